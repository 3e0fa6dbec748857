"""Teeter/Extract-v0: a hand draws one block out of the tower."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from teeter import Game
from teeter.envs.hand import BOUND, FRAMES, REACH, HandEnv, Vector, axes_of
from teeter.envs.screen import Screen
from teeter.envs.tower import DOMAIN, checked_rows, draw_scene

Floats = NDArray[np.float32]


class ExtractEnv(HandEnv):
    """A block that may be taken is held by its end; draw it out, and leave the tower as it is.

    Action: displacement of the hand's goal in a step of 1/20 s, over 5 mm, in [-1, 1]: outwards along
    the block, across it, upwards.
    Observation, float32 of shape (18,): displacement of the block (3, mm, in the axes of the action),
    its velocity (3, cm/s) and spin (3, rad/s), lead of the goal (3, mm), force of the hand (3, N), the
    largest displacement of any other block (mm), the share of the block that is out, row over rows.
    Reward: 10 for the way out in all, less 0.05 for each millimetre by which another block was moved
    further; 10 for a block that is out, -10 for a fall.
    Terminated: the block is out, or a block fell.

    rows: 3 to 40. loose: True for a block among the loosest quarter, False for any. max_force: of the
    hand, N. domain: ranges of the options of a tower, drawn in each episode.
    """

    def __init__(
        self,
        rows: int = 18,
        loose: bool = True,
        max_force: float = 4.0,
        domain: Mapping[str, tuple[float, float]] = DOMAIN,
        render_mode: str | None = None,
    ) -> None:
        self.rows, self.loose, self.max_force = checked_rows(rows), loose, float(max_force)
        self.domain, self.render_mode = dict(domain), render_mode
        self.screen = Screen(render_mode, self.metadata["render_fps"])
        self.action_space = spaces.Box(-1.0, 1.0, (3,), np.float32)
        self.observation_space = spaces.Box(-BOUND, BOUND, (18,), np.float32)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Floats, dict[str, Any]]:
        """Builds the next tower and grasps a block. ``options["body"]``: the block, instead of a drawn one."""
        super().reset(seed=seed)
        self._game = Game(draw_scene(self.np_random, self.rows, self.domain), "solo", 1)
        self._game.settle()
        self.body = int((options or {}).get("body", self._chosen()))
        self._start = self.game.poses
        world = self.game.world
        self._size: Vector = world.sizes[self.body]
        axes = axes_of(self._start[self.body, 3:])
        outward = axes[:, 0] * (1.0 if self.np_random.random() < 0.5 else -1.0)
        # Outwards, across, up; the last is the vertical of the tower.
        self._axes: Vector = np.stack([outward, np.cross([0.0, 0.0, 1.0], outward), [0.0, 0.0, 1.0]])
        anchor = [float(0.5 * self._size[0] * np.sign(outward @ axes[:, 0])), 0.0, 0.0]
        self.game.step({"command": "set_hand", "max_force": self.max_force})
        self._update = self.game.step(
            {"command": "grasp", "body": self.body, "anchor": anchor, "normal": outward, "grip": "auto"}
        )
        self._moved, self._travel = 0.0, 0.0
        self.screen.follow(self.game)
        return self._observation(), {"body": self.body}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Moves the hand's goal and advances by 1/20 s."""
        wanted = np.clip(np.asarray(action, np.float64), -1.0, 1.0) * REACH
        self._update = self.game.step({"command": "move", "displacement": wanted @ self._axes}, frames=FRAMES)
        self.screen.follow(self.game)
        events = {event["event"] for event in self._update["events"]}
        fell, out = "fell" in events, "removed" in events
        moved, travel = self.others_moved(self._start), self._outward()
        reward = 10.0 * (travel - self._travel) - 0.05 * 1e3 * max(moved - self._moved, 0.0)
        reward += -10.0 if fell else 10.0 if out else 0.0
        self._moved, self._travel = max(moved, self._moved), travel
        info = {"body": self.body, "fell": fell, "out": out, "moved_mm": 1e3 * moved}
        return self._observation(), float(reward), fell or out, False, info

    def _chosen(self) -> int:
        """Block of an episode: of those that may be taken, any or one of the loosest quarter."""
        turn = self.game.turn
        removable: list[int] = turn["removable"] if turn else []
        tightness = self.game.world.xray().tightness
        ordered = sorted(removable, key=lambda body: (float(tightness[body]), body))
        some = ordered[: max(1, len(ordered) // 4)] if self.loose else ordered
        return int(some[self.np_random.integers(len(some))])

    def _outward(self) -> float:
        """Share of its length by which the block is out, 0 to 1."""
        travel = (self.game.poses[self.body, :3] - self._start[self.body, :3]) @ self._axes[0]
        return float(np.clip(travel / self._size[0], 0.0, 1.0))

    def _observation(self) -> Floats:
        pose, hand = self.game.poses[self.body], self._update["hand"]
        velocity = self.game.velocities[self.body]
        lead = np.subtract(hand["goal"], hand["point"]) if hand else np.zeros(3)
        force = np.array(hand["force"]) if hand else np.zeros(3)
        parts = [
            1e3 * self._axes @ (pose[:3] - self._start[self.body, :3]),
            1e2 * self._axes @ velocity[:3],
            self._axes @ velocity[3:],
            1e3 * self._axes @ lead,
            self._axes @ force,
            [1e3 * self._moved, self._outward(), self.game.cells[self.body][0] / self.rows],
        ]
        return self.observation(*parts)
