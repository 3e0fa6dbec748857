"""Boxes of another format, gathered into a scene."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teeter import scenes
from teeter.errors import InterchangeError, SceneError
from teeter.interchange.rotation import Quaternion, matrix, set_rotation
from teeter.interchange.xml_document import Element

__all__ = ["Box", "box_inertia", "check_inertia", "checked", "scene_of"]

# Share by which the inertia of another format may differ from that of a uniform box.
INERTIA_TOLERANCE = 1e-2
_ID = re.compile(r"block (0|[1-9][0-9]{0,8})")


@dataclass(slots=True)
class Box:
    """A box of another format. size: full edges, m. friction: None for that of the scene."""

    name: str
    size: Sequence[float]
    mass: float
    center: Sequence[float]
    rotation: Quaternion
    fixed: bool = False
    friction: float | None = None


def box_inertia(mass: float, size: Sequence[float]) -> NDArray[np.float64]:
    """Moments of inertia of a uniform box about its axes, kg m², shape (3,)."""
    squares = np.asarray(size, dtype=np.float64) ** 2
    moments: NDArray[np.float64] = mass / 12.0 * (squares.sum() - squares)
    return moments


def check_inertia(
    element: Element, tensor: NDArray[np.float64], mass: float, size: Sequence[float], rotation: Quaternion
) -> None:
    """Raises InterchangeError where an inertia is not about that of a uniform box.

    tensor: about the centre of mass, kg m², shape (3, 3). rotation: of the box in the same frame.
    """
    turned = matrix(rotation)
    expected = turned @ np.diag(box_inertia(mass, size)) @ turned.T
    off = np.abs(tensor - expected).max() / np.abs(expected).max()
    if not off <= INERTIA_TOLERANCE:
        raise element.error(f"has an inertia that is {100 * off:.3g} % off that of a uniform box: blocks are uniform")


def scene_of(name: str, boxes: Sequence[Box], *, friction: float, gravity: float) -> dict[str, Any]:
    """Scene of boxes.

    Blocks have the ids of names such as `block 7` where all boxes are named like that, else their
    order, and the names as comments. Raises InterchangeError where there is no box.
    """
    if not boxes:
        raise InterchangeError("no boxes, expected one at least", "geom")
    matches = [_ID.fullmatch(box.name) for box in boxes]
    ids = [int(match[1]) for match in matches if match]
    named = len(ids) == len(boxes) and len(set(ids)) == len(ids)
    scene: dict[str, Any] = {"name": name or "tower", "gravity": gravity, "friction": friction, "blocks": []}
    for i, box in enumerate(boxes):
        block: dict[str, Any] = {
            "id": ids[i] if named else i,
            "size": [float(edge) for edge in box.size],
            "mass": float(box.mass),
            "pos": [float(part) for part in box.center],
        }
        set_rotation(block, box.rotation)
        if box.fixed:
            block["fixed"] = True
        if box.friction is not None and box.friction != friction:
            block["friction"] = float(box.friction)
        if not named and box.name:
            block["comment"] = box.name
        scene["blocks"].append(block)
    return scene


def checked(scene: dict[str, Any]) -> dict[str, Any]:
    """The scene. Raises InterchangeError where it cannot be simulated."""
    try:
        scenes.load(scene)
    except SceneError as error:
        raise InterchangeError(f"no scene of these boxes: {error}", error.field) from error
    return scene
