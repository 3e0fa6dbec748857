"""The game in words, for language models: reset, step and state.

The player takes turns with opponents that think by simulating. An action is a line such as
``take 13 cell 1``; what is no action, or against the rules, is answered with the reason and costs one of
a few tries. It needs no package but NumPy.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, Literal

from teeter import Game, Opponent
from teeter.errors import InputError
from teeter.scenes import tower

__all__ = ["TextAction", "TextEnv", "TextObservation", "TextState"]

Strength = Literal["random", "beginner", "skilled", "expert", "gentle"]

HELP = """\
You play a tower game. In a turn you take one block out of the tower, from below the highest complete row, \
and put it on top. Who fells the tower loses.
Answer with one line: `take BLOCK cell CELL`, with a number of the list and a free cell of the top row \
(0, 1 or 2). `show` shows the tower again, `resign` gives up."""
PATTERN = re.compile(r"^take\s+(?:block\s+)?(\d+)(?:\s+(?:to\s+)?cell\s+([0-2]))?$", re.IGNORECASE)


@dataclass(frozen=True)
class TextAction:
    """Action of the player: a line of text."""

    message: str


@dataclass(frozen=True)
class TextObservation:
    """What the player reads, the reward since the last action, and whether the game is over."""

    text: str
    reward: float = 0.0
    done: bool = False
    metadata: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class TextState:
    """Progress of the game. placed: blocks that the player has placed. winner: 0 is the player."""

    episode: int
    step_count: int
    placed: int
    tries_left: int
    winner: int | None


class TextEnv:
    """A game against one opponent, in words.

    rows: of the tower. opponent: strength of the opponent, None to play alone. tries: actions against the
    rules, or without a meaning, that a game forgives. noise: errors of the player's hand.

    Reward: 0.1 for each block placed, 1 for a game won, -1 for a game lost.
    """

    def __init__(
        self,
        rows: int = 9,
        opponent: Strength | None = "beginner",
        tries: int = 5,
        noise: Any = "person",
    ) -> None:
        if not 3 <= rows <= 40:
            raise InputError(f"`rows` is {rows}, expected 3 to 40", "rows")
        self.rows, self.strength, self.tries, self.noise = rows, opponent, tries, noise
        self._episode = 0
        self._game: Game | None = None

    def reset(self, seed: int = 0) -> TextObservation:
        """Begins a game on the tower of a seed and returns its rules and the tower in words."""
        self._episode += 1
        self._seed, self._steps, self._placed, self._left = seed, 0, 0, self.tries
        self._winner: int | None = None
        self._done = False
        players = 1 if self.strength is None else 2
        self._game = Game(tower(rows=self.rows, seed=seed), "official" if players == 2 else "solo", players)
        self._game.settle()
        self._opponent = None if self.strength is None else Opponent(1, self.strength, seed)
        return TextObservation(f"{HELP}\n\n{self.describe()}")

    def step(self, action: TextAction | str) -> TextObservation:
        """Carries out an action and the opponent's move after it. Nothing that is written raises."""
        game = self._playing()
        if self._done:
            return TextObservation("The game is over. Begin another.", 0.0, True)
        self._steps += 1
        line = (action if isinstance(action, str) else action.message).strip()
        if line.lower() == "show":
            return TextObservation(self.describe())
        if line.lower() == "resign":
            return self._end(1, "You gave up.")
        match = PATTERN.match(line)
        if match is None:
            return self._refused(f"'{line[:60]}' is no action: write `take BLOCK cell CELL`.")
        body, cell = int(match[1]), match[2]
        turn = game.turn or {}
        if body not in turn["removable"]:
            return self._refused(f"Block {body} may not be taken now.")
        slots = {slot["cell"]: slot["row"] for slot in game.slots(body)}
        if cell is not None and int(cell) not in slots:
            return self._refused(f"Cell {cell} of the top row is not free.")
        slot = None if cell is None else (slots[int(cell)], int(cell))
        return self._take(game, body, slot)

    @property
    def state(self) -> TextState:
        """Progress of the game."""
        self._playing()
        return TextState(self._episode, self._steps, self._placed, self._left, self._winner)

    def describe(self) -> str:
        """The tower in words: each row from the top, and how hard its blocks are to take."""
        game = self._playing()
        turn = game.turn or {"removable": []}
        tightness, cells = game.world.xray().tightness, game.cells
        removable = set(turn["removable"])
        lines = []
        for row in range(int(cells[:, 0].max()), -1, -1):
            parts = []
            for cell in range(3):
                found = [body for body in range(len(game)) if cells[body].tolist() == [row, cell]]
                parts.append(self._block(found[0], float(tightness[found[0]]), removable) if found else "empty")
            lines.append(f"row {row:2}: " + " | ".join(parts))
        anyone = next(iter(sorted(removable)), None)
        free = sorted({slot["cell"] for slot in game.slots(anyone)}) if anyone is not None else []
        return "\n".join([*lines, f"Free cells of the top row: {', '.join(map(str, free)) or 'none'}."])

    @staticmethod
    def _block(body: int, tightness: float, removable: set[int]) -> str:
        if body not in removable:
            return f"{body} (not now)"
        grade = "loose" if tightness < 0.15 else "medium" if tightness < 1.0 else "tight"
        return f"{body} ({grade}, {tightness:.2f} N)"

    def _take(self, game: Game, body: int, slot: tuple[int, int] | None) -> TextObservation:
        result = game.take(body, slot=slot, noise=self.noise, seed=self._seed + self._steps)
        after = game.settle()
        fell = result["fell"] + after["fell"]
        if fell or self._is_over(game):
            return self._end(1, f"You took block {body}, and the tower fell.")
        if result["end"] != "placed":
            return TextObservation(f"Block {body} did not come out and is still yours to take.\n\n{self.describe()}")
        self._placed += 1
        words = f"You took block {body} and put it on top."
        if self._opponent is not None:
            words += self._answer(game)
            if self._is_over(game):
                return self._end(0, words)
        return TextObservation(f"{words}\n\n{self.describe()}", 0.1)

    def _answer(self, game: Game) -> str:
        """Plays the opponent's turn and returns it in words."""
        taken = None
        for _ in range(20_000):
            turn = game.turn or {}
            if turn["phase"] == "over" or turn["player"] == 0:
                break
            assert self._opponent is not None
            update = game.step(self._opponent.next(game))
            taken = next((event["body"] for event in update["events"] if event["event"] == "removed"), taken)
        if self._is_over(game):
            return " The opponent felled the tower." if taken is not None else " The opponent gave up."
        game.settle()
        return f" The opponent took block {taken}."

    def _refused(self, reason: str) -> TextObservation:
        self._left -= 1
        if self._left < 0:
            return self._end(1, f"{reason} That was one too many.")
        return TextObservation(f"{reason} {self._left} more are forgiven.", 0.0, False, {"refused": True})

    def _end(self, winner: int, words: str) -> TextObservation:
        self._winner, self._done = winner, True
        alone = self.strength is None
        result = f"You placed {self._placed} blocks." if alone else "You win." if winner == 0 else "You lose."
        return TextObservation(f"{words} {result}", 1.0 if winner == 0 else -1.0, True)

    @staticmethod
    def _is_over(game: Game) -> bool:
        turn = game.turn
        return turn is None or turn["phase"] == "over"

    def _playing(self) -> Game:
        if self._game is None:
            raise InputError("`reset` was not called: no game has begun", "reset")
        return self._game
