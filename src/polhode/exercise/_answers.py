"""Answers that a question expects, and how those of students are marked against them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import islice, permutations
from typing import Any, Protocol

from polhode.base import PURE, PolhodeError, StoreError, UnitError, read_unit
from polhode.derive import Equations
from polhode.exercise._quantities import factor, number_latex, size_of, unit_printed
from polhode.exercise._reading import VectorReader, derivatives_in, read_statement, with_root
from polhode.judge import read_latex
from polhode.judge.service import AnswerTask, MarkedAnswer, marked_answer

_BLANK = re.compile(r"[\s_.…$\-–—]*")
_TIMES_TEN = r"(?:[eE]|(?:\\cdot|\\times|[·×*])\s*10\s*\^?)"
_NUMBER = re.compile(rf"[-+−]?\s*\d+(?:[.,]\d+)?(?:\s*{_TIMES_TEN}\s*\{{?\s*[-+−]?\s*\d+\s*\}}?)?")
_THOUSANDS = re.compile(r"[-+−]?\s*[1-9]\d{0,2},\d{3}")
_FIGURES = 2  # significant ones, from which on an answer may be rounded
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
        letters: those in which it may be given.
        given: what the sheet states, as LaTeX within words: a definition of the quantity, and
            relations between parameters.
        excluded: letters with dots, such as accelerations, that may not occur.
        also: the same with another definition by which an answer is right too, such as one with
            magnitudes.
        axes: for a vector, labels of the axes along which it is asked for, then of others along
            which it may be given.
        is_positive: whether the question says that the quantity is positive, as a frequency is.
    """

    asked: str
    latex: str
    letters: tuple[str, ...]
    given: str = ""
    excluded: tuple[str, ...] = ()
    also: str = ""
    axes: tuple[tuple[str, ...], ...] = ()
    is_positive: bool = False
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
        if beyond := list(self._excluded_in(text)):
            return MarkedPart(PartMark.WRONG, f"it is to be given without {', '.join(beyond)}")
        read = VectorReader(self.asked, self.axes).read(text) if self.axes else text
        read = with_root(read, self.asked) if self.is_positive else read
        try:
            found = self._judged(read, self.given, equations)
            if self.also and not found.is_correct:
                other = self._judged(read, self.also, equations)
                found = other if other.is_correct else found
        except PolhodeError as error:
            return MarkedPart(PartMark.NOT_JUDGED, str(error))
        return RIGHT if found.is_correct else _not_right(found)

    def _excluded_in(self, text: str) -> Iterator[str]:
        """What the answer is to be given without, and has."""
        statement = read_statement(text)
        used = set() if statement is None else {*derivatives_in(statement)}
        bare = re.sub(r"[\s{}]", "", text) if statement is None else ""
        for letter in self.excluded:
            ((of, dots),) = islice(derivatives_in(read_latex(letter)), 1)
            is_used = any(other == of and count >= dots for other, count in used)
            if is_used or re.sub(r"[\s{}]", "", letter) in (bare or ()):
                yield letter

    def _judged(self, text: str, given: str, equations: Equations) -> MarkedAnswer:
        return marked_answer(AnswerTask(text, self.asked, given, self.letters), equations)

    def to_json(self) -> dict[str, Any]:
        """With the options of a request to the service of marks."""
        beyond: dict[str, Any] = {"excluded": list(self.excluded), "also": self.also}
        axes = [list(labels) for labels in self.axes]
        beyond |= {"axes": axes, "is_positive": self.is_positive}
        return {"kind": self.kind, "latex": self.latex, **self.task, **beyond}


def _not_right(found: MarkedAnswer) -> MarkedPart:
    """What is said of an answer that does not give the formula."""
    lines = found.record.lines
    if not found.is_judged:
        reasons = filter(None, (str(line.get("reason") or "") for line in lines))
        why = "; ".join(reasons) or found.asked or "it could not be read"
        return MarkedPart(PartMark.NOT_JUDGED, why)
    marks = {line.get("mark") for line in lines}
    if marks & {"error", "doubt"} or not found.asked:
        return MarkedPart(PartMark.WRONG, "it does not hold for this system")
    if "needs" in marks:
        needed = "; ".join(str(line["needs"]) for line in lines if line.get("needs"))
        return MarkedPart(PartMark.WRONG, f"it holds only under a condition: {needed}")
    return MarkedPart(PartMark.WRONG, found.asked)


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
            found = [_numbers_in(piece, self.unit) for piece in pieces]
        except UnitError as error:
            return MarkedPart(PartMark.WRONG, str(error))
        if not found or not all(found):
            return MarkedPart(PartMark.NOT_JUDGED, f"no number is read in {text.strip()!r}")
        if len(found) != len(self.values):
            counts = f"{len(found)} where {len(self.values)} were asked for"
            return MarkedPart(PartMark.WRONG, f"the count of numbers is {counts}")
        pairs = (zip(order, self.values, strict=True) for order in permutations(found))
        if any(all(self._is_close(v, right) for v, right in pair) for pair in pairs):
            return RIGHT
        which = "this is not the right number" if len(found) == 1 else "these are not all right"
        return MarkedPart(PartMark.WRONG, which)

    def _is_close(self, readings: Sequence[_NumberRead], right: float) -> bool:
        """Whether a number is within the tolerance, or right as far as it is written."""
        near = self.tolerance * abs(right)
        return any(
            abs(read.value - right) <= max(near, read.rounding if near else 0.0) + 1e-12
            for read in readings
        )

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
                texts = {k: str(entry[k]) for k in ("asked", "latex", "given", "also")}
                axes = tuple(tuple(map(str, labels)) for labels in entry.get("axes", ()))
                positive = bool(entry.get("is_positive"))
                return FormulaAnswer(
                    **texts, letters=letters, excluded=excluded, axes=axes, is_positive=positive
                )
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


@dataclass(frozen=True)
class _NumberRead:
    """A number in some unit, and half of its last digit if there are two figures or more."""

    value: float
    rounding: float


def _numbers_in(text: str, unit: str) -> tuple[_NumberRead, ...]:
    """The number in a text, in a unit: none, or two where a comma may stand for thousands.

    Raises `UnitError` for a unit of another dimension.
    """
    plain = _without_latex(text)
    found = _NUMBER.match(plain)
    if found is None:
        return ()
    written = plain[found.end() :].strip(" .")
    size = 1.0
    if written:
        try:
            read = read_unit(written)
        except UnitError:
            return ()
        expected = read_unit(unit).dimension if unit else PURE
        if read.dimension != expected:
            raise UnitError(f"an answer in {written}", expected=f"one in {unit or 'no unit'}")
        size = size_of(read) / factor(unit)
    spelled = [found[0]]
    if _THOUSANDS.fullmatch(found[0].strip()):
        spelled.append(found[0].replace(",", ""))
    return tuple(_NumberRead(_decimal(t) * size, _rounding(t) * size) for t in spelled)


def _rounding(text: str) -> float:
    """Half of the last digit that is written; 0 for a single figure."""
    digits = re.match(r"[-+−\s]*0*[.,]?0*(?P<figures>\d[\d.,]*)", text)
    if digits is None or len(re.sub(r"[.,]", "", digits["figures"])) < _FIGURES:
        return 0.0
    mantissa = re.match(r"[-+−\s]*\d+(?:[.,](?P<behind>\d+))?", text)
    behind = mantissa["behind"] or "" if mantissa else ""
    power = (
        abs(_decimal(text) / _decimal(mantissa[0])) if mantissa and _decimal(mantissa[0]) else 1.0
    )
    return float(0.5 * 10.0 ** -len(behind) * power)


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
