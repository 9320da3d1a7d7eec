"""Rolling resistance and friction against spinning: how balls and disks come to rest."""

import numpy as np
import pytest

import polhode as ph
from oracles.time_stepping import RestingBall

M, A, G = 0.17, 0.0286, 9.81
m, a, g, mu, c, d = ph.symbols("m a g mu c d")
LAB = ph.Frame("lab")
NUMBERS = {m: M, a: A, g: G}


def ball(**more) -> ph.Body:
    return ph.sphere("ball", mass=m, radius=a, axes=LAB, **more)


def with_resistance(contact: ph.Rolling | ph.Coulomb, *loads) -> ph.System:
    return ph.System(
        contact,
        ph.RollingResistance(contact, mu=c),
        ph.DrillingFriction(contact, mu=d),
        ph.Gravity(g),
        *loads,
    )


def phases(run: ph.Trajectory) -> list[tuple[str, str]]:
    """What happens, and the mode after it, without the names of the laws."""
    words = {", rolling resistance": ";", ", drilling friction": ";", "contact ": ""}
    found = []
    for event in run.events:
        after = event.after or ""
        for long, short in words.items():
            after = after.replace(long, short)
        found.append((event.kind, after))
    return found


ON_TABLE = with_resistance(ph.Rolling(ball(), on=ph.Plane(LAB)))


def test_a_ball_rolls_to_rest() -> None:
    """v̇ = -c g/(1 + 2/5), and a ω̇_z = -(5/2) d g/a: in a straight line, with located ends."""
    numbers = {**NUMBERS, c: 0.01, d: 2e-4}
    run = ph.simulate(ON_TABLE, numbers, {"v_x": 1.2, "v_y": -0.5, "omega_z": 40}, 40)
    assert phases(run) == [
        ("start", "rolling; turning; turning"),
        ("sticks", "rolling; turning; held"),
        ("sticks", "rolling; held; held"),
        ("end", ""),
    ]
    slowing = 0.01 * G / 1.4
    assert run.events[1].time == pytest.approx(40 * 0.4 * A**2 / (2e-4 * G), rel=1e-13)
    assert run.events[2].time == pytest.approx(1.3 / slowing, rel=1e-13)
    way = 1.3**2 / (2 * slowing)
    assert run.final["x"] == pytest.approx(way * 12 / 13, rel=1e-13)
    assert run.final["y"] == pytest.approx(-way * 5 / 13, rel=1e-13)
    assert run.drift.energy < 1e-13
    assert all(run.final[s] == 0 for s in ("v_x", "v_y", "omega_z"))


def test_the_end_to_thirty_digits() -> None:
    from mpmath import mp, mpf

    numbers = {m: "0.17", a: "0.0286", g: "9.81", c: "0.01", d: "0.0002"}
    run = ph.simulate(ON_TABLE, numbers, {"v_x": "1.3", "omega_z": "1"}, 20, precision=40)
    with mp.workdps(40):
        rests = mpf("1.3") * mpf("1.4") / (mpf("0.01") * mpf("9.81"))
        assert abs(run.events[2].time / rests - 1) < mpf("1e-30")


@pytest.mark.parametrize("seed", range(4))
def test_a_struck_ball_slides_rolls_and_rests_as_time_stepping_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rough, rolls, spins = 0.2, 0.03, 0.1
    system = with_resistance(ph.Coulomb(ball(), on=ph.Plane(LAB), mu=mu))
    v, w = rng.normal(size=2), rng.normal(size=2)  # w = rim, a ω × ẑ: ω = (-w_y, w_x)/a
    spin = float(rng.normal())
    start = {
        "v_x": v[0],
        "v_y": v[1],
        "omega_x": -w[1] / A,
        "omega_y": w[0] / A,
        "omega_z": spin / A,
    }
    end = 3.0
    run = ph.simulate(system, {**NUMBERS, mu: rough, c: rolls, d: spins * A}, start, end)
    assert run.drift.energy < 1e-13
    oracle = RestingBall(0.4, rough, rolls, spins, G)
    errors = []
    for steps in (2000, 8000):
        velocity, _, turning, place = oracle.follow(complex(*v), complex(*w), spin, end, steps)
        final = run.final
        errors.append(
            abs(velocity - complex(final["v_x"], final["v_y"]))
            + abs(place - complex(final["x"], final["y"]))
            + abs(turning - final["omega_z"] * A)
        )
    assert errors[1] < 1e-3
    assert errors[1] < errors[0] / 3  # of first order


def test_a_ball_that_is_pushed_ever_harder_starts_where_the_push_exceeds_the_resistance() -> None:
    body = ball()
    push = ph.Force(body.point(), LAB["x"] * (ph.symbol("p") * ph.time), name="push")
    system = with_resistance(ph.Rolling(body, on=ph.Plane(LAB)), push)
    run = ph.simulate(system, {**NUMBERS, c: 0.02, d: 1e-4, "p": 0.01}, {}, 5)
    starts = 0.02 * M * G / 0.01
    assert phases(run)[:2] == [
        ("start", "rolling; held; held"),
        ("slips", "rolling; turning; held"),
    ]
    assert run.events[1].time == pytest.approx(starts, rel=1e-13)
    assert run.final["v_x"] == pytest.approx(0.01 * (5 - starts) ** 2 / (2.8 * M), rel=1e-12)


@pytest.mark.parametrize(("tilt", "rolls"), [(0.0099, False), (0.0101, True)])
def test_on_a_slope_it_stays_or_rolls(tilt: float, rolls: bool) -> None:
    alpha = ph.symbol("alpha")
    system = with_resistance(ph.Rolling(ball(), on=ph.Plane(LAB, tilt=alpha)))
    run = ph.simulate(system, {**NUMBERS, c: 0.01, d: 1e-4, alpha: tilt}, {}, 10)
    down = 10 * G * (np.sin(tilt) - 0.01 * np.cos(tilt)) / 1.4 if rolls else 0.0
    assert run.final["v_y"] == pytest.approx(-down, rel=1e-11, abs=0)


def test_on_a_carriage_they_come_to_rest_together() -> None:
    """Momentum stays, and the couple acts on both: m v = (m + M) V in the end."""
    plank = ph.Body("plank", mass=ph.symbol("M"), inertia=(0, 0, 0), axes=LAB, tag="p")
    slide = ph.Slider(plank, axis="x")
    roll = ph.Rolling(ball(), on=ph.Plane(plank))
    system = ph.System(slide, roll, ph.RollingResistance(roll, mu=c), ph.Gravity(g))
    run = ph.simulate(system, {**NUMBERS, c: 0.02, "M": 0.4}, {"v_x": 1.0}, 20)
    assert run.events[-2].kind == "sticks"
    assert run.drift.energy < 1e-13
    velocity = next(
        run.final[n] for n in ("s_p_dot", "x_p_dot", "v_x_p", "v_s_p") if n in run.final
    )
    assert velocity != 0
    momentum = M * 1.0  # v_x is the velocity of the ball's centre in the laboratory
    assert velocity * (M + 0.4) == pytest.approx(momentum, rel=1e-12)


# -- Euler's disk ----------------------------------------------------------------------------------


def disk_on_table(**coefficients) -> ph.System:
    theta, phi = ph.coordinates("theta phi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    disk = ph.disk("disk", mass=m, radius=a, axes=axes, spin_about="3")
    roll = ph.Rolling(disk, on=ph.Plane(LAB))
    return ph.System(roll, ph.RollingResistance(roll, **coefficients), ph.Gravity(g))


def whirring(system: ph.System, coefficient: float, tilt: float = 0.1) -> ph.Trajectory:
    """From the steady motion with Ω² a sin θ = 4 g and the centre at rest."""
    start = {"theta": tilt, "phi_dot": np.sqrt(4 * G / (0.03 * np.sin(tilt))), "omega_3": 0}
    return ph.simulate(system, {m: 0.2, a: 0.03, g: G, c: coefficient}, start, 60)


def tilts(run: ph.Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Times before the end, and the angles with the table there."""
    assert run.events[-2].kind == "goes flat"
    assert run.drift.energy < 1e-13
    left = run.events[-2].time * np.array([0.1, 0.3, 0.6, 0.9])
    return left, np.array([float(run.evaluate("theta", run.events[-2].time - t)) for t in left])


def test_eulers_disk_ends_at_a_located_time_with_resistance_along_its_rim() -> None:
    """3/2 m g a θ̇ = -c m g a Ω with Ω² = 4 g/(a θ): θ^(3/2) = c √(4 g/a) (t_f - t)."""
    left, found = tilts(whirring(disk_on_table(mu=c), 1e-4))
    assert found == pytest.approx((1e-4 * np.sqrt(4 * G / 0.03) * left) ** (2 / 3), rel=1e-2)


def test_resistance_in_proportion_to_the_speed_ends_with_a_square_root() -> None:
    """With c a Ω in place of c: θ² = 16/3 c g (t_f - t)."""
    left, found = tilts(whirring(disk_on_table(mu=0, viscous=c), 1e-5))
    assert found == pytest.approx(np.sqrt(16 / 3 * 1e-5 * G * left), rel=1e-2)


def test_a_wheel_rolls_upright_as_a_ball_does() -> None:
    """v̇ = -c g/(1 + 1/2)."""
    start = {"theta": np.pi / 2, "omega_3": 20.0}
    run = ph.simulate(disk_on_table(mu=c), {m: 0.2, a: 0.03, g: G, c: 0.01}, start, 5)
    assert run.final["omega_3"] == pytest.approx(20 - 5 * 0.01 * G / (1.5 * 0.03), rel=1e-12)


# -- what is refused, and what else knows of it ----------------------------------------------------


def test_impacts_are_refused() -> None:
    with pytest.raises(ph.NumericError, match="rolling resistance"):
        ph.simulate(ON_TABLE, {**NUMBERS, c: 0.01, d: 1e-4}, {"z": 0.2}, 1)


def test_a_ball_that_is_thrown_flies_until_it_lands() -> None:
    run = ph.simulate(ON_TABLE, {**NUMBERS, c: 0.01, d: 1e-4}, {"z": 0.2, "v_x": 1}, 0.1)
    assert run.final["x"] == pytest.approx(0.1, rel=1e-13)


def test_declarations_that_make_no_sense() -> None:
    roll = ph.Rolling(ball(), on=ph.Plane(LAB))
    with pytest.raises(ph.DeclarationError, match="belongs to 'contact'"):
        ph.System(ball(), ph.RollingResistance(roll, mu=c))
    with pytest.raises(ph.DeclarationError, match="give the contact"):
        ph.RollingResistance(ball(), mu=c)
    with pytest.raises(ph.DeclarationError, match="a body that rolls"):
        ph.RollingResistance(
            ph.Smooth(ph.point_mass("p", mass=m, axes=LAB), on=ph.Plane(LAB)), mu=c
        )
    with pytest.raises(ph.DeclarationError, match="zero or more"):
        ph.DrillingFriction(roll, mu=-1)
    sheet = ph.Sheet(LAB, motion=ph.functions("X Y"), edge=1)
    with pytest.raises(ph.DeclarationError, match="ends at an edge"):
        ph.RollingResistance(ph.Rolling(ball(), on=sheet), mu=c)


def test_a_motion_comes_back_from_a_file(tmp_path) -> None:
    run = ph.simulate(ON_TABLE, {**NUMBERS, c: 0.01, d: 1e-4}, {"v_x": 0.5}, 10)
    run.save(tmp_path / "run.npz")
    again = ph.load(tmp_path / "run.npz")
    assert again.final == run.final
    assert [e.time for e in again.events] == [e.time for e in run.events]


def test_its_lines_are_checked() -> None:
    equations = ph.derive(ON_TABLE)
    right = r"7\dot v_x = -5 c g \frac{v_x}{\sqrt{v_x^2+v_y^2}}"
    assert ph.check(right, equations).answer.value == "holds"
    assert ph.check(right.replace("5 c", "3 c"), equations).answer.value == "fails"


def test_exercises_say_what_opposes_the_rolling() -> None:
    words = str(ph.exercise(ON_TABLE, 1).statement)
    assert "rolls against a resistance" in words
    assert "opposes the spinning of the ball" in words
