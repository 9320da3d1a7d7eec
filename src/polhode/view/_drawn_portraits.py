"""What is drawn of a motion beside its plots against time, as expressions in its equations.

Phase portraits, the axis of a spinning body on the unit sphere, and the direction of the angular
momentum along the axes of a body that turns freely, which is the path of Poinsot's polhode.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol
from polhode.derive import Equations, is_angle
from polhode.model import About, Body, Components, Relative
from polhode.view._mathml import inline
from polhode.view._scene import Triple

_PHASES = 2  # at most


@dataclass(frozen=True)
class DrawnPortrait:
    """A curve in a plane, or of directions on the unit sphere.

    Attributes:
        kind: plane, sphere or axis.
        title: what it shows, in words.
        names: of its axes: published names of quantities in a plane, labels of directions.
        symbols: MathML of them; empty where the names are the letters.
        units: SI units; "rad" for an angle, empty on a sphere.
        values: along its axes, of any length on a sphere; None where they are not defined.
        body: of an axis, position of its body among the bodies.
        axis: unit vector along the axes of that body.
    """

    kind: str
    title: str
    names: tuple[str, ...]
    symbols: tuple[str, ...]
    units: tuple[str, ...]
    values: Callable[[Equations], Sequence[Expr] | None]
    body: int = -1
    axis: Triple = (0.0, 0.0, 0.0)


def portraits_in(equations: Equations) -> Iterator[DrawnPortrait]:
    """The portraits of a motion that begins with these equations."""
    yield from (_phase(equations, q) for q in essential_coordinates(equations)[:_PHASES])
    for i, body in enumerate(equations.system.bodies):
        if isinstance(body.spin, About | Relative):
            yield _axis(i, body, body.spin.axis)
        elif isinstance(body.spin, Components) and not body.is_isotropic:
            yield _polhode(body)


def essential_coordinates(equations: Equations) -> list[Symbol]:
    """The coordinates that the energy depends on."""
    used = equations.energy.symbols()
    return [q for q in equations.coordinates if q in used]


def _phase(equations: Equations, q: Symbol) -> DrawnPortrait:
    """A coordinate and its rate."""
    rate = q.derivative()

    def values(present: Equations) -> Sequence[Expr] | None:
        if q not in present.coordinates:
            return None
        return Expr.generator(q), present.kinetics.on_speeds(present.kinetics.rate(q))

    letters = (Expr.generator(q), Expr.generator(rate))
    symbols, names = tuple(map(inline, letters)), (q.published, rate.published)
    units = ("rad", "rad/s") if is_angle(equations, q) else ("m", "m/s")
    return DrawnPortrait("plane", "phase portrait", names, symbols, units, values)


def _axis(i: int, body: Body, label: str) -> DrawnPortrait:
    def values(equations: Equations) -> Sequence[Expr]:
        return body.axes[label].express(equations.system.root).components

    names = body.axes.root.labels
    at = body.axes.position(label)
    axis = (float(at == 0), float(at == 1), float(at == 2))
    return DrawnPortrait("axis", f"axis of {body.name}", names, (), (), values, i, axis)


def _polhode(body: Body) -> DrawnPortrait:
    def values(equations: Equations) -> Sequence[Expr]:
        turning = equations.kinetics.velocities[body][1]
        return tuple(body.inertia.times(turning.express(body.axes).components))

    title = f"angular momentum seen from {body.name}"
    return DrawnPortrait("sphere", title, body.axes.labels, (), (), values)
