"""Derivations with a planted slip: is the first wrong line named, and what is drawn from it?

SymPy works the derivations out; nothing of the review takes part. Some kinds were made up for this,
others are the chains of the problem set, and others take up a solution that polhode writes. All
such solutions are reviewed untouched as well.
"""

from collections.abc import Callable, Iterable
from functools import partial

import pytest

from judge.derivations import Derivation, derivation, shortened
from judge.marking import Marking, marked
from judge.own_solutions import ALL, doubted, written
from judge.problem_set_chains import CHAINS, LEFT_OUT
from judge.solutions_with_slips import solution
from proof.ledger import Ledger

SLIPS, UNTOUCHED = 300, 100
OF_PROBLEM_SET = "chains of the problem set"
DRAWN: dict[str, Callable[..., Derivation]] = {
    "every line": derivation,
    OF_PROBLEM_SET: partial(derivation, families=CHAINS),
    "solutions by Lagrange's method": solution,
}


def _print(markings: Iterable[Marking]) -> None:
    for marking in markings:
        made = marking.derivation
        print(f"{made.kind.name}, line {made.slip} is wrong:")
        print(made.text)
        print([line.mark.value for line in marking.displayed])


@pytest.mark.parametrize("part", [*DRAWN, "two of five lines left out"])
def test_slips(part: str, ledger: Ledger) -> None:
    made = [DRAWN.get(part, derivation)(seed, with_slip=True) for seed in range(SLIPS)]
    if part not in DRAWN:
        made = [shortened(each, seed) for seed, each in enumerate(made)]
    found = [marked(each) for each in made]
    drawn, following = sum(len(m.drawn) for m in found), sum(m.following for m in found)
    unnamed = [m for m in found if not m.is_named]
    doubts = [m for m in found if m.false_marks]
    _print((*unnamed, *doubts))
    ledger.part, ledger.cases = part, SLIPS
    ledger.error(len(unnamed) / SLIPS, 0.05, 1.0, "slips not named")
    ledger.error(
        1 - following / drawn, 0.10, 1.0, f"of {drawn} lines drawn from slips, not so said"
    )
    ledger.error(len(doubts) / SLIPS, 0.02, 1.0, "slips with a doubtful mark on a right line")
    ledger.where += (
        f"; {SLIPS - len(unnamed)} of {SLIPS} named, {following} of {drawn} drawn lines follow, "
        f"{len(doubts)} with a doubtful mark on a right line"
    )
    if part == OF_PROBLEM_SET:
        ledger.where += "; left out: " + "; ".join(f"{n}, {why}" for n, why in LEFT_OUT.items())


@pytest.mark.parametrize("part", DRAWN)
def test_untouched(part: str, ledger: Ledger) -> None:
    found = [marked(DRAWN[part](seed, with_slip=False)) for seed in range(UNTOUCHED)]
    false = [m for m in found if m.false_marks]
    _print(false)
    ledger.part, ledger.cases = f"untouched, {part}", UNTOUCHED
    ledger.error(len(false) / UNTOUCHED, 0.0, 1.0, "false marks")
    assert not false


def test_own_solutions(ledger: Ledger) -> None:
    texts = [
        (name, format, route)
        for name, route in ALL
        for format in (".tex", ".md")
        if written(name, format, route)
    ]
    false = {key: found for key in texts if (found := doubted(*key))}
    print(false)
    ledger.part, ledger.cases = "solutions that polhode writes", len(texts)
    ledger.error(len(false) / len(texts), 0.0, 1.0, "solutions with a false mark")
    assert not false
