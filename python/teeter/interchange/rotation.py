"""Rotations: quaternions x, y, z, w, and the conventions of other formats."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["IDENTITY", "Quaternion", "compose", "from_rpy", "matrix", "of_block", "rotate", "set_rotation", "to_rpy"]

Quaternion: TypeAlias = tuple[float, float, float, float]
Floats: TypeAlias = NDArray[np.float64]

IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)


def of_block(block: Mapping[str, Any]) -> Quaternion:
    """Rotation of a block of a scene, of length 1."""
    orientation = block.get("orientation")
    if orientation is None:
        half = 0.5 * float(block.get("yaw", 0.0))
        return (0.0, 0.0, math.sin(half), math.cos(half))
    x, y, z, w = (float(part) for part in orientation)
    length = math.sqrt(x * x + y * y + z * z + w * w)
    return (x / length, y / length, z / length, w / length)


def set_rotation(block: dict[str, Any], rotation: Sequence[float]) -> None:
    """Gives a block a rotation: ``yaw`` where it is about the vertical, else ``orientation``."""
    x, y, z, w = (float(part) for part in rotation)
    if x == 0.0 and y == 0.0:
        block["yaw"] = math.remainder(2.0 * math.atan2(z, w), 2.0 * math.pi)
    else:
        block["orientation"] = [x, y, z, w]


def compose(a: Sequence[float], b: Sequence[float]) -> Quaternion:
    """Rotation by b, and then by a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def matrix(rotation: Sequence[float]) -> Floats:
    """Matrix of a rotation, shape (3, 3)."""
    x, y, z, w = rotation
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )


def rotate(rotation: Sequence[float], vector: Sequence[float]) -> Floats:
    """A vector after a rotation, shape (3,)."""
    return matrix(rotation) @ np.asarray(vector, dtype=np.float64)


def from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Rotation of URDF: by roll about x, then by pitch about y, then by yaw about z, rad."""
    about_x = (math.sin(0.5 * roll), 0.0, 0.0, math.cos(0.5 * roll))
    about_y = (0.0, math.sin(0.5 * pitch), 0.0, math.cos(0.5 * pitch))
    about_z = (0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    return compose(about_z, compose(about_y, about_x))


def to_rpy(rotation: Sequence[float]) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a rotation, rad; with a pitch of a right angle the roll is 0."""
    turned = matrix(rotation)
    cosine = math.hypot(turned[0, 0], turned[1, 0])
    pitch = math.atan2(-turned[2, 0], cosine)
    if cosine < 1e-8:
        return 0.0, pitch, math.atan2(-turned[0, 1], turned[1, 1])
    return math.atan2(turned[2, 1], turned[2, 2]), pitch, math.atan2(turned[1, 0], turned[0, 0])
