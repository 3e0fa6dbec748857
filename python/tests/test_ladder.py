"""The ladder of players in words: rungs, where it ends, and its program."""

import json

import pytest

from teeter.envs import ladder as module
from teeter.envs.ladder import Rung, climb, first, ladder, loosest, main, named
from teeter.envs.text import TextEnv
from teeter.errors import InputError


@pytest.mark.parametrize("player", [first, loosest])
def test_a_player_takes_a_block_of_the_list(player):
    env = TextEnv(rows=4, opponent=None)
    text = env.reset(seed=2).text
    after = env.step(player(text))
    assert not after.metadata.get("refused") and env.state.tries_left == env.tries


def test_the_loosest_block_is_the_one_with_the_least_force():
    assert loosest("row 1: 4 (loose, 0.10 N) | 5 (tight, 2.00 N)\nrow 0: 1 (loose, 0.02 N) | empty") == "take 1"
    assert loosest("row 0: 1 (not now)") == first("") == "show"


def test_who_resigns_loses_every_game_and_climbs_no_further():
    rungs = ladder(lambda text: "resign", games=3, rows=3)
    assert [rung.opponent for rung in rungs] == ["random"]
    assert (rungs[0].wins, rungs[0].placed, rungs[0].refused, rungs[0].low) == (0, 0.0, 0, 0.0)
    assert 0.5 < rungs[0].high < 0.6


def test_lines_that_are_no_actions_lose_a_game_and_are_counted():
    rung = climb(lambda text: "hello", "random", 2, rows=3)
    assert (rung.wins, rung.refused) == (0, 2 * TextEnv(3).tries)


def test_a_player_that_only_looks_ends():
    rung = climb(lambda text: "show", "random", 1, rows=3)
    assert (rung.wins, rung.placed, rung.refused) == (0, 0.0, 0)


def test_the_climb_goes_on_while_half_of_the_games_are_won(monkeypatch):
    won = {"random": 4, "beginner": 2, "skilled": 1}
    monkeypatch.setattr(module, "climb", lambda p, o, n, **_: Rung(o, n, won[o], 0.0, 1.0, 0.0, 0))
    assert [rung.opponent for rung in ladder(first, 4)] == ["random", "beginner", "skilled"]


def test_games_follow_from_the_seed():
    one, again = (climb(loosest, "random", 2, rows=3, seed=5) for _ in range(2))
    assert one == again and one.placed > 0


def test_the_program_prints_the_rungs(capsys):
    assert main(["first", "--games", "1", "--rows", "3", "--json"]) == 0
    rungs = json.loads(capsys.readouterr().out)
    assert rungs[0]["opponent"] == "random" and rungs[0]["games"] == 1


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["nobody"], "`player` is nobody"),
        (["json:nothing"], "`player` is json:nothing"),
        (["json:__name__"], "no function"),
        (["first", "--games", "0"], "`games` is 0"),
        (["first", "--rows", "2"], "`rows` is 2"),
    ],
)
def test_a_bad_argument_is_one_line(arguments, words, capsys):
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1


def test_a_player_is_found_by_its_module():
    assert named("teeter.envs.ladder:loosest") is loosest
    with pytest.raises(InputError, match="expected first, loosest"):
        named(":")
