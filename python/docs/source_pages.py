"""Pages that show code, for the links of the documents to files and folders of the repository."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from docutils import nodes
from pages import ROOT, SOURCE
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.util import ClassNotFound
from sphinx.application import Sphinx

FOLDER = "source"
# A longer file is shown up to this line.
MAX_LINES = 120
# Folders of what is built.
_SKIPPED = ("target", "node_modules", "dist", "__pycache__")


def _linked(app: Sphinx) -> set[str]:
    env: Any = app.env
    if not hasattr(env, "teeter_source_links"):
        env.teeter_source_links = {}
    return {path for paths in env.teeter_source_links.values() for path in paths}


def resolve(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    """Turns links of the scheme `source:` into links to pages of code."""
    _linked(app)
    env: Any = app.env
    found = env.teeter_source_links[docname] = []
    up = "../" * docname.count("/")
    for reference in doctree.findall(nodes.reference):
        uri = reference.get("refuri", "")
        if uri.startswith(SOURCE):
            path = uri.removeprefix(SOURCE).partition("#")[0].rstrip("/")
            found.append(path)
            reference["refuri"] = f"{up}{FOLDER}/{path}.html"


def _summary(file: Path) -> str:
    """First sentence of the comment that opens a file, empty where there is none."""
    if file.suffix not in (".rs", ".ts", ".py", ".mjs"):
        return ""
    lines = []
    for line in file.read_text(errors="replace").split("\n"):
        text = re.sub(r'^(//[/!]?|"""|/\*\*| \*)\s?', "", line)
        if text == line and not lines:
            return ""
        if not text.strip() or (text == line and file.suffix != ".py"):
            break
        lines.append(text.strip())
    return re.split(r'(?<=[.:])\s|"""', " ".join(lines))[0].rstrip(":")


def _file(path: str) -> str:
    text = (ROOT / path).read_text(errors="replace")
    lines = text.split("\n")
    try:
        lexer = get_lexer_for_filename(path)
    except ClassNotFound:
        lexer = TextLexer()
    shown = highlight("\n".join(lines[:MAX_LINES]), lexer, HtmlFormatter())
    # Spaces, names and punctuation have the colour of the text: a third of the page.
    shown = re.sub(r'<span class="[wnp]">([^<]*)</span>', r"\1", shown)
    rest = len(lines) - MAX_LINES
    return shown + (f"<p>{rest} further lines are in the repository.</p>" if rest > 0 else "")


def _folder(path: str, linked: set[str]) -> str:
    rows = []
    for child in sorted((ROOT / path).iterdir(), key=lambda child: (child.is_file(), child.name)):
        if child.name.startswith(".") or child.name in _SKIPPED:
            continue
        here = f"{path}/{child.name}"
        name = html.escape(child.name + ("/" if child.is_dir() else ""))
        if here in linked:
            name = f'<a class="reference internal" href="{Path(path).name}/{html.escape(child.name)}.html">{name}</a>'
        summary = _summary(child) if child.is_file() else ""
        rows.append(f"<tr><td>{name}</td><td>{html.escape(summary)}</td></tr>")
    head = "<thead><tr><th>file</th><th>contents</th></tr></thead>"
    table = f'<table class="docutils align-default">{head}<tbody>{"".join(rows)}</tbody></table>'
    return f'<div class="table-wrapper">{table}</div>'


def collect(app: Sphinx) -> Iterator[tuple[str, dict[str, Any], str]]:
    """Yields a page for each file and folder that a document links to."""
    linked = _linked(app)
    for path in sorted(linked):
        body = _folder(path, linked) if (ROOT / path).is_dir() else _file(path)
        title = f'<h1 class="source">{html.escape(path)}</h1>'
        # Without the table of contents, which would be longer than the code.
        context = {"title": path, "body": title + body, "sidebars": ["sidebar/brand.html", "sidebar/search.html"]}
        yield f"{FOLDER}/{path}", context, "page.html"


def setup(app: Sphinx) -> dict[str, bool]:
    """Registers the extension."""
    app.connect("doctree-resolved", resolve)
    app.connect("html-collect-pages", collect)
    return {"parallel_read_safe": True, "parallel_write_safe": False}
