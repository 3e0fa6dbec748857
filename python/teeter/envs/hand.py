"""What the environments of a hand share: a block that it holds, and commands that move it."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from teeter.envs.episode import Episode
from teeter.envs.screen import RENDER_MODES

#: Frames of a step: 20 steps a second.
FRAMES = 3
#: Largest displacement of the hand's goal in a step, m.
REACH = 0.005

#: Bound of the numbers of an observation.
BOUND = 1e4

Vector = NDArray[np.float64]


def axes_of(quaternion: Vector) -> Vector:
    """Axes of a body in the world, the columns of a 3 by 3 array, from its quaternion x, y, z, w."""
    x, y, z, w = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


class HandEnv(Episode, gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """An environment in which a hand holds one block."""

    metadata: dict[str, Any] = {"render_modes": RENDER_MODES, "render_fps": 20}

    body: int = 0

    @staticmethod
    def observation(*parts: Any) -> NDArray[np.float32]:
        """Joins the parts of an observation."""
        joined: NDArray[np.float32] = np.clip(np.concatenate(parts), -BOUND, BOUND).astype(np.float32)
        return joined

    def others_moved(self, before: Vector) -> float:
        """Largest distance of any other block from where it was, m."""
        distance = np.linalg.norm(self.game.poses[:, :3] - before[:, :3], axis=1)
        distance[self.body] = 0.0
        return float(distance.max())
