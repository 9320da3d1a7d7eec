"""Ours: accelerations of an arm of n links, evaluated at many states by compiled code."""

from __future__ import annotations

import argparse
import importlib
import json
from time import process_time

import numpy as np
from families import arm

import polhode as ph
from polhode.algebra import Arithmetic, Expr, compile_program
from polhode.simulate import Dynamics

STATES = 20000
REPEATED = 5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("links", type=int)
    links = parser.parse_args().links
    member = arm(links)
    equations = ph.derive(member.system)
    dynamics = Dynamics(equations, {})
    wanted = [Expr.generator(symbol) for symbol in equations.acceleration_symbols]
    numbers = {s: Expr.of(member.parameters[s.published]) for s in dynamics.parameters}
    program = compile_program(
        wanted,
        dynamics.states,
        lambda symbol: numbers.get(symbol) or dynamics.meaning(symbol),
        (dynamics.accelerations,),
    )
    heyoka = importlib.import_module("heyoka")
    arithmetic = Arithmetic.of(heyoka, lambda value: heyoka.expression(float(value)))
    variables = heyoka.make_vars(*(f"x{i}" for i in range(len(dynamics.states))))
    function = heyoka.cfunc(list(program.function(arithmetic)(*variables)), vars=list(variables))
    state = np.array([member.start[s.published] for s in dynamics.states])
    states = np.repeat(state[:, None], STATES, axis=1)
    outputs = function(states)
    began = process_time()
    for _ in range(REPEATED):
        function(states, outputs=outputs)
    seconds = (process_time() - began) / (REPEATED * STATES)
    answer = {f"q_{k + 1}_ddot": float(outputs[k, 0]) for k in range(links)}
    document = {"seconds": seconds, "operations": program.operations, "answer": answer}
    print(json.dumps(document))


if __name__ == "__main__":
    main()
