r"""Numbers and labels of the equations of a text, and what its words refer to by them.

"Substituting (4) into (2)", "by eq. 5" and ``from~\eqref{energy}`` name what a line is drawn from.
Equations are numbered as LaTeX does it, by ``\tag`` and ``\label``, or by a number at the end of a
display.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

from polhode.judge.source import SourceRelation
from polhode.judge.text._cues import Cues

_NUMBERED = "equation|align|alignat|flalign|gather|multline|eqnarray"
_OPENING = re.compile(rf"\\begin\s*\{{(?P<name>{_NUMBERED})(?P<star>\*?)\}}|(?P<bracket>\\\[)|\$\$")
_ONE_NUMBER = ("equation", "multline")
_COMMENT = re.compile(r"(?<!\\)%[^\n]*")
_ROW = re.compile(r"\\\\(?:\s*\[[^\]\n]*\])?")
_ENVIRONMENT = re.compile(r"\\begin\s*\{(\w+\*?)\}.*?\\end\s*\{\1\}", re.DOTALL)
_LABEL = re.compile(r"\\label\s*\{([^{}]*)\}")
_TAG = re.compile(r"\\tag\*?\s*\{\(?([^{}()]*)\)?\}")
_UNNUMBERED = re.compile(r"\\(?:nonumber|notag)(?![A-Za-z])")
_AT_END = re.compile(r"\(([0-9]{1,3}[a-z]?)\)[\s.,]*\Z")
_CITED = re.compile(
    r"\\(?:eq|auto|c|C)?ref\s*\{(?P<label>[^{}]*)\}"
    r"|\((?P<first>[0-9]{1,3}[a-z]?)\)(?:\s*(?:--?|–|to)\s*\((?P<last>[0-9]{1,3})\))?"
    r"|\b(?:eqs?|eqns?|equations?)\.?[\s~]*(?P<bare>[0-9]{1,3}[a-z]?)\b",
    re.I,
)


@dataclass(frozen=True)
class References:
    """The equations of a document that have a number or a label.

    Attributes:
        of_relation: for each relation, in order, the keys that it is cited by.
    """

    of_relation: tuple[frozenset[str], ...]

    @classmethod
    def of(cls, relations: Sequence[SourceRelation], texts: Mapping[str, str]) -> References:
        """Those of a document, given the text of each of its files."""
        spans = {name: list(_numbered(text)) for name, text in texts.items()}
        lines = {name: _line_starts(text) for name, text in texts.items()}
        found = []
        for relation in relations:
            starts = lines.get(relation.file, [])
            known = relation.is_display and 0 < relation.line <= len(starts)
            place = starts[relation.line - 1] + relation.column - 1 if known else -1
            keys = (k for begin, end, k in spans.get(relation.file, []) if begin <= place < end)
            found.append(frozenset().union(*keys))
        return cls(tuple(found))

    def cited(self, cues: Cues, before: int) -> frozenset[int]:
        """The relations that the words around one refer to, of those before it."""
        keys = frozenset(_cited(cues.words_before))
        return frozenset(i for i in range(before) if self.of_relation[i] & keys)


def _cited(words: str) -> Iterator[str]:
    for found in _CITED.finditer(words):
        if found["label"]:
            yield from (f"label {part.strip()}" for part in found["label"].split(","))
        elif found["last"] and found["first"].isdigit():
            yield from map(str, range(int(found["first"]), int(found["last"]) + 1))
        else:
            yield found["first"] or found["bare"]


def _line_starts(text: str) -> list[int]:
    return [0, *accumulate(len(line) + 1 for line in text.split("\n"))][:-1]


def _numbered(text: str) -> Iterator[tuple[int, int, frozenset[str]]]:
    """First and last place of each equation with the keys that it has."""
    source = _COMMENT.sub(lambda found: " " * len(found[0]), text)
    count = 0
    for display, begin, content in _displays(source):
        counts = display["name"] is not None and not display["star"]
        for start, end in _rows(content, whole=display["name"] in (None, *_ONE_NUMBER)):
            row = content[start:end]
            keys = {f"label {label.strip()}" for label in _LABEL.findall(row)}
            tag = _TAG.search(row) or (None if counts else _AT_END.search(row))
            if tag:
                keys.add(tag[1].strip())
            elif counts and row.strip() and not _UNNUMBERED.search(row):
                count += 1
                keys.add(str(count))
            if keys:
                yield begin + start, begin + end, frozenset(keys)


def _displays(source: str) -> Iterator[tuple[re.Match[str], int, str]]:
    """Each display: what opens it, where it begins, and what stands in it."""
    place, unclosed = 0, set[str]()
    while opening := _OPENING.search(source, place):
        begin = place = opening.end()
        closing = r"\\\]" if opening["bracket"] else r"\$\$"
        if opening["name"]:
            closing = rf"\\end\s*\{{{opening['name']}{re.escape(opening['star'])}\}}"
        end = None if closing in unclosed else re.compile(closing).search(source, begin)
        if end is None:
            unclosed.add(closing)
        else:
            yield opening, begin, source[begin : end.start()]
            place = end.end()


def _rows(content: str, *, whole: bool) -> Iterator[tuple[int, int]]:
    """The rows of a display, those of environments within it left together."""
    hidden = _ENVIRONMENT.sub(lambda found: " " * len(found[0]), content)
    start = 0
    for found in () if whole else _ROW.finditer(hidden):
        yield start, found.start()
        start = found.end()
    yield start, len(content)
