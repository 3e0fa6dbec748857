"""Parts of the input of a step, as plain data.

A step takes them as keyword arguments: ``world.step(hand=Hand(...), forces=[Force(...)])``. Lengths
are in m, forces in N, directions and quaternions (x, y, z, w) in the world. What exceeds the limits
of inputs is reduced to them, see docs/inputs.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

__all__ = ["Drive", "Force", "Hand"]

Vector = Sequence[float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Hand:
    """A hand: a damped spring between a point of a body and a target, with limited force.

    body: index of the body that it holds.
    target: target of the grasped point at the end of the step, m.
    anchor: the grasped point in the body's frame, m.
    orientation: target orientation; None leaves it free.
    grip: "slide" in the tower, "carry" in the air, "push" for a fingertip.
    axis: direction of a push, in the world.
    max_force, max_torque: N and N m.
    """

    body: int
    target: Vector
    anchor: Vector = (0.0, 0.0, 0.0)
    orientation: Vector | None = None
    grip: Literal["slide", "carry", "push"] = "slide"
    axis: Vector = (0.0, 0.0, 0.0)
    max_force: float = 4.0
    max_torque: float = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class Force:
    """A force at a point that moves with a body.

    body: index of the body.
    force: in the world at the end of the step, N; it grows linearly from that of the last step.
    point: point of attack in the body's frame, m.
    """

    body: int
    force: Vector
    point: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """A velocity imposed on a body with a large but limited force, for experiments.

    body: index of the body.
    velocity: of its centre, m/s; it does not rotate.
    max_force: N.
    """

    body: int
    velocity: Vector
    max_force: float = 100.0
