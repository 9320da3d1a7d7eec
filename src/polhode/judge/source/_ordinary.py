r"""Formulas in ordinary signs: without boxes, phantoms and other things that only set the type.

Every change keeps the length of the text, so that all characters keep their places.
"""

from __future__ import annotations

import re

from polhode.judge.latex._units import unit_text
from polhode.judge.source._macros import argument_span, closing
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._signs import BRACKET, ENDS_OPEN, JOINING, SIGN, is_relation

_INVISIBLE = re.compile(r"\\(?:[vh]?phantom|label|footnote|cite|index)\s*\{")
_EMPTY = re.compile(r"[\^_]\s*\{\s*\}")
_QED = re.compile(r"\\qedhere(?![A-Za-z])")
_WRAPPER = re.compile(
    r"(?:\A|(?<=[&{(])|(?<=\\\\)|\\(?:boxed|fbox|ensuremath)|(?<=\\displaystyle)"
    r"|(?<=\\textstyle))\s*(?P<brace>\{)"
)
_MOST = 200  # braces looked at
_STACKED = re.compile(r"\\(?:overset|underset|stackrel)(?![A-Za-z])")
_RELATING = re.compile(r"\\mathrel(?![A-Za-z])")
_UNIT_BESIDE = re.compile(
    r"(?:\\[,;: ]|\\q?quad|~|\s)\s*\[\s*\\(?:text|mathrm|unit|si)\s*\{([^{}]*)\}\s*\]"
    r"\s*(?=[.,;&]|\\\\|\Z)"
)
_WIDE = re.compile(r"(?:\\;\s*){3,}|(?:\\ ){6,}|~{6,}")
_IN_ROW = re.compile(r"\\q?quad(?![A-Za-z])|(?:\\;\s*){2,}|(?:\\ ){2,}|~~+")


def ordinary(formula: PlacedText) -> PlacedText:
    r"""Without phantoms and boxes; = for ``\overset{!}{=}``, ≤ for <=, [a, b] for [a \quad b]."""
    text = _without_invisible(formula.masked(_QED).text)
    text = _EMPTY.sub(lambda match: " " * len(match[0]), text)
    text = _without_wrappers(text)
    text = _without_marks_on_signs(text)
    text = text.replace("<=>", "⇔  ").replace("=>", "⇒ ").replace("<=", "≤ ").replace(">=", "≥ ")
    text = _UNIT_BESIDE.sub(lambda m: " " * len(m[0]) if unit_text(m[1]) else m[0], text)
    text = _with_commas(text)
    return formula.with_text(_WIDE.sub(_gap, text))


def _blanked(text: str, start: int, end: int) -> str:
    return text[:start] + " " * (end - start) + text[end:]


def _without_invisible(text: str) -> str:
    for match in _INVISIBLE.finditer(text):
        end = closing(text, match.end() - 1)
        if end is not None:
            text = _blanked(text, match.start(), end + 1)
    return text


def _without_wrappers(text: str) -> str:
    """Without braces and boxes around whole relations, innermost first."""
    place = 0
    for _ in range(_MOST):
        match = _WRAPPER.search(text, place)
        if match is None:
            break
        start = match.start("brace")
        end = closing(text, start)
        if end is not None and is_relation(text[start + 1 : end]):
            text = _blanked(_blanked(text, match.start(), match.end()), end, end + 1)
            place = 0
        else:
            place = match.end()
    return text


def _without_marks_on_signs(text: str) -> str:
    """With the sign alone where something stands above or below it."""
    for pattern, count in ((_STACKED, 2), (_RELATING, 1)):
        for match in pattern.finditer(text):
            end, last = match.end(), None
            for _ in range(count):
                last = argument_span(text, end)
                end = last[2] if last else end
            sign = text[last[0] : last[1]].strip() if last else ""
            if SIGN.fullmatch(sign):
                text = f"{text[: match.start()]}{sign.ljust(end - match.start())}{text[end:]}"
    return text


def _with_commas(text: str) -> str:
    """With commas for wide spaces between the entries of a row in square brackets."""
    open_: list[str] = []
    spans = {match.start(): match.end() for match in _IN_ROW.finditer(text)}
    found: list[tuple[int, int]] = []
    for match in BRACKET.finditer(text):
        kind = match.lastgroup
        if kind in ("left", "begin"):
            open_.append(match[0][-1])
        elif kind in ("right", "end"):
            del open_[-1:]
        elif match.start() in spans and open_[-1:] == ["["]:
            found.append((match.start(), spans[match.start()]))
    for start, end in reversed(found):
        before, behind = text[:start], text[end:]
        is_entry = behind.lstrip().startswith("-") and not before.rstrip().endswith(("\\\\", "&"))
        joins = ENDS_OPEN.search(before) or (JOINING.match(behind) and not is_entry)
        if not joins and before.rstrip()[-1:] != ",":
            text = f"{before}{','.ljust(end - start)}{behind}"
    return text


def _gap(match: re.Match[str]) -> str:
    """A ``\\quad`` for a wide space that separates two relations."""
    before, behind = match.string[: match.start()], match.string[match.end() :]
    separates = is_relation(before) and is_relation(behind)
    return r"\quad".ljust(len(match[0])) if separates else match[0]
