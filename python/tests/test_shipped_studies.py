"""Studies that come with the package: what is known of their results, their plots and the data set."""

import functools
import json
import os

import numpy as np
import pytest
from study_samples import NUMBER

import teeter
from teeter import study
from teeter.study import card, dataset, plot
from teeter.study.folder import table_digest

pq = pytest.importorskip("pyarrow.parquet")

#: Few and low towers, so that the tests take seconds.
SMALL = {
    "removal": {"rows": 3, "block": [0, 4, 7]},
    "loose": {"rows": 3, "height_sd": [0.0, 1e-4]},
    "strength": {"rows": 4, "strength": ["random"]},
    "extraction": {"rows": 4, "policy": ["pull", "random"]},
}


@functools.cache
def small(name):
    """Three samples of a study."""
    return study.run(name, samples=3, seed=5, params=SMALL[name])


@pytest.mark.parametrize("name", list(study.STUDIES))
def test_a_study_is_a_pure_function_of_its_sample(name):
    plan, table = study.Plan(study.STUDIES[name], 5, SMALL[name]), small(name).table
    assert list(table.to_pylist()[2].values()) == plan.row(2)
    again = study.run(name, samples=2, seed=5, params=SMALL[name], executor="threads", batch=1)
    assert again.table.equals(table.slice(0, 2))
    for column in (*plan.study.columns, *plan.params):
        assert column in plan.study.about, f"{name}.{column}"


def test_a_removal_by_hand_agrees_with_statics_where_statics_is_sure():
    # Without its middle block the lower row of (010) would bear nothing; a full row bears with two.
    plan = study.Plan(study.STUDIES["removal"], params={"rows": 3})
    assert plan.combinations[-1]["block"] == 8
    result = study.run("removal", samples=18, seed=1, params={"rows": 3, "hand": "none"})
    rows = result.table.to_pylist()
    assert [row["block"] for row in rows] == [*range(9), *range(9)]
    for row in rows:
        assert row["fell_without"] == row["fell_exact"]
        assert row["loose"] == (row["load"] < 1e-3)
        assert row["end"] in ("placed", "stuck", "dropped", "fell")
        assert row["fell"] == (row["end"] == "fell")
        if row["block"] >= 6:
            # nothing lies on the top row
            assert row["loose"] and not row["fell"]


def test_blocks_are_loose_by_their_heights():
    """Equal heights leave no block loose. On stiff contacts the middle block of a row is loose where it is lower
    than the mean of the outer ones, and otherwise at least one of these is."""
    params = {"rows": 6, "height_sd": [0.0, 3e-4], "stiffness": 1e8}
    result = study.run("loose", samples=12, seed=1, params=params)
    equal, _ = result.summary()
    assert equal["loose_share"] == 0.0
    assert all(result.table["at_rest"].to_pylist())
    for row in result.table.to_pylist()[1::2]:
        seed = int(result.plan.sample(row["index"]).rng().integers(2**63))
        blocks = teeter.scenes.tower(rows=6, seed=seed, height_sd=3e-4)["blocks"]
        heights = np.array([block["size"][2] for block in blocks[:-3]]).reshape(-1, 3)
        is_low = heights[:, 1] < heights[:, [0, 2]].mean(axis=1)
        middle, outer = round(5 * row["loose_middle"]), round(10 * row["loose_outer"])
        assert middle == is_low.sum()
        assert (~is_low).sum() <= outer <= 2 * (~is_low).sum()


def test_a_player_builds_as_high_as_its_moves():
    result = study.run("strength", samples=2, seed=1, params={"rows": 4, "strength": "random", "players": 2})
    for row in result.table.to_pylist():
        assert row["height_rows"] == 4 + -(-row["moves"] // 3)
        assert row["seconds"] > 0
    with pytest.raises(teeter.StudyError, match="sample 0 of study `strength` failed: InputError: `strength"):
        study.run("strength", samples=1, params={"strength": "strong"})


@pytest.mark.parametrize("name", list(study.STUDIES))
def test_a_plot_shows_the_results_and_has_the_same_bytes_again(name, tmp_path):
    result = small(name)
    result.plot(tmp_path / "a.svg")
    result.plot(tmp_path / "b.svg")
    drawn = (tmp_path / "a.svg").read_text()
    assert drawn == (tmp_path / "b.svg").read_text()
    words = {"removal": "3 removals", "loose": "3 towers", "strength": "3 games", "extraction": "3 samples"}
    assert words[name] in drawn
    with pytest.raises(teeter.StudyError, match="cannot be drawn"):
        result.plot(tmp_path / "a.castle")


def test_any_study_can_be_drawn_over_its_sweep():
    result = study.run(NUMBER, samples=12)
    axes = result.plot().axes[0]
    (bars,) = axes.containers
    assert bars[0].get_xdata().tolist() == [1, 2, 3]
    assert bars[0].get_ydata() == pytest.approx([line["x"] for line in result.summary()])
    with pytest.raises(teeter.StudyError, match="`castle` is no column"):
        plot.sweep(result.table, "castle", "x")
    with pytest.raises(teeter.StudyError, match="no parameter is swept"):
        study.run(NUMBER, samples=2, params={"a": 1}).plot()


# The data set


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    pytest.importorskip("minari")
    out = tmp_path_factory.mktemp("dataset")
    made = dataset.build(out, episodes=6, seed=3, params={"rows": 4})
    assert made == out / "README.md"
    return out


def test_the_steps_of_the_data_set_are_those_of_the_environment(data):
    from teeter.envs.extract import ExtractEnv

    episodes = pq.read_table(data / "removals.parquet").to_pylist()
    steps = pq.read_table(data / "steps.parquet").to_pylist()
    assert [episode["episode"] for episode in episodes] == list(range(6))
    assert len(steps) == sum(episode["steps"] + 1 for episode in episodes)
    for episode in episodes[:3]:
        own = [step for step in steps if step["episode"] == episode["episode"]]
        env = ExtractEnv(rows=4, loose=False)
        observation, info = env.reset(seed=episode["seed"])
        assert info["body"] == episode["body"]
        for step in own[:-1]:
            assert observation.tolist() == step["observation"]
            observation, reward, terminated, _, _ = env.step(np.array(step["action"], np.float32))
            assert (reward, terminated) == (step["reward"], step["terminated"])
        assert observation.tolist() == own[-1]["observation"]
        assert own[-1]["action"] is own[-1]["reward"] is None
        assert own[-2]["terminated"] != own[-2]["truncated"]
        assert terminated == (episode["out"] or episode["fell"])


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
def test_the_data_set_is_read_by_minari(data, monkeypatch):
    import minari

    import teeter.envs  # noqa: F401

    monkeypatch.setenv("MINARI_DATASETS_PATH", str(data / "minari"))
    loaded = minari.load_dataset(dataset.DATASET_ID)
    table = study.load(data / "study").table
    assert loaded.total_episodes == 6
    assert loaded.total_steps == sum(table["steps"].to_pylist())
    for episode, rewards in zip(loaded.iterate_episodes(), table["rewards"].to_pylist(), strict=True):
        assert episode.rewards.tolist() == rewards
        assert episode.observations.shape == (len(rewards) + 1, 18)
        assert episode.actions.dtype == np.float32
        assert (episode.terminations | episode.truncations).tolist() == [False] * (len(rewards) - 1) + [True]
    env = loaded.recover_environment()
    first = table["seed"][0].as_py()
    assert env.reset(seed=first)[0].tolist() == loaded[0].observations[0].tolist()


def test_the_card_has_what_makes_the_data_set_again(data):
    text = (data / "README.md").read_text()
    result = study.load(data / "study")
    assert "--samples 6 --seed 3 --set rows=4" in text
    assert result.digest in text
    for name, words in (("removals", card.REMOVALS), ("steps", card.STEPS)):
        columns = pq.read_schema(data / f"{name}.parquet").names
        assert columns == [column for names in words for column in names.split(", ")]
    policies = [line.split(" | ") for line in text.splitlines() if line.startswith(("| pull", "| wiggle", "| random"))]
    assert [int(line[1]) for line in policies] == [2, 2, 2]
    out = sum(result.table["out"].to_pylist())
    assert sum(2 * int(line[2].removesuffix(" %")) / 100 for line in policies) == pytest.approx(out)


def test_the_data_set_is_made_again_from_its_study(data):
    before = {path: path.read_bytes() for path in data.glob("*.parquet")}
    digest = table_digest(pq.read_table(data / "steps.parquet").select(["reward"]))
    dataset.build(data, episodes=6, seed=3, params={"rows": 4})
    assert {path: path.read_bytes() for path in data.glob("*.parquet")} == before
    assert table_digest(pq.read_table(data / "steps.parquet").select(["reward"])) == digest
    assert not list(data.rglob("*.unfinished"))
    assert "MINARI_DATASETS_PATH" not in os.environ
    assert json.loads((data / "study" / "manifest.json").read_text())["study"] == "extraction"
