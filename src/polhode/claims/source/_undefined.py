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
from collections.abc import Iterable
from dataclasses import dataclass
from string import ascii_letters

from polhode.base import ParseError
from polhode.claims.latex._tokens import is_known
from polhode.claims.source._macros import CONTROL, closing
from polhode.claims.source._placed import PlacedText
from polhode.claims.source._standard import STANDARD

_WORD = re.compile(r"\\([A-Za-z@]+)\*?")
_STOP = re.compile(
    r"(?:\s|[&.,;~]|\\[,;:! ]|\\(?:nonumber|notag|label\{[^{}]*\}))*"
    r"(?:\Z|\\\\|\\q?quad(?![A-Za-z])|\\(?:text|mbox|end)\b)"
)
_RAISED = re.compile(r"\\(?:cal|mathfrak)\s*\{?\s*([A-Za-z])")


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


def punctuation(formulas: Iterable[str]) -> frozenset[str]:
    """Undefined macros that only ever end a formula or a row, as full stops and commas do."""
    ending: Counter[str] = Counter()
    others: set[str] = set()
    for text in formulas:
        for match in _WORD.finditer(text):
            if _is_defined(match[1]):
                continue
            if _STOP.match(text, match.end()) and text[: match.start()].strip(" \n&"):
                ending[match[1]] += 1
            else:
                others.add(match[1])
    return frozenset(name for name, count in ending.items() if count > 1 and name not in others)


def with_stand_ins(formula: PlacedText, stops: frozenset[str]) -> StandIns:
    """The formula with undefined macros replaced.

    Raises:
        ParseError: for more of them than there are letters.
    """
    text = formula.text
    free = [f"\\mathfrak{{{c}}}" for c in ascii_letters if c not in _RAISED.findall(text)]
    letters: dict[str, str] = {}
    parts: list[PlacedText] = []
    place = 0
    for match in CONTROL.finditer(text):
        name = match[0][1:]
        if match.start() < place or not name.isalpha() or _is_defined(name):
            continue
        end = match.end() if name in stops else _end_of_call(text, match.end())
        call = " ".join(text[match.start() : end].split())
        if name in stops:
            letter = " "
        elif call in letters:
            letter = letters[call]
        elif len(letters) < len(free):
            letter = letters.setdefault(call, free[len(letters)])
        else:
            raise ParseError(
                f"{len(letters) + 1} undefined macros in one formula",
                expected=f"at most {len(free)}",
                advice="give the file that defines them together with this one",
            )
        use = formula[match.start() : end]
        parts += [formula[place : match.start()], PlacedText.at(letter, use.places[0], use.end)]
        place = end
    if not parts:
        return StandIns(formula, {})
    return StandIns(
        PlacedText.joined([*parts, formula[place:]]),
        {letter: call for call, letter in letters.items()},
    )


def _is_defined(name: str) -> bool:
    return name in STANDARD or is_known(name)


def _end_of_call(text: str, place: int) -> int:
    """Behind the arguments in braces that follow a macro at once."""
    while text[place : place + 1] == "{":
        end = closing(text, place)
        if end is None:
            return place
        place = end + 1
    return place
