"""Slips of characters in true lines of every context: caught, and put right?

What makes the slips and what decides whether a line is still true share nothing with polhode.
"""

from itertools import product

import pytest

from judge.text_mutation import CONTEXTS, own_lines, problem_set_lines, tried
from proof.ledger import Ledger

MOST = {"own": 10, "problem set": 3}  # mutants of one line, drawn at random but of every kind
TOLD = ("missed", "definition", "alarm", "refused", "undecided, passed", "unlike")
# The problem set has no claim in the context of printed numbers.
CASES = [case for case in product(MOST, CONTEXTS) if case != ("problem set", "number")]


@pytest.mark.parametrize(("part", "context"), CASES)
def test_text_mutants(part: str, context: str, ledger: Ledger) -> None:
    lines = own_lines() if part == "own" else problem_set_lines([context])
    chosen = [line for line in lines if line.context == context]
    tally = tried(chosen, MOST[part], seed=1)[context]
    print(f"{part}, {context}: {tally}")
    for what in TOLD:
        print("\n".join(f"  {what}: {line}" for line in tally.lines.get(what, [])))
    ledger.part = f"{context}, {part}"
    ledger.cases, ledger.aside = tally.false, tally.counts["undecided"]
    ledger.error(1 - tally.caught, 0.01, 1.0, "false mutants not caught")
    ledger.error(1 - tally.repaired, 0.10, 1.0, "failing mutants not put right")
    ledger.where = f"{ledger.where}: {tally}"
    assert tally.lines.get("alarm", []) == []
