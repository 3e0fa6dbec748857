"""Dask, for studies on the workers of a cluster of Dask."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError
from typing import Any

from teeter.errors import StudyError, WorkerError
from teeter.study.extra import needed
from teeter.study.sample import worker_count

__all__ = ["Dask"]


class Dask:
    """Workers of Dask. It needs ``pip install 'teeter[dask]'``.

    address: of a scheduler; a client; or None for processes of this machine. workers: of this machine, one a
    core by default.

    Calls go to the client itself: its executor of ``concurrent.futures`` fails where the worker of a call that
    is done ends before the result is fetched. The client computes such a call again.
    """

    is_remote = True

    def __init__(self, address: Any = None, workers: int | None = None) -> None:
        self._distributed: Any = needed("distributed", "dask")
        self._owned: list[Any] = []
        if address is None:
            workers = worker_count(workers)
            # A port for the dashboard may be taken, and its pages need further packages.
            address = self._distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
            self._owned = [address]
        self.client = address
        if not isinstance(address, self._distributed.Client):
            try:
                self.client = self._distributed.Client(address)
            except (OSError, ValueError) as error:
                line = " ".join(str(error).split())
                raise StudyError(f"`address` is {address}, where no cluster is reached: {line}", "address") from error
            self._owned.insert(0, self.client)

    @property
    def workers(self) -> int:
        """Number of threads of all workers that are there now."""
        return max(1, int(sum(self.client.nthreads().values())))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Begins a call."""
        return self.client.submit(function, *arguments, pure=False)

    def wait(self, handles: Sequence[Any]) -> Sequence[Any]:
        """Waits until at least one of the calls is done."""
        try:
            return list(self._distributed.wait(list(handles), return_when="FIRST_COMPLETED").done)
        except CancelledError:
            return [handle for handle in handles if handle.status == "cancelled"]

    def result(self, handle: Any) -> Any:
        """Result of a call that is done."""
        try:
            return handle.result()
        except (self._distributed.scheduler.KilledWorker, CancelledError) as error:
            raise WorkerError(f"a worker ended: {error or type(error).__name__}", "executor") from error

    def close(self) -> None:
        """Closes the client and the workers that were started here."""
        for owned in self._owned:
            owned.close()
