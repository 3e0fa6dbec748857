"""Trace of a motion: a row a state and block, as Parquet or CSV, with the columns of docs/trace.md."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from teeter import __version__
from teeter.errors import InputError, InterchangeError
from teeter.interchange.motion import Motion, State

__all__ = ["COLUMNS", "write_trace"]

_POSE = [f"position_{axis}_m" for axis in "xyz"] + [f"orientation_{axis}" for axis in "xyzw"]
_TWIST = [f"velocity_{axis}_m_s" for axis in "xyz"] + [f"spin_{axis}_rad_s" for axis in "xyz"]
COLUMNS = ["time_s", "id", *_POSE, *_TWIST, "asleep", "quarantined"]
"""Names of the columns, with their units."""

# Rows of a group in a Parquet file.
GROUP_ROWS = 65_536


def write_trace(motion: Motion, path: str | os.PathLike[str]) -> None:
    """Writes a motion as Parquet or CSV, by the suffix of the path.

    The columns, their order and the metadata of a Parquet file are those of `teeter run --trace`.
    Parquet is written in groups of 65,536 rows, so a long motion needs no more memory than a short
    one. Raises InputError for another suffix, InterchangeError without the package pyarrow.
    """
    target = Path(path)
    writers: dict[str, Callable[[Motion, Path], None]] = {".csv": _write_csv, ".parquet": _write_parquet}
    if target.suffix.lower() not in writers:
        raise InputError(f"`path` is {target}, expected a name that ends in .parquet or .csv", "path")
    part = target.with_name(target.name + ".part")
    try:
        writers[target.suffix.lower()](motion, part)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)


def _columns(motion: Motion, state: State) -> dict[str, Any]:
    """Columns of a state, each with a value a block."""
    columns: dict[str, Any] = {
        "time_s": np.full(len(motion.ids), state.time),
        "id": np.array(motion.ids, dtype=np.uint32),
    }
    columns |= dict(zip(_POSE, state.poses.T, strict=True))
    columns |= dict(zip(_TWIST, state.velocities.T, strict=True))
    return columns | {"asleep": state.asleep, "quarantined": state.quarantined}


def _write_csv(motion: Motion, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for state in motion:
            rows = zip(*(values.tolist() for values in _columns(motion, state).values()), strict=True)
            writer.writerows([_cell(value) for value in row] for row in rows)


def _cell(value: Any) -> Any:
    return str(value).lower() if isinstance(value, bool) else repr(value)


def _write_parquet(motion: Motion, path: Path) -> None:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError as error:
        raise InterchangeError("Parquet needs pyarrow: pip install 'teeter[interchange]'") from error
    kinds = {"id": pa.uint32(), "asleep": pa.bool_(), "quarantined": pa.bool_()}
    fields = [pa.field(name, kinds.get(name, pa.float64()), nullable=False) for name in COLUMNS]
    notes = {
        "scene": motion.scene["name"],
        "teeter_version": __version__,
        "frame_s": _digits(motion.frame),
        "substep_s": _digits(motion.substep),
        "dt_s": _digits(motion.frame * motion.every),
    }
    schema = pa.schema(fields, metadata=notes)
    with parquet.ParquetWriter(path, schema, compression="snappy") as writer:
        for group in _groups(motion):
            writer.write_table(pa.table([pa.array(group[name], kinds.get(name)) for name in COLUMNS], schema=schema))


def _digits(number: float) -> str:
    """All digits of a number, without an exponent."""
    return np.format_float_positional(number, trim="-")


def _groups(motion: Motion) -> Iterator[dict[str, Any]]:
    """Columns of so many states that a group has about GROUP_ROWS rows."""
    states = max(1, GROUP_ROWS // max(1, len(motion.ids)))
    waiting: list[dict[str, Any]] = []
    for state in motion:
        waiting.append(_columns(motion, state))
        if len(waiting) == states:
            yield _joined(waiting)
            waiting = []
    if waiting:
        yield _joined(waiting)


def _joined(columns: list[dict[str, Any]]) -> dict[str, Any]:
    return {name: np.concatenate([part[name] for part in columns]) for name in COLUMNS}
