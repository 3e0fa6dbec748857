"""Vector environments: sub-environments that are stepped side by side on all cores.

The simulation runs without Python's lock, so threads suffice: nothing is copied between processes, and
each sub-environment gives what it gives alone.
"""

from __future__ import annotations

import os
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.vector.utils import iterate
from gymnasium.wrappers import TimeLimit

from teeter.envs.extract import ExtractEnv
from teeter.envs.place import PlaceEnv
from teeter.envs.solo import SoloEnv

__all__ = ["TeeterVectorEnv", "make_extract", "make_place", "make_solo"]


class _Ahead(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Sub-environment whose next step or reset may have begun in a thread."""

    _begun: Future[Any] | None = None

    def begin(self, pool: ThreadPoolExecutor, name: str, *args: Any, **kwargs: Any) -> None:
        """Begins a call of the sub-environment."""
        self._begun = pool.submit(getattr(self.env, name), *args, **kwargs)

    def step(self, action: Any) -> Any:
        """Result of the step that was begun."""
        return self._result() if self._begun else self.env.step(action)

    def reset(self, **kwargs: Any) -> Any:
        """Result of the reset that was begun."""
        return self._result() if self._begun else self.env.reset(**kwargs)

    def _result(self) -> Any:
        begun, self._begun = self._begun, None
        return begun.result() if begun else None


class TeeterVectorEnv(SyncVectorEnv):
    """Several environments of one kind, stepped side by side.

    kind: class of the environment. num_envs: their number. threads: one a core where absent; it changes
    no result. autoreset_mode: NEXT_STEP, SAME_STEP or DISABLED, see Gymnasium; with DISABLED those that are
    done are reset by ``reset(options={"reset_mask": mask})``. Other arguments are those of ``kind``.
    """

    def __init__(
        self,
        kind: type[gymnasium.Env[Any, Any]],
        num_envs: int,
        max_episode_steps: int | None = None,
        threads: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        **kwargs: Any,
    ) -> None:
        def build() -> gymnasium.Env[Any, Any]:
            env = kind(**kwargs)
            return _Ahead(TimeLimit(env, max_episode_steps) if max_episode_steps else env)

        super().__init__([build] * num_envs, autoreset_mode=autoreset_mode)
        self._pool = ThreadPoolExecutor(threads or os.cpu_count() or 1)
        self._done = np.zeros(num_envs, np.bool_)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Resets all sub-environments, or those of ``options["reset_mask"]``."""
        seeds = [seed + i for i in range(self.num_envs)] if isinstance(seed, int) else seed or [None] * self.num_envs
        given = dict(options or {})
        mask = given.pop("reset_mask", None)
        chosen = np.ones(self.num_envs, np.bool_) if mask is None else mask
        for env, own, is_chosen in zip(self.envs, seeds, chosen, strict=True):
            if is_chosen and isinstance(env, _Ahead):
                env.begin(self._pool, "reset", seed=own, options=given or None)
        result = super().reset(seed=seed, options=dict(options) if options else options)
        self._done[chosen] = False
        return result

    def step(self, actions: Any) -> Any:
        """Steps all sub-environments side by side."""
        resets = self._done if self.autoreset_mode == AutoresetMode.NEXT_STEP else np.zeros_like(self._done)
        for env, action, is_reset in zip(self.envs, iterate(self.action_space, actions), resets, strict=True):
            if isinstance(env, _Ahead):
                env.begin(self._pool, "reset") if is_reset else env.begin(self._pool, "step", action)
        result = super().step(actions)
        self._done = result[2] | result[3]
        return result

    def close_extras(self, **kwargs: Any) -> None:
        """Ends the threads."""
        super().close_extras(**kwargs)
        self._pool.shutdown()


def make_solo(num_envs: int, **kwargs: Any) -> TeeterVectorEnv:
    """Vector environment of Teeter/Solo-v0."""
    return TeeterVectorEnv(SoloEnv, num_envs, **kwargs)


def make_extract(num_envs: int, **kwargs: Any) -> TeeterVectorEnv:
    """Vector environment of Teeter/Extract-v0."""
    return TeeterVectorEnv(ExtractEnv, num_envs, **kwargs)


def make_place(num_envs: int, **kwargs: Any) -> TeeterVectorEnv:
    """Vector environment of Teeter/Place-v0."""
    return TeeterVectorEnv(PlaceEnv, num_envs, **kwargs)
