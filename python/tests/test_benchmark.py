"""The benchmark: tasks against engines with known answers, and engines of one's own."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import teeter
from teeter import EngineError, UnavailableError, scenes
from teeter.benchmark import ENGINES, FRAME, ClockedEngine, Engine, Options, load_engine, markdown, run
from teeter.benchmark.__main__ import main as program
from teeter.benchmark.tasks import forces, labelled, tilt

ALONE = Options(towers=4, tilts=1, storeys=1, rows=2, pulls=1, seconds=0.5)


class Rigid:
    """A block on a floor by Coulomb's law alone: it stays, or slides with the acceleration left."""

    details = "one block, exact"

    def load(self, scene):
        self.scene = scene
        self.mass = scene["blocks"][0]["mass"]
        self.pose = np.array([*scene["blocks"][0]["pos"], 0.0, 0.0, 0.0, 1.0])
        self.velocity = np.zeros(2)
        self.gravity = (0.0, 0.0, -scene["gravity"])

    def set_gravity(self, gravity):
        self.gravity = gravity

    def step(self, seconds, forces):
        pull = np.array(forces.get(0, (0.0, 0.0, 0.0)))[:2] / self.mass + np.array(self.gravity[:2])
        resistance = self.scene["friction"] * -self.gravity[2]
        size = np.linalg.norm(pull)
        if size > resistance:
            self.velocity += seconds * pull * (1 - resistance / size)
        self.pose[:2] += seconds * self.velocity

    def poses(self):
        return self.pose[None]


class Frozen:
    """An engine in which nothing ever moves."""

    def load(self, scene):
        self.poses_ = teeter.World(scene, ramp=0.1).poses

    def set_gravity(self, gravity):
        pass

    def step(self, seconds, forces):
        pass

    def poses(self):
        return self.poses_


class Void(Frozen):
    """An engine in which all blocks fall through the floor."""

    def step(self, seconds, forces):
        self.poses_ = self.poses_ - [0, 0, 9.81 * seconds, 0, 0, 0, 0]


def clocked(engine):
    return ClockedEngine(engine, type(engine).__name__)


def test_the_pull_and_tilt_of_a_block_are_coulombs():
    scene = scenes.named("block")
    coulomb = scene["friction"] * scene["gravity"] * scene["blocks"][0]["mass"]
    # the reading is late by what the pull grows while the block slides 0.5 mm
    assert 0 <= forces.pull(clocked(Rigid()), scene, 0, 1.0) - coulomb < 0.02
    angle = tilt.collapse_angle(clocked(Rigid()), scene | {"tilt_az": 0.7})
    assert angle == pytest.approx(math.degrees(math.atan(scene["friction"])), abs=0.05)


def test_an_engine_in_which_nothing_moves_has_half_of_the_labels_right():
    figures = labelled.measure(clocked(Frozen()), Options(towers=20), lambda *_: None)
    unstable = sum(scene["label"] == "unstable" for scene in teeter.labelled_towers(20))
    assert figures["false_stable"] == unstable and figures["right"] == 20 - unstable
    assert figures["false_unstable"] == 0 and 0 < unstable < 20
    assert forces.pull(clocked(Frozen()), scenes.named("block"), 0, 0.3) == 0.3


def test_an_engine_in_which_all_falls_is_seen():
    rows = run([f"{__file__}:Void"], ["labelled", "tilt", "cards", "forces"], ALONE)
    by_task = {row.task: row.figures for row in rows}
    assert by_task["labelled"]["false_stable"] == 0
    assert by_task["tilt"]["fell_upright"] == 1
    assert by_task["cards"]["stands"] is False and by_task["forces"]["stands"] is False
    assert "fell" in markdown(rows)


def test_teeter_is_right_about_a_few_of_each():
    rows = run(["teeter"], ["labelled", "cards", "forces"], Options(towers=4, storeys=1, rows=2, pulls=2, seconds=0.5))
    figures = {row.task: row.figures for row in rows}
    assert figures["labelled"]["clear_right"] == figures["labelled"]["clear"]
    assert figures["cards"]["stands"] and figures["cards"]["creep_mm"] < 1e-3
    assert figures["forces"]["stands"] and figures["forces"]["mean_error_N"] < 0.02
    assert all(row.simulated_s > 0 and row.cpu_s > 0 for row in rows)
    scene, exact = min(teeter.tilted_towers(), key=lambda pair: len(pair[0]["blocks"]))
    assert tilt.collapse_angle(clocked(load_engine("teeter")), scene) == pytest.approx(exact, abs=0.3)


def test_mujoco_holds_a_low_tower_and_falls_from_another_scene_to_the_next():
    engine = clocked(load_engine("mujoco"))
    for scene in (scenes.config("(010)-(111)"), scenes.config("(111)-(010)")):
        engine.start(scene)
        engine.run_for(0.5)
        start = np.array([block["pos"] for block in scene["blocks"]])
        assert np.abs(engine.poses()[:, :3] - start).max() < 2e-3
    # whole steps of 2 ms do not make a frame, but follow the time
    assert engine.engine._data.time == pytest.approx(engine.engine._until, abs=1e-3)
    assert engine.simulated_s == pytest.approx(2 * (0.3 + 0.5))


def test_all_engines_are_of_the_protocol():
    for name in ("teeter", "mujoco", "mujoco-default"):
        engine = load_engine(name)
        assert isinstance(engine, Engine) and engine.details
    assert set(ENGINES) > {"rapier", "rapier-default"}


LINES = """
import json, sys
print(json.dumps({"details": "lines"}), flush=True)
n = 0
for line in sys.stdin:
    request = json.loads(line)
    if "gravity" in request:
        print("{}", flush=True)
        continue
    if "load" in request:
        n = len(request["load"]["blocks"])
        if n > 3:
            print(json.dumps({"error": "too many"}), flush=True)
            continue
    print(json.dumps({"poses": [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0] * n, "cpu_s": 7.0}), flush=True)
"""


def test_an_engine_in_another_process_is_asked_line_by_line(tmp_path, monkeypatch):
    fake = tmp_path / "lines.py"
    fake.write_text(f"#!{sys.executable}\n{LINES}")
    fake.chmod(0o755)
    monkeypatch.setenv("TEETER_RAPIER", str(fake))
    engine = clocked(load_engine("rapier"))
    engine.start(scenes.named("block"))
    assert engine.details == "Rapier, lines" and engine.poses().shape == (1, 7)
    assert engine.engine.cpu_seconds() == 7.0
    with pytest.raises(EngineError, match="too many"):
        engine.load(scenes.named("column"))
    engine.engine.close()
    monkeypatch.setenv("TEETER_RAPIER", str(tmp_path / "none"))
    with pytest.raises(EngineError):
        load_engine("rapier")


def test_the_example_of_an_own_engine_is_that_of_the_page():
    root = Path(__file__).parents[2]
    rows = run(["teeter", f"{root / 'python/examples/own_engine.py'}:SoftEngine"], ["forces"], ALONE)
    stiff, soft = (row.figures for row in rows)
    # ten times softer contacts give ten times as much
    assert soft["sink_mm"] == pytest.approx(10 * stiff["sink_mm"], rel=0.1)
    page = (root / "docs/benchmark.md").read_text()
    for line in (root / "python/examples/own_engine.py").read_text().splitlines():
        if line.strip().startswith(("self.world", "applied", "return")):
            assert line in page


class Partial:
    """Not an engine: two functions are missing."""

    def load(self, scene):
        pass

    def step(self, seconds, forces):
        pass


class Broken(Frozen):
    """An engine with poses of another shape."""

    def poses(self):
        return np.zeros((2, 3))


class Failing(Frozen):
    """An engine that fails."""

    def step(self, seconds, forces):
        raise ValueError("no\nsolution")


@pytest.mark.parametrize(
    "name", ["castle", "math:sin", "no.such.module:X", f"{__file__}:Nothing", f"{__file__}:Partial"]
)
def test_what_is_no_engine_is_named(name):
    with pytest.raises(EngineError) as caught:
        load_engine(name)
    assert caught.value.field == "engine" and "\n" not in str(caught.value)


def test_an_engine_whose_program_is_not_installed_says_what_to_do(monkeypatch):
    monkeypatch.delenv("TEETER_RAPIER", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(UnavailableError, match=r"rapier-lines.*docs/benchmark\.md"):
        load_engine("rapier")
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(UnavailableError, match="pip install"):
        load_engine("mujoco")


def test_warnings_of_mujoco_leave_no_file_behind(tmp_path, monkeypatch, caplog):
    monkeypatch.chdir(tmp_path)
    engine = load_engine("mujoco")
    engine.load(scenes.named("block"))
    engine.step(0.1, {0: [1e30, 0.0, 0.0]})
    assert "Nan, Inf or huge value" in caplog.text
    assert not list(tmp_path.iterdir())


def test_an_engine_that_breaks_its_protocol_is_named():
    with pytest.raises(EngineError, match="expected \\(1, 7\\)"):
        forces.pull(clocked(Broken()), scenes.named("block"), 0, 0.1)
    with pytest.raises(EngineError, match="fails in step: ValueError: no solution"):
        clocked(Failing()).start(scenes.named("block"))
    with pytest.raises(EngineError) as caught:
        run(["teeter"], ["dance"], ALONE)
    assert caught.value.field == "tasks"


def test_the_program_writes_a_table_and_the_figures(tmp_path, capsys):
    words = ["--engine", f"{__file__}:Frozen", "--tasks", "labelled,cards", "--towers", "3", "--storeys", "1"]
    assert program([*words, "--seconds", "1", "--out", str(tmp_path / "out"), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads((tmp_path / "out/benchmark.json").read_text())
    assert [row["task"] for row in printed["rows"]] == ["labelled", "cards"]
    assert (tmp_path / "out/benchmark.md").read_text().startswith("| engine | labels right |")
    assert program(["--engine", "castle"]) == 2
    assert capsys.readouterr().err.startswith("teeter.benchmark: `engine` is castle")


def test_batches_of_two_engines_are_compared():
    from teeter.benchmark import measure_throughput

    figures = measure_throughput(2, 1, rows=2, seconds=0.25)
    assert figures.ratio == pytest.approx(figures.teeter / figures.mujoco) and figures.blocks == 6
    assert figures.teeter_creep_mm < 1e-3 < 1e3 * figures.mujoco_creep_mm
    assert "mujoco.batch" in figures.markdown()
    with pytest.raises(EngineError):
        measure_throughput(1, 2)


def test_the_module_runs_as_a_program():
    environment = {"PYTHONPATH": str(Path(teeter.__file__).parents[1])}
    command = [sys.executable, "-m", "teeter.benchmark", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    assert done.returncode == 0 and "--towers" in done.stdout
    assert pytest.approx(1 / 60) == FRAME
