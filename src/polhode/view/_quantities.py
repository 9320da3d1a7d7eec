"""Quantities of a motion: their names in print, and the units they are shown in."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, dimension_of
from polhode.base import (
    LENGTH,
    MASS,
    PURE,
    TIME,
    DeclarationError,
    Dimension,
    NumericError,
    UnitError,
    look_up,
    provenance,
)
from polhode.derive import Equations, is_angle
from polhode.simulate import Trajectory, spline_through

Array = NDArray[np.float64]

#: A quantity by its published name, or as a symbol of the system.
Named = str | Symbol | Expr

#: Quantities to plot, a panel for each and for each group of them.
Groups = Iterable[Named | Sequence[Named]]

FORCE = MASS * LENGTH / TIME**2
ENERGY = FORCE * LENGTH

_WORDS = {"energy": ("E", "J"), "power": ("P", "W"), "work": ("W", "J")}
UNITS = {
    PURE: "",
    LENGTH: "m",
    TIME: "s",
    PURE / TIME: "rad/s",
    PURE / TIME**2: "rad/s²",
    LENGTH / TIME: "m/s",
    LENGTH / TIME**2: "m/s²",
    FORCE: "N",
    ENERGY: "N m",
    ENERGY / TIME: "W",
}
# Largest first: least value for which a prefix is used, size of that unit, and the prefix. From
# 0.1 to 10⁴ values are shown without a prefix.
_PREFIXES = (
    (1e12, 1e12, "T"),
    (1e9, 1e9, "G"),
    (1e6, 1e6, "M"),
    (1e4, 1e3, "k"),
    (1e-1, 1.0, ""),
    (1e-3, 1e-3, "m"),
    (1e-6, 1e-6, "µ"),
    (1e-9, 1e-9, "n"),
    (1e-12, 1e-12, "p"),
)
_TURN = 2 * np.pi
_FINE = 4001  # least number of instants through which a smooth curve is drawn


@dataclass(frozen=True)
class Scale:
    """A unit to show values in: shown = value in SI units times `factor`."""

    unit: str
    factor: float


@dataclass(frozen=True)
class PlottedQuantity:
    """A quantity of a motion.

    Attributes:
        name: published name.
        symbol: as mathematical text between dollar signs.
        unit: SI unit, empty for a pure number and "rad" for an angle.
    """

    name: str
    symbol: str
    unit: str

    def label(self, scale: Scale) -> str:
        """Symbol and unit, as the label of an axis."""
        return label(self.symbol, scale)


def label(symbol: str, scale: Scale) -> str:
    """A symbol with its unit in brackets, if it has one."""
    return f"{symbol} ({scale.unit})" if scale.unit else symbol


def grouped(wanted: Groups) -> list[list[str]]:
    """The quantities of each panel, by their published names, from groups and single names."""
    several = [wanted] if isinstance(wanted, str) else wanted
    groups = [
        [one] if isinstance(one, str) or not isinstance(one, Sequence) else list(one)
        for one in several
    ]
    return [[published(name) for name in group] for group in groups if group]


def published(name: Named) -> str:
    """The published name of a quantity, given as a name or as a symbol of the system."""
    symbol = name.symbol if isinstance(name, Expr) else name
    return symbol.published if isinstance(symbol, Symbol) else str(symbol or name)


def quantity(run: Trajectory, named: Named) -> PlottedQuantity:
    """The quantity of that published name, or symbol.

    Raises:
        DeclarationError: for a name the run does not have.
    """
    name = published(named)
    if name in _WORDS:
        letter, unit = _WORDS[name]
        return PlottedQuantity(name, f"${letter}$", unit)
    expression = look_up(name, run.quantities, f"quantity of {run.equations.system.name}")
    symbol = expression.symbol or Symbol(name)
    modes = [equations for equations in modes_of(run) if name in equations.components]
    if modes:  # a reaction
        dimension = ENERGY if name in modes[0].couples else FORCE
    else:
        dimension = dimension_of(expression, equations_of(run).dimensions) or PURE
    angle = dimension == PURE and is_angle(equations_of(run), symbol)
    return PlottedQuantity(name, math(Expr.generator(symbol)), si_unit(dimension, angle=angle))


def si_unit(dimension: Dimension, *, angle: bool) -> str:
    """The SI unit of a quantity; empty for a pure number and "rad" for an angle."""
    return "rad" if angle else UNITS.get(dimension, str(dimension))


def math(expression: Expr) -> str:
    """An expression as mathematical text of a figure."""
    return f"${expression.latex()}$"


def equations_of(run: Trajectory) -> Equations:
    """The equations behind a motion of a declared system."""
    return cast(Equations, run.equations)


def modes_of(run: Trajectory) -> tuple[Equations, ...]:
    """The equations of every contact mode that the motion visits."""
    return tuple(cast(Equations, segment.dynamics.equations) for segment in run.segments)


def common_unit(quantities: Sequence[PlottedQuantity]) -> str:
    """The unit that all of them have.

    Raises:
        DeclarationError: where there are no quantities.
        UnitError: where they have none in common.
    """
    units = dict.fromkeys(q.unit for q in quantities)
    if not units:
        raise DeclarationError("no quantities to plot", expected="names of quantities")
    if len(units) > 1:
        named = ", ".join(f"{q.name} in {q.unit or 'no unit'}" for q in quantities)
        raise UnitError(
            f"{named} cannot share an axis",
            expected="quantities of one unit",
            advice="give each a separate panel",
        )
    return next(iter(units))


def scale_for(unit: str, largest: float) -> Scale:
    """The unit in which the largest value is neither tiny nor huge."""
    if unit == "rad":
        return Scale("turns", 1 / _TURN) if largest > 5 * _TURN else Scale("deg", 360 / _TURN)
    if not unit or unit.startswith("kg"):
        return Scale(unit, 1.0)
    if unit.startswith("rad") and largest >= 1:
        return Scale(unit, 1.0)
    for least, size, prefix in _PREFIXES:
        if largest >= least:
            return Scale(prefix + unit, 1 / size)
    return Scale(unit, 1.0)


def everything(run: Trajectory) -> list[list[str]]:
    """Coordinates, speeds and reactions."""
    equations = run.equations
    groups = [
        [s.published for s in equations.coordinates],
        [s.published for s in equations.speeds],
        list(run.reactions),
    ]
    return [group for group in groups if group]


def accumulated(rates: Array, t: Array) -> Array:
    """The integral of a rate since the first of some times, by a spline through its values."""
    if len(t) < 3:
        return np.append(0.0, np.cumsum(np.diff(t) * (rates[1:] + rates[:-1]) / 2))
    powers = np.arange(1, 5)
    pieces = spline_through(t, rates, (False, False)) * np.diff(t)[:, None] ** powers / powers
    return np.append(0.0, np.cumsum(np.sum(pieces, axis=1)))


def instants(run: Trajectory) -> Array:
    """Times to draw curves through: the samples, or finer ones over the same interval, s.

    Raises:
        NumericError: for a motion that does not last.
    """
    require_duration(run)
    if len(run.t) >= _FINE:
        return run.t
    fine: Array = np.linspace(run.t[0], run.t[-1], _FINE)
    return fine


def made_with(run: Trajectory) -> dict[str, object]:
    """Provenance of a picture of a motion."""
    return {
        **provenance(),
        "system": run.equations.system.name,
        "mode": run.mode,
        "parameters": dict(run.parameters),
        "assumed": dict(run.assumed),
        "integrator": run.integrator,
    }


def require_duration(run: Trajectory) -> None:
    """Refuse a motion of zero duration, such as that of a disk that already lies flat.

    Raises:
        NumericError: for a motion of zero duration.
    """
    if run.duration <= 0:
        kinds = [event.kind for event in run.events[1:-1]]
        raise NumericError(
            f"the motion of {run.equations.system.name} ends at its start"
            f" ({', '.join(kinds) or 'no event'})",
            expected="a motion of non-zero duration",
            advice="start from another state",
        )


def largest(*values: Array) -> float:
    """Largest size among all values."""
    return float(max((np.max(np.abs(v), initial=0.0) for v in values), default=0.0))
