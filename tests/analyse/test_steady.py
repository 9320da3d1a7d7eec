"""Steady motions against the closed forms of the literature, and against the dynamics."""

import math

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations, symbols
from derive.linkages import four_bar
from derive.trailers import by_hand, train
from polhode.algebra import Expr, cos, pi, sin, sqrt
from polhode.analyse import SteadyMotion, steady
from polhode.base import NumericError
from polhode.catalogue import CATALOGUE
from polhode.model import with_friction, with_independent


def relation_of(name: str) -> tuple[SteadyMotion, dict[str, Expr]]:
    derived = equations(name)
    (family,) = (f for f in steady(derived) if f.relations)
    return family, symbols(derived)


def test_rolling_disk_steady_motion_is_the_classical_quadratic():
    family, s = relation_of("rolling-disk")
    (found,) = family.relations
    theta, spin, rate = s["theta"], s["omega_3"], s["phi_dot"]
    classical = rate**2 * sin(theta) * cos(theta) - 6 * spin * rate * sin(theta)
    classical = classical - 4 * s["g"] * cos(theta) / s["a"]
    quotient = found / classical
    assert not quotient.symbols() & {theta.symbol, spin.symbol, rate.symbol}


def test_coin_precession_has_both_roots():
    family, s = relation_of("spinning-coin")
    theta, spin = s["theta"], s["omega_3"]
    root = sqrt(spin**2 + 4 * s["g"] * cos(theta) ** 2 / (s["a"] * sin(theta)))
    values = [b.value for b in family.branches]
    for sign in (1, -1):
        expected = (spin + sign * root) / cos(theta)
        assert sum(_agree(value, expected) for value in values) == 1
    # sin θ, which both sides of the solved quadratic share, is cancelled under the root
    assert str(values[0]) == (
        "(omega_3 + sqrt(omega_3**2 + 4*g*cos(theta)**2/(a*sin(theta))))/cos(theta)"
    )


def _agree(first: Expr, second: Expr) -> bool:
    numbers = {"a": 0.012, "g": 9.81, "theta": 1.1, "omega_3": 7.0}
    return math.isclose(_number(first, numbers), _number(second, numbers), rel_tol=1e-12)


def _number(expression: Expr, numbers: dict[str, float]) -> float:
    symbols = sorted(expression.symbols(), key=lambda s: s.published)
    function = ph.compile_program([expression], symbols).function()
    (value,) = function(*(numbers[s.published] for s in symbols))
    return float(value)


def test_coin_on_edge_has_two_classes():
    derived = equations("spinning-coin")
    s = symbols(derived)
    families = steady(derived, {s["theta"]: pi / 2})
    vanishing = [
        {symbol.published for symbol, v in f.fixed.items() if v == 0} - {"theta_dot"}
        for f in families
    ]
    assert sorted(vanishing, key=sorted) == [{"omega_3"}, {"phi_dot"}]


def test_gyroscope_precession_exists_where_its_discriminant_is_positive():
    family, s = relation_of("gyroscope")
    first, second = family.branches
    (condition,) = first.exists
    about_pivot = s["I_2"] + s["M"] * s["a"] ** 2
    wanted = s["I_1"] ** 2 * s["omega_1"] ** 2
    wanted = wanted - 4 * s["M"] * s["g"] * s["a"] * about_pivot * cos(s["theta"])
    assert condition.expression == wanted
    product = first.value * second.value
    assert product == s["M"] * s["g"] * s["a"] / (about_pivot * cos(s["theta"]))


def test_gyroscope_at_right_angles_has_one_precession():
    derived = equations("gyroscope")
    s = symbols(derived)
    (family,) = steady(derived, {s["theta"]: pi / 2})
    (branch,) = family.branches
    assert branch.value == s["M"] * s["g"] * s["a"] / (s["I_1"] * s["omega_1"])
    assert branch.exists == ()


def test_tilted_marble_drifts_at_the_one_velocity_without_acceleration():
    derived = equations("marble-on-turntable/tilted")
    s = symbols(derived)
    (family,) = steady(derived)
    assert family.fixed[s["v_2"].symbol] == 0
    drift = -s["m"] * s["a"] ** 2 * s["g"] * sin(s["alpha"]) / (s["I"] * s["Omega"])
    assert family.fixed[s["v_3"].symbol] == drift


def test_free_body_turns_steadily_about_three_axes():
    families = steady(equations("tennis-racquet"))
    assert len(families) == 3
    assert all(sum(v == 0 for v in f.fixed.values()) == 2 for f in families)


@pytest.mark.parametrize("name", ["spinning-coin", "rolling-disk", "gyroscope", "gyrocompass"])
def test_nothing_accelerates_on_any_family(name):
    derived = equations(name)
    for family in steady(derived):
        fixed = dict(family.fixed)
        for row in derived.forcing:
            left = row.subs(fixed)
            for relation in family.relations:
                left = left.subs(_eliminate(relation))
            assert left == 0


def _eliminate(relation: Expr) -> dict[Expr, Expr]:
    g = next(Expr.generator(s) for s in relation.symbols() if s.published in ("g", "omega_0"))
    slope = relation.diff(g)
    return {g: -(relation - slope * g) / slope}


def test_no_steady_motion_is_an_error():
    derived = equations("gyroscope/vertical-plane")
    theta = symbols(derived)["theta"]
    with pytest.raises(ph.NumericError, match="steady motions of gyroscope/vertical-plane"):
        steady(derived, {theta: pi / 2})


def test_driven_systems_are_refused():
    with pytest.raises(ph.NumericError, match=r"depend on time through .*X"):
        steady(equations("ball-on-paper"))


def test_where_angles_are_singular_gravity_still_pulls():
    """At cos β = 0 an equation of the upright gyroscope is empty; that is no steady motion."""
    derived = equations("gyroscope/upright")
    beta = symbols(derived)["beta"].symbol
    assert {str(family.fixed[beta]) for family in steady(derived)} == {"0", "pi"}


def test_a_four_bar_linkage_balances_where_the_power_of_the_weights_vanishes():
    """Of every crank angle: no factor of the common denominator is taken for a steady motion."""
    (family,) = steady(four_bar())
    m_1, m_2, m_3 = ph.symbols("m_1 m_2 m_3")
    one, two, three = ph.coordinates("theta_1 theta_2 theta_3")
    # The loop's velocities, resolved across coupler and rocker, give their rates over that of the
    # crank as l₁ sin(θ₁ - θ₃)/(l₂ sin(θ₃ - θ₂)) and l₁ sin(θ₁ - θ₂)/(l₃ sin(θ₃ - θ₂)).
    power = (
        (m_1 + 2 * m_2) * cos(one) * sin(three - two)
        + m_2 * cos(two) * sin(one - three)
        + m_3 * cos(three) * sin(one - two)
    )
    (relation,) = family.relations
    assert abs((relation / power).rational) == 1


def test_trailers_run_steadily_in_line_and_stably_where_they_are_drawn():
    """Against the eigenvalues of Newton's and Euler's equations by hand, by differences."""
    independent = (ph.coordinate("phi_0").dt(), ph.speed("v_x_0"))
    families = steady(ph.derive(with_independent(train(2), independent)))
    stable = {str(family): str(ph.stability(family)) for family in families}
    assert stable["phi_1 = phi_0"] == "stable when (b - c)*v_x_0*cos(phi_0) > 0"
    assert stable["phi_1 = pi + phi_0"] == "stable when -v_x_0*cos(phi_0) > 0"
    for b, c, u in ((1.0, 0.3, 1.0), (1.0, 0.3, -1.0), (0.3, 1.0, 1.0), (0.3, 1.0, -1.0)):
        neutral, other = sorted(exponents_by_hand(b, c, u), key=abs)
        assert neutral == pytest.approx(0, abs=1e-6)
        assert other == pytest.approx(-(b - c) * u / (b**2 + c**2))


def test_three_trailers_in_line_are_stable_like_two():
    """Their equations are kept in parts; `linearise` finds eigenvalues at numbers another way."""
    phi, forward = [ph.coordinate(f"phi_{i}") for i in range(3)], ph.speed("v_x_0")
    derived = ph.derive(with_independent(train(3), (phi[0].dt(), forward)))
    assert derived.motion_in_parts
    (family,) = steady(derived, {"phi_1": phi[0], "phi_2": phi[0]})
    assert str(ph.stability(family)) == "stable when (b - c)*v_x_0*cos(phi_0) > 0"
    for b, c in ((1.0, 0.3), (0.3, 1.0)):
        numbers = {"m": 1.0, "J": 0.1, "b": b, "c": c, "g": 9.81}
        at_rest = dict.fromkeys(("phi_0", "phi_1", "phi_2"), 0.0)
        found = ph.linearise(derived, numbers, {**at_rest, "v_x_0": 1.0}).exponents
        assert (max(found.real) < 1e-9) == (b > c)


def test_values_at_which_equations_are_infinite_are_refused():
    with pytest.raises(ph.NumericError, match="coefficients of its equations are infinite"):
        steady(ph.derive(train(3)), {"phi_0": 0, "phi_1": 0, "phi_2": 0})


def exponents_by_hand(b: float, c: float, u: float) -> np.ndarray:
    """Of small departures of two trailers that run in line at the forward speed u, 1/s."""

    def rates(angle: float, turning: float) -> np.ndarray:
        """Of the angle from the first to the second, and of the turning of the first."""
        rest = dict.fromkeys(("x_0_dot", "y_0_dot", "phi_0"), 0.0) | {"x_0_dot": u}
        turn = -(u * np.sin(angle) + c * turning * np.cos(angle)) / b
        # along the second trailer: the velocity of the hitch along it
        along = u * np.cos(angle) - c * turning * np.sin(angle)
        second = {"x_1_dot": along * np.cos(angle), "y_1_dot": along * np.sin(angle)}
        state = rest | second | {"phi_0_dot": turning, "phi_1": angle, "phi_1_dot": turn}
        hand = by_hand(2, {"m": 1.0, "J": 0.2, "b": b, "c": c} | state)
        return np.array([turn - turning, hand["phi_0_ddot"]])

    step = 1e-5
    slopes = [(rates(*(step * unit)) - rates(*(-step * unit))) / (2 * step) for unit in np.eye(2)]
    return np.linalg.eigvals(np.array(slopes).T)


def test_a_sliding_top_is_refused_in_words() -> None:
    """Its accelerations have 1/|slip|, which has no value where it rolls upright."""
    top = with_friction(CATALOGUE["tippe-top"].build(), 0.3)
    with pytest.raises(NumericError, match="whether tippe-top can move steadily"):
        steady(ph.derive(top))
