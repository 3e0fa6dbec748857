"""Tasks of the benchmark, by name."""

from __future__ import annotations

from collections.abc import Callable

from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.tasks import cards, forces, labelled, tilt
from teeter.benchmark.tasks.figures import Figures, Options, Progress

__all__ = ["TASKS", "Figures", "Options", "Progress"]

TASKS: dict[str, Callable[[ClockedEngine, Options, Progress], Figures]] = {
    "labelled": labelled.measure,
    "tilt": tilt.measure,
    "cards": cards.measure,
    "forces": forces.measure,
}
"""Each measures an engine and returns figures by name; docs/benchmark.md describes them."""
