"""The golden runs have the same bits from Python as from Rust, WebAssembly and the page."""

import json
from pathlib import Path

import pytest

import teeter

GOLDEN = Path(__file__).parents[2] / "data/golden"
RUNS = json.loads((GOLDEN / "runs.json").read_text())
HASHES = {run["name"]: run["hash"] for run in json.loads((GOLDEN / "hashes.json").read_text())["runs"]}


def lines(name, steps):
    text = (GOLDEN / name).read_text().split("\n")[:steps] if name else []
    parsed = [json.loads(line) if line else {} for line in text]
    return parsed + [{}] * (steps - len(parsed))


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run["name"])
def test_a_golden_run_ends_in_its_state(run):
    scene = teeter.scenes.named(run["scene"])
    scene |= {key: run[key] for key in ("stiffness", "form", "springs") if key in run}
    params = run.get("params", {})
    if "commands" in run:
        game = teeter.Game(scene, **params)
        for command in lines(run["commands"], run["steps"]):
            game.step(command or None)
        assert game.hash() == HASHES[run["name"]]
        return
    world = teeter.World(scene, **params)
    for line in lines(run.get("inputs"), run["steps"]):
        world.step(**line)
    assert world.hash() == HASHES[run["name"]]
