"""The widget: a tower in the view of the page."""

from __future__ import annotations

import base64
import weakref
from typing import Any

import anywidget
import numpy as np
import traitlets
from numpy.typing import NDArray

from teeter import Game, World
from teeter.notebook import stills
from teeter.notebook.bundle import BUNDLE

__all__ = ["View"]


def _bytes(values: NDArray[Any]) -> bytes:
    return np.ascontiguousarray(values, np.float32).tobytes()


class View(anywidget.AnyWidget):
    """Tower in the view of the page. show(), scrub() and xray() create one.

    frame: state in the picture; a fraction is between two. It can be set, and follows the bar.
    playing: True while the motion plays. It can be set.
    interval: simulated time from one state to the next, s.
    selected: block that was clicked, -1 for none. It can be set.
    height: of the picture, px.
    """

    _esm = BUNDLE

    sizes = traitlets.Bytes().tag(sync=True)
    poses = traitlets.Bytes().tag(sync=True)
    readings = traitlets.Bytes().tag(sync=True)
    interval = traitlets.Float(1.0).tag(sync=True)
    frame = traitlets.Float(0.0, min=0.0).tag(sync=True)
    playing = traitlets.Bool(False).tag(sync=True)
    selected = traitlets.Int(-1, min=-1).tag(sync=True)
    height = traitlets.Int(420, min=100, max=4000).tag(sync=True)

    def __init__(
        self,
        source: World | Game,
        *,
        height: int = 420,
        poses: NDArray[np.float32] | None = None,
        interval: float = 1.0,
        forces: bool = False,
    ) -> None:
        """Shows a world or game: its own poses, or those of a motion; with `forces`, its X-ray."""
        self._source, self._follows, self._forces = source, poses is None, forces
        world = self._world()
        super().__init__(
            sizes=_bytes(world.sizes),
            poses=_bytes(world.poses if poses is None else poses),
            readings=self._readings(world),
            interval=interval,
            height=height,
        )
        if self._follows:
            _follow(self)

    def _world(self) -> World:
        return self._source.world if isinstance(self._source, Game) else self._source

    def _readings(self, world: World) -> bytes:
        """Load and breakaway force of each block, of shape (n, 2)."""
        if not self._forces:
            return b""
        loads = world.xray()
        return _bytes(np.stack([loads.above, loads.tightness], axis=1))

    def update(self) -> None:
        """Shows the present state of the world. A notebook does so after each cell."""
        if self._follows:
            world = self._world()
            with self.hold_sync():
                self.poses, self.readings = _bytes(world.poses), self._readings(world)

    def still(self) -> bytes:
        """Returns a picture of the world as PNG: of a motion, its start."""
        world = self._world()
        return stills.png(stills.still(world, world.xray().tightness if self._forces else None))

    def _repr_mimebundle_(self, **options: Any) -> Any:
        """Adds the picture, for readers of a notebook without widgets."""
        found = super()._repr_mimebundle_(**options)
        data, metadata = found if isinstance(found, tuple) else (found, {})
        if data is None:
            return found
        return {**data, "image/png": base64.b64encode(self.still()).decode()}, metadata


_views: weakref.WeakSet[View] = weakref.WeakSet()


def _update_all(*_: Any) -> None:
    for view in list(_views):
        if view.comm is None:
            _views.discard(view)
        else:
            view.update()


def _follow(view: View) -> None:
    """Updates a view after each cell, where there are cells."""
    try:
        from IPython import get_ipython
    except ImportError:
        return
    shell = get_ipython()
    if shell is None:
        return
    if _update_all not in shell.events.callbacks["post_run_cell"]:
        shell.events.register("post_run_cell", _update_all)
    _views.add(view)
