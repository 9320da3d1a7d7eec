"""States to ask about: every contact pushes, and no answer is a small difference of large terms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import PolhodeError
from polhode.exercise._numbers import draw_state
from polhode.exercise._quantities import Amount
from polhode.exercise._question import Occasion
from polhode.exercise._subject import ExerciseSubject, value_of

_LEAST_PUSH = 0.1  # of the weight
#: Of the largest term that a sum has at the least, so that no answer hangs on the last figures.
_LEAST_PART = 0.2


def legal_state(occasion: Occasion, purpose: str, value: Expr) -> dict[Symbol, Amount]:
    """A state in which a value can be asked for; empty where there is none."""
    subject = occasion.subject
    symbols = _varying(value)
    if any(s.kind is SymbolKind.FUNCTION for s in symbols):
        return {}
    pushes = list(_pushes(subject))

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        pushed = all(value_of(push, numbers) > 0 for push in pushes)
        return pushed and relative_size(value, numbers) > _LEAST_PART

    symbols = symbols.union(*map(_varying, pushes))
    own = occasion.own.about(purpose)
    return draw_state(subject, symbols, occasion.drawn, own, accepts) or {}


def _varying(value: Expr) -> set[Symbol]:
    return {s for s in value.symbols() if s.kind.varies}


def _pushes(subject: ExerciseSubject) -> Iterator[Expr]:
    """Forces of contacts along their normals, less a tenth of the weight, and pulls of ropes.

    Those that are not determined are left out.
    """
    equations, setting = subject.equations, subject.setting
    for contact in setting.contacts:
        reaction = equations.reactions.get(contact.name)
        if reaction is None or equations.undetermined:
            continue
        try:
            push = equations.on_shell(reaction.force.dot(contact.on.up))
        except PolhodeError:
            continue
        if setting.gravity is not None:
            push -= setting.mass * setting.gravity.g * Expr.of(_LEAST_PUSH)
        if not any(s.kind is SymbolKind.FUNCTION for s in push.symbols()):
            yield push
    for name in subject.tensions:
        if name not in equations.undetermined:
            with suppress(PolhodeError):
                yield equations.on_shell(equations.components[name])


def vanishes(expression: Expr, values: Mapping[Symbol, float]) -> bool:
    """Whether an expression is zero at numbers, relative to its largest term."""
    return relative_size(expression, values) <= 1e-9


def relative_size(expression: Expr, values: Mapping[Symbol, float]) -> float:
    """How large the sum of the terms of an expression is over the largest of them."""
    total = largest = 0.0
    for powers, number in expression.numerator.terms():
        term = float(number)
        for generator, power in powers.items():
            term *= value_of(Expr.generator(generator), values) ** power
        total += term
        largest = max(largest, abs(term))
    return abs(total) / largest if largest else 0.0
