"""The angle of a point in a plane, whose sine and cosine are written with a root."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from polhode.algebra._expression import ONE, Composite, Expr, ExprLike, Rate
from polhode.algebra._residues import FieldPoint, NoResidueError, Residue
from polhode.algebra._ring import Ball, Symbol
from polhode.algebra._roots import SquareRoot, is_plainly_positive, sqrt


@dataclass(frozen=True)
class Arctangent(Composite):
    """The polar angle of the point (x, y), rad; its tangent is y/x.

    With √(x² + y²) its cosine is x, and its sine y, over that root; no other function of it is
    needed where directions are turned by it.
    """

    y: Expr
    x: Expr

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"atan({self.y.key}, {self.x.key})"

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def inside(self) -> Expr:
        return self.y / self.x

    @cached_property
    def pair(self) -> tuple[Expr, Expr]:
        """Cosine and sine."""
        size = sqrt(self.x**2 + self.y**2)
        return self.x / size, self.y / size

    def symbols(self) -> frozenset[Symbol]:
        return self.y.symbols() | self.x.symbols()

    def remade(self, inside: Expr) -> Expr:
        # the tangent alone does not tell the angle from the opposite one
        assert is_plainly_positive(self.x), f"{self.key} by its tangent"
        return atan(inside)

    def replaced(self, image: Rate) -> Expr:
        return polar_angle(self.x.replaced(image), self.y.replaced(image))

    def chain(self, rate: Rate) -> Expr:
        change = self.x * self.y.chain(rate) - self.y * self.x.chain(rate)
        return change / (self.x**2 + self.y**2)

    def ball(self, state: int) -> Ball:
        return self.inside.ball(state).atan()

    def residue(self, point: FieldPoint) -> Residue:
        raise NoResidueError(f"the angle {self.key}")


def atan(y: ExprLike, x: ExprLike = ONE) -> Expr:
    """The angle whose tangent is y/x, between −π/2 and π/2, rad; x is to be positive.

    Angles that are functions of others, such as the slope of a curve, turn frames. Equations
    contain their sines, cosines and rates only.
    """
    above, below = Expr.of(y), Expr.of(x)
    if above.is_zero:
        return above
    # of v/√(R² − v²) both parts, rather than the quotient: √(x² + y²) is then R
    quotient = above / below
    roots = [Expr.generator(g) for g in quotient.generators if isinstance(g, SquareRoot)]
    for part in (ONE, *roots):
        rest = quotient * part
        if is_plainly_positive(rest.denominator):
            return Expr.generator(Arctangent(rest.numerator, part * rest.denominator))
    return Expr.generator(Arctangent(above, below))


def polar_angle(x: ExprLike, y: ExprLike) -> Expr:
    """The angle of the point (x, y) about the origin from the first axis, rad."""
    along, across = Expr.of(x), Expr.of(y)
    if across.is_zero and is_plainly_positive(along):
        return across
    return Expr.generator(Arctangent(across, along))
