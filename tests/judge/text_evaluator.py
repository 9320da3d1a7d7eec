r"""Numbers of a printed formula, from a small grammar of its own; nothing of polhode is used.

It speaks of scalars only: letters with dots and indices, products, fractions, powers, roots,
functions of one letter or bracket, relations in chains and lists, and ± as one choice.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

Array = np.ndarray
Values = Mapping[str, Array | float]

RELATIONS = {
    "=": "=",
    r"\equiv": "=",
    r"\approx": "≈",
    r"\simeq": "≈",
    "<": "<",
    ">": ">",
    r"\le": "<=",
    r"\leq": "<=",
    r"\ge": ">=",
    r"\geq": ">=",
}
_FUNCTIONS: dict[str, Callable[[Array], Array]] = {
    r"\sin": np.sin,
    r"\cos": np.cos,
    r"\tan": np.tan,
    r"\cot": lambda x: 1 / np.tan(x),
    r"\sinh": np.sinh,
    r"\cosh": np.cosh,
    r"\tanh": np.tanh,
    "sech": lambda x: 1 / np.cosh(x),
}
_DOTS = {r"\dot": "_dot", r"\ddot": "_ddot", r"\dddot": "_dddot"}
_BLANK = re.compile(r"\\[,;:! ]|\s|~|\\left(?![a-z])|\\right(?![a-z])|\$|&")
_TAGS = re.compile(r"\\tag\{[^{}]*\}|\(\d+\)\s*$")
_TOKEN = re.compile(r"\\[A-Za-z]+|\d+(?:\.\d+)?|\\.|.")
_LISTS = {",", ";", r"\quad", r"\qquad", r"\\"}
_STOPS = {*RELATIONS, *_LISTS, "+", "-", r"\pm", r"\mp", ")", "]", "}", "|", "."}


class UnknownTextError(Exception):
    """A formula that this grammar does not have."""


@dataclass(frozen=True)
class Relation:
    """Two neighbouring sides of a chain, as tokens."""

    left: tuple[str, ...]
    sign: str
    right: tuple[str, ...]


@dataclass(frozen=True)
class Formula:
    """A printed formula."""

    latex: str

    @cached_property
    def relations(self) -> tuple[Relation, ...]:
        """The relations of a list of chains."""
        shown = " ".join(self.latex.split("$$")[1::2]) or self.latex
        tokens = _TOKEN.findall(_BLANK.sub(" ", _TAGS.sub("", shown)))
        tokens = [t for t in tokens if t.strip()]
        found: list[Relation] = []
        for chain in _split(tokens, _LISTS):
            if chain and chain[-1] == ".":
                chain = chain[:-1]
            if not chain:
                continue
            signs = [t for t in _outside(chain) if t in RELATIONS]
            sides = [tuple(side) for side in _split(chain, set(RELATIONS))]
            if len(sides) < 2 or not all(sides):
                raise UnknownTextError(self.latex)
            found += [
                Relation(a, RELATIONS[s], b)
                for s, (a, b) in zip(signs, pairwise(sides), strict=True)
            ]
        if not found:
            raise UnknownTextError(self.latex)
        return tuple(found)

    @property
    def has_choice(self) -> bool:
        return r"\pm" in self.latex or r"\mp" in self.latex

    def sides(self, values: Values, upper: bool = True) -> list[tuple[Array, str, Array]]:
        """Numbers of both sides of every relation.

        Raises `UnknownTextError` for a letter without a value and for text beyond the grammar.
        """
        with np.errstate(all="ignore"):
            return [
                (
                    _Numbers(r.left, values, upper).whole(),
                    r.sign,
                    _Numbers(r.right, values, upper).whole(),
                )
                for r in self.relations
            ]


def _outside(tokens: list[str]) -> list[str]:
    """The tokens outside of all brackets."""
    depth, found = 0, []
    for token in tokens:
        depth -= token in (")", "]", "}")
        if not depth:
            found.append(token)
        depth += token in ("(", "[", "{")
    return found


def _split(tokens: list[str], at: set[str]) -> list[list[str]]:
    depth = 0
    found: list[list[str]] = [[]]
    for token in tokens:
        depth += (token in ("(", "[", "{")) - (token in (")", "]", "}"))
        if not depth and token in at:
            found.append([])
        else:
            found[-1].append(token)
    return found


class _Numbers:
    """One side, evaluated from left to right."""

    def __init__(self, tokens: tuple[str, ...], values: Values, upper: bool) -> None:
        self.tokens, self.values, self.upper = tokens, values, upper
        self.at = 0

    @property
    def here(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        token = self.here
        if not token:
            raise UnknownTextError("end of text")
        self.at += 1
        return token

    def whole(self) -> Array:
        found = self.sum()
        if self.here:
            raise UnknownTextError(f"{self.here} in {''.join(self.tokens)}")
        return found

    def sum(self) -> Array:
        total = np.asarray(0.0)
        first = True
        while first or self.here in ("+", "-", r"\pm", r"\mp"):
            sign = 1.0
            if self.here in ("+", "-", r"\pm", r"\mp"):
                token = self.take()
                up = self.upper if token == r"\pm" else not self.upper
                sign = {"+": 1.0, "-": -1.0}.get(token, 1.0 if up else -1.0)
            total = total + sign * self.product()
            first = False
        return total

    def product(self) -> Array:
        """Everything after a slash is below it, as texts print a/bc."""
        above, below, divided = np.asarray(1.0), np.asarray(1.0), False
        count = 0
        while self.here and self.here not in _STOPS:
            if self.here in ("/", r"\cdot", r"\times"):
                divided = divided or self.take() == "/"
                continue
            factor = self.power()
            above, below = (above, below * factor) if divided else (above * factor, below)
            count += 1
        if self.here == "|" or not count:
            raise UnknownTextError("no factor")
        return above / below

    def power(self) -> Array:
        token = self.here
        if token in _FUNCTIONS or (token == r"\operatorname" or token == r"\text"):
            return self.function()
        base = self.atom()
        while self.here == "^":
            self.take()
            base = np.power(base, self.argument())
        return base

    def function(self) -> Array:
        token = self.take()
        if token in (r"\operatorname", r"\text"):
            token = self.word()
        if token not in _FUNCTIONS:
            raise UnknownTextError(token)
        exponent = np.asarray(1.0)
        if self.here == "^":
            self.take()
            exponent = self.argument()
        argument, start = np.asarray(1.0), self.at
        while self.here and self.here[0].isdigit():
            argument = argument * self.atom()
        if self.here not in _STOPS and self.here:
            argument = argument * self.atom()
            if self.here == "^":
                self.take()
                argument = np.power(argument, self.argument())
        elif self.at == start:
            raise UnknownTextError("a function of nothing")
        return _FUNCTIONS[token](argument) ** exponent

    def word(self) -> str:
        if self.take() != "{":
            raise UnknownTextError("no group")
        start = self.at
        while self.take() != "}":
            pass
        return "".join(self.tokens[start : self.at - 1])

    def argument(self) -> Array:
        """An argument in braces, or one token."""
        if self.here == "{":
            return self.bracket()
        token = self.take()
        if token[0].isdigit() and len(token) > 1 and "." not in token:
            rest = (*token[1:],)
            self.tokens = (*self.tokens[: self.at], *rest, *self.tokens[self.at :])
            token = token[0]
        if token[0].isdigit():
            return np.asarray(float(token))
        if re.fullmatch(r"[A-Za-z]|\\[A-Za-z]+", token):
            return self.letter(token.removeprefix("\\"))
        raise UnknownTextError(token)

    def bracket(self) -> Array:
        opening = self.take()
        found = self.sum()
        if self.take() != {"{": "}", "(": ")", "[": "]"}[opening]:
            raise UnknownTextError("brackets")
        return found

    def atom(self) -> Array:
        token = self.here
        if token == "{":
            return self._group_or_name()
        if token in ("(", "["):
            return self.bracket()
        if token[0].isdigit():
            return np.asarray(float(self.take()))
        if token in (r"\frac", r"\tfrac", r"\dfrac"):
            self.take()
            above = self.argument()
            return above / self.argument()
        if token == r"\sqrt":
            self.take()
            return np.sqrt(self.argument())
        if token == r"\pi":
            self.take()
            return np.asarray(np.pi)
        return self.named()

    def _group_or_name(self) -> Array:
        """A group is evaluated; one with an index after it is a name, as in {\\phi}_1."""
        start = self.at
        value = self.bracket()
        if self.here != "_":
            return value
        self.at = start
        return self.named()

    def named(self) -> Array:
        token = self.take()
        dots = ""
        while token in _DOTS:
            dots += _DOTS[token]
            token = self.take()
            if token == "{":
                token = self._inner()
        if token == "{":
            token = self._inner()
        if token == r"\mathcal":
            self.take() if self.here == "{" else None
            token = "cal" + self.take()
            self.take() if self.here == "}" else None
        if not re.fullmatch(r"[A-Za-z]|cal[A-Z]|\\[A-Za-z]+(_.*)?|[A-Za-z]_.*", token):
            raise UnknownTextError(token)
        name = token.removeprefix("\\")
        if self.here == "_":
            self.take()
            name += "_" + self._index()
        return self.letter(name + dots)

    def _inner(self) -> str:
        """The letter in braces after a dot, with its index."""
        letter = self.take()
        if self.here == "_":
            self.take()
            letter += "_" + self._index()
        if self.take() != "}":
            raise UnknownTextError("more than a letter under a dot")
        return letter

    def _index(self) -> str:
        token = self.take()
        if token != "{":
            return token.removeprefix("\\")
        depth, found = 1, ""
        while depth:
            token = self.take()
            depth += (token == "{") - (token == "}")
            if token not in ("{", "}", ",", r"\text", r"\rm", r"\mathrm"):
                found += token.removeprefix("\\")
        return found

    def letter(self, name: str) -> Array:
        if name not in self.values:
            raise UnknownTextError(f"{name} has no value")
        return np.asarray(self.values[name])
