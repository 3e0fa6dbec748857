"""What all environments share: ranges of domains, observations, pictures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from teeter import Game
from teeter.errors import InputError
from teeter.scenes import tower

#: Ranges that each episode draws from, uniformly.
DOMAIN: dict[str, tuple[float, float]] = {"friction": (0.3, 0.5), "height_sd": (8e-5, 1.2e-4)}

#: Parts of an observation that can be left out or added.
PARTS = ("poses", "cells", "forces", "image")
IMAGE_SIZE = (96, 128)
#: Bound of positions, m, in the space of observations.
FAR = 10.0


def draw_scene(rng: np.random.Generator, rows: int, domain: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
    """Tower of an episode: its seed and the options of ``domain`` are drawn from ``rng``."""
    options: dict[str, Any] = {name: float(rng.uniform(*domain[name])) for name in sorted(domain)}
    return tower(rows=rows, seed=int(rng.integers(2**63)), **options)


def checked_parts(parts: tuple[str, ...]) -> tuple[str, ...]:
    """Parts of an observation, checked."""
    for part in parts:
        if part not in PARTS:
            raise InputError(f"`observe` has '{part}', expected some of {', '.join(PARTS)}", "observe")
    return tuple(parts)


def checked_rows(rows: int) -> int:
    """Number of rows, checked."""
    if not (isinstance(rows, int | np.integer) and 3 <= rows <= 40):
        raise InputError(f"`rows` is {rows!r}, expected an integer from 3 to 40", "rows")
    return int(rows)


def space_of(parts: tuple[str, ...], blocks: int) -> dict[str, spaces.Space[Any]]:
    """Spaces of the parts of an observation of a tower of ``blocks`` blocks."""
    known: dict[str, spaces.Space[Any]] = {
        "poses": spaces.Box(-FAR, FAR, (blocks, 7), np.float32),
        "cells": spaces.Box(-1, 1000, (blocks, 2), np.int32),
        "forces": spaces.Box(0.0, 1000.0, (blocks, 2), np.float32),
        "image": spaces.Box(0, 255, (*IMAGE_SIZE, 3), np.uint8),
    }
    return {part: known[part] for part in parts}


def observed(game: Game, parts: tuple[str, ...]) -> dict[str, NDArray[Any]]:
    """Parts of an observation: new arrays on every call.

    poses: position (m) and quaternion. cells: row and cell, -1 where a block is in none. forces: the
    load on each block, and the force that starts it sliding, N. image: red, green and blue.
    """
    found: dict[str, NDArray[Any]] = {}
    world = game.world if "forces" in parts or "image" in parts else None
    for part in parts:
        if part == "poses":
            found[part] = np.clip(game.poses, -FAR, FAR).astype(np.float32)
        elif part == "cells":
            found[part] = game.cells.astype(np.int32)
        elif part == "forces" and world is not None:
            loads = world.xray()
            both = np.stack([loads.above, loads.tightness], axis=1)
            found[part] = np.clip(np.nan_to_num(both, nan=0.0), 0.0, 1000.0).astype(np.float32)
        elif part == "image" and world is not None:
            found[part] = world.render(IMAGE_SIZE[1], IMAGE_SIZE[0])
    return found


def cells_of_top(game: Game, body: int) -> dict[int, tuple[int, int]]:
    """Free cells of the top row for a block: cell, and its pair of row and cell."""
    return {slot["cell"]: (slot["row"], slot["cell"]) for slot in game.slots(body)}


def legal_moves(game: Game, blocks: int) -> NDArray[np.int8]:
    """Mask of the moves, int8 of shape (3 * blocks,): move 3 * b + c takes block b to cell c of the top row.

    A block may be taken where the rules say so; a cell where it is free.
    """
    mask = np.zeros(3 * blocks, np.int8)
    turn = game.turn
    if turn is None or turn["phase"] == "over":
        return mask
    free: list[int] | None = None
    for body in turn["removable"]:
        if free is None:
            free = list(cells_of_top(game, body))
        for cell in free:
            mask[3 * body + cell] = 1
    return mask


def carry_out(game: Game, move: int, seed: int, noise: Any) -> dict[str, Any]:
    """Carries out a move of legal_moves() with a hand, and waits until the tower is at rest."""
    body, cell = divmod(int(move), 3)
    slot = cells_of_top(game, body).get(cell)
    result = game.take(body, slot=slot, noise=noise, seed=seed)
    after = game.settle()
    return {
        "body": body,
        "end": result["end"],
        "fell": sorted(set(result["fell"] + after["fell"])),
        "frames": result["frames"] + after["frames"],
        "events": result["events"] + after["events"],
    }
