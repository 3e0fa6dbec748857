"""Executors: the rows of a study are the same on each, also where a worker is killed in the middle."""

import importlib.util
import json
import os
import threading
from concurrent import futures

import pytest
from study_samples import ALWAYS_DIES, DIES, DROP, NUMBER, program

import teeter
from teeter import study

pytest.importorskip("pyarrow")

SAMPLES = 14


@pytest.fixture(scope="module")
def serial():
    return study.run(DROP, samples=SAMPLES, seed=2)


def pools():
    yield "threads", lambda: "threads"
    yield "threads of one's own", lambda: study.Threads(3)
    yield "concurrent.futures", lambda: futures.ThreadPoolExecutor(2)


@pytest.mark.parametrize("pool", [pytest.param(make, id=name) for name, make in pools()])
@pytest.mark.parametrize("batch", [1, 5, None])
def test_threads_give_the_rows_of_serial(serial, pool, batch):
    executor = pool()
    assert study.run(DROP, samples=SAMPLES, seed=2, executor=executor, batch=batch).digest == serial.digest
    for end in ("close", "shutdown"):
        getattr(executor, end, lambda: None)()


def test_processes_take_functions_of_a_notebook_and_are_kept_by_their_owner(serial):
    factor = 2

    def measure(sample):
        return {"x": factor * sample.index, "process": os.getpid()}

    local = study.Study("local", measure, {"x": "int", "process": "int"})
    executor = study.Processes(2)
    try:
        result = study.run(local, samples=6, executor=executor, batch=1)
        assert result.table["x"].to_pylist() == [0, 2, 4, 6, 8, 10]
        assert os.getpid() not in result.table["process"].to_pylist()
        assert study.run(DROP, samples=SAMPLES, seed=2, executor=executor).digest == serial.digest
    finally:
        executor.close()


def test_a_study_that_cannot_be_sent_is_refused():
    lock = threading.Lock()
    stuck = study.Study("stuck", lambda sample: {"x": lock.locked()}, {"x": "bool"})
    assert study.run(stuck, samples=1, executor="threads").table["x"].to_pylist() == [False]
    with pytest.raises(teeter.StudyError, match="`stuck` cannot be sent to a worker"):
        study.run(stuck, samples=1, executor="processes", workers=1)


def test_a_process_killed_in_the_middle_changes_nothing(tmp_path):
    marker = tmp_path / "killed"
    params = {"marker": str(marker)}
    killed = study.run(DIES, tmp_path / "out", samples=SAMPLES, params=params, executor="processes", workers=2, batch=2)
    assert int(marker.read_text()) != os.getpid()
    assert killed.table["index"].to_pylist() == list(range(SAMPLES))
    assert killed.digest == study.run(DIES, samples=SAMPLES, params=params).digest


@pytest.mark.parametrize("workers, samples", [(1, 3), (2, 8)])
def test_a_worker_that_always_ends_is_named_and_the_other_rows_stay(tmp_path, workers, samples):
    with pytest.raises(teeter.WorkerError, match="samples 2 to 2 lost their worker 4 times") as caught:
        study.run(ALWAYS_DIES, tmp_path, samples=samples, executor="processes", workers=workers, batch=1)
    assert caught.value.field == "executor"
    rows = study.load(tmp_path, ALWAYS_DIES).table["x"].to_pylist()
    assert rows == [0, 1]


# Clusters, each in a process of its own as in a shell


@pytest.mark.parametrize("name", ["ray", "dask"])
def test_a_cluster_of_two_with_one_killed_gives_the_rows_of_serial(name, tmp_path):
    if importlib.util.find_spec({"ray": "ray", "dask": "distributed"}[name]) is None:
        pytest.skip(f"{name} is not installed")
    marker = tmp_path / "killed"
    params = {"marker": str(marker)}
    line = ["study_samples:DIES", "--out", tmp_path / "out", "--samples", SAMPLES, f"--set=marker={marker}"]
    done = program(*line, "--executor", name, "--workers=2", "--batch=2", "--quiet", "--json")
    assert done.returncode == 0, done.stderr
    killed = json.loads(done.stdout)
    assert int(marker.read_text()) != os.getpid()
    serial = study.run(DIES, samples=SAMPLES, params=params)
    assert killed["samples"] == SAMPLES
    assert killed["digest"] == serial.digest
    assert study.load(tmp_path / "out", DIES).digest == serial.digest


@pytest.mark.parametrize(
    "arguments, field",
    [
        ({"executor": "castle"}, "executor"),
        ({"executor": object()}, "executor"),
        ({"executor": "serial", "workers": 2}, "workers"),
        ({"executor": "threads", "workers": 0}, "workers"),
        ({"executor": "threads", "workers": 1.5}, "workers"),
        ({"executor": "processes", "address": "here"}, "address"),
        ({"executor": study.Serial(), "workers": 2}, "workers"),
    ],
)
def test_a_wrong_executor_is_refused(arguments, field):
    with pytest.raises(teeter.StudyError) as caught:
        study.run(NUMBER, samples=1, **arguments)
    assert caught.value.field == field


def test_a_cluster_that_is_not_reached_is_named(tmp_path):
    if importlib.util.find_spec("distributed") is None:
        pytest.skip("dask is not installed")
    done = program("loose", "--out", tmp_path, "--executor=dask", "--address=nowhere", "--quiet")
    assert done.returncode == 2
    assert done.stderr.startswith("teeter: `address` is nowhere, where no cluster is reached")
