"""Force map: the pull that starts a block of a full tower sliding, beside the exact one.

Heights scattered by 0.1 mm make some blocks loose and others tight. The exact force lies between
bounds of limit analysis, which agree for many blocks; the error is the distance from that range.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from teeter import Footing, exact_forces, scenes
from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import FRAME, Floats, Scene
from teeter.benchmark.tasks.figures import SETTLE_S, Figures, Options, Progress, creep_mm

__all__ = ["measure", "pull"]

# Displacement of a block that slides, m: a hundred times what contacts give.
SLID = 0.5e-3
# Rate of the pull, N/s. While a block moves by SLID the pull grows by about 0.015 N.
RATE = 0.25
# A block that holds against this much more than the exact force is no longer pulled.
EXCESS_SHARE, EXCESS_N = 2.0, 0.2


def measure(engine: ClockedEngine, options: Options, progress: Progress) -> Figures:
    """Lets a tower rest, and then pulls blocks of it, each from a tower that is built again.

    Figures: stands, creep_mm in the time of the options, and sink_mm, how far the highest block is
    below where it lies in a tower of rigid blocks; and of the pulls: pulls, mean_error_N,
    max_error_N, loose, how many bear nothing, loose_error_N of those, and correlation with the upper
    bound. A tower that fell has stands and pulls alone.
    """
    scene = scenes.tower(rows=options.rows)
    exact = exact_forces(scene)
    chosen = spread(len(exact), options.pulls)
    progress(0, 1 + len(chosen))
    engine.start(scene)
    engine.run_for(SETTLE_S)
    creep = creep_mm(engine, options.seconds)
    poses = engine.poses()
    if Footing(scene).any_fallen(poses):
        progress(1 + len(chosen), 1 + len(chosen))
        return {"stands": False, "pulls": 0}
    heights = [block["pos"][2] + forces["rise_m"] for block, forces in zip(scene["blocks"], exact, strict=True)]
    top = int(np.argmax(heights))
    figures: Figures = {"stands": True, "creep_mm": creep, "sink_mm": 1e3 * (heights[top] - float(poses[top, 2]))}
    measured = []
    for i, body in enumerate(chosen):
        progress(1 + i, 1 + len(chosen))
        measured.append(pull(engine, scene, body, EXCESS_SHARE * exact[body]["straight_n"] + EXCESS_N))
    progress(1 + len(chosen), 1 + len(chosen))
    return figures | _errors([exact[body] for body in chosen], np.array(measured), scene)


def pull(engine: ClockedEngine, scene: Scene, body: int, max_force: float) -> float:
    """Force along the longest edge at which a block of a tower at rest has slid by 0.5 mm, N; the
    largest force where it does not.
    """
    engine.start(scene)
    engine.run_for(SETTLE_S)
    block = scene["blocks"][body]
    turned = block.get("yaw", 0.0) + (math.pi / 2 if block["size"][1] > block["size"][0] else 0.0)
    axis = np.array([math.cos(turned), math.sin(turned), 0.0])
    start = engine.poses()[body, :3]
    force = moved = 0.0
    while force < max_force:
        grown = force + RATE * FRAME
        engine.step({body: (grown * axis).tolist()})
        now = float((engine.poses()[body, :3] - start) @ axis)
        # a pose that is not finite has slid
        if not now < SLID:
            share = (SLID - moved) / (now - moved) if math.isfinite(now) and now > moved else 1.0
            return force + (grown - force) * share
        force, moved = grown, now
    return max_force


def spread(count: int, wanted: int) -> list[int]:
    """Indices of some of ``count`` blocks, evenly spread over them."""
    wanted = max(1, min(wanted, count))
    return [(2 * i + 1) * count // (2 * wanted) for i in range(wanted)]


def _lower_bound(forces: dict[str, Any]) -> float:
    """Force from which a block may move, N: it turns, or rocks with all above it, before it slides."""
    tipping = forces["tipping_n"]
    return float(min(forces["turning_n"], forces["straight_n"], math.inf if tipping is None else tipping))


def _errors(exact: Sequence[dict[str, Any]], measured: Floats, scene: Scene) -> Figures:
    high = np.array([forces["straight_n"] for forces in exact])
    low = np.array([_lower_bound(forces) for forces in exact])
    errors = np.maximum(np.maximum(low - measured, measured - high), 0.0)
    # friction under the block's own weight, and half as much again
    own = 1.5 * scene["friction"] * scene["gravity"] * max(block["mass"] for block in scene["blocks"])
    loose = high < own
    varies = len(exact) > 1 and float(np.std(high)) > 0.0 and float(np.std(measured)) > 0.0
    return {
        "pulls": len(exact),
        "mean_error_N": float(errors.mean()),
        "max_error_N": float(errors.max()),
        "loose": int(loose.sum()),
        "loose_error_N": float(errors[loose].mean()) if loose.any() else None,
        "correlation": float(np.corrcoef(high, measured)[0, 1]) if varies else None,
    }
