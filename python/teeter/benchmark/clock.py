"""An engine with its CPU time, and checks of what it returns."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence

import numpy as np

from teeter.benchmark.engine import FRAME, Engine, Floats, Scene
from teeter.errors import EngineError

__all__ = ["ClockedEngine"]


class ClockedEngine:
    """Engine that adds up simulated time and the CPU time of its steps.

    name: as in messages. Loading a scene and reading poses are not timed. Raises EngineError where
    the engine fails or its poses are not of the protocol; values that are not finite are poses of
    blocks that have fallen.
    """

    def __init__(self, engine: Engine, name: str) -> None:
        self.engine = engine
        self.name = name
        self.simulated_s = 0.0
        self.cpu_s = 0.0
        self._bodies = 0

    @property
    def details(self) -> str:
        """Version and settings of the engine, empty where it has none."""
        return str(getattr(self.engine, "details", ""))

    def load(self, scene: Scene) -> None:
        """Loads a scene under gravity that will grow."""
        self._bodies = len(scene["blocks"])
        self._call("load", scene)

    def start(self, scene: Scene, seconds: float = 0.3) -> None:
        """Loads a scene and lets gravity grow to its value, linearly over a time, s.

        All engines begin alike, without load: with one that begins with it, a tower would drop by
        what its contacts give.
        """
        self.load(scene)
        frames = max(1, round(seconds / FRAME))
        for i in range(1, frames + 1):
            self.set_gravity((0.0, 0.0, -scene.get("gravity", 9.81) * i / frames))
            self.step()

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Sets gravity, m/s²."""
        self._call("set_gravity", gravity)

    def step(self, forces: Mapping[int, Sequence[float]] | None = None) -> None:
        """Advances by a frame under forces at centres, N."""
        start = self._cpu_seconds()
        self._call("step", FRAME, forces or {})
        self.cpu_s += self._cpu_seconds() - start
        self.simulated_s += FRAME

    def run_for(self, seconds: float) -> None:
        """Advances by whole frames."""
        for _ in range(round(seconds / FRAME)):
            self.step()

    def poses(self) -> Floats:
        """Poses, float64 of shape (n, 7), a copy."""
        poses = np.array(self._call("poses"), dtype=np.float64)
        if poses.shape != (self._bodies, 7):
            message = f"engine {self.name}: `poses` has shape {poses.shape}, expected ({self._bodies}, 7)"
            raise EngineError(message, "poses")
        return poses

    def _cpu_seconds(self) -> float:
        other = getattr(self.engine, "cpu_seconds", None)
        return time.process_time() if other is None else float(other())

    def _call(self, function: str, *arguments: object) -> object:
        try:
            result: object = getattr(self.engine, function)(*arguments)
            return result
        except EngineError:
            raise
        except Exception as error:
            line = " ".join(f"{type(error).__name__}: {error}".split())
            raise EngineError(f"engine {self.name} fails in {function}: {line}", function) from error
