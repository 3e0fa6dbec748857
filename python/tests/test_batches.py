"""Batches: the bits of single worlds, live views, per-world constants and rollouts."""

import numpy as np
import pytest

import teeter
from teeter import Drive, Force, Hand, scenes

ROWS = 4


def towers(count):
    return [scenes.tower(rows=ROWS, seed=seed) for seed in range(count)]


def inputs(count):
    """Inputs of every kind, another for each world, and none for the last."""
    some = [
        {"drives": [Drive(body=4, velocity=(0.5, 0, 0))]},
        {"forces": [Force(body=9, force=(0.0, 0.2, 0.1))]},
        {"hand": Hand(body=11, target=(0, 0, 0.2), grip="carry")},
        {"gravity": (0.5, 0, -9.0)},
    ]
    return [some[i % len(some)] for i in range(count - 1)] + [None]


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_batch_has_the_bits_of_single_worlds_in_any_number_of_threads(threads):
    given = inputs(6)
    batch = teeter.WorldBatch(towers(6), threads=threads)
    worlds = [teeter.World(scene) for scene in towers(6)]
    for _ in range(40):
        batch.step(given)
    batch.run_for(0.2)
    for world, item in zip(worlds, given, strict=True):
        for _ in range(40):
            world.step(**(item or {}))
        world.run_for(0.2)
    assert batch.hashes() == [world.hash() for world in worlds]
    assert batch.threads == threads
    for i, world in enumerate(worlds):
        assert np.array_equal(batch.poses[i], world.poses)
        assert np.array_equal(batch.velocities[i], world.velocities)
        assert batch.times[i] == world.time
        assert np.array_equal(batch.xray()[i, :, 2], world.xray().tightness, equal_nan=True)


def test_views_are_live_and_cannot_be_written():
    batch = teeter.WorldBatch(towers(2))
    poses, times = batch.poses, batch.times
    before = poses.copy()
    batch.step([{"drives": [Drive(body=9, velocity=(1, 0, 0))]}, None], frames=3)
    assert not np.array_equal(poses[0], before[0])
    assert times == pytest.approx([0.05, 0.05])
    with pytest.raises(ValueError, match="read-only"):
        poses[0, 0, 0] = 1.0


def test_worlds_of_a_batch_have_constants_of_their_own():
    friction = np.array([0.1, 0.3, 0.6])
    batch = teeter.WorldBatch(scenes.vary("block", 3, friction=friction))
    weight = 9.81 * batch.world(0).masses[0]
    push = {"forces": [Force(body=0, force=(0.35 * weight, 0, 0))]}
    batch.run_for(0.5, [push] * 3)
    slides = batch.velocities[:, 0, 0] > 0.1
    assert slides.tolist() == [True, True, False]


def test_varied_scenes_scale_masses_and_heights():
    heavy, low = scenes.vary("column", 2, mass=[2.0, 1.0], height=[1.0, 0.5])
    base = scenes.named("column")
    assert heavy["blocks"][3]["mass"] == 2 * base["blocks"][3]["mass"]
    assert low["blocks"][3]["pos"][2] == base["blocks"][3]["pos"][2] / 2
    assert base == scenes.named("column")
    with pytest.raises(teeter.SceneError, match="`colour`") as error:
        scenes.vary("column", 1, colour=[1.0])
    assert error.value.field == "colour"
    with pytest.raises(teeter.SceneError, match="2 values, expected 3"):
        scenes.vary("column", 3, friction=[0.1, 0.2])


def test_a_reset_puts_the_chosen_worlds_back():
    batch = teeter.WorldBatch(towers(3))
    start = batch.hashes()
    batch.step([{"drives": [Drive(body=9, velocity=(1, 0, 0))]}] * 3, frames=5)
    moved = batch.hashes()
    batch.reset([False, True, False])
    assert batch.hashes() == [moved[0], start[1], moved[2]]
    assert batch.times[1] == 0.0
    batch.reset()
    assert batch.hashes() == start


def test_a_state_of_a_world_can_be_restored_into_a_batch():
    batch = teeter.WorldBatch(towers(2))
    world = batch.world(1)
    world.run_for(0.2, drives=[Drive(body=9, velocity=(0.5, 0, 0))])
    batch.restore(1, world.snapshot())
    assert batch.hashes()[1] == world.hash()
    assert np.array_equal(batch.poses[1], world.poses)
    assert batch.snapshots()[1] == world.snapshot()


@pytest.mark.parametrize("threads", [1, 2])
def test_a_rollout_is_the_same_as_stepping_and_leaves_the_batch_alone(threads):
    frames, rng = 30, np.random.default_rng(1)
    batch = teeter.WorldBatch(towers(2), threads=threads)
    start = batch.hashes()
    forces = rng.uniform(-0.3, 0.3, (2, frames, 2, 3))
    gravity = np.tile([0.0, 0.0, -9.0], (2, frames, 1))
    hand = Hand(body=11, target=(0, 0, 0), grip="carry", max_force=1.0)
    targets = rng.uniform(-0.01, 0.01, (2, frames, 3)) + [0, 0, 0.15]
    result = batch.rollout(
        frames, forces=forces, bodies=[9, 10], gravity=gravity, hands=[hand, None], targets=targets, every=10
    )
    assert batch.hashes() == start
    assert result.poses.shape == (2, 3, 12, 7) and result.velocities.shape == (2, 3, 12, 6)
    assert result.times == pytest.approx([10 / 60, 20 / 60, 30 / 60])
    for i in range(2):
        world = batch.world(i)
        for t in range(frames):
            pushes = [Force(body=9, force=forces[i, t, 0]), Force(body=10, force=forces[i, t, 1])]
            held = Hand(body=11, target=targets[i, t], grip="carry", max_force=1.0) if i == 0 else None
            world.step(hand=held, forces=pushes, gravity=gravity[i, t])
            if t == 19:
                assert np.array_equal(result.poses[i, 1], world.poses)
                assert np.array_equal(result.velocities[i, 1], world.velocities)
        assert result.hashes[i] == world.hash()


def test_a_batch_names_the_scene_that_is_wrong():
    scene = scenes.named("block")
    scene["blocks"][0]["mass"] = -1
    with pytest.raises(teeter.SceneError, match=r"scenes\[1\]: block 0: `mass` is -1"):
        teeter.WorldBatch(["block", scene])
    with pytest.raises(teeter.InputError, match=r"`scenes\[1\]` has 10 blocks, expected 1"):
        teeter.WorldBatch(["block", "column"])
    with pytest.raises(teeter.InputError, match="`inputs`"):
        teeter.WorldBatch(["block"]).step([None, None])
    with pytest.raises(teeter.BodyError, match=r"`inputs\[0\].hand.body` is 5"):
        teeter.WorldBatch(["block"]).step([{"hand": Hand(body=5, target=(0, 0, 0))}])
    with pytest.raises(teeter.InputError, match=r"`forces` is of shape \[1, 2, 1, 3\]"):
        teeter.WorldBatch(["block"]).rollout(3, forces=np.zeros((1, 2, 1, 3)), bodies=[0])
