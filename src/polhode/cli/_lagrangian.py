"""The Lagrangian, the momenta conjugate to the coordinates, and Lagrange's equations."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable

from polhode.algebra import Symbol
from polhode.analyse import lagrangian
from polhode.base import DeclarationError
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser
from polhode.cli._printing import in_decimals, print_document, printed_by_name
from polhode.derive import Equations


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)


def run(options: Namespace) -> int:
    """Form the Lagrangian of one system and print what follows from it."""
    entry, equations, at = exact_system(options)
    _refuse_others(equations, at)
    found = lagrangian(equations)
    energies = {"T": found.kinetic, "V": found.potential, "L": found.value}
    energies = {name: value.subs(at) for name, value in energies.items()}
    momenta = {f"P_{q.published}": value.subs(at) for q, value in found.momenta.items()}
    conserved = [f"P_{q.published}" for q in found.conserved]
    rows = {q.published: found.rate_of_momentum_less_slope(q).subs(at) for q in found.momenta}
    forces = {q.published: found.generalised_force(q).subs(at) for q in found.momenta}
    if options.json:
        print_document(
            {
                "system": entry.name,
                **printed_by_name(energies),
                "momenta": printed_by_name(momenta),
                "conserved": conserved,
                # d/dt dL/dq_dot - dL/dq = the generalised force
                "equations": printed_by_name(rows),
                "forces": printed_by_name(forces),
            }
        )
        return 0
    text = [f"Lagrangian of {entry.name}"]
    text += [f"  {name} = {value.pretty()}" for name, value in energies.items()]
    text += ["Momenta"]
    for name, value in momenta.items():
        remark = "    (conserved)" if name in conserved else ""
        text.append(f"  {name} = {value.pretty()}{remark}")
    text += ["Lagrange's equations, d/dt ∂L/∂q̇ − ∂L/∂q"]
    for name, value in rows.items():
        force = forces[name].pretty()
        text.append(f"  {name}: {value.pretty()} = {force}")
    print(in_decimals("\n".join(text)))
    return 0


def _refuse_others(equations: Equations, given: Iterable[Symbol]) -> None:
    """Refuse values of speeds that a Lagrangian does not contain, such as ω₃ = ψ̇ + φ̇ cos θ."""
    rates = {q.derivative() for q in equations.coordinates}
    known = {*equations.speeds, *equations.dependent} - rates
    for symbol in (s for s in given if s in known):
        raise DeclarationError(
            f"a value of {symbol.published} in a Lagrangian",
            expected="coordinates, their rates and parameters, of which it is a function",
            advice="give values of rates such as psi_dot",
        )
