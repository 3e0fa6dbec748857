"""Teeter/Place-v0: a hand puts a block down on top of the tower."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from teeter import Game
from teeter.envs.hand import BOUND, FRAMES, REACH, HandEnv, axes_of
from teeter.envs.screen import Screen
from teeter.envs.tower import DOMAIN, checked_rows, draw_scene

Floats = NDArray[np.float32]

#: Rotation of the block in a step, rad.
TURN = 0.05
#: Offset (m) and angle (rad) within which a block is in its slot.
IN_SLOT, ASKEW = 0.006, 0.15
#: Frames for which the tower is watched after the hand let go.
AFTER = 90


class PlaceEnv(HandEnv):
    """A block is carried beside and above the tower; put it into the drawn slot and let go.

    Action, in [-1, 1]: displacement of the hand's goal in a step of 1/20 s over 5 mm (x, y, z), rotation
    about the vertical over 0.05 rad, and letting go where the last is above 0.5.
    Observation, float32 of shape (14,): slot less centre of the block (3, cm), angle to the slot about
    the vertical (rad), velocity (3, cm/s) and spin (3, rad/s) of the block, force of the hand (3, N), the
    largest displacement of any other block (mm).
    Reward: the centimetres by which the block came nearer to its slot, less a tenth for each
    millimetre by which another block was moved further; 10 for a block that stays in its slot, -10 for a
    fall or a block let go elsewhere.
    Terminated: the hand let go, or a block of the tower fell.

    rows: 3 to 40. domain: ranges of the options of a tower, drawn in each episode.
    """

    def __init__(
        self,
        rows: int = 12,
        domain: Mapping[str, tuple[float, float]] = DOMAIN,
        render_mode: str | None = None,
    ) -> None:
        self.rows, self.domain, self.render_mode = checked_rows(rows), dict(domain), render_mode
        self.screen = Screen(render_mode, self.metadata["render_fps"])
        self.action_space = spaces.Box(-1.0, 1.0, (5,), np.float32)
        self.observation_space = spaces.Box(-BOUND, BOUND, (14,), np.float32)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Floats, dict[str, Any]]:
        """Builds the next tower, with a block in the hand beside its top."""
        super().reset(seed=seed)
        scene = draw_scene(self.np_random, self.rows, self.domain)
        blocks = scene["blocks"]
        top = max(block["pos"][2] + 0.5 * block["size"][2] for block in blocks)
        side = self.np_random.uniform(-0.02, 0.02, 2)
        # Blocks of the next row lie along y where the rows are odd in number.
        yaw = (np.pi / 2 if self.rows % 2 else 0.0) + float(self.np_random.uniform(-0.2, 0.2))
        position = [0.13 + float(side[0]), float(side[1]), top + 0.06]
        self.body = len(blocks)
        blocks.append({**blocks[0], "id": self.body, "pos": position, "yaw": yaw})
        self._game = Game(scene)
        self._start = self.game.poses
        self._update = self.game.step(
            {"command": "grasp", "body": self.body, "anchor": [0, 0, 0], "normal": [0, 0, 1], "grip": "carry"}
        )
        slots = self.game.slots(self.body)
        self._slot = slots[int(self.np_random.integers(len(slots)))]
        self._moved, self._distance = 0.0, self._offset()
        self.screen.follow(self.game)
        return self._observation(), {"body": self.body, "slot": (self._slot["row"], self._slot["cell"])}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Moves the hand's goal and advances by 1/20 s, or lets go and watches."""
        wanted = np.clip(np.asarray(action, np.float64), -1.0, 1.0)
        if wanted[4] > 0.5:
            return self._let_go()
        half = 0.5 * TURN * wanted[3]
        turned = self.game.step({"command": "turn", "rotation": [0.0, 0.0, np.sin(half), np.cos(half)]})
        moved_on = self.game.step({"command": "move", "displacement": wanted[:3] * REACH}, frames=FRAMES - 1)
        self._update = moved_on
        self.screen.follow(self.game)
        fell = any(event["event"] == "fell" for event in turned["events"] + moved_on["events"])
        reward = self._progress() - (10.0 if fell else 0.0)
        return self._observation(), reward, fell, False, self._info(fell, placed=False)

    def _let_go(self) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        self._update = self.game.step("release", frames=AFTER)
        self.screen.follow(self.game)
        fell = any(event["event"] == "fell" for event in self._update["events"])
        placed = not fell and self._offset() < IN_SLOT and abs(self._angle()) < ASKEW
        reward = self._progress() + (10.0 if placed else -10.0)
        return self._observation(), reward, True, False, self._info(fell, placed)

    def _info(self, fell: bool, placed: bool) -> dict[str, Any]:
        return {"fell": fell, "placed": placed, "moved_mm": 1e3 * self.others_moved(self._start)}

    def _progress(self) -> float:
        distance, moved = self._offset(), self.others_moved(self._start)
        reward = 1e2 * (self._distance - distance) - 0.1 * 1e3 * max(moved - self._moved, 0.0)
        self._distance, self._moved = distance, max(moved, self._moved)
        return float(reward)

    def _offset(self) -> float:
        """Distance of the block from its slot, m."""
        return float(np.linalg.norm(np.subtract(self._slot["position"], self.game.poses[self.body, :3])))

    def _angle(self) -> float:
        """Angle about the vertical by which the block has to turn; its ends are alike, rad."""
        along, wanted = (
            axes_of(np.asarray(q))[:, 0] for q in (self.game.poses[self.body, 3:], self._slot["orientation"])
        )
        angle = np.arctan2(wanted[1], wanted[0]) - np.arctan2(along[1], along[0])
        return float((angle + np.pi / 2) % np.pi - np.pi / 2)

    def _observation(self) -> Floats:
        pose, velocity, hand = self.game.poses[self.body], self.game.velocities[self.body], self._update["hand"]
        parts = [
            1e2 * np.subtract(self._slot["position"], pose[:3]),
            [self._angle()],
            1e2 * velocity[:3],
            velocity[3:],
            np.array(hand["force"]) if hand else np.zeros(3),
            [1e3 * self._moved],
        ]
        return self.observation(*parts)
