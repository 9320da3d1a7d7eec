"""Thousands of shocks, hundreds of bouncing balls, and a block shaken a hundred thousand times."""

import numpy as np
import pytest

from oracles.shocks import lost, random_shock
from polhode.simulate._shock import Roughness, coulomb_shock
from proof.ledger import Ledger
from simulate.contact import test_bounce as bounce
from simulate.contact.blocks import shaken
from simulate.contact.test_block import OMEGA, reach_at

FIRST = 200_000
PERIODS = 100_000


def test_shocks(ledger: Ledger) -> None:
    for seed in range(FIRST, FIRST + 3000):
        rng = np.random.default_rng(seed)
        felt, velocity = random_shock(rng)
        mu, restitution = float(rng.choice([0.05, 0.2, 0.6, 1.5])), float(rng.uniform(0, 1))
        shock = coulomb_shock(felt, velocity, Roughness(mu, mu, restitution))
        scale = lost(felt, velocity, np.zeros(3))
        where = f"seed {seed}"
        ledger.cases += 1
        gained = -lost(felt, velocity, shock.velocity) / scale
        ledger.error(max(gained, 0.0), 1e-11, 1.0, f"energy, {where}")
        ledger.error(max(-float(shock.velocity[2]), 0.0), 1e-11, 1.0, f"approach, {where}")
        beyond = float(np.hypot(*shock.impulse[:2]) / (mu * shock.impulse[2])) - 1
        ledger.error(max(beyond, 0.0), 1e-9, 1.0, f"cone, {where}")


def test_bouncing_balls(ledger: Ledger) -> None:
    for seed in range(FIRST, FIRST + 200):
        ledger.cases += 1
        for name, size in bounce.check(bounce.ball_of(seed)).items():
            ledger.error(float(size), 1e-12, 1.0, f"{name}, seed {seed}")


@pytest.mark.parametrize("ratio", [0.5, 1 - 1e-9])
def test_block_shaken_for_long(ratio: float, ledger: Ledger) -> None:
    reach = reach_at(0.3, ratio)
    ledger.cases += 1
    duration = PERIODS * 2 * np.pi / OMEGA
    run = shaken(0.3, 0.3, reach, OMEGA, duration, samples=50_001)
    assert [event.kind for event in run.events] == ["start", "end"]
    moved = run.evaluate("x") - reach * np.sin(OMEGA * run.t)
    ledger.error(float(np.abs(moved - moved[0]).max() / reach), 1e-9, 1.0, f"creep, {ratio}")
