"""Thousands of shocks, and hundreds of bouncing balls."""

import numpy as np

from oracles.shocks import lost, random_shock
from polhode.base import PolhodeError
from polhode.simulate.contact._impact import Roughness, coulomb_impact
from proof.ledger import Ledger
from simulate.contact import test_bounce as bounce

FIRST = 200_000


def test_shocks(ledger: Ledger) -> None:
    """Also of bodies so lopsided that sliding without a shock would jam: shocks always end."""
    for seed in range(FIRST, FIRST + 3000):
        rng = np.random.default_rng(seed)
        felt, velocity = random_shock(rng)
        mu, restitution = float(rng.choice([0.05, 0.2, 0.6, 1.5])), float(rng.uniform(0, 1))
        ledger.cases += 1
        where = f"seed {seed}"
        try:
            shock = coulomb_impact(felt, velocity, Roughness(mu, mu, restitution))
        except PolhodeError as error:
            ledger.failures.append(f"{where} is lost: {error}")
            continue
        scale = lost(felt, velocity, np.zeros(3))
        gained = -lost(felt, velocity, shock.velocity) / scale
        ledger.error(max(gained, 0.0), 1e-11, 1.0, f"energy, {where}")
        ledger.error(max(-float(shock.velocity[2]), 0.0), 1e-11, 1.0, f"approach, {where}")
        missed = np.abs(velocity + felt @ shock.impulse - shock.velocity).max()
        ledger.error(float(missed / np.linalg.norm(velocity)), 1e-11, 1.0, f"momentum, {where}")
        beyond = float(np.hypot(*shock.impulse[:2]) / (mu * shock.impulse[2])) - 1
        ledger.error(max(beyond, 0.0), 1e-9, 1.0, f"cone, {where}")


def test_bouncing_balls(ledger: Ledger) -> None:
    for seed in range(FIRST, FIRST + 200):
        ledger.cases += 1
        for name, size in bounce.check(bounce.ball_of(seed)).items():
            ledger.error(float(size), 1e-12, 1.0, f"{name}, seed {seed}")
