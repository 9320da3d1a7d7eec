"""Derivations with a planted slip: is the first wrong line named, and what is drawn from it?

SymPy works the derivations out; nothing of the review takes part.
"""

import pytest

from proof.ledger import Ledger
from review.derivations import derivation, shortened
from review.marking import marked

SLIPS, UNTOUCHED = 300, 100


@pytest.mark.parametrize("part", ["every line", "two of five lines left out"])
def test_slips(part: str, ledger: Ledger) -> None:
    made = [derivation(seed, with_slip=True) for seed in range(SLIPS)]
    if part != "every line":
        made = [shortened(each, seed) for seed, each in enumerate(made)]
    found = [marked(each) for each in made]
    drawn, following = sum(len(m.drawn) for m in found), sum(m.following for m in found)
    unnamed = [m for m in found if not m.is_named]
    doubted = [m for m in found if m.false_marks]
    for marking in (*unnamed, *doubted):
        print(f"{marking.derivation.kind.name}, line {marking.derivation.slip} is wrong:")
        print(marking.derivation.text)
        print([line.mark.value for line in marking.review.lines])
    ledger.part, ledger.cases = part, SLIPS
    ledger.error(len(unnamed) / SLIPS, 0.05, 1.0, "slips not named")
    ledger.error(
        1 - following / drawn, 0.10, 1.0, f"of {drawn} lines drawn from slips, not so said"
    )
    ledger.error(len(doubted) / SLIPS, 0.02, 1.0, "slips with a doubtful mark on a right line")
    ledger.where += (
        f"; {SLIPS - len(unnamed)} of {SLIPS} named, {following} of {drawn} drawn lines follow, "
        f"{len(doubted)} with a doubtful mark on a right line"
    )


def test_untouched(ledger: Ledger) -> None:
    found = [marked(derivation(seed, with_slip=False)) for seed in range(UNTOUCHED)]
    false = [m for m in found if m.false_marks]
    for marking in false:
        print(marking.derivation.text)
        print([line.mark.value for line in marking.review.lines])
    ledger.part, ledger.cases = "untouched", UNTOUCHED
    ledger.error(len(false) / UNTOUCHED, 0.0, 1.0, "false marks")
    assert not false
