"""The package: its docstrings, types and program."""

import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import teeter

ROOT = Path(__file__).parents[2]


def public():
    for name in teeter.__all__:
        item = getattr(teeter, name)
        if callable(item):
            yield name, item


@pytest.mark.parametrize("name, item", list(public()), ids=lambda value: value if isinstance(value, str) else "")
def test_everything_public_is_documented(name, item):
    assert item.__doc__, name
    if inspect.isclass(item):
        for member, value in vars(item).items():
            if not member.startswith("_") and (callable(value) or inspect.isgetsetdescriptor(value)):
                assert value.__doc__ or not item.__module__.startswith("builtins"), f"{name}.{member}"


@pytest.mark.parametrize("name", ["World", "WorldBatch", "Game", "Record", "Opponent"])
def test_methods_say_what_they_do(name):
    for member, value in vars(getattr(teeter, name)).items():
        if not member.startswith("_"):
            assert value.__doc__, f"{name}.{member}"


def test_the_stub_has_exactly_what_the_module_has():
    stub = (ROOT / "python/teeter/_teeter.pyi").read_text()
    from teeter import _teeter

    for name, item in vars(_teeter).items():
        if name.startswith("__") or not (inspect.isclass(item) or callable(item)):
            continue
        if not inspect.isclass(item):
            assert re.search(rf"^def {name}\(", stub, re.MULTILINE), name
            continue
        body = re.search(rf"^class {name}:\n((?:    .*\n|\n)+)", stub, re.MULTILINE)[1]
        declared = set(re.findall(r"^    def (\w+)\(", body, re.MULTILINE))
        members = {member for member in vars(item) if not member.startswith("_")}
        assert {member for member in declared if not member.startswith("_")} == members, name


def run(*arguments):
    command = [sys.executable, "-m", "teeter", *arguments]
    environment = {"PYTHONPATH": str(Path(teeter.__file__).parents[1])}
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)


def test_the_program_gives_the_hash_that_the_package_gives():
    done = run("run", "column", "--seconds", "0.5", "--json")
    world = teeter.World("column")
    world.run_for(0.5)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["hash"] == world.hash()


def test_the_program_ends_with_the_codes_of_the_shell():
    assert run("--version").stdout.startswith("teeter ")
    bad = run("run", "castle")
    assert bad.returncode == 2 and bad.stderr.startswith("teeter: there is no scene `castle`")


def test_memory_stays_flat_over_many_worlds():
    resource = pytest.importorskip("resource")

    def build(count):
        for _ in range(count):
            # a world that begins without weight need not settle
            world = teeter.World("block", ramp=0.1)
            world.step()
            world.snapshot()
            world.contacts()

    build(300)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    build(3000)
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    # A world of one block is some kilobytes: with a leak of one in ten it would be 1 MB.
    assert grown < 500, f"{grown} kB"
