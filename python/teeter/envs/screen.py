"""Screen of an environment: pictures as arrays, or a page of the browser that follows it."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from teeter import Game
from teeter.envs.window import Window

__all__ = ["RENDER_MODES", "Screen"]

RENDER_MODES = ["human", "rgb_array"]


class Screen:
    """Screen for a render mode, None for no pictures. fps: states a second that a page shows at most."""

    def __init__(self, mode: str | None, fps: float) -> None:
        self._is_human, self._interval = mode == "human", 1.0 / fps
        self._window: Window | None = None
        self._shown = -np.inf

    def follow(self, game: Game) -> None:
        """Shows the state after a reset or a step, in a page that the first one opens; else does nothing."""
        if not self._is_human:
            return
        if self._window is None:
            self._window = Window()
            self._window.open()
        time.sleep(max(0.0, self._shown + self._interval - time.monotonic()))
        self._shown = time.monotonic()
        self._window.show(game.world)

    def picture(self, game: Game) -> NDArray[np.uint8] | None:
        """Picture of the tower, uint8 of shape (480, 640, 3); None where a page shows it."""
        return None if self._is_human else game.world.render(640, 480)

    def close(self) -> None:
        """Closes the page."""
        if self._window is not None:
            self._window.close()
            self._window = None
