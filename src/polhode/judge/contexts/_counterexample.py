"""Counterexamples: a state that refutes a claim, with exact values and a numeric second opinion."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain, islice
from math import isclose

from polhode.algebra import ONE, Expr, Generator, Symbol, under_name
from polhode.base import LENGTH, TIME, NumericError
from polhode.judge._verdict import Confirmation, Counterexample, Evidence, Residual
from polhode.judge.balance._declared import declared, reaction_symbol
from polhode.judge.balance._newton_euler import (
    constrained_motion,
    rate_along_motion,
    true_motion,
)
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._claim_domain import AnyState, ClaimDomain
from polhode.judge.states._numeric import NO_VALUE, number
from polhode.judge.states._sample_points import (
    ExactPoint,
    exact_point,
    is_physical,
    on_closed_loops,
)

_TRIES = 300  # states drawn from many numbers, of which few may be physical
_MOST_FAILED = 30  # states without values of every quantity
_PLAIN_TRIES = 150  # states of small numbers, drawn before
_LOOKED_AT = 12  # states that refute a claim, confirmed or not
_COMPARED = 4  # states that refute a claim, of which the one with the shortest numbers is shown
# Numbers that a reader can follow by hand; g is 10 m/s².
_PLAIN = [*map(Fraction, range(1, 9)), Fraction(1, 2), Fraction(3, 2), Fraction(5, 2)]
_GRAVITY = Fraction(10)
_ACCELERATION = LENGTH / TIME**2
_ROUNDING = 1e-7  # relative error of the linear solve at a state; wrong sides differ by far more
_CLOSE = 1e-9  # relative; two sides this close differ by rounding, where they are in doubles
_RATES = 4  # how many of f, ḟ, f̈, … get values for a prescribed function f


def _differ(left: Expr, right: Expr) -> bool:
    """Whether two values differ by more than the rounding of doubles."""
    return left != right and not isclose(number(left, {}), number(right, {}), rel_tol=_CLOSE)


def refutation(
    component: ScalarRelation,
    residual: Residual,
    states: ClaimDomain,
    refutes: Callable[[Expr, Expr], bool] = _differ,
    nonzero: Expr = ONE,
) -> Evidence:
    """A counterexample and its confirmation; None where none is found.

    Args:
        component: what is refuted.
        residual: of that component, exactly.
        states: where the claim should hold.
        refutes: whether values of the two sides refute it; by default, if they differ.
        nonzero: what must not vanish there, such as the residuals of all branches of a ±.
    """
    sides = (states.on(component.left), states.on(component.right))

    def is_example(point: ExactPoint) -> bool:
        left, right = (_at(point, side) for side in sides)
        return refutes(left, right) and bool(_at(point, nonzero))

    return example_where(is_example, component, residual, states, nonzero)


def example_where(
    refutes: Callable[[ExactPoint], bool],
    component: ScalarRelation,
    residual: Residual,
    states: ClaimDomain,
    used: Expr = ONE,
) -> Evidence:
    """The physical state with the shortest numbers that refutes a component, among the first few.

    Args:
        refutes: whether a state refutes it.
        component: what is refuted.
        residual: of that component, exactly.
        states: where the claim should hold.
        used: a further expression that needs a value at the state.
    """
    sides = (states.on(component.left), states.on(component.right))

    def examples() -> Iterator[tuple[ExactPoint, Counterexample]]:
        for drawn in _drawn((*sides, used), states):
            try:
                point = on_closed_loops(drawn, states)
                if is_physical(states, point.floats()) and refutes(point):
                    left, right = (_at(point, side) for side in sides)
                    values = _described(point, states)
                    yield point, Counterexample(values, left, right, residual)
            except NO_VALUE:
                continue

    found = examples()
    shortest_first = sorted(islice(found, _COMPARED), key=lambda pair: _length(pair[1]))
    for point, example in chain(shortest_first, islice(found, _LOOKED_AT - _COMPARED)):
        confirmation = _confirmed(point, component, states, example)
        # A state may lie on another branch of a closed loop, which the numeric balance refuses.
        if confirmation is not None:
            return example, confirmation
    return (shortest_first[0][1], None) if shortest_first else (None, None)


def _length(example: Counterexample) -> tuple[bool, int]:
    """Whether g is far from that on Earth; the digits of all values and of both sides."""
    gravity = example.values.get("g", str(_GRAVITY))
    digits = sum(map(len, (*example.values.values(), str(example.left), str(example.right))))
    return gravity != str(_GRAVITY), digits


def drawn_numbers(sides: Sequence[Expr], states: ClaimDomain) -> Iterator[dict[Symbol, float]]:
    """Values of every quantity at physical states of a domain, forces included."""
    failed = 0
    for drawn in _unreduced(sides, states):
        try:
            point = on_closed_loops(drawn, states)
            if is_physical(states, point.floats()):
                yield _numbers(point, states)
        except NO_VALUE:
            failed += 1
            if failed == _MOST_FAILED:  # of frames that turn in time, it has no value anywhere
                return


def _unreduced(sides: Sequence[Expr], states: ClaimDomain) -> Iterator[ExactPoint]:
    """States with values for what is drawn, found without solving for anything else."""
    field = states.field
    if field is None:
        yield from _drawn(tuple(map(states.on, sides)), states)
        return
    equations = states.equations
    used = [*sides, *states.given.values(), *equations.forcing, *equations.kinematics.values()]
    used += equations.mass.entries
    used += [*equations.dependent.values(), *states.assumed_positive, *field.reactions.values()]
    symbols = {s for e in used for s in e.symbols() if field.is_drawn(s)} | _state(states)
    yield from (exact_point(used, symbols, seed) for seed in range(_TRIES))


def _drawn(sides: tuple[Expr, ...], states: ClaimDomain) -> Iterator[ExactPoint]:
    used = [*sides, *states.settled_relations, *map(states.on, states.signs)]
    used += states.equations.accelerations.values()
    symbols = {s for e in used for s in e.symbols()} | _state(states)
    gravity = {
        s: _GRAVITY
        for s in symbols
        if s.published == "g" and states.equations.dimensions.get(s) == _ACCELERATION
    }
    for seed in range(_PLAIN_TRIES):
        point = exact_point(used, symbols, seed, _PLAIN)
        yield replace(point, numbers={**point.numbers, **gravity})
    yield from (exact_point(used, symbols, seed) for seed in range(_TRIES))


def _state(states: ClaimDomain) -> set[Symbol]:
    """The symbols that need a value for a state to be complete."""
    equations = states.equations
    known = declared(equations.system)
    found = {*equations.coordinates, *equations.speeds, *equations.parameters}
    found |= {*known.coordinates, *known.parameters}
    # What is given may contain letters of the text, such as a radius in I = m a²/2.
    found |= {s for e in (*states.relations, *states.given.values()) for s in e.symbols()}
    for function in equations.functions:
        for _ in range(_RATES):
            found.add(function)
            function = function.derivative()
    return found


def _at(point: ExactPoint, expression: Expr) -> Expr:
    """The exact value of an expression; in doubles if it has none, or named subexpressions."""
    if not any(under_name(generator) is not None for generator in expression.generators):
        try:
            return point(expression)
        except NumericError:
            pass  # such as of cos γt
    return Expr.of(float(number(expression, point.floats())))


def _described(point: ExactPoint, states: ClaimDomain) -> dict[str, str]:
    """The state in full, including the quantities that the domain determines."""
    values = point.described()
    for symbol in _state(states):
        image = states.of(symbol)
        if image != Expr.generator(symbol):
            values[symbol.published] = str(_at(point, image))
    return dict(sorted(values.items()))


# -- the second opinion ---------------------------------------------------------------------------


def _confirmed(
    point: ExactPoint, component: ScalarRelation, states: ClaimDomain, found: Counterexample
) -> Confirmation | None:
    """Both sides with accelerations and reactions from the numeric balance of every body."""
    used = component.left.symbols() | component.right.symbols()
    equations = states.equations
    try:
        numbers = _numbers(point, states)
        forces = {reaction_symbol(name) for name in equations.components}
        rates = {s for s in used - numbers.keys() if s.order == 1 and s.base() in forces}
        for side in (component.left, component.right):  # rates take long, and not all have a value
            number(side, numbers | dict.fromkeys(rates, 1.0))
        numbers |= {
            s: rate_along_motion(equations.system, numbers, equations.speeds, s.base())
            for s in rates
        }
        left, right = (float(number(s, numbers)) for s in (component.left, component.right))
    except NO_VALUE:
        return None
    scale = max(abs(left), abs(right), 1e-12)  # one side may be zero: compare with the other
    expected = (number(found.left, {}), number(found.right, {}))
    agrees = all(
        isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING * scale)
        for one, other in zip((left, right), expected, strict=True)
    )
    named = {
        s.published: numbers[s] for s in sorted(used, key=lambda s: s.published) if s in numbers
    }
    return Confirmation(named, left, right, agrees)


def _numbers(point: ExactPoint, states: ClaimDomain) -> dict[Symbol, float]:
    """Values of all quantities at a point; accelerations and reactions from the balance alone."""
    drawn = point.floats()
    symbols, known = _state(states), dict[Generator, float]()
    state = drawn | {s: number(states.of(s), drawn, known) for s in symbols}
    system = states.equations.system
    if isinstance(states, AnyState):
        accelerations = {s: drawn[s] for s in states.equations.acceleration_symbols if s in drawn}
        return drawn | constrained_motion(system, state, accelerations)
    return drawn | true_motion(system, state)
