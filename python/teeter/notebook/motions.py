"""Poses over time, for a view."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from teeter import POSE_STRIDE, Record
from teeter.errors import InputError

__all__ = ["checked", "interval", "of_record", "scene_of"]

FRAME = 1 / 60
# The most states of a view: half an hour of a game at ten a second.
MAX_STATES = 20_000


def interval(rate: float) -> float:
    """Returns the time from one state to the next, s.

    rate: states a second. Raises InputError unless it is between 0 and 60.
    """
    if not isinstance(rate, int | float) or not 0 < rate <= 60:
        raise InputError(f"`rate` is {rate!r}, expected more than 0 and at most 60 states a second", "rate")
    return 1 / rate


def scene_of(world: Any) -> Any:
    """Returns a scene that was given. Raises InputError where none was."""
    if world is None:
        raise InputError("`world` is missing, expected the world or scene of the poses", "world")
    return world


def checked(poses: ArrayLike, bodies: int) -> NDArray[np.float32]:
    """Returns poses of shape (states, bodies, 7) as float32.

    Raises InputError for another shape and for values that are not finite.
    """
    try:
        found = np.asarray(poses, np.float32)
    except (TypeError, ValueError):
        raise InputError("`motion` is no array of numbers", "motion") from None
    if found.ndim == 2:
        found = found[None]
    if found.shape[1:] != (bodies, POSE_STRIDE) or not 0 < len(found) <= MAX_STATES:
        expected = f"(states, {bodies}, {POSE_STRIDE}) with 1 to {MAX_STATES} states"
        raise InputError(f"`motion` has the shape {found.shape}, expected {expected}", "motion")
    if not np.isfinite(found).all():
        raise InputError("`motion` has values that are not finite", "motion")
    return np.ascontiguousarray(found)


def of_record(record: Record, rate: float) -> tuple[NDArray[np.float32], float]:
    """Returns the poses of a record, float32 of shape (states, n, 7), and the time between two, s.

    rate: states a second; at 1 or less, those that the record keeps of each second.
    """
    frames = max(1, round(interval(rate) / FRAME))
    game = record.game(0)
    if rate <= 1:
        kept = record.keyframes()
        return checked(np.concatenate([game.poses[None], kept]), len(game)), 1.0
    frames = max(frames, -(-record.frames // (MAX_STATES - 1)))
    states = [game.poses.astype(np.float32)]
    for index, command in enumerate(record.commands(), 1):
        game.step(command)
        if index % frames == 0:
            states.append(game.poses.astype(np.float32))
    return np.stack(states), frames * FRAME
