"""Motions beyond doubles: against closed forms, against a second integrator, and refused."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import polhode as ph
from polhode.algebra import fraction_of
from polhode.base import ConstraintError, DeclarationError, NumericError, StopRequested
from polhode.simulate import Trajectory
from polhode.simulate.integrate._number_types import DOUBLES, numbers_for
from simulate.examples import four_bar

TIMES = (0, 0.3, 1, 1.75, 2)
MANY = mpmath.MPContext()
MANY.dps = 120


def largest(first, second) -> float:
    """Difference of two arrays of numbers of any sort."""
    pairs = zip(np.ravel(first), np.ravel(second), strict=True)
    return float(max(abs(fraction_of(a) - fraction_of(b)) for a, b in pairs))


def racquet() -> ph.Equations:
    m, a, b, c = ph.symbols("m I_1 I_2 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    spin = ph.Components()
    body = ph.Body("racquet", mass=m, inertia=(a, b, c), axes=axes, spin=spin)
    return ph.derive(ph.System(ph.Pivot(body, name="centre")))


RACQUET = {"I_1": "0.0012", "I_2": "0.0164", "I_3": "0.0176"}


def top() -> ph.Equations:
    m, a, g, i_1, i_3 = ph.symbols("m a g I_1 I_3", positive=True)
    phi, theta = ph.coordinates("phi theta")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    body = ph.Body("top", mass=m, inertia=(i_1, i_1, i_3), axes=axes, spin_about="3")
    return ph.derive(ph.System(ph.Pivot(body, at=-a * axes["3"]), ph.Gravity(g)))


TOP = {"m": "0.5 kg", "a": "60 mm", "I_1": "4e-4", "I_3": "3.5e-4", "g": "9.81"}


# -- against closed forms --------------------------------------------------------------------------


@pytest.mark.parametrize("integrator", ["heyoka", "kernel"], indirect=True)
@pytest.mark.parametrize(
    ("precision", "error"), [("extended", 1e-14), ("quadruple", 1e-29), (50, 1e-45)]
)
def test_a_free_body_is_where_its_closed_form_is(integrator, precision, error):
    equations = racquet()
    start = {"omega_1": "0.01", "omega_2": "10", "omega_3": "0.01", "theta": "90 deg"}
    run = ph.simulate(equations, RACQUET, start, "2 s", precision=precision, samples=21)
    exact = ph.closed_form(equations, RACQUET, start, digits=60).at(TIMES)
    found = run.at(TIMES)
    for name in ("omega_1", "omega_2", "omega_3"):
        assert largest(found[name], exact[name]) < error  # near the separatrix all errors grow
    assert run.drift.energy < 2.0 ** (4 - numbers_for(precision).bits)
    assert run.integrator == ("heyoka" if integrator == "heyoka" else "flint")


def test_a_top_is_where_its_closed_form_is():
    equations = top()
    start = {"theta": "60 deg", "omega_3": "150 rad/s"}
    run = ph.simulate(equations, TOP, start, "2 s", precision="quadruple", samples=11)
    exact = ph.closed_form(equations, TOP, start, digits=40).at(TIMES)
    for name in ("theta", "phi"):
        assert largest(run.evaluate(name, TIMES), exact[name]) < 1e-29
    assert run.drift.energy < 1e-31


def test_after_a_period_the_top_is_back():
    equations = top()
    start = {"theta": "60 deg", "omega_3": "150 rad/s"}
    period = ph.closed_form(equations, TOP, start, digits=40).period
    run = ph.simulate(equations, TOP, start, period, precision="quadruple", samples=3)
    assert largest(run.final["theta"], MANY.pi / 3) < 1e-31
    assert run.duration != float(run.duration)


def test_a_nudge_of_1e_20_flips_the_racquet_when_the_closed_form_says():
    equations = racquet()
    start = {"omega_1": "1e-20", "omega_2": "10", "theta": "90 deg"}
    exact = ph.closed_form(equations, RACQUET, start, digits=40)
    run = ph.simulate(
        equations,
        RACQUET,
        start,
        "10 s",
        precision="quadruple",
        samples=11,
        events={"flip": ph.speed("omega_2")},
    )
    flips = [event.time for event in run.events if event.kind == "flip"]
    assert largest(flips[0], exact.period / 4) < 1e-12
    assert abs(float(exact.at(flips[0])["omega_2"])) < 1e-11
    assert abs(float(run.evaluate("omega_2", flips[0]))) < 1e-31


def test_the_error_of_a_double_is_seen(integrator):
    equations = top()
    start = {"theta": "60 deg", "omega_3": "150 rad/s"}
    double = ph.simulate(equations, TOP, start, "2 s", samples=5)
    better = ph.simulate(equations, TOP, start, "2 s", samples=5, precision="extended")
    assert 1e-17 < largest(double["theta"], better["theta"]) < 1e-9


# -- values are exact ------------------------------------------------------------------------------


def glider() -> ph.System:
    m, s, g = ph.symbols("m s g", positive=True)
    frame = ph.Frame("lab")
    body = ph.sphere("glider", mass=m, radius=s, inertia=m * s**2, axes=frame)
    return ph.System(ph.Smooth(body, on=ph.Plane(frame), name="ice"), ph.Gravity(g))


def glide(speed, duration, **more) -> Trajectory:
    values = {"m": 1, "s": "0.1 m", "g": 9.81}
    return ph.simulate(
        glider(), values, {"v_x": speed}, duration, precision="quadruple", samples=3, **more
    )


@pytest.mark.parametrize(
    ("speed", "duration", "place"),
    [
        ("0.1 m/s", "0.1 s", Fraction(1, 100)),
        (0.1, "0.1 s", Fraction(0.1) / 10),
        ((Fraction(1, 3), "mm/s"), 3, Fraction(1, 1000)),
        (ph.sqrt(2) ** 2 / 7, Fraction(7, 10), Fraction(1, 5)),
        (MANY.mpf(1) / 3, 0.5, Fraction(1, 6)),
        ("10 cm/s", "0.5 min", 3),
        (np.longdouble(1) / 4, np.float64(2), Fraction(1, 2)),
    ],
)
def test_values_enter_exactly(speed, duration, place):
    run = glide(speed, duration)
    assert largest(run.final["x"], MANY.mpf(1) * place.numerator / place.denominator) < 4e-33
    assert largest(run["x"][1], run.final["x"] / 2) < 4e-33


def test_a_forcing_is_exact_too():
    m, s, g = ph.symbols("m s g", positive=True)
    (push,) = ph.functions("P")
    frame = ph.Frame("lab")
    body = ph.sphere("ball", mass=m, radius=s, inertia=m * s**2, axes=frame)
    table = ph.Smooth(body, on=ph.Plane(frame), name="ice")
    force = ph.Force(body.point(frame.zero), frame["x"] * push)
    system = ph.System(table, force, ph.Gravity(g))
    values = {"m": 1, "s": 1, "g": 1}
    motion = {"P": ph.sin(ph.time / 10)}
    run = ph.simulate(system, values, {}, 1, precision=40, samples=3, forcing=motion)
    assert largest(run.final["v_x"], 10 - 10 * MANY.cos(MANY.mpf(1) / 10)) < 1e-39
    with pytest.raises(DeclarationError, match="P, known only in double precision"):
        ph.simulate(system, values, {}, 1, precision=40, forcing={"P": lambda t: t})


def test_a_closed_loop_closes_to_all_digits():
    values = {"p": "0.1 m", "q": "0.3 m", "r": "0.25 m", "d": "0.3 m", "I": "0.01"}
    start = {"alpha": "50 deg", "alpha_dot": "2 rad/s"}
    run = ph.simulate(four_bar(), values, start, "1 s", precision=40, samples=5)
    assert run.drift.constraint < 1e-38
    assert largest(run.final["alpha"], 2 + MANY.pi * 5 / 18) < 1e-38


# -- contacts --------------------------------------------------------------------------------------


def sliding(duration, **start) -> Trajectory:
    m, s, k, g, mu = ph.symbols("m r k g mu", positive=True)
    frame = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=s, inertia=k * m * s**2, axes=frame)
    system = ph.System(ph.Coulomb(ball, on=ph.Plane(frame), mu=mu, name="floor"), ph.Gravity(g))
    values = {"m": "50 g", "r": "20 mm", "k": "0.4", "g": "9.81", "mu": "0.3"}
    return ph.simulate(system, values, start, duration, precision="quadruple", samples=5)


def test_a_sliding_ball_slides_as_exactly():
    run = sliding("0.05 s", v_x="1 m/s", v_y="0.5 m/s", omega_y=0)
    slip = MANY.sqrt(MANY.mpf(5) / 4)
    slowing = MANY.mpf(2943) / 1000 / slip
    assert run.mode == "sliding"
    assert largest(run.final["v_x"], 1 - slowing / 20) < 1e-32
    assert largest(run.final["x"], MANY.mpf(1) / 20 - slowing / 800) < 1e-32
    assert largest(run.evaluate("slip_x_floor", 0), 1) == 0
    assert run.drift.energy < 1e-31


def test_a_thrown_ball_flies_as_exactly():
    run = sliding("0.3 s", z="0.02 m", v_z="2 m/s")
    height = Fraction(2, 100) + Fraction(6, 10) - Fraction(981, 200) * Fraction(9, 100)
    assert run.mode == "flight"
    assert largest(run.final["z"], MANY.mpf(height.numerator) / height.denominator) < 1e-32


# -- what people work with -------------------------------------------------------------------------


def test_in_doubles_it_is_a_motion_like_any_other(tmp_path):
    run = glide("0.1 m/s", "0.1 s", events={"halfway": ph.coordinate("x") - Fraction(1, 200)})
    assert (run.precision, run["x"].dtype) == ("quadruple", np.dtype(object))
    (event,) = (e for e in run.events if e.kind == "halfway")
    assert largest(event.time, MANY.mpf(1) / 20) < 1e-33
    assert largest(event.state_after["x"], MANY.mpf(1) / 200) < 1e-34
    rounded = run.rounded()
    assert (rounded.precision, rounded["x"].dtype) == ("double", np.dtype(float))
    assert rounded.final["x"] == 0.01
    assert [e.time for e in rounded.events] == [0.0, 0.05, 0.1]
    run.to_csv(tmp_path / "x.csv", ["x"])
    assert "0.01" in (tmp_path / "x.csv").read_text()


def test_times_beyond_the_motion_are_refused():
    with pytest.raises(NumericError, match=r"times within the motion, from 0 to 0\.1 s"):
        glide("0.1 m/s", "0.1 s").at(0.2)


@pytest.mark.parametrize(
    "precision", ["triple", "", 0, 15, -40, 301, 10**6, 2.5, True, "1e3", "9" * 5000, object()]
)
def test_unknown_precisions_are_refused(precision):
    with pytest.raises(NumericError, match="expected double, extended, quadruple, or a number of"):
        numbers_for(precision)


def test_the_known_precisions():
    assert numbers_for(None) is numbers_for("double") is DOUBLES
    assert numbers_for("quadruple").bits == 113
    assert numbers_for("40").bits == numbers_for(40).bits > 132


def test_an_impossible_start_is_refused_as_in_doubles():
    with pytest.raises(ConstraintError, match=r"starts 0\.01 m below"):
        sliding(1, z="0.01 m")


# -- interrupted -----------------------------------------------------------------------------------


class Impatient:
    """Has enough after a number of steps."""

    def __init__(self, steps: int) -> None:
        self._left = steps

    def begin(self, task: str, total: int | None = None) -> None:
        pass

    def advance(self, steps: int = 1) -> None:
        self._left -= steps
        if self._left <= 0:
            raise StopRequested

    def finish(self) -> None:
        pass


@pytest.mark.parametrize("precision", ["double", "quadruple"])
def test_what_is_done_is_kept(integrator, precision):
    equations = top()
    start = {"theta": "60 deg", "omega_3": "150 rad/s"}
    given = {"precision": precision, "progress": Impatient(8), "samples": 1001}
    run = ph.simulate(equations, TOP, start, "1000 s", **given)
    assert run.events[-1].kind == "interrupted"
    assert 0 < run.duration < 10
    assert run.t[-1] <= run.duration
    assert run.drift.energy < 1e-11
    assert np.isfinite(float(run.final["theta"]))
