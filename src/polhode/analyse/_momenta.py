"""Momenta that mechanics knows by name, each about a stated point and along a stated direction.

Names are those that claims read: `L_pivot_z` is printed as L with the subscripts pivot and z.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Vector, dot
from polhode.analyse._symmetry import symmetry_axes
from polhode.derive import Equations
from polhode.model import Body, Contact, Element, Frame, Gravity, Pivot


@dataclass(frozen=True)
class Momentum:
    """A component of a momentum.

    Attributes:
        name: published; empty where no letter says what it is.
        expression: in coordinates and speeds.
        meaning: in words.
    """

    name: str
    expression: Expr
    meaning: str


def momenta(equations: Equations) -> Iterator[Momentum]:
    """Momenta of every body about its centre and its axes, of all about points, and Jellett's."""
    bodies = equations.system.bodies
    for body in bodies:
        yield from _about_own_axes(equations, body)
    for body in bodies:
        yield from _about_own_centre(equations, body)
    for place in _places(equations):
        yield from _about(equations, place)
    for place in _places(equations):
        angular = equations.angular_momentum(place.position)
        square = dot(angular.components, angular.components)
        yield Momentum("", square, f"square of the angular momentum about {place.words}")
    root = equations.system.root
    for label in root.labels:
        along = equations.linear_momentum.dot(root[label])
        yield Momentum(f"P_total_{label}", along, f"linear momentum along {label}")
    for contact in equations.system.elements:
        if isinstance(contact, Contact):
            body = contact.body
            meaning = f"Jellett's: spin of {body.name} along its line to where it touches"
            yield Momentum(f"J{body.tag}", -_spin(equations, body).dot(contact.arm), meaning)


def _about_own_axes(equations: Equations, body: Body) -> Iterator[Momentum]:
    spin = _spin(equations, body)
    letter = _letter(equations)
    for label in body.axes.labels:
        meaning = f"angular momentum of {body.name} about its axis {label}"
        yield Momentum(f"{letter}_{label}{body.tag}", spin.dot(body.axes[label]), meaning)
    for axis in symmetry_axes(body):
        meaning = f"angular momentum of {body.name} about its axis of symmetry"
        yield Momentum("", spin.dot(axis), meaning)


def _about_own_centre(equations: Equations, body: Body) -> Iterator[Momentum]:
    spin, letter = _spin(equations, body), _letter(equations)
    for name, words, direction in _directions(equations, body.axes):
        meaning = f"angular momentum of {body.name} about its centre of mass along {words}"
        yield Momentum(name and f"{letter}_{name}{body.tag}", spin.dot(direction), meaning)


def _letter(equations: Equations) -> str:
    """L_cm is that of the whole system about one centre: of a single body's spin alone."""
    return "L_cm" if len(equations.system.bodies) == 1 else "S"


@dataclass(frozen=True)
class _Place:
    name: str
    words: str
    position: Vector


def _about(equations: Equations, place: _Place) -> Iterator[Momentum]:
    angular = equations.angular_momentum(place.position)
    for name, words, direction in _directions(equations, equations.system.bodies[0].axes):
        meaning = f"angular momentum about {place.words} along {words}"
        yield Momentum(name and f"L_{place.name}_{name}", angular.dot(direction), meaning)


def _places(equations: Equations) -> Iterator[_Place]:
    """Where contacts and joints act, and the origin."""
    kinetics = equations.kinetics
    taken: set[str] = set()
    for element in kinetics.elements:
        restraints = [r for r in kinetics.restraints[element.name] if not r.is_couple]
        name = _label(element, taken)
        first = restraints[0] if restraints else None
        if first is not None and first.arm is not None and name:
            taken.add(name)
            touching = isinstance(element, Contact)
            words = f"the point of contact at {element.name}" if touching else element.name
            yield _Place(name, words, kinetics.places[first.body] + first.arm)
    yield _Place("O", "the origin", equations.system.root.zero)


def _label(element: Element, taken: set[str]) -> str:
    """Its name if that can stand below a letter, else what texts call the first of its kind."""
    if element.name.isalnum():
        return element.name
    kinds = ((Contact, "contact"), (Pivot, "pivot"))
    label = next((word for kind, word in kinds if isinstance(element, kind)), "")
    return "" if label in taken else label


def _directions(equations: Equations, axes: Frame) -> Iterator[tuple[str, str, Vector]]:
    """Name, words and unit vector of directions at rest; nameless where a letter means another."""
    root = equations.system.root
    moving: Sequence[str] = () if axes == root else axes.labels
    for label in reversed(root.labels):
        yield ("" if label in moving else label), label, root[label]
    for load in equations.system.loads:
        if isinstance(load, Gravity) and load.up is not None:
            yield "", "the vertical", load.up


def _spin(equations: Equations, body: Body) -> Vector:
    """Angular momentum about the centre of mass."""
    angular_velocity = equations.kinetics.velocities[body][1]
    return Vector(body.inertia.times(angular_velocity.components), angular_velocity.triad)
