"""Scenes: blocks on a floor and the constants of their contact, as plain dicts.

The fields are those of docs/scene-format.md, in SI units, with z up and the floor at z = 0. A dict
can be changed before a world is built from it::

    scene = scenes.tower(rows=12, seed=7)
    scene["friction"] = 0.3
"""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

from teeter._teeter import cards, config, field, load, named, names, tower
from teeter.errors import SceneError

__all__ = ["cards", "config", "field", "load", "named", "names", "tower", "vary"]

_FIELDS = ("gravity", "friction", "kinetic_friction", "restitution", "stiffness", "edge_radius")


def vary(scene: Any, count: int, **fields: Sequence[float]) -> list[dict[str, Any]]:
    """Copies of a scene, each with constants of its own: the worlds of a batch.

    scene: as World takes it.
    count: number of copies.
    fields: ``count`` values each of gravity, friction, kinetic_friction, restitution, stiffness or
        edge_radius, in SI units; and ``mass`` and ``height``, factors of all blocks' masses and
        heights. A scaled height moves each block's centre by the same factor.

    Raises SceneError for a field that is unknown or has another number of values.
    """
    base = load(scene)
    for name, values in fields.items():
        if name not in (*_FIELDS, "mass", "height"):
            known = ", ".join((*_FIELDS, "mass", "height"))
            raise SceneError(f"`{name}` is no field that can be varied, expected one of {known}", name)
        if len(values) != count:
            raise SceneError(f"`{name}` has {len(values)} values, expected {count}, one a scene", name)
    return [_varied(base, {name: float(values[i]) for name, values in fields.items()}) for i in range(count)]


def _varied(base: Mapping[str, Any], fields: Mapping[str, float]) -> dict[str, Any]:
    scene = copy.deepcopy(dict(base))
    for name, value in fields.items():
        if name in _FIELDS:
            scene[name] = value
    for block in scene["blocks"]:
        block["mass"] *= fields.get("mass", 1.0)
        block["size"][2] *= fields.get("height", 1.0)
        block["pos"][2] *= fields.get("height", 1.0)
    return scene
