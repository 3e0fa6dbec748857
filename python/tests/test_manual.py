"""The manual: its pages, links and reference."""

import re
from pathlib import Path

import check
import docstrings
import pages
import pytest
import signatures

import teeter
from teeter import docs

ROOT = Path(__file__).parents[2]
FILES = pages.Site(
    pages={"docs/play/free.md": "play/free.md", "docs/method.md": "method.md", "README.md": "overview.md"},
    assets={"docs/pictures/tower.png": "pictures/tower.png"},
)


@pytest.mark.parametrize(
    "link, expected",
    [
        ("../method.md", "../method.md"),
        ("../method.md#step", "../method.md#step"),
        ("../../README.md", "../overview.md"),
        ("../pictures/tower.png", "../pictures/tower.png"),
        ("../../crates/game", "source:crates/game"),
        ("#keys", "#keys"),
        ("https://example.org/a.md", "https://example.org/a.md"),
    ],
)
def test_a_link_of_a_document_leads_to_the_page_of_its_target(link, expected):
    text = f"see [it]({link}) and `[code]({link})`\n```\n[fence]({link})\n```"
    changed = pages.relinked(text, "docs/play/free.md", FILES)
    assert changed == text.replace(f"[it]({link})", f"[it]({expected})")


def test_a_link_to_a_missing_file_is_an_error():
    with pytest.raises(pages.LinkError, match=r"no file docs/castle\.md"):
        pages.relinked("[it](../castle.md)", "docs/play/free.md", FILES)


def test_neighbouring_blocks_of_rust_and_python_become_tabs():
    rust, python, shell = "```rust,ignore\na\n```", "```python\nb\n```", "```sh\nc\n```"
    shown = rust.replace(",ignore", "")
    assert pages.tabbed(f"{rust}\n\n{python}") == f":::::{{tab-set-code}}\n\n{shown}\n\n{python}\n\n:::::"
    for apart in (f"{python}\n\ntext\n\n{python}", f"{shell}\n\n{python}", f"{python}\n\n{python}"):
        assert pages.tabbed(apart) == apart


def test_the_contents_have_every_document_of_the_index_once():
    listed = [path for paths in pages.contents().values() for path in paths]
    files = pages.site()
    assert len(listed) == len(set(listed))
    folders = ("docs/", "python/notebooks/")
    inside = {path for path in files.pages if path.startswith(folders) and not path.startswith("docs/play/")}
    assert inside - {pages.INDEX} <= set(listed)


def test_pages_have_names_of_their_own():
    files = pages.site()
    names = [*files.pages.values(), *files.assets.values()]
    # The index of the documents is the front page.
    assert len(names) == len(set(names)) + 1


def test_a_docstring_becomes_a_list_of_arguments_with_links():
    text = "Force of a Hand, N*m. See docs/inputs.md.\n\nbody: its index. point, axis: of `it`, m.\nRaises InputError."
    links = {name: f"<{name}>" for name in ("Force", "Hand", "InputError")}
    assert docstrings.converted(text.split("\n"), {"body", "point", "axis"}, links) == [
        r"Force of a <Hand>, N\*m. See :doc:`/inputs`.",
        "",
        "",
        "* **body**: its index.",
        "* **point, axis**: of ``it``, m.",
        "",
        "Raises <InputError>.",
        "",
        "",
    ]


def test_an_indented_block_of_a_docstring_stays_as_it_is():
    text = "So::\n\n    world = f(*x)\n\n    y = 1\n\nor::\n\n    A (B)   c_d\n"
    code = [".. code-block:: python", "", "   world = f(*x)", "", "   y = 1", ""]
    assert docstrings.converted(text.split("\n"), set(), {}) == [
        *("So:", "", *code, "or:", ""),
        *(".. code-block:: text", "", "   A (B)   c_d", ""),
    ]


def test_a_signature_has_the_types_of_the_stub_and_the_defaults_of_the_module():
    arguments, result = signatures.signature("World", teeter.World)
    assert "precision: Literal['single', 'double']='single'" in arguments and "ramp: float=0.0" in arguments
    assert result is None
    arguments, result = signatures.signature("World.breakaway_force", teeter.World.breakaway_force)
    assert arguments == "(body: int, direction: ArrayLike | None=None)" and result == "float | None"
    for name in ("World", "WorldBatch", "Game"):
        assert "=..." not in signatures.signature(name, getattr(teeter, name))[0]


def test_the_reference_has_every_public_name():
    written = "\n".join(file.read_text() for file in (ROOT / "python/docs/reference").glob("*.md"))
    modules = {"teeter.errors": teeter.errors, "teeter.inputs": teeter.inputs, "teeter.scenes": teeter.scenes}
    of_modules = {name for module in modules.values() for name in module.__all__} | {"errors", "inputs", "scenes"}
    named = set(re.findall(r"(?:teeter\.|data:: )(\w+)", written))
    assert set(teeter.__all__) - of_modules - {"__version__"} - named == set()


def test_every_written_page_of_the_reference_is_in_its_table():
    folder = ROOT / "python/docs/reference"
    index = (folder / "index.md").read_text()
    for page in folder.glob("*.md"):
        assert page.name == "index.md" or (f"]({page.name})" in index and f"\n{page.name}\n" in index)


def test_broken_links_and_loads_from_a_network_are_found(tmp_path):
    (tmp_path / "b.html").write_text('<h1 id="top">b</h1><img src="data:image/png;base64,">')
    (tmp_path / "a.html").write_text(
        '<a href="b.html#top">b</a><a href="https://example.org">e</a>'
        '<a href="b.html#end">b</a><a href="c.html">c</a><script src="//example.org/x.js"></script>'
    )
    assert check.faults(tmp_path) == [
        "a.html: loads //example.org/x.js",
        "a.html: no heading b.html#end",
        "a.html: no page c.html",
    ]


def test_the_program_prints_the_path_of_a_page(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(docs, "_FOLDER", tmp_path)
    with pytest.raises(teeter.UnavailableError, match="make site"):
        docs.path()
    with pytest.raises(SystemExit) as ended:
        docs.main(["--path"])
    assert ended.value.code == 2 and "make site" in capsys.readouterr().err
    (tmp_path / "index.html").touch()
    docs.main(["--path"])
    assert Path(capsys.readouterr().out.strip()) == tmp_path / "index.html"
    with pytest.raises(teeter.UnavailableError, match="no page `castle`"):
        docs.path("castle")
