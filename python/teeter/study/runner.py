"""Run of a study: samples in batches through an executor, rows into a folder as they come."""

from __future__ import annotations

import functools
import math
import os
import pickle
import tempfile
import time
from collections import Counter, deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from teeter.errors import StudyError, WorkerError
from teeter.study.executor import Executor, executor_of
from teeter.study.extra import needed
from teeter.study.folder import Folder, manifest_of, table_digest
from teeter.study.interval import summary
from teeter.study.plot import drawn, save
from teeter.study.sample import MAX_SAMPLES, Plan, Study, checked_count
from teeter.study.shipped import study_of

__all__ = ["Result", "load", "run"]

#: Time that a batch is to take, s: from the first, for a call through Ray costs 1 ms, up to the second
#: where a study takes long, so that there are not too many files.
MIN_BATCH, MAX_BATCH = 2.0, 120.0
#: Share of the time that has gone by which a batch is to take.
SHARE = 0.02
#: Times that a batch is sent again after the loss of its worker.
RETRIES = 3


@dataclass(frozen=True)
class Result:
    """Results of a study. table: a row a sample in order of the index, a table of Arrow. out: their folder."""

    plan: Plan
    table: Any
    out: Path | None

    @property
    def digest(self) -> str:
        """SHA-256 of the values of the table: equal for any executor, batches and restarts."""
        return table_digest(self.table)

    def summary(self) -> list[dict[str, Any]]:
        """Shares and means of each combination of values with their intervals of 95 %, see teeter.study.summary."""
        columns = [name for name, kind in self.plan.study.columns.items() if kind in ("bool", "int", "float")]
        return summary(self.table, self.plan.swept, columns)

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draws the results and returns a figure of Matplotlib. path: file to write it to as well."""
        figure = drawn(self.plan.study, self.table, self.plan.swept)
        if path is not None:
            save(figure, path)
        return figure


def run(
    study: str | Study,
    out: str | os.PathLike[str] | None = None,
    *,
    samples: int | None = None,
    seed: int = 0,
    params: Mapping[str, Any] | None = None,
    executor: Any = "serial",
    workers: int | None = None,
    address: str | None = None,
    batch: int | None = None,
    progress: bool = False,
) -> Result:
    """Runs a study and returns its results. Samples that the folder has already are not computed again.

    study: the name of one that comes with the package, or a Study. out: folder of the results, made where it
    is absent; None for results in memory alone. samples: their number; ten of each combination of
    values by default. seed: master seed. params: values that replace the defaults of the study; a list is swept.
    executor: "serial", "threads", "processes", "dask", "ray", an Executor, an executor of
    ``concurrent.futures`` or a client of Dask. workers: their number, one a core by default. address: of a
    cluster of Dask or Ray. batch: samples a call; by default as many as take 2 s, more in a long study.
    progress: True for a bar on the standard error. Neither of the last five changes a row.

    Raises StudyError for wrong arguments, a folder of another study, a damaged one, or a sample that fails;
    WorkerError where a batch lost its worker four times; UnavailableError where a package is not installed.
    """
    plan = Plan(study_of(study), seed, params)
    number = 10 * len(plan.combinations) if samples is None else checked_count("samples", samples, 1, MAX_SAMPLES)
    if batch is not None:
        checked_count("batch", batch, 1, MAX_SAMPLES)
    with _opened(out, plan) as folder:
        missing = folder.missing(number)
        if missing:
            chosen = executor_of(executor, workers, address)
            try:
                _compute(folder, _Batches(missing, chosen, batch), chosen, number, progress)
            finally:
                # An executor that was handed in is its owner's to close.
                if isinstance(executor, str):
                    chosen.close()
        return Result(plan, folder.table(number), None if out is None else Path(out))


def load(out: str | os.PathLike[str], study: str | Study | None = None) -> Result:
    """Results that a folder has, up to the first sample that is not there, also while a run is writing to it.

    study: where it is none that comes with the package. Raises StudyError.
    """
    manifest = manifest_of(out)
    plan = Plan(study_of(study or manifest.get("study", "")), manifest.get("seed", 0), manifest["params"])
    folder = Folder(out, plan, writes=False)
    return Result(plan, folder.table(folder.missing(MAX_SAMPLES)[0].start), Path(out))


@contextmanager
def _opened(out: str | os.PathLike[str] | None, plan: Plan) -> Iterator[Folder]:
    """Folder of results, a temporary one where none is given."""
    with tempfile.TemporaryDirectory(prefix="study-") if out is None else nullcontext(out) as path:
        folder = Folder(path, plan)
        try:
            yield folder
        finally:
            folder.close()


class _Batches:
    """Batches of the samples that are missing; their size follows from the time that samples took."""

    def __init__(self, missing: Sequence[range], executor: Executor, size: int | None) -> None:
        self._missing, self._executor, self._size = deque(missing), executor, size
        self._left = sum(len(part) for part in missing)
        self._begun = time.monotonic()
        self._samples, self._seconds, self._last = 0, 0.0, 1

    def next(self) -> range | None:
        """Next batch, or None where none is left."""
        if not self._missing:
            return None
        part = self._missing.popleft()
        size = min(len(part), self._size or self._fitting())
        if size < len(part):
            self._missing.appendleft(range(part.start + size, part.stop))
        self._left -= size
        return range(part.start, part.start + size)

    def took(self, samples: int, seconds: float) -> None:
        """Notes the time that samples took in a worker."""
        self._samples += samples
        self._seconds += seconds

    def _fitting(self) -> int:
        """Number of samples that takes the time of a batch, at most four times the last."""
        if not self._samples:
            return 1
        wanted = min(max(SHARE * (time.monotonic() - self._begun), MIN_BATCH), MAX_BATCH)
        size = wanted / max(self._seconds / self._samples, 1e-7)
        # The last batches are to end together.
        self._last = max(1, min(int(size), 4 * self._last, math.ceil(self._left / (2 * self._executor.workers))))
        return self._last


def _compute(folder: Folder, batches: _Batches, executor: Executor, samples: int, progress: bool) -> None:
    """Computes the batches and adds each to the folder as soon as it is there."""
    missing = sum(len(part) for part in folder.missing(samples))
    with _bar(folder.plan, samples, samples - missing, progress) as bar:
        for start, rows in _rows(folder.plan, batches, executor):
            folder.append(start, rows)
            bar.update(len(rows))


def _rows(plan: Plan, batches: _Batches, executor: Executor) -> Iterator[tuple[int, list[list[Any]]]]:
    """Rows of the batches in the order in which they are done. At most two batches a worker are out at a time."""
    payload = _payload(plan) if executor.is_remote else plan
    running: dict[Any, range] = {}
    again: deque[range] = deque()
    losses: Counter[range] = Counter()
    while True:
        while len(running) < 2 * executor.workers:
            batch = _next(again, losses, batches, bool(running))
            if batch is None:
                break
            running[executor.submit(measure_batch, payload, batch.start, batch.stop)] = batch
            if losses[batch] > 1:
                break
        if not running:
            return
        for handle in executor.wait(list(running)):
            batch = running.pop(handle)
            try:
                done: _Done = executor.result(handle)
            except WorkerError as error:
                losses[batch] += 1
                if losses[batch] > RETRIES:
                    lost = f"samples {batch.start} to {batch.stop - 1} lost their worker {losses[batch]} times"
                    raise WorkerError(f"{lost}: {error}", "executor") from error
                again.append(batch)
                continue
            batches.took(len(done.rows), done.seconds)
            if done.rows:
                yield batch.start, done.rows
            if done.error is not None:
                raise done.error


def _next(again: deque[range], losses: Counter[range], batches: _Batches, is_busy: bool) -> range | None:
    """Next batch to be sent, or None where there is none now.

    A pool of processes ends as a whole, so all batches that are out are lost with the one that is to blame. One that
    was lost twice is therefore sent alone.
    """
    if not again:
        return batches.next()
    return None if is_busy and losses[again[0]] > 1 else again.popleft()


@dataclass(frozen=True)
class _Done:
    rows: list[list[Any]]
    seconds: float
    error: StudyError | None


def measure_batch(payload: Plan | bytes, start: int, stop: int) -> _Done:
    """Rows of the samples from ``start`` up to ``stop``, in a worker; up to the first that fails."""
    plan = _sent(payload) if isinstance(payload, bytes) else payload
    begun, rows = time.perf_counter(), []
    for index in range(start, stop):
        try:
            rows.append(plan.row(index))
        except StudyError as error:
            return _Done(rows, time.perf_counter() - begun, error)
    return _Done(rows, time.perf_counter() - begun, None)


def _payload(plan: Plan) -> bytes:
    """Bytes of a plan, with functions of a notebook as they are."""
    try:
        payload: bytes = needed("cloudpickle", "study").dumps(plan)
    except (TypeError, AttributeError, pickle.PicklingError) as error:
        raise StudyError(f"study `{plan.study.name}` cannot be sent to a worker: {error}", "measure") from error
    return payload


@functools.lru_cache(maxsize=4)
def _sent(payload: bytes) -> Plan:
    """Plan in a process of its own."""
    # A worker has one core, and rayon's pool would have threads on all of them.
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    plan = needed("cloudpickle", "study").loads(payload)
    assert isinstance(plan, Plan)
    return plan


def _bar(plan: Plan, samples: int, done: int, progress: bool) -> Any:
    """Progress bar of tqdm, on the standard error."""
    bar = needed("tqdm", "study").tqdm
    return bar(total=samples, initial=done, unit="sample", desc=plan.study.name, disable=not progress, smoothing=0.05)
