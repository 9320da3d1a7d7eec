"""Statements with their indices written out and their matrices multiplied, still as trees.

Σ_i I_i ω_i² becomes I_1 ω_1² + I_2 ω_2² + I_3 ω_3², a relation with a free index becomes one
relation for each value, and one between matrices becomes one for each entry. Nothing here depends
on what letters mean, except which of them are known: that decides what an index without a stated
range runs over, axes, bodies or coordinates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import product

from polhode.judge.latex import _tree as tree
from polhode.judge.latex._tree import Name, Node, Piece, Relation, Statement
from polhode.judge.meaning._meaning import BindingError
from polhode.judge.meaning._proposals import NORMAL_MODES
from polhode.judge.meaning._small_oscillations import ORDINALS, normal_frequencies
from polhode.judge.meaning._vocabulary import Vocabulary

_INDICES = ("i", "j", "k")  # letters that may be indices without being said to be
_MOST_VALUES = 12
_INSTANTS = ("i", "initial", "before"), ("f", "final", "after")
_TORQUES = ("tau", "M", "Gamma")  # letters under a Σ that are torques, even where M is a mass

#: What a letter becomes for one value of an index.
Substitution = Callable[[Name], Node]


def expanded(statement: Statement, vocabulary: Vocabulary) -> Statement:
    """The statement with sums, free indices and matrices written out.

    Raises `BindingError` for an index whose range is not known, and matrices that do not match.
    """
    is_conservation = any(_as_conserved(each) is not each for each in statement.relations)
    if not is_conservation and not _is_abbreviated(statement, vocabulary):
        return statement
    indices = _Indices(vocabulary, dict(_stated_ranges(statement)))
    return replace(
        statement,
        relations=tuple(indices.relations(statement.relations)),
        conditions=tuple(indices.relations(statement.conditions)),
        assumptions=tuple(indices.relations(statement.assumptions)),
    )


def _is_abbreviated(statement: Statement, vocabulary: Vocabulary) -> bool:
    """Whether anything is to be written out."""
    pieces = list(tree.walk(statement))
    if any(type(p) in _WRITTEN_OUT or _is_pair(p, vocabulary) for p in pieces):
        return True
    indexed = {(p, i) for p in pieces if isinstance(p, Name) for i in _INDICES if _has_index(p, i)}
    return any(not vocabulary.has(name) for name, _ in indexed) or any(
        _contracted(relation, index, vocabulary)
        for relation in statement.relations
        for index in {index for _, index in indexed}
    )


_WRITTEN_OUT = {
    *(tree.Summation, tree.PrintedMatrix, tree.Transposed, tree.ComponentList),
    *(tree.Order, tree.Omitted),
}


# -- indices ------------------------------------------------------------------------------------


def _is_dummy(relation: Relation, index: str) -> bool:
    """Whether an index is summed over without a Σ: it stands twice in one term, in others never.

    Einstein's convention: T = ½ I_ik ω_i ω_k, and the k of L_i = I_ik ω_k.
    """
    counts = _counts(relation, index)
    return 0 in counts and all(count != 1 for count in counts) and not _is_label(relation, index)


def _counts(relation: Relation, index: str) -> list[int]:
    terms = (term for side in relation.sides for term in _terms(side) if not _is_zero(term))
    return [_count(term, index) for term in terms]


def _is_label(relation: Relation, index: str) -> bool:
    """Whether an index stands for an axis, as in L_i² + L_j² + L_k², where others stand beside."""
    sums = (p.terms for p in tree.walk(relation) if isinstance(p, tree.Sum))
    for terms in sums:
        apart = [t for t in terms if not _count(t, index)]
        own = {p.letter for t in terms for p in _names(t) if _has_index(p, index)}
        beside = (p for t in apart for p in _names(t) if p.letter in own)
        if any(_has_index(p, other) for p in beside for other in _INDICES):
            return True
    return False


def _names(piece: Piece) -> list[Name]:
    return [p for p in tree.walk(piece) if isinstance(p, Name)]


def _contracted(relation: Relation, index: str, vocabulary: Vocabulary) -> list[Name]:
    """Letters in products such as L_i ω_i, where i is no axis though L_i may be along one.

    None where the i of a letter is a label that the declaration or the text gave it.
    """
    found = {p for p in _names(relation) if _has_index(p, index)}
    if not found or any(p in vocabulary.stated or p in vocabulary.declared for p in found):
        return []
    return sorted(found, key=str) if _is_summed(relation, index, vocabulary) else []


def _is_summed(relation: Relation, index: str, vocabulary: Vocabulary) -> bool:
    """Whether an index is summed over, also where nothing but 0 stands without it.

    L_i ω̇_i = 0 is a scalar product, but m_i v̇_i = 0 may hold for each i.
    """
    if _is_dummy(relation, index):
        return True
    are_components = not any(
        _has_index(p, index) and not vocabulary.has(p) for p in _names(relation)
    )
    is_zero = any(map(_is_zero, relation.sides))
    counts = set(_counts(relation, index))
    return are_components and is_zero and counts == {2} and not _is_label(relation, index)


def _with_dummy_summed(
    relation: Relation, index: str, values: Sequence[tuple[str, Substitution]]
) -> Relation:
    def written_out(side: Node) -> Node:
        terms = [
            _substituted(term, index, number, substitute)
            for term in _terms(side)
            for number, substitute in (values if _count(term, index) else values[:1])
        ]
        return terms[0] if len(terms) == 1 else tree.Sum(tuple(terms), span=side.span)

    return replace(relation, sides=tuple(map(written_out, relation.sides)))


def _terms(side: Node) -> tuple[Node, ...]:
    return side.terms if isinstance(side, tree.Sum) else (side,)


def _is_zero(node: Node) -> bool:
    return node == tree.Number("0")


def _count(term: Node, index: str) -> int:
    """How often an index stands in a term, twice in a square."""
    squares = [p.base for p in tree.walk(term) if isinstance(p, tree.Power)]
    names = [*_names(term), *(p for p in squares if isinstance(p, Name))]
    return sum(_has_index(name, index) for name in names)


def _has_index(name: Name, index: str) -> bool:
    """Whether an index stands below a letter, alone or beside other indices and digits."""
    marks = set(name.subscript.replace(",", ""))
    return index in marks and all(mark.isdigit() or mark in _INDICES for mark in marks - {index})


def _with_label(name: Name, index: str, label: str) -> Name:
    return replace(name, subscript=name.subscript.replace(index, label))


def _stated_ranges(statement: Statement) -> Iterator[tuple[str, tuple[str, ...]]]:
    """The values of indices that a statement lists: i = 1, 2; none for i = 1, ..., n."""
    for relation in (*statement.relations, *statement.conditions, *statement.assumptions):
        index = _listed_index(relation)
        if index:
            right = relation.sides[1]
            values = right.entries if isinstance(right, tree.ComponentList) else (right,)
            numbers = tuple(v.text for v in values if isinstance(v, tree.Number))
            yield index, numbers if len(numbers) == len(values) else ()


def _listed_index(relation: Relation) -> str:
    """The index of which a relation lists the values, or ""."""
    match relation:
        case Relation(sides=(Name(letter=letter, subscript=""), right), signs=("=",)):
            listed = isinstance(right, tree.ComponentList | tree.Number)
            return letter if listed and len(letter) == 1 and letter.islower() else ""
    return ""


def _as_conserved(relation: Relation) -> Relation:
    """E_k,i + E_p,i = E_k,f + E_p,f as the statement that E_k + E_p is constant."""
    if relation.signs != ("=",):
        return relation
    before, after = (_at_instant(s, n) for s, n in zip(relation.sides, _INSTANTS, strict=True))
    if before is None or before != after:
        return relation
    return replace(relation, sides=(before, Name("constant", span=relation.sides[1].span)))


def _at_instant(side: Node, labels: Sequence[str]) -> Node | None:
    """The side without the labels of one instant; None if no letter has any."""
    found = tree.mapped(Relation((side,), ()), lambda piece: _unlabelled(piece, labels)).sides[0]
    return None if found is side else found


def _unlabelled(piece: Piece, labels: Sequence[str]) -> Piece:
    if isinstance(piece, Name):
        whole, _, label = piece.subscript.rpartition(",")
        return replace(piece, subscript=whole) if label in labels else piece
    return tree.mapped(piece, lambda inner: _unlabelled(inner, labels))


@dataclass(frozen=True)
class _Indices:
    """Writes out the indices of one statement.

    Attributes:
        vocabulary: tells which letters are known.
        stated: values of indices that the text lists; empty for a range that it only hints at.
    """

    vocabulary: Vocabulary
    stated: dict[str, tuple[str, ...]]

    def relations(self, relations: Sequence[Relation]) -> Iterator[Relation]:
        for printed in relations:
            relation = _as_conserved(printed)
            index = _listed_index(relation)
            if index and any(_uses(other, index) for other in relations if other is not printed):
                continue  # the range of an index
            for one in self._for_each_value(self._summed(relation)):
                for each in _for_each_sign(one, self.vocabulary):
                    yield from _by_entries(_without_remainder(each))

    def _for_each_value(self, relation: Relation) -> Iterator[Relation]:
        """One relation for each value of every free index."""
        for index in dict.fromkeys([*self.stated, *_INDICES]):
            names = self._indexed(relation, index) or _contracted(relation, index, self.vocabulary)
            if names:
                values = self._values(index, names, self.stated.get(index, ()))
                if _is_summed(relation, index, self.vocabulary):
                    yield from self._for_each_value(_with_dummy_summed(relation, index, values))
                    return
                for number, substitute in values:
                    yield from self._for_each_value(
                        _substituted(relation, index, number, substitute)
                    )
                return
        yield relation

    def _total(self, summation: tree.Summation) -> Node | None:
        """The total force or torque that Σ F_x or Σ M is for a single body; None for other sums."""
        name, is_of_one = summation.of, len(self.vocabulary.mechanics.bodies) == 1
        if not isinstance(name, Name) or summation.sign != "sum" or not is_of_one:
            return None
        if name.letter == "F":
            label = f"total,{name.subscript}" if name.subscript else "total"
            return replace(name, subscript=label, span=summation.span)
        if name.letter in _TORQUES:
            label = name.subscript or "total"
            return replace(name, letter="tau", subscript=label, span=summation.span)
        return None

    def _summed(self, piece: tree.PieceT) -> tree.PieceT:
        """The piece with sums and products over an index written out, the innermost first."""
        inner = tree.mapped(piece, self._summed)
        if not isinstance(inner, tree.Summation):
            return inner
        if inner.index is None and (total := self._total(inner)) is not None:
            return total  # type: ignore[return-value]  # a node in place of a node
        if inner.index is None:
            raise BindingError(
                "a sum that does not say over what it runs",
                expected="its index, as in \\sum_{i=1}^{3}, or a total: \\mathbf F_{\\text{total}}",
            )
        terms = tuple(self._terms(inner))
        kind = tree.Sum if inner.sign == "sum" else tree.Product
        whole: Node = terms[0] if len(terms) == 1 else kind(terms, span=inner.span)
        return whole  # type: ignore[return-value]  # a node in place of a node

    def _terms(self, node: tree.Summation) -> Iterator[Node]:
        index = node.index.letter if node.index else ""
        names = list(dict.fromkeys(p for p in _names(node.of) if _has_index(p, index)))
        for number, substitute in self._values(index, names, self._limits(node)):
            yield _substituted(node.of, index, number, substitute)

    def _limits(self, node: tree.Summation) -> tuple[str, ...]:
        lower, upper = node.lower, node.upper
        if not isinstance(lower, tree.Number) or not isinstance(upper, tree.Number):
            return self.stated.get(node.index.letter if node.index else "", ())
        first, last = (int(n.text) if n.text.isdigit() else -1 for n in (lower, upper))
        if not 0 <= first <= last < first + _MOST_VALUES:
            raise BindingError(
                f"a sum from {lower.text} to {upper.text}",
                expected=f"whole numbers, at most {_MOST_VALUES} terms",
            )
        return tuple(str(n) for n in range(first, last + 1))

    def _indexed(self, piece: Piece, index: str) -> list[Name]:
        found = (p for p in tree.walk(piece) if isinstance(p, Name) and _has_index(p, index))
        return [name for name in dict.fromkeys(found) if not self.vocabulary.has(name)]

    def _values(
        self, index: str, names: Sequence[Name], listed: tuple[str, ...]
    ) -> list[tuple[str, Substitution]]:
        """What an index runs over: the values listed, or else axes, bodies or coordinates."""
        for labels in (listed,) if listed else self._ranges():
            by_label = (
                [(str(n), _labelling(index, label)) for n, label in enumerate(labels, 1)]
                if not listed
                else [(label, _labelling(index, label)) for label in labels]
            )
            if names and self._all_known(index, names, by_label):
                return by_label
            coordinates = self._coordinates(index, [number for number, _ in by_label])
            if names and coordinates and self._all_known(index, names, coordinates):
                return coordinates
        shown = ", ".join(dict.fromkeys(f"{n.letter}_{n.subscript}" for n in names)) or index
        raise BindingError(
            f"{shown}, whose index runs over nothing known in {self.vocabulary.system}",
            expected="an index of axes, bodies or coordinates",
            advice=f"write the values below the sum, or as in {index} = 1, 2",
            symbol=shown,
        )

    def _ranges(self) -> Iterator[tuple[str, ...]]:
        equations = self.vocabulary.mechanics.equations
        yield self.vocabulary.mechanics.body.axes.labels
        yield ("1", "2", "3")
        bodies = self.vocabulary.mechanics.bodies
        yield tuple(body.tag.strip("_") or str(n) for n, body in enumerate(bodies, 1))
        yield tuple(str(n) for n in range(1, len(equations.coordinates) + 1))

    def _all_known(
        self, index: str, names: Sequence[Name], values: Sequence[tuple[str, Substitution]]
    ) -> bool:
        written = (substitute(name) for name in names for _, substitute in values)
        return all(
            self.vocabulary.has(node) or (isinstance(node, Name) and _still_indexed(node, index))
            for node in written
        )

    def _coordinates(self, index: str, numbers: Sequence[str]) -> list[tuple[str, Substitution]]:
        """q_i as the i-th coordinate, and p_i as the momentum conjugate to it."""
        pairs = self.vocabulary.generalised
        if not all(n.isdigit() and 1 <= int(n) <= len(pairs) for n in numbers):
            return []
        if len(numbers) != len(pairs) and not self.stated.get(index):
            return []

        def substitution(number: str) -> Substitution:
            coordinate, momentum = pairs[int(number) - 1]
            chosen = {"q": coordinate, "p": momentum}

            def substitute(name: Name) -> Node:
                known = chosen.get(name.letter) if name.subscript == index else None
                return known or _with_label(name, index, number)

            return substitute

        return [(number, substitution(number)) for number in numbers]


def _still_indexed(name: Name, index: str) -> bool:
    return any(_has_index(name, other) for other in _INDICES if other != index)


def _labelling(index: str, label: str) -> Substitution:
    return lambda name: _with_label(name, index, label)


def _uses(relation: Relation, index: str) -> bool:
    return any(isinstance(p, Name) and _has_index(p, index) for p in tree.walk(relation))


def _substituted(
    piece: tree.PieceT, index: str, number: str, substitute: Substitution
) -> tree.PieceT:
    """A piece for one value of an index, which may also stand alone as a number."""

    def change(inner: Piece) -> Piece:
        if isinstance(inner, Name):
            if inner == Name(index):
                return tree.Number(number, span=inner.span) if number.isdigit() else inner
            return (
                replace(substitute(inner), span=inner.span) if _has_index(inner, index) else inner
            )
        return tree.mapped(inner, change)

    return change(piece)  # type: ignore[return-value]  # of the kind that it was


# -- two letters in one, by the sign of ± -------------------------------------------------------

_MODES = {name.letter for name in NORMAL_MODES}
_PAIRS = {"±": ("+", "-"), "∓": ("-", "+"), "1,2": ("1", "2"), "": ("+", "-")}


def _is_pair(piece: Piece, vocabulary: Vocabulary) -> bool:
    """Whether a letter stands for two frequencies of normal modes: ω_±, ω_{1,2}, or ω beside ±."""
    if not isinstance(piece, Name) or piece.letter not in _MODES or piece.subscript not in _PAIRS:
        return False
    sense = vocabulary.sense(piece)
    known = [phrase for r in sense.readings for phrase in r.phrases] if sense else []
    if sense and not any(phrase.startswith(f"{ORDINALS[0]} frequency") for phrase in known):
        return False
    one = replace(piece, subscript=_PAIRS[piece.subscript][0])
    return one in NORMAL_MODES and bool(normal_frequencies(vocabulary.mechanics))


def _for_each_sign(relation: Relation, vocabulary: Vocabulary) -> Iterator[Relation]:
    """ω_±² = a ± b as ω_+² = a + b and ω_-² = a - b; other relations as they are."""
    has_sign = any(isinstance(p, tree.PlusMinus) for p in tree.walk(relation))
    if not has_sign or not any(_is_pair(p, vocabulary) for p in tree.walk(relation)):
        yield relation
        return
    for number, sign in enumerate("±∓"):

        def change(piece: Piece, number: int = number, sign: str = sign) -> Piece:
            if isinstance(piece, Name) and _is_pair(piece, vocabulary):
                return replace(piece, subscript=_PAIRS[piece.subscript][number])
            inner = tree.mapped(piece, change)
            if not isinstance(inner, tree.PlusMinus):
                return inner
            return inner.of if inner.sign == sign else tree.Negative(inner.of, span=inner.span)

        yield change(relation)  # type: ignore[misc]  # of the kind that it was


# -- terms left out -----------------------------------------------------------------------------


def _without_remainder(relation: Relation) -> Relation:
    """a = b + O(x³) and a = b + ⋯ as a ≈ b: of what is left out only the order is judged."""
    sides = tuple(map(_shortened, relation.sides))
    if sides == relation.sides:
        return relation
    signs = tuple("≈" if sign in ("=", "≡") else sign for sign in relation.signs)
    left_out = tuple(p.of for p in tree.walk(relation) if isinstance(p, tree.Order))
    return replace(relation, sides=sides, signs=signs, left_out=left_out)


def _shortened(node: Node) -> Node:
    if not isinstance(node, tree.Sum):
        return tree.mapped(node, lambda p: _shortened(p) if isinstance(p, Node) else p)
    kept = tuple(_shortened(term) for term in node.terms if not _is_remainder(term))
    if len(kept) > 1:
        return node if kept == node.terms else tree.Sum(kept, span=node.span)
    return replace(kept[0], span=node.span) if kept else node


def _is_remainder(term: Node) -> bool:
    inner = term.of if isinstance(term, tree.Negative) else term
    return isinstance(inner, tree.Order | tree.Omitted)


# -- matrices -----------------------------------------------------------------------------------

#: Entries in rows.
Rows = tuple[tuple[Node, ...], ...]


def _by_entries(relation: Relation) -> Iterator[Relation]:
    """The relations between entries of a relation between matrices; others as they are."""
    arrays = [_rows(side) for side in relation.sides]
    found = [rows for rows in arrays if rows is not None]
    if not found:
        yield replace(relation, sides=tuple(map(_with_inner_products, relation.sides)))
        return
    sides = tuple(
        _as_printed(side, rows) for side, rows in zip(relation.sides, arrays, strict=True)
    )
    height, width = len(found[0]), len(found[0][0])
    spread = [
        rows if rows is not None else _zeros(side, height, width)
        for side, rows in zip(relation.sides, arrays, strict=True)
    ]
    if any(rows is None for rows in spread):
        yield replace(relation, sides=sides)  # a vector or a tensor by its letter on one side
        return
    if len({(len(rows), len(rows[0])) for rows in spread if rows}) > 1:
        raise BindingError("matrices of different size on both sides", expected="one size")
    for i, j in product(range(height), range(width)):
        entries = (rows[i][j] for rows in spread if rows)
        spans = (side.span for side in relation.sides)
        yield replace(
            relation,
            sides=tuple(
                replace(entry, span=span) for entry, span in zip(entries, spans, strict=True)
            ),
        )


def _zeros(side: Node, height: int, width: int) -> Rows | None:
    if side in (tree.Number("0"), Name("0", decoration="vector")):
        return ((tree.Number("0"),) * width,) * height
    return None


def _as_printed(side: Node, rows: Rows | None) -> Node:
    """A product of matrices as the one bracket that it makes."""
    if rows is None:
        return side
    if len(rows[0]) == 1:
        return tree.ComponentList(tuple(row[0] for row in rows), span=side.span)
    return tree.PrintedMatrix(tuple(tree.ComponentList(row) for row in rows), span=side.span)


def _with_inner_products(node: Node) -> Node:
    """A node whose products of a row, a matrix and a column are written out."""
    if isinstance(node, tree.Product) and any(_rows(f) for f in node.factors):
        rows = _multiplied(node.factors)
        if rows is not None and len(rows) == len(rows[0]) == 1:
            return replace(rows[0][0], span=node.span)
        return node
    return tree.mapped(node, _with_inner_products) if isinstance(node, Node) else node


def _rows(node: Node) -> Rows | None:
    """The entries of a matrix, or of an expression of matrices; None for anything else."""
    match node:
        case tree.ComponentList(entries):
            return tuple((entry,) for entry in entries)
        case tree.PrintedMatrix(rows):
            return tuple(row.entries for row in rows)
        case tree.Transposed(of):
            inside = _rows(of)
            return tuple(zip(*inside, strict=True)) if inside else None
        case tree.Negative(of):
            inside = _rows(of)
            return _mapped_rows(inside, lambda e: tree.Negative(e)) if inside else None
        case tree.Sum(terms):
            parts = [_rows(term) for term in terms]
            found = [rows for rows in parts if rows]
            return reduce(_added, found) if len(found) == len(parts) else None
        case tree.Product(factors):
            found_rows = _multiplied(factors)
            is_scalar = found_rows is not None and len(found_rows) == len(found_rows[0]) == 1
            return None if is_scalar else found_rows
        case tree.Quotient(above, below):
            inside = _rows(above)
            return _mapped_rows(inside, lambda e: tree.Quotient(e, below)) if inside else None
    return None


def _mapped_rows(rows: Rows, change: Callable[[Node], Node]) -> Rows:
    return tuple(tuple(change(entry) for entry in row) for row in rows)


def _added(one: Rows, other: Rows) -> Rows:
    if (len(one), len(one[0])) != (len(other), len(other[0])):
        raise BindingError("a sum of matrices of different size", expected="one size")
    return tuple(
        tuple(tree.Sum((a, b)) for a, b in zip(*rows, strict=True))
        for rows in zip(one, other, strict=True)
    )


def _multiplied(factors: Sequence[Node]) -> Rows | None:
    """The product of matrices and of factors that multiply every entry."""
    scalars = [factor for factor in factors if _rows(factor) is None]
    arrays = [rows for factor in factors if (rows := _rows(factor)) is not None]
    if not arrays:
        return None
    if any(isinstance(s, Name) and s.is_marked_vector for s in scalars):
        return None  # a matrix that maps a vector given by its letter
    whole = reduce(_product, arrays)
    if not scalars:
        return whole
    return _mapped_rows(whole, lambda entry: tree.product((*scalars, entry)))


def _product(one: Rows, other: Rows) -> Rows:
    if len(one[0]) != len(other):
        raise BindingError(
            f"a matrix of {len(one[0])} columns beside one of {len(other)} rows",
            expected="as many columns as rows",
        )
    columns = list(zip(*other, strict=True))
    return tuple(tuple(_inner_product(row, column) for column in columns) for row in one)


def _inner_product(row: Sequence[Node], column: Sequence[Node]) -> Node:
    zero = tree.Number("0")
    pairs = [(a, b) for a, b in zip(row, column, strict=True) if zero not in (a, b)]
    terms = tuple(tree.Product((a, b)) for a, b in pairs)
    if not terms:
        return zero
    return terms[0] if len(terms) == 1 else tree.Sum(terms)
