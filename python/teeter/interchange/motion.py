"""Motion of blocks over time: a world that runs on, or a recorded game that is played again."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teeter import Record, World
from teeter.errors import InputError

__all__ = ["Motion", "State"]

MAX_SECONDS = 86_400.0


@dataclass(frozen=True, slots=True)
class State:
    """State of all blocks at a time, s: poses of shape (n, 7), velocities of shape (n, 6), and for
    each block whether it sleeps or was frozen.
    """

    time: float
    poses: NDArray[np.float64]
    velocities: NDArray[np.float64]
    asleep: NDArray[np.bool_]
    quarantined: NDArray[np.bool_]


class Motion:
    """States of blocks at the start of a motion, and after every few frames of it.

    source: a World, which stays as it is: a copy runs on without input; a Record, which is played
    again; or a scene as World takes it. seconds: length of the motion, None for all of a record.
    every: frames from one state to the next. Raises InputError, or SceneError for a scene.
    """

    def __init__(self, source: Any, seconds: float | None = None, every: int = 1) -> None:
        if seconds is not None and not 0.0 <= seconds <= MAX_SECONDS:
            raise InputError(f"`seconds` is {seconds}, expected 0 to {MAX_SECONDS:g}", "seconds")
        if isinstance(every, bool) or not isinstance(every, int) or every < 1:
            raise InputError(f"`every` is {every}, expected an integer of 1 or more", "every")
        self.source = source if isinstance(source, (World, Record)) else World(source)
        self.seconds = seconds
        self.every = every
        start = self.source if isinstance(self.source, World) else self.source.game(0).world
        self.scene = start.scene
        self.ids: list[int] = start.ids
        self.sizes = start.sizes
        self.frame: float = start.frame
        self.substep: float = start.substep

    @property
    def frames(self) -> int:
        """Number of frames."""
        if isinstance(self.source, Record):
            whole = self.source.frames
            return whole if self.seconds is None else min(whole, round(self.seconds / self.frame))
        return round((10.0 if self.seconds is None else self.seconds) / self.frame)

    def __iter__(self) -> Iterator[State]:
        if isinstance(self.source, Record):
            game = self.source.game(0)
            commands = self.source.commands()
            yield _state(game.world)
            for i in range(1, self.frames + 1):
                game.step(commands[i - 1])
                if i % self.every == 0:
                    yield _state(game.world)
            return
        world = self.source.clone()
        yield _state(world)
        for i in range(1, self.frames + 1):
            world.step()
            if i % self.every == 0:
                yield _state(world)


def _state(world: World) -> State:
    frozen = np.zeros(len(world), dtype=np.bool_)
    frozen[world.quarantined] = True
    return State(world.time, world.poses, world.velocities, world.asleep, frozen)
