"""Towers of boxes from URDF: links with one box, floating or fixed in the world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from teeter.interchange.box_tower import Box, check_inertia, checked, scene_of
from teeter.interchange.rotation import IDENTITY, Quaternion, compose, from_rpy, matrix, rotate
from teeter.interchange.xml_document import Element, parse

__all__ = ["read_urdf"]

# Parts of a robot, and of a link, that have none in the motion of boxes.
_IDLE = {"material", "gazebo", "transmission"}
_IDLE_PARTS = {"visual"}


@dataclass(frozen=True, slots=True)
class _Pose:
    position: Any
    rotation: Quaternion

    def then(self, inner: _Pose) -> _Pose:
        """Pose in the world of one that is given in the frame of this."""
        position = np.asarray(self.position) + rotate(self.rotation, inner.position)
        return _Pose(position, compose(self.rotation, inner.rotation))


_ORIGIN = _Pose((0.0, 0.0, 0.0), IDENTITY)


@dataclass(frozen=True, slots=True)
class _Joint:
    element: Element
    kind: str
    parent: str
    pose: _Pose


def read_urdf(text: str | bytes, *, friction: float = 0.4, gravity: float = 9.81) -> dict[str, Any]:
    """Returns the scene of a URDF document.

    A link with a box is a block: free where a floating joint leads to it, fixed where only fixed
    joints do. A link without a joint to it is the world, or a single free block. friction, gravity:
    what URDF does not say; a link's ``contact/lateral_friction`` comes first. Raises
    InterchangeError, with name and line, for all that a scene cannot say.
    """
    document = parse(text, "robot")
    links = _named(document, "link")
    joints = _joints(document, links)
    for child in document.children:
        if child.name not in {"link", "joint"} | _IDLE:
            raise child.error("has no counterpart in a scene")
    boxes = []
    for name, link in links.items():
        box = _box(link, *_placed(name, links, joints))
        if box is not None:
            boxes.append(box)
    common = _common_friction(boxes, friction)
    return checked(scene_of(document.attributes.get("name", ""), boxes, friction=common, gravity=gravity))


def _common_friction(boxes: list[Box], otherwise: float) -> float:
    """Friction of the scene: that of all boxes where they agree, which have none of their own then."""
    given = {box.friction for box in boxes}
    if len(given) == 1 and None not in given:
        return float(given.pop() or 0.0)
    return otherwise


def _named(document: Element, kind: str) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in document.all(kind):
        name = element.attributes.get("name", "")
        if not name or name in found:
            raise element.error("has no name of its own", "name")
        found[name] = element
    return found


def _joints(document: Element, links: dict[str, Element]) -> dict[str, _Joint]:
    """Joints by the link that each leads to."""
    joints: dict[str, _Joint] = {}
    for element in _named(document, "joint").values():
        kind = element.attributes.get("type", "")
        if kind not in ("fixed", "floating"):
            raise element.error(f"has type '{kind}': blocks are free or fixed", "type")
        ends = [(element.first(part) or element).attributes.get("link", "") for part in ("parent", "child")]
        for end in ends:
            if end not in links:
                raise element.error(f"leads to a link '{end}' that does not exist", "link")
        if ends[1] in joints:
            raise element.error(f"is a second one to the link '{ends[1]}'", "child")
        joints[ends[1]] = _Joint(element, kind, ends[0], _pose(element))
    return joints


def _pose(element: Element) -> _Pose:
    origin = element.first("origin")
    if origin is None:
        return _ORIGIN
    xyz, rpy = (origin.numbers(name, 3) or (0.0, 0.0, 0.0) for name in ("xyz", "rpy"))
    return _Pose(xyz, from_rpy(*rpy))


def _placed(name: str, links: dict[str, Element], joints: dict[str, _Joint]) -> tuple[_Pose, bool]:
    """Pose of a link in the world, and whether it is fixed there."""
    chain = []
    seen = {name}
    link = name
    while link in joints:
        chain.append(joints[link])
        link = joints[link].parent
        if link in seen:
            raise chain[-1].element.error("is one of a ring of joints", "parent")
        seen.add(link)
    pose = _ORIGIN
    for joint in reversed(chain):
        pose = pose.then(joint.pose)
    if any(joint.kind == "floating" for joint in chain[1:]) and _is_box(links[name]):
        raise chain[0].element.error("leads to a part of a body that moves: expected one box a body")
    root_moves = _is_box(links[link])
    if root_moves and chain and _is_box(links[name]) and chain[0].kind == "fixed":
        raise chain[0].element.error("leads to a part of a body that moves: expected one box a body")
    fixed = bool(chain) and chain[0].kind == "fixed"
    return pose, fixed


def _is_box(link: Element) -> bool:
    return link.first("collision") is not None


def _box(link: Element, pose: _Pose, fixed: bool) -> Box | None:
    collisions, inertial = link.all("collision"), link.first("inertial")
    for part in link.children:
        if part.name not in {"collision", "inertial", "contact"} | _IDLE_PARTS:
            raise part.error("has no counterpart in a scene")
    if not collisions:
        if inertial is not None and not fixed:
            raise link.error("has mass without a `collision`")
        return None
    if len(collisions) > 1:
        raise collisions[1].error("is a second one of its link: expected one box a body")
    geometry = collisions[0].first("geometry") or collisions[0]
    shape = geometry.first("box")
    if shape is None or len(geometry.children) != 1:
        raise (geometry.children[0] if geometry.children else geometry).error("is no box", "geometry")
    size = shape.numbers("size", 3)
    if size is None:
        raise shape.error("has no size", "size")
    offset = _pose(collisions[0])
    mass = _mass(link, inertial, offset, size, fixed)
    placed = pose.then(offset)
    name = link.attributes["name"]
    return Box(name, size, mass, placed.position, placed.rotation, fixed, _friction(link))


def _mass(link: Element, inertial: Element | None, box: _Pose, size: list[float], fixed: bool) -> float:
    mass = _value(inertial, "mass") if inertial is not None else None
    if inertial is None or mass is None:
        if fixed:
            # a fixed block needs a mass, which has no effect
            return 1.0
        raise link.error("has no mass", "inertial")
    own = _pose(inertial)
    if np.abs(np.asarray(own.position) - np.asarray(box.position)).max() > 1e-6 * max(size):
        raise inertial.error("has its centre of mass off that of its box", "origin")
    inertia = inertial.first("inertia")
    if inertia is not None and not fixed:
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        given = [inertia.numbers(part, 1) or [0.0] for part in names]
        xx, xy, xz, yy, yz, zz = (value[0] for value in given)
        turned = matrix(own.rotation)
        tensor = turned @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turned.T
        if not mass > 0.0:
            raise inertial.error(f"has mass {mass:g} kg, expected above 0", "mass")
        check_inertia(inertia, tensor, mass, size, box.rotation)
    return mass


def _value(parent: Element, name: str) -> float | None:
    element = parent.first(name)
    numbers = element.numbers("value", 1) if element is not None else None
    return numbers[0] if numbers else None


def _friction(link: Element) -> float | None:
    contact = link.first("contact")
    return _value(contact, "lateral_friction") if contact is not None else None
