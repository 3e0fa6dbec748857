"""Scenes as URDF: a link a block, with a floating or a fixed joint to the world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any
from xml.etree import ElementTree

from teeter import scenes
from teeter.interchange.box_tower import box_inertia
from teeter.interchange.mjcf_writer import block_name
from teeter.interchange.rotation import of_block, to_rpy

__all__ = ["write_urdf"]


def write_urdf(scene: Any) -> str:
    """Returns a scene as URDF.

    URDF has no floor, gravity or velocities. Friction is written as ``contact/lateral_friction``,
    which Bullet reads. Raises SceneError.
    """
    scene = scenes.load(scene)
    robot = ElementTree.Element("robot", name=scene["name"])
    ElementTree.SubElement(robot, "link", name="world")
    for block in scene["blocks"]:
        name = block_name(block)
        _add_link(robot, block, name, scene["friction"])
        kind = "fixed" if block.get("fixed") else "floating"
        joint = ElementTree.SubElement(robot, "joint", name=f"{name} joint", type=kind)
        rpy = (0.0, 0.0, float(block["yaw"])) if block.get("orientation") is None else to_rpy(of_block(block))
        ElementTree.SubElement(joint, "origin", xyz=_text(block["pos"]), rpy=_text(rpy))
        ElementTree.SubElement(joint, "parent", link="world")
        ElementTree.SubElement(joint, "child", link=name)
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def _add_link(robot: ElementTree.Element, block: Mapping[str, Any], name: str, friction: float) -> None:
    link = ElementTree.SubElement(robot, "link", name=name)
    own = block.get("friction")
    contact = ElementTree.SubElement(link, "contact")
    ElementTree.SubElement(contact, "lateral_friction", value=_text((friction if own is None else own,)))
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "mass", value=_text((block["mass"],)))
    moments = [_text((moment,)) for moment in box_inertia(block["mass"], block["size"])]
    names = ("ixx", "iyy", "izz")
    products = dict.fromkeys(("ixy", "ixz", "iyz"), "0")
    ElementTree.SubElement(inertial, "inertia", {**dict(zip(names, moments, strict=True)), **products})
    for part in ("visual", "collision"):
        geometry = ElementTree.SubElement(ElementTree.SubElement(link, part), "geometry")
        ElementTree.SubElement(geometry, "box", size=_text(block["size"]))


def _text(numbers: Sequence[float]) -> str:
    """Numbers with as many digits as it takes to read the same bits."""
    return " ".join(repr(float(number)) for number in numbers)
