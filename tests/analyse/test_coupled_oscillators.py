"""Oscillators of which some are damped, or which share a frequency, against matrix exponentials."""

import numpy as np
import pytest
from scipy.linalg import expm

import polhode as ph

LAB = ph.Frame("lab")
#: Stiffness and damping matrices, in units in which the masses are one.
CASES = {
    "one of two is damped": ([[1, 0], [0, 1]], [[0, 0], [0, 1]]),
    "one of two is damped, at another frequency": ([[1, 0], [0, 3]], [[0, 0], [0, 1]]),
    "a damper between equals leaves their common motion": ([[2, -1], [-1, 2]], [[1, -1], [-1, 1]]),
    "one of two is driven": ([[1, 0], [0, 1]], [[0, 0], [0, -1]]),
    "one is damped and one falls over": ([[-1, 0], [0, 1]], [[0, 0], [0, 1]]),
    "equal frequencies": ([[1, 0], [0, 1]], [[0, 0], [0, 0]]),
    "equal frequencies that resonate": ([[1, 1], [0, 1]], [[0, 0], [0, 0]]),
    "equal unstable exponents": ([[-1, 0], [0, -1]], [[0, 0], [0, 0]]),
    "flutter": ([[1, 1], [-1, 1]], [[0, 0], [0, 0]]),
    "three equal ones": (np.eye(3).tolist(), np.zeros((3, 3)).tolist()),
    "three equal ones, two of which resonate": (
        [[1, 1, 0], [0, 1, 0], [0, 0, 1]], np.zeros((3, 3)).tolist(),
    ),
    "two equal ones and a damped one": (np.eye(3).tolist(), np.diag([0, 0, 1]).tolist()),
    "two that resonate and a damped one": (
        [[1, 1, 0], [0, 1, 0], [0, 0, 1]], np.diag([0, 0, 1]).tolist(),
    ),
    "all are damped": ([[1, 0], [0, 2]], [[1, 0], [0, 1]]),
}  # fmt: skip


def oscillators(stiffness, damping):
    """Masses on lines, under forces that are linear in their places and velocities."""
    k, c = ph.symbols("k c", positive=True)
    m = ph.symbol("m", positive=True)
    tags = "abc"[: len(stiffness)]
    places = [ph.coordinate(f"x_{tag}") for tag in tags]
    speeds = [ph.speed(f"v_x_{tag}") for tag in tags]
    parts = []
    for i, tag in enumerate(tags):
        body = ph.point_mass(tag, mass=m, axes=LAB, tag=tag)
        force = sum(-k * int(s) * x for s, x in zip(stiffness[i], places, strict=True))
        force = force + sum(-c * int(d) * v for d, v in zip(damping[i], speeds, strict=True))
        parts.append(ph.Pivot(body, only="y z", name=f"line {tag}"))
        parts.append(ph.Force(body.point(), LAB["x"] * force, name=f"force {tag}"))
    return ph.derive(ph.System(*parts))


def is_bounded(stiffness, damping):
    """Whether departures stay bounded: a Jordan block would make them grow with the time."""
    size = len(stiffness)
    matrix = np.block(
        [[np.zeros((size, size)), np.eye(size)], [-np.array(stiffness), -np.array(damping)]]
    ).astype(float)
    return bool(np.linalg.norm(expm(matrix * 300)) < 20)


@pytest.mark.parametrize("name", CASES)
def test_they_are_stable_where_departures_stay_bounded(name):
    stiffness, damping = CASES[name]
    equations = oscillators(stiffness, damping)
    at_rest = {f"x_{tag}": 0 for tag in "abc"[: len(stiffness)]}
    (family,) = ph.steady(equations, at_rest)
    expected = "stable" if is_bounded(stiffness, damping) else "unstable"
    assert str(ph.stability(family)) == expected


def test_a_bob_seen_from_above_is_stable_below_and_unstable_above():
    """A spherical pendulum described by two tilts: both frequencies are equal."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    axes = LAB.rotated(alpha, "x").rotated(beta, "y")
    bob = ph.Body("bob", mass=m, inertia=(0, 0, 0), axes=axes)
    hanging = ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g))
    for angle, expected in ((0, "stable"), (ph.pi, "unstable")):
        (family,) = ph.steady(ph.derive(hanging), {"alpha": angle, "beta": 0})
        assert str(ph.stability(family)) == expected


def test_springs_of_different_stiffness_leave_one_place_of_rest() -> None:
    """Rest is at x₁ = x₂ = 0 only, and the frequencies are those of the stiffness matrix."""
    k_1, k_2, k_3, m_1, m_2 = ph.symbols("k_1 k_2 k_3 m_1 m_2", positive=True)
    x_1, x_2 = ph.coordinates("x_1 x_2")
    carts = [ph.point_mass(n, mass=m, axes=LAB, tag=n) for n, m in (("1", m_1), ("2", m_2))]
    rails = [ph.Pivot(cart, only="y z", name=f"rail {cart.name}") for cart in carts]
    stored = (k_1 * x_1**2 + k_2 * (x_2 - x_1) ** 2 + k_3 * x_2**2) / 2
    (rest,) = ph.steady(ph.derive(ph.System(*rails, ph.Potential(stored, on=carts))))
    assert set(rest.relations) == {x_1, x_2}
    small, values = ph.stability(rest), {k_1: 2, k_2: 3, k_3: 5, m_1: 1, m_2: 4}
    assert str(small) == "stable"
    exactly = np.linalg.eigvals(np.array([[5, -3], [-3 / 4, 8 / 4]]))
    found = [float(ph.to_sympy((w**2).subs(values))) for w in small.frequencies]
    np.testing.assert_allclose(sorted(found), sorted(exactly), rtol=1e-12)
