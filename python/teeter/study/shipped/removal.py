"""Study ``removal``: the chance that taking a block fells the tower, for each block of a full tower."""

from __future__ import annotations

from typing import Any

from teeter import Game, remove
from teeter.errors import StudyError
from teeter.scenes import tower
from teeter.study.sample import Params, Row, Sample, Study

__all__ = ["REMOVAL"]


def _blocks(params: Params) -> range:
    """Blocks of a tower of so many rows."""
    rows = params["rows"]
    if not isinstance(rows, int) or not 3 <= rows <= 40:
        raise StudyError(f"`rows` is {rows!r}, expected one integer from 3 to 40, or `block` as well", "rows")
    return range(3 * rows)


def _measure(sample: Sample) -> Row:
    """Takes a block out of a new tower by hand, and builds the same tower without it."""
    params, rng = sample.params, sample.rng()
    body = params["block"]
    scene = tower(
        rows=params["rows"],
        seed=int(rng.integers(2**63)),
        height_sd=params["height_sd"],
        friction=params["friction"],
    )
    game = Game(scene)
    game.settle()
    loads = game.world.xray()
    result = game.take(body, noise=params["hand"], seed=int(rng.integers(2**63)))
    fell = bool(result["fell"] or game.settle()["fell"])
    without = remove(scene, body)
    return {
        "fell": fell,
        "end": "fell" if fell else result["end"],
        "fell_without": without["fell"],
        "fell_exact": without["exact_fell"],
        "lean_mm": without["lean_mm"],
        "load": float(loads.above[body]),
        "tightness": float(loads.tightness[body]),
        "loose": bool(loads.loose[body]),
    }


def _plot(table: Any) -> Any:
    from teeter.study.plot import removals

    return removals(table)


_ABOUT = """\
The chance of collapse of each of the 54 removals from a full tower.

Parameters: rows; block, its index from the bottom, all by default; height_sd, scatter of the heights, m;
friction; hand, "person" or "none" for its errors. Columns: fell, whether a block fell while a hand took
this one and put it on top; end, "placed", "stuck", "dropped" or "fell"; fell_without, whether the tower
falls that is built without the block; fell_exact, whether rigid blocks do; lean_mm, displacement of the
tower without it; load and tightness, N, and loose, of the block before.
"""

REMOVAL = Study(
    name="removal",
    measure=_measure,
    columns={
        "fell": "bool",
        "end": "str",
        "fell_without": "bool",
        "fell_exact": "bool",
        "lean_mm": "float",
        "load": "float",
        "tightness": "float",
        "loose": "bool",
    },
    params={"rows": 18, "block": _blocks, "height_sd": 1e-4, "friction": 0.4, "hand": "person"},
    about=_ABOUT,
    plot=_plot,
)
