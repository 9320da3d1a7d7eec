"""The kernel: 10,000 random tapes against many digits, and its functions at 30,000 places each."""

from random import Random

import numpy as np
import pytest

from polhode.simulate.kernel._assembly import Module
from polhode.simulate.kernel._elementary import elementary
from proof.ledger import Ledger
from simulate.kernel.hosts import exports
from simulate.kernel.tapes import EPSILON, reached, rounding
from simulate.kernel.test_elementary import CASES, RANGES, error
from simulate.kernel.test_recurrences import drawn_case, first_step

TAPES, BLOCK = 10_000, 500
PLACES = 30_000
ALLOWED = 1e-14  # relative to the states, or absolute where they are below one


@pytest.mark.parametrize("block", range(TAPES // BLOCK))
def test_tapes(block: int, ledger: Ledger) -> None:
    """One step of each, compared with the series of the same rates in balls of 1200 bits."""
    ledger.part = "steps"
    for seed in range(block * BLOCK, (block + 1) * BLOCK):
        program, state, parameters, time = drawn_case(Random(f"proof {seed}"))
        steps = first_step(program, state, parameters, time)
        case = (program, state, parameters, time, float(steps.lengths[0]))
        expected = reached(*case)
        error_ = float(np.max(np.abs(steps.state - expected) / np.maximum(1, np.abs(expected))))
        ledger.cases += 1
        condition = 1.0
        if not error_ <= ALLOWED:
            condition = max(1.0, rounding(*case) / EPSILON)
        ledger.error(error_, max(ALLOWED, condition * EPSILON), condition, f"{seed}")


@pytest.mark.parametrize(("name", "where"), CASES)
def test_functions(name: str, where: str, ledger: Ledger) -> None:
    """In units in the last place."""
    module = Module()
    elementary(module, 1024)
    function = exports(module.binary(65536))[name]
    drawn, draw = Random(f"proof {name} {where}"), RANGES[name][where]
    ledger.part = f"{name}, {where}"
    for _ in range(PLACES):
        place = draw(drawn)
        ledger.cases += 1
        ledger.error(error(name, place, function(place)), 1.0, 1, place.hex())
