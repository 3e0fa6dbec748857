"""Towers in a notebook, with the view of the page.

``show`` draws a world that follows its steps, ``scrub`` a record or other motion with a bar for its
time, ``xray`` the forces of a tower at rest. Each returns a View, which is a widget::

    import teeter
    from teeter import notebook

    world = teeter.World("tower")
    notebook.show(world)

Drag to rotate the view, hold Ctrl and turn the wheel to zoom, click a block to describe it. It needs
``pip install 'teeter[notebook]'``. Where widgets cannot run, a picture stands for the view.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from teeter import Game, Record, World
from teeter.errors import InputError, UnavailableError
from teeter.notebook import bundle

if TYPE_CHECKING:
    from teeter._teeter import SceneLike
    from teeter.notebook.view import View

__all__ = ["scrub", "show", "xray"]


def _check(height: int) -> None:
    for package, distribution in (("anywidget", "anywidget"), ("PIL", "pillow")):
        if find_spec(package) is None:
            message = f"{distribution} is not installed: pip install 'teeter[notebook]'"
            raise UnavailableError(message, distribution)
    bundle.require()
    if type(height) is not int or not 100 <= height <= 4000:
        raise InputError(f"`height` is {height!r}, expected 100 to 4000 px", "height")


def show(source: World | Game | Record | SceneLike, *, height: int = 420) -> View:
    """Shows a world, a game, a record or a scene.

    source: a World or Game, which the view follows: after each cell of a notebook, and when its update() is called
        in a loop. Of a Record the view shows the start. Else a scene as World takes it.
    height: of the picture, px.

    Raises UnavailableError where a part is missing, InputError and SceneError.
    """
    _check(height)
    from teeter.notebook.view import View

    source = source.game(0) if isinstance(source, Record) else source
    return View(source if isinstance(source, World | Game) else World(source), height=height)


def scrub(
    motion: Record | ArrayLike,
    world: World | Game | SceneLike | None = None,
    *,
    rate: float = 10.0,
    height: int = 420,
) -> View:
    """Shows a motion with a bar for its time: play and pause by the button or the space bar, arrow keys step.

    motion: a Record, which is played again, or poses of shape (states, n, 7), such as those of a rollout.
    world: the world or scene of the poses; a Record has its own.
    rate: states a second. A record takes the nearest rate that is a whole number of frames. At 1 or less, the
        poses that a record keeps of each second are shown, and nothing is simulated.
    height: of the picture, px.

    Raises UnavailableError where a part is missing, InputError, SceneError and RecordError.
    """
    _check(height)
    from teeter.notebook import motions
    from teeter.notebook.view import View

    if isinstance(motion, Record):
        poses, interval = motions.of_record(motion, rate)
        return View(motion.game(0), height=height, poses=poses, interval=interval)
    source = world if isinstance(world, World | Game) else World(motions.scene_of(world))
    return View(source, height=height, poses=motions.checked(motion, len(source)), interval=motions.interval(rate))


def xray(world: World | Game | SceneLike, *, height: int = 420) -> View:
    """Shows the X-ray of a tower at rest: each block in the colour of the force that starts it sliding.

    world: a World or Game at rest, or a scene, which is simulated for 1 s. A click on a block writes its force and
        its load. The forces follow the world as the poses do.
    height: of the picture, px.

    Raises UnavailableError where a part is missing, InputError and SceneError.
    """
    _check(height)
    from teeter.notebook.view import View

    if not isinstance(world, World | Game):
        world = World(world)
        world.run_for(1.0)
    return View(world, height=height, forces=True)
