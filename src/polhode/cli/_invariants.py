"""The first integrals of a system, each verified exactly."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping

from polhode.algebra import Expr
from polhode.analyse import Invariants, invariants, lagrangian
from polhode.base import DeclarationError
from polhode.cli._contact_options import add_slipping_options, exactly_declared
from polhode.cli._parser import Parser
from polhode.cli._printing import print_document, printed, printed_by_name
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.add_system()
    add_slipping_options(parser)
    parser.add_json()


def run(options: Namespace) -> int:
    """Find the integrals of one system and print them."""
    entry = entry_of(options.name)
    equations = derive(exactly_declared(entry, options))
    found = invariants(equations)
    momenta = conserved_momenta(equations)
    if options.json:
        described = [{"name": i.name, **printed(i.expression), "meaning": i.meaning} for i in found]
        linear = found.linear and {
            "angle": found.linear.angle.published,
            "speeds": [speed.published for speed in found.linear.speeds],
            # d(speed)/d(angle), one slope for each speed
            "slopes": [printed(slope) for slope in found.linear.slopes],
        }
        print_document(
            {
                "system": entry.name,
                "invariants": described,
                "ansatz": found.ansatz,
                "linear": linear,
                "momenta": printed_by_name(momenta),
            }
        )
        return 0
    print(f"Integrals of {entry.name}{', slipping' if options.mu else ''}")
    print(found)
    for name, value in momenta.items():
        print(f"{name} = {value.pretty()}    (conserved momentum{_by_name(value, found)})")
    return 0


def conserved_momenta(equations: Equations) -> Mapping[str, Expr]:
    """The conserved momenta ∂L/∂q̇ by name, in the speeds of the equations; none without L."""
    try:
        found = lagrangian(equations)
    except DeclarationError:  # rolling, for instance, has no Lagrangian in these coordinates
        return {}
    return {
        f"P_{q.published}": equations.kinetics.on_speeds(found.momenta[q]) for q in found.conserved
    }


def _by_name(value: Expr, found: Invariants) -> str:
    """Which invariant a momentum is, or is a constant multiple of."""
    for one in found:
        factor = value / one.expression
        if not factor.varies:
            return f": {one.name}" if factor == 1 else f": {one.name} times {factor.pretty()}"
    return ""
