"""Lagrange's equations, the momenta and the effective potential."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    linear_parts,
    solve,
    taylor,
    with_fewer_terms,
)
from polhode.analyse import Lagrangian, lagrangian
from polhode.base import NumericError
from polhode.solution._lines import SolutionLine, inline, joined, listed
from polhode.solution._setting import LONGEST, Setting
from polhode.solution._squares import sum_of_squares


def by_lagrange(setting: Setting) -> Iterator[SolutionLine]:
    """Kinetic and potential energy, momenta, equations, and the effective potential.

    Raises:
        DeclarationError: for constraints on velocities, such as rolling.
        NumericError: for a Lagrangian too long to be printed.
    """
    found = lagrangian(setting.equations.in_lengths)
    yield from _energies(setting, found)
    yield from _momenta(found)
    yield from _equations(found)
    yield from _effective_potential(found)


def _energies(setting: Setting, found: Lagrangian) -> Iterator[SolutionLine]:
    rates = [q.derivative() for q in found.equations.coordinates]
    kinetic = sum_of_squares(found.kinetic, rates)
    potential = found.potential.latex()
    if len(kinetic) > LONGEST:
        raise NumericError(
            f"the kinetic energy of {setting.equations.system.name!r}, {len(kinetic)} characters "
            "of LaTeX",
            expected=f"a kinetic energy of at most {LONGEST} characters, to be printed",
            advice="look at derive, which prints the equations of motion",
        )
    coordinates = found.equations.coordinates
    free = f"The coordinate {inline(coordinates[0])} is not constrained"
    if len(coordinates) > 1:
        free = f"The coordinates {listed(map(inline, coordinates))} are independent"
    yield SolutionLine(
        f"{free}, so that Lagrange's equations apply. The kinetic energy is",
        f"T = {kinetic}",
        "kinetic",
    )
    lagrangian_is = "The Lagrangian is $\\mathcal L = T$, since there is no potential energy."
    if found.potential:
        yield SolutionLine("and the potential energy is", f"V = {potential}", "potential")
        lagrangian_is = "The Lagrangian is $\\mathcal L = T - V$."
    yield SolutionLine(lagrangian_is)


def momentum_letter(coordinate: Symbol) -> str:
    """LaTeX of the momentum conjugate to a coordinate."""
    return Expr.generator(Symbol(f"P_{coordinate.name}")).latex()


def _meanings(coordinates: Iterable[Symbol]) -> dict[str, str]:
    """What the letters of momenta mean whose coordinates have subscripts."""
    subscripted = [q for q in coordinates if "_" in q.name]
    return {momentum_letter(q): f"momentum conjugate to {q.published}" for q in subscripted}


def _momenta(found: Lagrangian) -> Iterator[SolutionLine]:
    conserved = found.conserved
    if not conserved:
        return
    names = listed(map(inline, conserved))
    several = len(conserved) > 1
    yield SolutionLine(
        f"It does not contain the coordinate{'s' * several} "
        f"{names}. The conjugate moment{'a are' if several else 'um is'} therefore conserved:"
    )
    for q in conserved:
        name, value = momentum_letter(q), found.momenta[q]
        rate = Expr.generator(q.derivative()).latex()
        yield SolutionLine(
            "",
            rf"{name} = \frac{{\partial\mathcal L}}{{\partial {rate}}} = {value.latex()}",
            f"momentum_{q.name}",
            bindings=_meanings([q]),
        )


def _equations(found: Lagrangian) -> Iterator[SolutionLine]:
    rest = [q for q in found.momenta if q not in found.conserved]
    for i, q in enumerate(rest):
        name = Expr.generator(q).latex()
        rate = Expr.generator(q.derivative()).latex()
        left = rf"\frac{{d}}{{dt}}\frac{{\partial\mathcal L}}{{\partial {rate}}}"
        force = found.generalised_force(q)
        right = rf"\frac{{\partial\mathcal L}}{{\partial {name}}}"
        sides = f"{left} = {right}"
        if force:
            sides = f"{left if q in found.cyclic else f'{left} - {right}'} = {force.latex()}"
        words = "" if i else _introduced(found, rest)
        yield SolutionLine(words, sides, f"lagrange_{q.name}")
        momentum, slope = found.momenta[q].dt(), found.value.diff(q)
        text = f"{momentum.latex()} = {with_fewer_terms(slope + force).latex()}"
        if len(text) <= LONGEST:
            yield SolutionLine("that is,", text, f"row_{q.name}")
        else:
            yield SolutionLine("Written out it has no short form.")


def _introduced(found: Lagrangian, rest: list[Symbol]) -> str:
    remaining = "remaining " if found.conserved else ""
    if len(rest) == 1:
        return f"The {remaining}equation is that for {inline(rest[0])}:"
    return f"The {remaining}equations are those for {listed(map(inline, rest))}:"


# -- the effective potential -----------------------------------------------------------------------


def _effective_potential(found: Lagrangian) -> Iterator[SolutionLine]:
    """The motion of the only coordinate that is not cyclic, as in one dimension."""
    rest = [q for q in found.momenta if q not in found.conserved]
    if len(rest) != 1 or not found.conserved or found.equations.power:
        return
    (q,) = rest
    reduced = _with_momenta(found, q)
    if reduced is None:
        return
    inertia, potential = reduced
    rate = Expr.generator(q.derivative())
    kinetic = inertia * rate**2 / 2
    rotation, height = potential - found.potential, found.potential
    momenta = [Symbol(f"P_{one.name}") for one in found.conserved]
    terms = [kinetic.latex(), sum_of_squares(rotation, momenta), height.latex()]
    text = f"E = {joined([t for t in terms if t != '0'])}"
    if len(text) > LONGEST:
        return
    letters = listed(f"${momentum_letter(one)}$" for one in found.conserved)
    several = len(found.conserved) > 1
    put = f"constants {letters} in place of the rates of their coordinates"
    put = put if several else f"constant {letters} in place of the rate of its coordinate"
    yield SolutionLine(
        f"Put the {put}. The energy is "
        f"then that of a motion in one dimension, and what depends on {inline(q)} alone is the "
        "effective potential:",
        text,
        "effective",
        bindings=_meanings(found.conserved),
    )


def _with_momenta(found: Lagrangian, free: Symbol) -> tuple[Expr, Expr] | None:
    """Coefficient of q̇²/2 and the rest of the energy, in terms of the conserved momenta."""
    rates = [q.derivative() for q in found.conserved]
    parts = [linear_parts(found.momenta[q], rates) for q in found.conserved]
    letters = {q: Expr.generator(Symbol(f"P_{q.name}")) for q in found.conserved}
    right = [letters[q] - rest for q, (_, rest) in zip(found.conserved, parts, strict=True)]
    try:
        values = solve([row for row, _ in parts], right)
    except (NumericError, ZeroDivisionError):
        return None
    images: Mapping[Symbol, Expr] = dict(zip(rates, values, strict=True))
    energy = (found.kinetic + found.potential).subs(images)
    rate = free.derivative()
    inertia = energy.diff(rate).diff(rate)
    rest = energy.subs({rate: ZERO})
    is_square = not (energy - taylor(energy, rate, 2)) and not energy.diff(rate).subs({rate: ZERO})
    if not is_square or any(s.kind is SymbolKind.SPEED for s in rest.symbols()):
        return None
    return inertia, rest
