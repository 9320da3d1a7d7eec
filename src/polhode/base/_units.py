"""Dimensions, the table of units, and compound units such as ``kg m^2/s``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from polhode.base._errors import UnitError, did_you_mean


@dataclass(frozen=True, slots=True)
class Dimension:
    """Exponents of mass, length and time; angles have none.

    Prints as the SI unit of that dimension: ``kg m^2/s^2``, and ``1`` for a pure number.
    """

    mass: Fraction = Fraction(0)
    length: Fraction = Fraction(0)
    time: Fraction = Fraction(0)

    def __mul__(self, other: Dimension) -> Dimension:
        return Dimension(self.mass + other.mass, self.length + other.length, self.time + other.time)

    def __truediv__(self, other: Dimension) -> Dimension:
        return self * other**-1

    def __pow__(self, exponent: int | Fraction) -> Dimension:
        return Dimension(self.mass * exponent, self.length * exponent, self.time * exponent)

    def __str__(self) -> str:
        powers = (("kg", self.mass), ("m", self.length), ("s", self.time))
        above = [_power(unit, exponent) for unit, exponent in powers if exponent > 0]
        below = [_power(unit, -exponent) for unit, exponent in powers if exponent < 0]
        if len(below) > 1:
            below = [f"({' '.join(below)})"]
        return "/".join([" ".join(above or ["1"]), *below])

    @property
    def unit(self) -> str:
        """The SI unit as it is usually called: N/m for a stiffness, N s/m for a damping."""
        return _CALLED.get(self, str(self))


def _power(unit: str, exponent: Fraction) -> str:
    if exponent == 1:
        return unit
    return f"{unit}^{exponent}" if exponent.denominator == 1 else f"{unit}^({exponent})"


PURE = Dimension()
MASS = Dimension(mass=Fraction(1))
LENGTH = Dimension(length=Fraction(1))
TIME = Dimension(time=Fraction(1))

_FORCE = MASS * LENGTH / TIME**2
_CALLED = {
    _FORCE: "N",
    _FORCE * LENGTH: "N m",
    _FORCE / LENGTH: "N/m",
    _FORCE * TIME / LENGTH: "N s/m",
    _FORCE * LENGTH * TIME: "N m s",
    _FORCE * LENGTH / TIME: "W",
}


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of measure: ``coefficient * pi**pi_power`` times the SI unit of `dimension`."""

    coefficient: Fraction = Fraction(1)
    pi_power: int = 0
    dimension: Dimension = PURE

    def __mul__(self, other: Unit) -> Unit:
        return Unit(
            self.coefficient * other.coefficient,
            self.pi_power + other.pi_power,
            self.dimension * other.dimension,
        )

    def __pow__(self, exponent: int) -> Unit:
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
"""All unit names, with prefixes."""


# -- compound units as people write them -----------------------------------------------------------


def read_unit(text: str) -> Unit:
    """Read a unit: names, perhaps with a whole exponent, joined by ``*``, a space or ``/``.

    Brackets group, as in ``kg/(m s^2)``. ``/`` divides by the next factor only, so ``N/m s`` is
    ``(N/m) s``. ``Hz`` is one per second, not one turn per second: write ``rev/s`` or ``rpm`` for
    angular velocities.

    Raises:
        UnitError: for a name the table does not have, or text that is not a unit.
    """
    if len(text) > _LONGEST:
        raise _malformed(f"{text[:20]}...")
    return _UnitParser(text).unit()


_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_TOKEN = re.compile(
    r"""\s*(?:
        (?:\^|\*\*)\s*(?P<power>[+-]?\d{1,2})(?!\d)
      | (?P<superscript>⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,2})
      | (?P<name>1(?=\s*/)|°|[^\W\d_⁰¹²³⁴⁵⁶⁷⁸⁹]+)
      | (?P<mark>[*·⋅×/()])
    )\s*""",
    re.VERBOSE,
)
_LONGEST = 100


class _UnitParser:
    """Recursive descent over the tokens of one unit."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._tokens = [*self._scanned(), ("end", "")]
        self._next = 0

    def unit(self) -> Unit:
        """The whole text."""
        unit = self._product()
        if self._kind != "end":
            raise _malformed(self._text)
        return unit

    def _product(self) -> Unit:
        unit = Unit() if self._symbol == "/" else self._factor()
        while self._kind != "end" and self._symbol != ")":
            divides = self._symbol == "/"
            if self._kind == "mark" and self._symbol != "(":
                self._next += 1
            factor = self._factor()
            unit = unit * factor**-1 if divides else unit * factor
        return unit

    def _factor(self) -> Unit:
        if self._symbol == "(":
            self._take()
            unit = self._product()
            if self._symbol != ")":
                raise _malformed(self._text)
            self._take()
            return unit
        base = self._named()
        if self._kind not in ("power", "superscript"):
            return base
        return base ** int(self._take().translate(_SUPERSCRIPTS))

    def _named(self) -> Unit:
        if self._kind != "name":
            raise _malformed(self._text)
        name = self._take()
        if name == "1":
            return Unit()
        if name not in UNITS:
            prefixes = " ".join(filter(str.isascii, PREFIXES))
            raise UnitError(
                f"the unit {name!r} is not known",
                expected=f"{' '.join(PREFIXED)}, perhaps prefixed {prefixes}, or {' '.join(PLAIN)}",
                advice=did_you_mean(name, UNITS),
            )
        return UNITS[name]

    def _scanned(self) -> Iterator[tuple[str, str]]:
        position = 0
        while position < len(self._text):
            match = _TOKEN.match(self._text, position)
            if match is None or match.lastgroup is None:
                raise _malformed(self._text)
            yield match.lastgroup, match[match.lastgroup]
            position = match.end()

    @property
    def _kind(self) -> str:
        return self._tokens[self._next][0]

    @property
    def _symbol(self) -> str:
        kind, text = self._tokens[self._next]
        return text if kind == "mark" else ""

    def _take(self) -> str:
        text = self._tokens[self._next][1]
        self._next += 1
        return text


def _malformed(text: str) -> UnitError:
    return UnitError(f"{text!r} is not a unit", expected="units joined as in 'kg m^2/s'")
