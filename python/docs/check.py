"""Checks a built manual: each link leads to a page and a heading, and no page loads from a network."""

from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes whose address a browser loads without being asked to.
_LOADED = {"img": "src", "script": "src", "link": "href", "iframe": "src", "source": "src"}


class _Page(HTMLParser):
    """Links, loaded addresses and anchors of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        if anchor := found.get("id"):
            self.anchors.add(anchor)
        if tag == "a" and (link := found.get("href")):
            self.links.add(link)
        if (name := _LOADED.get(tag)) and (link := found.get(name)):
            self.loaded.add(link)


def faults(folder: Path) -> list[str]:
    """Returns what is wrong with the pages of a folder, a line each."""
    pages = {file: _Page(file.read_text()) for file in sorted(folder.rglob("*.html"))}
    out = []
    for file, page in pages.items():
        name = file.relative_to(folder)
        for link in sorted(page.links | page.loaded):
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded and parts.scheme != "data":
                    out.append(f"{name}: loads {link}")
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if not target.exists():
                out.append(f"{name}: no page {link}")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                out.append(f"{name}: no heading {link}")
    return out
