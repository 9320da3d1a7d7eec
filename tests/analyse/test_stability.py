"""Stability against classical thresholds, and every threshold against the motion itself."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import brentq

import polhode as ph
from analyse.systems import equations, symbols
from polhode.algebra import Expr, cos, pi, sqrt
from polhode.analyse import Stability, SteadyMotion, Truth, stability, steady
from polhode.base import NumericError

NUMBERS = {
    "spinning-coin": {"m": 0.0075, "a": 0.012, "g": 9.81},
    "rolling-disk": {"m": 0.2, "a": 0.03, "g": 9.81},
}


def on_edge(name: str, vanishing: str) -> tuple[Stability, dict[str, Expr]]:
    derived = equations(name)
    s = symbols(derived)
    families = steady(derived, {s["theta"]: pi / 2})
    (family,) = (f for f in families if f.fixed.get(s[vanishing].symbol) == 0)
    return stability(family), s


EDGES = [
    ("rolling-disk", "phi_dot", "omega_3", lambda s: s["g"] / (3 * s["a"])),
    ("rolling-disk", "omega_3", "phi_dot", lambda s: 4 * s["g"] / (5 * s["a"])),
    ("spinning-coin", "phi_dot", "omega_3", lambda s: s["g"] / s["a"]),
    ("spinning-coin", "omega_3", "phi_dot", lambda s: 4 * s["g"] / s["a"]),
]


@pytest.mark.parametrize(("name", "vanishing", "speed", "square"), EDGES)
def test_threshold_on_edge(name, vanishing, speed, square):
    found, s = on_edge(name, vanishing)
    (condition,) = found.conditions
    assert condition.truth is Truth.OPEN
    at_threshold = condition.expression.subs({s[speed]: sqrt(square(s))})
    assert at_threshold == 0
    slope = condition.expression.diff(s[speed])
    assert ph.is_positive(slope.subs({s[speed]: s["g"]}))


@pytest.mark.parametrize(("name", "vanishing", "speed", "square"), EDGES)
@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_threshold_by_simulation(name, vanishing, speed, square, factor):
    """A tilt rate of 1e-6 leads nowhere 0.1 % above the threshold and away 0.1 % below it."""
    found, s = on_edge(name, vanishing)
    numbers = NUMBERS[name]
    threshold = float(np.sqrt(_number(square(s), numbers)))
    start = {"theta": np.pi / 2, "theta_dot": 1e-6, speed: factor * threshold}
    run = ph.simulate(equations(name), numbers, start, 12.0)
    departure = np.abs(run["theta"] - np.pi / 2).max()
    assert (departure < 1e-5) == (factor > 1)
    assert str(found).startswith("stable when")


@pytest.mark.parametrize(("name", "vanishing", "speed", "square"), EDGES)
def test_frequency_by_simulation(name, vanishing, speed, square):
    found, s = on_edge(name, vanishing)
    numbers = NUMBERS[name] | {speed: 2 * float(np.sqrt(_number(square(s), NUMBERS[name])))}
    (frequency,) = found.frequencies
    predicted = _number(frequency, numbers)
    start = {"theta": np.pi / 2, "theta_dot": 1e-5 * predicted, speed: numbers[speed]}
    period = 2 * np.pi / predicted
    run = ph.simulate(equations(name), NUMBERS[name], start, 1.1 * period)

    def tilt(t: float) -> float:
        return float(run.evaluate("theta", np.array([t]))[0]) - np.pi / 2

    measured = brentq(tilt, 0.9 * period, 1.1 * period, xtol=1e-14)
    assert measured == pytest.approx(period, rel=1e-7)


def _number(expression: Expr, numbers: dict[str, float]) -> float:
    used = sorted(expression.symbols(), key=lambda s: s.published)
    (value,) = ph.compile_program([expression], used).function()(
        *(numbers[s.published] for s in used)
    )
    return float(value)


def test_gyroscope_precesses_stably_wherever_it_precesses():
    derived = equations("gyroscope")
    (family,) = (f for f in steady(derived) if f.relations)
    assert stability(family).truth is Truth.ALWAYS


def test_upright_gyroscope_asks_for_another_chart():
    derived = equations("gyroscope")
    theta = symbols(derived)["theta"].symbol
    upright = next(f for f in steady(derived) if f.fixed.get(theta) == 0)
    with pytest.raises(ph.NumericError, match="not singular"):
        stability(upright)


def test_sleeping_top_in_another_chart():
    """Two tilts about horizontal axes describe an upright top; stable above 2√(M g a I)/I₁."""
    mass, a, first, second, g = ph.symbols("M a I_1 I_2 g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    axes = ph.Frame("lab").rotated(alpha, "x").rotated(beta, "y", labels="2 3 1")
    top = ph.Body("top", mass=mass, inertia=(second, second, first), axes=axes, spin_about="1")
    derived = ph.derive(ph.System(ph.Pivot(top, at=axes["1"] * -a), ph.Gravity(g)))
    upright = SteadyMotion(
        steady(derived, {alpha: 0, beta: 0, alpha.dt(): 0, beta.dt(): 0})[0].reduced,
        {s.symbol: Expr.of(0) for s in (alpha, beta, alpha.dt(), beta.dt())},
        (),
    )
    found = stability(upright)
    spin = ph.speed("omega_1")
    threshold = first**2 * spin**2 - 4 * mass * g * a * (second + mass * a**2)
    assert threshold in [c.expression for c in found.conditions]


@pytest.mark.parametrize("factor", [0.999, 1.001])
def test_sleeping_top_by_simulation(factor):
    """0.1 % below the threshold a nudge grows past its swing above it."""
    numbers = {"I_1": 6.25e-4, "I_2": 3.5e-4, "M": 0.5, "a": 0.06, "g": 9.81}
    about_pivot = numbers["I_2"] + numbers["M"] * numbers["a"] ** 2
    weight = numbers["M"] * numbers["g"] * numbers["a"]
    spin = factor * 2 * np.sqrt(weight * about_pivot) / numbers["I_1"]
    start = {"alpha_dot": 1e-6, "omega_1": spin}
    run = ph.simulate(equations("gyroscope/upright"), numbers, start, 15.0)
    departure = np.hypot(run["alpha"], run["beta"]).max()
    assert (departure < 1e-5) == (factor > 1)


def test_rolling_hoops_and_rims():
    """Upright above ω₃² = I₁ m g a/(I₃ (I₃ + m a²)): g/3a for a disk, g/4a for a hoop (Routh)."""
    mass, radius, g, across, along = ph.symbols("m a g I_1 I_3", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    wheel = ph.disk("wheel", mass=mass, radius=radius, inertia=(across, across, along), axes=axes)
    ground = ph.Rolling(wheel, on=ph.Plane(axes.root))
    derived = ph.derive(ph.System(ground, ph.Gravity(g)))
    s = symbols(derived)
    straight = next(
        f for f in steady(derived, {theta: pi / 2}) if f.fixed.get(s["phi_dot"].symbol) == 0
    )
    (condition,) = stability(straight).conditions
    inertia = along * (along + mass * radius**2)
    square = across * mass * g * radius / inertia
    assert condition.expression.subs({s["omega_3"]: sqrt(square)}) == 0
    assert square.subs({across: mass * radius**2 / 2, along: mass * radius**2}) == g / (4 * radius)


def test_a_conical_pendulum_is_stable_at_every_tilt():
    mass, length, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    bob = ph.point_mass("bob", mass=mass, axes=axes)
    derived = ph.derive(ph.System(ph.Pivot(bob, at=axes["3"] * length), ph.Gravity(g)))
    (family,) = (f for f in steady(derived) if f.relations)
    found = stability(family)
    assert found.truth is Truth.ALWAYS
    (frequency,) = found.frequencies
    turning = g / (length * cos(theta))
    small = frequency.subs({theta.symbol: pi / 3, phi.dt().symbol: sqrt(turning)})
    assert small.subs({theta.symbol: pi / 3}) ** 2 == Fraction(7, 2) * g / length


def test_middle_axis_is_unstable():
    derived = equations("tennis-racquet")
    s = symbols(derived)
    low, high = ph.symbols("d e", positive=True)
    ordered = {s["I_2"]: s["I_1"] + low, s["I_3"]: s["I_1"] + low + high}
    verdicts = {}
    for family in steady(derived):
        axis = next(u for u in ("omega_1", "omega_2", "omega_3") if s[u].symbol in family.free)
        verdicts[axis] = stability(family, ordered).truth
    assert verdicts == {
        "omega_1": Truth.ALWAYS,
        "omega_2": Truth.NEVER,
        "omega_3": Truth.ALWAYS,
    }


@pytest.mark.parametrize(("axis", "crossing"), [("omega_1", "omega_2"), ("omega_3", "omega_2")])
def test_frequency_of_a_wobbling_racquet_by_simulation(axis, crossing):
    derived = equations("tennis-racquet")
    s = symbols(derived)
    numbers = {"I_1": 1.2e-3, "I_2": 1.64e-2, "I_3": 1.76e-2}
    family = next(f for f in steady(derived) if s[axis].symbol in f.free)
    (frequency,) = stability(family).frequencies
    predicted = _number(frequency, numbers | {axis: 10.0})
    start = {"theta": 1.0, axis: 10.0, crossing: 1e-5}
    run = ph.simulate(derived, numbers, start, 6.0 / predicted)

    def wobble(t: float) -> float:
        return float(run.evaluate(crossing, np.array([t]))[0])

    quarter = brentq(wobble, 0.5 / predicted, 3.0 / predicted, xtol=1e-14)
    assert quarter == pytest.approx(np.pi / 2 / predicted, rel=1e-7)


def test_gyrocompass_settles_about_the_north_with_its_frequency():
    derived = equations("gyrocompass")
    s = symbols(derived)
    north = next(f for f in steady(derived) if f.fixed.get(s["theta"].symbol) == 0)
    (frequency,) = stability(north).frequencies
    rate = s["Omega"] * ph.sin(s["lambda_"])
    exact = (s["I_3"] * (s["omega"] + rate) - s["I_1"] * rate) * rate / s["I_1"]
    assert frequency**2 == exact


def test_marble_runs_in_circles_at_two_sevenths():
    derived = equations("marble-on-turntable")
    s = symbols(derived)
    (family,) = steady(derived)
    found = stability(family, {s["I"]: 2 * s["m"] * s["a"] ** 2 / 5})
    (frequency,) = found.frequencies
    assert frequency**2 == (2 * s["Omega"] / 7) ** 2
    assert found.neutral == found.directions == 1


def test_tall_cosine_of_a_damped_pendulum_needs_hurwitz():
    mass, a, g, c = ph.symbols("M a g c", positive=True)
    theta = ph.coordinate("theta")
    axes = ph.Frame("lab").rotated(theta, "x")
    bob = ph.Body("bob", mass=mass, axes=axes)
    end = bob.point(axes.zero)
    damper = ph.Damper(end, axes.root.zero + axes.root["y"] * a, damping=c)
    pivot = ph.Pivot(bob, at=axes["z"] * a)
    derived = ph.derive(ph.System(pivot, ph.Gravity(g), damper))
    families = steady(derived)
    truths = {str(f): stability(f).truth for f in families}
    assert truths["theta = 0"] is Truth.ALWAYS
    assert truths["theta = pi"] is Truth.NEVER
    assert not stability(families[0]).is_even
    assert cos(theta).dt() != 0


def test_the_threshold_itself_is_not_stable():
    """Two exponents meet at zero there, and a tilt grows in proportion to time."""
    straight, s = on_edge("rolling-disk", "phi_dot")
    assert "3*a*omega_3**2 - g > 0" in str(straight)
    threshold = sqrt(s["g"] / (3 * s["a"]))
    for share, verdict in ((Fraction(9, 10), "unstable"), (1, "unstable"), (2, "stable")):
        there = stability(straight.family, {s["omega_3"]: share * threshold})
        assert str(there) == verdict


def test_what_stops_turning_everywhere_is_no_threshold():
    """On a table at rest a marble keeps any velocity: nothing grows."""
    derived = equations("marble-on-turntable")
    (resting,) = steady(derived)
    assert str(stability(resting, {ph.symbol("Omega"): 0})) == "stable"


def test_a_coordinate_that_a_steady_motion_fixes_does_not_occur_in_its_exponents():
    """A bead on the axis of a tube that turns freely: m s̈ = m s θ̇², whatever the tube's inertia."""
    m, M, J = ph.symbols("m M J", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "z")
    tube = ph.Body("tube", mass=M, inertia=(J, J, J), axes=axes, tag="t")
    bead = ph.point_mass("bead", mass=m, axes=axes, tag="b")
    axle = (ph.Pivot(tube), ph.Hinge(tube, axis="z"))
    equations = ph.derive(ph.System(*axle, ph.Slider(bead, axis="x", to=tube.point())))
    found = {str(family): ph.stability(family) for family in ph.steady(equations)}
    assert [str(rate) for rate in found["s_b = 0"].growth] == ["abs(theta_dot)"]
    assert not found["s_b = 0"].frequencies


def test_linear_equations_where_a_length_vanishes_are_refused():
    """Friction has no direction where nothing slips, and a spring none where its ends meet."""
    m, r, g = ph.symbols("m r g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    sliding = ph.System(ph.Coulomb(ball, on=ph.Plane(lab), mu=0.3), ph.Gravity(g))
    (family,) = ph.steady(ph.derive(sliding))
    with pytest.raises(ph.NumericError, match="expected forces that are smooth there"):
        ph.stability(family)


def test_values_that_contradict_the_motion_are_refused() -> None:
    """At the top of a bowl u = π, and at u = 0 it would look as stable as the bottom."""
    m, a, R, g = ph.symbols("m a R g", positive=True)
    bowl = ph.Sphere(ph.Frame("lab"), radius=R, inside=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=bowl.axes)
    top = ph.steady(ph.derive(ph.System(ph.Rolling(ball, on=bowl), ph.Gravity(g))))[1]
    with pytest.raises(NumericError, match="u = 0 in the steady motion u = pi, v = 0"):
        ph.stability(top, at={"u": 0})
    assert ph.stability(top, at={"u": 3.141592653589793}).conditions == ph.stability(top).conditions
