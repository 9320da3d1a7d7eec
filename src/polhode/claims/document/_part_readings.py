"""The one reading that each part of a document keeps for a letter of several meanings.

An author who writes **L** for the angular momentum about the fixed point does so in a whole part of
a text. Where nothing states which point is meant, the reading under which most lines hold is
proposed for all lines of the part; a line that is true only under another stays ambiguous, since
it uses the letter in two senses.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from polhode.claims._readings import Chosen, ambiguous_between, joint_choices, plain_letter
from polhode.claims._verdict import Answer, Verdict, VerdictInReading
from polhode.claims.latex._names import name_latex
from polhode.claims.latex._tree import Name
from polhode.claims.meaning._vocabulary import Reading

_FEWEST = 2  # lines with a letter: one alone cannot decide how it is to be read itself


@dataclass(frozen=True)
class ReadingCount:
    """How many lines hold if their letters are read in one way.

    Attributes:
        chosen: the quantity that each letter means.
        holding: the number of lines that hold.
    """

    chosen: Chosen
    holding: int

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document."""
        read = [{"letter": name_latex(n), "meaning": p} for n, p in self.chosen.items()]
        return {"readings": read, "holding": self.holding}


@dataclass(frozen=True)
class PartReading:
    """The reading proposed for letters throughout a part of a document.

    Attributes:
        part: id of the part.
        kept: the reading under which most lines hold.
        others: the other readings.
        lines: the number of judged lines with these letters.
    """

    part: str
    kept: ReadingCount
    others: tuple[ReadingCount, ...]
    lines: int

    def __str__(self) -> str:
        chosen = self.kept.chosen
        meant = " and ".join(f"{plain_letter(n)} as {phrase}" for n, phrase in chosen.items())
        others = (f"{_briefly(other.chosen, chosen)}: {other.holding}" for other in self.others)
        return (
            f"read {meant} throughout part {self.part}: {self.kept.holding} of {self.lines} lines "
            f"with {' or '.join(map(plain_letter, chosen))} hold; {'; '.join(others)}"
        )

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document."""
        others = [other.to_json() for other in self.others]
        return {"part": self.part, **self.kept.to_json(), "lines": self.lines, "others": others}


def _briefly(other: Chosen, kept: Chosen) -> str:
    """Another reading without the words that it shares with the one kept: "about cm"."""
    return " and ".join(dict.fromkeys(_point_or_all(p, kept[n]) for n, p in other.items()))


def _point_or_all(phrase: str, kept: str) -> str:
    quantity, about, point = phrase.partition(" about ")
    return f"about {point}" if about and kept.startswith(f"{quantity} about ") else phrase


def part_readings(part: str, verdicts: Iterable[Verdict]) -> tuple[PartReading, ...]:
    """The readings proposed for a part whose lines have these verdicts.

    No reading is proposed where two are equally good or a single line has the letter.
    """
    # A line that makes sense in one reading only says nothing about the others.
    lines = [verdict.by_reading for verdict in verdicts if len(verdict.by_reading) > 1]
    meanings: dict[Name, dict[str, None]] = {}
    for name, phrase in (pair for ways in lines for way in ways for pair in way.chosen.items()):
        meanings.setdefault(name, {})[phrase] = None
    groups = joint_choices(
        [Reading(n, "", tuple(sorted(p))) for n, p in meanings.items() if len(p) > 1]
    )
    found = (_counted(part, choices, lines) for choices in groups)
    return tuple(
        reading
        for reading in found
        if reading.lines >= _FEWEST and reading.kept.holding > reading.others[0].holding
    )


def _counted(
    part: str, choices: Sequence[Chosen], lines: Sequence[Sequence[VerdictInReading]]
) -> PartReading:
    with_letter = [ways for ways in lines if ways[0].chosen.keys() & choices[0].keys()]
    counts = [
        ReadingCount(c, sum(any(w.verdict.holds for w in _under(c, ways)) for ways in with_letter))
        for c in choices
    ]
    best, *others = sorted(counts, key=lambda count: -count.holding)
    return PartReading(part, best, tuple(others), len(with_letter))


def _under(chosen: Chosen, ways: Iterable[VerdictInReading]) -> list[VerdictInReading]:
    """The ways of reading a line that agree with a choice of its letters."""
    return [
        w for w in ways if all(w.chosen.get(n, phrase) == phrase for n, phrase in chosen.items())
    ]


def chosen_in(readings: Iterable[PartReading]) -> Mapping[str, Chosen]:
    """The choices proposed, by the part for which they are."""
    found: dict[str, dict[Name, str]] = {}
    for reading in readings:
        found.setdefault(reading.part, {}).update(reading.kept.chosen)
    return found


def under_part_reading(verdict: Verdict, chosen: Chosen) -> Verdict | None:
    """The verdict on a line whose part reads letters as chosen; None where it must be judged anew.

    It must be where it fails in every reading: its correction was sought under another one.
    """
    ways = _under(chosen, verdict.by_reading)
    if not ways or not any(way.chosen.keys() & chosen.keys() for way in ways):
        return verdict  # the letters are not in it, or make sense in another meaning only
    answers = {way.verdict.answer for way in ways}
    if len(answers) > 1:  # by another letter, for which nothing is proposed
        return _remaining(verdict, ways)
    (answer,) = answers
    if verdict.answer is Answer.AMBIGUOUS and not ways[0].verdict.holds:
        return _mixed_use(verdict, ways[0], chosen)
    if answer is Answer.FAILS:
        return verdict if ways[0] is verdict.by_reading[0] else None
    return _settled(verdict, ways[0], chosen)


def _settled(verdict: Verdict, kept: VerdictInReading, chosen: Chosen) -> Verdict:
    """The verdict under the reading kept; says that it was proposed, where that decides."""
    read = " and ".join(plain_letter(name) for name in chosen if name in kept.chosen)
    remarks = kept.verdict.remarks
    if verdict.answer is Answer.AMBIGUOUS:
        remarks = (*remarks, f"{read} read as proposed for this part")
    return replace(kept.verdict, remarks=remarks, by_reading=verdict.by_reading)


def _remaining(verdict: Verdict, ways: Sequence[VerdictInReading]) -> Verdict:
    remaining = ambiguous_between(ways)
    return replace(verdict, reason=remaining.reason)


def _mixed_use(verdict: Verdict, kept: VerdictInReading, chosen: Chosen) -> Verdict:
    """The verdict on a line that is true only under a reading that its part does not keep."""
    read = " and ".join(
        f"{plain_letter(n)} as {phrase}" for n, phrase in chosen.items() if n in kept.chosen
    )
    reason = f"the lines of this part read {read}; {verdict.reason}"
    return replace(verdict, reason=reason)
