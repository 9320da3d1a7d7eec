r"""Slips made in the characters of a printed formula, as a compositor or a tired author makes them.

Nothing here knows what a formula means: the text is cut into tokens, and a slip changes some of
them. It shares nothing with polhode, neither its parser nor its search for corrections.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|\s+|.", re.DOTALL)
_RELATIONS = {"=", "<", ">", r"\approx", r"\ge", r"\le", r"\geq", r"\leq", r"\equiv", r"\simeq"}
_TURNED = {
    "<": ">",
    ">": "<",
    r"\ge": r"\le",
    r"\le": r"\ge",
    r"\geq": r"\leq",
    r"\leq": r"\geq",
}
_SIGNS = {"+": "-", "-": "+", r"\pm": "+"}
_OPEN, _CLOSE = {"{", "(", "["}, {"}", ")", "]"}
_FUNCTIONS = {
    r"\sin": r"\cos",
    r"\cos": r"\sin",
    r"\tan": r"\cot",
    r"\cot": r"\tan",
    r"\sinh": r"\cosh",
    r"\cosh": r"\sinh",
    r"\tanh": r"\operatorname{sech}",
}
_GREEK = re.compile(
    r"\\(alpha|beta|gamma|delta|(var)?epsilon|zeta|eta|theta|iota|kappa|lambda|mu|nu|xi|rho|sigma|tau"
    r"|(var)?phi|chi|psi|omega|Omega|Gamma|Delta|Theta|Lambda|Phi|Psi|ell)"
)
_DOTS = {r"\dot": "", r"\ddot": r"\dot", r"\dddot": r"\ddot"}
_FRACTIONS = {r"\frac", r"\tfrac", r"\dfrac"}
#: Commands whose group is no formula.
_WORDS = {
    r"\tag",
    r"\text",
    r"\textrm",
    r"\textit",
    r"\mathrm",
    r"\rm",
    r"\operatorname",
    r"\begin",
    r"\end",
    r"\label",
}
_FACES = {r"\mathbf", r"\boldsymbol", r"\hat", r"\vec", r"\bm"}
_BETWEEN = {",", ";", r"\qquad", r"\quad", r"\\", "&", "$$", "$"}


@dataclass(frozen=True)
class TextMutant:
    """A formula with one slip."""

    slip: str
    latex: str


@dataclass(frozen=True)
class _Atom:
    """A letter with its accents and indices: tokens from `start` up to `stop`."""

    start: int
    stop: int
    text: str


def _tokens(latex: str) -> Iterator[str]:
    r"""Tokens; of the digits in \frac12 each is an argument."""
    bare = 0
    for token in _TOKEN.findall(latex):
        if bare and token.isdigit():
            single = token[:bare]
            yield from single
            if token[bare:]:
                yield token[bare:]
            bare -= len(single)
            continue
        yield token
        if token in _FRACTIONS:
            bare = 2
        elif not token.isspace():
            bare = 0 if token == "{" else max(0, bare - 1)


class _Text:
    """The tokens of a formula, and what may be changed among them."""

    def __init__(self, latex: str) -> None:
        self.tokens: list[str] = list(_tokens(latex))
        self.partner = self._partners()
        self.fixed = self._fixed()

    def _partners(self) -> dict[int, int]:
        found: dict[int, int] = {}
        opened: list[int] = []
        for i, token in enumerate(self.tokens):
            if token in _OPEN:
                opened.append(i)
            elif token in _CLOSE and opened:
                j = opened.pop()
                found[i], found[j] = j, i
        return found

    def _fixed(self) -> set[int]:
        """Tokens that are words, numbers of equations, or indices in words."""
        found: set[int] = set()
        for i, token in enumerate(self.tokens):
            following = self.after(i)
            if token in _WORDS and following in self.partner:
                found |= set(range(i, self.partner[following] + 1))
            elif token == r"\rm":  # up to the end of its group
                found |= set(range(i, self._end_of_group(i)))
        found |= self._label()
        return found

    def _end_of_group(self, i: int) -> int:
        while i < len(self.tokens) and self.tokens[i] not in _CLOSE:
            i = self.partner.get(i, i) + 1
        return i

    def _label(self) -> set[int]:
        """A number of an equation in brackets at the end, and all outside of displays."""
        shown = [i for i, pair in enumerate(pairwise(self.tokens)) if pair == ("$", "$")]
        if shown:
            inside: set[int] = set()
            for start, stop in zip(shown[::2], shown[1::2], strict=False):
                inside |= set(range(start + 2, stop))
            return set(range(len(self.tokens))) - inside
        text = "".join(self.tokens)
        label = re.search(r"\(\d+\)\s*$", text)
        if label is None:
            return set()
        at, found = 0, set()
        for i, token in enumerate(self.tokens):
            if at >= label.start():
                found.add(i)
            at += len(token)
        return found

    def after(self, i: int) -> int:
        """The next token that is not blank."""
        i += 1
        while i < len(self.tokens) and self.tokens[i].isspace():
            i += 1
        return i

    def at(self, i: int) -> str:
        return self.tokens[i] if 0 <= i < len(self.tokens) else ""

    def group_end(self, i: int) -> int:
        """The end of one argument of a command, which is a group or one token."""
        return self.partner[i] + 1 if i in self.partner and self.at(i) in _OPEN else i + 1

    def replaced(self, start: int, stop: int, *new: str) -> str:
        tokens = [*self.tokens[:start], *new, *self.tokens[stop:]]
        joined = ""
        for token in tokens:  # \cos and a letter must not run together
            if re.search(r"\\[A-Za-z]+$", joined) and re.match(r"[A-Za-z]", token):
                joined += " "
            joined += token
        return joined

    def text(self, start: int, stop: int) -> str:
        return "".join(self.tokens[start:stop])

    # -- letters ----------------------------------------------------------------------------------

    def atoms(self) -> Iterator[_Atom]:
        i = 0
        while i < len(self.tokens):
            stop = self._atom_end(i)
            if stop is None:
                i += 1
                continue
            yield _Atom(i, stop, self.text(i, stop))
            i = stop

    def _atom_end(self, i: int) -> int | None:
        token = self.at(i)
        if i in self.fixed:
            return None
        if token in _DOTS or token in _FACES:
            inner = self.after(i)
            end = self.group_end(inner)
        elif _GREEK.fullmatch(token) or re.fullmatch("[A-Za-z]", token):
            end = i + 1
        else:
            return None
        while (following := self._skipped(end)) < len(self.tokens) and self.at(following) in "_'":
            end = following + 1
            if self.at(following) == "_":
                end = self.group_end(self.after(following))
        return end

    def _skipped(self, i: int) -> int:
        return i if i < len(self.tokens) and not self.at(i).isspace() else self.after(i - 1)

    def in_index(self, i: int) -> bool:
        """Whether a token is part of an index or an exponent."""
        return any(a <= i < b for a, b in self._indices)

    @property
    def _indices(self) -> list[tuple[int, int]]:
        return [
            (i, self.group_end(self.after(i)))
            for i, token in enumerate(self.tokens)
            if token in ("_", "^")
        ]

    # -- terms ------------------------------------------------------------------------------------

    def starts_of_terms(self) -> Iterator[int]:
        """Where a term begins: after a sign, a relation, an opening bracket, or at the start."""
        for i, token in enumerate(self.tokens):
            if i in self.fixed or self.in_index(i):
                continue
            if token in _RELATIONS or token in _SIGNS or token in ("(", "["):
                yield self.after(i)

    def term_end(self, i: int) -> int:
        """Where the term that begins here ends."""
        while i < len(self.tokens):
            token = self.at(i)
            if token in _CLOSE or token in _BETWEEN or token in _RELATIONS:
                return i
            if token in _SIGNS or token == r"\mp" or token in (r"\right", r"\tag"):
                return i
            if i in self.fixed and token not in _WORDS - {r"\tag"}:
                return i
            i = self.partner[i] + 1 if i in self.partner and token in _OPEN else i + 1
        return i


def text_mutants(latex: str, letters: Sequence[str] = ()) -> list[TextMutant]:
    """Every slip of a formula, once each.

    Args:
        latex: the formula as printed.
        letters: further letters of the same text, one of which may stand for another of other case.
    """
    text = _Text(latex)
    found = {
        mutant.latex: mutant
        for slips in _SLIPS
        for mutant in slips(text, letters)
        if _squeezed(mutant.latex) != _squeezed(latex)
    }
    return list(found.values())


def _squeezed(latex: str) -> str:
    return re.sub(r"\s+", "", latex)


def _functions(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token in _FUNCTIONS and i not in text.fixed:
            yield TextMutant("sine for cosine", text.replaced(i, i + 1, _FUNCTIONS[token]))


def _signs(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if i in text.fixed or (text.in_index(i) and text.at(i - 1) in "_"):
            continue
        if token in _SIGNS:
            yield TextMutant("sign", text.replaced(i, i + 1, _SIGNS[token]))
    for i in text.starts_of_terms():
        before = next((t for t in reversed(text.tokens[:i]) if not t.isspace()), "")
        if before in _RELATIONS and text.at(i) not in {*_SIGNS, "0", ""}:
            yield TextMutant("sign", text.replaced(i, i, "-"))


def _numbers(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i in text.starts_of_terms():
        if text.at(i) not in {*_SIGNS, *_CLOSE, "0", ""} and not text.at(i).isdigit():
            yield TextMutant("factor 2 added", text.replaced(i, i, "2 "))
    for i, token in enumerate(text.tokens):
        if i in text.fixed or not token[0].isdigit() or text.in_index(i):
            continue
        if token == "1" and _is_bare(text, i):  # 1/2 becomes 1/3, not 2/2
            continue
        if _is_named(text, i):
            continue
        if token not in ("0", "1") and not _is_alone(text, i) and not _is_bare(text, i):
            yield TextMutant("number dropped", text.replaced(i, i + 1))
        if token != "0":
            yield TextMutant("number", text.replaced(i, i + 1, _changed(token)))


def _is_named(text: _Text, i: int) -> bool:
    """Whether a number names an axis: 3 in \\hat{\\mathbf{3}}."""
    before = [t for t in text.tokens[max(0, i - 4) : i] if t not in "{ "]
    return bool(before) and before[-1] in _FACES


def _is_bare(text: _Text, i: int) -> bool:
    r"""Whether a token is an argument without braces, as both are in \frac12."""
    before = [t for t in text.tokens[max(0, i - 3) : i] if not t.isspace()]
    last, second = (before[-1:] or [""])[0], (before[-2:-1] or [""])[0]
    alone = re.fullmatch(r"\d|[A-Za-z]", last) is not None
    return last in _FRACTIONS or (alone and second in _FRACTIONS)


def _is_alone(text: _Text, i: int) -> bool:
    """Whether a number is a whole group or side."""
    neighbours = (text.at(i - 1), text.at(text.after(i)))
    return all(t in {*_OPEN, *_CLOSE, *_RELATIONS, *_SIGNS, *_BETWEEN, "", "/"} for t in neighbours)


def _changed(number: str) -> str:
    """A number with its last digit changed."""
    return number[:-1] + str((int(number[-1]) + 1) % 10)


def _exponents(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token != "^" or i in text.fixed:
            continue
        start = text.after(i)
        end = text.group_end(start)
        inner = text.text(start, end).strip("{} ")
        if inner.isdigit():
            yield TextMutant("exponent", text.replaced(start, end, str(int(inner) + 1)))
            yield TextMutant("exponent dropped", text.replaced(i, end))
    for atom in text.atoms():
        following = text.at(text._skipped(atom.stop))
        if (
            following not in ("^", "'")
            and not text.in_index(atom.start)
            and not _argument(text, atom)
        ):
            yield TextMutant("exponent added", text.replaced(atom.stop, atom.stop, "^2"))


def _argument(text: _Text, atom: _Atom) -> bool:
    """Whether a letter is the argument of a command or a function, or carries a hat."""
    if any(face in atom.text for face in _FACES):
        return True
    before = [t for t in text.tokens[max(0, atom.start - 6) : atom.start] if not t.isspace()]
    while len(before) > 1 and before[-2] == "^":  # sin² x
        del before[-2:]
    last, second = (before[-1:] or [""])[0], (before[-2:-1] or [""])[0]
    alone = re.fullmatch(r"\d|[A-Za-z]", last) is not None
    return last in {*_FUNCTIONS, *_FACES, *_FRACTIONS} or (alone and second in _FRACTIONS)


def _indices(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if i in text.fixed or text.at(i) not in ("1", "2", "3"):
            continue
        before = text.at(i - 1), text.at(i - 2) + text.at(i - 1)
        if before[0] == "_" or before[1] == "_{" or _is_named(text, i):
            for other in "123":
                if other != token:
                    yield TextMutant("index", text.replaced(i, i + 1, other))


def _letters(text: _Text, letters: Sequence[str]) -> Iterator[TextMutant]:
    """One letter for another of the same alphabet that the formula has, its dots kept."""
    bases = [b for a in text.atoms() if (b := _base(text, a)) is not None]
    names = list(dict.fromkeys(b.text for b in bases))
    for base in bases:
        if text.in_index(base.start):
            continue
        for other in names:
            if other != base.text and (other[0] == "\\") == (base.text[0] == "\\"):
                new = f"{{{other}}}" if "_" in other and text.at(base.start - 1) != "{" else other
                yield TextMutant("letter", text.replaced(base.start, base.stop, new))
        if len(base.text) == 1 and base.text.swapcase() in letters:
            other = base.text.swapcase()
            yield TextMutant("case of a letter", text.replaced(base.start, base.stop, other))


def _base(text: _Text, atom: _Atom) -> _Atom | None:
    """A letter without its dots; None for what is no plain letter."""
    start = atom.start
    if text.at(start) in _DOTS:
        start = text.after(start)
        start += text.at(start) == "{"
        if (stop := text._atom_end(start)) is None:
            return None
        return _Atom(start, stop, text.text(start, stop))
    if any(face in atom.text for face in _FACES) or atom.text in ("d", "t"):
        return None
    return atom


def _dots(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token in _DOTS and i not in text.fixed:
            fewer = [_DOTS[token]] if _DOTS[token] else []
            stop = i + 1 if fewer else text.after(i)
            yield TextMutant("dot dropped", text.replaced(i, stop, *fewer))


def _terms(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token in ("+", "-") and i not in text.fixed and not text.in_index(i):
            end = text.term_end(text.after(i))
            before = next((t for t in reversed(text.tokens[:i]) if not t.isspace()), "")
            if before not in {*_RELATIONS, *_OPEN, ""}:
                yield TextMutant("term dropped", text.replaced(i, end))
    for i in text.starts_of_terms():
        end = text.term_end(i)
        if text.at(end) in ("+", "-") and end > i and text.at(i) not in _SIGNS:
            stop = end + 1 if text.at(end) == "+" else end
            yield TextMutant("term dropped", text.replaced(i, stop))


def _factors(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for atom in text.atoms():
        if text.in_index(atom.start) or _argument(text, atom):
            continue
        end = text._skipped(atom.stop)
        stop = atom.stop
        if text.at(end) == "^":
            stop = text.group_end(text.after(end))
        sides = (
            next((t for t in reversed(text.tokens[: atom.start]) if not t.isspace()), ""),
            text.at(text._skipped(stop)),
        )
        if not all(t in {*_OPEN, *_CLOSE, *_RELATIONS, *_SIGNS, *_BETWEEN, "", "/"} for t in sides):
            yield TextMutant("factor dropped", text.replaced(atom.start, stop))


def _fractions(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token not in _FRACTIONS or i in text.fixed:
            continue
        first = text.after(i)
        middle = text.group_end(first)
        second = text._skipped(middle)
        end = text.group_end(second)
        above, below = text.text(first, middle), text.text(second, end)
        if above.strip("{}").startswith(("d", r"\partial")):
            continue  # a derivative
        yield TextMutant(
            "fraction upside down", text.replaced(first, end, _grouped(below), _grouped(above))
        )


def _grouped(part: str) -> str:
    return part if part.startswith("{") else f"{{{part}}}"


def _relations(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token in _TURNED and i not in text.fixed:
            yield TextMutant("inequality", text.replaced(i, i + 1, _TURNED[token]))


def _roots(text: _Text, _: Sequence[str]) -> Iterator[TextMutant]:
    for i, token in enumerate(text.tokens):
        if token == r"\sqrt" and i not in text.fixed and text.at(text.after(i)) == "{":
            start = text.after(i)
            inner = text.text(start + 1, text.partner[start])
            yield TextMutant(
                "root dropped", text.replaced(i, text.partner[start] + 1, "(", inner, ")")
            )


_SLIPS = (
    _functions,
    _signs,
    _numbers,
    _exponents,
    _indices,
    _letters,
    _dots,
    _terms,
    _factors,
    _fractions,
    _relations,
    _roots,
)
