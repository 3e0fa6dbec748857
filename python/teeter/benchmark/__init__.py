"""Benchmark of engines for stacks of blocks: exact answers on one side, any engine on the other.

An engine is a class of four functions, see Engine. The tasks are labelled towers, tilt, a house of
cards and the breakaway forces of a tower; each has an exact answer or a strict one. The program is
``python -m teeter.benchmark``, and docs/benchmark.md describes tasks, figures and an engine of one's
own.
"""

from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import ENGINES, FRAME, Engine, load_engine
from teeter.benchmark.report import Row, markdown, run
from teeter.benchmark.tasks import TASKS, Figures, Options
from teeter.benchmark.throughput import Throughput, measure_throughput

__all__ = [
    "ENGINES",
    "FRAME",
    "TASKS",
    "ClockedEngine",
    "Engine",
    "Figures",
    "Options",
    "Row",
    "Throughput",
    "load_engine",
    "markdown",
    "measure_throughput",
    "run",
]
