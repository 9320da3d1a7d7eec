"""Polynomials with some of their generators replaced by expressions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from math import prod

from polhode.algebra._expression import Expr, total
from polhode.algebra._generators import Generator
from polhode.algebra._ring import ring_of


def substituted(polynomial: Expr, images: Mapping[Generator, Expr]) -> Expr:
    """A polynomial with generators replaced by their images; those without one stay as they are."""
    used = polynomial.generators
    kept = ring_of(frozenset(used).difference(images))
    ring, changed = polynomial.ring, tuple(g for g in used if g in images)
    if not changed:
        return polynomial
    positions = [ring.index[generator] for generator in changed]
    products = _Products(changed, images)
    terms = []
    for powers, part in ring.grouped(polynomial.num, positions).items():
        product = products(powers)
        if product is not None:
            terms.append(product * Expr(kept, part.project_to_context(kept.context), kept.one))
    return total(terms)


class _Products:
    """Products of powers of images, none of which is raised to the same power twice."""

    def __init__(self, changed: Iterable[Generator], images: Mapping[Generator, Expr]) -> None:
        self._images = [images[generator] for generator in changed]
        self._vanishing = [image.num == 0 for image in self._images]
        self._known: dict[tuple[int, int], Expr] = {}

    def __call__(self, powers: tuple[int, ...]) -> Expr | None:
        """The product with these powers; None where one of its factors is zero."""
        if any(power and zero for power, zero in zip(powers, self._vanishing, strict=True)):
            return None
        return prod(self._factors(powers), start=Expr.constant(1))

    def _factors(self, powers: tuple[int, ...]) -> Iterator[Expr]:
        for place, power in enumerate(powers):
            if power:
                key = place, int(power)
                if key not in self._known:
                    self._known[key] = self._images[place] ** int(power)
                yield self._known[key]
