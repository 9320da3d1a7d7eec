"""First integrals: named ones tried first, then whatever a stated ansatz contains."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, Vector, dot, pi, time
from polhode.analyse._ansatz import Ansatz, search
from polhode.analyse._independence import Independent
from polhode.analyse._linear_integrals import LinearIntegrals, linear_integrals
from polhode.analyse._reduced import refuse_parts
from polhode.base import NumericError, Shown, look_up
from polhode.derive import Equations, equations_only
from polhode.model import Body, Contact


@dataclass(frozen=True)
class Invariant(Shown):
    """An expression of coordinates, speeds and time that keeps its value along every motion.

    Attributes:
        name: what it is called; C_1, C_2, ... where it has no name.
        expression: verified exactly, by its derivative along the motion.
        meaning: in words.
    """

    name: str
    expression: Expr
    meaning: str


@dataclass(frozen=True, repr=False)
class Invariants(Shown):
    """All that was found.

    Attributes:
        found: independent of one another.
        ansatz: what was searched, in words; nothing outside it is excluded.
        linear: a linear equation whose constants of integration are integrals too, where
            not all of them were found: they are no elementary functions, or outside the ansatz.
    """

    found: tuple[Invariant, ...]
    ansatz: str
    linear: LinearIntegrals | None = None

    def __str__(self) -> str:
        found = [f"{i.name} = {i.expression.pretty()}    ({i.meaning})" for i in self.found]
        limits = f"Searched: {self.ansatz}. Nothing outside it is excluded."
        return "\n".join([*found, *self._beyond(), limits])

    def __repr__(self) -> str:
        return str(self)

    def _beyond(self) -> list[str]:
        if self.linear is None:
            return []
        count = len(self.linear.speeds)
        return [
            f"and the {count} constants of integration of",
            *(f"  {line}" for line in str(self.linear).splitlines()),
            "which the ansatz does not contain (linear_integrals gives them in numbers)",
        ]

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

    Args:
        equations: derived equations.
        ansatz: what to search besides energy and momenta; a modest default otherwise.

    Raises `NumericError` for equations in named parts.
    """
    equations_only(equations, "invariants")
    refuse_parts(equations)
    chosen = ansatz or Ansatz()
    found: list[Invariant] = []
    independent = Independent(*_symbols(equations))
    for candidate in (*_named(equations), *_searched(equations, chosen)):
        constant = not equations.rate(candidate.expression)
        if constant and independent.takes(candidate.expression):
            found.append(candidate)
    numbered = _numbered(found)
    searched = f"energy, momenta and speeds; {chosen.describe()}"
    return Invariants(numbered, searched, _linear(equations, numbered))


def _linear(equations: Equations, found: Iterable[Invariant]) -> LinearIntegrals | None:
    """The linear equation of some speeds, unless its integrals have been found already."""
    try:
        linear = linear_integrals(equations)
    except NumericError:  # driven: no angle tells where the motion is
        return None
    if linear is None or linear.known(i.expression for i in found) == len(linear.speeds):
        return None
    return linear


def _symbols(equations: Equations) -> tuple[list[Symbol], list[Symbol]]:
    """What integrals may vary with, and the constants in them."""
    driven = [
        rate
        for f in equations.functions
        for rate in (f, f.derivative(), f.derivative().derivative())
    ]
    state = [*equations.coordinates, *equations.speeds, *driven]
    return state, [*equations.parameters, *time.symbols(), *pi.symbols()]


def _named(equations: Equations) -> Iterator[Invariant]:
    yield Invariant("E", equations.energy, "energy")
    for speed in equations.speeds:
        expression = Expr.generator(speed)
        yield Invariant(speed.published, expression, f"the speed {speed.published}")
    for body in equations.system.bodies:
        momentum = _spin(equations, body)
        for label in body.axes.labels:
            meaning = f"angular momentum of {body.name} about its axis {label}"
            yield Invariant(f"L_{label}{body.tag}", momentum.dot(body.axes[label]), meaning)
    yield from _momenta(equations)


def _momenta(equations: Equations) -> Iterator[Invariant]:
    root = equations.system.root
    for body in equations.system.bodies:
        momentum = _spin(equations, body)
        for label in reversed(root.labels):
            meaning = f"angular momentum of {body.name} about its centre along {label}"
            yield Invariant(f"S_{label}{body.tag}", momentum.dot(root[label]), meaning)
    angular, linear = equations.angular_momentum(), equations.linear_momentum
    for label in reversed(root.labels):
        yield Invariant(f"L_{label}", angular.dot(root[label]), f"angular momentum about {label}")
    yield Invariant("L2", dot(angular.components, angular.components), "angular momentum squared")
    for label in root.labels:
        yield Invariant(f"P_{label}", linear.dot(root[label]), f"linear momentum along {label}")
    for contact in equations.system.elements:
        if isinstance(contact, Contact):
            body = contact.body
            meaning = f"Jellett's: spin of {body.name} along its line to where it touches"
            yield Invariant(f"J{body.tag}", -_spin(equations, body).dot(contact.arm), meaning)


def _spin(equations: Equations, body: Body) -> Vector:
    """Angular momentum about the centre of mass."""
    angular_velocity = equations.kinetics.velocities[body][1]
    return Vector(body.inertia.times(angular_velocity.components), angular_velocity.triad)


def _searched(equations: Equations, ansatz: Ansatz) -> Iterator[Invariant]:
    for expression in search(equations, ansatz):
        yield Invariant("", expression, "found within the ansatz")


def _numbered(found: list[Invariant]) -> tuple[Invariant, ...]:
    taken: set[str] = set()
    result = []
    for invariant in found:
        name = invariant.name
        number = 1
        while not name or name in taken:
            name = f"C_{number}" if not invariant.name else f"{invariant.name}_{number}"
            number += 1
        taken.add(name)
        result.append(Invariant(name, invariant.expression, invariant.meaning))
    return tuple(result)
