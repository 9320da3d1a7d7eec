"""Motions that a live page computes, against those of Python: another integrator, other rules.

The worker of the page runs under Node; `tests/browser/test_live.py` has the page itself.
"""

import shlex

import numpy as np
import pytest

import polhode as ph
from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET, cases_of
from polhode.cli._main import _parser
from polhode.cli._motion import motion_wanted
from polhode.view import scene
from polhode.view._live import live_document
from polhode.view._scene_along import along
from polhode.view._scene_text import energies_of
from view.live_host import answers, replies, table, usual_numbers

FRAMES = 401


def wanted(line):
    words = ["page", *shlex.split(line), "-o", "page.html"]
    return motion_wanted(_parser(words).parse_args(words), lettered=True)


def followed(line):
    """A motion, its scene, and what its live page has, for the words after `polhode page`."""
    motion = wanted(line)
    run = motion.followed()
    shown = scene(run, plots=motion.entry.plots, frames=FRAMES)
    return run, shown, live_document(run, shown, motion.written)


def values_of(run, name, times):
    """A quantity; the energies are found from the expressions of each mode."""
    if name in ("kinetic energy", "potential energy"):
        return along(run, energies_of, 2, times)[:, int(name == "potential energy")]
    return run.evaluate(name, times)


def assert_same(run, columns, tolerance):
    """Every column as in Python, relative to its largest value."""
    times = np.minimum(columns["t"], run.duration)
    for name, values in columns.items():
        if name == "t":
            continue
        expected = values_of(run, name, times)
        size = max(np.max(np.abs(expected)), 1e-6)
        assert np.max(np.abs(values - expected)) <= tolerance * size, name


# -- the motions ----------------------------------------------------------------------------------


CASES = [f"{name} --case {c.name}" for name, entry in PROBLEM_SET.items() for c in cases_of(entry)]


@pytest.mark.parametrize("name", [*PROBLEM_SET, *CASES])
def test_every_catalogue_system_and_case_moves_as_in_python(name):
    run, _, live = followed(name)
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 201, "table": True})
    assert found["ending"]["kind"] == "goal"
    assert found["end"] == pytest.approx(run.duration, rel=1e-15)
    columns = table(found["table"])
    states = {s.published for s in (*run.equations.coordinates, *run.equations.speeds)}
    moving = {k: v for k, v in columns.items() if k in states | {"t"}}
    # about its middle axis a body leaves steady rotation exponentially
    tolerance = 1e-5 if name == "tennis-racquet" else 1e-10
    # reactions jump where contact modes change
    assert_same(run, moving if "--case" in name else columns, tolerance)


CONTACTS = {
    "rolling-disk --mu 0.1 --duration 3s": 1e-9,
    "rolling-disk --mu .3 --start theta=70deg --start omega_3=20 --start v_x=1 --start v_y=.4 "
    "--start phi_dot=2 --duration 1s": 1e-10,
    "rolling-disk --mu 0.3 --mu-static 0.4 --start theta=60deg --start omega_3=5 "
    "--start phi_dot=2 --duration 1s": 1e-9,
    "spinning-coin --mu 0.2 --start v_x=0.3 --duration 2s": 1e-11,
    "marble-on-turntable/tilted --mu 0.01 --duration 5s": 1e-11,
    "ball-on-paper --case jerked": 1e-11,
    "ball-on-paper --case rolls-off": 1e-11,
    "ball-on-paper --mu 0.2 --set edge=0.05m": 1e-11,
    "ball-on-paper --mu 0.3 --start z=0.1m --duration 1s": 1e-11,
    "rolling-disk --mu 0.3 --start z=0.1m --start theta=60deg --start v_x=0.5 "
    "--duration 0.4s": 1e-10,
    "spinning-coin --start z=0.05m --start theta=60deg --start phi_dot=3 --duration 0.2s": 1e-11,
}


@pytest.mark.parametrize("line", CONTACTS)
def test_contacts_stick_slip_open_and_close_as_in_python(line):
    run, seen, live = followed(line)
    numbers = usual_numbers(live)
    found, shown = answers(
        live,
        {"numbers": numbers, "frames": 201, "table": True},
        {"numbers": numbers, "frames": 201},
    )
    events = [(event.kind, float(event.time)) for event in run.events[1:-1]][:40]
    assert len(events) > 0
    happened = shown["computed"]["happenings"]
    assert [event["what"].split(":")[0] for event in happened] == [kind for kind, _ in events]
    spans = [(span["name"], span["end"]) for span in shown["computed"]["modes"]]
    expected = [(span.name, span.end) for span in seen.modes]
    assert [name for name, _ in spans] == [name for name, _ in expected]
    assert [end for _, end in spans] == pytest.approx([end for _, end in expected], abs=1e-11)
    times = [event["time"] for event in happened]
    assert times == pytest.approx([time for _, time in events], abs=1e-11)
    assert found["end"] == pytest.approx(run.duration, rel=1e-12)
    columns = table(found["table"])
    states = {s.published for s in (*run.equations.coordinates, *run.equations.speeds)}
    assert_same(run, {k: v for k, v in columns.items() if k in states | {"t"}}, CONTACTS[line])
    (energy,) = shown["computed"]["evidence"]
    assert energy["value"] < 1e-12
    assert shown["computed"]["doubt"] == ""


M, G, A, R, E, MU, ALPHA = ph.symbols("m g a R e mu alpha")
LAB = ph.Frame("lab")
NUMBERS = {"m": 0.1, "g": 9.81, "a": 0.02, "R": 0.2, "e": 0.8, "mu": 0.2, "alpha": 0.6}


def bouncing(law):
    ball = ph.sphere("ball", mass=M, radius=A, axes=LAB)
    laws = {
        "smooth": lambda: ph.Smooth(ball, on=ph.Plane(LAB), restitution=E),
        "friction": lambda: ph.Coulomb(ball, on=ph.Plane(LAB), mu=MU, restitution=E),
        "superball": lambda: ph.Rolling(ball, on=ph.Plane(LAB), restitution=(E, E)),
    }
    return ph.System(ball, laws[law](), ph.Gravity(G), name="ball")


def on_support(support, start):
    ball = ph.sphere("ball", mass=M, radius=A, axes=support.axes)
    contact = ph.Coulomb(ball, on=support, mu=MU)
    return ph.System(ball, contact, ph.Gravity(G), name="ball"), start


def simulated(system, start, duration):
    modes = ph.automaton(system)
    known = {p.published for p in modes.parameters}
    numbers = {name: value for name, value in NUMBERS.items() if name in known}
    return ph.simulate(modes, numbers, start, duration)


@pytest.mark.parametrize("law", ["smooth", "friction", "superball"])
def test_a_ball_bounces_as_in_python(law):
    """Fast spin and slow fall: friction turns the slip within an impact, which ends in stick."""
    start = {"z": 0.5, "v_x": 0.3, "v_y": -0.1, "omega_y": 20.0, "omega_x": 3.0}
    run = simulated(bouncing(law), start, "1.5 s")
    shown = scene(run, frames=FRAMES)
    live = live_document(run, shown, {})
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 201, "table": True})
    columns = table(found["table"])
    # the instants of impacts are rounded: there, speeds differ
    near = np.min([np.abs(columns["t"] - float(e.time)) for e in run.events], axis=0) < 1e-9
    assert_same(run, {name: values[~near] for name, values in columns.items()}, 1e-10)


SUPPORTS = {
    "bowl": on_support(ph.Sphere(LAB, radius=R, inside=True), {"u": 0.8, "v_dot": 2.0}),
    "trough": on_support(ph.Cylinder(LAB, radius=R, inside=True), {"u": 0.8}),
    "sphere": on_support(ph.Sphere(LAB, radius=R), {"u": 0.1}),
    "funnel": on_support(ph.Cone(LAB, half_angle=ALPHA, inside=True), {"v": 0.3, "u_dot": 8.0}),
}


@pytest.mark.parametrize("name", SUPPORTS)
def test_bodies_on_curved_supports_move_and_are_drawn_as_in_python(name):
    system, start = SUPPORTS[name]
    run = simulated(system, start, "0.4 s")
    shown = scene(run, frames=FRAMES)
    live = live_document(run, shown, {})
    numbers = usual_numbers(live)
    found, picture = answers(
        live,
        {"numbers": numbers, "frames": 201, "table": True},
        {"numbers": numbers, "frames": FRAMES},
    )
    assert_same(run, table(found["table"]), 1e-9)
    (support,) = picture["computed"]["supports"]
    np.testing.assert_allclose(support["points"], shown.supports[0].points, atol=1e-6)


def test_an_impact_beside_stick_ends_as_in_python_for_many_directions():
    """Random approaches of a rough disk, whose slip friction turns."""
    motion = wanted("rolling-disk --mu 0.3 --start z=0.05m --start theta=50deg --duration 0.2s")
    run = motion.followed()
    live = live_document(run, scene(run, frames=11), motion.written)
    names = [slider["name"] for slider in live["start"]]
    random = np.random.default_rng(7)
    starts = []
    for _ in range(10):
        start = dict(zip(names, usual_numbers(live)["start"], strict=True))
        start |= {n: random.uniform(-1, 1) for n in ("v_x", "v_y")}
        start |= {n: random.uniform(-20, 20) for n in ("phi_dot", "theta_dot", "omega_3")}
        starts.append(start)
    requests = [
        {
            "numbers": {
                **usual_numbers(live),
                "start": [start[name] for name in names],
                "duration": 0.2,
            },
            "frames": 61,
            "table": True,
        }
        for start in starts
    ]
    letters = {**motion.numbers.parameters, **motion.letters}
    for start, found in zip(starts, answers(live, *requests), strict=True):
        if "no unique motion" in found["ending"]["what"]:  # friction is too strong
            with pytest.raises(ph.NumericError, match="no unique motion") as refused:
                ph.simulate(motion.modes, letters, start, 0.2)
            assert f"t = {found['end']:.9g}" in str(refused.value)
            continue
        other = ph.simulate(motion.modes, letters, start, 0.2)
        assert found["end"] == pytest.approx(other.duration, rel=1e-9)
        columns = table(found["table"])
        assert_same(other, {k: columns[k] for k in ("t", "x", "y", "phi", "psi")}, 1e-9)


# -- numbers of the page --------------------------------------------------------------------------


def test_a_parameter_that_is_a_formula_follows_the_others():
    run, _, live = followed("gyrocompass --duration 20s")
    sliders = [slider["name"] for slider in live["parameters"]]
    assert {one["name"] for one in live["formulas"]} == {"I_1", "I_3"}
    assert "a" in sliders
    assert "I_1" not in sliders
    numbers = usual_numbers(live)
    numbers["parameters"][sliders.index("a")] = 0.2
    (found,) = answers(live, {"numbers": numbers, "frames": 101, "table": True})
    values = {**run.parameters, "I_1": 0.2**2 / 2, "I_3": 0.2**2}
    start = {"theta": np.radians(20), "omega": 3000 * 2 * np.pi / 60}
    other = ph.simulate(ph.derive(PROBLEM_SET["gyrocompass"].build()), values, start, 20)
    assert_same(other, table(found["table"]), 1e-9)


def test_sliders_are_in_the_units_that_were_written():
    _, _, live = followed("rolling-disk --set a=4cm --start theta=1.2 --start omega_3=300rpm")
    units = {s["name"]: (s["value"], s["unit"]) for s in (*live["parameters"], *live["start"])}
    assert units["a"] == (pytest.approx(4), "cm")
    assert units["omega_3"] == (pytest.approx(300), "rpm")
    assert units["theta"] == (pytest.approx(np.degrees(1.2)), "deg")


def test_a_rolling_motion_tells_how_much_friction_it_needs():
    """Against the forces of Python; with less friction it slips, where more leaves it as it is."""
    run, _, live = followed("rolling-disk --mu 0.3 --duration 2s")
    numbers = usual_numbers(live)
    (shown,) = answers(live, {"numbers": numbers, "frames": 2001})
    times = np.linspace(0, run.duration, 2001)
    along_, across, normal = (run.evaluate(name, times) for name in ("F_x", "F_y", "F_z"))
    ratios = np.hypot(along_, across) / normal
    assert shown["needed"] == pytest.approx([ratios[0], np.max(ratios)], rel=1e-9)
    place = [slider["name"] for slider in live["parameters"]].index(live["friction"])
    for factor, slips in ((0.99, True), (1.001, False)):
        numbers["parameters"][place] = factor * np.max(ratios)
        (found,) = answers(live, {"numbers": numbers, "frames": 201})
        assert (found["needed"] is None) == slips


def test_impossible_coefficients_are_refused_in_words():
    _, _, live = followed("rolling-disk --mu 0.1 --mu-static 0.2 --duration 0.1s")
    numbers = usual_numbers(live)
    mu = [slider["name"] for slider in live["parameters"]].index("mu")
    numbers["parameters"][mu] = 0.3
    (reply,) = replies(live, {"numbers": numbers, "frames": 11})
    assert "static friction" in reply["error"]


def test_a_motion_that_loses_its_energy_is_doubted():
    """Past gimbal lock, where Python goes on with other angles."""
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=M, inertia=ph.symbols("I_1 I_2 I_3", positive=True), axes=axes)
    equations = ph.derive(ph.System(body, name="free"))
    numbers = {"m": 1, "I_1": 1, "I_2": 2, "I_3": 2.5}
    start = {"theta": 0.5, "theta_dot": -1.0, "phi_dot": 0.001}
    run = ph.simulate(equations, numbers, start, 2)
    live = live_document(run, scene(run, frames=11), {})
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 401})
    assert "energy balance is off" in found["computed"]["doubt"]


@pytest.mark.parametrize(
    ("line", "name", "value"),
    [("rolling-disk", "a", -0.03), ("gyroscope", "M", 0.0), ("tennis-racquet", "I_2", -1e-3)],
)
def test_impossible_masses_and_lengths_are_refused_in_words(line, name, value):
    _, _, live = followed(f"{line} --duration 0.1s")
    numbers = usual_numbers(live)
    numbers["parameters"][[s["name"] for s in live["parameters"]].index(name)] = value
    (reply,) = replies(live, {"numbers": numbers, "frames": 11})
    assert "positive" in reply["error"]


def test_a_contact_that_slides_beside_another_has_no_live_page():
    first, second = (
        ph.sphere(name, mass=M, radius=A, axes=LAB, tag=name) for name in ("one", "two")
    )
    contacts = (ph.Coulomb(ball, on=ph.Plane(LAB), mu=MU) for ball in (first, second))
    system = ph.System(*contacts, ph.Gravity(G), name="two balls")
    speeds = dict.fromkeys(("v_x_one", "v_x_two"), 0.3)
    still = dict.fromkeys(("omega_y_one", "omega_y_two"), 0.0)
    run = simulated(system, {**speeds, **still, "x_two": 0.5}, "0.05 s")
    with pytest.raises(DeclarationError, match="several contacts"):
        live_document(run, scene(run, frames=11), {})


def test_a_start_without_a_motion_is_told_without_a_picture():
    """In a singular attitude the equations have no finite values."""
    _, _, live = followed("tennis-racquet --duration 1s")
    numbers = usual_numbers(live)
    numbers["start"][1] = 0.0  # theta
    (found,) = answers(live, {"numbers": numbers, "frames": 11})
    assert found["end"] == 0
    assert found["ending"]["kind"] == "broken"
    assert found["computed"] is None


def test_a_sheet_given_by_samples_moves_as_in_python(tmp_path):
    sheet = tmp_path / "sheet.csv"
    sheet.write_text("t,x,y\n0,0,0\n0.2,0.01,0\n0.5,0.05,0.01\n1,0.1,0.02\n2,0.1,0.05\n")
    run, _, live = followed(f"ball-on-paper --sheet {sheet} --mu 0.01 --duration 2s")
    assert len(live["schedule"]["times"]) > 3
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 201, "table": True})
    columns = table(found["table"])
    states = {s.published for s in (*run.equations.coordinates, *run.equations.speeds)}
    assert_same(run, {k: v for k, v in columns.items() if k in states | {"t"}}, 1e-9)


# -- closed loops ---------------------------------------------------------------------------------


def slider_crank():
    """A crank, a connecting rod and a piston in its bore; phi follows from theta."""
    r, b, piston = ph.symbols("r b M", positive=True)
    theta, phi = ph.coordinates("theta phi")
    turning, swinging = LAB.rotated(theta, "y"), LAB.rotated(phi, "y")
    crank = ph.rod("crank", mass=M, length=r, axes=turning, axis="x", tag="c")
    rod = ph.rod("rod", mass=M, length=b, axes=swinging, axis="x", tag="r")
    weight = ph.point_mass("piston", mass=piston, axes=LAB, tag="p")
    return ph.System(
        ph.Pivot(crank, at=turning["x"] * (-r / 2), name="main bearing"),
        ph.Hinge(crank, axis="y"),
        ph.Pivot(
            rod, at=swinging["x"] * (-b / 2), to=crank.point(turning["x"] * (r / 2)), name="pin"
        ),
        ph.Hinge(rod, axis="y"),
        ph.Pivot(weight, to=rod.point(swinging["x"] * (b / 2)), name="wrist"),
        ph.Pivot(weight, only="z", name="bore", force="N"),
        ph.Gravity(G),
    )


LENGTHS = {"m": 0.4, "M": 0.6, "r": 0.05, "b": 0.16, "g": 9.81}


def cranked(parameters, start):
    """A motion, its live page, and the numbers of the page by name."""
    run = ph.simulate(slider_crank(), parameters, start, 0.3)
    live = live_document(run, scene(run, frames=11), dict.fromkeys(start, "0"))
    return run, live


def numbers_with(live, **changed):
    """The numbers that a page opens with, some of them changed."""
    numbers = usual_numbers(live)
    for kind in ("parameters", "start"):
        names = [slider["name"] for slider in live[kind]]
        numbers[kind] = [changed.pop(name, v) for name, v in zip(names, numbers[kind], strict=True)]
    assert not changed
    return numbers


def test_a_loop_is_closed_in_the_page_where_the_start_or_a_length_changes():
    _, live = cranked(LENGTHS, {"theta": 0.5, "theta_dot": 40.0})
    assert [live["start"][place]["name"] for place in live["loops"]["solved"]] == ["phi"]
    numbers = numbers_with(live, theta=2.0, b=0.2, theta_dot=30)
    (found,) = answers(live, {"numbers": numbers, "frames": 201, "table": True})
    expected, _ = cranked({**LENGTHS, "b": 0.2}, {"theta": 2.0, "theta_dot": 30})
    columns = table(found["table"])
    assert found["end"] == pytest.approx(0.3, rel=1e-12)
    assert_same(expected, columns, 1e-10)


def test_the_page_says_how_far_loops_open():
    _, live = cranked(LENGTHS, {"theta": 0.5, "theta_dot": 40.0})
    (shown,) = answers(live, {"numbers": usual_numbers(live), "frames": 51})
    evidence = {one["name"]: one["value"] for one in shown["computed"]["evidence"]}
    assert evidence["closed loops"] < 1e-15
    assert evidence["energy − work done"] < 1e-13


def test_lengths_with_which_no_loop_closes_are_refused():
    _, live = cranked(LENGTHS, {"theta": 0.5, "theta_dot": 40.0})
    numbers = numbers_with(live, theta=np.pi / 2, b=0.04)
    (reply,) = replies(live, {"numbers": numbers, "frames": 11})
    assert "loop does not close" in reply["error"]


def test_equal_numbers_have_the_same_configuration_whatever_was_tried_before():
    """There are two in which the connecting rod closes the loop."""
    _, live = cranked(LENGTHS, {"theta": 0.5, "theta_dot": 40.0})
    wanted = {"numbers": numbers_with(live, theta=-2.0), "frames": 2, "table": True}
    around = {"numbers": numbers_with(live, theta=9.0), "frames": 2, "table": True}
    first, _, again = answers(live, wanted, around, wanted)
    assert first["table"] == again["table"]


# -- what may only push or pull -------------------------------------------------------------------


def bob_on_a_rope():
    bob = ph.point_mass("bob", mass=M, axes=LAB)
    rope = ph.Rope([bob.point(), LAB.zero], name="string")
    return ph.System(ph.Pivot(bob, only="y", name="plane"), rope, ph.Gravity(G))


def test_a_rope_that_goes_slack_ends_the_motion_of_a_page():
    """From the lowest point with v² = 3 g R it does at a third of the radius above the middle."""
    values = {"m": 2.0, "g": 9.81}
    start = {"x": 0.0, "z": -0.5, "v_x": (3 * 9.81 * 0.5) ** 0.5}
    run = ph.simulate(bob_on_a_rope(), values, start, 0.2)
    live = live_document(run, scene(run, frames=11), dict.fromkeys(start, "0"))
    numbers = usual_numbers(live) | {"duration": 2.0}
    (found,) = answers(live, {"numbers": numbers, "frames": 51, "table": True})
    assert found["ending"] == {"kind": "event", "what": "string goes slack"}
    assert table(found["table"])["z"][-1] == pytest.approx(0.5 / 3, rel=1e-10)


def test_a_start_that_a_rope_would_have_to_push_is_refused():
    values = {"m": 2.0, "g": 9.81}
    run = ph.simulate(bob_on_a_rope(), values, {"x": 0.0, "z": -0.5, "v_x": 1.0}, 0.2)
    live = live_document(run, scene(run, frames=11), {"z": "0"})
    numbers = numbers_with(live, z=0.45, v_x=0.1)
    (reply,) = replies(live, {"numbers": numbers, "frames": 51})
    assert reply["error"] == "string goes slack at the start."


# -- the picture ----------------------------------------------------------------------------------


def assert_same_pose(pose, expected):
    for key in ("place", "turn", "spin"):
        values = np.asarray(getattr(expected, key), dtype="f4")
        np.testing.assert_allclose(pose[key], values, atol=2e-5, err_msg=key)


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_a_computed_motion_is_drawn_as_in_python(name):
    _, shown, live = followed(name if name != "tennis-racquet" else f"{name} --duration 3s")
    request = {"numbers": usual_numbers(live), "frames": FRAMES}
    (found,) = answers(live, request)
    seen = found["computed"]
    assert (seen["floor"] is None) == (shown.floor is None)
    assert seen["floor"] is None or seen["floor"] == pytest.approx(shown.floor)
    assert seen["up"] == pytest.approx(list(shown.up))
    for body, expected in zip(seen["bodies"], shown.bodies, strict=True):
        assert_same_pose(body["pose"], expected.pose)
        assert body["shape"]["kind"] == expected.shape.kind
        assert body["shape"]["size"] == pytest.approx(expected.shape.size)
        assert body["shape"]["axis"] == pytest.approx(expected.shape.axis)
        np.testing.assert_allclose(body["arms"], expected.arms)
    for joint, expected in zip(seen["joints"], shown.joints, strict=True):
        assert joint["kind"] == expected.kind
        assert joint["place"] == pytest.approx(expected.place)
        assert joint["axis"] == pytest.approx(expected.axis)
    for support, expected in zip(seen["supports"], shown.supports, strict=True):
        assert_same_pose(support["pose"], expected.pose)
        assert support["middle"] == pytest.approx(expected.middle, abs=1e-6)
        assert support["reach"] == pytest.approx(expected.reach, rel=1e-6)
    assert [arrow["name"] for arrow in seen["arrows"]] == [arrow.name for arrow in shown.arrows]
    for arrow, expected in zip(seen["arrows"], shown.arrows, strict=True):
        tolerance = 1e-5 * expected.largest
        np.testing.assert_allclose(arrow["along"], expected.along, atol=tolerance)
        np.testing.assert_allclose(arrow["foot"], expected.foot, atol=1e-6)
    for trace, expected in zip(seen["traces"], shown.traces, strict=True):
        assert trace["name"] == expected.name
        np.testing.assert_allclose(trace["points"], expected.points, atol=1e-5)
    for panel, expected in zip(seen["panels"], shown.panels, strict=True):
        assert panel["unit"] == expected.unit


@pytest.mark.parametrize(
    "moments",
    [
        (2, 2, 1),  # long cylinder
        (1, 1, 2),  # wheel
        (1, 1, 0),  # rod
        (1, 2, 2.5),  # box
        (0.001, 1, 1.001),  # racquet
        (3, 1, 2.9),
    ],
)
def test_a_body_without_a_surface_has_the_shape_of_its_inertia(moments):
    """Also where its principal axes are not those of the body."""
    q = ph.coordinate("q")
    axes = LAB.rotated(q, "y")
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    matrix = turn @ np.diag(moments) @ turn.T * 1e-3
    names = [ph.symbol(f"I_{i}{k}") for i in range(3) for k in range(3)]
    inertia = [
        [names[3 * i + k] if i <= k else names[3 * k + i] for k in range(3)] for i in range(3)
    ]
    body = ph.Body("body", mass=M, inertia=inertia, axes=axes)
    system = ph.System(ph.Pivot(body, at=axes["z"] * R), ph.Hinge(body, axis="y"), ph.Gravity(G))
    values = {f"I_{i}{k}": matrix[i, k] for i in range(3) for k in range(i, 3)}
    equations = ph.derive(system)
    given = {**values, "m": 0.1, "R": 0.2, "g": 9.81}
    run = ph.simulate(equations, given, {"q": 0.3}, 0.5)
    shown = scene(run, frames=11)
    live = live_document(run, shown, {})
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 11})
    (there,), (here,) = found["computed"]["bodies"], shown.bodies
    assert there["shape"]["kind"] == here.shape.kind
    assert there["shape"]["size"] == pytest.approx(here.shape.size, rel=1e-6)
    for key in ("axis", "across"):  # up to their signs
        cosine = np.dot(there["shape"][key], getattr(here.shape, key))
        assert abs(cosine) == pytest.approx(1, abs=1e-6) or moments[0] == moments[1]
