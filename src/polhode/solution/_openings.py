"""Where contacts open in a motion from rest, by the force along a level of the energy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from polhode.algebra import Expr, Symbol
from polhode.analyse import Opening, leaves
from polhode.base import PolhodeError
from polhode.solution._judge import if_true
from polhode.solution._lines import SolutionLine
from polhode.solution._setting import Setting


def openings(setting: Setting) -> Iterator[SolutionLine]:
    """For the first coordinate in which the system can move alone, each contact that opens."""
    equations = setting.equations
    for q in equations.coordinates:
        start = Symbol(f"{q.name}_0")
        with suppress(PolhodeError, ArithmeticError):
            found = leaves(equations, {q: Expr.generator(start)})
            for opening in found:
                yield from if_true(_opens(setting, q, start, opening), equations)
            return


def _opens(setting: Setting, q: Symbol, start: Symbol, opening: Opening) -> list[SolutionLine]:
    """The force of a contact, and where it vanishes; nothing where it does not for this start."""
    places = [(left, value) for left, value in opening.places if start in value.symbols()]
    if not places:
        return []
    contact = next(c for c in setting.equations.system.contacts if c.name == opening.contact)
    force = Expr.generator(Symbol(contact.component(contact.on.normal)))
    letter, rate = Expr.generator(q).latex(), Expr.generator(q.derivative()).latex()
    where = " or ".join(f"${left.latex()} = {value.latex()}$" for left, value in places)
    begun = Expr.generator(start).latex()
    source = setting.source(contact)
    return [
        SolutionLine(
            f"Let it start from rest at ${letter} = {begun}$. By the energy, the force of {source} "
            f"is then a function of ${letter}$ alone:",
            f"{force.latex()} = {opening.normal.latex()}",
            given=(f"{rate}_0 = 0",),
        ),
        SolutionLine(
            f"A contact can only push. Where {where}, its force vanishes, and {source} opens: the "
            "motion does not go on as before."
        ),
    ]
