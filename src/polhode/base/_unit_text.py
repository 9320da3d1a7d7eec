"""Compound units as people write them, such as ``kg m^2/s``."""

import re
from collections.abc import Iterator

from polhode.base._errors import UnitError
from polhode.base._units import PLAIN, PREFIXED, PREFIXES, UNITS, Unit


def read_unit(text: str) -> Unit:
    """Read a unit: names, perhaps with a whole exponent, joined by ``*``, a space or ``/``.

    Brackets group, as in ``kg/(m s^2)``. ``/`` divides by the next factor only, so ``N/m s`` is
    ``(N/m) s``. ``Hz`` is one per second, not one turn per second: write ``rev/s`` or ``rpm`` for
    turning.

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
            return self._bracket()
        base = self._named()
        if self._kind not in ("power", "superscript"):
            return base
        return base ** int(self._take().translate(_SUPERSCRIPTS))

    def _bracket(self) -> Unit:
        self._take()
        unit = self._product()
        if self._symbol != ")":
            raise _malformed(self._text)
        self._take()
        return unit

    def _named(self) -> Unit:
        if self._kind != "name":
            raise _malformed(self._text)
        name = self._take()
        if name == "1":
            return Unit()
        if name not in UNITS:
            raise _unknown(name)
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


def _unknown(name: str) -> UnitError:
    prefixes = " ".join(filter(str.isascii, PREFIXES))
    return UnitError(
        f"the unit {name!r} is not known",
        expected=f"{' '.join(PREFIXED)}, perhaps prefixed {prefixes}, or {' '.join(PLAIN)}",
    )
