"""Ray, for studies on more than one machine."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from typing import Any

from teeter.errors import StudyError, WorkerError
from teeter.study.extra import needed
from teeter.study.sample import worker_count

__all__ = ["Ray"]

#: Memory for the objects of a cluster on this machine, bytes: rows are small.
OBJECT_MEMORY = 100 * 2**20


class Ray:
    """Workers of Ray. It needs ``pip install 'teeter[ray]'``.

    address: of a cluster, "auto" for the one of this machine, or None to start one, unless Ray runs already.
    workers: cores of the cluster that is started, one a core of this machine by default.

    A call costs about 1 ms and the start 10 s, so batches are to take seconds.
    """

    is_remote = True

    def __init__(self, address: str | None = None, workers: int | None = None) -> None:
        self._ray: Any = needed("ray", "ray")
        self._is_owner = not self._ray.is_initialized()
        if not self._is_owner and (address is not None or workers is not None):
            raise StudyError("`address` or `workers` is given, expected none of them where Ray runs already", "address")
        if self._is_owner:
            options = _options(address, workers)
            try:
                self._ray.init(log_to_driver=False, logging_level="warning", **options)
            except (OSError, ValueError) as error:
                line = " ".join(str(error).split())
                raise StudyError(f"`address` is {address}, where no cluster is reached: {line}", "address") from error
        # The study itself sends again what was lost, so that each executor counts losses alike.
        self._call = self._ray.remote(max_retries=0)(_call)

    @property
    def workers(self) -> int:
        """Number of cores of all machines that are there now."""
        return max(1, int(self._ray.cluster_resources().get("CPU", 1)))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Begins a call."""
        return self._call.remote(function, *arguments)

    def wait(self, handles: Sequence[Any]) -> Sequence[Any]:
        """Waits until a call is done. One at a time is fetched, so the rows of a study never pile up here."""
        done: list[Any] = self._ray.wait(list(handles), num_returns=1)[0]
        return done

    def result(self, handle: Any) -> Any:
        """Result of a call that is done."""
        errors = self._ray.exceptions
        try:
            return self._ray.get(handle)
        except errors.RayTaskError:
            raise
        except errors.RayError as error:
            reason = str(error).strip().splitlines() or [type(error).__name__]
            raise WorkerError(f"a worker ended: {reason[0]}", "executor") from error

    def close(self) -> None:
        """Ends Ray where it was started here."""
        if self._is_owner:
            self._ray.shutdown()


def _options(address: str | None, workers: int | None) -> dict[str, Any]:
    """Options of Ray's start."""
    if address is not None and workers is not None:
        raise StudyError("`workers` is given, expected none where a cluster is joined", "workers")
    if address is not None:
        return {"address": address}
    # Ray reports its use over the network by default.
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    options: dict[str, Any] = {
        "address": "local",
        "include_dashboard": False,
        "object_store_memory": OBJECT_MEMORY,
        # Workers import what this process can import.
        "runtime_env": {"env_vars": {"PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))}},
    }
    if workers is not None:
        options["num_cpus"] = worker_count(workers)
    return options


def _call(function: Callable[..., Any], *arguments: Any) -> Any:
    return function(*arguments)
