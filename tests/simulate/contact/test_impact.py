"""Shocks of random bodies: energy never rises, friction keeps to its cone, Stronge's law holds."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from oracles.shocks import felt_inertia, lost, random_shock, stepped
from polhode.simulate.contact._impact import (
    Impact,
    Roughness,
    coulomb_impact,
    rough_impact,
    smooth_impact,
)
from polhode.simulate.integrate._number_types import ManyDigits, numbers_for

RESTITUTIONS = st.sampled_from([0.0, 0.3, 0.7, 1.0])
FRICTIONS = st.sampled_from([0.0, 0.05, 0.2, 0.6, 1.5])


@given(st.integers(0, 10**6), FRICTIONS, RESTITUTIONS, st.sampled_from([1.0, 1.3]))
def test_energy_never_rises(seed: int, mu: float, restitution: float, ratio: float) -> None:
    felt, velocity = random_shock(np.random.default_rng(seed))
    spread = np.linalg.eigvalsh(felt)
    assume(spread[0] > 1e-3 * spread[-1])  # an inverse inertia is positive definite
    assume(felt[2, 2] > 1.05 * mu * np.hypot(*felt[2, :2]))  # friction that cannot jam
    shock = coulomb_impact(felt, velocity, Roughness(mu, ratio * mu, restitution))
    scale = lost(felt, velocity, np.zeros(3))
    p_x, p_y, p_z = shock.impulse
    assert np.abs(velocity + felt @ shock.impulse - shock.velocity).max() < 1e-11
    assert lost(felt, velocity, shock.velocity) > -1e-11 * scale
    assert p_z > 0
    assert np.hypot(p_x, p_y) <= ratio * mu * p_z * (1 + 1e-9)
    assert shock.velocity[2] >= -1e-12
    if shock.sticks:
        assert np.hypot(*shock.velocity[:2]) < 1e-11


@given(st.integers(0, 10**6), RESTITUTIONS)
def test_without_friction(seed: int, restitution: float) -> None:
    felt, velocity = random_shock(np.random.default_rng(seed))
    plain = smooth_impact(felt, velocity, restitution)
    slippery = coulomb_impact(felt, velocity, Roughness(0.0, 0.0, restitution))
    assert np.abs(plain.velocity - slippery.velocity).max() < 1e-9
    assert abs(plain.velocity[2] + restitution * velocity[2]) < 1e-12
    if restitution == 1.0:
        assert abs(lost(felt, velocity, plain.velocity)) < 1e-12 * lost(felt, velocity, np.zeros(3))


@given(st.integers(0, 10**6), RESTITUTIONS)
def test_without_slip(seed: int, restitution: float) -> None:
    felt, velocity = random_shock(np.random.default_rng(seed))
    shock = rough_impact(felt, velocity, (restitution, 0.0))
    assert np.abs(shock.velocity[:2]).max() < 1e-12
    assert shock.velocity[2] >= 0
    assert lost(felt, velocity, shock.velocity) > -1e-12


@pytest.mark.parametrize("seed", range(12))
def test_against_small_steps(seed: int) -> None:
    """A scheme of first order: half the step, half the difference."""
    rng = np.random.default_rng(seed)
    felt, velocity = random_shock(rng)
    mu, restitution = float(rng.uniform(0.05, 0.7)), float(rng.uniform(0.1, 1.0))
    shock = coulomb_impact(felt, velocity, Roughness(mu, mu, restitution))
    _, coarse = stepped(felt, velocity, mu, restitution, 1000)
    _, fine = stepped(felt, velocity, mu, restitution, 4000)
    assert np.abs(fine - shock.velocity).max() < 4e-3
    assert np.abs(fine - shock.velocity).max() < 0.6 * np.abs(coarse - shock.velocity).max() + 5e-4


@pytest.mark.parametrize("mu", [0.05, 0.3, 2.0])
def test_ball_in_closed_form(mu: float) -> None:
    """A ball takes at most μ (1 + 1/k)(1 + e) c off its slip, and all restitutions agree."""
    m, a, k, e = 0.3, 0.1, 0.4, 0.7
    felt = felt_inertia(m, k * m * a * a * np.eye(3), np.array([0.0, 0.0, -a]))
    velocity = np.array([0.6, -0.8, -2.0])
    shock = coulomb_impact(felt, velocity, Roughness(mu, mu, e))
    left = max(1.0 - mu * (1 + 1 / k) * (1 + e) * 2.0, 0.0)
    assert abs(shock.velocity[2] - e * 2.0) < 1e-14
    assert np.abs(shock.velocity[:2] - left * velocity[:2]).max() < 1e-14
    assert shock.sticks == (left == 0.0)


@pytest.mark.parametrize("seed", range(4))
def test_beyond_doubles_it_is_the_same_shock(seed: int) -> None:
    """Friction turns the slip of these: in doubles by Runge and Kutta, beyond by power series."""
    rng = np.random.default_rng(seed)
    lever = rng.normal(size=(3, 3))
    felt, velocity = lever @ lever.T + 0.3 * np.eye(3), rng.normal(size=3)
    velocity[2] = -abs(velocity[2])
    double = coulomb_impact(felt, velocity, Roughness(0.3, 0.4, 0.6))
    fine, finer = (_in_numbers(felt, velocity, numbers_for(p).careful) for p in ("quadruple", 50))
    assert np.max(np.abs(fine.velocity - double.velocity)) < 1e-12
    assert np.max(np.abs(fine.impulse - double.impulse)) < 1e-12
    assert max(abs(fine.velocity - finer.velocity)) < 1e-31
    assert max(abs(fine.impulse - finer.impulse)) < 1e-31


@pytest.mark.parametrize("unit", [1e-9, 1e-6, 1e-3, 1e3, 1e9])
def test_a_light_body_takes_the_same_shock(unit: float) -> None:
    """In other units of mass impulses are other numbers, and velocities are the same ones."""
    lever = np.random.default_rng(2).normal(size=(3, 3))
    felt, velocity = lever @ lever.T + 0.3 * np.eye(3), np.array([0.4, -0.7, -1.1])
    rough = Roughness(0.3, 0.4, 0.6)
    one, other = (coulomb_impact(w, velocity, rough) for w in (felt, felt / unit))
    assert np.max(np.abs(one.velocity - other.velocity)) < 1e-14
    assert np.max(np.abs(one.impulse - other.impulse / unit)) < 1e-14


def _in_numbers(felt: np.ndarray, velocity: np.ndarray, numbers: ManyDigits) -> Impact:
    rough = Roughness(*numbers.array([0.3, 0.4, 0.6]))
    given = numbers.array(felt), numbers.array(velocity)
    return coulomb_impact(*given, rough, "a contact", numbers)
