"""Docstrings of the package as reStructuredText.

They are plain text: paragraphs, `names` between backticks, and arguments as `name: text`. Each
argument becomes an item of a list, names of the package become links, and all else is literal.
"""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Collection, Iterable, Mapping

_PART = re.compile(r"(``.+?``|`[^`]+`|docs/[\w/-]+\.md|\b[A-Za-z_][\w.]*\w(?:\(\))?)")
_SPECIAL = re.compile(r"([*|\\]|(?<=\w)_(?!\w))")
# Keys of the docstrings of environments; the space of an action may stand behind its key.
_KEYS = (r"(?:Action|Observation)(?:, [^:]+)?", "Reward", "Terminated", "Truncated")


def _word(word: str, before: str, links: Mapping[str, str]) -> str:
    if word.startswith("`"):
        name = word.strip("`")
        return links.get(name, f"``{name}``")
    if page := re.fullmatch(r"docs/([\w/-]+)\.md", word):
        return f":doc:`/{page[1]}`"
    name = word.removesuffix("()")
    is_name = "." in name or word.endswith("()") or not name[1:].islower() or before[-1:] not in ("", ".", ":", ";")
    if name in links and is_name and (name[0].isupper() or word.endswith("()")):
        return links[name]
    return f"``{word}``" if "_" in word.strip("_") else _SPECIAL.sub(r"\\\1", word)


def inline(text: str, links: Mapping[str, str]) -> str:
    """Returns a text with its names as links or literals and all marks escaped.

    A single capitalised word that begins a sentence, such as Force, is a word and no name.
    """
    parts = _PART.split(text)
    return "".join(
        _word(part, "".join(parts[:i]).rstrip(), links) if i % 2 else _SPECIAL.sub(r"\\\1", part)
        for i, part in enumerate(parts)
    )


def _arguments(paragraph: str, names: Collection[str]) -> list[tuple[str, str]]:
    """Splits a paragraph at its arguments: pairs of name and text, with no name for what is before."""
    one = "|".join([*(re.escape(name) for name in sorted(names, key=len, reverse=True)), *_KEYS])
    mark = re.compile(rf"(?:^|(?<=[.;)]\s)|(?<=\n))((?:{one})(?:(?:, | and )(?:{one}))*): ")
    parts = mark.split(paragraph)
    pairs = [("", parts[0].strip())] if parts[0].strip() else []
    return pairs + [(parts[i], parts[i + 1].strip()) for i in range(1, len(parts), 2)]


def _listed(paragraph: str, names: Collection[str], links: Mapping[str, str]) -> list[str]:
    out: list[str] = []
    for name, text in _arguments(paragraph, names):
        after = ""
        if name and (found := re.search(r"(?<=\.\s)Raises [A-Z].*$", text, re.DOTALL)):
            text, after = text[: found.start()].strip(), found[0]
        flat = inline(" ".join(text.split()), links)
        out += [f"* **{inline(name, {})}**: {flat}"] if name else [flat, ""]
        if after:
            out += ["", inline(" ".join(after.split()), links), ""]
    return [*out, ""]


def converted(lines: Iterable[str], names: Collection[str], links: Mapping[str, str]) -> list[str]:
    """Returns a docstring as lines of reStructuredText.

    names: of arguments and attributes. links: reference of each name that has one.
    """
    out: list[str] = []
    text = "\n".join(lines).expandtabs().strip("\n")
    literal = False
    block: list[str] = []
    for paragraph in re.split(r"\n\s*\n", text):
        if literal and paragraph.startswith(" "):
            block.append(paragraph)
            continue
        out += _block(block)
        block = []
        literal = paragraph.rstrip().endswith("::")
        if literal:
            out += [inline(" ".join(paragraph.split())[:-1], links), ""]
        else:
            out += _listed(paragraph, names, links)
    return out + _block(block)


def _block(paragraphs: list[str]) -> list[str]:
    """An indented block: Python where it is, else text."""
    if not paragraphs:
        return []
    lines = textwrap.dedent("\n\n".join(paragraphs)).split("\n")
    try:
        ast.parse("\n".join(lines))
        language = "python"
    except SyntaxError:
        language = "text"
    return [f".. code-block:: {language}", "", *(f"   {line}".rstrip() for line in lines), ""]


def without_signature(lines: list[str], name: str) -> list[str]:
    """Returns a docstring whose first paragraph does not repeat the signature of `name`."""
    first, *rest = "\n".join(lines).split("\n\n")
    return "\n\n".join([re.sub(rf"\s*\b{re.escape(name)}\(.*\)\s*$", "", first, flags=re.DOTALL), *rest]).split("\n")
