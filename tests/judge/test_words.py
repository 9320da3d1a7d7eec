"""The words of a document: what a reader sees of LaTeX and of Markdown."""

import re
from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polhode.judge import ShownFormula, SourceWords, read_pieces
from polhode.judge.text._words import blocks, formula_at, with_formulas, without_marks

ALLOWED = {"em", "strong", "code", "br"}


def shown(text, format=".tex"):
    return [(block.kind, str(block.html)) for block in blocks(text, format)]


@pytest.mark.parametrize(
    ("source", "html"),
    [
        (r"a \emph{very \textbf{old}} top", "a <em>very <strong>old</strong></em> top"),
        (r"50\,\% of M\"uller \& S\o{}n", "50% of Müller &amp; Søn"),
        (
            r"see~(\ref{a}), \eqref{eq:b} and \cite{goldstein}",
            "see\u00a0(a), (eq:b) and [goldstein]",
        ),
        (r"``so'' -- it --- is", "“so” – it — is"),
        (r"Poinsot's \textit{h\'erpolhodie} \ldots", "Poinsot's <em>hérpolhodie</em> …"),
        (r"\unknown{kept} \label{gone}\vspace{2em}text", "kept text"),
        ("x < y & <b>z</b>", "x &lt; y &amp; &lt;b&gt;z&lt;/b&gt;"),
    ],
)
def test_words_of_latex(source, html):
    assert shown(source) == [("p", html)]


def test_blocks_of_latex():
    source = (
        "\\documentclass{article}\\newcommand{\\a}{b}\n\\begin{document}\n\\section*{One}\n"
        "First.\n\nSecond.\n\\begin{itemize}\\item this \\item that\\end{itemize}\n"
        f"\\subsection{{Two}}\nLet {formula_at(0, is_display=True)} be.\n\\end{{document}} rest"
    )
    found = shown(source)
    assert found == [
        ("h2", "One"),
        ("p", "First."),
        ("p", "Second."),
        ("li", "this"),
        ("li", "that"),
        ("h3", "Two"),
        ("p", "Let"),
        ("formula", ""),
        ("p", "be."),
    ]


def test_blocks_of_markdown():
    source = (
        "# One\nA *thin* disk, `code` and **more** [here](http://x.y).\n\n- this\n- that\n\n2 \\* 3"
    )
    assert shown(source, ".md") == [
        ("h2", "One"),
        ("p", "A <em>thin</em> disk, <code>code</code> and <strong>more</strong> here."),
        ("li", "this"),
        ("li", "that"),
        ("p", "2 * 3"),
    ]


def test_headings_of_typst():
    assert shown("= One\n== Two\nA *thin* disk.", ".typ") == [
        ("h2", "One"),
        ("h3", "Two"),
        ("p", "A <em>thin</em> disk."),
    ]


def test_definitions_in_the_text_are_not_words():
    assert shown(r"\newcommand{\x}[1]{y {#1}} so \def\z#1{w} be it") == [("p", "so  be it")]


class _Tags(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = set()

    def handle_starttag(self, tag, attrs):
        self.found.add(tag)
        assert not attrs


@given(
    st.text(max_size=80)
    | st.lists(
        st.sampled_from(
            [
                "<script>",
                "\\emph{",
                "}",
                "\\textbf{",
                "\ue0001\ue002",
                "&",
                "`",
                "**",
                "]](",
                "\\item",
            ]
        ),
        max_size=12,
    ).map("".join),
    st.sampled_from([".tex", ".md"]),
)
def test_no_element_comes_from_the_text(text, format):
    for block in blocks(without_marks(text), format):
        tags = _Tags()
        tags.feed(block.html)
        assert tags.found <= ALLOWED
        for name in ALLOWED - {"br"}:
            assert block.html.count(f"<{name}>") == block.html.count(f"</{name}>")
        with_formulas(block.html, lambda number: pytest.fail("no formula was put in"))


def test_pieces_join_to_the_text():
    source = "So $a = b$ and\n\\[ c = d \\]\nhold % not this: $x$\n."
    pieces = list(read_pieces(source, ".tex"))
    formulas = [piece for piece in pieces if isinstance(piece, ShownFormula)]
    assert [(f.latex, f.is_display) for f in formulas] == [("a = b", False), (" c = d ", True)]
    assert [f.begin for f in formulas] == [(1, 5), (2, 3)]
    words = "".join(piece.text for piece in pieces if isinstance(piece, SourceWords))
    assert re.sub(r"[$\\\[\]\s]+", " ", words) == "So and hold ."


def test_pieces_of_a_notebook_are_those_of_its_cells():
    source = '{"cells": [{"cell_type": "markdown", "source": ["A $\\\\omega$\\n", "top"]}]}'
    found = list(read_pieces(source, ".ipynb"))
    assert [piece.text if isinstance(piece, SourceWords) else piece.latex for piece in found] == [
        "A $",
        r"\omega",
        "$\ntop",
        "\n\n",
    ]
