"""Ladder: a player of the game in words against opponents of growing strength.

A player is a function from what it reads to the line that it writes, such as a call of a language model::

    rungs = ladder(lambda text: model.complete(text), games=20)

``python -m teeter.envs.ladder module:function`` climbs from a shell.
"""

from __future__ import annotations

import argparse
import importlib
import json
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import cast

from teeter.envs.text import Strength, TextEnv
from teeter.errors import InputError, TeeterError
from teeter.study.interval import wilson

__all__ = ["OPPONENTS", "PLAYERS", "Player", "Rung", "climb", "first", "ladder", "loosest"]

#: From what a player reads to the line that it writes.
Player = Callable[[str], str]
#: Opponents of the ladder, the weakest first.
OPPONENTS: tuple[Strength, ...] = ("random", "beginner", "skilled", "expert")
#: Lines that a player may write in a game.
MAX_LINES = 200
BLOCK = re.compile(r"(\d+) \((?:loose|medium|tight), ([0-9.]+) N\)")


@dataclass(frozen=True)
class Rung:
    """Games against one opponent. low, high: interval of 95 % of the share of games won (Wilson).

    placed: mean number of blocks that the player placed in a game. refused: lines of all games that were no
    action or against the rules.
    """

    opponent: Strength
    games: int
    wins: int
    low: float
    high: float
    placed: float
    refused: int


def first(text: str) -> str:
    """Takes the first block that is listed: a player to compare with."""
    found = BLOCK.search(text)
    return f"take {found[1]}" if found else "show"


def loosest(text: str) -> str:
    """Takes the block that is listed with the least force: a player to compare with."""
    blocks = BLOCK.findall(text)
    return f"take {min(blocks, key=lambda block: float(block[1]))[0]}" if blocks else "show"


#: Players of this module by their names.
PLAYERS: dict[str, Player] = {"first": first, "loosest": loosest}


def climb(player: Player, opponent: Strength, games: int = 10, *, rows: int = 9, seed: int = 0) -> Rung:
    """Plays games against one opponent and returns the rung.

    games: 1 or more; game i is on the tower of seed + i. rows: of the towers. An exception of the player ends
    the climb. Raises InputError.
    """
    if games < 1:
        raise InputError(f"`games` is {games}, expected 1 or more", "games")
    env = TextEnv(rows, opponent)
    wins = placed = refused = 0
    for game in range(games):
        observation = env.reset(seed + game)
        for _ in range(MAX_LINES):
            if observation.done:
                break
            observation = env.step(str(player(observation.text)))
            refused += bool(observation.metadata.get("refused"))
        wins += env.state.winner == 0
        placed += env.state.placed
    low, high = wilson(wins, games)
    return Rung(opponent, games, wins, low, high, placed / games, refused)


def ladder(
    player: Player,
    games: int = 10,
    *,
    opponents: Sequence[Strength] = OPPONENTS,
    rows: int = 9,
    seed: int = 0,
) -> list[Rung]:
    """Climbs from the first opponent on, as long as at least half of the games are won, and returns the rungs.

    Arguments are those of `climb`. Raises InputError.
    """
    rungs = []
    for opponent in opponents:
        rungs.append(climb(player, opponent, games, rows=rows, seed=seed))
        if 2 * rungs[-1].wins < games:
            break
    return rungs


def named(name: str) -> Player:
    """Returns the player of a name, or the function of ``module:function``. Raises InputError."""
    if name in PLAYERS:
        return PLAYERS[name]
    module, _, function = name.partition(":")
    try:
        player = getattr(importlib.import_module(module), function)
    except (ImportError, AttributeError, ValueError) as error:
        expected = f"{', '.join(PLAYERS)} or `module:function`"
        raise InputError(f"`player` is {name}, expected {expected}", "player") from error
    if not callable(player):
        raise InputError(f"`player` is {name}, which is no function", "player")
    return cast(Player, player)


def table(rungs: Sequence[Rung]) -> str:
    """Returns the rungs as a table in Markdown."""
    lines = ["| opponent | games | won | interval | placed a game | refused |", "|---|--:|--:|--:|--:|--:|"]
    for rung in rungs:
        interval = f"{100 * rung.low:.0f} to {100 * rung.high:.0f} %"
        counts = f"{rung.games} | {rung.wins} | {interval} | {rung.placed:.1f} | {rung.refused}"
        lines.append(f"| {rung.opponent} | {counts} |")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Climbs as the arguments of a shell say. Returns the exit code: 2 after an error of the caller."""
    known = argparse.ArgumentParser(prog="python -m teeter.envs.ladder", description=(__doc__ or "").split("\n")[0])
    known.add_argument("player", help=f"{', '.join(PLAYERS)} or module:function")
    known.add_argument("--games", type=int, default=10, help="games a rung (10)")
    known.add_argument("--rows", type=int, default=9, help="rows of the towers (9)")
    known.add_argument("--seed", type=int, default=0, help="seed of the first tower (0)")
    known.add_argument("--json", action="store_true", help="print JSON instead of the table")
    given = known.parse_args(arguments)
    sys.path.insert(0, "")
    try:
        rungs = ladder(named(given.player), given.games, rows=given.rows, seed=given.seed)
    except TeeterError as error:
        print(f"ladder: {error}", file=sys.stderr)
        return 2
    print(json.dumps([asdict(rung) for rung in rungs]) if given.json else table(rungs))
    return 0


if __name__ == "__main__":
    sys.exit(main())
