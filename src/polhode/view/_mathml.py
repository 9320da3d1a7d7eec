"""Formulas as MathML: expressions in pieces between which a line may break, and LaTeX."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache, lru_cache
from html import escape
from importlib.resources import files
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from polhode.algebra import Expr, mathml
from polhode.base import family_style
from polhode.view._html import Markup

_NAMESPACE = "{http://www.w3.org/1998/Math/MathML}"
_FUNCTIONS = ("sin", "cos", "tan", "exp", "sinh", "cosh", "tanh")
_ROWS = ("math", "mrow", "msqrt", "mstyle", "mtd")  # whose pieces stand side by side
_ALPHABETS = {"bold": "BOLD", "bold-italic": "BOLD ITALIC", "script": "SCRIPT"}
_LEAVES = ("mi", "mn", "mo", "mtext")
_AFTER = "0.25em"  # space after a sign at which a formula is cut
_LOW = "0.6em"  # height of a letter without its dots
# What a formula of a text may contain: the converter lets \href and \text bring in links, styles
# and elements of HTML.
_TAGS = frozenset({
    "math", "mrow", "mi", "mn", "mo", "ms", "mtext", "mspace", "mfrac", "msqrt", "mroot",
    "msup", "msub", "msubsup", "mover", "munder", "munderover", "mmultiscripts", "mprescripts",
    "none", "mstyle", "mpadded", "mphantom", "menclose", "mtable", "mtr", "mtd",
})  # fmt: skip
_ATTRIBUTES = frozenset({
    "display", "displaystyle", "scriptlevel", "form", "fence", "separator", "stretchy",
    "symmetric", "largeop", "movablelimits", "minsize", "maxsize", "lspace", "rspace", "width",
    "height", "depth", "voffset", "mathvariant", "accent", "accentunder", "linethickness",
    "notation", "rowspacing", "columnspacing", "rowalign", "columnalign", "rowlines",
    "columnlines", "frame", "rowspan", "columnspan",
})  # fmt: skip
_SIGNS = ("+", "−", "-")
_RELATIONS = ("=", ">", "<", "≈")
_CACHED = 512  # formulas: a notebook shows the same system again and again
_LONGEST = 2500  # characters of a formula that is still printed
_LONGEST_LATEX = 1500  # characters of LaTeX that is still typeset
_LONG_IN_TEXT = 20  # of a formula between words that may be broken
_LONG = 36  # letters, figures and signs in a bracket or fraction that may be broken
# Parts of LaTeX source that are not the formula: dollar signs, tags, labels, line ends, numbers.
_MARKS = re.compile(r"\$+|\\(?:tag|label)\*?\s*\{[^{}]*\}|\\n(?![A-Za-z])")
#: The converter takes a single upright letter for the italic one, unless it is in a group.
_UPRIGHT = re.compile(r"\\mathrm\{([A-Za-z])\}")
#: Punctuation that stays in the line of the formula before it.
_CLOSING = re.compile(r"[.,;:)]+")
_NUMBER = re.compile(r"(?:\\q?quad)?\s*(?:\(\d+\)|\\text\s*\{\s*\(\d+\)\s*\})\s*$")


@cache
def math_fonts() -> str:
    """The style that names the fonts of formulas, `--polhode-math`, on one line."""
    text = files("polhode.view").joinpath("math.css").read_text("utf-8")
    return " ".join(re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL).split())


def styled(style: str, within: str = ":root") -> str:
    """A style behind the fonts of formulas and the colours and sizes of all pages.

    Args:
        style: CSS.
        within: the selector of what it is for.
    """
    return f"{math_fonts()}\n{family_style(within)}{style}"


@dataclass(frozen=True)
class Formula:
    """A formula in pieces of MathML, between which a line may break.

    Attributes:
        name: heading; empty for none.
        pieces: MathML.
        spoken: the same on one line of text.
    """

    name: str
    pieces: tuple[str, ...]
    spoken: str


# --- expressions ---


@lru_cache(_CACHED)
def inline(expression: Expr) -> Markup:
    """A formula within text, which does not break."""
    return _written(_tree(expression.mathml()))


@lru_cache(_CACHED)
def equation(name: str, left: Expr, right: Expr) -> Formula:
    """left = right, which may break before every sign between two terms."""
    return _relation(name, left, "=", right)


def positive(expression: Expr) -> Formula:
    """expression > 0, which may break likewise."""
    return _relation("", expression, ">", Expr.of(0))


def alone(expression: Expr) -> Formula:
    """An expression by itself, which may break likewise."""
    spoken = expression.pretty()
    if len(spoken) > _LONGEST:
        return Formula("", (), f"… ({len(spoken):,} characters: too long to show)")
    return Formula("", tuple(_pieces(_row(expression))), spoken)


def listed(name: str, expressions: Iterable[Expr], words: str) -> Formula:
    """Some expressions, and what is to be said of them."""
    known = list(expressions)
    row: list[Element] = []
    for expression in known:
        row += [*_row(expression), leaf("mo", ",")]
    spoken = ", ".join(expression.pretty() for expression in known)
    return Formula(
        name, tuple(_pieces([*row[:-1], leaf("mtext", f": {words}")])), f"{spoken}: {words}"
    )


def opened_equation(left: Expr, right: Expr) -> tuple[Markup, ...]:
    """Pieces of left = right, which may break within long brackets and fractions as well."""
    row = [*_row(left), leaf("mo", "=", form="infix"), *_row(right)]
    return tuple(_pieces(list(_opened(row))))


def _relation(name: str, left: Expr, sign: str, right: Expr) -> Formula:
    spoken = f"{left.pretty()} {sign} {right.pretty()}"
    if len(spoken) > _LONGEST:
        cut = f"{left.pretty()} {sign} … ({len(spoken):,} characters: too long to show)"
        return Formula(name, (), cut)
    row = [*_row(left), leaf("mo", sign), *_row(right)]
    return Formula(name, tuple(_pieces(row)), spoken)


def _row(expression: Expr) -> list[Element]:
    return _side_by_side(_tree(expression.mathml()))


def _pieces(row: Sequence[Element], **attributes: str) -> Iterator[Markup]:
    """A row cut before what relates its sides and before every sign between two terms."""
    piece: list[Element] = []
    kept = _in_short_brackets(row)
    for place, element in enumerate(row):
        is_sign = element.tag == "mo" and element.text in _SIGNS and place not in kept
        opens = not piece or (piece[-1].tag == "mo" and piece[-1].text in ("(", "[", *_RELATIONS))
        if element.text in _RELATIONS or (is_sign and not opens):
            yield math(piece, **attributes)
            # Otherwise a sign at the start of a line is set close, as of a negative number.
            piece = [leaf("mo", element.text or "", form="infix", lspace="0", rspace=_AFTER)]
        else:
            piece.append(element)
    yield math(piece, **attributes)


def _in_short_brackets(row: Sequence[Element]) -> set[int]:
    """The places within brackets that are too short to be broken."""
    opened, kept = list[int](), set[int]()
    for place, element in enumerate(row):
        if element.tag == "mo" and element.text in ("(", "["):
            opened.append(place)
        elif element.tag == "mo" and element.text in (")", "]") and opened:
            start = opened.pop()
            if sum(map(_length, row[start:place])) <= _LONG:
                kept |= {*range(start, place)}
    return kept


def _opened(row: Iterable[Element]) -> Iterator[Element]:
    """Long brackets as their contents, and long fractions as a factor and a bracket."""
    for element in row:
        if element.tag == "mrow" and _length(element) > _LONG:
            yield from _opened(element)
        elif element.tag == "mfrac" and _length(element[0]) > _LONG:
            above, below = element
            factor = Element("mfrac")
            factor.extend([leaf("mn", "1"), below])
            yield factor
            yield leaf("mo", "(", fence="true", form="prefix")
            yield from _opened(above if above.tag == "mrow" else [above])
            yield leaf("mo", ")", fence="true", form="postfix")
        else:
            yield element


def _length(element: Element) -> int:
    return sum(not len(part) for part in element.iter())


# --- LaTeX ---


def typeset(latex: str) -> Markup:
    """LaTeX as MathML, without dollar signs and equation numbers; empty if it cannot be read."""
    root = _read(latex)
    return Markup() if root is None else _written(root)


def typeset_in_pieces(latex: str) -> tuple[Markup, ...]:
    """The same in pieces between which a line may break; none if it cannot be read."""
    root = _read(latex)
    return () if root is None else tuple(_pieces(_side_by_side(root), displaystyle="true"))


def _side_by_side(root: Element) -> list[Element]:
    return list(root[0] if len(root) == 1 and root[0].tag == "mrow" else root)


def _within_text(latex: str) -> Markup:
    """A formula between words, which may break if it is long."""
    root = _read(latex)
    if root is None:
        return Markup()
    if _length(root) <= _LONG_IN_TEXT:
        return _written(root)
    return Markup("\u200b".join(_pieces(_side_by_side(root))))


def words_with_formulas(words: str, plain: Callable[[str], str] = escape) -> Markup:
    """Words in which formulas between dollars are typeset, each with the punctuation after it.

    The rest is written by a function, by default as it is.
    """
    cut = words.split("$")
    for i in range(1, len(cut), 2):
        closing = _CLOSING.match(cut[i + 1])
        cut[i] = _within_text(cut[i])
        cut[i + 1] = plain(cut[i + 1][closing.end() if closing else 0 :])
        if closing:
            cut[i] = f'<span class="keep">{cut[i]}{closing[0]}</span>'
    return Markup("".join((plain(cut[0]), *cut[1:])))


def typeset_change(before: str, after: str) -> tuple[Markup, Markup]:
    """Two formulas as MathML; elements in which they differ have the class `changed`."""
    first, second = _read(before), _read(after)
    if first is None or second is None:
        return typeset(before), typeset(after)
    old, new = ([e for e in root.iter() if e.tag in _LEAVES] for root in (first, second))
    before_texts, after_texts = ([e.text or "" for e in leaves] for leaves in (old, new))
    matcher = SequenceMatcher(None, before_texts, after_texts, autojunk=False)
    for kind, i, j, k, n in matcher.get_opcodes():
        if kind != "equal":
            for element in (*old[i:j], *new[k:n]):
                element.set("class", "changed")
    return _written(first), _written(second)


def _read(latex: str) -> Element | None:
    bare = _NUMBER.sub("", _MARKS.sub(" ", latex).strip()).strip()
    if not bare or len(bare) > _LONGEST_LATEX:
        return None
    try:
        root = _tree(mathml(_UPRIGHT.sub(r"\\mathrm{{\1}}", bare)))
    except Exception:  # arbitrary LaTeX makes the converter raise errors of many types
        return None
    if any(element.tag not in _TAGS for element in root.iter()):
        return None
    for element in root.iter():
        element.attrib = {n: v for n, v in element.attrib.items() if n in _ATTRIBUTES}
    return root


# --- elements ---


def math(elements: Iterable[Element], **attributes: str) -> Markup:
    """A formula of elements side by side."""
    root, row = Element("math", attributes), Element("mrow")
    row.extend(elements)
    root.append(row)
    return _written(root)


def leaf(kind: str, text: str, **attributes: str) -> Element:
    """A letter, number or sign."""
    element = Element(kind, attributes)
    element.text = text
    return element


def _written(root: Element) -> Markup:
    return Markup(ElementTree.tostring(root, encoding="unicode", short_empty_elements=False))


def _tree(text: str) -> Element:
    """MathML as a tree, with the thin spaces that browsers do not set on their own."""
    root = ElementTree.fromstring(text)
    for element in root.iter():
        element.tag = element.tag.removeprefix(_NAMESPACE)
        _set_in_alphabet(element)
    for element in list(root.iter()):
        _lower_exponent(element)
    for row in [element for element in root.iter() if element.tag in ("math", "mrow", "mtd")]:
        _set_functions_apart(row)
    for row in root.iter():
        for i in reversed(range(1, len(row))):
            # Otherwise the bars of two adjacent fractions are drawn as one.
            if row.tag in _ROWS and row[i].tag == row[i - 1].tag == "mfrac":
                row.insert(i, _thin_space())
    return root


def _set_in_alphabet(element: Element) -> None:
    """A bold or script letter by its own character: browsers set mathvariant only if normal."""
    alphabet, text = element.get("mathvariant", ""), element.text or ""
    if alphabet not in _ALPHABETS or len(text) != 1:
        return
    plain = unicodedata.name(text, "").removeprefix("GREEK ").removeprefix("LATIN ")
    letter = plain.replace("LETTER ", "")
    for prefix in ("MATHEMATICAL ", ""):  # a few script letters are older than that alphabet
        for style in (_ALPHABETS[alphabet], _ALPHABETS[alphabet].removesuffix(" ITALIC")):
            with suppress(KeyError):
                element.text = unicodedata.lookup(f"{prefix}{style} {letter}")
                del element.attrib["mathvariant"]
                return


def _lower_exponent(element: Element) -> None:
    """The exponent of a dotted letter as high as of the letter alone, as TeX has it."""
    if element.tag in ("msup", "msubsup") and element[0].tag == "mover":
        base = Element("mpadded", height=_LOW)
        base.append(element[0])
        element[0] = base


def _set_functions_apart(row: Element) -> None:
    """A thin space around the names of functions, as in 2 sin θ, but not as in sin(a + b)."""
    for i in reversed(range(len(row))):
        name = row[i][0] if row[i].tag == "msup" else row[i]  # sin, or sin² and the like
        if name.tag != "mi" or name.text not in _FUNCTIONS:
            continue
        if i + 1 < len(row) and not _is_sign_or_bracket(row[i + 1]):
            row.insert(i + 1, _thin_space())
        if i and row[i - 1].tag != "mo":
            row.insert(i, _thin_space())


def _is_sign_or_bracket(element: Element) -> bool:
    first = element[0] if element.tag == "mrow" and len(element) else element
    return first.tag == "mo"


def _thin_space() -> Element:
    return Element("mspace", width="0.17em")
