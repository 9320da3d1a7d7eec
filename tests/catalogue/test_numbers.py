"""The numbers of a run: defaults, what replaces them, and what follows from what."""

import math

import pytest

import polhode as ph
from polhode.base import PURE, read_unit
from polhode.catalogue import CATALOGUE, numbers_of
from polhode.simulate import simulate


def numbers(name, settings=(), start=(), duration=""):
    entry = CATALOGUE[name]
    return numbers_of(entry, ph.derive(entry.build()), dict(settings), dict(start), duration)


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_defaults_are_a_run(name):
    entry = CATALOGUE[name]
    equations = ph.derive(entry.build())
    chosen = numbers_of(entry, equations)
    run = simulate(
        equations, chosen.parameters, chosen.start, chosen.duration / 50, forcing=chosen.forcing
    )
    assert run.drift.energy < 1e-12


@pytest.mark.parametrize("name", CATALOGUE)
def test_units_of_the_catalogue_are_those_that_follow_from_use(name):
    entry = CATALOGUE[name]
    inferred = ph.derive(entry.build()).dimensions
    declared = {p.name: read_unit(p.unit).dimension if p.unit else PURE for p in entry.parameters}
    used = {s.published: d for s, d in inferred.items() if s.published in declared}
    assert used
    assert used == {key: declared[key] for key in used}


def test_defaults_follow_what_they_are_made_of():
    heavier = numbers("gyrocompass", {"m": "2kg", "a": "20cm"}).parameters
    assert heavier["I_1"] == pytest.approx(2 * 0.2**2 / 2)
    assert heavier["I_3"] == pytest.approx(2 * 0.2**2)
    assert "a" not in heavier  # no equation holds it


def test_a_start_that_is_given_is_given_for_all_speeds():
    start = numbers("gyroscope", start={"omega_1": "3000rpm"}).start
    assert start == {"theta": math.radians(60), "omega_1": pytest.approx(100 * math.pi)}
    assert "omega_1" not in numbers("gyroscope", start={"theta": "pi/3"}).start


def test_a_start_may_be_an_expression_of_parameters():
    start = numbers("marble-on-turntable", start={"v_y": "-Omega*a"}).start
    assert start["v_y"] == pytest.approx(-33 * math.pi / 30 * 0.008)


def test_prescribed_functions_are_expressions_of_time():
    t = ph.time
    forcing = numbers("ball-on-paper", {"X": "r*sin(3*t)/2", "chi": "10deg"}).forcing
    assert forcing["X"] == ph.symbol("r", positive=True) * ph.sin(3 * t) / 2
    assert forcing["chi"].subs({ph.pi: 1}).rational is not None
    assert forcing["Y"] == ph.sin(t) ** 3 / 10


def test_the_duration_replaces_the_default():
    assert numbers("rolling-disk").duration == 10.0
    assert numbers("rolling-disk", duration="2 min").duration == 120.0


@pytest.mark.parametrize(
    ("settings", "start", "duration", "said"),
    [
        ({"m": "a/a*3m"}, {}, "", "m: at character 6"),
        ({"m": "3m"}, {}, "", "m = '3m' is a quantity in m"),
        ({"m": "a"}, {}, "", "m = a is in m; expected an expression in kg"),
        ({"m": "t"}, {}, "", "m = t varies in time"),
        ({"m": "m"}, {}, "", "m needs m"),
        ({"m": "g", "g": "m"}, {}, "", "depend on one another"),
        ({"M": "1"}, {}, "", "'M' is no parameter of rolling-disk"),
        ({"theta": "1"}, {}, "", "theta as a parameter; expected a start value"),
        ({}, {"m": "1"}, "", "m as a start value; expected a parameter"),
        ({}, {"thta": "1"}, "", "did you mean theta"),
        ({}, {"theta": "3kg"}, "", "theta = '3kg' is a quantity in kg"),
        ({}, {"phi_dot": "3m/s"}, "", "expected a quantity in 1/s"),
        ({}, {"v_x": "3rad"}, "", "expected a quantity in m/s"),
        ({}, {"theta": "t"}, "", "theta = t varies in time"),
        ({}, {}, "0", "a duration of 0 s"),
        ({}, {}, "-2*pi", "a duration of -6.28"),
        ({}, {}, "inf", "expected a finite number"),
        ({}, {}, "3kg", "expected a quantity in s"),
    ],
)
def test_invalid_values_are_refused_with_their_name(settings, start, duration, said):
    with pytest.raises(ph.PolhodeError) as refusal:
        numbers("rolling-disk", settings, start, duration)
    assert said in str(refusal.value)
