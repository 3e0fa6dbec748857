"""Scenes as MJCF, the models of MuJoCo, with settings with which a tower stands there.

A block is a body with a box, a fixed one a body without a joint. What MJCF has no words for, such as
restitution, is written as custom text, so that read_mjcf gives the same scene back.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree

from teeter import scenes
from teeter.errors import InterchangeError
from teeter.interchange.rotation import matrix, of_block

__all__ = ["CUSTOM", "DEFAULTS", "FLOOR", "RECIPE", "START", "Recipe", "block_name", "write_mjcf"]

CUSTOM = "teeter"
"""Name of the text with the fields that MJCF has no words for."""
FLOOR = "floor"
START = "start"
# Fields of a scene, and of a block, that MJCF says itself.
_OWN_FIELDS = {"name", "gravity", "friction", "blocks"}
_OWN_BLOCK_FIELDS = {"id", "size", "mass", "pos", "yaw", "orientation", "velocity", "spin", "fixed", "friction"}
MAX_PAIRS = 200_000


@dataclass(frozen=True, slots=True)
class Recipe:
    """Settings of MuJoCo: attributes of ``option``, and of all contacts."""

    option: Mapping[str, str]
    contact: Mapping[str, str]

    @property
    def details(self) -> str:
        """The settings as a text."""
        parts = [f"{name} {value}" for name, value in {**self.option, **self.contact}.items()]
        return ", ".join(parts) if parts else "its defaults"


RECIPE = Recipe(
    {"timestep": "0.002", "integrator": "implicitfast", "cone": "elliptic", "impratio": "10", "noslip_iterations": "2"},
    {"solref": "0.005 3", "solimp": "0.95 0.99 0.0001"},
)
"""Settings with which a full tower stands: stiff and overdamped contacts, and friction that holds."""

DEFAULTS = Recipe({}, {})
"""The defaults of MuJoCo, with which a full tower creeps away by centimetres."""


def write_mjcf(scene: Any, recipe: Recipe = RECIPE) -> str:
    """Returns a scene as MJCF.

    scene: as World takes it. recipe: settings of MuJoCo. A contact of two geoms has the larger of
    their coefficients of friction there, and the geometric mean here: where these differ, a
    ``pair`` gives the contact its own. Raises SceneError, or InterchangeError for a scene of more
    than 200,000 such pairs.
    """
    scene = scenes.load(scene)
    root = ElementTree.Element("mujoco", model=scene["name"])
    ElementTree.SubElement(root, "compiler", angle="radian", autolimits="true")
    ElementTree.SubElement(root, "option", {"gravity": _text((0.0, 0.0, -scene["gravity"])), **recipe.option})
    if recipe.contact:
        defaults = ElementTree.SubElement(root, "default")
        for name in ("geom", "pair"):
            ElementTree.SubElement(defaults, name, dict(recipe.contact))
    world = ElementTree.SubElement(root, "worldbody")
    floor = {"name": FLOOR, "type": "plane", "size": "0 0 0.05", "friction": _text((scene["friction"],))}
    ElementTree.SubElement(world, "geom", floor)
    for block in scene["blocks"]:
        _add_block(world, block, scene["friction"])
    _add_pairs(root, scene)
    _add_start(root, scene["blocks"])
    _add_rest(root, scene)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def block_name(block: Mapping[str, Any]) -> str:
    """Name of a block in other formats."""
    return f"block {block['id']}"


def _text(numbers: Sequence[float]) -> str:
    """Numbers with as many digits as it takes to read the same bits."""
    return " ".join(repr(float(number)) for number in numbers)


def _quaternion(block: Mapping[str, Any]) -> tuple[float, float, float, float]:
    x, y, z, w = of_block(block)
    return w, x, y, z


def _add_block(world: ElementTree.Element, block: Mapping[str, Any], friction: float) -> None:
    pose = {"pos": _text(block["pos"]), "quat": _text(_quaternion(block))}
    body = ElementTree.SubElement(world, "body", {"name": block_name(block), **pose})
    if not block.get("fixed"):
        ElementTree.SubElement(body, "freejoint", name=block_name(block))
    geom = {
        "name": block_name(block),
        "type": "box",
        "size": _text([0.5 * edge for edge in block["size"]]),
        "mass": _text((block["mass"],)),
        "friction": _text((_friction(block, friction),)),
    }
    ElementTree.SubElement(body, "geom", geom)


def _friction(block: Mapping[str, Any], otherwise: float) -> float:
    friction = block.get("friction")
    return float(otherwise if friction is None else friction)


def _pairs(scene: Mapping[str, Any]) -> Iterator[tuple[str, str, float]]:
    """Contacts whose geometric mean is not the larger coefficient, with that mean."""
    blocks = [(FLOOR, float(scene["friction"]), True)]
    blocks += [(block_name(b), _friction(b, scene["friction"]), bool(b.get("fixed"))) for b in scene["blocks"]]
    if len({friction for _, friction, _ in blocks}) == 1:
        return
    for i, (name, friction, fixed) in enumerate(blocks):
        for other, other_friction, other_fixed in blocks[:i]:
            if friction != other_friction and not (fixed and other_fixed):
                yield other, name, math.sqrt(friction * other_friction)


def _add_pairs(root: ElementTree.Element, scene: Mapping[str, Any]) -> None:
    contact = None
    for count, (a, b, friction) in enumerate(_pairs(scene), start=1):
        if count > MAX_PAIRS:
            raise InterchangeError(f"more than {MAX_PAIRS} contacts with a `friction` of their own", "friction")
        if contact is None:
            contact = ElementTree.SubElement(root, "contact")
        pair = {"geom1": a, "geom2": b, "condim": "3", "friction": _text((friction, friction))}
        ElementTree.SubElement(contact, "pair", pair)


def _add_start(root: ElementTree.Element, blocks: Sequence[Mapping[str, Any]]) -> None:
    """The start as a keyframe, which has the velocities too."""
    positions: list[float] = []
    velocities: list[float] = []
    for block in blocks:
        if not block.get("fixed"):
            positions += [*block["pos"], *_quaternion(block)]
            # MuJoCo has the spin of a free body in the body's frame
            spin = matrix(of_block(block)).T @ block.get("spin", (0.0, 0.0, 0.0))
            velocities += [*block.get("velocity", (0.0, 0.0, 0.0)), *spin]
    if positions:
        keyframe = ElementTree.SubElement(root, "keyframe")
        ElementTree.SubElement(keyframe, "key", name=START, qpos=_text(positions), qvel=_text(velocities))


def _add_rest(root: ElementTree.Element, scene: Mapping[str, Any]) -> None:
    rest: dict[str, Any] = {name: value for name, value in scene.items() if name not in _OWN_FIELDS}
    blocks = {}
    for block in scene["blocks"]:
        fields = {name: value for name, value in block.items() if name not in _OWN_BLOCK_FIELDS}
        if block.get("fixed") and any(block.get(name) for name in ("velocity", "spin")):
            fields |= {name: block[name] for name in ("velocity", "spin") if name in block}
        if fields:
            blocks[str(block["id"])] = fields
    if blocks:
        rest["blocks"] = blocks
    if rest:
        custom = ElementTree.SubElement(root, "custom")
        ElementTree.SubElement(custom, "text", name=CUSTOM, data=json.dumps(rest))
