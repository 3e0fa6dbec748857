"""Pages of the browser that follow an environment."""

import base64
import json
import urllib.error
import urllib.request

import gymnasium
import numpy as np
import pytest

import teeter.envs  # noqa: F401, registers the environments
from teeter import World
from teeter.envs import window as module
from teeter.envs.teeter_v0 import env as game
from teeter.envs.window import Window
from teeter.errors import UnavailableError

needs_view = pytest.mark.skipif(not module.bundle.BUNDLE.exists(), reason="the view is not built: make page")


@pytest.fixture
def opened(monkeypatch):
    """Addresses that a browser was asked to open."""
    addresses = []
    monkeypatch.setattr(module.webbrowser, "open", addresses.append)
    return addresses


@pytest.fixture
def window():
    window = Window()
    yield window
    window.close()


def states(address):
    """States as a page receives them."""
    with urllib.request.urlopen(address + "states") as stream:
        for line in stream:
            if line.startswith(b"data: "):
                state = json.loads(line[6:])
                yield {name: np.frombuffer(base64.b64decode(text), np.float32) for name, text in state.items()}


@needs_view
def test_a_page_draws_the_last_state_and_each_that_follows(window):
    world = World("column")
    window.show(world)
    found = states(window.address)
    first = next(found)
    np.testing.assert_array_equal(first["sizes"], world.sizes.astype(np.float32).ravel())
    np.testing.assert_array_equal(first["poses"], world.poses.astype(np.float32).ravel())
    world.run_for(0.5)
    window.show(world)
    np.testing.assert_array_equal(next(found)["poses"], world.poses.astype(np.float32).ravel())
    found.close()


@needs_view
def test_a_page_that_is_closed_ends_its_stream():
    window = Window()
    window.show(World("column"))
    found = states(window.address)
    next(found)
    window.close()
    assert list(found) == []


@needs_view
def test_the_files_of_a_page_are_its_own(window):
    for path, kind in (("", "text/html"), ("window.js", "text/javascript"), ("widget.js", "text/javascript")):
        with urllib.request.urlopen(window.address + path) as answer:
            assert answer.headers["Content-Type"].startswith(kind) and answer.read()
            assert "default-src 'self'" in answer.headers["Content-Security-Policy"]
    with pytest.raises(urllib.error.HTTPError, match="404"):
        urllib.request.urlopen(window.address + "../pyproject.toml")
    other = urllib.request.Request(window.address, headers={"Host": "example.org"})
    with pytest.raises(urllib.error.HTTPError, match="421"):
        urllib.request.urlopen(other)


@needs_view
@pytest.mark.parametrize("name, arguments", [("Extract", {"rows": 4}), ("Place", {"rows": 4}), ("Solo", {"rows": 4})])
def test_a_person_sees_each_step_of_an_environment(name, arguments, opened):
    env = gymnasium.make(f"Teeter/{name}-v0", render_mode="human", **arguments)
    env.reset(seed=1)
    assert len(opened) == 1 and env.render() is None
    found = states(opened[0])
    before = next(found)["poses"]
    action = env.unwrapped.action_space
    if name == "Solo":
        env.step(int(np.flatnonzero(env.unwrapped._mask())[0]))
    else:
        env.step(np.array([1.0, 0.0, 0.0, 0.0, 0.0][: action.shape[0]], np.float32))
    after = next(found)["poses"]
    np.testing.assert_array_equal(after, env.unwrapped.game.world.poses.astype(np.float32).ravel())
    assert not np.array_equal(before, after) and len(opened) == 1
    env.close()


@needs_view
def test_a_person_sees_a_game_of_several_players(opened):
    env = game(rows=4, render_mode="human")
    env.reset(seed=1)
    assert len(opened) == 1 and env.render() is None
    env.step(int(np.flatnonzero(env.last()[0]["action_mask"])[0]))
    env.close()


def test_a_view_that_was_not_built_is_named(monkeypatch, tmp_path):
    monkeypatch.setattr(module.bundle, "BUNDLE", tmp_path / "widget.js")
    with pytest.raises(UnavailableError, match="make page"):
        Window()
