"""Answers that a question expects, and how those of students are marked against them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import permutations
from typing import Any, Protocol

from polhode.base import PURE, PolhodeError, StoreError, UnitError, read_unit
from polhode.derive import Equations
from polhode.exercise._quantities import factor, number_latex, size_of, unit_printed
from polhode.review.service import AnswerTask, MarkedAnswer, marked_answer

_BLANK = re.compile(r"[\s_.…$\-–—]*")
_TIMES_TEN = r"(?:[eE]|(?:\\cdot|\\times|[·×*])\s*10\s*\^?)"
_NUMBER = re.compile(rf"[-+−]?\s*\d+(?:[.,]\d+)?(?:\s*{_TIMES_TEN}\s*\{{?\s*[-+−]?\s*\d+\s*\}}?)?")
_APART = re.compile(r"\s*(?:;|\band\b|\bund\b|\n|,\s+)\s*")
_RIGHT_SIDE = re.compile(r".*(?:=|≈|\\approx)", re.DOTALL)


class PartMark(Enum):
    """What is said of the answer to one part."""

    RIGHT = "right"
    WRONG = "wrong"
    NOT_JUDGED = "not-judged"


@dataclass(frozen=True)
class MarkedPart:
    """The answer to one part, marked.

    Attributes:
        mark: of the answer.
        message: why, for a wrong answer or one that was not judged.
    """

    mark: PartMark
    message: str = ""


RIGHT = MarkedPart(PartMark.RIGHT)


class ExpectedAnswer(Protocol):
    """What one blank of a question expects."""

    @property
    def kind(self) -> str:
        """formula, number or choice."""

    @property
    def prompt(self) -> str:
        """What stands before the blank, such as "$F_z =$"."""

    @property
    def unit(self) -> str:
        """What stands behind the blank; empty for nothing."""

    @property
    def shown(self) -> str:
        """The right answer, for people."""

    def marked(self, text: str, equations: Equations) -> MarkedPart:
        """An answer that is not blank, marked."""

    def to_json(self) -> dict[str, Any]:
        """As it stands in a key."""


@dataclass(frozen=True)
class FormulaAnswer:
    """A formula, which may be given in any form that is equal to it on the model.

    Attributes:
        asked: the quantity, as LaTeX.
        latex: its value.
        letters: those in which it is to be given.
        given: what the problem states, as LaTeX within words: a definition of the quantity.
        excluded: letters with dots, such as accelerations, that may not occur.
        also: another definition by which an answer is right too, such as one with magnitudes.
    """

    asked: str
    latex: str
    letters: tuple[str, ...]
    given: str = ""
    excluded: tuple[str, ...] = ()
    also: str = ""
    kind = "formula"
    unit = ""

    @property
    def prompt(self) -> str:
        """The quantity and =."""
        return f"${self.asked} =$"

    @property
    def shown(self) -> str:
        """The formula."""
        return f"${self.asked} = {self.latex}$"

    @property
    def task(self) -> dict[str, Any]:
        """Options of a request to the service of marks."""
        return {"asked": self.asked, "given": self.given, "letters": list(self.letters)}

    def marked(self, text: str, equations: Equations) -> MarkedPart:
        """Judged on the model, as the service of marks does."""
        bare = re.sub(r"[\s{}]", "", text)
        if beyond := [x for x in self.excluded if re.sub(r"[\s{}]", "", x) in bare]:
            return MarkedPart(PartMark.WRONG, f"it is to be given without {', '.join(beyond)}")
        try:
            found = self._judged(text, self.given, equations)
            if self.also and not found.is_correct:
                other = self._judged(text, self.also, equations)
                found = other if other.is_correct else found
        except PolhodeError as error:
            return MarkedPart(PartMark.NOT_JUDGED, str(error))
        if found.is_correct:
            return RIGHT
        if not found.is_judged:
            reasons = [str(line.get("reason") or "") for line in found.record.lines]
            why = "; ".join(filter(None, reasons)) or found.asked or "it could not be read"
            return MarkedPart(PartMark.NOT_JUDGED, why)
        wrong = any(line.get("mark") in ("error", "doubt") for line in found.record.lines)
        message = "it does not hold for this system" if wrong or not found.asked else found.asked
        return MarkedPart(PartMark.WRONG, message)

    def _judged(self, text: str, given: str, equations: Equations) -> MarkedAnswer:
        return marked_answer(AnswerTask(text, self.asked, given, self.letters), equations)

    def to_json(self) -> dict[str, Any]:
        """With the options of a request to the service of marks."""
        beyond = {"excluded": list(self.excluded), "also": self.also}
        return {"kind": self.kind, "latex": self.latex, **self.task, **beyond}


@dataclass(frozen=True)
class NumberAnswer:
    """One number or several in any order, within a tolerance.

    Attributes:
        prompt: what stands before the blank.
        values: in the unit.
        unit: in which a bare number is taken; an answer may be in another.
        tolerance: relative; 0 for counted things.
    """

    prompt: str
    values: tuple[float, ...]
    unit: str = ""
    tolerance: float = 0.02
    kind = "number"

    @property
    def shown(self) -> str:
        """The numbers, to three significant figures unless they are counted."""
        printed = unit_printed(self.unit)
        close = "" if printed == "°" else " "
        figures = (f"{v:g}" if not self.tolerance else number_latex(v) for v in self.values)
        return " and ".join(f"${figure}${close}{printed}".strip() for figure in figures)

    def marked(self, text: str, equations: Equations) -> MarkedPart:
        """Compared in SI units."""
        pieces = [p for p in _APART.split(_RIGHT_SIDE.sub("", text.strip())) if p]
        if len(pieces) < len(self.values):
            pieces = _NUMBER.findall(text) if len(self.values) > 1 else pieces
        try:
            found = [_number_in(piece, self.unit) for piece in pieces]
        except UnitError as error:
            return MarkedPart(PartMark.WRONG, str(error))
        if not found or any(value is None for value in found):
            return MarkedPart(PartMark.NOT_JUDGED, f"no number is read in {text.strip()!r}")
        if len(found) != len(self.values):
            counts = f"{len(found)} where {len(self.values)} were asked for"
            return MarkedPart(PartMark.WRONG, f"the count of numbers is {counts}")
        pairs = (zip(order, self.values, strict=True) for order in permutations(found))
        if any(all(self._is_close(v, right) for v, right in pair) for pair in pairs):
            return RIGHT
        which = "this is not the right number" if len(found) == 1 else "these are not all right"
        return MarkedPart(PartMark.WRONG, which)

    def _is_close(self, value: float | None, right: float) -> bool:
        return value is not None and abs(value - right) <= self.tolerance * abs(right) + 1e-12

    def to_json(self) -> dict[str, Any]:
        """With the tolerance."""
        return {
            "kind": self.kind,
            "prompt": self.prompt,
            "values": list(self.values),
            "unit": self.unit,
            "tolerance": self.tolerance,
        }


@dataclass(frozen=True)
class ChoiceAnswer:
    """One or several of the options of a question.

    Attributes:
        prompt: what stands before the blank.
        right: letters of the right options.
        options: letters of all.
    """

    prompt: str
    right: frozenset[str]
    options: tuple[str, ...]
    kind = "choice"
    unit = ""

    @property
    def shown(self) -> str:
        """The letters."""
        return ", ".join(f"({letter})" for letter in sorted(self.right)) or "none"

    def marked(self, text: str, equations: Equations) -> MarkedPart:
        """Compared as sets of letters."""
        words = set(re.findall(r"[^\W\d_]+", text.lower())) - {"and", "option", "options", "only"}
        if words - set(self.options) - {"none"}:
            which = ", ".join(self.options)
            return MarkedPart(PartMark.NOT_JUDGED, f"expected letters of the options: {which}")
        if words - {"none"} == self.right:
            return RIGHT
        return MarkedPart(PartMark.WRONG, "these are not the right options")

    def to_json(self) -> dict[str, Any]:
        """With all options."""
        return {
            "kind": self.kind,
            "prompt": self.prompt,
            "right": sorted(self.right),
            "options": list(self.options),
        }


def is_blank(text: str) -> bool:
    """Whether nothing was answered."""
    return _BLANK.fullmatch(text) is not None


def marked_part(expected: ExpectedAnswer, text: str, equations: Equations) -> MarkedPart:
    """The answer of a student to one part, marked; one left blank is not judged."""
    if is_blank(text):
        return MarkedPart(PartMark.NOT_JUDGED, "left blank")
    return expected.marked(text, equations)


def expected_from(entry: Mapping[str, Any]) -> ExpectedAnswer:
    """An expected answer from its entry in a key.

    Raises:
        StoreError: for a damaged entry.
    """
    try:
        match entry["kind"]:
            case "formula":
                letters = tuple(map(str, entry["letters"]))
                excluded = tuple(map(str, entry["excluded"]))
                asked, latex, given = (str(entry[k]) for k in ("asked", "latex", "given"))
                return FormulaAnswer(asked, latex, letters, given, excluded, str(entry["also"]))
            case "number":
                values = tuple(map(float, entry["values"]))
                tolerance = float(entry["tolerance"])
                return NumberAnswer(entry["prompt"], values, str(entry["unit"]), tolerance)
            case "choice":
                right, options = frozenset(entry["right"]), tuple(entry["options"])
                return ChoiceAnswer(entry["prompt"], right, options)
    except (KeyError, TypeError, ValueError) as error:
        raise _damaged(entry) from error
    raise _damaged(entry)


def _damaged(entry: object) -> StoreError:
    return StoreError(
        f"an answer in the key: {entry!r}"[:200],
        expected="the key that was written with the exercise",
        advice="make it again from the same seed",
    )


# -- numbers as students write them ----------------------------------------------------------------


def _number_in(text: str, unit: str) -> float | None:
    """The number in a text, in a unit; None where there is none.

    Raises `UnitError` for a unit of another dimension.
    """
    plain = _without_latex(text)
    found = _NUMBER.match(plain)
    if found is None:
        return None
    number = _decimal(found[0])
    written = plain[found.end() :].strip(" .")
    if not written:
        return number
    try:
        read = read_unit(written)
    except UnitError:
        return None
    expected = read_unit(unit).dimension if unit else PURE
    if read.dimension != expected:
        raise UnitError(f"an answer in {written}", expected=f"one in {unit or 'no unit'}")
    return number * size_of(read) / factor(unit)


def _without_latex(text: str) -> str:
    """A number with its unit without the commands around it."""
    plain = re.sub(r"\\(?:mathrm|text|textrm|rm|unit|,|;|!| |quad)", " ", text)
    plain = plain.replace(r"^\circ", "°").replace(r"\circ", "°").replace("^°", "°")
    plain = re.sub(r"[${}~]", lambda f: f[0] if f[0] in "{}" and "10" in text else " ", plain)
    return plain.strip()


def _decimal(text: str) -> float:
    plain = text.replace("−", "-").replace(",", ".")
    plain = re.sub(r"(?:\\cdot|\\times|[·×*])\s*10\s*\^?", "e", plain)
    return float(re.sub(r"[\s{}]", "", plain))
