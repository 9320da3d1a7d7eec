"""The formulas of Typst, written as LaTeX with the place of every character in the file.

Typst's own rules decide what a fraction and a script reach over: one letter, number, group or call
to either side. Brackets that only group are left out, as Typst does. See the reference of Typst,
"Math" and "Symbols".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import reduce

from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._brackets import DEEPEST
from polhode.judge.source._macros import Macro
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._scan import LONGEST_FORMULA, SourceFormula, around

_HIDDEN = re.compile(r"//[^\n]*|/\*.*?\*/|```.*?```|`[^`\n]*`", re.DOTALL)
_LET = re.compile(r"#let\s+([A-Za-z]+)\s*=\s*\$([^$]*)\$")
_URL = re.compile(r"https?://")
_EVENT = re.compile(r"^(?P<marks>=+)[ \t]+(?P<words>[^\n]+)|(?<!\\)\$", re.MULTILINE)
_END = re.compile(r"(?<!\\)\$|\n[ \t]*\n")
_TOKEN = re.compile(
    r"""
      (?P<space>\s+)
    | (?P<string>"(?:[^"\\]|\\.)*")
    | (?P<number>[0-9]+(?:\.[0-9]+)?)
    | (?P<word>[A-Za-z]+(?:\.[A-Za-z]+)*)
    | (?P<sign><=>|=>|<=|>=|!=|:=|<<|>>|->|\.\.\.|\+-|-\+)
    | (?P<row>\\(?=\s|\Z))
    | (?P<escape>\\.)
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_SIGNS = {
    "<=": r"\le ", ">=": r"\ge ", "!=": r"\ne ", ":=": ":=", "<<": r"\ll ", ">>": r"\gg ",
    "->": r"\to ", "=>": r"\Rightarrow ", "<=>": r"\Leftrightarrow ", "...": r"\ldots ",
    "+-": r"\pm ", "-+": r"\mp ", "\\": r"\\ ",
}  # fmt: skip
_NAMES = lexicon.GREEK | lexicon.FUNCTIONS.keys() | lexicon.OPERATORS
_SYMBOLS = {
    **{name: rf"\{name} " for name in _NAMES},
    "epsilon.alt": r"\epsilon ", "epsilon": r"\varepsilon ", "phi.alt": r"\phi ",
    "theta.alt": r"\vartheta ", "rho.alt": r"\varrho ", "sigma.alt": r"\varsigma ",
    "dot": r"\cdot ", "dot.op": r"\cdot ", "dot.c": r"\cdot ", "times": r"\times ",
    "approx": r"\approx ", "prop": r"\propto ", "equiv": r"\equiv ", "eq.not": r"\ne ",
    "lt.eq": r"\le ", "gt.eq": r"\ge ", "lt": "<", "gt": ">", "eq": "=", "plus.minus": r"\pm ",
    "minus.plus": r"\mp ", "partial": r"\partial ", "diff": r"\partial ", "dif": "d",
    "infinity": r"\infty ", "oo": r"\infty ", "nabla": r"\nabla ", "integral": r"\int ",
    "sum": r"\sum ", "perp": r"\perp ", "parallel": r"\parallel ", "quad": r"\quad ",
    "qquad": r"\qquad ", "thin": r"\,", "med": r"\;", "thick": r"\;", "degree": r"^\circ ",
    "degree.alt": r"^\circ ", "prime": "'", "cdot": r"\cdot ", "ell": r"\ell ", "hbar": r"\hbar ",
    "arrow.r": r"\to ", "arrow.r.double": r"\Rightarrow ", "implies": r"\Rightarrow ",
}  # fmt: skip
#: Functions of one argument, by the macro that does the same.
_OVER = {
    "dot": r"\dot", "dot.double": r"\ddot", "dot.triple": r"\dddot", "hat": r"\hat",
    "tilde": r"\tilde", "macron": r"\bar", "overline": r"\bar", "arrow": r"\vec",
    "bold": r"\mathbf",
    "upright": r"\mathrm", "italic": "", "cal": r"\mathcal", "bb": r"\mathbb",
    "frak": r"\mathfrak",
    "sans": r"\mathsf", "mono": r"\mathtt", "sqrt": r"\sqrt", "op": r"\operatorname",
    "underline": r"\underline", "cancel": "", "display": "", "inline": "",
}  # fmt: skip
_OVER |= {"vb": r"\mathbf", "va": r"\vec", "vu": r"\hat", "dd": "d "}  # of the package physica
_FENCES = {"abs": ("|", "|"), "norm": (r"\|", r"\|"), "lr": ("", "")}
_DERIVATIVES = {"dv": r"\dv", "derivative": r"\dv", "pdv": r"\pdv", "partialderivative": r"\pdv"}
_BESIDE = 40  # formulas that the words around one are searched for
_CLOSING = {"(": ")", "[": "]", "{": "}"}


def typst_formulas(text: PlacedText, macros: dict[str, Macro]) -> Iterator[SourceFormula]:
    """Displays and formulas in a line, in order, without comments and raw text.

    A formula with space inside both of its dollar signs is a display. The words around a formula
    have those beside it as LaTeX, as in other formats.
    """
    found = list(_formulas(text))
    printed = [f"${formula.text.text}$" for formula, _ in found]
    written = [source for _, source in found]
    for i, (formula, _) in enumerate(found):
        near = slice(max(0, i - _BESIDE), i), slice(i + 1, i + 1 + _BESIDE)
        before, after = (
            reduce(
                lambda said, pair: said.replace(*pair),
                zip(written[s], printed[s], strict=True),
                words,
            )
            for s, words in zip(near, (formula.before, formula.after), strict=True)
        )
        yield replace(formula, before=before, after=after)


def _formulas(text: PlacedText) -> Iterator[tuple[SourceFormula, str]]:
    """The formulas with Typst in the words around them, each with its source."""
    source = without_comments(text)
    headings: dict[int, str] = {}
    names: dict[str, str] = {}
    for let in _LET.finditer(source.text):
        with suppress(ParseError):  # the name then stands for itself
            names[let[1]] = _Writer(PlacedText.of(let[2]), names).latex().text.strip()
    place = 0
    while match := _EVENT.search(source.text, place):
        place = match.end()
        if match["marks"]:
            depth = len(match["marks"])
            headings = {d: words for d, words in headings.items() if d < depth}
            headings[depth] = match["words"].strip()
            continue
        end = _END.search(source.text, place)
        problem = "" if end and end[0] == "$" else "a $ that is not closed"
        inside = source[place : end.start() if end else len(source)]
        is_display = inside.text[:1].isspace() and inside.text[-1:].isspace()
        place += len(inside) + (not problem)
        before, after = around(source.text, match.start(), place)
        above = tuple(headings[depth] for depth in sorted(headings))
        try:
            if len(inside) > LONGEST_FORMULA:
                raise ParseError(f"a formula of more than {LONGEST_FORMULA} characters")
            latex = replace(_Writer(inside, names).latex(), end=inside.end)
        except ParseError as error:
            latex, problem = inside, error.given
        formula = SourceFormula(latex, is_display, above, {}, problem, before, after)
        yield formula, f"${inside.text}$"


def without_comments(text: PlacedText) -> PlacedText:
    """With blanks for comments, raw text, and addresses, whose slashes begin no comment."""
    return text.masked(_URL).masked(_HIDDEN)


class _Writer:
    """Writes one formula as LaTeX."""

    def __init__(self, text: PlacedText, names: Mapping[str, str]) -> None:
        self._text = text
        self._names = names  # those of the text's own, for a formula each
        self._tokens = [
            (m.lastgroup or "", text[m.start() : m.end()]) for m in _TOKEN.finditer(text.text)
        ]
        self._at = 0
        self._depth = 0

    def latex(self) -> PlacedText:
        """The whole formula; closing brackets without an opening one stand for themselves.

        Raises:
            ParseError: for brackets nested too deeply.
        """
        parts = []
        while self._at < len(self._tokens):
            parts.append(self._sequence(""))
            if self._at < len(self._tokens):
                parts.append(self._next()[1])
        return PlacedText.joined(parts) if parts else self._text[:0]

    def _peek(self) -> tuple[str, str]:
        if self._at >= len(self._tokens):
            return "end", ""
        kind, token = self._tokens[self._at]
        return kind, token.text

    def _next(self) -> tuple[str, PlacedText]:
        self._at += 1
        return self._tokens[self._at - 1]

    def _sequence(self, until: str) -> PlacedText:
        """What stands up to one of some characters, or a closing bracket."""
        self._depth += 1
        if self._depth > DEEPEST:
            raise ParseError(f"brackets nested more than {DEEPEST} deep")
        try:
            return self._parts(until)
        finally:
            self._depth -= 1

    def _parts(self, until: str) -> PlacedText:
        parts: list[PlacedText] = []
        while True:
            kind, text = self._peek()
            if kind == "end" or (kind == "other" and text in f"{until})]}}"):
                return PlacedText.joined(parts) if parts else self._text[:0]
            if kind == "other" and text == "/":
                slash = self._next()[1]
                self._skip_space()
                above = _bare(_last(parts))
                below = _bare(self._attached())
                parts.append(_made(rf"\frac{{{above.text}}}{{{below.text}}}", slash, above, below))
            else:
                parts.append(self._attached())

    def _skip_space(self) -> None:
        while self._peek()[0] == "space":
            self._at += 1

    def _attached(self) -> PlacedText:
        """A letter, number, group or call, with its scripts."""
        parts = [self._atom()]
        while self._peek()[1] in ("_", "^"):
            mark = self._next()[1]
            parts += [mark, _braced(_bare(self._atom()))]
        return PlacedText.joined(parts)

    def _atom(self) -> PlacedText:
        if self._at >= len(self._tokens):
            return PlacedText.at("", self._text.end, self._text.end)
        kind, token = self._next()
        match kind:
            case "string":
                return _made(rf"\text{{{token.text[1:-1]}}}", token)
            case "sign" | "row":
                return _made(_SIGNS[token.text], token)
            case "word":
                return self._word(token)
            case "escape":
                return _made(token.text[1:], token)
        if token.text in _CLOSING:
            return self._group(token)
        return token

    def _group(self, opening: PlacedText) -> PlacedText:
        inside = self._sequence("")
        if self._peek()[1] != _CLOSING[opening.text]:
            return PlacedText.joined([opening, inside])
        return PlacedText.joined([opening, inside, self._next()[1]])

    def _word(self, token: PlacedText) -> PlacedText:
        name = token.text
        if self._peek()[1] == "(" and name in _CALLED:
            return self._call(name, token)
        if name in self._names:
            return _made(f"{{{self._names[name]}}}", token)
        if name not in _SYMBOLS and len(name) > 1:
            return _made(rf"\mathrm{{{name}}}", token)
        symbol = _made(_SYMBOLS[name], token) if name in _SYMBOLS else token
        if self._peek()[1] == "(" and (len(name) == 1 or name in _NAMES):  # f(x)/y divides f(x)
            return PlacedText.joined([symbol, self._group(self._next()[1])])
        return symbol

    def _call(self, name: str, token: PlacedText) -> PlacedText:
        rows = self._arguments()
        first = rows[0][0]
        if name in _SEVERAL:
            return _joined(token, rows, *_SEVERAL[name])
        if name in _FENCES:
            return _joined(token, [[first]], _FENCES[name][0], "", "", _FENCES[name][1])
        if name in _DERIVATIVES:
            *variables, last = rows[0]
            order = f"[{last.text}]" if last.text.isdecimal() else ""
            rows = [variables if order else rows[0]]
            rows = rows if first.text else [rows[0][1:]]
            return _joined(token, rows, f"{_DERIVATIVES[name]}{order}{{", "}{", "", "}")
        over = _OVER.get(rows[0][-1].text, r"\overset") if name == "accent" else _OVER[name]
        return PlacedText.joined([_made(over, token), _braced(first)])

    def _arguments(self) -> list[list[PlacedText]]:
        """Those in brackets, with ``;`` between rows; named ones are left out."""
        self._next()
        rows: list[list[PlacedText]] = [[]]
        while True:
            self._skip_space()
            here = [text.text for _, text in self._tokens[self._at : self._at + 2]]
            is_named = here[-1:] == [":"] and here[0].isalpha()
            start = self._at
            argument = self._sequence(",;").stripped()
            name = self._tokens[start][1] if self._at == start + 1 else argument
            if not is_named:
                rows[-1].append(name if name.text in _OVER else argument)
            mark = self._peek()[1]
            if mark not in (",", ";"):
                break
            rows += [[]] if mark == ";" else []
            self._next()
        if mark == ")":
            self._next()
        return [row for row in rows if row] or [[self._text[:0]]]


#: Functions of several arguments: what stands before, between and behind them, and between rows.
_SEVERAL = {
    "frac": (r"\frac{", "}{", "", "}"),
    "root": (r"\sqrt[", "]{", "", "}"),
    "binom": (r"\binom{", "}{", "", "}"),
    "vec": (r"\begin{pmatrix}", r"\\ ", "", r"\end{pmatrix}"),
    "mat": (r"\begin{pmatrix}", " & ", r"\\ ", r"\end{pmatrix}"),
    "cases": (r"\begin{cases}", r"\\ ", "", r"\end{cases}"),
    "underbrace": (r"\underbrace{", "}_{", "", "}"),
    "overbrace": (r"\overbrace{", "}^{", "", "}"),
}
_CALLED = {*_OVER, *_FENCES, *_SEVERAL, *_DERIVATIVES, "accent"}


def _joined(
    token: PlacedText,
    rows: list[list[PlacedText]],
    opening: str,
    between: str,
    between_rows: str,
    closing: str,
) -> PlacedText:
    """Arguments with LaTeX before, between and behind them, each at its own place."""
    parts = [PlacedText.at(opening, token.places[0], token.end)]
    for row in rows:
        for argument in row:
            end = parts[-1].end
            mark = "" if len(parts) == 1 else between_rows if argument is row[0] else between
            parts += [PlacedText.at(mark, end, end), argument]
    return PlacedText.joined([*parts, PlacedText.at(closing, parts[-1].end, parts[-1].end)])


def _last(parts: list[PlacedText]) -> PlacedText:
    """What stands before a slash, taken out of the parts."""
    while parts and not parts[-1].text.strip():
        parts.pop()
    return parts.pop() if parts else PlacedText.of("")


def _bare(text: PlacedText) -> PlacedText:
    """A group without the round brackets around it."""
    inner = text.text
    if not (inner.startswith("(") and inner.endswith(")")):
        return text
    depth = 0
    for place, character in enumerate(inner):
        depth += (character == "(") - (character == ")")
        if depth == 0 and place < len(inner) - 1:
            return text  # as in (a + b)(c + d)
    return text[1 : len(inner) - 1]


def _braced(text: PlacedText) -> PlacedText:
    return _made(f"{{{text.text}}}", text)


def _made(latex: str, *sources: PlacedText) -> PlacedText:
    """LaTeX in place of pieces of the text, all at the place of the first of them."""
    known = [source for source in sources if len(source)]
    start = min((source.places[0] for source in known), default=sources[0].end)
    end = max((source.end for source in known), default=sources[0].end)
    if latex.endswith(" ") and end > start:  # the blank behind a macro belongs to its last letter
        blank = PlacedText.at(" ", end - 1, end)
        return PlacedText.joined([PlacedText.at(latex[:-1], start, end - 1), blank])
    return PlacedText.at(latex, start, end)
