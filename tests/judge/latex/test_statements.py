"""Displays with several relations, rows, conditions, cases, words and numbers."""

import pytest

from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import (
    Case,
    Cases,
    Name,
    Negative,
    Node,
    Number,
    Quotient,
    Relation,
    Sum,
    Words,
)

a, b, c, d, x, theta, pi = map(Name, ["a", "b", "c", "d", "x", "theta", "pi"])
ZERO, TWO = Number("0"), Number("2")


def read(latex: str) -> Node:
    """The one quantity that a text holds."""
    (relation,) = read_latex(latex).relations
    (side,) = relation.sides
    return side


@pytest.mark.parametrize(
    ("latex", "sign"),
    [
        ("a = b", "="),
        (r"a \approx b", "≈"),
        ("a ≈ b", "≈"),
        ("a < b", "<"),
        (r"a \leq b", "≤"),
        (r"a \ge b", "≥"),
        (r"a \ll b", "≪"),
        (r"a \gg b", "≫"),
        (r"a \equiv b", "≡"),
        (r"a \propto b", "∝"),
        (r"a \neq b", "≠"),
        (r"a \to b", "→"),
        (r"a \leftrightarrow b", "↔"),
    ],
)
def test_signs_of_relations(latex: str, sign: str) -> None:
    assert read_latex(latex).relations == (Relation((a, b), (sign,)),)


def test_a_chain_is_one_relation() -> None:
    assert read_latex(r"a = b \approx c < d").relations == (
        Relation((a, b, c, d), ("=", "≈", "<")),
    )


@pytest.mark.parametrize(
    "latex",
    [
        r"a = b, \qquad c = d",
        r"a = b \quad c = d",
        r"a = b \\ c = d",
        r"a = b; c = d.",
        r"a = b \text{ and } c = d",
        r"a = b \Rightarrow c = d",
        r"a = b \to c = d",
        r"\begin{align} a &= b, \\ c &= d \end{align}",
        r"\begin{array}{rcl} a & = & b \\ c & = & d \end{array}",
        "$a = b$, where $c = d$",
        "$$a = b$$\n\n$$c = d$$",
    ],
)
def test_two_relations_in_one_display(latex: str) -> None:
    assert read_latex(latex).relations == (Relation((a, b), ("=",)), Relation((c, d), ("=",)))


def test_an_arrow_to_a_quantity_is_of_a_limit() -> None:
    assert read_latex(r"a = b \to c").relations == (Relation((a, b, c), ("=", "→")),)


@pytest.mark.parametrize(
    "latex",
    [
        r"a &= b \\ &= c + d",
        r"a = b \\ = c \\ + d",
        "$$a = b$$\n$$= c + d$$",
        "$$\na = b\n$$\n= $c$\n+ $d$",
        r"a = b, = c + d",
        r"a = b \n= c \n+ d",
    ],
)
def test_a_row_that_begins_with_a_sign_continues(latex: str) -> None:
    assert read_latex(latex).relations == (Relation((a, b, Sum((c, d))), ("=", "=")),)


def test_a_row_that_begins_with_a_minus_sign() -> None:
    going_on = Relation((a, Sum((b, Negative(c)))), ("=",))
    assert read_latex(r"a = b \\ - c").relations == (going_on,)
    assert read_latex(r"a &= b \\ & - c").relations == (going_on,)
    assert read_latex(r"a &= b \\ -c &= d").relations == (
        Relation((a, b), ("=",)),
        Relation((Negative(c), d), ("=",)),
    )


@pytest.mark.parametrize(
    "latex",
    [r"a = b \tag{7}", r"a = b. (7)", r"a = b, \qquad(7)", "$$a = b$$ (7)", "$$a = b$$\n\\n(7)"],
)
def test_equation_numbers(latex: str) -> None:
    statement = read_latex(latex)
    assert statement.tags == ("7",)
    assert statement.relations == (Relation((a, b), ("=",)),)


def test_words_between_relations_are_notes() -> None:
    statement = read_latex(r"\text{Since } a = b, \text{ and with } c = d")
    assert statement.notes == ("Since", "and with")


def test_a_condition_behind_a_gap() -> None:
    statement = read_latex(r"a > b \qquad (\theta < \pi/2)")
    assert statement.conditions == (Relation((theta, Quotient(pi, TWO)), ("<",)),)
    assert statement.relations == (Relation((a, b), (">",)),)


def test_what_is_constant() -> None:
    for latex in (r"a = \text{constant}.", r"a = \mathrm{const.}", r"a = \text{a constant}"):
        assert read_latex(latex).relations == (Relation((a, Name("constant")), ("=",)),)


def test_words_for_a_quantity() -> None:
    (relation,) = read_latex(r"\theta = \text{angle of } \hat z \text{ and so on}.").relations
    assert relation.sides == (theta, Words(r"angle of \hat z and so on"))
    assert read_latex(r"a = (\text{spin})").relations[0].sides[1] == Words("( spin )")
    assert read_latex("$a =$ the height.").relations[0].sides[1] == Words("the height")


def test_a_relation_alone_in_brackets() -> None:
    assert read_latex("(a = b)").relations == (Relation((a, b), ("=",)),)


CASES = Cases((Case(a, (Relation((x, ZERO), (">",)),)), Case(Negative(b), words="otherwise")))


@pytest.mark.parametrize(
    "latex",
    [
        r"\begin{cases} a & x > 0 \\ -b, & \text{otherwise} \end{cases}",
        r"\left\{ \begin{array}{ll} a & x > 0, \\ -b & \text{otherwise} \end{array} \right.",
    ],
)
def test_cases(latex: str) -> None:
    assert read(latex) == CASES


def test_either_of_two_values() -> None:
    value = Cases((Case(a, words="slow"), Case(b, words="fast")))
    for latex in (r"x = a \text{ (slow) or } b \text{ (fast)}", "$x = a$ (slow) or $b$ (fast)"):
        assert read_latex(latex).relations == (Relation((x, value), ("=",)),)


def test_either_of_two_relations() -> None:
    assert read_latex(r"x = a \text{ or } x = b").relations == (
        Relation((x, a), ("=",)),
        Relation((x, b), ("=",)),
    )


def test_pieces_know_their_place() -> None:
    text = r"m\dot{\mathbf v}_{\rm cm} = \mathbf F - Mg\,\hat{\mathbf z}"
    (relation,) = read_latex(text).relations
    left, right = relation.sides
    assert text[slice(*left.span)] == r"m\dot{\mathbf v}_{\rm cm}"
    assert [text[slice(*term.span)] for term in right.terms] == [
        r"\mathbf F",
        r"- Mg\,\hat{\mathbf z}",
    ]


@pytest.mark.parametrize(
    ("latex", "relations"),
    [
        (r"a + b \\ - c = 0", ["a + b - c = 0"]),
        (r"a + b \\ - c + d \\ - e = 0", ["a + b - c + d - e = 0"]),
        (r"x = 1 \\ -a + b \\ - c = 0", ["x = 1", "-a + b - c = 0"]),
        (r"a = b \\ -c = 0", ["a = b", "-c = 0"]),
        (r"\underbrace{x}_{= 0} + y \\ - c = 0", ["x + y - c = 0", "x = 0"]),
    ],
)
def test_a_row_that_begins_with_a_minus_sign_continues_a_relation_without_a_sign(
    latex: str, relations: list[str]
) -> None:
    assert [write_latex(relation) for relation in read_latex(latex).relations] == relations
