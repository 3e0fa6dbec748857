"""Packages that a part of this one needs, and that are installed by an extra."""

from __future__ import annotations

import importlib
from types import ModuleType

from teeter.errors import UnavailableError

__all__ = ["needed"]


def needed(module: str, extra: str) -> ModuleType:
    """Imports a module of an extra. Raises UnavailableError where it is not installed."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = error.name or module
        raise UnavailableError(
            f"`{package}` is not installed, expected `pip install 'teeter[{extra}]'`", package
        ) from error
