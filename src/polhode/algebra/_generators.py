"""Generators: the symbols and functions of symbols that expressions are polynomials in."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polhode.algebra._expression import Expr
    from polhode.algebra._ring import Polynomial, Ring

Rate = Callable[["Symbol"], "Expr"]


class Generator(ABC):
    """One variable of a polynomial ring: a symbol, or a function such as sin θ of an expression.

    A generator is *algebraic* when its square is a polynomial in simpler generators
    (cos² = 1 - sin², a square root); every other one is transcendental.
    """

    #: Unique name; fixes the order of generators everywhere.
    key: str
    #: Whether its value is known to be positive.
    positive: bool = False
    #: Whether it stands for a longer expression that is not multiplied out.
    is_part: bool = False

    @property
    def depth(self) -> int:
        """Height in the tower of algebraic generators; 0 for a transcendental one."""
        return 0

    def square(self, ring: Ring) -> Polynomial:
        """What the square of an algebraic generator equals, in a ring that holds it."""
        return ring.variable(self) ** 2

    def companions(self) -> tuple[Generator, ...]:
        """Generators that its square, or another form of it, is written with."""
        return ()

    def partner(self) -> tuple[Generator, int] | None:
        """The odd function and the sign with which this one's square is 1 + sign · odd²."""
        return None

    def refined(self, others: tuple[Generator, ...]) -> Expr | None:
        """This generator in terms of a finer unit that occurs among `others`, if one does."""
        return None

    @abstractmethod
    def chain(self, rate: Rate) -> Expr:
        """Derivative, given the derivative of every symbol."""

    @abstractmethod
    def replaced(self, image: Rate) -> Expr:
        """This generator with every symbol replaced by its image."""

    @abstractmethod
    def symbols(self) -> frozenset[Symbol]:
        """The symbols it depends on."""

    @property
    def arguments(self) -> tuple[Expr, ...]:
        """The expressions it is a function of."""
        return ()


class SymbolKind(Enum):
    """What a symbol stands for; decides what its time derivative is."""

    PARAMETER = "parameter"
    COORDINATE = "coordinate"
    SPEED = "speed"
    FUNCTION = "function"
    TIME = "time"

    @property
    def varies(self) -> bool:
        """Whether the time derivative is a further symbol."""
        return self in (SymbolKind.COORDINATE, SymbolKind.SPEED, SymbolKind.FUNCTION)


_DOTS = ("", "_dot", "_ddot", "_dddot")


@dataclass(frozen=True)
class Symbol(Generator):
    """A named quantity, or one of its time derivatives.

    `positive` is what is known of its sign; it decides √(x²) = x and is not part of the identity.
    """

    name: str
    kind: SymbolKind = SymbolKind.PARAMETER
    order: int = 0
    positive: bool = field(default=False, compare=False)

    @cached_property
    def published(self) -> str:
        """ASCII name as scripts know it: `theta`, `theta_dot`, `omega_3_dot`."""
        if self.order < len(_DOTS):
            return self.name + _DOTS[self.order]
        return f"{self.name}_d{self.order}"

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return self.published if self.kind is not SymbolKind.TIME else "t"

    def derivative(self) -> Symbol:
        """The symbol of the time derivative."""
        return Symbol(self.name, self.kind, self.order + 1)

    def base(self) -> Symbol:
        """The quantity this is a time derivative of."""
        return Symbol(self.name, self.kind, 0, self.positive)

    def __hash__(self) -> int:
        return hash(self.key)

    def __repr__(self) -> str:
        return self.published

    def chain(self, rate: Rate) -> Expr:
        return rate(self)

    def replaced(self, image: Rate) -> Expr:
        return image(self)

    def symbols(self) -> frozenset[Symbol]:
        return frozenset((self,))
