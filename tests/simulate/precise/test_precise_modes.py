"""Beyond doubles through changes of contact mode: against closed forms, to all digits."""

from fractions import Fraction

import mpmath
import pytest

import polhode as ph
from polhode.algebra import fraction_of
from polhode.simulate import Trajectory
from simulate.contact import balls, blocks, disks
from simulate.precise.test_precise_declared import Impatient

DIGITS = mpmath.MPContext()
DIGITS.dps = 120
FINE = [("quadruple", 1e-31), (55, 1e-52)]
BALL = {"m": "50 g", "a": "20 mm", "k": "0.4", "g": "9.81", "mu": "0.3", "mu_s": "0.3", "e": 0}


def exact(value) -> mpmath.mpf:
    """A number of any sort, or the text of one, with many digits."""
    found = Fraction(value) if isinstance(value, str) else fraction_of(value)
    return DIGITS.mpf(found.numerator) / found.denominator


def off(one, other) -> float:
    return float(abs(exact(one) - exact(other)))


def kinds(run: Trajectory) -> list[str]:
    return [event.kind for event in run.events]


G, MU = exact("9.81"), exact("0.3")


# -- slip that ends --------------------------------------------------------------------------------


@pytest.mark.parametrize(("precision", "error"), FINE)
def test_a_ball_with_backspin_and_sidespin(integrator, precision, error):
    start = {"v_x": 1, "v_y": "0.5 m/s", "omega_x": 10, "omega_y": -20, "omega_z": 3}
    run = ph.simulate(balls.on_table(), BALL, start, "1 s", precision=precision, samples=3)
    velocity, slip = (exact(1), exact("0.5")), (exact("1.4"), exact("0.7"))
    speed = DIGITS.hypot(*slip)
    time = speed / (MU * G * Fraction(7, 2).numerator / 2)
    slowed = [MU * G * s / speed for s in slip]
    rolls = [v - a * time for v, a in zip(velocity, slowed, strict=True)]
    places = [v * time - a * time**2 / 2 for v, a in zip(velocity, slowed, strict=True)]
    assert kinds(run) == ["start", "sticks", "end"]
    sticks = run.events[1]
    assert off(sticks.time, time) < error
    for k, label in enumerate("xy"):
        assert off(sticks.state_before[label], places[k]) < error
        assert off(sticks.state_after[f"v_{label}"], rolls[k]) < error
        assert off(run.final[f"v_{label}"], rolls[k]) < error
        assert off(run.final[label], places[k] + rolls[k] * (1 - time)) < error
    assert off(run.final["omega_z"], 3) < error
    assert run.drift.energy < error
    assert run.integrator == ("heyoka" if integrator == "heyoka" else "flint")


@pytest.mark.parametrize(("precision", "error"), [("extended", 1e-18), *FINE])
def test_a_ball_that_only_slides_keeps_five_sevenths_of_its_speed(precision, error):
    start = {"v_x": 7, "omega_y": 0}
    run = ph.simulate(balls.on_table(), BALL, start, "2 s", precision=precision, samples=3)
    assert off(run.final["v_x"], 5) < 10 * error
    assert off(run.final["omega_y"], 250) < 1000 * error
    assert off(run.events[1].time, 2 / (MU * G)) < error


def test_what_is_read_of_a_motion_that_switches(tmp_path):
    run = ph.simulate(
        balls.on_table(),
        BALL,
        {"v_x": 7, "omega_y": 0},
        "2 s",
        precision="quadruple",
        samples=9,
        events={"at six": ph.speed("v_x") - 6},
    )
    sliding = MU * G / 20
    times = [exact("0.1"), exact("1.9")]
    friction = run.evaluate("F_x", times)
    assert off(friction[0], -sliding) < 1e-33
    assert off(friction[1], 0) < 1e-33
    assert kinds(run) == ["start", "at six", "sticks", "end"]
    assert off(run.events[1].time, 1 / (MU * G)) < 1e-32
    assert off(run["v_x"][-1], 5) < 1e-32
    run.to_csv(tmp_path / "run.csv", ["v_x"])
    assert (tmp_path / "run.csv").read_text().rstrip().endswith("5.0")
    double = run.rounded()
    assert [segment.mode for segment in double.segments] == ["sliding", "rolling"]
    assert double.events[2].time == float(run.events[2].time)
    assert double.drift.energy < 1e-15


# -- landings --------------------------------------------------------------------------------------


def test_a_ball_thrown_up_lands_and_rolls():
    """Its rim strikes the table with friction enough to stop the slip at once."""
    start = {"z": "0.02 m", "v_z": "2 m/s", "v_x": "0.7 m/s"}
    run = ph.simulate(balls.on_table(), BALL, start, "1 s", precision="quadruple", samples=3)
    assert kinds(run) == ["start", "touches down", "end"]
    time = 4 / G
    assert off(run.events[1].time, time) < 1e-33
    assert off(run.final["v_x"], exact("0.5")) < 1e-33
    assert off(run.final["x"], exact("0.7") * time + (1 - time) / 2) < 1e-32
    assert run.drift.energy < 1e-32


def test_a_ball_that_lands_slips_until_it_rolls():
    start = {"z": "0.02 m", "v_z": "1 m/s", "v_x": "5 m/s"}
    run = ph.simulate(balls.on_table(), BALL, start, "2 s", precision="quadruple", samples=3)
    assert kinds(run) == ["start", "touches down", "sticks", "end"]
    landed = 2 / G
    left = 5 - MU
    sticks = landed + (5 - MU * exact("3.5")) / (MU * G * exact("3.5"))
    assert off(run.events[1].state_after["v_x"], left) < 1e-32
    assert off(run.events[2].time, sticks) < 1e-32
    assert off(run.final["v_x"], exact("25") / 7) < 1e-32


@pytest.mark.parametrize("restitution", ["0.5", "0.1"])
def test_a_ball_that_bounces_ever_lower_comes_to_rest_in_time(restitution):
    values, height = BALL | {"e": restitution}, {"z": "0.12 m"}
    run = ph.simulate(balls.on_table(), values, height, "1 s", precision="quadruple", samples=3)
    e = exact(restitution)
    rest = DIGITS.sqrt(exact("0.2") / G) * (1 + e) / (1 - e)
    assert off(run.events[-2].time, rest) < 1e-30
    assert kinds(run)[-2] == "touches down"
    assert len(run.events) > (90 if restitution == "0.5" else 30)
    assert run.drift.energy < 1e-31


# -- slip that begins ------------------------------------------------------------------------------


@pytest.mark.parametrize("static", ["0.2", "0.3"])
def test_a_block_on_a_sheet_that_gathers_speed_slips_when_the_limit_is_passed(static):
    """X = t³: the block is carried until 6 t = mu_s g, then pushed by mu g, and left behind."""
    values = {"m": 2, "J": "0.1", "h": "0.2", "g": "9.81", "mu": "0.2", "mu_s": static}
    forcing = {"X": ph.time**3}
    run = ph.simulate(
        blocks.on_sheet(), values, {}, 1, forcing=forcing, precision="quadruple", samples=3
    )
    begins = exact(static) * G / 6
    push, passed = exact("0.2") * G, 1 - begins
    assert kinds(run) == ["start", "slips", "end"]
    assert off(run.events[1].time, begins) < 1e-33
    assert off(run.final["v_x"], 3 * begins**2 + push * passed) < 1e-32
    way = begins**3 + 3 * begins**2 * passed + push * passed**2 / 2
    assert off(run.final["x"], way) < 1e-32
    assert run.drift.energy < 1e-32


def test_a_block_that_is_thrown_uphill_turns_round():
    """It stops, cannot stay, and slides back down."""
    values = {"m": 2, "J": "0.1", "h": "0.2", "g": "9.81", "mu": "0.2", "mu_s": "0.2"}
    run = ph.simulate(
        blocks.on_plane(),
        values,
        {"v_y": 3},
        1,
        forcing={"beta": ph.pi / 6},
        precision=40,
        samples=3,
    )
    assert kinds(run) == ["start", "turns round", "end"]
    up, down = (G * (1 + sign * exact("0.2") * DIGITS.sqrt(3)) / 2 for sign in (1, -1))
    turns = 3 / up
    assert off(run.events[1].time, turns) < 1e-39
    assert off(run.final["v_y"], -down * (1 - turns)) < 1e-38
    assert off(run.final["y"], 3 * turns / 2 - down * (1 - turns) ** 2 / 2) < 1e-38
    assert run.drift.energy < 1e-38


def carried(static: str, precision, duration) -> Trajectory:
    """A ball on a sheet that is pulled about in two directions, until it slips."""
    values = BALL | {"mu": "0.1", "mu_s": static, "e": 0}
    forcing = {"X": ph.sin(5 * ph.time) / 5, "Y": ph.cos(3 * ph.time) / 3}
    lab, (x, y) = ph.Frame("lab"), ph.functions("X Y")
    m, a, k, g, e = balls.M, balls.A, balls.K, balls.G, balls.E
    ball = ph.sphere("ball", mass=m, radius=a, inertia=k * m * a**2, axes=lab)
    sheet = ph.Sheet(lab, motion=(x, y))
    touch = ph.Coulomb(ball, on=sheet, mu=balls.MU, mu_static=balls.MU_S, restitution=e, name="p")
    system = ph.System(touch, ph.Gravity(g))
    more = {"forcing": forcing, "precision": precision, "samples": 2}
    return ph.simulate(system, values, {"v_x": "0.3 m/s"}, duration, **more)


def pulled(time) -> tuple:
    """Acceleration of that sheet."""
    return -5 * DIGITS.sin(5 * time), -3 * DIGITS.cos(3 * time)


@pytest.mark.parametrize("static", ["0.12", "0.1"])
def test_slip_in_two_directions_obeys_its_equation_from_its_first_instant_on(static):
    """s(t) = −∫ (α s/|s| + A) dt from where |A| passes its limit; the integral by quadrature."""
    run = carried(static, "quadruple", "0.2 s")
    assert kinds(run) == ["start", "slips", "end"]
    begins, alpha = exact(run.events[1].time), exact("3.5") * G / 10
    assert off(DIGITS.hypot(*pulled(begins)), exact(static) * G * exact("3.5")) < 1e-31

    def change(k):
        def rate(time):
            slip = [exact(run.evaluate(f"slip_{label}_p", time)[()]) for label in "xy"]
            return -alpha * slip[k] / DIGITS.hypot(*slip) - pulled(time)[k]

        return rate

    stop = begins + exact("0.05")
    for k, label in enumerate("xy"):
        pieces = DIGITS.linspace(begins, stop, 4)
        found = DIGITS.quad(change(k), pieces, method="gauss-legendre", maxdegree=4)
        assert off(run.evaluate(f"slip_{label}_p", stop)[()], found) < 1e-29


# -- disks ---------------------------------------------------------------------------------------


DISK = {"m": "0.1", "a": "0.05", "g": "9.81", "e": 0, "mu": "0.3", "mu_s": "0.36"}


def test_a_disk_that_slips_rolls_and_slips_again():
    """Slip ends where its direction turns ever faster, and begins in no direction it had before."""
    start = {"theta": "60 deg", "phi_dot": 3, "omega_3": 8}
    double, run, finer = (
        ph.simulate(disks.with_friction(), DISK, start, "0.42", samples=2, precision=precision)
        for precision in (None, "quadruple", 40)
    )
    assert kinds(double) == kinds(run) == kinds(finer) == ["start", "sticks", "slips", "end"]
    for name in ("theta", "phi", "x", "y", "omega_3", "v_x"):
        assert off(double.final[name], finer.final[name]) < 1e-12
        assert off(run.final[name], finer.final[name]) < 1e-30
    for event, same in zip(run.events, finer.events, strict=True):
        assert off(event.time, same.time) < 1e-32
    assert run.drift.energy < 1e-32
    assert finer.drift.energy < 1e-39


def test_a_tilted_disk_lands_with_friction_that_turns_its_slip():
    values, start = DISK | {"mu": "0.1", "mu_s": "0.12"}, {"theta": "20 deg", "omega_3": 1}
    run, finer = (
        ph.simulate(
            disks.with_friction(), values, start | {"z": "0.2 m"}, "0.22", samples=2, precision=p
        )
        for p in ("quadruple", 40)
    )
    expected = ["start", "touches down", "touches down", "slips", "lifts off", "end"]
    assert kinds(run) == kinds(finer) == expected
    for name in ("theta", "phi", "x", "y", "z", "omega_3"):
        assert off(run.final[name], finer.final[name]) < 1e-30
    assert run.drift.energy < 1e-31


def test_a_disk_goes_flat_where_its_tilt_says():
    values, start = DISK | {"mu": 2, "mu_s": 2}, {"theta": "10 deg"}
    run = ph.simulate(disks.with_friction(), values, start, 1, samples=2, precision="quadruple")
    assert (run.mode, kinds(run)[-2]) == ("near-flat", "goes flat")
    assert off(DIGITS.sin(exact(run.final["theta"])), "0.001") < 1e-33


# -- edges and interruptions ---------------------------------------------------------------------


def test_a_ball_rolls_off_the_edge_of_a_sheet_that_is_pulled_away():
    """The sheet moves at a constant speed; on the table the ball slips, then rolls more slowly."""
    lab, u = ph.Frame("lab"), ph.symbol("U")
    m, a, k, g = balls.M, balls.A, balls.K, balls.G
    ball = ph.sphere("ball", mass=m, radius=a, inertia=k * m * a**2, axes=lab)
    sheet = ph.Sheet(lab, motion=(u * ph.time, 0), edge=ph.sqrt(4) / 20)
    touch = ph.Coulomb(ball, on=sheet, mu=balls.MU, mu_static=balls.MU_S, name="paper")
    system = ph.System(touch, ph.Gravity(g))
    values = {key: value for key, value in BALL.items() if key != "e"} | {"U": "-0.5"}
    run = ph.simulate(system, values, {"v_x": "0.2"}, 2, samples=2, precision="quadruple")
    assert kinds(run) == ["start", "crosses the edge", "sticks", "end"]
    assert off(run.events[1].time, Fraction(1, 7)) < 1e-33
    # v + k u is kept by any force at the contact, with u = a omega_y = v − U at first
    assert (
        off(run.final["v_x"], (exact("0.2") + exact("0.4") * exact("0.7")) / exact("1.4")) < 1e-32
    )


def test_what_is_done_is_kept_of_a_motion_that_switches():
    values, steps = DISK | {"mu": "0.3"}, 170
    start = {"theta": "60 deg", "phi_dot": 3, "omega_3": 8}
    run = ph.simulate(
        disks.with_friction(),
        values,
        start,
        "0.3",
        samples=11,
        precision="quadruple",
        progress=Impatient(steps),
    )
    assert kinds(run)[-1] == "interrupted"
    assert 0 < run.duration < 0.3
    assert run.t[-1] <= run.duration
    assert run.drift.energy < 1e-32


@pytest.mark.parametrize(("precision", "error"), [("extended", 1e-17), ("quadruple", 1e-31)])
def test_a_ball_that_bounces_twice(precision, error):
    """A height that starts again from zero is over the time since then, in numbers of one sort."""
    start = {"z": "0.1 m", "v_z": 0}
    run = ph.simulate(
        balls.on_table(), BALL | {"e": "0.5"}, start, "0.5 s", precision=precision, samples=3
    )
    falls = DIGITS.sqrt(2 * exact("0.08") / G)
    landed = [event.time for event in run.events if event.kind == "bounces"]
    assert off(landed[0], falls) < error
    assert off(landed[1], 2 * falls) < error
    assert off(landed[2], 2.5 * falls) < error
