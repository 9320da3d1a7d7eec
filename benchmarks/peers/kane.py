"""What the SymPy peers share: Kane's equations solved for accelerations and reactions.

A reaction is brought into evidence as SymPy's tutorial on the rolling disc does it: the point where
it acts is given fictitious "auxiliary" speeds, and each reaction then has one equation of its own.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add

import sympy as sm
import sympy.physics.mechanics as me


@dataclass(frozen=True)
class Kane:
    """Kane's equations of one system, with the reactions in its auxiliary equations."""

    method: me.KanesMethod
    reactions: Sequence[sm.Expr]


@dataclass(frozen=True)
class Motion:
    """Accelerations and reactions as functions of coordinates and speeds alone."""

    accelerations: sm.Matrix
    reactions: sm.Matrix

    def simplified(self) -> Motion:
        """Of the simplifiers tried (see the README), the fastest that gives a compact form."""
        return Motion(
            *(
                part.applyfunc(lambda e: sm.trigsimp(sm.expand(e)))
                for part in (self.accelerations, self.reactions)
            )
        )


def resultant(components: Sequence[sm.Expr], axes: Sequence[me.Vector]) -> me.Vector:
    return reduce(add, (component * axis for component, axis in zip(components, axes, strict=True)))


def solved(kane: Kane) -> Motion:
    """Solve for the accelerations, and put them into the auxiliary equations for the reactions."""
    rates = kane.method.kindiffdict()
    accelerations = kane.method.mass_matrix.LUsolve(kane.method.forcing).subs(rates)
    known = dict(zip((u.diff() for u in kane.method.u), accelerations, strict=True))
    without = kane.method.auxiliary_eqs.subs(dict.fromkeys(kane.reactions, 0))
    return Motion(accelerations, -without.subs(known).subs(rates))


def operations(expressions: Sequence[sm.Expr]) -> int:
    """Operations left after common subexpressions are shared."""
    shared, rest = sm.cse(list(expressions))
    return int(sum(e.count_ops() for e in [*(value for _, value in shared), *rest]))


def report(declare: Callable[[], Kane], names: Sequence[str], state: Mapping[str, float]) -> None:
    """Derive once, timed, and print what it took and gave; `state` is where it is evaluated."""
    started = time.perf_counter()
    raw = solved(declare())
    derived = time.perf_counter()
    motion = raw.simplified()
    finished = time.perf_counter()
    expressions = [*motion.accelerations, *motion.reactions]
    values = [float(at(e, state)) for e in expressions]
    document = {
        "seconds": finished - started,
        "seconds_raw": derived - started,
        "operations": operations(motion.accelerations),
        "operations_raw": operations(raw.accelerations),
        "answer": dict(zip(names, values, strict=True)),
        "expressions": dict(zip(names, map(str, expressions), strict=True)),
        "versions": {"sympy": sm.__version__},
    }
    print(json.dumps(document))


def at(expression: sm.Expr, state: Mapping[str, float]) -> sm.Expr:
    atoms = expression.atoms(sm.Symbol) | expression.atoms(sm.core.function.AppliedUndef)
    return expression.subs({a: state[a.name] for a in atoms if a != me.dynamicsymbols._t})
