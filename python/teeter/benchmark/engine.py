"""Protocol of an engine under measurement, and how one is found."""

from __future__ import annotations

import importlib
import importlib.util
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from teeter.errors import EngineError, TeeterError

__all__ = ["ENGINES", "FRAME", "Engine", "load_engine"]

FRAME = 1.0 / 60.0
"""Time of a frame, s: forces and gravity change from frame to frame."""

Scene = dict[str, Any]
Floats = NDArray[np.float64]


@runtime_checkable
class Engine(Protocol):
    """An engine with a scene. SI units, z up, the floor at z = 0, one thread, sleep off.

    An instance is made without arguments and loads many scenes, one after the other. ``details``,
    where it has one, is a text with version and settings. An engine that computes in another process
    has ``cpu_seconds()`` as well: the CPU time used so far, s.
    """

    def load(self, scene: Scene) -> None:
        """Builds a scene at time 0, at rest, and drops the former one.

        scene: a dict with the fields of docs/scene-format.md, which no engine may change. Block i of
        its list is body i. Gravity is that of the scene until set_gravity changes it.
        """

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Sets the acceleration of free fall, three numbers in the world, m/s²."""

    def step(self, seconds: float, forces: Mapping[int, Sequence[float]]) -> None:
        """Advances by a time, s, in as many steps as the engine takes.

        forces: of some bodies, by index: a force at the centre, three numbers in the world, N. It
        acts during this call alone; it may grow to that value from that of the last call.
        """

    def poses(self) -> Floats:
        """Poses of all bodies, float64 of shape (n, 7): centre (m), quaternion x, y, z, w."""


ENGINES: dict[str, str] = {
    "teeter": "teeter.benchmark.engines.teeter:TeeterEngine",
    "mujoco": "teeter.benchmark.engines.mujoco:TunedMujoco",
    "mujoco-default": "teeter.benchmark.engines.mujoco:DefaultMujoco",
    "rapier": "teeter.benchmark.engines.rapier:TunedRapier",
    "rapier-default": "teeter.benchmark.engines.rapier:DefaultRapier",
}
"""Engines that come with the package, by name."""


def load_engine(name: str) -> Engine:
    """Makes an engine: one of ENGINES, ``module:Class`` or ``file.py:Class``.

    Raises EngineError where there is none or it is not of the protocol, and UnavailableError where its
    package or program is missing.
    """
    where, colon, attribute = ENGINES.get(name, name).rpartition(":")
    if not colon or not where or not attribute:
        known = ", ".join(ENGINES)
        raise EngineError(f"`engine` is {name}, expected one of {known}, `module:Class` or `file.py:Class`", "engine")
    module = _module(where, name)
    try:
        engine = getattr(module, attribute)()
    except TeeterError:
        raise
    except Exception as error:
        raise EngineError(f"engine {name} cannot be made: {_one_line(error)}", "engine") from error
    missing = [part for part in ("load", "set_gravity", "step", "poses") if not callable(getattr(engine, part, None))]
    if missing:
        raise EngineError(f"engine {name} has no {', '.join(missing)}: see teeter.benchmark.Engine", "engine")
    checked: Engine = engine
    return checked


def _module(where: str, name: str) -> ModuleType:
    try:
        if where.endswith(".py"):
            path = Path(where).resolve()
            spec = importlib.util.spec_from_file_location(path.stem, os.fspath(path))
            if spec is None or spec.loader is None:
                raise ImportError("it is no file of Python")
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            return module
        return importlib.import_module(where)
    except TeeterError:
        raise
    except Exception as error:
        raise EngineError(f"engine {name} cannot be loaded: {_one_line(error)}", "engine") from error


def _one_line(error: BaseException) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())
