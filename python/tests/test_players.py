"""The game of several players for PettingZoo, and the game in words."""

import numpy as np
import pytest
from pettingzoo.test import api_test, seed_test

import teeter
from teeter.envs import teeter_v0
from teeter.envs.text import TextAction, TextEnv

ROWS = 4


# The checker knows dicts with masks only from the games of its own package.
@pytest.mark.filterwarnings("ignore:Observation is not a NumPy array:UserWarning")
@pytest.mark.filterwarnings("ignore:Observation space for each agent probably:UserWarning")
@pytest.mark.parametrize("num_players", [2, 3])
def test_the_checkers_of_pettingzoo_pass(num_players):
    api_test(teeter_v0.env(rows=ROWS, num_players=num_players, noise="none"), num_cycles=12)


def test_equal_seeds_give_equal_games():
    seed_test(lambda: teeter_v0.env(rows=ROWS, noise="none"), num_cycles=4)


def test_the_loser_pays_the_winner():
    env = teeter_v0.env(rows=ROWS)
    env.reset(seed=4)
    rng = np.random.default_rng(1)
    moves = []
    for agent in env.agent_iter(200):
        observation, _, terminated, truncated, _ = env.last()
        if terminated or truncated:
            env.step(None)
            continue
        moves.append(agent)
        env.step(int(rng.choice(np.flatnonzero(observation["action_mask"]))))
    raw = env.unwrapped
    assert moves[0] == "player_0"
    assert sorted(raw.possible_agents) == ["player_0", "player_1"]
    outcome = raw.game.turn["outcome"]
    assert outcome is not None
    assert raw.agents == []


def test_an_illegal_action_loses():
    env = teeter_v0.env(rows=ROWS)
    env.reset(seed=1)
    env.step(3 * 11)
    assert env.terminations == {"player_0": True, "player_1": True}
    assert env.rewards["player_0"] == -1


def test_observations_mask_all_but_the_agent_to_move():
    env = teeter_v0.raw_env(rows=ROWS)
    env.reset(seed=1)
    assert env.observe("player_0")["action_mask"].any()
    assert not env.observe("player_1")["action_mask"].any()
    with pytest.raises(teeter.InputError, match="`num_players`"):
        teeter_v0.raw_env(num_players=9)


def test_a_game_in_words_is_played_to_its_end():
    env = TextEnv(rows=4, opponent="random")
    first = env.reset(seed=2)
    assert "take BLOCK cell CELL" in first.text
    assert "row  3:" in first.text
    for _ in range(40):
        turn = env._game.turn
        tightness = env._game.world.xray().tightness
        body = min(turn["removable"], key=lambda body: tightness[body])
        result = env.step(TextAction(f"take {body}"))
        if result.done:
            break
    assert result.done
    assert result.reward in (1.0, -1.0)
    assert env.state.winner == (0 if result.reward > 0 else 1)
    assert env.state.step_count > 0
    assert "over" in env.step("show").text


@pytest.mark.parametrize(
    "line", ["", "hello", "take", "take 999 cell 0", "take 11 cell 0", "take 0 cell 9", "\x00" * 200]
)
def test_nonsense_is_answered_with_a_reason_and_forgiven_a_few_times(line):
    env = TextEnv(rows=4, opponent=None, tries=1)
    env.reset()
    before = env._game.state_hash()
    answer = env.step(line)
    assert not answer.done
    assert answer.metadata["refused"]
    assert env._game.state_hash() == before
    assert env.step(line).done


def test_a_game_in_words_begins_with_reset():
    with pytest.raises(teeter.InputError, match="`reset`"):
        TextEnv().step("show")
