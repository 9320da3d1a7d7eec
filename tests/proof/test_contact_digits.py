"""The sheets on which slip begins most abruptly, in twenty-two digits."""

import numpy as np
import pytest

from proof.ledger import Ledger
from simulate.contact.paper import LAST, case
from simulate.contact.test_digits import ABRUPT, errors

TIMES = np.array([0.3, 0.8, 1.2, LAST])


@pytest.mark.parametrize("seed", [ABRUPT, 100_570, 100_626, 101_054, 101_210, 101_254])
def test_ball_in_digits(seed: int, ledger: Ledger) -> None:
    ledger.cases += 1
    ours, oracle = errors(case(seed), TIMES)
    ledger.error(ours, 1e-12, 1.0, f"ours, seed {seed}")
    ledger.error(oracle, 1e-10, 1.0, f"oracle, seed {seed}")
