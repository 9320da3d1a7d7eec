"""What a store of a sweep holds, as a map over two of its axes."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, dimension_of
from polhode.base import PURE, DeclarationError, Dimension, look_up, read_quantity
from polhode.derive import Equations, automaton, derive, is_angle
from polhode.model import System, read_declaration
from polhode.study._columns import Array
from polhode.study._grid import SAMPLE
from polhode.study._reasons import Reason
from polhode.study._store import REASON, Store, intact, open_store
from polhode.study._thresholds import Threshold, thresholds

_MOST = 100_000_000


@dataclass(frozen=True)
class Measured:
    """A quantity of a system, as people read it.

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
    """One output over two axes.

    Attributes:
        system: its name.
        output: name of the output.
        labels: what its codes stand for; empty for a quantity.
        axes: values along the two axes by name, SI.
        values: of the output, shape of the axes; not-a-number where there is none.
        thresholds: exact curves over the axes.
        numbers: everything else that was given.
        origin: what the store was made with, as JSON.
        measured: which of the axes, and of the output, are quantities of the system, by name.
        failed: where a motion could not be followed, shape of the axes; None where not known.
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
        output: name of what to map; by default the first that is a code.

    Raises:
        DeclarationError: for a store that does not have two axes, or an output it has not.
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
    """A map still without thresholds, the system, and whether it was kept to one mode."""
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
    """Those of some names that are quantities of a system."""
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
