"""What our derivation scripts share: solve for accelerations and reactions, evaluate, report."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping

from polhode.algebra import Expr, Symbol, Vector, compile_program
from polhode.derive import Equations, derive
from polhode.model import System


def report(
    system: System,
    force: Callable[[Equations], dict[str, Expr]],
    state: Mapping[str, float],
) -> None:
    """Derive once, timed, with every acceleration and force component in closed form."""
    started = time.perf_counter()
    equations = derive(system)
    accelerations = equations.accelerations
    forces = {name: equations.on_shell(value) for name, value in force(equations).items()}
    seconds = time.perf_counter() - started
    answer = {s.published: e for s, e in accelerations.items()} | forces
    arguments = sorted(set().union(*(e.symbols() for e in answer.values())), key=_published)
    values = compile_program(list(answer.values()), arguments).function()
    solved = compile_program(list(accelerations.values()), arguments)
    print(
        json.dumps(
            {
                "seconds": seconds,
                "operations": solved.operations,
                "answer": dict(
                    zip(answer, values(*(state[s.published] for s in arguments)), strict=True)
                ),
            }
        )
    )


def _published(symbol: Symbol) -> str:
    return symbol.published


def along(vector: Vector, directions: Mapping[str, Vector]) -> dict[str, Expr]:
    """Components of a vector by name."""
    return {name: vector.dot(direction) for name, direction in directions.items()}
