"""Documents read: every relation with its place, its macros, and what else there is in a file."""

from __future__ import annotations

import json

import pytest

from judge.source.texts import LEAN, MARKDOWN, NOTEBOOK, RESTRUCTURED, TEX, TEXTS
from polhode.base import ParseError, StoreError
from polhode.judge import read_documents, read_file, read_source, read_text


def printed(text, format=".tex"):
    return [relation.printed for relation in read_source(text, format)]


def display(latex):
    return read_source(rf"\[{latex}\]")


# -- formats -------------------------------------------------------------------------------------


def test_latex_with_its_macros():
    assert printed(TEX) == [
        r"\frac{d \mathbf{L}}{d t} = \boldsymbol{\tau}",
        r"T = \frac{1}{2} I_{1} \dot{\theta}^{2}",
        r"V = M g l \cos \theta",
        r"E = T + V",
        r"\boldsymbol{\omega} = \omega_{3} \hat{\mathbf{3}}",
        r"I_{3} \omega_{3} = L_{3}",
    ]


def test_markdown_without_its_code():
    assert printed(MARKDOWN, ".md") == [
        r"\tau = M g l \sin \theta",
        r"p = L_{z}",
        r"\dot{\phi} = \frac{M g l}{I_{3} \omega_{3}}",
        r"E = T + V",
    ]


def test_a_notebook_keeps_its_macros_from_cell_to_cell():
    assert printed(NOTEBOOK, ".ipynb") == [r"L_{3} = I_{3} \omega_{3}", "p = q"]


def test_restructured_text_without_its_literal_blocks():
    assert printed(RESTRUCTURED, ".rst") == [
        r"\tau = M g l \sin \theta",
        "E = T + V",
        r"L_{3} = I_{3} \omega_{3}",
        r"p = L_{z}",
    ]


def test_the_comments_of_lean():
    assert printed(LEAN, ".lean") == [r"\tau = M g l \sin \theta", r"p = L_{z}"]


def test_mathematics_in_the_fences_of_markdown():
    block = "```math\na = b\n```\n\n```{math}\n:label: x\nc &= d \\\\\ne &= f\n```\n"
    text = f"{block}and $`g = h`$, <code>$i = j$</code>"
    found = read_source(text, ".md")
    assert [relation.printed for relation in found] == ["a = b", "c = d", "e = f", "g = h"]
    assert [relation.line for relation in found] == [2, 7, 8, 10]


def test_comments_and_listings_hide_one_another():
    text = r"""
    $$ a = b \\% \begin{verbatim}
       c = d $$ \verb|%| $ e = f $ 100\% $ g = h $
    """
    assert printed(text) == ["a = b", "c = d", "e = f", "g = h"]


def test_any_other_text_is_read_between_dollar_signs():
    assert printed("Here $a = b$ stands.", ".txt") == ["a = b"]


@pytest.mark.parametrize("format", TEXTS)
def test_every_place_is_where_the_formula_begins(format):
    text = TEXTS[format]
    lines = text.split("\n")
    for relation in read_source(text, format):
        first = relation.latex.split("\n")[0].strip()
        if format == ".ipynb":
            first = json.dumps(first, ensure_ascii=True)[1:-1]
        rest = lines[relation.line - 1][relation.column - 1 :]
        assert rest.startswith(first), relation


def test_the_latex_is_what_stands_in_the_file():
    found = read_source(TEX)
    assert found[0].latex == r"\rate{\mathbf L} = \boldsymbol\tau"
    assert found[1].latex.startswith(r"T &= \half I_1 \sq{\dot\angle}")


# -- rows ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "relations"),
    [
        (r"a &= b \\ &= c \\ d &= e", ["a = b = c", "d = e"]),
        (r"a &= b \\ &\quad + c", ["a = b + c"]),
        (r"\begin{split} a &= b \\ c &= d \end{split}", ["a = b", "c = d"]),
        (r"a = b, \qquad c = d", ["a = b", "c = d"]),
        (r"\left(\begin{aligned} a &= b \\ c &= d \end{aligned}\right)", ["a = b", "c = d"]),
        (r"\left\{\begin{array}{l} a = b \\ c = d \end{array}\right.", ["a = b", "c = d"]),
        (r"\begin{cases} a = b \\ c = d \end{cases}", ["a = b", "c = d"]),
        (r"a = 0 \\ \text{ where } \\ b = c", ["a = 0", "b = c"]),
        (r"a = b \;\;\; c = d", ["a = b", "c = d"]),
        (r"\boxed{a = b}", ["a = b"]),
        (r"{\displaystyle {\begin{aligned} a &= b \\ c &= d \end{aligned}}}", ["a = b", "c = d"]),
        (r"a \overset{!}{=} b", ["a = b"]),
        (r"a <= b", [r"a \le b"]),
        (r"a = b => c = d", ["a = b", "c = d"]),
        (r"a = b \;\; [\mathrm{N\,m}], \quad c = d", ["a = b", "c = d"]),
        (r"a = b [\text{x}]", ["a = b x"]),
        (r"\vphantom{\begin{matrix} a \end{matrix}} a = b", ["a = b"]),
        (r"\mathbf{v} = [a \quad b]", [r"\mathbf{v} = \left(a, b\right)"]),
        (r"\mathbf{v} = [a \quad 0 \quad -b]", [r"\mathbf{v} = \left(a, 0, -b\right)"]),
    ],
)
def test_a_display_of_several_relations(latex, relations):
    assert [relation.printed for relation in display(latex)] == relations


@pytest.mark.parametrize(
    "layout", ["{align}", "{alignat}{2}", "{IEEEeqnarray}{rCl}", "{IEEEeqnarray}[]{r?l}"]
)
def test_the_columns_of_a_layout_are_no_letters(layout):
    name = layout[: layout.index("}") + 1]
    assert printed(rf"\begin{layout} a &=& b \\ c &=& d \end{name}") == ["a = b", "c = d"]


def test_rows_of_equations_in_a_bracket_are_never_run_together():
    (relation,) = display(r"x = \left( a = b \\ c = d \right)")
    assert not relation.read
    assert "rows of equations in brackets" in relation.why


def test_one_row_that_cannot_be_read_leaves_the_others():
    good, bad = display(r"a &= b \\ c &= \frac{d}{")
    assert (good.read, good.printed) == (True, "a = b")
    assert not bad.read
    assert bad.why


def test_a_quantity_alone_is_no_relation():
    assert display(r"\frac{1}{2} m v^2") == []
    assert read_source("a force $> 0$ or $= 1$") == []


def test_a_display_that_is_not_closed_ends_with_its_paragraph():
    first, second = read_source("\\begin{equation} a = b\n\nand $c = d$")
    assert "not closed" in first.why
    assert second.printed == "c = d"


def test_a_relation_within_bold_braces_is_told():
    (relation,) = display(r"\mathbf{M\ddot q + Kq = 0}")
    assert "in bold" in relation.why


def test_a_file_of_very_many_formulas_is_cut_short(monkeypatch):
    monkeypatch.setattr("polhode.judge.source._read_source.MOST_FORMULAS", 3)
    document = read_text("$a = b$ " * 5)
    assert len(document.relations) == 3
    assert "more than 3 formulas" in str(document.refused[0])


def test_money_is_no_formula():
    assert printed("It costs $5.\n\nThat is $a = b$.") == ["a = b"]


# -- macros --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("definitions", "use", "meaning"),
    [
        (r"\newcommand\w{\omega}", r"a = \w t", r"a = \omega t"),
        (r"\newcommand{\v}[1]{\mathbf{#1}}", r"\v a = \v{b}", r"\mathbf{a} = \mathbf{b}"),
        (r"\newcommand{\p}[2][x]{#2_{#1}}", r"\p{a} = \p[y]{b}", r"a_{x} = b_{y}"),
        (r"\def\d#1#2{\frac{d#1}{d#2}}", r"\d xt = v", r"\frac{d x}{d t} = v"),
        (r"\def\a{b}\let\c\a\def\a{d}", r"\a = \c", "d = b"),
        (r"\newcommand\a{b}\renewcommand\a{c}", r"\a = d", "c = d"),
        (r"\newcommand\a{b}\providecommand\a{c}", r"\a = d", "b = d"),
        (r"\DeclarePairedDelimiter\mag{|}{|}", r"\mag{a} = b", r"\left|a\right| = b"),
        (
            r"\DeclarePairedDelimiter\mag{|}{|}",
            r"\mag*{a} = \mag[\Big]b",
            r"\left|a\right| = \left|b\right|",
        ),
        (r"\NewDocumentCommand{\v}{m}{\mathbf{#1}}", r"\v{a} = b", r"\mathbf{a} = b"),
        (
            r"\NewDocumentCommand\d{s O{t} m}{\frac{d#3}{d#2}}",
            r"\d{x} = \d*[y]x",
            r"\frac{d x}{d t} = \frac{d x}{d y}",
        ),
        (r"\RenewDocumentCommand{\vec}{m}{\hat{#1}}", r"\vec{a} = b", r"\hat{\mathbf{a}} = b"),
        (
            r"\NewDocumentCommand{\w}{m o}{\omega_{#1\IfValueT{#2}{/#2}}\IfNoValueTF{#2}{a}{b}}",
            r"\w{A} = \w{A}[B]",
            r"\omega_{A} a = \omega_{A/B} b",
        ),
        (
            r"\newcommandx{\rate}[3][1=,3={t}]{\frac{d^{#1}#2}{d#3^{#1}}}",
            r"\rate{x} = \rate[2]{x}[y]",
            r"\frac{d x}{d t} = \frac{d^{2} x}{d y^{2}}",
        ),
        (
            r"\DeclarePairedDelimiterX{\mean}[2]{|}{|}{#1\,\delimsize/\,#2}",
            r"\mean{a}{b} = c",
            r"\left|\frac{a}{b}\right| = c",
        ),
        (
            r"\newcommand{\p}[2][]{\partial^{#1} #2}",
            r"\frac{\p a}{\partial x} = b",
            r"\frac{\partial a}{\partial x} = b",
        ),
    ],
)
def test_macros(definitions, use, meaning):
    assert printed(f"{definitions}\n$${use}$$") == [meaning]


@pytest.mark.parametrize(
    ("latex", "relations"),
    [
        (r"\eqalign{a &= b \cr c &= d \cr}", ["a = b", "c = d"]),
        (r"\matrix{a\cr b} = c", [r"\left(a, b\right) = c"]),
        (r"a \cdotp b = \textcolor[rgb]{1,0,0}{c}", [r"a \cdot b = c"]),
        (r"\require{cancel} a \vcentcolon= b", [r"a \equiv b"]),
        (r"\MoveEqLeft a + b \\ &= c", ["a + b = c"]),
        (r"\tensor{R}{_{A}^{B}} = \tensor[^N]{v}{}", [r"R_{A}^{B} = {}^{N}v"]),
        (r"\odif{x} = v \odif{t}", [r"d x = v d t"]),
    ],
)
def test_macros_of_plain_tex_and_packages(latex, relations):
    assert [relation.printed for relation in display(latex)] == relations


def test_what_a_macro_or_environment_of_a_package_displays_is_found():
    assert printed(r"\newcommand{\eqn}[1]{\begin{equation}#1\end{equation}} \eqn{a = b}") == [
        "a = b"
    ]
    for opening in (r"{empheq}[left=\empheqlbrace]{align}", "{aligned}", "{dmath}[label={eq:x}]"):
        name = opening[: opening.index("}") + 1]
        text = rf"\begin{opening} a &= b \\ c &= d \end{name}"
        assert printed(text) == ["a = b", "c = d"]


def test_a_macro_holds_from_its_definition_on():
    assert printed(r"$\om = 1$ \newcommand\om{\omega} $\om = 1$")[1] == r"\omega = 1"


@pytest.mark.parametrize(
    "definitions",
    [
        r"\def\a{\a\a}",
        r"\def\a{x\b}\def\b{y\a}",
        r"\def\a{\b\b\b\b\b\b\b\b}\def\b{\c\c\c\c\c\c\c\c}\def\c{\e\e\e\e\e\e\e\e}\def\e{xxxxxxxx"
        r"xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx}",
    ],
)
def test_macros_that_grow_without_end_are_told(definitions):
    (relation,) = read_source(rf"{definitions} $\a = 1$")
    assert "grows without end" in relation.why


def test_a_macro_that_lacks_its_argument_is_told():
    (relation,) = read_source(r"\newcommand\v[2]{#1_#2} $a = \v b$")
    assert "1 argument" in relation.why


def test_a_macro_that_no_file_defines_is_a_letter_of_its_own():
    (first, second) = read_source(r"$$\inframe{0}{r} = 2\inframe{0}{r} + \qv$$ $$F = m \acc$$")
    assert first.printed == r"\inframe{0}{r} = 2 \inframe{0}{r} + \qv"
    left, right = first.relation.sides
    assert left == right.terms[0].factors[1]
    assert first.undefined == (r"\inframe{0}{r}", r"\qv")
    assert second.printed == r"F = m \acc"


def test_options_of_a_macro_that_no_file_defines_belong_to_it():
    (relation,) = display(r"\rate[2]{x} = \rate*{a}")
    assert relation.printed == r"\rate[2]{x} = \rate*{a}"


def test_units_are_no_macros_that_no_file_defines():
    (relation,) = display(r"m = \qty[mode=text]{2}{\kg} + \SI{3}{\g\per\m}")
    assert relation.printed == r"m = 2 \unit{kg} + 3 \unit{g/m}"


def test_the_place_of_a_macro_contains_all_of_it():
    macros = r"\def\v#1{{\bf #1}}\newcommand\c{\ensuremath{\text{const.}}}"
    found = read_source(rf"{macros} $$\left(a\right) = \v N$$ $$p = \c$$")
    assert [relation.latex for relation in found] == [
        r"\left(a\right) = \v N",
        r"p = \c",
    ]


def test_a_macro_that_only_ends_formulas_is_punctuation():
    assert printed(r"$$a = b \fin$$" * 10)[0] == "a = b"
    assert printed(r"$$a = b \fin$$" * 10 + r"$$a = \fin$$")[0] == r"a = b \fin"
    assert printed(r"$$a = b \fin$$" * 3)[0] == r"a = b \fin"


def test_a_macro_of_latex_is_never_taken_for_a_letter():
    (relation,) = read_source(r"$a \bowtie b = c$")
    assert not relation.read
    assert r"\bowtie" in relation.why


def test_a_macro_with_another_meaning_in_the_text_is_never_misread():
    (relation,) = display(r"\mp{a}{b} = c")  # no sign takes arguments
    assert relation.printed == r"\mp{a}{b} = c"
    assert relation.undefined == (r"\mp{a}{b}",)


def test_marks_close_behind_a_macro_belong_to_it():
    uses = " ".join(rf"${name}\tp = [a]\tp$" for name in (r"\p", r"\q", r"\p"))
    found = read_source(uses)
    assert [relation.undefined[0] for relation in found] == [r"\p\tp", r"\q\tp", r"\p\tp"]


# -- scope ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "subject"),
    [
        (r"G(s) = \frac{1}{s + 2}", "control"),
        (r"u = -K x", "control"),
        (r"M = EI w''", "flexible bodies"),
        (r"\texttt{omega} = 3", "software"),
        (r"i = 1, 2, \ldots, n", "index"),
        (r"n_c = 6", "number of dimensions"),
        (r"r \pm \sigma_r = 3", "statistics"),
        (r"1 + 1 = 2", "numbers"),
        (r"\omega = dp_i \wedge dq^i", "differential forms"),
    ],
)
def test_what_is_no_mechanics_is_told(latex, subject):
    (relation,) = display(latex)
    assert not relation.in_scope
    assert subject in relation.why


@pytest.mark.parametrize(
    "latex",
    [
        r"I_1 \dot\omega_1 = (I_2 - I_3)\omega_2\omega_3",
        r"m_1 = m_2",
        r"N = 0",
        r"\mathbf F = -k \mathbf r",
        r"T(\theta) = \tfrac12 I \dot\theta^2",
        r"\bowtie = 2 m",
    ],
)
def test_mechanics_is_in_scope_whether_it_is_read_or_not(latex):
    (relation,) = display(latex)
    assert relation.in_scope


def test_the_innermost_heading_that_names_a_subject_decides():
    text = r"""
    \section{Control of a bicycle} $$ a = b $$
    \subsection{Equations of motion} $$ c = d $$
    \subsection{Remarks} $$ e = f $$
    \section{The gyroscope} $$ g = h $$
    """
    assert [relation.in_scope for relation in read_source(text)] == [False, True, False, True]


# -- files ---------------------------------------------------------------------------------------


def test_files_that_a_document_includes(tmp_path):
    (tmp_path / "macros.tex").write_text(r"\newcommand{\om}{\omega}")
    (tmp_path / "part").mkdir()
    (tmp_path / "part" / "one.tex").write_text("\n$\\om = b$")
    main = tmp_path / "main.tex"
    main.write_text("\\input{macros}\n$a = \\om$ \\include{part/one} \\input{absent} $c = \\om$")
    found = read_file(main)
    assert [relation.printed for relation in found] == [
        r"a = \omega",
        r"\omega = b",
        r"c = \omega",
    ]
    assert [(relation.file, relation.line) for relation in found] == [
        (str(main), 2),
        (str(tmp_path / "part" / "one.tex"), 2),
        (str(main), 2),
    ]
    documents = list(read_documents([tmp_path / "part" / "one.tex", main]))
    assert [len(document.relations) for document in documents] == [0, 3]


def test_a_file_outside_the_folder_and_a_circle_are_refused(tmp_path):
    (tmp_path / "secret.tex").write_text("$a = b$")
    folder = tmp_path / "text"
    folder.mkdir()
    (folder / "main.tex").write_text("\\input{../secret} \\input{other} $c = d$")
    (folder / "other.tex").write_text("\\input{main} $e = f$")
    (folder / "link.tex").symlink_to(tmp_path / "secret.tex")
    main = folder / "main.tex"
    (document,) = read_documents([main])
    assert [relation.printed for relation in document.relations] == ["e = f", "c = d"]
    assert [str(error) for error in document.refused] == [
        f"{main}:1 includes ../secret, outside the folder of {main}; what it holds was not read",
        f"{folder / 'other.tex'}:1 includes main, which includes itself; what it holds was not "
        "read",
    ]


def test_a_missing_file_and_one_that_is_no_text_are_told_with_their_place(tmp_path):
    (tmp_path / "latin.tex").write_bytes("é $a = b$".encode("latin-1"))
    (tmp_path / "part" / "deep").mkdir(parents=True)
    (tmp_path / "part" / "one.tex").write_text("\\subfile{deep/two} $c = d$")
    (tmp_path / "part" / "deep" / "two.tex").write_text("\\input gone\n$e = f$")
    main = tmp_path / "main.tex"
    main.write_text("\\input{absent}\n\\input latin\n\\subimport{part/}{one}\n% \\input{comment}")
    (document,) = read_documents([main])
    assert [relation.printed for relation in document.relations] == ["e = f", "c = d"]
    missing, damaged, deep = map(str, document.refused)
    told = "a file that is not there; what it holds was not read"
    assert missing == f"{main}:1 includes absent, {told}"
    assert damaged.startswith(f"{main}:2 includes latin, {tmp_path / 'latin.tex'} is not UTF-8")
    assert deep == f"{tmp_path / 'part' / 'deep' / 'two.tex'}:1 includes gone, {told}"
    assert [str(e) for e in read_text("\n\\input{a}").refused] == [
        "line 2 includes a, a file that is not at hand; what it holds was not read"
    ]


def test_lines_end_in_any_way(tmp_path):
    path = tmp_path / "a.tex"
    path.write_bytes("\ufeffx\r\n$a = b$\r$c = d$".encode())
    assert [(r.line, r.column) for r in read_file(path)] == [(2, 2), (3, 2)]


def test_what_is_no_document(tmp_path):
    with pytest.raises(StoreError, match="cannot be read"):
        read_file(tmp_path / "absent.tex")
    with pytest.raises(StoreError, match="is a folder"):
        read_file(tmp_path)
    (tmp_path / "latin.tex").write_bytes("é".encode("latin-1"))
    with pytest.raises(StoreError, match="not UTF-8: byte 1 is 0xe9"):
        read_file(tmp_path / "latin.tex")
    (tmp_path / "pdf.tex").write_bytes(b"%PDF-1.5\n%\xd0\xd4")
    with pytest.raises(StoreError, match="is a PDF"):
        read_file(tmp_path / "pdf.tex")
    (tmp_path / "a.ipynb").write_text("[]")
    with pytest.raises(ParseError, match=r"a\.ipynb: JSON without cells"):
        read_file(tmp_path / "a.ipynb")


def test_prices_quotations_and_front_matter_of_markdown():
    text = (
        "---\ntitle: a $a = b$\n---\n\nIt costs $5 and $6, the table $20, so $c = d$.\n\n"
        "> $$\n> e = f\n> $$\n\n$2 = g$ and $3 m g = N $ remain."
    )
    assert [(r.line, r.printed) for r in read_source(text, ".md")] == [
        (5, "c = d"),
        (8, "e = f"),
        (11, "2 = g"),
        (11, "3 m g = N"),
    ]


@pytest.mark.parametrize("text", ["{", "[]", "3", '{"cells": 3}', "", "[" * 100_000])
def test_a_damaged_notebook(text):
    with pytest.raises(ParseError, match="Jupyter notebook"):
        read_source(text, ".ipynb")


def test_a_notebook_of_odd_cells():
    text = '{"cells": [3, {}, {"cell_type": "markdown"}, {"cell_type": "markdown", "source": [1]}]}'
    assert read_source(text, ".ipynb") == []
