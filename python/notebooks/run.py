"""Executes the notebooks and stores their outputs.

    python run.py [NAME...]

Widgets are stored as the pictures that stand for them: their state would be larger than all else.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
# An installed package comes first.
sys.path.append(str(HERE.parent))

import teeter  # noqa: E402

WIDGET = "application/vnd.jupyter.widget-view+json"
# Longest time of a cell on a busy machine, s.
TIMEOUT = 600


def executed(path: Path, folder: Path) -> nbformat.NotebookNode:
    """Returns a notebook with the outputs of a run in a folder, its widgets as pictures."""
    notebook = nbformat.read(path, as_version=4)
    paths = [str(Path(teeter.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(path for path in paths if path),
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
    }
    where = {"metadata": {"path": str(folder)}}
    client = NotebookClient(notebook, timeout=TIMEOUT, startup_timeout=TIMEOUT, resources=where)
    client.execute(env=environment)
    return stripped(notebook)


def stripped(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Returns a notebook without the state of widgets, the times of its run, and names of objects."""
    notebook.metadata.pop("widgets", None)
    notebook.metadata.language_info = {"name": "python"}
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            data.pop(WIDGET, None)
            if "image/png" in data:
                data.pop("text/plain", None)
    for cell in notebook.cells:
        # A figure is shown by its picture: the value of its last line says nothing.
        if any(output.output_type == "display_data" for output in cell.get("outputs", [])):
            cell.outputs = [output for output in cell.outputs if output.output_type != "execute_result"]
    return notebook


def main(names: list[str]) -> None:
    """Executes all notebooks, or those with some names."""
    for path in sorted(HERE.glob("*.ipynb")):
        if not names or path.stem in names:
            nbformat.write(executed(path, HERE), path)
            print(f"{path.name}: {path.stat().st_size // 1000} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
