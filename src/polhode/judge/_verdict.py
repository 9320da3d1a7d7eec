"""Verdicts on claims, with the evidence for them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field, fields, replace
from enum import Enum
from fractions import Fraction
from math import ceil, log10

from polhode.algebra import Expr, SquareRoot, Symbol
from polhode.base import Dimension, PolhodeError, Shown
from polhode.judge.latex._tree import Node

_EXACT = 24  # characters of a fraction that people are shown as it is
_LONGEST = 300  # characters of any other value that they are shown
_TAG = re.compile(r"\\tag\{[^{}]*\}")


class Answer(Enum):
    """The answer of a verdict."""

    HOLDS = "holds"
    AMBIGUOUS = "ambiguous"
    APPROXIMATE = "approximate"
    DEFINITION = "definition"
    FAILS = "fails"
    UNREAD = "unread"


@dataclass(frozen=True)
class Read:
    """What a letter of a claim was taken to mean.

    Attributes:
        letter: as LaTeX.
        meaning: the quantity, such as "angular momentum about cm".
        plain: the letter in ASCII, as it is typed to choose another reading.
        proposed: whether it was chosen since most lines of the part hold under it.
    """

    letter: str
    meaning: str
    plain: str
    proposed: bool = False

    def __str__(self) -> str:
        return f"{self.plain} {self.words}"

    @property
    def words(self) -> str:
        """The meaning, to follow the letter."""
        return f"as {self.meaning}{' (proposed for this part)' if self.proposed else ''}"

    @property
    def is_worth_saying(self) -> bool:
        """Whether a reader might doubt the meaning; axes 1, 2, 3 of a body are unambiguous."""
        return not self.meaning.startswith("axis ") or self.plain in ("x", "y", "z")

    def to_json(self) -> dict[str, str]:
        """As it stands in a JSON document."""
        return {"letter": self.letter, "meaning": self.meaning}


@dataclass(frozen=True)
class Residual:
    """The residual of one component of one member: left minus right side, in the claim's context.

    Attributes:
        member: which link of a chain or row of a block, counted from 0.
        component: label of the direction, such as "3" or "rho"; empty for a scalar.
        expression: exact; zero where this component holds.
    """

    member: int
    component: str
    expression: Expr

    def __str__(self) -> str:
        where = f"component {self.component} of " if self.component else ""
        return f"{where}member {self.member + 1}: {self.expression}"


@dataclass(frozen=True)
class Counterexample:
    """A state that the context allows and the claim does not.

    Attributes:
        values: exact value of every symbol of the state as text (SI). An angle is 2 atan(q) with
            rational q, so that its sine and cosine are rational.
        left: exact value of the left side there.
        right: exact value of the right side there.
        residual: which part of the claim is refuted.
    """

    values: Mapping[str, str]
    left: Expr
    right: Expr
    residual: Residual

    @property
    def state(self) -> str:
        """The state in a line, such as "a = 1/2, theta = 2*atan(1/3)"."""
        return ", ".join(f"{name} = {value}" for name, value in self.values.items())

    def to_json(self) -> dict[str, object]:
        """The state and both sides, exactly."""
        return {"values": dict(self.values), "left": str(self.left), "right": str(self.right)}

    @property
    def shown(self) -> dict[str, object]:
        """The state and both sides for people."""
        left, right = self.sides
        return {"values": dict(self.values), "left": left, "right": right}

    @property
    def sides(self) -> tuple[str, str]:
        """Both sides for people: a fraction of many digits as a decimal, a long text cut off."""
        return _short(str(self.left)), _short(str(self.right))


def _short(value: str) -> str:
    if len(value) > _EXACT:
        with suppress(ValueError):
            return f"{float(Fraction(value)):.9g}"
    return value if len(value) <= _LONGEST else f"{value[:_LONGEST]}..."


@dataclass(frozen=True)
class Confirmation:
    """Numbers for the two sides at one state, accelerations and reactions computed independently.

    Attributes:
        values: numbers of all quantities that enter, SI.
        left: value of the left side.
        right: value of the right side.
        agrees: whether the numbers say the same as the exact judgement.
    """

    values: Mapping[str, float]
    left: float
    right: float
    agrees: bool


@dataclass(frozen=True)
class SimpleRelation:
    """A simple relation between quantities, such as I_1 = I_2 or omega_3 > 0.

    Attributes:
        left: side.
        sign: one of =, <, >.
        right: side.
    """

    left: Expr
    sign: str
    right: Expr

    def __str__(self) -> str:
        return f"{self.left} {self.sign} {self.right}"

    def latex(self) -> str:
        """As LaTeX."""
        return f"{self.left.latex()} {self.sign} {self.right.latex()}"


#: What has to hold together.
SimpleCondition = tuple[SimpleRelation, ...]


@dataclass(frozen=True)
class Correction:
    """A change that makes a claim hold.

    Attributes:
        what: the change in words, such as "wrong sign".
        latex: the corrected statement in the author's notation.
    """

    what: str
    latex: str

    def to_json(self) -> dict[str, str]:
        """As it stands in a JSON document."""
        return {"what": self.what, "latex": self.latex}


@dataclass(frozen=True)
class MemberAtOdds:
    """A member of a claim whose terms have different dimensions.

    Attributes:
        member: its number, counted from zero.
        dimensions: of its terms.
    """

    member: int
    dimensions: frozenset[Dimension]

    @property
    def units(self) -> tuple[str, ...]:
        """The SI units of these dimensions, in alphabetical order."""
        return tuple(sorted(map(str, self.dimensions)))


class Decides(Enum):
    """What a condition of the model decides of steady motions."""

    STABILITY = "stability"
    EXISTENCE = "existence"


@dataclass(frozen=True)
class ComparedCondition:
    """The condition of the model with which a threshold was compared.

    Attributes:
        words: the condition, as the reason of the verdict has it.
        decides: stability or existence.
        is_at_fixed_angles: whether it is that of one family of steady motions, at angles that do
            not depend on their speeds.
    """

    words: str
    decides: Decides
    is_at_fixed_angles: bool


@dataclass(frozen=True, repr=False)
class Verdict(Shown):
    """The judgement on one claim.

    Attributes:
        answer: holds, ambiguous, approximate, definition, fails or unread.
        context: where the claim is to hold.
        reason: the verdict explained in a sentence.
        residuals: every component that does not vanish, exactly.
        counterexample: for a failure, a state that refutes the claim.
        confirmation: the same in numbers, computed without the derivation.
        correction: the smallest change that makes the claim hold.
        alternatives: other changes just as small.
        order: for an approximation, the highest order to which it is true.
        dropped: for an approximation, the first term left out.
        remarks: further notes, such as roots that are not covered.
        readings: the meanings given to letters by common usage.
        option: for an undecided claim, the argument that would help, such as "let" or "read".
        error_bound: where an identity was decided by evaluation at random points, a bound on the
            probability that it was accepted though false (Schwartz and Zippel); otherwise None.
        by_reading: the verdict in each reading that fits, where letters may be read in several.
        holds_where: for a claim that fails or is undecided, alternatives in which it holds.
        resting: for an undecided claim, the rates that have to vanish at the start for it to hold.
        at_odds: the members that have terms of different dimensions.
        compared: for a threshold, the condition of the model with which it was compared.
        error: for a claim that could not be read, bound or decided, the error that says why.
    """

    answer: Answer
    context: str
    reason: str = ""
    residuals: tuple[Residual, ...] = ()
    counterexample: Counterexample | None = None
    confirmation: Confirmation | None = None
    correction: Correction | None = None
    alternatives: tuple[Correction, ...] = ()
    order: int | None = None
    dropped: Expr | None = None
    remarks: tuple[str, ...] = field(default=())
    readings: tuple[Read, ...] = ()
    option: str = ""
    error_bound: float | None = None
    by_reading: tuple[VerdictInReading, ...] = ()
    holds_where: tuple[SimpleCondition, ...] = ()
    resting: tuple[Symbol, ...] = ()
    at_odds: tuple[MemberAtOdds, ...] = ()
    compared: ComparedCondition | None = None
    error: PolhodeError | None = field(default=None, compare=False)

    @classmethod
    def unread(cls, context: str, error: Exception, hint: str = "") -> Verdict:
        """For a claim that could not be read, bound or decided, for the reason an error gives."""
        reason = f"{error}{hint}"
        if not isinstance(error, PolhodeError):
            return cls(Answer.UNREAD, context, reason)
        # Without its traceback, which would keep everything alive that the error passed; some
        # libraries make copies keep it.
        bare = copy(error).with_traceback(None)
        return cls(Answer.UNREAD, context, reason, option=error.option, error=bare)

    @classmethod
    def undecided(cls, context: str, error: Exception) -> Verdict:
        """For a claim that was read but could not be decided, for the reason an error gives."""
        return replace(cls.unread(context, error), reason=f"it was read, but not decided: {error}")

    @property
    def holds(self) -> bool:
        """Whether the claim was judged and found true, exactly or to its order."""
        return self.answer in (Answer.HOLDS, Answer.APPROXIMATE)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes shown beside the verdict: remarks, and the meanings that letters were given."""
        read = "; ".join(map(str, self.shown_readings))
        return (*self.details, f"read: {read}") if read else self.details

    @property
    def details(self) -> tuple[str, ...]:
        """Remarks, and how sure an identity is that was decided at random points."""
        return (*self.remarks, *([certainty(self.error_bound)] if self.error_bound else []))

    @property
    def shown_readings(self) -> tuple[Read, ...]:
        """The meanings that letters were given, without those that no reader would doubt.

        A letter that is printed both bold and plain with one meaning is shown once.
        """
        shown = {str(reading): reading for reading in self.readings if reading.is_worth_saying}
        return tuple(shown.values())

    @property
    def where_it_holds(self) -> str:
        """The alternatives in which it holds, in words; empty for none."""
        where = " or ".join(" and ".join(map(str, each)) for each in self.holds_where)
        return where and f"it holds where {where}"

    def holding_where(self, conditions: tuple[SimpleCondition, ...]) -> Verdict:
        """With alternatives in which it holds, and a remark on them."""
        found = replace(self, holds_where=conditions)
        return replace(found, remarks=(*self.remarks, found.where_it_holds)) if conditions else self

    @property
    def is_conditional(self) -> bool:
        """Whether simple conditions are known under which a claim holds that fails."""
        return bool(self.holds_where)

    def proved(self) -> Verdict:
        """With all evidence for it."""
        return self

    def _repr_latex_(self) -> str:
        """The answer with the correction, or else with the residual of each component."""
        rows = [rf"\text{{{self.answer.value}}}"]
        if self.correction is not None:
            what = rf"\text{{{self.correction.what}; it holds as}}"
            rows += [what, _TAG.sub("", self.correction.latex)]
        elif self.residuals:
            left = (rf"\text{{left minus right: }} {r.expression.latex()}" for r in self.residuals)
            rows += left
        rows += (rf"\text{{{_escaped(note)}}}" for note in self.notes)
        table = r" \\ ".join(rows)
        return rf"$\displaystyle \begin{{array}}{{l}} {table} \end{{array}}$"

    def __str__(self) -> str:
        text = self.answer.value
        if self.correction is not None:
            text += f"; {self.correction.what}: {self.correction.latex}"
        if self.reason:
            text += f" ({self.reason})"
        return "\n  ".join([text, *self.notes])

    def __repr__(self) -> str:
        return f"Verdict: {self}"


def certainty(error_bound: float) -> str:
    """How sure it is what was decided at random points, in words."""
    power = f"1e{ceil(log10(error_bound))}"  # rounded up, so that it remains a bound
    return f"decided by exact evaluation at random points, probability of error below {power}"


def _has_root(expression: Expr) -> bool:
    """Whether it has roots, which have no single form: √(2 - √2) √(2 + √2) is √2."""
    return any(isinstance(generator, SquareRoot) for generator in expression.generators)


def _escaped(text: str) -> str:
    """Text for LaTeX, with its special characters escaped."""
    return re.sub(r"[_&%#$]", r"\\\g<0>", text)


@dataclass(frozen=True)
class VerdictInReading:
    """A claim judged under one choice of what its letters mean.

    Attributes:
        chosen: that choice, for each letter that has several meanings.
        verdict: under it, before any correction.
    """

    chosen: Mapping[Node, Read]
    verdict: Verdict


#: A state that refutes a claim, and an independent check of it; None where none was found.
Evidence = tuple[Counterexample | None, Confirmation | None]


@dataclass(frozen=True, kw_only=True, repr=False)
class Refuted(Verdict):
    """A certain failure whose evidence is computed only on request.

    Trials of corrections judge many claims that fail, and need no evidence for any of them.

    Attributes:
        evidence: computes it.
        conditions: finds simple conditions under which the claim holds.
    """

    evidence: Callable[[], Evidence]
    conditions: Callable[[], tuple[SimpleCondition, ...]] = tuple

    @property
    def is_conditional(self) -> bool:
        return bool(self.conditions())

    def proved(self) -> Verdict:
        """With its evidence, and the conditions under which it holds."""
        example, second = self.evidence()
        known = {entry.name: getattr(self, entry.name) for entry in fields(Verdict)}
        known |= {"counterexample": example, "confirmation": second}
        where = self.conditions()
        has_root = any(_has_root(residual.expression) for residual in self.residuals)
        if example is None and (where or has_root):  # no state is known at which the sides differ
            why = "both sides contain roots, and differ at no state that was tried"
            undecided = Verdict(
                Answer.UNREAD,
                self.context,
                residuals=self.residuals,
                remarks=self.remarks,
                option="positive",
                holds_where=where,
            )
            if where:
                why = f"{undecided.where_it_holds}; state the sign, or restrict it"
            return replace(undecided, reason=f"it was read, and {why}")
        return Verdict(**known).holding_where(where)
