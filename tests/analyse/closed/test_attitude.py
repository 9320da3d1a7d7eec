"""A closed form is of the body, not of the angles it is described by.

The same body is started in the same way in several sequences of rotations, with angles negated,
gravity along other axes and the axis of symmetry along others. What has nothing to do with angles
must come out the same; and each coordinate must be what a simulation makes of it.
"""

import numpy as np
import pytest

import polhode as ph
from polhode.analyse import closed_form
from polhode.base import NumericError
from polhode.derive import Equations

M, A_, I_1, I_2, I_3, G = ph.symbols("M a I_1 I_2 I_3 g", positive=True)
ANGLES = ph.coordinates("a_1 a_2 a_3")
LAB = ph.Frame("lab")

#: Rotations about axes, their signs, the body's axis of symmetry, and which way is up.
CHARTS = {
    "z-x-z": ("zxz", "+++", "z", "z"),
    "z-x-y": ("zxy", "+++", "y", "z"),
    "z-y-x": ("zyx", "+++", "x", "z"),
    "x-y-z": ("xyz", "+++", "z", "z"),
    "y-x-z": ("yxz", "+++", "z", "z"),
    "negated": ("zxz", "-+-", "z", "z"),
    "tilts negated": ("xyz", "--+", "z", "z"),
    "axis not last": ("zxy", "+++", "z", "z"),
    "world on its side": ("xyz", "+++", "z", "x"),
    "Euler on its side": ("xzx", "+-+", "x", "x"),
}
NUMBERS = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 2}


def frames(turns: str, signs: str) -> ph.Frame:
    axes = LAB
    for angle, about, sign in zip(ANGLES, turns, signs, strict=True):
        axes = axes.rotated(-angle if sign == "-" else angle, about)
    return axes


def top(turns: str, signs: str, along: str, up: str) -> Equations:
    axes = frames(turns, signs)
    moments = tuple(I_1 if label == along else I_2 for label in "xyz")
    body = ph.Body("top", mass=M, inertia=moments, axes=axes)
    pivot = ph.Pivot(body, at=axes[along] * -A_)
    return ph.derive(ph.System(body, pivot, ph.Gravity(G, up=LAB[up]), name="top"))


def rotation(about: str, angle: float) -> np.ndarray:
    i = "xyz".index(about)
    j, k = (i + 1) % 3, (i + 2) % 3
    found = np.eye(3)
    found[j, j] = found[k, k] = np.cos(angle)
    found[k, j], found[j, k] = np.sin(angle), -np.sin(angle)
    return found


def attitude(turns: str, signs: str, angles) -> np.ndarray:
    """By hand, for one set of angles."""
    found = np.eye(3)
    for about, sign, angle in zip(turns, signs, angles, strict=True):
        found = found @ rotation(about, -angle if sign == "-" else angle)
    return found


def physics(chart, start, found) -> tuple[np.ndarray, ...]:
    """Height of the axis and its turn about the vertical since the start, spin and energy."""
    turns, signs, along, up = chart
    names = [f"a_{i}" for i in (1, 2, 3)]
    track = np.stack([np.asarray(found[n], dtype=float) for n in names], axis=-1)
    rates = np.stack([np.asarray(found[f"{n}_dot"], dtype=float) for n in names], axis=-1)
    i, u = "xyz".index(along), np.eye(3)["xyz".index(up)]
    axes = np.array([attitude(turns, signs, a)[:, i] for a in track])
    turning = np.array([turned(turns, signs, a, r) for a, r in zip(track, rates, strict=True)])
    spin = np.einsum("ij,ij->i", axes, turning)
    across = np.einsum("ij,ij->i", turning, turning) - spin**2
    height = axes @ u
    return height, spin, across + spin**2 / 2 + 2 * height


def turned(turns, signs, angles, rates) -> np.ndarray:
    """Angular velocity along the laboratory's axes, by hand."""
    found, so_far = np.zeros(3), np.eye(3)
    for about, sign, angle, rate in zip(turns, signs, angles, rates, strict=True):
        factor = -1 if sign == "-" else 1
        found = found + factor * rate * so_far[:, "xyz".index(about)]
        so_far = so_far @ rotation(about, factor * angle)
    return found


def started(chart) -> dict[str, float]:
    """The angles and rates of one and the same start, up to a turn about the vertical."""
    from scipy.optimize import fsolve

    turns, signs, along, up = chart
    i, u = "xyz".index(along), "xyz".index(up)
    # Vertical and two level axes of the laboratory, and the same of the body, in cyclic order.
    space = np.roll(np.eye(3), -(u + 1), axis=0)
    own = np.roll(np.eye(3), -(i + 1), axis=0)
    wanted = space.T @ rotation("x", 0.9) @ rotation("z", 0.4) @ own
    turning = wanted @ own.T @ np.array([0.7, -0.4, 3.0])

    def gap(angles):
        error = attitude(turns, signs, angles).T @ wanted
        return error[2, 1] - error[1, 2], error[0, 2] - error[2, 0], error[1, 0] - error[0, 1]

    for guess in np.random.default_rng(3).uniform(-2, 2, (200, 3)):
        angles, *_ = fsolve(gap, guess, full_output=True, xtol=1e-14)
        if np.allclose(attitude(turns, signs, angles), wanted, rtol=0, atol=1e-13):
            break
    else:
        raise AssertionError("no angles found for the start")
    angles = np.remainder(angles + np.pi, 2 * np.pi) - np.pi
    columns = np.array([turned(turns, signs, angles, unit) for unit in np.eye(3)]).T
    rates = np.linalg.solve(columns, turning)
    names = [f"a_{k}" for k in (1, 2, 3)]
    return dict(zip([*names, *(f"{n}_dot" for n in names)], [*angles, *rates], strict=True))


TIMES = np.linspace(0, 12, 61)


@pytest.fixture(scope="module")
def reference():
    chart = CHARTS["z-x-z"]
    motion = closed_form(top(*chart), NUMBERS, started(chart))
    return motion, physics(chart, None, motion.at(TIMES))


@pytest.mark.parametrize("name", CHARTS)
def test_a_top_moves_the_same_in_any_angles(name, reference):
    chart = CHARTS[name]
    equations, start = top(*chart), started(chart)
    motion = closed_form(equations, NUMBERS, start)
    known, wanted = reference
    assert (motion.name, motion.kind) == (known.name, known.kind)
    assert motion.period == pytest.approx(known.period, rel=1e-13)
    for figure, value in known.figures.items():
        assert motion.figures[figure] == pytest.approx(value, rel=1e-11)
    found = motion.at(TIMES)
    for one, other in zip(physics(chart, start, found), wanted, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-11)
    run = ph.simulate(equations, NUMBERS, start, TIMES[-1])
    for quantity, values in found.items():
        np.testing.assert_allclose(values, run.table([quantity], TIMES)[quantity], atol=1e-9)


def test_energy_and_spin_are_what_the_start_says(reference):
    """ω·e = 3, ė² = 0.7² + 0.4², and e leans by 0.9."""
    height, spin, energy = reference[1]
    np.testing.assert_allclose(spin, 3, atol=1e-12)
    np.testing.assert_allclose(energy, 0.65 + 4.5 + 2 * np.cos(0.9), atol=1e-12)
    assert height[0] == pytest.approx(np.cos(0.9), abs=1e-14)


def coin(turns: str, along: str) -> Equations:
    axes = LAB
    for angle, about in zip(ANGLES, turns, strict=False):
        axes = axes.rotated(angle, about)
    moments = tuple(M * A_**2 / (2 if label == along else 4) for label in "xyz")
    spin = {"spin_about": along} if len(turns) == 2 else {}
    disk = ph.Body("coin", mass=M, inertia=moments, axes=axes, surface=ph.Rim(A_, along), **spin)
    smooth = ph.Smooth(disk, on=ph.Plane(LAB))
    return ph.derive(ph.System(smooth, ph.Gravity(G), name="coin"))


COINS = [
    ("zx", "y", {"a_1": 0.1, "a_2": 0.3, "a_1_dot": 40, "omega_y": 5}),
    ("zxy", "y", {"a_1": 0.1, "a_2": 0.3, "a_1_dot": 40, "a_3_dot": 5}),
    ("zyx", "x", {"a_1": 0.1, "a_2": 0.3, "a_1_dot": 40, "a_3_dot": 5}),
    ("xy", "z", {"a_1": 1.2, "a_2": 0.1, "a_1_dot": 4, "a_2_dot": 30, "omega_z": 5}),
]


@pytest.mark.parametrize(("turns", "along", "start"), COINS)
def test_a_coin_in_any_angles(turns, along, start):
    numbers = {"M": 0.0075, "a": 0.012, "g": 9.81}
    equations = coin(turns, along)
    motion = closed_form(equations, numbers, start)
    assert motion.name == "spinning coin"
    run = ph.simulate(equations, numbers, start, 0.3)
    for quantity, values in motion.at(run.t).items():
        np.testing.assert_allclose(values, run[quantity], rtol=1e-10, atol=1e-9)


@pytest.mark.parametrize("turns", ["zxz", "xyz", "zyx"])
def test_a_free_body_in_any_angles(turns):
    body = ph.Body("racquet", mass=M, inertia=(I_1, I_2, I_3), axes=frames(turns, "+++"))
    equations = ph.derive(ph.System(ph.Pivot(body), name="racquet"))
    numbers = {"M": 1, "I_1": 1, "I_2": 2, "I_3": 3}
    start = {"a_1": 0.1, "a_2": 0.5, "a_3": 0.2, "a_1_dot": 0.3, "a_2_dot": 1, "a_3_dot": 0.2}
    motion = closed_form(equations, numbers, start)
    assert motion.name == "free body"
    run = ph.simulate(equations, numbers, start, 10)
    for quantity, values in motion.at(run.t).items():
        np.testing.assert_allclose(values, run[quantity], rtol=0, atol=1e-10)


@pytest.mark.parametrize("arm", ["x", "-x", "z", "-z"])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_pendulum_counted_from_anywhere(arm, sign):
    axes = LAB.rotated(sign * ANGLES[0], "y")
    bob = ph.Body("bob", mass=M, axes=axes)
    at = axes[arm[-1]] * (-A_ if arm[0] == "-" else A_)
    equations = ph.derive(ph.System(ph.Pivot(bob, at=at), ph.Gravity(G), name="bob"))
    start = {"a_1": 0.5, "a_1_dot": 0.2}
    numbers = {"M": 1, "a": 1, "g": 9.81}
    motion = closed_form(equations, numbers, start)
    assert motion.name == "pendulum"
    run = ph.simulate(equations, numbers, start, 5)
    np.testing.assert_allclose(motion.at(run.t)["a_1"], run["a_1"], rtol=0, atol=1e-12)
    lowest = motion.at(motion.figures["time_to_lowest"])
    speed2 = 0.04 + 2 * 9.81 * (1 + _height(arm, sign, 0.5))
    assert lowest["a_1_dot"] ** 2 == pytest.approx(speed2, rel=1e-12)


def _height(arm: str, sign: int, angle: float) -> float:
    """Of the bob over the pivot: it lies opposite to `at`."""
    direction = rotation("y", sign * angle)[2, "xyz".index(arm[-1])]
    return direction if arm[0] == "-" else -direction


def test_tilts_to_many_digits():
    chart = CHARTS["x-y-z"]
    start = {name: str(value) for name, value in started(chart).items()}
    doubles = closed_form(top(*chart), NUMBERS, started(chart)).at(0.7)
    for name, value in closed_form(top(*chart), NUMBERS, start, 30).at(0.7).items():
        assert float(value) == pytest.approx(float(doubles[name]), rel=1e-14, abs=1e-14)


def test_turns_that_cannot_be_counted_are_refused():
    chart = CHARTS["x-y-z"]
    motion = closed_form(top(*chart), NUMBERS, started(chart))
    with pytest.raises(NumericError, match="whose turns are counted over"):
        motion.at(1e7)


def test_a_lopsided_top_has_none():
    axes = frames("xyz", "+++")
    body = ph.Body("top", mass=M, inertia=(I_1, I_2, I_3), axes=axes)
    pivot = ph.Pivot(body, at=axes["z"] * -A_)
    with pytest.raises(NumericError, match="no closed form that is known"):
        closed_form(ph.derive(ph.System(body, pivot, ph.Gravity(G), name="top")), {}, {})
