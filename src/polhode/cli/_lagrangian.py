"""The Lagrangian, the momenta conjugate to the coordinates, and Lagrange's equations."""

from __future__ import annotations

from argparse import Namespace

from polhode.algebra import Expr, Symbol
from polhode.analyse import lagrangian
from polhode.catalogue import exact_values
from polhode.cli._parser import Parser, assignments
from polhode.cli._printing import in_decimals, print_document, printed
from polhode.cli._systems import NAME_HELP, entry_of
from polhode.cli._vectors import AT_HELP
from polhode.derive import derive


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_argument("name", metavar="NAME", help=NAME_HELP)
    parser.add_argument("--at", action="append", default=[], metavar="k=v", help=AT_HELP)
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(options: Namespace) -> int:
    """Form the Lagrangian of one system and print what follows from it."""
    entry = entry_of(options.name)
    equations = derive(entry.build())
    at = dict[Symbol, Expr](exact_values(equations, assignments(options.at), entry))
    found = lagrangian(equations)
    energies = {"T": found.kinetic, "V": found.potential, "L": found.value}
    momenta = {f"P_{q.published}": value for q, value in found.momenta.items()}
    conserved = [f"P_{q.published}" for q in found.conserved]
    rows = {q.published: found.rate_of_momentum_less_slope(q) for q in found.momenta}
    forces = {q.published: found.generalised_force(q) for q in found.momenta}
    if options.json:
        print_document(
            {
                "system": entry.name,
                **{name: printed(value.subs(at)) for name, value in energies.items()},
                "momenta": {name: printed(value.subs(at)) for name, value in momenta.items()},
                "conserved": conserved,
                # d/dt dL/dq_dot - dL/dq = the generalised force
                "equations": {name: printed(value.subs(at)) for name, value in rows.items()},
                "forces": {name: printed(value.subs(at)) for name, value in forces.items()},
            }
        )
        return 0
    text = [f"Lagrangian of {entry.name}"]
    text += [f"  {name} = {value.subs(at).pretty()}" for name, value in energies.items()]
    text += ["Momenta"]
    for name, value in momenta.items():
        remark = "    (conserved)" if name in conserved else ""
        text.append(f"  {name} = {value.subs(at).pretty()}{remark}")
    text += ["Lagrange's equations, d/dt ∂L/∂q̇ − ∂L/∂q"]
    for name, value in rows.items():
        force = forces[name].subs(at).pretty()
        text.append(f"  {name}: {value.subs(at).pretty()} = {force}")
    print(in_decimals("\n".join(text)))
    return 0
