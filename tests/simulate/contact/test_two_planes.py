"""One body between two supports, and supports whose forces Newton's laws leave open."""

import math

import pytest

import polhode as ph

LAB = ph.Frame("lab")
M, R, G = ph.symbols("m r g", positive=True)
BALL = ph.sphere("ball", mass=M, radius=R, axes=LAB)
NUMBERS = {"m": 0.17, "r": 0.03, "g": 9.81}
FLOOR, WALL = 0.7, 0.8  # coefficients of restitution


def in_a_corner(height, distance, towards, spin, frictions, duration):
    """A ball thrown at a wall bounces off it and the floor, in closed form between the impacts.

    Coulomb's law for a sphere whose slip does not turn: the tangential impulse is mu times the
    normal one, or what ends the slip, 2/7 of its speed times the mass.

    Returns:
        times of the impacts, then distance, height and spin at the end.
    """
    r, g = NUMBERS["r"], NUMBERS["g"]
    velocity, rise, now, times = towards, 0.0, 0.0, []
    while True:
        to_wall = (distance - r) / velocity if velocity > 0 else math.inf
        to_floor = (rise + math.sqrt(rise**2 + 2 * g * (height - r))) / g
        step = min(to_wall, to_floor, duration - now)
        distance, height = distance - velocity * step, height + rise * step - g * step**2 / 2
        rise, now = rise - g * step, now + step
        if now >= duration:
            return times, distance, height, spin
        times.append(now)
        is_floor = to_floor < to_wall
        slip = (velocity if is_floor else rise) + r * spin
        pressed = (1 + FLOOR) * -rise if is_floor else (1 + WALL) * velocity
        rubbed = -math.copysign(min(frictions[not is_floor] * pressed, 2 / 7 * abs(slip)), slip)
        spin += 5 / 2 * rubbed / r
        if is_floor:
            velocity, rise = velocity + rubbed, -FLOOR * rise
        else:
            velocity, rise = -WALL * velocity, rise + rubbed


def wall(normal):
    """A vertical wall: a plane turned by a right angle, or one whose normal is level."""
    return ph.Plane(LAB, tilt=ph.pi / 2) if normal == "tilted" else ph.Plane(LAB, normal="x")


@pytest.mark.parametrize("normal", ["tilted", "x"])
@pytest.mark.parametrize("frictions", [(0.2, 0.2), (0.2, 0), (0, 0)])
def test_a_ball_that_bounces_between_floor_and_wall(normal, frictions):
    touches = [
        ph.Coulomb(BALL, on=support, mu=mu, name=name, force=name[0].upper(), restitution=e)
        for support, mu, name, e in (
            (ph.Plane(LAB), frictions[0], "floor", FLOOR),
            (wall(normal), frictions[1], "wall", WALL),
        )
    ]
    system = ph.System(*touches, ph.Gravity(G))
    # the tilted wall is at y = 0 with the ball at y < 0, the other one at x = 0 with x > 0
    along, about, sign = ("y", "omega_x", -1) if normal == "tilted" else ("x", "omega_y", 1)
    start = {"z": 0.5, along: sign * 1.0, f"v_{along}": -sign * 2.0, about: 5.0}
    run = ph.simulate(system, NUMBERS, start, "1.5 s", samples=2)
    times, distance, height, spin = in_a_corner(0.5, 1.0, 2.0, 5.0, frictions, 1.5)
    found = [float(event.time) for event in run.events[1:-1]]
    assert found == pytest.approx(times, abs=1e-13)
    assert run.final[along] == pytest.approx(sign * distance, abs=1e-13)
    assert run.final["z"] == pytest.approx(height, abs=1e-13)
    assert run.final[about] == pytest.approx(spin, abs=1e-12)


def test_friction_beside_contacts_with_open_forces_is_not_switched_off():
    """A ball in a groove hides which side presses; another one slides down a slope."""
    lean, half = ph.symbols("lean half")
    slope = LAB.rotated(lean, "y")
    sides = [ph.Plane(slope.rotated(s * half, "x")) for s in (1, -1)]
    ball = ph.sphere("ball", mass=M, radius=R, axes=slope)
    other = ph.sphere("other", mass=M, radius=R, axes=slope, tag="o")
    groove = [
        ph.Rolling(ball, on=side, name=name, force=name[0].upper())
        for side, name in zip(sides, ("left", "right"), strict=True)
    ]
    slides = ph.Coulomb(other, on=ph.Plane(slope), mu=0.05, name="slope", force="S")
    weight, numbers = ph.Gravity(G, up=LAB["z"]), NUMBERS | {"lean": 1.2}
    alone = ph.simulate(ph.System(slides, weight), numbers, {}, "1 s", samples=2)
    down = 9.81 * (math.sin(1.2) - 0.05 * math.cos(1.2))
    assert alone.final["v_x_o"] == pytest.approx(down, abs=1e-13)
    # v = 5 cos² δ/(2 + 5 cos² δ) g sin ε t in the groove, whose axis of rotation is r cos δ away
    rolls = ph.simulate(ph.System(*groove, weight), numbers | {"half": 0.5}, {}, "1 s", samples=2)
    share = 5 * math.cos(0.5) ** 2
    expected = share / (2 + share) * 9.81 * math.sin(1.2)
    assert rolls.final["v_x"] == pytest.approx(expected, abs=1e-13)
    both = ph.System(*groove, slides, weight)
    with pytest.raises(ph.NumericError, match=r"forces at left, right .* systems of their own"):
        ph.simulate(both, numbers | {"half": 0.5}, {}, "1 s")


def test_a_weight_on_the_rim_of_a_hoop_makes_it_slip():
    """A particle on axes that turn with the hoop; slip begins where F = mu N, by energy."""
    alpha = ph.coordinate("alpha")
    hoop_mass, mu, begin = 0.05, 0.3, 0.01
    turning = LAB.rotated(alpha, "y")
    J = ph.symbol("M", positive=True) * R**2
    hoop = ph.Body(
        "hoop", mass=ph.symbol("M"), inertia=(J / 2, J, J / 2), axes=turning, surface=ph.Round(R)
    )
    weight = ph.point_mass("weight", mass=M, axes=turning, tag="w")
    system = ph.System(
        ph.Coulomb(hoop, on=ph.Plane(LAB), mu=mu, name="floor"),
        ph.Hinge(hoop, axis="y"),
        ph.Pivot(weight, to=hoop.point(turning["z"] * R), name="rim", force="N"),
        ph.Gravity(G),
    )
    run = ph.simulate(system, NUMBERS | {"M": hoop_mass}, {"alpha": begin}, "1 s")
    slips = next(event for event in run.events if event.kind == "slips")
    a, share = slips.state_before["alpha"], hoop_mass / NUMBERS["m"]
    # per m r²: (2 M/m + 2 (1 + cos α)) α̇²/2 = g (cos α₀ − cos α)/r, and its rate
    inertia = 2 * share + 2 * (1 + math.cos(a))
    pull = NUMBERS["g"] / NUMBERS["r"]
    square = 2 * pull * (math.cos(begin) - math.cos(a)) / inertia
    bend = math.sin(a) * (square + pull) / inertia
    normal = (1 + share) * pull - math.sin(a) * bend - math.cos(a) * square
    along = (1 + share) * bend + math.cos(a) * bend - math.sin(a) * square
    assert slips.state_before["alpha_dot"] ** 2 == pytest.approx(square, rel=1e-11)
    assert abs(along) == pytest.approx(mu * normal, rel=1e-10)
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize("up", [1, -1])
@pytest.mark.parametrize("derived", [False, True])
def test_a_run_tells_that_contacts_with_open_forces_may_have_to_pull(up, derived):
    """A ball that rolls in a groove, and one that the groove would hold from above.

    Of least norm, the forces of both planes are vertical, half of the weight each: their normal
    components are ± (m g/2) cos α.
    """
    tilt = ph.symbol("alpha")
    left, right = (ph.Plane(LAB.rotated(sign * tilt, "y")) for sign in (1, -1))
    groove = ph.System(
        ph.Rolling(BALL, on=left, name="left", force="F"),
        ph.Rolling(BALL, on=right, name="right", force="G"),
        ph.Gravity(G, up=LAB["z"] * up),
    )
    equations = ph.derive(groove)
    assert {"F_z", "G_z"} <= set(equations.undetermined)
    run = ph.simulate(equations if derived else groove, {**NUMBERS, "alpha": 0.5}, {}, "1 s")
    between = [event.kind for event in run.events[1:-1]]
    assert between == ([] if up > 0 else ["left may pull", "right may pull"])
    share = up * NUMBERS["m"] * NUMBERS["g"] / 2 * math.cos(0.5)
    assert run.evaluate(equations.least["F_z"], 0.5) == pytest.approx(share, rel=1e-12)
