"""Normal modes of small oscillations: their equation, their frequencies and their shapes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from polhode.algebra import ONE, ZERO, Expr, Symbol, factors, is_positive
from polhode.analyse import Stability, SteadyMotion, Truth, lagrangian
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.judge import Answer, Verdict
from polhode.solution._judge import if_true, judged
from polhode.solution._letters import free_letter
from polhode.solution._lines import (
    SolutionLine,
    bracketed,
    fraction,
    inline,
    is_sum,
    joined,
    listed,
    negative_multiple,
    root_latex,
)
from polhode.solution._setting import LONGEST, WIDEST

_Rows = Sequence[Sequence[Expr]]
_NUMBERS = {2: "two", 3: "three", 4: "four"}


@dataclass(frozen=True)
class Oscillations:
    """The linear equations of oscillations about an equilibrium, as they are displayed.

    Attributes:
        family: the equilibrium, as `steady` gives it.
        stability: of it.
        rows: expressions that vanish to first order.
        letters: of the departures in them.
        let: definitions of those letters that are no coordinates.
    """

    family: SteadyMotion
    stability: Stability
    rows: tuple[Expr, ...]
    letters: tuple[Expr, ...]
    let: tuple[str, ...]

    @property
    def equations(self) -> Equations:
        """Of the system."""
        return self.family.reduced.equations

    @property
    def small(self) -> tuple[str, ...]:
        """What is small in claims about them."""
        return tuple(f"{letter}:1" for letter in self.letters)


def normal_modes(about: Oscillations) -> Iterator[SolutionLine]:
    """Two or more oscillations about an equilibrium that may be stable."""
    found = about.stability
    size = len(about.letters)
    if found.truth is Truth.NEVER or not found.is_even or size not in _NUMBERS:
        return
    omega = Expr.generator(free_letter(about.equations, "omega", "Omega", "nu"))
    matrix = _oscillating(about, omega)
    if len(matrix) != size or len(found.oscillating) != 2 * size + 1:
        return
    if all(sum(map(bool, row)) == 1 for row in matrix):
        yield from _apart(about, matrix, omega)
        return
    determinant = _determinant(matrix)
    if not _agree(determinant, omega, found):
        return
    shapes = tuple(_shapes(about, matrix, omega))
    yield from _together(about, determinant, omega, bool(shapes))
    yield from shapes


def by_potential(family: SteadyMotion) -> Truth:
    """Whether the potential energy is least at an equilibrium; open where its signs are open.

    Nothing but the loads and the inertia may act: neither friction nor supports that move. It says
    nothing of steady motions with a speed that is not zero, which rotation may keep stable.
    """
    equations = family.reduced.equations
    if any(family.fixed.get(speed) != ZERO for speed in family.reduced.speeds):
        return Truth.OPEN
    try:
        found = lagrangian(equations)
    except PolhodeError:
        return Truth.OPEN
    rates = {q.derivative(): ZERO for q in equations.coordinates}
    moving = (found.kinetic, *(found.kinetic.diff(rate) for rate in rates))
    pushed = map(found.generalised_force, equations.coordinates)  # also by forces that do no work
    if any(pushed) or any(term.subs(rates) for term in moving):
        return Truth.OPEN
    essential = family.reduced.essential
    slopes = [found.potential.diff(q) for q in essential]
    bends = [[slope.diff(q).subs(family.fixed) for q in essential] for slope in slopes]
    if any(is_positive(-row[i]) for i, row in enumerate(bends)):
        return Truth.NEVER
    minors = (_determinant([row[:n] for row in bends[:n]]) for n in range(1, len(bends) + 1))
    return Truth.ALWAYS if all(map(is_positive, minors)) else Truth.OPEN


def _oscillating(about: Oscillations, omega: Expr) -> _Rows:
    """The coefficients of the letters once every one varies as cos ωt; empty with damping."""
    bends = {x.dt().dt().symbol: -(omega**2) * x for x in about.letters}
    put_in = [row.subs({s: v for s, v in bends.items() if s is not None}) for row in about.rows]
    matrix = [[row.diff(x.symbol) for x in about.letters if x.symbol] for row in put_in]
    for row, line in zip(put_in, matrix, strict=True):
        if row != sum((c * x for c, x in zip(line, about.letters, strict=True)), ZERO):
            return ()
    return matrix


def _determinant(matrix: _Rows) -> Expr:
    if len(matrix) == 1:
        return matrix[0][0]
    found = ZERO
    for i, value in enumerate(matrix[0]):
        below = [[*row[:i], *row[i + 1 :]] for row in matrix[1:]]
        found = found + value * (-ONE) ** i * _determinant(below)
    return found


def _agree(determinant: Expr, omega: Expr, found: Stability) -> bool:
    """Whether the determinant is the characteristic polynomial, which is found in another way."""
    pairs = enumerate(found.oscillating[::2])
    polynomial = sum((c * (-(omega**2)) ** i for i, c in pairs), ZERO)
    if omega.symbol is None or not polynomial:
        return False
    return omega.symbol not in (determinant / polynomial).symbols()


def _apart(about: Oscillations, matrix: _Rows, omega: Expr) -> Iterator[SolutionLine]:
    """Departures that do not influence one another."""
    words, claims = [], []
    for row in matrix:
        ((letter, entry),) = ((x, c) for x, c in zip(about.letters, row, strict=True) if c)
        square = _square(entry, omega)
        words.append(f"{inline(letter)} at the angular frequency ${root_latex(square)}$")
        text = rf"{letter.dt().dt().latex()} \approx {negative_multiple(square, letter)}"
        claims.append(SolutionLine("", text, context="limit", let=about.let, small=about.small))
    stated = tuple(if_true(claims, about.equations))
    if stated:
        yield SolutionLine(
            f"They do not influence one another, and oscillate: {listed(words)}.", stated=stated
        )


def _square(entry: Expr, omega: Expr) -> Expr:
    """ω² where a ω² + b vanishes."""
    slope = (entry - entry.subs({omega.symbol: ZERO})) / omega**2 if omega.symbol else ONE
    return (slope * omega**2 - entry) / slope


def _together(
    about: Oscillations, determinant: Expr, omega: Expr, shown: bool
) -> Iterator[SolutionLine]:
    """The characteristic equation and, where there are two modes, its roots.

    They need not be judged where the shapes of the modes, which oscillate with them, were.
    """
    _, powers = factors(determinant)
    for factor, power in powers.items():
        if omega.symbol not in factor.symbols():
            determinant = determinant / factor**power
    size = len(about.letters)
    text = f"{_by_powers(determinant, omega, 2 * size)} = 0"
    if len(text) > LONGEST:
        return
    first = about.letters[0]
    yield SolutionLine(
        f"In a normal mode all departures vary as $\\cos({omega.latex()} t)$, so that "
        f"${first.dt().dt().latex()} = {(-(omega**2) * first).latex()}$ and likewise for the "
        f"other{'s' * (size > 2)}. The equations then have a solution other than zero if their "
        "determinant vanishes:",
        text,
        "modes",
        "steady",
        verdict=Verdict(Answer.HOLDS, "steady"),
    )
    if size != 2:
        yield SolutionLine(
            f"Its {_NUMBERS[size]} roots ${omega.latex()}^2$, of which there is no short form, are "
            "the squares of the angular frequencies."
        )
        return
    words = "The squares of the angular frequencies of the two modes are its roots,"
    yield from _roots(about, words, omega, {}, shown)
    alike = _alike(about)
    if alike:
        equal = listed(f"${Expr.generator(a).latex()} = {b.latex()}$" for a, b in alike.items())
        yield from _roots(about, f"With {equal} these are", omega, alike, False)


def _by_powers(polynomial: Expr, letter: Expr, degree: int) -> str:
    """A polynomial from its highest power down, beginning without a sign."""
    coefficients, rest = list[Expr](), polynomial
    for _ in range(degree + 1):
        coefficients.append(rest.subs({letter.symbol: ZERO}) if letter.symbol else rest)
        rest = (rest - coefficients[-1]) / letter
    sign = -1 if coefficients[-1].latex().startswith("-") else 1
    terms = [
        f"{bracketed(text) if is_sum(text) and power else text} "
        f"{(letter**power).latex() if power else ''}".strip()
        for power, c in enumerate(coefficients)
        if c and (text := (c * sign).latex())
    ]
    return joined(terms[::-1])


def _alike(about: Oscillations) -> dict[Symbol, Expr]:
    """Parameters with the same letter and other subscripts, as masses m₁ and m₂, made equal."""
    known = {s for rate in about.stability.frequencies for s in rate.symbols()}
    named = sorted((s for s in known if "_" in s.published), key=lambda s: s.published)
    found = dict[Symbol, Expr]()
    for one, other in combinations(named, 2):
        if one.name.split("_")[0] == other.name.split("_")[0] and one not in found:
            found.setdefault(other, Expr.generator(one))
    return found


def _roots(
    about: Oscillations, words: str, omega: Expr, alike: dict[Symbol, Expr], shown: bool
) -> Iterator[SolutionLine]:
    """Both roots in one formula with ∓, or in two."""
    values = [(rate**2).subs(alike) for rate in about.stability.frequencies]
    if len(values) != 2:
        return
    squares = [fraction(value) for value in values]
    if not _with_both_signs(*squares):
        squares = [value.latex() for value in values]
    names = [f"{omega.latex()}_{i}" for i in (1, 2)]
    each = [f"{name}^2 = {square}" for name, square in zip(names, squares, strict=True)]
    place = str(about.family)
    line = SolutionLine(
        words,
        r", \qquad ".join(each),
        context="identity",
        given=tuple(f"{s.published} = {v}" for s, v in alike.items()),
        bindings={
            name: f"{which} frequency of small oscillations about {place}"
            for name, which in zip(names, ("first", "second"), strict=True)
        },
    )
    if max(map(len, squares)) > LONGEST / 2:
        return
    try:
        verdict = Verdict(Answer.HOLDS, "steady") if shown else judged(line, about.equations)
    except NumericError:
        return
    pair = _with_both_signs(*squares)
    text = f"{omega.latex()}_{{1,2}}^2 = {pair}" if pair else line.latex
    yield replace(line, latex=text, context="steady", verdict=verdict)


def _with_both_signs(lower: str, upper: str) -> str:
    r"""Two formulas that differ in signs only as one with ∓; empty if they differ otherwise."""
    signs = {("-", "+"): r"\mp", ("+", "-"): r"\pm"}
    if len(lower) != len(upper):
        return ""
    found = ""
    for pair in zip(lower, upper, strict=True):
        if pair[0] != pair[1] and pair not in signs:
            return ""
        found += signs.get(pair, pair[0])
    return re.sub(r"(\\[mp]{2})(?=\w)", r"\1 ", found)


def _shapes(about: Oscillations, matrix: _Rows, omega: Expr) -> Iterator[SolutionLine]:
    """The ratio of the two departures in each mode."""
    rates = about.stability.frequencies
    if len(about.letters) != 2 or len(rates) != 2:
        return
    one, other = about.letters
    words, claims = [], []
    for which, rate in zip(("first", "second"), rates, strict=True):
        images = {omega.symbol: rate} if omega.symbol else {}
        left, right = next(((a, b) for a, b in matrix if b), (ZERO, ONE))
        ratio = -left.subs(images) / right.subs(images)
        shape = f"{other.latex()} = {fraction(ratio * one)}"
        if len(shape) > WIDEST / 3:
            return
        words.append(f"in the {which} mode ${shape}$")
        claims += [
            SolutionLine(
                "",
                rf"{x.dt().dt().latex()} \approx {negative_multiple(rate**2, x)}",
                context="limit",
                let=about.let,
                small=about.small,
                given=(f"{other} = {ratio * one}",),
            )
            for x in (one, other)
        ]
    stated = tuple(if_true(claims, about.equations))
    if stated:
        start = listed(words)
        yield SolutionLine(f"{start[0].upper()}{start[1:]}.", stated=stated)
