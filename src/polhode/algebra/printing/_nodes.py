"""The display tree: the layout of an expression, made once for all printers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Protocol, TypeVar

from polhode.algebra._ring import Symbol

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class Style(Protocol[T_co]):
    """A way of writing: one method for each kind of node."""

    def number(self, value: int) -> T_co:
        """A whole number."""

    def name(self, symbol: Symbol) -> T_co:
        """A symbol."""

    def call(self, function: str, argument: PrintNode) -> T_co:
        """A function of one argument."""

    def power(self, base: PrintNode, exponent: int) -> T_co:
        """A whole power above one."""

    def product(self, factors: tuple[PrintNode, ...]) -> T_co:
        """Two or more factors; only the first can be a number."""

    def sum(self, terms: tuple[PrintNode, ...]) -> T_co:
        """Two or more terms."""

    def fraction(self, above: PrintNode, below: PrintNode) -> T_co:
        """One positive quantity over another."""

    def radical(self, radicand: PrintNode) -> T_co:
        """A square root."""

    def letter(self, letter: PrintNode, meaning: PrintNode) -> T_co:
        """A letter, or the absolute value of one, for a quantity."""


class PrintNode(ABC):
    """A piece of a printed expression."""

    @property
    def size(self) -> int:
        """How many nodes it takes; signs are free."""
        return 1

    @abstractmethod
    def drawn(self, style: Style[T]) -> T:
        """Written in a style."""

    @property
    def is_negative(self) -> bool:
        """Whether it begins with a minus sign that a sum can take over."""
        return False

    def negated(self) -> PrintNode:
        """The same with the opposite sign."""
        return PrintProduct((PrintNumber(-1), self))


@dataclass(frozen=True)
class PrintNumber(PrintNode):
    """A whole number; a rational one is a `PrintFraction` of two."""

    value: int

    def drawn(self, style: Style[T]) -> T:
        return style.number(self.value)

    @property
    def is_negative(self) -> bool:
        return self.value < 0

    def negated(self) -> PrintNode:
        return PrintNumber(-self.value)


@dataclass(frozen=True)
class PrintName(PrintNode):
    """A symbol."""

    symbol: Symbol

    def drawn(self, style: Style[T]) -> T:
        return style.name(self.symbol)


@dataclass(frozen=True)
class PrintCall(PrintNode):
    """A function of one argument: sin, cos, sinh, cosh, exp, abs."""

    function: str
    argument: PrintNode

    @cached_property
    def size(self) -> int:
        return 1 + self.argument.size

    def drawn(self, style: Style[T]) -> T:
        return style.call(self.function, self.argument)


@dataclass(frozen=True)
class PrintPower(PrintNode):
    """A whole power, above one."""

    base: PrintNode
    exponent: int

    @cached_property
    def size(self) -> int:
        return 1 + self.base.size

    def drawn(self, style: Style[T]) -> T:
        return style.power(self.base, self.exponent)


@dataclass(frozen=True)
class PrintProduct(PrintNode):
    """Two or more factors; only the first can be a number, and then carries the sign."""

    factors: tuple[PrintNode, ...]

    @cached_property
    def size(self) -> int:
        bare = self.factors[1:] if self.factors[0] == PrintNumber(-1) else self.factors
        return sum(f.size for f in bare) + (len(bare) > 1)

    def drawn(self, style: Style[T]) -> T:
        return style.product(self.factors)

    @property
    def is_negative(self) -> bool:
        return self.factors[0].is_negative

    def negated(self) -> PrintNode:
        first, *rest = self.factors
        if isinstance(first, PrintNumber):
            return product(-first.value, rest)
        return PrintProduct((PrintNumber(-1), *self.factors))


@dataclass(frozen=True)
class PrintSum(PrintNode):
    """Two or more terms, none of them a sum."""

    terms: tuple[PrintNode, ...]

    @cached_property
    def size(self) -> int:
        return 1 + sum(t.size for t in self.terms)

    def drawn(self, style: Style[T]) -> T:
        return style.sum(self.terms)

    def negated(self) -> PrintNode:
        return PrintSum(tuple(t.negated() for t in self.terms))


@dataclass(frozen=True)
class PrintFraction(PrintNode):
    """A quotient; its sign stands before it."""

    above: PrintNode
    below: PrintNode

    @cached_property
    def size(self) -> int:
        return 1 + self.above.size + self.below.size

    def drawn(self, style: Style[T]) -> T:
        return style.fraction(self.above, self.below)


@dataclass(frozen=True)
class PrintRadical(PrintNode):
    """A square root."""

    radicand: PrintNode

    @cached_property
    def size(self) -> int:
        return 1 + self.radicand.size

    def drawn(self, style: Style[T]) -> T:
        return style.radical(self.radicand)


@dataclass(frozen=True)
class PrintLetter(PrintNode):
    """A letter, or the absolute value of one, for a quantity that is defined elsewhere."""

    letter: PrintNode
    meaning: PrintNode

    def drawn(self, style: Style[T]) -> T:
        return style.letter(self.letter, self.meaning)


def product(number: int, factors: list[PrintNode]) -> PrintNode:
    """A number times factors, with numbers multiplied together and no factor 1."""
    whole = [f for f in factors if isinstance(f, PrintNumber)]
    number = number * prod(f.value for f in whole)
    rest = [f for f in factors if not isinstance(f, PrintNumber)]
    if number == 1 and rest:
        return rest[0] if len(rest) == 1 else PrintProduct(tuple(rest))
    return PrintProduct((PrintNumber(number), *rest)) if rest else PrintNumber(number)


def fraction(above: PrintNode, below: PrintNode) -> PrintNode:
    """A quotient with its sign before it; `below` positive."""
    if below == PrintNumber(1):
        return above
    if above.is_negative:
        return PrintProduct((PrintNumber(-1), PrintFraction(above.negated(), below)))
    return PrintFraction(above, below)


def power(base: PrintNode, exponent: int) -> PrintNode:
    """A positive whole power."""
    return base if exponent == 1 else PrintPower(base, exponent)


def total(terms: list[PrintNode]) -> PrintNode:
    """A sum that begins without a minus sign if any of its terms does."""
    if not terms:
        return PrintNumber(0)
    if len(terms) == 1:
        return terms[0]
    first = next((t for t in terms if not t.is_negative), terms[0])
    return PrintSum((first, *(t for t in terms if t is not first)))
