"""Slips in every claim of the problem set that holds: caught, and put right?

Whether a mutant is true still is decided by the oracles, which know nothing of polhode. The counts
so far are printed with every claim, so that an interrupted campaign is not lost.
"""

import pytest

from judge.mutation import document, tried, true_claims
from proof.ledger import Ledger

MOST = 6  # of one claim, drawn at random; 1000 are all of them, and take hours


def _told(progress: str) -> None:
    """The claim at hand and the counts so far."""
    print("; ".join(progress.splitlines()[:3]), flush=True)


def test_mutants_of_the_problem_set(ledger: Ledger, capsys: pytest.CaptureFixture[str]) -> None:
    with capsys.disabled():
        counts = tried(true_claims(), MOST, seed=1, tell=_told)
        print(f"\n{counts}")
        print("\n".join([*counts.missed, *counts.alarms, *counts.unlike]))
    ledger.part = document().title
    ledger.cases, ledger.aside = counts.untrue, counts.total["set aside"]
    ledger.error(1 - counts.caught, 0.01, 1.0, "untrue mutants not caught")
    ledger.error(1 - counts.repaired, 0.10, 1.0, "caught mutants not put right")
    assert counts.alarms == []
