"""Typst: its mathematics read as the same relations in LaTeX are."""

import pytest

from polhode.judge import read_source

PAIRS = [
    ("T = 1/2 m v^2", r"T = \frac{1}{2} m v^2"),
    ("omega_3 = dot(psi) + dot(phi) cos theta", r"\omega_3 = \dot\psi + \dot\phi\cos\theta"),
    ("a = (b + c)/(d e)", r"a = \frac{b + c}{d e}"),
    ("a = (b + c)(d + e)/f", r"a = (b + c)\frac{d + e}{f}"),
    ("a = x_1^2/y_2", r"a = \frac{x_1^2}{y_2}"),
    ("dot.double(theta) = - g/l sin(theta)", r"\ddot\theta = -\frac{g}{l}\sin(\theta)"),
    ("v_(1 2) = root(3, x) + sqrt(y)", r"v_{1 2} = \sqrt[3]{x} + \sqrt{y}"),
    ("cal(L) = T - V", r"\mathcal{L} = T - V"),
    (
        "bold(L) = I bold(omega) times hat(bold(z))",
        r"\mathbf{L} = I\mathbf{\omega}\times\hat{\mathbf{z}}",
    ),
    ('v_"cm" != 0', r"v_{\text{cm}} \ne 0"),
    ("abs(x) <= frac(a, b)", r"|x| \le \frac{a}{b}"),
    ("omega^2 >= 4 g dot a", r"\omega^2 \ge 4 g \cdot a"),
    ("(dif theta)/(dif t) = 0", r"\frac{d\theta}{dt} = 0"),
    ("vec(x, y, z) = bold(r)", r"\begin{pmatrix}x\\ y\\ z\end{pmatrix} = \mathbf{r}"),
    ("plus.minus x = y", r"\pm x = y"),
    ('mat(delim: "[", a, b; c, d) x = y', r"\begin{pmatrix}a & b\\ c & d\end{pmatrix} x = y"),
    ("x = cases(a, b)", r"x = \begin{cases} a \\ b \end{cases}"),
    ("1/m(a + b) = f(x)/y", r"\frac{1}{m(a + b)} = \frac{f(x)}{y}"),
    ("accent(x, dot.double) = accent(y, arrow)", r"\ddot x = \vec y"),
    ('underbrace(m g h, "high") = dv(x, t, 2)', r"\underbrace{m g h}_{\text{high}} = \dv[2]{x}{t}"),
    ("pdv(L, dot(q)) = dv(, t) vb(v)", r"\pdv{L}{\dot q} = \dv{t} \mathbf{v}"),
    ("upright(d) x = va(F) dot vu(z)", r"\mathrm{d} x = \vec F \cdot \hat z"),
]


@pytest.mark.parametrize(("typst", "latex"), PAIRS)
def test_it_reads_as_the_same_latex(typst: str, latex: str) -> None:
    (found,) = read_source(f"$ {typst} $", ".typ")
    (expected,) = read_source(rf"\[ {latex} \]", ".tex")
    assert found.why == expected.why == ""
    assert found.printed == expected.printed


def test_space_inside_the_dollar_signs_makes_a_display() -> None:
    displayed, inline = read_source("$ a = b $ and $c = d$", ".typ")
    assert (displayed.is_display, inline.is_display) == (True, False)


def test_rows_and_alignment_make_two_relations_with_their_places() -> None:
    one, other = read_source("First:\n$ a &= b \\\n  c &= theta $", ".typ")
    assert (one.line, one.column) == (2, 3)
    assert (other.line, other.column) == (3, 3)
    assert other.latex == r"c &= \theta"


def test_names_of_the_text_stand_for_their_formulas() -> None:
    (found,) = read_source("#let om = $omega$\n#let half = $1/2$\n$ T = half I om_3^2 $", ".typ")
    assert found.printed == r"T = \frac{1}{2} I \omega_{3}^{2}"


def test_a_formula_ends_with_its_paragraph() -> None:
    open_, next_ = read_source("$ a = b\n\nText $c = d$ goes on.", ".typ")
    assert "not closed" in open_.why
    assert next_.printed == "c = d"


def test_comments_raw_text_and_prices_are_passed_over() -> None:
    text = "// $a = b$\n/* $c = d$ */ `$e = f$` costs \\$5\n= Part\n$g = h$ see https://x.org"
    (found,) = read_source(text, ".typ")
    assert found.printed == "g = h"
    assert found.headings == ("Part",)


@pytest.mark.parametrize(
    "text", ["$", "$ a = ( $", "$ a = b) $", "$ _ = / $", "$ frac(a = b $", "$$"]
)
def test_damaged_formulas_raise_nothing(text: str) -> None:
    for found in read_source(text, ".typ"):
        assert found.read or found.why


DEEP = {
    "brackets": "({x})",
    "roots": "sqrt({x})",
    "exponents": "x^({x})",
    "fractions": "1/({x})",
    "calls": "frac(1, {x})",
    "open brackets": "({x}",
}


@pytest.mark.parametrize("form", DEEP.values(), ids=DEEP)
@pytest.mark.parametrize("depth", [65, 1000, 5000])
def test_what_is_nested_too_deeply_is_not_read_and_the_rest_is(form: str, depth: int) -> None:
    before, after = form.split("{x}")
    deep = f"{before * depth}y{after * depth}"
    first, second = read_source(f"$ {deep} = 1 $\n\n$ T = 2 $", ".typ")
    assert not first.read
    assert "more than" in first.why
    assert second.printed == "T = 2"


def test_a_deeply_nested_name_stands_for_itself() -> None:
    (found,) = read_source(f"#let a = ${'(' * 1000}x{')' * 1000}$\n\n$ a = 2 $", ".typ")
    assert found.printed == "a = 2"


@pytest.mark.parametrize("depth", range(0, 60, 7))
def test_what_is_nested_less_deeply_is_read_as_latex_is(depth: int) -> None:
    (found,) = read_source(f"$ {'sqrt(' * depth}x{')' * depth} = 1 $", ".typ")
    (expected,) = read_source(_roots(depth), ".tex")
    assert (found.read, found.printed) == (expected.read, expected.printed)


def _roots(depth: int) -> str:
    opening, closing = r"\sqrt{" * depth, "}" * depth
    return rf"\[ {opening}x{closing} = 1 \]"
