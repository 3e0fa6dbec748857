"""Runs tasks on engines, and the table of their figures."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, field
from typing import Any

from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import load_engine
from teeter.benchmark.tasks import TASKS, Figures, Options
from teeter.errors import EngineError

__all__ = ["Row", "markdown", "run"]


@dataclass(slots=True)
class Row:
    """Figures of an engine in a task, with its cost."""

    engine: str
    details: str
    task: str
    figures: Figures = field(default_factory=dict)
    simulated_s: float = 0.0
    cpu_s: float = 0.0

    @property
    def cost(self) -> float:
        """CPU seconds of a simulated second."""
        return self.cpu_s / self.simulated_s if self.simulated_s else 0.0

    def as_dict(self) -> dict[str, Any]:
        """The row as plain data, with its cost as cpu_s_per_s."""
        return asdict(self) | {"cpu_s_per_s": self.cost}


def run(
    engines: Iterable[str],
    tasks: Iterable[str],
    options: Options,
    progress: Callable[[str, str, int, int], None] = lambda *_: None,
) -> list[Row]:
    """Measures each engine in each task.

    engines: as load_engine takes them. tasks: names of TASKS. progress: is called with engine, task,
    the cases done and all of them. Raises EngineError.
    """
    tasks = list(tasks)
    for task in tasks:
        if task not in TASKS:
            raise EngineError(f"`tasks` has {task}, expected some of {', '.join(TASKS)}", "tasks")
    loaded = [(name, load_engine(name)) for name in engines]
    rows = []
    for name, engine in loaded:
        for task in tasks:
            clocked = ClockedEngine(engine, name)
            figures = TASKS[task](clocked, options, functools.partial(progress, name, task))
            rows.append(Row(name, clocked.details, task, figures, clocked.simulated_s, clocked.cpu_s))
    return rows


def markdown(rows: Iterable[Row]) -> str:
    """One table, an engine a row: errors of each task beside its cost, and the settings."""
    rows = list(rows)
    tasks = [task for task in TASKS if any(row.task == task for row in rows)]
    heads = [head for task in tasks for head in (*_COLUMNS[task], "CPU s / s")]
    lines = [f"| engine | {' | '.join(heads)} |", "|---" + "|--:" * len(heads) + "|"]
    engines = list(dict.fromkeys(row.engine for row in rows))
    for engine in engines:
        cells = []
        for task in tasks:
            row = next((row for row in rows if (row.engine, row.task) == (engine, task)), None)
            cells += [*(f(row.figures) for f in _COLUMNS[task].values()), _number(row.cost)] if row else _gap(task)
        lines.append(f"| {engine} | {' | '.join(cells)} |")
    details = {row.engine: row.details for row in rows}
    lines += ["", "| engine | version and settings |", "|---|---|"]
    lines += [f"| {engine} | {details[engine] or '-'} |" for engine in engines]
    return "\n".join(lines) + "\n"


def _gap(task: str) -> list[str]:
    return ["-"] * (1 + len(_COLUMNS[task]))


def _number(value: Any) -> str:
    """Three significant digits, without an exponent where that is short."""
    if value is None:
        return "-"
    return f"{value:.3g}" if 1e-3 <= abs(value) < 1e3 or value == 0 else f"{value:.1e}"


def _fell(figures: Figures, name: str) -> str:
    return _number(figures.get(name)) if figures.get("stands") else "fell"


_COLUMNS: dict[str, dict[str, Callable[[Figures], str]]] = {
    "labelled": {
        "labels right": lambda figures: f"{figures['right']} of {figures['towers']}",
        "clear ones": lambda figures: f"{figures['clear_right']} of {figures['clear']}",
    },
    "tilt": {
        "tilt error, median °": lambda figures: _number(figures["median_error_deg"]),
        "max °": lambda figures: _number(figures["max_error_deg"]),
    },
    "cards": {"cards creep mm": lambda figures: _fell(figures, "creep_mm")},
    "forces": {
        "tower creep mm": lambda figures: _fell(figures, "creep_mm"),
        "sink mm": lambda figures: _fell(figures, "sink_mm"),
        "force error N": lambda figures: _fell(figures, "mean_error_N"),
        "of loose blocks N": lambda figures: _fell(figures, "loose_error_N"),
    },
}
