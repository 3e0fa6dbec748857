"""Study ``loose``: the share of loose blocks against the scatter of the blocks' heights."""

from __future__ import annotations

from typing import Any

from teeter import Game
from teeter.scenes import tower
from teeter.study.sample import Row, Sample, Study

__all__ = ["LOOSE"]

#: Longest time for a tower to come to rest, s.
SETTLE = 30.0


def _measure(sample: Sample) -> Row:
    """Builds a tower and counts the blocks on which nothing presses, once it is at rest."""
    params, rng = sample.params, sample.rng()
    scene = tower(
        rows=params["rows"],
        seed=int(rng.integers(2**63)),
        height_sd=params["height_sd"],
        friction=params["friction"],
    )
    scene["stiffness"] = params["stiffness"]
    game = Game(scene)
    at_rest = game.settle(SETTLE)["at_rest"]
    loose = game.world.xray().loose
    # Nothing lies on the top row, whatever its heights.
    rows = loose[: len(loose) - 3].reshape(-1, 3)
    return {
        "loose_share": float(rows.mean()),
        "loose_middle": float(rows[:, 1].mean()),
        "loose_outer": float(rows[:, [0, 2]].mean()),
        "at_rest": bool(at_rest),
    }


def _plot(table: Any) -> Any:
    from teeter.study.plot import loose_shares

    return loose_shares(table)


_ABOUT = """\
The share of loose blocks against the scatter of their heights.

Parameters: rows; height_sd, m, from 0 to 1 mm by default; friction; stiffness of a contact, N/m. Columns:
loose_share, of the blocks below the top row; loose_middle and loose_outer, of the middle and outer ones;
at_rest. By heights alone the middle block of a row is loose where it is lower than the mean of the outer ones, and
otherwise both of these: half of all blocks.
"""

LOOSE = Study(
    name="loose",
    measure=_measure,
    columns={"loose_share": "float", "loose_middle": "float", "loose_outer": "float", "at_rest": "bool"},
    params={
        "rows": 18,
        "height_sd": (0.0, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3),
        "friction": 0.4,
        "stiffness": 1e6,
    },
    about=_ABOUT,
    plot=_plot,
)
