"""glTF animation of a motion: a binary file (.glb) of glTF 2.0 with a named node a block.

Blocks are a cuboid of 1 m that each node scales. All nodes are children of one that turns z up,
as here, to y up, as in glTF. Positions and quaternions are keyframes with linear samplers between.
"""

from __future__ import annotations

import json
import math
import os
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from teeter import __version__
from teeter.interchange.mjcf_writer import block_name
from teeter.interchange.motion import Motion

__all__ = ["write_gltf"]

# Constants of glTF 2.0.
_MAGIC, _JSON, _BINARY = 0x46546C67, 0x4E4F534A, 0x004E4942
_FLOAT, _SHORT = 5126, 5123
_VERTICES, _INDICES = 34962, 34963

_WOOD = [0.71, 0.52, 0.32, 1.0]
_HALF = math.sqrt(0.5)


def write_gltf(motion: Motion, path: str | os.PathLike[str]) -> None:
    """Writes a motion as a binary glTF file.

    The first state is the pose of the nodes, and the animation `motion` has all of them, from 0 s
    on. A block that does not move has no channel. All states are held in memory as float32.
    """
    states = list(motion)
    buffer = _Buffer()
    nodes, rows = _nodes(motion, states[0].poses)
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": f"Teeter {__version__}"},
        "scene": 0,
        "scenes": [{"name": motion.scene["name"], "nodes": [0]}],
        "nodes": nodes,
        "meshes": [{"name": "block", "primitives": [_cuboid(buffer)]}],
        "materials": [
            {
                "name": "wood",
                "pbrMetallicRoughness": {"baseColorFactor": _WOOD, "metallicFactor": 0.0, "roughnessFactor": 0.8},
            }
        ],
    }
    times = np.array([state.time for state in states])
    poses = np.array([state.poses for state in states])
    animation = _animation(buffer, times - times[0], poses, rows)
    if animation["channels"]:
        document["animations"] = [animation]
    document |= buffer.described()
    Path(path).write_bytes(_packed(document, bytes(buffer.data)))


def _nodes(motion: Motion, poses: NDArray[np.float64]) -> tuple[list[dict[str, Any]], list[int]]:
    """Nodes of a document, the root first, and the node of each block."""
    nodes: list[dict[str, Any]] = [
        {"name": "tower", "rotation": [-_HALF, 0.0, 0.0, _HALF], "children": list(range(1, 1 + len(poses)))}
    ]
    for block, size, pose in zip(motion.scene["blocks"], motion.sizes, poses, strict=True):
        nodes.append(
            {
                "name": block_name(block),
                "mesh": 0,
                "translation": pose[:3].tolist(),
                "rotation": _unit(pose[3:]).tolist(),
                "scale": size.tolist(),
            }
        )
    return nodes, list(range(1, 1 + len(poses)))


def _unit(quaternions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quaternions of length 1 within the precision of a file."""
    unit: NDArray[np.float64] = quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)
    return unit


class _Buffer:
    """Bytes of a file, with the views and accessors of their parts."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], kind: str, target: int | None = None, *, bounds: bool = False) -> int:
        """Adds an array and returns the index of its accessor."""
        component = _SHORT if values.dtype == np.uint16 else _FLOAT
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes}
        self.views.append(view if target is None else {**view, "target": target})
        self.data += values.tobytes()
        self.data += bytes(-len(self.data) % 4)
        accessor: dict[str, Any] = {
            "bufferView": len(self.views) - 1,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        if bounds:
            columns = values.reshape(len(values), -1)
            accessor |= {"min": columns.min(axis=0).tolist(), "max": columns.max(axis=0).tolist()}
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def described(self) -> dict[str, Any]:
        """Parts of the document about the buffer."""
        return {
            "buffers": [{"byteLength": len(self.data)}],
            "bufferViews": self.views,
            "accessors": self.accessors,
        }


def _cuboid(buffer: _Buffer) -> dict[str, Any]:
    """Primitive of a cuboid of 1 m: four corners a face, which share its normal."""
    positions: list[NDArray[np.float64]] = []
    normals: list[NDArray[np.float64]] = []
    indices: list[int] = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            first = len(positions)
            normal = np.zeros(3)
            normal[axis] = side
            for u, v in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
                corner = 0.5 * normal
                corner[(axis + 1) % 3], corner[(axis + 2) % 3] = u, v
                positions.append(corner)
                normals.append(normal)
            turn = (0, 1, 2, 0, 2, 3) if side > 0.0 else (0, 2, 1, 0, 3, 2)
            indices += [first + corner for corner in turn]
    return {
        "attributes": {
            "POSITION": buffer.add(np.array(positions, dtype=np.float32), "VEC3", _VERTICES, bounds=True),
            "NORMAL": buffer.add(np.array(normals, dtype=np.float32), "VEC3", _VERTICES),
        },
        "indices": buffer.add(np.array(indices, dtype=np.uint16), "SCALAR", _INDICES),
        "material": 0,
    }


def _animation(
    buffer: _Buffer, times: NDArray[np.float64], poses: NDArray[np.float64], nodes: list[int]
) -> dict[str, Any]:
    """Animation of poses of shape (states, n, 7)."""
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    moving = [(i, part) for i in range(len(nodes)) for part in ("translation", "rotation")]
    clock: int | None = None
    for i, part in moving:
        values = poses[:, i, :3] if part == "translation" else _continuous(poses[:, i, 3:])
        if np.array_equal(values, np.broadcast_to(values[0], values.shape)):
            continue
        if clock is None:
            clock = buffer.add(times.astype(np.float32), "SCALAR", bounds=True)
        kind = "VEC3" if part == "translation" else "VEC4"
        output = buffer.add(values.astype(np.float32), kind)
        samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": nodes[i], "path": part}})
    return {"name": "motion", "samplers": samplers, "channels": channels}


def _continuous(quaternions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit quaternions with the signs between which a sampler takes the shorter path."""
    unit = _unit(quaternions)
    turns = np.sum(unit[1:] * unit[:-1], axis=1) < 0.0
    signs = np.where(np.concatenate([[False], np.cumsum(turns) % 2 == 1]), -1.0, 1.0)
    return unit * signs[:, None]


def _packed(document: dict[str, Any], data: bytes) -> bytes:
    """A document and its buffer as one binary file: a header and two chunks of whole words."""
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=False).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON) + text + struct.pack("<II", len(data), _BINARY) + data
    return struct.pack("<III", _MAGIC, 2, 12 + len(chunks)) + chunks
