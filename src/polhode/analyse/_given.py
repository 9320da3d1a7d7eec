"""Values supplied for exact analysis: expressions, numbers, and text or pairs with a unit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from polhode.algebra import Expr, ExprLike, GivenValue, Symbol, as_symbol, read_value
from polhode.base import PURE, TIME, NumericError, Quantity, Value, look_up
from polhode.derive import Equations
from polhode.model import declared_parameters

#: Types accepted for a value, such as text "70 deg" and pairs (12, "mm").
Given = ExprLike | Value

#: Angles in these fractions of π have sines that are square roots; others are kept as decimals.
_EXACT_FRACTION = 12

#: What to do with a value that restricts steady motions and is given to what takes one family.
TO_STEADY = "give it to steady with at=, which restricts the families"


def values_given(
    equations: Equations,
    at: Mapping[Any, Given] | None,
    names: Mapping[str, Symbol] | None = None,
) -> dict[Symbol, Expr]:
    """Exact values of coordinates, their rates, speeds and parameters, by symbol.

    Args:
        equations: of the system they belong to.
        at: values by published name or by symbol.
        names: of quantities that text may be a formula of; without them text is a number.

    Raises:
        DeclarationError: for a name the system does not have.
        ParseError: for text that is no formula.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    rates = (q.derivative() for q in equations.coordinates)
    # what was declared may be given, whether anything depends on it or not
    parameters = dict.fromkeys((*equations.parameters, *declared_parameters(equations.system)))
    speeds = dict.fromkeys((*equations.speeds, *equations.dependent))
    everything = (*equations.coordinates, *rates, *speeds, *parameters)
    what = f"quantity of {equations.system.name}"
    found = {}
    for symbol, value in _by_symbol(at or {}, everything, what).items():
        base = equations.dimensions.get(symbol.base())
        dimension = None if base is None else base / TIME**symbol.order
        given = read_value(symbol.published, _in_decimals(value), names)
        found[symbol] = _exact(given.in_dimension(dimension))
    return found


def following_speeds(equations: Equations, given: Iterable[Symbol]) -> dict[Symbol, Expr]:
    """Which of some quantities are speeds that follow from the independent ones, and how."""
    follow = {**equations.kinematics, **equations.dependent}
    return {s: follow[s] for s in given if s in follow and s not in equations.speeds}


def refuse_following(
    equations: Equations, given: Iterable[Symbol], advice: str = "give a value of these"
) -> None:
    """Refuse values of speeds that follow from others, where they would change nothing.

    Raises:
        NumericError: with the speeds that each of them follows from.
    """
    for symbol, value in following_speeds(equations, given).items():
        raise NumericError(
            f"a value of {symbol.published}, which follows from other speeds",
            expected=f"independent speeds, of which {symbol.published} = {value}",
            advice=advice,
        )


def images_given(expression: Expr, about: Mapping[Any, Given] | None) -> dict[Symbol, Expr]:
    """The same for the symbols of an expression, whose dimensions are not known.

    Symbols that do not occur in it may be given.
    """
    own = (as_symbol(key) for key in about or {} if not isinstance(key, str))
    named = _by_symbol(about or {}, (*expression.symbols(), *own), "symbol of the expression")
    return {s: _exact(read_value(s.published, _in_decimals(v))) for s, v in named.items()}


def _by_symbol(given: Mapping[Any, Given], known: Iterable[Symbol], what: str) -> dict[Symbol, Any]:
    names = {s.published: s for s in known}
    return {
        look_up(key if isinstance(key, str) else as_symbol(key).published, names, what): value
        for key, value in given.items()
    }


def _in_decimals(value: Any) -> Any:
    """A value whose floats are read as the decimals they print as, which is what users mean."""
    match value:
        case (magnitude, str(unit)) if Expr.reads(magnitude):
            number = Expr.of(magnitude).rational
            return value if number is None else (number, unit)
    return Expr.of(value) if Expr.reads(value) else value


def _exact(value: GivenValue) -> Expr:
    """The exact value for analysis.

    An angle in multiples of 15 degrees is kept exact: its sine is a square root. The sine of any
    other angle has no such form, so the angle becomes the decimal it prints as in radians.
    """
    number = value.number
    is_decimal = (
        isinstance(number, Quantity)
        and number.pi_power == 1
        and number.dimension in (PURE, None)
        and _EXACT_FRACTION % number.coefficient.denominator
    )
    return Expr.of(Fraction(repr(value.rounded()))) if is_decimal else value.exact()
