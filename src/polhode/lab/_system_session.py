"""A worker's session with one system: its variants by contact, and compiled experiments."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

import polhode as ph
from polhode.algebra import FLOATS, Expr, compile_program
from polhode.analyse import Ansatz, invariants
from polhode.base import PURE, DeclarationError, NumericError, Progress, to_si
from polhode.catalogue import CatalogueEntry, Parameter, RunNumbers, numbers_of
from polhode.derive import Automaton, Equations, automaton, derive
from polhode.lab._requests import Row, RunRequest
from polhode.model import Coulomb, Rolling, Smooth, System, with_elements, with_friction
from polhode.simulate import Experiment, Pieces, Trajectory, sampled, spline_through
from polhode.view import state_unit

_KEPT = 4  # experiments that stay compiled
_LONGEST = 1000.0  # s of motion

# The path of a drag comes with the jitter of the pointer, whose second differences would be
# accelerations of many g: it is thinned and smoothed.
_STEP = 0.12  # s between the samples kept of a drag; hands do not change direction faster
_TREMOR = 0.02  # noise of a hand, as a fraction of the width of its path
_REST = 3  # samples added at the end, during which the sheet comes to rest

MU = Parameter("mu", "", "0.3", "coefficient of friction")


@dataclass(frozen=True)
class Variant:
    """A system with its contacts rolling, without friction, with friction, or as declared.

    Attributes:
        entry: with mu among its parameters where there is friction.
        system: the declaration.
    """

    entry: CatalogueEntry
    system: System

    @property
    def has_friction(self) -> bool:
        """Whether a contact can slide against friction."""
        return any(isinstance(element, Coulomb) for element in self.system.elements)

    @cached_property
    def modes(self) -> Automaton:
        """Contact modes."""
        return automaton(self.system)

    @property
    def equations(self) -> Equations:
        """Of motion with every contact touching, and sticking where it can."""
        return self.modes.together.equations

    @cached_property
    def at_start(self) -> Equations:
        """The equations with the quantities of the usual start: in contact, or apart."""
        names = self.entry.start.keys()
        if _free(self.equations) >= names:
            return self.equations
        declared = derive(self.system)
        return declared if _free(declared) >= names else self.modes.separated.equations

    @cached_property
    def constant_quantities(self) -> dict[str, ph.Expr]:
        """Energy, momenta and speeds that are conserved, if there is no friction."""
        if self.has_friction:
            return {}
        try:
            found = invariants(self.equations, Ansatz(0, 0, 0))
        except NumericError:  # a system too large to be solved for its accelerations
            return {}
        return {invariant.name: invariant.expression for invariant in found}


def _free(equations: Equations) -> set[str]:
    """Names of the coordinates and independent speeds."""
    return {s.published for s in (*equations.coordinates, *equations.speeds)}


def variant(entry: CatalogueEntry, contact: str) -> Variant:
    """A system with all its contacts of a kind; as declared if no kind is named.

    Raises:
        DeclarationError: for a kind of contact, where the system has no contacts.
    """
    system = entry.build()
    if contact in ("", declared_contact(system)):
        return Variant(entry, system)
    if not declared_contact(system):
        raise DeclarationError(
            f"{contact} contacts of {entry.name!r}", expected="a system with a contact"
        )
    if contact == "friction":
        rough = with_friction(system, ph.symbol(MU.name))
        return Variant(replace(entry, parameters=(*entry.parameters, MU)), rough)
    kind = {"rolling": Rolling, "smooth": Smooth}[contact]
    changed = {
        c.name: kind(
            c.body, on=c.on, name=c.name, force=c.force, restitution=c.restitution, at=c.at
        )
        for c in system.contacts
    }
    return Variant(entry, with_elements(system, dict(changed)))


def declared_contact(system: System) -> str:
    """The kind of the first contact: rolling, smooth or friction; empty if there is none."""
    for contact in system.contacts:
        if isinstance(contact, Coulomb):
            return "friction"
        return "rolling" if isinstance(contact, Rolling) else "smooth"
    return ""


# -- a session -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class VariantRun:
    """A simulated motion, and the variant of the system that moves."""

    variant: Variant
    run: Trajectory


class SystemSession:
    """One system, ready to be simulated again and again.

    Args:
        entry: the system with its usual numbers.
    """

    def __init__(self, entry: CatalogueEntry) -> None:
        self.entry = entry
        self._variants: dict[str, Variant] = {}
        self._experiments: OrderedDict[object, Experiment] = OrderedDict()
        self._last: tuple[RunRequest, VariantRun] | None = None

    def variant(self, contact: str) -> Variant:
        """The system with its contacts of a kind, derived once."""
        if contact not in self._variants:
            made = variant(self.entry, contact)
            if contact == "smooth" != declared_contact(self.variant("").system):
                # Start as the rolling body does, so that friction is the only difference.
                rolling, sliding = self.variant("").equations, made.equations
                usual = numbers_of(self.entry, rolling)
                rates = {
                    f"{name}_dot": _value(value.dt(), {}) for name, value in usual.forcing.items()
                }
                known = {**usual.parameters, **usual.start, **rates}
                values = {
                    s: _value(rolling.dependent[s], known)
                    for s in sliding.speeds
                    if s in rolling.dependent
                }
                implied = {
                    s.published: f"{value:.9g} {state_unit(s, sliding)}"
                    for s, value in values.items()
                }
                made = replace(
                    made, entry=replace(made.entry, start={**implied, **made.entry.start})
                )
            self._variants[contact] = made
        return self._variants[contact]

    def numbers(self, request: RunRequest) -> RunNumbers:
        """The numbers requested, in SI units, with mu among the parameters.

        Raises:
            PolhodeError: for an invalid value.
        """
        chosen = self.variant(request.contact)
        settings = dict(request.settings)
        friction = settings.pop(MU.name, MU.default) if chosen.has_friction else ""
        found = numbers_of(
            chosen.entry,
            chosen.equations,
            settings,
            request.start,
            request.duration,
            chosen.at_start,
        )
        if found.duration > _LONGEST:
            raise NumericError(
                f"a duration of {found.duration:g} s",
                expected=f"at most {_LONGEST:g} s in the lab",
                advice="simulate longer motions with ph.simulate or polhode run",
            )
        parameters = dict(found.parameters)
        if friction:
            parameters[MU.name] = to_si(friction, PURE, MU.name)
        return replace(found, parameters=parameters)

    def simulate(self, request: RunRequest, progress: Progress | None = None) -> VariantRun:
        """The motion requested; the last one is kept, since the page asks twice for it: first
        for the picture, then for numbers and plots.

        Raises:
            PolhodeError: for invalid values, and motions that cannot be simulated.
        """
        if self._last is None or self._last[0] != request:
            chosen, numbers = self.variant(request.contact), self.numbers(request)
            experiment = self._experiment(request, chosen, numbers)
            run = experiment.run(numbers.parameters, numbers.start, progress)
            self._last = (request, VariantRun(chosen, run))
        return self._last[1]

    def _experiment(self, request: RunRequest, chosen: Variant, numbers: RunNumbers) -> Experiment:
        forcing: Mapping[Any, Any] = numbers.forcing
        if request.sheet:
            names = [symbol.published for symbol in chosen.equations.functions]
            if not {"X", "Y"} <= set(names):
                raise DeclarationError(
                    f"a dragged sheet for {chosen.entry.name!r}",
                    expected="a system whose sheet is moved by X and Y, such as ball-on-paper",
                )
            x, y = sheet_path(request.sheet)
            still = {name: Expr.of(0) for name in names if name not in ("X", "Y")}
            forcing = {**forcing, "X": x, "Y": y, **still}
            return Experiment(chosen.modes, numbers.duration, forcing=forcing)  # never the same
        sorted_forcing = tuple(sorted((str(name), value) for name, value in forcing.items()))
        key = (request.contact, numbers.duration, sorted_forcing)
        if key not in self._experiments:
            self._experiments[key] = Experiment(
                chosen.modes,
                numbers.duration,
                forcing=forcing,
                invariants=chosen.constant_quantities,
            )
        self._experiments.move_to_end(key)
        if len(self._experiments) > _KEPT:
            self._experiments.popitem(last=False)
        return self._experiments[key]


def _value(expression: Expr, known: Mapping[str, float]) -> float:
    """An expression at the start, where time and all that is not known are zero."""
    symbols = tuple(expression.symbols())
    known = {"pi": np.pi, **known}
    function = compile_program([expression], symbols).function(FLOATS)
    return float(function(*(known.get(symbol.published, 0.0) for symbol in symbols))[0])


# -- a sheet that is dragged by hand ---------------------------------------------------------------


def sheet_path(rows: Sequence[Row]) -> tuple[Pieces, Pieces]:
    """Smooth place of a sheet along x and y, m, at rest at the start and at the end.

    Args:
        rows: times (s) and places (m) of the hand.
    """
    t, x, y = np.array(rows).T
    times = np.linspace(0.0, t[-1] - t[0], max(2, round((t[-1] - t[0]) / _STEP)) + 1)
    step = times[1]
    later = times[-1] + step * np.arange(1, _REST + 1)
    knots = np.concatenate([times, later])
    width = float(np.hypot(np.ptp(x), np.ptp(y)))
    curves = []
    for places in (x, y):
        moved = np.interp(times, t - t[0], places - places[0])
        held = np.concatenate([moved, np.full(_REST, moved[-1])])
        path = sampled(knots, held, noise=_TREMOR * width)
        # Smoothing leaves a speed at the ends: a clamped spline through the same knots has none.
        through = path.value(path.knots)
        curves.append(Pieces(path.knots, spline_through(path.knots, through, (True, True))))
    return curves[0], curves[1]
