"""Builds the manual from the documents, the docstrings and the notebooks.

    python build.py OUT

lays out the pages under OUT/source, and has Sphinx write them to OUT/html. A warning is an error,
and so is a broken link.
"""

from __future__ import annotations

import importlib
import pkgutil
import shutil
import sys
from pathlib import Path

import check
import pages
from sphinx.cmd.build import build_main

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

MARK = "<!-- contents -->"
# Modules without a page: the binding, whose items the package re-exports, and programs.
HIDDEN = ("_", "__main__")


def modules() -> list[str]:
    """Returns the names of the modules that have a page of the reference, in order.

    The parts of a package that exports names are its own affair; those of one without are public. A
    module that a written page has needs no page.
    """
    import teeter

    written = "".join(page.read_text() for page in (HERE / "reference").glob("*.md"))
    found: list[str] = []
    for _, name, _ in sorted(pkgutil.walk_packages(teeter.__path__, "teeter."), key=lambda module: module.name):
        parent = name.rpartition(".")[0]
        is_part = parent != "teeter" and bool(getattr(importlib.import_module(parent), "__all__", ()))
        if not is_part and not any(part.startswith(HIDDEN) for part in name.split(".")):
            found.append(name)
    return [name for name in found if f"automodule:: {name}\n" not in written]


def module_page(name: str) -> str:
    """Returns the page of a module. Raises ImportError where a package that it needs is not installed."""
    imported = "\n   :imported-members:" if hasattr(importlib.import_module(name), "__all__") else ""
    return f"# {name}\n\n```{{eval-rst}}\n.. automodule:: {name}\n   :members:{imported}\n```\n"


def tree(caption: str, entries: list[str], visible: bool = False) -> str:
    """Returns a part of the table of contents."""
    hidden = "" if visible else ":hidden:\n"
    return f"```{{toctree}}\n:caption: {caption}\n:maxdepth: 1\n{hidden}\n" + "\n".join(entries) + "\n```\n"


def table_of_contents(files: pages.Site) -> str:
    """Returns the trees of the sections of the index of the documents, and of the other pages."""
    sections = {
        name: [files.pages[path] for path in paths if path in files.pages] for name, paths in pages.contents().items()
    }
    listed = {page for paths in sections.values() for page in paths}
    project = [page for page in pages.PROJECT.values() if page not in listed]
    trees = [tree(name, paths) for name, paths in sections.items()]
    trees.append(tree("Reference", ["reference/index.md"]))
    return "\n".join([*trees, tree("Project", project)])


def lay_out(source: Path) -> None:
    """Writes the pages into a folder, and leaves those that have not changed."""
    files = pages.site()
    written = {}
    for path, page in files.pages.items():
        if path == pages.INDEX:
            continue
        text = (pages.ROOT / path).read_text()
        if path.endswith(".md"):
            text = pages.tabbed(pages.relinked(text, path, files))
        written[page] = text
    written["index.md"] = written["index.md"].replace(MARK, table_of_contents(files))
    names = modules()
    for name in names:
        written[f"reference/{name}.md"] = module_page(name)
    written["reference/index.md"] += "\n" + tree("Modules", [f"{name}.md" for name in names], visible=True)
    for page in [page for page in written if page.endswith("/index.md") and not page.startswith("reference/")]:
        folder = page.removesuffix("index.md")
        inside = [other.removeprefix(folder) for other in written if other.startswith(folder) and other != page]
        written[page] += "\n" + tree("Pages", inside)
    for page, text in written.items():
        write(source / page, text.encode())
    for path, page in files.assets.items():
        write(source / page, (pages.ROOT / path).read_bytes())
    known = {*written, *files.assets.values()}
    for file in source.rglob("*"):
        if file.is_file() and file.relative_to(source).as_posix() not in known:
            file.unlink()


def write(file: Path, data: bytes) -> None:
    """Writes a file where its contents change."""
    if not file.exists() or file.read_bytes() != data:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)


def main(out: Path) -> int:
    """Builds the manual and returns the exit code of Sphinx."""
    lay_out(out / "source")
    shutil.rmtree(out / "html", ignore_errors=True)
    options = [
        "--fail-on-warning",
        "--keep-going",
        "--fresh-env",
        "--quiet",
        "-c",
        str(HERE),
        "-d",
        str(out / "doctrees"),
    ]
    code = build_main([*options, "-b", "html", str(out / "source"), str(out / "html")])
    # For the tools of developers only.
    for pattern in ("*.map", ".buildinfo*", "objects.inv"):
        for file in (out / "html").rglob(pattern):
            file.unlink()
    found = check.faults(out / "html")
    print("\n".join(found), file=sys.stderr, end="\n" if found else "")
    return code or int(bool(found))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
