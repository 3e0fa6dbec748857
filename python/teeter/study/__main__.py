"""Studies in a shell: ``python -m teeter.study NAME --out DIR``."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from teeter.errors import StudyError, TeeterError
from teeter.study import dataset
from teeter.study.runner import Result, run
from teeter.study.sample import Study
from teeter.study.shipped import STUDIES, study_of

__all__ = ["main"]

DATASET = "dataset"


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a study or makes the data set, and returns the code for the shell: 0, 2 after a line on the error, or
    130 where it was stopped.
    """
    options = _parser().parse_args(arguments)
    try:
        # Ray reports on the standard output, which is for the results here.
        with contextlib.redirect_stdout(sys.stderr):
            made = _run(options)
        if isinstance(made, Result):
            _print(made, options)
        else:
            print(made)
    except (TeeterError, ModuleNotFoundError) as error:
        print(f"teeter: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("teeter: stopped; the same command goes on from what is there", file=sys.stderr)
        return 130
    return 0


def _run(options: argparse.Namespace) -> Result | Path:
    if options.name == DATASET:
        return dataset.build(options.out, episodes=options.samples, **_common(options))
    study = _imported(options.name) if ":" in options.name else study_of(options.name)
    return run(study, options.out, samples=options.samples, **_common(options))


def _common(options: argparse.Namespace) -> dict[str, Any]:
    return {
        "seed": options.seed,
        "params": dict(_param(line) for line in options.set),
        "executor": options.executor,
        "workers": options.workers,
        "address": options.address,
        "batch": options.batch,
        "progress": not options.quiet,
    }


def _print(result: Result, options: argparse.Namespace) -> None:
    """Prints the summary, and draws where a file is given for it."""
    plan = result.plan
    lines = result.summary()
    if options.json:
        print(json.dumps({**plan.identity(), "samples": result.table.num_rows, "digest": result.digest}))
    else:
        numbers = [name for name, kind in plan.study.columns.items() if kind in ("bool", "int", "float")]
        for line in lines:
            swept = " ".join(f"{name}={line[name]}" for name in plan.swept)
            shares = ", ".join(
                f"{name} {line[name]:.4g} ({line[f'{name}_low']:.3g} to {line[f'{name}_high']:.3g})" for name in numbers
            )
            print(f"{swept or plan.study.name}: {line['samples']} samples, {shares}")
        print(f"{result.table.num_rows} samples, digest {result.digest[:16]}")
    if options.plot is not None:
        result.plot(options.plot)


def _param(line: str) -> tuple[str, Any]:
    """Name and value of ``name=value``, or of ``name=value,value`` for a sweep."""
    name, equals, text = line.partition("=")
    if not equals:
        raise StudyError(f"`--set` is {line!r}, expected name=value", "set")
    values = [_value(part) for part in text.split(",")]
    return name, values if len(values) > 1 else values[0]


def _value(text: str) -> Any:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text, text)


def _imported(name: str) -> Study:
    """Study of ``module:attribute``."""
    module, _, attribute = name.partition(":")
    if "" not in sys.path:
        sys.path.insert(0, "")
    found = getattr(importlib.import_module(module), attribute, None)
    if not isinstance(found, Study):
        raise StudyError(f"`{name}` is {found!r}, expected a Study", "study")
    return found


def _parser() -> argparse.ArgumentParser:
    about = "\n".join(f"{name}: {study.about}" for name, study in STUDIES.items())
    parser = argparse.ArgumentParser(
        prog="python -m teeter.study",
        description="Runs a study of many samples. One that was stopped goes on from what is in its folder.",
        epilog=f"{about}\n{DATASET}: {dataset.ABOUT}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("name", help=f"{', '.join(STUDIES)}, {DATASET}, or module:attribute of a Study")
    parser.add_argument("--out", type=Path, required=True, help="folder of the results")
    parser.add_argument("--samples", type=int, help="number of samples; ten of each combination of values by default")
    parser.add_argument("--seed", type=int, default=0, help="master seed")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter; a,b,c is swept")
    parser.add_argument("--executor", default="processes", help="serial, threads, processes, dask or ray")
    parser.add_argument("--workers", type=int, help="number of workers, one a core by default")
    parser.add_argument("--address", help="address of a cluster of Dask or Ray")
    parser.add_argument("--batch", type=int, help="samples a call, as many as take 2 s by default")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="file for the plot, .svg or .png")
    parser.add_argument("--json", action="store_true", help="print the parameters and the digest of the table as JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress bar")
    return parser


if __name__ == "__main__":
    sys.exit(main())
