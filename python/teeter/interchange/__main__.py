"""The program of the interchange: ``python -m teeter.interchange --help``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from teeter.errors import TeeterError
from teeter.interchange.convert import MOTIONS, SCENES, convert

__all__ = ["main"]


def parser() -> argparse.ArgumentParser:
    """Parser of the arguments."""
    program = argparse.ArgumentParser(
        prog="python -m teeter.interchange",
        description="Converts scenes and motions between formats; see docs/interchange.md.",
    )
    command = program.add_subparsers(dest="command", required=True).add_parser(
        "convert",
        help="convert a file by its suffix",
        description=f"Scenes: {', '.join(SCENES)}. Motions, of a scene or a .record: {', '.join(MOTIONS)}.",
    )
    command.add_argument("source", help="file, or the name or notation of a scene")
    command.add_argument("target", help="file to write")
    command.add_argument("--seconds", type=float, help="length of a motion, s (a whole record, or 10)")
    command.add_argument("--every", type=int, default=1, help="frames from one state to the next (1)")
    return program


def main(words: Sequence[str] | None = None) -> int:
    """Runs the program and returns its exit code: 0, or 2 for bad input with one line."""
    arguments = parser().parse_args(words)
    try:
        convert(arguments.source, arguments.target, seconds=arguments.seconds, every=arguments.every)
    except (TeeterError, OSError) as error:
        print(f"teeter.interchange: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
