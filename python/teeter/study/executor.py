"""Executors: where the samples of a study are computed.

An executor has ``workers`` and four functions, see Executor. Serial, Threads, Processes, Dask and Ray are
such; an executor of ``concurrent.futures`` and a client of Dask are taken as they are. None of them changes
a row.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent import futures
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Any, Protocol

from teeter.errors import StudyError, WorkerError
from teeter.study.dask_executor import Dask
from teeter.study.ray_executor import Ray
from teeter.study.sample import MAX_WORKERS, checked_count, worker_count

__all__ = ["Dask", "Executor", "Futures", "Processes", "Serial", "Threads", "executor_of"]


class Executor(Protocol):
    """Runs calls in any order. ``workers``: number of calls that run side by side.

    ``is_remote``: True where calls run in processes of their own, each of which uses one core.
    """

    is_remote: bool

    @property
    def workers(self) -> int:
        """Number of calls that run side by side; it may change."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Begins a call and returns a handle of it, which can be a key of a dict."""

    def wait(self, handles: Sequence[Any]) -> Sequence[Any]:
        """Waits until at least one of the calls is done, and returns the handles of those that are."""

    def result(self, handle: Any) -> Any:
        """Result of a call that is done. Raises WorkerError where its worker ended before."""

    def close(self) -> None:
        """Ends the workers; calls that have not begun are cancelled."""


class Futures:
    """An executor of ``concurrent.futures``.

    pool: the executor; it is not shut down. workers: number of calls that it runs side by side. lost: exceptions
    of a call whose worker ended.
    """

    def __init__(
        self,
        pool: futures.Executor,
        workers: int,
        lost: tuple[type[BaseException], ...] = (futures.BrokenExecutor, futures.CancelledError),
        is_remote: bool = True,
    ) -> None:
        self.pool, self.lost, self.is_remote = pool, lost, is_remote
        self._workers = checked_count("workers", workers, 1, MAX_WORKERS)

    @property
    def workers(self) -> int:
        """Number of calls that run side by side."""
        return self._workers

    def submit(self, function: Callable[..., Any], *arguments: Any) -> futures.Future[Any]:
        """Begins a call."""
        return self.pool.submit(function, *arguments)

    def wait(self, handles: Sequence[futures.Future[Any]]) -> Sequence[futures.Future[Any]]:
        """Waits until at least one of the calls is done."""
        return list(futures.wait(handles, return_when=futures.FIRST_COMPLETED).done)

    def result(self, handle: futures.Future[Any]) -> Any:
        """Result of a call that is done."""
        try:
            return handle.result()
        except self.lost as error:
            raise WorkerError(f"a worker ended: {error or type(error).__name__}", "executor") from error

    def close(self) -> None:
        """Leaves the pool to its owner."""


class Serial:
    """Computes each sample in the calling thread."""

    workers = 1
    is_remote = False

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Notes a call; wait() makes it."""
        return _Call(function, arguments)

    def wait(self, handles: Sequence[Any]) -> Sequence[Any]:
        """The first of the calls."""
        return handles[:1]

    def result(self, handle: Any) -> Any:
        """Makes the call and returns its result."""
        return handle.function(*handle.arguments)

    def close(self) -> None:
        """Has nothing to end."""


class _Call:
    def __init__(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
        self.function, self.arguments = function, arguments


class Threads(Futures):
    """Threads of this process: the simulation runs without Python's lock. workers: one a core by default."""

    def __init__(self, workers: int | None = None) -> None:
        workers = worker_count(workers)
        super().__init__(futures.ThreadPoolExecutor(workers, "study"), workers, is_remote=False)

    def close(self) -> None:
        """Ends the threads."""
        self.pool.shutdown(cancel_futures=True)


class Processes(Futures):
    """Processes of this machine. workers: one a core by default.

    A worker that ends takes the pool with it, which is built again by the next call. Workers are started
    afresh and not forked: threads do not survive a fork. So a script that runs a study needs the line
    ``if __name__ == "__main__":``.
    """

    def __init__(self, workers: int | None = None) -> None:
        workers = worker_count(workers)
        super().__init__(self._pool(workers), workers)

    @staticmethod
    def _pool(workers: int) -> futures.ProcessPoolExecutor:
        return futures.ProcessPoolExecutor(workers, mp_context=get_context("spawn"))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> futures.Future[Any]:
        """Begins a call, in a new pool where the last one broke."""
        try:
            return super().submit(function, *arguments)
        except BrokenProcessPool:
            self.pool.shutdown(wait=False)
            self.pool = self._pool(self.workers)
            return super().submit(function, *arguments)

    def close(self) -> None:
        """Ends the processes."""
        self.pool.shutdown(cancel_futures=True)


def executor_of(executor: Any, workers: int | None = None, address: str | None = None) -> Executor:
    """Executor of an argument: its name, an Executor, or an executor or client of another package.

    workers, address: of the executors that are given by their names.

    Raises StudyError, or UnavailableError where a package is not installed.
    """
    if isinstance(executor, str):
        return _named(executor, workers, address)
    if workers is not None or address is not None:
        raise StudyError("`workers` and `address` are for executors given by name", "workers")
    if isinstance(executor, futures.Executor):
        is_remote = not isinstance(executor, futures.ThreadPoolExecutor)
        return Futures(executor, getattr(executor, "_max_workers", None) or worker_count(None), is_remote=is_remote)
    if hasattr(executor, "get_executor") and hasattr(executor, "nthreads"):
        return Dask(executor)
    if all(hasattr(executor, name) for name in ("workers", "submit", "wait", "result", "close", "is_remote")):
        found: Executor = executor
        return found
    raise StudyError(f"`executor` is {executor!r}, expected a name, an Executor, or one of another package", "executor")


def _named(name: str, workers: int | None, address: str | None) -> Executor:
    if address is not None and not isinstance(address, str):
        raise StudyError(f"`address` is of type {type(address).__name__}, expected a text", "address")
    if address is not None and name not in ("dask", "ray"):
        raise StudyError(f"`address` is {address!r}, expected none for executor `{name}`", "address")
    if workers is not None:
        workers = worker_count(workers)
    if name == "serial":
        if workers not in (None, 1):
            raise StudyError(f"`workers` is {workers}, expected 1 for executor `serial`", "workers")
        return Serial()
    if name == "threads":
        return Threads(workers)
    if name == "processes":
        return Processes(workers)
    if name == "dask":
        return Dask(address, workers)
    if name == "ray":
        return Ray(address, workers)
    raise StudyError(f"`executor` is {name!r}, expected serial, threads, processes, dask or ray", "executor")
