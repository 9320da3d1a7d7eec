"""Dimension: the powers of mass, length and time in a quantity."""

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True, slots=True)
class Dimension:
    """Exponents of mass, length and time; angles have none.

    Prints as the SI unit of that dimension: ``kg m^2/s^2``, and ``1`` for a pure number.
    """

    mass: Fraction = Fraction(0)
    length: Fraction = Fraction(0)
    time: Fraction = Fraction(0)

    def __mul__(self, other: "Dimension") -> "Dimension":
        return Dimension(self.mass + other.mass, self.length + other.length, self.time + other.time)

    def __truediv__(self, other: "Dimension") -> "Dimension":
        return self * other**-1

    def __pow__(self, exponent: int | Fraction) -> "Dimension":
        return Dimension(self.mass * exponent, self.length * exponent, self.time * exponent)

    def __str__(self) -> str:
        powers = (("kg", self.mass), ("m", self.length), ("s", self.time))
        above = [_power(unit, exponent) for unit, exponent in powers if exponent > 0]
        below = [_power(unit, -exponent) for unit, exponent in powers if exponent < 0]
        return " ".join(above or ["1"]) + _divisor(below)


def _divisor(factors: list[str]) -> str:
    if len(factors) > 1:
        return f"/({' '.join(factors)})"
    return "".join(f"/{factor}" for factor in factors)


def _power(unit: str, exponent: Fraction) -> str:
    if exponent == 1:
        return unit
    return f"{unit}^{exponent}" if exponent.denominator == 1 else f"{unit}^({exponent})"


PURE = Dimension()
MASS = Dimension(mass=Fraction(1))
LENGTH = Dimension(length=Fraction(1))
TIME = Dimension(time=Fraction(1))
