"""A value means the same wherever values are given: to a closed form, a steady motion, a run."""

import json
from math import radians

import pytest

import polhode as ph
from analyse.systems import equations
from polhode.base import DeclarationError, UnitError
from polhode.cli import main

COIN = {"m": "7.5 g", "a": "12 mm", "g": 9.81}
TOP = {"M": 0.5, "a": "60 mm", "g": 9.81, "I_1": 6.25e-4, "I_2": "3.5e-4 kg m^2"}
SEVENTY = {"text": "70 deg", "pair": (70, "deg"), "exact": ph.pi * 7 / 18, "number": radians(70)}


@pytest.mark.parametrize("angle", SEVENTY.values(), ids=SEVENTY)
def test_an_angle_whose_sine_is_no_square_root_starts_a_closed_form(angle):
    start = {"theta": angle, "phi_dot": "400 rpm", "omega_3": 3}
    exact = ph.closed_form(equations("spinning-coin"), COIN, start)
    run = ph.simulate(equations("spinning-coin"), COIN, start, "0.2 s")
    for name, values in exact.at(run.t).items():
        assert values == pytest.approx(run[name], abs=1e-10)


def test_more_digits_take_the_angle_exactly():
    top, start = equations("gyroscope"), {"theta": "70 deg", "omega_1": 150}
    found = ph.closed_form(top, TOP, start, digits=40).figures["theta_1"]
    assert abs(found - found.context.pi * 7 / 18) < 1e-38


def test_the_shell_and_python_agree(capsys):
    """`polhode exact` on the same start."""
    asked = ["exact", "spinning-coin", "--start", "theta=70deg", "--start", "phi_dot=400rpm"]
    assert main([*asked, "--start", "omega_3=3", "--duration", "0.2s", "--json"]) == 0
    shell = json.loads(capsys.readouterr().out)
    start = {"theta": "70 deg", "phi_dot": "400 rpm", "omega_3": 3}
    python = ph.closed_form(equations("spinning-coin"), shell["parameters"], start)
    assert python.period == pytest.approx(shell["period"], rel=1e-14)


@pytest.mark.parametrize("key", ["theta", ph.coordinate("theta")], ids=["name", "symbol"])
@pytest.mark.parametrize("angle", ["90 deg", (90, "deg"), "pi/2", ph.pi / 2])
def test_steady_motions_take_what_a_run_takes(key, angle):
    top = equations("gyroscope")
    (level,) = ph.steady(top, {key: angle})
    assert str(level) == "theta = pi/2, I_1*omega_1*phi_dot - M*g*a = 0"
    precession = next(f for f in ph.steady(top) if f.relations)
    assert str(ph.stability(precession, {key: angle})) == "stable"
    found = ph.steady_values(precession, {key: angle, "omega_1": "150 rad/s", **TOP})
    assert found.values == pytest.approx([0.5 * 9.81 * 0.06 / (6.25e-4 * 150)])
    row = equations("rolling-disk").motion[0]
    assert ph.expand(row, ph.symbol("e"), about={key: angle}).polynomial == ph.coordinate(
        "phi"
    ).dt().dt() * row.diff(ph.coordinate("phi").dt().dt()).subs({ph.coordinate("theta"): ph.pi / 2})


def test_other_angles_are_decimals_in_steady_motions():
    (family,) = ph.steady(equations("gyroscope"), {"theta": "70 deg"})
    assert float(family.fixed[ph.coordinate("theta").symbol].rational) == radians(70)


def test_names_and_units_are_checked():
    top = equations("gyroscope")
    precession = next(f for f in ph.steady(top) if f.relations)
    for ask in (
        lambda given: ph.steady(top, given),
        lambda given: ph.stability(precession, given),
        lambda given: ph.steady_values(precession, given),
        lambda given: ph.closed_form(top, TOP, given),
        lambda given: ph.simulate(top, TOP, given, 1),
    ):
        with pytest.raises(UnitError, match="theta = "):
            ask({"theta": "70 kg"})
        with pytest.raises(DeclarationError, match="'thta' is no"):
            ask({"thta": 1})


def test_what_was_declared_may_be_given_although_it_has_dropped_out():
    """A compound pendulum turns about one axis: of its moments of inertia two do not matter."""
    m, l, g, *moments = ph.symbols("m l g A B C", positive=True)
    theta = ph.coordinate("theta")
    axes = ph.Frame("lab").rotated(theta, "y")
    body = ph.Body("body", mass=m, inertia=moments, axes=axes)
    pin = ph.Pivot(body, at=axes["z"] * l), ph.Hinge(body, axis="y")
    equations = ph.derive(ph.System(*pin, ph.Gravity(g)))
    hanging, upright = ph.steady(equations, {"A": 2, moments[2]: "3 kg m^2"})
    assert str(ph.stability(hanging, {"C": 1})) == "stable"
    assert str(ph.stability(upright, {"C": 1})) == "unstable"
    # a symbol counts by its name, and one that the system does not have is refused
    (frequency,) = ph.stability(hanging, {ph.symbol(n): 1 for n in "Bmlg"}).frequencies
    assert frequency == ph.sqrt(ph.Expr.of(1) / 2)
    for unknown in (ph.steady, lambda e, at: ph.stability(hanging, at)):
        with pytest.raises(ph.DeclarationError, match="'Q' is no quantity"):
            unknown(equations, {ph.symbol("Q"): 1})
