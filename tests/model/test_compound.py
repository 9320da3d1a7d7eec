"""Mass, centre of mass and inertia of bodies that are made of several."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph

LAB = ph.Frame("lab")
theta = ph.coordinate("theta")
g, m, R, L = ph.symbols("g m R L", positive=True)
lengths = st.integers(-4, 4).map(lambda n: Fraction(n, 2))
places = st.tuples(lengths, lengths, lengths)
turns = st.sampled_from([Fraction(0), Fraction(1, 3), Fraction(-5, 2)])
parts = st.lists(
    st.tuples(st.integers(1, 5), places, turns, st.sampled_from("xyz")), min_size=1, max_size=3
)


def points(mass, place, angle, axis):
    """The eight corners of a box of sides 1, 2, 3, turned and shifted, with the mass shared.

    Their second moments are three times those of a solid one.
    """
    turn = np.eye(3)
    i, j = [k for k in range(3) if "xyz"[k] != axis]
    sign = -1 if axis == "y" else 1
    turn[i, i] = turn[j, j] = np.cos(float(angle))
    turn[j, i] = sign * np.sin(float(angle))
    turn[i, j] = -turn[j, i]
    halves = np.array([[x, 2 * y, 3 * z] for x in (1, -1) for y in (1, -1) for z in (1, -1)]) / 2
    return np.array([mass / 8.0] * 8), halves / 3**0.5 @ turn.T + np.array(place, float)


@given(parts)
def test_as_for_the_particles_of_all_parts(listed):
    """A solid box has the moments of its corners, drawn together by √3."""
    bodies = [
        (
            ph.box(f"{n}", mass=mass, sides=(1, 2, 3), axes=LAB.rotated(angle, axis)),
            LAB.vector(*place),
        )
        for n, (mass, place, angle, axis) in enumerate(listed)
    ]
    whole = ph.compound("whole", bodies, axes=LAB)
    clouds = [points(*part) for part in listed]
    masses = np.concatenate([mass for mass, _ in clouds])
    where = np.concatenate([place for _, place in clouds])
    centre = masses @ where / masses.sum()
    away = where - centre
    inertia = np.einsum("n,nij->ij", masses, [(r @ r) * np.eye(3) - np.outer(r, r) for r in away])
    found = np.reshape(ph.compile_program(whole.inertia.entries, ()).function()(), (3, 3))
    assert np.allclose(found, inertia, atol=1e-12 * masses.sum() * 50)
    at = ph.compile_program(ph.centre_of_mass(bodies).components, ()).function()()
    assert np.allclose(at, centre, atol=1e-13)
    assert whole.mass.rational == masses.sum()


def test_a_pendulum_of_a_clock_swings_like_its_parts_welded_together():
    axes = LAB.rotated(theta, "y")
    shaft = ph.rod("shaft", mass=m, length=L, axes=axes, axis="z", tag="s")
    bob = ph.Body("bob", mass=2 * m, inertia=[2 * m * R**2] * 3, axes=axes, tag="b")
    listed = [(shaft, axes["z"] * (-L / 2)), (bob, axes["z"] * -L)]
    one = ph.compound("pendulum", listed, axes=axes)
    whole = ph.derive(ph.System(ph.Pivot(one, at=-ph.centre_of_mass(listed)), ph.Gravity(g)))
    welded = ph.derive(
        ph.System(
            ph.Pivot(shaft, at=axes["z"] * (L / 2)),
            ph.Pivot(bob, at=axes.zero, to=shaft.point(axes["z"] * (-L / 2)), name="P", force="P"),
            ph.Gravity(g),
        )
    )
    assert whole.accelerations == welded.accelerations


def test_parts_that_move_are_refused():
    arm = ph.rod("arm", mass=m, length=L, axes=LAB.rotated(theta, "y"), axis="x")
    with pytest.raises(ph.DeclarationError, match="moves with theta"):
        ph.compound("both", [(arm, LAB.zero)], axes=LAB)
    fixed = ph.rod("arm", mass=m, length=L, axes=LAB, axis="x")
    with pytest.raises(ph.DeclarationError, match="moves with theta"):
        ph.compound("both", [(fixed, LAB["x"] * theta)], axes=LAB)


@pytest.mark.parametrize("given_", [[], None, "rod", [(LAB, LAB.zero)], [LAB["x"]]])
def test_what_are_no_parts_is_refused(given_):
    with pytest.raises(ph.DeclarationError):
        ph.compound("nothing", given_, axes=LAB)
    with pytest.raises(ph.DeclarationError):
        ph.centre_of_mass(given_)


def test_a_massless_whole_has_no_centre():
    link = ph.Body("link", mass=0, axes=LAB)
    with pytest.raises(ph.DeclarationError, match="massless"):
        ph.centre_of_mass([(link, LAB.zero)])
