"""The page of a review: marks beside relations, hints, and a text that is escaped throughout."""

import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from judge.solutions import NAME, TEXT, equations, hostile, solution
from polhode.judge import Hints, Mark, Review, ReviewedLine, read_source
from polhode.judge import review as reviewed
from polhode.judge.output._messages import SIGNS, TITLES
from polhode.judge.output._page import notebook_html, review_html, review_page

VOID = {"meta", "link", "br", "hr", "img", "source"}
ELEMENTS = {
    "html", "head", "meta", "title", "link", "style", "body", "header", "main", "section", "h1",
    "h2", "h3", "h4", "p", "ul", "li", "div", "span", "small", "strong", "em", "code", "b", "a",
    "br", "details", "summary", "button", "math", "mrow", "mi", "mn", "mo", "mtext", "mspace",
    "mfrac", "msqrt", "mroot", "msup", "msub", "msubsup", "mover", "munder", "munderover",
    "menclose", "mstyle", "mtable", "mtr", "mtd", "mphantom", "mpadded", "ms", "none",
    "mmultiscripts", "mprescripts",
}  # fmt: skip


class Page(HTMLParser):
    """The elements of a page, each with its attributes; they must be closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.found, self.words = [], [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "style" not in self.open and "script" not in self.open:
            self.words.append(data)

    @property
    def text(self):
        return " ".join("".join(self.words).split())


def test_every_relation_has_its_mark_in_words_and_with_a_sign():
    page = Page(review_html(solution()))
    groups = [attrs for _, attrs in page.found if attrs.get("role") == "group"]
    labels = {attrs["id"]: attrs["aria-label"] for attrs in groups}
    assert labels == {
        f"r{i}": f"Line {line.line}: {TITLES[line.mark]}" for i, line in enumerate(solution().lines)
    }
    for mark in Mark:
        assert f"{SIGNS[mark]} {TITLES[mark]}" in page.text


def test_a_reader_hears_words_formula_mark_and_evidence_in_this_order():
    text = review_html(solution())
    places = [
        text.index("Along its own axes"),
        text.index('id="r0"'),
        text.index('id="r1"'),
        text.index("This does not hold on the model"),
        text.index("cos where sin is right"),
        text.index("The moments of inertia"),
        text.index('id="r4"'),
    ]
    assert places == sorted(places)


def test_the_words_of_the_text_are_there_and_its_macros_are_expanded():
    page = Page(review_html(solution()))
    for words in ("Problem 2 (a): the rolling disk", "of mass", "For a small tilt, 5% say"):
        assert words in page.text
    assert "\\rate" not in page.text
    assert "a time derivative" not in page.text  # a comment
    assert ("em", {}) in page.found


def test_links_lead_somewhere():
    page = Page(review_html(solution()))
    ids = {attrs["id"] for _, attrs in page.found if "id" in attrs}
    targets = {attrs["href"] for tag, attrs in page.found if tag == "a"}
    assert targets
    assert targets <= {f"#{name}" for name in ids}


def test_the_final_answer_stands_in_the_summary():
    page = Page(review_html(solution()))
    assert "Final answer, line" in page.text
    assert "Error: line 9." in page.text


@pytest.mark.parametrize("hints", [Hints.WHERE, Hints.KIND])
def test_what_is_withheld_is_nowhere_in_the_source(hints):
    text = review_html(solution(), equations(), hints)
    whole = Page(review_html(solution()))
    error = solution().lines[1].verdict
    assert error.correction.what in whole.text
    assert error.correction.what not in text
    assert r"\omega_1 = 0" not in text
    for line in solution().lines:
        if line.mark is not Mark.TRUE and line.verdict:
            for residual in line.verdict.residuals:
                assert str(residual.expression) not in text
    # The second angular velocity is φ' sin θ, and nothing on the page of words says so.
    words = text.split('<script type="application/json" id="player">')[0]
    marked = words[words.index('id="r1"') : words.index("The moments of inertia")]
    assert "sin" not in re.sub("<[^>]*>", "", marked)


def test_the_first_level_shows_no_motion_and_runs_no_script():
    text = review_html(solution(), equations(), Hints.WHERE)
    assert "<script" not in text
    assert "script-src 'none'" in text


def test_a_state_that_refutes_a_line_is_typeset():
    page = review_html(solution())
    state = re.findall(r"<p>At (.*?) \(SI\)", page)[0]
    assert "_" not in state
    assert "atan(" not in state
    assert "<mi>arctan</mi>" in state


def test_every_final_answer_stands_in_the_summary():
    text = r"$\boxed{T = 0}$ and $\boxed{V = 0}$"
    review = reviewed(text, equations())
    assert review_html(review).count("<p>Final answer, ") == 2


def test_a_state_that_refutes_a_line_is_played():
    page = review_html(solution(), equations(), Hints.KIND)
    buttons = [attrs for tag, attrs in Page(page).found if tag == "button"]
    assert [attrs["data-scene"] for attrs in buttons] == ["1"]
    assert '"equations"' not in page.split('id="scenes"')[1].split("</script>")[0]


def test_nothing_is_fetched():
    page = review_html(solution(), equations())
    policy = re.search(r'content="(default-src[^"]*)"', page)[1]
    assert policy.startswith("default-src 'none'")
    assert not re.search(r"<(?:img|iframe|object|embed)\b", page.split('id="player"')[0])


TEXTS = st.text(max_size=60) | st.sampled_from(
    [
        "</style><script>alert(1)</script>",
        '"><img src=x onerror=alert(1)>',
        r"\text{<script>alert(1)</script>}",
        r"$\text{</span><iframe src='//x'>}$ and \href{javascript:alert(1)}{x}",
        "\ue0000\ue002 \ue0015\ue002",
        "<!--", "]]>", "&lt;", "\x00\ud800", "{{}}", "$", "\\",
    ]
)  # fmt: skip


@settings(deadline=None)
@given(TEXTS)
def test_nothing_of_a_text_reaches_the_page_unescaped(text):
    page = Page(review_html(hostile(text)))
    assert {tag for tag, _ in page.found} <= ELEMENTS
    for tag, attrs in page.found:
        assert not any(name.startswith("on") or name in ("src", "style") for name in attrs)
        assert tag not in ("a", "link") or attrs["href"].startswith(("#r", "data:,"))


@settings(deadline=None)
@given(st.lists(TEXTS | st.sampled_from([r"$a = b$", r"\[ c = d \]", "\n\n"]), max_size=6))
def test_hostile_words_around_formulas(parts):
    text = "".join(parts)
    for format in (".tex", ".md"):
        found = read_source(text, format, f"a{format}")
        lines = [ReviewedLine(r.file, r.line, r.column, r.latex, Mark.ERROR) for r in found]
        page = Page(
            review_html(Review("s", (f"a{format}",), tuple(lines), texts={f"a{format}": text}))
        )
        assert {tag for tag, _ in page.found} <= ELEMENTS
        ids = [attrs["id"] for _, attrs in page.found if "id" in attrs]
        assert sorted(ids) == sorted(f"r{i}" for i in range(len(lines)))


@pytest.mark.parametrize("opener", [r"\section{", r"\emph{", r"\textbf{a} \section{b \emph{"])
def test_words_are_shown_once_where_braces_are_not_closed(opener):
    page = review_html(Review("", ("a.tex",), (), texts={"a.tex": f"{opener * 3000}last words"}))
    assert page.count("last words") == 1


def test_without_its_text_a_review_still_shows_its_relations():
    page = Page(review_html(replace(solution(), texts={})))
    ids = {attrs["id"] for _, attrs in page.found if "id" in attrs}
    assert ids == {f"r{i}" for i in range(len(solution().lines))}


def test_files_that_others_include_have_their_own_heading():
    other = replace(solution().lines[0], file="part.tex", line=1, column=2)
    both = replace(
        solution(), lines=(*solution().lines, other), texts={NAME: TEXT, "part.tex": "$a = b$"}
    )
    page = Page(review_html(both))
    assert "part.tex" in page.text
    assert len({attrs["id"] for _, attrs in page.found if "id" in attrs}) == len(both.lines)


def test_macros_of_an_included_file_and_rows_of_a_display_are_shown_typeset():
    shown = "\\[ T &= \\spin \\\\ &= 2\\spin \\]"
    main = f"\\input{{macros}} {shown} A \\begin{{lemma}}[of $b$]So $b$.\\end{{lemma}}"
    texts = {"a.tex": main, "macros.tex": "\\newcommand{\\spin}{\\omega_3}"}
    (relation,) = read_source(f"{texts['macros.tex']}{main[14:]}")
    line = ReviewedLine("a.tex", 1, 19, relation.latex, Mark.TRUE)
    html = review_html(Review("s", ("a.tex",), (line,), texts=texts))
    assert "spin" not in html
    assert html.count("<mtr>") == 2
    assert "Lemma (of " in Page(html).text


def test_no_relation_is_lost_with_the_code_around_it():
    text = "#set page(margin: 2cm)\n#figure($ a = b $)\n#box[$c = d$]"
    lines = [
        ReviewedLine(r.file, r.line, r.column, r.latex, Mark.TRUE)
        for r in read_source(text, ".typ", "a.typ")
    ]
    page = Page(review_html(Review("s", ("a.typ",), tuple(lines), texts={"a.typ": text})))
    assert {attrs["id"] for _, attrs in page.found if "id" in attrs} == {"r0", "r1"}
    assert "margin" not in page.text


def test_cells_of_a_notebook_are_paragraphs_and_prices_keep_their_signs():
    cells = '{"cell_type": "markdown", "source": ["%s"]}'
    first = "It costs $5 and the table $20, so $a$."
    text = f'{{"cells": [{cells % first}, {cells % "## Then"}]}}'
    page = Page(review_html(Review("s", ("a.ipynb",), (), texts={"a.ipynb": text})))
    assert "It costs $5 and the table $20, so a." in " ".join(page.text.split())
    assert "h3" in {tag for tag, _ in page.found}


def test_the_page_is_written(tmp_path):
    review_page(solution(), tmp_path / "disk.html")
    assert (tmp_path / "disk.html").read_text("utf-8") == review_html(solution())


def test_a_notebook_shows_the_same_text():
    shown = solution()._repr_html_()
    assert shown == notebook_html(solution())
    assert "<script" not in shown
    assert "Problem 2 (a)" in Page(shown).text


def test_a_damaged_notebook_has_only_its_heading():
    both = replace(solution(), files=(NAME, "a.ipynb"), texts={NAME: TEXT, "a.ipynb": "{"})
    page = Page(review_html(both))
    assert "a.ipynb" in page.text
    assert sum("id" in attrs for _, attrs in page.found) == len(both.lines)
