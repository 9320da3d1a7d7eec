"""Joints in small machines against their closed forms, and what redundant ones leave open."""

from functools import cache
from math import atan2, cos, sin

import pytest

import polhode as ph
from derive.declarations import LAB, a, g, m
from derive.states import Numeric, agree, draw
from polhode.derive import Equations

seeds = pytest.mark.parametrize("seed", range(6))
h, length = ph.symbols("h l", positive=True)


# -- Hooke's joint ---------------------------------------------------------------------------------


@cache
def hooke_joint() -> Numeric:
    """Two shafts at an angle beta, with flywheels J_1 and J_2 and driving torques N_1 and N_2."""
    turns, bent = ph.coordinates("theta_1 theta_2"), LAB.rotated(ph.symbol("beta"), "z")
    shafts = [
        ph.Body(
            f"shaft {tag}",
            mass=m,
            inertia=(ph.symbol(f"J_{tag}"), ph.symbol("K"), ph.symbol("K")),
            axes=ground.rotated(turn, "x"),
            tag=tag,
        )
        for tag, ground, turn in zip("12", (LAB, bent), turns, strict=True)
    ]
    first, second = shafts
    cross = ph.Universal(
        second, arm=second.axes["z"], other_arm=first.axes["y"], to=first, torque="C"
    )
    drives = [
        ph.Torque(shaft, shaft.axes["x"] * ph.symbol(f"N_{shaft.tag[1:]}"), name=shaft.name)
        for shaft in shafts
    ]
    bearings = [part for s in shafts for part in (ph.Pivot(s), ph.Hinge(s, axis="x"))]
    system = ph.System(*bearings, cross, *drives, independent=(turns[0].dt(),))
    return Numeric(ph.derive(system))


@seeds
def test_hooke_joint(seed: int) -> None:
    """tan θ₁ = cos β tan θ₂, differentiated twice; energy; and the couple that turns shaft 2."""
    state = draw("J_1 J_2 K m N_1 N_2 theta_1 theta_1_dot", seed, beta=0.3 + 0.1 * seed)
    turn, rate, bend = state["theta_1"], state["theta_1_dot"], state["beta"]
    state["theta_2"] = atan2(sin(turn), cos(bend) * cos(turn))
    below = 1 - (sin(bend) * cos(turn)) ** 2
    ratio = cos(bend) / below
    slope = -ratio * 2 * sin(bend) ** 2 * cos(turn) * sin(turn) / below
    inertia = state["J_1"] + ratio**2 * state["J_2"]
    drive = state["N_1"] + ratio * state["N_2"]
    acceleration = (drive - state["J_2"] * ratio * slope * rate**2) / inertia
    follows = ratio * acceleration + slope * rate**2
    found = hooke_joint().at(**state)
    expected = {"theta_2_dot": ratio * rate, "theta_2_ddot": follows, "theta_1_ddot": acceleration}
    agree(found, expected, expected, tolerance=1e-11)
    # The couple is along the normal of the cross, which a turn of shaft 2 about its axis meets.
    arm_1 = (0, cos(turn), sin(turn))
    arm_2 = (sin(bend) * sin(state["theta_2"]), -cos(bend) * sin(state["theta_2"]),
             cos(state["theta_2"]))  # fmt: skip
    normal = (arm_2[1] * arm_1[2] - arm_2[2] * arm_1[1], arm_2[2] * arm_1[0] - arm_2[0] * arm_1[2])
    along = normal[0] * cos(bend) + normal[1] * sin(bend)
    couple = (state["J_2"] * follows - state["N_2"]) / along
    agree(found, {"C_cross_2": couple}, ["C_cross_2"], tolerance=1e-11)
    driven = state["N_1"] * rate + state["N_2"] * ratio * rate
    agree(found, {"power": driven, "T_dot": driven}, ["power", "T_dot"], tolerance=1e-11)


# -- redundant joints ------------------------------------------------------------------------------


def door(*more: str) -> Equations:
    """A door of height h on pivots at top and bottom, and perhaps a hinge besides."""
    axes = LAB.rotated(ph.coordinates("theta")[0], "z")
    plate = ph.Body("door", mass=m, inertia=ph.symbols("A B C"), axes=axes)
    edge, up = axes["x"] * -a, axes["z"] * (h / 2)
    joints = {
        "bottom": ph.Pivot(plate, at=edge - up, to=LAB["z"] * (-h / 2), along=axes, name="bottom"),
        "top": ph.Pivot(
            plate, at=edge + up, to=LAB["z"] * (h / 2), along=axes, name="top", force="G"
        ),
        "hinge": ph.Hinge(plate, axis="z"),
    }
    return ph.derive(ph.System(*(joints[name] for name in ("bottom", *more)), ph.Gravity(g)))


def test_a_door_on_two_pivots_leaves_open_which_bears_its_weight() -> None:
    equations = door("top")
    assert set(equations.undetermined) == {"F_z", "G_z"}
    assert equations.components["F_z"] + equations.components["G_z"] == m * g
    assert equations.least["F_z"] == equations.least["G_z"] == m * g / 2
    assert equations.components["F_x"] + equations.components["G_x"] == push(equations)
    assert equations.components["F_x"] - equations.components["G_x"] == 2 * m * g * a / h
    assert equations.reactions["top"].undetermined == ("G_z",)
    assert str(equations.reactions["top"]).startswith("Reaction of 'top' on 'door': force (")
    assert str(equations.reactions["top"]).endswith("; not determined: G_z")


def push(equations: Equations) -> ph.Expr:
    """Centripetal force on the door."""
    return -m * a * ph.coordinates("theta")[0].dt() ** 2


def test_with_a_hinge_besides_hardly_any_reaction_is_determined() -> None:
    equations = door("top", "hinge")
    assert set(equations.undetermined) == {
        "F_x", "F_y", "F_z", "G_x", "G_y", "G_z", "tau_x", "tau_y",
    }  # fmt: skip
    assert equations.rows == door("top").rows == door("hinge").rows
    least, forced = equations.least, door("hinge").components
    assert least["F_x"] + least["G_x"] == forced["F_x"]
    assert least["F_z"] + least["G_z"] == forced["F_z"] == m * g


def test_a_hinge_and_one_pivot_determine_every_reaction() -> None:
    equations = door("hinge")
    assert equations.undetermined == ()
    assert equations.least == equations.components
    spin = ph.coordinates("theta")[0].dt()
    assert equations.components["tau_y"] == -m * g * a - m * a * spin**2 * h / 2


def test_the_least_choice_has_the_least_forces_and_then_the_least_couples() -> None:
    """No change of the open components makes the forces smaller, and none that keeps the forces
    makes the couples smaller. What may change: the pivots against each other, and with a couple.
    """
    equations = door("top", "hinge")
    forces = ("F_x", "F_y", "F_z", "G_x", "G_y", "G_z")
    apart = [{"F_x": 1, "G_x": -1, "tau_y": h}, {"F_y": 1, "G_y": -1, "tau_x": -h}]
    lifted = {"F_z": 1, "G_z": -1}
    for change in (*apart, lifted):
        slope = sum((equations.least[name] * change.get(name, 0) for name in forces), ph.Expr.of(0))
        assert slope.is_zero
    # Every change alters a force, so that nothing is left for the couples to choose.
    assert equations.least["tau_y"] == -m * g * a
    assert equations.least["F_x"] == equations.least["G_x"] == push(equations) / 2


def test_where_forces_leave_couples_open_the_least_couples_are_chosen() -> None:
    """A shaft in two bearings that are at one place: each bears half of every couple."""
    axes = LAB.rotated(ph.coordinates("theta")[0], "z")
    shaft = ph.Body("shaft", mass=m, inertia=ph.symbols("A B C"), axes=axes)
    load = ph.Torque(shaft, LAB["x"] * ph.symbol("N"))
    bearings = (ph.Hinge(shaft, axis="z"), ph.Hinge(shaft, axis="z", name="two", torque="sigma"))
    equations = ph.derive(ph.System(ph.Pivot(shaft), *bearings, load))
    assert set(equations.undetermined) == {"tau_x", "tau_y", "sigma_x", "sigma_y"}
    for label in "xy":
        assert equations.least[f"tau_{label}"] == equations.least[f"sigma_{label}"]


def test_least_reactions_are_of_the_dimensions_of_a_force_and_a_couple() -> None:
    """A sum of squares of forces and couples took (2 + h²) for a sum like any other."""
    dimensions = {s.published: str(d) for s, d in door("top", "hinge").dimensions.items()}
    assert (dimensions["h"], dimensions["a"], dimensions["g"]) == ("m", "m", "m/s^2")


# -- welds, motors, moving pivots ------------------------------------------------------------------


def test_a_pendulum_welded_of_rod_and_bob_carries_the_bob_by_the_weld() -> None:
    theta, bob_mass = ph.coordinates("theta")[0], ph.symbol("M", positive=True)
    axes = LAB.rotated(theta, "y", labels="1 2 3")
    rod = ph.rod("rod", mass=m, length=length, axes=axes, axis="3")
    bob = ph.point_mass("bob", mass=bob_mass, axes=axes)
    half = axes["3"] * (length / 2)
    weld = ph.Weld(bob, to=rod.point(-half), along=axes, force="S", torque="sigma")
    parts = (ph.Pivot(rod, at=half), ph.Hinge(rod, axis="2"), weld, ph.Gravity(g))
    equations = ph.derive(ph.System(*parts))
    moment = m * length**2 / 3 + bob_mass * length**2
    fall = -(m / 2 + bob_mass) * g * length * ph.sin(theta)
    assert list(equations.accelerations.values()) == [fall / moment]
    stretch = bob_mass * (g * ph.cos(theta) + length * theta.dt() ** 2)
    assert equations.components["S_3"] == stretch
    assert equations.components["S_1"] == bob_mass * (-g * ph.sin(theta) - length * theta.dt().dt())
    assert all(not equations.components[f"sigma_{i}"] for i in "123")


def test_a_pendulum_on_a_shaken_pivot() -> None:
    """l θ̈ = -(g + Z̈) sin θ, and the pivot works at the rate F_z Ż."""
    theta, (lift,) = ph.coordinates("theta")[0], ph.functions("Z")
    axes = LAB.rotated(theta, "y", labels="1 2 3")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    pivot = ph.Pivot(bob, at=axes["3"] * length, to=LAB["z"] * lift)
    equations = ph.derive(ph.System(pivot, ph.Gravity(g)))
    (acceleration,) = equations.accelerations.values()
    assert acceleration == -(g + lift.dt().dt()) * ph.sin(theta) / length
    assert equations.power == equations.components["F_z"] * lift.dt()
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_a_motor_between_two_bodies_pushes_on_both() -> None:
    """A flywheel driven at a rate by a motor in a case that is free to turn the other way."""
    case_turn, rate = ph.coordinates("phi")[0], ph.functions("Omega")[0]
    J, K = ph.symbols("J K", positive=True)
    case_axes = LAB.rotated(case_turn, "z", labels="1 2 3")
    case = ph.Body("case", mass=m, inertia=(J, J, J), axes=case_axes)
    spun = {"mass": m, "inertia": (K, K, K), "axes": case_axes, "spin_about": "3"}
    wheel = ph.Body("wheel", tag="w", **spun)
    holds = (ph.Pivot(case), ph.Hinge(case, axis="3"), ph.Pivot(wheel), ph.Hinge(wheel, axis="3"))
    motor = ph.Motor(wheel, axis="3", rate=rate, relative_to=case_axes, to=case, torque="C")
    equations = ph.derive(ph.System(*holds, motor))
    (acceleration,) = equations.accelerations.values()
    assert acceleration == -K * rate.dt() / (J + K)
    couple = J * K / (J + K) * rate.dt()
    assert equations.on_shell(equations.components["C_3_w"]) == couple
    assert equations.on_shell(equations.power) == couple * rate
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_a_slot_in_a_body_that_does_not_turn_is_pushed_where_the_pin_is():
    """A bead on a shelf welded to the ground: the weld takes the moment of the weight at x."""
    m, M, J, g = ph.symbols("m M J g", positive=True)
    lab = ph.Frame("lab")
    shelf = ph.Body("shelf", mass=M, inertia=(J, J, J), axes=lab, tag="s")
    bead = ph.point_mass("bead", mass=m, axes=lab)
    groove = ph.Pivot(bead, to=shelf.point(), only="y z", name="groove")
    equations = ph.derive(ph.System(ph.Weld(shelf), groove, ph.Gravity(g)))
    assert (equations.components["tau_y_s"] + m * g * ph.coordinate("x")).is_zero


def test_a_chain_that_would_take_hours_is_refused_at_once():
    m, l = ph.symbols("m l", positive=True)
    lab = ph.Frame("lab")
    parts, end = [], None
    for k in range(400):
        axes = lab.rotated(ph.coordinate(f"q{k}"), "x")
        link = ph.rod(f"link {k}", mass=m, length=l, axes=axes, axis="z", tag=f"{k}")
        parts.append(ph.Pivot(link, at=axes["z"] * l, to=end, name=f"pin {k}"))
        end = link.point(axes["z"] * -l)
    with pytest.raises(ph.DeclarationError, match=r"400 bodies that joints hold .* at most 64"):
        ph.derive(ph.System(*parts))
