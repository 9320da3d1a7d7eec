"""What a worker keeps of one system: its variants, and what was compiled for them."""

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
from polhode.derive import Automaton, Equations, automaton
from polhode.lab._controls import unit_of
from polhode.lab._requests import Row, RunRequest
from polhode.model import Contact, Coulomb, Rolling, Smooth, System, with_elements, with_friction
from polhode.simulate import Experiment, Pieces, Trajectory, sampled

# A system as it is declared, and with its contacts rolling, without friction, or with friction.

MU = Parameter("mu", "", "0.3", "coefficient of friction")


@dataclass(frozen=True)
class Variant:
    """A system with its contacts in one way.

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
    def watched(self) -> dict[str, ph.Expr]:
        """Energy, momenta and speeds that stay constant, where no friction changes them."""
        if self.has_friction:
            return {}
        try:
            found = invariants(self.equations, Ansatz(0, 0, 0))
        except NumericError:  # a system too large to be solved for its accelerations
            return {}
        return {invariant.name: invariant.expression for invariant in found}


def variant(entry: CatalogueEntry, contact: str) -> Variant:
    """A system with all its contacts of a kind; as declared where none is named.

    Raises:
        DeclarationError: for a kind of contact that is asked of a system without any.
    """
    system = entry.build()
    if contact in ("", declared_contact(system)):
        return Variant(entry, system)
    if not declared_contact(system):
        raise DeclarationError(
            f"{contact} contacts of {entry.name!r}", expected="a system in which something touches"
        )
    if contact == "friction":
        rough = with_friction(system, ph.symbol(MU.name))
        return Variant(replace(entry, parameters=(*entry.parameters, MU)), rough)
    kind = {"rolling": Rolling, "smooth": Smooth}[contact]
    changed = {
        c.name: kind(c.body, on=c.on, name=c.name, force=c.force, restitution=c.restitution)
        for c in _contacts(system)
    }
    return Variant(entry, with_elements(system, dict(changed)))


def declared_contact(system: System) -> str:
    """What the first contact is: rolling, smooth or friction; empty where nothing touches."""
    for contact in _contacts(system):
        if isinstance(contact, Coulomb):
            return "friction"
        return "rolling" if isinstance(contact, Rolling) else "smooth"
    return ""


def _contacts(system: System) -> list[Contact]:
    return [element for element in system.elements if isinstance(element, Contact)]


_KEPT = 4  # experiments that stay compiled
_LONGEST = 1000.0  # s of motion


@dataclass(frozen=True)
class Played:
    """A motion that was asked for, with the system it is of."""

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
        self._last: tuple[RunRequest, Played] | None = None

    def variant(self, contact: str) -> Variant:
        """The system with its contacts of a kind, derived once."""
        if contact not in self._variants:
            made = variant(self.entry, contact)
            if contact == "smooth" != declared_contact(self.variant("").system):
                made = self._begun_as_if_rolling(made)
            self._variants[contact] = made
        return self._variants[contact]

    def numbers(self, wish: RunRequest) -> RunNumbers:
        """The numbers that were asked for, in SI units, with mu among the parameters.

        Raises:
            PolhodeError: for a value that cannot be.
        """
        chosen = self.variant(wish.contact)
        settings = dict(wish.settings)
        friction = settings.pop(MU.name, MU.default) if chosen.has_friction else ""
        found = numbers_of(chosen.entry, chosen.equations, settings, wish.start, wish.duration)
        if found.duration > _LONGEST:
            raise NumericError(
                f"a duration of {found.duration:g} s",
                expected=f"at most {_LONGEST:g} s in the lab",
                advice="longer ones can be simulated from Python or in a shell",
            )
        parameters = dict(found.parameters)
        if friction:
            parameters[MU.name] = to_si(friction, PURE, MU.name)
        return replace(found, parameters=parameters)

    def play(self, wish: RunRequest, progress: Progress | None = None) -> Played:
        """The motion that is asked for; the last one is kept, as it is asked for again to be read.

        Raises:
            PolhodeError: for values that cannot be, and motions that cannot be followed.
        """
        if self._last is None or self._last[0] != wish:
            self._last = (wish, self._played(wish, progress))
        return self._last[1]

    def _played(self, wish: RunRequest, progress: Progress | None) -> Played:
        chosen, numbers = self.variant(wish.contact), self.numbers(wish)
        experiment = self._experiment(wish, chosen, numbers)
        return Played(chosen, experiment.run(numbers.parameters, numbers.start, progress))

    def _experiment(self, wish: RunRequest, chosen: Variant, numbers: RunNumbers) -> Experiment:
        forcing: Mapping[Any, Any] = numbers.forcing
        if wish.sheet:
            forcing = {**forcing, **_dragged(chosen, wish)}
            return Experiment(chosen.modes, numbers.duration, forcing=forcing)
        named = tuple(sorted((str(name), value) for name, value in forcing.items()))
        key = (wish.contact, numbers.duration, named)
        if key not in self._experiments:
            self._experiments[key] = Experiment(
                chosen.modes, numbers.duration, forcing=forcing, invariants=chosen.watched
            )
        self._experiments.move_to_end(key)
        if len(self._experiments) > _KEPT:
            self._experiments.popitem(last=False)
        return self._experiments[key]

    def _begun_as_if_rolling(self, smooth: Variant) -> Variant:
        """With the usual start as rolling has it, so that only friction's absence is seen."""
        rolling, sliding = self.variant("").equations, smooth.equations
        usual = numbers_of(self.entry, rolling)
        known = {**usual.parameters, **usual.start, **_rates(usual.forcing)}
        implied = {
            s.published: f"{_value(rolling.dependent[s], known):.9g} {unit_of(s, sliding)}"
            for s in sliding.speeds
            if s in rolling.dependent
        }
        return replace(smooth, entry=replace(smooth.entry, start={**implied, **smooth.entry.start}))


def _rates(forcing: Mapping[str, Expr]) -> dict[str, float]:
    """Rates of prescribed functions at the start, by published name."""
    return {f"{name}_dot": _value(value.dt(), {}) for name, value in forcing.items()}


def _value(expression: Expr, known: Mapping[str, float]) -> float:
    """At the start: time and what is not named are zero there."""
    symbols = tuple(expression.symbols())
    known = {"pi": np.pi, **known}
    function = compile_program([expression], symbols).function(FLOATS)
    return float(function(*(known.get(symbol.published, 0.0) for symbol in symbols))[0])


def _dragged(chosen: Variant, wish: RunRequest) -> dict[str, Any]:
    names = [symbol.published for symbol in chosen.equations.functions]
    if not {"X", "Y"} <= set(names):
        raise DeclarationError(
            f"a dragged sheet for {chosen.entry.name!r}",
            expected="a system whose sheet is moved by X and Y, such as ball-on-paper",
        )
    x, y = sheet_path(wish.sheet)
    still = {name: Expr.of(0) for name in names if name not in ("X", "Y")}
    return {"X": x, "Y": y, **still}


# The path of a sheet that was dragged by hand, made smooth.

_STEP = 0.12  # s between the samples that are kept: a hand does not move faster
_TREMOR = 0.02  # of the width of the path: what the hand did not mean
_REST = 3  # samples at the end, for the sheet to come to rest


def sheet_path(rows: Sequence[Row]) -> tuple[Pieces, Pieces]:
    """Place of the sheet along x and y, m: at rest at first and at the end.

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
        through = np.interp(times, t - t[0], places - places[0])
        held = np.concatenate([through, np.full(_REST, through[-1])])
        curves.append(_stopped(sampled(knots, held, noise=_TREMOR * width)))
    return curves[0], curves[1]


def _stopped(path: Pieces) -> Pieces:
    """Through the same places at its knots, and at rest at both ends: smoothing leaves a speed."""
    from scipy.interpolate import CubicSpline

    spline = CubicSpline(path.knots, path.value(path.knots), bc_type="clamped")
    return Pieces(path.knots, np.ascontiguousarray(spline.c[::-1].T))
