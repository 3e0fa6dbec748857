"""A house of cards: it stands by friction alone, and no card may creep."""

from __future__ import annotations

from teeter import Footing, scenes
from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.tasks.figures import SETTLE_S, Figures, Options, Progress, creep_mm

__all__ = ["measure"]


def measure(engine: ClockedEngine, options: Options, progress: Progress) -> Figures:
    """Lets a house of cards stand for 2 s, and then for the time of the options.

    Figures: cards, stands and creep_mm, the largest displacement in the second time (exact: 0),
    None where it fell.
    """
    scene = scenes.cards(options.storeys)
    footing = Footing(scene)
    progress(0, 1)
    engine.start(scene)
    engine.run_for(SETTLE_S)
    creep = creep_mm(engine, options.seconds)
    stands = not footing.any_fallen(engine.poses())
    progress(1, 1)
    return {"cards": len(scene["blocks"]), "stands": stands, "creep_mm": creep if stands else None}
