"""Centrifugal, Coriolis and Euler torques on each body in a frame that turns.

The torques are about the centre of mass of each body. The frame is the laboratory where it turns,
as on the Earth, and otherwise the axes of each body.
"""

from __future__ import annotations

from argparse import Namespace

from polhode.analyse import fictitious_torque, frame_along, refuse_following
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser
from polhode.cli._printing import in_decimals, print_document, printed_by_name
from polhode.cli._vectors import ALONG_HELP, components, lines

_KINDS = ("centrifugal", "coriolis", "euler", "total")


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)
    parser.add_option("--frame FRAME", "the turning frame: its name or its labels")
    parser.add_option("--along AXES", ALONG_HELP)


def run(options: Namespace) -> int:
    """Derive one system and print the fictitious torques on its bodies."""
    entry, equations, at = exact_system(options)
    refuse_following(equations, at)
    system = equations.system
    bodies = {}
    for body in system.bodies:
        turning = system.root if any(system.root.turned) else body.axes
        if options.frame:
            turning, _ = frame_along(system, options.frame)
        frame, labels = frame_along(system, options.along or ",".join(body.axes.labels))
        torque = fictitious_torque(equations, body, turning)
        parts = {kind: components(getattr(torque, kind), frame, labels, at) for kind in _KINDS}
        bodies[body.name] = (turning.name, parts)
    if options.json:
        described = {
            name: {"frame": frame_name, "torques": printed_by_name(parts)}
            for name, (frame_name, parts) in bodies.items()
        }
        print_document({"system": entry.name, "bodies": described})
        return 0
    for name, (frame_name, parts) in bodies.items():
        print(f"Fictitious torques on {name} about its centre of mass, in the frame {frame_name}")
        for kind, along in parts.items():
            print(in_decimals("\n".join(lines(kind, along))))
    return 0
