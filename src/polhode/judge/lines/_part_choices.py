"""The one reading that each part of a text keeps for a letter of several meanings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace

from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, Read
from polhode.judge.document._part_readings import (
    Choice,
    choices_by_part,
    part_readings,
    proposed,
    under_part_reading,
)
from polhode.judge.latex import write_latex
from polhode.judge.lines._judge_line import judged_line
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.text._in_force import Section


def choices_of(lines: Iterable[JudgedLine]) -> dict[Section, Choice]:
    """The readings under which most lines of a part hold, by the part."""
    by_section: dict[Section, list[JudgedLine]] = {}
    for line in lines:
        by_section.setdefault(line.line.section.whole, []).append(line)
    found: dict[Section, Choice] = {}
    for section, members in by_section.items():
        readings = part_readings(section.name, (line.verdict for line in members))
        for choice in choices_by_part(readings).values():
            found[section] = choice
    return found


def in_one_sense(lines: Sequence[JudgedLine], equations: Equations) -> dict[int, JudgedLine]:
    """Lines that hold only with a force counted the other way than most lines of the part have it.

    By their places, as they fail with the sense of the others.
    """
    senses: dict[str, Counter[str]] = {}
    for read in (read for line in lines if line.verdict.holds for read in _with_sense(line)):
        senses.setdefault(read.letter, Counter())[read.meaning] += 1
    usual = {
        letter: most[0][0]
        for letter, counted in senses.items()
        if len(most := counted.most_common()) > 1 and most[0][1] > most[1][1]
    }
    found: dict[int, JudgedLine] = {}
    for place, line in enumerate(lines):
        other = [r for r in _with_sense(line) if usual.get(r.letter, r.meaning) != r.meaning]
        if line.verdict.holds and other and not line.stated:
            named = {write_latex(n): n for n in line.line.letters}
            chosen = {named[r.letter]: usual[r.letter] for r in other if r.letter in named}
            again = judged_line(line.line, equations, chosen)
            if again.verdict.answer is Answer.FAILS:
                said = " and ".join(r.letter for r in other)
                found[place] = replace(again, otherwise=f"{said} counted in the other sense")
    return found


def _with_sense(judged: JudgedLine) -> list[Read]:
    """The letters of a line for forces that may point either way."""
    return [r for r in judged.verdict.readings if r.meaning.startswith("declared ")]


def under_choice(judged: JudgedLine, choice: Choice, equations: Equations) -> JudgedLine:
    """A line with letters read as its part reads them."""
    if len(judged.verdict.by_reading) < 2:
        return judged
    verdict = under_part_reading(judged.verdict, choice)
    if verdict is judged.verdict:
        return judged
    if verdict is not None and verdict.answer is Answer.AMBIGUOUS:
        return replace(judged, judgement=OpenVerdict(verdict))
    chosen = {node: read.meaning for node, read in choice.items()}
    found = judged_line(judged.line, equations, chosen)
    said = replace(found.judgement, verdict=proposed(found.verdict, choice))
    return replace(found, judgement=said, stated=judged.stated)
