"""The mutation test: claims that hold get a slip; whether it is caught, and put right."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache, reduce
from random import Random

from catalogue.systems import equations
from judge.mutants import Mutant, mutants
from judge.oracle import JUDGED, Oracle
from polhode.algebra import Expr, Symbol, Vector
from polhode.base import ParseError, PolhodeError
from polhode.catalogue import problem_set
from polhode.judge import Answer, Claim, Document, Notation, read_document
from polhode.judge._check import judged_claim
from polhode.judge._typed import with_start
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.contexts._contexts import holds
from polhode.judge.latex import Statement, read_latex, write_latex
from polhode.judge.latex._parser import slash_readings
from polhode.judge.meaning._meaning import Side
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import AnyState


@cache
def document() -> Document:
    return read_document(problem_set())


@dataclass(frozen=True)
class Original:
    """A claim of the document that holds."""

    claim: Claim
    notation: Notation
    statement: Statement
    bound: BoundClaim

    @classmethod
    def of(cls, claim: Claim) -> Original:
        part = document().part_of(claim)
        notation = Notation.of_part(equations(part.system), part).of_claim(claim)
        start = (f"{name} = {value}" for name, value in claim.start.items())
        notation = reduce(with_start, start, notation)
        readings = slash_readings(claim.formula)
        for text, statement in readings.items():
            bound = notation.read_claim(statement, {})
            if len(readings) == 1:
                return cls(claim, notation, statement, bound)
            if holds(bound, claim.context):  # with \frac for a slash that may be read in two ways
                return cls(replace(claim, read_as=text), notation, statement, bound)
        raise ParseError(claim.formula, expected="a formula that holds in a reading of its slashes")

    def oracle(self) -> Oracle:
        scalars = self.notation.vocabulary.mechanics.scalars.values()
        letters = (e.symbol for e in scalars if e.symbol is not None)
        return Oracle(self.bound, self.claim.context, letters)


@dataclass
class Counts:
    """What became of the mutants."""

    total: Counter[str] = field(default_factory=Counter)
    slips: Counter[tuple[str, str]] = field(default_factory=Counter)
    missed: list[str] = field(default_factory=list)
    alarms: list[str] = field(default_factory=list)
    unlike: list[str] = field(default_factory=list)

    def enter(self, what: str, slip: str) -> None:
        self.total[what] += 1
        self.slips[slip, what] += 1

    @property
    def untrue(self) -> int:
        return self.total["caught"] + self.total["missed"]

    @property
    def caught(self) -> float:
        return self.total["caught"] / self.untrue

    @property
    def repaired(self) -> float:
        return self.total["repaired"] / self.total["caught"]

    def __str__(self) -> str:
        counts = ", ".join(f"{count} {what}" for what, count in sorted(self.total.items()))
        rows = sorted({slip for slip, _ in self.slips})
        each = [
            f"  {slip}: "
            + ", ".join(
                f"{count} {what}" for (s, what), count in sorted(self.slips.items()) if s == slip
            )
            for slip in rows
        ]
        share = f"caught {self.caught:.2%}, repaired to the original {self.repaired:.2%}"
        return "\n".join([counts, share, *each])


def true_claims(every: int = 1) -> Iterator[Original]:
    """Every so-manieth claim that holds, in contexts that the oracle can speak of."""
    for claim in [c for c in document().claims if c.context in JUDGED][::every]:
        original = Original.of(claim)
        if original.bound.members and _verdict(original, claim.formula).answer is Answer.HOLDS:
            yield original


def tried(
    originals: Iterable[Original],
    most: int,
    seed: int,
    tell: Callable[[str], None] = lambda _: None,
) -> Counts:
    """Judge up to so many mutants of every claim, drawn at random."""
    counts = Counts()
    for original in originals:
        oracle = original.oracle()
        if not oracle.is_true(original.bound):
            counts.enter("claims set aside", "")
            continue
        counts.enter("claims", "")
        every = list(dict.fromkeys(mutants(original.statement)))
        for mutant in Random(seed).sample(every, min(most, len(every))):
            _try(original, oracle, mutant, counts)
        tell(
            f"{original.claim.id}\n{counts}\n"
            + "\n".join([*counts.missed, *counts.alarms, *counts.unlike])
        )
    return counts


def _try(original: Original, oracle: Oracle, mutant: Mutant, counts: Counts) -> None:
    latex = write_latex(mutant.statement)
    where = f"{original.claim.id} {mutant.slip}: {latex}"
    try:
        bound = original.notation.read_claim(mutant.statement, {})
        counted = [len(r.components()) for r in (bound, original.bound)]
    except (PolhodeError, ArithmeticError):
        counts.enter("without meaning", mutant.slip)
        return
    true = oracle.is_true(bound) if counted[0] == counted[1] else None
    if true and _undetermined(bound):
        true = None  # the oracle has picked one of the many ways that supports may share a load
    if true is None:
        counts.enter("set aside", mutant.slip)
        return
    verdict = _verdict(original, latex)
    if true:
        counts.enter("true still", mutant.slip)
        if verdict.answer is Answer.FAILS:
            counts.enter("true, and refused", mutant.slip)
            counts.alarms.append(where)
        return
    if verdict.answer is not Answer.FAILS:
        counts.enter("missed", mutant.slip)
        counts.missed.append(f"{where}: {verdict}")
        return
    counts.enter("caught", mutant.slip)
    first, *others = [verdict.correction, *verdict.alternatives]
    if first is not None and _is_original(original, first.latex):
        counts.enter("repaired", mutant.slip)
    elif any(c is not None and _is_original(original, c.latex) for c in others):
        counts.enter("repaired", mutant.slip)
        counts.enter("repaired, one of several as small", mutant.slip)
    else:
        what = "repaired otherwise" if first is not None else "not repaired"
        counts.enter(what, mutant.slip)
        counts.unlike.append(f"{where} -> {first and first.latex}")


def _undetermined(bound: BoundClaim) -> bool:
    """Whether the claim speaks of reactions that Newton's laws leave open."""
    forces = bound.equations.components.items()
    free = {Symbol(name) for name, value in forces if value.symbol == Symbol(name)}
    open_ = {reaction_symbol(name) for name, value in forces if free & value.symbols()}
    sides = (side for c in bound.components() for side in (c.left, c.right))
    return any(open_ & side.symbols() for side in sides)


def _verdict(original: Original, latex: str):
    return judged_claim(
        latex, original.notation.choosing, original.claim.context, original.claim.when
    )


def _is_original(original: Original, latex: str) -> bool:
    """Whether a correction says the same: every member but for a number that multiplies it."""
    try:
        bound = original.notation.read_claim(read_latex(latex), {})
    except (PolhodeError, ArithmeticError):
        return False
    states = original.bound.states(AnyState)
    pairs = list(zip(bound.branches, original.bound.branches, strict=False))
    return len(bound.branches) == len(original.bound.branches) and all(
        len(ours) == len(theirs)
        and all(_same(one, other, states) for one, other in zip(ours, theirs, strict=True))
        for ours, theirs in pairs
    )


def _same(one: BoundRelation, other: BoundRelation, states: AnyState) -> bool:
    """Whether the differences of both sides are in proportion, or else the sides themselves."""
    if one.sign != other.sign:
        return False
    ours, theirs = (_scalars(_difference(r)) for r in (one, other))
    if any(theirs):
        return _in_proportion(ours, theirs)
    sides = [
        [states.on(x) for side in (r.left, r.right) for x in _scalars(side)] for r in (one, other)
    ]
    return not any(ours) and _in_proportion(*sides)


def _difference(relation: BoundRelation) -> Side:
    left, right = relation.left, relation.right
    if isinstance(left, Vector) and isinstance(right, Expr):
        return left
    if isinstance(right, Vector) and isinstance(left, Expr):
        return -right
    return left - right


def _scalars(side: Side) -> list[Expr]:
    if isinstance(side, Expr):
        return [side]
    return list(side.express(side.triad.root).components)


def _in_proportion(ours: list[Expr], theirs: list[Expr]) -> bool:
    if len(ours) != len(theirs):
        return False
    ratios = {(a / b).rational for a, b in zip(ours, theirs, strict=True) if a and b}
    alike = all(bool(a) == bool(b) for a, b in zip(ours, theirs, strict=True))
    return alike and len(ratios) <= 1 and None not in ratios
