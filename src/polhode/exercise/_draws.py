"""Numbers drawn from a seed, the same on every machine and with every version of Python."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from math import exp, floor, log, log10
from typing import TypeVar

Item = TypeVar("Item")


@dataclass(frozen=True)
class Draws:
    """Random numbers by name: each depends on the label and the name alone, not on the order.

    Attributes:
        label: seed and purpose.
    """

    label: str

    def about(self, purpose: object) -> Draws:
        """Draws for a narrower purpose, independent of these."""
        return Draws(f"{self.label}/{purpose}")

    def fraction(self, name: object) -> float:
        """From 0 to 1, 1 excluded; a multiple of 2⁻⁵³."""
        digest = sha256(f"{self.label}/{name}".encode()).digest()
        return (int.from_bytes(digest[:8], "big") >> 11) / 2**53

    def between(self, name: object, low: float, high: float) -> float:
        """Equally likely everywhere between two numbers."""
        return low + (high - low) * self.fraction(name)

    def scaled(self, name: object, typical: float, least: float, most: float) -> float:
        """A multiple of a typical value, its logarithm equally likely everywhere."""
        return typical * exp(self.between(name, log(least), log(most)))

    def choice(self, name: object, items: Sequence[Item]) -> Item:
        """One of several."""
        return items[floor(self.fraction(name) * len(items))]

    def shuffled(self, name: object, items: Iterable[Item]) -> tuple[Item, ...]:
        """All of them in some order."""
        keyed = [(self.fraction(f"{name}/{i}"), i, item) for i, item in enumerate(items)]
        return tuple(item for _, _, item in sorted(keyed, key=lambda entry: entry[:2]))


def rounded(value: float, figures: int = 2) -> float:
    """A number to so many significant figures."""
    if not value:
        return 0.0
    places = figures - 1 - floor(log10(abs(value)))
    return round(value, places)
