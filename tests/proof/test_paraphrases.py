"""Fifty true statements in six ways each, by a reader who did not know the program: its marks."""

from collections import Counter

from judge.paraphrased import ACCUSING, JUDGED, statements
from polhode import Mark
from proof.ledger import Ledger

DOUBTED = 0.10  # of the lines that are judged, at most


def test_paraphrases(ledger: Ledger) -> None:
    marks = Counter[Mark]()
    for statement in statements():
        for way, text in enumerate(statement.ways):
            for line in statement.reviewed(way):
                marks[line.mark] += 1
                if line.mark in ACCUSING:
                    ledger.failures.append(
                        f"{statement.system}: {line.mark.value}: {line.latex} in: {text}"
                    )
            ledger.cases += 1
    judged = sum(marks[mark] for mark in JUDGED)
    ledger.error(marks[Mark.DOUBT] / judged, DOUBTED, 1.0, "of the judged lines in doubt")
    ledger.where += "; " + ", ".join(f"{count} {mark.value}" for mark, count in marks.items())
