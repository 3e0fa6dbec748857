"""Options and results of the tasks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import Floats

__all__ = ["SETTLE_S", "Figures", "Options", "Progress", "creep_mm"]

Figures: TypeAlias = dict[str, float | int | bool | None]
"""Figures of a task by name; None where there is none, as for a tower that fell."""

Progress: TypeAlias = Callable[[int, int], None]
"""Is called with the number of cases done and the number of all."""

SETTLE_S = 2.0
"""Time that a tower settles before it is measured, s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """Size of a run.

    towers: number of labelled towers, 1 to 400. seed: None for the towers of data/oracle, or a seed
    that the towers are drawn from. tilts: number of tilted towers, 1 to 50. storeys: of the house of
    cards. rows: of the tower whose blocks are pulled. pulls: number of its blocks that are pulled.
    seconds: time at rest in which creep is measured, s.
    """

    towers: int = 400
    seed: int | None = None
    tilts: int = 50
    storeys: int = 3
    rows: int = 18
    pulls: int = 54
    seconds: float = 8.0


def creep_mm(engine: ClockedEngine, seconds: float) -> float:
    """Largest displacement of any block during a time, mm, from now on."""
    start = engine.poses()[:, :3]
    engine.run_for(seconds)
    moved: Floats = np.linalg.norm(engine.poses()[:, :3] - start, axis=1)
    return 1e3 * float(moved.max())
