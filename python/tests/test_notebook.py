"""The widget of notebooks: its values, its picture, and errors where a part is missing."""

import base64
import io

import IPython
import numpy as np
import pytest
from PIL import Image

import teeter
from teeter import notebook
from teeter.notebook import motions, stills


def numbers(data, *shape):
    return np.frombuffer(data, np.float32).reshape(shape)


@pytest.fixture(scope="module")
def record():
    tower = teeter.scenes.tower(rows=4)
    return teeter.contest(tower, "official", ["random", "random"], seed=3)[0]


def test_a_view_has_the_sizes_and_poses_of_its_world_and_follows_it():
    world = teeter.World("loose")
    view = notebook.show(world, height=300)
    assert view.height == 300 and view.frame == 0 and not view.playing and view.readings == b""
    assert np.array_equal(numbers(view.sizes, -1, 3), world.sizes.astype(np.float32))
    assert np.array_equal(numbers(view.poses, -1, 7), world.poses.astype(np.float32))
    world.step(drives=[teeter.Drive(body=8, velocity=(0.5, 0, 0))])
    view.update()
    assert np.array_equal(numbers(view.poses, -1, 7), world.poses.astype(np.float32))


def test_views_follow_their_worlds_after_each_cell_until_they_are_closed(monkeypatch):
    shell = IPython.core.interactiveshell.InteractiveShell()
    monkeypatch.setattr(IPython, "get_ipython", lambda: shell)
    world = teeter.World("column")
    first, second = notebook.show(world), notebook.show(world)
    still = notebook.scrub(world.poses, world)
    assert len([call for call in shell.events.callbacks["post_run_cell"] if "_update_all" in call.__name__]) == 1
    before = first.poses
    second.close()
    world.step(drives=[teeter.Drive(body=9, velocity=(0.5, 0, 0))])
    shell.events.trigger("post_run_cell", None)
    assert np.array_equal(numbers(first.poses, -1, 7), world.poses.astype(np.float32)) and first.poses != before
    assert second.poses == before and still.poses == before


@pytest.mark.parametrize("source", ["column", teeter.scenes.named("column"), "(010)-(111)"])
def test_a_scene_is_shown_as_the_world_that_it_makes(source):
    assert len(notebook.show(source).poses) == 28 * len(teeter.World(source))


def test_a_game_is_followed_as_its_world_is():
    game = teeter.Game(teeter.scenes.tower(rows=3))
    view = notebook.show(game)
    game.step({"command": "grasp", "body": 4, "anchor": [0, 0, 0], "normal": [1, 0, 0], "grip": "push"}, frames=5)
    view.update()
    assert np.array_equal(numbers(view.poses, -1, 7), game.poses.astype(np.float32))


def test_an_x_ray_has_the_load_and_the_breakaway_force_of_each_block():
    world = teeter.World("loose")
    world.run_for(1.0)
    loads = world.xray()
    view = notebook.xray(world)
    assert np.allclose(numbers(view.readings, -1, 2), np.stack([loads.above, loads.tightness], 1), equal_nan=True)


def test_a_record_is_played_again_frame_by_frame(record):
    view = notebook.scrub(record, rate=10)
    poses = numbers(view.poses, -1, 12, 7)
    assert view.interval == pytest.approx(0.1) and len(poses) == 1 + record.frames // 6
    for state in (0, 3, len(poses) - 1):
        assert np.array_equal(poses[state], record.game(6 * state).poses.astype(np.float32))


def test_a_coarse_motion_is_that_of_the_keyframes(record):
    view = notebook.scrub(record, rate=1)
    poses = numbers(view.poses, -1, 12, 7)
    assert view.interval == 1.0 and np.array_equal(poses[1:], record.keyframes().astype(np.float32))


def test_poses_of_a_rollout_are_a_motion():
    batch = teeter.WorldBatch(["column", "column"])
    rollout = batch.rollout(20, every=5)
    view = notebook.scrub(rollout.poses[1], "column", rate=12)
    assert np.array_equal(numbers(view.poses, 4, 10, 7), rollout.poses[1].astype(np.float32))
    assert view.interval == 1 / 12


@pytest.mark.parametrize(
    "motion, world, rate, field",
    [
        (np.zeros((2, 3, 7)), "column", 10, "motion"),
        (np.full((2, 10, 7), np.nan), "column", 10, "motion"),
        (np.zeros((0, 10, 7)), "column", 10, "motion"),
        ("castle", "column", 10, "motion"),
        (np.zeros((2, 10, 7)), None, 10, "world"),
        (np.zeros((2, 10, 7)), "column", 0, "rate"),
        (np.zeros((2, 10, 7)), "column", float("nan"), "rate"),
        (np.zeros((2, 10, 7)), "column", "fast", "rate"),
    ],
)
def test_a_bad_motion_is_an_input_error(motion, world, rate, field):
    with pytest.raises(teeter.InputError) as raised:
        notebook.scrub(motion, world, rate=rate)
    assert raised.value.field == field


@pytest.mark.parametrize("height", [0, 99, 4001, 300.0, "tall", None])
def test_a_bad_height_is_an_input_error(height):
    for shown in (notebook.show, notebook.xray):
        with pytest.raises(teeter.InputError, match="`height` is"):
            shown("column", height=height)


def test_messages_of_the_page_set_the_values_and_call_observers():
    view = notebook.show("column")
    seen = []
    view.observe(lambda change: seen.append((change["name"], change["new"])), ["selected", "frame"])
    view.set_state({"selected": 4, "frame": 0.0})
    assert view.selected == 4 and seen == [("selected", 4)]


def test_a_picture_stands_for_the_view_where_there_are_no_widgets():
    view = notebook.show("column")
    data, _ = view._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data
    picture = Image.open(io.BytesIO(base64.b64decode(data["image/png"])))
    assert picture.format == "PNG" and picture.size == (640, 420)
    assert np.asarray(picture.convert("RGB")).std() > 5
    assert len(base64.b64decode(data["image/png"])) < 100_000


def test_a_missing_part_is_an_error_with_the_command_to_run(monkeypatch, tmp_path):
    monkeypatch.setattr(notebook.bundle, "BUNDLE", tmp_path / "widget.js")
    with pytest.raises(teeter.UnavailableError, match="make page"):
        notebook.show("column")
    monkeypatch.setattr(notebook, "find_spec", lambda name: None)
    with pytest.raises(teeter.UnavailableError, match=r"pip install 'teeter\[notebook\]'"):
        notebook.xray("column")


def test_the_rate_of_a_long_record_is_limited(record, monkeypatch):
    monkeypatch.setattr(motions, "MAX_STATES", 20)
    poses, interval = motions.of_record(record, 60)
    assert len(poses) <= 20 and interval * (len(poses) - 1) <= record.seconds + 1e-9


def test_the_picture_of_an_x_ray_colours_each_block_and_nothing_else():
    world = teeter.World("column")
    wood, stained = stills.still(world), stills.still(world, np.full(10, 20.0))
    changed = (wood != stained).any(axis=2)
    rows, columns = np.nonzero(changed)
    # The column is one block wide, so its picture is upright, in the middle, and without holes.
    assert 0.1 * wood.shape[0] < np.ptp(rows) and abs(columns.mean() - wood.shape[1] / 2) < 20
    assert changed.mean() < 0.3 and changed[rows.min() : rows.max() + 1].any(axis=1).all()
    colour = stained[changed].mean(axis=0)
    assert colour[2] > colour[0] > colour[1], "the dark violet of tight blocks"
    loose = stills.still(world, np.where(np.arange(10) == 9, 0.05, 20.0))
    top = rows.min() + np.ptp(rows) // 20
    assert (loose != stained).any(axis=2)[: top + 1].any() and not (loose != stained).any(axis=2)[rows.max()].any()
