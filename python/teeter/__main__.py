"""The program ``teeter``, as a script of the package and as ``python -m teeter``."""

from __future__ import annotations

import signal
import sys

from teeter import docs
from teeter._teeter import run_command


def main() -> None:
    """Runs the program with the arguments of the shell and exits with its code.

    ``docs`` opens the manual; all other commands are those of the program in Rust.
    """
    if sys.argv[1:2] == ["docs"]:
        docs.main(sys.argv[2:])
        return
    # Python's own handlers would wait until the program is done.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    sys.exit(run_command(["teeter", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
