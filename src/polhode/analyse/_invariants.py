"""First integrals: named ones tried first, then whatever a stated ansatz contains."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol
from polhode.analyse._ansatz import Ansatz, is_searched, search
from polhode.analyse._independence import Independent
from polhode.analyse._linear_integrals import LinearIntegrals, linear_integrals
from polhode.analyse._momenta import momenta
from polhode.analyse._reduced import refuse_parts
from polhode.base import NumericError, Shown, look_up
from polhode.derive import Equations, equations_only


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

    @property
    def letter(self) -> str:
        """LaTeX of the name, as claims read it: `L_{\\mathrm{pivot},z}` for `L_pivot_z`."""
        plain = self.name.removesuffix("_dot")
        letter = Expr.generator(Symbol(plain)).latex()
        return letter if plain == self.name else rf"\dot{{{letter}}}"


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
        found = [f"{i.name} = {i.expression.pretty()}    ({_told(i)})" for i in self.found]
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


def _told(invariant: Invariant) -> str:
    """What it is, and how it is written where that is not how it is spelled."""
    if invariant.name.count("_") < 2 or invariant.name.endswith("_dot"):
        return invariant.meaning
    return f"{invariant.meaning}; in LaTeX {invariant.letter}"


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
    independent = Independent(_state(equations))
    for candidate in (*_named(equations), *_searched(equations, chosen)):
        constant = not equations.rate(candidate.expression)
        if constant and independent.takes(candidate.expression):
            found.append(candidate)
    numbered = _numbered(found)
    beyond = chosen.describe() if is_searched(equations) else "nothing else in driven equations"
    searched = f"energy, momenta and speeds; {beyond}"
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


def _state(equations: Equations) -> list[Symbol]:
    """What integrals may vary with; time itself is none of it."""
    driven = [
        rate
        for f in equations.functions
        for rate in (f, f.derivative(), f.derivative().derivative())
    ]
    return [*equations.coordinates, *equations.speeds, *driven]


def _named(equations: Equations) -> Iterator[Invariant]:
    yield Invariant("E", equations.energy, "energy")
    for speed in equations.speeds:
        expression = Expr.generator(speed)
        yield Invariant(speed.published, expression, f"the speed {speed.published}")
    for momentum in momenta(equations):
        yield Invariant(momentum.name, momentum.expression, momentum.meaning)


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
