"""Gears, racks, screws, ropes, sliders and knife edges, against closed forms by hand."""

import numpy as np
import pytest

import polhode as ph
from model.transmissions import atwood
from polhode.base import ConstraintError, DeclarationError, PolhodeError

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
ALPHA = ph.coordinate("alpha")
M, m, J, R, g, h, k = ph.symbols("M m J R g h k", positive=True)


def _wheel(name, angle, tag, moment=J, mass=M):
    axes = LAB.rotated(angle, "z")
    return ph.Body(name, mass=mass, inertia=(moment,) * 3, axes=axes, tag=tag)


def _turning(*wheels):
    return [
        part
        for wheel in wheels
        for part in (
            ph.Pivot(wheel, name=f"pivot {wheel.name}"),
            ph.Hinge(wheel, axis="z"),
        )
    ]


def test_atwood_machine_with_a_heavy_pulley():
    # Kleppner and Kolenkow, An Introduction to Mechanics, ex. 7.15:
    # a = (m₁ - m₂) g/(m₁ + m₂ + I/R²)
    equations = ph.derive(atwood())
    m_1, m_2 = ph.symbols("m_1 m_2", positive=True)
    expected = (m_1 - m_2) * g / (m_1 + m_2 + J / R**2)
    assert (equations.on_shell(ALPHA.dt().dt()) * R + expected).is_zero
    tension = equations.on_shell(equations.components["S_1"])
    assert (tension - m_1 * (g - expected)).is_zero
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_block_and_tackle():
    """A rope from the ceiling, under a moving block, over a fixed eye, down to a counterweight."""
    block = ph.point_mass("block", mass=M, axes=LAB, tag="b")
    weight = ph.point_mass("weight", mass=m, axes=LAB, tag="w")
    under = [block.point(X * -R), block.point(X * R)]
    points = [X * -R, *under, X * R, X * (2 * R), weight.point()]
    rope = ph.Rope(points, directions=[-Z, X, Z, X, -Z])
    parts = [
        ph.Pivot(block, only="x y", name="guide block"),
        ph.Pivot(weight, to=X * (2 * R), only="x y", name="guide weight"),
    ]
    equations = ph.derive(ph.System(*parts, rope, ph.Gravity(g)))
    acceleration = (M - 2 * m) * g / (M + 4 * m)  # of the block, downwards
    found = equations.on_shell(equations.components["S_b"])
    assert (found * 2 - M * (g - acceleration)).is_zero


def test_a_driven_rope_lifts_its_load():
    (lift,) = ph.functions("s")
    load = ph.point_mass("load", mass=m, axes=LAB)
    rope = ph.Rope([load.point(), Z * lift], directions=[Z])
    guide = ph.Pivot(load, only="x y")
    equations = ph.derive(ph.System(rope, guide, ph.Gravity(g)))
    assert (equations.components["S"] - m * (g + lift.dt().dt())).is_zero
    supplied = equations.on_shell(equations.power)
    assert equations.rate(equations.energy) == supplied


def test_epicyclic_gear_obeys_willis_formula():
    r_1, r_2, tau = ph.symbols("r_1 r_2 tau", positive=True)
    angles = ph.coordinates("theta_s theta_q theta_r phi")
    moments = ph.symbols("I_s I_q I_r I_c", positive=True)
    sun, planet, ring, carrier = (
        _wheel(name, angle, name[0], moment)
        for name, angle, moment in zip(
            ("sun", "planet", "ring", "carrier"), angles, moments, strict=True
        )
    )
    outer = r_1 + 2 * r_2
    system = ph.System(
        *_turning(sun, ring, carrier),
        ph.Hinge(planet, axis="z"),
        ph.Pivot(planet, to=carrier.point(carrier.axes["x"] * (r_1 + r_2)), name="pin"),
        ph.Gear(sun, radius=r_1, to=planet, other_radius=r_2, axis=Z, name="inner"),
        ph.Gear(
            planet, radius=r_2, to=ring, other_radius=outer, axis=Z, teeth="internal", name="outer"
        ),
        ph.Torque(sun, Z * tau),
    )
    equations = ph.derive(system)
    speeds = [equations.kinetics.on_speeds(angle.dt()) for angle in angles]
    sun_speed, _, ring_speed, arm_speed = speeds
    assert ((sun_speed - arm_speed) * r_1 + (ring_speed - arm_speed) * outer).is_zero
    # virtual power for a turn of the carrier and for one of the sun: the ratios of the four angles
    with_carrier = (0, 1 + r_1 / r_2, 1 + r_1 / outer, 1)
    with_sun = (1, -r_1 / r_2, -r_1 / outer, 0)
    turned = [equations.on_shell(equations.rate(speed)) for speed in speeds]
    inertia = (*moments[:3], moments[3] + M * (r_1 + r_2) ** 2)
    for ratios, power in ((with_carrier, 0), (with_sun, tau)):
        terms = zip(inertia, turned, ratios, strict=True)
        assert (sum(one * rate * ratio for one, rate, ratio in terms) - power).is_zero


def test_gears_on_fixed_axles_exchange_one_tooth_force():
    a, b, tau = ph.symbols("a b tau", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    first, second = _wheel("first", alpha, "1"), _wheel("second", beta, "2", moment=k)
    system = ph.System(
        ph.Pivot(first, name="axle 1"),
        ph.Hinge(first, axis="z"),
        ph.Pivot(second, to=X * (a + b), name="axle 2"),
        ph.Hinge(second, axis="z"),
        ph.Gear(first, radius=a, to=second, other_radius=b, axis=Z),
        ph.Torque(first, Z * tau),
    )
    equations = ph.derive(system)
    assert (equations.kinetics.on_speeds(alpha.dt() * a + beta.dt() * b)).is_zero
    turned = tau / (J + k * a**2 / b**2)
    tooth = (J * turned - tau) / a  # J α̈ = τ + a F
    assert (equations.on_shell(equations.components["F_t_1"]) - tooth).is_zero


def test_pinion_rolling_along_a_fixed_rack_and_driving_a_sliding_one():
    theta = ph.coordinate("theta")
    pinion = _wheel("pinion", theta, "p")
    bar = ph.Body("bar", mass=m, inertia=(k, k, k), axes=LAB, tag="b")
    tau = ph.symbol("tau")
    driven = ph.derive(
        ph.System(
            *_turning(pinion),
            ph.Slider(bar, axis="x", to=Y * -R, name="guide"),
            ph.Rack(pinion, at=Y * -R, along=X, to=bar),
            ph.Torque(pinion, Z * tau),
        )
    )
    force = -tau * m * R / (J + m * R**2)
    assert (driven.on_shell(driven.components["F_t_p"]) - force).is_zero
    rolling = ph.derive(
        ph.System(
            ph.Pivot(pinion, only="y z", name="guide"),
            ph.Hinge(pinion, axis="z"),
            ph.Rack(pinion, at=Y * -R, along=X),
        )
    )
    assert (rolling.kinetics.on_speeds(ph.coordinate("x_p").dt() + R * theta.dt())).is_zero


def test_screw_under_its_weight():
    theta = ph.coordinate("theta")
    nut = _wheel("nut", theta, "", mass=m)
    equations = ph.derive(
        ph.System(
            ph.Pivot(nut, only="x y"),
            ph.Hinge(nut, axis="z"),
            ph.Screw(nut, axis=Z, pitch=h),
            ph.Gravity(g),
        )
    )
    lead = h / (2 * ph.pi)
    fall = -g * m * lead**2 / (J + m * lead**2)  # z̈ = lead θ̈
    found = equations.on_shell(equations.components["F_a"])
    assert (found - m * (g + fall)).is_zero
    reaction = equations.reactions["screw"]
    assert (equations.on_shell(reaction.couple.dot(Z)) + lead * found).is_zero


def test_bead_in_a_turning_guide_is_the_same_as_in_a_slot():
    turn = ph.coordinate("phi")
    groove = LAB.rotated(turn, "z")
    plate = ph.Body("plate", mass=M, inertia=(J, J, J), axes=groove, tag="p")
    block = ph.Body("block", mass=m, inertia=(k, k, k), axes=groove)
    held = (ph.Pivot(plate, name="axle"), ph.Hinge(plate, axis="z"))
    slider = ph.Slider(block, axis="x", along=groove, to=plate.point())
    equations = ph.derive(ph.System(*held, slider))
    # angular momentum (J + k + m s²) φ̇ is conserved, and s̈ = s φ̇²
    momentum = equations.angular_momentum().dot(Z)
    assert equations.on_shell(equations.rate(momentum)).is_zero
    s = ph.coordinate("s")
    assert (momentum - (J + k + m * s**2) * turn.dt()).is_zero
    assert (equations.on_shell(s.dt().dt()) - s * turn.dt() ** 2).is_zero
    torque = equations.reactions["slider"].couple.dot(Z)
    assert (equations.on_shell(torque - k * equations.on_shell(turn.dt().dt()))).is_zero


def test_chaplygin_sleigh():
    # Neimark and Fufaev, Dynamics of Nonholonomic Systems, ch. II § 3: with the edge at a
    # distance a behind the centre of mass, u̇ = a ω², (J + m a²) ω̇ = -m a u ω
    a = ph.symbol("a", positive=True)
    theta = ph.coordinate("theta")
    axes = LAB.rotated(theta, "z", labels="1 2 3")
    sleigh = ph.Body("sleigh", mass=m, inertia=(J, J, J), axes=axes)
    system = ph.System(
        ph.Pivot(sleigh, only="z", name="ice"),
        ph.Hinge(sleigh, axis="3"),
        ph.KnifeEdge(sleigh, across="2", at=axes["1"] * -a),
    )
    start = {"theta": 0.3, "theta_dot": 1.5, "x_dot": 0.7}
    run = ph.simulate(system, {"m": 2, "J": 0.5, "a": 0.4}, start, "2 s")
    speed = run["x_dot"] ** 2 + run["y_dot"] ** 2
    energy = speed + 0.25 * run["theta_dot"] ** 2
    assert abs(energy - energy[0]).max() < 1e-12
    # the solution u = a Ω tanh, ω = Ω k sech has (u/a)² + (1 + J/ma²) ω² constant and ω/u → 0
    along = run["x_dot"] * np.cos(run["theta"]) + run["y_dot"] * np.sin(run["theta"])
    conserved = along**2 + (0.5 / 2 + 0.16) * run["theta_dot"] ** 2
    assert abs(conserved - conserved[0]).max() < 1e-12
    assert run.drift.constraint < 1e-13


def test_claims_about_a_tension_are_confirmed_by_the_balance():
    equations = ph.derive(atwood())
    right = r"S_1 = \frac{m_1 g(2m_2 + J/R^2)}{m_1 + m_2 + J/R^2}"
    verdict = ph.check(right, equations)
    assert verdict.answer.value == "holds"
    wrong = ph.check(right.replace("2m_2", "m_2"), equations)
    assert wrong.answer.value == "fails"
    assert wrong.confirmation.agrees
    whole = r"\mathbf F_{\rm total} = \frac{d\mathbf P}{dt}"
    assert ph.check(whole, equations).answer.value == "holds"


OTHER = _wheel("other", 0, "o")
BETA = ph.coordinate("beta")
SPINNING = ph.Body("spinning", mass=m, inertia=(J, J, k), axes=LAB, spin=ph.About("z"))


@pytest.mark.parametrize(
    ("declare", "message"),
    [
        (lambda w: ph.Gear(w, radius=0, to=OTHER, other_radius=R, axis=Z), "radius"),
        (lambda w: ph.Gear(w, radius=R, to=w, other_radius=R, axis=Z), "itself"),
        (
            lambda w: ph.Gear(w, radius=R, to=_wheel("o", 0, "o"), other_radius=R, axis=Z * 2),
            "unit",
        ),
        (lambda w: ph.Screw(w, axis=Z, pitch=0), "pitch"),
        (lambda w: ph.Rope([w.point()]), "two points"),
        (lambda w: ph.Rope([X, Y]), "two points"),
        (lambda w: ph.Rope([w.point(), X], directions=[Z, Z]), "directions"),
        (lambda w: ph.Rack(w, at=X * 0, along=X), "radius to the pitch point"),
        (lambda w: ph.Rack(w, at=X * R, along=X), "perpendicular"),
        (lambda w: ph.KnifeEdge(w, across="q"), "direction"),
        (lambda w: ph.Gear(w, radius=ALPHA, to=OTHER, other_radius=R, axis=Z), "alpha"),
        (lambda w: ph.Gear(w, radius=R, to=None, other_radius=R, axis=Z), "expected a Body"),
        (lambda w: ph.Gear(w, radius=R, to=OTHER, other_radius=R, axis="z"), "expected a Vector"),
        (lambda w: ph.Screw(w, axis=Z, pitch=ALPHA.dt()), "alpha_dot"),
        (lambda w: ph.Rack(w, at=1, along=X), "expected a Vector"),
        (lambda w: ph.Rack(w, at=w.axes["y"] * R, along=w.axes["x"]), "alpha"),
        (lambda w: ph.Rack(w, at=Y * R, along=X, to=_wheel("r", BETA, "r")), "fixed in body 'r'"),
        (lambda w: ph.Gear(w, radius=R, to=OTHER, other_radius=R, axis=X), "fixed in body"),
        (lambda w: ph.Screw(w, axis=X, pitch=h), "fixed in body"),
        (lambda w: ph.KnifeEdge(SPINNING, across="x"), "fixed in body"),
        (lambda w: ph.Rope(w), "expected a Sequence"),
        (lambda w: ph.Rope([w.point(), X], directions=Z), "expected a Sequence"),
        (lambda w: ph.Rope([w.point(), w]), "expected a BodyPoint"),
    ],
)
def test_impossible_declarations_are_refused(declare, message):
    with pytest.raises(DeclarationError, match=message):
        declare(_wheel("wheel", ph.coordinate("alpha"), ""))


def test_wheels_too_far_apart_are_refused():
    alpha, beta = ph.coordinates("alpha beta")
    first, second = _wheel("first", alpha, "1"), _wheel("second", beta, "2")
    system = ph.System(
        ph.Pivot(first, name="1"),
        ph.Pivot(second, to=X * (3 * R), name="2"),
        ph.Gear(first, radius=R, to=second, other_radius=R, axis=Z),
    )
    with pytest.raises(DeclarationError, match="apart at right angles"):
        ph.derive(system)


def test_racks_that_cannot_mesh_are_refused():
    """A pinion that may leave the rack, one whose axis tilts, and a radius along its axis."""
    pinion = _wheel("pinion", ph.coordinate("theta"), "p")
    tilting = ph.Body(
        "tilting",
        mass=M,
        inertia=(J, J, J),
        axes=LAB.rotated(BETA, "x").rotated(ph.coordinate("theta"), "z"),
    )
    bar = ph.Body("bar", mass=m, inertia=(k, k, k), axes=LAB, tag="b")
    along_y = ph.Slider(bar, axis="y", to=Y * -R, name="guide")
    hinge = ph.Hinge(pinion, axis="z")
    for parts in (
        (ph.Pivot(pinion, only="z"), hinge, ph.Rack(pinion, at=Y * -R, along=X)),
        (ph.Pivot(pinion, only="x z"), hinge, ph.Rack(pinion, at=Y * -R, along=X)),
        (ph.Pivot(tilting, only="y z"), ph.Rack(tilting, at=Y * -R, along=X)),
        (ph.Pivot(pinion, only="y z"), hinge, ph.Rack(pinion, at=Z * R, along=X)),
        (*_turning(pinion), along_y, ph.Rack(pinion, at=Y * -R, along=X, to=bar)),
    ):
        with pytest.raises(DeclarationError, match="does not stay on the pitch line"):
            ph.derive(ph.System(*parts))


def test_contradictory_transmissions_are_named():
    theta = ph.coordinate("theta")
    nut = _wheel("nut", theta, "", mass=m)
    system = ph.System(
        ph.Pivot(nut, only="x y"),
        ph.Hinge(nut, axis="z"),
        ph.Screw(nut, axis=Z, pitch=h),
        ph.Motor(nut, axis="z", rate=1, relative_to=LAB),
        ph.Rope([nut.point(), Z * 5], directions=[Z]),
    )
    with pytest.raises(ConstraintError, match="contradict"):
        ph.derive(system)


def _balanced(equations):
    supplied = equations.on_shell(equations.power)
    return equations.on_shell(equations.rate(equations.energy) - supplied).is_zero


def test_screw_in_the_ground_of_the_turning_earth():
    """At rest in the laboratory it does not advance, although its nut turns in space."""
    (angle,) = ph.functions("f")
    ground = ph.earth(ph.symbol("Omega"), colatitude=0)
    theta, z = ph.coordinate("theta"), ph.coordinate("z")
    screw = ph.Body("screw", mass=m, inertia=(J, J, J), axes=ground.rotated(theta, "z"))
    nut = ph.Body("nut", mass=M, inertia=(k, k, k), axes=ground.rotated(angle, "z"), tag="n")
    held = (ph.Pivot(screw, only="x y"), ph.Hinge(screw, axis="z"), ph.Gravity(g))
    driven = (ph.Pivot(nut), ph.Hinge(nut, axis="z"), ph.Motor(nut, axis="z", rate=0))
    for to, carried, parts in ((None, 0, held), (nut, angle, held + driven)):
        thread = ph.Screw(screw, axis=ground["z"], pitch=h, to=to)
        equations = ph.derive(ph.System(*parts, thread))
        advance = z.dt() - (theta - carried).dt() * h / (2 * ph.pi)
        assert equations.kinetics.on_speeds(advance).is_zero
        assert _balanced(equations)


def test_a_straight_rope_over_an_eye_on_its_way():
    """It does not pull at a point where it is straight; the end may still be driven."""
    (lift,) = ph.functions("s")
    upper, lower = (ph.point_mass(n, mass=m, axes=LAB, tag=n) for n in "ul")
    guides = [ph.Pivot(b, only="x y", name=f"guide {b.name}") for b in (upper, lower)]
    for points in ([lower, upper], [upper, lower]):
        rope = ph.Rope([*(b.point() for b in points), Z * lift], directions=[Z, Z], tension="T")
        equations = ph.derive(ph.System(*guides, rope, ph.Gravity(g)))
        (tension,) = (v for name, v in equations.components.items() if name.startswith("T"))
        assert (tension - m * (g + lift.dt().dt())).is_zero
        assert _balanced(equations)
    nothing = ph.Rope([Z * 0, upper.point(), Z * lift], directions=[Z, Z])
    with pytest.raises(DeclarationError, match="pulls at no body"):
        ph.derive(ph.System(*guides, nothing, ph.Gravity(g)))


def test_ropes_that_would_not_keep_their_length_are_refused():
    (moved,) = ph.functions("s")
    load = ph.point_mass("load", mass=m, axes=LAB)
    beam = ph.Body("beam", mass=M, inertia=(J, J, J), axes=LAB, tag="b")
    askew = ph.Rope([load.point(), Z * h], directions=[X])
    with pytest.raises(DeclarationError, match="not along it"):
        ph.derive(ph.System(askew, ph.Gravity(g)))
    trolley = ph.Rope([load.point(), beam.point(X * moved)])
    with pytest.raises(DeclarationError, match="an end of 'rope'"):
        ph.derive(ph.System(ph.Weld(beam), trolley, ph.Gravity(g)))
    with pytest.raises(DeclarationError, match="on the way"):
        ph.Rope([X, beam.point(X * moved), load.point()])


def test_a_rope_that_is_not_where_its_guide_is_cannot_start():
    system = atwood()
    aside = ph.Pivot(system.body("left"), to=X * (-2 * R), only="x y", name="left guide")
    parts = [aside if part.name == aside.name else part for part in system.elements]
    numbers = {"M": 1, "J": 0.1, "R": 0.2, "m_1": 1, "m_2": 2, "g": 9.81}
    with pytest.raises(PolhodeError, match="closes"):
        ph.simulate(ph.System(*parts, *system.loads), numbers, {}, "1 s")


def test_slider_in_a_guide_that_turns_with_time():
    """A collar on a rod at a prescribed angle: s̈ = s Ω², and the rod drives it by 2m ṡ Ω."""
    (turn,) = ph.functions("f")
    guide = LAB.rotated(turn, "z")
    collar = ph.Body("collar", mass=m, inertia=(J, J, J), axes=guide)
    equations = ph.derive(ph.System(ph.Slider(collar, axis="x", along=guide)))
    s, rate = ph.coordinate("s"), turn.dt()
    assert (equations.on_shell(s.dt().dt()) - s * rate**2).is_zero
    assert (equations.components["F_y"] - m * (2 * s.dt() * rate + s * rate.dt())).is_zero
    assert (equations.components["tau_z"] - J * rate.dt()).is_zero
    assert _balanced(equations)


def test_slider_pushes_its_carriage_where_it_is():
    """The carriage is welded to the ground, which takes the moment of the weight at s."""
    carriage = ph.Body("carriage", mass=M, inertia=(J, J, J), axes=LAB, tag="c")
    block = ph.Body("block", mass=m, inertia=(k, k, k), axes=LAB)
    parts = (ph.Weld(carriage), ph.Slider(block, axis="x", to=carriage.point(X * R)))
    equations = ph.derive(ph.System(*parts, ph.Gravity(g)))
    assert (equations.components["tau_y_c"] + m * g * (R + ph.coordinate("s"))).is_zero


def test_sliders_whose_axes_are_not_those_of_the_guide_are_refused():
    groove = LAB.rotated(ALPHA, "z")
    plate = ph.Body("plate", mass=M, inertia=(J, J, J), axes=groove, tag="p")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    with pytest.raises(DeclarationError, match="axes of the guide"):
        ph.Slider(bead, axis="x", to=plate.point())
    with pytest.raises(DeclarationError, match="carries the guide"):
        ph.Slider(bead, axis="x", along=LAB, to=plate.point())


def test_two_sliders_have_coordinates_of_their_own():
    one, two = (ph.point_mass(name, mass=m, axes=LAB) for name in ("one", "two"))
    second = ph.Slider(two, axis="z", name="2", force="G", torque="T")
    system = ph.System(ph.Slider(one, axis="z", name="1"), second, ph.Gravity(g))
    with pytest.raises(DeclarationError, match="coordinate s of both 'one' and 'two'"):
        ph.derive(system)


def test_bevel_gears_are_refused_with_the_constraint_to_use():
    first = _wheel("first", ALPHA, "1")
    second = ph.Body("second", mass=m, inertia=(J, J, J), axes=LAB.rotated(BETA, "x"), tag="2")
    with pytest.raises(DeclarationError) as error:
        ph.Gear(first, radius=R, to=second, other_radius=h, axis=Z)
    assert "'R*alpha - h*beta = 0', on=(first, second), where={'R': R, 'h': h}" in str(error.value)


def test_a_rack_on_a_bar_that_is_guided_along_it_needs_no_couple():
    """T = ½ (J + M R²) φ̇²: the bar's own pivot keeps it on the pitch line."""
    pinion = ph.Body("pinion", mass=m, inertia=(J, J, J), axes=LAB.rotated(ALPHA, "y"), tag="p")
    bar = ph.point_mass("bar", mass=m, axes=LAB, tag="b")
    machine = ph.derive(
        ph.System(
            ph.Pivot(pinion, name="axle"),
            ph.Hinge(pinion, axis="y"),
            ph.Pivot(bar, to=Z * -R, only="y z", name="guide"),
            ph.Rack(pinion, at=Z * -R, along=X, to=bar),
            ph.Torque(pinion, Y * k),
        )
    )
    acceleration = machine.on_shell(ALPHA.dt().dt())
    assert acceleration == k / (J + m * R**2)
    assert machine.on_shell(machine.components["F_t_p"]) == m * R * acceleration
