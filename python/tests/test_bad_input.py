"""Bad input of every kind to every public function: a typed exception, never a panic."""

import inspect
import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import teeter

#: What a function may raise at bad input. A panic of Rust is a BaseException of none of these.
EXPECTED = (teeter.TeeterError, TypeError)

SCENE = teeter.scenes.config("(111)-(111)")
WORLD = teeter.World(SCENE)
GAME = teeter.Game(SCENE, "official")
RECORD = teeter.Game(SCENE, record=True).record()

scalars = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.integers(-2, 8),
    st.floats(),
    st.text(max_size=5),
    st.binary(max_size=5),
    st.sampled_from([math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, 2**31, 2**32, 2**63, 2**64, 10**400]),
    st.sampled_from(["tower", "(010)", "(1)", "official", "free", "rigid", "none", "pull", "idle", "grasp", "\ud800"]),
    st.sampled_from([np.float32(0.5), np.int64(-1), np.uint8(3), np.nan, object(), b"", complex(1, 2)]),
)
vectors = st.lists(st.floats() | st.integers(-3, 3), min_size=0, max_size=5)
fields = st.sampled_from(
    [
        "body",
        "target",
        "anchor",
        "orientation",
        "grip",
        "axis",
        "max_force",
        "force",
        "point",
        "velocity",
        "hand",
        "forces",
        "drives",
        "gravity",
        "command",
        "displacement",
        "slot",
        "rotation",
        "form",
        "row",
        "cell",
        "normal",
        "rows",
        "seed",
        "friction",
        "players",
        "blocks",
        "name",
        "pos",
        "size",
        "mass",
    ]
)
values = st.recursive(
    scalars | vectors | vectors.map(np.array),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(fields, inner, max_size=4),
    max_leaves=8,
)
hands = st.fixed_dictionaries(
    {"body": st.integers(-2, 8), "target": vectors, "anchor": vectors},
    optional={
        "orientation": vectors,
        "grip": st.sampled_from(["slide", "carry", "push"]),
        "axis": vectors,
        "max_force": st.floats(),
        "max_torque": st.floats(),
    },
)
commands = st.fixed_dictionaries(
    {
        "command": st.sampled_from(
            ["idle", "grasp", "move", "turn", "place", "poke", "release", "set_hand", "set_blocks", "resign", "rebuild"]
        )
    },
    optional={
        "body": st.integers(-1, 8),
        "anchor": vectors,
        "normal": vectors,
        "grip": st.sampled_from(["auto", "slide", "carry", "push"]),
        "displacement": vectors,
        "rotation": vectors,
        "form": st.sampled_from(["rigid", "lattice"]),
        "spring_stiffness": st.floats(),
        "max_force": st.floats(),
        "slot": st.fixed_dictionaries({"row": st.integers(), "cell": st.integers(0, 5)}),
    },
)


def attempt(function, *args, **kwargs):
    """Calls a function and returns the exception that it raised, or None."""
    try:
        function(*args, **kwargs)
    except EXPECTED as error:
        message = str(error)
        assert message and "\n" not in message, message
        assert "panicked" not in message, message
        return error
    return None


# What may be called with anything, and does not take long whatever it is given.
METHODS = {
    "World": (lambda: WORLD.clone(), {"snapshot", "hash", "clone", "run_for"}),
    "Game": (lambda: GAME.clone(), {"snapshot", "hash", "state_hash", "clone", "settle", "take"}),
    "Record": (lambda: RECORD, set()),
    "WorldBatch": (lambda: teeter.WorldBatch([WORLD, WORLD], threads=1), {"run_for"}),
    "Opponent": (lambda: teeter.Opponent(0), set()),
}


def methods():
    for name, (_, left_out) in METHODS.items():
        for method, function in inspect.getmembers(getattr(teeter, name), callable):
            if not method.startswith("_") and method not in left_out:
                yield name, method, len(parameters(function))


def parameters(function):
    named = inspect.signature(function).parameters.values()
    return [parameter.name for parameter in named if parameter.name not in ("self", "options", "params", "springs")]


FUNCTIONS = [
    teeter.World,
    teeter.Game,
    teeter.Record,
    teeter.Opponent,
    teeter.rules,
    teeter.force_map,
    teeter.remove,
    teeter.thinking,
    teeter.analyse,
    teeter.breakdown,
    teeter.step_games,
    teeter.scenes.load,
    teeter.scenes.named,
    teeter.scenes.config,
    teeter.scenes.cards,
]

relaxed = settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))


@pytest.mark.parametrize("name, method, count", list(methods()), ids=lambda value: str(value))
def test_any_argument_of_a_method_is_taken_or_refused_by_a_typed_exception(name, method, count):
    @relaxed
    @given(st.lists(values, min_size=0, max_size=count + 1))
    def check(args):
        attempt(getattr(METHODS[name][0](), method), *args)

    check()


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_any_argument_of_a_function_is_taken_or_refused_by_a_typed_exception(function):
    @relaxed
    @given(st.lists(values, min_size=1, max_size=3))
    def check(args):
        attempt(function, *args)

    check()


@relaxed
@given(st.dictionaries(st.sampled_from(["precision", "width", "sleep", "ramp", "frame", "speed"]), values, max_size=3))
def test_any_constants_of_a_run_are_taken_or_refused(params):
    attempt(teeter.World, "block", **params)
    attempt(teeter.WorldBatch, ["block"], threads=1, **params)


@relaxed
@given(
    st.dictionaries(
        st.sampled_from(["rows", "seed", "block", "height_sd", "mass_sd", "friction", "restitution", "colour"]),
        values,
        max_size=3,
    )
)
def test_any_options_of_a_tower_are_taken_or_refused(options):
    attempt(teeter.scenes.tower, **options)
    attempt(teeter.scenes.config, "(010)", **options)
    attempt(teeter.scenes.field, 2, **options)


@settings(relaxed, max_examples=200)
@given(hands, vectors, st.lists(st.fixed_dictionaries({"body": st.integers(-1, 7), "force": vectors}), max_size=2))
def test_any_input_is_applied_or_refused_and_a_refused_one_changes_nothing(hand, gravity, forces):
    world = WORLD.clone()
    before = world.hash()
    error = attempt(world.step, hand=hand, gravity=gravity, forces=forces)
    if error is not None:
        assert world.hash() == before and getattr(error, "field", None), error
    else:
        assert np.isfinite(world.poses).all()
    attempt(world.step, hand=hand)
    attempt(world.run_for, 0.05, forces=forces)


@settings(relaxed, max_examples=200)
@given(st.lists(commands, min_size=1, max_size=4))
def test_any_command_is_carried_out_refused_by_an_event_or_an_exception(sequence):
    game = GAME.clone()
    for command in sequence:
        attempt(game.judge, command)
        attempt(game.step, command)
    assert np.isfinite(game.poses).all()


@relaxed
@given(st.binary(max_size=200), st.integers(0, 10_000), st.integers(0, 255))
def test_any_bytes_are_no_state_and_no_record(data, at, flipped):
    world, game = WORLD.clone(), GAME.clone()
    hashes = world.hash(), game.state_hash()
    for restore, state in ((world.restore, world.snapshot()), (game.restore, game.snapshot())):
        assert isinstance(attempt(restore, data), teeter.SnapshotError)
        altered = bytearray(state)
        altered[at % len(altered)] ^= flipped
        if flipped:
            assert isinstance(attempt(restore, bytes(altered)), teeter.SnapshotError)
    assert (world.hash(), game.state_hash()) == hashes
    assert isinstance(attempt(teeter.Record, data), teeter.RecordError)


@pytest.mark.parametrize(
    "call, kind, field",
    [
        (lambda: teeter.World("castle"), teeter.SceneError, "scene"),
        (lambda: teeter.World(3), teeter.SceneError, "scene"),
        (lambda: teeter.World(SCENE | {"friction": math.nan}), teeter.SceneError, "scene.friction"),
        (lambda: teeter.World(SCENE | {"friction": -1.0}), teeter.SceneError, "friction"),
        (lambda: teeter.World(SCENE | {"colour": 1}), teeter.SceneError, "colour"),
        (lambda: teeter.World("block", frame=1.0), teeter.ParamError, "frame"),
        (lambda: teeter.World("block", sleep="no"), teeter.ParamError, "sleep"),
        (lambda: teeter.World("block", speed=1), teeter.ParamError, "speed"),
        (lambda: WORLD.clone().run_for(math.inf), teeter.InputError, "seconds"),
        (lambda: WORLD.clone().step(gravity=(0, 0)), teeter.InputError, "gravity"),
        (lambda: WORLD.clone().step(gravity=(0, 0, math.nan)), teeter.InputError, "gravity[2]"),
        (
            lambda: WORLD.clone().step(hand=teeter.Hand(body=0, target=(0, 0, "up"))),
            teeter.InputError,
            "hand.target[2]",
        ),
        (
            lambda: WORLD.clone().step(hand=teeter.Hand(body=0, target=(0, 0, 0), max_force=-1)),
            teeter.InputError,
            "hand.max_force",
        ),
        (lambda: WORLD.clone().step(hand=teeter.Hand(body=6, target=(0, 0, 0))), teeter.BodyError, "hand.body"),
        (lambda: WORLD.clone().step(forces=[{"body": 6, "force": (0, 0, 0)}]), teeter.BodyError, "forces[0].body"),
        (lambda: WORLD.contacts(-1), teeter.BodyError, "body"),
        (lambda: WORLD.breakaway_force(0, (0, 0, 0)), teeter.InputError, "direction"),
        (lambda: WORLD.render(0, 5), teeter.InputError, "width"),
        (lambda: GAME.clone().step({"command": "fly"}), teeter.CommandError, "command.command"),
        (lambda: GAME.clone().step({"command": "place", "body": 77}), teeter.BodyError, "command.body"),
        (lambda: GAME.clone().take(0, seed=-1), teeter.InputError, "seed"),
        (lambda: teeter.Opponent(0, "genius"), teeter.InputError, "strength"),
        (lambda: teeter.scenes.tower(rows=0), teeter.SceneError, "rows"),
        (lambda: teeter.scenes.config("(010)-(000)"), teeter.SceneError, None),
    ],
)
def test_a_refusal_names_its_field(call, kind, field):
    with pytest.raises(kind) as error:
        call()
    assert error.value.field == field, str(error.value)
    assert isinstance(error.value, teeter.TeeterError)


def test_data_without_an_end_is_refused():
    endless = []
    endless.append(endless)
    with pytest.raises(teeter.CommandError, match="deep"):
        GAME.clone().step({"command": endless})
    with pytest.raises(teeter.SceneError):
        teeter.World({"blocks": endless})


def test_an_exception_survives_a_pickle():
    import pickle

    with pytest.raises(teeter.BodyError) as error:
        WORLD.contacts(99)
    again = pickle.loads(pickle.dumps(error.value))
    assert str(again) == str(error.value) and again.field == "body"
    assert isinstance(again, IndexError)
