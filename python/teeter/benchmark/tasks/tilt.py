"""Tilt: the angle of the floor at which a tower collapses.

Gravity turns instead of the floor. A ramp finds the neighbourhood, late by the time that a tower
takes to fall. Then the angle is bisected: each time the tower is built again, tilted to an angle and
held there. It is above that of collapse where the tower falls, and below where it stands.
"""

from __future__ import annotations

import math

import numpy as np

from teeter import Footing, tilted_towers
from teeter.benchmark.clock import ClockedEngine
from teeter.benchmark.engine import FRAME, Scene
from teeter.benchmark.tasks.figures import Figures, Options, Progress

__all__ = ["collapse_angle", "measure"]

SETTLE_S = 0.5
# Rates of the two ramps, degrees/s; the second ends where an angle is held.
RAMP_RATE = 3.0
APPROACH_RATE = 6.0
# The fall takes up to a second: the ramp reads late by its rate times that, and some sway.
BACKTRACK = 4.0
# Width at which the bisection ends, degrees: half of it is the error of the method.
RESOLUTION = 0.04
# Time of constant gravity, s: a tower 0.02 degrees beyond balance falls within 1 s.
HOLD_S = 2.0
MAX_ANGLE = 45.0


def measure(engine: ClockedEngine, options: Options, progress: Progress) -> Figures:
    """Compares angles of collapse with limit analysis.

    Figures: towers, median_error_deg, max_error_deg, mean_signed_deg and fell_upright.
    """
    towers = tilted_towers(options.tilts)
    errors = []
    upright = 0
    for i, (scene, exact) in enumerate(towers):
        progress(i, len(towers))
        angle = collapse_angle(engine, scene)
        upright += angle == 0.0
        errors.append(angle - exact)
    progress(len(towers), len(towers))
    return {
        "towers": len(towers),
        "median_error_deg": float(np.median(np.abs(errors))),
        "max_error_deg": float(np.max(np.abs(errors))),
        "mean_signed_deg": float(np.mean(errors)),
        "fell_upright": upright,
    }


def collapse_angle(engine: ClockedEngine, scene: Scene) -> float:
    """Angle at which the tower collapses towards ``tilt_az``, degrees; 0 where it falls upright, and
    45 where it stands at all angles.
    """
    tower = _TiltedTower(engine, scene)
    reading = tower.ramp()
    if reading is None or reading == 0.0:
        return MAX_ANGLE if reading is None else 0.0
    low, high = reading - BACKTRACK, reading
    while low > 0.0 and tower.falls_at(low):
        low, high = low - BACKTRACK, low
    low = max(low, 0.0)
    while high - low > RESOLUTION:
        middle = 0.5 * (low + high)
        if tower.falls_at(middle):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


class _TiltedTower:
    """A tower that is built again for each angle."""

    def __init__(self, engine: ClockedEngine, scene: Scene) -> None:
        self.engine = engine
        self.scene = scene
        self.footing = Footing(scene)

    def ramp(self) -> float | None:
        """Angle of a growing tilt at which the tower has collapsed, degrees: 0 where it falls
        upright, None where it stands at all angles.
        """
        if self._falls_upright():
            return 0.0
        angle = 0.0
        while angle < MAX_ANGLE:
            angle += RAMP_RATE * FRAME
            if self._has_collapsed(angle):
                return angle
        return None

    def falls_at(self, angle: float) -> bool:
        """True when the tower collapses on a floor that is tilted to an angle and held there."""
        if self._falls_upright():
            return True
        frames = max(1, math.ceil(angle / (APPROACH_RATE * FRAME)))
        if any(self._has_collapsed(angle * i / frames) for i in range(1, frames + 1)):
            return True
        return any(self._has_collapsed(angle) for _ in range(round(HOLD_S / FRAME)))

    def _falls_upright(self) -> bool:
        self.footing = Footing(self.scene)
        self.engine.start(self.scene)
        falls = any(self._has_collapsed(0.0) for _ in range(round(SETTLE_S / FRAME)))
        self.footing = Footing(self.scene, self.engine.poses())
        return falls

    def _has_collapsed(self, angle: float) -> bool:
        """Steps a frame on a tilted floor."""
        tilt, azimuth, g = math.radians(angle), self.scene["tilt_az"], self.scene["gravity"]
        along = g * math.sin(tilt)
        self.engine.set_gravity((along * math.cos(azimuth), along * math.sin(azimuth), -g * math.cos(tilt)))
        self.engine.step()
        return self.footing.any_fallen_or_slid(self.engine.poses())
