"""Moreau and Jean's scheme on many sheets: its errors stay in proportion to its step."""

from itertools import pairwise

import numpy as np
import pytest

from proof.ledger import Ledger
from simulate.contact.paper import case
from simulate.contact.test_time_stepping import THROWN, check_ball, check_block, check_disk

SEEDS = [seed for seed in range(1, 81) if case(seed).ball.mu == case(seed).ball.mu_static]
STEPS = (1e-3, 2e-4, 4e-5)
MOST = 20.0  # error over step, m/s or m/s²


@pytest.mark.parametrize("seeds", np.array_split(SEEDS, 4), ids=lambda seeds: f"{seeds[0]}")
def test_ball_by_fixed_steps(seeds: np.ndarray, ledger: Ledger) -> None:
    for seed in seeds.tolist():
        ledger.cases += 1
        for step, error in zip(STEPS, check_ball(seed, 2.0, STEPS), strict=True):
            ledger.error(error, MOST * step, 1.0, f"step {step:g} s, seed {seed}")


def test_block_by_fixed_steps(ledger: Ledger) -> None:
    for ratio in (1.05, 1.2, 1.5, 1.7, 2.0, 3.0, 5.0):
        ledger.cases += 1
        counts = tuple(round(1 / step) for step in STEPS)
        for step, error in zip(STEPS, check_block(ratio, 1.0, counts), strict=True):
            ledger.error(error, MOST * step, 1.0, f"step {step:g} s, {ratio} of the limit")


def test_disk_by_fixed_steps(ledger: Ledger) -> None:
    ledger.cases += 1
    errors, _ = check_disk(0.25, THROWN, 0.1, (1000, 2000, 4000, 8000, 16000))
    for coarse, fine in pairwise(errors):
        ledger.error(abs(coarse / fine - 2), 0.1, 1.0, "ratio of errors as the step is halved")
