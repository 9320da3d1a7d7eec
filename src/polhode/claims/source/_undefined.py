r"""Macros that neither LaTeX nor the text defines, kept as letters of their own.

A text in several files defines its macros in one of them, which may not be at hand. What such a
macro prints is unknown, and nobody may guess it; but the formula around it can be read. Each use,
with its arguments, stands for one quantity: `\LU{0}{r}` in two places is twice the same, and
nothing is known about it. For the reader it is replaced by a letter that the formula does not
contain, and put back afterwards.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from string import ascii_letters

from polhode.base import ParseError
from polhode.claims.latex._tokens import is_known
from polhode.claims.source._macros import CONTROL, closing
from polhode.claims.source._placed import PlacedText
from polhode.claims.source._standard import STANDARD

_STOP = re.compile(
    r"(?:\s|[&.,;~]|\\[,;:! ]|\\(?:nonumber|notag|label\{[^{}]*\}))*"
    r"(?:\Z|\\\\|\\q?quad(?![A-Za-z])|\\(?:text|mbox|end)\b)"
)
_RAISED = re.compile(r"\\(?:cal|mathfrak)\s*\{?\s*([A-Za-z])")
_SPACE = re.compile(r"\s*")
#: Macros of packages that take arguments; a text that uses them without has macros of its own.
_WITH_ARGUMENTS = {"dv", "pdv", "fdv", "vb", "va", "vu", "SI", "num", "abs", "norm"}
#: Letters of LaTeX for parts of a complex number, which many texts redefine for a matrix.
_PARTS = {"Re", "Im"}
_OPERAND = re.compile(r"\s*(?:[A-Za-z({\[]|\\(?:left|[a-zA-Z]*omega|[a-zA-Z]*xi|bigl?|Bigl?)\b)")


@dataclass(frozen=True)
class Undefined:
    """The macros that a document uses without defining them.

    Args:
        arguments: how many arguments in braces each takes, the fewest of all its uses.
        stops: those that only ever end a formula or a row, as full stops and commas do.
    """

    arguments: Mapping[str, int]
    stops: frozenset[str]


@dataclass(frozen=True)
class StandIns:
    """A formula with letters in place of undefined macros.

    Args:
        formula: for the reader.
        printed: what each letter stands for, by the LaTeX that the writer has for it.
    """

    formula: PlacedText
    printed: dict[str, str]

    def restored(self, latex: str) -> str:
        """LaTeX of the writer with the macros put back."""
        for letter, macro in self.printed.items():
            latex = latex.replace(letter, macro)
        return latex


def undefined(formulas: Iterable[str]) -> Undefined:
    """The undefined macros of a document, from all its formulas with their macros expanded."""
    arguments: dict[str, int] = {}
    ending: Counter[str] = Counter()
    others: set[str] = set()
    for text in formulas:
        for match in CONTROL.finditer(text):
            name = match[0][1:]
            if not name.isalpha() or not _may_be_own(text, name, match.end()):
                continue
            count = sum(1 for _ in _groups(text, match.end()))
            arguments[name] = min(count, arguments.get(name, count))
            if _STOP.match(text, match.end()) and text[: match.start()].strip(" \n&"):
                ending[name] += 1
            else:
                others.add(name)
    stops = (name for name, count in ending.items() if count > 1 and name not in others)
    return Undefined(arguments, frozenset(stops))


def with_stand_ins(formula: PlacedText, own: Undefined) -> StandIns:
    """The formula with undefined macros replaced.

    Raises:
        ParseError: for more of them than there are letters.
    """
    text = formula.text
    used = set(_RAISED.findall(text))
    free = iter(f"\\mathfrak{{{c}}}" for c in ascii_letters if c not in used)
    letters: dict[str, str] = {}
    parts: list[PlacedText] = []
    place = 0
    for match in CONTROL.finditer(text):
        name = match[0][1:]
        if match.start() < place or name not in own.arguments:
            continue
        ends = [match.end(), *islice(_groups(text, match.end()), own.arguments[name])]
        use = formula[match.start() : ends[-1]]
        letter = " " if name in own.stops else _letter_for(use.text, letters, free)
        parts += [formula[place : match.start()], PlacedText.at(letter, use.places[0], use.end)]
        place = ends[-1]
    if not parts:
        return StandIns(formula, {})
    printed = {letter: call for call, letter in letters.items()}
    return StandIns(PlacedText.joined([*parts, formula[place:]]), printed)


def _letter_for(use: str, letters: dict[str, str], free: Iterator[str]) -> str:
    """The letter for a macro with its arguments, the same wherever it is used."""
    call = " ".join(use.split())
    if call not in letters:
        letter = next(free, "")
        if not letter:
            raise ParseError(
                f"{len(letters) + 1} macros without a definition in one formula",
                expected=f"at most {len(letters)}",
                advice="put the file that defines them beside this one and include it",
            )
        letters[call] = letter
    return letters[call]


def _may_be_own(text: str, name: str, end: int) -> bool:
    """Whether a macro is none of LaTeX or its packages, by its name or the way it is used."""
    if name in _WITH_ARGUMENTS:
        return not text[end:].lstrip().startswith(("{", "[", "*"))
    if name in _PARTS:
        return not _OPERAND.match(text, end)
    return name not in STANDARD and not is_known(name)


def _groups(text: str, place: int) -> Iterator[int]:
    """The ends of the arguments in braces behind a macro."""
    while True:
        space = _SPACE.match(text, place)
        start = space.end() if space else place
        end = closing(text, start) if text[start : start + 1] == "{" else None
        if end is None:
            return
        place = end + 1
        yield place
