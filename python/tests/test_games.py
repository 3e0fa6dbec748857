"""Games: turns, moves, records, opponents and analysis."""

import pickle

import numpy as np
import pytest

import teeter

SMALL = teeter.scenes.tower(rows=5)


def official(**options):
    return teeter.Game(SMALL, "official", 2, **options)


def loose_block(game):
    """The block that slides with the least force among those that may be taken."""
    tightness = game.world.xray().tightness
    return min(game.turn["removable"], key=lambda body: tightness[body])


def test_a_move_takes_a_block_from_the_tower_to_its_top_and_ends_the_turn():
    game = official()
    game.settle()
    body = loose_block(game)
    row = game.cells[body][0]
    result = game.take(body, slot=(5, 1), noise="none")
    assert result["end"] == "placed" and result["fell"] == []
    game.settle()
    assert row < 4 and game.cells[body].tolist() == [5, 1]
    assert game.turn["player"] == 1 and game.turn["number"] == 2
    assert {"removed", "settled"} <= {event["event"] for event in result["events"]} | {"settled"}


def test_the_rules_refuse_a_block_of_the_top_row():
    game = official()
    grasp = {"command": "grasp", "body": 13, "anchor": [0, 0, 0], "normal": [1, 0, 0], "grip": "auto"}
    assert "too high" in game.judge(grasp)
    events = game.step(grasp)["events"]
    illegal = [event for event in events if event["event"] == "illegal"]
    assert illegal[0]["rule"]["rule"] == "too_high"
    assert teeter.Game(SMALL).judge(grasp) is None


def test_a_move_of_the_same_seed_has_the_same_bits():
    def hashes(seed):
        game = official()
        game.take(4, seed=seed)
        return game.state_hash()

    assert hashes(3) == hashes(3) != hashes(4)


def test_a_snapshot_and_a_pickle_go_on_alike():
    game = official()
    game.step({"command": "grasp", "body": 4, "anchor": [0, 0, 0], "normal": [1, 0, 0], "grip": "auto"})
    copies = [game.clone(), pickle.loads(pickle.dumps(game))]
    fresh = official()
    fresh.restore(game.snapshot())
    for other in (*copies, fresh):
        assert other.state_hash() == game.state_hash() and other.rules == game.rules
        assert other.step("release")["events"] == game.clone().step("release")["events"]
    with pytest.raises(teeter.SnapshotError):
        game.restore(b"nonsense")


def test_a_record_replays_the_game_and_finds_what_was_altered():
    game = official(record=True)
    game.take(4, noise="none")
    record = teeter.Record(game.record().encode())
    assert record.frames == round(game.time * 60) and record.seconds == pytest.approx(game.time)
    assert record.verify()["same"] and record.verify()["hash"] == game.hash()
    assert record.game().state_hash() == game.state_hash()
    assert record.game(0).time == 0
    assert len(record.commands()) == record.frames and record.commands()[0]["command"] == "grasp"
    assert record.keyframes()[-1][:, :3] == pytest.approx(game.poses[:, :3], abs=1e-4)
    assert pickle.loads(pickle.dumps(record)).encode() == record.encode()
    data = bytearray(record.encode())
    data[-1] ^= 1
    with pytest.raises(teeter.RecordError, match="altered"):
        teeter.Record(bytes(data))
    with pytest.raises(teeter.RecordError, match="`record=True`"):
        official().record()


def test_games_step_side_by_side_as_one_by_one():
    games = [teeter.Game(SMALL, "solo") for _ in range(3)]
    singles = [game.clone() for game in games]
    grasp = {"command": "grasp", "body": 4, "anchor": [0, 0, 0], "normal": [1, 0, 0], "grip": "auto"}
    commands = [grasp, None, "idle"]
    updates = teeter.step_games(games, commands)
    for single, command, update in zip(singles, commands, updates, strict=True):
        assert single.step(command) == update
    assert [game.state_hash() for game in games] == [single.state_hash() for single in singles]
    with pytest.raises(RuntimeError):
        teeter.step_games([games[0], games[0]], [None, None])
    with pytest.raises(teeter.InputError, match="`commands`"):
        teeter.step_games(games, [None])


def test_an_opponent_plays_its_turn_by_commands():
    game = official()
    thinking = {
        "candidates": 2,
        "is_ranked": True,
        "budget": 0.0,
        "errors": {"height": 0.0, "friction": 0.0, "position": 0.0},
        "trouble": 0.0,
        "risk": 0.0,
    }
    opponent = teeter.Opponent(0, thinking, seed=2)
    for _ in range(3000):
        update = game.step(opponent.next(game))
        if update["turn"]["player"] != 0 or update["turn"]["phase"] == "over":
            break
    assert update["turn"]["player"] == 1 or update["turn"]["outcome"]["loser"] == 0
    considered = opponent.considered()
    assert len(considered) == 2 and considered[0]["cost"] <= considered[1]["cost"]


def test_a_contest_has_a_loser_and_its_record_is_broken_down():
    record, result = teeter.contest("(010)-(101)-(010)-(111)", "official", ["random", "random"], seed=1)
    assert result["fell"] and result["outcome"]["loser"] in (0, 1)
    assert record.verify()["same"]
    report = teeter.breakdown(record)
    assert report["moves"][-1]["fell"] and report["fall"]["bodies"]


def test_the_analysis_of_a_column_knows_that_only_its_top_is_free():
    world = teeter.World("column")
    world.run_for(1.0)
    blocks = teeter.analyse(world)
    assert [block["body"] for block in blocks] == list(range(10))
    assert all(block["falls_by_statics"] for block in blocks[:9]) and not blocks[9]["falls_by_statics"]
    assert blocks[9]["chance_of_fall"] == 0 and blocks[9]["held_by"] == []
    assert blocks[0]["held_by"] == [1]


def test_the_force_map_is_exact_beside_measured():
    for block in teeter.force_map("(1L1)-(010)"):
        assert block["forward_N"] == pytest.approx(min(block["exact"].values()), rel=0.02)


def test_slots_and_freedom_of_blocks():
    game = teeter.Game(SMALL)
    slots = game.slots(14)
    assert {slot["row"] for slot in slots} <= {4, 5} and len(slots) >= 1
    assert game.is_free(14) and not game.is_free(0)
    assert len(game) == 15 and np.array_equal(game.cells[:, 0], np.repeat(np.arange(5), 3))


def test_rules_of_a_table_can_be_changed_and_are_checked():
    rules = teeter.rules("official", 3) | {"turn_s": 30.0}
    game = teeter.Game(SMALL, rules)
    assert game.rules == rules and game.turn["left_s"] == 30.0
    with pytest.raises(teeter.RulesError, match="`players` is 0") as error:
        teeter.Game(SMALL, rules | {"players": 0})
    assert error.value.field == "players"
    with pytest.raises(teeter.RulesError):
        teeter.Game(SMALL, "poker")


def test_a_strength_is_a_manner_of_thinking():
    strengths = ["random", "beginner", "skilled", "expert", "gentle"]
    budgets = [teeter.thinking(strength)["budget"] for strength in strengths]
    assert budgets[0] == 0.0 and budgets[:4] == sorted(budgets[:4])
    scene = teeter.scenes.config("(010)-(101)-(010)-(111)")
    by_name = teeter.contest(scene, "official", ["random", "random"], seed=1)
    by_dict = teeter.contest(scene, "official", [teeter.thinking("random")] * 2, seed=1)
    assert by_name[0].encode() == by_dict[0].encode()
    with pytest.raises(teeter.InputError, match="`strength"):
        teeter.thinking("strong")
