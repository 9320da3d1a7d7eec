"""The core against itself done another way: differentiation, geometry, integration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from .constraints import (
    Constraint,
    Ellipsoid,
    Held,
    Parts,
    Perpendicular,
    Sliding,
    Smooth,
    SpinRate,
    Spot,
    hinge,
    parallel,
    universal,
)
from .newton_euler import Accelerations, bodies_of, solve, supports_of, weights
from .parts import LAB, Array, Body, Driven, Placed, X, Y, Z, skew, turn_x, turn_z, vector

STEP = 1e-30
GRAVITY = vector(0.3, -0.2, -9.7)
SPOT = Spot(vector(0.3, -0.4, 0.5))
EGG = Ellipsoid((0.7, 0.9, 1.3))
RIM = Ellipsoid((0.7, 0.7, 0))
TILTED = vector(0.6, 0.0, 0.8)

KINDS: dict[str, Constraint] = {
    "spherical joint": Held("a", "b", SPOT),
    "pivot on a moving ground": Held("a", "ground", SPOT),
    "rolling egg on a body": Held("a", "b", EGG, normal=TILTED),
    "rolling sphere": Held("a", "ground", Ellipsoid((0.7, 0.7, 0.7)), normal=TILTED),
    "rolling rim": Held("a", "ground", RIM),
    "smooth egg": Smooth("a", "ground", EGG, normal=TILTED),
    "point in a moving plane": Smooth("a", "b", SPOT, normal=TILTED),
    "sliding rim": Sliding("a", "ground", RIM, 0.4),
    "guide": Perpendicular("a", "ground", X, TILTED),
    "motor": SpinRate("a", "b", TILTED, rate=2.0),
    "hinge": hinge("a", "b", SPOT.at, TILTED, Z),
    "universal joint": universal("a", "ground", SPOT.at, X, Y),
    "equal axes": parallel("a", "ground", Z, Z),
}
IDEAL = [name for name in KINDS if not name.startswith("sliding")]
seeds = pytest.mark.parametrize("seed", range(4))
kinds = pytest.mark.parametrize("kind", KINDS)


def somewhere(rng: np.random.Generator) -> dict[str, Array]:
    attitude, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return {
        "position": rng.normal(size=3),
        "rotation": attitude * np.linalg.det(attitude),
        "velocity": rng.normal(size=3),
        "omega": rng.normal(size=3),
    }


def random_parts(rng: np.random.Generator) -> dict[str, Body | Driven]:
    def body() -> Body:
        return Body(mass=rng.uniform(1, 2), moments=rng.uniform(1, 2, size=3), **somewhere(rng))

    ground = Driven(acceleration=rng.normal(size=3), alpha=rng.normal(size=3), **somewhere(rng))
    return {"a": body(), "b": body(), "ground": ground}


def an_instant_later(part: Placed, rate: Array) -> Placed:
    """The part carried along its motion by an imaginary instant."""
    return replace(
        part,
        position=part.position + 1j * STEP * part.velocity,
        rotation=part.rotation + 1j * STEP * part.rotation_rate,
        velocity=part.velocity + 1j * STEP * rate[:3],
        omega=part.omega + 1j * STEP * rate[3:],
    )


@seeds
@kinds
def test_jacobian_and_bias_are_the_derivative_of_the_residual(kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    parts, constraint = random_parts(rng), KINDS[kind]
    rates = {name: rng.normal(size=6) for name in parts}
    rows = constraint.rows(parts)
    later = {name: an_instant_later(part, rates[name]) for name, part in parts.items()}
    derivative = constraint.rows(later).residual.imag / STEP
    stated = rows.bias + sum(block @ rates[name] for name, block in rows.jacobian.items())
    assert derivative == pytest.approx(stated, rel=1e-11, abs=1e-11)


@seeds
@kinds
def test_reactions_on_the_two_parts_are_opposite_at_one_line(kind: str, seed: int) -> None:
    parts = random_parts(np.random.default_rng(seed))
    rows = KINDS[kind].rows(parts)
    total = sum(wrench_about_the_origin(parts[n], w) for n, w in rows.wrenches.items())
    assert total == pytest.approx(np.zeros_like(total), abs=1e-12)


def wrench_about_the_origin(part: Placed, wrenches: Array) -> Array:
    force, torque = wrenches[:, :3], wrenches[:, 3:]
    return np.hstack([force, torque + np.cross(part.position, force)])


@seeds
@pytest.mark.parametrize("surface", [EGG, RIM])
def test_contact_is_the_lowest_point_of_the_surface(surface: Ellipsoid, seed: int) -> None:
    rng = np.random.default_rng(seed)
    body, normal = random_parts(rng)["a"], TILTED
    lowest, _ = surface.point(body, normal, np.zeros(3))
    directions = rng.normal(size=(2000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    heights = directions * surface.semi_axes @ body.rotation.T @ normal
    along_axes = body.rotation.T @ lowest
    extents = np.array(surface.semi_axes)
    scaled = along_axes[extents > 0] / extents[extents > 0]
    assert lowest @ normal <= heights.min()
    assert lowest @ normal == pytest.approx(heights.min(), rel=0.02)
    assert scaled @ scaled == pytest.approx(1)
    assert along_axes[extents == 0] == pytest.approx(0, abs=1e-12)


@seeds
@pytest.mark.parametrize("kind", IDEAL)
def test_accelerations_meet_newton_euler_and_keep_the_constraint(kind: str, seed: int) -> None:
    parts = random_parts(np.random.default_rng(seed))
    motion = solve(parts, {"it": KINDS[kind]}, weights(parts, GRAVITY))
    rates = twist_rates(parts, motion)
    rows = KINDS[kind].rows(parts)
    kept = rows.bias + sum(block @ rates[name] for name, block in rows.jacobian.items())
    assert kept == pytest.approx(np.zeros_like(kept), abs=1e-11)
    for name, body in bodies_of(parts).items():
        on_body = motion.reactions["it"].get(name)
        force = body.mass * (motion.linear[name] - GRAVITY)
        momentum_rate = body.inertia @ rates[name][3:] - body.gyroscopic_torque
        assert force == pytest.approx(on_body.force if on_body else np.zeros(3), abs=1e-11)
        assert momentum_rate == pytest.approx(on_body.torque if on_body else np.zeros(3), abs=1e-11)


def twist_rates(parts: Parts, motion: Accelerations) -> dict[str, Array]:
    free = {n: np.concatenate([motion.linear[n], motion.angular[n]]) for n in motion.linear}
    return free | {name: support.twist_rate for name, support in supports_of(parts).items()}


def test_friction_is_mu_times_the_normal_force_against_the_slip() -> None:
    parts = random_parts(np.random.default_rng(3))
    motion = solve(parts, {"it": KINDS["sliding rim"]}, weights(parts, -9.8 * Z))
    slip = Held("a", "ground", RIM).rows(parts).residual
    normal = parts["ground"].rotation @ Z
    slip -= normal * (normal @ slip)
    force = motion.reactions["it"]["a"].force
    friction = -0.4 * (force @ normal) * slip / np.linalg.norm(slip)
    assert force - normal * (force @ normal) == pytest.approx(friction, abs=1e-12)


def test_redundant_constraints_share_the_least_reaction() -> None:
    parts = {
        "lab": LAB,
        "beam": Body(mass=3.0, moments=np.ones(3), rotation=np.eye(3), omega=0 * Z),
    }
    ends = {"left": Held("beam", "lab", Spot(-X)), "right": Held("beam", "lab", Spot(X))}
    motion = solve(parts, ends, weights(parts, -10.0 * Z))
    for end in ends:
        assert motion.reactions[end]["beam"].force == pytest.approx(15.0 * Z, abs=1e-12)


def test_a_motor_brings_its_body_up_to_speed_against_the_inertia() -> None:
    wheel = Body(mass=1.0, moments=vector(1, 1, 3), rotation=np.eye(3), omega=2.0 * Z)
    motor = SpinRate("wheel", "lab", Z, rate=2.0, rate_dot=0.7)
    parts = {"lab": LAB, "wheel": wheel}
    motion = solve(parts, {"motor": motor}, {})
    assert motor.rows(parts).residual == pytest.approx(0)
    assert motion.angular["wheel"] == pytest.approx(0.7 * Z)
    assert motion.reactions["motor"]["wheel"].torque == pytest.approx(2.1 * Z)


def test_contradictory_constraints_are_refused() -> None:
    parts = random_parts(np.random.default_rng(0))
    motors = {str(rate): SpinRate("a", "b", Z, rate=0.0, rate_dot=rate) for rate in (1.0, 2.0)}
    with pytest.raises(ArithmeticError, match="no accelerations"):
        solve(parts, motors, {})


def test_a_rolling_disk_integrated_in_maximal_coordinates_keeps_its_contact() -> None:
    """Position, velocity and acceleration of the gap vanish along the path, by differences."""
    attitude = turn_z(0.3) @ turn_x(1.1)
    omega = attitude @ vector(0.5, -0.8, 3.0)
    arm = 0.7 * attitude @ Y
    disk = Body(
        mass=1.3,
        moments=vector(0.2, 0.2, 0.35),
        position=arm,
        velocity=np.cross(omega, arm),
        rotation=attitude,
        omega=omega,
    )
    rolling, step = Held("disk", "lab", RIM), 2e-3
    path = [disk]
    for _ in range(40):
        path.append(runge_kutta(path[-1], rolling, step))
    gaps = np.array([d.position[2] + RIM.point(d, Z, np.zeros(3))[0][2] for d in path])
    slips = np.array([rolling.rows({"lab": LAB, "disk": d}).residual for d in path])
    assert np.abs(path[-1].rotation - attitude).max() > 0.1
    assert np.abs(slips).max() < 1e-10
    assert np.abs(gaps).max() < 1e-10
    assert np.abs(np.diff(gaps, 2)).max() / step**2 < 1e-6
    assert energy(path[-1]) == pytest.approx(energy(disk), rel=1e-10)


def runge_kutta(body: Body, constraint: Constraint, step: float) -> Body:
    def slope(b: Body) -> tuple[Array, ...]:
        parts = {"lab": LAB, "disk": b}
        motion = solve(parts, {"contact": constraint}, weights(parts, -9.8 * Z))
        return b.velocity, skew(b.omega) @ b.rotation, motion.linear["disk"], motion.angular["disk"]

    def moved(slopes: tuple[Array, ...], time: float) -> Body:
        now = (body.position, body.rotation, body.velocity, body.omega)
        r, R, v, w = (x + time * rate for x, rate in zip(now, slopes, strict=True))
        return replace(body, position=r, rotation=R, velocity=v, omega=w)

    k1 = slope(body)
    k2 = slope(moved(k1, step / 2))
    k3 = slope(moved(k2, step / 2))
    k4 = slope(moved(k3, step))
    mean = tuple((p + 2 * q + 2 * r + s) / 6 for p, q, r, s in zip(k1, k2, k3, k4, strict=True))
    return moved(mean, step)


def energy(body: Body) -> float:
    spin = body.omega @ body.inertia @ body.omega
    return float(
        (body.mass * body.velocity @ body.velocity + spin) / 2 + body.mass * 9.8 * body.position[2]
    )
