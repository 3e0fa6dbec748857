"""Environments: the official checkers, determinism, the vector environments beside singles, and play."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import teeter
import teeter.envs  # registers the environments

IDS = ["Teeter/Solo-v0", "Teeter/Extract-v0", "Teeter/Place-v0"]
ROWS = 4


def make(env_id, **kwargs):
    return gymnasium.make(env_id, rows=ROWS, **kwargs)


def same(a, b):
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list | tuple):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    return np.array_equal(a, b)


@pytest.mark.parametrize("env_id", IDS)
def test_the_checker_of_gymnasium_passes_without_a_warning(env_id):
    env = make(env_id)
    check_env(env.unwrapped)
    env.close()


@pytest.mark.parametrize("env_id", IDS)
def test_equal_seeds_and_actions_give_equal_episodes(env_id):
    def episode():
        env = make(env_id)
        env.action_space.seed(5)
        found = [env.reset(seed=3)]
        for _ in range(4):
            found.append(env.step(env.action_space.sample()))
            if found[-1][2]:
                break
        return found, env.unwrapped.game.state_hash()

    (first, hash_of_first), (second, hash_of_second) = episode(), episode()
    assert hash_of_first == hash_of_second
    assert all(same(a, b) for a, b in zip(first, second, strict=True))


def test_solo_gives_a_point_for_a_block_and_masks_what_the_rules_forbid():
    env = make("Teeter/Solo-v0", noise="none")
    observation, info = env.reset(seed=1)
    mask = info["action_mask"].reshape(-1, 3)
    assert mask[:9].all()
    assert not mask[9:].any()
    assert np.array_equal(observation["action_mask"], info["action_mask"])
    body = int(observation["forces"][:9, 1].argmin())
    observation, reward, terminated, truncated, info = env.step(3 * body + 1)
    assert info["move"]["end"] == "placed"
    assert (reward, info["score"], terminated, truncated) == (1.0, 1, False, False)
    assert observation["cells"][body].tolist() == [ROWS, 1]
    # the cell is taken now, and a block above it may not be taken
    _, reward, _, _, info = env.step(3 * body + 1)
    assert reward == -1.0
    assert info["illegal"]


def test_solo_ends_with_a_fall():
    env = make("Teeter/Solo-v0", noise="none")
    env.reset(seed=1)
    terminated, steps = False, 0
    while not terminated and steps < 40:
        mask = env.unwrapped._mask()
        # always from the lowest row: a tower on one edge falls
        _, reward, terminated, _, info = env.step(int(np.flatnonzero(mask)[0]))
        steps += 1
    assert terminated
    assert info["move"]["fell"] or not info["action_mask"].any()
    assert reward >= -1.0


def test_a_straight_pull_draws_a_loose_block_out_and_is_rewarded():
    env = make("Teeter/Extract-v0")
    _, info = env.reset(seed=2)
    total, out = 0.0, False
    for _ in range(60):
        _, reward, terminated, _, info = env.step(np.array([0.6, 0.0, 0.0], np.float32))
        total += reward
        if terminated:
            out = info["out"]
            break
    assert out
    assert total > 15.0
    assert info["moved_mm"] < 3.0


def place(env, observation, steps=150):
    """A controller that brings the block over its slot, down, and lets go."""
    for _ in range(steps):
        offset, angle = observation[:3] * 0.01, observation[3]
        over = np.hypot(*offset[:2]) < 0.004 and abs(angle) < 0.03
        down = offset[2] if over else offset[2] + 0.03
        standing = over and abs(offset[2]) < 0.0015
        action = np.clip(
            [*(0.3 * offset[:2] / 0.005), 0.3 * down / 0.005, angle / 0.05, 1.0 if standing else 0.0], -1, 1
        )
        observation, reward, terminated, _, info = env.step(action.astype(np.float32))
        if terminated:
            return reward, info
    return 0.0, info


def test_a_controller_puts_a_block_into_its_slot():
    env = make("Teeter/Place-v0")
    placed = 0
    for seed in range(3):
        observation, _ = env.reset(seed=seed)
        reward, info = place(env, observation)
        placed += info["placed"]
        assert (reward > 5) == info["placed"]
    assert placed >= 2


def test_letting_go_in_the_air_is_no_placing():
    env = make("Teeter/Place-v0")
    env.reset(seed=0)
    _, reward, terminated, _, info = env.step(np.array([0, 0, 0, 0, 1], np.float32))
    assert terminated
    assert not info["placed"]
    assert reward < -5


@pytest.mark.parametrize("env_id", IDS)
@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP, AutoresetMode.DISABLED])
def test_a_vector_environment_gives_what_its_parts_give_alone(env_id, mode):
    steps = 3
    envs = gymnasium.make_vec(env_id, num_envs=3, rows=ROWS, autoreset_mode=mode, max_episode_steps=2)
    assert envs.metadata["autoreset_mode"] is mode
    singles = [make(env_id, max_episode_steps=2) for _ in range(3)]
    observations, _ = envs.reset(seed=7)
    alone = [env.reset(seed=7 + i)[0] for i, env in enumerate(singles)]
    done = [False] * 3
    envs.action_space.seed(1)
    for _ in range(steps):
        assert same(list(gymnasium.vector.utils.iterate(envs.observation_space, observations)), alone)
        if mode == AutoresetMode.DISABLED and any(done):
            mask = np.array(done)
            observations, _ = envs.reset(options={"reset_mask": mask})
            alone = [env.reset()[0] if done[i] else alone[i] for i, env in enumerate(singles)]
            assert same(list(gymnasium.vector.utils.iterate(envs.observation_space, observations)), alone)
            done = [False] * 3
        actions = envs.action_space.sample()
        observations, rewards, terminations, truncations, _ = envs.step(actions)
        for i, env in enumerate(singles):
            if mode == AutoresetMode.NEXT_STEP and done[i]:
                alone[i], done[i] = env.reset()[0], False
                assert rewards[i] == 0.0
                continue
            alone[i], reward, terminated, truncated, _ = env.step(actions[i])
            done[i] = terminated or truncated
            assert (rewards[i], terminations[i], truncations[i]) == (reward, terminated, truncated)
            if mode == AutoresetMode.SAME_STEP and done[i]:
                alone[i], done[i] = env.reset()[0], False
    envs.close()


def test_pictures_are_new_arrays_of_the_stated_shape():
    env = make("Teeter/Solo-v0", render_mode="rgb_array", observe=("image",))
    observation, _ = env.reset(seed=1)
    assert observation["image"].shape == (96, 128, 3)
    assert env.render().shape == (480, 640, 3)


def test_wrong_options_are_named():
    for kwargs, field in (({"rows": 2}, "rows"), ({"observe": ("smell",)}, "observe")):
        with pytest.raises(teeter.InputError) as error:
            teeter.envs.solo.SoloEnv(**kwargs)
        assert error.value.field == field
