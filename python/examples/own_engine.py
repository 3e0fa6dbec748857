"""An engine of one's own for the benchmark: Teeter with contacts ten times softer.

python -m teeter.benchmark --engine teeter,own_engine.py:SoftEngine --tasks forces --rows 6
"""

from __future__ import annotations

from typing import Any

import numpy as np

from teeter import Force, World


class SoftEngine:
    """The four functions of an engine, see teeter.benchmark.Engine."""

    details = "Teeter, contacts of 1e5 N/m"

    def load(self, scene: dict[str, Any]) -> None:
        """Builds the scene."""
        # a ramp that is over at once: the world begins without load, as the tasks expect
        self.world = World({**scene, "stiffness": 1e5}, sleep=False, ramp=1e-9)
        self.gravity: Any = (0.0, 0.0, -scene["gravity"])

    def set_gravity(self, gravity: Any) -> None:
        """Sets the acceleration of free fall, m/s²."""
        self.gravity = gravity

    def step(self, seconds: float, forces: Any) -> None:
        """Advances by a time, s, under forces at centres, N, by body."""
        applied = [Force(body=body, force=force) for body, force in forces.items()]
        self.world.run_for(seconds, forces=applied, gravity=self.gravity)

    def poses(self) -> np.ndarray:
        """Poses of shape (n, 7): centre, m, and quaternion x, y, z, w."""
        return self.world.poses
