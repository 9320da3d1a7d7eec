"""The motion that the options of `run` and `page` ask for."""

from __future__ import annotations

import time
from argparse import Namespace
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr
from polhode.base import terminal_progress
from polhode.catalogue import CatalogueEntry, RunCase, RunNumbers, case_of, numbers_of
from polhode.cli._case_options import with_case
from polhode.cli._contact_options import (
    add_friction_options,
    declared,
    declared_with_letters,
    sheet_of,
)
from polhode.cli._exit import Interruptible
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import warn_of_radians
from polhode.cli._systems import entry_of
from polhode.derive import Automaton, Equations, automaton
from polhode.model import System
from polhode.simulate import Trajectory, simulate


def add_motion_options(parser: Parser) -> None:
    """Add the system, and what determines one of its motions."""
    parser.add_system()
    parser.add_option(
        "--case CASE",
        "a motion that answers a question of the problem set; 'polhode list NAME' names them. "
        "Other options override its values",
    )
    parser.add_motion(
        "set a parameter, such as M=0.4kg, or a prescribed function as a formula in t"
    )
    add_friction_options(parser)
    parser.add_file(
        "--sheet FILE.csv",
        "move the sheet along the path in this table, with columns t,x,y in SI units",
    )
    parser.set_defaults(path=None)


@dataclass(frozen=True)
class MotionWanted:
    """A system with its numbers.

    Attributes:
        entry: of the catalogue, or of a file.
        case: whose motion it is, if one was named.
        options: with the values of the case for everything not given.
        system: the declaration, with the friction and the edge of the options.
        modes: its contact modes.
        numbers: of the motion.
        sheet: its motion, if it is read from a file or that of a case.
        letters: values of letters for the friction and the edge, where the declaration has them.
        written: the texts that parameters and start values were given as, by name.
        seconds: that the derivation took.
    """

    entry: CatalogueEntry
    case: RunCase | None
    options: Namespace
    system: System
    modes: Automaton
    numbers: RunNumbers
    sheet: Mapping[str, Any]
    letters: Mapping[str, float]
    written: Mapping[str, str]
    seconds: float

    @property
    def equations(self) -> Equations:
        """Of the mode in which every contact touches."""
        return self.modes.together.equations

    def followed(
        self,
        *,
        invariants: Mapping[str, Expr] | None = None,
        events: Mapping[str, Expr] | None = None,
        precision: str = "double",
    ) -> Trajectory:
        """The motion; arguments and errors as for `simulate`."""
        given = self.numbers.exact if precision != "double" else self.numbers
        return simulate(
            self.modes,
            dict[Any, Any](given.parameters) | dict(self.letters),
            given.start,
            given.duration,
            forcing=dict[Any, Any](self.numbers.forcing) | dict(self.sheet),
            invariants=invariants,
            events=events,
            progress=Interruptible(terminal_progress()),
            precision=precision,
        )


def motion_wanted(options: Namespace, *, lettered: bool = False) -> MotionWanted:
    """The motion that the options ask for.

    Args:
        options: of the command.
        lettered: whether the declaration has letters for the friction and the edge.

    Raises:
        PolhodeError: for a system, a case, a name or a value that is wrong.
    """
    entry = entry_of(options.name)
    case = case_of(entry, options.case) if options.case else None
    options = with_case(options, case) if case else options
    settings, start = assignments(options.settings), assignments(options.start)
    began = time.perf_counter()
    letters = dict[str, float]()
    if lettered:
        system, letters = declared_with_letters(entry, options, settings)
    else:
        system = declared(entry, options, settings)
    modes = automaton(system)
    equations = modes.together.equations
    seconds = time.perf_counter() - began
    sheet = sheet_of(options, equations)
    flight = modes.separated.equations
    numbers = numbers_of(entry, equations, settings, start, options.duration, flight=flight)
    warn_of_radians(start, equations)
    chosen = assignments(options.settings) | {"mu": options.mu, "mu_static": options.mu_static}
    given = {name: chosen[name] for name in letters}
    written = {**entry.defaults, **settings, **given, **(start or entry.start)}
    return MotionWanted(
        entry, case, options, system, modes, numbers, sheet, letters, written, seconds
    )
