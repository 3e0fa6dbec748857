"""Friction of MJCF: of each pair there, of each block here.

There a contact has the larger coefficient of its two geoms, or that of a ``pair``; here the
geometric mean of its two blocks, and the floor that of the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from teeter.errors import InterchangeError
from teeter.interchange.xml_document import Element

__all__ = ["Friction", "scene_friction"]

# Relative difference up to which two coefficients are equal.
_SAME = 1e-9
_MAX_FRICTION = 2.0
_MAX_MIXED = 3000


class _Placed(Protocol):
    @property
    def geom(self) -> int: ...
    @property
    def joint(self) -> int | None: ...


@dataclass(frozen=True, slots=True)
class Friction:
    """Coefficient of the scene, and of each block."""

    scene: float
    blocks: list[float]


def scene_friction(document: Element, compiled: Any, floor: int | None, boxes: Sequence[_Placed]) -> Friction:
    """Coefficients that give each contact the friction that it has in MuJoCo.

    Raises InterchangeError where there are none.
    """
    model = compiled.model
    geoms = [box.geom for box in boxes]
    _check_dimensions(document, compiled, [*geoms, *([] if floor is None else [floor])])
    own = [float(model.geom_friction[geom, 0]) for geom in geoms]
    ground = own[0] if floor is None and own else float(model.geom_friction[floor, 0]) if own else 0.0
    if not own:
        return Friction(0.4, [])
    if not model.npair and (len({ground, *own}) == 1 or all(box.joint is None for box in boxes)):
        # fixed boxes have no contacts with each other and the floor
        return Friction(ground, own)
    pairs = _pairs(document, model)
    if not pairs and len(set(own)) == 1 and own[0] > 0.0:
        # the larger of the two with the floor, which the mean gives with another floor
        ground = max(ground, own[0]) ** 2 / own[0]
        if ground <= _MAX_FRICTION:
            return Friction(ground, own)
    fixed = np.array([True, *(box.joint is None for box in boxes)])
    _check_means(document, [-1 if floor is None else floor, *geoms], [ground, *own], pairs, fixed)
    return Friction(ground, own)


def _check_dimensions(document: Element, compiled: Any, geoms: Sequence[int]) -> None:
    for geom in geoms:
        model = compiled.model
        frictionless = model.geom_condim[geom] == 1 and model.geom_friction[geom, 0] > 0.0
        if frictionless or model.geom_priority[geom] != 0:
            name = compiled.spec.geoms[geom].name
            what = "condim 1" if frictionless else "a priority"
            raise document.error(f"has a geom '{name}' with {what}, which no block has", "geom")


def _pairs(document: Element, model: Any) -> dict[tuple[int, int], float]:
    """Friction of explicit pairs, by the lower and the higher geom."""
    pairs = {}
    for i in range(model.npair):
        a, b = int(model.pair_geom1[i]), int(model.pair_geom2[i])
        along, across = (float(part) for part in model.pair_friction[i, :2])
        if abs(along - across) > _SAME * max(along, across):
            raise _section(document).error("has a pair with two coefficients: friction has no direction")
        pairs[min(a, b), max(a, b)] = along
    return pairs


def _check_means(
    document: Element,
    geoms: Sequence[int],
    coefficients: Sequence[float],
    pairs: dict[tuple[int, int], float],
    fixed: NDArray[np.bool_],
) -> None:
    """Refuses a contact whose friction is not the geometric mean. The first geom is the floor."""
    if len(coefficients) > _MAX_MIXED:
        raise InterchangeError(f"more than {_MAX_MIXED} boxes of different `friction`", "friction")
    own = np.array(coefficients)
    there = np.maximum(own[:, None], own[None, :])
    rows = {geom: row for row, geom in enumerate(geoms)}
    for (a, b), friction in pairs.items():
        if a in rows and b in rows:
            there[rows[a], rows[b]] = there[rows[b], rows[a]] = friction
    here = np.sqrt(own[:, None] * own[None, :])
    off = np.abs(there - here) > _SAME * np.maximum(there, here)
    off[fixed[:, None] & fixed[None, :]] = False
    np.fill_diagonal(off, False)
    if geoms[0] < 0:
        # without a floor there, nothing is known of its friction
        off[0] = off[:, 0] = False
    if off.any():
        i, j = (int(part) for part in np.argwhere(off)[0])
        message = f"friction of {there[i, j]:.4g} between geoms of {own[i]:.4g} and {own[j]:.4g}"
        raise _section(document).error(f"has {message}, which a scene cannot give: expected the geometric mean")


def _section(document: Element) -> Element:
    return document.first("contact") or document.first("worldbody") or document
