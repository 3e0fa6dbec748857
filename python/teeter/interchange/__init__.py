"""Interchange with other programs: scenes and motions in their formats.

read_scene and write_scene take JSON, MJCF (MuJoCo) and URDF; write_motion writes glTF for modelling
programs and Parquet or CSV for tables. ``python -m teeter.interchange convert IN OUT`` does the same
in a shell, and docs/interchange.md describes each format.
"""

from teeter.interchange.convert import convert, read_scene, write_motion, write_scene
from teeter.interchange.gltf import write_gltf
from teeter.interchange.mjcf_reader import read_mjcf
from teeter.interchange.mjcf_writer import DEFAULTS, RECIPE, Recipe, write_mjcf
from teeter.interchange.motion import Motion, State
from teeter.interchange.trace import COLUMNS, write_trace
from teeter.interchange.urdf_reader import read_urdf
from teeter.interchange.urdf_writer import write_urdf

__all__ = [
    "COLUMNS",
    "DEFAULTS",
    "RECIPE",
    "Motion",
    "Recipe",
    "State",
    "convert",
    "read_mjcf",
    "read_scene",
    "read_urdf",
    "write_gltf",
    "write_mjcf",
    "write_motion",
    "write_scene",
    "write_trace",
    "write_urdf",
]
