r"""Units that stand in the words behind a formula: "$r = 5$ mm", "$g = 9.81$ m/s$^2$"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from polhode.base import PolhodeError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import Name, Number, UnitSymbol, walk
from polhode.judge.latex._units import unit_text
from polhode.judge.source import SourceRelation

_POWER = r"(?:\s*\$?\^\{?-?\d\}?\$?|⁻?[¹²³⁴])?"
_FACTOR = rf"(?:[A-Za-zµΩ]+|°){_POWER}"
_JOINED = rf"(?:\s|~|\\[,; ]|/|·|\$?\\cdot\$?)+{_FACTOR}"
_BESIDE = re.compile(rf"(?:\s|~|\\[,; ])*(?P<unit>{_FACTOR}(?:{_JOINED}){{0,3}})")
_LAST_FACTOR = re.compile(rf"{_JOINED}\Z")
_PREPOSITION = "in"  # never the inch


def with_unit_behind(relation: SourceRelation) -> SourceRelation:
    """A relation that ends in a plain number, with the unit that the words behind it begin with."""
    read = relation.relation
    if read is None or relation.is_display or not _is_plain_number(relation):
        return relation
    for unit in _units(relation.after):
        with suppress(PolhodeError):
            found = read_latex(rf"{relation.latex}\,\mathrm{{{unit}}}").relations
            if len(found) == 1:
                return replace(relation, relation=found[0], printed=write_latex(found[0]))
    return relation


def _is_plain_number(relation: SourceRelation) -> bool:
    last = relation.relation.sides[-1] if relation.relation is not None else None
    pieces = list(walk(last)) if last is not None else []
    is_number = any(isinstance(piece, Number) for piece in pieces)
    return is_number and not any(isinstance(piece, (Name, UnitSymbol)) for piece in pieces)


def _units(words: str) -> Iterator[str]:
    """What the words may begin with as a unit, the longest first."""
    found = _BESIDE.match(words)
    text = found["unit"] if found is not None else ""
    while text and text != _PREPOSITION:
        plain = re.sub(r"\\cdot|·", "*", text.replace("$", ""))
        spelled = unit_text(plain) or unit_text(rf"\{plain.removesuffix('s')}")
        if spelled:
            yield spelled
        shorter = _LAST_FACTOR.sub("", text)
        text = shorter if shorter != text else ""
