"""Formulas and numbers of the scene: equations, parameters, evidence, plots."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from polhode.algebra import (
    ZERO,
    Expr,
    Generator,
    Symbol,
    SymbolKind,
    kept_length,
    kept_sum,
    lengths_in,
    under_defined_letters,
)
from polhode.base import PURE
from polhode.derive import Equations, is_angle, slips_along, symbols_of
from polhode.model import Slipping
from polhode.simulate import Trajectory
from polhode.view._magnitudes import Magnitudes, panels
from polhode.view._mathml import Formula, equation, inline, listed, typeset
from polhode.view._quantities import Array, equations_of, largest, quantity, scale_for
from polhode.view._scene import ModeSpan, Panel, PlotSeries, SceneEvent, SceneNumber
from polhode.view._scene_along import along

_EVENTS = 40  # listed at most
_DEFINED = 80  # letters for long parts whose meanings are shown
POINTS = 1501  # of a plotted curve
_ENERGY = "energy"
_VARIES = 1e-9  # of the largest energy: a potential energy that varies by less is not shown
#: Letters of the energies that are shown, by the names under which they are plotted.
ENERGIES = {_ENERGY: "E", "kinetic energy": "T", "potential energy": "V"}


def panels_of(
    run: Trajectory, groups: Sequence[Sequence[str]], sizes: Magnitudes, points: int
) -> tuple[Panel, ...]:
    """Plots of named quantities, a panel for each group; energy in a separate, last one.

    Values that only rounding has left are drawn as zero.
    """
    chosen = [*groups, *([] if any(_ENERGY in group for group in groups) else [[_ENERGY]])]
    t = np.linspace(0.0, run.duration, points)
    found = []
    for names in (names for group in chosen for names in panels(run, group, sizes)):
        if names == [_ENERGY] and (energies := _energies(run, t, sizes)):
            found.append(energies)
            continue
        unit = quantity(run, names[0]).unit
        values = [sizes.without_rounding(run.evaluate(name, t), unit) for name in names]
        scale = scale_for(unit, largest(*values))
        series = (
            PlotSeries(name, _letter(run, name), value * scale.factor)
            for name, value in zip(names, values, strict=True)
        )
        found.append(Panel(scale.unit, tuple(series)))
    return tuple(found)


def _energies(run: Trajectory, t: Array, sizes: Magnitudes) -> Panel | None:
    """Total, kinetic and potential energy; None where the potential one does not vary."""
    kinetic, potential = along(run, energies_of, 2, t).T
    rows = [sizes.without_rounding(row, "J") for row in (kinetic + potential, kinetic, potential)]
    size = largest(*rows)
    if not np.all(np.isfinite(rows)) or np.ptp(rows[2]) <= _VARIES * size:
        return None
    scale = scale_for("J", size)
    series = (
        PlotSeries(name, _letter(run, name), row * scale.factor)
        for name, row in zip(ENERGIES, rows, strict=True)
    )
    return Panel(scale.unit, tuple(series), "energies")


def energies_of(equations: Equations) -> tuple[Expr, Expr]:
    """Kinetic and potential energy in a contact mode."""
    return equations.kinetic_energy, equations.potential_energy


def _letter(run: Trajectory, name: str) -> str:
    if name in ENERGIES:
        return inline(Expr.generator(Symbol(ENERGIES[name])))
    expression = run.quantities[name]
    return inline(Expr.generator(expression.symbol or Symbol(name)))


#: Two sides of an equation.
_Row = tuple[Expr, Expr]


@dataclass(frozen=True)
class ShownEquations:
    """The equations of every contact mode, headed by its name if there are several.

    Attributes:
        motion: of motion, rates that are not speeds, and what letters in them stand for.
        reactions: every component that Newton's laws determine, the letters that they add, and the
            names of components that are left open.
    """

    motion: tuple[Formula, ...]
    reactions: tuple[Formula, ...]


def equations_shown(run: Trajectory) -> ShownEquations:
    """The equations of every contact mode; a letter for a long part has one meaning in all."""
    modes: dict[str, Equations] = {}
    for segment in run.segments:
        modes.setdefault(segment.mode, cast(Equations, segment.dynamics.equations))
    motion = {mode: list(_motion(equations)) for mode, equations in modes.items()}
    reactions = {mode: list(_reactions(equations)) for mode, equations in modes.items()}
    rows = [row for rows in (*motion.values(), *reactions.values()) for row in rows]
    known = [symbol for equations in modes.values() for symbol in symbols_of(equations)]
    sides = [side for row in rows for side in row]
    written, letters = under_defined_letters(sides, known)
    images = iter(zip(written[::2], written[1::2], strict=True))
    left = dict(letters)
    shown = []
    open_ = {mode: equations.undetermined for mode, equations in modes.items()}
    for groups, unsaid in ((motion, {}), (reactions, open_)):
        named = {mode: [next(images) for _ in rows] for mode, rows in groups.items()}
        used = (side for rows in named.values() for row in rows for side in row)
        defined = _defined(used, left)
        shown.append((*_headed(named, unsaid), *meanings_of(defined)))
    return ShownEquations(*shown)


def _motion(equations: Equations) -> Iterator[_Row]:
    yield from ((row, ZERO) for row in equations.motion)
    for rate, value in equations.kinematics.items():
        if value != Expr.generator(rate):
            yield Expr.generator(rate), value
    yield from _slip_symbols(equations)


def _reactions(equations: Equations) -> Iterator[_Row]:
    for name, value in equations.components.items():
        if name not in equations.undetermined:
            yield Expr.generator(Symbol(name)), value


def _headed(
    modes: Mapping[str, Sequence[_Row]], undetermined: Mapping[str, Sequence[str]]
) -> Iterator[Formula]:
    """The formulas of every contact mode, headed by its name if there are several.

    Args:
        modes: both sides of equations.
        undetermined: names of reactions that Newton's laws leave open.
    """
    for mode, rows in modes.items():
        heading = mode if len(modes) > 1 else ""
        for i, (left, right) in enumerate(rows):
            yield equation(heading if i == 0 else "", left, right)
        if names := undetermined.get(mode):
            letters = (Expr.generator(Symbol(name)) for name in names)
            yield listed("" if rows else heading, letters, "left open by Newton’s laws")


def _defined(used: Iterable[Expr], left: dict[Generator, Expr]) -> dict[Generator, Expr]:
    """The letters that occur in expressions, and in the meanings of these; they leave the rest."""
    order = list(left)
    found: dict[Generator, Expr] = {}
    pending = [*used]
    for expression in pending:  # which grows
        for letter in left.keys() & {*expression.generators, *expression.symbols()}:
            found[letter] = left.pop(letter)
            pending.append(found[letter])
    return {letter: found[letter] for letter in order if letter in found}


def meanings_of(letters: Mapping[Generator, Expr]) -> Iterator[Formula]:
    """What letters stand for; of very many, how many there are."""
    names = [Expr.generator(letter) for letter in letters]
    if len(names) > _DEFINED:
        many = f"{names[0].pretty()}, …, {names[-1].pretty()}"
        words = f"{len(names)} long expressions of coordinates and speeds, kept under names"
        yield Formula("where", (), f"{many}: {words}")
        return
    for i, (name, meaning) in enumerate(zip(names, letters.values(), strict=True)):
        yield equation("where" if i == 0 else "", name, meaning)


def _slip_symbols(equations: Equations) -> Iterator[_Row]:
    """Definitions of the symbols for slip at sliding contacts."""
    for element in equations.kinetics.elements:
        if not isinstance(element, Slipping):
            continue
        motion = equations.kinetics
        slips = slips_along(motion, element.law.sliding(motion.places))
        speed = Expr.generator(element.slip_speed)
        kept = (kept_sum(slip) / speed for slip in slips)
        meanings = list(zip(element.direction, kept, strict=False))
        size = kept_length(slips)
        root = size.recast({part: part.meaning for part in lengths_in([size])})
        meanings.append((element.slip_speed, root))
        if element.law.stribeck is not None:
            meanings.append((element.slowness, element.law.slowness(speed)))
        yield from ((Expr.generator(s), meaning) for s, meaning in meanings)


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


def modes_of(run: Trajectory) -> tuple[ModeSpan, ...]:
    """The contact modes along a motion; stays in the same one are joined."""
    spans: list[ModeSpan] = []
    for segment in run.segments:
        if spans and spans[-1].name == segment.mode:
            spans[-1] = replace(spans[-1], end=float(segment.end))
        else:
            spans.append(ModeSpan(segment.mode, float(segment.begin), float(segment.end)))
    return tuple(spans)
