"""Pages of the manual: which files of the repository they come from, and their links.

The documents are written for readers of the repository. A page of the manual is a copy of one, in
which links lead to other pages of the manual, and links to code to pages that show it.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Documents outside of docs and python/docs that are pages as well.
PROJECT = {
    "README.md": "overview.md",
    "ARCHITECTURE.md": "architecture.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "data/oracle/README.md": "oracle.md",
}
INDEX = "docs/README.md"

# Scheme of a link to code: the extension `source_pages` resolves it.
SOURCE = "source:"

_FENCE = re.compile(r"^(\s*)(`{3,}|~{3,})\s*(\S*)")
_LINK = re.compile(r"(\]\()([^)\s]+)(\))")
_SECTION = re.compile(r"^\| \*\*(.+?)\*\* \|")
_ROW_LINK = re.compile(r"\]\(([^)#\s]+)")


class LinkError(ValueError):
    """Link of a document to a file that does not exist."""


@dataclass(frozen=True)
class Site:
    """Files of the manual, by their paths in the repository. Paths are posix and relative.

    pages: path of the page of each document.
    assets: path of each picture or table that is copied as it is.
    """

    pages: dict[str, str]
    assets: dict[str, str]


def site(root: Path = ROOT) -> Site:
    """Returns the pages and assets of a repository."""
    pages = {path: page for path, page in PROJECT.items() if (root / path).exists()}
    assets = {}
    for folder, at in (("docs", ""), ("python/docs", ""), ("python/notebooks", "notebooks/")):
        for file in sorted((root / folder).rglob("*")):
            path = file.relative_to(root).as_posix()
            name = at + file.relative_to(root / folder).as_posix()
            if file.suffix in (".md", ".ipynb") and path != INDEX and ".ipynb_checkpoints" not in path:
                pages[path] = re.sub(r"(^|/)README\.md$", r"\1index.md", name)
            elif file.suffix in (".png", ".gif", ".svg", ".csv"):
                assets[path] = name
    pages[INDEX] = "index.md"
    return Site(pages, assets)


def contents(root: Path = ROOT) -> dict[str, list[str]]:
    """Returns the documents of each section of the index of the documents, in its order."""
    sections: dict[str, list[str]] = {}
    section = ""
    for line in (root / INDEX).read_text().splitlines():
        if found := _SECTION.match(line):
            section = found[1]
        elif section and line.startswith("| ["):
            target = _ROW_LINK.search(line)
            if target and target[1].endswith((".md", ".ipynb")):
                path = posixpath.normpath(posixpath.join("docs", target[1]))
                sections.setdefault(section, []).append(path)
    return sections


def outside_fences(text: str, change: Callable[[str], str]) -> str:
    """Returns a text in which each line that is in no fenced block is changed."""
    lines, fence = [], ""
    for line in text.split("\n"):
        mark = _FENCE.match(line)
        if mark and (not fence or (mark[2].startswith(fence) and not mark[3])):
            fence = "" if fence else mark[2]
        elif not fence:
            line = change(line)
        lines.append(line)
    return "\n".join(lines)


def relinked(text: str, path: str, files: Site, root: Path = ROOT) -> str:
    """Returns a document with the links of its page.

    path: of the document in the repository. Raises LinkError for a link to a file that is missing.
    """
    here = posixpath.dirname(files.pages[path])

    def target_of(link: str) -> str:
        file, _, anchor = link.partition("#")
        if not file or re.match(r"[a-z]+:", link):
            return link
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), file))
        known = files.pages.get(target) or files.assets.get(target)
        if known:
            return posixpath.relpath(known, here or ".") + (f"#{anchor}" if anchor else "")
        if not (root / target).exists():
            raise LinkError(f"{path}: no file {target}")
        return SOURCE + target

    def change(line: str) -> str:
        # Code spans keep their text: odd parts are within backticks.
        parts = re.split(r"(`[^`]*`(?!\]))", line)
        return "".join(
            part if i % 2 else _LINK.sub(lambda found: found[1] + target_of(found[2]) + found[3], part)
            for i, part in enumerate(parts)
        )

    return outside_fences(text, change)


def _fenced(lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Splits lines into fenced blocks, with their language, and all others, with none."""
    at = 0
    while at < len(lines):
        mark = _FENCE.match(lines[at])
        end = at + 1
        if mark:
            while end < len(lines) and lines[end].strip() != mark[2]:
                end += 1
            end += 1
        block = lines[at:end]
        # `rust,ignore` is for the tests of the examples.
        language = mark[3].split(",")[0] if mark else ""
        if mark:
            block[0] = mark[1] + mark[2] + language
        yield language, block
        at = end


def tabbed(text: str) -> str:
    """Returns a document whose neighbouring blocks of Rust and Python are tabs of one block.

    Neighbours have only an empty line between them.
    """
    parts = list(_fenced(text.split("\n")))
    out: list[str] = []
    at = 0
    while at < len(parts):
        group = [parts[at]]
        after = at + 1
        while after + 1 < len(parts) and parts[after][1] == [""] and _pair(group[-1][0], parts[after + 1][0]):
            group.append(parts[after + 1])
            after += 2
        if len(group) > 1:
            out += [":::::{tab-set-code}", "", *(line for _, block in group for line in [*block, ""]), ":::::"]
        else:
            out += group[0][1]
            after = at + 1
        at = after
    return "\n".join(out)


def _pair(one: str, other: str) -> bool:
    return {one, other} == {"rust", "python"}
