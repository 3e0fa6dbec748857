"""What all environments share: the game of an episode, and the screen that shows it."""

from __future__ import annotations

import gymnasium
import numpy as np
from numpy.typing import NDArray

from teeter import Game
from teeter.envs.screen import Screen

__all__ = ["Episode"]


class Episode:
    """Game of an episode and its screen; a base of environments, before that of their library."""

    screen: Screen
    _game: Game | None = None

    @property
    def game(self) -> Game:
        """Game of the episode."""
        if self._game is None:
            raise gymnasium.error.ResetNeeded("the environment was not reset")
        return self._game

    def render(self) -> NDArray[np.uint8] | None:
        """Picture of the tower, uint8 of shape (480, 640, 3); None where a page of the browser shows it."""
        return self.screen.picture(self.game)

    def close(self) -> None:
        """Closes the page of the browser."""
        self.screen.close()
