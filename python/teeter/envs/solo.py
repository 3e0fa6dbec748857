"""Teeter/Solo-v0: one player builds on as long as the tower stands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from teeter import Game
from teeter.envs.episode import Episode
from teeter.envs.screen import RENDER_MODES, Screen
from teeter.envs.tower import (
    DOMAIN,
    carry_out,
    checked_parts,
    checked_rows,
    draw_scene,
    legal_moves,
    observed,
    space_of,
)

Observation = dict[str, NDArray[Any]]


class SoloEnv(Episode, gymnasium.Env[Observation, np.int64]):
    """One step is one whole move, carried out by a hand with the errors of a person.

    Action: 3 * block + cell, the block to take and the cell of the top row to put it in. ``info`` has
    ``action_mask``, int8 of shape (9 * rows,), 1 for the legal ones.
    Observation: a dict of the parts in ``observe``, see teeter.envs.tower.observed, and ``action_mask``.
    Reward: the points of solo rules, 1 for a block placed and 3 more for a row completed; -1 for an
    illegal action, which changes nothing, and -0.1 for a block that does not come out.
    Terminated: a block fell, or no move is left.

    rows: 3 to 40. observe: some of "poses", "cells", "forces", "image". noise: errors of the hand,
    "person", "none" or a dict. domain: ranges of the options of a tower, drawn in each episode.
    """

    metadata: dict[str, Any] = {"render_modes": RENDER_MODES, "render_fps": 1}

    def __init__(
        self,
        rows: int = 18,
        observe: tuple[str, ...] = ("poses", "cells", "forces"),
        noise: Any = "person",
        domain: Mapping[str, tuple[float, float]] = DOMAIN,
        render_mode: str | None = None,
    ) -> None:
        self.rows = checked_rows(rows)
        self.parts = checked_parts(observe)
        self.noise, self.domain, self.render_mode = noise, dict(domain), render_mode
        self.screen = Screen(render_mode, self.metadata["render_fps"])
        blocks = 3 * self.rows
        self.action_space = spaces.Discrete(3 * blocks)
        mask = {"action_mask": spaces.MultiBinary(3 * blocks)}
        self.observation_space: spaces.Space[Any] = spaces.Dict({**space_of(self.parts, blocks), **mask})

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Builds the next tower. ``options["scene"]``: a scene with 3 * rows blocks, instead of a drawn one."""
        super().reset(seed=seed)
        scene = (options or {}).get("scene") or draw_scene(self.np_random, self.rows, self.domain)
        self._game = Game(scene, "solo", 1)
        self._game.settle()
        self.screen.follow(self._game)
        mask = self._mask()
        return self._observation(mask), self._info(mask)

    def step(self, action: np.int64) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Carries out a move."""
        mask = self._mask()
        seed = int(self.np_random.integers(2**63))
        if not mask[int(action)]:
            return self._observation(mask), -1.0, False, False, self._info(mask) | {"illegal": True}
        before = self._score()
        result = carry_out(self.game, int(action), seed, self.noise)
        self.screen.follow(self.game)
        reward = float(self._score() - before) - (0.1 if result["end"] == "stuck" else 0.0)
        mask = self._mask()
        terminated = bool(result["fell"]) or not mask.any()
        result.pop("events")
        return self._observation(mask), reward, terminated, False, self._info(mask) | {"move": result}

    def _score(self) -> int:
        turn = self.game.turn
        return int(turn["scores"][0]) if turn else 0

    def _mask(self) -> NDArray[np.int8]:
        return legal_moves(self.game, 3 * self.rows)

    def _info(self, mask: NDArray[np.int8]) -> dict[str, Any]:
        return {"action_mask": mask, "score": self._score()}

    def _observation(self, mask: NDArray[np.int8]) -> Observation:
        # A returned array is no other one: whoever changes it changes nothing else.
        return {**observed(self.game, self.parts), "action_mask": mask.copy()}
