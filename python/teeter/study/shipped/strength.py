"""Study ``strength``: the height of the tower by the strength of the player who builds it."""

from __future__ import annotations

import math
from typing import Any

from teeter import contest, rules, thinking
from teeter.scenes import tower
from teeter.study.sample import Row, Sample, Study

__all__ = ["STRENGTH"]


def _measure(sample: Sample) -> Row:
    """Plays one game to its end: alone, or against players of the same strength."""
    params, rng = sample.params, sample.rng()
    rows, players = params["rows"], params["players"]
    scene = tower(rows=rows, seed=int(rng.integers(2**63)), height_sd=params["height_sd"])
    manner = thinking(params["strength"])
    manner["budget"] *= params["effort"]
    table = rules("solo" if players == 1 else "official", players)
    record, result = contest(scene, table, [manner] * players, int(rng.integers(2**63)))
    moves = int(result["moves"])
    return {
        "moves": moves,
        "height_rows": rows + math.ceil(moves / 3),
        "fell": bool(result["fell"]),
        "seconds": record.seconds,
    }


def _plot(table: Any) -> Any:
    from teeter.study.plot import heights

    return heights(table)


_ABOUT = """\
The height that a player of each strength builds.

Parameters: strength; rows of the tower; players, 1 for a game alone, up to 8 for one with others of the same
strength; effort, by which the budget of rollouts is multiplied; height_sd, m. Columns: moves, blocks that were
put on top; height_rows, rows of the tower with the last of them; fell, False where a player gave up; seconds
of the game.
"""

STRENGTH = Study(
    name="strength",
    measure=_measure,
    columns={"moves": "int", "height_rows": "int", "fell": "bool", "seconds": "float"},
    params={
        "strength": ("random", "beginner", "skilled", "expert"),
        "rows": 6,
        "players": 1,
        "effort": 1.0,
        "height_sd": 1e-4,
    },
    about=_ABOUT,
    plot=_plot,
)
