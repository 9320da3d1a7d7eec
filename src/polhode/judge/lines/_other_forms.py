"""The other form of a Greek letter: ϑ, φ and ε where the model has θ, ϕ and ϵ, or the reverse."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from polhode.derive import Equations
from polhode.judge._notation import Notation
from polhode.judge.latex._tree import Name, Node, walk
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.source import SourceRelation

_VARIANTS = ("epsilon", "phi", "rho", "sigma", "theta")
_OTHER = {f"var{letter}": letter for letter in _VARIANTS}
_OTHER |= {letter: variant for variant, letter in _OTHER.items()}


def other_forms(
    relations: Iterable[SourceRelation], equations: Equations
) -> Iterator[tuple[Node, Meaning]]:
    """Letters of a text that has the other form of one, with what that means in the model.

    A text that has both forms means two quantities.
    """
    read = [way.relation for r in relations for way in (r, *r.ways)]
    names = {n for relation in read if relation for n in walk(relation) if isinstance(n, Name)}
    used = {part for name in names for part in _parts(name)}
    renamed = {part: other for part in used if (other := _OTHER.get(part)) and other not in used}
    if not renamed:
        return
    vocabulary = Notation.of(equations).vocabulary
    declared = {name.letter for name in vocabulary.declared if isinstance(name, Name)}
    renamed = {part: other for part, other in renamed.items() if other in declared - {part}}
    for name in names:
        letter, *labels = (renamed.get(part, part) for part in _parts(name))
        known = replace(name, letter=letter, subscript=",".join(labels))
        sense = vocabulary.sense(known) if known != name else None
        if sense and not vocabulary.has(name) and all(len(r.phrases) < 2 for r in sense.readings):
            yield name, sense.meaning


def _parts(name: Name) -> list[str]:
    """The letter, and the labels below it."""
    return [name.letter, *(name.subscript.split(",") if name.subscript else ())]
