"""The notebooks run, and store what they print."""

import json
from pathlib import Path

import nbformat
import pytest
import run

FOLDER = Path(__file__).parents[1] / "notebooks"


NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
# Largest size of a file with its pictures, bytes.
MAX_SIZE = 300_000


def printed(notebook):
    """Text that each cell prints."""
    return [
        "".join(output.text for output in cell.get("outputs", []) if output.output_type == "stream")
        for cell in notebook.cells
    ]


def pictures(notebook):
    """Number of pictures of each cell."""
    outputs = [cell.get("outputs", []) for cell in notebook.cells]
    return [sum("image/png" in output.get("data", {}) for output in of_cell) for of_cell in outputs]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_prints_what_it_stores(path, tmp_path):
    stored, ran = nbformat.read(path, as_version=4), run.executed(path, tmp_path)
    assert printed(ran) == printed(stored)
    assert pictures(ran) == pictures(stored)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_has_pictures_instead_of_widgets(path):
    text = path.read_text()
    stored = json.loads(text)
    assert len(text) < MAX_SIZE and "widgets" not in stored["metadata"]
    assert run.WIDGET not in text
    assert sum(pictures(nbformat.from_dict(stored))) >= 3


def test_there_are_three_notebooks():
    assert [path.stem for path in NOTEBOOKS] == ["first-tower", "loose-blocks", "why-it-fell"]
