"""First integrals: energy, momenta and speeds first, then a search within a stated ansatz.

Named momenta are about a stated point and along a stated direction. Their names are those that
claims use: `L_pivot_z` is printed as L with the subscripts pivot and z.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, Vector, dot, length
from polhode.analyse._ansatz import Ansatz, is_searched, search
from polhode.analyse._constancy import has_closed_accelerations, is_constant
from polhode.analyse._finite_field import Independent
from polhode.analyse._linear_integrals import LinearIntegrals, linear_integrals
from polhode.analyse._symmetry import symmetry_axes
from polhode.base import NumericError, Shown, look_up
from polhode.derive import Equations, equations_only
from polhode.model import Body, Contact, Frame, Gravity, Pivot

#: Terms of the longest expression that is tried where accelerations are not written out.
LONGEST_CANDIDATE = 300


@dataclass(frozen=True)
class Invariant(Shown):
    """An expression of coordinates, speeds and time that keeps its value along every motion.

    Attributes:
        name: C_1, C_2, ... for one without a common name.
        expression: verified exactly, by its derivative along the motion.
        meaning: in words.
    """

    name: str
    expression: Expr
    meaning: str

    @property
    def letter(self) -> str:
        """LaTeX of the name, as used in claims: `L_{\\mathrm{pivot},z}` for `L_pivot_z`."""
        plain = self.name.removesuffix("_dot")
        letter = Expr.generator(Symbol(plain)).latex()
        return letter if plain == self.name else rf"\dot{{{letter}}}"


@dataclass(frozen=True, repr=False)
class Invariants(Shown):
    """First integrals of a system.

    Attributes:
        found: functionally independent integrals.
        ansatz: the class searched, in words; nothing outside it is excluded.
        linear: a linear equation whose constants of integration are integrals too, if not all of
            them were found: they are not elementary, or outside the ansatz.
    """

    found: tuple[Invariant, ...]
    ansatz: str
    linear: LinearIntegrals | None = None

    def __str__(self) -> str:
        lines = []
        for one in self.found:
            is_plain = one.name.count("_") < 2 or one.name.endswith("_dot")
            latex = "" if is_plain else f"; in LaTeX {one.letter}"
            lines.append(f"{one.name} = {one.expression.pretty()}    ({one.meaning}{latex})")
        if self.linear is not None:
            lines += [
                f"and the {len(self.linear.speeds)} constants of integration of",
                *(f"  {line}" for line in str(self.linear).splitlines()),
                "which the ansatz does not contain (linear_integrals computes them numerically)",
            ]
        return "\n".join([*lines, f"Searched: {self.ansatz}. Nothing outside it is excluded."])

    def __repr__(self) -> str:
        return str(self)

    def __iter__(self) -> Iterator[Invariant]:
        return iter(self.found)

    def __len__(self) -> int:
        return len(self.found)

    def __getitem__(self, name: str) -> Invariant:
        """The invariant of that name.

        Raises:
            DeclarationError: where there is none.
        """
        return look_up(name, {i.name: i for i in self.found}, "invariant that was found")


def invariants(equations: Equations, ansatz: Ansatz | None = None) -> Invariants:
    """First integrals of the motion, each verified exactly.

    Where the accelerations are too long to be written out, only energy, momenta and speeds are
    tried, at random points of a prime field: a wrong answer is less likely than 10⁻²⁰.

    Args:
        equations: derived equations.
        ansatz: the class to search besides energy and momenta; a modest one by default.
    """
    equations_only(equations, "invariants")
    chosen, closed = ansatz or Ansatz(), has_closed_accelerations(equations)
    candidates = [Invariant("E", equations.energy, "energy")]
    for speed in equations.speeds:
        meaning = f"the speed {speed.published}"
        candidates.append(Invariant(speed.published, Expr.generator(speed), meaning))
    candidates += momenta(equations)
    searched = search(equations, chosen) if closed else ()
    candidates += [Invariant("", e, "found within the ansatz") for e in searched]
    # gradients are taken with respect to the state and to prescribed functions, not to time
    driven = [
        rate
        for f in equations.functions
        for rate in (f, f.derivative(), f.derivative().derivative())
    ]
    independent = Independent([*equations.coordinates, *equations.speeds, *driven])
    found: dict[str, Invariant] = {}
    for candidate in candidates:
        expression = candidate.expression
        if not closed and length(expression) > LONGEST_CANDIDATE:
            continue
        kept = not equations.rate(expression) if closed else is_constant(equations, expression)
        if kept and independent.takes(candidate.expression):
            name, number = candidate.name, 1
            while not name or name in found:
                name = f"{candidate.name or 'C'}_{number}"
                number += 1
            found[name] = Invariant(name, candidate.expression, candidate.meaning)
    numbered = tuple(found.values())
    scope = f"energy, momenta and speeds; {_beyond(equations, chosen, closed)}"
    return Invariants(numbered, scope, _linear(equations, numbered) if closed else None)


def _beyond(equations: Equations, ansatz: Ansatz, closed: bool) -> str:
    """What was searched besides them, in words."""
    if not closed:
        return (
            f"of these, expressions of up to {LONGEST_CANDIDATE} terms; nothing else, as the "
            "accelerations are too long to be written out"
        )
    return ansatz.describe() if is_searched(equations) else "nothing else in driven equations"


def _linear(equations: Equations, found: Iterable[Invariant]) -> LinearIntegrals | None:
    """The linear equation of some speeds, unless all its integrals have been found."""
    try:
        linear = linear_integrals(equations)
    except NumericError:  # equations that depend on time have no such linear equation
        return None
    if linear is None or linear.known(i.expression for i in found) == len(linear.speeds):
        return None
    return linear


def momenta(equations: Equations) -> Iterator[Invariant]:
    """Momenta of each body about its axes and centre, of all about points; Jellett's integral."""
    yield from _spins(equations)
    places = tuple(_places(equations))
    for place in places:
        angular = equations.angular_momentum(place.position)
        for name, words, direction in _directions(equations, equations.system.bodies[0].axes):
            meaning = f"angular momentum about {place.words} along {words}"
            letter = name and f"L_{place.name}_{name}"
            yield Invariant(letter, angular.dot(direction), meaning)
    for place in places:
        angular = equations.angular_momentum(place.position)
        square = dot(angular.components, angular.components)
        yield Invariant("", square, f"square of the angular momentum about {place.words}")
    root = equations.system.root
    for label in root.labels:
        along = equations.linear_momentum.dot(root[label])
        yield Invariant(f"P_total_{label}", along, f"linear momentum along {label}")
    for contact in equations.system.elements:
        if isinstance(contact, Contact):
            body = contact.body
            meaning = f"Jellett's: spin of {body.name} along its line to where it touches"
            yield Invariant(f"J{body.tag}", -_spin(equations, body).dot(contact.arm), meaning)


def _spins(equations: Equations) -> Iterator[Invariant]:
    """Angular momenta of each body about its centre of mass: along its own, then fixed axes."""
    bodies = equations.system.bodies
    # L_cm is the momentum of the whole system, which is the spin for a single body only
    letter = "L_cm" if len(bodies) == 1 else "S"
    for body in bodies:
        spin = _spin(equations, body)
        for label in body.axes.labels:
            meaning = f"angular momentum of {body.name} about its axis {label}"
            yield Invariant(f"{letter}_{label}{body.tag}", spin.dot(body.axes[label]), meaning)
        for axis in symmetry_axes(body):
            meaning = f"angular momentum of {body.name} about its axis of symmetry"
            yield Invariant("", spin.dot(axis), meaning)
    for body in bodies:
        spin = _spin(equations, body)
        for name, words, direction in _directions(equations, body.axes):
            meaning = f"angular momentum of {body.name} about its centre of mass along {words}"
            yield Invariant(name and f"{letter}_{name}{body.tag}", spin.dot(direction), meaning)


@dataclass(frozen=True)
class _Place:
    name: str
    words: str
    position: Vector


def _places(equations: Equations) -> Iterator[_Place]:
    """Where contacts and joints act, and the origin."""
    kinetics = equations.kinetics
    taken: set[str] = set()
    for element in kinetics.elements:
        restraints = [r for r in kinetics.restraints[element.name] if not r.is_couple]
        name = element.name
        if not name.isalnum():  # unfit as a subscript: use the kind, for the first of its kind
            kinds = ((Contact, "contact"), (Pivot, "pivot"))
            word = next((word for kind, word in kinds if isinstance(element, kind)), "")
            name = "" if word in taken else word
        first = restraints[0] if restraints else None
        if first is not None and first.arm is not None and name:
            taken.add(name)
            touching = isinstance(element, Contact)
            words = f"the point of contact at {element.name}" if touching else element.name
            yield _Place(name, words, kinetics.places[first.body] + first.arm)
    yield _Place("O", "the origin", equations.system.root.zero)


def _directions(equations: Equations, axes: Frame) -> Iterator[tuple[str, str, Vector]]:
    """Name, words and unit vector of fixed directions; no name if the letter is ambiguous."""
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
