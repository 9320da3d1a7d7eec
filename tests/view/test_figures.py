"""Single figures: that they show what the mechanics says."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.figure import Figure

import polhode as ph
from polhode.base import DeclarationError, NumericError, UnitError
from polhode.catalogue import CATALOGUE
from polhode.view import figures as view
from polhode.view._quantities import scale_for
from polhode.view.figures._rotation import _SKY as SKY
from polhode.view.figures._rotation import View, _polhode, _separatrices
from polhode.view.figures._style import INK, line_style


def test_a_history_is_the_quantity_in_the_unit_of_the_label(run_of):
    run = run_of("rolling-disk")
    (line,) = view.history(run, "theta")
    assert line.axes.get_ylabel() == r"$\theta$ (deg)"
    np.testing.assert_allclose(
        line.get_ydata(), np.degrees(run.evaluate("theta", line.get_xdata()))
    )


def test_small_values_get_a_prefix(run_of):
    (line,) = view.history(run_of("marble-on-turntable"), "F_z")
    assert line.axes.get_ylabel() == "$F_z$ (mN)"
    np.testing.assert_allclose(line.get_ydata(), 5 * 9.81)


def test_a_quantity_that_hardly_changes_is_shown_by_its_change(run_of):
    run = run_of("gyrocompass")
    (line,) = view.history(run, "omega")
    assert line.axes.get_ylabel() == r"$\omega - \omega(0)$ (µrad/s)"
    change = run.evaluate("omega", line.get_xdata()) - run["omega"][0]
    np.testing.assert_allclose(line.get_ydata(), change * 1e6)


def test_a_constant_is_not_blown_up_to_its_rounding(run_of):
    (line,) = view.history(run_of("spinning-coin"), "omega_3")
    low, high = line.axes.get_ylim()
    assert low < 1.7
    assert high > 2.3


def test_many_turns_are_counted_in_turns(run_of):
    (line,) = view.history(run_of("gyroscope"), "psi")
    assert line.axes.get_ylabel() == r"$\psi$ (turns)"
    assert np.max(line.get_ydata()) == pytest.approx(2 * 150 / (2 * np.pi), rel=0.05)


def test_one_axis_has_one_unit(run_of):
    with pytest.raises(UnitError, match="theta in rad, omega_3 in rad/s cannot share an axis"):
        view.history(run_of("rolling-disk"), "theta", "omega_3")


def test_a_quantity_that_is_not_there_is_named(run_of):
    with pytest.raises(DeclarationError, match="'omega_9' is no quantity of rolling-disk"):
        view.history(run_of("rolling-disk"), "omega_9")


def test_a_group_of_several_units_gets_several_panels(run_of):
    figure = view.figure_of_run(run_of("rolling-disk"), [("theta", "omega_3"), ("F_x", "F_z")])
    assert [axes.get_ylabel() for axes in figure.axes] == [
        r"$\theta$ (deg)",
        r"$\omega_3$ (rad/s)",
        "force (N)",
    ]


def test_forces_of_unlike_size_get_panels_of_their_own(run_of):
    figure = view.figure_of_run(run_of("marble-on-turntable"), [("F_x", "F_y", "F_z")])
    assert [axes.get_ylabel() for axes in figure.axes] == ["force (µN)", "$F_z$ (mN)"]


def test_lines_of_a_panel_differ_in_dashes_too(run_of):
    lines = view.history(run_of("rolling-disk"), "F_x", "F_y", "F_z")
    assert len({line.get_color() for line in lines}) == 3
    assert len({str(line._dash_pattern) for line in lines}) == 3
    assert [text.get_text() for text in lines[0].axes.get_legend().get_texts()] == [
        "$F_x$",
        "$F_y$",
        "$F_z$",
    ]


def test_figures_are_drawn_in_the_axes_given(run_of):
    run = run_of("rolling-disk")
    axes = view.new_figure(3.0).subplots(2, 3).ravel()
    drawn = [
        view.history(run, "theta", ax=axes[0]),
        view.energies(run, ax=axes[1]),
        view.energy_drift(run, ax=axes[2]),
        view.floor_path(run, ax=axes[3]),
        view.phase_portrait(run, "theta", ax=axes[4]),
        view.reaction_ranges(run, ax=axes[5]),
    ]
    assert [artist.axes for artist in drawn] == list(axes)


@pytest.mark.parametrize("own", [False, True])
def test_figures_look_alike_in_axes_of_the_user_s_own(run_of, own):
    """Frame, fonts of ticks and labels, and their colour, as in a figure of their own."""
    with rc_context({"font.family": "monospace", "axes.spines.top": True}):
        plain = Figure().subplots()
        plain.figure.draw_without_rendering()
    axes = plain if own else None
    run = run_of("gyroscope/held")
    for draw in (view.energy_drift, view.reaction_ranges):
        shown = draw(run, ax=axes).axes
        shown.figure.draw_without_rendering()
        assert not shown.spines["top"].get_visible()
        texts = [*shown.get_xticklabels(), *shown.get_yticklabels(), shown.xaxis.label]
        assert {text.get_fontfamily()[0] for text in texts} == {"STIXGeneral"}
        assert {text.get_math_fontfamily() for text in texts} == {"stix"}
        assert {text.get_color() for text in texts} == {INK}


def test_what_is_drawn_shows_itself_as_its_figure(run_of):
    """A notebook has the figure, not the name of a class; axes of the user's show themselves."""
    top = run_of("gyroscope")
    everything = [
        view.nutation(top),
        view.energy_drift(top),
        view.history(top, "theta"),
        view.reaction_ranges(top),
    ]
    for drawn in everything:
        assert drawn._repr_png_().startswith(b"\x89PNG")
        assert drawn.figure is drawn.axes.figure
        assert repr(drawn).startswith("drawn: Line")
    assert view.nutation(top, ax=Figure().subplots())._repr_png_() is None


def test_a_stretch_of_a_run_is_shown_alone(run_of):
    run = replace(run_of("rolling-disk"), t=np.linspace(2.0, 3.0, 50))
    (line,) = view.history(run, "theta")
    assert line.axes.get_xlim() == (2.0, 3.0)
    assert len(line.get_xdata()) > 1000  # a smooth curve, however few the samples


def test_energy_lost_by_one_form_is_gained_by_the_other(run_of):
    kinetic, potential, total = view.energies(run_of("spinning-coin"))
    np.testing.assert_allclose(kinetic.get_ydata(), -potential.get_ydata(), atol=1e-9)
    np.testing.assert_allclose(total.get_ydata(), 0, atol=1e-9)
    assert kinetic.axes.get_ylabel() == "energy change (µJ)"


def test_a_moving_support_shows_up_as_work(run_of):
    kinetic, work = view.energies(run_of("ball-on-paper"))
    np.testing.assert_allclose(kinetic.get_ydata(), work.get_ydata(), atol=1e-9)


def test_energy_that_does_not_change_is_a_flat_line(run_of):
    (line,) = view.energies(run_of("tennis-racquet"))
    low, high = line.axes.get_ylim()
    assert np.max(np.abs(line.get_ydata())) < 1e-6 * (high - low)


def test_the_drift_shown_is_that_of_the_run(run_of):
    run = run_of("rolling-disk")
    (line,) = view.energy_drift(run)
    shown = np.max(line.get_ydata())
    assert shown == pytest.approx(run.drift.energy, rel=0.3)
    assert line.axes.get_yscale() == "log"


def test_the_marble_runs_round_its_circle(run_of):
    """Centre and radius as in equation 8: 2/7 of the table's rate, through x = 0.1 m."""
    (line,) = view.floor_path(run_of("marble-on-turntable"))
    rate = 2 / 7 * 33 * 2 * np.pi / 60
    x, y = line.get_xdata(), line.get_ydata()
    radius = 0.05 / rate
    np.testing.assert_allclose(np.hypot(x - 0.1 + radius, y), radius, rtol=1e-9)


def test_the_trace_on_the_table_is_the_path_turned_back(run_of):
    run = run_of("marble-on-turntable")
    (line,) = view.support_trace(run)
    path = run.table(["x", "y"], line_times(run, line))
    np.testing.assert_allclose(
        np.hypot(line.get_xdata(), line.get_ydata()), np.hypot(path["x"], path["y"]), atol=1e-9
    )
    turned = np.unwrap(
        np.arctan2(path["y"], path["x"]) - np.arctan2(line.get_ydata(), line.get_xdata())
    )
    times = line_times(run, line)
    np.testing.assert_allclose(turned - turned[0], 33 * 2 * np.pi / 60 * times, atol=1e-6)


def line_times(run, line):
    return np.linspace(0, run.duration, len(line.get_xdata()))


def test_up_the_slope_is_up_the_page(run_of):
    (line,) = view.floor_path(run_of("marble-on-turntable/tilted"))
    assert line.axes.get_ylabel() == "$x_2$ (m)"
    assert line.axes.get_xlabel() == "$x_3$ (m)"
    assert line.axes.xaxis_inverted()


def test_the_phase_portrait_closes_on_a_swing(run_of):
    (line,) = view.phase_portrait(run_of("gyroscope"), "theta")
    assert line.axes.get_xlabel() == r"$\theta$ (deg)"
    assert line.axes.get_ylabel() == r"$\dot{\theta}$ (rad/s)"
    assert np.min(line.get_xdata()) == pytest.approx(60, abs=1e-6)


def test_the_axle_is_traced_on_the_sphere(run_of):
    run = run_of("gyroscope")
    front, behind = view.nutation(run)
    axle = np.array(
        [
            run.evaluate(run.equations.system.body("gyroscope").axes["1"].dot(d))
            for d in run.equations.system.root.directions
        ]
    )
    page = SKY.project(axle)
    drawn = np.array([front.get_xydata(), behind.get_xydata()])
    assert np.nanmax(np.hypot(*np.moveaxis(drawn, -1, 0))) <= 1 + 1e-12
    both = np.where(np.isnan(drawn[0]), drawn[1], drawn[0])
    np.testing.assert_allclose(both[0], page[:, 0], atol=1e-12)
    assert not np.any(np.isnan(both))


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("gyroscope", ["nutation", "effective_potential"]),
        ("rolling-disk", ["nutation", "effective_potential", "floor_path"]),
        ("tennis-racquet", ["polhodes"]),
        ("marble-on-turntable", ["floor_path"]),
        ("gyroscope/held", []),
    ],
)
def test_a_motion_has_the_pictures_that_show_something(run_of, name, shown):
    """A gyroscope that is held has nothing to show."""
    assert [picture.draw.__name__ for picture in view.pictures_of(run_of(name))] == shown


def test_pictures_stand_beneath_a_history(run_of):
    run = run_of("gyroscope")
    draw = [picture.draw for picture in view.pictures_of(run)]
    figure = view.figure_of_run(run, [("theta",)], beneath=draw)
    *pictures, history = figure.axes
    assert len(pictures) == 2
    assert history.get_ylabel() == r"$\theta$ (deg)"
    assert history.get_window_extent().y0 > max(ax.get_window_extent().y1 for ax in pictures)


def test_an_axis_that_does_not_go_round_is_seen_from_its_side(run_of):
    """Three cusps of a gyroscope are in front of the sphere."""
    run = run_of("gyroscope")
    few = replace(run, t=np.linspace(0.0, 0.05 * run.duration, 200))
    _, behind = view.nutation(few)
    assert np.all(np.isnan(behind.get_ydata()))


def test_a_body_without_a_spin_axis_needs_the_axis_named(run_of):
    run = run_of("tennis-racquet")
    with pytest.raises(DeclarationError, match="name the axis to follow"):
        view.nutation(run)
    axes = run.equations.system.body("racquet").axes
    assert view.nutation(run, axis=axes["2"])


@pytest.mark.parametrize("share", [0.01, 0.3, 0.7, 0.99])
@pytest.mark.parametrize("moments", [(1.0, 2.0, 5.0), (5.0, 1.0, 2.0)])
def test_a_polhode_keeps_energy_and_angular_momentum(moments, share):
    inertia = np.array(moments)
    ratio = 1 + 4 * share
    curve = _polhode(inertia, ratio)
    np.testing.assert_allclose(np.sum(curve**2, axis=0), 1)
    np.testing.assert_allclose(inertia @ curve**2, ratio)


def test_separatrices_cross_at_the_middle_axis():
    inertia = np.array([5.0, 1.0, 2.0])
    for curve in _separatrices(inertia):
        np.testing.assert_allclose(np.sum(curve**2, axis=0), 1)
        np.testing.assert_allclose(inertia @ curve**2, 2)
        np.testing.assert_allclose(np.abs(curve[:, 0]), [0, 0, 1], atol=1e-12)


def test_polhodes_need_a_body_that_turns_freely(run_of):
    with pytest.raises(DeclarationError, match="gyroscope has no free body to draw polhodes of"):
        view.polhodes(run_of("gyroscope"))
    assert view.polhodes(run_of("tennis-racquet"))


def test_reactions_of_one_joint(run_of):
    lines = view.reactions(run_of("gyroscope"), "pivot")
    assert lines[0].axes.get_ylabel() == "force (N)"
    assert len(lines) == 3


def test_undetermined_reactions_are_marked(run_of):
    bars = view.reaction_ranges(run_of("gyroscope/held"))
    faces = [line.get_markerfacecolor() for line in bars.axes.lines if line.get_marker() == "o"]
    assert faces.count("none") == 4
    assert len(faces) == 6


def test_the_view_is_a_rotation():
    eye = View(azimuth=37, elevation=21)
    flat = eye.project(np.eye(3))
    square = np.vstack([flat, eye.towards])
    np.testing.assert_allclose(square @ square.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(square) == pytest.approx(1)
    assert flat[0, 2] == 0
    assert flat[1, 2] > 0


# --- what is asked for ---


def test_quantities_are_called_by_names_or_by_symbols(run_of):
    run, theta = run_of("gyroscope"), ph.coordinate("theta")
    assert len(ph.plot(run, theta, (theta, "phi")).axes) == len(ph.plot(run, "theta", "phi").axes)
    assert view.history(run, theta)[0].axes.get_ylabel() == r"$\theta$ (deg)"
    shown = ph.scene(run, plots=["theta", (theta, "phi")])
    assert [s.name for s in shown.panels[0].series] == ["theta"]
    assert ph.scene(run, plots="theta").panels[0].series[0].name == "theta"


def test_what_cannot_be_plotted_is_refused(run_of):
    run = run_of("gyroscope")
    for wanted in (5, 2 * ph.coordinate("theta")):
        with pytest.raises(DeclarationError, match="is no quantity of gyroscope"):
            ph.plot(run, wanted)
    with pytest.raises(DeclarationError, match="no quantities to plot; expected names"):
        view.history(run)
    with pytest.raises(DeclarationError, match="F_z has no rate among the quantities"):
        view.phase_portrait(run, "F_z")


def test_lines_of_one_panel_are_unlike():
    styles = [line_style(i) for i in range(16)]
    assert all(styles.index(style) == i for i, style in enumerate(styles))


@pytest.mark.parametrize(
    ("largest", "shown"),
    [(3e-5, "30 µN"), (0.05, "50 mN"), (9999, "9999 N"), (2e5, "200 kN"), (1e10, "10 GN")],
)
def test_no_unit_is_tiny_or_huge(largest, shown):
    scale = scale_for("N", largest)
    assert f"{largest * scale.factor:.4g} {scale.unit}" == shown


# --- forces that come and go ---


@pytest.fixture(scope="module")
def bouncing():
    """A ball that begins in flight, lands, slides and rolls; and nothing else takes a force."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    floor = ph.Coulomb(ball, on=ph.Plane(lab), mu=0.2, name="floor")
    return ph.System(floor, ph.Gravity(g)), {m: 0.1, a: 0.02, g: 9.81}


def test_the_ranges_are_of_the_forces_of_all_modes(bouncing):
    run = ph.simulate(*bouncing, {"z": 0.03, "v_x": 1.0}, 0.5)
    axes = view.reaction_ranges(run).axes
    labels = [text.get_text() for text in axes.get_yticklabels()]
    assert sorted(labels) == ["$F_x$", "$F_y$", "$F_z$"]
    (bars,) = axes.collections
    ends = dict(zip(labels, (bar[:, 0] for bar in bars.get_segments()), strict=True))
    np.testing.assert_allclose(ends["$F_z$"], [0, 0.981], rtol=1e-12)
    np.testing.assert_allclose(ends["$F_x$"], [-0.2 * 0.981, 0], rtol=1e-9, atol=1e-12)


def test_in_flight_there_are_no_forces_to_draw(bouncing):
    run = ph.simulate(*bouncing, {"z": 0.5, "v_x": 1.0}, 0.1)
    with pytest.raises(
        DeclarationError, match="expected a motion with a force at a contact or joint"
    ):
        view.reaction_ranges(run)
    with pytest.raises(DeclarationError, match="'floor' exerts no force along the motion"):
        view.reactions(run, "floor")


def test_rounding_is_no_work():
    """What rolling takes from the slip it leaves, some 1e-34 J, is not a line of its own."""
    M, b, g, I_1, I_3 = ph.symbols("M b g I_1 I_3", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    ring = ph.Body("ring", mass=M, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3", rim=b)
    system = ph.System(ph.Rolling(ring, on=ph.Plane(lab)), ph.Gravity(g), name="ring")
    numbers = {M: 0.2, b: 0.03, I_1: 0.9e-4, I_3: 1.8e-4, g: 9.81}
    run = ph.simulate(system, numbers, {theta: "80 deg", "omega_3": 40}, "0.01 s")
    assert 0 < np.max(np.abs(run["work"])) < 1e-30
    labels = [line.get_label() for line in view.energies(run)]
    assert labels == [r"$\Delta T$", r"$\Delta V$", r"$\Delta T + \Delta V$"]


@pytest.mark.parametrize("name", ["Fußboden", "_under", "$x^$", r"100 % of {0} \frac"])
def test_a_name_is_text_wherever_it_is_shown(name, tmp_path):
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    floor = ph.Coulomb(ball, on=ph.Plane(lab), mu=0.2, name=name)
    numbers, start = {m: 0.1, a: 0.02, g: 9.81}, {"v_x": 1.0, "omega_y": 0.0}
    run = ph.simulate(ph.System(floor, ph.Gravity(g), name=name), numbers, start, 0.1)
    lines = view.power_balance(run)
    labels = lines[0].axes.get_legend().get_texts()[-1].get_text()
    assert labels.strip().replace(r"\$", "$") == name
    assert view.svg_of(lines[0].get_figure())
    ph.page(run, tmp_path / "named.html", title=name)


def test_what_stands_for_the_direction_of_a_slip_is_shown(bouncing):
    shown = ph.scene(ph.simulate(*bouncing, {"v_x": 1.0, "omega_y": 0.0}, 0.05))
    spoken = [formula.spoken for formula in shown.motion]
    assert "eₓ_floor = (vₓ − a ω_y)/vₛₗᵢₚ_floor" in spoken
    assert any(text.startswith("vₛₗᵢₚ_floor = √((vₓ − a ω_y)²") for text in spoken)


def test_a_motion_that_ends_as_it_begins_is_named():
    """A disk on its back is flat from the start."""
    entry = CATALOGUE["rolling-disk"]
    numbers, start = {"m": 0.2, "a": 0.03, "g": 9.81}, {"theta": np.pi, "phi_dot": 1, "omega_3": 40}
    run = ph.simulate(entry.build(), numbers, start, "1 s")
    assert run.duration == 0
    for draw in (ph.scene, ph.plot, view.energies, view.support_trace):
        with pytest.raises(NumericError, match=r"ends at its start \(goes flat\)"):
            draw(run)


def test_rates_of_turning_have_no_thousands():
    assert scale_for("rad/s", 4e4).unit == "rad/s"
    assert scale_for("rad/s", 4e-3).unit == "mrad/s"


def test_a_start_at_rest_is_named_rest():
    """The evaluation leaves some 4e-15 rad/s of zero where 36 rad/s are reached."""
    m, r, g = ph.symbols("m r g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    system = ph.System(ph.Coulomb(ball, on=ph.Plane(lab), mu=0.3), ph.Gravity(g))
    start = {"v_x": 1.0, "omega_y": 0.0}
    run = ph.simulate(system, {m: 0.05, r: 0.02, g: 9.81}, start, 1.0)
    assert 1e-15 < abs(run.evaluate("omega_y", 0.0)) < 1e-13
    assert {number.name: number.value for number in ph.scene(run).start}["omega_y"] == 0


def test_time_may_be_counted_in_a_period(run_of):
    run = run_of("gyroscope")
    figure = view.figure_of_run(run, [("theta",)], period=run.duration / 4)
    (axes,) = figure.axes
    assert axes.get_xlabel() == "$t/T$"
    assert float(axes.get_xticklabels()[-1].get_text()) == 4
    assert axes.get_xticks()[-1] == pytest.approx(run.duration)
