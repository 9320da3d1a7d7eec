"""The vectors of a motion: angular velocities, velocities, momenta and forces along chosen axes."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping

from polhode.algebra import ZERO, Expr, Symbol, Vector
from polhode.analyse import frame_along, named_vectors, reduced, refuse_following
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser
from polhode.cli._printing import in_decimals, print_document, printed_by_name
from polhode.derive import Equations
from polhode.model import Frame

ALONG_HELP = "axes to resolve vectors along: labels such as 1,2,3, or the name of a frame"


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)
    parser.add_option("--along AXES", ALONG_HELP)
    parser.add_switch("--steady", "in steady motion: all speeds constant")


def run(options: Namespace) -> int:
    """Derive one system and print its vectors by components."""
    entry, equations, at = exact_system(options)
    refuse_following(equations, at)
    if options.steady:
        at = _still(equations) | at
    system = equations.system
    axes = options.along or ",".join(system.bodies[0].axes.labels)
    frame, labels = frame_along(system, axes)
    resolved = {
        name: components(vector, frame, labels, at)
        for name, vector in named_vectors(equations).items()
    }
    if options.json:
        axes_used = {"frame": frame.name, "along": list(labels)}
        print_document({"system": entry.name, **axes_used, "vectors": printed_by_name(resolved)})
        return 0
    print(f"Vectors of {entry.name} along {', '.join(labels)} of {frame.name}")
    for name, parts in resolved.items():
        print(in_decimals("\n".join(lines(name, parts))))
    return 0


def _still(equations: Equations) -> dict[Symbol, Expr]:
    """In steady motion accelerations and the rates of essential coordinates vanish."""
    rates = (q.derivative() for q in reduced(equations).essential)
    return dict.fromkeys([*equations.acceleration_symbols, *rates], ZERO)


def components(
    vector: Vector, frame: Frame, labels: tuple[str, ...], at: Mapping[Symbol, Expr]
) -> dict[str, Expr]:
    """Components of a vector along directions of a frame, with values put in."""
    resolved = vector.express(frame)
    return {label: resolved.dot(frame[label]).subs(at) for label in labels}


def lines(name: str, parts: Mapping[str, Expr]) -> Iterator[str]:
    """A vector as lines of text, one for each component that does not vanish."""
    shown = {label: value for label, value in parts.items() if value}
    if not shown:
        yield f"  {name} = 0"
    for label, value in shown.items():
        yield f"  {name} along {label} = {value.pretty()}"
