"""Numbers and units as they are read and printed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import floor, isfinite, log10, pi

from polhode.base import PURE, TIME, Dimension, Unit, read_unit

_PLAIN = re.compile(r"\s*([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)\s*([^\d\s*/+-].*)?\s*")
_POWERS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_POWER = re.compile(r"\^\(?(-?\d+)\)?")


@dataclass(frozen=True)
class Amount:
    """A number with its unit.

    Attributes:
        number: in that unit.
        unit: as `read_unit` reads it; empty for a pure number.
    """

    number: float
    unit: str = ""

    @property
    def si(self) -> float:
        """The value in SI units."""
        return self.number * factor(self.unit)

    @property
    def text(self) -> str:
        """As it is given to `simulate` and other functions: "28 mm"."""
        return f"{self.number!r} {self.unit}".strip()

    @property
    def latex(self) -> str:
        """The number alone, as LaTeX."""
        return number_latex(self.number, 12)

    @property
    def printed(self) -> str:
        """For people, to be put between words: "$28$ mm"."""
        shown = unit_printed(self.unit)
        close = "" if shown == "°" else " "
        return f"${self.latex}${close}{shown}".strip()


def factor(unit: str) -> float:
    """How many SI units a unit is."""
    return size_of(read_unit(unit)) if unit else 1.0


def size_of(unit: Unit) -> float:
    """The same of a unit that was read."""
    return float(unit.coefficient) * pi**unit.pi_power


def plain_amount(text: str) -> Amount | None:
    """A number with a unit; None for a formula such as m*a**2/2."""
    found = _PLAIN.fullmatch(text)
    return Amount(float(found[1]), (found[2] or "").strip()) if found else None


def unit_printed(unit: str) -> str:
    """A unit with its powers raised: "kg m²"."""
    raised = _POWER.sub(lambda found: found[1].translate(_POWERS), unit)
    return raised.replace("deg", "°") if raised == "deg" else raised


def unit_of(dimension: Dimension, is_angle: bool = False) -> str:
    """The unit in which a quantity is stated: rad/s for what is one per second."""
    if dimension == PURE:
        return "deg" if is_angle else ""
    if dimension == PURE / TIME:
        return "rad/s"
    if dimension == PURE / TIME**2:
        return "rad/s^2"
    return dimension.unit


def number_latex(value: float, figures: int = 3) -> str:
    """A number to so many significant figures, with a power of ten where it is far from one."""
    if not value or not isfinite(value):
        return f"{value:g}"
    power = floor(log10(abs(float(f"{value:.{figures - 1}e}"))))
    if -3 <= power < 5:
        digits = max(figures - 1 - power, 0)
        text = f"{value:.{digits}f}"
        return text.rstrip("0").rstrip(".") if figures > 6 and "." in text else text
    mantissa = f"{value / 10**power:.{figures - 1}f}"
    if figures > 6:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return rf"{mantissa}\cdot 10^{{{power}}}" if mantissa != "1" else f"10^{{{power}}}"


def unit_latex(text: str) -> str:
    """A unit behind a number in a formula."""
    if not text:
        return ""
    if text == "deg":
        return r"^{\circ}"
    raised = re.sub(r"\^\(?(-?\d+)\)?", r"^{\1}", text).replace(" ", r"\,")
    return rf"\,\mathrm{{{raised}}}"
