"""Any text is read, or refused at a place that is shown: no crash, no hang."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from judge.latex.displays import DISPLAYS
from polhode.base import ParseError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tokens import LONGEST
from polhode.judge.latex._tree import Statement, Words, walk

WORDS = r"""
    a d t x 1 2 0.5 + - = < ^ _ ' / | & , . ; : ( ) [ ] { } \{ \} $ $$ \\ \n * ~ \, \quad
    \theta \omega \Delta \partial \pi \infty \hat \mathbf \bf \rm \cal \vec \dot \ddot \frac \sqrt
    \int \sin \cos \tanh \exp \times \cdot \pm \approx \to \Rightarrow \left( \right) \left. \right|
    \left[ \right] \left| \right. \over \prime \circ \perp \max \text{or} \text{(slow)~or} \tag{1}
    \begin{cases} \end{cases} \begin{array}{c} \end{array} \begin{aligned} \end{aligned}
    \frac{d}{dt} \operatorname{sech} \mathrm{cm} \displaystyle \limits \foo
    ^{ _{ \frac{ \sqrt[3]{ \hat{ }_ }^
    {}^N ^B ^T {}^ \sum_{i=1}^{3} \sum \prod_j \sum_ \int_V \iint i=1,2 \cdots \ldots ... O( O
    \begin{pmatrix} \end{pmatrix} \begin{matrix} \end{matrix} \left\{ \right\} \begin{vmatrix}
    \end{vmatrix} \underbrace{ \overbrace \overset{\circ} \overset{def}{=} \stackrel{!} \dv \dv[2]{
    \pdv \abs{ \norm \qty( \qty{ \mqty( \order{ \prescript{N}{} \leftidx{^N} \eval{ \SI{2}{m}
    \num{1e3} \unit{ \mathrm{m} \diag \text{diag}( \phantom{ \cancel{ \otimes \top := =: d' \breve
    \left(\frac{d}{dt}\right)_{rot} \right|_{body} \mathcal \forall \in (t=0) {I_1}_{2} \mathring
    \operatorname{tr} \const \text{const} [ \tilde\omega ]' \! \underset{\sim} \xrightarrow{a}
"""
PIECES = WORDS.split()

soup = st.lists(st.sampled_from(PIECES), max_size=40).map(" ".join)


@st.composite
def damaged_displays(draw: st.DrawFn) -> str:
    """A display of the set with some of it lost, repeated or replaced."""
    latex = draw(st.sampled_from(sorted(DISPLAYS.values())))
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(latex)))
        end = draw(st.integers(start, min(len(latex), start + 12)))
        middle = draw(st.sampled_from(("", latex[start:end] * 2)) | st.sampled_from(PIECES))
        latex = latex[:start] + middle + latex[end:]
    return latex


def read_or_refused(latex: str) -> Statement | None:
    try:
        return read_latex(latex)
    except ParseError:
        return None


@given(st.text() | st.binary().map(lambda raw: raw.decode("latin-1")))
def test_any_text(latex: str) -> None:
    read_or_refused(latex)


@given(soup)
def test_any_words_of_latex(latex: str) -> None:
    read_or_refused(latex)


@given(damaged_displays() | soup)
def test_whatever_is_read_can_be_written(latex: str) -> None:
    statement = read_or_refused(latex)
    if statement and not any(isinstance(piece, Words) for piece in walk(statement)):
        for relation in statement.relations:
            assert read_latex(write_latex(relation)).relations == (relation,)


@given(soup)
def test_every_piece_stands_in_the_source(latex: str) -> None:
    for piece in walk(read_or_refused(latex) or Statement(())):
        start, end = piece.span
        assert 0 <= start <= end <= len(latex)


DEEP = {
    "round brackets": "(" * 5000 + "x" + ")" * 5000,
    "fractions": r"\frac{" * 1500 + "x" + "}{2}" * 1500,
    "roots": r"\sqrt{" * 2000 + "x" + "}" * 2000,
    "exponents": "x^{" * 4000 + "x" + "}" * 4000,
    "labels": "x_{" * 4000 + "x" + "}" * 4000,
    "cases": r"\begin{cases}" * 700 + "x" + r"\end{cases}" * 700,
    "bars": "|" * 5000 + "x" + "|" * 5000,
    "signs": "-" * 9000 + "x",
    "hats": r"\hat " * 3000 + "x",
    "dots": r"\dot " * 3000 + "x",
    "bold": r"\bf " * 3000 + "x",
    "script": r"\cal " * 3000 + "x",
    "functions": r"\sin " * 3000 + "x",
    "roots without braces": r"\sqrt " * 3000 + "x",
    "derivatives": r"\frac{d}{dt}" * 1500 + "x",
    "integrals": r"\int " * 3000 + "x",
    "integrals with limits": r"\int_0^1 " * 2000 + "x",
    "sums": r"\sum_i " * 2500 + "x",
    "prescripts": "{}^N" * 4000 + "x",
    "labels before brackets": "{}^N(" * 3000 + "x" + ")" * 3000,
    "braces under": r"\underbrace{" * 1500 + "x" + "}" * 1500,
    "circles": r"\mathring " * 1900 + "x",
    "matrices": r"\begin{pmatrix}" * 600 + "x" + r"\end{pmatrix}" * 600,
    "magnitudes": r"\abs{" * 2800 + "x" + "}" * 2800,
    "transposes": "(" * 3000 + "x" + ")^T" * 3000,
    "outer products": r"a \otimes " * 1800 + "x",
    "orders": "O(" * 6000 + "x" + ")" * 6000,
    "products of vectors": r"a \times " * 2000 + "x",
    "slashes": "a/" * 9000 + "x",
    "signs behind crosses": r"a \times " + "-" * 9000 + "x",
}


@pytest.mark.parametrize("latex", DEEP.values(), ids=DEEP.keys())
def test_what_goes_too_deep_is_refused(latex: str) -> None:
    assert len(latex) <= LONGEST
    with pytest.raises(ParseError, match=r"deep|in a row"):
        read_latex(latex)


@pytest.mark.parametrize(
    "latex",
    [
        "a + " * 4000 + "a",
        "a" * LONGEST,
        r"a \\ " * 3000,
        "&" * 9000 + "a",
        "$a$ or " * 2000 + "$a$",
        r"\begin{pmatrix} a" + "& a" * 3000 + r"\end{pmatrix}",
        r"\phantom{b}" * 1500 + "a",
        "{}^N a " * 2500,
        "i = 1" + ", 2" * 5000,
        r"\cancel{" * 30 + "a" + "}" * 30 + " b" * 9000,
        r"a = \begin{cases} " + r"b & c > 0 \\ " * 1000 + r"\end{cases}",
        r"\begin{cases} " + r"b = c \\ " * 1500 + r"\end{cases}",
    ],
)
def test_what_is_only_long_is_read(latex: str) -> None:
    assert read_latex(latex).relations


@pytest.mark.parametrize("latex", ["f(x_)'_", "f(a(x_)'_", "f({x_)", r"f(\dot)", "f(t=)", "f(,)"])
def test_arguments_that_are_damaged_are_refused(latex: str) -> None:
    with pytest.raises(ParseError):
        read_latex(latex)


def test_what_is_too_long_is_refused() -> None:
    with pytest.raises(ParseError, match="20001 characters"):
        read_latex("a" * (LONGEST + 1))


@pytest.mark.parametrize(
    ("latex", "problem", "place"),
    [
        ("", "the end", 1),
        ("   ", "the end", 4),
        ("a \0", r"U\+0000", 3),
        ("a\u202eb", r"U\+202E", 2),
        ("a + \N{PILE OF POO}", r"U\+1F4A9", 5),
        (r"a = \foo b", r"macro \\foo", 5),
        (r"a = \sinn b", r"macro \\sinn; \\sin is known", 5),
        (r"\frac{a", "never closed", 6),
        ("a)", "closes nothing", 2),
        ("[a + b) c", "closed by", 7),
        (r"\left( a \end{cases}", "closed by", 10),
        (r"\begin{tabular} a \end{tabular}", "tabular", 1),
        ("a + ", "the end", 5),
        ("a + + = b", "=", 7),
        ("= b", "=", 1),
        ("a = = b", "=", 5),
        ("{}_1^2 I", "_", 3),
        ("x_1_2", "second _", 4),
        ("x^1^2", "second", 4),
        ("2 3", "two numbers", 3),
        ("2_3", "number with an index", 1),
        ("ma^.2 = I", r"\.2 without braces", 4),
        (r"\frac 1.5", r"1\.5 without braces", 7),
        (r"\hat{x + y}", "hat over more", 1),
        (r"\mathcal{3}", "script letter", 1),
        (r"\frac{d}{dt} + a", "derivative with nothing to act on", 1),
        (r"O(\frac{d}{dt})x", "derivative with nothing to act on", 3),
        (r"\partial + a", "∂ that stands alone", 1),
        (r"\int \sin\phi", "integral without a differential", 1),
        (r"\int x \, dx \, dy", "a second differential", 1),
        (r"\begin{pmatrix} a & b \\ c \end{pmatrix}", "rows of 1 and 2 entries", 1),
        (r"\text{a {nested} one}", r"\\text", 1),
        (r"a = \perp", r"\\perp", 5),
        (r"|a", "the end", 3),
        (r"x_\hat{z}", r"\\hat", 3),
        (r"x_{\frac{1}{2}}", "a formula in a label", 4),
        (r"a = b \\ c \times", "the end", 18),
    ],
)
def test_the_place_is_shown(latex: str, problem: str, place: int) -> None:
    with pytest.raises(ParseError, match=problem) as caught:
        read_latex(latex)
    shown = caught.value.advice.splitlines()
    assert shown[0] == f"at character {place}:"
    assert shown[2].index("^") - 4 == min(place - 1, 40)


def test_nothing_is_evaluated(monkeypatch: pytest.MonkeyPatch) -> None:
    def ran(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr("builtins.eval", ran)
    monkeypatch.setattr("os.system", ran)
    for latex in ("__import__('os').system('true')", r"\input{x}", r"\write18{true}", "9^9^9^9"):
        read_or_refused(latex)
    assert read_latex("9^{9^{9^{9}}}")


@pytest.mark.parametrize("latex", ["F = {} M g", "F = M g^{{{}}}", "F = 0.{} M", "{} = 1"])
def test_a_number_of_thousands_of_digits_is_refused(latex):
    with pytest.raises(ParseError, match=r"a number of \d+ characters"):
        read_latex(latex.format("1" * 5000))
