"""Figures of derived mechanics: that what is drawn is what the equations say."""

import numpy as np
import pytest

import polhode as ph
from polhode.base import DeclarationError, UnitError
from polhode.catalogue import CATALOGUE
from polhode.derive import is_angle
from polhode.study._maps import Found, measured, thresholds
from polhode.view import figures
from polhode.view._quantities import instants
from polhode.view.figures._potential import potential
from polhode.view.figures._rotation import invariable_path


@pytest.fixture(scope="module")
def sliding():
    """A ball set down in flight, which lands, slides and rolls."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    floor = ph.Coulomb(ball, on=ph.Plane(lab), mu=0.2, mu_static=0.3, name="floor")
    system = ph.System(floor, ph.Gravity(g), name="bowling")
    return ph.simulate(system, {m: 0.1, a: 0.02, g: 9.81}, {"z": 0.03, "v_x": 1.0}, 0.5)


def test_functions_take_axes_and_return_what_they_drew(run_of, sliding):
    axes = figures.new_figure(6.0).subplots(2, 3).ravel()
    top, racquet = run_of("gyroscope"), run_of("tennis-racquet")
    drawn = [
        figures.power_balance(top, ax=axes[0]),
        figures.herpolhode(racquet, ax=axes[1]),
        figures.effective_potential(top, ax=axes[2]),
        figures.friction_needed(sliding, ax=axes[3]),
        figures.reactions(top, "pivot", top.system.bodies[0].axes, ax=axes[4]),
        figures.modes(sliding, ax=axes[5]),
    ]
    assert [artist.axes for artist in drawn] == list(axes)


def test_labels_carry_units(run_of, sliding):
    top = run_of("gyroscope")
    assert figures.power_balance(top)[0].axes.get_ylabel() == "power (W)"
    assert figures.effective_potential(top).axes.get_ylabel() == "energy (J)"
    assert figures.effective_potential(top).axes.get_xlabel() == r"$\theta$ (deg)"
    assert figures.herpolhode(run_of("tennis-racquet")).axes.get_xlabel() == (
        r"$\omega_\xi$ (rad/s)"
    )
    assert figures.reactions(top, "pivot", top.system.root)[0].axes.get_ylabel() == (
        "force at pivot (N)"
    )


def test_one_plot_has_a_panel_for_every_name(run_of):
    figure = ph.plot(run_of("rolling-disk"), "theta", ("F_x", "F_z"), "energy")
    assert [axes.get_ylabel() for axes in figure.axes] == [
        r"$\theta$ (deg)",
        "force (N)",
        "$E$ (J)",
    ]


def test_the_bold_polhode_lies_on_both_quadrics(run_of):
    """Drawn on the ellipsoid of energy, it keeps the angular momentum too."""
    from polhode.view.figures._rotation import free_body, moments_of, rates_of

    run = run_of("tennis-racquet")
    body = free_body(run)
    moments = moments_of(run, body)
    rates = rates_of(run, body, np.linspace(0, run.duration, 500))
    energy, momentum = moments @ rates**2, moments**2 @ rates**2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-11)
    np.testing.assert_allclose(momentum, momentum[0], rtol=1e-11)


def test_the_herpolhode_is_that_of_the_closed_form(run_of):
    run = run_of("tennis-racquet")
    path = invariable_path(run)
    t = instants(run)
    start = {s.published: float(run[s.published][0]) for s in run.equations.speeds}
    exact = ph.closed_form(run.equations, dict(run.parameters), start).besides(t)
    distance = np.hypot(exact["herpolhode_1"], exact["herpolhode_2"])
    np.testing.assert_allclose(np.hypot(*path), distance, atol=1e-9 * distance.max())
    turned = np.unwrap(np.arctan2(path[1], path[0]))
    exactly = np.unwrap(np.arctan2(exact["herpolhode_2"], exact["herpolhode_1"]))
    np.testing.assert_allclose(turned, exactly - exactly[0], atol=1e-5)


def test_the_power_of_all_that_acts_is_the_rate_of_the_kinetic_energy(run_of, sliding):
    for run in (run_of("marble-on-turntable/tilted"), sliding):
        total, rate, *_ = figures.power_balance(run)
        size = np.max(np.abs(rate.get_ydata()))
        np.testing.assert_allclose(total.get_ydata(), rate.get_ydata(), atol=1e-9 * size)


@pytest.mark.parametrize("name", ["gyroscope", "rolling-disk", "spinning-coin"])
def test_kinetic_energy_of_the_tilt_is_what_lies_above_the_effective_potential(run_of, name):
    run = run_of(name)
    angles = np.sort(run.evaluate("theta", np.linspace(0, run.duration, 7)))
    heights = potential(run, angles)
    (tilting,) = (s for s in run.equations.kinematics if s.published == "theta_dot")
    inertia = run.equations.kinetic_energy.diff(tilting).diff(tilting)
    for angle, height in zip(angles, heights, strict=True):
        t = _when(run, angle)
        rate = run.evaluate("theta_dot", t)
        kinetic = run.evaluate(inertia, t) * rate**2 / 2
        assert height + kinetic == pytest.approx(run["energy"][0], rel=1e-9)


def _when(run, angle):
    t = np.linspace(0, run.duration, 7)
    return t[np.argmin(np.abs(run.evaluate("theta", t) - angle))]


def test_turning_points_are_the_limits_of_the_swing(run_of):
    run = run_of("gyroscope")
    (line,) = figures.effective_potential(run)
    dots = [a.get_xdata()[0] for a in line.axes.lines if a.get_marker() == "o"]
    theta = np.degrees(run.evaluate("theta", np.linspace(0, run.duration, 20001)))
    assert dots == pytest.approx([theta.min(), theta.max()], abs=0.02)


def test_an_effective_potential_needs_one_tilt(run_of):
    with pytest.raises(DeclarationError, match="reduces to one tilt"):
        figures.effective_potential(run_of("tennis-racquet"))
    with pytest.raises(DeclarationError, match="energy is conserved"):
        figures.effective_potential(run_of("marble-on-turntable"))


def test_friction_needed_is_what_the_contact_gives(sliding):
    needed, available = figures.friction_needed(sliding)
    t, ratio = needed.get_data()
    slips = next(e.time for e in sliding.events if e.after == "sliding")
    sticks = next(e.time for e in sliding.events if e.after == "rolling")
    assert np.all(np.isnan(ratio[t < slips]))
    np.testing.assert_allclose(ratio[(t > slips) & (t < sticks)], 0.2)
    np.testing.assert_allclose(ratio[t > sticks], 0, atol=1e-9)
    assert available.get_ydata() == [0.3, 0.3]


def test_modes_are_shaded_while_they_last(sliding):
    axes = figures.new_figure(2.0).subplots()
    shades = figures.modes(sliding, ax=axes)
    labels = {s.get_label(): s.get_bbox().intervalx for s in shades if s.get_label() != "_"}
    assert list(labels) == ["flight", "sliding", "rolling"]
    ends = sorted(x for shade in labels.values() for x in shade)
    assert ends[0] == 0
    assert ends[-1] == sliding.duration
    assert figures.modes(sliding, ax=axes)[0].get_hatch() != shades[1].get_hatch()


def test_forces_along_any_triad_have_the_same_size(run_of):
    run = run_of("gyroscope")
    named = figures.reactions(run, "pivot")
    turned = figures.reactions(run, "pivot", run.system.bodies[0].axes)
    sizes = [
        np.linalg.norm([line.get_ydata() for line in lines], axis=0) for lines in (named, turned)
    ]
    np.testing.assert_allclose(*sizes, rtol=1e-12)


# --- maps of stability ---


@pytest.fixture(scope="module")
def rolling():
    theta = ph.coordinate("theta")
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    return next(f for f in ph.steady(disk, {theta: ph.pi / 2}) if "phi_dot = 0" in str(f))


def test_the_exact_threshold_divides_growth_from_none(rolling):
    """A disk rolls upright where ω₃² > g/(3a)."""
    drawn = figures.stability_map(
        rolling, ("omega_3", 0, "10 rad/s"), ("a", "2 cm", "20 cm"), {"g": 9.81, "m": 1}
    )
    growth = np.asarray(drawn.growth.get_array()).reshape(161, 161)
    omega, radius = np.meshgrid(np.linspace(0, 10, 161), np.linspace(0.02, 0.2, 161))
    stable = omega**2 > 9.81 / (3 * radius)
    assert np.array_equal(growth == 0, stable)
    (threshold,) = drawn.thresholds
    points = np.concatenate(threshold.allsegs[0])
    np.testing.assert_allclose(points[:, 0] ** 2, 9.81 / (3 * points[:, 1]), rtol=2e-3)
    axes = drawn.growth.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"$\omega_3$ (rad/s)", "$a$ (m)")


def test_a_relation_of_the_family_is_put_in():
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    leaning = next(f for f in ph.steady(disk) if f.relations)
    drawn = figures.stability_map(
        leaning,
        ("theta", "20 deg", "160 deg"),
        ("phi_dot", "1 rad/s", "10 rad/s"),
        {"g": 9.81, "m": 1, "a": 0.1},
    )
    growth = np.asarray(drawn.growth.get_array()).reshape(161, 161)
    assert growth[30, 80] > 1
    assert np.all(growth[:, :20] == 0)
    assert drawn.growth.axes.get_xlabel() == r"$\theta$ (deg)"


def test_a_map_says_what_it_lacks(rolling):
    with pytest.raises(DeclarationError, match="no value of g, m for a map"):
        figures.stability_map(rolling, ("omega_3", 0, 10), ("a", "2 cm", "20 cm"))
    with pytest.raises(DeclarationError, match="'omega_3' along a side of a map"):
        figures.stability_map(rolling, "omega_3", ("a", 0.1, 0.2))
    with pytest.raises(UnitError, match="omega_3 = '10 m'"):
        figures.stability_map(rolling, ("omega_3", 0, "10 m"), ("a", 0.1, 0.2), {"g": 9.81})


def test_the_threshold_of_a_map_is_named(rolling):
    drawn = figures.stability_map(
        rolling, ("omega_3", 0, "10 rad/s"), ("a", "2 cm", "20 cm"), {"g": 9.81, "m": 1}
    )
    labels = [text.get_text() for text in drawn.axes.get_legend().get_texts()]
    assert labels == [r"threshold: $3 a \omega_3^2 - g = 0$"]
    assert drawn._repr_png_().startswith(b"\x89PNG")


@pytest.fixture(scope="module")
def fates():
    """Of nine disks, one of which could not be followed, and one of which has no result."""
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    theta, omega = np.radians([30.0, 60.0, 90.0]), np.array([5.0, 10.0, 15.0])
    values, failed = np.array([[0.0, 0, 1], [0, np.nan, 1], [np.nan, 1, 1]]), np.zeros((3, 3), bool)
    failed[1, 1] = True
    axes, numbers = {"theta": theta, "omega_3": omega}, {"m": 0.2, "a": 0.03, "g": 9.81}
    return Found(
        system="rolling-disk",
        output="fate",
        labels=("goes flat", "none of these"),
        axes=axes,
        values=values,
        thresholds=tuple(thresholds(disk, axes, numbers)),
        numbers=numbers,
        origin="",
        measured=measured(disk, axes),
        failed=failed,
    )


def test_a_map_of_outcomes_has_symbols_degrees_and_names_for_all_it_shows(fates):
    drawn = figures.outcome_map(fates)
    assert drawn.axes.get_xlabel() == r"$\theta$ (deg)"
    assert drawn.axes.get_ylabel() == r"$\omega_3$ (rad/s)"
    assert drawn.axes.get_xlim() == pytest.approx((15, 105))
    labels = [text.get_text() for text in drawn.axes.get_legend().get_texts()]
    assert labels[:4] == ["goes flat", "none of these", "could not be simulated", "no result"]
    assert [t for t in labels[4:] if not t.startswith("threshold")] == []
    assert len(labels) == 4 + len(drawn.thresholds) == 4 + len(drawn.conditions)
    hatched = [c for c in drawn.axes.collections if c.get_hatch()]
    assert [len(c.get_array().compressed()) for c in hatched] == [1, 1]
    # The threshold of the upright disk is one of upright starts: a point, not a line.
    (point,) = drawn.thresholds
    assert point.get_xdata() == pytest.approx([90])
    assert point.get_ydata() == pytest.approx([np.sqrt(9.81 / (3 * 0.03))], rel=1e-3)
    assert labels[4].endswith(r"at $\theta$ = 90 deg")


def _of_starts(start, axes=None):
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    over = axes or {"omega_3": np.array([5.0, 15.0]), "a": np.array([0.02, 0.2])}
    return [str(t.condition) for t in thresholds(disk, over, {"m": 0.2, "g": 9.81, **start})]


def test_a_threshold_is_shown_where_starts_are_close_to_its_steady_motion():
    upright = "3*a*omega_3**2 - g"
    assert upright in _of_starts({"theta": np.pi / 2})
    assert upright in _of_starts({"theta": np.radians(89), "phi_dot": 0.0})
    assert upright not in _of_starts({"theta": np.radians(80)})
    assert upright not in _of_starts({"theta": np.pi / 2, "phi_dot": 3.0})
    assert upright not in _of_starts({"theta": np.pi / 2, "theta_dot": 2.0})
    spinning = {"phi_dot": np.array([5.0, 40.0]), "a": np.array([0.02, 0.2])}
    assert _of_starts({"theta": np.pi / 2, "omega_3": 0.0}, spinning) == ["5*a*phi_dot**2 - 4*g"]
    assert _of_starts({"theta": np.pi / 2, "omega_3": 5.0}, spinning) == []
    leaning = {"omega_3": np.array([5.0, 15.0]), "theta": np.radians([40.0, 85.0])}
    assert _of_starts({"a": 0.03}, leaning) == []


def test_the_line_of_upright_starts_is_the_closed_form():
    """A disk rolls upright where ω₃² > g/(3a)."""
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    axes = {"omega_3": np.linspace(2, 14, 7), "a": np.linspace(0.02, 0.2, 5)}
    numbers = {"m": 0.2, "g": 9.81, "theta": np.radians(89.5)}
    found = Found(
        system="rolling-disk", output="fate", labels=("none of these",), axes=axes,
        values=np.zeros((7, 5)), thresholds=tuple(thresholds(disk, axes, numbers)),
        numbers=numbers, origin="", measured=measured(disk, axes),
    )  # fmt: skip
    (line,) = figures.outcome_map(found).thresholds
    points = np.concatenate(line.allsegs[0])
    np.testing.assert_allclose(points[:, 0] ** 2, 9.81 / (3 * points[:, 1]), rtol=2e-3)


@pytest.mark.parametrize(
    ("name", "symbol", "expected"),
    [
        ("gyrocompass", "lambda_", True),
        ("marble-on-turntable/tilted", "alpha", True),
        ("rolling-disk", "theta", True),
        ("ball-on-paper", "k", False),
        ("rolling-disk", "m", False),
    ],
)
def test_angles_are_what_sines_are_taken_of(name, symbol, expected):
    equations = ph.derive(CATALOGUE[name].build())
    known = {s.published: s for s in (*equations.coordinates, *equations.parameters)}
    assert is_angle(equations, known[symbol]) == expected
