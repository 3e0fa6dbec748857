"""Pictures that stand for a view: the tower, and the colours of its X-ray."""

from __future__ import annotations

import io
from itertools import product

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from teeter import World

__all__ = ["png", "still"]

Floats = NDArray[np.float64]

# Width and height, px.
SIZE = (640, 420)
# Colours of the file, which keeps it small.
COLOURS = 128
# Camera: azimuth and elevation, rad, that of the page at its start, and vertical field of view, rad.
AZIMUTH, ELEVATION, FIELD_OF_VIEW = -0.95, 0.36, np.radians(34)
# Room around the blocks, as a factor.
ROOM = 1.15
# Forces at the ends of the scale, N, and its colours from loose to tight, as in web/src/xray/readings.ts.
LOOSE, END = 0.1, 10.0
RAMP = ["fde725", "b5de2b", "6ece58", "35b779", "1f9e89", "26828e", "31688e", "3e4989", "482878", "440154"]
NO_COLOUR = "8b857e"


def png(pixels: NDArray[np.uint8]) -> bytes:
    """Returns a picture of shape (height, width, 3) as a PNG file."""
    out = io.BytesIO()
    Image.fromarray(pixels).quantize(COLOURS).save(out, "png", optimize=True)
    return out.getvalue()


def still(world: World, forces: Floats | None = None) -> NDArray[np.uint8]:
    """Returns a picture of a world, uint8 of shape (420, 640, 3).

    forces: force that starts each block, N, for the colours of the X-ray; NaN for none. None for wood.
    """
    corners = _corners(world)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    target, extent = (low + high) / 2, np.linalg.norm(high - low) * ROOM
    distance = extent / 2 / np.sin(FIELD_OF_VIEW / 2)
    view = {"azimuth": AZIMUTH, "elevation": ELEVATION, "distance": distance, "target": target}
    pixels = world.render(*SIZE, **view)
    if forces is None:
        return pixels
    flat = np.cos(ELEVATION)
    outward = np.array([flat * np.cos(AZIMUTH), flat * np.sin(AZIMUTH), np.sin(ELEVATION)])
    seen = _bodies(world, corners, target + distance * outward, -outward)
    return _stained(pixels, seen, np.array([_colour(force) for force in forces]))


def _corners(world: World) -> Floats:
    """Corners of all bodies, m, of shape (n, 8, 3)."""
    halves = np.array(list(product((-0.5, 0.5), repeat=3)))
    local = halves[None] * world.sizes[:, None]
    rotated: Floats = local @ _rotations(world).transpose(0, 2, 1)
    return rotated + world.poses[:, None, :3]


def _rotations(world: World) -> Floats:
    """Rotation matrices of all bodies, of shape (n, 3, 3)."""
    x, y, z, w = world.poses[:, 3:].T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _bodies(world: World, corners: Floats, eye: Floats, forward: Floats) -> NDArray[np.int64]:
    """Body in each pixel, -1 for none, of shape (height, width)."""
    width, height = SIZE
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(right, forward), forward])
    scale = height / 2 / np.tan(FIELD_OF_VIEW / 2)
    nearest = np.full((height, width), np.inf)
    seen = np.full((height, width), -1)
    for body, rotation in enumerate(_rotations(world)):
        # Only the pixels around the body: its corners bound them.
        across, up, depth = axes @ (corners[body] - eye).T
        columns = np.clip(width / 2 + scale * across / depth, 0, width)
        rows = np.clip(height / 2 - scale * up / depth, 0, height)
        box = tuple(slice(int(ends.min()), int(np.ceil(ends.max()))) for ends in (rows, columns))
        y, x = np.mgrid[box] + 0.5
        rays = np.stack([(x - width / 2) / scale, (height / 2 - y) / scale, np.ones_like(x)], -1) @ axes
        at = _hit(rays @ rotation, (eye - world.poses[body, :3]) @ rotation, world.sizes[body] / 2)
        closer = at < nearest[box]
        nearest[box][closer] = at[closer]
        seen[box][closer] = body
    return seen


def _hit(rays: Floats, origin: Floats, half: Floats) -> Floats:
    """Distance along rays to a box in its own frame, inf where they miss it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([(-half - origin) / rays, (half - origin) / rays])
    near, far = ends.min(axis=0).max(axis=-1), ends.max(axis=0).min(axis=-1)
    return np.where((near <= far) & (near > 0), near, np.inf)


def _colour(force: float) -> list[float]:
    """Colour of a force, red, green and blue from 0 to 1; the scale is logarithmic."""
    if not np.isfinite(force):
        return [int(NO_COLOUR[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    level = np.clip(np.log(max(force, 1e-9) / LOOSE) / np.log(END / LOOSE), 0, 1) * (len(RAMP) - 1)
    channels = [[int(colour[k : k + 2], 16) / 255 for colour in RAMP] for k in (0, 2, 4)]
    return [float(np.interp(level, range(len(RAMP)), channel)) for channel in channels]


def _stained(pixels: NDArray[np.uint8], seen: NDArray[np.int64], colours: Floats) -> NDArray[np.uint8]:
    """Blocks in their colours, with the light and shadow of the picture."""
    wood = seen >= 0
    light = pixels.mean(axis=2) / 255
    shade = light[wood] / max(np.percentile(light[wood], 90), 1e-3)
    out = pixels.copy()
    out[wood] = np.clip(255 * colours[seen[wood]] * shade[:, None], 0, 255).astype(np.uint8)
    return out
