"""Data card of the data set of removals, in Markdown."""

from __future__ import annotations

from typing import Any

from teeter.study.interval import summary
from teeter.study.runner import Result
from teeter.study.shipped.extraction import MAX_STEPS

__all__ = ["card"]

#: Columns of removals.parquet, with their meaning.
REMOVALS = {
    "episode": "number of the episode",
    "seed": "seed of `reset` of the environment, which gives tower and block",
    "policy": "scripted hand: `pull`, `wiggle` or `random`",
    "rows": "rows of the tower",
    "friction": "coefficient of friction of the tower",
    "body": "index of the block, from the bottom",
    "row, cell": "row from the bottom and position in it, from 0",
    "load": "normal force on the upper face of the block before, N",
    "tightness": "force that starts the block sliding, N",
    "steps": "steps of 1/20 s",
    "out": "true where the block came out",
    "fell": "true where a block fell",
    "moved_mm": "largest displacement of any other block, mm",
    "reward": "sum of the rewards",
}
#: Columns of steps.parquet, with their meaning.
STEPS = {
    "episode, step": "numbers of the episode and of the step in it",
    "observation": "18 numbers of float32 before the step, those of `Teeter/Extract-v0`",
    "action": "3 numbers of float32: outwards, across and upwards, in [-1, 1]; none in the last row of an episode",
    "reward": "reward of the step; none in the last row",
    "terminated, truncated": "true in the step with which the episode ended: at a fall or an end, or at the limit",
}


def card(result: Result, dataset_id: str, size: int) -> str:
    """Text of the card. dataset_id: name of the data set for Minari. size: of the Parquet files, bytes."""
    identity, table = result.plan.identity(), result.table
    steps = sum(table["steps"].to_pylist())
    return f"""\
---
pretty_name: Teeter removals
license: [mit, apache-2.0]
task_categories: [reinforcement-learning, robotics]
tags: [physics, simulation, manipulation, stacking, offline-rl]
size: {size} bytes
configs:
  - {{config_name: removals, data_files: removals.parquet}}
  - {{config_name: steps, data_files: steps.parquet}}
---

# Removals of blocks from a tower

{table.num_rows} episodes with {steps} steps, in each of which a scripted hand draws one block out of a tower of wooden
blocks. They are simulated by Teeter {identity["engine"]}, not measured.

| policy | episodes | block out | 95 % | a block fell | 95 % |
|---|--:|--:|--:|--:|--:|
{_policies(table)}

## Files

`removals.parquet` has a row an episode:

{_columns(REMOVALS)}

`steps.parquet` has a row a step:

{_columns(STEPS)}

`minari` has the same episodes for Minari, as `{dataset_id}`:

```python
import os
os.environ["MINARI_DATASETS_PATH"] = "minari"
import minari
import teeter.envs

dataset = minari.load_dataset("{dataset_id}")
env = dataset.recover_environment()
```

`study` has the results from which these files are made.

## How it is made

```sh
python -m teeter.study dataset --out DIR --samples {table.num_rows} --seed {identity["seed"]}{_settings(result)}
```

makes the same values again, with any executor. On another kind of processor NumPy may round the goal of a hand
differently. SHA-256 of all values of the study: `{result.digest}`.

Blocks have the size of those of the dissertation of 2003, 81 by 26.8 by 18 mm; friction and the scatter of heights
are drawn for each episode, uniformly. The block is drawn from those that the rules let a player take. `pull` draws it
straight out at a speed of the episode, `wiggle` at half that speed and to and fro across, and `random` moves by lot;
the first two have uniform noise of up to a fifth of the largest action. An episode ends when the block is out, when a
block fell, or after {MAX_STEPS} steps.

## Limits

The hand is a damped spring with a force of at most 4 N that holds the end of the block; it does not slip, and the
observations have no errors of measurement. Friction is the same for all blocks of a tower. The share of falls is that
of these hands, not of people. Episodes of one study are independent, so any split by episodes is sound.

## Licence

MIT or Apache 2.0, at the user's option, as the project.
"""


def _policies(table: Any) -> str:
    lines = []
    for line in summary(table, ["policy"], ["out", "fell"]):
        shares = [
            f"{100 * line[name]:.0f} % | {100 * line[f'{name}_low']:.0f} to {100 * line[f'{name}_high']:.0f} %"
            for name in ("out", "fell")
        ]
        lines.append(f"| {line['policy']} | {line['samples']} | {' | '.join(shares)} |")
    return "\n".join(lines)


def _columns(columns: dict[str, str]) -> str:
    lines = [f"| {name} | {meaning} |" for name, meaning in columns.items()]
    return "\n".join(["| column | meaning |", "|---|---|", *lines])


def _settings(result: Result) -> str:
    """Options of the command for parameters that are not the defaults."""
    settings = ""
    for name, value in result.plan.params.items():
        if value != result.plan.study.params[name]:
            values = value if isinstance(value, tuple) else (value,)
            settings += f" --set {name}={','.join(map(str, values))}"
    return settings
