"""Baselines, and the training example beside random play."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import teeter
from teeter.envs import baselines

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_the_loosest_block_is_the_one_with_the_least_force():
    observation = {"forces": np.array([[0.0, 3.0], [0.0, 0.1], [0.0, 0.2]])}
    mask = np.array([1, 1, 1, 0, 0, 0, 0, 1, 0], np.int8)
    assert baselines.loosest(observation, mask, np.random.default_rng(1)) == 7


def test_a_steady_player_leaves_a_middle_block_or_both_ends():
    cells = np.array([[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [2, 1]])
    forces = np.array([[0, 0.5], [0, 0.4], [0, 0.3], [0, 0.2], [0, 0.1], [0, 0.05]])
    observation = {"cells": cells, "forces": forces}
    mask = np.ones(18, np.int8)
    # the middle blocks of the upper rows are looser, and nothing stands without them
    assert baselines.steady(observation, mask, np.random.default_rng(1)) // 3 == 3


def test_a_score_follows_from_the_seed_and_a_steady_player_is_no_worse_than_a_random_one():
    options = {"rows": 4, "noise": "none", "max_moves": 6}
    steady = baselines.score(baselines.steady, 2, seed=5, **options)
    assert steady == baselines.score(baselines.steady, 2, seed=5, **options)
    random = baselines.score(baselines.random, 2, seed=5, **options)
    assert sum(steady) >= sum(random)
    assert sum(steady) > 0


@pytest.mark.skipif(not EXAMPLES.exists(), reason="the examples are not a part of the package")
def test_the_training_example_learns_and_draws_its_curve(tmp_path):
    chart = tmp_path / "curve.svg"
    command = [sys.executable, str(EXAMPLES / "train_solo.py"), "--rows", "4", "--envs", "2", "--steps", "6"]
    done = subprocess.run(
        [*command, "--test-steps", "4", "--chart", str(chart)],
        capture_output=True,
        text=True,
        timeout=600,
        env={"PYTHONPATH": str(Path(teeter.__file__).parents[1])},
    )
    assert done.returncode == 0, done.stderr
    assert re.search(r"^random .* points an episode", done.stdout, re.MULTILINE)
    assert re.search(r"^trained .* points an episode", done.stdout, re.MULTILINE)
    assert "an episode of training" in chart.read_text()
