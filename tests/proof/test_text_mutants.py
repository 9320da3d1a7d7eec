"""Slips of characters in true lines of every context: caught, and put right?

What makes the slips and what decides whether a line is still true share nothing with polhode.
"""

import pytest

from claims.text_mutation import CONTEXTS, own_lines, problem_set_lines, tried
from proof.ledger import Ledger

MOST = {"own": 12, "problem set": 4}  # of one line, drawn at random but of every kind


@pytest.mark.parametrize("part", MOST)
def test_text_mutants(part: str, ledger: Ledger, capsys: pytest.CaptureFixture[str]) -> None:
    lines = own_lines() if part == "own" else problem_set_lines()
    with capsys.disabled():
        tallies = tried(lines, MOST[part], seed=1, tell=lambda done: print(done, flush=True))
        for context in (c for c in CONTEXTS if c in tallies):
            tally = tallies[context]
            print(f"\n{part}, {context}: {tally}")
            for what in ("missed", "definition", "alarm", "refused", "undecided, passed", "unlike"):
                print("\n".join(f"  {what}: {line}" for line in tally.lines.get(what, [])))
    ledger.part = part
    for context, tally in tallies.items():
        ledger.cases += tally.false
        ledger.aside += tally.counts["undecided"]
        ledger.error(1 - tally.caught, 0.01, 1.0, f"{context}: false mutants not caught")
        ledger.error(1 - tally.repaired, 0.10, 1.0, f"{context}: failing mutants not put right")
    assert not any(tally.lines.get("alarm") for tally in tallies.values())
