"""Towers of boxes from MJCF, the models of MuJoCo.

MuJoCo itself reads the file, so that defaults, classes, angles, frames and densities mean what they
mean there. What the compiled model has is compared with what a scene can say: anything else is
refused with the name and line of its element.
"""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from teeter.errors import InterchangeError
from teeter.interchange.box_tower import Box, check_inertia, checked, scene_of
from teeter.interchange.mjcf_friction import scene_friction
from teeter.interchange.mjcf_writer import CUSTOM, START
from teeter.interchange.rotation import Quaternion, compose, matrix, rotate
from teeter.interchange.xml_document import Element, parse

__all__ = ["read_mjcf"]

# Sections that have no part in the motion of boxes.
_IDLE = {"asset", "visual", "statistic", "size", "sensor", "default", "compiler", "option", "worldbody"}
_READ = {"contact", "custom", "keyframe"}
# Attributes that ask for memory, with the largest number that is read.
_SIZES = {"memory": 2**30, "width": 2**13, "height": 2**13, "nrow": 2**13, "ncol": 2**13, "nuserdata": 2**20}
_SIZES |= {f"nuser_{part}": 2**10 for part in ("body", "jnt", "geom", "site", "cam", "tendon", "actuator", "sensor")}
_SIZES |= {"nkey": 2**10, "nconmax": 2**20, "njmax": 2**20, "nstack": 2**27}
_SIZE = re.compile(r"\s*([0-9]{1,18})\s*([KMGTPE]?)\s*", re.IGNORECASE)
# Elements of a body that have none.
_IDLE_PARTS = {"site", "camera", "light"}
_PARTS = {"body", "geom", "joint", "freejoint", "inertial", "frame"}


def read_mjcf(text: str | bytes) -> dict[str, Any]:
    """Returns the scene of an MJCF document: boxes that are free or fixed, on a level floor.

    Poses, sizes, masses or densities and friction are taken over; contacts have Teeter's stiffness,
    not that of MuJoCo, and time steps and solvers are left aside. What write_mjcf wrote gives the
    scene that it was. Raises InterchangeError, with name and line, for all that a scene cannot say.
    """
    document = parse(text, "mujoco")
    _check_elements(document)
    model = _compiled(text)
    reader = _Reader(document, model)
    boxes = reader.boxes()
    friction = scene_friction(document, model, reader.floor, boxes)
    for box, own in zip(boxes, friction.blocks, strict=True):
        box.box.friction = own
    name = document.attributes.get("model", "")
    scene = scene_of(name, [found.box for found in boxes], friction=friction.scene, gravity=reader.gravity())
    reader.add_velocities(scene, boxes)
    return checked(_with_rest(document, scene))


def _check_elements(document: Element) -> None:
    """Refuses what names files or code, and sections that act on bodies."""
    for element in document.walk():
        if element.name in ("include", "plugin", "attach", "model"):
            raise element.error("is not read: expected a document that is complete in itself")
        _check_size(element)
        if "file" in element.attributes:
            raise element.error("names a file, which is not read: expected boxes", "file")
    for section in document.children:
        if section.name not in _IDLE | _READ:
            raise section.error("has no counterpart in a scene")
        if section.name == "worldbody":
            _check_bodies(section)
        if section.name == "contact":
            for child in section.all("exclude"):
                raise child.error("has no counterpart in a scene: all blocks touch each other")


def _check_size(element: Element) -> None:
    """Refuses sizes with which a short document takes gigabytes."""
    for name, limit in _SIZES.items():
        number = _SIZE.fullmatch(element.attributes.get(name, "0"))
        # no number, or one of the default, is for MuJoCo to judge
        if number and int(number[1]) * 1024 ** "-KMGTPE".index(number[2].upper() or "-") > limit:
            raise element.error(f"has {name}='{element.attributes[name]}', expected at most {limit}", name)


def _check_bodies(world: Element) -> None:
    for element in world.walk():
        for child in element.children:
            if element.name in ("worldbody", "body", "frame") and child.name not in _PARTS | _IDLE_PARTS:
                raise child.error("has no counterpart in a scene")


def _compiled(text: str | bytes) -> Any:
    try:
        import mujoco
    except ImportError as error:
        raise InterchangeError("reading MJCF needs mujoco: pip install 'teeter[interchange]'") from error
    if isinstance(text, bytes):
        try:
            text = text.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            raise InterchangeError(f"no UTF-8: {error}") from error
    try:
        with _without_log(mujoco):
            spec = mujoco.MjSpec.from_string(text)
            return _Model(mujoco, spec, spec.compile())
    except (ValueError, RuntimeError, MemoryError, mujoco.FatalError) as error:
        message = " ".join(str(error).split())
        raise InterchangeError(f"MuJoCo refuses it: {message}", None, _line(message)) from error


@contextlib.contextmanager
def _without_log(mujoco: Any) -> Iterator[None]:
    """Keeps MuJoCo from writing warnings into a file of the current folder."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda message: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)


def _line(message: str) -> int | None:
    """Line in a message or note of MuJoCo such as `line 7`."""
    parts = message.replace(",", " ").replace(")", " ").split()
    lines = [after for before, after in itertools.pairwise(parts) if before == "line" and after.isdigit()]
    return int(lines[-1]) if lines else None


@dataclass(slots=True)
class _Model:
    """A model with its elements as they were read, and its state at the start."""

    mujoco: Any
    spec: Any
    model: Any

    def state(self) -> Any:
        data = self.mujoco.MjData(self.model)
        self.mujoco.mj_kinematics(self.model, data)
        return data


@dataclass(slots=True)
class _Found:
    """A box with the indices of its geom and its free joint, None where it is fixed."""

    box: Box
    geom: int
    joint: int | None


class _Reader:
    def __init__(self, document: Element, compiled: _Model) -> None:
        self.document = document
        self.model = compiled.model
        self.mujoco = compiled.mujoco
        self.data = compiled.state()
        self.spec_geoms = list(compiled.spec.geoms)
        self.spec_bodies = list(compiled.spec.bodies)
        self.spec_joints = list(compiled.spec.joints)
        self.floor: int | None = None
        self._by_line = {(element.name, element.line): element for element in document.walk()}

    def element(self, spec: Any, name: str) -> Element:
        """Element of the document that a part of the model was read from."""
        line = _line(spec.info) or 1
        found = self._by_line.get((name, line)) or self._by_line.get(("freejoint", line))
        return found or Element(name, {"name": spec.name} if spec.name else {}, line)

    def gravity(self) -> float:
        """Gravity, m/s²; refuses what else acts on bodies everywhere."""
        option = self.document.first("option") or self.document
        x, y, z = self.model.opt.gravity
        if x != 0.0 or y != 0.0 or z > 0.0:
            raise option.error("has gravity that is not straight down", "gravity")
        if any(self.model.opt.wind) or self.model.opt.density or self.model.opt.viscosity:
            raise option.error("has a medium: a scene is in a vacuum")
        flags = self.mujoco.mjtDisableBit
        if self.model.opt.disableflags & (flags.mjDSBL_CONTACT | flags.mjDSBL_GRAVITY | flags.mjDSBL_CONSTRAINT):
            raise option.error("switches gravity or contacts off", "flag")
        return float(-z) if z else 0.0

    def boxes(self) -> list[_Found]:
        """All boxes, in the order of their bodies."""
        self._check_joints()
        found = []
        for body in range(self.model.nbody):
            geoms = [geom for geom in self._geoms(body) if self._collides(geom, body)]
            if self._is_free(body):
                found.append(self._free_box(body, geoms))
            else:
                found += [self._fixed_box(geom) for geom in geoms if not self._is_floor(geom)]
        self._check_filters(found)
        return found

    def _geoms(self, body: int) -> range:
        first = int(self.model.body_geomadr[body])
        return range(first, first + int(self.model.body_geomnum[body])) if first >= 0 else range(0)

    def _is_free(self, body: int) -> bool:
        """True for a body that moves; one that is welded to it must not have geoms of its own."""
        welded = int(self.model.body_weldid[body])
        if welded != 0 and welded != body and self.model.body_geomnum[body]:
            raise self.element(self.spec_bodies[body], "body").error("is a part of another: expected one box a body")
        return welded == body != 0

    def _check_joints(self) -> None:
        for joint in range(self.model.njnt):
            element = self.element(self.spec_joints[joint], "joint")
            if self.model.jnt_type[joint] != self.mujoco.mjtJoint.mjJNT_FREE:
                raise element.error("is no free joint: blocks are free or fixed")
            first = int(self.model.jnt_dofadr[joint])
            for name in ("dof_damping", "dof_armature", "dof_frictionloss"):
                if np.any(getattr(self.model, name)[first : first + 6]):
                    raise element.error(f"has {name[4:]}, which a free block has not", name[4:])
            if self.model.jnt_stiffness[joint]:
                raise element.error("has stiffness, which a free block has not", "stiffness")

    def _collides(self, geom: int, body: int) -> bool:
        """True for a geom that takes part in contacts; others must not have mass."""
        if self.model.geom_contype[geom] or self.model.geom_conaffinity[geom]:
            return True
        if self.model.body_weldid[body] != 0 and self._mass(geom) > 0.0:
            raise self.element(self.spec_geoms[geom], "geom").error("has mass without contacts")
        return False

    def _mass(self, geom: int) -> float:
        spec = self.spec_geoms[geom]
        if not math.isnan(spec.mass):
            return float(spec.mass)
        return float(spec.density * np.prod(2.0 * self.model.geom_size[geom]))

    def _is_floor(self, geom: int) -> bool:
        """True for the plane z = 0. Refuses another plane, and all that is no box."""
        kinds = self.mujoco.mjtGeom
        element = self.element(self.spec_geoms[geom], "geom")
        if self.model.geom_type[geom] == kinds.mjGEOM_BOX:
            return False
        if self.model.geom_type[geom] != kinds.mjGEOM_PLANE:
            raise element.error("is no box", "type")
        height, normal = self.data.geom_xpos[geom][2], self.data.geom_xmat[geom].reshape(3, 3)[:, 2]
        if abs(height) > 1e-9 or normal[2] < 1.0 - 1e-12:
            raise element.error("is no level floor at z = 0")
        if self.floor is not None:
            raise element.error("is a second floor")
        self.floor = geom
        return True

    def _placed(self, geom: int) -> tuple[list[float], Quaternion]:
        """Centre and rotation of a geom at the start."""
        body = int(self.model.geom_bodyid[geom])
        w, x, y, z = (float(part) for part in self.data.xquat[body])
        gw, gx, gy, gz = (float(part) for part in self.model.geom_quat[geom])
        offset = rotate((x, y, z, w), self.model.geom_pos[geom])
        center = [float(part) for part in self.data.xpos[body] + offset]
        return center, compose((x, y, z, w), (gx, gy, gz, gw))

    def _free_box(self, body: int, geoms: list[int]) -> _Found:
        element = self.element(self.spec_bodies[body], "body")
        if len(geoms) != 1 or self._is_floor(geoms[0]):
            raise element.error(f"has {len(geoms)} geoms that touch, expected one box")
        if self.model.body_gravcomp[body]:
            raise element.error("has gravcomp, which a block has not", "gravcomp")
        geom = geoms[0]
        size = 2.0 * self.model.geom_size[geom]
        mass = float(self.model.body_mass[body])
        w, x, y, z = (float(part) for part in self.model.geom_quat[geom])
        if np.abs(self.model.body_ipos[body] - self.model.geom_pos[geom]).max() > 1e-6 * size.max():
            raise element.error("has its centre of mass off that of its box")
        iw, ix, iy, iz = (float(part) for part in self.model.body_iquat[body])
        axes = matrix((ix, iy, iz, iw))
        check_inertia(element, axes @ np.diag(self.model.body_inertia[body]) @ axes.T, mass, size, (x, y, z, w))
        center, rotation = self._placed(geom)
        name = self.spec_bodies[body].name or self.spec_geoms[geom].name
        return _Found(Box(name, size, mass, center, rotation), geom, int(self.model.body_jntadr[body]))

    def _fixed_box(self, geom: int) -> _Found:
        center, rotation = self._placed(geom)
        body = int(self.model.geom_bodyid[geom])
        name = self.spec_geoms[geom].name or (self.spec_bodies[body].name if body else "")
        size = 2.0 * self.model.geom_size[geom]
        mass = self._mass(geom)
        # a fixed block needs a mass, which has no effect
        return _Found(Box(name, size, mass if mass > 0.0 else 1.0, center, rotation, fixed=True), geom, None)

    def _check_filters(self, found: list[_Found]) -> None:
        """Refuses geoms of which some do not touch others."""
        geoms = [box.geom for box in found] + ([] if self.floor is None else [self.floor])
        kinds, masks = self.model.geom_contype[geoms], self.model.geom_conaffinity[geoms]
        for i, geom in enumerate(geoms):
            touches = (kinds[i] & masks) | (masks[i] & kinds)
            touches[i] = 1
            if not touches.all():
                raise self.element(self.spec_geoms[geom], "geom").error(
                    "does not touch all others: all blocks touch each other", "contype"
                )

    def add_velocities(self, scene: dict[str, Any], found: list[_Found]) -> None:
        """Sets velocities from the keyframe of the start, where there is one."""
        for key in range(self.model.nkey):
            if self.mujoco.mj_id2name(self.model, self.mujoco.mjtObj.mjOBJ_KEY, key) == START:
                for block, box in zip(scene["blocks"], found, strict=True):
                    if box.joint is not None:
                        self._add_velocity(block, self.model.key_qvel[key], int(self.model.jnt_dofadr[box.joint]))

    def _add_velocity(self, block: dict[str, Any], speeds: Any, first: int) -> None:
        body = int(self.model.dof_bodyid[first])
        w, x, y, z = (float(part) for part in self.data.xquat[body])
        velocity, spin = speeds[first : first + 3], rotate((x, y, z, w), speeds[first + 3 : first + 6])
        for name, vector in (("velocity", velocity), ("spin", spin)):
            if np.any(vector):
                block[name] = [float(part) for part in vector]


def _with_rest(document: Element, scene: dict[str, Any]) -> dict[str, Any]:
    """Scene with the fields that write_mjcf wrote as custom text."""
    for element in _texts(document):
        try:
            rest = json.loads(element.attributes.get("data", ""))
            blocks = rest.pop("blocks", {})
            for block in scene["blocks"]:
                block |= blocks.get(str(block["id"]), {})
            scene = {**scene, **rest, "name": scene["name"], "blocks": scene["blocks"]}
        except (ValueError, TypeError, AttributeError, RecursionError) as error:
            raise element.error("has no fields of a scene, expected a JSON object", "data") from error
    return scene


def _texts(document: Element) -> Iterator[Element]:
    for custom in document.all("custom"):
        yield from (text for text in custom.all("text") if text.attributes.get("name") == CUSTOM)
