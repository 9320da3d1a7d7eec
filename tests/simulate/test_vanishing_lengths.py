"""Ropes whose ends meet the points that they run over: the motion is refused from then on."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

M, MASS, G, D = ph.symbols("M m g d", positive=True)
LAB = ph.Frame("lab")
X, Z = LAB["x"], LAB["z"]
WEIGHT = ph.point_mass("weight", mass=M, axes=LAB, tag="w")
BOB = ph.point_mass("bob", mass=MASS, axes=LAB, tag="b")
NUMBERS = {M: 0.5, MASS: 1.0, G: 9.81, D: 0.2}


def over_two_eyes(*directions: ph.Vector) -> ph.System:
    return ph.System(
        ph.Rope([WEIGHT.point(), X * -D, X * D, BOB.point()], name="rope", directions=directions),
        ph.Pivot(WEIGHT, to=X * -D, only="x y", name="guide", force="N"),
        ph.Pivot(BOB, to=X * D, only="x y", name="guide2", force="P"),
        ph.Gravity(G),
    )


@pytest.mark.parametrize("directions", [(), (Z, X, -Z)])
@pytest.mark.parametrize("hanging", [0.1, 0.4])
def test_the_lighter_weight_reaches_its_eye(
    directions: tuple[ph.Vector, ...], hanging: float
) -> None:
    """It rises with g/3."""
    system, start = over_two_eyes(*directions), {"z_w": -hanging, "z_b": -0.5}
    time = np.sqrt(2 * hanging / (9.81 / 3))
    before = ph.simulate(system, NUMBERS, start, 0.99 * time)
    assert float(before.final["z_w"]) == pytest.approx(-hanging * (1 - 0.99**2), rel=1e-9)
    with pytest.raises(ph.NumericError, match=f"stretch 1 of 'rope' .* t = {time:.9g} s"):
        ph.simulate(system, NUMBERS, start, 2.0)


@pytest.mark.parametrize("wrong", [(Z, X, Z), (-Z, X, -Z), (Z, -X, -Z)])
def test_a_direction_against_its_stretch_is_refused(wrong: tuple[ph.Vector, ...]) -> None:
    with pytest.raises(ph.ConstraintError, match="points against its direction"):
        ph.simulate(over_two_eyes(*wrong), NUMBERS, {"z_w": -0.4, "z_b": -0.5}, 0.1)


def test_lengths_that_are_not_given_may_be_zero() -> None:
    """Accelerations do not depend on them."""
    run = ph.simulate(over_two_eyes(Z, X, -Z), NUMBERS, {}, 0.3)
    assert float(run.final["v_z_b"]) == pytest.approx(-9.81 / 3 * 0.3, rel=1e-12)


def test_a_string_pulled_through_a_hole() -> None:
    """A disk on a table, tied through a hole to a falling weight, slides straight into the hole.

    With a swing about the hole it never gets there (angular momentum), and nothing is refused.
    """
    puck = ph.point_mass("puck", mass=MASS, axes=LAB, tag="b")
    system = ph.System(
        ph.Rope([puck.point(), X * 0, WEIGHT.point()], name="string"),
        ph.Pivot(puck, only="z", name="table"),
        ph.Pivot(WEIGHT, only="x y", name="shaft", force="N"),
        ph.Gravity(G),
    )
    numbers = {M: 0.5, MASS: 1.0, G: 9.81}
    start = {"x_b": 0.3, "y_b": 0.4, "z_w": -0.2}
    time = np.sqrt(2 * 0.5 / (9.81 / 3))  # M g/(M + m)
    with pytest.raises(ph.NumericError, match=r"no length left|vanishes") as caught:
        ph.simulate(system, numbers, start, 2.0)
    assert f"{time:.6g}" in str(caught.value)
    run = ph.simulate(system, numbers, {**start, "v_x_b": -0.8, "v_y_b": 0.6}, 2.0)

    def rates(_: float, y: np.ndarray) -> list[float]:
        r, speed = y
        return [speed, (0.5**2 / r**3 - 0.5 * 9.81) / 1.5]

    own = solve_ivp(rates, [0, 2.0], [0.5, 0.0], rtol=1e-12, atol=1e-13).y[0, -1]
    assert np.hypot(run.final["x_b"], run.final["y_b"]) == pytest.approx(own, rel=1e-8)


def test_a_yo_yo_climbs_back_to_the_ceiling() -> None:
    """Thrown upwards with its rope wound up, an axle meets the ceiling: x = u t − a t²/2."""
    turn, radius, inertia = ph.coordinate("theta"), ph.symbol("a", positive=True), ph.symbol("I")
    axes = LAB.rotated(turn, "y")
    yoyo = ph.Body("yoyo", mass=MASS, inertia=(inertia,) * 3, axes=axes)
    rope = ph.Rope([X * radius, yoyo.point(X * radius)], directions=[-Z], name="rope")
    system = ph.System(
        rope,
        ph.Pivot(yoyo, only="x y", name="guide"),
        ph.Hinge(yoyo, axis="y"),
        ph.Gravity(G),
    )
    numbers = {MASS: 1.0, radius: 0.01, inertia: 1e-4, G: 9.81}
    falls = 9.81 / 2  # g/(1 + I/(m a²))
    time = (2.0 - np.sqrt(4.0 - 2 * falls * 0.3)) / falls
    with pytest.raises(ph.NumericError, match=f"'rope' has no length .* t = {time:.9g} s"):
        ph.simulate(system, numbers, {"z": -0.3, "v_z": 2.0}, 2.0)
