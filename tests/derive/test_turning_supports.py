"""Points held along directions that turn: slots, rods and walls, against their known equations."""

from functools import cache

import numpy as np
import pytest

import polhode as ph
from derive.declarations import LAB, a, g, m
from derive.states import Numeric, agree, draw, value
from polhode.derive import Equations

seeds = pytest.mark.parametrize("seed", range(4))
J, M, length, tau = ph.symbols("J M l tau", positive=True)
Omega, colatitude = ph.symbols("Omega lambda_", positive=True)
phi, s = ph.coordinates("phi s")
TURNED = LAB.rotated(phi, "z")
DRIVEN = LAB.rotated(Omega * ph.time, "z")


def balanced(equations: Equations) -> bool:
    return equations.rate(equations.energy) == equations.on_shell(equations.power)


# -- a slot in a body that turns freely ------------------------------------------------------------


@cache
def bead_in_a_slot() -> Numeric:
    """A bead on a rod that a torque turns about the vertical."""
    rod = ph.Body("rod", mass=M, inertia=(J, J, J), axes=TURNED, tag="r")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    slot = ph.Pivot(bead, to=rod.point(), along=TURNED, only="y z", name="slot")
    axle = (ph.Pivot(rod, along=TURNED, name="axle", force="A"), ph.Hinge(rod, axis="z"))
    return Numeric(ph.derive(ph.System(*axle, slot, ph.Torque(rod, LAB["z"] * tau))))


@cache
def slot_over_a_pin() -> Numeric:
    """The same with the bead at rest: a rod in a plane slides over a pin at the origin."""
    rod = ph.Body("rod", mass=m, inertia=(J, J, J), axes=TURNED)
    slot = ph.Pivot(rod, along=TURNED, only="y z", name="slot")
    turned = ph.Torque(rod, LAB["z"] * tau)
    return Numeric(ph.derive(ph.System(slot, ph.Hinge(rod, axis="z"), turned)))


@seeds
@pytest.mark.parametrize("declared", [bead_in_a_slot, slot_over_a_pin])
def test_a_slot_that_turns(declared, seed: int) -> None:
    """(J + m s²) φ̈ = τ - 2 m s ṡ φ̇, s̈ = s φ̇², and the slot pushes with m (s φ̈ + 2 ṡ φ̇)."""
    state = draw("m M J tau phi phi_dot g", seed)
    out, rate = 0.5 + 0.3 * seed, 0.7 - seed
    turn, spin, mass = state["phi"], state["phi_dot"], state["m"]
    along, across = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    place, velocity = out * along, rate * along + out * spin * across
    state |= {"x": place[0], "y": place[1], "z": 0.0, "v_x": velocity[0], "v_y": velocity[1]}
    state |= {"x_r": 0.0, "y_r": 0.0, "z_r": 0.0}
    found = declared().at(**state)
    swing = (state["tau"] - 2 * mass * out * rate * spin) / (state["J"] + mass * out**2)
    push = mass * (out * swing + 2 * rate * spin)
    gained = push / mass * across
    expected = {"phi_ddot": swing, "v_x_dot": gained[0], "v_y_dot": gained[1]}
    expected |= {"F_y": push, "F_z": 0.0, "A_y_r": push, "A_x_r": 0.0}
    agree(found, expected, [name for name in expected if name in found], 1e-9)
    for gap in declared().equations.closures:
        assert value(gap, state) == pytest.approx(0, abs=1e-14)
    assert found["T_dot"] == pytest.approx(state["tau"] * spin)


# -- along directions that turn as given -----------------------------------------------------------


@cache
def bead_on_a_driven_rod() -> Numeric:
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    wire = ph.Pivot(bead, along=DRIVEN, only="y z", name="wire")
    return Numeric(ph.derive(ph.System(wire, ph.Gravity(g))))


@seeds
def test_a_bead_on_a_rod_that_is_driven_round(seed: int) -> None:
    """s̈ = Ω² s, and the rod pushes with 2 m Ω ṡ."""
    state = draw("m g Omega t", seed)
    out, rate, turn, spin = 1.3, -0.4 * seed, state["Omega"] * state["t"], state["Omega"]
    along, across = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
    place, velocity = out * along, rate * along + out * spin * across
    state |= {"x": place[0], "y": place[1], "z": 0.0, "v_x": velocity[0], "v_y": velocity[1]}
    found = bead_on_a_driven_rod().at(**state)
    push = 2 * state["m"] * spin * rate
    rates = push / state["m"] * across
    expected = {"v_y_dot": rates[1], "F_y": push, "F_z": state["m"] * state["g"]}
    agree(found, expected, expected, 1e-9)


def test_the_same_bead_by_its_place_along_the_rod() -> None:
    bead = ph.point_mass("bead", mass=m, axes=DRIVEN)
    wire = ph.Pivot(bead, to=DRIVEN["x"] * s, along=DRIVEN)
    equations = ph.derive(ph.System(wire, ph.Gravity(g)))
    assert equations.motion == (s.dt().dt() - Omega**2 * s,)
    assert equations.components["F_y"] == 2 * m * Omega * s.dt()
    assert equations.on_shell(equations.components["F_x"]).is_zero
    assert balanced(equations)


GROUND = ph.earth(Omega, colatitude=colatitude)
HELD = [
    lambda p: ph.Pivot(p, only="z", name="wall"),
    lambda p: ph.Hold(p, at=GROUND.zero, only="z", name="wall", force="F"),
    lambda p: ph.Smooth(p, on=ph.Plane(GROUND), name="wall"),
]


@seeds
@pytest.mark.parametrize("held", HELD)
def test_a_point_kept_at_a_height_over_the_turning_ground(held, seed: int) -> None:
    """m a = F + m g - 2 m Ω × v - m Ω × (Ω × r) as seen from the ground, with ż = 0."""
    puck = ph.Body("puck", mass=m, axes=GROUND, surface=ph.Face(0))
    equations = ph.derive(ph.System(held(puck), ph.Gravity(g)))
    state = draw("m g Omega lambda_ x y v_x v_y", seed, z=0.0, v_z=0.0)
    spin = state["Omega"] * np.array([0, np.sin(state["lambda_"]), np.cos(state["lambda_"])])
    place = np.array([state["x"], state["y"], 0.0])
    velocity = np.array([state["v_x"], state["v_y"], 0.0])
    seen = -2 * np.cross(spin, velocity) - np.cross(spin, np.cross(spin, place))
    found = Numeric(equations).at(**state)
    expected = {"v_x_dot": seen[0], "v_y_dot": seen[1]}
    expected["F_z"] = state["m"] * (state["g"] - seen[2])
    expected |= {"x_dot": state["v_x"], "y_dot": state["v_y"], "z_dot": 0.0}
    agree(found, expected, [name for name in expected if name in found])


def test_a_plane_that_turns_may_be_declared_by_its_normal_or_by_its_frame() -> None:
    """A guide keeps an axle in a vertical plane that is driven round."""
    theta, psi = ph.coordinates("theta psi")
    axes = LAB.rotated(psi, "z").rotated(theta, "x", labels="1 2 3")
    rotor = ph.Body("rotor", mass=m, inertia=(J, J, M), axes=axes, spin=ph.About("3", "chi"))
    turn = Omega * ph.time
    normals = (DRIVEN["x"], LAB.vector(ph.cos(turn), ph.sin(turn), 0))
    first, second = (
        ph.derive(ph.System(ph.Pivot(rotor), ph.Guide(rotor, axis="3", normal=normal, label="q")))
        for normal in normals
    )
    assert first.dependent == second.dependent
    assert first.rows == second.rows
    assert first.components == second.components
    # Where the axle is in the plane it goes round with it: ψ = Ω t, ψ̇ = Ω.
    (spin,) = (rate for symbol, rate in first.dependent.items() if symbol.published == "psi_dot")
    there = {psi: turn}
    assert spin.subs(there) == Omega


# -- places that a body moves by itself ------------------------------------------------------------


def test_a_bob_on_a_light_rod_by_its_place_is_a_pendulum() -> None:
    axes = LAB.rotated(-phi, "y")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    by_place = ph.Pivot(bob, to=axes["z"] * -length, along=axes)
    by_point = ph.Pivot(bob, at=axes["z"] * length, along=axes)
    placed, known = (ph.derive(ph.System(pivot, ph.Gravity(g))) for pivot in (by_place, by_point))
    assert placed.accelerations == known.accelerations
    assert placed.on_shell(placed.components["F_x"]).is_zero
    pull = m * g * ph.cos(phi) + m * length * phi.dt() ** 2
    assert placed.on_shell(placed.components["F_z"]) == pull
    assert known.on_shell(known.components["F_z"]) == pull
    assert balanced(placed)


def test_what_hangs_on_such_a_bob_is_carried_too() -> None:
    theta = ph.coordinate("theta")
    upper, lower = LAB.rotated(-phi, "y"), LAB.rotated(-theta, "y")
    first = ph.point_mass("first", mass=m, axes=upper)
    second = ph.point_mass("second", mass=M, axes=lower, tag="2")
    string = ph.Pivot(second, at=lower["z"] * a, to=first.point(), along=lower, name="string")
    by_place = ph.Pivot(first, to=upper["z"] * -length, along=upper)
    by_point = ph.Pivot(first, at=upper["z"] * length, along=upper)
    placed, known = (
        ph.derive(ph.System(pivot, string, ph.Gravity(g))) for pivot in (by_place, by_point)
    )
    assert placed.accelerations == known.accelerations
    for name in ("F_x", "F_z", "F_z_2"):
        assert placed.on_shell(placed.components[name]) == known.on_shell(known.components[name])
    assert balanced(placed)


def test_a_spring_on_a_ring_that_runs_along_a_rail() -> None:
    """Only the stretch across the rail is felt: its end follows the bob along the rail."""
    bob = ph.point_mass("bob", mass=m, axes=LAB)
    spring = ph.Spring(bob.point(), LAB["x"] * ph.coordinate("x"), stiffness=tau)
    equations = ph.derive(ph.System(spring))
    rates = {symbol.published: value for symbol, value in equations.accelerations.items()}
    assert rates["v_y_dot"] == -tau * ph.coordinate("y") / m
    assert rates["v_x_dot"].is_zero
    assert balanced(equations)
