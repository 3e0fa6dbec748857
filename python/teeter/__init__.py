"""Teeter: a real-time simulator of a tower of wooden blocks, for the game Jenga.

World steps a scene, WorldBatch many of them on all cores, Game plays by rules with a hand. The same
inputs give the same bits on every machine, from Python as from the page and the shell.
"""

from teeter import errors, inputs, scenes
from teeter._teeter import (
    POSE_STRIDE,
    Contacts,
    Energy,
    Game,
    HandReport,
    Loads,
    Opponent,
    Record,
    Rollout,
    StepReport,
    World,
    WorldBatch,
    __version__,
    analyse,
    breakdown,
    contest,
    force_map,
    rules,
    step_games,
)
from teeter.errors import (
    BodyError,
    CommandError,
    InputError,
    ParamError,
    RecordError,
    RulesError,
    SceneError,
    SnapshotError,
    TeeterError,
)
from teeter.inputs import Drive, Force, Hand

__all__ = [
    "POSE_STRIDE",
    "BodyError",
    "CommandError",
    "Contacts",
    "Drive",
    "Energy",
    "Force",
    "Game",
    "Hand",
    "HandReport",
    "InputError",
    "Loads",
    "Opponent",
    "ParamError",
    "Record",
    "RecordError",
    "Rollout",
    "RulesError",
    "SceneError",
    "SnapshotError",
    "StepReport",
    "TeeterError",
    "World",
    "WorldBatch",
    "__version__",
    "analyse",
    "breakdown",
    "contest",
    "errors",
    "force_map",
    "inputs",
    "rules",
    "scenes",
    "step_games",
]
