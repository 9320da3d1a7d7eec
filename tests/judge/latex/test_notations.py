"""Notations of mechanics texts and of packages for LaTeX, each with the tree it stands for."""

import pytest

from polhode.base import ParseError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import (
    At,
    Call,
    Component,
    ComponentList,
    Cross,
    Derivative,
    Differential,
    Dot,
    Dots,
    Integral,
    Magnitude,
    Name,
    Negative,
    Node,
    Number,
    Omitted,
    Order,
    Outer,
    Power,
    PrintedMatrix,
    Product,
    Quotient,
    Relation,
    Resolved,
    Sum,
    Summation,
    Transposed,
    UnitSymbol,
)

a, b, c, d, i, j, m, n, p, q, r, s, t, v, x, y, A, B, H, L, N, R, U, V = map(
    Name, "abcdijmnpqrstvxyABHLNRUV"
)
theta, phi, omega, gamma = map(Name, ("theta", "phi", "omega", "gamma"))
ZERO, ONE, TWO, THREE = map(Number, "0123")


def vector(letter: str, subscript: str = "", superscript: str = "", prescript: str = "") -> Name:
    return Name(letter, subscript, 0, "vector", superscript, prescript)


def column(*entries: Node) -> ComponentList:
    return ComponentList(entries)


def matrix(*rows: tuple[Node, ...]) -> PrintedMatrix:
    return PrintedMatrix(tuple(ComponentList(row) for row in rows))


def read(latex: str) -> Node:
    """The one quantity that a text holds."""
    (relation,) = read_latex(latex).relations
    (side,) = relation.sides
    return side


rate_of_l = Derivative(vector("L"), t)

MATRICES = {
    r"\begin{pmatrix} a & b \\ c & d \end{pmatrix}": matrix((a, b), (c, d)),
    r"\left[\begin{array}{cc} a & b \\ c & d \\ \end{array}\right]": matrix((a, b), (c, d)),
    r"\mqty(a & b \\ c & d)": matrix((a, b), (c, d)),
    r"\begin{bmatrix} a & \\ & d \end{bmatrix}": matrix((a, ZERO), (ZERO, d)),
    r"\begin{pmatrix} 0 \\ 0 \end{pmatrix}": column(ZERO, ZERO),
    r"\operatorname{diag}(a, b)": matrix((a, ZERO), (ZERO, b)),
    r"\begin{pmatrix} a & b \end{pmatrix}": matrix((a, b)),
    r"\begin{pmatrix} a & b \end{pmatrix}^T": column(a, b),
    r"\begin{pmatrix} a \\ b \end{pmatrix}^T": matrix((a, b)),
    r"[a, b]^\top": column(a, b),
    r"\begin{vmatrix} a & b \\ c & d \end{vmatrix}": Magnitude(matrix((a, b), (c, d))),
    r"\mathbf A \begin{pmatrix} x \\ y \end{pmatrix}": Product((vector("A"), column(x, y))),
    r"\begin{pmatrix} a \\ \vdots \\ b \end{pmatrix}": column(a, Omitted(), b),
    r"{}^{\mathcal B}\begin{pmatrix} a \\ b \end{pmatrix}": Resolved(column(a, b), "B"),
    r"\mathbf R^{\mathsf T}": Transposed(vector("R")),
    r"R^T": Transposed(R),
    r"e_1^T": Transposed(Name("e", "1")),
    r"\left\{\begin{array}{c} a \\ b \end{array}\right\}": column(a, b),
    r"\mathbf R^{-T}": Power(Transposed(vector("R")), Negative(ONE)),
    r"\mathbf R^{-1}": Power(vector("R"), Negative(ONE)),
    r"\dot{\mathbf q}^T": Transposed(Dots(vector("q"), 1)),
    r"e^T": Power(Name("e"), Name("T")),
    r"\mathbf a \otimes \mathbf b": Outer(vector("a"), vector("b")),
    r"[\tilde{\boldsymbol\omega}]": Name("omega", decoration="tilde vector"),
    r"\tilde{\hat{\mathbf g}}": Name("g", decoration="tilde hat"),
    r"[\boldsymbol\omega]_\times": Component(vector("omega"), "×"),
    r"[0_{3\times 3}]": Name("0", "3×3"),
    r"\mathbf 0": vector("0"),
    r"\mathbb 1": Name("bb 1"),
}

FRAMES = {
    r"{}^N\boldsymbol\omega^B": vector("omega", "", "B", "N"),
    r"^N\bar\omega^B": Name("omega", "", 0, "bar", "B", "N"),
    r"^{0}\mathbf v": vector("v", prescript="0"),
    r"{^{A}}\mathbf v": vector("v", prescript="A"),
    r"a\,{}^1\mathbf v": Product((a, vector("v", prescript="1"))),
    r"{}^A_B R": Name("R", prescript="A;B"),
    r"{}_B^{A} R": Name("R", prescript="A;B"),
    r"{}^A_\vv{} R": Name("R", prescript="A"),
    r"\prescript{0}{1}{R}": Name("R", prescript="0;1"),
    r"\overline{\overline{I}}_O": vector("I", "O"),
    r"F_{\text{тр}}": Name("F", "тр"),
    r"v_{\text{Stoß}}": Name("v", "Stoß"),
    r"\frac{\partial L}{\partial q^i}": Derivative(L, Name("q", superscript="i"), partial=True),
    r"\dot x^i": Dots(Name("x", superscript="i"), 1),
    "q^2": Power(q, TWO),
    r"\Delta KE": Differential(Name("KE"), "Δ"),
    "m KE_{rot}": Product((m, Name("KE", "rot"))),
    "mass_0 a": Product((Name("mass", "0"), a)),
    "d mass_0 a": Product((Name("d"), Name("mass", "0"), a)),
    r"\prescript{N}{}{\omega}^B": Name("omega", "", 0, "", "B", "N"),
    r"\leftidx{^N}{\omega}{^B}": Name("omega", "", 0, "", "B", "N"),
    r"\leftexp{N}{\omega}": Name("omega", prescript="N"),
    r"a {}^N\dot{\mathbf v}": Product((a, Dots(vector("v", prescript="N"), 1))),
    r"a\,^N\mathbf v": Product((a, vector("v", prescript="N"))),
    r"e\,^x y": Product((Power(Name("e"), x), y)),
    r"x{}^2 y": Product((Power(x, TWO), y)),
    r"\mathbf v^P": vector("v", "", "P"),
    r"\mathbf v^2": Power(vector("v"), TWO),
    r"\omega^{S/O}": Name("omega", superscript="S/O"),
    r"\omega^n": Power(omega, n),
    r"\boldsymbol\omega_{\mathcal B/\mathcal N}": vector("omega", "B/N"),
    r"\boldsymbol\omega_{\cal{B/N}}": vector("omega", "B/N"),
    r"{I_T}_{xx}": Name("I", "T,xx"),
    r"[I_c]'": Name("I", "c", 1),
    r"\left(\frac{d\mathbf L}{dt}\right)_{\rm rot}": Derivative(vector("L"), t, frame="rot"),
    r"\left(\frac{d}{dt}\right)_{s}\mathbf L": Derivative(vector("L"), t, frame="s"),
    r"\left.\frac{d\mathbf L}{dt}\right|_{\text{body}}": Derivative(vector("L"), t, frame="body"),
    r"\left(\frac{d\mathbf L}{dt}\right)_z": Component(rate_of_l, "z"),
    r"\frac{d'\mathbf L}{dt}": Derivative(vector("L"), t, frame="'"),
    r"\frac{{}^N d}{dt}\mathbf L": Derivative(vector("L"), t, frame="N"),
    r"\frac{^Bd^2\,\mathbf L}{dt^2}": Derivative(vector("L"), t, 2, frame="B"),
    r"\overset{\circ}{\mathbf L}_P": Derivative(vector("L", "P"), t, frame="circ"),
    r"\mathring{\mathbf L}": Derivative(vector("L"), t, frame="circ"),
    r"\hat{\mathbf x}'": Name("x", primes=1, decoration="hat"),
}

SUMS = {
    r"\sum_{i=1}^{3} m_i v_i^2": Summation(
        Product((Name("m", "i"), Power(Name("v", "i"), TWO))), i, ONE, THREE
    ),
    r"\sum a_x": Summation(Name("a", "x")),
    r"\Sigma a_x + b": Sum((Summation(Name("a", "x")), b)),
    r"\Sigma_i a_i": Summation(Name("a", "i"), i),
    r"\Sigma^2": Power(Name("Sigma"), TWO),
    r"\omega_{\Sigma x}": Name("omega", "Sigma x"),
    r"\sum_j I_{ij} \omega_j": Summation(Product((Name("I", "ij"), Name("omega", "j"))), j),
    r"\sum\limits_{i}^{n} -a + b": Sum((Summation(Negative(a), i, None, n), b)),
    r"\sum_{i,j} a": Summation(Summation(a, j), i),
    r"\prod_{i} a": Summation(a, i, sign="product"),
    r"\sum_i \mathbf r_i \times \mathbf v_i": Summation(
        Cross(vector("r", "i"), vector("v", "i")), i
    ),
    r"\theta + O(\theta^3)": Sum((theta, Order(Power(theta, THREE)))),
    r"\mathcal{O}\left(\theta^3\right)": Order(Power(theta, THREE)),
    r"\order{\theta^3}": Order(Power(theta, THREE)),
    r"1 + x + \cdots": Sum((ONE, x, Omitted())),
    r"1 + x + ...": Sum((ONE, x, Omitted())),
    r"3!": Number("6"),
    r"\int_V x \, dV": Integral(x, V, V),
    r"\int_{\textrm{body}} x \, dm": Integral(x, m, Name("body")),
    r"\iint_A x \, dA": Integral(x, A, A),
    r"\int_0^a \int_0^b x \, dx \, dy": Integral(Integral(x, x, ZERO, b), y, ZERO, a),
    r"\int \mathbf r \times \mathbf v \, dm": Integral(Cross(vector("r"), vector("v")), m),
}

CALLS = {
    "H(p, q)": At(H, column(p, q)),
    r"\mathbf r(q, \dot q, t)": At(vector("r"), column(q, Dots(q, 1), t)),
    r"U(\theta)": At(U, theta),
    r"\theta(t = 0)": At(theta, ZERO),
    r"\theta(t_0)": At(theta, Name("t", "0")),
    r"\cos\gamma t": Call("cos", Product((gamma, t))),
    r"\cos\theta\dot\phi": Product((Call("cos", theta), Dots(phi, 1))),
    r"\sin[2](\theta)": Power(Call("sin", theta), TWO),
    r"\operatorname{sh} x": Call("sinh", x),
    r"mcos\theta": Product((m, Call("cos", theta))),
    r"\mathrm{c}\theta\, s\theta": Product((Call("cos", theta), Call("sin", theta))),
    r"c\theta\, s": Product((c, theta, s)),
    "Asin(x)": Product((A, Call("sin", x))),
    "v_{tan}": Name("v", "tan"),
    r"v(t^*)": At(v, Name("t", superscript="*")),
    r"\operatorname{arctg} x": Call("arctan", x),
    r"\dv{\theta}{t}": Derivative(theta, t),
    r"\dv{}{t}\pdv{L}{q}": Derivative(Derivative(L, q, partial=True), t),
    r"\dv[2]{\theta}{t}": Derivative(theta, t, 2),
    r"\dv{t}(a + b)": Derivative(Sum((a, b)), t),
    r"\pdv{L}{\dot q}": Derivative(L, Dots(q, 1), partial=True),
    r"\pdv[2]{L}{q}": Derivative(L, q, 2, partial=True),
    r"\pdv{L}{q}{t}": Derivative(Derivative(L, t, partial=True), q, partial=True),
    r"m \dd{\phi}": Product((m, Differential(phi))),
    r"\vb{F}": vector("F"),
    r"\va*{F}": vector("F"),
    r"\vu{x}": Name("x", decoration="hat"),
    r"\abs{\vb v}": Magnitude(vector("v")),
    r"\norm{\vb v}": Magnitude(vector("v")),
    r"\lVert\vb v\rVert": Magnitude(vector("v")),
    r"\vb a \cross \vb b": Cross(vector("a"), vector("b")),
    r"\vb a \vdot \vb b": Dot(vector("a"), vector("b")),
    r"\qty(a + b) c": Product((Sum((a, b)), c)),
    r"\qty{a + b} c": Product((Sum((a, b)), c)),
    r"\varOmega": Name("Omega"),
    r"\ddddot x": Dots(x, 4),
}

UNITS = {
    r"\SI{9.81}{m/s^2}": Product((Number("9.81"), UnitSymbol("m/s^2"))),
    r"\qty{9.81}{\metre\per\second\squared}": Product((Number("9.81"), UnitSymbol("m/s^2"))),
    r"\SI{-1.5e3}{\kilo\gram}": Negative(Product((Number("1500"), UnitSymbol("kg")))),
    r"9.81\,\mathrm{m/s^2}": Product((Number("9.81"), UnitSymbol("m/s^2"))),
    r"2\;\text{m s}^{-1}": Product((TWO, UnitSymbol("m s^-1"))),
    r"5\,{\rm m/s}": Product((Number("5"), UnitSymbol("m/s"))),
    r"\num{1e3}": Number("1000"),
    r"\num{0,5}": Number("0.5"),
    r"2\frac{\text{m}}{\text{s}^2}": Product((TWO, Quotient(UnitSymbol("m"), UnitSymbol("s^2")))),
    r"2\pi\,\text{rad}": Product((TWO, Name("pi"), UnitSymbol("rad"))),
    r"2\ensuremath{\,\mathrm{m/s}}": Product((TWO, UnitSymbol("m/s"))),
    "10°": Product((Number("10"), Name("degree"))),
    r"0{,}5": Number("0.5"),
    r"0{,}125": Number("0.125"),
    r"2\,\text{N}\cdot\text{m}": Product((TWO, UnitSymbol("N"), UnitSymbol("m"))),
    r"v_{\text{th}}": Name("v", "th"),
    r"\ang{80}": Product((Number("80"), Name("degree"))),
    r"\omega_{2\text{min}}": Name("omega", "2min"),
    r"2 \mathrm{T}": Product((TWO, Name("T"))),
    r"\tfrac12\mathrm{m} v": Product((Quotient(ONE, TWO), m, v)),
    r"2\mathrm{m} v": Product((TWO, m, v)),
    r"2\,\mathrm{m}": Product((TWO, UnitSymbol("m"))),
}

PASSED_THROUGH = {
    r"\boxed{\cancel{a} + \underbrace{b}_{\text{small}}}": "a + b",
    r"a \phantom{\frac{b}{c}} + b": "a + b",
    r"a \mkern-3mu b \hspace{2pt} c": "a b c",
    r"a \hspace{\theta^3om} b": "a b",  # a unit that is none
    r"m_{\text{\text{sc}}}": r"m_{\text{sc}}",
}

NOTATIONS = MATRICES | FRAMES | SUMS | CALLS | UNITS


@pytest.mark.parametrize(("latex", "tree"), NOTATIONS.items())
def test_a_notation_stands_for_its_tree(latex: str, tree: Node) -> None:
    assert read(latex) == tree


@pytest.mark.parametrize("latex", NOTATIONS)
def test_a_notation_comes_back(latex: str) -> None:
    assert read(write_latex(read(latex))) == read(latex)


@pytest.mark.parametrize(("latex", "plain"), PASSED_THROUGH.items())
def test_what_only_sets_off_makes_no_difference(latex: str, plain: str) -> None:
    assert read(latex) == read(plain)


@pytest.mark.parametrize(
    ("latex", "sign"),
    [
        ("a := b", "≡"),
        ("a =: b", "≡"),
        (r"a \triangleq b", "≡"),
        (r"a \coloneqq b", "≡"),
        (r"a \overset{\text{def}}{=} b", "≡"),
        (r"a \stackrel{\triangle}{=} b", "≡"),
        (r"a \stackrel{!}{=} b", "="),
        (r"a \overset{(3)}{=} b", "="),
        (r"a \xrightarrow{x} b", "→"),
        ("a <= b", "≤"),
        (r"a \in b", "∈"),
    ],
)
def test_signs_with_something_above(latex: str, sign: str) -> None:
    assert read_latex(latex).relations == (Relation((a, b), (sign,)),)


@pytest.mark.parametrize(
    "latex",
    [
        r"\begin{cases} a = b \\ c = d \end{cases}",
        r"\left.\begin{aligned} a &= b \\ c &= d \end{aligned}\right\}",
        r"\left\{\begin{array}{rcl} a & = & b \\ c & = & d \end{array}\right.",
        r"\left\{ a = b \\ c = d \right.",
        r"a = b \implies \begin{cases} c = d \end{cases}",
    ],
)
def test_a_system_of_equations(latex: str) -> None:
    assert read_latex(latex).relations == (Relation((a, b), ("=",)), Relation((c, d), ("=",)))


def test_a_relation_under_a_brace_is_one() -> None:
    statement = read_latex(r"a = \underbrace{b + c}_{= d} + \overbrace{x}^{\text{small}}")
    whole, part = statement.relations
    assert whole == Relation((a, Sum((Sum((b, c)), x))), ("=",))
    assert part == Relation((Sum((b, c)), d), ("=",))
    assert statement.notes == ("small",)


def test_an_inequality_of_several_letters_holds_for_each() -> None:
    relations = read_latex(r"a, b > c, \quad d = 1").relations
    assert relations[:2] == (Relation((a, c), (">",)), Relation((b, c), (">",)))


@pytest.mark.parametrize(
    "space", [r"\hspace{1cm}", r"\hspace*{2em}", r"\hspace{2pc}", r"\hskip 2em", r"\hfill"]
)
def test_wide_space_separates_relations(space: str) -> None:
    relations = read_latex(rf"a = b {space} c = d").relations
    assert relations == (Relation((a, b), ("=",)), Relation((c, d), ("=",)))


@pytest.mark.parametrize("number", [r"\eqno(1)", r"\leqno{\rm(iii)}", r"\eqno{\hbox{(A)}}"])
def test_what_stands_behind_eqno_is_the_number(number: str) -> None:
    statement = read_latex(rf"$$a = b {number}$$")
    assert statement.relations == (Relation((a, b), ("=",)),)
    assert statement.tags in (("1",), ("iii",), ("A",))


def test_the_values_of_an_index() -> None:
    relations = read_latex(r"a = b, \quad i = 1, 2, \quad j = 1, \ldots, n, \quad x = 1").relations
    assert [relation.sides[1] for relation in relations] == [
        b,
        column(ONE, TWO),
        column(ONE, Omitted(), n),
        ONE,
    ]


def test_a_constant_is_stated_of_the_other_side() -> None:
    for word in ("const", "konst.", "cste"):
        (relation,) = read_latex(rf"\text{{{word}}} = a = b").relations
        assert relation == Relation((a, b, Name("constant")), ("=", "="))


def test_a_relation_in_brackets_that_begins_with_its_sign_goes_on() -> None:
    first, second = read_latex(r"a = b\ (= 0), \quad c = d").relations
    assert first == Relation((a, b, ZERO), ("=", "="))
    assert second == Relation((c, d), ("=",))


def test_a_letter_behind_words_belongs_to_them() -> None:
    statement = read_latex(r"a = b \text{ for small } x: c = d")
    assert statement.relations[0] == Relation((a, b), ("=",))
    assert statement.relations[-1] == Relation((c, d), ("=",))


def test_a_constant_that_is_multiplied_is_no_word_beside() -> None:
    (relation,) = read_latex(r"\text{const} \cdot a = b").relations
    assert relation == Relation((Dot(Name("constant"), a), b), ("=",))


def test_for_all_is_a_note() -> None:
    statement = read_latex(r"a = b \quad \forall t")
    assert statement.relations == (Relation((a, b), ("=",)),)
    assert statement.notes == (r"\forall t",)


@pytest.mark.parametrize(
    ("latex", "problem"),
    [
        (r"\sum", "a quantity"),
        (r"a = [\mathbf b\mathbf c]", "two vectors in square brackets"),
        (r"\frac{D\mathbf v}{Dt}", "a derivative D/Dt"),
        (r"\dot x^i = x^j", "an index above a letter"),
        ("mass g = a", "mass, which LaTeX prints letter by letter"),
        ("a^mass_0 = b", "mass without braces"),
        (r"a = bsinc", "bsinc, which LaTeX prints"),
        (r"x = asin\theta", "asin, which LaTeX prints"),
        ("a = 3 rad", "rad, which LaTeX prints"),
        ("a = 4.9 m/s^2", "m/s, which LaTeX prints"),
        (r"a = \mathrm{ad}^*_x b", "a quantity"),
        (r"\sum_{i \ne j} a", r"\\ne"),
        (r"\operatorname{tr} a", "the function tr"),
        (r"a \, \mathrm{sgn}(b)", "the function sgn"),
        (r"\int \mathbf F \cdot d\mathbf r", "an integral along a path"),
        (r"\overset{a}{b}", "a mark above a quantity"),
        (r"\prescript{}{}{a}", "a label in front without letters"),
        (r"\SI{a}{m}", r"\\SI"),
        (r"\SI{2}{furlong}", "the unit furlong"),
        (r"\det a", "the function det"),
        (r"a = \max(b, c)", "the function max"),
        (r"\text{max}(b, c)", "the function max"),
        (r"\mathrm{skew}(\omega)", "the function skew"),
        (r"a = b \text{sgn} (v)", "the function sgn"),
        (r"\operatorname*{arg\,min}_x a", r"\\operatorname"),
        (r"\mathbf{Rot}(z, \theta)", "a word in bold"),
        (r"1{,}500", "a comma in a number"),
        ("f = 0,3", "a comma between two numbers"),
        (r"\omega_1 : \omega_2 = a : b", "a quantity in no relation"),
        (r"a = v(A \in S) + b", "a quantity in no relation"),
        (r"a = \frac{b}{c} \\ (d + x)", "a quantity in no relation"),
        (r"\dv[n]{f}{x}", "the order of a derivative"),
        (r"\qty{3.0(1)}{\newton}", r"\\qty"),
        (r"\theta = 0, \pi", "several quantities with commas"),
        (r"x_1, x_2 = \pm a", "several quantities with commas"),
        (r"\text{rate of change of } L = \tau", "words that go on with a quantity"),
        (r"v \text{ (velocity of } C \text{)} = R\omega", "words that go on with a quantity"),
        (r"T = 1/2 m v^2", "a slash that may"),
        (r"\dot\omega_1 = (I_2 - I_3)/I_1 \omega_2\omega_3", "a slash that may"),
        (r"\ddot\theta = -g/l\sin\theta", "a slash that may"),
        (r"q = \cos\theta/2", "a slash that may"),
        (r"\prescript{A;B}{}{v} = 1", "a label in front"),
        (r"x = \cos 2\pi t/T", "a slash that may"),
        (r"\cos m\phi", "part of the angle"),
        (r"\left. x^2 \right|_a^b", "limits behind a bar"),
        (r"12!", "a factorial"),
        (r"\abs a", "a macro without the bracket"),
        (r"\underline{a = b}", "the end of the bracket|="),
        (r"\operatorname{diag}(a)", "a diagonal of one entry"),
    ],
)
def test_what_has_no_tree_is_refused_with_its_cause(latex: str, problem: str) -> None:
    with pytest.raises(ParseError, match=problem):
        read_latex(latex)
