"""Labelled towers: statics says of each whether it stands."""

from __future__ import annotations

from teeter import Footing, labelled_towers
from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import FRAME, Scene
from teeter.benchmark.tasks.figures import Figures, Options, Progress

__all__ = ["measure"]

RAMP_S = 0.3
DURATION_S = 5.0
# Margin below which a verdict of statics is not clear, mm.
CLEAR_MM = 0.1


def measure(engine: ClockedEngine, options: Options, progress: Progress) -> Figures:
    """Steps each tower for 5 s, 0.3 s of it with growing gravity, and compares falls with labels.

    Figures: towers, right, clear (with a margin of 0.1 mm or more), clear_right, false_stable and
    false_unstable.
    """
    towers = labelled_towers(options.towers, seed=options.seed)
    right = clear = clear_right = false_stable = false_unstable = 0
    for i, scene in enumerate(towers):
        progress(i, len(towers))
        unstable = scene["label"] == "unstable"
        fell = falls(engine, scene)
        is_clear = abs(scene["margin"]) >= CLEAR_MM
        right += fell == unstable
        clear += is_clear
        clear_right += is_clear and fell == unstable
        false_stable += unstable and not fell
        false_unstable += fell and not unstable
    progress(len(towers), len(towers))
    return {
        "towers": len(towers),
        "right": right,
        "clear": clear,
        "clear_right": clear_right,
        "false_stable": false_stable,
        "false_unstable": false_unstable,
    }


def falls(engine: ClockedEngine, scene: Scene) -> bool:
    """True when a block of the tower falls within 5 s."""
    footing = Footing(scene)
    engine.start(scene, RAMP_S)
    if footing.any_fallen(engine.poses()):
        return True
    for _ in range(round((DURATION_S - RAMP_S) / FRAME)):
        engine.step()
        if footing.any_fallen(engine.poses()):
            return True
    return False
