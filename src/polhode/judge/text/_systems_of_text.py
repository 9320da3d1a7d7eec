"""The system that a text is about: named in a comment, or proposed by the words that it uses."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from polhode.catalogue import CATALOGUE, CatalogueEntry

_NAMED = re.compile(  # in a comment, or in the front matter of Markdown
    r"(?:%|//|<!--|#|^)[ \t]*polhode:[ \t]*(?P<name>[^\s>]+)", re.IGNORECASE | re.MULTILINE
)
_HEAD = 4000  # characters in which the comment is looked for
_WORD = re.compile(r"[a-z]{4,}")
_COMMON = frozenset(
    """that with from about into over under this which without where while when there they them then
    than have been body bodies motion system mass point angle angular axis axes center centre
    gravity constant moves move moving free fixed held rigid rate speed velocity time line plane
    horizontal vertical every other same only does what whatever touches through along contact
    left right starts rest""".split()  # noqa: SIM905
)
_FEWEST = 2  # words in common that make a proposal


def named_system(texts: Iterable[str]) -> str:
    """The system that the first comment ``polhode: NAME`` near the top of a text names, or ""."""
    for text in texts:
        found = _NAMED.search(text[:_HEAD])
        if found:
            return found["name"].removesuffix("--").removesuffix("\\n")
    return ""


def proposed_systems(texts: Iterable[str]) -> tuple[str, ...]:
    """Names of systems of the catalogue whose description shares most words with texts."""
    words = {_stem(word) for text in texts for word in _WORD.findall(text.lower())}
    shared = {name: len(words & own) for name, own in _words_by_system(CATALOGUE).items()}
    most = max(shared.values(), default=0)
    return tuple(n for n, count in shared.items() if count == most) if most >= _FEWEST else ()


def _words_by_system(entries: Mapping[str, CatalogueEntry]) -> dict[str, frozenset[str]]:
    """Words of the description of each system that those of few others have."""
    words = {
        name: {
            _stem(w)
            for w in _WORD.findall(f"{name} {entry.title} {entry.about}".lower())
            if w not in _COMMON
        }
        for name, entry in entries.items()
    }
    count: dict[str, int] = {}
    for own in words.values():
        for word in own:
            count[word] = count.get(word, 0) + 1
    return {name: frozenset(w for w in own if count[w] <= 2) for name, own in words.items()}


def _stem(word: str) -> str:
    return word.removesuffix("s")
