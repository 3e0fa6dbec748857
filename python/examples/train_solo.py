"""Learns which block to take in Teeter/Solo-v0, and compares with random play.

A move is rated by a logistic regression of its features on the points that it brought without a fall. It
takes some minutes on two cores and needs NumPy and Gymnasium alone; the chart needs ``teeter[study]``::

    python train_solo.py --rows 6 --envs 4 --steps 200 --curve curve.csv --chart curve.svg
"""

from __future__ import annotations

import argparse
import csv
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import teeter.envs  # noqa: F401  registers the environments

Floats = NDArray[np.float64]


def features(observation: dict[str, NDArray[Any]]) -> Floats:
    """Features of each move, float64 of shape (moves, k): of the block, of its row, and of the cell."""
    cells, forces = observation["cells"], observation["forces"].astype(np.float64)
    blocks = len(cells)
    rows, positions = cells[:, 0], cells[:, 1]
    top = rows.max()
    in_row = np.array([(rows == row).sum() if row >= 0 else 0 for row in rows])
    has_middle = np.array([bool(((rows == row) & (positions == 1)).any()) for row in rows])
    is_middle = positions == 1
    stands_without = np.where(is_middle, in_row == 3, (in_row == 3) | ~has_middle | (in_row == 2) & has_middle)
    block = np.stack(
        [
            np.ones(blocks),
            np.tanh(forces[:, 1]),
            np.tanh(forces[:, 0]),
            rows / max(top, 1),
            is_middle,
            in_row == 3,
            in_row == 2,
            stands_without,
        ],
        axis=1,
    )
    in_top = (rows == top).sum() % 3
    cell = np.eye(3)[np.tile(np.arange(3), blocks)] * (in_top > 0)
    return np.hstack([np.repeat(block, 3, axis=0), cell])


class Policy:
    """Chance that a move succeeds, as a logistic function of its features."""

    def __init__(self, rng: np.random.Generator, rate: float = 0.2) -> None:
        self.rng, self.rate = rng, rate
        self.weights: Floats | None = None

    def choose(self, observation: dict[str, NDArray[Any]], explore: float) -> tuple[int, Floats]:
        """Returns a move and its features: the best rated, or any legal one by the share ``explore``."""
        rated = features(observation)
        legal = np.flatnonzero(observation["action_mask"])
        if self.weights is None:
            self.weights = np.zeros(rated.shape[1])
        if len(legal) == 0:
            return 0, rated[0]
        if self.rng.random() < explore:
            move = int(self.rng.choice(legal))
        else:
            scores = rated[legal] @ self.weights + 1e-6 * self.rng.random(len(legal))
            move = int(legal[scores.argmax()])
        return move, rated[move]

    def learn(self, known: list[tuple[Floats, float]]) -> None:
        """Takes in moves and their success."""
        if self.weights is None:
            return
        for _ in range(4):
            for index in self.rng.permutation(len(known)):
                x, success = known[index]
                chance = 1.0 / (1.0 + np.exp(-np.clip(x @ self.weights, -30, 30)))
                self.weights += self.rate / (1 + len(known) / 200) * (success - chance) * x


def play(policy: Policy, arguments: argparse.Namespace, steps: int, explore: float, learn: bool) -> list[float]:
    """Plays ``steps`` steps in all environments and returns the scores of the episodes, in their order."""
    number = arguments.envs
    envs = gymnasium.make_vec(
        "Teeter/Solo-v0", num_envs=number, rows=arguments.rows, observe=("cells", "forces"), max_episode_steps=60
    )
    observations, _ = envs.reset(seed=int(policy.rng.integers(2**31)))
    scores, running, known = [], np.zeros(number), []
    done = np.zeros(number, bool)
    for _ in range(steps):
        singles = list(gymnasium.vector.utils.iterate(envs.observation_space, observations))
        chosen = [policy.choose(single, explore) for single in singles]
        observations, rewards, terminations, truncations, _ = envs.step(np.array([move for move, _ in chosen]))
        for i in np.flatnonzero(~done):
            known.append((chosen[i][1], float(rewards[i] > 0)))
            running[i] += max(rewards[i], 0.0)
        done = terminations | truncations
        for i in np.flatnonzero(done):
            scores.append(float(running[i]))
            running[i] = 0.0
        if learn:
            policy.learn(known)
    envs.close()
    return scores


def draw(at_random: list[float], curve: list[float], trained: list[float], path: str) -> None:
    """Draws the scores of the episodes in training with their running mean, between both comparisons."""
    from matplotlib.figure import Figure

    from teeter.study import plot

    figure = Figure(figsize=(6.0, 3.6), layout="constrained")
    axes = figure.add_subplot()
    axes.plot(np.arange(1, len(curve) + 1), curve, ".", color=plot.GREY, ms=4, label="an episode of training")
    width = max(1, len(curve) // 10)
    means = np.convolve(curve, np.ones(width) / width, "valid")
    axes.plot(np.arange(len(means)) + (width + 1) / 2, means, color=plot.BLUE, label=f"mean of {width} episodes")
    for scores, style, name in ((trained, "--", "trained, without exploring"), (at_random, ":", "random play")):
        if scores:
            axes.axhline(float(np.mean(scores)), color=plot.ORANGE, ls=style, label=f"{name}: {np.mean(scores):.1f}")
    axes.set(xlabel="episode", ylabel="points", ylim=(0, None))
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(fontsize=8)
    plot.save(figure, path)


def main() -> None:
    """Trains, and prints the mean score of random play and of the trained policy."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=100, help="steps of training in each environment")
    parser.add_argument("--envs", type=int, default=8, help="environments side by side")
    parser.add_argument("--rows", type=int, default=8, help="rows of the tower")
    parser.add_argument("--test-steps", type=int, default=60, help="steps of each comparison")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--curve", help="file for the scores of the episodes in training, CSV")
    parser.add_argument("--chart", help="file for a picture of them, SVG or PNG")
    arguments = parser.parse_args()
    policy = Policy(np.random.default_rng(arguments.seed))
    at_random = play(policy, arguments, arguments.test_steps, explore=1.0, learn=False)
    curve = play(policy, arguments, arguments.steps, explore=0.2, learn=True)
    trained = play(policy, arguments, arguments.test_steps, explore=0.0, learn=False)
    if arguments.curve:
        with open(arguments.curve, "w", newline="") as file:
            csv.writer(file).writerows([("episode", "score"), *enumerate(curve)])
    if arguments.chart:
        draw(at_random, curve, trained, arguments.chart)
    for start in range(0, len(curve), max(1, len(curve) // 8)):
        part = curve[start : start + max(1, len(curve) // 8)]
        print(f"episodes {start + 1:4} to {start + len(part):4}: {np.mean(part):5.1f} points")
    for name, scores in (("random", at_random), ("trained", trained)):
        error = np.std(scores) / max(len(scores), 1) ** 0.5 if scores else float("nan")
        mean = np.mean(scores) if scores else float("nan")
        print(f"{name:8} {mean:5.1f} points an episode, give or take {error:.1f} ({len(scores)} episodes)")


if __name__ == "__main__":
    main()
