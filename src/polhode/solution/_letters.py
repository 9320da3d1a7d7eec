"""Letters that a solution introduces, chosen so that the system does not have them already."""

from __future__ import annotations

from polhode.algebra import Expr, Symbol, variables
from polhode.base import NumericError
from polhode.derive import Equations


def free_letter(equations: Equations, *candidates: str) -> Symbol:
    """The first of some published names that the system does not use.

    Raises `NumericError` where it uses them all.
    """
    known = {s.published for s in (*equations.parameters, *equations.coordinates)}
    known |= {s.published for s in equations.speeds} | set(equations.components)
    # also what the motion does not depend on, such as a moment of inertia that drops out
    bodies = equations.system.bodies
    known |= {
        s.published
        for s in variables([e for b in bodies for e in (b.mass, *sum(b.inertia.rows, ()))])
    }
    for name in candidates:
        if name not in known:
            return Symbol(name)
    raise NumericError(
        f"a system that uses all the letters {', '.join(candidates)}",
        expected=f"one of them free in {equations.system.name}",
        advice="rename a parameter",
    )


def letter_latex(symbol: Symbol) -> str:
    """LaTeX of a letter."""
    return Expr.generator(symbol).latex()


def definition(name: str, value: str) -> str:
    """A definition for a claim; the braces say that it is LaTeX."""
    return f"{{{name}}} = {value}"
