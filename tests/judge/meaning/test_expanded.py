"""Indices and matrices written out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from judge import textbook_systems as systems
from judge.judged import uncorrected
from polhode.judge import Answer
from polhode.judge._notation import Notation
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.meaning._expanded import expanded


def written_out(latex: str, equations: ph.Equations) -> list[str]:
    found = expanded(read_latex(latex), Notation.of(equations).vocabulary)
    return [write_latex(r) for r in found.relations]


@pytest.mark.parametrize(
    ("latex", "same"),
    [
        (r"2T = \sum_i I_i\omega_i^2", r"2T = I_1\omega_1^2 + I_2\omega_2^2 + I_3\omega_3^2"),
        (r"L_i = I_i\omega_i", r"L_1 = I_1\omega_1,\ L_2 = I_2\omega_2,\ L_3 = I_3\omega_3"),
        (r"L_i = \sum_j I_{ij}\omega_j", r"L_1 = I_{11}\omega_1,\ L_2 = I_{22}\omega_2"),
    ],
)  # fmt: skip
def test_an_index_of_axes(latex: str, same: str) -> None:
    for formula in (latex, same):
        assert ph.check(formula, systems.free_body(), context="identity").answer is Answer.HOLDS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"L_i\dot\omega_i = 0", Answer.HOLDS),  # the rate of T, since L_i = I_i ω_i
        (r"\sum_i L_i\dot\omega_i = 0", Answer.HOLDS),
        (r"L_i\ddot\omega_i = 0", Answer.FAILS),
        (r"L_iL_i = L^2", Answer.HOLDS),
        (r"\omega_i\omega_i = \omega^2", Answer.HOLDS),
        (r"\omega_i\omega_i = 2\omega^2", Answer.FAILS),
        (r"L_i^2 + L_j^2 + L_k^2 = L^2", Answer.HOLDS),  # here they stand for axes
        (r"T = \frac12(L_i\omega_i + L_j\omega_j + L_k\omega_k)", Answer.HOLDS),
    ],
)  # fmt: skip
def test_a_repeated_index_is_summed_over(latex: str, answer: Answer) -> None:
    assert uncorrected(latex, systems.free_body()).answer is answer


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"T = \frac12\sum_{i=1}^2 m_iv_i^2", Answer.HOLDS),
        (r"T = \frac12\sum_i m_iv_i^2", Answer.HOLDS),
        (r"T = \sum_{i=1}^2 m_iv_i^2", Answer.FAILS),
        (r"T = \frac12\sum_{i=1}^1 m_iv_i^2", Answer.FAILS),
    ],
)
def test_an_index_of_bodies(latex: str, answer: Answer) -> None:
    assert uncorrected(latex, systems.beads(), context="identity").answer is answer


def test_an_index_that_runs_over_nothing_known_says_so() -> None:
    verdict = ph.check(r"T = \sum_i b_i", systems.beads())
    assert verdict.answer is Answer.UNREAD
    assert "b_i, whose index runs over nothing known" in verdict.reason


ENTRIES = st.integers(1, 9)


@given(
    st.lists(st.lists(ENTRIES, min_size=2, max_size=2), min_size=2, max_size=2),
    st.lists(ENTRIES, min_size=2, max_size=2),
)
def test_a_matrix_times_a_column(matrix: list[list[int]], column: list[int]) -> None:
    rows = r"\\".join(" & ".join(map(str, row)) for row in matrix)
    product = np.array(matrix) @ np.array(column)
    latex = (
        rf"\begin{{pmatrix}}{rows}\end{{pmatrix}}"
        rf"\begin{{pmatrix}}{column[0]}\\{column[1]}\end{{pmatrix}}"
        rf" = \begin{{pmatrix}}{product[0]}\\{product[1]}\end{{pmatrix}}"
    )
    assert len(written_out(latex, systems.beads())) == 2
    verdict = ph.check(latex, systems.beads(), context="identity", seconds=None)
    assert verdict.answer is Answer.HOLDS


def test_matrices_that_do_not_match_are_refused() -> None:
    latex = (
        r"\begin{pmatrix}1&2\\3&4\end{pmatrix}\begin{pmatrix}1\\2\\3\end{pmatrix}"
        r" = \begin{pmatrix}1\\2\end{pmatrix}"
    )
    verdict = ph.check(latex, systems.beads())
    assert verdict.answer is Answer.UNREAD
    assert "as many columns as rows" in verdict.reason


@pytest.mark.parametrize(
    "latex",
    [
        r"\mathbf I = \begin{pmatrix}I_1&0&0\\0&I_2&0\\0&0&I_3\end{pmatrix}",
        r"\mathbf L = \begin{pmatrix}I_1&0&0\\0&I_2&0\\0&0&I_3\end{pmatrix}\boldsymbol\omega",
        r"T = \frac12\boldsymbol\omega^T\mathbf I\boldsymbol\omega",
        r"T = \frac12\boldsymbol\omega\cdot\mathbf I\cdot\boldsymbol\omega",
    ],
)
def test_tensors_as_matrices(latex: str) -> None:
    assert ph.check(latex, systems.free_body(), context="identity").answer is Answer.HOLDS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"\ddot\theta = -\frac gl(\theta - \frac{\theta^3}{6}) + O(\theta^5)", Answer.APPROXIMATE),
        (r"\ddot\theta = -\frac gl(\theta - \frac{\theta^3}{6} + \cdots)", Answer.APPROXIMATE),
        (r"\ddot\theta = -\frac gl(\theta - \frac{\theta^3}{3} + \cdots)", Answer.FAILS),
    ],
)
def test_terms_left_out_make_an_approximation(latex: str, answer: Answer) -> None:
    verdict = uncorrected(latex, systems.pendulum(), context="limit", small=[r"\theta:3"])
    assert verdict.answer is answer
