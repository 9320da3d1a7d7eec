"""Formulas and numbers of the scene: equations, parameters, evidence, plots."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, sqrt
from polhode.base import PURE
from polhode.derive import Equations, is_angle, slips_along
from polhode.model import Sliding
from polhode.simulate import Trajectory
from polhode.view._magnitudes import Magnitudes, panels
from polhode.view._mathml import Formula, equation, inline, typeset
from polhode.view._quantities import equations_of, largest, quantity, scale_for
from polhode.view._scene import Panel, PlotSeries, SceneEvent, SceneNumber

_EVENTS = 40  # listed at most
_POINTS = 1501  # of a plotted curve
_ENERGY = "energy"


def panels_of(
    run: Trajectory, groups: Sequence[Sequence[str]], sizes: Magnitudes
) -> tuple[Panel, ...]:
    """Plots of named quantities, a panel for each group; energy in a separate, last one.

    Values that only rounding has left are drawn as zero.
    """
    chosen = [*groups, *([] if any(_ENERGY in group for group in groups) else [[_ENERGY]])]
    t = np.linspace(0.0, run.duration, _POINTS)
    found = []
    for names in (names for group in chosen for names in panels(run, group, sizes)):
        unit = quantity(run, names[0]).unit
        values = [sizes.without_rounding(run.evaluate(name, t), unit) for name in names]
        scale = scale_for(unit, largest(*values))
        series = (
            PlotSeries(name, _letter(run, name), value * scale.factor)
            for name, value in zip(names, values, strict=True)
        )
        found.append(Panel(scale.unit, tuple(series)))
    return tuple(found)


def _letter(run: Trajectory, name: str) -> str:
    if name == _ENERGY:
        return inline(Expr.generator(Symbol("E")))
    expression = run.quantities[name]
    return inline(Expr.generator(expression.symbol or Symbol(name)))


def motion_of(run: Trajectory) -> tuple[Formula, ...]:
    """The equations of motion of every contact mode, and rates that are not speeds."""

    def motion(equations: Equations) -> list[Formula]:
        rows = [equation("", row, ZERO) for row in equations.motion]
        rates = [
            equation("", Expr.generator(rate), value)
            for rate, value in equations.kinematics.items()
            if value != Expr.generator(rate)
        ]
        return [*rows, *rates, *_slip_symbols(equations)]

    return _by_mode(run, motion)


def reactions_of(run: Trajectory) -> tuple[Formula, ...]:
    """Every component that Newton's laws determine, in every contact mode."""

    def reactions(equations: Equations) -> list[Formula]:
        return [
            equation("", Expr.generator(Symbol(name)), value)
            for name, value in equations.components.items()
            if name not in equations.undetermined
        ]

    return _by_mode(run, reactions)


def _by_mode(
    run: Trajectory, formulas: Callable[[Equations], list[Formula]]
) -> tuple[Formula, ...]:
    """The formulas of every contact mode, headed by its name if there are several."""
    modes: dict[str, list[Formula]] = {}
    for segment in run.segments:
        if segment.mode not in modes:
            modes[segment.mode] = formulas(cast(Equations, segment.dynamics.equations))
    if len(modes) == 1:
        return tuple(next(iter(modes.values())))
    filled = ((mode, group) for mode, group in modes.items() if group)
    named = [[replace(first, name=mode), *rest] for mode, (first, *rest) in filled]
    return tuple(formula for group in named for formula in group)


def _slip_symbols(equations: Equations) -> Iterator[Formula]:
    """Definitions of the symbols for slip at sliding contacts."""
    for element in equations.kinetics.elements:
        if not isinstance(element, Sliding):
            continue
        slips = slips_along(equations.kinetics, element, element.on.tangents)
        speed = Expr.generator(element.slip_speed)
        meanings = list(zip(element.direction, (slip / speed for slip in slips), strict=True))
        meanings.append((element.slip_speed, sqrt(slips[0] ** 2 + slips[1] ** 2)))
        if element.law.stribeck is not None:
            meanings.append((element.slowness, element.law.slowness(speed)))
        yield from (equation("", Expr.generator(s), meaning) for s, meaning in meanings)


def parameters_of(run: Trajectory, meanings: Mapping[str, str]) -> tuple[SceneNumber, ...]:
    """Parameters with the units inferred from their uses."""
    equations = equations_of(run)
    dimensions = {s.published: d for s, d in equations.dimensions.items()}
    angles = {s.published for s in equations.parameters if is_angle(equations, s)}
    return tuple(
        _in_degrees(
            SceneNumber(
                name,
                inline(Expr.generator(Symbol(name.rstrip("_"), SymbolKind.PARAMETER))),
                float(value),
                "rad" if name in angles else str(dimensions.get(name, PURE)),
                meanings.get(name, ""),
            )
        )
        for name, value in run.parameters.items()
    )


def _in_degrees(number: SceneNumber) -> SceneNumber:
    """An angle in degrees; any other number unchanged."""
    if number.unit != "rad":
        return number
    return replace(number, value=math.degrees(number.value), unit="deg")


def start_of(run: Trajectory, sizes: Magnitudes) -> tuple[SceneNumber, ...]:
    """Coordinates and speeds at the start."""
    names = [s.published for s in (*run.equations.coordinates, *run.equations.speeds)]
    found = []
    for name, values in run.table(names).items():
        unit = quantity(run, name).unit
        # Dense output is a series, whose rounding leaves about 1e-16 where a start is zero.
        value = float(sizes.without_rounding(values, unit)[0])
        found.append(_in_degrees(SceneNumber(name, _letter(run, name), value, unit)))
    return tuple(found)


def evidence_of(run: Trajectory) -> tuple[SceneNumber, ...]:
    """Largest drift of every conserved quantity."""
    drift = run.drift
    found = [SceneNumber("energy − work done", "", drift.energy, "", "against the energy scale")]
    if any(segment.dynamics.equations.closures for segment in run.segments):
        found.append(SceneNumber("closed loops", "", drift.constraint, "m", "largest gap"))
    found += [
        SceneNumber(name, _invariant(name), value, "", "against its largest term")
        for name, value in drift.invariants.items()
    ]
    return tuple(found)


def _invariant(name: str) -> str:
    """The letter of a conserved quantity, as L with the subscripts pivot and z for L_pivot_z."""
    plain = name.removesuffix("_dot")
    letter = Expr.generator(Symbol(plain)).latex()
    return typeset(letter if plain == name else rf"\dot{{{letter}}}")


def happenings_of(run: Trajectory) -> tuple[SceneEvent, ...]:
    """Events between start and end; of very many, the first ones and how many more."""
    found = [
        SceneEvent(event.time, f"{event.kind}: {event.after}")
        for event in run.events
        if event.before is not None and event.after is not None
    ]
    shown, more = found[:_EVENTS], len(found) - _EVENTS
    if more > 0:
        shown.append(SceneEvent(found[-1].time, f"the last of {more} more"))
    return tuple(shown)
