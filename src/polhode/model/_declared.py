"""Common to all declarations: printing, registration, and checks of arguments."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import fields, is_dataclass
from inspect import isabstract
from typing import Any, NamedTuple, Self, cast

from polhode.algebra import (
    PI,
    Expr,
    ExprLike,
    Symbol,
    SymbolKind,
    Vector,
    is_positive,
    variables,
)
from polhode.base import DeclarationError, NumericError, Shown


class Size(NamedTuple):
    """A quantity of a declaration that no negative number can be, such as a radius.

    Attributes:
        what: its name in messages.
        value: as it was declared.
        may_vanish: whether it can be zero.
    """

    what: str
    value: Expr
    may_vanish: bool = False


class Declared(Shown):
    """A part of a declaration: a frozen dataclass that prints its fields and can be saved.

    Every subclass is registered under its name, so that a user's load or surface is written to
    documents, and read from them, like those of polhode.

    Raises:
        DeclarationError: for a user's subclass with the name of a class of polhode.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        known = _REGISTERED.get(cls.__name__)
        if known is not None and is_own(known) and not is_own(cls):
            raise DeclarationError(
                f"a class {cls.__name__!r}, derived from {cls.__base__.__name__}",  # type: ignore[union-attr]
                expected="a name that polhode does not use itself",
                advice="choose another name: saved files refer to classes by name",
            )
        _REGISTERED[cls.__name__] = cls

    def _set(self, **values: object) -> None:
        """Set the fields of a frozen dataclass that checks its arguments in `__init__`."""
        for field, value in values.items():
            object.__setattr__(self, field, value)

    def _changed(self, **values: object) -> Self:
        """A copy with other values of some fields, and nothing cached from the old ones."""
        kept = {field.name: getattr(self, field.name) for field in fields(cast(Any, self))}
        made = object.__new__(type(self))
        made._set(**{**kept, **values})
        return made

    @property
    def brief(self) -> str:
        """Its short form within another declaration."""
        name = getattr(self, "name", "")
        return f"{type(self).__name__} {name!r}" if name else type(self).__name__

    @property
    def parts(self) -> Iterator[tuple[str, object]]:
        """Its fields by name, except `name` and those left empty."""
        named: Any = self
        for field in fields(named):
            value = getattr(self, field.name)
            if field.name != "name" and value not in (None, "", ()):
                yield field.name.replace("_", " "), value

    @property
    def sizes(self) -> Iterator[Size]:
        """The quantities whose sign is checked again when their values are known."""
        return iter(())

    def __str__(self) -> str:
        parts = [(name, brief(value)) for name, value in self.parts]
        width = max((len(name) for name, _ in parts), default=0)
        return "\n".join([self.brief, *(f"  {name:{width}}  {text}" for name, text in parts)])


_REGISTERED: dict[str, type[Declared]] = {}


def registered() -> tuple[type[Declared], ...]:
    """The concrete classes of declarations, with the latest definitions of users' classes."""
    return tuple(
        kind
        for kind in _REGISTERED.values()
        if is_dataclass(kind) and not isabstract(kind) and not kind.__name__.startswith("_")
    )


def is_own(kind: type) -> bool:
    """Whether a class is part of polhode."""
    return kind.__module__.partition(".")[0] == __name__.partition(".")[0]


def brief(value: object) -> str:
    """A part of a declaration on one line."""
    if isinstance(value, tuple):
        return ", ".join(map(brief, value))
    return str(getattr(value, "brief", value))


# -- checks, whose messages name the quantity ------------------------------------------------------


def quantity(value: ExprLike, what: str) -> Expr:
    """The expression that a value stands for.

    Raises `DeclarationError` with the name of the quantity, for NaN or anything but a number.
    """
    try:
        return Expr.of(value)
    except NumericError as error:
        raise DeclarationError(
            f"{what}: {error.given}", expected=error.expected, advice=error.advice
        ) from error


def positive(value: ExprLike, what: str) -> Expr:
    """The same for a quantity that must be positive."""
    expression = quantity(value, what)
    if expression.is_zero or is_negative(expression):
        raise DeclarationError(f"{what}: {expression}", expected="a positive value")
    return expression


def not_negative(value: ExprLike, what: str) -> Expr:
    """The same for a quantity that must not be negative."""
    expression = quantity(value, what)
    if is_negative(expression):
        raise DeclarationError(f"{what}: {expression}", expected="zero or more")
    return expression


def three(values: Iterable[ExprLike], what: str) -> tuple[ExprLike, ExprLike, ExprLike]:
    """Three values along three axes."""
    listed = tuple(values) if isinstance(values, Iterable) else (values,)
    if len(listed) != 3 or isinstance(values, str):
        raise DeclarationError(f"{what}: {values!r}", expected="three lengths, along three axes")
    first, second, third = listed
    return first, second, third


def constant(expression: Expr, what: str) -> Expr:
    """An expression of parameters alone."""
    varying = sorted(s.published for s in expression.symbols() if is_varying(s))
    if varying:
        raise DeclarationError(
            f"{what}: {expression}, which varies with {', '.join(varying)}",
            expected="a constant: bodies are rigid and keep their mass",
        )
    return expression


def is_varying(symbol: Symbol) -> bool:
    """Whether it changes with time."""
    return symbol.kind.varies or symbol.kind is SymbolKind.TIME


def without_rates(expressions: Iterable[Expr], what: str) -> None:
    """Refuse speeds and rates of coordinates in a position or an angle."""
    found = (s for s in variables(expressions) if is_rate(s))
    if rates := sorted(s.published for s in found):
        raise DeclarationError(
            f"{what}, which depends on {', '.join(rates)}",
            expected="an expression of coordinates, parameters and time",
            advice="speeds may occur in loads, and in the rate of a Motor or a Turntable",
        )


def without_coordinates(expressions: Iterable[Expr], what: str, advice: str) -> None:
    """Refuse coordinates and speeds in a quantity that must be prescribed."""
    found = (
        s for s in variables(expressions) if s.kind in (SymbolKind.COORDINATE, SymbolKind.SPEED)
    )
    if names := sorted(s.published for s in found):
        raise DeclarationError(
            f"{what}, which depends on {', '.join(names)}",
            expected="an expression of parameters and time",
            advice=advice,
        )


def is_rate(symbol: Symbol) -> bool:
    """Whether it is a speed or the rate of a coordinate."""
    return symbol.kind is SymbolKind.SPEED or (
        symbol.kind is SymbolKind.COORDINATE and symbol.order > 0
    )


def unit_vector(vector: Vector, what: str) -> Vector:
    """A vector of length one."""
    of_type(vector, Vector, what, "take a direction of a frame, such as lab['x']")
    if vector.dot(vector) != 1:
        raise DeclarationError(
            f"{what}: ({', '.join(map(str, vector.components))})",
            expected="a unit vector",
            advice="divide it by its length",
        )
    return vector


def of_type(value: object, kind: type, what: str, advice: str) -> None:
    """Refuse a part of a declaration that is of another type."""
    if not isinstance(value, kind):
        raise DeclarationError(f"{what}: {value!r}", expected=f"a {kind.__name__}", advice=advice)


def is_negative(expression: Expr) -> bool:
    """Whether it is known to be negative, as a number or from the signs of its symbols."""
    return is_positive(-expression)


def declared_parameters(declaration: Any) -> tuple[Symbol, ...]:
    """The parameters that occur anywhere in a declaration, each once, in order of appearance."""
    return tuple(dict.fromkeys(s for s in _symbols(declaration, SymbolKind.PARAMETER) if s != PI))


def declared_functions(declaration: Any) -> tuple[Symbol, ...]:
    """The prescribed functions of time that occur in it, without their rates."""
    return tuple(dict.fromkeys(s.base() for s in _symbols(declaration, SymbolKind.FUNCTION)))


def _symbols(part: Any, kind: SymbolKind) -> Iterator[Symbol]:
    if isinstance(part, Expr):
        found = (s for s in part.symbols() if s.kind is kind)
        yield from sorted(found, key=lambda symbol: symbol.published)
    elif isinstance(part, tuple):
        for inner in part:
            yield from _symbols(inner, kind)
    elif is_dataclass(part) and not isinstance(part, Symbol | type):
        for field in fields(part):
            yield from _symbols(getattr(part, field.name), kind)
