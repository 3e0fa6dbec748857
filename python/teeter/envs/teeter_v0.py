"""The game of two to eight players, for PettingZoo.

``env()`` has the wrappers of PettingZoo's games of turns, ``raw_env()`` none. Each step of an agent is one
whole move, carried out by a hand with the errors of a person.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from pettingzoo import AECEnv
from pettingzoo.utils import wrappers

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
from teeter.errors import InputError

__all__ = ["TeeterAEC", "env", "raw_env"]


class TeeterAEC(Episode, AECEnv[str, dict[str, Any], int]):
    """Players take turns, and the one in whose turn the tower falls loses.

    Action: 3 * block + cell, the block to take and the cell of the top row to put it in.
    Observation: a dict of ``observation``, the parts in ``observe``, and ``action_mask``, int8 of shape
    (9 * rows,), all 0 for an agent whose turn it is not.
    Reward at the end: -1 for the loser, 1 for the player who placed the last block safely, 0 for others.

    num_players: 2 to 8. rows: 3 to 40. rules: name of a table with turns. max_moves: moves after which the
    game is truncated. observe, noise, domain: as of Teeter/Solo-v0.
    """

    metadata: dict[str, Any] = {
        "name": "teeter_v0",
        "render_modes": RENDER_MODES,
        "is_parallelizable": False,
        "render_fps": 1,
    }

    def __init__(
        self,
        num_players: int = 2,
        rows: int = 18,
        rules: Any = "official",
        observe: tuple[str, ...] = ("poses", "cells", "forces"),
        noise: Any = "person",
        domain: Mapping[str, tuple[float, float]] = DOMAIN,
        max_moves: int = 400,
        render_mode: str | None = None,
    ) -> None:
        super().__init__()
        if not 2 <= num_players <= 8:
            raise InputError(f"`num_players` is {num_players}, expected 2 to 8", "num_players")
        self.rows, self.rules, self.parts = checked_rows(rows), rules, checked_parts(observe)
        self.noise, self.domain = noise, dict(domain)
        self.max_moves, self.render_mode = max_moves, render_mode
        self.screen = Screen(render_mode, self.metadata["render_fps"])
        self.possible_agents = [f"player_{i}" for i in range(num_players)]
        self.agents: list[str] = []
        blocks = 3 * self.rows
        self._action_space = spaces.Discrete(3 * blocks)
        mask = spaces.Box(0, 1, (3 * blocks,), np.int8)
        self._parts_space = spaces.Dict(space_of(self.parts, blocks))
        self._observation_space = spaces.Dict({"observation": self._parts_space, "action_mask": mask})
        self.action_spaces = dict.fromkeys(self.possible_agents, self._action_space)
        self.observation_spaces = dict.fromkeys(self.possible_agents, self._observation_space)
        self._rng, _ = gymnasium.utils.seeding.np_random(None)

    def observation_space(self, agent: str) -> spaces.Space[Any]:
        """Space of the observations of an agent."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Space[Any]:
        """Space of the actions of an agent."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        """Builds the next tower."""
        if seed is not None:
            self._rng, _ = gymnasium.utils.seeding.np_random(seed)
        scene = (options or {}).get("scene") or draw_scene(self._rng, self.rows, self.domain)
        self.agents = list(self.possible_agents)
        self._game = Game(scene, self.rules, len(self.agents))
        self._game.settle()
        self.screen.follow(self._game)
        self._moves = 0
        self.rewards = dict.fromkeys(self.agents, 0.0)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self.terminations = dict.fromkeys(self.agents, False)
        self.truncations = dict.fromkeys(self.agents, False)
        self.infos: dict[str, dict[str, Any]] = {agent: {} for agent in self.agents}
        self.agent_selection = self.agents[0]

    def observe(self, agent: str) -> dict[str, Any]:
        """Observation of an agent: new arrays on every call."""
        blocks = 3 * self.rows
        mask = np.zeros(3 * blocks, np.int8)
        if agent == self.agent_selection:
            mask = legal_moves(self.game, blocks)
        return {"observation": observed(self.game, self.parts), "action_mask": mask}

    def state(self) -> NDArray[np.float32]:
        """State of the tower: all poses, float32 of shape (3 * rows, 7)."""
        return self.game.poses.astype(np.float32)

    @property
    def state_space(self) -> spaces.Space[Any]:
        """Space of state()."""
        return spaces.Box(-np.inf, np.inf, (3 * self.rows, 7), np.float32)

    def step(self, action: int | None) -> None:
        """Carries out a move of the agent whose turn it is. An illegal one loses the game."""
        agent: str = self.agent_selection
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        self._cumulative_rewards[agent] = 0.0
        self._clear_rewards()
        self._moves += 1
        seed = int(self._rng.integers(2**63))
        if action is None or not legal_moves(self.game, 3 * self.rows)[int(action)]:
            self._end(loser=agent, winner=None)
        else:
            self._carry_out(agent, int(action), seed)
        self.agent_selection = self._next(agent)
        self._accumulate_rewards()

    def render(self) -> NDArray[np.uint8] | None:
        """Picture of the tower, uint8 of shape (480, 640, 3); None without a render mode, and with a page."""
        if self.render_mode is None:
            gymnasium.logger.warn("render() was called without a render mode")
            return None
        return super().render()

    def close(self) -> None:
        """Ends the game, and closes the page of the browser."""
        self._game = None
        super().close()

    def _carry_out(self, agent: str, action: int, seed: int) -> None:
        player = self._player()
        carry_out(self.game, action, seed, self.noise)
        self.screen.follow(self.game)
        turn = self.game.turn or {}
        if self._is_over():
            outcome = turn["outcome"]
            named = {key: None if who is None else self.possible_agents[who] for key, who in outcome.items()}
            self._end(named["loser"], named["winner"])
        elif not legal_moves(self.game, 3 * self.rows).any():
            # The next player can take no block.
            self._end(loser=self.possible_agents[self._player()], winner=agent)
        elif self._moves >= self.max_moves:
            self.truncations = dict.fromkeys(self.agents, True)
        self.infos[agent] = {"stuck": not self._is_over() and self._player() == player}

    def _end(self, loser: str | None, winner: str | None) -> None:
        for agent in self.agents:
            self.rewards[agent] = -1.0 if agent == loser else 1.0 if agent == winner else 0.0
        self.terminations = dict.fromkeys(self.agents, True)

    def _is_over(self) -> bool:
        turn = self.game.turn
        return turn is None or turn["phase"] == "over"

    def _player(self) -> int:
        turn = self.game.turn
        return int(turn["player"]) if turn else 0

    def _next(self, agent: str) -> str:
        """Agent whose turn it is; after the end they follow in their order, to see it."""
        if self.terminations[agent] or self.truncations[agent]:
            return self.agents[(self.agents.index(agent) + 1) % len(self.agents)]
        return self.possible_agents[self._player()]


def raw_env(**kwargs: Any) -> TeeterAEC:
    """The environment without wrappers."""
    return TeeterAEC(**kwargs)


def env(**kwargs: Any) -> AECEnv[str, dict[str, Any], int]:
    """The environment with the wrappers of PettingZoo's games of turns."""
    wrapped: Any = wrappers.TerminateIllegalWrapper(raw_env(**kwargs), illegal_reward=-1)
    wrapped = wrappers.AssertOutOfBoundsWrapper(wrapped)
    return wrappers.OrderEnforcingWrapper(wrapped)
