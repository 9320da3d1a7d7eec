"""How the letters of a claim were understood that texts use in more than one sense."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from polhode.claims.latex._tree import Name, Statement, walk
from polhode.claims.meaning._vocabulary import Vocabulary, automatic, spelled


def read_as(statement: Statement, vocabulary: Vocabulary) -> str:
    """Letters that the text does not define, with the quantities they were read as."""
    phrases = dict(automatic(vocabulary.mechanics))
    names = dict.fromkeys(piece for piece in walk(statement) if isinstance(piece, Name))
    open_ = (n for n in names if n not in vocabulary.told and n not in vocabulary.declared)
    phrased = {
        n: next((phrases[f] + part for f, part in _forms(n) if f in phrases), "") for n in open_
    }
    return ", ".join(f"{spelled(name)} as {phrase}" for name, phrase in phrased.items() if phrase)


def _forms(name: Name) -> Iterator[tuple[Name, str]]:
    """A letter as printed, as a vector, and as the vector of which it is a component."""
    if name.decoration == "hat":
        return
    yield name, ""
    yield replace(name, decoration="vector"), ""
    whole, _, label = name.subscript.rpartition(",")
    if label:
        yield replace(name, subscript=whole, decoration="vector"), f" along {label}"
