"""Dimensions of all symbols, inferred from where they are used."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from polhode.algebra import Expr, Generator, Symbol, Vector, has_parts, lengths_written_out, time
from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, UnitError
from polhode.derive._motion import Kinematics
from polhode.model import Body

RATE = PURE / TIME
FORCE = MASS * LENGTH / TIME**2
ENERGY = FORCE * LENGTH


@dataclass(frozen=True)
class Use:
    """An expression in a role whose dimension is known.

    One that is not binding determines dimensions, but contradicts nothing: numbers in forces are
    often written without their units, as in m * 9.81 or sin(3 * time).
    """

    role: str
    expression: Expr
    dimension: Dimension
    is_binding: bool = True


def infer(uses: Iterable[Use]) -> dict[Symbol, Dimension]:
    """Dimension of every symbol that the uses determine.

    Every term of every expression must have the dimension of its role, and every argument of a
    function must be dimensionless. In the exponents of mass, length and time that is a linear
    system: Σ power · exponent(symbol) = exponent(role), one equation for each term.

    Raises `UnitError` where two uses contradict one another, naming both.
    """
    system, added = _Exponents(), set[tuple[frozenset[tuple[Generator, Fraction]], Dimension]]()
    for use in uses:
        for term in _terms(use):
            equation = frozenset(term.powers.items()), term.dimension
            if equation in added:  # most terms of long expressions say the same
                continue
            try:
                system.add(term, use.role)
                added.add(equation)
            except UnitError:
                if use.is_binding:
                    raise
    return system.dimensions()


@dataclass(frozen=True)
class _Term:
    """One term: a product of powers of symbols, and named parts, that must have a dimension."""

    powers: Mapping[Generator, Fraction]
    dimension: Dimension


def _terms(use: Use) -> Iterator[_Term]:
    parts = (use.expression.numerator, use.expression.denominator)
    monomials = [list(_different(part)) for part in parts]
    for generator in use.expression.generators:
        # arguments of sines and exponentials are dimensionless; the terms of a radicand agree
        for argument in generator.arguments:
            if not generator.depth or generator.partner() is not None:
                yield from _terms(Use(use.role, argument, PURE))
            else:
                first, *others = (_dimensional(powers) for powers, _ in argument.terms())
                yield from (_quotient(other, first, PURE) for other in others)
    if not monomials[0]:
        return
    below = monomials[1][0]
    for above in monomials[0]:
        yield _quotient(above, below, use.dimension)
    for other in monomials[1][1:]:
        yield _quotient(other, below, PURE)


def _different(polynomial: Expr) -> Iterator[_Term]:
    """Its terms; of those that differ in sines and numbers only, the first."""
    generators = polynomial.ring.generators
    counting = [i for i, g in enumerate(generators) if _has_dimension(g)]
    found = dict.fromkeys(tuple(m[i] for i in counting) for m in polynomial.num.monoms())
    for powers in found:
        pairs = zip(counting, powers, strict=True)
        yield _dimensional({generators[i]: int(power) for i, power in pairs if power})


def _has_dimension(generator: Generator) -> bool:
    """Whether it is a symbol, a named part or a root; functions are dimensionless."""
    is_root = bool(generator.depth) and generator.partner() is None
    return generator.is_part or isinstance(generator, Symbol) or is_root


def _dimensional(powers: Mapping[Generator, int]) -> _Term:
    """Powers of symbols in a monomial; a root counts as half the powers of its first term."""
    found: dict[Generator, Fraction] = {}
    dimension = PURE
    for generator, power in powers.items():
        if generator.is_part:
            found[generator] = Fraction(power)
        elif isinstance(generator, Symbol):
            base = generator.base()
            found[base] = found.get(base, Fraction(0)) + power
            if generator.order:
                dimension = dimension * TIME ** (generator.order * power)
        elif generator.depth and generator.partner() is None:
            inner = _dimensional(next(iter(generator.arguments[0].terms()))[0])
            for symbol, exponent in inner.powers.items():
                found[symbol] = found.get(symbol, Fraction(0)) + exponent * power / 2
            dimension = dimension * inner.dimension ** Fraction(power, 2)
    return _Term(found, dimension)


def _quotient(above: _Term, below: _Term, dimension: Dimension) -> _Term:
    powers = _difference(above.powers, below.powers)
    return _Term(powers, dimension * above.dimension / below.dimension)


def _difference(
    above: Mapping[Generator, Fraction], below: Mapping[Generator, Fraction]
) -> dict[Generator, Fraction]:
    zero = Fraction(0)
    return {s: above.get(s, zero) - below.get(s, zero) for s in dict.fromkeys([*above, *below])}


class _Exponents:
    """Gaussian elimination on exponents, with the role that fixed each symbol."""

    def __init__(self) -> None:
        self._rows: dict[Generator, _Term] = {}
        self._roles: dict[Generator, str] = {}

    def add(self, term: _Term, role: str) -> None:
        """Add a term whose dimension is known.

        Raises:
            UnitError: where that contradicts terms added before, or a bare number has a unit.
        """
        reduced = self._reduced(term)
        pivot = next((s for s, power in reduced.powers.items() if power), None)
        if pivot is not None:
            self._rows[pivot] = _scaled(reduced, 1 / reduced.powers[pivot])
            self._roles[pivot] = role
        elif not any(term.powers.values()) and term.dimension != PURE:
            raise UnitError(
                f"a bare number as {role}",
                expected=f"a symbol, since it has the unit {term.dimension}",
                advice="write m = polhode.symbol('m') or the like, and give its value at run time",
            )
        elif reduced.dimension != PURE:
            involved = [s for s, power in term.powers.items() if power]
            earlier = dict.fromkeys(self._roles[s] for s in involved if s in self._roles)
            names = ", ".join(s.published if isinstance(s, Symbol) else "a part" for s in involved)
            raise UnitError(
                f"dimensions of {names}: as {role} they are off by {reduced.dimension}",
                expected="one dimension for each quantity, as already fixed by "
                + (" and by ".join(earlier) or "the role alone"),
                advice="look for a missing length, mass or time, or a bare number in place of one",
            )

    def _reduced(self, term: _Term) -> _Term:
        while known := next((s for s, p in term.powers.items() if p and s in self._rows), None):
            row = _scaled(self._rows[known], term.powers[known])
            term = _Term(_difference(term.powers, row.powers), term.dimension / row.dimension)
        return term

    def dimensions(self) -> dict[Symbol, Dimension]:
        found = {}
        for symbol in self._rows:
            solved = self._reduced(_Term({symbol: Fraction(1)}, PURE))
            if isinstance(symbol, Symbol) and not any(solved.powers.values()):
                found[symbol] = PURE / solved.dimension
        return found


def _scaled(term: _Term, factor: Fraction) -> _Term:
    powers = {s: p * factor for s, p in term.powers.items()}
    return _Term(powers, term.dimension**factor)


def uses_of(
    motion: Kinematics,
    energies: Mapping[str, Expr],
    reactions: Mapping[str, tuple[Expr, Dimension]],
) -> Iterator[Use]:
    """Every role that a system gives to expressions.

    The plainest come first: a contradiction is reported against the roles added before it. Of what
    elimination in named parts has given nothing is read: its normal equations add the squares of
    constraints of different dimensions.
    """
    yield Use("time", time, TIME)
    for body in motion.system.bodies:
        yield Use(f"mass of {body.name}", body.mass, MASS)
        for row in body.inertia.rows:
            for entry in row:
                yield Use(f"inertia of {body.name}", entry, MASS * LENGTH**2)
        for frame in body.axes.lineage:
            yield Use(f"angle of frame {frame.name}", frame.angle, PURE)
        yield from (Use(f"place of {body.name}", c, LENGTH) for c in motion.places[body].components)
        yield from _uses_by_velocities(body, *motion.unconstrained[body])
    yield from _uses_by_restraints(motion)
    solved = _solved_uses(motion, energies, reactions)
    yield from (use for use in solved if not has_parts(use.expression))
    yield from _uses_by_loads(motion)


def _uses_by_velocities(body: Body, velocity: Vector, angular: Vector) -> Iterator[Use]:
    yield from (Use(f"velocity of {body.name}", c, LENGTH / TIME) for c in velocity.components)
    yield from (Use(f"rotation of {body.name}", c, RATE) for c in angular.components)


def _solved_uses(
    motion: Kinematics,
    energies: Mapping[str, Expr],
    reactions: Mapping[str, tuple[Expr, Dimension]],
) -> Iterator[Use]:
    """The roles of what follows by solving the constraints."""
    for body, pair in motion.velocities.items():
        yield from _uses_by_velocities(body, *pair)
    for coordinate, rate in motion.kinematics.items():
        quotient = rate / Expr.generator(coordinate)
        yield Use(f"rate of {coordinate.base().published}", quotient, PURE)
    yield from (Use(name, energy, ENERGY) for name, energy in energies.items())
    yield from (Use(name, value, d) for name, (value, d) in reactions.items())


def _uses_by_restraints(motion: Kinematics) -> Iterator[Use]:
    for restraint in (r for group in motion.restraints.values() for r in group):
        for arm in (restraint.arm, restraint.other_arm):
            lengths = () if arm is None else arm.components
            yield from (Use(f"place of {restraint.name}", c, LENGTH) for c in lengths)
        # The terms of Σ direction · velocity = 0 have one dimension.
        if restraint.more:
            velocities = [motion.velocity_along(share) for share in restraint.shares()]
            if velocities[0]:
                one = _some_term(velocities[0])
                quotients = (velocity / one for velocity in velocities)
                yield from (Use(f"velocities at {restraint.name}", q, PURE) for q in quotients)
    for element in motion.elements:
        for closure in element.closures(motion.places):
            yield from _homogeneous(f"equation of {element.name}", closure)


def _uses_by_loads(motion: Kinematics) -> Iterator[Use]:
    """Forces and couples of loads without a potential; energies determine those of the others."""
    reactions = {r.name: r.is_couple for group in motion.restraints.values() for r in group}
    bodies = motion.system.bodies
    for load in motion.system.loads:
        if load.potential(bodies, motion.places) is not None:
            continue
        for declared in load.actions(bodies, motion.places, motion.velocities):
            action = declared.mapped(lengths_written_out)
            for symbol in action.reactions:
                known = ENERGY if reactions.get(symbol.name, False) else FORCE
                yield Use(f"reaction {symbol.name}", Expr.generator(symbol), known)
            for vector, dimension in ((action.force, FORCE), (action.couple, ENERGY)):
                for component in vector.components:
                    if not has_parts(component):
                        yield Use(f"load {load.name}", component, dimension, is_binding=False)


def _some_term(expression: Expr) -> Expr:
    """A product of powers with the dimension of an expression."""
    above, below = (
        Expr.product(next(iter(part.terms()))[0])
        for part in (expression.numerator, expression.denominator)
    )
    return above / below


def _homogeneous(role: str, expression: Expr) -> Iterator[Use]:
    """That all terms of an expression have one dimension, whichever it is."""
    if has_parts(expression):
        return
    first, *others = (Expr.product(powers) for powers, _ in expression.terms())
    yield from (Use(role, other / first, PURE) for other in others)
