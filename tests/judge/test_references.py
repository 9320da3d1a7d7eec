"""What the words of a text cite by number or label is what a line is drawn from."""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET
from polhode.judge import read_source
from polhode.judge.text._references import References

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
UNLINKED = ph.Mark.UNLINKED


@cache
def disk() -> ph.Equations:
    return ph.derive(PROBLEM_SET["rolling-disk"].build())


def keys(text: str, format: str = ".tex") -> list[set[str]]:
    relations = read_source(text, format, "a")
    return [set(found) for found in References.of(relations, {"a": text}).of_relation]


def test_equations_are_numbered_as_latex_does() -> None:
    text = r"""
\begin{equation} a = b \label{one} \end{equation} % \begin{equation} x = y \end{equation}
\[ c = d \] $e = f$
\begin{align}
  g &= h, \\
  i &= j, \nonumber \\
  k &= l. \label{four}
\end{align}
\begin{equation*} m = n \tag{A} \end{equation*}
"""
    assert keys(text) == [
        {"1", "label one"},
        set(),
        set(),
        {"2"},
        set(),
        {"3", "label four"},
        {"A"},
    ]


def test_displays_that_are_not_closed_have_no_number_and_take_no_long_time() -> None:
    text = r"\begin{align}" * 20_000 + "\n\n" + r"\begin{equation} T = 0 \end{equation}"
    relations = read_source(text)
    assert References.of(relations, {"": text}).of_relation[-1] == {"1"}


def test_numbers_at_the_end_of_a_display_count_in_markdown() -> None:
    assert keys("$$ a = b \\tag{7} $$\n\n$$ c = d \\qquad (8) $$", ".md") == [{"7"}, {"8"}]


SLIPS = r"""
\begin{equation} V = mga\cos\theta \label{v} \end{equation}
\begin{equation}
T = \frac{ma^2}{8}(6\omega_3^2 + 5\dot\theta^2 + 2\dot\phi^2\sin^2\theta)
\end{equation}
\begin{equation} E = T + V \end{equation}
"""


@pytest.mark.parametrize("words", [r"By~\eqref{v}", "From (1)", "By eq. 1", "With (1) in (3)"])
def test_a_line_follows_from_what_it_cites(words: str) -> None:
    text = rf"{SLIPS} {words} we find \[ E = T + mga\cos\theta . \]"
    line = ph.review(text, disk(), seconds=0.0).lines[-1]
    assert (blamed(line), line.of) == (FOLLOWS, 0)


# -- what the words behind a display say of the next one -------------------------------------------


def test_a_line_all_of_whose_terms_vanish_in_steady_motion_says_nothing_of_it() -> None:
    text = r"In steady motion \[ \ddot\phi\sin\theta = 3\omega_3\dot\theta . \]"
    assert [blamed(line) for line in ph.review(text, disk(), seconds=0.0).lines] == [ERROR]
