"""Trees such as formulas are read into, drawn at random."""

from collections.abc import Callable
from functools import cache

from hypothesis import strategies as st

from judge.latex.displays import DISPLAYS
from judge.latex.test_notations import NOTATIONS
from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex import read_latex
from polhode.judge.latex._tree import (
    At,
    Call,
    Case,
    Cases,
    Component,
    ComponentList,
    Cross,
    Derivative,
    Differential,
    Dot,
    Dots,
    Evaluated,
    Integral,
    Magnitude,
    Name,
    Negative,
    Node,
    Number,
    Omitted,
    Order,
    Outer,
    PlusMinus,
    Power,
    PrintedMatrix,
    Product,
    Quotient,
    Relation,
    Resolved,
    Root,
    Sum,
    Summation,
    Transposed,
    UnitSymbol,
    Words,
    walk,
)

LETTERS = ("a", "d", "k", "m", "n", "t", "v", "x", "theta", "omega", "Delta", "pi", "cal L")
LABELS = ("1", "cm", "2p", "2,max", "rho", "perp", "(1,2,3)", "rho phi z", "2pi", "t=0", "1_2")
PLAIN_DECORATIONS = ("", "", "hat", "vector", "bar", "tilde", "breve")
DECORATIONS = (*PLAIN_DECORATIONS, "bar vector", "tilde vector", "tilde hat", "check vector")
FRAMES = ("", "rot", "s", "N", "A", "B/N", "'")

#: Letters and what may stand around them, to be read whatever comes of it.
SPELLED = r"""
    x d t e O \theta \omega \mathbf{v} \hat{\mathbf{n}} \bar{r} \mathcal{L} \boldsymbol{\omega}
    \mathbf{0} \mathrm{KE} \text{MW} \text{const} \mathrm{cm} \text{tr} \boldsymbol{\mathrm{AB}}
    \tilde{\hat{a}}
"""
SCRIPTS = r"""
    a B N T n 1 2 10 . .5 \rho \perp \varpi \mathrm{cm} \text{a~b} \text{S/O} \mathrm{bot} \max
    / _ ' * + - = : , ( ) \bar \dot \circ | i1 rot \mathcal{B} \sin \mathrm{kg} \text{const} \times
    \to {}
"""

Nodes = st.SearchStrategy[Node]


def _quantities(latex: str) -> list[Node]:
    """The quantities that a text holds, as far as it is read and has no words or differentials."""
    try:
        sides = [side for relation in read_latex(latex).relations for side in relation.sides]
    except ParseError:
        return []
    return [
        side
        for side in sides
        if not any(isinstance(piece, Words | Differential) for piece in walk(side))
    ]


signs = st.sampled_from(
    ("=", "≈", "≡", "≠", "<", ">", "≤", "≥", "≪", "≫", "∝", "→", "↔", "∈", "↦"),
)
functions = st.sampled_from(sorted(set(lexicon.FUNCTIONS.values())))
labels = st.sampled_from(LABELS)
plain_names = st.builds(
    Name,
    st.sampled_from(("t", "x", "theta", "omega")),
    st.sampled_from(("", "1", "cm", "2,max")),
    decoration=st.sampled_from(("", "vector")),
)
names = st.builds(
    Name,
    st.sampled_from(LETTERS),
    st.just("") | labels,
    st.integers(0, 2),
    st.sampled_from(DECORATIONS),
    st.sampled_from(("", "", "*", "cm", "perp", "(1)")),
)
in_frames = st.builds(
    Name,
    st.sampled_from(("v", "omega", "R")),
    st.just("") | labels,
    st.integers(0, 1),
    st.sampled_from(DECORATIONS),
    st.sampled_from(("", "B", "P_1", "B/N", "*")),
    st.sampled_from(("N", "A", "B")),
)
of_points = st.builds(
    Name,
    st.sampled_from(("v", "r")),
    decoration=st.sampled_from(("hat", "vector", "bar vector")),
    superscript=st.sampled_from(("P", "OP", "S/O", "i")),
)
scripts = st.lists(st.sampled_from(SCRIPTS.split()), max_size=4).map(" ".join)
spelled_letters = st.sampled_from(SPELLED.split())
around = st.one_of(
    spelled_letters,
    st.builds(r"\dot{{{}}}".format, spelled_letters),
    st.builds(r"\mathring{{{}}}".format, spelled_letters),
)
behind = st.one_of(
    st.just("'"), st.builds("_{{{}}}".format, scripts), st.builds("^{{{}}}".format, scripts)
)
before = st.just("+") | st.builds(r"+\prescript{{{}}}{{}}".format, scripts)


#: A letter with whatever labels the reader takes; a zero for those that it does not.
read_names = st.builds(
    lambda *parts: next(iter(_quantities("".join(parts))), Number("0")),
    before,
    around,
    st.lists(behind, max_size=3).map("".join),
)


unit_vectors = st.builds(Name, st.sampled_from("123"), labels, decoration=st.just("hat"))
numbers = st.builds(Number, st.sampled_from(("0", "1", "2", "12", "0.35")))
degrees = st.builds(lambda number: Product((number, Name("degree"))), numbers)
times = plain_names | st.builds(Dots, plain_names, st.integers(1, 3))
differentials = st.builds(Differential, times, st.sampled_from("dΔδ"))
applied = st.builds(At, times, plain_names | st.just(Number("0")))
of_several = st.builds(
    At, times, st.builds(ComponentList, st.lists(times, min_size=2, max_size=3).map(tuple))
)
circled = st.builds(lambda name: Derivative(name, Name("t"), frame="circ"), in_frames | names)
frames = st.sampled_from(("N", "B"))
indices = st.builds(Name, st.sampled_from(("i", "alpha")))
summing = st.sampled_from(("sum", "product"))
units = st.builds(UnitSymbol, st.sampled_from(("m", "m/s^2", "kg m^2", "rad/s")))
zeros = st.builds(Name, st.just("0"), st.sampled_from(("", "3×3")), decoration=st.just("vector"))
#: Small quantities of texts, as they are read: all kinds, within each other as texts have them.
PRINTED = tuple(
    dict.fromkeys(
        piece
        for latex in (*DISPLAYS.values(), *NOTATIONS)
        for quantity in _quantities(latex)
        for piece in walk(quantity)
        if isinstance(piece, Node)
        and sum(1 for _ in walk(piece)) < 12
        and piece != Name("body")  # which stands only below an integral
    )
)
printed = st.integers(0, len(PRINTED) - 1).map(lambda place: PRINTED[place])
leaves = st.one_of(
    names,
    unit_vectors,
    read_names,
    printed,
    numbers,
    degrees,
    times,
    applied,
    in_frames,
    of_points,
    of_several,
) | st.one_of(circled, units, zeros, st.just(Omitted()))


def _several(nodes: Nodes) -> st.SearchStrategy[tuple[Node, ...]]:
    return st.lists(nodes, min_size=2, max_size=4).map(tuple)


def _chain(nodes: Nodes, least: int) -> st.SearchStrategy[Relation]:
    lengths = range(least, 4)
    return st.one_of(
        st.builds(Relation, st.tuples(*[nodes] * length), st.tuples(*[signs] * (length - 1)))
        for length in lengths
    )


def _case(nodes: Nodes) -> st.SearchStrategy[Case]:
    conditions = st.lists(_chain(nodes, 2), max_size=2).map(tuple)
    return st.builds(Case, nodes, conditions, st.sampled_from(("", "slow", "if it slips")))


BRANCHES: tuple[Callable[[Nodes], Nodes], ...] = (
    lambda nodes: st.builds(Sum, _several(nodes)),
    lambda nodes: st.builds(Product, _several(nodes)),
    lambda nodes: st.builds(Negative, nodes),
    lambda nodes: st.builds(PlusMinus, nodes, st.sampled_from("±∓")),
    lambda nodes: st.builds(Cross, nodes, nodes),
    lambda nodes: st.builds(Dot, nodes, nodes),
    lambda nodes: st.builds(Quotient, nodes, nodes),
    lambda nodes: st.builds(Power, nodes, nodes),
    lambda nodes: st.builds(Root, nodes, st.sampled_from((None, Number("3"), Name("n")))),
    lambda nodes: st.builds(Call, functions, nodes),
    lambda nodes: st.builds(Dots, nodes, st.integers(1, 3)),
    lambda nodes: st.builds(
        Derivative, nodes, times, st.integers(1, 3), st.booleans(), st.sampled_from(FRAMES)
    ),
    lambda nodes: st.builds(Outer, nodes, nodes),
    lambda nodes: st.builds(Order, nodes),
    lambda nodes: _matrices(nodes),
    lambda nodes: nodes.map(lambda node: Transposed(node) if _keeps_transpose(node) else node),
    lambda nodes: st.builds(
        Resolved, _matrices(nodes) | st.builds(ComponentList, _several(nodes)), frames
    ),
    lambda nodes: st.builds(
        Summation, nodes, indices, st.none() | nodes, st.none() | nodes, summing
    ),
    lambda nodes: st.builds(Integral, nodes, plain_names, st.just(Name("V"))),
    lambda nodes: st.builds(Integral, nodes, plain_names),
    lambda nodes: st.builds(Integral, nodes, plain_names, nodes, nodes),
    lambda nodes: st.builds(Magnitude, nodes),
    lambda nodes: st.builds(Component, nodes, labels),
    lambda nodes: st.builds(Evaluated, nodes, labels),
    lambda nodes: st.builds(ComponentList, _several(nodes)),
    lambda nodes: st.builds(Cases, st.lists(_case(nodes), min_size=1, max_size=2).map(tuple)),
)


def _matrices(nodes: Nodes) -> st.SearchStrategy[PrintedMatrix]:
    def of_size(size: tuple[int, int]) -> st.SearchStrategy[PrintedMatrix]:
        row = st.builds(ComponentList, st.tuples(*[nodes] * size[1]))
        return st.builds(PrintedMatrix, st.tuples(*[row] * size[0]))

    return st.sampled_from(((1, 2), (2, 2), (1, 3))).flatmap(of_size)


def _keeps_transpose(node: Node) -> bool:
    """Whether a T above is kept: it makes a column of a row, of e a power; words have none."""
    return (
        node not in (Name("e"), Name("constant"))
        and not isinstance(node, ComponentList | Number)
        and (not isinstance(node, PrintedMatrix) or len(node.rows) > 1)
    )


@cache
def trees(depth: int = 2) -> Nodes:
    """Quantities, at most so deep."""
    if depth == 0:
        return leaves
    return st.one_of(leaves, *(branch(trees(depth - 1)) for branch in BRANCHES))


@cache
def relations(depth: int = 2) -> st.SearchStrategy[Relation]:
    """Chains of quantities, or one alone."""
    return _chain(trees(depth), 1)
