"""Data set of removals: episodes of the study ``extraction`` as Parquet and for Minari, with a data card."""

from __future__ import annotations

import os
import shutil
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from teeter.study.card import card
from teeter.study.extra import needed
from teeter.study.runner import Result, run
from teeter.study.shipped.extraction import MAX_STEPS

__all__ = ["ABOUT", "DATASET_ID", "build"]

ABOUT = "Data set of removals: the study `extraction` as Parquet and for Minari, with its card."
#: Name of the data set for Minari.
DATASET_ID = "teeter/removals-v0"
#: Numbers of an observation and of an action of Teeter/Extract-v0.
OBSERVATION, ACTION = 18, 3


def build(
    out: str | os.PathLike[str],
    episodes: int | None = None,
    seed: int = 0,
    params: Mapping[str, Any] | None = None,
    **kwargs: Any,
) -> Path:
    """Makes the data set in a folder and returns the path of its card, README.md.

    out: folder; its part ``study`` has the results of the study, from which the rest is made again. episodes:
    their number, ten of each policy by default. seed, params and kwargs are those of teeter.study.run.

    ``removals.parquet`` has a row an episode, ``steps.parquet`` a row a step, and ``minari`` the data set
    ``teeter/removals-v0``, for MINARI_DATASETS_PATH. Raises StudyError or UnavailableError.
    """
    path = Path(out)
    needed("minari", "minari")
    needed("gymnasium", "gym")
    result = run("extraction", path / "study", samples=episodes, seed=seed, params=params, **kwargs)
    written = [_removals(path, result), _steps(path, result), _minari(path, result)]
    unfinished = path / "README.unfinished"
    unfinished.write_text(card(result, DATASET_ID, sum(one.stat().st_size for one in written[:2])))
    return unfinished.replace(path / "README.md")


def _removals(path: Path, result: Result) -> Path:
    """A row an episode, without its steps."""
    table = result.table.drop_columns(["observations", "actions", "rewards"])
    return _write(table.rename_columns(["episode", *table.column_names[1:]]), path / "removals.parquet")


def _steps(path: Path, result: Result) -> Path:
    """A row a step: the observation before it, the action, the reward, and whether the episode ended with it.

    The last row of an episode has the last observation and no action.
    """
    arrow = needed("pyarrow", "study")
    parts = [_steps_of(_episode(result.table, i), i, arrow) for i in range(result.table.num_rows)]
    return _write(arrow.concat_tables(parts), path / "steps.parquet")


def _steps_of(one: Mapping[str, Any], episode: int, arrow: Any) -> Any:
    """Table of the steps of an episode."""
    rows = len(one["observations"])
    is_last = np.arange(rows) == rows - 2
    observations = arrow.array(one["observations"].ravel())
    columns = {
        "episode": arrow.array([episode] * rows, arrow.int64()),
        "step": arrow.array(range(rows), arrow.int64()),
        "observation": arrow.FixedSizeListArray.from_arrays(observations, OBSERVATION),
        "action": arrow.array([*one["actions"].tolist(), None], arrow.list_(arrow.float32(), ACTION)),
        "reward": arrow.array([*one["rewards"].tolist(), None], arrow.float64()),
        "terminated": arrow.array(is_last & one["is_over"]),
        "truncated": arrow.array(is_last & (not one["is_over"])),
    }
    return arrow.table(columns)


def _minari(path: Path, result: Result) -> Path:
    """Data set of Minari in a folder of its own."""
    minari = needed("minari", "minari")
    gymnasium = needed("gymnasium", "gym")
    needed("teeter.envs", "gym")
    buffer = needed("minari.data_collector", "minari").EpisodeBuffer
    root, unfinished = path / "minari", path / "minari.unfinished"
    shutil.rmtree(unfinished, ignore_errors=True)
    buffers = []
    for i in range(result.table.num_rows):
        one = _episode(result.table, i)
        ends = np.arange(len(one["rewards"])) == len(one["rewards"]) - 1
        buffers.append(
            buffer(
                id=i,
                seed=result.table["seed"][i].as_py(),
                observations=one["observations"],
                actions=one["actions"],
                rewards=one["rewards"],
                terminations=ends & one["is_over"],
                truncations=ends & (not one["is_over"]),
            )
        )
    rows = result.plan.params["rows"]
    spec = gymnasium.spec("Teeter/Extract-v0")
    spec.kwargs = {"loose": False} if isinstance(rows, tuple) else {"rows": rows, "loose": False}
    with _datasets_path(unfinished), warnings.catch_warnings():
        # Minari asks for an address of the makers and a link to the code, which a copy of the data has not.
        warnings.simplefilter("ignore")
        minari.create_dataset_from_buffers(
            DATASET_ID,
            buffers,
            env=spec,
            algorithm_name=", ".join(sorted(set(result.table["policy"].to_pylist()))),
            author="the Teeter project",
            description="Removals of one block of a tower by scripted hands; see README.md.",
            data_format="parquet",
            requirements=[f"teeter=={result.plan.identity()['engine']}"],
        )
    shutil.rmtree(root, ignore_errors=True)
    return unfinished.replace(root)


@contextmanager
def _datasets_path(path: Path) -> Iterator[None]:
    """Lets Minari write to a folder."""
    before = os.environ.get("MINARI_DATASETS_PATH")
    os.environ["MINARI_DATASETS_PATH"] = str(path.resolve())
    try:
        yield
    finally:
        if before is None:
            del os.environ["MINARI_DATASETS_PATH"]
        else:
            os.environ["MINARI_DATASETS_PATH"] = before


def _episode(table: Any, index: int) -> dict[str, Any]:
    """Arrays of an episode: observations (steps + 1, 18), actions (steps, 3), rewards (steps,), and its end."""
    steps = table["steps"][index].as_py()
    is_over = table["out"][index].as_py() or table["fell"][index].as_py()
    assert is_over or steps == MAX_STEPS, "an episode without an end"
    return {
        "observations": _numbers(table, "observations", index).astype(np.float32).reshape(steps + 1, OBSERVATION),
        "actions": _numbers(table, "actions", index).astype(np.float32).reshape(steps, ACTION),
        "rewards": _numbers(table, "rewards", index),
        "is_over": is_over,
    }


def _numbers(table: Any, column: str, index: int) -> Any:
    return table[column][index].values.to_numpy()


def _write(table: Any, path: Path) -> Path:
    """Writes a table, as a whole or not at all."""
    unfinished = path.with_suffix(".unfinished")
    needed("pyarrow.parquet", "study").write_table(table, unfinished)
    return unfinished.replace(path)
