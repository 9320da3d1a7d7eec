"""Two rolling systems against equations derived by hand and integrated by SciPy."""

from math import cos, pi, sin, tan

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

lab = ph.Frame("lab")
m, g = ph.symbols("m g", positive=True)
EXACTLY = {"rtol": 1e-12, "atol": 1e-13, "method": "DOP853"}


def test_a_cone_rolls_on_a_slope_like_a_pendulum():
    """It turns about the generator on the slope with the rate φ̇ cot α: T = I_g (φ̇ cot α)²/2."""
    I, J, r, h, c, slant = ph.symbols("I J r h c epsilon", positive=True)
    phi, theta = ph.coordinates("phi theta")
    slope = ph.Plane(lab, tilt=slant)
    axes = slope.axes.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    rim = ph.Rim(r, "3", c - h)
    cone = ph.Body("cone", mass=m, inertia=(J, J, I), axes=axes, spin=ph.About("3"), surface=rim)
    apex = ph.Pivot(cone, at=axes["3"] * c, name="apex", force="A")
    system = ph.System(ph.Rolling(cone, on=slope, name="base"), apex, ph.Gravity(g))
    half, tilt = 0.25, 0.3
    numbers = {m: 1, I: 0.02, J: 0.05, c: 0.3, h: 0.4, r: 0.4 * tan(half), slant: tilt, g: 9.81}
    # the centre of mass is at a right angle to φ, which is the direction of axis 1
    run = ph.simulate(system, numbers, {phi: 1 - pi / 2}, "5 s")
    about = 0.02 * cos(half) ** 2 + (0.05 + 0.3**2) * sin(half) ** 2
    pull = 9.81 * 0.3 * cos(half) * sin(tilt) * tan(half) ** 2 / about
    end = solve_ivp(lambda _, u: [u[1], -pull * cos(u[0])], (0, 5), [1, 0], **EXACTLY).y[0, -1]
    assert run.final["phi"] + pi / 2 == pytest.approx(end, abs=1e-9)


M, a, J, I, c, l, w = ph.symbols("M a J I c l w", positive=True)
PHASE = w * ph.time
SIZES = {m: 6, J: 0.016, M: 2, I: 0.072, a: 0.5, c: 0.0013, l: 0.2, w: 3}


def _snakeboard(steer: ph.Expr, aft_angle: ph.Expr | None = None) -> ph.System:
    """With both wheel sets steered as prescribed; by default the aft one opposite to the front."""
    theta, psi, front, back = ph.coordinates("theta psi phi beta")
    heading = lab.rotated(theta, "z")
    board = ph.Body("board", mass=m, inertia=(J, J, J), axes=heading)

    def on_board(name, mass, moment, angle, place):
        axes, tag = heading.rotated(angle, "z"), name[0]
        body = ph.Body(name, mass=mass, inertia=(moment,) * 3, axes=axes, tag=tag)
        at = board.point(heading["x"] * place)
        return body, ph.Pivot(body, to=at, name=name), ph.Hinge(body, axis="z", to=board)

    rotor, *turns = on_board("rotor", M, I, psi, 0)
    fore, *leads = on_board("fore", a, c, front, l)
    aft, *follows = on_board("aft", a, c, back, -l)
    if aft_angle is None:
        linked = ph.Constraint(front + back, on=(fore, aft), name="linkage", force="Q_p")
    else:
        linked = ph.Constraint(back - aft_angle, on=aft, name="linkage", force="Q_p")
    return ph.System(
        ph.Pivot(board, only="z"),
        ph.Hinge(board, axis="z"),
        *(*turns, *leads, *follows),
        ph.KnifeEdge(fore, across="y", force="N"),
        ph.KnifeEdge(aft, across="y", force="P"),
        ph.Constraint(psi - 0.7 * ph.sin(PHASE), on=rotor, name="rider", force="Q_r"),
        ph.Constraint(front - steer, on=fore, name="feet", force="Q_f"),
        linked,
    )


def test_a_snakeboard_is_driven_by_its_rotor_and_its_wheels():
    """J. Ostrowski, A. Lewis, R. Murray, J. Burdick, Nonholonomic mechanics and locomotion: the
    snakeboard example (1994). With v along the board, θ̇ = v tan φ/l; the power of the constraint
    forces vanishes on (v, θ̇) = (1, tan φ/l).
    """
    run = ph.simulate(_snakeboard(0.3 * ph.sin(PHASE) + 0.4), SIZES, {}, "5 s")
    whole, moment = 9, 0.016 + 0.072 + 2 * (0.0013 + 0.5 * 0.2**2)

    def rates(t, state):
        _, _, heading, v = state
        angle, rate = 0.3 * sin(3 * t) + 0.4, 0.9 * cos(3 * t)
        turn, change = tan(angle) / 0.2, rate / cos(angle) ** 2 / 0.2
        driven = moment * v * change - 0.072 * 6.3 * sin(3 * t)
        speed_up = -turn * driven / (whole + moment * turn**2)
        return [v * cos(heading), v * sin(heading), v * turn, speed_up]

    end = solve_ivp(rates, (0, 5), [0, 0, 0, 0], **EXACTLY).y[:3, -1]
    assert [run.final[q] for q in ("x", "y", "theta")] == pytest.approx(np.array(end), abs=1e-10)


def test_a_snakeboard_with_one_wheel_set_across_turns_on():
    """At φ = π/2 the speed along the board vanishes and the others follow from θ̇: v = 2 l θ̇ cot φ,
    while the aft wheels, straight ahead, keep the velocity across at l θ̇.
    """
    system = _snakeboard(ph.pi / 2 + 0.3 * ph.sin(PHASE), ph.Expr.of(0))
    run = ph.simulate(system, SIZES, {"theta_dot": 1}, "3 s")
    moment = 0.016 + 0.072 + 2 * (0.0013 + 0.5 * 0.2**2)

    def rates(t, state):
        _, _, heading, turn = state
        angle, rate, change = pi / 2 + 0.3 * sin(3 * t), 0.9 * cos(3 * t), -2.7 * sin(3 * t)
        along, across = 0.4 * turn / tan(angle), 0.2 * turn
        pull = 9 * 4 * 0.2**2 * rate * turn / tan(angle) / sin(angle) ** 2
        pull += 0.072 * 6.3 * sin(3 * t) - 0.0013 * change
        gain = pull / (9 * 0.2**2 * (4 / tan(angle) ** 2 + 1) + moment)
        ahead = along * cos(heading) - across * sin(heading)
        return [ahead, along * sin(heading) + across * cos(heading), turn, gain]

    end = solve_ivp(rates, (0, 3), [0, 0, 0, 1], **EXACTLY).y[:3, -1]
    assert [run.final[q] for q in ("x", "y", "theta")] == pytest.approx(np.array(end), abs=1e-10)


@pytest.mark.parametrize("middle", [pi / 2, 1.0])
def test_a_snakeboard_with_both_wheel_sets_across_is_free_to_go_sideways(middle):
    """At φ = -β = π/2 both hold the velocity along the board alone: rank one, not two."""
    system = _snakeboard(ph.Expr.of(middle) + 0.8 * ph.sin(PHASE))
    told = r"dead point (at the start|at t = ).*constraints leave 2 degrees of freedom, not 1"
    with pytest.raises(ph.PolhodeError, match=told):
        ph.simulate(system, SIZES, {"theta_dot": 1} if middle == 1.0 else {}, "3 s")
