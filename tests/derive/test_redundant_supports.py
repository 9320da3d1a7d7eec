"""Supports that agree with one another: the motion is derived, and what stays open is named.

The expected equations are Newton's and Euler's, written by hand for the body as a whole.
"""

import pytest

import polhode as ph

lab = ph.Frame("lab")
x, y, z = lab["x"], lab["y"], lab["z"]
m, M, a, b, c, g, I, J, K, T = ph.symbols("m M a b c g I J K T", positive=True)
phi, theta = ph.coordinates("phi theta")
heading = lab.rotated(phi, "z", labels="1 2 3")
left = ph.disk("left wheel", mass=m, radius=a, axes=heading, axis="2", tag="l")
right = ph.disk("right wheel", mass=m, radius=a, axes=heading, axis="2", tag="r")


def on_two_wheels(body, centre, support=None):
    """A body whose two wheels roll without slipping; `centre` is the midpoint of the axle."""
    return (
        ph.Rolling(left, on=ph.Plane(lab)),
        ph.Pivot(body, at=centre + heading["2"] * b, to=left.point(), name="left", force="P"),
        ph.Hinge(left, axis="2", to=body, name="left axle"),
        ph.Pivot(right, to=body.point(centre - heading["2"] * b), name="right", force="Q"),
        ph.Hinge(right, axis="2", to=body, name="right axle"),
        ph.Rolling(right, on=support or ph.Plane(lab)),
        ph.Gravity(g),
    )


def vanishes(equations, expression):
    """Whether an expression is zero on every motion."""
    return not equations.on_shell(expression)


@pytest.fixture(scope="module")
def segway():
    """A body that tilts by θ on two wheels, which a motor turns by T on each."""
    tilting = heading.rotated(theta, "2")
    body = ph.Body("body", mass=M, inertia=(I, J, K), axes=tilting, tag="b")
    driven = (
        ph.Torque(wheel, heading["2"] * (sign * T), name=f"motor of {wheel.name}")
        for wheel, sign in ((left, 1), (right, 1), (body, -2))
    )
    return ph.derive(ph.System(*on_two_wheels(body, tilting["3"] * -c), *driven))


def test_a_body_on_two_rolling_wheels_obeys_newtons_and_eulers_laws(segway):
    """Three laws by hand, for the speed s along the heading, the turn φ and the tilt θ.

    Along the heading: the horizontal forces of the ground on wheels and body. About the vertical
    through the middle of the axle: their moments. About the axle: the body alone.
    """
    s = a * ph.speed("omega_2_r") - b * phi.dt()
    s_dot = s.dt()
    sin, cos = ph.sin(theta), ph.cos(theta)
    turn, tilt = phi.dt(), theta.dt()
    # the wheels: m v̇ = F + bearing, (m a²/2) ψ̈ = T − a F; so F = T/a − (m/2) v̇ and each wheel
    # needs (3/2) m v̇ of the sum T/a − bearing
    ahead = c * (theta.dt().dt() * cos - (tilt * tilt + turn * turn) * sin)
    along = (M + 3 * m) * s_dot + M * ahead - 2 * T / a
    # the body's moment of inertia about the vertical, and the lateral acceleration s φ̇ of the axle
    vertical = (I + M * c * c) * sin * sin + K * cos * cos
    disks = 2 * (m * a * a / 4 + m * b * b) + m * b * b
    about_vertical = ((vertical + disks) * turn).dt() + M * c * sin * s * turn
    about_axle = (
        (J + M * c * c) * theta.dt().dt()
        - (I + M * c * c - K) * sin * cos * turn * turn
        + M * c * s_dot * cos
        - M * g * c * sin
        + 2 * T
    )
    for law in (along, about_vertical, about_axle):
        assert vanishes(segway, law)


def test_only_the_share_of_each_wheel_in_the_force_along_the_axle_is_open(segway):
    across = heading["2"]
    forces = {name: segway.reactions[name].force for name in ("contact_l", "contact_r")}
    symbols = {s.published for f in forces.values() for s in f.dot(across).symbols()}
    opened = [s for s in segway.undetermined if s in symbols]
    assert len(opened) == 1
    # the sum is what the whole needs for its centre of mass to follow the curve
    s = a * ph.speed("omega_2_r") - b * phi.dt()
    needed = (M + 2 * m) * s * phi.dt() + M * c * (ph.sin(theta) * phi.dt()).dt()
    needed += M * c * ph.cos(theta) * theta.dt() * phi.dt()
    assert vanishes(segway, (forces["contact_l"] + forces["contact_r"]).dot(across) - needed)
    for force in forces.values():
        for direction in (heading["1"], heading["3"]):
            assert opened[0] not in {s.published for s in force.dot(direction).symbols()}


def test_contradictory_wheels_are_refused():
    """The ground under one wheel moves, and neither wheel can follow it along the axle."""
    axle = ph.rod("axle", mass=M, length=2 * b, axes=heading, axis="2", tag="a")
    pulled = ph.Sheet(lab, motion=(0, *ph.functions("Y")))
    with pytest.raises(ph.ConstraintError, match="contradict one another, at F_"):
        ph.derive(ph.System(*on_two_wheels(axle, heading["2"] * 0, pulled)))


def door(*hinges, lower=z * -b):
    turned = lab.rotated(theta, "z")
    leaf = ph.Body("leaf", mass=m, inertia=(I, I, J), axes=turned)
    edge = turned["x"] * -a
    return ph.System(
        ph.Pivot(leaf, at=edge + z * b, to=z * b, name="upper", force="P"),
        ph.Pivot(leaf, at=edge - z * b, to=lower, name="lower", force="Q"),
        *(ph.Hinge(leaf, axis="z", name=f"{t}", torque=t) for t in hinges),
        ph.Gravity(g),
    )


@pytest.mark.parametrize(
    ("hinges", "open_"),
    [
        ((), {"P_z", "Q_z"}),
        (("tau", "sigma"), {f"{f}_{i}" for f in "PQ" for i in "xyz"}),
    ],
)
def test_a_door_on_two_hinges(hinges, open_):
    """Two balls leave the share of the weight open, two hinges all forces across as well."""
    equations = ph.derive(door(*hinges))
    assert vanishes(equations, (J + m * a * a) * theta.dt().dt())
    couples = {f"{torque}_{i}" for torque in hinges for i in "xy"}
    assert set(equations.undetermined) == open_ | couples
    upper, lower = (equations.reactions[name] for name in ("upper", "lower"))
    assert (upper.force + lower.force).dot(z) == m * g
    out = lab.rotated(theta, "z")["x"]
    if not hinges:  # the moment of the weight about the lower hinge
        assert vanishes(equations, (lower.force - upper.force).dot(out) * b - m * g * a)


def test_a_door_whose_hinges_do_not_fit_is_refused():
    with pytest.raises(ph.ConstraintError, match="never closes"):
        ph.derive(door(lower=z * -b + x * c))


def four_bar(is_spatial):
    """Crank, coupler and rocker, held by hinges all round, or in the plane alone."""
    angles = ph.coordinates("alpha beta gamma")
    lengths = ph.symbols("l_1 l_2 l_3", positive=True)
    kind = {} if is_spatial else {"only": "x z"}
    elements, before = [], None
    for angle, length, tag in zip(angles, lengths, "abc", strict=True):
        turned = lab.rotated(angle, "y")
        bar = ph.rod(f"bar {tag}", mass=m, length=length, axes=turned, axis="x", tag=tag)
        end = turned["x"] * (length / 2)
        elements += [
            ph.Pivot(bar, at=-end, to=before, name=f"pin {tag}", force="P"),
            ph.Hinge(bar, axis="y", name=f"axis {tag}"),
        ]
        before = bar.point(end)
    place = x * ph.symbol("l_4", positive=True)
    elements.append(ph.Pivot(bar, at=end, to=place, name="last pin", force="S", **kind))
    if is_spatial:
        elements.append(ph.Hinge(bar, axis="y", name="last axis", torque="sigma"))
    return ph.derive(ph.System(*elements, ph.Gravity(g)))


def test_a_four_bar_with_hinges_all_round_moves_as_the_planar_one():
    planar, spatial = four_bar(False), four_bar(True)
    assert planar.undetermined == ()
    assert spatial.motion == planar.motion
    # across the plane, and the couples that keep the bars in it
    assert {name.split("_")[1] for name in spatial.undetermined} <= {"x", "y", "z"}
    assert {name for name in spatial.undetermined if name[0] in "PS"} == {
        "P_y_a",
        "P_y_b",
        "P_y_c",
        "S_y_c",
    }
