"""Studies: many samples of the engine, on any executor, with results on the disk.

A study is a pure function of a sample, which has parameters and a seed of its own, and returns a row. Rows go
into Parquet files as they come, and a study that was stopped goes on from them::

    result = study.run("removal", out="removal", samples=540, executor="processes")
    result.plot("removal.svg")

It needs ``pip install 'teeter[study]'``, and ``[ray]`` or ``[dask]`` for those executors.
"""

from __future__ import annotations

from teeter.study.executor import Dask, Executor, Futures, Processes, Serial, Threads
from teeter.study.interval import mean_interval, summary, wilson
from teeter.study.ray_executor import Ray
from teeter.study.runner import Result, load, run
from teeter.study.sample import Plan, Row, Sample, Study, seed_of
from teeter.study.shipped import STUDIES

__all__ = [
    "STUDIES",
    "Dask",
    "Executor",
    "Futures",
    "Plan",
    "Processes",
    "Ray",
    "Result",
    "Row",
    "Sample",
    "Serial",
    "Study",
    "Threads",
    "load",
    "mean_interval",
    "run",
    "seed_of",
    "summary",
    "wilson",
]
