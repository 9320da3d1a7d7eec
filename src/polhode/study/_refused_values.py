"""Values that no member can have: of another dimension, or common to all and impossible."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any

from polhode.algebra import Expr
from polhode.base import TIME, DeclarationError, Dimension, to_si
from polhode.derive import Equations
from polhode.simulate import constants
from polhode.study._columns import Column


def refuse_values(
    modes: Iterable[Equations], parameters: Mapping[str, Any], start: Mapping[str, Any]
) -> None:
    """Refuse what is wrong whatever member it is given to.

    Args:
        modes: in which the quantities are known.
        parameters: a `Column` where members differ, else the one value of all.
        start: likewise.

    Raises:
        DeclarationError: for a common parameter that has to be positive and is not, or one that is
            an expression of unknown quantities.
        UnitError: for a unit of another dimension, or a common value that cannot be read.
    """
    known, positive = dict[str, Dimension](), set[str]()
    for equations in modes:
        known |= dict(_dimensions(equations))
        positive |= {s.published for s in equations.parameters if s.positive}
    for name, value in {**parameters, **start}.items():
        for one in _told(value):
            number = to_si(one, known[name], name) if name in known else 1.0
            if name in positive and number <= 0 and not isinstance(value, Column):
                raise DeclarationError(
                    f"{name} = {number:g} for every member",
                    expected="a positive value, as it was declared",
                    advice=f"check the sign of {name}",
                )
    _refuse_unknown(parameters, ())
    _refuse_unknown(start, parameters)


def _dimensions(equations: Equations) -> Iterator[tuple[str, Dimension]]:
    """Of parameters, coordinates, speeds and rates, as far as they are known."""
    own = (*equations.coordinates, *equations.speeds)
    moving = (*own, *equations.kinematics, *equations.dependent)
    for symbol in (*equations.parameters, *moving):
        base = equations.dimensions.get(symbol.base())
        if base is not None:
            yield symbol.published, base / TIME**symbol.order


def _told(value: Any) -> Iterator[Any]:
    """What tells whether values can be read: every text, a unit, or the one value of all."""
    match value:
        case Column() if value.values.dtype.kind == "U":
            yield from sorted(set(value.values.tolist()))
        case Column() if value.unit:
            yield (1.0, value.unit)
        case Expr() | Column():
            return
        case _:
            yield value


def _refuse_unknown(values: Mapping[str, Any], known: Collection[str]) -> None:
    """Expressions of what has no value."""
    for name, value in values.items():
        for symbol in constants([value]) if isinstance(value, Expr) else ():
            if symbol.published not in known:
                raise DeclarationError(
                    f"{name} = {value}, and no value for {symbol.published}",
                    expected="a number, or an expression of parameters for a start value",
                )
