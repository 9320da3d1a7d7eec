"""How fast the point of contact travels over a body that turns, against differences."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from polhode.model import Ellipsoidal, Rim, Round, Surface

AXES = ph.Frame("lab")
SHAPES: dict[str, Surface] = {
    "sphere": Round(0.3),
    "loaded sphere": Round(0.3, "2", 0.1),
    "rim": Rim(0.4, "3"),
    "rim on an axle": Rim(0.4, "1", -0.2),
    "ellipsoid": Ellipsoidal((0.2, 0.3, 0.5), (0.05, 0, -0.1)),
}
VECTORS = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)
NORMAL, FIRST, SECOND = (ph.symbols(f"{v}_1 {v}_2 {v}_3") for v in "nst")
Function = Callable[..., np.ndarray]


def vector(components: tuple[ph.Expr, ...]) -> ph.Vector:
    along = (AXES[label] * c for label, c in zip(AXES.labels, components, strict=True))
    return sum(along, AXES.zero)


@cache
def functions(name: str) -> tuple[Function, Function]:
    """The point that touches and the axes, of the normal and the tangents in numbers."""
    surface, normal = SHAPES[name], vector(NORMAL)
    axes = surface.rolling_axes(AXES, normal, (vector(FIRST), vector(SECOND)))
    arm = surface.lowest(AXES, normal).express(AXES).components
    rows = [c for k in axes for c in k.express(AXES).components]
    known = tuple(s.symbol for s in (*NORMAL, *FIRST, *SECOND))
    place, found = (ph.compile_program(e, known).function() for e in (arm, rows))
    return (
        lambda *given: np.array(place(*np.concatenate(given))),
        lambda *given: np.reshape(found(*np.concatenate(given)), (-1, 3)),
    )


def unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v)


@pytest.mark.parametrize("name", SHAPES)
@given(normal=VECTORS, turning=VECTORS)
def test_the_point_travels_as_the_axes_say(name: str, normal: tuple, turning: tuple) -> None:
    n, w = unit(np.array(normal)), np.array(turning)
    if isinstance(surface := SHAPES[name], Rim):  # not lying flat
        n[int(surface.axis) - 1] *= 0.5
        n = unit(n + 0.2 * np.roll(np.eye(3)[int(surface.axis) - 1], 1))
    first = unit(np.cross(n, np.eye(3)[np.argmin(np.abs(n))]))
    second = np.cross(n, first)
    touched, axes = functions(name)
    # In the body the normal of a plane at rest turns the other way round: n' = n - dt ω × n.
    dt = 1e-5
    ahead, behind = (unit(n - sign * dt * np.cross(w, n)) for sign in (1, -1))
    travel = (touched(ahead, first, second) - touched(behind, first, second)) / (2 * dt)
    found = axes(n, first, second) @ w
    if len(found) == 2:
        assert found == pytest.approx([travel @ first, travel @ second], abs=1e-6)
    else:  # along the rim, in one direction of it or the other
        assert abs(found[0]) == pytest.approx(np.linalg.norm(travel), abs=1e-6)


def test_a_body_that_touches_with_one_point_does_not_roll() -> None:
    assert ph.Face(0.1).rolling_axes(AXES, AXES["z"], (AXES["x"], AXES["y"])) == ()
