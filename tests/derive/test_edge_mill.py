"""An edge mill: a wheel that rolls on a floor while its axle turns about a vertical post.

By hand, with Ω = φ̇ and e_r, e_t, e_n along the axle, along the path and up (Routh, Advanced
Rigid Dynamics; Goldstein, ch. 5): the centre goes round a circle of radius b, the wheel spins with
−bΩ/a about e_r, and its angular momentum I₁ Ω e_n − I₃ (bΩ/a) e_r changes by −I₃ (bΩ²/a) e_t and
by what Ω̇ adds.
"""

from math import pi

import pytest

import polhode as ph

lab = ph.Frame("lab")
M, a, b, g, I_1, I_3, tau, mu = ph.symbols("M a b g I_1 I_3 tau mu", positive=True)
phi = ph.coordinate("phi")
turn = lab.rotated(phi, "z", labels="r t n")
axes = turn.rotated(ph.pi / 2, "t", labels="1 2 3")
wheel = ph.Body("wheel", mass=M, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3", rim=a)
floor = ph.Plane(lab)
NUMBERS = {M: 2, a: 0.3, b: 0.5, I_1: 0.06, I_3: 0.1, g: 9.81, tau: 0.7}


def declared(*contact, only="", loads=()):
    post = ph.Pivot(
        wheel, at=axes["3"] * -b, to=lab["z"] * a, along=turn, only=only, name="post", force="P"
    )
    drive = loads or (ph.Torque(wheel, lab["z"] * tau),)
    return ph.System(*contact, post, ph.Gravity(g), *drive)


def mill(*contact, **how):
    return ph.derive(declared(*contact, **how))


def by_hand(rate):
    """Ω̇, and the sums of all forces along e_r and of their couples along e_t on a mill."""
    M_, a_, b_, I_1_, I_3_, tau_ = (NUMBERS[s] for s in (M, a, b, I_1, I_3, tau))
    return (
        tau_ / (I_1_ + M_ * b_**2 + I_3_ * b_**2 / a_**2),
        -M_ * b_ * rate**2,
        -I_3_ * b_ * rate**2 / a_,
    )


@pytest.mark.parametrize("start", [0.0, pi / 2, -pi / 2, 0.7])
def test_with_friction_along_the_axle(start):
    """The floor bears the weight; its friction along the axle turns the spin, and moves the post.

    The pivot holds along directions that turn with the mill. It does not hold the mill itself.
    """
    run = ph.simulate(
        mill(ph.Rolling(wheel, on=floor), only="r t"), NUMBERS, {phi: start, "phi_dot": 2.0}, "1 s"
    )
    turned, along, about = by_hand(2.0)
    assert run.evaluate("phi_ddot", 0.0) == pytest.approx(turned, rel=1e-13)
    friction = run.evaluate(run.equations.reactions["contact"].force.dot(turn["r"]), 0.0)
    a_ = NUMBERS[a]
    # a friction F e_r at −a e_n has the couple −a F e_t
    assert friction == pytest.approx(-about / a_, rel=1e-12)
    assert run.evaluate("P_r", 0.0) == pytest.approx(along - friction, rel=1e-12)
    assert run.evaluate("F_z", 0.0) == pytest.approx(NUMBERS[M] * NUMBERS[g], rel=1e-12)
    assert run.final["phi"] == pytest.approx(start + 2.0 + turned / 2, rel=1e-12)


def test_the_declaration_moves_as_its_equations_do():
    """Nothing keeps the axle level off the floor, which does not matter while it is on it."""
    system = declared(ph.Rolling(wheel, on=floor), only="r t")
    start = {phi: 0.3, "phi_dot": 2.0}
    declaration, equations = (
        ph.simulate(subject, NUMBERS, start, "1 s") for subject in (system, ph.derive(system))
    )
    for name in ("phi", "omega_3", "x", "y", "F_x", "F_y", "F_z", "P_r", "P_t"):
        assert declaration.final[name] == pytest.approx(equations.final[name], rel=1e-12)


def test_a_floor_that_lets_go_of_a_wheel_that_nothing_else_holds_ends_the_motion():
    lift = ph.Force(wheel.point(), lab["z"] * (ph.symbol("k") * ph.time), name="lift")
    system = declared(ph.Rolling(wheel, on=floor), only="r t", loads=(lift,))
    numbers = {s: value for s, value in NUMBERS.items() if s != tau} | {"k": 10}
    with pytest.raises(ph.ConstraintError, match=r"at t = 1\.962 s, flight: nothing supplies"):
        ph.simulate(system, numbers, {phi: 0.3, "phi_dot": 2.0}, "3 s")


@pytest.mark.parametrize("start", [0.0, pi / 2, -pi / 2, 0.7])
def test_without_friction_along_the_axle_the_stone_presses_harder(start):
    """The post takes the couple: N = M g + I₃ Ω²/a, wherever the mill is."""
    rolls = ph.Hold(wheel, at=lab["z"] * -a, along=turn, only="t", name="track", force="T")
    grinding = mill(ph.Smooth(wheel, on=floor), rolls)
    run = ph.simulate(grinding, NUMBERS, {phi: start, "phi_dot": 2.0}, "1 s")
    turned, along, about = by_hand(2.0)
    pressed = NUMBERS[M] * NUMBERS[g] - about / NUMBERS[b]
    assert run.evaluate("F_z", 0.0) == pytest.approx(pressed, rel=1e-12)
    assert run.evaluate("P_n", 0.0) == pytest.approx(about / NUMBERS[b], rel=1e-12)
    assert run.evaluate("P_r", 0.0) == pytest.approx(along, rel=1e-12)
    track = -NUMBERS[I_3] * NUMBERS[b] * turned / NUMBERS[a] ** 2
    assert run.evaluate("T_t", 0.0) == pytest.approx(track, rel=1e-12)


def test_with_both_the_share_of_each_is_open():
    assert set(mill(ph.Rolling(wheel, on=floor)).undetermined) == {
        "F_x",
        "F_y",
        "F_z",
        "P_r",
        "P_n",
    }


@pytest.mark.parametrize("start", [0.0, pi / 2, -pi / 2, 0.7])
def test_friction_of_the_post_slows_the_mill_down(start):
    """A couple μ a |P_r| = μ a M b Ω²: then 1/Ω grows at the rate μ a M b over the inertia."""
    rub = ph.Torque(wheel, lab["z"] * (mu * a * ph.reaction("P_r")), name="friction of the post")
    rolls = ph.Hold(wheel, at=lab["z"] * -a, along=turn, only="t", name="track", force="T")
    rubbed = mill(ph.Smooth(wheel, on=floor), rolls, loads=(rub,))
    numbers = {s: value for s, value in NUMBERS.items() if s != tau} | {mu: 0.1}
    run = ph.simulate(rubbed, numbers, {phi: start, "phi_dot": 2.0}, "1 s")
    inertia = NUMBERS[tau] / by_hand(0.0)[0]
    slowing = 0.1 * NUMBERS[a] * NUMBERS[M] * NUMBERS[b] / inertia
    assert run.final["phi_dot"] == pytest.approx(2 / (1 + 2 * slowing), rel=1e-12)
    assert run.evaluate("P_r", 0.0) == pytest.approx(by_hand(2.0)[1], rel=1e-12)


@pytest.mark.parametrize("start", [{"omega_3": 2.0}, {"phi_dot": 2.0}])
def test_an_axle_that_is_free_to_slide_along_the_path_is_at_a_branch_in_the_middle(start):
    """Held along e_r and e_n only, the wheel may go round the post or roll straight past it.

    Off the middle, at a distance s along the path, the closure x cos φ + y sin φ = b requires
    s φ̇ = 0; in the middle nothing does.
    """
    free = mill(ph.Rolling(wheel, on=floor), only="r n", loads=(ph.Torque(wheel, axes["3"] * 0),))
    numbers = {s: value for s, value in NUMBERS.items() if s != tau}
    with pytest.raises(ph.ConstraintError, match="dead point at the start"):
        ph.simulate(free, numbers, {"phi": 0, "x": numbers[b], "y": 0, **start}, "1 s")
    beside = {"phi": 0, "x": numbers[b], "y": 0.1, "omega_3": 2.0}
    run = ph.simulate(free, numbers, beside, "1 s")
    assert run.final["y"] == pytest.approx(0.1 - 2 * numbers[a])
    assert run.final["phi"] == 0
