r"""Macros with arguments, and labels in front of letters, rewritten as plain mathematics.

The packages physics, mathtools and leftidx have words of their own for brackets, matrices and
labels; the frame of ``{}^N\boldsymbol\omega`` is set on an empty group. Each of them becomes the
tokens that say the same, so that the grammar does not have to know them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._labels import label_text, spells
from polhode.judge.latex._tokens import Token, refusal

_PAIRS = {"{": "}", "(": ")", "[": "]"}
_BEFORE_QUANTITY = {"sign", "row", "gap", "arrow", "begin", "prescript"}
_MARKS_BEFORE_QUANTITY = (*"{([&,;+-±∓×·*⊗/", "\\{", "bar(", "null(")
_QUANTITIES = {"letter", "decoration", "dots", "alphabet", "begin", "prescript", "rate"}
_SPACE = re.compile(r"(?:\\[,;: ]|~)\s*\Z")
_SHORT = {"c": "cos", "s": "sin"}
_LONGEST = 30  # tokens of a label in front
_SET_OFF = re.compile(r"(?:\\[,;: ]|~|\s)\{\}\Z")
_DEFINING = {"def", "Def", "Delta", "triangle"}
_ABOVE = {"°": ("rate", "circ"), "→": ("decoration", "arrow"), "↔": ("decoration", "arrow")} | {
    "≈": ("decoration", "tilde")
}


def rewritten(source: str, tokens: Sequence[Token]) -> list[Token]:
    """The tokens without macros of these packages, and with each label in front as one token.

    Raises:
        ParseError: for a macro without its arguments, or with ones that have no meaning.
    """
    tokens = _with_short_functions([_summing(tokens, place) for place in range(len(tokens))])
    edits = _Edits(source, tokens, _partners(tokens))
    for place, token in enumerate(tokens):
        if token.kind == "macro":
            REWRITES[token.text](edits, place)
    return _with_prescripts(source, edits.applied())


def _summing(tokens: Sequence[Token], place: int) -> Token:
    r"""A Σ before a quantity or an index as the sign of a sum: ``\Sigma F``, ``\Sigma_i m_i``."""
    token = tokens[place]
    if token.text != "Sigma" or any(t.is_mark("_", "^") for t in tokens[max(0, place - 2) : place]):
        return token
    behind, index = tokens[place + 1], tokens[min(place + 2, len(tokens) - 1)]
    is_indexed = behind.is_mark("_") and index.text in lexicon.INDICES
    sums = (
        is_indexed or behind.kind in _QUANTITIES | {"function", "fraction"} or behind.is_mark("(")
    )
    return replace(token, kind="summation", text="sum") if sums else token


def _with_short_functions(tokens: list[Token]) -> list[Token]:
    """With cosine and sine for a c and an s that both stand before the same angle: cθ, sθ."""
    before: dict[str, set[str]] = {"c": set(), "s": set()}
    for first, behind in pairwise(tokens):
        if first.text in before and behind.kind == "letter" and behind.text in lexicon.ANGLES:
            before[first.text].add(behind.text)
    if not before["c"] & before["s"]:
        return tokens
    return [
        replace(token, kind="function", text=_SHORT[token.text])
        if token.text in _SHORT and behind.kind == "letter" and behind.text in lexicon.ANGLES
        else token
        for token, behind in pairwise([*tokens, tokens[-1]])
    ]


def _partners(tokens: Sequence[Token]) -> dict[int, int]:
    """The position of the closing bracket for that of each opening one, as far as they match."""
    partner: dict[int, int] = {}
    unclosed: list[int] = []
    for place, token in enumerate(tokens):
        if token.is_mark(*_PAIRS):
            unclosed.append(place)
        elif unclosed and token.is_mark(_PAIRS[tokens[unclosed[-1]].text]):
            partner[unclosed.pop()] = place
    return partner


@dataclass
class _Edits:
    """What is to stand in place of some tokens; the others stay."""

    source: str
    tokens: Sequence[Token]
    partner: dict[int, int]
    new: dict[int, tuple[Token, ...]] = field(default_factory=dict)
    dropped: set[int] = field(default_factory=set)

    def applied(self) -> list[Token]:
        """The tokens with all changes made."""
        return [
            token
            for place, old in enumerate(self.tokens)
            if place not in self.dropped
            for token in self.new.get(place, (old,))
        ]

    def put(self, place: int, kind: str, text: str) -> None:
        """One token in place of another."""
        self.new[place] = (Token(kind, text, self.tokens[place].span),)

    def remove(self, start: int, end: int) -> None:
        """Leave out the tokens from one position up to another."""
        self.dropped.update(range(start, end))

    def end_of_argument(self, place: int) -> int:
        """The position behind the argument that begins here: a group or one token."""
        if self.tokens[place].kind in ("close", "row", "gap"):
            raise self.refused(place, "an argument of a macro that is missing", "its braces")
        return self.partner.get(place, place) + 1

    def inside(self, start: int, end: int) -> list[Token]:
        """The tokens of an argument, without braces."""
        return [token for token in self.tokens[start:end] if not token.is_mark("{", "}")]

    def refused(self, place: int, problem: str, expected: str) -> Exception:
        return refusal(self.source, self.tokens[place].span, problem, expected)


_Rewrite = Callable[[_Edits, int], None]


# -- brackets and matrices -----------------------------------------------------------------------


def _bracketed_by(kind: str, opener: str, closer: str, before: str = "") -> _Rewrite:
    r"""The argument between other brackets: ``\abs{x}`` is ``|x|``; one letter may go before."""
    kinds = ("mark", "mark") if kind == "mark" else ("begin", "end")

    def rewrite(edits: _Edits, place: int) -> None:
        first = place + 1
        if first not in edits.partner:
            raise edits.refused(place, "a macro without the bracket behind it", "its argument")
        edits.new[place] = ()
        if before:
            edits.put(place, "letter", before)
        edits.put(first, kinds[0], opener)
        edits.put(edits.partner[first], kinds[1], closer)

    return rewrite


def _automatic_bracket(edits: _Edits, place: int) -> None:
    r"""``\qty(x)`` of the package physics: the bracket behind it; braces are printed."""
    edits.new[place] = ()
    first = place + 1
    if edits.tokens[first].is_mark("{") and first in edits.partner:
        edits.put(first, "mark", "\\{")
        edits.put(edits.partner[first], "mark", "\\}")


# -- marks above and below -----------------------------------------------------------------------


def _above(edits: _Edits, place: int) -> None:
    r"""``\overset{def}{=}``, ``\stackrel{!}{=}``, ``\overset{\circ}{\mathbf L}``."""
    middle = edits.end_of_argument(place + 1)
    end = edits.end_of_argument(middle)
    label = edits.inside(place + 1, middle)
    below = edits.inside(middle, end)
    if [token.kind for token in below] == ["sign"]:
        is_definition = any(token.text in _DEFINING for token in label) or (
            "".join(token.text for token in label) in _DEFINING
        )
        edits.remove(place + 1, end)
        edits.put(place, "sign", "≡" if is_definition else below[0].text)
    elif len(label) == 1 and label[0].text in _ABOVE:
        edits.remove(place + 1, middle)
        edits.put(place, *_ABOVE[label[0].text])
    else:
        raise edits.refused(place, "a mark above a quantity", "a circle, an arrow or a tilde")


def _below(edits: _Edits, place: int) -> None:
    r"""``\underset{\sim}{L}``, a vector."""
    middle = edits.end_of_argument(place + 1)
    label = edits.inside(place + 1, middle)
    if len(label) != 1 or label[0].text not in ("≈", "→"):
        raise edits.refused(place, "a mark below a quantity", "a tilde or an arrow")
    edits.remove(place + 1, middle)
    edits.put(place, "decoration", "arrow")


def _arrow_with_words(edits: _Edits, place: int) -> None:
    edits.remove(place + 1, edits.end_of_argument(place + 1))
    edits.put(place, "sign", "→")


# -- labels in front of letters ------------------------------------------------------------------


def _in_front(edits: _Edits, place: int) -> None:
    r"""``\leftexp{N}{\omega}``, and ``\prescript{N}{}{\omega}`` up to the empty group."""
    end = edits.end_of_argument(place + 1)
    label = _name_in_front(edits, place, edits.inside(place + 1, end))
    edits.remove(place + 1, end)
    edits.put(place, "prescript", label)


def _in_front_above(edits: _Edits, place: int) -> None:
    _in_front(edits, place)
    start = edits.end_of_argument(place + 1)
    end = edits.end_of_argument(start)
    if below := edits.inside(start, end):
        above = edits.new[place][0].text
        edits.put(place, "prescript", f"{above};{_name_in_front(edits, place, below)}")
    edits.remove(start, end)


def _name_in_front(edits: _Edits, place: int, label: Sequence[Token]) -> str:
    """The text of a label in front, which a semicolon sets off from one below it."""
    is_name = label_text(label) and label[-1].kind not in ("decoration", "dots")
    if not is_name or not all(spells(token) and not token.is_mark(";") for token in label):
        raise edits.refused(place, "a label in front without letters", "the name of a frame")
    return label_text(label)


REWRITES: dict[str, _Rewrite] = {
    "qty": _automatic_bracket,
    "quantity": _automatic_bracket,
    "order": _bracketed_by("mark", "(", ")", before="O"),
    "eval": _bracketed_by("mark", "null(", "bar)"),
    "overset": _above,
    "stackrel": _above,
    "underset": _below,
    "xrightarrow": _arrow_with_words,
    "mathring": lambda edits, place: edits.put(place, "rate", "circ"),
    "leftidx": lambda edits, place: edits.remove(place, place + 1),
    "leftexp": _in_front,
    "prescript": _in_front_above,
    **dict.fromkeys(("abs", "absolutevalue", "norm"), _bracketed_by("mark", "bar(", "bar)")),
    **dict.fromkeys(
        ("mqty", "pmqty", "bmqty", "matrixquantity"),
        _bracketed_by("environment", "pmatrix", "pmatrix"),
    ),
}


# -- prescripts ----------------------------------------------------------------------------------


def _with_prescripts(source: str, tokens: Sequence[Token]) -> list[Token]:
    r"""Each ``{}^N`` as one token; so is ``^N`` where there is nothing that it could stand on."""
    partner = _partners(tokens)
    kept: list[Token] = []
    place = 0
    while place < len(tokens):
        is_free = tokens[place].is_mark("^", "_") and _is_free(source, tokens[place], kept)
        above, below, end = _scripts_in_front(tokens, partner, place if is_free else None)
        if not above or not _is_prescript(source, tokens, (place, end), above, kept):
            kept.append(tokens[place])
            place += 1
            continue
        if _ends_with_empty_group(kept):
            del kept[-2:]
        elif tokens[end].is_mark("}"):  # {^N}\omega
            kept.pop()
            end += 1
        text = ";".join(filter(None, map(label_text, (above, below))))
        kept.append(Token("prescript", text, tokens[place].span))
        place = end
    return kept


def _scripts_in_front(
    tokens: Sequence[Token], partner: dict[int, int], place: int | None
) -> tuple[list[Token], list[Token], int]:
    """What stands above and below in scripts that begin here, and the position behind them."""
    scripts: dict[str, list[Token]] = {}
    if place is None:
        return [], [], 0
    while tokens[place].is_mark("^", "_") and tokens[place].text not in scripts:
        end = partner.get(place + 1, place + 1) + 1
        has_semicolon = any(token.is_mark(";") for token in tokens[place:end])
        if has_semicolon or end >= min(len(tokens), place + _LONGEST):
            return [], [], place
        inside = [token for token in tokens[place + 1 : end] if not token.is_mark("{", "}")]
        scripts[tokens[place].text], place = inside, end
    return scripts.get("^", []), scripts.get("_", []), place


def _is_prescript(
    source: str,
    tokens: Sequence[Token],
    place: tuple[int, int],
    above: Sequence[Token],
    kept: Sequence[Token],
) -> bool:
    """Whether scripts from one position up to another belong to the quantity behind them."""
    start, end = place
    is_number = [token.kind for token in above] == ["number"]
    # x{}^2 is a power, but behind a sign or set off, ^0 v is v seen from frame 0.
    is_set_off = _has_nothing_before(kept) or _SET_OFF.search(source[: tokens[start].span[0]])
    is_named = (is_set_off and tokens[start].is_mark("^")) if is_number else _names_frame(above)
    if not is_named:
        return False
    is_wrapped = tokens[end].is_mark("}") and kept and kept[-1].is_mark("{")
    behind = tokens[end + 1 if is_wrapped else end]
    if is_number and not _has_nothing_before(kept) and source[behind.span[0] - 1].isspace():
        return False
    return behind.kind in _QUANTITIES or behind.is_mark("[", "(", "{", "^")


def _is_free(source: str, token: Token, kept: Sequence[Token]) -> bool:
    """Whether nothing stands in front that a superscript could belong to."""
    if _ends_with_empty_group(kept) or _has_nothing_before(kept):
        return True
    before, behind = source[max(0, token.span[0] - 4) : token.span[0]], source[token.span[1] :][:3]
    # Behind a space, e^x is still a power; the names of frames are capitals or script letters.
    is_capital = behind.lstrip(" {")[:1].isupper() or "\\" in behind
    return _SPACE.search(before) is not None and is_capital


def _has_nothing_before(kept: Sequence[Token]) -> bool:
    """Whether a quantity begins here, perhaps behind an empty group."""
    kept = kept[:-2] if _ends_with_empty_group(kept) else kept
    before = kept[-1:]
    if not before:
        return True
    if len(kept) > 1 and kept[-2].is_mark("_", "^"):
        return False  # in a label, or behind one
    return before[0].kind in _BEFORE_QUANTITY or before[0].is_mark(*_MARKS_BEFORE_QUANTITY)


def _ends_with_empty_group(kept: Sequence[Token]) -> bool:
    return len(kept) > 1 and kept[-1].is_mark("}") and kept[-2].is_mark("{")


def _names_frame(inside: Sequence[Token]) -> bool:
    """Whether a superscript is the name of a frame: N, or B/N, in whatever font; no T."""
    printed = [token for token in inside if not token.is_mark("{", "}")]
    if not printed or printed[0].kind not in ("letter", "alphabet"):
        return False
    is_transpose = [token.text for token in printed] == ["T"]
    return not is_transpose and all(spells(token) for token in printed)
