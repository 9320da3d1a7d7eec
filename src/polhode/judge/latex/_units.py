r"""Units of measurement as LaTeX prints them: ``m/s^2``, ``m\,s^{-2}``, ``\metre\per\second``."""

from __future__ import annotations

import re

from polhode.base import UnitError, read_unit

_PREFIXES = {"nano": "n", "micro": "u", "milli": "m", "centi": "c", "kilo": "k"} | {
    "mega": "M",
    "giga": "G",
}
_NAMES = {"metre": "m", "meter": "m", "gram": "g", "kilogram": "kg", "second": "s"} | {
    "newton": "N",
    "joule": "J",
    "watt": "W",
    "hertz": "Hz",
    "pascal": "Pa",
    "radian": "rad",
    "degree": "deg",
    "minute": "min",
    "hour": "h",
    "day": "day",
    "circ": "deg",
}
_POWERS = {"squared": "^2", "cubed": "^3"}
_POWERS_AHEAD = {"square": "^2", "cubic": "^3"}
_JOINING = {"cdot": "*", "times": "*", "per": "/"}
_SPACES = re.compile(r"\\[,;:!> ]|[~.\s]+")
_MACRO = re.compile(r"\\([A-Za-z]+)\s*")
_BRACES = re.compile(r"\{([^{}]*)\}")
_FONT = re.compile(r"\\(?:mathrm|text|rm)\b\s*")


def unit_text(latex: str) -> str:
    """A unit as `read_unit` reads it; nothing for what is none."""
    plain = _SPACES.sub(" ", _FONT.sub("", latex))
    text = _spelled(_BRACES.sub(r"\1", plain)).strip()
    try:
        read_unit(text)
    except UnitError:
        return ""
    return text


def _spelled(latex: str) -> str:
    """The unit with the words of siunitx replaced by their signs."""
    text, place, ahead = "", 0, ""
    for match in _MACRO.finditer(latex):
        name, between = match[1], latex[place : match.start()]
        text, place = text + between, match.end()
        if name in _POWERS_AHEAD:
            ahead = _POWERS_AHEAD[name]
        elif name in _PREFIXES:
            text += f" {_PREFIXES[name]}"
        elif name in _NAMES:
            is_prefixed = any(text.endswith(f" {prefix}") for prefix in _PREFIXES.values())
            text += ("" if is_prefixed and not between else " ") + _NAMES[name] + ahead
            ahead = ""
        else:
            text += _POWERS.get(name) or _JOINING.get(name) or f" {name}"
    return " ".join((text + latex[place:]).split()).replace("/ ", "/")
