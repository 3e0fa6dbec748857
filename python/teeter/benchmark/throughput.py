"""Speed of many towers at once: Teeter's WorldBatch beside mujoco.batch.

Both step the same towers in equally many threads, in turns of the same run, so that other work on
the machine distorts neither more than the other. Teeter does not sleep.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from teeter import WorldBatch, scenes
from teeter.benchmark.engine import FRAME, Floats, Scene
from teeter.benchmark.engines.mujoco import import_mujoco
from teeter.errors import EngineError
from teeter.interchange.mjcf_writer import RECIPE, write_mjcf

__all__ = ["Throughput", "measure_throughput"]

SETTLE_S = 2.0


@dataclass(frozen=True, slots=True)
class Throughput:
    """Speeds of two batches of the same towers.

    teeter, mujoco: tower-seconds that are simulated in a second. ratio: the first over the second.
    teeter_creep_mm, mujoco_creep_mm: largest displacement of any block from 2 s on.
    """

    worlds: int
    threads: int
    blocks: int
    seconds: float
    teeter: float
    mujoco: float
    ratio: float
    teeter_creep_mm: float
    mujoco_creep_mm: float

    def as_dict(self) -> dict[str, Any]:
        """All figures as plain data."""
        return asdict(self)

    def markdown(self) -> str:
        """Table of the two."""
        return (
            f"| {self.worlds} towers of {self.blocks} blocks, {self.threads} threads "
            "| tower-seconds a second | creep mm |\n|---|--:|--:|\n"
            f"| teeter, WorldBatch | {self.teeter:.3g} | {self.teeter_creep_mm:.2g} |\n"
            f"| mujoco.batch | {self.mujoco:.3g} | {self.mujoco_creep_mm:.2g} |\n"
            f"| ratio | {self.ratio:.3g} | |\n"
        )


def measure_throughput(
    worlds: int,
    threads: int,
    *,
    rows: int = 18,
    seconds: float = 2.0,
    progress: Callable[[int, int], None] = lambda *_: None,
) -> Throughput:
    """Steps batches of full towers, each with a seed of its own, and compares their speeds.

    worlds: number of towers, at least one a thread. threads: number of threads of both. seconds:
    time that is measured after 2 s of settling, s, in rounds of a quarter of a second. progress: is
    called with the rounds done and all of them. Raises EngineError.
    """
    if worlds < threads or threads < 1:
        raise EngineError(f"`worlds` is {worlds}, expected at least one a thread, of {threads}", "worlds")
    towers = [scenes.tower(rows=rows, seed=seed) for seed in range(1, worlds + 1)]
    batches: dict[str, _TeeterBatch | _MujocoBatch] = {
        "teeter": _TeeterBatch(towers, threads),
        "mujoco": _MujocoBatch(towers, threads),
    }
    for batch in batches.values():
        batch.run_for(SETTLE_S)
    starts = {name: batch.centers() for name, batch in batches.items()}
    wall = dict.fromkeys(batches, 0.0)
    rounds = max(1, round(4 * seconds))
    for i in range(rounds):
        progress(i, rounds)
        for name, batch in batches.items():
            start = time.perf_counter()
            batch.run_for(0.25)
            wall[name] += time.perf_counter() - start
    progress(rounds, rounds)
    speed = {name: worlds * rounds * 0.25 / wall[name] for name in batches}
    creep = {name: 1e3 * _largest(batch.centers() - starts[name]) for name, batch in batches.items()}
    return Throughput(
        worlds,
        threads,
        3 * rows,
        0.25 * rounds,
        speed["teeter"],
        speed["mujoco"],
        speed["teeter"] / speed["mujoco"],
        creep["teeter"],
        creep["mujoco"],
    )


def _largest(displacements: Floats) -> float:
    return float(np.linalg.norm(displacements, axis=-1).max())


class _TeeterBatch:
    def __init__(self, towers: list[Scene], threads: int) -> None:
        self.batch = WorldBatch(towers, threads=threads, sleep=False)

    def run_for(self, seconds: float) -> None:
        self.batch.step(frames=round(seconds / FRAME))

    def centers(self) -> Floats:
        return np.array(self.batch.poses[:, :, :3])


class _MujocoBatch:
    def __init__(self, towers: list[Scene], threads: int) -> None:
        mujoco = import_mujoco()
        from mujoco.batch import Batch

        models = [mujoco.MjModel.from_xml_string(write_mjcf(tower, RECIPE)) for tower in towers]
        self.batch = Batch(models[0], nsim=len(towers), nthread=threads)
        self.batch.set_models(models)
        self.batch.reset()
        self.qpos = self.batch.bind("qpos")
        self.timestep = float(models[0].opt.timestep)

    def run_for(self, seconds: float) -> None:
        self.batch.step(nstep=round(seconds / self.timestep))

    def centers(self) -> Floats:
        return np.array(self.qpos).reshape(len(self.qpos), -1, 7)[:, :, :3]
