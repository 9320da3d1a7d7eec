"""The one reading that each part of a document keeps for a letter of several meanings.

An author who writes **L** for the angular momentum about the fixed point does so in a whole part of
a text. Where nothing states which point is meant, the reading under which most lines hold is
proposed for all lines of the part; a line that is true only under another stays ambiguous, since
it uses the letter in two senses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from polhode.judge._verdict import Answer, Read, Verdict, VerdictInReading
from polhode.judge.latex._tree import Node

#: Letters of several meanings, each with the one that is taken.
Choice = Mapping[Node, Read]

_FEWEST = 2  # lines with a letter: one alone cannot decide how it is to be read itself


@dataclass(frozen=True)
class ReadingCount:
    """How many lines hold if their letters are read in one way.

    Attributes:
        chosen: what each letter means.
        holding: the number of lines that hold.
    """

    chosen: Choice
    holding: int

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document."""
        read = [reading.to_json() for reading in self.chosen.values()]
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
        others = (f"{_briefly(other.chosen, chosen)}: {other.holding}" for other in self.others)
        return (
            f"Read {_meant(chosen)} throughout part {self.part}: {self.kept.holding} of "
            f"{self.lines} lines with {' or '.join(read.plain for read in chosen.values())} hold; "
            f"{'; '.join(others)}."
        )

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document."""
        others = [other.to_json() for other in self.others]
        return {"part": self.part, **self.kept.to_json(), "lines": self.lines, "others": others}


def _meant(chosen: Choice) -> str:
    return " and ".join(f"{read.plain} as {read.meaning}" for read in chosen.values())


def _briefly(other: Choice, kept: Choice) -> str:
    """Another reading without the words that it shares with the one kept: "about cm"."""
    pairs = ((read.meaning, kept[node].meaning) for node, read in other.items())
    return " and ".join(dict.fromkeys(_point_or_all(*pair) for pair in pairs))


def _point_or_all(meaning: str, kept: str) -> str:
    quantity, about, point = meaning.partition(" about ")
    return f"about {point}" if about and kept.startswith(f"{quantity} about ") else meaning


def part_readings(part: str, verdicts: Iterable[Verdict]) -> tuple[PartReading, ...]:
    """The readings proposed for a part whose lines have these verdicts.

    No reading is proposed where two are equally good or a single line has the letter.
    """
    # A line that makes sense in one reading only says nothing about the others.
    lines = [verdict.by_reading for verdict in verdicts if len(verdict.by_reading) > 1]
    found = (_counted(part, choices, lines) for choices in _choices(lines))
    return tuple(
        reading
        for reading in found
        if reading.lines >= _FEWEST and reading.kept.holding > reading.others[0].holding
    )


def _choices(lines: Iterable[Sequence[VerdictInReading]]) -> Iterator[list[dict[Node, Read]]]:
    """The choices for each letter; **L** and τ, which are about one point, are chosen jointly."""
    meanings: dict[Node, dict[str, Read]] = {}
    for node, read in (pair for ways in lines for way in ways for pair in way.chosen.items()):
        meanings.setdefault(node, {})[read.meaning] = read
    groups: dict[tuple[object, ...], list[Node]] = {}
    for node in (node for node, reads in meanings.items() if len(reads) > 1):
        points = tuple(sorted(meaning.partition(" about ")[2] for meaning in meanings[node]))
        groups.setdefault(points if all(points) else (node,), []).append(node)
    for group in groups.values():
        by_point = [
            sorted(meanings[node].items(), key=lambda item: item[0].partition(" about ")[2])
            for node in group
        ]
        ways = zip(*([read for _, read in reads] for reads in by_point), strict=True)
        yield [dict(zip(group, way, strict=True)) for way in ways]


def _counted(
    part: str, choices: Sequence[Choice], lines: Sequence[Sequence[VerdictInReading]]
) -> PartReading:
    with_letter = [ways for ways in lines if ways[0].chosen.keys() & choices[0].keys()]
    counts = [
        ReadingCount(c, sum(any(w.verdict.holds for w in _under(c, ways)) for ways in with_letter))
        for c in choices
    ]
    best, *others = sorted(counts, key=lambda count: -count.holding)
    return PartReading(part, best, tuple(others), len(with_letter))


def _under(chosen: Choice, ways: Iterable[VerdictInReading]) -> list[VerdictInReading]:
    """The ways of reading a line that agree with a choice of its letters."""
    return [w for w in ways if all(w.chosen.get(n, read) == read for n, read in chosen.items())]


def choices_by_part(readings: Iterable[PartReading]) -> Mapping[str, Choice]:
    """The choices proposed, by the part for which they are."""
    found: dict[str, dict[Node, Read]] = {}
    for reading in readings:
        found.setdefault(reading.part, {}).update(reading.kept.chosen)
    return found


def under_part_reading(verdict: Verdict, chosen: Choice) -> Verdict | None:
    """The verdict on a line whose part reads letters as chosen; None where it must be judged anew.

    It must be where it fails in every reading: its correction was sought under another one.
    """
    ways = _under(chosen, verdict.by_reading)
    if not ways or not ways[0].chosen.keys() & chosen.keys():
        return verdict  # the letters are not in it, or make sense in another meaning only
    answers = {way.verdict.answer for way in ways}
    if len(answers) > 1:
        return verdict  # ambiguous by another letter, for which nothing is proposed
    if verdict.answer is Answer.AMBIGUOUS and not ways[0].verdict.holds:
        return _mixed_use(verdict, ways[0], chosen)
    if answers == {Answer.FAILS}:
        return proposed(verdict, chosen) if ways[0] is verdict.by_reading[0] else None
    return replace(proposed(ways[0].verdict, chosen), by_reading=verdict.by_reading)


def proposed(verdict: Verdict, chosen: Choice) -> Verdict:
    """The verdict, which says that readings among these were proposed."""
    known = set(chosen.values())
    readings = (replace(read, proposed=read in known) for read in verdict.readings)
    return replace(verdict, readings=tuple(readings))


def _mixed_use(verdict: Verdict, kept: VerdictInReading, chosen: Choice) -> Verdict:
    """The verdict on a line that is true only under a reading that its part does not keep."""
    meant = _meant({node: read for node, read in chosen.items() if node in kept.chosen})
    reason = f"the lines of this part read {meant}; {verdict.reason}"
    return replace(verdict, reason=reason)
