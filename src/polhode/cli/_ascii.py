"""Formulas in ASCII, for terminals whose encoding lacks the letters and signs of formulas.

θ̈ is written theta_ddot, ω₃² omega_3^2, sin²θ sin(theta)^2 and √g sqrt(g), in the names that options
and scripts take. It is an error handler of Python's codecs: what an encoding does have is kept, and
whatever is printed is covered.
"""

from __future__ import annotations

import codecs
import re
import unicodedata
from itertools import takewhile

HANDLER = "polhode.ascii"

#: Marks above a letter, by what they are in names.
_MARKS = {
    "\u0307": "_dot", "\u0308": "_ddot", "\u20db": "_dddot",
    "\u0302": "_hat", "\u0304": "_bar", "\u20d7": "_vec",
}  # fmt: skip
#: Composed letters with these marks are of formulas: others are of words, such as ü and ê.
_MARKED = {"\u0307": "abcdefghklmnopqrstuvwxyzFLNPTV", "\u0308": "xwthXW", "\u0302": "zsyxnwghjc"}
_SIGNS = {
    "−": "-", "–": "-", "—": "--", "‑": "-", "×": " x ", "·": ".", "⋅": ".", "∙": ".", "±": "+-",
    "∓": "-+", "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "≃": "~", "∼": "~", "≅": "~", "≡": "==",
    "≪": "<<", "≫": ">>", "→": "->", "↦": "|->", "↔": "<->", "⇒": "=>", "⇐": "<==", "⇔": "<=>",
    "↳": ">", "∝": "~", "∞": "infinity", "∂": "d", "∫": "int ", "∇": "grad ", "∈": " in ",
    "∀": "for all ", "⊗": "(x)", "∴": "therefore", "∵": "since", "°": " deg", "′": "'", "″": "''",
    "‘": "'", "’": "'", "“": '"', "”": '"', "⋯": "...", "✓": "+", "✗": "x", "─": "-", "│": "|",
    "\ufffd": "?", "•": "*", "√": "sqrt", "⁄": "/",
}  # fmt: skip
_FUNCTION = re.compile(r"(?<![A-Za-z])(?:arc)?(?:sin|cos|tan|cot|exp|log|ln)h?\Z")
_DIFFERENTIAL = re.compile(r"(?<![^\W\d_])[d∂]\Z")


def register() -> str:
    """Make the handler known to Python; its name, for ``errors=`` of a stream."""
    codecs.register_error(HANDLER, _spelled_out)
    return HANDLER


def in_ascii(text: str) -> str:
    """A text with its formulas, and all else, in ASCII."""
    return text.encode("ascii", errors=register()).decode("ascii")


def _spelled_out(error: UnicodeError) -> tuple[str, int]:
    """What takes the place of a sign that cannot be encoded, and where the text goes on."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text, start = error.object, error.start
    before = text[:start]
    power, end = _power(text, start)
    if power:
        inside, after = _argument(text, end) if _FUNCTION.search(before) else ("", end)
        return (f"({inside})^{power}", after) if inside else (f"^{power}", end)
    name, end = _name(text, start)
    if name:
        return _apart(name, before, text[end : end + 1]), end
    if text[start] == "√":
        inside, after = _argument(text, start + 1)
        return (f"sqrt({inside})", after) if inside else ("sqrt", start + 1)
    return _sign(text[start], before, text[start + 1 : start + 2]), start + 1


# -- pieces of a text, each with the place behind it -----------------------------------------------


def _power(text: str, place: int) -> tuple[str, int]:
    """An exponent, such as ⁻¹; empty for none."""
    raised = _run(text, place, "<super>")
    return "".join(map(_plain, raised)), place + len(raised)


def _name(text: str, place: int) -> tuple[str, int]:
    """A letter with its marks, primes and subscripts, or those behind a letter before it."""
    letter, mark = _letter(text[place])
    place += bool(letter)
    dots, place = (mark, place) if mark else _mark(text, place)
    rest = "".join(_ascii_word(text[place:])) if dots and not _is_greek(letter) else ""
    place += len(rest)
    primes = len(text[place:]) - len(text[place:].lstrip("′"))
    place += primes
    subscripts, place = _subscripts(text, place)
    return f"{letter}{rest}{'prime' * primes}{subscripts}{dots}", place


def _letter(character: str) -> tuple[str, str]:
    """A letter that is spelled out, and the mark above it; empty for other characters."""
    if name := _greek(character):
        return name, ""
    base, mark = (*unicodedata.normalize("NFD", character), "", "")[:2]
    return (base, _MARKS[mark]) if base in _MARKED.get(mark, "") else ("", "")


def _mark(text: str, place: int) -> tuple[str, int]:
    """A mark of its own, or the number of dots in brackets."""
    found = _MARKS.get(text[place : place + 1], "")
    if found:
        return found, place + 1
    order = _run(text, place + 1, "<super>")
    end = place + 1 + len(order)
    if text[place : place + 1] == "⁽" and text[end : end + 1] == "⁾":
        return f"_d{''.join(map(_plain, order))}", end + 1
    return "", place


def _subscripts(text: str, place: int) -> tuple[str, int]:
    """Subscripts, lowered ones or behind an underscore."""
    written = ""
    while place < len(text):
        lowered = _run(text, place, "<sub>")
        behind = text[place + 1 :] if text[place] == "_" else ""
        word = "".join(takewhile(lambda c: c.isalnum() and not _is_placed(c), behind))
        if not (lowered or word):
            break
        written += f"_{''.join(_greek(c) or _plain(c) for c in lowered or word)}"
        place += len(lowered) or 1 + len(word)
    return written, place


def _argument(text: str, place: int) -> tuple[str, int]:
    """What a function or a root is taken of: a bracket, a name or a number; empty for neither."""
    start = place + (text[place : place + 1] == " ")
    if text[start : start + 1] == "(":
        depth = 0
        for end in range(start, len(text)):
            depth += (text[end] == "(") - (text[end] == ")")
            if not depth:
                return in_ascii(text[start + 1 : end]), end + 1
        return "", place
    word = re.compile(r"\d+(?:\.\d+)?|[A-Za-z]?").match(text, start)
    assert word is not None  # it matches the empty text
    more, end = ("", word.end()) if word[0].isdigit() else _name_behind(text, word.end())
    found = f"{word[0]}{more}"
    return (found, end) if found else ("", place)


def _name_behind(text: str, place: int) -> tuple[str, int]:
    return _name(text, place) if place < len(text) else ("", place)


# -- single characters -----------------------------------------------------------------------------


def _apart(name: str, before: str, after: str) -> str:
    """A name set apart from letters and digits beside it; in brackets behind a function."""
    if name.startswith("prime") and not before[-1:].isalpha():
        return name.replace("prime", "'")
    if not name[0].isalpha() or name.startswith("prime"):
        return name
    if _FUNCTION.search(before.rstrip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻")):
        return f"({name})"
    last = before[-1:]
    touches = last.isalnum() or bool(last and unicodedata.combining(last))
    left = " " if touches and not _DIFFERENTIAL.search(before) else ""
    right = " " if after.isascii() and after.isalnum() else ""
    return f"{left}{name}{right}"


def _greek(character: str) -> str:
    """The English name of a Greek letter; empty for other characters."""
    if _is_placed(character):
        return ""
    form = unicodedata.normalize("NFKD", character)[0]
    words = unicodedata.name(form, "").split()
    if words[:1] != ["GREEK"] or "LETTER" not in words:
        return ""
    name = words[words.index("LETTER") + 1 :][-1].lower().replace("lamda", "lambda")
    return name.title() if "CAPITAL" in words else name


def _is_greek(name: str) -> bool:
    return len(name) > 1


def _sign(character: str, before: str, after: str) -> str:
    """Any other character, between its neighbours."""
    if character in _SIGNS:
        sign = _SIGNS[character].lstrip() if before[-1:].isspace() else _SIGNS[character]
        return sign.rstrip() if after.isspace() else sign
    form = unicodedata.normalize("NFKD", character)
    if unicodedata.decomposition(character).startswith("<fraction>"):
        return " " * before[-1:].isdigit() + form.replace("\u2044", "/")
    plain = "".join(c for c in form if not "\u0300" <= c <= "\u0333")  # accents of words
    if plain.isascii():
        return plain
    return "?" if "\ud800" <= character <= "\udfff" else ascii(character)[1:-1]


def _run(text: str, place: int, kind: str) -> str:
    """The characters from a place on that are raised or lowered, but for brackets."""
    end = place
    while end < len(text) and _is_placed(text[end], kind) and text[end] not in "⁽⁾":
        end += 1
    return text[place:end]


def _is_placed(character: str, *kinds: str) -> bool:
    """Whether a character is raised or lowered."""
    return unicodedata.decomposition(character).startswith(kinds or ("<super>", "<sub>"))


def _plain(character: str) -> str:
    """The character that one is a raised or lowered form of."""
    plain = unicodedata.normalize("NFKD", character).replace("−", "-")
    return _greek(plain) or plain


def _ascii_word(text: str) -> list[str]:
    return list(takewhile(lambda c: c.isascii() and c.isalnum(), text))
