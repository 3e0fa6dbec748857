"""Study ``extraction``: episodes of Teeter/Extract-v0 by scripted hands, with all observations and actions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from teeter.study.extra import needed
from teeter.study.sample import Row, Sample, Study

__all__ = ["EXTRACTION", "MAX_STEPS"]

#: Steps after which an episode is truncated.
MAX_STEPS = 160
#: Largest noise of an action.
NOISE = 0.2
#: Steps of `wiggle` from one side to the other, and its reach.
SWING, REACH = 3, 0.6


def _action(policy: str, step: int, speed: float, rng: np.random.Generator) -> NDArray[np.float32]:
    """Action of a scripted hand: outwards, across, upwards."""
    noise = rng.uniform(-NOISE, NOISE, 3)
    if policy == "random":
        chosen = rng.uniform(-1.0, 1.0, 3)
    elif policy == "wiggle":
        side = REACH if step // SWING % 2 else -REACH
        chosen = np.array([0.5 * speed, side, 0.0]) + noise
    else:
        chosen = np.array([speed, 0.0, 0.0]) + noise
    return np.clip(chosen, -1.0, 1.0).astype(np.float32)


def _measure(sample: Sample) -> Row:
    """Plays one episode to its end."""
    extract = needed("teeter.envs.extract", "gym")
    params, rng = sample.params, sample.rng()
    env = extract.ExtractEnv(rows=params["rows"], loose=False)
    observation, _ = env.reset(seed=sample.seed)
    game, body = env.game, env.body
    loads, (row, cell) = game.world.xray(), game.cells[body]
    speed = float(rng.uniform(0.2, 1.0))
    observations, actions, rewards = [observation], [], []
    info: dict[str, Any] = {}
    for step in range(MAX_STEPS):
        actions.append(_action(params["policy"], step, speed, rng))
        observation, reward, terminated, _, info = env.step(actions[-1])
        observations.append(observation)
        rewards.append(reward)
        if terminated:
            break
    return {
        "friction": game.scene["friction"],
        "body": body,
        "row": int(row),
        "cell": int(cell),
        "load": float(loads.above[body]),
        "tightness": float(loads.tightness[body]),
        "steps": len(rewards),
        "out": bool(info["out"]),
        "fell": bool(info["fell"]),
        "moved_mm": float(info["moved_mm"]),
        "reward": float(sum(rewards)),
        "observations": np.concatenate(observations),
        "actions": np.concatenate(actions),
        "rewards": rewards,
    }


def _plot(table: Any) -> Any:
    from teeter.study.plot import sweep

    return sweep(table, "policy", "out")


_ABOUT = """\
Removals of one block by scripted hands, episodes of Teeter/Extract-v0.

Parameters: policy, "pull" (straight out), "wiggle" (to and fro while pulling) or "random"; rows. Columns:
friction of the tower; body, row and cell of the block; load and tightness, N, of the block before; steps of 1/20 s;
out, whether the block came out; fell, whether one fell; moved_mm, largest displacement of any other block; reward,
the sum; observations, 18 numbers each, actions, 3 each, and rewards, in order of the steps.
"""

EXTRACTION = Study(
    name="extraction",
    measure=_measure,
    columns={
        "friction": "float",
        "body": "int",
        "row": "int",
        "cell": "int",
        "load": "float",
        "tightness": "float",
        "steps": "int",
        "out": "bool",
        "fell": "bool",
        "moved_mm": "float",
        "reward": "float",
        "observations": "floats",
        "actions": "floats",
        "rewards": "floats",
    },
    params={"policy": ("pull", "wiggle", "random"), "rows": 18},
    about=_ABOUT,
    plot=_plot,
)
