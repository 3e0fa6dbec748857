"""Worlds: closed forms of statics and dynamics, copies, and the bits of a state."""

import copy
import multiprocessing
import os
import pickle
import threading

import numpy as np
import pytest

import teeter

G = 9.81


@pytest.fixture(scope="module")
def tower():
    world = teeter.World("tower")
    world.run_for(1.0)
    return world


def test_a_block_in_the_air_falls_by_the_parabola():
    scene = teeter.scenes.named("block")
    scene["blocks"][0]["pos"][2] += 1.0
    world = teeter.World(scene)
    start = world.poses[0, 2]
    world.run_for(0.4)
    assert start - world.poses[0, 2] == pytest.approx(0.5 * G * world.time**2, rel=1e-3)
    assert world.velocities[0, 2] == pytest.approx(-G * world.time, rel=1e-3)


def test_the_floor_bears_the_whole_tower_and_pairs_are_named_once(tower):
    contacts = tower.contacts()
    floor = contacts.b == -1
    assert contacts.force[floor].sum() == pytest.approx(G * tower.masses.sum(), rel=1e-4)
    pairs = list(zip(contacts.a, contacts.b, strict=True))
    assert len(pairs) == len(set(pairs)) == len(contacts)
    assert np.all((contacts.b == -1) | (contacts.a < contacts.b))
    assert contacts.normal[floor] == pytest.approx(np.tile([0, 0, 1], (floor.sum(), 1)), abs=1e-3)


def test_the_contacts_of_a_block_balance_its_weight(tower):
    contacts = tower.contacts(20)
    force = (contacts.force[:, None] * contacts.normal).sum(axis=0)
    assert np.all(contacts.a == 20)
    assert force[2] == pytest.approx(G * tower.masses[20], rel=0.02)


def test_the_xray_of_a_column_counts_the_blocks_above():
    world = teeter.World("column")
    world.run_for(1.0)
    loads = world.xray()
    weight = G * world.masses[0]
    assert loads.below == pytest.approx(weight * np.arange(10, 0, -1), rel=1e-3)
    assert loads.above == pytest.approx(weight * np.arange(9, -1, -1), rel=1e-3, abs=1e-6)
    assert world.xray(0.2).tightness == pytest.approx(loads.tightness / 2)
    assert loads.loose.tolist() == [False] * 9 + [True]


def test_a_removal_falls_where_rigid_blocks_do():
    bridge = teeter.scenes.config("(010)-(111)")
    stands = teeter.remove(bridge, 1)
    assert (stands["id"], stands["fell"], stands["exact_fell"]) == (1, False, False)
    falls = teeter.remove(bridge, 0)
    assert falls["fell"] and falls["exact_fell"] and falls["creep_mm"] == 0.0
    with pytest.raises(teeter.BodyError):
        teeter.remove(bridge, 4)
    with pytest.raises(teeter.SceneError):
        teeter.remove("block", 0)


def test_a_block_breaks_away_at_coulombs_force_and_the_world_stays():
    world = teeter.World("block")
    world.run_for(1.0)
    before = world.hash()
    coulomb = 0.4 * G * world.masses[0]
    assert world.breakaway_force(0) == pytest.approx(coulomb, rel=0.01)
    assert world.breakaway_force(0, (0, -3, 0)) == pytest.approx(coulomb, rel=0.01)
    assert world.breakaway_force(0, (0, 0, -1)) is None
    assert world.hash() == before


def test_a_block_stays_below_coulombs_force_and_slides_above():
    for share, slides in ((0.9, False), (1.1, True)):
        world = teeter.World("block")
        world.run_for(0.5)
        start = world.poses[0, 0]
        force = share * 0.4 * G * world.masses[0]
        world.run_for(0.5, forces=[teeter.Force(body=0, force=(force, 0, 0))])
        assert (world.poses[0, 0] - start > 0.01) == slides


def test_a_hand_carries_a_block_to_its_target_with_its_weight():
    world = teeter.World("block")
    target = world.poses[0, :3] + [0, 0, 0.05]
    report = world.run_for(1.5, hand=teeter.Hand(body=0, target=target, grip="carry", orientation=(0, 0, 0, 1)))
    assert report.hand.point == pytest.approx(target, abs=1e-5)
    assert report.hand.force[2] == pytest.approx(G * world.masses[0], rel=1e-3)
    assert not report.hand.capped


def test_a_hand_never_gives_more_than_its_force():
    world = teeter.World("tower")
    hand = teeter.Hand(body=22, target=world.poses[22, :3] + [0.5, 0, 0], max_force=0.5)
    forces = [np.linalg.norm(world.step(hand=hand).hand.force) for _ in range(30)]
    assert max(forces) <= 0.5 + 1e-12 and max(forces) > 0.49


def test_a_drive_moves_a_block_at_its_velocity():
    world = teeter.World("block")
    start = world.poses[0, 0]
    world.run_for(1.0, drives=[teeter.Drive(body=0, velocity=np.array([0.1, 0, 0]))])
    assert world.poses[0, 0] - start == pytest.approx(0.1, abs=2e-3)


def test_gravity_of_an_input_replaces_that_of_the_scene():
    world = teeter.World("block")
    world.step(gravity=(0, 0, 5.0))
    world.run_for(0.2, gravity=(0, 0, 5.0))
    assert world.velocities[0, 2] > 0.5


def test_energy_is_conserved_in_the_air():
    scene = teeter.scenes.named("block")
    scene["blocks"][0]["pos"][2] += 0.5
    world = teeter.World(scene)
    before = world.energy
    world.run_for(0.2)
    after = world.energy
    assert after.kinetic > 0 and after.total == pytest.approx(before.total, rel=1e-6)
    assert after.total == after.kinetic + after.potential + after.elastic


def test_a_snapshot_restores_the_future_bit_for_bit(tower):
    world = tower.clone()
    state = world.snapshot()
    world.run_for(0.3, drives=[teeter.Drive(body=9, velocity=(1, 0, 0))])
    end = world.hash()
    world.restore(state)
    assert world.hash() == tower.hash() and world.time == tower.time
    world.run_for(0.3, drives=[teeter.Drive(body=9, velocity=(1, 0, 0))])
    assert world.hash() == end


@pytest.mark.parametrize(
    "duplicate",
    [
        lambda world: world.clone(),
        copy.copy,
        copy.deepcopy,
        lambda world: pickle.loads(pickle.dumps(world)),
    ],
    ids=["clone", "copy", "deepcopy", "pickle"],
)
def test_a_copy_goes_on_alike_and_alone(tower, duplicate):
    before = tower.hash()
    other = duplicate(tower)
    assert other.hash() == before and other.params == tower.params and other.scene == tower.scene
    other.run_for(0.2, forces=[teeter.Force(body=50, force=(0.1, 0, 0))])
    assert other.hash() != before and tower.hash() == before


def test_a_lattice_world_survives_a_pickle_and_a_change_of_form():
    scene = teeter.scenes.named("column") | {"form": "lattice"}
    world = teeter.World(scene)
    world.run_for(0.2)
    again = pickle.loads(pickle.dumps(world))
    assert again.hash() == world.hash() and again.form == "lattice"
    particles, forces = world.lattice(0)
    assert particles.shape == (8, 3) and forces.shape == (28,)
    assert particles.mean(axis=0) == pytest.approx(world.poses[0, :3], abs=1e-9)
    world.set_form("rigid")
    assert world.form == "rigid" and world.lattice(0) is None and world.spring_stiffness is None
    assert pickle.loads(pickle.dumps(world)).hash() == world.hash()


def test_a_scene_of_the_present_state_has_its_poses(tower):
    scene = tower.to_scene()
    assert [block["pos"] for block in scene["blocks"]] == tower.poses[:, :3].tolist()
    assert teeter.World(scene).poses[:, :3] == pytest.approx(tower.poses[:, :3], abs=2e-4)


def test_arrays_are_copies_of_the_stated_shapes(tower):
    n = len(tower)
    assert tower.poses.shape == (n, teeter.POSE_STRIDE) and tower.velocities.shape == (n, 6)
    assert tower.sizes.shape == (n, 3) and tower.masses.shape == (n,) and tower.asleep.shape == (n,)
    tower.poses[:] = 0.0
    assert tower.poses[:, 2].min() > 0
    assert tower.ids == list(range(n)) and tower.quarantined == [] and tower.warnings == []


def test_velocity_and_orientation_are_set():
    world = teeter.World("block")
    world.set_velocity(0, (0.0, 0.0, 1.0), spin=[0, 0, 2])
    assert world.velocities[0] == pytest.approx([0, 0, 1, 0, 0, 2])
    world.set_orientation(0, (0, 0, 2, 0))
    assert world.poses[0, 3:] == pytest.approx([0, 0, 1, 0])


def test_the_page_of_a_notation_a_name_a_dict_and_a_file_build_the_same_world(tmp_path):
    notation = "(111)-(101)"
    scene = teeter.scenes.config(notation)
    path = tmp_path / "scene.json"
    path.write_text(__import__("json").dumps(scene))
    hashes = {teeter.World(source).hash() for source in (notation, scene, path, str(path))}
    assert len(hashes) == 1
    assert teeter.World("tower").hash() == teeter.World(teeter.scenes.named("tower")).hash()


def test_a_picture_shows_wood_in_its_middle_and_has_its_shape(tower):
    picture = tower.render(96, 72)
    assert picture.shape == (72, 96, 3) and picture.dtype == np.uint8
    red, _, blue = picture[36, 48].astype(int)
    assert red > blue + 30
    assert not np.array_equal(picture, tower.render(96, 72, azimuth=1.0))


def test_other_threads_run_while_a_world_is_stepped():
    world = teeter.World("tower", sleep=False)
    done, ticks = threading.Event(), 0

    def step():
        world.run_for(1.0)
        done.set()

    thread = threading.Thread(target=step)
    thread.start()
    while not done.wait(1e-4):
        ticks += 1
    thread.join()
    # A thread that held the lock for the whole run would leave none.
    assert ticks > 3


def test_a_world_that_is_stepped_elsewhere_raises_and_stays_whole():
    world = teeter.World("tower", sleep=False)
    thread = threading.Thread(target=lambda: world.run_for(1.0))
    thread.start()
    raised = 0
    while thread.is_alive():
        try:
            world.hash()
        except RuntimeError:
            raised += 1
    thread.join()
    assert raised > 0
    assert world.time == pytest.approx(1.0)


def _hash_in_child(queue):
    scene = teeter.scenes.field(2, rows=2)
    batch = teeter.WorldBatch([scene, scene])
    batch.step()
    queue.put(batch.hashes())


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork")
def test_a_forked_child_steps_worlds_and_batches_as_its_parent_does():
    here = multiprocessing.get_context("fork")
    queue = here.Queue()
    _hash_in_child(queue)
    parent = queue.get()
    child = here.Process(target=_hash_in_child, args=(queue,))
    child.start()
    assert queue.get(timeout=60) == parent
    child.join()
