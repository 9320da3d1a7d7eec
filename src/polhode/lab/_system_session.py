"""What a worker keeps of one system: its variants, and what was compiled for them."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import FLOATS, Expr, compile_program
from polhode.base import PURE, DeclarationError, NumericError, Progress, to_si
from polhode.catalogue import CatalogueEntry, RunNumbers, numbers_of
from polhode.lab._controls import unit_of
from polhode.lab._requests import RunRequest
from polhode.lab._sheet import sheet_path
from polhode.lab._variants import MU, Variant, declared_contact, variant
from polhode.simulate import Experiment, Trajectory

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
