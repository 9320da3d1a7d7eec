r"""Macros that neither LaTeX nor the text defines, kept as letters of their own.

A text in several files defines its macros in one of them, which may not be at hand. What such a
macro prints is unknown, and nobody may guess it; but the formula around it can be read. Each use,
with its arguments, stands for one quantity: `\inframe{0}{r}` in two places is twice the same, and
nothing is known about it. For the reader it is replaced by a letter that the formula does not
contain, and put back afterwards.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice

from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._tokens import is_known
from polhode.judge.source._macros import CONTROL, closing
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._signs import ENDS_OPEN
from polhode.judge.source._standard import STANDARD

_STOP = re.compile(
    r"(?:\s|[&.,;~]|\\[,;:! ]|\\(?:nonumber|notag|label\{[^{}]*\}))*"
    r"(?:\Z|\\\\|\\q?quad(?![A-Za-z])|\\(?:text|mbox|end)\b)"
)
# Letters without a part in the grammar, such as d, t, n and π have; the seldom ones come first.
_SELDOM = """
xi zeta eta iota upsilon chi varsigma varkappa varpi varrho Xi Upsilon Psi Phi Lambda Theta Gamma
psi vartheta rho tau mu lambda gamma sigma beta alpha phi varphi varepsilon epsilon theta
"""
_LETTER = re.compile(r"\\([A-Za-z]+)")
_MARKED = re.compile(r"[A-Za-z0-9}\])']\Z")
_MARKS = 5  # uses of a macro from which it is taken for a mark
_STOPS = 10  # and for punctuation
_MOSTLY = 0.8  # of its uses that have to agree
_SPACE = re.compile(r"\s*")
_OPTION = re.compile(r"\*?(?:\[[^\[\]]*\])?(?=\s*\{)")
#: Units are macros of their own: \qty{2}{\kg}, \si{\m}.
_MEASURE = re.compile(
    r"\\(?:(?:SI|qty)\s*(?:\[[^\]]*\])?\s*\{[^{}]*\}|(?:si|unit))\s*\{(?:[^{}]|\{[^{}]*\})*\}"
)
#: Macros of packages that take arguments; a text that uses them without has macros of its own.
_WITH_ARGUMENTS = {"dv", "pdv", "fdv", "vb", "va", "vu", "vv", "SI", "num", "abs", "norm"} | {
    *("mdv", "jdv", "adv", "ev", "mdet", "ab", "Res"),
}
_GROUP = re.compile(r"\s*[{\[*(|<]")
_LETTER_OR_GROUP = re.compile(r"\s*[{\[*]|\s+[A-Za-z]|\s*\\(?:[a-zA-Z]*omega|[a-zA-Z]*tau|alpha)\b")
_WITHOUT_ARGUMENTS = lexicon.MARKS.keys() | lexicon.SIGNS.keys() | lexicon.LETTERS.keys()
#: Letters of LaTeX for parts of a complex number, which many texts redefine for a matrix.
_PARTS = {"Re", "Im"}
_OPERAND = re.compile(r"\s*(?:[A-Za-z({\[]|\\(?:left|[a-zA-Z]*omega|[a-zA-Z]*xi|bigl?|Bigl?)\b)")


@dataclass(frozen=True)
class Undefined:
    """The macros that a document uses without defining them.

    Args:
        arguments: how many arguments in braces each takes, the fewest of all its uses.
        stops: those that nearly always end a formula or a row, never behind a sign: punctuation.
        marks: those that stand close behind a quantity, as a label or a transposition does.
    """

    arguments: Mapping[str, int]
    stops: frozenset[str]
    marks: frozenset[str]


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
        return _LETTER.sub(lambda match: self.printed.get(match[0], match[0]), latex)

    def macros_in(self, latex: str) -> tuple[str, ...]:
        """The macros that LaTeX of the writer stands for."""
        letters = dict.fromkeys(match[0] for match in _LETTER.finditer(latex))
        return tuple(self.printed[letter] for letter in letters if letter in self.printed)

    def refuse_loss(self, written: Iterable[str]) -> None:
        """Refuse a reading that has lost a macro.

        Raises:
            ParseError: where none of what is written has it.
        """
        kept = {macro for latex in written for macro in self.macros_in(latex)}
        for macro in self.printed.values():
            if macro not in kept:
                raise ParseError(
                    f"{macro}, which is defined nowhere",
                    expected="the document that defines it",
                    advice="give the file that includes this one, or put the definition into it",
                )


def undefined(formulas: Iterable[str]) -> Undefined:
    """The undefined macros of a document, from all its formulas with their macros expanded."""
    uses: dict[str, list[_MacroUse]] = {}
    for text in formulas:
        for match in _macros_in(text):
            name = match[0][1:]
            if name.isalpha() and _may_be_own(text, name, match.end()):
                uses.setdefault(name, []).append(_use(text, match))
    return Undefined(
        {name: min(use.arguments for use in all_) for name, all_ in uses.items()},
        frozenset(name for name, all_ in uses.items() if _are_stops(all_)),
        frozenset(name for name, all_ in uses.items() if _are_marks(all_)),
    )


@dataclass(frozen=True)
class _MacroUse:
    """What stands around a macro where it is used."""

    arguments: int
    is_last: bool
    is_close: bool
    is_behind_bracket: bool
    is_behind_sign: bool


def _are_stops(uses: list[_MacroUse]) -> bool:
    """Whether a macro is punctuation; a letter at the end of formulas stands behind a sign too."""
    is_last = _mostly(use.is_last and not use.arguments for use in uses)
    return len(uses) >= _STOPS and is_last and not any(use.is_behind_sign for use in uses)


def _are_marks(uses: list[_MacroUse]) -> bool:
    is_close = _mostly(use.is_close and not use.arguments for use in uses)
    return len(uses) >= _MARKS and is_close and any(use.is_behind_bracket for use in uses)


def _mostly(answers: Iterable[bool]) -> bool:
    found = list(answers)
    return sum(found) >= _MOSTLY * len(found)


def _use(text: str, match: re.Match[str]) -> _MacroUse:
    before = text[: match.start()]
    return _MacroUse(
        sum(1 for _ in _groups(text, match.end())),
        bool(_STOP.match(text, match.end()) and before.strip(" \n&")),
        _MARKED.search(before[-1:]) is not None,
        before.endswith(("]", "}", ")")),
        ENDS_OPEN.search(before) is not None,
    )


def with_stand_ins(formula: PlacedText, own: Undefined) -> StandIns:
    """The formula with undefined macros replaced.

    Raises:
        ParseError: for more of them than there are letters.
    """
    text = formula.text
    used = set(_LETTER.findall(text))
    free = iter(f"\\{letter}" for letter in _SELDOM.split() if letter not in used)
    letters: dict[str, str] = {}
    parts: list[PlacedText] = []
    place = 0
    for match in _macros_in(text):
        name = match[0][1:]
        if match.start() < place or name not in own.arguments:
            continue
        end = _end_of_marks(text, _end_of_call(text, match, own), own)
        use = formula[match.start() : end]
        letter = "" if name in own.stops else _letter_for(use.text, letters, free)
        parts += [
            formula[place : match.start()],
            PlacedText.at(letter, use.places[0], use.end),
            PlacedText.at(" ", use.end, use.end),  # so that it does not run into a letter
        ]
        place = end
    if not parts:
        return StandIns(formula, {})
    printed = {letter: call for call, letter in letters.items()}
    return StandIns(PlacedText.joined([*parts, formula[place:]]), printed)


def _macros_in(text: str) -> Iterator[re.Match[str]]:
    """The macros of a formula, but for those of units."""
    return CONTROL.finditer(_MEASURE.sub(lambda match: " " * len(match[0]), text))


def _end_of_call(text: str, match: re.Match[str], own: Undefined) -> int:
    ends = [match.end(), *islice(_groups(text, match.end()), own.arguments[match[0][1:]])]
    return ends[-1]


def _end_of_marks(text: str, place: int, own: Undefined) -> int:
    """Behind the marks that stand close behind a macro and its arguments."""
    while (match := CONTROL.match(text, place)) and match[0][1:] in own.marks:
        place = match.end()
    return place


def _letter_for(use: str, letters: dict[str, str], free: Iterator[str]) -> str:
    """The letter for a macro with its arguments, the same wherever it is used."""
    call = " ".join(use.split())
    if call not in letters:
        letter = next(free, "")
        if not letter:
            raise ParseError(
                f"{len(letters) + 1} macros without a definition in one formula",
                expected=f"at most {len(letters)}",
                advice="give the file that includes this one, or put the definitions into it",
            )
        letters[call] = letter
    return letters[call]


def _may_be_own(text: str, name: str, end: int) -> bool:
    """Whether a macro is none of LaTeX or its packages, by its name or the way it is used."""
    if name in _WITH_ARGUMENTS:
        form = _LETTER_OR_GROUP if name in lexicon.DECORATIONS else _GROUP
        return not form.match(text, end)
    if name in _PARTS:
        return not _OPERAND.match(text, end)
    if name in _WITHOUT_ARGUMENTS:
        return sum(1 for _ in _groups(text, end)) > 1
    return name not in STANDARD and not is_known(name)


def _groups(text: str, place: int) -> Iterator[int]:
    """The ends of the arguments in braces behind a macro."""
    option = _OPTION.match(text, place)
    place = option.end() if option else place
    while True:
        space = _SPACE.match(text, place)
        start = space.end() if space else place
        end = closing(text, start) if text[start : start + 1] == "{" else None
        if end is None:
            return
        place = end + 1
        yield place
