"""Measures the speed of worlds and batches, and prints ratios.

Each figure is the least time of many short rounds that take turns, so that other work on the machine
distorts them little::

    python speed.py --rounds 40
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable

import teeter

FRAMES = 4


def measure(tasks: dict[str, Callable[[], None]], rounds: int) -> dict[str, float]:
    """Least time of each task, s; the tasks take turns."""
    least = dict.fromkeys(tasks, float("inf"))
    for _ in range(rounds):
        for name, task in tasks.items():
            start = time.perf_counter()
            task()
            least[name] = min(least[name], time.perf_counter() - start)
    return least


def main() -> None:
    """Measures and prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=40)
    parser.add_argument("--worlds", type=int, default=64)
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    arguments = parser.parse_args()
    world = teeter.World("tower", sleep=False)
    world.run_for(1.0)
    seconds = 32 * world.frame

    def step() -> None:
        for _ in range(32):
            world.step()

    scenes = [teeter.scenes.tower(seed=seed) for seed in range(arguments.worlds)]
    one, many = (teeter.WorldBatch(scenes, threads=n, sleep=False) for n in (1, arguments.threads))
    tasks = {
        "one call": lambda: world.run_for(seconds),
        "step by step": step,
        "one thread": lambda: one.step(frames=FRAMES),
        "all threads": lambda: many.step(frames=FRAMES),
    }
    times = measure(tasks, arguments.rounds)
    simulated = arguments.worlds * FRAMES * world.frame
    print(f"one tower, step by step over one call:  {times['one call'] / times['step by step']:.3f} of the speed")
    print(f"{arguments.worlds} towers, one thread:    {simulated / times['one thread']:7.1f} tower-seconds a second")
    print(f"{arguments.worlds} towers, {arguments.threads} threads:     {simulated / times['all threads']:7.1f}")
    print(f"{arguments.threads} threads over one:      {times['one thread'] / times['all threads']:7.2f} times")
    print(f"equal bits: {one.hashes() == many.hashes()}")


if __name__ == "__main__":
    main()
