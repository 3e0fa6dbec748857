"""Exact statics and the definition of a fall, against closed forms and the labelled towers."""

import math

import numpy as np
import pytest

import teeter
from teeter import (
    Footing,
    InputError,
    SceneError,
    World,
    exact_fall,
    exact_forces,
    exact_tilt,
    labelled_towers,
    scenes,
    tilted_towers,
)


def test_statics_agrees_with_every_label_that_it_judges():
    towers = [scene for scene in labelled_towers() if len(scene["blocks"]) <= 12]
    assert len(towers) > 80
    answers = [exact_fall(scene) for scene in towers]
    judged = [(scene, fall) for scene, fall in zip(towers, answers, strict=True) if fall is not None]
    assert len(judged) >= 0.8 * len(towers), "the solver gives up on many"
    wrong = [scene["name"] for scene, fall in judged if fall != (scene["label"] == "unstable")]
    assert not wrong


def test_the_exact_tilt_is_that_of_the_labelled_towers():
    towers = [pair for pair in tilted_towers() if len(pair[0]["blocks"]) <= 12]
    assert len(towers) >= 8
    for scene, angle in towers:
        assert exact_tilt(scene, scene["tilt_az"]) == pytest.approx(angle, abs=1e-3), scene["name"]


@pytest.mark.parametrize("azimuth", [0.0, 0.5, 2.0])
def test_a_block_slides_at_the_angle_of_friction_and_a_column_topples_at_its_edge(azimuth):
    block = scenes.named("block")
    assert math.tan(math.radians(exact_tilt(block, azimuth))) == pytest.approx(block["friction"], rel=1e-6)
    column = scenes.named("column") | {"friction": 2.0}
    width, length = sorted(column["blocks"][0]["size"][:2])
    height = 0.5 * 10 * column["blocks"][0]["size"][2]
    # the resultant passes the nearer edge of the base
    expected = min(0.5 * length / max(abs(math.cos(azimuth)), 1e-9), 0.5 * width / max(abs(math.sin(azimuth)), 1e-9))
    assert math.tan(math.radians(exact_tilt(column, azimuth))) == pytest.approx(expected / height, rel=1e-6)


def test_the_exact_forces_of_a_column_are_coulombs():
    column = scenes.named("column")
    weight = column["gravity"] * column["blocks"][0]["mass"]
    for i, forces in enumerate(exact_forces(column)):
        assert forces["straight_n"] == pytest.approx(column["friction"] * weight * (10 - i), rel=1e-6)
        assert forces["turning_n"] <= forces["straight_n"] * (1 + 1e-9)


@pytest.mark.parametrize("seed", [0, 3])
def test_drawn_towers_have_the_labels_of_statics_and_are_the_same_each_time(seed):
    towers = labelled_towers(4, seed=seed)
    assert [scene["label"] for scene in towers] == ["stable", "unstable"] * 2
    for scene in towers:
        assert exact_fall(scene) == (scene["label"] == "unstable") == (scene["margin"] < 0)
        assert abs(scene["margin"]) >= 0.1
    assert towers == labelled_towers(4, seed=seed)
    assert len({str(scene["blocks"]) for scene in towers}) == 4


def test_a_drawn_label_holds_in_the_engine():
    # clear ones only: within half a millimetre the springs of the engine may decide
    for scene in labelled_towers(6, seed=1):
        if abs(scene["margin"]) < 0.5:
            continue
        footing, world = Footing(scene), World(scene, sleep=False)
        world.run_for(2.0)
        assert footing.any_fallen(world.poses) == (scene["label"] == "unstable"), scene["name"]


def test_towers_are_spread_over_the_set():
    assert [scene["name"] for scene in labelled_towers(400)] == [scene["name"] for scene in labelled_towers()]
    names = [scene["name"] for scene in labelled_towers()]
    some = [names.index(scene["name"]) for scene in labelled_towers(10)]
    assert np.all(np.diff(some) == 40)


def test_a_footing_judges_poses_of_any_engine():
    scene = scenes.config("(111)-(111)")
    poses = World(scene, ramp=0.1).poses
    footing = Footing(scene)
    height = scene["blocks"][0]["size"][2]
    assert len(footing) == 6 and not footing.any_fallen(poses)
    dropped = poses.copy()
    dropped[4, 2] -= 0.15 * height
    assert not footing.any_fallen(dropped)
    dropped[4, 2] -= 0.02 * height
    assert footing.any_fallen(dropped)
    slid = poses.copy()
    slid[4, 1] += 0.3 * height
    assert footing.any_fallen_or_slid(slid) and not footing.any_fallen(slid)
    # as a whole it has not moved against its bearers, and a footing of its poses has not at all
    assert not footing.any_fallen_or_slid(poses + [0, 0, 0, 0, 0, 0, 0])
    assert not Footing(scene, slid).any_fallen_or_slid(slid)
    gone = poses.copy()
    gone[0] = np.nan
    assert footing.any_fallen(gone)


@pytest.mark.parametrize(
    "call, error, field",
    [
        (lambda: labelled_towers(0), InputError, "count"),
        (lambda: labelled_towers(401), InputError, "count"),
        (lambda: labelled_towers(10, seed=-1), InputError, "seed"),
        (lambda: tilted_towers(51), InputError, "count"),
        (lambda: exact_tilt("block", float("nan")), InputError, "azimuth"),
        (lambda: Footing("block", np.zeros((2, 7))), InputError, "poses"),
        (lambda: Footing("block").any_fallen([1, 2]), InputError, "poses"),
        (lambda: exact_forces("test-4"), SceneError, None),
        (lambda: exact_tilt("cards", 0.0), SceneError, None),
        (lambda: exact_fall({}), SceneError, "name"),
    ],
)
def test_bad_input_is_named(call, error, field):
    with pytest.raises(error) as caught:
        call()
    assert caught.value.field == field and isinstance(caught.value, teeter.TeeterError)
