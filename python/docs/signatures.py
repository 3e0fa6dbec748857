"""Signatures of the reference: types of the stub, defaults of the module.

The stub of a module in Rust declares types, and its defaults are `...`. The module has the values
of the defaults, in the text of a signature or in the first paragraph of a docstring.
"""

from __future__ import annotations

import ast
import copy
import re
from functools import cache
from pathlib import Path
from typing import Any

STUB = Path(__file__).resolve().parents[1] / "teeter/_teeter.pyi"


@cache
def _declared() -> dict[str, ast.FunctionDef]:
    """Functions and methods of the stub by qualified name; `__new__` has the name of its class."""
    found: dict[str, ast.FunctionDef] = {}
    for node in ast.parse(STUB.read_text()).body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = node
        elif isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    found[node.name if member.name == "__new__" else f"{node.name}.{member.name}"] = member
    return found


def _defaults(name: str, item: Any) -> dict[str, str]:
    """Defaults of the parameters of an item, as source."""
    short = name.rsplit(".", 1)[-1]
    found: dict[str, str] = {}
    first = " ".join((item.__doc__ or "").split("\n\n")[0].split())
    own = re.search(rf"\b{short}(\(.*\))$", first)
    for text in (getattr(item, "__text_signature__", None), own[1] if own else None):
        if not text:
            continue
        try:
            arguments = ast.parse(f"def f{text.replace('$', '')}: ...").body[0].args  # type: ignore[attr-defined]
        except SyntaxError:
            continue
        positional = arguments.args[len(arguments.args) - len(arguments.defaults) :]
        for argument, default in zip(positional, arguments.defaults, strict=True):
            found[argument.arg] = ast.unparse(default)
        for argument, value in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
            if value is not None:
                found[argument.arg] = ast.unparse(value)
    return found


def signature(name: str, item: Any) -> tuple[str, str | None] | None:
    """Returns the arguments and the type of the result of an item; None where the stub lacks it.

    name: qualified name in the module, such as `World.step`.
    """
    node = _declared().get(name)
    if node is None:
        return None
    defaults = _defaults(name, item)
    arguments = copy.deepcopy(node.args)
    arguments.args = [argument for argument in arguments.args if argument.arg not in ("self", "cls")]
    positional = arguments.args[len(arguments.args) - len(arguments.defaults) :]
    arguments.defaults = _filled(positional, arguments.defaults, defaults)
    arguments.kw_defaults = _filled(arguments.kwonlyargs, arguments.kw_defaults, defaults)
    is_class = node.name == "__new__"
    result = ast.unparse(node.returns) if node.returns and not is_class else None
    return f"({ast.unparse(arguments)})", result


def parameters(name: str) -> set[str]:
    """Returns the names of the parameters of an item, none where the stub lacks it."""
    node = _declared().get(name)
    if node is None:
        return set()
    arguments = node.args
    return {argument.arg for argument in (*arguments.args, *arguments.kwonlyargs)} - {"self", "cls"}


def _filled(arguments: list[ast.arg], values: list[Any], defaults: dict[str, str]) -> list[Any]:
    """Defaults of arguments, by the module where it has them."""
    return [
        ast.parse(defaults[argument.arg], mode="eval").body if value and argument.arg in defaults else value
        for argument, value in zip(arguments, values, strict=True)
    ]
