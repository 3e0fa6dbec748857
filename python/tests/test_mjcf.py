"""MJCF: a tower stands in MuJoCo, scenes come back as they were, and models of others are read."""

import contextlib
import math

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from scene_draws import assert_same, damaged
from scene_draws import scenes as drawn_scenes

import teeter
from teeter import InterchangeError, scenes
from teeter.interchange import DEFAULTS, read_mjcf, write_mjcf


@settings(max_examples=40, deadline=None)
@given(drawn_scenes())
def test_a_scene_comes_back_as_it_was(scene):
    scene = scenes.load(scene)
    assert_same(scene, scenes.load(read_mjcf(write_mjcf(scene))))


@pytest.mark.parametrize("name", ["tower", "cards", "test-4"])
def test_scenes_of_the_list_come_back(name):
    scene = scenes.named(name)
    back = read_mjcf(write_mjcf(scene))
    assert_same(scene, back)
    assert teeter.World(back, ramp=0.1).masses == pytest.approx(teeter.World(scene, ramp=0.1).masses)


def test_a_tower_stands_in_mujoco():
    scene = scenes.tower(rows=4)
    model = mujoco.MjModel.from_xml_string(write_mjcf(scene))
    data = mujoco.MjData(model)
    start = data.qpos.reshape(-1, 7)[:, :3].copy()
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    settled = data.qpos.reshape(-1, 7)[:, :3].copy()
    while data.time < 5.0:
        mujoco.mj_step(model, data)
    now = data.qpos.reshape(-1, 7)[:, :3]
    # soft contacts let it sink; after that it may creep by little
    assert np.abs(now - start).max() < 2e-3
    assert np.abs(now - settled).max() < 1e-4


def test_the_model_has_the_masses_inertia_and_friction_of_the_scene():
    scene = scenes.tower(rows=2)
    model = mujoco.MjModel.from_xml_string(write_mjcf(scene, DEFAULTS))
    world = teeter.World(scene, ramp=0.1)
    assert model.body_mass[1:] == pytest.approx(world.masses)
    expected = world.masses[:, None] / 12 * ((world.sizes**2).sum(axis=1, keepdims=True) - world.sizes**2)
    assert np.sort(model.body_inertia[1:]) == pytest.approx(np.sort(expected))
    assert np.all(model.geom_friction[:, 0] == scene["friction"])


def test_contacts_of_two_coefficients_have_the_geometric_mean_there_too():
    scene = scenes.config("(010)-(010)")
    scene["blocks"][1]["friction"] = 0.1
    model = mujoco.MjModel.from_xml_string(write_mjcf(scene))
    data = mujoco.MjData(model)
    for _ in range(200):
        mujoco.mj_step(model, data)
    ends = {frozenset(int(g) for g in contact.geom): contact.friction[0] for contact in data.contact}
    assert ends[frozenset({0, 1})] == pytest.approx(0.4)
    assert ends[frozenset({1, 2})] == pytest.approx(math.sqrt(0.4 * 0.1))


# As a tutorial of MuJoCo would have it: degrees, classes, densities, a nested table.
OTHERS = """<?xml version="1.0" encoding="utf-8"?>
<!-- a small stack -->
<mujoco model="stack">
  <compiler angle="degree" eulerseq="xyz"/>
  <option timestep="0.004" gravity="0 0 -9.8"/>
  <visual><headlight ambient="0.4 0.4 0.4"/></visual>
  <default>
    <geom friction="0.6 0.005 0.0001"/>
    <default class="brick"><geom type="box" size="0.1 0.05 0.025" density="700"/></default>
  </default>
  <asset><material name="grey" rgba="0.5 0.5 0.5 1"/></asset>
  <worldbody>
    <light pos="0 0 3"/>
    <geom name="ground" type="plane" size="2 2 0.1" material="grey"/>
    <body name="table" pos="1 0 0">
      <geom name="leg" type="box" size="0.05 0.05 0.2" pos="0 0 0.2"/>
      <body name="top" pos="0 0 0.4" euler="0 0 90">
        <geom name="plate" type="box" size="0.3 0.2 0.01" pos="0 0 0.01"/>
      </body>
    </body>
    <body name="low" pos="0 0 0.025"><freejoint/><geom class="brick"/></body>
    <body name="high" pos="0 0 0.075" euler="0 0 30"><joint type="free"/><geom class="brick" rgba="1 0 0 1"/></body>
    <body name="heavy" pos="1 0 0.52" axisangle="0 1 0 90">
      <freejoint/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.0041667 0.0070833 0.0104167"/>
      <geom type="box" size="0.1 0.075 0.025"/>
      <site name="mark" pos="0 0 0.1"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_a_model_of_others_is_read():
    scene = read_mjcf(OTHERS)
    blocks = {block["comment"]: block for block in scene["blocks"]}
    assert scene["name"] == "stack" and scene["gravity"] == 9.8 and scene["friction"] == 0.6
    assert list(blocks) == ["leg", "plate", "low", "high", "heavy"]
    assert blocks["leg"]["fixed"] and blocks["plate"]["fixed"] and not blocks["low"].get("fixed")
    assert blocks["plate"]["pos"] == pytest.approx([1, 0, 0.41]) and blocks["plate"]["yaw"] == pytest.approx(
        math.pi / 2
    )
    assert blocks["low"]["mass"] == pytest.approx(700 * 0.2 * 0.1 * 0.05)
    assert blocks["high"]["yaw"] == pytest.approx(math.radians(30))
    half = math.sqrt(0.5)
    assert blocks["heavy"]["mass"] == 2 and blocks["heavy"]["orientation"] == pytest.approx([0, half, 0, half])
    teeter.World(scene)


BODY = '<body name="b" pos="0 0 1"><freejoint/><geom type="box" size=".1 .1 .1"/></body>'


def model(body=BODY, *, before="", world="", after=""):
    return f"<mujoco>\n{before}\n<worldbody>\n{world}\n{body}\n</worldbody>\n{after}\n</mujoco>"


def test_a_smooth_floor_under_rough_blocks_is_represented():
    scene = read_mjcf(
        model(
            '<body pos="0 0 1"><freejoint/><geom type="box" size=".1 .1 .1" friction="0.4"/></body>',
            world='<geom type="plane" size="1 1 1" friction="0.8"/>',
        )
    )
    # the larger of the two in MuJoCo is the mean of 0.4 and 1.6
    assert scene["blocks"][0]["friction"] == pytest.approx(0.4)
    assert math.sqrt(scene["friction"] * 0.4) == pytest.approx(0.8)


BOX = '<geom type="box" size=".1 .1 .1"/>'
INERTIA = '<inertial pos="{}" mass="1" diaginertia=".01 .01 .01"/>'


def body(inside=BOX, *, joint="<freejoint/>", height=1):
    return f'<body name="c" pos="0 0 {height}">{joint}{inside}</body>'


REFUSED = {
    "sphere": (model(body('<geom type="sphere" size=".1"/>')), "type", 5),
    "hinge": (model(body(joint='<joint type="hinge"/>')), "joint", 5),
    "damped": (model(body(joint='<joint type="free" damping="1"/>')), "damping", 5),
    "two boxes": (model(body(BOX + "\n" + BOX)), "body", 5),
    "part": (model(body(f"{BOX}\n<body>{BOX}</body>")), "body", 6),
    "off centre": (model(body(INERTIA.format(".05 0 0") + BOX)), "body", 5),
    "hollow": (model(body(INERTIA.format("0 0 0") + BOX)), "body", 5),
    "floating up": (model(body().replace("pos", 'gravcomp="1" pos')), "gravcomp", 5),
    "mixed friction": (
        model(body() + body(BOX.replace("size", 'friction=".3" size'), height=2).replace('"c"', '"d"')),
        "worldbody",
        3,
    ),
    "ghost": (
        model(BODY + "\n" + body(BOX.replace("size", 'contype="2" conaffinity="2" size'), height=2)),
        "contype",
        5,
    ),
    "welded": (model(after='<equality>\n<weld body1="b"/></equality>'), "equality", 7),
    "motor": (model(after='<actuator><motor site="x"/></actuator>'), "actuator", 7),
    "exclude": (
        model(body(height=2) + BODY, after='<contact>\n<exclude body1="b" body2="c"/></contact>'),
        "exclude",
        8,
    ),
    "wind": (model(before='<option wind="1 0 0"/>'), "option", 2),
    "sideways": (model(before='<option gravity="1 0 -9"/>'), "gravity", 2),
    "slope": (model(world='<geom type="plane" size="1 1 1" euler="10 0 0"/>'), "geom", 4),
    "raised floor": (model(world='<geom type="plane" size="1 1 1" pos="0 0 .1"/>'), "geom", 4),
    "file": (model(before='<asset><mesh name="m" file="/etc/passwd"/></asset>'), "file", 2),
    "include": (model(before='<include file="x.xml"/>'), "include", 2),
    "plugin": (model(before='<extension><plugin plugin="p"/></extension>'), "plugin", 2),
    "memory": (model(before='<size memory="64G"/>'), "memory", 2),
    "user data": (model(before='<size nuser_geom="1000000000"/>'), "nuser_geom", 2),
    "picture": (
        model(before='<asset><texture type="2d" builtin="flat" width="99999" height="1"/></asset>'),
        "width",
        2,
    ),
    "unknown": (model(world='<geom type="box" size=".1 .1 .1" colour="red"/>'), None, 4),
    "empty": (model(""), "geom", None),
    "not XML": ("<mujoco><worldbody>\n</mujoco>", None, 2),
    "another format": ("<robot name='r'/>", "robot", 1),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_scene_cannot_say_is_refused_with_its_line(name):
    text, field, line = REFUSED[name]
    with pytest.raises(InterchangeError) as caught:
        read_mjcf(text)
    assert (caught.value.field, caught.value.line) == (field, line), str(caught.value)
    assert "\n" not in str(caught.value)


def test_reading_writes_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # MuJoCo warns of a number that is none
    read_mjcf(model(before='<option timestep="nan"/>'))
    assert not list(tmp_path.iterdir())


ENTITIES = '<!DOCTYPE mujoco [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>\n<mujoco model="&b;"/>'
OUTSIDE = '<!DOCTYPE mujoco [<!ENTITY a SYSTEM "file:///etc/passwd">]>\n<mujoco>&a;</mujoco>'


@pytest.mark.parametrize("text", [ENTITIES, OUTSIDE, "<mujoco>" * 200 + "</mujoco>" * 200, "", "\0", b"\xff\xfe<"])
def test_hostile_documents_are_refused(text):
    with pytest.raises(InterchangeError):
        read_mjcf(text)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(damaged(OTHERS))
def test_a_damaged_document_is_read_or_refused(text):
    # any other exception fails the test
    with contextlib.suppress(InterchangeError):
        scenes.load(read_mjcf(text))
