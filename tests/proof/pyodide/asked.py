"""What is asked of polhode, here and in a browser; prints the answers as JSON.

NumPy is not there: its wheels for this platform are on no registry that the tests reach. The kernel
is therefore run by its instance alone, below the arrays that Python reads it into.
"""

import json
import struct
import sys
import types
from pathlib import Path

import polhode as ph
from polhode.algebra import compile_program, coordinates, cos, sin, symbols
from polhode.catalogue import CATALOGUE


def kernel_classes():
    """Modules of the kernel without `polhode.simulate`, which needs NumPy."""
    for name in ("polhode.simulate", "polhode.simulate.kernel"):
        package = types.ModuleType(name)
        package.__path__ = [str(Path(ph.__file__).parent.joinpath(*name.split(".")[1:]))]
        sys.modules[name] = package
    from polhode.simulate.kernel._instance import instance
    from polhode.simulate.kernel._layout import DOUBLE_PLACES, Layout
    from polhode.simulate.kernel._tape import tape_of

    return instance, Layout, tape_of, DOUBLE_PLACES


def motion():
    """Bits of a pendulum after 10 s of 25 steps, by polynomials of order 20."""
    instance, Layout, tape_of, places = kernel_classes()
    theta, omega = coordinates("theta omega")
    (g,) = symbols("g")
    arguments = tuple(next(iter(e.symbols())) for e in (theta, omega, g))
    rates = compile_program([omega, -g * sin(theta) + cos(theta) / 7], arguments)
    layout = Layout(tape_of(rates, 2), 20, 64)
    begun = instance(layout.size)
    for address, content in layout.image().items():
        begun.write(address, content)
    for address, value in zip((*layout.parameters, *layout.states), (9.81, 2.0, 0.5), strict=True):
        begun.write(address, struct.pack("<d", value))
    begun.call("start")
    for name, value in (("goal", 10.0), ("longest", 10.0)):
        begun.write(places[name], struct.pack("<d", value))
    status = [begun.call("advance", 64)]
    while status[-1] == 0:
        status.append(begun.call("advance", 64))
    ends = [struct.unpack("<d", begun.read(address, 8))[0].hex() for address in layout.states]
    return [*status, *ends]


def answers():
    """By name."""
    found = {}
    for name, entry in CATALOGUE.items():
        found[name] = str(ph.derive(entry.build()))
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    families = ph.steady(disk)
    found["steady"] = str(families)
    found["stability"] = str([ph.stability(family) for family in families])
    found["Lagrangian"] = str(ph.lagrangian(ph.derive(CATALOGUE["gyroscope"].build())))
    found["kernel"] = motion()
    return found


print(json.dumps(answers()))
