"""Snippets of the documents: Python runs as written, and the shell prints what the page shows.

The steps of a page run in their order in one folder, so a snippet may read the file that a command
before it wrote, and use names of the snippets before it.
"""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

import teeter

ROOT = Path(__file__).parents[2]
PAGES = [
    "README.md",
    "python/docs/index.md",
    *sorted(str(path.relative_to(ROOT)) for path in ROOT.glob("docs/**/*.md")),
]
# Commands that run: these, which take a second, and those whose output is shown, but for one of 400
# towers. Of the others, the options are checked.
QUICK = ("scene", "run")
LONG = ("score",)
# Longest time of a step on a busy machine, s.
TIMEOUT = 300


def blocks(page):
    """Fenced blocks of a page: language, line and text of each, and True for one that directly follows another."""
    text, end = (ROOT / page).read_text(), -1
    for match in re.finditer(r"^```(\w*)[^\n]*\n(.*?)^```\n", text, re.DOTALL | re.MULTILINE):
        yield match[1], text[: match.start()].count("\n") + 1, match[2], not text[end : match.start()].strip()
        end = match.end()


def commands(language, text):
    """Commands of a block that call the program, each with the lines that it prints; None where none are shown."""
    mark = {"sh": "", "text": "$ "}.get(language)
    if mark is None:
        return
    for part in re.split(rf"^{re.escape(mark)}(?=teeter )", text, flags=re.MULTILINE)[1:]:
        command, *printed = part.rstrip().split("\n")
        # A remark stands behind some spaces.
        command = re.split(r"\s{3,}|\s+#", command)[0]
        shown = [line for line in printed if line.strip()] if mark else []
        yield command, shown or None


def steps(page):
    """Steps of a page: the line, `python` or a command, the snippet if any, and what it prints, if it is shown.

    A block of text that directly follows a snippet, or the same in Rust, is what it prints.
    """
    found, ran = [], False
    for language, line, text, follows in blocks(page):
        if language == "python":
            found.append((line, "python", text, None))
        elif language == "text" and ran and follows and not text.startswith("$ "):
            found[-1] = (*found[-1][:3], text.split("\n"))
        found += [(line, command, None, printed) for command, printed in commands(language, text)]
        ran = language == "python" or (language == "rust" and ran and follows)
    return found


ALL = {page: list(steps(page)) for page in PAGES}


@pytest.fixture
def program(tmp_path_factory):
    """Environment in which `teeter` is the program of the package."""
    folder = tmp_path_factory.mktemp("bin")
    (folder / "teeter").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m teeter "$@"\n')
    (folder / "teeter").chmod(0o755)
    paths = {"PATH": f"{folder}:{os.environ['PATH']}", "PYTHONPATH": str(Path(teeter.__file__).parents[1])}
    return {**os.environ, **paths}


def matches(printed, shown):
    """True where lines are as shown: `...` stands for any text, and times of a processor differ."""
    pattern = ".*".join(re.escape(part) for part in "\n".join(line.strip() for line in shown).split("..."))
    pattern = re.sub(r"[\d\\.]+\\ s\\ of\\ the\\ processor", r"\\S+ s of the processor", pattern)
    lines = "\n".join(line.strip() for line in printed.split("\n"))
    return re.match(pattern, lines, re.DOTALL) is not None


def printed_by_python(code, name, names):
    """Text that a snippet prints, which may use names of those before it."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(code, name, "exec"), names)
    return out.getvalue()


def printed_by_shell(command, name, environment):
    """Text that a command prints. 1 is the code of one that finds a difference."""
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=TIMEOUT, env=environment)
    assert done.returncode in (0, 1), f"{name}: {command}: {done.stderr}"
    return done.stdout


@pytest.mark.parametrize("page", [page for page in PAGES if ALL[page]])
def test_the_snippets_of_a_page_run_as_written(page, tmp_path, monkeypatch, program):
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "snippet"}
    for line, command, code, shown in ALL[page]:
        name = f"{page}:{line}"
        if command == "python":
            printed = printed_by_python(code, name, names)
        elif command.split()[1] not in LONG and (shown or command.split()[1] in QUICK):
            printed = printed_by_shell(command, name, program)
        else:
            continue
        assert shown is None or matches(printed, shown), f"{name}: {command}:\n{printed}"


@cache
def known_options(command):
    help_of = [sys.executable, "-m", "teeter", *command.split(), "--help"]
    done = subprocess.run(help_of, capture_output=True, text=True, check=True)
    return set(re.findall(r"--[a-z][a-z-]*", done.stdout))


@pytest.mark.parametrize("page", [page for page in PAGES if any(step[1] != "python" for step in ALL[page])])
def test_the_options_of_a_command_exist(page, monkeypatch, program):
    monkeypatch.setenv("PYTHONPATH", program["PYTHONPATH"])
    for line, command, *_ in ALL[page]:
        for name, arguments in re.findall(r"teeter ((?:scene |dissertation )?\w+)([^|>]*)", command):
            options = set(re.findall(r"--[a-z][a-z-]*", arguments))
            assert not options or options <= known_options(name), f"{page}:{line}: {command}"


@pytest.mark.parametrize("page", ["README.md", "docs/scene-format.md"])
def test_a_scene_of_a_page_makes_a_world(page):
    scenes = [json.loads(text) for language, _, text, _ in blocks(page) if language == "json"]
    assert scenes
    for scene in scenes:
        assert len(teeter.World(scene)) == len(scene["blocks"])


def test_the_inputs_of_a_page_are_inputs_of_a_run(tmp_path, program):
    (lines,) = [text for language, _, text, _ in blocks("docs/inputs.md") if language == "json"]
    (tmp_path / "inputs.jsonl").write_text(lines)
    command = f"teeter run tower --seconds 4.5 --inputs {tmp_path}/inputs.jsonl --json"
    ran = json.loads(printed_by_shell(command, "docs/inputs.md", program))
    without = json.loads(printed_by_shell("teeter run tower --seconds 4.5 --json", "docs/inputs.md", program))
    assert ran["hash"] != without["hash"]


def test_text_that_differs_from_what_is_shown_is_found():
    shown = ["stands", "  ...", "  time   10.00 s simulated in 0.37 s of the processor", "hash  12ab"]
    printed = "stands\n blocks 3\n time   10.00 s simulated in 4.2 s of the processor\nhash  12ab\n"
    assert matches(printed, shown)
    assert not matches(printed.replace("12ab", "12ac"), shown)
    assert not matches(printed.replace("10.00", "9.00"), shown)


def test_every_block_of_rust_is_an_example_of_the_library():
    tested = (ROOT / "crates/teeter/src/lib.rs").read_text()
    for page in PAGES:
        if re.search(r"^```rust$", (ROOT / page).read_text(), re.MULTILINE):
            assert f'"../../../{page}"' in tested, page
