"""Samples of a trajectory with their units, for files and tables."""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

from polhode.algebra import Symbol, SymbolKind, dimension_of
from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, UnitError
from polhode.derive import Equations
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.files._archive import Sampled

_ENERGY = MASS * LENGTH**2 / TIME**2
_NAMED = {PURE: "", _ENERGY: "J", _ENERGY / LENGTH: "N", _ENERGY / TIME: "W"}
_TURNING = {PURE: "rad", PURE / TIME: "rad/s", PURE / TIME**2: "rad/s^2"}
_WORDS = {"energy": "J", "work": "J", "power": "W"}


def samples_of(run: Trajectory, names: Iterable[str] | None = None) -> dict[str, Sampled]:
    """Quantities at the sample times of a motion.

    Args:
        run: the motion.
        names: published names; by default coordinates, speeds, rates, reactions, energy, power,
            work and the invariants watched.
    """
    chosen = list(names) if names is not None else _usual(run)
    table = run.table(chosen)
    return {name: Sampled(unit_of(run, name), values) for name, values in table.items()}


def _usual(run: Trajectory) -> list[str]:
    states = (name for name in run.final if name not in ("energy", "mode"))
    return list(dict.fromkeys((*states, *_WORDS, *run.invariants)))


def unit_of(run: Trajectory, name: str) -> str:
    """SI unit of a quantity of a motion; empty for a pure number, and where it is not known."""
    if name in _WORDS:
        return _WORDS[name]
    if name in run.reactions:
        return "N m" if name in _couples(run) else "N"
    expression = run.quantities[name]
    try:
        known = cast(Equations, run.equations).dimensions
        return _unit(expression.symbol, dimension_of(expression, known) or PURE)
    except UnitError:
        return ""


def _couples(run: Trajectory) -> frozenset[str]:
    modes = (cast(Equations, segment.dynamics.equations) for segment in run.segments)
    return frozenset(n.name for mode in modes for n in mode.lines if n.restraint.is_couple)


def _unit(symbol: Symbol | None, dimension: Dimension) -> str:
    moves = symbol is not None and symbol.kind in (SymbolKind.COORDINATE, SymbolKind.SPEED)
    if moves and dimension in _TURNING:
        return _TURNING[dimension]
    return _NAMED.get(dimension, str(dimension))
