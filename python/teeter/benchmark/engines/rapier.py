"""Rapier, in a process of its own: the program `rapier-lines` of benches/peers.

Rapier has no package for Python. `cargo build --release` builds the program, see docs/benchmark.md;
TEETER_RAPIER is its path where it is not on the search path.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from teeter.benchmark.engine import Floats, Scene
from teeter.errors import EngineError, UnavailableError

__all__ = ["DefaultRapier", "RapierEngine", "TunedRapier"]

PROGRAM = "rapier-lines"
VARIABLE = "TEETER_RAPIER"


def _program() -> str:
    path = os.environ.get(VARIABLE) or shutil.which(PROGRAM)
    if path is None:
        message = f"engine rapier needs the program {PROGRAM}, on the search path or in {VARIABLE}"
        raise UnavailableError(f"{message}: see docs/benchmark.md", "engine")
    return path


class RapierEngine:
    """Rapier with one of the settings of benches/peers: a request a line, and an answer a line."""

    setting = "best"

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [_program(), self.setting], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
        )
        self.details = f"Rapier, {self._read()['details']}"
        self._poses: Floats = np.zeros((0, 7))
        self._cpu_s = 0.0

    def load(self, scene: Scene) -> None:
        """Sends the scene."""
        self._take(self._ask({"load": scene}))

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Sets gravity, m/s²."""
        self._ask({"gravity": [float(part) for part in gravity]})

    def step(self, seconds: float, forces: Mapping[int, Sequence[float]]) -> None:
        """Advances by the steps of the setting."""
        applied = [[body, *(float(part) for part in force)] for body, force in forces.items()]
        self._take(self._ask({"step": {"seconds": seconds, "forces": applied}}))

    def poses(self) -> Floats:
        """Poses after the last step, float64 of shape (n, 7)."""
        return self._poses

    def cpu_seconds(self) -> float:
        """CPU time of the steps in the program so far, s."""
        return self._cpu_s

    def close(self) -> None:
        """Ends the program."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        self._process.wait(timeout=10)

    def __del__(self) -> None:
        if hasattr(self, "_process") and self._process.poll() is None:
            self.close()

    def _take(self, answer: dict[str, Any]) -> None:
        self._poses = np.array(answer["poses"], dtype=np.float64).reshape(-1, 7)
        self._cpu_s = float(answer["cpu_s"])

    def _ask(self, request: dict[str, Any]) -> dict[str, Any]:
        if self._process.stdin is None:
            raise EngineError(f"{PROGRAM} has no input", "engine")
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        return self._read()

    def _read(self) -> dict[str, Any]:
        line = self._process.stdout.readline() if self._process.stdout else ""
        if not line:
            raise EngineError(f"{PROGRAM} ended with code {self._process.wait(timeout=10)}", "engine")
        answer: dict[str, Any] = json.loads(line)
        if "error" in answer:
            raise EngineError(f"{PROGRAM}: {answer['error']}", "engine")
        return answer


class TunedRapier(RapierEngine):
    """Rapier with the settings that hold a tower at a moderate cost."""


class DefaultRapier(RapierEngine):
    """Rapier with its defaults."""

    setting = "default"
