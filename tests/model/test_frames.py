"""Frames turned in steps: rotations, and the angular velocity that follows from them."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import ONE, ZERO, Matrix

LAB = ph.Frame("lab")
ANGLES = [
    *ph.coordinates("theta phi"),
    ph.functions("chi")[0],
    ph.symbol("alpha"),
    ph.pi / 3,
    2 * ph.coordinates("psi")[0] - ph.pi / 4,
]
SKEW = (ph.Expr.of(2) / 3, ph.Expr.of(-1) / 3, ph.Expr.of(2) / 3)

frames = st.lists(
    st.tuples(st.sampled_from(ANGLES), st.sampled_from(["x", "y", "z", SKEW])),
    min_size=1,
    max_size=3,
).map(lambda steps: turned(LAB, steps))


def turned(frame: ph.Frame, steps) -> ph.Frame:
    for angle, about in steps:
        frame = frame.rotated(angle, about)
    return frame


def rate(matrix: Matrix) -> Matrix:
    return Matrix(tuple(tuple(entry.dt() for entry in row) for row in matrix.rows))


def skew(vector: ph.Vector) -> Matrix:
    x, y, z = vector.components
    return Matrix(((ZERO, -z, y), (z, ZERO, -x), (-y, x, ZERO)))


@settings(max_examples=25)
@given(frame=frames)
def test_angular_velocity_is_how_the_rotation_changes(frame: ph.Frame) -> None:
    """Ṙ Rᵀ is the cross product with ω, along the root frame."""
    turn = frame.rotation_to(LAB)
    assert turn @ turn.T == Matrix.diagonal([ONE] * 3)
    assert rate(turn) @ turn.T == skew(frame.angular_velocity.express(LAB))


@settings(max_examples=25)
@given(frame=frames, other=frames)
def test_rotations_through_a_third_frame_are_the_same(frame: ph.Frame, other: ph.Frame) -> None:
    direct = frame.rotation_to(other)
    assert direct == LAB.rotation_to(other) @ frame.rotation_to(LAB)
    assert other.rotation_to(frame) == direct.T


@settings(max_examples=25)
@given(frame=frames)
def test_a_fixed_vector_of_a_turning_frame_moves_as_its_angular_velocity_says(frame) -> None:
    vector = frame.vector(*ph.symbols("p q r"))
    assert vector.dt().components == frame.angular_velocity.cross(vector).components
    assert vector.dt(seen_from=frame).is_zero
    there = vector.express(LAB)
    assert there.dt().components == vector.dt().express(LAB).components


def test_directions_are_right_handed() -> None:
    for frame in (LAB, turned(LAB, [(ANGLES[0], SKEW), (ANGLES[1], "y")])):
        x, y, z = frame.directions
        assert x.cross(y).components == z.components
        assert frame.others("y") == ("z", "x")


@pytest.mark.parametrize(
    ("directions", "spin"),
    [
        ("east north up", ("east", "north", "up")),
        ("up east north", ("up", "east", "north")),
        ("south east up", ("south", "east", "up")),
        ("north west up", ("north", "west", "up")),
    ],
)
def test_the_earth_turns_about_the_pole_whatever_its_directions_are(directions, spin) -> None:
    Omega, colatitude = ph.symbols("Omega lambda_")
    along = {
        "east": 0,
        "north": Omega * ph.sin(colatitude),
        "up": Omega * ph.cos(colatitude),
        "west": 0,
        "south": -Omega * ph.sin(colatitude),
    }
    ground = ph.earth(Omega, colatitude=colatitude, directions=directions)
    assert ground.turning == tuple(along[name] for name in spin)
    assert ground.compass == spin
    up = ground[ground.labels[spin.index("up")]]
    assert ground.skyward is not None
    assert ground.skyward.components == up.components


def test_down_is_opposite_to_the_sky_and_a_laboratory_has_no_compass() -> None:
    ground = ph.earth(
        ph.symbol("Omega"), colatitude=ph.symbol("lambda_"), directions="north east down"
    )
    assert ground.skyward is not None
    assert ground.skyward.components == (-ground["z"]).components
    assert LAB.compass == ()
    assert LAB.skyward is None


def test_upright_axes_begin_with_the_vertical() -> None:
    first, second, third = ph.upright(LAB).directions
    assert first.express(LAB).components == LAB["z"].components
    assert second.express(LAB).components == LAB["y"].components
    assert third.express(LAB).components == (-LAB["x"]).components
