"""Units of measure, and the table of those that have a name."""

from dataclasses import dataclass
from fractions import Fraction

from polhode.base._dimension import LENGTH, MASS, PURE, TIME, Dimension


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure: ``coefficient * pi**pi_power`` times the SI unit of `dimension`."""

    coefficient: Fraction = Fraction(1)
    pi_power: int = 0
    dimension: Dimension = PURE

    def __mul__(self, other: "Unit") -> "Unit":
        return Unit(
            self.coefficient * other.coefficient,
            self.pi_power + other.pi_power,
            self.dimension * other.dimension,
        )

    def __pow__(self, exponent: int) -> "Unit":
        return Unit(self.coefficient**exponent, self.pi_power * exponent, self.dimension**exponent)


PREFIXES = {
    "n": Fraction(1, 10**9),
    "u": Fraction(1, 10**6),
    "µ": Fraction(1, 10**6),  # the micro sign
    "μ": Fraction(1, 10**6),  # the Greek letter
    "m": Fraction(1, 10**3),
    "k": Fraction(10**3),
    "M": Fraction(10**6),
    "G": Fraction(10**9),
}

_FORCE = MASS * LENGTH / TIME**2

PREFIXED = {
    "m": Unit(dimension=LENGTH),
    "g": Unit(Fraction(1, 1000), dimension=MASS),
    "s": Unit(dimension=TIME),
    "rad": Unit(),
    "Hz": Unit(dimension=TIME**-1),
    "N": Unit(dimension=_FORCE),
    "J": Unit(dimension=_FORCE * LENGTH),
    "W": Unit(dimension=_FORCE * LENGTH / TIME),
    "Pa": Unit(dimension=_FORCE / LENGTH**2),
}

PLAIN = {
    "cm": Unit(Fraction(1, 100), dimension=LENGTH),
    "in": Unit(Fraction(127, 5000), dimension=LENGTH),
    "ft": Unit(Fraction(381, 1250), dimension=LENGTH),
    "min": Unit(Fraction(60), dimension=TIME),
    "h": Unit(Fraction(3600), dimension=TIME),
    "day": Unit(Fraction(86400), dimension=TIME),
    "deg": Unit(Fraction(1, 180), 1),
    "°": Unit(Fraction(1, 180), 1),
    "rev": Unit(Fraction(2), 1),
    "turn": Unit(Fraction(2), 1),
    "rpm": Unit(Fraction(1, 30), 1, TIME**-1),
}

UNITS: dict[str, Unit] = {
    prefix + name: Unit(factor * unit.coefficient, unit.pi_power, unit.dimension)
    for name, unit in PREFIXED.items()
    for prefix, factor in {"": Fraction(1), **PREFIXES}.items()
} | PLAIN
"""Every name, prefixes included."""
