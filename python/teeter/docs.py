"""The manual: guides, reference, method and results, as pages that need no network.

``teeter docs`` opens it in a browser, and ``teeter docs --path`` prints the path of its first page.
So does ``python -m teeter.docs``.
"""

from __future__ import annotations

import argparse
import webbrowser
from collections.abc import Sequence
from pathlib import Path

from teeter.errors import UnavailableError

__all__ = ["main", "path", "show"]

_FOLDER = Path(__file__).parent / "manual"


def path(page: str = "index") -> Path:
    """Returns the file of a page of the manual.

    page: its name, such as "index", "tutorial" or "reference/worlds".

    Raises UnavailableError where the manual was not built, or has no such page.
    """
    file = _FOLDER / f"{page}.html"
    if not (_FOLDER / "index.html").exists():
        raise UnavailableError("this package has no manual: build it by `make site`", "manual")
    if not file.exists():
        raise UnavailableError(f"the manual has no page `{page}`", "page")
    return file


def show(page: str = "index") -> bool:
    """Opens a page of the manual in a browser. Returns False where there is no browser.

    page: its name, see path().

    Raises UnavailableError.
    """
    return webbrowser.open(path(page).as_uri())


def main(arguments: Sequence[str] | None = None) -> None:
    """Carries out ``teeter docs``, and exits with its code."""
    parser = argparse.ArgumentParser("teeter docs", description="Opens the manual in a browser.")
    parser.add_argument("page", nargs="?", default="index", help="name of a page, such as python or reference/worlds")
    parser.add_argument("--path", action="store_true", help="print the path of the page instead")
    given = parser.parse_args(arguments)
    try:
        file = path(given.page)
    except UnavailableError as error:
        parser.error(str(error))
    if given.path or not show(given.page):
        print(file)


if __name__ == "__main__":
    main()
