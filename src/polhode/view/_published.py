"""Names and expressions as they are typed, such as phi_dot**2, set as formulas within words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

from polhode.algebra import Expr, Symbol, SymbolKind, read_expression
from polhode.base import PolhodeError
from polhode.view._html import Markup, joined
from polhode.view._mathml import typeset

_RELATIONS = {"=": "=", "<": "<", ">": ">", "<=": r"\le", ">=": r"\ge"}
_SIGNS = ("+", "-", "*", "/", *_RELATIONS)
_ORDERS = {"dot": 1, "ddot": 2, "dddot": 3}
_FUNCTIONS = ("sin", "cos", "tan", "sqrt", "abs", "exp", "pi", "t")
_NAME = re.compile(r"[A-Za-z]\w*")
_TYPED = re.compile(r"[\w.()*/+^-]*\w[\w.()*/+^-]*", re.ASCII)
_ENDING = re.compile(r"[.,;:]*$")
_COMPONENTS = re.compile(r"\(([^(),]+(?:, [^(),]+)+)\)")
#: LaTeX behind words that introduce it, up to the next remark.
_LATEX = re.compile(r"((?:read as|under the condition) )(\S.*?)(?=; |$)")


def words_with_published(words: str) -> Markup:
    """Words in which expressions as they are typed, and LaTeX that is announced, are typeset."""
    if (found := _LATEX.search(words)) and "\\" in found[2] and (formula := typeset(found[2])):
        return _around(words, found.span(2), formula)
    if (found := _COMPONENTS.search(words)) and (formula := _components(found[1])):
        return _around(words, found.span(), formula)
    return joined(_pieces(words.split(" ")), " ")


def _around(words: str, span: tuple[int, int], formula: Markup) -> Markup:
    before, after = words[: span[0]], words[span[1] :]
    return joined([words_with_published(before), formula, words_with_published(after)])


def _components(text: str) -> Markup:
    """Components of a vector; empty where one of them is no expression."""
    try:
        parts = [
            read_expression(part, {name: _letter(name) for name in _NAME.findall(part)}).latex()
            for part in text.split(", ")
        ]
    except PolhodeError:
        return Markup()
    return typeset(rf"\left({', '.join(parts)}\right)")


def _pieces(words: list[str]) -> Iterator[Markup]:
    """Runs of words that spell a formula, as long as possible; all others as they are."""
    place = 0
    while place < len(words):
        end = place
        while end < len(words) and (_is_part(words[end]) or words[end] in _SIGNS):
            end += 1
            if words[end - 1].endswith((".", ",", ";", ":")):
                break
        formula = Markup()
        while end > place and not (formula := _typeset(" ".join(words[place:end]))):
            end -= 1
        if formula:
            yield formula
            place = end
        else:
            yield Markup(escape(words[place]))
            place += 1


def _is_part(word: str) -> bool:
    return _TYPED.fullmatch(_ENDING.sub("", word)) is not None


def _typeset(text: str) -> Markup:
    """A typed formula with the punctuation behind it; empty for words that are none."""
    typed = _ENDING.sub("", text)
    names = {name for name in _NAME.findall(typed) if name not in _FUNCTIONS}
    letters = {name: _letter(name) for name in names}
    written = [value.latex() for value in letters.values()]
    is_word = any(latex.startswith(r"\mathrm") for latex in written)
    # A single Latin letter or a number may be a word as well; other letters are none.
    if is_word or not any("_" in latex or latex.startswith("\\") for latex in written):
        return Markup()
    cut = re.split(r" (<=|>=|=|<|>) ", typed)
    try:
        cut[::2] = [read_expression(side, letters).latex() for side in cut[::2]]
    except PolhodeError:
        return Markup()
    latex = " ".join(_RELATIONS.get(piece, piece) for piece in cut)
    return joined([typeset(latex), text[len(typed) :]])


def _letter(published: str) -> Expr:
    """The symbol with a published name, such as theta_ddot."""
    base, _, ending = published.rpartition("_")
    if order := _ORDERS.get(ending, 0):
        return Expr.generator(Symbol(base, SymbolKind.COORDINATE, order))
    return Expr.generator(Symbol(published))
