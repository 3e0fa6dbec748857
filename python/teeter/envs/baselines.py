"""Baselines for Teeter/Solo-v0 and teeter_v0: moves that need no learning.

Each takes an observation and its action mask, and returns an action; ``score`` plays episodes with one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teeter.envs.solo import SoloEnv

__all__ = ["loosest", "random", "score", "steady"]

Observation = Mapping[str, NDArray[Any]]
Policy = Callable[[Observation, NDArray[np.int8], np.random.Generator], int]


def random(observation: Observation, mask: NDArray[np.int8], rng: np.random.Generator) -> int:
    """Any legal move."""
    return int(rng.choice(np.flatnonzero(mask)))


def loosest(observation: Observation, mask: NDArray[np.int8], rng: np.random.Generator) -> int:
    """The block that slides with the least force, into any free cell. It needs the part ``forces``."""
    legal = np.flatnonzero(mask)
    force = observation["forces"][legal // 3, 1] + 1e-6 * rng.random(len(legal))
    return int(legal[force.argmin()])


def steady(observation: Observation, mask: NDArray[np.int8], rng: np.random.Generator) -> int:
    """The loosest block whose row stands without it: with its middle block, or with both its ends.

    It needs the parts ``cells`` and ``forces``. Where no row stands, the loosest of all.
    """
    legal = np.flatnonzero(mask)
    cells = observation["cells"]
    safe = [move for move in legal if _stands_without(cells, int(move) // 3)]
    chosen = np.zeros_like(mask)
    chosen[safe if safe else legal] = 1
    return loosest(observation, chosen, rng)


def _stands_without(cells: NDArray[Any], body: int) -> bool:
    """Returns True if the row of a block bears the rows above without it."""
    row, cell = (int(number) for number in cells[body])
    left = {int(c) for r, c in cells if r == row and c != cell}
    return 1 in left or left == {0, 2}


def score(policy: Policy, episodes: int, seed: int = 0, max_moves: int = 100, **kwargs: Any) -> list[float]:
    """Plays episodes of Teeter/Solo-v0 and returns the points of each.

    policy: a baseline, or a function like one. seed: episode i has the tower of (seed, i), whatever else is
    played. max_moves: moves after which an episode ends. A block that did not come out is masked until another
    was placed; an episode ends where none is left. kwargs: arguments of the environment.
    """
    env = SoloEnv(**kwargs)
    points = []
    for episode in range(episodes):
        own = np.random.SeedSequence([seed, episode])
        rng = np.random.default_rng(own)
        observation, info = env.reset(seed=int(own.generate_state(1)[0]))
        stuck: set[int] = set()
        for _ in range(max_moves):
            mask = info["action_mask"].copy()
            for body in stuck:
                mask[3 * body : 3 * body + 3] = 0
            if not mask.any():
                break
            action = policy(observation, mask, rng)
            observation, _, terminated, _, info = env.step(np.int64(action))
            if terminated:
                break
            is_placed = info["move"]["end"] == "placed"
            stuck = set() if is_placed else stuck | {action // 3}
        points.append(float(info["score"]))
    return points
