"""Reference of the package: turns docstrings and signatures into those of the manual."""

from __future__ import annotations

import contextlib
import inspect
from functools import cache
from typing import Any

import docstrings
import signatures
from sphinx.application import Sphinx

import teeter

BINDING = "teeter._teeter"


@cache
def links() -> dict[str, str]:
    """References of the public names of the package: classes, their members, and functions."""
    found = {}
    for name in teeter.__all__:
        item = getattr(teeter, name)
        if inspect.isclass(item):
            role = "exc" if issubclass(item, Exception) else "class"
            at = f"teeter.errors.{name}" if role == "exc" else _home(item)
            found[name] = f":py:{role}:`~{at}`"
            for member, value in vars(item).items():
                if not member.startswith("_") and callable(value):
                    found[f"{name}.{member}"] = f":py:meth:`{name}.{member} <{_home(item)}.{member}>`"
        elif callable(item):
            found[name] = f":py:func:`teeter.{name}`"
    return found


def _home(item: Any) -> str:
    """Qualified name under which the reference has a class."""
    module = item.__module__
    return f"teeter.{item.__name__}" if module in ("builtins", BINDING, "teeter") else f"{module}.{item.__name__}"


def _binding_name(name: str, item: Any) -> str | None:
    """Name of an item in the module in Rust; None where it is not from there."""
    short = name.split(".", 2)[-1] if name.startswith("teeter.scenes.") else name.removeprefix("teeter.")
    first = getattr(teeter._teeter, short.split(".")[0], None)
    return short if first is not None else None


def process_docstring(app: Sphinx, what: str, name: str, item: Any, options: Any, lines: list[str]) -> None:
    """Turns a docstring into reStructuredText."""
    short = name.rsplit(".", 1)[-1]
    names: set[str] = set()
    if what == "class":
        names |= {member for member in vars(item) if not member.startswith("_")}
        lines[:] = docstrings.without_signature(lines, short)
    described = signatures.parameters(_binding_name(name, item) or "")
    with contextlib.suppress(TypeError, ValueError):
        described = described or set(inspect.signature(item).parameters)
    own = {key: link for key, link in links().items() if key != short}
    lines[:] = docstrings.converted(lines, names | described, own)


def process_signature(
    app: Sphinx, what: str, name: str, item: Any, options: Any, args: str | None, result: str | None
) -> tuple[str, str | None] | None:
    """Returns the signature of an item in Rust by its stub."""
    short = _binding_name(name, item) if what in ("class", "function", "method") else None
    return signatures.signature(short, item) if short else None


def setup(app: Sphinx) -> dict[str, bool]:
    """Registers the extension."""
    app.connect("autodoc-process-docstring", process_docstring)
    app.connect("autodoc-process-signature", process_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
