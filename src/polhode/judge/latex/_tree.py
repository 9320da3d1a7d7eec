"""Syntax trees of printed formulas, before letters are given a meaning.

A tree records what is printed: which letter carries a hat, which sign stands between two vectors,
which quantity is divided by which. Whether a letter is a vector, a function of time or a parameter
is decided by the bindings. Letters have their published names: ``theta``, ``Omega``, ``a``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from itertools import chain
from typing import Any, TypeVar

Span = tuple[int, int]
PieceT = TypeVar("PieceT", bound="Piece")

NOWHERE: Span = (0, 0)


@dataclass(frozen=True, eq=False)
class Piece:
    """Any part of a formula, with its place in the source.

    Args:
        span: first and one past the last character in the source; two pieces that differ only in
            where they stand are equal.
    """

    span: Span = field(default=NOWHERE, repr=False, kw_only=True)

    @cached_property
    def parts(self) -> tuple[Piece, ...]:
        """The pieces directly inside, in order of printing."""
        entries = (v if isinstance(v, tuple) else (v,) for v in self._contents)
        return tuple(e for entry in entries for e in entry if isinstance(e, Piece))

    @cached_property
    def _inside(self) -> tuple[Piece, ...]:
        """All pieces inside it, outermost first; kept, since a statement is searched often."""
        found, stack = list[Piece](), [*reversed(self.parts)]
        while stack:
            found.append(piece := stack.pop())
            stack.extend(reversed(piece.parts))
        return tuple(found)

    @cached_property
    def _contents(self) -> tuple[object, ...]:
        named: tuple[str, ...] = self.__match_args__
        return tuple(map(self.__dict__.__getitem__, named))

    @cached_property
    def _key(self) -> int:
        return hash((type(self), self._contents))

    def __hash__(self) -> int:
        return self._key

    def __eq__(self, other: object) -> bool:
        if self is other or not isinstance(other, Piece):
            return self is other
        return (
            type(self) is type(other)
            and self._key == other._key
            and self._contents == other._contents
        )

    def __getstate__(self) -> dict[str, object]:
        """The fields alone: cached hashes differ from process to process."""
        return {entry.name: getattr(self, entry.name) for entry in fields(self)}


@dataclass(frozen=True, eq=False)
class Node(Piece):
    """A piece that stands for a quantity."""


@dataclass(frozen=True, eq=False)
class Number(Node):
    """A number without a sign, exactly as spelled: ``2``, ``0.35``."""

    text: str


@dataclass(frozen=True, eq=False)
class Name(Node):
    r"""A letter with its labels, primes and decoration, but without dots.

    Args:
        letter: ``"theta"``, ``"I"``, ``"1"`` (of ``\hat{\mathbf 1}``), ``"cal L"`` (of
            ``\mathcal L``), or an upright word such as ``"constant"``.
        subscript: as text without spaces, macros by name: ``"cm"``, ``"2p"``, ``"2,max"``,
            ``"(1,2,3)"``, ``"rho"``, ``"perp"``; Greek beside letters is set off by a space,
            ``"rho phi z"``. A label in brackets joins it: ``\omega_p(\text{slow})`` has
            ``"p,slow"``.
        primes: how many.
        decoration: ``"hat"``, ``"bar"``, ``"tilde"``, ``"vector"`` for bold or an arrow (a bold hat
            is ``"hat"``), ``"breve"``, ``"check"``, two such as ``"bar vector"`` and
            ``"tilde hat"``, or nothing.
        superscript: a label above that is no power: ``"*"``, ``"cm"``, ``"perp"``; the body of
            ``{}^N\boldsymbol\omega^B``.
        prescript: a label above and before the letter, the frame of ``{}^N\boldsymbol\omega^B``.
    """

    letter: str
    subscript: str = ""
    primes: int = 0
    decoration: str = ""
    superscript: str = ""
    prescript: str = ""

    @property
    def is_marked_vector(self) -> bool:
        """Whether it is printed as a vector; false is no proof, since transcripts lose boldness."""
        return self.decoration.endswith(("hat", "vector"))


@dataclass(frozen=True, eq=False)
class Words(Node):
    """Words where a quantity should stand: the right side of "θ = angle between the axes"."""

    text: str


@dataclass(frozen=True, eq=False)
class Dots(Node):
    """Time derivatives printed as dots over the quantity."""

    of: Node
    count: int


@dataclass(frozen=True, eq=False)
class Derivative(Node):
    """d/dt or ∂/∂θ acting on a quantity; mixed ones are nested, the last printed innermost.

    ``frame`` names the triad in which the rate is taken: the label of (dL/dt)_rot, the N of
    ᴺd/dt, ``"'"`` for d'L/dt and ``"circ"`` for a circle above the letter; or it is "".
    """

    of: Node
    by: Node
    order: int = 1
    partial: bool = False
    frame: str = ""


@dataclass(frozen=True, eq=False)
class Differential(Node):
    """d, Δ, δ or ∂ before a quantity. Where ``d`` is a length, the bindings may read a product."""

    of: Node
    sign: str = "d"


@dataclass(frozen=True, eq=False)
class Integral(Node):
    """An integral: with both limits, neither, or below alone what it extends over."""

    of: Node
    by: Node
    lower: Node | None = None
    upper: Node | None = None


@dataclass(frozen=True, eq=False)
class Sum(Node):
    """Two or more terms; one that is subtracted is a `Negative`."""

    terms: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class Negative(Node):
    """The quantity with a minus sign."""

    of: Node


@dataclass(frozen=True, eq=False)
class PlusMinus(Node):
    """The quantity with the sign ``"±"`` or ``"∓"``."""

    of: Node
    sign: str


@dataclass(frozen=True, eq=False)
class Product(Node):
    """Two or more factors side by side."""

    factors: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class Cross(Node):
    r"""Two quantities with ``\times`` between; of numbers, their product."""

    left: Node
    right: Node


@dataclass(frozen=True, eq=False)
class Dot(Node):
    r"""Two quantities with ``\cdot`` between; of scalars, their product."""

    left: Node
    right: Node


@dataclass(frozen=True, eq=False)
class Outer(Node):
    r"""Two vectors with ``\otimes`` between."""

    left: Node
    right: Node


@dataclass(frozen=True, eq=False)
class Quotient(Node):
    """One quantity over another, by a fraction or a slash."""

    above: Node
    below: Node


@dataclass(frozen=True, eq=False)
class Power(Node):
    """A quantity raised to a power; the square of a vector is its square magnitude."""

    base: Node
    exponent: Node


@dataclass(frozen=True, eq=False)
class Root(Node):
    """The root of a quantity: the square root unless an index says otherwise."""

    of: Node
    index: Node | None = None


@dataclass(frozen=True, eq=False)
class Call(Node):
    """A known function: sin, cos, tan, sec, csc, cot, their arc-, -h and ar-h kin, exp, ln, log."""

    function: str
    argument: Node


@dataclass(frozen=True, eq=False)
class At(Node):
    """A quantity with one in round brackets behind it: ``θ(0)``, ``v(t)``, ``V(θ)``.

    Several arguments are a `ComponentList`: ``H(p, q)``.
    """

    of: Node
    argument: Node


@dataclass(frozen=True, eq=False)
class Magnitude(Node):
    """A quantity between bars."""

    of: Node


@dataclass(frozen=True, eq=False)
class Component(Node):
    """A bracket with a subscript: ``(dv/dt)_z``. The subscript is spelled as in `Name`."""

    of: Node
    subscript: str


@dataclass(frozen=True, eq=False)
class Evaluated(Node):
    """A quantity with a bar and a subscript behind it: dL/dt|_P. Spelled as in `Name`."""

    of: Node
    subscript: str


@dataclass(frozen=True, eq=False)
class ComponentList(Node):
    """Quantities in a bracket with commas between, or stacked in a column."""

    entries: tuple[Node, ...]


@dataclass(frozen=True, eq=False)
class PoissonBracket(Node):
    """Two quantities in braces, or in square brackets: ``{q, p}``."""

    left: Node
    right: Node
    is_square: bool = False


@dataclass(frozen=True, eq=False)
class PrintedMatrix(Node):
    """Quantities in rows and columns, with at least two columns."""

    rows: tuple[ComponentList, ...]


@dataclass(frozen=True, eq=False)
class Transposed(Node):
    """A matrix, or a column, with a T above."""

    of: Node


@dataclass(frozen=True, eq=False)
class Resolved(Node):
    """A column or a matrix with the frame, above and before it, along whose axes it is given."""

    of: Node
    frame: str


@dataclass(frozen=True, eq=False)
class UnitSymbol(Node):
    """A unit of measurement, such as ``m/s^2``."""

    text: str


@dataclass(frozen=True, eq=False)
class Summation(Node):
    """A sum or a product over an index: Σ_{i=1}^{3} I_i ω_i²; without limits, over all values.

    Without an index, as in Σ F = ma, the words say what is summed.
    """

    of: Node
    index: Name | None = None
    lower: Node | None = None
    upper: Node | None = None
    sign: str = "sum"  # or "product"


@dataclass(frozen=True, eq=False)
class Order(Node):
    """Terms of an order left out: O(θ³)."""

    of: Node


@dataclass(frozen=True, eq=False)
class Omitted(Node):
    """Terms left out without an order, printed as dots: 1 + x + ⋯."""


@dataclass(frozen=True, eq=False)
class Relation(Piece):
    """A chain ``a = b ≈ c``; a quantity standing alone is a chain of one side.

    Args:
        sides: the quantities.
        signs: one fewer, each of ``= ≈ ≡ ≠ < > ≤ ≥ ≪ ≫ ∝ → ↔ ∈ ↦``; the signs of a definition
            are ``≡``.
        left_out: the orders of terms left out, where it stands for a = b + O(x³): x³.
    """

    sides: tuple[Node, ...]
    signs: tuple[str, ...] = ()
    left_out: tuple[Node, ...] = ()

    @property
    def is_claim(self) -> bool:
        """Whether it relates anything."""
        return bool(self.signs)


@dataclass(frozen=True, eq=False)
class Case(Piece):
    """One of several values: "A (slow)" of "A (slow) or B (fast)".

    Args:
        value: the value.
        conditions: the relations under which it holds, where there are any.
        words: that describe it, or "".
    """

    value: Node
    conditions: tuple[Relation, ...] = ()
    words: str = ""


@dataclass(frozen=True, eq=False)
class Cases(Node):
    """A quantity given case by case."""

    cases: tuple[Case, ...]


@dataclass(frozen=True, eq=False)
class Statement(Piece):
    r"""The content of one display.

    Args:
        relations: in order of printing.
        conditions: relations in brackets behind a gap, "... \qquad (θ < π/2)".
        notes: the words between, trimmed: "where", "and with", "⇒".
        tags: equation numbers.
        assumptions: relations in brackets after a word such as "if": "... (for θ = π/2)".
    """

    relations: tuple[Relation, ...]
    conditions: tuple[Relation, ...] = ()
    notes: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    assumptions: tuple[Relation, ...] = ()


def product(factors: Sequence[Node], span: Span = NOWHERE) -> Node:
    """Factors side by side; a single one is itself, and no factors make 1."""
    if len(factors) == 1:
        return factors[0]
    return Product(tuple(factors), span=span) if factors else Number("1", span=span)


def factors_of(node: Node) -> tuple[Node, ...]:
    """The factors of a product; anything else is its own factor."""
    return node.factors if isinstance(node, Product) else (node,)


def walk(piece: Piece) -> Iterator[Piece]:
    """The piece and all inside it, outermost first."""
    return chain((piece,), piece._inside)


def height(piece: Piece) -> int:
    """How many pieces stand within each other, the outermost counted."""
    return 1 + max(map(height, piece.parts), default=0)


def mapped(piece: PieceT, change: Callable[[Any], Piece]) -> PieceT:
    """The same piece with each one directly inside it changed; itself if nothing changes."""
    contents = piece._contents
    changed = tuple(_changed(value, change) for value in contents)
    if all(new is old for new, old in zip(changed, contents, strict=True)):
        return piece
    return type(piece)(*changed, span=piece.span)


def replaced(node: Node, old: Node, new: Node) -> Node:
    """The node with one node in it replaced, found by identity: equal nodes elsewhere stay."""

    def change(piece: Node) -> Node:
        return new if piece is old else mapped(piece, change)

    return change(node)


def _changed(value: object, change: Callable[[Any], Piece]) -> object:
    if isinstance(value, Piece):
        return change(value)
    if isinstance(value, tuple):
        changed = tuple(_changed(item, change) for item in value)
        same = all(new is old for new, old in zip(changed, value, strict=True))
        return value if same else changed
    return value
