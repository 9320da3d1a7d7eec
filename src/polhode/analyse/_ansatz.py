"""Search for integrals polynomial in the speeds, with trigonometric coefficients.

The unknown coefficients solve a linear system. It is first solved at random parameters and states
in a prime field, which shows the few monomials that matter; for those it is solved exactly, with
the parameters as symbols.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, combinations_with_replacement
from math import prod

from flint import nmod_mat

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Generator,
    Row,
    Symbol,
    SymbolKind,
    cos,
    dependent_columns,
    dot,
    eliminate,
    length,
    sin,
    time,
    variables,
)
from polhode.analyse._finite_field import points
from polhode.analyse._reduced import reduced
from polhode.base import NumericError
from polhode.derive import Equations

#: Points beyond the number of unknowns: a coincidence at random would have to occur at each.
_SPARE, _SEED = 4, 7


@dataclass(frozen=True)
class Ansatz:
    """The class of expressions searched for first integrals.

    Attributes:
        speeds: highest degree in the speeds.
        trigonometric: highest degree in sines and cosines of angles.
        lengths: highest degree in coordinates that stand outside sines and cosines.
    """

    speeds: int = 2
    trigonometric: int = 2
    lengths: int = 2

    def describe(self) -> str:
        """The ansatz in words."""
        return (
            f"polynomials of degree {self.speeds} in the speeds and {self.trigonometric} in sines "
            f"and cosines of essential angles; of degree {self.speeds} in the speeds and "
            f"{self.lengths} in essential coordinates outside sines and cosines, {self.together} "
            f"together; these coordinates over square roots that occur in the equations; and time"
        )

    @property
    def together(self) -> int:
        """Highest degree in speeds and such coordinates together."""
        return min(self.speeds + self.lengths, 1 + max(self.speeds, self.lengths))


#: A product of factors, each by its position, in ascending order.
Monomial = tuple[int, ...]


@dataclass(frozen=True)
class AnsatzTerms:
    """Monomials that an integral may be a sum of.

    Attributes:
        factors: what they are products of.
        monomials: all of them, simple ones first.
    """

    factors: tuple[Expr, ...]
    monomials: tuple[Monomial, ...]

    def expression(self, monomial: Monomial) -> Expr:
        """A monomial as an expression."""
        return prod((self.factors[i] for i in monomial), start=ONE)


def search(equations: Equations, ansatz: Ansatz) -> Iterator[Expr]:
    """Integrals within the ansatz, simple ones first; none for driven systems."""
    if not is_searched(equations):
        return
    terms = _terms(equations, reduced(equations).essential, ansatz)
    for support in _supports(equations, terms):
        chosen = [terms.expression(terms.monomials[i]) for i in support]
        coefficients = _coefficients([equations.rate(m) for m in chosen])
        if coefficients is not None:
            yield sum((c * m for c, m in zip(coefficients, chosen, strict=True)), ZERO)


def is_searched(equations: Equations) -> bool:
    """Whether the ansatz suits the equations: they must not depend on time explicitly."""
    try:
        reduced(equations)
    except NumericError:
        return False
    return True


def _terms(equations: Equations, essential: tuple[Symbol, ...], ansatz: Ansatz) -> AnsatzTerms:
    """The monomials of an ansatz for these equations."""
    factors: dict[Expr, int] = {}

    def place(factor: Expr) -> Monomial:
        return (factors.setdefault(factor, len(factors)),)

    angles = [q for q in essential if _is_angle(equations, q)]
    lengths = [q for q in equations.coordinates if not _is_angle(equations, q)]
    speeds = [place(Expr.generator(u)) for u in equations.speeds]
    in_angles = [_joined(*map(place, w)) for w in _sines(angles, ansatz.trigonometric)]
    in_speeds = _products(speeds, ansatz.speeds)
    found = dict.fromkeys(_joined(u, w) for u in in_speeds for w in in_angles)
    found |= dict.fromkeys(
        _products([place(Expr.generator(q)) for q in lengths], ansatz.lengths and 1)
    )
    found[place(time)] = None
    # Symbols and functions that occur in the equations of motion.
    entries = (*equations.mass.entries, *equations.forcing, *equations.kinematics.values())
    used = list(dict.fromkeys(g for e in entries for g in e.generators))
    plain = [place(Expr.generator(q)) for q in essential if q in used]
    pairs = (_joined(u, x) for x in _products(plain, ansatz.lengths) for u in in_speeds)
    found |= dict.fromkeys(m for m in pairs if len(m) <= ansatz.together)
    if ansatz.lengths:
        roots = []
        for generator in used:
            is_root = bool(generator.depth) and generator.partner() is None
            symbols = {s for s in generator.symbols() if s.kind.varies}
            if is_root and symbols and symbols <= set(essential):
                roots.append(Expr.generator(generator))
        found |= dict.fromkeys(map(place, roots))
        inverse = [place(1 / root) for root in roots]
        found |= dict.fromkeys(_joined(r, x) for r in inverse for x in _products(plain, 1))
    found.pop((), None)
    return AnsatzTerms(tuple(factors), tuple(found))


def _joined(*monomials: Monomial) -> Monomial:
    return tuple(sorted(chain.from_iterable(monomials)))


def _sines(angles: Sequence[Symbol], degree: int) -> list[list[Expr]]:
    """Products of sines and cosines, by their factors; cos² is left out, being 1 - sin²."""
    found: dict[int, list[list[Expr]]] = {0: [[]]}
    for angle in angles:
        s, c = sin(Expr.generator(angle)), cos(Expr.generator(angle))
        own = [(j + i, [s] * j + [c] * i) for i in (0, 1) for j in range(degree + 1 - i)]
        wider: dict[int, list[list[Expr]]] = {}
        for power, products in found.items():
            for extra, factors in own:
                if power + extra <= degree:
                    wider.setdefault(power + extra, []).extend(p + factors for p in products)
        found = wider
    return [product for products in found.values() for product in products]


def _products(factors: Sequence[Monomial], degree: int) -> list[Monomial]:
    sizes = range(degree + 1)
    return [_joined(*m) for n in sizes for m in combinations_with_replacement(factors, n)]


def _is_angle(equations: Equations, coordinate: Symbol) -> bool:
    return str(equations.dimensions.get(coordinate, "")) == "1"


def _supports(equations: Equations, terms: AnsatzTerms) -> Iterator[list[int]]:
    """Positions of the monomials in each independent solution, at random parameters.

    Σ cⱼ dmⱼ/dt = 0 must hold at every state. Each random state gives one row of a table over a
    prime field: the rates of all monomials there. Its null space is that of the integrals at these
    parameters; no expression has to be multiplied out for it.
    """
    import numpy as np

    rates = [equations.rate(factor) for factor in terms.factors]
    needed = (*terms.factors, *rates)
    varying = [s for s in variables(needed) if s.kind is not SymbolKind.PARAMETER]
    width = len(terms.monomials)
    sample = points(needed, varying, width + _SPARE, _SEED)
    prime = sample[0].field.prime
    longest = max(map(len, terms.monomials), default=0)
    one = len(terms.factors)  # position of a factor 1, which pads short monomials
    table = np.array([[*m, *[one] * (longest - len(m))] for m in terms.monomials])
    rows = []
    for point in sample:
        values = np.array([*point.all(terms.factors), 1])[table]
        changes = np.array([*point.all(rates), 0])[table]
        product, change = np.ones(width, dtype=np.int64), np.zeros(width, dtype=np.int64)
        for value, factor_change in zip(values.T, changes.T, strict=True):  # the product rule
            change = (change * value % prime + product * factor_change % prime) % prime
            product = product * value % prime
        rows.extend(change.tolist())
    echelon, rank = nmod_mat(len(sample), width, rows, prime).rref()
    columns = range(width)
    # in reduced echelon form each free column gives one null vector, on it and on pivot columns
    pivots = [next(j for j in columns if int(echelon[i, j])) for i in range(rank)]
    for free in (j for j in columns if j not in pivots):
        used = [pivots[i] for i in range(rank) if int(echelon[i, free])]
        yield sorted([*used, free])


def _is_constant(generator: Generator) -> bool:
    return all(s.kind is SymbolKind.PARAMETER for s in generator.symbols())


def _coefficients(rates: Sequence[Expr]) -> Row | None:
    """Coefficients c of the parameters alone with Σ c · rate = 0; None if not unique.

    Terms that differ in a generator that varies are independent: each gives one linear equation.
    """
    common = ONE
    for rate in rates:
        if (common / rate.denominator).denominator != ONE:
            common = common * rate.denominator
    table: dict[frozenset[tuple[Generator, int]], list[Expr]] = defaultdict(
        lambda: [ZERO] * len(rates)
    )
    for column, rate in enumerate(rates):
        scaled = rate * common
        ring = scaled.ring
        varying = [g for g in ring.generators if not _is_constant(g)]
        parts = ring.grouped(scaled.num, [ring.index[g] for g in varying])
        for powers, part in parts.items():
            key = frozenset((g, p) for g, p in zip(varying, powers, strict=True) if p)
            table[key][column] = Expr(ring, part, ring.one)
    rows = list(dict.fromkeys(map(tuple, table.values())))
    values = _null_vector(_independent(rows), len(rates))
    if values is None or any(dot(row, values) for row in rows):
        values = _null_vector(rows, len(rates))
    if values is None:
        return None
    scale = ONE
    for value in values:
        scale = scale * (value * scale).denominator
    return tuple(value * scale for value in values)


def _null_vector(rows: Sequence[Row], width: int) -> list[Expr] | None:
    """The only solution of homogeneous equations, up to a factor; None where it is not the only."""
    outcome = eliminate(rows, [ZERO] * len(rows), [0] * width)
    if len(outcome.free) != 1:
        return None
    (free,) = outcome.free
    return [ONE if j == free else outcome.solved[j][0][0] for j in range(width)]


def _independent(rows: Sequence[Row]) -> list[Row]:
    """As many short rows as there are independent ones, at random values of the parameters."""
    ordered = sorted(rows, key=lambda row: sum(map(length, row)))
    spare = frozenset(dependent_columns(list(zip(*ordered, strict=True))))
    return [row for i, row in enumerate(ordered) if i not in spare]
