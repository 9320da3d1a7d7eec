"""A block shaken and tilted a hundred thousand times, and by one part in a billion too much."""

import numpy as np
import pytest

from oracles.blocks import Shaken, Tilted
from polhode.base import PolhodeError
from proof.ledger import Ledger
from simulate.contact.blocks import rocked, shaken, tilted
from simulate.contact.test_block import OMEGA, PASSED, G, creep, reach_at

FIRST = 300_000
PERIODS = 100_000


@pytest.mark.parametrize("ratio", [0.5, 1 - PASSED])
def test_block_shaken_for_long(ratio: float, ledger: Ledger) -> None:
    reach = reach_at(0.3, ratio)
    ledger.cases += 1
    run = shaken(0.3, 0.3, reach, OMEGA, PERIODS * 2 * np.pi / OMEGA, samples=50_001)
    assert [event.kind for event in run.events] == ["start", "end"]
    ledger.error(creep(run), 1e-14, 1.0, f"creep, {ratio}")


def test_block_shaken_and_tilted_for_long(ledger: Ledger) -> None:
    ledger.cases += 1
    run = rocked(0.4, 2e-3, 0.1, OMEGA, PERIODS * 2 * np.pi / OMEGA, samples=50_001)
    assert [event.kind for event in run.events] == ["start", "end"]
    ledger.error(creep(run), 1e-14, 1.0, "creep")
    ledger.error(float(np.abs(run["y"] - run["y"][0]).max()), 0.0, 1.0, "creep across")


def test_block_shaken_a_billionth_too_much(ledger: Ledger) -> None:
    """At what instant it slips is known to the root of the rounding, near the crest."""
    for seed in range(FIRST, FIRST + 100):
        rng = np.random.default_rng(seed)
        mu, w = float(rng.uniform(0.05, 1.0)), float(rng.uniform(1.0, 100.0))
        mu_static = mu * float(rng.uniform(1.02, 2.0))
        block = Shaken(mu_static * G * (1 + PASSED) / w**2, w, mu, mu_static, G)
        ledger.cases += 1
        try:
            run = shaken(mu, mu_static, block.reach, w, block.sticks * 1.01, samples=2)
        except PolhodeError as error:
            ledger.failures.append(f"seed {seed} is lost: {error}")
            continue
        kinds = [event.kind for event in run.events]
        if kinds != ["start", "slips", "sticks", "end"]:
            ledger.failures.append(f"seed {seed}: {kinds}")
            continue
        slips, sticks = (event.time for event in run.events[1:3])
        moved = float(run.final["x"] - run.evaluate("X", run.duration))
        condition = 1 / np.sqrt(2 * PASSED)
        ledger.error(abs(slips - block.slips) * w, 1e-10, condition, f"slips, seed {seed}")
        ledger.error(abs(sticks - block.sticks) * w, 1e-9, condition, f"sticks, seed {seed}")
        ledger.error(abs(moved - block.shift) / block.reach, 1e-9, condition, f"seed {seed}")


def test_block_tilted(ledger: Ledger) -> None:
    for seed in range(FIRST, FIRST + 50):
        rng = np.random.default_rng(seed)
        mu, rate, y = (float(rng.uniform(*span)) for span in ((0.1, 1.0), (0.05, 0.8), (0, 0.5)))
        block = Tilted(rate, 0.2, y, mu, G)
        ledger.cases += 1
        run = tilted(mu, rate, y, block.slips * 1.1)
        assert run.events[1].kind == "slips"
        ledger.error(abs(run.events[1].time - block.slips), 1e-12, 1.0, f"slips, seed {seed}")
        within = run.evaluate("y", np.linspace(0.0, block.slips * (1 - 1e-9), 50))
        ledger.error(float(np.abs(within - y).max()), 0.0, 1.0, f"creep, seed {seed}")
