"""No line of a solution that polhode writes itself is doubted; the campaign takes them all."""

import pytest

import polhode as ph
from judge.marking import blamed, marked
from judge.own_solutions import doubted, equations
from judge.solutions_with_slips import solution


@pytest.mark.parametrize(
    ("name", "format"),
    [("marble-on-turntable", ".tex"), ("ball-on-paper", ".md")],
)
def test_no_line_is_doubted(name: str, format: str) -> None:
    assert doubted(name, format) == []


def test_a_slip_in_an_energy_is_named_and_what_is_worked_out_from_it_follows() -> None:
    found = marked(solution(18, with_slip=True))
    assert found.is_named
    assert found.following == len(found.drawn) > 1
    assert not found.false_marks


def test_a_formula_made_smaller_by_a_macro_is_read() -> None:
    macro = (
        r"\newcommand{\fitted}[1]{\sbox{\formula}{$\displaystyle #1$}\usebox{\formula}}"
        "\n"
        + r"\begin{document}\[ \fitted{V = mga\sin\theta} \]\[ \fitted{V = mga} \]\end{document}"
    )
    lines = ph.review(macro, equations("spinning-coin"), seconds=0.0).lines
    assert [blamed(line) for line in lines] == [ph.Mark.TRUE, ph.Mark.ERROR]
