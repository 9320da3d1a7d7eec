"""The classics of the catalogue against closed forms, each worked out by hand or by its source."""

from functools import cache

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE, CLASSICS, cases_of, numbers_of
from polhode.derive import automaton
from polhode.model import with_friction

G = 9.81


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(CATALOGUE[name].build())


@cache
def run(name: str) -> ph.Trajectory:
    """The motion that `polhode run` shows."""
    entry = CATALOGUE[name]
    flight = automaton(entry.build()).separated.equations
    numbers = numbers_of(entry, equations(name), flight=flight)
    return ph.simulate(entry.build(), numbers.parameters, numbers.start, numbers.duration)


def of_kind(name: str, kind: str) -> list:
    return [event for event in run(name).events if event.kind == kind]


def values(name: str) -> dict[str, float]:
    return dict(numbers_of(CATALOGUE[name], equations(name)).parameters)


def frequencies(found: ph.Stability, known: dict[str, float]) -> list[float]:
    """In rad/s."""
    used = {s for frequency in found.frequencies for s in frequency.symbols()}
    given = {s: known[s.published] for s in used if s.published in known}
    program = ph.compile_program(found.frequencies, tuple(given))
    return list(program.function()(*given.values()))


@pytest.mark.parametrize("name", CLASSICS)
def test_the_energy_balances(name: str) -> None:
    assert run(name).drift.energy < 1e-12


def test_a_ball_leaves_a_sphere() -> None:
    """At 10/17 of its first height over the centre (energy, and N = 0)."""
    (leaves,) = of_kind("ball-on-sphere", "lifts off")
    assert np.cos(leaves.state_before["u"]) == pytest.approx(
        10 / 17 * np.cos(np.radians(3)), rel=1e-12
    )


def test_a_ball_oscillates_in_a_bowl() -> None:
    known = values("ball-in-bowl")
    bottom = ph.steady(equations("ball-in-bowl"))[0]
    found = frequencies(ph.stability(bottom, at={"omega_n": 0}), known)
    expected = np.sqrt(5 * G / (7 * (known["R"] - known["a"])))
    assert found == pytest.approx([expected] * 2, rel=1e-12)


def test_a_ball_turns_back_in_a_cylinder() -> None:
    """5 g/Ω² below its start, for Ω = u̇ (energy, with ω̇ₙ = −u̇ v̇/a integrated)."""
    lowest = min(run("ball-in-cylinder")["v"])
    assert lowest == pytest.approx(-5 * G / 20**2, rel=1e-5)  # of samples


def test_a_wedge_is_pushed_back() -> None:
    known, motion = values("cylinder-on-wedge"), run("cylinder-on-wedge")
    m, M, alpha = (known[name] for name in ("m", "M", "alpha"))
    sine, cosine = np.sin(alpha), np.cos(alpha)
    expected = 2 * m * G * sine * cosine / (3 * (M + m) - 2 * m * cosine**2)
    assert motion["v_y_w"][-1] / motion.t[-1] == pytest.approx(expected, rel=1e-12)


def test_a_cylinder_rolls_in_a_cylinder() -> None:
    known = values("cylinder-in-cylinder")
    found = frequencies(ph.stability(ph.steady(equations("cylinder-in-cylinder"))[0]), known)
    expected = np.sqrt(2 * G / (3 * (known["R"] - known["a"])))
    assert found == pytest.approx([expected], rel=1e-12)


def test_a_ladder_leaves_the_wall() -> None:
    """At two thirds of its first height."""
    leaves = of_kind("ladder", "lifts off")[0]
    expected = 2 / 3 * np.sin(np.radians(75))
    assert np.sin(leaves.state_before["alpha"]) == pytest.approx(expected, rel=1e-12)


def test_a_tippe_top_turns_over() -> None:
    """It keeps Jellett's integral, the angular momentum along the arm of the contact."""
    known, entry = values("tippe-top"), CATALOGUE["tippe-top"]
    (case,) = cases_of(entry)
    sliding = with_friction(entry.build(), float(case.mu))
    numbers = numbers_of(entry, equations("tippe-top"), start=case.start)
    start = {**numbers.start, "v_x": 0, "v_y": 0}
    motion = ph.simulate(sliding, numbers.parameters, start, case.duration)
    theta, phi_dot, omega = (motion[name] for name in ("theta", "phi_dot", "omega_3"))
    A, C, R, h = (known[name] for name in ("A", "C", "R", "h"))
    jellett = A * phi_dot * np.sin(theta) ** 2 * R + C * omega * (R * np.cos(theta) - h)
    assert jellett == pytest.approx(np.full_like(jellett, jellett[0]), rel=1e-11)
    assert theta[-1] > 2.4


def test_a_block_rocks_as_housner_says() -> None:
    """Each impact leaves 1 - 3/2 sin² α (Housner, Bull. Seism. Soc. Am. 53, 403, 1963)."""
    known, impacts = values("rocking-block"), of_kind("rocking-block", "touches down")
    kept = 1 - 1.5 * known["w"] ** 2 / (known["w"] ** 2 + known["h"] ** 2)
    for impact in impacts[:20]:
        before, after = impact.state_before["theta_dot"], impact.state_after["theta_dot"]
        assert after == pytest.approx(kept * before, rel=1e-12)
    assert run("rocking-block").mode == "rolling"
    assert run("rocking-block").final["theta_dot"] == 0


def test_eulers_disk_stops_at_a_finite_time() -> None:
    """3/2 m g a θ̇ = -μ m g a Ω with Ω² = 4 g/(a θ), while it is flat and slow to change."""
    known, motion = values("eulers-disk"), run("eulers-disk")
    (flat,) = of_kind("eulers-disk", "goes flat")
    left = flat.time * np.array([0.2, 0.4])
    theta = [float(motion.evaluate("theta", flat.time - t)) for t in left]
    rate = known["mu"] * np.sqrt(4 * G / known["a"])
    assert theta == pytest.approx((rate * left) ** (2 / 3), rel=1e-2)


def test_a_cue_ball_ends_rolling() -> None:
    """v = (5 v₀ + 2 a ω₀ × n)/7, whatever the friction."""
    final, a = run("cue-ball"), values("cue-ball")["a"]
    assert final["v_x"][-1] == pytest.approx((5 * 2 + 2 * a * -30) / 7, rel=1e-12)
    assert final["v_y"][-1] == pytest.approx(-2 * a * 60 / 7, rel=1e-12)


def test_a_superball_reverses_its_slip() -> None:
    """v' = (3 v + 4 a ω)/7 (Garwin, Am. J. Phys. 37, 88, 1969)."""
    bounce, a = of_kind("superball", "bounces")[0], values("superball")["a"]
    before, after = bounce.state_before, bounce.state_after
    assert after["v_x"] == pytest.approx(
        (3 * before["v_x"] + 4 * a * before["omega_y"]) / 7, rel=1e-12
    )
    assert after["v_z"] == pytest.approx(-before["v_z"], rel=1e-12)


def test_two_balls_part_as_they_met() -> None:
    """Along the line of centres with e times their speed; they turn as before (no friction)."""
    (bounce,), known = of_kind("two-balls", "bounces"), values("two-balls")
    before, after = bounce.state_before, bounce.state_after
    assert after["gap_dot"] == pytest.approx(-0.9 * before["gap_dot"], rel=1e-12)
    assert after["omega_z"] == pytest.approx(before["omega_z"], rel=1e-12)
    lost = run("two-balls")["energy"][0] - run("two-balls")["energy"][-1]
    reduced = known["m"] * known["M"] / (known["m"] + known["M"])
    assert lost == pytest.approx(reduced / 2 * before["gap_dot"] ** 2 * (1 - 0.9**2), rel=1e-10)


def points_of_a_cone(h: float, alpha: float) -> tuple[np.ndarray, np.ndarray]:
    """Points of a cone with its apex at the origin about the third axis, and shares of its mass."""
    z, weight = np.polynomial.legendre.leggauss(12)
    z, weight = h * (z + 1) / 2, weight / 2
    s, share = np.polynomial.legendre.leggauss(8)
    s, share = (s + 1) / 2, share / 2
    turns = 2 * np.pi * np.arange(12) / 12
    grid = np.meshgrid(np.arange(12), np.arange(8), turns, indexing="ij")
    i, j, turn = grid[0], grid[1], grid[2]
    radius = z[i] * np.tan(alpha) * np.sqrt(s[j])  # equal areas in equal steps of s
    places = np.stack([radius * np.cos(turn), radius * np.sin(turn), z[i]])
    masses = 3 * (z[i] / h) ** 2 * weight[i] * share[j] / 12
    return places.reshape(3, -1), masses.ravel()


def test_a_cone_rolls_around_its_apex() -> None:
    """Energy and forces from the points of the cone, which turns about the line that touches."""
    known, rate = values("rolling-cone"), 4.0
    m, h, alpha = known["m"], known["h"], known["alpha"]
    places, shares = points_of_a_cone(h, alpha)
    # the axis along x, up by alpha: the lowest line of the side is along x
    across = np.array(
        [[np.sin(alpha), 0, np.cos(alpha)], [0, 1, 0], [-np.cos(alpha), 0, np.sin(alpha)]]
    )
    at = across @ places
    turning = np.array([-rate / np.tan(alpha), 0, 0])
    velocity = np.cross(turning, at.T).T
    energy = m * np.sum(shares * np.sum(velocity**2, axis=0)) / 2
    assert energy == pytest.approx(3 / 40 * m * h**2 * rate**2 * (1 + 5 * np.cos(alpha) ** 2))
    final = run("rolling-cone").final
    centre = at @ shares
    assert final["energy"] == pytest.approx(energy + m * G * centre[2], rel=1e-12)
    # the angular momentum turns with the cone, by the torque of the weight and of N
    momentum = m * np.sum(shares * np.cross(at.T, velocity.T).T, axis=1)
    torque = np.cross([0, 0, rate], momentum)
    side = h / np.cos(alpha)
    pressing = (m * G * centre[0] - torque[1]) / side
    assert final["N_z"] == pytest.approx(pressing, rel=1e-12)
    assert final["F_z"] == pytest.approx(m * G - pressing, rel=1e-12)


def test_a_cone_that_rolls_too_fast_tips_about_its_edge() -> None:
    """Where nothing presses at the apex: 3 h (1 + 5 cos²α) φ̇² sin α = 5 g (1 + 3 sin²α)."""
    entry, known = CATALOGUE["rolling-cone"], values("rolling-cone")
    sine, cosine = np.sin(known["alpha"]), np.cos(known["alpha"])
    fastest = np.sqrt(5 * G * (1 + 3 * sine**2) / (3 * known["h"] * (1 + 5 * cosine**2) * sine))
    for rate, pulls in ((0.999 * fastest, False), (1.001 * fastest, True)):
        found = ph.simulate(entry.build(), known, {"phi_dot": rate}, 0.1)
        assert (found.final["F_z"] < 0) is pulls
