"""Teeter, in this process."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from teeter import Force, World, __version__
from teeter.benchmark.engine import FRAME, Floats, Scene

__all__ = ["TeeterEngine"]

# Shorter than a substep: gravity has its value from the start, and what touches does not settle
# before time begins, so that Teeter begins as other engines do.
RAMP = 1e-9


class TeeterEngine:
    """Teeter with its defaults, sleep off."""

    details = f"Teeter {__version__}, frame 1/60 s, inner loop in single precision, sleep off, the rest default"

    def __init__(self) -> None:
        self._world: World | None = None
        self._gravity: tuple[float, ...] = (0.0, 0.0, -9.81)

    def load(self, scene: Scene) -> None:
        """Builds a world."""
        self._world = World(scene, sleep=False, ramp=RAMP, frame=FRAME)
        self._gravity = (0.0, 0.0, -float(scene.get("gravity", 9.81)))

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Sets gravity, m/s²."""
        self._gravity = tuple(float(part) for part in gravity)

    def step(self, seconds: float, forces: Mapping[int, Sequence[float]]) -> None:
        """Advances by whole frames; a force grows to its value within each."""
        applied = [Force(body=body, force=force) for body, force in forces.items()]
        self.world.run_for(seconds, forces=applied, gravity=self._gravity)

    def poses(self) -> Floats:
        """Poses, float64 of shape (n, 7)."""
        return self.world.poses

    @property
    def world(self) -> World:
        """World of the scene."""
        if self._world is None:
            raise RuntimeError("no scene is loaded")
        return self._world
