"""Environments for reinforcement learning and language models.

Importing this module registers ``Teeter/Solo-v0``, ``Teeter/Extract-v0`` and ``Teeter/Place-v0`` with
Gymnasium, each with a vector entry point. ``teeter.envs.teeter_v0`` is the game of several players for
PettingZoo, and ``teeter.envs.text`` the game in words. It needs ``pip install teeter[gym]``.
"""

from __future__ import annotations

from gymnasium.envs.registration import register, registry

__all__: list[str] = []

_STEPS = {"Solo": 200, "Extract": 160, "Place": 200}

for _name, _steps in _STEPS.items():
    if f"Teeter/{_name}-v0" not in registry:
        register(
            id=f"Teeter/{_name}-v0",
            entry_point=f"teeter.envs.{_name.lower()}:{_name}Env",
            vector_entry_point=f"teeter.envs.vector:make_{_name.lower()}",
            max_episode_steps=_steps,
        )
