r"""The formulas of a text between dollar signs, ``\[ \]`` and ``\begin \end``, as TeX sees it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from posixpath import join

from polhode.judge.source._macros import (
    DEFINING,
    Macro,
    Macros,
    argument,
    argument_span,
    definition,
)
from polhode.judge.source._placed import PlacedText

ENVIRONMENTS = {
    "equation", "align", "alignat", "flalign", "gather", "multline", "eqnarray", "IEEEeqnarray",
    "displaymath", "math", "dmath", "empheq",
    "aligned", "alignedat", "gathered", "split", "cases",  # alone, as MathJax takes them
}  # fmt: skip
#: Abbreviations that texts customarily define in their preamble, used where it is not at hand.
_CUSTOMARY = {
    "be": "ee", "beq": "eeq", "bea": "eea", "bean": "eean", "beqn": "eeqn", "beqa": "eeqa",
    "beqnarray": "eeqnarray", "ba": "ea", "bal": "eal", "bga": "ega", "bml": "eml",
}  # fmt: skip

_HEADING = r"\\[A-Za-z]*(?:section|chapter|paragraph)[A-Za-z]*\*?\s*\{"
_EVENT = re.compile(
    rf"""
      (?P<define>{DEFINING.pattern})
    | (?P<newenv>\\(?:re)?newenvironment\b\*?)
    | (?P<input>\\(?:input|include|subfile(?:include)?|(?:sub)?import\*?)(?![A-Za-z]))
    | (?P<heading>{_HEADING})
    | (?P<hashes>^\#{{1,6}}[ \t]+[^\n]+)
    | (?P<begin>\\begin\s*\{{\s*(?P<env>[A-Za-z]+)\*?\s*\}})
    | (?P<open>\\\[)
    | (?P<inline>\\\()
    | (?P<dollars>\$\$?)
    | (?P<word>\\[A-Za-z@]+)
    | (?P<skip>\\.)
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
_FILE = re.compile(r"[ \t]*(?P<brace>\{)?(?P<name>(?(brace)[^{}]|[^\s{}\\%$])+)(?(brace)\})")
_END = re.compile(r"\\end\s*\{\s*([A-Za-z]+)\*?\s*\}")
_OPTIONS = re.compile(r"\s*(?:\[[^\]]*\]\s*)?(?:\{[^{}]*\})?")
_WITH_OPTIONS = {"alignat", "alignedat", "IEEEeqnarray", "empheq"}
_IN_BRACKETS = re.compile(r"\s*\[[^\]=]*=[^\]]*\]")  # of breqn: [label={eq:x}]
_DOLLAR = re.compile(r"\\.|\$", re.DOTALL)
# What a dollar sign may open that nothing closes, up to the end of its line.
_UNCLOSED = re.compile(r"(?![\s\d])[^\n]*?[=<>][^\n]*")
_IN_WORDS = re.compile(r"\\\[|\\\(|\\begin(?![A-Za-z])")
_BLANK_LINE = re.compile(r"\n[ \t]*\n")
_BODY_BEGIN = re.compile(r"\s*\\begin\s*\{\s*([A-Za-z]+)\*?\s*\}|\s*(\\\[|\$\$)")
_BODY_END = re.compile(r"\s*\\end\s*\{\s*([A-Za-z]+)\*?\s*\}|\s*(\\\]|\$\$)")
_AROUND = re.compile(r"(.*?)\s*#1\s*(?:\\end\s*\{[^{}]*\}|\\\]|\$\$)\s*", re.DOTALL)
_PARAGRAPH = re.compile(
    rf"\n[ \t]*\n|{_HEADING}[^{{}}]*\}}|^(?:\#{{1,6}}|=+)[ \t][^\n]*\n", re.MULTILINE
)
# In Markdown the words that lead to a display often stand in a paragraph of their own.
_DISPLAYED = re.compile(
    r"\$\$.*?\$\$|\\\[.*?\\\]|\\begin\s*\{(\w+\*?)\}.*?\\end\s*\{\1\}|\\begin\s*\{\w+\*?\}\s*\Z",
    re.DOTALL,
)
_WORD = re.compile(r"[^\W\d_]{2,}")
_MATHEMATICAL = re.compile(r"[\\=<>≤≥≈^_{}]")
GOES_ON = re.compile(r"\s*(?:then|so|hence|thus|therefore|it follows)\b", re.I)
"""How a sentence or a paragraph begins that goes on with what the one before it says."""
_WINDOW = 1000  # characters around a formula that may say what it is
LONGEST_FORMULA = 20_000  # characters within which a formula must end


@dataclass(frozen=True)
class SourceFormula:
    """A formula as it stands in a text.

    Args:
        text: what stands between the signs that delimit it.
        is_display: whether it stands on lines of its own.
        heading: the headings above it, outermost first, and the words just before it.
        macros: those that the text has defined up to there.
        problem: what is wrong with its delimiters; empty if nothing.
        before: the text before it, back to the blank line or heading where its paragraph begins.
        after: the text behind it, to the end of its paragraph.
    """

    text: PlacedText
    is_display: bool
    heading: tuple[str, ...] = ()
    macros: Macros = field(default_factory=dict)
    problem: str = ""
    before: str = ""
    after: str = ""


@dataclass(frozen=True)
class Inclusion:
    """A file that the text takes in, by the name that it gives, and where it does so."""

    name: str
    place: int


class Scanner:
    """Goes once through a text; what included files define is known afterwards as well.

    Args:
        text: the text, comments and listings blanked out.
        macros: those known before it begins; it adds its own.
    """

    def __init__(self, text: PlacedText, macros: dict[str, Macro] | None = None) -> None:
        self._text = text
        self.macros: dict[str, Macro] = {} if macros is None else macros
        self._place = 0
        self._headings: dict[int, str] = {}
        self._frozen: Macros | None = None
        self._openers: set[str] = set()  # environments of the text's own
        self._unclosed: set[str] = set()  # what is known to be missing in the rest

    def formulas(self) -> Iterator[SourceFormula | Inclusion]:
        """Formulas and included files, in order."""
        source = self._text.text
        while match := _EVENT.search(source, self._place):
            self._place = match.end()
            kind = match.lastgroup or ""
            kind = "begin" if kind == "env" else kind
            reader = getattr(self, f"_{kind}", None)
            if reader is not None:
                yield from reader(match)

    # -- definitions ----------------------------------------------------------------------------

    def _define(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        self._place = self._defined(self._text.text, match)
        yield from ()

    def _defined(self, text: str, match: re.Match[str]) -> int:
        """Take in the definition that a match begins; where it ends."""
        found = definition(text, match.start(), self.macros)
        if found is None:
            return match.end()
        name, macro, end = found
        provided = match[0].startswith(r"\providecommand")
        if not (provided and name in self.macros) and macro.body.strip() != name:
            self.macros[name] = macro
            self._frozen = None
        return end

    def _without_definitions(self, formula: PlacedText) -> PlacedText:
        """A formula without the definitions in it, which are taken in."""
        text, place = formula.text, 0
        while match := DEFINING.search(text, place):
            place = self._defined(text, match)
            text = text[: match.start()] + " " * (place - match.start()) + text[place:]
        return formula.with_text(text)

    def _newenv(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        """An environment of the text's own, known if it begins with one that holds a formula."""
        source = self._text.text
        name = argument(source, self._place)
        begin = argument(source, name[1]) if name else None
        end = argument(source, begin[1]) if begin else None
        if name and begin and end:
            self._place = end[1]
            if _is_display(_BODY_BEGIN.match(begin[0])):
                self._openers.add(name[0].strip())
        yield from ()

    def _input(self, match: re.Match[str]) -> Iterator[Inclusion]:
        names: list[str] = []
        while len(names) <= ("import" in match[0]):  # a folder, and the file in it
            found = _FILE.match(self._text.text, self._place)
            if found is None:
                return
            self._place = found.end()
            names.append(found["name"].strip())
        self._frozen = None
        yield Inclusion(join(*names), self._text.places[match.start()])

    def _heading(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        found = argument(self._text.text, match.end() - 1)
        if found:
            self._below(_depth(match[0]), found[0])
        yield from ()

    def _hashes(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        marks, _, words = match[0].partition(" ")
        self._below(len(marks), words.strip())
        yield from ()

    def _below(self, depth: int, words: str) -> None:
        """Put a heading below those above it."""
        self._headings = {d: there for d, there in self._headings.items() if d < depth}
        self._headings[depth] = words

    # -- formulas -------------------------------------------------------------------------------

    def _begin(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        name = match["env"]
        if not (name in ENVIRONMENTS or name in self._openers):
            return
        source = self._text.text
        start = match.end()
        pattern = _OPTIONS if name in _WITH_OPTIONS else _IN_BRACKETS
        options = pattern.match(source, start) if name in {*_WITH_OPTIONS, "dmath"} else None
        start = options.end() if options else start
        end = re.compile(rf"\\end\s*\{{\s*{name}\*?\s*\}}")
        yield self._closed(end, start, match[0])

    def _open(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        yield self._closed(re.compile(r"\\\]"), match.end(), match[0])

    def _inline(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        yield self._closed(re.compile(r"\\\)"), match.end(), match[0], is_display=False)

    def _dollars(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        if match[0] == "$$":
            yield self._closed(re.compile(r"(?<!\\)\$\$"), match.end(), "$$")
            return
        source, start = self._text.text, match.end()
        second = next((m for m in _DOLLAR.finditer(source, start) if m[0] == "$"), None)
        last = second.start() if second else len(source)
        blank = _BLANK_LINE.search(source, start, last)
        if second is None or blank:
            # What begins with an amount means money, not mathematics.
            stretch = source[start : min(blank.start() if blank else last, start + LONGEST_FORMULA)]
            if formula := _UNCLOSED.match(_IN_WORDS.split(stretch, 1)[0]):
                yield self._formula(
                    start, start + formula.end(), False, f"{match[0]} that is not closed"
                )
        elif not _is_price(source[start : second.end() + 1]):
            self._place = second.end()
            if last - start <= LONGEST_FORMULA:
                yield self._formula(start, last, is_display=False)
            else:
                problem = f"a formula of more than {LONGEST_FORMULA} characters"
                yield self._formula(start, start + LONGEST_FORMULA, False, problem)

    def _word(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        """A macro that opens a display, by its definition or by custom."""
        name = match[0]
        macro = self.macros.get(name)
        if macro is not None:
            if (around := _AROUND.fullmatch(macro.body)) and macro.arguments == (None,):
                span = argument_span(self._text.text, match.end())
                if span and _is_display(_BODY_BEGIN.fullmatch(around[1])):
                    self._place = span[2]
                    yield self._formula(span[0], span[1], is_display=True)
            elif not macro.arguments and _is_display(_BODY_BEGIN.fullmatch(macro.body)):
                closers = [
                    re.escape(other)
                    for other, there in self.macros.items()
                    if not there.arguments and _is_display(_BODY_END.fullmatch(there.body))
                ]
                if closers:
                    end = re.compile(rf"(?:{'|'.join(closers)})(?![A-Za-z])")
                    yield self._closed(end, match.end(), name)
        elif name[1:] in _CUSTOMARY:
            end = re.compile(rf"\\{_CUSTOMARY[name[1:]]}(?![A-Za-z])")
            yield self._closed(end, match.end(), name)

    def _closed(
        self, end: re.Pattern[str], start: int, opener: str, is_display: bool = True
    ) -> SourceFormula:
        """The formula up to its end; without one, up to the next blank line, with its problem."""
        source = self._text.text
        found = None
        if end.pattern not in self._unclosed:
            found = end.search(source, start, start + 2 * LONGEST_FORMULA)
        if found:
            self._place = found.end()
            return self._formula(start, found.start(), is_display)
        if len(source) <= start + 2 * LONGEST_FORMULA:
            self._unclosed.add(end.pattern)
        blank = _BLANK_LINE.search(source, start, start + LONGEST_FORMULA)
        self._place = blank.start() if blank else min(len(source), start + LONGEST_FORMULA)
        return self._formula(start, self._place, is_display, f"{opener} that is not closed")

    def _formula(self, start: int, end: int, is_display: bool, problem: str = "") -> SourceFormula:
        text = self._without_definitions(self._text[start:end])
        if self._frozen is None:
            self._frozen = dict(self.macros)
        heading = tuple(self._headings[depth] for depth in sorted(self._headings))
        before, after = around(self._text.text, start, self._place)
        return SourceFormula(text, is_display, heading, self._frozen, problem, before, after)


def around(source: str, start: int, end: int) -> tuple[str, str]:
    """What stands before and behind a formula in its paragraph.

    Where only displays stand before it there, the paragraph before them is taken as well, and so
    is the one before a paragraph that begins with "then" or the like.
    """
    before = source[max(0, start - _WINDOW) : start]
    # Within a formula its signs would be paired wrongly.
    begin = before.find("\n") + 1 if start > _WINDOW else 0
    for boundary in reversed(list(_PARAGRAPH.finditer(before))):
        is_blank = not boundary[0].strip()
        words = _DISPLAYED.sub(" ", before[boundary.end() :])
        if not is_blank or (_WORD.search(words) and not GOES_ON.match(words)):
            begin = boundary.end()
            break
    after = source[end : end + _WINDOW]
    stop = _PARAGRAPH.search(after)
    return before[begin:], after[: stop.start()] if stop else after


def _is_price(text: str) -> bool:
    """Whether what begins with a dollar sign, up to behind the next one, is money and words."""
    amount, _, behind = text.partition("$")
    if not (amount[:1].isdigit() and amount[-1:].isspace()) or _MATHEMATICAL.search(amount):
        return False
    return len(_WORD.findall(amount)) + amount.count(", ") + behind.isdigit() > 1


def _is_display(match: re.Match[str] | None) -> bool:
    return match is not None and (match[2] is not None or match[1] in ENVIRONMENTS)


def _depth(command: str) -> int:
    """How deep a heading stands; own commands such as \\mysubsection count as what they contain."""
    for depth, word in enumerate(("chapter", "subsubsubsection", "subsubsection", "subsection")):
        if word in command:
            return (0, 4, 3, 2)[depth]
    return 5 if "paragraph" in command else 1
