"""Trees written as LaTeX in the style of textbooks; the result is read back as the same tree."""

from __future__ import annotations

from functools import singledispatch
from itertools import pairwise

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._labels import label_latex
from polhode.judge.latex._names import (
    BEGIN_DIFFERENTIATED,
    ORDERS,
    ROMAN,
    exponent_latex,
    follows_d,
    in_frame_latex,
    is_word,
    letter_latex,
    name_latex,
    scanned,
    scripts_latex,
)
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
    Piece,
    PlusMinus,
    PoissonBracket,
    Power,
    PrintedMatrix,
    Product,
    Quotient,
    Relation,
    Resolved,
    Root,
    Statement,
    Sum,
    Summation,
    Transposed,
    UnitSymbol,
    Words,
    factors_of,
)

_SIGNS = {"=": "=", "<": "<", ">": ">", "→": r"\to", "↔": r"\leftrightarrow"} | {
    "≈": r"\approx",
    "≡": r"\equiv",
    "≠": r"\ne",
    "≤": r"\le",
    "≥": r"\ge",
    "≪": r"\ll",
    "≫": r"\gg",
    "∝": r"\propto",
    "∈": r"\in",
    "↦": r"\mapsto",
}
_ADDED = {"±": r"\pm", "∓": r"\mp"}
_MULTIPLIED: dict[type[Node], str] = {Cross: r"\times", Dot: r"\cdot", Outer: r"\otimes"}
_DIFFERENTIALS = {"d": "d", "Δ": r"\Delta", "δ": r"\delta", "∂": r"\partial"}
_DOTS = {count: name for name, count in lexicon.DOTS.items()}
_SIGNED = (Sum, Negative, PlusMinus)
# Bracketed beside a sign of multiplication.
_OPEN = (*_SIGNED, Cross, Dot, Outer, Integral, Summation)
_WIDE = (*_OPEN, Product)  # and beside another factor
_BRACKETED = (Magnitude, Component, PrintedMatrix, Evaluated)  # by themselves
_RAISED_BARE = (Magnitude, Component, PrintedMatrix, Number, Dots, At)
_TAKEN_FOR_DIFFERENTIALS = frozenset(Name(letter) for letter in lexicon.DIFFERENTIALS)
_BRACKETED_ANGLES = frozenset(lexicon.DIFFERENTIALS) | {"n", "k", "pi", "constant"}
_JOINING_ANGLES = lexicon.GREEK | {"t"}  # which, behind an angle, may belong to it
_KNOWN_TO_LATEX = lexicon.FUNCTIONS.keys() - {"sech", "csch", "arsinh", "arcosh", "artanh"}


@singledispatch
def write_latex(piece: Piece) -> str:
    """LaTeX for a tree; the notes of a statement are left out.

    Args:
        piece: a node, a relation or a statement.
    """
    raise TypeError(f"no LaTeX for {type(piece).__name__}")


@write_latex.register
def _(statement: Statement) -> str:
    relations = r",\quad ".join(write_latex(relation) for relation in statement.relations)
    conditions = (rf"\quad {_bracketed(relation)}" for relation in statement.conditions)
    assumed = (
        rf"\quad \left(\text{{if }} {write_latex(relation)}\right)"
        for relation in statement.assumptions
    )
    tags = (rf"\tag{{{tag}}}" for tag in statement.tags)
    return "".join((relations, *conditions, *assumed, *tags))


@write_latex.register
def _(relation: Relation) -> str:
    first, *rest = (write_latex(side) for side in relation.sides)
    begins_with_word = first.startswith(r"\text{constant}")
    if begins_with_word and (relation.sides[0] != Name("constant") or not rest):
        first = f"+{first}"  # a word at the beginning is a note
    chain = zip(relation.signs, rest, strict=True)
    return first + "".join(f" {_SIGNS[sign]} {side}" for sign, side in chain)


@write_latex.register
def _(number: Number) -> str:
    return number.text


@write_latex.register
def _(name: Name) -> str:
    written = name_latex(name)
    before = written.removesuffix(r"\Sigma")
    # A Σ before a quantity is read as the sign of a sum.
    return written if before == written else rf"{before}{{\Sigma}}"


@write_latex.register
def _(words: Words) -> str:
    return rf"\text{{{words.text}}}"


@write_latex.register
def _(dots: Dots) -> str:
    macro = _DOTS[dots.count]
    if not isinstance(dots.of, Name):
        return rf"\{macro}{{{write_latex(dots.of)}}}"
    return _below_mark(rf"\{macro}", dots.of, dots.count)


def _below_mark(macro: str, name: Name, dots: int = 0) -> str:
    """A letter under dots or a circle, with its labels outside."""
    if name.letter.isdigit() and not name.decoration:
        return rf"{macro}{{{name_latex(name)}}}"
    letter = rf"{macro}{{{letter_latex(name)}}}"
    return in_frame_latex(name.prescript, letter) + scripts_latex(name, dots)


@write_latex.register
def _(derivative: Derivative) -> str:
    if derivative == Derivative(derivative.of, Name("t"), frame="circ"):
        return _circled(derivative.of)
    label = "" if _stands_before_d(derivative.frame) else f"_{{{label_latex(derivative.frame)}}}"
    sign = r"\partial" if derivative.partial else "d"
    power = f"^{{{derivative.order}}}" if derivative.order > 1 else ""
    below = f"{sign} {write_latex(derivative.by)}{power}"
    above = f"{sign if label else _sign_in_frame(sign, derivative.frame)}{power}"
    # Behind a whole derivative, only the known names of triads are not those of a component.
    is_known = not label or derivative.frame.partition("_")[0] in lexicon.FRAMES
    if follows_d(derivative.of) and is_known:
        whole = rf"\frac{{{above} {write_latex(derivative.of)}}}{{{below}}}"
        return rf"\left({whole}\right){label}" if label else whole
    operator = rf"\frac{{{above}}}{{{below}}}"
    operator = rf"\left({operator}\right){label}" if label else operator
    return operator + _bracketed(derivative.of)


def _circled(node: Node) -> str:
    if isinstance(node, Name):
        return _below_mark(r"\overset{\circ}", node)
    return rf"\overset{{\circ}}{{{write_latex(node)}}}"


def _stands_before_d(frame: str) -> bool:
    """Whether a triad is printed with the d, as in ᴺd or d', and not as a label behind."""
    return frame in ("", "'") or (len(frame) == 1 and frame.isalnum() and frame not in "sbS")


@write_latex.register
def _(differential: Differential) -> str:
    return f"{_DIFFERENTIALS[differential.sign]} {write_latex(differential.of)}"


@write_latex.register
def _(integral: Integral) -> str:
    limits = _limit("_", integral.lower) + _limit("^", integral.upper)
    measured = Product((*factors_of(integral.of), Differential(integral.by)))
    return rf"\int{limits} {write_latex(measured)}"


@write_latex.register
def _(total: Sum) -> str:
    first, *rest = total.terms
    return _term(first) + "".join(f" {_added(term)}" for term in rest)


@write_latex.register
def _(negative: Negative) -> str:
    return f"-{_bracketed_if(negative.of, _SIGNED)}"


@write_latex.register
def _(either: PlusMinus) -> str:
    return f"{_ADDED[either.sign]} {_bracketed_if(either.of, _SIGNED)}"


@write_latex.register
def _(product: Product) -> str:
    if _is_angle_in_degrees(product):
        return rf"{write_latex(product.factors[0])}^{{\circ}}"
    written = [
        write_latex(f) if _is_angle_in_degrees(f) else _bracketed_if(f, _WIDE)
        for f in product.factors
    ]
    for place, (left, right) in enumerate(pairwise(product.factors)):
        begins = scanned(written[place + 1])[0]
        if isinstance(left, Number) and begins.kind == "number":
            written[place + 1] = _bracketed(right)
        if begins.kind == "words":  # which stand for a quantity only where one has to come
            written[place + 1] = rf"\left[{written[place + 1]}\right]"
        if left in _TAKEN_FOR_DIFFERENTIALS and begins.kind in BEGIN_DIFFERENTIATED:
            written[place] = rf"\left[{written[place]}\right]"  # round ones hold arguments
        if begins.kind == "letter" and begins.text in _JOINING_ANGLES:
            written[place] = _closed(left, written[place], begins.text)
        if begins.text in lexicon.ANGLES and scanned(written[place])[-1].text in ("c", "s"):
            written[place] = f"{{{written[place]}}}"  # not the cosine or sine that it is short for
        if isinstance(right, ComponentList):  # not what a function is taken at
            written[place + 1] = _stacked(right)
        letter = left.of if isinstance(left, Differential) else left
        if letter in ORDERS and written[place + 1].startswith(r"\left("):
            written[place + 1] = rf"\left[{written[place + 1]}\right]"
    first, *rest = written
    return first + "".join(f if f.startswith(r"\left(") else f" {f}" for f in rest)


@write_latex.register
def _(multiplied: Cross | Dot | Outer) -> str:
    left, right = (_bracketed_if(side, _OPEN) for side in (multiplied.left, multiplied.right))
    return f"{left} {_MULTIPLIED[type(multiplied)]} {right}"


@write_latex.register
def _(unit: UnitSymbol) -> str:
    return rf"\unit{{{unit.text}}}"


@write_latex.register
def _(transposed: Transposed) -> str:
    of = transposed.of
    return f"{_bracketed(of) if isinstance(of, Component) else _raised_base(of)}^{{T}}"


@write_latex.register
def _(resolved: Resolved) -> str:
    is_matrix = isinstance(resolved.of, PrintedMatrix | ComponentList)
    inside = write_latex(resolved.of) if is_matrix else _bracketed(resolved.of)
    return in_frame_latex(resolved.frame, inside)


@write_latex.register
def _(total: Summation) -> str:
    below = f"_{{{write_latex(total.index)}" if total.index else ""
    if total.lower:
        below += f" = {write_latex(total.lower)}"
    sign = (r"\sum" if total.sign == "sum" else r"\prod") + below + "}" * bool(below)
    return f"{sign}{_limit('^', total.upper)} {_bracketed_if(total.of, _SIGNED)}"


@write_latex.register
def _(order: Order) -> str:
    return rf"O\left({write_latex(order.of)}\right)"


@write_latex.register
def _(omitted: Omitted) -> str:
    return r"\cdots"


@write_latex.register
def _(matrix: PrintedMatrix) -> str:
    rows = (" & ".join(write_latex(entry) for entry in row.entries) for row in matrix.rows)
    inside = r" \\ ".join(rows)
    return rf"\begin{{pmatrix}} {inside} \end{{pmatrix}}"


@write_latex.register
def _(quotient: Quotient) -> str:
    return rf"\frac{{{write_latex(quotient.above)}}}{{{write_latex(quotient.below)}}}"


@write_latex.register
def _(power: Power) -> str:
    exponent = write_latex(power.exponent)
    base = power.base
    if isinstance(base, Call) and power.exponent != Negative(Number("1")):
        return f"{_function(base)}^{{{exponent}}}{_angle(base)}"
    if isinstance(base, Differential) and isinstance(power.exponent, Number):
        return f"{write_latex(base)}^{{{exponent}}}"
    stands_on = base.of if isinstance(base, Component) else base  # as its bracket is read
    return f"{_raised_base(base)}^{{{exponent_latex(exponent, stands_on)}}}"


def _raised_base(base: Node) -> str:
    """What an exponent stands on, in brackets where the exponent might join its labels."""
    bare = isinstance(base, _RAISED_BARE) or (isinstance(base, Name) and not base.superscript)
    if isinstance(base, ComponentList):
        return _stacked(base)
    if isinstance(base, Name) and not bare:  # round brackets would hold what a letter is taken at
        return rf"\left[{write_latex(base)}\right]"
    return write_latex(base) if bare else _bracketed(base)


@write_latex.register
def _(root: Root) -> str:
    index = f"[{write_latex(root.index)}]" if root.index else ""
    return rf"\sqrt{index}{{{write_latex(root.of)}}}"


@write_latex.register
def _(call: Call) -> str:
    return _function(call) + _angle(call)


@write_latex.register
def _(at: At) -> str:
    if isinstance(at.argument, ComponentList):
        return write_latex(at.of) + write_latex(at.argument)
    return write_latex(at.of) + _bracketed(at.argument)


@write_latex.register
def _(magnitude: Magnitude) -> str:
    return rf"\left|{write_latex(magnitude.of)}\right|"


@write_latex.register
def _(component: Component) -> str:
    return f"{_bracketed(component.of)}_{{{label_latex(component.subscript)}}}"


@write_latex.register
def _(evaluated: Evaluated) -> str:
    label = label_latex(evaluated.subscript)
    return rf"\left.{write_latex(evaluated.of)}\right|_{{{label}}}"


@write_latex.register
def _(components: ComponentList) -> str:
    if len(components.entries) == 1:
        return _stacked(components)
    return rf"\left({', '.join(write_latex(entry) for entry in components.entries)}\right)"


@write_latex.register
def _(bracket: PoissonBracket) -> str:
    left, right = (write_latex(part) for part in (bracket.left, bracket.right))
    opener, closer = ("[", "]") if bracket.is_square else (r"\{", r"\}")
    return rf"\left{opener}{left}, {right}\right{closer}"


def _stacked(components: ComponentList) -> str:
    """A column."""
    inside = r" \\ ".join(write_latex(entry) for entry in components.entries)
    return rf"\begin{{pmatrix}} {inside} \end{{pmatrix}}"


@write_latex.register
def _(cases: Cases) -> str:
    rows = r" \\ ".join(write_latex(case) for case in cases.cases)
    return rf"\begin{{cases}} {rows} \end{{cases}}"


@write_latex.register
def _(case: Case) -> str:
    words = [rf"\text{{{case.words}}}"] if case.words else []
    stated = [write_latex(condition) for condition in case.conditions]
    # A word at the beginning is a remark.
    remarks = [f"+{c}" if scanned(c)[0].kind == "words" else c for c in stated] + words
    value = write_latex(case.value)
    return f"{value} & {', '.join(remarks)}" if remarks else value


def _sign_in_frame(sign: str, frame: str) -> str:
    """The d of a derivative with the triad that it names."""
    if frame in ("", "'"):
        return sign + frame
    return in_frame_latex(frame, sign)


def _bracketed(piece: Piece) -> str:
    inside = write_latex(piece)
    if isinstance(piece, Name) and is_word(piece):  # words in round brackets are a label or a note
        return rf"\left[{inside}\right]"
    return rf"\left({inside}\right)"


def _bracketed_if(node: Node, kinds: tuple[type[Node], ...]) -> str:
    return _bracketed(node) if isinstance(node, kinds) else write_latex(node)


def _term(node: Node) -> str:
    return _bracketed_if(node, (Sum,))


def _added(node: Node) -> str:
    """A term behind another, with the sign between."""
    match node:
        case Negative(of):
            return f"- {_bracketed_if(of, _SIGNED)}"
        case PlusMinus():
            return write_latex(node)
    return f"+ {_term(node)}"


def _is_angle_in_degrees(node: Node) -> bool:
    match node:
        case Product((Number(), mark)):
            return mark == Name("degree")
    return False


def _limit(mark: str, limit: Node | None) -> str:
    return f"{mark}{{{write_latex(limit)}}}" if limit else ""


def _function(call: Call) -> str:
    known = call.function in _KNOWN_TO_LATEX
    return rf"\{call.function}" if known else rf"\operatorname{{{call.function}}}"


def _angle(call: Call) -> str:
    """The argument: behind the function where it is one letter, else in brackets."""
    name = call.argument.of if isinstance(call.argument, Dots) else call.argument
    if isinstance(name, Name) and name.letter not in _BRACKETED_ANGLES and name not in ORDERS:
        return f" {write_latex(call.argument)}"
    return _bracketed(call.argument)


def _closed(node: Node, written: str, behind: str) -> str:
    """A function with its argument in brackets where what follows would join the angle."""
    call = node.base if isinstance(node, Power) else node
    if not isinstance(call, Call):
        return written
    is_latin = isinstance(call.argument, Name) and call.argument.letter in ROMAN
    if behind != "t" and not is_latin:
        return written
    power = f"^{{{write_latex(node.exponent)}}}" if isinstance(node, Power) else ""
    return f"{_function(call)}{power}{_bracketed(call.argument)}"
