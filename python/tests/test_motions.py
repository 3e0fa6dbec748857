"""Motions as glTF, CSV and Parquet, and the conversion of files."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pygltflib
import pytest

import teeter
from teeter import InputError, InterchangeError, World, scenes
from teeter.interchange import COLUMNS, Motion, convert, read_scene, write_gltf, write_motion, write_scene, write_trace
from teeter.interchange.__main__ import main as program


@pytest.fixture(scope="module")
def record():
    game = teeter.Game(scenes.tower(rows=3), "free", record=True)
    game.take(1, noise="none")
    return game.record()


def test_a_motion_leaves_its_world_as_it_is():
    world = World("test-4")
    before = world.hash()
    states = list(Motion(world, 0.5, every=5))
    assert world.hash() == before and len(states) == 7
    other = World("test-4")
    other.run_for(0.5)
    assert np.array_equal(states[-1].poses, other.poses) and states[-1].time == other.time


def test_the_motion_of_a_record_ends_where_its_game_ended(record):
    states = list(Motion(record, every=1))
    assert len(states) == record.frames + 1
    assert np.array_equal(states[-1].poses, record.game(record.frames).poses)
    assert len(list(Motion(record, 0.5, every=10))) == 4


@pytest.mark.parametrize("arguments", [{"seconds": -1.0}, {"seconds": float("nan")}, {"every": 0}, {"every": True}])
def test_bad_lengths_of_a_motion_are_named(arguments):
    with pytest.raises(InputError) as caught:
        Motion("block", **arguments)
    assert caught.value.field in arguments


def accessor(document, index):
    """Values of an accessor, as float32 or uint16."""
    part = document.accessors[index]
    view = document.bufferViews[part.bufferView]
    data = document.binary_blob()[view.byteOffset : view.byteOffset + view.byteLength]
    kind = np.uint16 if part.componentType == pygltflib.UNSIGNED_SHORT else np.float32
    values = np.frombuffer(data, dtype=kind).reshape(part.count, -1)
    if part.min:
        assert values.min(axis=0).tolist() == part.min and values.max(axis=0).tolist() == part.max
    return values


def test_a_gltf_file_has_a_named_node_a_block_and_its_poses(tmp_path):
    motion = Motion("test-4", 0.5)
    write_gltf(motion, tmp_path / "fall.glb")
    document = pygltflib.GLTF2().load(tmp_path / "fall.glb")
    states = list(motion)
    blocks = motion.scene["blocks"]
    assert [document.nodes[child].name for child in document.nodes[0].children] == [f"block {b['id']}" for b in blocks]
    assert document.buffers[0].byteLength == len(document.binary_blob())
    seen = set()
    for channel in document.animations[0].channels:
        sampler = document.animations[0].samplers[channel.sampler]
        node, path = channel.target.node, channel.target.path
        values = accessor(document, sampler.output)
        expected = np.array([s.poses[node - 1, :3] if path == "translation" else s.poses[node - 1, 3:] for s in states])
        assert accessor(document, sampler.input)[:, 0] == pytest.approx([s.time for s in states], abs=1e-6)
        if path == "rotation":
            assert np.linalg.norm(values, axis=1) == pytest.approx(1.0, abs=1e-6)
            assert np.all((values[1:] * values[:-1]).sum(axis=1) > 0), "a sampler would take the longer path"
            expected *= np.sign((expected * values).sum(axis=1, keepdims=True))
        assert values == pytest.approx(expected, abs=1e-6)
        seen.add((node, path))
    assert len(seen) == 2 * len(blocks)


def test_the_cuboid_of_a_gltf_file_is_closed_and_faces_outwards(tmp_path):
    write_gltf(Motion("block", 0.0), tmp_path / "block.glb")
    document = pygltflib.GLTF2().load(tmp_path / "block.glb")
    primitive = document.meshes[0].primitives[0]
    corners, normals = (accessor(document, i) for i in (primitive.attributes.POSITION, primitive.attributes.NORMAL))
    triangles = corners[accessor(document, primitive.indices).reshape(-1, 3)]
    turned = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    # the volume of a closed surface, by the divergence theorem
    assert (triangles[:, 0] * turned).sum() / 6 == pytest.approx(1.0)
    assert np.all((turned * normals[accessor(document, primitive.indices).reshape(-1, 3)[:, 0]]).sum(axis=1) > 0)
    assert document.nodes[1].scale == pytest.approx(scenes.named("block")["blocks"][0]["size"])
    # z up becomes y up
    assert document.nodes[0].rotation == pytest.approx([-(0.5**0.5), 0, 0, 0.5**0.5])
    assert not document.animations


def run(*arguments):
    environment = {"PYTHONPATH": str(Path(teeter.__file__).parents[1])}
    command = [sys.executable, "-m", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
def test_a_trace_is_that_of_the_program(tmp_path, suffix):
    ours, theirs = tmp_path / f"ours.{suffix}", tmp_path / f"theirs.{suffix}"
    done = run("teeter", "run", "test-4", "--seconds", "0.3", "--trace", str(theirs), "--trace-every", "3")
    assert done.returncode == 0, done.stderr
    write_trace(Motion("test-4", 0.3, every=3), ours)
    if suffix == "parquet":
        one, other = pq.read_table(ours), pq.read_table(theirs)
        assert one.schema.equals(other.schema, check_metadata=False) and one.equals(other)
        assert one.schema.metadata == {key: other.schema.metadata[key] for key in one.schema.metadata}
        return
    with ours.open() as one, theirs.open() as other:
        rows, expected = list(csv.DictReader(one)), list(csv.DictReader(other))
    assert list(rows[0]) == COLUMNS == list(expected[0])
    for row, wanted in zip(rows, expected, strict=True):
        assert [row[name] for name in ("id", "asleep")] == [wanted[name] for name in ("id", "asleep")]
        numbers = [name for name in COLUMNS if name not in ("asleep", "quarantined")]
        assert [float(row[name]) for name in numbers] == [float(wanted[name]) for name in numbers]


def test_a_failed_trace_leaves_no_file(tmp_path):
    with pytest.raises(InputError):
        write_trace(Motion("block", 0.1), tmp_path / "trace.xlsx")
    with pytest.raises(OSError):
        write_trace(Motion("block", 0.1), tmp_path / "none" / "trace.csv")
    assert not list(tmp_path.iterdir())


def test_files_are_converted_by_their_suffixes(tmp_path, record):
    (tmp_path / "game.record").write_bytes(record.encode())
    scene = scenes.tower(rows=2)
    write_scene(scene, tmp_path / "a.json")
    for before, after in (("a.json", "b.xml"), ("b.xml", "c.urdf"), ("c.urdf", "d.mjcf"), ("b.xml", "e.json")):
        convert(tmp_path / before, tmp_path / after)
    assert read_scene(tmp_path / "e.json") == scenes.load(scene)
    assert read_scene(tmp_path / "d.mjcf")["blocks"] == scenes.load(scene)["blocks"]
    assert read_scene(tmp_path / "game.record") == record.scene
    for name in ("f.glb", "g.csv", "h.parquet"):
        convert(tmp_path / "game.record", tmp_path / name, every=30)
    assert pq.read_table(tmp_path / "h.parquet").num_rows == 9 * (1 + record.frames // 30)
    assert json.loads((tmp_path / "e.json").read_text())["name"] == scene["name"]


def test_the_program_converts_and_names_what_it_cannot(tmp_path, capsys):
    assert program(["convert", "column", str(tmp_path / "a.csv"), "--seconds", "0.1"]) == 0
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 1 + 7 * 10
    bad = tmp_path / "bad.xml"
    bad.write_text("<mujoco>\n<worldbody>\n<geom type='sphere' size='1'/></worldbody></mujoco>")
    for words in ((str(bad), "b.json"), ("column", "b.obj"), ("castle", "b.xml"), (str(tmp_path / "no.urdf"), "b.xml")):
        assert program(["convert", *words]) == 2
        line = capsys.readouterr().err
        assert line.startswith("teeter.interchange: ") and line.count("\n") == 1


def test_exceptions_of_the_interchange_survive_a_pickle():
    import pickle

    error = pickle.loads(pickle.dumps(InterchangeError("line 3: no box", "geom", 3)))
    assert (str(error), error.field, error.line) == ("line 3: no box", "geom", 3)


def test_a_motion_goes_by_its_suffix(tmp_path):
    write_motion("block", tmp_path / "a.GLB", seconds=0.1)
    with pytest.raises(InputError):
        write_motion("block", tmp_path / "a.fbx")
