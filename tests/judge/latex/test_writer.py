"""What is written is read again as the same tree."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from judge.latex.drawn import differentials, relations, trees
from polhode.base import ParseError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import (
    Evaluated,
    Name,
    Node,
    Number,
    Power,
    Product,
    Relation,
    Statement,
    Transposed,
    mapped,
    walk,
)


@given(relations(3))
def test_a_relation_comes_back(relation: Relation) -> None:
    assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_bar_with_a_label_is_raised_in_brackets() -> None:
    at_one = Evaluated(Name("x"), "1")
    for raised in (Transposed(at_one), Power(at_one, Number("2"))):
        side = read_latex(write_latex(raised)).relations[0].sides[0]
        assert side == raised


@given(st.lists(trees(1) | differentials, min_size=2, max_size=4))
def test_differentials_among_factors_come_back(factors: list[Node]) -> None:
    side = Product((Name("x"), *factors))  # "constant" at the beginning may be a word beside it
    assert read_latex(write_latex(side)).relations == (Relation((side,)),)


@given(st.lists(relations(1), min_size=1, max_size=3))
def test_a_statement_comes_back(chains: list[Relation]) -> None:
    condition = Relation((Name("x"), Number("0")), (">",))
    chains = [chain for chain in chains if chain.signs] or chains[:1]  # nothing in no relation
    statement = Statement(tuple(chains), (condition,), tags=("7",))
    assert read_latex(write_latex(statement)) == statement


@given(relations(1))
def test_a_tree_is_rebuilt_from_its_parts(relation: Relation) -> None:
    assert mapped(relation, lambda part: part) == relation
    assert list(relation.parts) == list(relation.sides)
    assert sum(piece == relation for piece in walk(relation)) == 1


@pytest.mark.parametrize(
    ("latex", "written"),
    [
        (r"\sin\theta\,\dot\phi^2/2", r"\frac{\sin \theta \dot{\phi}^{2}}{2}"),
        (r"F_\rho'\hat{\bf z}", r"F'_{\rho} \hat{\mathbf{z}}"),
        (r"{\rm sech} kx", r"\operatorname{sech}\left(k x\right)"),
        (r"a - (b + c)", r"a - \left(b + c\right)"),
        (
            r"-\frac{d \boldsymbol\omega_{\rm cm}}{dt}",
            r"-\frac{d \boldsymbol{\omega}_{\mathrm{cm}}}{d t}",
        ),
    ],
)
def test_it_is_written_as_texts_print(latex: str, written: str) -> None:
    assert write_latex(read_latex(latex)) == written


@pytest.mark.parametrize("count", range(1, 60))
def test_signs_in_a_row_come_back_or_are_refused(count: int) -> None:
    deep = r"\begin{matrix} a & b \\ " + "-" * count + r"c & d \end{matrix}"
    for latex in ("-" * count + "x", r"a \times " + "-" * count + "x", deep):
        try:
            (relation,) = read_latex(latex).relations
        except ParseError:
            assert count > 12
        else:
            assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_word_of_any_length_comes_back() -> None:
    word, _ = read_latex("S" * 122 + "$a = b$").relations
    assert read_latex(write_latex(word)).relations == (word,)


def test_only_parts_of_trees_are_written() -> None:
    with pytest.raises(TypeError, match="str"):
        write_latex("x")


@pytest.mark.parametrize(
    "latex",
    [
        r"A{^{beginA}} v",
        r"\mathbf v^{A_B}",
        r"\omega^{S/O}",
        r"\omega^{Stern/O}",
        r"\mathbf R^{\\body2toT}",
        r"x_{a.{2}}",
        r"x_{\text{low...est}}",
        r"$y = \frac{a}{b}$ ({low) or $y = c$ (fast)",
        r"\Delta\mathring{^N}The",
        r"\bm\omega^{{S}_T{i}}",
        r"(2^{+const})",
        r"\omega^{S\varpi/O}",
        r"dt^\text{2}",
        r"\bm\mathrm{cm}_B",
        "disk[const]",
        "+const x = 2",
        "+const",
        r"\order{const}",
        "((0)_1)^T",
        r"x = \begin{cases} a & [\mathrm{KE}] = a \\ b \end{cases}",
        r"((\mathbf v)_z)^B",
        r"\vec[0_\times]",
        "const = const = a",
        r"2[\mathrm{MW}] = [\mathrm{KE}]_z",
        r"\sum_i^{10^{2}} \mathrm{MW}",
        r"2\degree_2",
        r"\sin O (a + b)",
        r"\prescript{N}{}{\mathrm{KE}}",
        r"\dv[2]{x}{\theta(t)}",
        r"v \text{(x) or} w",
    ],
)
def test_what_was_found_by_random_search_comes_back(latex: str) -> None:
    for relation in read_latex(latex).relations:
        assert read_latex(write_latex(relation)).relations == (relation,)


@pytest.mark.parametrize(
    "latex",
    [r"F_(\theta_)", "F_{: =}", r"^{{if}\check}e", "x(t)'", "v(t)^*"],
)
def test_what_would_be_written_as_something_else_is_refused(latex: str) -> None:
    with pytest.raises(ParseError, match=r"in a label|a label on more than a letter"):
        read_latex(latex)


def test_a_zero_matrix_has_no_bar() -> None:
    with pytest.raises(ParseError, match="a bar over more than a letter"):
        read_latex(r"\bar[0_{\times}]")


@pytest.mark.parametrize("latex", ["dv/(dt)", r"\frac{dv}{(dt)}", "(dv)/(dt)", "{dv}/{dt}"])
def test_brackets_around_differentials_make_no_difference(latex: str) -> None:
    assert read_latex(latex) == read_latex(r"\frac{dv}{dt}")


def test_a_slash_in_the_name_of_a_frame_stands_between_two_names() -> None:
    with pytest.raises(ParseError, match="expected a quantity"):
        read_latex(r"\omega^{S/}")


def test_a_label_in_front_is_more_than_a_hat() -> None:
    with pytest.raises(ParseError, match="label in front without letters"):
        read_latex(r"\leftexp\hat{N}{a}")


def test_each_index_of_a_sum_is_named_once() -> None:
    with pytest.raises(ParseError, match="an index named twice"):
        read_latex(r"\sum_{i,j,i} x_{ij}")


def test_of_many_slashes_no_tower_is_built() -> None:
    with pytest.raises(ParseError, match="slashes in a row"):
        read_latex("x" + "/y" * 20)


@pytest.mark.parametrize(
    ("opener", "closer"),
    [("|", "|"), (r"\sqrt ", ""), (r"\sin -", ""), (r"\sum_i -", ""), (r"\frac{d}{dt} ", "")],
)
def test_what_is_nested_comes_back_or_is_refused(opener: str, closer: str) -> None:
    for depth in (5, 9, 17, 18, 25, 40, 59):
        latex = opener * depth + "x" + closer * depth
        try:
            (relation,) = read_latex(latex).relations
        except ParseError:
            assert depth > 8
            continue
        assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_diagonal_is_no_longer_than_it_can_be_written() -> None:
    with pytest.raises(ParseError, match="a diagonal of 200 entries"):
        read_latex(r"\operatorname{diag}(" + ",".join("a" * 200) + ")")


def test_the_power_of_a_unit_takes_no_brace_that_it_has_not_opened() -> None:
    (relation,) = read_latex(r"x = \frac{2\,\mathrm{m}^2}{y}").relations
    assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_tie_between_the_words_of_a_case_is_a_space() -> None:
    (relation,) = read_latex("$$x = y$$ (at~first) or $z$ (later)").relations
    assert read_latex(write_latex(relation)).relations == (relation,)


@pytest.mark.parametrize("label", [r"\rm\dot{\theta}^2\cos^2\theta", r"s^{-1}", "a+^2b"])
def test_a_label_has_no_powers(label: str) -> None:
    with pytest.raises(ParseError, match="a formula in a label"):
        read_latex(f"T_{{{label}}} = 2")


def test_a_number_is_not_transposed() -> None:
    for latex in ("(135)^{-T}", "(135)^T", "135^{-T}"):
        (relation,) = read_latex(latex).relations
        assert read_latex(write_latex(relation)).relations == (relation,)


def test_punctuation_is_no_label() -> None:
    with pytest.raises(ParseError, match="an empty label"):
        read_latex(r"\theta(t_;0)")


def test_a_derivative_with_a_slash_acts_on_what_stands_behind_it() -> None:
    (relation,) = read_latex("d/dt x = y").relations
    assert relation == read_latex(r"\frac{d}{dt} x = y").relations[0]
    with pytest.raises(ParseError, match="nothing to act on"):
        read_latex("y = d/dx")


def test_a_word_in_a_label_is_not_written_as_a_macro_that_means_another() -> None:
    (relation,) = read_latex(r"x_{\rm bot} = y").relations
    assert write_latex(relation) == r"x_{\mathrm{bot}} = y"
    assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_bracket_behind_the_differential_of_a_letter_o_is_no_order() -> None:
    (relation,) = read_latex(r"x dO \int 1 dy").relations
    assert read_latex(write_latex(relation)).relations == (relation,)


def test_letters_that_may_stand_for_cosine_and_sine_are_set_apart():
    """Where cθ and sθ both occur they are cos θ and sin θ; products of letters are not."""
    (relation,) = read_latex(r"{c}\theta + {s}\theta = x").relations
    assert write_latex(relation) == r"{c} \theta + {s} \theta = x"
    assert read_latex(write_latex(relation)).relations == (relation,)


def test_a_letter_sigma_is_no_sign_of_a_sum() -> None:
    (relation,) = read_latex(r"{\Sigma}i = M").relations
    assert relation.sides[0] == Product((Name("Sigma"), Name("i")))
    (seen,) = read_latex(r"{}^{A}{\Sigma}b = M").relations
    assert read_latex(write_latex(seen)).relations == (seen,)
    assert read_latex(write_latex(relation)).relations == (relation,)
