"""Values of parameters and start values, read and checked."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from functools import lru_cache
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

import numpy as np

from polhode.algebra import (
    FLOATS,
    Compiled,
    Expr,
    GivenValue,
    Symbol,
    compile_program,
    read_value,
)
from polhode.base import TIME, DeclarationError, Dimension, ParseError, UnitError, look_up
from polhode.model import check_inertia, check_mass, declared_parameters
from polhode.simulate._dynamics import Dynamics, EquationsOfMotion, constants
from polhode.simulate._names import Name, by_name, published

Numbers = Mapping[Symbol, float]


def given_values(given: Mapping[Name, Any]) -> dict[Name, GivenValue]:
    """Values by published name, each read once.

    Raises:
        DeclarationError: for a name that is given twice, and for anything but a mapping.
        UnitError: for a value that cannot be read.
    """
    _refuse_unnamed(given)
    values: dict[Name, GivenValue] = {}
    for key, value in given.items():
        name = published(key)
        if name in values:
            raise DeclarationError(f"{name} is given twice", expected="one value for it")
        values[name] = read_value(name, value)
    return values


def _refuse_unnamed(given: object) -> None:
    if not isinstance(given, Mapping):
        raise DeclarationError(
            f"values given as a {type(given).__name__}",
            expected="a dictionary with a value for each name",
            advice='as in {"theta": "80 deg"}',
        )


def with_formulas(
    given: Mapping[Name, Any], known: Callable[[], Collection[str]]
) -> dict[Name, GivenValue]:
    """Values of parameters, some of them formulas of others, such as "m*a**2/2".

    Args:
        given: numbers, texts, or expressions of other parameters.
        known: names of the parameters of the system. Others may be given if a formula needs them,
            such as a radius that only moments of inertia depend on; they are left out.

    Raises:
        DeclarationError: for values that depend on one another in a circle, or on others that are
            not given.
        UnitError: for a value that cannot be read.
    """
    _refuse_unnamed(given)
    names = {published(key): Symbol(published(key)) for key in given}
    read = given_values({key: _read(published(key), v, names) for key, v in given.items()})
    values = {published(name): value for name, value in read.items()}
    needs = {name: {s.published for s in value.symbols} for name, value in values.items()}
    needed = set[str]().union(*needs.values())
    if not needed:
        return read
    try:
        order = [name for name in TopologicalSorter(needs).static_order() if name in values]
    except CycleError as error:
        circle = " needs ".join(reversed(error.args[1]))
        raise DeclarationError(
            f"values that depend on one another: {circle}", expected="a number for one of them"
        ) from error
    refuse_missing(sorted(needed - values.keys()))
    doubles, exact = dict[str, float](), dict[str, Expr]()
    for name in order:
        value = values[name]
        doubles[name] = value.rounded({s: doubles[s.published] for s in value.symbols})
        exact[name] = value.exact({s: exact[s.published] for s in value.symbols})
        if value.symbols:
            values[name] = GivenValue(name, value.given, exact[name], doubles[name])
    helpers = needed - set(known())
    return {name: value for name, value in values.items() if name not in helpers}


def _read(name: str, value: Any, names: Mapping[str, Symbol]) -> Any:
    """A value; text that is neither a number nor one with a unit may be a formula."""
    try:
        return read_value(name, value)
    except UnitError:
        if not isinstance(value, str):
            raise
        try:
            return read_value(name, value, names)
        except ParseError:
            pass
        raise


def read_values(
    given: Mapping[Name, Any],
    symbols: Mapping[str, Symbol],
    what: str,
    dimensions: Mapping[Symbol, Dimension],
    known: Numbers,
) -> dict[Symbol, float]:
    """SI values of quantities given by name, rounded to doubles.

    Args:
        given: numbers, texts with a unit, or expressions of `known` symbols.
        symbols: the quantities that may be given, by published name.
        what: the word for them in messages.
        dimensions: of the symbols whose dimension is known.
        known: values of the symbols that expressions may use.

    Raises:
        DeclarationError: for a name that is unknown or given twice.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    values: dict[Symbol, float] = {}
    for name in map(published, given):
        look_up(name, symbols, what)
    for value in given_values(given).values():
        symbol = symbols[value.name]
        base = dimensions.get(symbol.base())
        dimension = None if base is None else base / TIME**symbol.order
        values[symbol] = value.in_dimension(dimension).rounded(known)
    return values


def read_parameters(
    dynamics: Dynamics, given: Mapping[Name, Any], supplied: Numbers = MappingProxyType({})
) -> dict[Symbol, float]:
    """The value of every parameter, except those `supplied` by prescribed motions.

    Raises:
        DeclarationError: for an unknown name, a parameter without a value, or values that no body
            can have.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    wanted = [symbol for symbol in dynamics.parameters if symbol not in supplied]
    dimensions = getattr(dynamics.equations, "dimensions", {})
    values = read_values(given, by_name(wanted), "parameter", dimensions, {})
    missing = [symbol.published for symbol in wanted if symbol not in values]
    refuse_missing(missing)
    for symbol, value in values.items():
        if symbol.positive and value <= 0:
            raise DeclarationError(
                f"{symbol.published} = {value:g}",
                expected="a positive value, as it was declared",
                advice=f"check the sign of {symbol.published}",
            )
    _check_bodies(dynamics, values)
    _check_sizes(dynamics, values)
    return {symbol: values[symbol] for symbol in wanted}


def refuse_missing(parameters: Sequence[str]) -> None:
    """Refuse parameters that have no value.

    Raises:
        DeclarationError: with their names.
    """
    if parameters:
        raise DeclarationError(
            f"no value for {', '.join(parameters)}",
            expected="a value for every parameter",
            advice=f"give {parameters[0]} as a number in SI units or with a unit",
        )


def idle_parameters(equations: EquationsOfMotion, given: Mapping[Name, Any]) -> tuple[Symbol, ...]:
    """Given parameters of the declaration, whether the motion depends on them or not."""
    names = {published(name) for name in given}
    return tuple(s for s in declared_parameters(equations.system) if s.published in names)


def evaluate(expression: Expr, numbers: Numbers) -> float:
    """Value of an expression of known symbols."""
    if (symbol := expression.symbol) is not None and symbol in numbers:
        return float(numbers[symbol])
    (value,) = _function((expression,), tuple(numbers))(*numbers.values())
    return float(value)


@lru_cache(maxsize=256)
def _function(expressions: tuple[Expr, ...], symbols: tuple[Symbol, ...]) -> Compiled:
    return compile_program(expressions, symbols).function(FLOATS)


def _check_sizes(dynamics: Dynamics, values: Numbers) -> None:
    """Refuse radii and lengths that are negative, which a symbol may hide in the declaration."""
    system = dynamics.equations.system
    surfaces = (body.surface for body in getattr(system, "bodies", ()) if body.surface)
    for part in (*surfaces, *getattr(system, "elements", ()), *getattr(system, "loads", ())):
        for what, size, may_vanish in part.sizes:
            if not values.keys() >= set(constants([size])):
                continue
            value = evaluate(size, values)
            if value < 0 or (value == 0 and not may_vanish):
                raise DeclarationError(
                    f"{what}: {size} = {value:g}",
                    expected="zero or more" if may_vanish else "a positive value",
                    advice="check its sign",
                )


def _check_bodies(dynamics: Dynamics, values: Numbers) -> None:
    bodies = getattr(dynamics.equations.system, "bodies", ())
    for body in (body for body in bodies if not body.is_massless):
        if values.keys() >= set(constants([body.mass])):
            check_mass(body.name, evaluate(body.mass, values))
        entries = body.inertia.entries
        if values.keys() >= set(constants(entries)):
            inertia = _function(entries, tuple(values))(*values.values())
            if not np.isfinite(inertia).all():
                raise DeclarationError(
                    f"inertia of body {body.name!r}: not finite, with these values",
                    expected="moments of at most 1e308 kg m²",
                    advice="check the units of masses and lengths",
                )
            # Principal moments obey the triangle inequality: of a + b, b + c and c + a, where a, b
            # and c are the second moments of mass, the largest is at most the sum of the others.
            moments = np.linalg.eigvalsh(np.reshape(inertia, (3, 3))).tolist()
            if moments[0] < 0 or moments[2] > moments[0] + moments[1]:
                check_inertia(body.name, moments)
