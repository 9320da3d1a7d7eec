"""The data of a motion besides its declaration and its series, as plain JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from polhode.algebra import SHAPES, Expr, Symbol, SymbolKind
from polhode.base import Codec, ShapeRecord
from polhode.simulate._event import Event
from polhode.simulate.files._archive import mapping, number, numbers, text


@dataclass(frozen=True)
class _Table:
    """Expressions under symbols or names."""

    rows: tuple[tuple[Symbol | str, Expr], ...]


def _table(rows: tuple[tuple[Any, Any], ...]) -> _Table:
    for name, expression in rows:
        if not isinstance(name, Symbol | str) or not isinstance(expression, Expr):
            raise ValueError("a table of something other than expressions")
    return _Table(rows)


_CODEC = Codec(
    (*SHAPES, ShapeRecord("table", (_Table,), lambda table: {"rows": table.rows}, _table))
)


@dataclass(frozen=True)
class Details:
    """The data of a motion that are stored by name.

    Attributes:
        duration, mode, assumed, seconds, integrator, invariants, resolution: as of the trajectory.
        turned: for angles that grow large, the symbol of the angle modulo whole turns.
        prescribed: every prescribed function as an expression of time.
        sides: signs of the arguments of absolute values, in order, by number of the segment.
        independent: the independent speeds, by number of the segment, where they are not those
            that the declaration leads to.
        replaced: by number of the stretch, where angles are counted from turned axes: the declared
            ones where it begins, and their rates where these are known.
        doubt: as of the trajectory.
    """

    duration: float
    mode: str
    assumed: Mapping[str, float]
    seconds: Mapping[str, float]
    integrator: str
    resolution: Mapping[str, float]
    turned: Mapping[Symbol, Symbol]
    prescribed: Mapping[Symbol, Expr]
    invariants: Mapping[str, Expr]
    sides: Mapping[int, Sequence[int]]
    independent: Mapping[int, Sequence[Symbol]]
    replaced: Mapping[int, Mapping[Symbol, float]]
    doubt: str

    def as_json(self) -> dict[str, Any]:
        """As JSON values, which `read_details` reads."""
        return {
            "duration": self.duration,
            "mode": self.mode,
            "assumed": dict(self.assumed),
            "seconds": dict(self.seconds),
            "integrator": self.integrator,
            "resolution": dict(self.resolution),
            "turned": {label(a): label(b) for a, b in self.turned.items()},
            "forcing": _CODEC.write(_Table(tuple(self.prescribed.items()))),
            "invariants": _CODEC.write(_Table(tuple(self.invariants.items()))),
            "sides": {str(number): list(sides) for number, sides in self.sides.items()},
            "independent": {
                str(number): list(map(label, speeds)) for number, speeds in self.independent.items()
            },
            "replaced": {
                str(k): {label(s): x for s, x in angles.items()}
                for k, angles in self.replaced.items()
            },
            "doubt": self.doubt,
        }


def read_details(given: Mapping[str, Any]) -> Details:
    """The details that were written.

    Raises:
        LookupError, ValueError: where something is missing or of another type.
        StoreError: for expressions that cannot be read.
    """
    # A prescribed function is an expression of time, or of one other: the time since a knot.
    rows = _rows(given["forcing"])
    table = {name: value for name, value in rows if isinstance(name, Symbol)}
    plain = {s for s, value in table.items() if all(map(_is_given, value.symbols()))}
    for name, value in table.items():
        if not all(_is_given(s) or s in plain for s in value.symbols()):
            raise ValueError(f"{name.published} is not a function of time")
    return Details(
        duration=number(given["duration"]),
        mode=text(given["mode"]),
        assumed=numbers(given["assumed"]),
        seconds=numbers(given["seconds"]),
        integrator=text(given["integrator"]),
        resolution=numbers(given["resolution"]),
        turned={symbol(a): symbol(text(b)) for a, b in mapping(given["turned"]).items()},
        prescribed=table,
        invariants={text(name): value for name, value in _rows(given["invariants"])},
        sides={int(i): tuple(map(_side, s)) for i, s in mapping(given["sides"]).items()},
        independent={
            int(i): tuple(symbol(text(s)) for s in speeds)
            for i, speeds in mapping(given.get("independent", {})).items()
        },
        replaced={
            int(k): {symbol(text(s)): x for s, x in numbers(angles).items()}
            for k, angles in mapping(given.get("replaced", {})).items()
        },
        doubt=text(given["doubt"]),
    )


def _side(given: object) -> int:
    if given not in (-1, 0, 1):
        raise ValueError("a sign other than -1, 0 and 1")
    return int(number(given))


def _rows(document: Any) -> tuple[tuple[Any, Expr], ...]:
    return _CODEC.read(text(document), _Table).rows


def _is_given(symbol: Symbol) -> bool:
    return symbol.kind in (SymbolKind.TIME, SymbolKind.PARAMETER)


# -- events ----------------------------------------------------------------------------------------


def read_event(given: Mapping[str, Any], duration: float) -> Event:
    """An event of a motion of some duration.

    Raises:
        LookupError, ValueError: where something is missing or of another type.
    """
    before, after = (None if given[end] is None else text(given[end]) for end in ("from", "to"))
    time = number(given["time"])
    if not 0 <= time <= duration:
        raise ValueError(f"an event at t = {time:g} s in a motion of {duration:g} s")
    return Event(time, text(given["kind"]), before, after)


# -- symbols ---------------------------------------------------------------------------------------


def label(symbol: Symbol) -> str:
    """A symbol as text."""
    return f"{symbol.kind.value} {symbol.order} {symbol.name}"


def symbol(label: str) -> Symbol:
    """The symbol that `label` wrote as text.

    Raises:
        ValueError: for other text.
    """
    kind, order, name = label.split(" ", 2)
    if order not in ("0", "1", "2"):
        raise ValueError(f"the derivative {order[:20]}")
    return Symbol(name, SymbolKind(kind), int(order))
