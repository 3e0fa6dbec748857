"""Conversion of files, by their suffixes."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from teeter import Record, scenes
from teeter.errors import InputError
from teeter.interchange.gltf import write_gltf
from teeter.interchange.mjcf_reader import read_mjcf
from teeter.interchange.mjcf_writer import write_mjcf
from teeter.interchange.motion import Motion
from teeter.interchange.trace import write_trace
from teeter.interchange.urdf_reader import read_urdf
from teeter.interchange.urdf_writer import write_urdf

__all__ = ["MOTIONS", "SCENES", "convert", "read_scene", "write_motion", "write_scene"]

PathLike = str | os.PathLike[str]

SCENES: dict[str, Callable[[Any], str]] = {
    ".json": lambda scene: json.dumps(scenes.load(scene), indent=1) + "\n",
    ".xml": write_mjcf,
    ".mjcf": write_mjcf,
    ".urdf": write_urdf,
}
"""Writers of scenes, by suffix."""

MOTIONS: dict[str, Callable[[Motion, PathLike], None]] = {
    ".glb": write_gltf,
    ".csv": write_trace,
    ".parquet": write_trace,
}
"""Writers of motions, by suffix."""

_READERS: dict[str, Callable[[bytes], dict[str, Any]]] = {".xml": read_mjcf, ".mjcf": read_mjcf, ".urdf": read_urdf}
RECORD = ".record"


def _suffix(path: PathLike) -> str:
    return Path(path).suffix.lower()


def read_scene(path: PathLike) -> dict[str, Any]:
    """Reads a scene: MJCF from .xml or .mjcf, URDF from .urdf, the first scene of a .record, and all
    else as World takes it: a name, a notation or a file of JSON.

    Raises InterchangeError, SceneError, RecordError or OSError.
    """
    suffix = _suffix(path)
    if suffix == RECORD:
        return Record(Path(path).read_bytes()).scene
    if suffix in _READERS:
        return _READERS[suffix](Path(path).read_bytes())
    return scenes.load(path)


def write_scene(scene: Any, path: PathLike) -> None:
    """Writes a scene as .json, .xml, .mjcf or .urdf. Raises InputError for another suffix."""
    suffix = _suffix(path)
    if suffix not in SCENES:
        raise InputError(f"`path` is {path}, expected a name that ends in {', '.join(SCENES)}", "path")
    Path(path).write_text(SCENES[suffix](scene), encoding="utf-8")


def write_motion(source: Any, path: PathLike, *, seconds: float | None = None, every: int = 1) -> None:
    """Writes a motion as .glb, .csv or .parquet.

    source, seconds, every: as Motion takes them. Raises InputError for another suffix.
    """
    suffix = _suffix(path)
    if suffix not in MOTIONS:
        raise InputError(f"`path` is {path}, expected a name that ends in {', '.join(MOTIONS)}", "path")
    MOTIONS[suffix](Motion(source, seconds, every), path)


def convert(source: PathLike, target: PathLike, *, seconds: float | None = None, every: int = 1) -> None:
    """Converts a file.

    A scene becomes a scene; a record or a scene becomes a motion: a record as it was played, a scene
    as it goes on by itself, 10 s where ``seconds`` is None. Raises InputError, InterchangeError,
    SceneError, RecordError or OSError.
    """
    if _suffix(target) in SCENES:
        write_scene(read_scene(source), target)
        return
    is_record = _suffix(source) == RECORD
    motion = Record(Path(source).read_bytes()) if is_record else read_scene(source)
    if _suffix(target) not in MOTIONS:
        known = ", ".join([*SCENES, *MOTIONS])
        raise InputError(f"`target` is {target}, expected a name that ends in {known}", "target")
    write_motion(motion, target, seconds=seconds, every=every)
