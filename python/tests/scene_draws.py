"""Scenes for hypothesis: boxes that are apart, in any pose, with any of the fields of a block."""

import math

import numpy as np
from hypothesis import strategies as st

from teeter.interchange.rotation import matrix, of_block

NUMBERS = st.floats(-1.0, 1.0).map(lambda x: round(x, 6) * 0.9973)
VECTORS = st.lists(NUMBERS, min_size=3, max_size=3)


@st.composite
def blocks(draw, number):
    edge = st.floats(0.01, 0.5)
    block = {
        "id": number,
        "size": [draw(edge) for _ in range(3)],
        "mass": draw(st.floats(0.01, 5.0)),
        "pos": [2.0 * number + draw(NUMBERS) / 2, draw(NUMBERS), 3.0 + draw(NUMBERS)],
    }
    if draw(st.booleans()):
        block["yaw"] = draw(st.floats(-3.0, 3.0))
    else:
        x, y, z = draw(VECTORS)
        length = math.sqrt(x * x + y * y + z * z + 0.25)
        block["orientation"] = [x / length, y / length, z / length, 0.5 / length]
    if draw(st.booleans()):
        block["fixed"] = True
    else:
        block |= {"velocity": draw(VECTORS), "spin": draw(VECTORS)}
    if draw(st.booleans()):
        block["friction"] = draw(st.floats(0.05, 1.5))
    return block


@st.composite
def scenes(draw):
    count = draw(st.integers(1, 4))
    return {
        "name": draw(st.sampled_from(["two", "a & <b>", "Türme"])),
        "gravity": draw(st.floats(0.0, 20.0)),
        "friction": draw(st.floats(0.05, 1.5)),
        "restitution": draw(st.floats(0.0, 1.0)),
        "stiffness": draw(st.floats(1e5, 1e7)),
        "edge_radius": draw(st.floats(0.0, 0.003)),
        "blocks": [draw(blocks(number)) for number in draw(st.permutations(range(count)))],
    }


def assert_same(one, other, *, velocities=True, exact=True):
    """Two scenes are equal within 1e-12: poses, masses, friction and the constants of contacts."""
    same = ("gravity", "friction", "restitution", "stiffness", "edge_radius") if exact else ("gravity",)
    assert one["name"] == other["name"]
    for field in same:
        assert math.isclose(one.get(field, 0.0), other.get(field, 0.0), rel_tol=1e-12), field
    assert [block["id"] for block in one["blocks"]] == [block["id"] for block in other["blocks"]]
    for a, b in zip(one["blocks"], other["blocks"], strict=True):
        np.testing.assert_allclose(a["size"], b["size"], rtol=1e-12)
        np.testing.assert_allclose(a["pos"], b["pos"], rtol=1e-12, atol=1e-12)
        assert bool(a.get("fixed")) == bool(b.get("fixed"))
        assert math.isclose(a["mass"], b["mass"], rel_tol=1e-12)
        np.testing.assert_allclose(matrix(of_block(a)), matrix(of_block(b)), atol=1e-12)
        friction = [block.get("friction") or scene["friction"] for block, scene in ((a, one), (b, other))]
        assert math.isclose(*friction, rel_tol=1e-9 if exact else 1e-12)
        for field in ("velocity", "spin") if velocities else ():
            np.testing.assert_allclose(a.get(field, [0, 0, 0]), b.get(field, [0, 0, 0]), atol=1e-12)


@st.composite
def damaged(draw, text):
    """A text with a few of its characters changed, repeated or left out."""
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        stop = min(len(text), start + draw(st.integers(0, 12)))
        put = draw(
            st.sampled_from(["", "<", '"', "/>", " ", "0", "-1", "nan", "1e400", "&amp;", "é", text[start:stop] * 2])
        )
        text = text[:start] + put + text[stop:]
    return text
