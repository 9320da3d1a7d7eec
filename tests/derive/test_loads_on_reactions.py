"""Loads in proportion to reactions: friction, brakes and rolling resistance declared by hand."""

from math import cos, radians, sin

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph
from polhode.base import ConstraintError, DeclarationError, NumericError
from polhode.judge.balance._newton_euler import true_motion

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
m, J, R, L, F, c, e, d, a, g, mu, epsilon, w = ph.symbols(
    "m J R L F c e d a g mu epsilon w", positive=True
)
NORMAL = ph.reaction("F_z")


def _block(law, *, axes=LAB):
    """A block on a straight rail, under its weight and a force along the rail."""
    block = ph.point_mass("block", mass=m, axes=axes)
    rail = ph.Slider(block, axis="x", along=axes, name="rail")
    return ph.System(rail, ph.Gravity(g), ph.Force(block.point(), axes["x"] * law, name="friction"))


def test_a_block_that_slides_down_an_incline():
    # s̈ = g (sin ε - μ cos ε): Kleppner and Kolenkow, An Introduction to Mechanics, sec. 2.5
    equations = ph.derive(_block(-mu * NORMAL, axes=LAB.rotated(epsilon, "y")))
    s = ph.coordinate("s")
    down = g * (ph.sin(epsilon) - mu * ph.cos(epsilon))
    assert (equations.on_shell(s.dt().dt()) - down).is_zero
    assert (equations.components["F_z"] - m * g * ph.cos(epsilon)).is_zero
    assert (equations.load_power("friction") + mu * m * g * ph.cos(epsilon) * s.dt()).is_zero
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)
    assert (
        ph.check(r"\ddot s = g(\sin\epsilon - \mu\cos\epsilon)", equations).answer.value == "holds"
    )
    wrong = ph.check(r"\ddot s = g(\sin\epsilon + \mu\cos\epsilon)", equations)
    assert wrong.answer.value == "fails"
    assert wrong.confirmation.agrees


def test_dry_friction_of_either_direction_stops_the_block_and_holds_it():
    v = ph.coordinate("s").dt()
    system = _block(-mu * NORMAL * v / ph.absolute(v))
    run = ph.simulate(system, {"m": 2, "g": 9.81, "mu": 0.3}, {"s_dot": 1}, "1 s")
    assert [event.kind for event in run.events] == ["start", "stays zero", "end"]
    assert run.events[1].time == pytest.approx(1 / (0.3 * 9.81), rel=1e-12)
    assert run.final["s"] == pytest.approx(1 / (2 * 0.3 * 9.81), rel=1e-12)


def _brake(drag, *, reach=c):
    """A lever presses its shoe on a drum; `drag` is the direction of the friction on the shoe."""
    drum = ph.Body("drum", mass=m, inertia=(J,) * 3, axes=LAB.rotated(ph.coordinate("phi"), "z"))
    lever = ph.Body("lever", mass=m, inertia=(J,) * 3, axes=LAB, tag="l")
    shoe, normal = X * reach - Y * e, ph.reaction("N_y_l")
    return ph.System(
        ph.Pivot(drum, to=shoe - Y * R, name="axle"),
        ph.Hinge(drum, axis="z", name="drum hinge"),
        ph.Pivot(lever, name="pin", force="P"),
        ph.Hinge(lever, axis="z", name="hinge", torque="sigma"),
        ph.Hold(lever, at=shoe, only="y", name="shoe", force="N"),
        ph.Force(lever.point(X * L), Y * -F, name="hand"),
        ph.Force(lever.point(shoe), X * (drag * mu * normal), name="drag"),
        ph.Torque(drum, Z * (drag * mu * R * normal), name="brake"),
    )


@pytest.mark.parametrize("drag", [1, -1])
def test_a_brake_whose_friction_helps_or_hinders_the_hand(drag):
    # Moments about the pin: N c + drag μ N e = F L. J. E. Shigley, Mechanical Engineering Design,
    # ch. 16: self-energising where the moment of the friction helps that of the hand.
    equations = ph.derive(_brake(drag))
    normal = F * L / (c + drag * mu * e)
    assert (equations.components["N_y_l"] - normal).is_zero
    turning = equations.on_shell(ph.coordinate("phi").dt().dt())
    assert (turning - drag * mu * R * normal / J).is_zero
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_a_brake_that_locks_itself_is_named():
    with pytest.raises(ConstraintError, match=r"N_y_l.*no finite reactions.*locks"):
        ph.derive(_brake(-1, reach=mu * e))
    numbers = {"J": 1, "L": 1, "F": 10, "R": 0.3, "mu": 0.5, "c": 0.25, "e": 0.5}
    with pytest.raises(NumericError, match=r"no finite solution.*friction locks"):
        ph.simulate(_brake(-1), numbers, {"phi_dot": 3}, 1)


def test_rolling_resistance():
    """A couple d N against the rotation: v̇ = -(5/7) g d/a for a ball on level ground."""
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    resistance = ph.Torque(ball, Y * (-d * NORMAL), name="rolling resistance")
    equations = ph.derive(ph.System(ph.Rolling(ball, on=ph.Plane(LAB)), resistance, ph.Gravity(g)))
    braked = equations.on_shell(ph.speed("v_x").dt())
    assert (braked + 5 * g * d / (7 * a)).is_zero
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_friction_by_hand_is_that_of_a_coulomb_contact():
    """A ball slipping along x: its friction as a load on a smooth contact, and by Coulomb's law."""
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    ground = ph.Plane(LAB)
    touching = ph.Force(ball.point(Z * -a), X * (-mu * NORMAL), name="friction")
    by_hand = ph.derive(ph.System(ph.Smooth(ball, on=ground), touching, ph.Gravity(g)))
    sliding = ph.derive(ph.System(ph.Coulomb(ball, on=ground, mu=mu), ph.Gravity(g)))
    v_x, v_y, *spins = ph.speeds("v_x v_y omega_x omega_y omega_z")
    along_x = {v_y: 0, v_x: 2, **dict.fromkeys(spins, 0)}
    for speed in (v_x, v_y, *spins):
        found, expected = (eq.on_shell(speed.dt()).subs(along_x) for eq in (by_hand, sliding))
        assert (found - expected).is_zero


def _cart():
    """A pendulum on a block: the normal force of the rail depends on accelerations."""
    theta = ph.coordinate("theta")
    block = ph.point_mass("block", mass=m, axes=LAB)
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(theta, "y"), tag="b")
    v = ph.speed("v_x")
    return ph.System(
        ph.Pivot(block, only="y z", name="rail"),
        ph.Pivot(bob, at=bob.axes["z"] * L, to=block.point(), name="string", force="S"),
        ph.Gravity(g),
        ph.Force(block.point(), X * (-mu * NORMAL * ph.tanh(v / w)), name="friction"),
    )


def test_a_normal_force_that_depends_on_accelerations():
    """Against Newton's laws for both masses, written out and solved by numbers."""
    system = _cart()
    equations = ph.derive(system)
    numbers = {"m": 1.5, "L": 0.7, "g": 9.81, "mu": 0.4, "w": 1}
    state = {"x": 0.2, "y": 0, "z": 0, "theta": 0.6, "v_x": 0.8, "theta_dot": -1.3}
    run = ph.simulate(system, numbers, {k: v for k, v in state.items() if k not in "yz"}, 1e-9)
    # unknowns ẍ, θ̈, S (tension), N with bob at (x - L sin θ, -L cos θ)
    t, rate, drag = 0.6, -1.3, 0.4 * np.tanh(0.8)
    rows = np.array(
        [
            [1.5, 0, np.sin(t), drag],
            [0, 0, -np.cos(t), 1],
            [1.5, -1.5 * 0.7 * np.cos(t), -np.sin(t), 0],
            [0, 1.5 * 0.7 * np.sin(t), -np.cos(t), 0],
        ]
    )
    weight = 1.5 * 9.81
    right = [
        0,
        weight,
        -1.5 * 0.7 * np.sin(t) * rate**2,
        -weight - 1.5 * 0.7 * np.cos(t) * rate**2,
    ]
    expected = np.linalg.solve(rows, right)
    assert run["F_z"][0] == pytest.approx(expected[3], rel=1e-12)
    symbols = {s.published: s for s in (*equations.coordinates, *equations.speeds)}
    known = {symbols[name]: float(value) for name, value in state.items() if name in symbols}
    known |= {p: numbers[p.published] for p in equations.parameters}
    found = {s.published: v for s, v in true_motion(system, known).items()}
    assert found["v_x_dot"] == pytest.approx(expected[0], rel=1e-9)
    assert found["theta_ddot"] == pytest.approx(expected[1], rel=1e-9)
    assert found["F_z"] == pytest.approx(expected[3], rel=1e-9)
    swung = ph.simulate(system, numbers, {"theta": 1, "v_x": 1}, "2 s")
    assert swung.drift.energy < 1e-13


def test_a_load_vanishes_while_the_contact_is_open_and_its_impact_is_refused():
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    touching = ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3)
    resistance = ph.Torque(ball, Y * (-d * NORMAL), name="rolling resistance")
    system = ph.System(touching, resistance, ph.Gravity(g))
    numbers = {"m": 1, "a": 0.1, "g": 9.81, "d": 1e-3}
    flight = ph.simulate(system, numbers, {"z": 1, "v_x": 1, "omega_y": 5}, 0.3)
    assert flight.final["omega_y"] == 5
    assert flight.final["mode"] == "flight"
    with pytest.raises(NumericError, match=r"an impact of contact.*in proportion to F_z"):
        ph.simulate(system, numbers, {"z": 1}, 1)


def test_a_mass_matrix_that_jumps_with_the_friction_is_named():
    v = ph.speed("v_x")
    system = _cart()
    block = system.body("block")
    law = ph.Force(block.point(), X * (-mu * NORMAL * v / ph.absolute(v)), name="dry")
    loads = [load for load in system.loads if load.name != "friction"]
    dry = ph.System(*system.elements, *loads, law)
    numbers = {"m": 1, "L": 1, "g": 9.81, "mu": 0.3}
    with pytest.raises(NumericError, match="mass matrix that jumps where v_x is zero"):
        ph.simulate(dry, numbers, {"theta": 1, "v_x": 1}, 2)


BOB = ph.point_mass("bob", mass=m, axes=LAB)
GUIDE = ph.Pivot(BOB, only="y z", name="guide")
OTHERS = (ph.reaction("F_y"), NORMAL)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        (ph.Force(BOB.point(), X * ph.reaction("F_q")), "F_q; expected one of the reactions F_y"),
        (ph.Force(BOB.point(), X * NORMAL.dt()), "F_z_dot"),
        (ph.Force(BOB.point(), X * ph.absolute(NORMAL)), "not linear in the reaction F_z"),
        (ph.Force(BOB.point(), X * NORMAL**2), "not linear"),
        (ph.Force(BOB.point(), X * ph.sqrt(OTHERS[0] ** 2 + OTHERS[1] ** 2)), "not linear"),
        (ph.Force(BOB.point(X * NORMAL), X), "not linear"),
        (ph.Gravity(NORMAL), "reaction F_z, on which"),
        (ph.Spring(BOB.point(), X, stiffness=NORMAL), "reaction F_z, on which"),
        (ph.Force(BOB.point(), Z * -NORMAL), "in proportion to F_z, which the balances"),
    ],
)
def test_loads_that_cannot_be_are_refused(load, words):
    with pytest.raises((DeclarationError, ConstraintError), match=words):
        ph.derive(ph.System(GUIDE, load))


def test_a_reaction_that_is_not_determined_makes_no_load():
    """A bar on two pins: their forces along it are undetermined, and so is friction from them."""
    bar = ph.rod("bar", mass=m, length=2 * a, axes=LAB)
    pins = [
        ph.Pivot(bar, at=X * (s * a), to=X * (s * a), name=f"pin {s}", force=f)
        for s, f in ((1, "P"), (-1, "Q"))
    ]
    turn = ph.coordinate("phi")
    wheel = ph.Body("wheel", mass=m, inertia=(J,) * 3, axes=LAB.rotated(turn, "z"), tag="w")
    axle = (ph.Pivot(wheel, to=Y * R, name="axle"), ph.Hinge(wheel, axis="z", torque="sigma"))
    brake = ph.Torque(wheel, Z * (-mu * R * ph.reaction("P_x")), name="brake")
    with pytest.raises(ConstraintError, match="in proportion to P_x"):
        ph.derive(ph.System(*pins, *axle, brake, ph.Gravity(g)))


def test_units_of_the_factors_are_known():
    dimensions = ph.derive(_block(-mu * NORMAL)).dimensions
    known = {symbol.published: str(found) for symbol, found in dimensions.items()}
    assert known["mu"] == "1"
    viscous = ph.derive(_block(-d * ph.coordinate("s").dt())).dimensions
    assert {s.published: str(x) for s, x in viscous.items()}["d"] == "kg/s"


def test_an_incline_by_numbers():
    system = _block(-mu * NORMAL, axes=LAB.rotated(epsilon, "y"))
    numbers = {"m": 3, "g": 9.81, "epsilon": "20 deg", "mu": 0.1}
    run = ph.simulate(system, numbers, {}, "1 s")
    tilt = radians(20)
    assert run.final["s"] == pytest.approx(9.81 * (sin(tilt) - 0.1 * cos(tilt)) / 2, rel=1e-13)


# -- a body that turns about all axes --------------------------------------------------------------

GYRO = {"m": 0.5, "a": 0.06, "g": 9.81, "A": 6.25e-4, "B": 8e-4, "C": 3.5e-4, "d": 1.2e-3}
ANGLES = {"phi": 0.2, "theta": 0.5, "psi": 0.1}


def _braked_gyro(spin):
    """An asymmetric top on its tip, braked about the vertical in proportion to its support."""
    A, B, C = ph.symbols("A B C", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("top", mass=m, inertia=(A, B, C), axes=axes, spin=spin)
    pivot = ph.Pivot(body, at=axes["3"] * -a)
    return ph.System(pivot, ph.Gravity(g), ph.Torque(body, Z * (-d * NORMAL), name="brake"))


def _turned(phi, theta, psi):
    def about(i, j, angle):
        matrix = np.eye(3)
        matrix[i, i] = matrix[j, j] = np.cos(angle)
        matrix[i, j], matrix[j, i] = -np.sin(angle), np.sin(angle)
        return matrix

    return about(0, 1, phi) @ about(1, 2, theta) @ about(0, 1, psi)


def _cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def _braked_by_matrices(spin, duration):
    """The rotation matrix from Newton's and Euler's six equations for ω̇ and the force at the tip.

    Args:
        spin: components along the body's axes at the start, rad/s.
    """
    value, vertical = GYRO, np.array([0.0, 0.0, 1.0])

    def rates(t, y):
        turn, spin = y[:9].reshape(3, 3), y[9:]
        inertia = turn @ np.diag([value[name] for name in "ABC"]) @ turn.T
        omega, arm = turn @ spin, turn[:, 2] * value["a"]
        matrix, right = np.zeros((6, 6)), np.zeros(6)
        # m (ω̇ × r + ω × (ω × r)) = F - m g z
        matrix[:3, :3], matrix[:3, 3:] = -value["m"] * _cross(arm), -np.eye(3)
        right[:3] = -value["m"] * (value["g"] * vertical + np.cross(omega, np.cross(omega, arm)))
        # I ω̇ + ω × I ω = -r × F - d F_z z
        matrix[3:, :3] = inertia
        matrix[3:, 3:] = _cross(arm) + value["d"] * np.outer(vertical, vertical)
        right[3:] = -np.cross(omega, inertia @ omega)
        turning = np.linalg.solve(matrix, right)[:3]
        return np.concatenate([(turn @ _cross(spin)).ravel(), turn.T @ turning])

    start = np.concatenate([_turned(*ANGLES.values()).ravel(), spin])
    found = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=3e-14, atol=1e-15)
    return found.y[:9, -1].reshape(3, 3)


def _spin_of(turning):
    """Components of the angular velocity along the body's axes, from rates at the start."""
    phi, theta, psi = turning.values()
    node = _turned(0, 0, ANGLES["psi"]).T @ np.array([theta, 0.0, 0.0])
    vertical = _turned(*ANGLES.values())[2]
    return phi * vertical + node + np.array([0.0, 0.0, psi])


@pytest.mark.parametrize("spin", [ph.WithAxes(), ph.Components()], ids=["rates", "components"])
def test_a_braked_body_turns_through_gimbal_lock_and_every_heading(spin):
    """Its heading passes 90° and its axle the vertical, where no balance may be divided by zero."""
    turning = {"phi_dot": 1e-4, "theta_dot": -9.0, "psi_dot": 4.0}
    run = ph.simulate(_braked_gyro(spin), GYRO, ANGLES | turning, "0.5 s")
    exact = _braked_by_matrices(_spin_of(turning), 0.5)
    found = _turned(*(run.final[name] for name in ANGLES))
    assert found == pytest.approx(exact, abs=1e-11)
    assert run["phi"].min() < -np.pi / 2
    assert np.abs(np.sin(run["theta"])).min() < 0.02
    assert not run.doubt


def test_a_bead_that_rubs_on_a_curved_wire():
    """On z = x²/2b: s̈ = −g sin α − μ (g cos α + v²/ρ), while it moves to the right."""
    x, z = ph.coordinates("x z")
    b = ph.symbol("b", positive=True)
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    Q = ph.reaction("Q")  # along (−x/b, 1): the wire pushes with N = Q √(1 + x²/b²)
    rubs = ph.Force(bead.point(), (X + Z * (x / b)) * (-mu * Q), name="friction")
    wire = ph.Constraint(z - x**2 / (2 * b), on=bead, name="wire")
    system = ph.System(ph.Pivot(bead, only="y"), wire, rubs, ph.Gravity(g))
    numbers = {m: 1.5, b: 2, mu: 0.1, g: 9.81}
    run = ph.simulate(system, numbers, {"x": -2, "v_x": 0.1}, 0.8)

    def laws(place, speed):
        slope = place / 2
        longer = np.hypot(1, slope)
        normal = (9.81 + speed**2 / 2) / longer  # per mass; 1/ρ = (1/b)/longer³, v = longer ẋ
        along = -9.81 * slope / longer - 0.1 * normal
        return (along - slope * speed**2 / 2 / longer) / longer, 1.5 * normal / longer

    found = solve_ivp(
        lambda t, y: (y[1], laws(*y)[0]), (0, 0.8), (-2, 0.1), rtol=1e-12, atol=1e-13
    ).y[:, -1]
    assert [run.final["x"], run.final["v_x"]] == pytest.approx(found, abs=1e-9)
    assert run.final["Q"] == pytest.approx(laws(*found)[1], abs=1e-8)
    held = ph.Pivot(bead, to=X * x + Z * (x**2 / (2 * b)))
    size = (ph.reaction("F_z") - ph.reaction("F_x") * x / b) / (1 + x**2 / b**2)
    pushed = ph.Force(bead.point(), (X + Z * (x / b)) * (-mu * size), name="friction")
    with pytest.raises(ConstraintError, match="declare the curve as a Constraint"):
        ph.derive(ph.System(held, pushed, ph.Gravity(g)))
