"""URDF: scenes come back as they were, towers of others are read, and the rest is refused."""

import contextlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from scene_draws import assert_same, damaged
from scene_draws import scenes as drawn_scenes

import teeter
from teeter import InterchangeError, scenes
from teeter.interchange import read_urdf, write_urdf


@settings(max_examples=40, deadline=None)
@given(drawn_scenes())
def test_a_scene_comes_back_but_for_what_urdf_cannot_say(scene):
    scene = scenes.load(scene)
    back = read_urdf(write_urdf(scene), gravity=scene["gravity"], friction=scene["friction"])
    assert_same(scene, scenes.load(back), velocities=False, exact=False)


# As a package of robots would have it: a fixed table, boxes with an origin of their own, frames.
OTHERS = """<?xml version="1.0"?>
<robot name="shelf">
  <link name="map"/>
  <link name="table">
    <visual><geometry><mesh filename="package://shelf/table.dae"/></geometry></visual>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.6 0.4 0.4"/></geometry></collision>
  </link>
  <link name="frame"/>
  <link name="box">
    <inertial>
      <origin xyz="0 0 0.05" rpy="0 0 0"/><mass value="0.6"/>
      <inertia ixx="0.00082" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.00232"/>
    </inertial>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.2 0.08 0.1"/></geometry></collision>
  </link>
  <joint name="a" type="fixed"><parent link="map"/><child link="table"/></joint>
  <joint name="b" type="fixed"><origin xyz="0 0 0.4"/><parent link="table"/><child link="frame"/></joint>
  <joint name="c" type="floating">
    <origin xyz="0.1 0 0" rpy="0 0 1.5707963267948966"/><parent link="frame"/><child link="box"/>
  </joint>
</robot>
"""


def test_a_tower_of_others_is_read():
    scene = read_urdf(OTHERS, friction=0.5)
    table, box = scene["blocks"]
    assert scene["name"] == "shelf" and scene["friction"] == 0.5
    assert table["fixed"] and table["comment"] == "table" and table["pos"] == pytest.approx([0, 0, 0.2])
    assert box["pos"] == pytest.approx([0.1, 0, 0.45]) and box["yaw"] == pytest.approx(math.pi / 2)
    assert box["mass"] == 0.6 and not box.get("fixed")
    world = teeter.World(scene)
    world.run_for(1.0)
    assert np.abs(world.poses[1, :3] - box["pos"]).max() < 1e-3


def link(inside, name="l"):
    return f'<link name="{name}">{inside}</link>'


BOX = "<collision><geometry><box size='1 1 1'/></geometry></collision>"
MOMENTS = " ".join(f"{name}='{1 / 6}'" for name in ("ixx", "iyy", "izz"))
MASS = f"<inertial><mass value='1'/><inertia {MOMENTS} ixy='0' ixz='0' iyz='0'/></inertial>"


def joint(kind="floating", child="l", parent="w"):
    return f'<joint name="{child}{parent}" type="{kind}"><parent link="{parent}"/><child link="{child}"/></joint>'


WORLD = '<link name="w"/>\n'
REFUSED = {
    "sphere": (link(MASS + "<collision><geometry>\n<sphere radius='1'/></geometry></collision>"), "geometry", 2),
    "hinge": (WORLD + link(MASS + BOX) + "\n" + joint("revolute"), "type", 3),
    "two boxes": (link(MASS + BOX + "\n" + BOX), "collision", 2),
    "no mass": (link(BOX), "inertial", 1),
    "no link": (link(MASS + BOX) + joint("floating", parent="nowhere"), "link", 1),
    "ring": (link(MASS + BOX) + link("", "w") + joint() + joint("fixed", "w", "l"), "parent", 1),
    "part": (WORLD + link(MASS + BOX) + link(MASS + BOX, "m") + joint() + "\n" + joint("fixed", "m", "l"), "joint", 3),
    "bad number": (link(MASS + "<collision><geometry>\n<box size='1 1'/></geometry></collision>"), "size", 2),
    "not a number": (link(MASS + "<collision><geometry>\n<box size='1 1 nan'/></geometry></collision>"), "size", 2),
    "hollow": (link(MASS.replace(str(1 / 6), "0.3") + BOX), "inertia", 1),
    "macro": ("<xacro:macro/>", None, None),
    "transparent": ("\n<sensor/>" + link(MASS + BOX), "sensor", 2),
    "empty": ("", "geom", None),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_scene_cannot_say_is_refused_with_its_line(name):
    inside, field, line = REFUSED[name]
    with pytest.raises(InterchangeError) as caught:
        read_urdf(f"<robot name='r'>{inside}</robot>")
    if name != "macro":
        assert (caught.value.field, caught.value.line) == (field, line), str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_document_type_is_refused():
    with pytest.raises(InterchangeError) as caught:
        read_urdf('<!DOCTYPE robot [<!ENTITY a "b">]>\n<robot name="&a;"/>')
    assert caught.value.field == "DOCTYPE"


@settings(max_examples=100, deadline=None, derandomize=True)
@given(damaged(OTHERS))
def test_a_damaged_document_is_read_or_refused(text):
    # any other exception fails the test
    with contextlib.suppress(InterchangeError):
        scenes.load(read_urdf(text))
