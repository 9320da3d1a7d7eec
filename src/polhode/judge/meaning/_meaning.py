"""Meanings of formulas: scalars, vectors and inertia tensors, with the operations on them."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import prod
from typing import TypeAlias

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Generator,
    Matrix,
    SquareRoot,
    Symbol,
    Triad,
    Vector,
    absolute,
    factors,
    is_positive,
    sqrt,
    zero_vector,
)
from polhode.base import NumericError, ParseError


@dataclass(frozen=True)
class Tensor:
    """A linear map of vectors, such as an inertia tensor, by its matrix along a triad."""

    matrix: Matrix
    triad: Triad

    def of(self, vector: Vector) -> Vector:
        """The vector it maps a vector to."""
        return Vector(self.matrix.times(vector.express(self.triad).components), self.triad)

    def transposed(self) -> Tensor:
        """The map with rows and columns exchanged."""
        return Tensor(Matrix.of(list(zip(*self.matrix.rows, strict=True))), self.triad)


Meaning: TypeAlias = Expr | Vector | Tensor

#: The imaginary unit: its powers are reduced where real and imaginary parts are compared.
IMAGINARY = Symbol("imaginary_unit")

#: One side of a relation.
Side = Expr | Vector


class BindingError(ParseError):
    """A formula that was read but whose symbols cannot be given a meaning.

    Attributes:
        symbol: the symbol at fault, in ASCII; empty where two quantities cannot be combined.
        near: known names that resemble it.
    """

    def __init__(
        self,
        given: str,
        *,
        expected: str = "",
        advice: str = "",
        option: str = "",
        symbol: str = "",
        near: tuple[str, ...] = (),
    ) -> None:
        super().__init__(given, expected=expected, advice=advice, option=option)
        self.symbol = symbol
        self.near = near

    def __reduce__(self) -> tuple[object, ...]:
        words = {"expected": self.expected, "advice": self.advice, "option": self.option}
        return partial(type(self), **words, symbol=self.symbol, near=self.near), (self.given,)


class UnknownLetterError(BindingError):
    """A letter that has no meaning: neither in the system nor by the text."""


def plus(left: Meaning, right: Meaning) -> Meaning:
    """The sum of two scalars or two vectors; the number 0 may stand for a vector."""
    match left, right:
        case Expr(), Expr():
            return left + right
        case Vector(), Vector():
            return left + right
        case Expr(), Vector() if not left:
            return right
        case Vector(), Expr() if not right:
            return left
    raise _mismatch(left, "+", right, "look for a lost hat, arrow or dot product")


def minus(meaning: Meaning) -> Meaning:
    """The quantity with the opposite sign."""
    if isinstance(meaning, Tensor):
        return Tensor(Matrix.of([[-x for x in row] for row in meaning.matrix.rows]), meaning.triad)
    return -meaning


def times(left: Meaning, right: Meaning) -> Meaning:
    """Two quantities side by side: a product unless both are vectors."""
    match left, right:
        case Expr(), Expr():
            return left * right
        case (Expr() as factor, Vector() as vector) | (Vector() as vector, Expr() as factor):
            return vector * factor
        case Expr(), Tensor():
            return _scaled(right, left)
        case Tensor(), Expr():
            return _scaled(left, right)
        case Tensor(), Vector():
            return left.of(right)
    raise _mismatch(left, "beside", right, "write \\times or \\cdot between two vectors")


def cross(left: Meaning, right: Meaning) -> Meaning:
    """Two quantities with × between; of scalars, their product."""
    match left, right:
        case Vector(), Vector():
            return left.cross(right)
        case Expr(), Expr():
            return left * right
        case (Expr() as factor, Vector()) | (Vector(), Expr() as factor):
            # 2 × v is a product; any other scalar must be a vector that lost its hat or boldness.
            if factor.rational is None:
                raise _mismatch(left, "×", right, "look for a lost hat or arrow")
            return times(left, right)
    raise _mismatch(left, "×", right, "")


def dot(left: Meaning, right: Meaning) -> Meaning:
    """Two quantities with · between; of scalars, their product."""
    match left, right:
        case Vector(), Vector():
            return left.dot(right)
        case Tensor(), Vector():
            return left.of(right)
        case Vector(), Tensor():
            return right.transposed().of(left)
        case (Expr(), Expr()) | (Expr(), Vector()) | (Vector(), Expr()):
            return times(left, right)
    raise _mismatch(left, "·", right, "")


def over(above: Meaning, below: Meaning) -> Meaning:
    """A quotient by a scalar."""
    if not isinstance(below, Expr):
        raise _mismatch(above, "over", below, "divide by a length or a component")
    if not below:
        raise BindingError("a division by zero", advice="check the denominator")
    return times(above, below.reciprocal())


def power(base: Meaning, exponent: Meaning, root: Callable[[Expr], Expr]) -> Meaning:
    """A power; of a vector, of its length."""
    number = exponent.rational if isinstance(exponent, Expr) else None
    if number is None or number.denominator > 2 or abs(number) > _HIGHEST:
        raise BindingError(
            "a power whose exponent is not a number",
            expected=f"a whole or half number up to {_HIGHEST}",
        )
    if isinstance(base, Tensor):
        raise _mismatch(base, "to the power", exponent, "")
    if number.denominator == 2:
        return root(as_scalar(base, "the base of a power")) ** number.numerator
    if isinstance(base, Vector):
        square = base.dot(base)
        half = Fraction(number, 2)
        return square**half.numerator if half.denominator == 1 else root(square) ** int(number)
    if not base and number < 0:
        raise BindingError("a negative power of zero", advice="check the denominator")
    return base**number


_HIGHEST = 20  # exponents beyond this are hardly meant, and expand into too many terms


def as_scalar(meaning: Meaning, what: str) -> Expr:
    """A meaning that has to be a scalar."""
    if not isinstance(meaning, Expr):
        raise BindingError(f"a {sort(meaning)} for {what}", expected="a scalar")
    return meaning


def as_vector(meaning: Meaning, what: str) -> Vector:
    """A meaning that has to be a vector."""
    if not isinstance(meaning, Vector):
        raise BindingError(f"a {sort(meaning)} for {what}", expected="a vector")
    return meaning


def rate(meaning: Meaning) -> Meaning:
    """Time derivative, of a vector in inertial space."""
    if isinstance(meaning, Tensor):
        raise BindingError("the time derivative of a tensor", expected="a scalar or a vector")
    return meaning.dt()


def sort(meaning: Meaning) -> str:
    """The kind of a quantity in one word."""
    return {Expr: "scalar", Vector: "vector", Tensor: "tensor"}[type(meaning)]


def positive_root(radicand: Expr, positive: Collection[Expr]) -> Expr:
    """The square root, simplified by the known signs of some quantities."""
    try:
        return with_signs(sqrt(radicand), positive)
    except NumericError as error:
        raise BindingError(
            error.given, expected=error.expected, advice=error.advice, option=error.option
        ) from None


def complex_parts(side: Expr) -> tuple[Expr, Expr]:
    """The real and the imaginary part of a polynomial in the imaginary unit."""
    inside = (g for g in side.generators if g != IMAGINARY)
    if IMAGINARY in side.denominator.symbols() or any(IMAGINARY in g.symbols() for g in inside):
        raise ParseError(
            "the imaginary unit below a fraction line or inside of a function",
            expected="sums and products of real quantities with it",
        )
    parts, unit = [ZERO, ZERO], Expr.generator(IMAGINARY)
    rest, power = side, 0
    while rest:
        coefficient = rest.subs({IMAGINARY: ZERO})
        parts[power % 2] += -coefficient if power % 4 > 1 else coefficient
        rest, power = (rest - coefficient) / unit, power + 1
    return parts[0], parts[1]


def positive_size(x: Expr, positive: Collection[Expr]) -> Expr:
    """The magnitude, simplified by the known signs of some quantities."""
    return with_signs(absolute(x), positive)


def signed(meaning: Meaning, positive: Collection[Expr]) -> Meaning:
    """A scalar or vector simplified by the known signs of some quantities."""
    match meaning:
        case Expr():
            return with_signs(meaning, positive)
        case Vector(components, triad):
            return Vector(tuple(with_signs(c, positive) for c in components), triad)
    return meaning


def with_signs(x: Expr, positive: Collection[Expr]) -> Expr:
    """The expression with |f| replaced by f, and √(f h) by √f √h, for every f known as positive."""
    known: dict[Generator, Expr] = {}
    for generator in x.generators:
        if isinstance(generator, SquareRoot):
            image = _with_sign(generator, positive)
            known |= {} if image is None else {generator: image}
    return x.recast(known) if known else x


def _with_sign(root: SquareRoot, positive: Collection[Expr]) -> Expr | None:
    if root.plain is not None:  # the f of |f|
        either = (root.plain, -root.plain)
        known = (ONE, *filter(None, positive))
        return next((f for f in either if any(is_positive(f / each) for each in known)), None)
    powers = factors(root.radicand)[1]
    taken = {f: power for f, power in powers.items() if f in positive}
    if not taken or len(powers) == 1:
        return None
    rest = root.radicand / prod((f**power for f, power in taken.items()), start=ONE)
    return prod((sqrt(f) ** power for f, power in taken.items()), start=sqrt(rest))


def alike(one: Meaning, other: Meaning) -> bool:
    """Whether two meanings are the same quantity, exactly."""
    match one, other:
        case Expr(), Expr():
            return one == other
        case Vector(), Vector():
            return (one - other).is_zero
        case Tensor(), Tensor() if one.triad == other.triad:
            return one.matrix == other.matrix
    return False


def zero_like(meaning: Meaning) -> Meaning:
    """The zero that goes with a scalar or a vector."""
    return zero_vector(meaning.triad) if isinstance(meaning, Vector) else Expr.of(0)


def _scaled(tensor: Tensor, factor: Expr) -> Tensor:
    return Tensor(
        Matrix.of([[x * factor for x in row] for row in tensor.matrix.rows]), tensor.triad
    )


def _mismatch(left: Meaning, sign: str, right: Meaning, advice: str) -> BindingError:
    return BindingError(
        f"a {sort(left)} {sign} a {sort(right)}",
        expected="quantities that can be combined",
        advice=advice,
    )
