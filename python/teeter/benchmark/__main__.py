"""The program of the benchmark: ``python -m teeter.benchmark --help``."""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from teeter import __version__
from teeter.benchmark.engine import ENGINES
from teeter.benchmark.report import markdown, run
from teeter.benchmark.tasks import TASKS, Options
from teeter.benchmark.throughput import measure_throughput
from teeter.errors import TeeterError

__all__ = ["main"]


def parser() -> argparse.ArgumentParser:
    """Parser of the arguments."""
    known = argparse.ArgumentParser(
        prog="python -m teeter.benchmark",
        description="Measures engines on towers with exact answers; see docs/benchmark.md.",
    )
    known.add_argument(
        "--engine",
        default="teeter,mujoco",
        help=f"names with commas between: {', '.join(ENGINES)}, module:Class or file.py:Class",
    )
    known.add_argument("--tasks", default=",".join(TASKS), help="names with commas between (all)")
    known.add_argument("--towers", type=_count(400), default=40, help="labelled towers, 1 to 400 (40)")
    known.add_argument("--seed", type=_count(10**9, least=0), help="draw the labelled towers from a seed")
    known.add_argument("--tilts", type=_count(50), default=8, help="tilted towers, 1 to 50 (8)")
    known.add_argument("--storeys", type=_count(20), default=3, help="storeys of the house of cards (3)")
    known.add_argument("--rows", type=_count(60), default=18, help="rows of the tower (18)")
    known.add_argument("--pulls", type=_count(180), default=6, help="blocks of it that are pulled (6)")
    known.add_argument("--seconds", type=_count(3600), default=8, help="time at rest, s (8)")
    known.add_argument(
        "--batch", type=_count(4096), metavar="WORLDS", help="measure WorldBatch beside mujoco.batch as well"
    )
    known.add_argument("--threads", type=_count(1024), default=os.cpu_count() or 1, help="threads of --batch (all)")
    known.add_argument("--out", type=Path, help="folder for benchmark.json and benchmark.md")
    known.add_argument("--json", action="store_true", help="print JSON instead of the table")
    return known


def _count(most: int, least: int = 1) -> Any:
    def read(text: str) -> int:
        number = int(text)
        if not least <= number <= most:
            raise argparse.ArgumentTypeError(f"is {number}, expected {least} to {most}")
        return number

    return read


def _show_progress(engine: str, task: str, done: int, total: int) -> None:
    if sys.stderr.isatty():
        end = "\n" if done == total else ""
        print(f"\r{engine} {task}: {done} of {total} ", end=end, file=sys.stderr, flush=True)
    elif done == total:
        print(f"{engine} {task}: {total} done", file=sys.stderr, flush=True)


def measure(arguments: argparse.Namespace) -> tuple[str, dict[str, Any]]:
    """Measures, and returns the tables as Markdown and all figures as plain data."""
    options = Options(
        towers=arguments.towers,
        seed=arguments.seed,
        tilts=arguments.tilts,
        storeys=arguments.storeys,
        rows=arguments.rows,
        pulls=arguments.pulls,
        seconds=float(arguments.seconds),
    )
    names = [name for name in arguments.engine.split(",") if name]
    tasks = [name for name in arguments.tasks.split(",") if name]
    rows = run(names, tasks, options, _show_progress)
    data: dict[str, Any] = {
        "teeter": __version__,
        "python": platform.python_version(),
        "machine": platform.machine(),
        "rows": [row.as_dict() for row in rows],
    }
    text = markdown(rows) if rows else ""
    if arguments.batch:
        batch = measure_throughput(
            arguments.batch,
            arguments.threads,
            rows=arguments.rows,
            progress=lambda done, total: _show_progress("teeter and mujoco", "batch", done, total),
        )
        data["batch"] = batch.as_dict()
        text += ("\n" if text else "") + batch.markdown()
    return text, data


def main(words: Sequence[str] | None = None) -> int:
    """Runs the program and returns its exit code: 0, or 2 for bad input with one line."""
    arguments = parser().parse_args(words)
    try:
        if arguments.out is not None:
            # before hours of measuring, not after
            arguments.out.mkdir(parents=True, exist_ok=True)
        text, data = measure(arguments)
        encoded = json.dumps(data, indent=2) + "\n"
        if arguments.out is not None:
            (arguments.out / "benchmark.json").write_text(encoded, encoding="utf-8")
            (arguments.out / "benchmark.md").write_text(text, encoding="utf-8")
    except (TeeterError, OSError) as error:
        print(f"teeter.benchmark: {error}", file=sys.stderr)
        return 2
    print(encoded if arguments.json else text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
