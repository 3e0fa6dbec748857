"""MuJoCo, in this process, with the settings that hold a tower best and with its defaults."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from teeter.benchmark.engine import Floats, Scene
from teeter.errors import UnavailableError
from teeter.interchange.mjcf_writer import DEFAULTS, RECIPE, Recipe, write_mjcf

__all__ = ["DefaultMujoco", "MujocoEngine", "TunedMujoco", "import_mujoco"]


def import_mujoco() -> Any:
    """The package mujoco; it logs its warnings. Raises UnavailableError where it is not installed."""
    try:
        import mujoco
    except ImportError as error:
        message = "engine mujoco needs its package: pip install 'teeter[benchmark]'"
        raise UnavailableError(message, "engine") from error
    # Without a handler MuJoCo writes warnings to a file in the working directory.
    mujoco.set_mju_user_warning(logging.getLogger(__name__).warning)
    return mujoco


class MujocoEngine:
    """MuJoCo with a recipe, which is written into the model that Teeter exports."""

    recipe: ClassVar[Recipe] = RECIPE

    def __init__(self) -> None:
        self._mujoco = import_mujoco()
        self.details = f"MuJoCo {self._mujoco.__version__}, {self.recipe.details}"
        self._model: Any = None
        self._data: Any = None
        self._until = 0.0

    def load(self, scene: Scene) -> None:
        """Compiles the exported model."""
        self._model = self._mujoco.MjModel.from_xml_string(write_mjcf(scene, self.recipe))
        self._data = self._mujoco.MjData(self._model)
        if self._model.nkey:
            self._mujoco.mj_resetDataKeyframe(self._model, self._data, 0)
        self._mujoco.mj_forward(self._model, self._data)
        self._until = 0.0
        # bodies come in the order of the blocks, after the world
        self._free = self._model.body_dofnum[1:] > 0

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """Sets gravity, m/s²."""
        self._model.opt.gravity[:] = gravity

    def step(self, seconds: float, forces: Mapping[int, Sequence[float]]) -> None:
        """Advances by steps of the recipe; what a frame has too few is made up in the next."""
        self._until += seconds
        applied = self._data.xfrc_applied
        for body, force in forces.items():
            applied[1 + body, :3] = force
        half = 0.5 * self._model.opt.timestep
        while self._data.time < self._until - half:
            self._mujoco.mj_step(self._model, self._data)
        for body in forces:
            applied[1 + body, :3] = 0.0

    def poses(self) -> Floats:
        """Poses, float64 of shape (n, 7), from the generalised positions: the others lag by a step."""
        poses = np.concatenate([self._data.xpos[1:], self._data.xquat[1:]], axis=1)
        poses[self._free] = self._data.qpos.reshape(-1, 7)
        return poses[:, [0, 1, 2, 4, 5, 6, 3]]


class TunedMujoco(MujocoEngine):
    """MuJoCo with the settings that hold a tower."""


class DefaultMujoco(MujocoEngine):
    """MuJoCo with its defaults."""

    recipe = DEFAULTS
