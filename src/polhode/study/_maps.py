"""Maps over two quantities: an output of a sweep, and exact thresholds of stability."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, arrays, compile_program, dimension_of, pi
from polhode.analyse import SteadyMotion, stability, steady
from polhode.base import PURE, DeclarationError, Dimension, PolhodeError, look_up, read_quantity
from polhode.derive import Equations, automaton, derive, is_angle
from polhode.model import System, read_declaration
from polhode.study._columns import Array
from polhode.study._ensemble_runner import Reason
from polhode.study._grid import SAMPLE
from polhode.study._store import REASON, Store, intact, open_store

# Steady attitudes that are considered, over π: there the conditions of stability are short.
_ATTITUDES = (Fraction(0), Fraction(1, 2), Fraction(1))
_NEAR = 0.1  # how far beyond the ends of an axis a steady attitude may be, relative to its length
# How far starts may be from the steady motion whose threshold is shown: angles in rad, speeds
# relative to the largest of the map. Stability speaks of small departures.
_CLOSE, _SLOW = 0.05, 0.02
_ROUNDED = 1e-9  # beyond the end of an axis that is meant to reach a steady attitude
_MOST = 100_000_000  # values of a map


@dataclass(frozen=True)
class Threshold:
    """Where a family of steady motions changes between stable and unstable.

    Attributes:
        family: in words.
        condition: positive where it is stable; a function of the axes and the numbers.
        only_at: axes along which only one value belongs to the family, with that value.
    """

    family: str
    condition: Expr
    only_at: Mapping[str, float] = field(default_factory=dict, hash=False)

    def values(self, names: tuple[str, str], numbers: Mapping[str, float], grid: Array) -> Array:
        """The condition over a grid of two quantities, shape (2, …) to (…)."""
        symbols = {s.published: s for s in self.condition.symbols()}
        arguments = tuple(s for name, s in symbols.items() if name in (*names, *numbers))
        function = compile_program([self.condition], arguments).function(arrays())
        along = dict(zip(names, grid, strict=True))
        values = [along.get(s.published, numbers.get(s.published)) for s in arguments]
        # Undefined values, as of a square root, leave gaps in the curve; a condition on one of
        # the two quantities alone has to be spread over the grid.
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(function(*values)[0], dtype=float), grid.shape[1:])


def thresholds(
    equations: Equations, axes: Mapping[str, Array], numbers: Mapping[str, float]
) -> list[Threshold]:
    """The exact thresholds of stability of steady motions that starts of the map belong to.

    Only attitudes of 0, π/2 and π that lie on an axis or at the start are considered. A threshold
    of the upright disk is one of a map over ω₃ and a at θ = π/2; over θ and ω₃ it is a point.

    Args:
        axes: values of two quantities, by name.
        numbers: values of all others.
    """
    known = {*axes, *numbers, "pi"}
    found: dict[Expr, Threshold] = {}
    for at in _attitudes(equations, axes, numbers):
        try:
            families = steady(equations, at)
        except PolhodeError:
            continue  # no steady motions there, or none that can be found
        for family in families:
            only_at = _only_at(family, axes, numbers)
            for condition in _conditions(family) if only_at is not None else []:
                names = {s.published for s in condition.symbols()}
                # It needs a quantity of the axes, and numbers for all others.
                if names <= known and names & (set(axes) - set(only_at or ())):
                    found.setdefault(condition, Threshold(str(family), condition, only_at or {}))
    return list(found.values())


def _only_at(
    family: SteadyMotion, axes: Mapping[str, Array], numbers: Mapping[str, float]
) -> dict[str, float] | None:
    """The axes on which a family has one value; None where no start of the map is close to it.

    Speeds that are not given are zero.
    """
    system = family.reduced
    if family.relations:  # which few starts of a map meet
        return None
    known = {"pi": np.pi, **numbers}
    speeds = {s.published for s in system.speeds}
    sizes = [np.abs(known[s]) for s in speeds & known.keys()]
    fastest = max([*sizes, *(np.max(np.abs(axes[s])) for s in speeds & axes.keys())], default=0.0)
    found: dict[str, float] = {}
    for symbol in (s for s in system.state if s in family.fixed):
        name, own = symbol.published, _number(family.fixed[symbol], known)
        if own is None:
            return None
        if name in axes:
            if not np.min(axes[name]) - _ROUNDED <= own <= np.max(axes[name]) + _ROUNDED:
                return None
            found[name] = own
            continue
        is_speed = name in speeds
        start = known.get(name, 0.0 if is_speed else np.inf)
        if abs(start - own) > (_SLOW * fastest if is_speed else _CLOSE):
            return None
    return found


def _number(expression: Expr, known: Mapping[str, float]) -> float | None:
    """The value of an expression of known quantities; None for one of others."""
    symbols = tuple(expression.symbols())
    if not {s.published for s in symbols} <= known.keys():
        return None
    arguments = [known[s.published] for s in symbols]
    return float(compile_program([expression], symbols).function()(*arguments)[0])


def _conditions(family: SteadyMotion) -> list[Expr]:
    """Conditions of stability; none where these coordinates cannot decide."""
    try:
        return [condition.expression for condition in stability(family).conditions]
    except PolhodeError:
        return []


def _attitudes(
    equations: Equations, axes: Mapping[str, Array], numbers: Mapping[str, float]
) -> Iterator[dict[Symbol | Expr | str, Expr]]:
    for coordinate in equations.coordinates:
        name = coordinate.published
        values = axes.get(name, np.array([numbers[name]]) if name in numbers else np.empty(0))
        if not len(values):
            continue
        low, high = float(np.min(values)), float(np.max(values))
        margin = _NEAR * max(high - low, 1.0)
        for attitude in _ATTITUDES:
            if low - margin <= float(attitude) * np.pi <= high + margin:
                yield {coordinate: Expr.constant(attitude) * pi}


# -- a map from a store ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Measured:
    """A quantity of a system, for labels and units.

    Attributes:
        symbol: of the system.
        dimension: of its values.
        is_angle: whether it is an angle.
    """

    symbol: Symbol
    dimension: Dimension
    is_angle: bool


@dataclass(frozen=True)
class Found:
    """An output over two axes.

    Attributes:
        system: its name.
        output: name of the output.
        labels: meanings of its codes; empty for a quantity.
        axes: values along the two axes by name, SI.
        values: of the output, shape of the axes; not-a-number where there is no result.
        thresholds: exact curves over the axes.
        numbers: values of all other quantities.
        origin: provenance of the store, as JSON.
        measured: which of the axes, and of the output, are quantities of the system, by name.
        failed: where a motion could not be simulated, shape of the axes; None if unknown.
    """

    system: str
    output: str
    labels: tuple[str, ...]
    axes: Mapping[str, Array]
    values: Array
    thresholds: tuple[Threshold, ...]
    numbers: Mapping[str, float]
    origin: str
    measured: Mapping[str, Measured] = field(default_factory=dict)
    failed: NDArray[np.bool_] | None = None


def found_in(path: Path, output: str = "") -> Found:
    """The map that a store holds.

    Args:
        output: name of the output to map; by default the first that is a code.

    Raises:
        DeclarationError: for a store without two axes, or an unknown output.
        StoreError: where there is no store.
    """
    store = open_store(path)
    with intact(path):
        mapped, system, in_one_mode = _mapped(store, output)
    equations: Equations = derive(system) if in_one_mode else automaton(system).together.equations
    return replace(
        mapped,
        thresholds=tuple(thresholds(equations, mapped.axes, mapped.numbers)),
        measured=measured(equations, (*mapped.axes, mapped.output)),
    )


def _mapped(store: Store, output: str) -> tuple[Found, System, bool]:
    """A map without thresholds, the system, and whether it was simulated in one mode only."""
    origin = store.origin
    names = list(origin["axes"])
    if len(names) != 2 or any(axis["axis"] == SAMPLE for axis in origin["axes"].values()):
        raise DeclarationError(
            f"{store.path} has the axes {', '.join(names)}",
            expected="a sweep over two quantities, for a map",
        )
    outputs = {name: store.group[name] for name in origin["outputs"]}
    codes = [name for name, array in outputs.items() if "labels" in array.attrs]
    chosen = output or next(iter([*codes, *outputs]))
    array = look_up(chosen, outputs, "output of this sweep")
    if array.ndim != 2:
        raise DeclarationError(f"{chosen} is a series", expected="an output that is one number")
    axes = {name: _si(store.group[origin["axes"][name]["coordinate"]]) for name in names}
    labels = tuple(map(str, array.attrs.get("labels", ())))
    found = Found(
        system=str(origin["system"]),
        output=chosen,
        labels=labels,
        axes=axes,
        values=_values(array, labels, tuple(len(values) for values in axes.values())),
        thresholds=(),
        numbers=plain_numbers({**origin["parameters"], **origin["start"]}),
        origin=json.dumps(origin, sort_keys=True),
        failed=_all_of(store.group[REASON]) > Reason.DONE,
    )
    system = read_declaration(json.dumps(origin["declaration"]))
    return found, system, bool(origin["kept_to_one_mode"])


def _values(array: Any, labels: tuple[str, ...], shape: tuple[int, ...]) -> Array:
    if array.shape != shape:
        raise ValueError(f"an output of shape {array.shape} over axes of {shape}")
    values = _all_of(array)
    if not labels:
        return values
    if np.any(values >= len(labels)):
        raise ValueError("codes that stand for nothing")
    return np.where(values < 0, np.nan, values)


def _all_of(array: Any) -> Array:
    if array.size > _MOST:
        raise ValueError(f"{array.size} values, more than a map can show")
    return np.asarray(array[...], dtype=float)


def measured(equations: Equations, names: Iterable[str]) -> dict[str, Measured]:
    """The quantities of a system among some names."""
    rates = (q.derivative() for q in equations.coordinates)
    own = (*equations.coordinates, *equations.speeds, *rates, *equations.parameters)
    known = {symbol.published: symbol for symbol in own}
    return {
        name: Measured(
            symbol,
            dimension_of(Expr.generator(symbol), equations.dimensions) or PURE,
            is_angle(equations, symbol),
        )
        for name in names
        if (symbol := known.get(name)) is not None
    }


def _si(array: Any) -> Array:
    values = _all_of(array)
    unit = array.attrs.get("units", "")
    return values * read_quantity(f"1 {unit}").value if unit else values


def plain_numbers(given: Mapping[str, object]) -> dict[str, float]:
    """SI values of numbers and texts with a unit; others are left out."""
    found = {}
    for name, value in given.items():
        if isinstance(value, str):
            found[name] = read_quantity(value).value
        elif isinstance(value, int | float):
            found[name] = float(value)
    return found
