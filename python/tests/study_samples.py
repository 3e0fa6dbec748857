"""Studies for the tests, in a module that workers can import, and the program that runs them."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import teeter
from teeter.study import Study


def drop(sample):
    """Bits of a small world after some frames, and numbers of every kind."""
    rng = sample.rng()
    world = teeter.World(teeter.scenes.tower(rows=3, seed=sample.seed, friction=sample.params["friction"]), ramp=0.1)
    world.set_velocity(int(rng.integers(9)), rng.uniform(-0.5, 0.5, 3))
    for _ in range(4):
        world.step()
    return {
        "hash": world.hash(),
        "top": world.poses[:, 2].max(),
        "count": len(world),
        "fast": world.velocities.max() > 0.1,
        "path": world.poses[0, :3] if sample.index % 3 else None,
    }


DROP = Study(
    "drop",
    drop,
    {"hash": "str", "top": "float", "count": "int", "fast": "bool", "path": "floats"},
    {"friction": (0.3, 0.5), "marker": ""},
)


def dies(sample):
    """The worker of sample 5 is killed once: where there is no marker yet."""
    marker = Path(sample.params["marker"])
    if sample.index == 5 and not marker.exists():
        marker.write_text(str(os.getpid()))
        os.kill(os.getpid(), signal.SIGKILL)
    return drop(sample)


DIES = Study("dies", dies, DROP.columns, DROP.params)


def always_dies(sample):
    """The worker of sample 2 is killed every time."""
    if sample.index == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"x": sample.index}


ALWAYS_DIES = Study("always-dies", always_dies, {"x": "int"})


def fails(sample):
    """Sample 7 fails while there is no marker."""
    if sample.index == 7 and not Path(sample.params["marker"]).exists():
        raise teeter.SceneError("`blocks[3].mass` is -1,\nexpected more than 0", "mass")
    return drop(sample)


FAILS = Study("fails", fails, DROP.columns, DROP.params)


def stops(sample):
    """Sample 3 is stopped from the keyboard."""
    if sample.index == 3:
        raise KeyboardInterrupt
    return {"x": sample.index}


STOPS = Study("stops", stops, {"x": "int"})


def number(sample):
    """A number of the seed alone: as cheap as a sample can be."""
    return {"x": float(sample.rng().normal()), "even": sample.index % 2 == 0}


NUMBER = Study("number", number, {"x": "float", "even": "bool"}, {"a": (1, 2, 3), "b": 0.5})


def program(*arguments):
    """Runs ``python -m teeter.study`` to its end."""
    folders = os.pathsep.join([str(Path(teeter.__file__).parents[1]), str(Path(__file__).parent)])
    environment = {**os.environ, "PYTHONPATH": folders}
    command = [sys.executable, "-m", "teeter.study", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=500, env=environment)
