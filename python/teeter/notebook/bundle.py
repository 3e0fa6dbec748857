"""The built view of notebooks, a module of JavaScript that windows of environments show as well."""

from __future__ import annotations

from pathlib import Path

from teeter.errors import UnavailableError

__all__ = ["BUNDLE", "require"]

#: File that `make page` builds.
BUNDLE = Path(__file__).parent / "static" / "widget.js"


def require() -> Path:
    """Returns the file of the view. Raises UnavailableError where it was not built."""
    if not BUNDLE.exists():
        raise UnavailableError("the widget was not built: run `make page`", "widget")
    return BUNDLE
