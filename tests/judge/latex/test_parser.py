"""Each way in which mechanics texts write a quantity."""

import pytest

from polhode.judge.latex import read_latex
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
    Evaluated,
    Integral,
    Magnitude,
    Name,
    Negative,
    Node,
    Number,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Root,
    Sum,
)

a, b, c, d, g, k, m, n, r, t, v, x, y, z, F, I, L, T, V = map(Name, "abcdgkmnrtvxyzFILTV")
theta, phi, psi, omega, Omega, rho, pi = map(
    Name, ["theta", "phi", "psi", "omega", "Omega", "rho", "pi"]
)
ZERO, ONE, TWO, THREE = map(Number, "0123")


def vector(letter: str, subscript: str = "") -> Name:
    return Name(letter, subscript, decoration="vector")


def hat(letter: str) -> Name:
    return Name(letter, decoration="hat")


def dot(node: Node) -> Dots:
    return Dots(node, 1)


def read(latex: str) -> Node:
    """The one quantity that a text holds."""
    (relation,) = read_latex(latex).relations
    (side,) = relation.sides
    return side


LETTERS = {
    "a": a,
    r"\theta": theta,
    "θ": theta,
    r"\varphi": Name("varphi"),
    r"\omega_1": Name("omega", "1"),
    r"v_{\rm cm}": Name("v", "cm"),
    r"v_{\text{cm}}": Name("v", "cm"),
    r"v_{cm}": Name("v", "cm"),
    r"v_\mathrm{cm}": Name("v", "cm"),
    r"I_{2p}": Name("I", "2p"),
    r"\omega_{2,\max}": Name("omega", "2,max"),
    r"\omega_{2,\text{max}}": Name("omega", "2,max"),
    r"\omega_{(1,2,3)}": Name("omega", "(1,2,3)"),
    r"\omega_{(1,2,3)_3}": Name("omega", "(1,2,3)_3"),
    r"\omega_\perp": Name("omega", "perp"),
    r"\omega_{\rho \phi z}": Name("omega", "rho phi z"),
    r"F_\rho": Name("F", "rho"),
    r"F'_\rho": Name("F", "rho", 1),
    r"F_\rho'": Name("F", "rho", 1),
    r"F_{\rho}^{\prime}": Name("F", "rho", 1),
    r"{F'}_\rho": Name("F", "rho", 1),
    r"x''": Name("x", primes=2),
    r"\mathcal{L}": Name("cal L"),
    r"{\cal L}": Name("cal L"),
    r"\mathbf{F}": vector("F"),
    r"{ \bf F }": vector("F"),
    r"\bf{F}": vector("F"),
    r"\vec F": vector("F"),
    r"\bm{F}": vector("F"),
    r"\boldsymbol\omega": vector("omega"),
    r"\mathbf{\Omega}": vector("Omega"),
    r"\mathbf{v}_{\rm cm}": vector("v", "cm"),
    r"\mathbf{v_0}": vector("v", "0"),
    r"\overrightarrow{AB}": vector("AB"),
    r"\hat{\mathbf 1}": hat("1"),
    r"\hat{1}": hat("1"),
    r"\hat 1": hat("1"),
    r"\hat{\bf z}": hat("z"),
    r"\mathbf{\hat z}": hat("z"),
    r"\hat{\boldsymbol\rho}": hat("rho"),
    r"\bar x": Name("x", decoration="bar"),
    r"\bar{\mathbf x}": Name("x", decoration="bar vector"),
    r"\tilde x": Name("x", decoration="tilde"),
    r"x^*": Name("x", superscript="*"),
    r"\bar r^{c_l/d_o}": Name("r", decoration="bar", superscript="c_l/d_o"),
    r"\bar v^{c_o}": Name("v", decoration="bar", superscript="c_o"),
    r"f^{(lin)}": Name("f", superscript="(lin)"),
    r"x^{\rm cm}": Name("x", superscript="cm"),
    r"\mathrm{KE}": Name("KE"),
    r"\text{KE}_1": Name("KE", "1"),
    r"\omega_p(\text{slow})": Name("omega", "p,slow"),
}

DERIVATIVES = {
    r"\dot\theta": dot(theta),
    r"\ddot{\theta}": Dots(theta, 2),
    r"\dot\omega_3": dot(Name("omega", "3")),
    r"\dot{\mathbf v}_{\rm cm}": dot(vector("v", "cm")),
    r"\mathbf{\dot r}": dot(vector("r")),
    r"\dot\theta^2": Power(dot(theta), TWO),
    r"\frac{d\mathbf{L}}{dt}": Derivative(vector("L"), t),
    r"\frac{{\rm d} \mathbf{L}}{{\rm d} t}": Derivative(vector("L"), t),
    r"d\mathbf L/dt": Derivative(vector("L"), t),
    r"m d\mathbf v/dt": Product((m, Derivative(vector("v"), t))),
    r"\frac{m\,d\mathbf v}{dt}": Product((m, Derivative(vector("v"), t))),
    r"\frac{d^2\theta}{dt^2}": Derivative(theta, t, 2),
    r"d^2\theta/dt^2": Derivative(theta, t, 2),
    r"\frac{d\omega_1^2}{dt}": Derivative(Power(Name("omega", "1"), TWO), t),
    r"\frac{d(a\hat{1})}{dt}": Derivative(Product((a, hat("1"))), t),
    r"\frac{d\mathbf{v}(t)}{dt}": Derivative(At(vector("v"), t), t),
    r"\frac{d}{dt}(a + b)": Derivative(Sum((a, b)), t),
    r"\frac{d}{dt}\left(a + b\right) c": Product((Derivative(Sum((a, b)), t), c)),
    r"\frac{d}{dt} a b": Derivative(Product((a, b)), t),
    r"\frac{d}{dt}\frac{\partial T}{\partial \dot\theta}": Derivative(
        Derivative(T, dot(theta), partial=True), t
    ),
    r"\frac{\partial^2 V}{\partial x \partial y}": Derivative(
        Derivative(V, y, partial=True), x, partial=True
    ),
    r"\frac{\partial^2 V}{\partial x^2}": Derivative(V, x, 2, partial=True),
    r"\left(\frac{d\mathbf L}{dt}\right)_{\rm rot}": Derivative(vector("L"), t, frame="rot"),
    r"\left.\frac{dL}{dt}\right|_{P}": Evaluated(Derivative(L, t), "P"),
    r"\frac{dL}{dt}|_{t=0}": Evaluated(Derivative(L, t), "t=0"),
    r"\Delta \mathbf{L}_h": Differential(vector("L", "h"), "Δ"),
    r"m \, d\phi": Product((m, Differential(phi))),
    r"\frac{m d\phi}{\pi}": Quotient(Product((m, Differential(phi))), pi),
    r"m g d \sin\theta": Product((m, g, d, Call("sin", theta))),
}

FUNCTIONS = {
    r"\sin\theta\cos\phi": Product((Call("sin", theta), Call("cos", phi))),
    r"\sin 2\theta": Call("sin", Product((TWO, theta))),
    r"\sin n\theta": Call("sin", Product((n, theta))),
    r"\sin 2(\theta - \phi)": Call("sin", Product((TWO, Sum((theta, Negative(phi)))))),
    r"\sin{2\theta}\cos\phi": Product((Call("sin", Product((TWO, theta))), Call("cos", phi))),
    r"\cos^2\theta": Power(Call("cos", theta), TWO),
    r"\cos(\theta)^2": Power(Call("cos", theta), TWO),
    r"\sin\theta^2": Call("sin", Power(theta, TWO)),
    r"\sin(\theta)": Call("sin", theta),
    r"\cos\Omega t": Call("cos", Product((Omega, t))),
    r"v \sin\theta t": Product((v, Call("sin", theta), t)),
    r"\sin\theta \dot\phi": Product((Call("sin", theta), dot(phi))),
    r"\sin\theta (a + b)": Product((Call("sin", theta), Sum((a, b)))),
    r"\sin\theta\,\hat{\mathbf 2}": Product((Call("sin", theta), hat("2"))),
    r"\sin\frac{\theta}{2}": Call("sin", Quotient(theta, TWO)),
    r"\tanh^{-1} x": Call("artanh", x),
    r"\operatorname{sech}[k x]": Call("sech", Product((k, x))),
    r"\text{sech}^2 x": Power(Call("sech", x), TWO),
    r"\ln\tan\theta": Call("ln", Call("tan", theta)),
    r"\exp(-t)": Call("exp", Negative(t)),
    r"\sin -\theta": Call("sin", Negative(theta)),
}

COMBINATIONS = {
    "a + b - c": Sum((a, b, Negative(c))),
    r"a \pm b": Sum((a, PlusMinus(b, "±"))),
    r"\mp a": PlusMinus(a, "∓"),
    "-a b": Negative(Product((a, b))),
    r"\mathbf a \times \mathbf b": Cross(vector("a"), vector("b")),
    r"a \hat 1 \times m \mathbf v": Cross(Product((a, hat("1"))), Product((m, vector("v")))),
    r"a \times b \cdot c": Dot(Cross(a, b), c),
    r"a \cdot b \times c": Dot(a, Cross(b, c)),
    r"-\mathbf a \times -\mathbf b": Negative(Cross(vector("a"), Negative(vector("b")))),
    r"\mathbf{a \times b}": Cross(vector("a"), vector("b")),
    "2*a": Dot(TWO, a),
    r"\frac{a}{b}": Quotient(a, b),
    r"\frac12 m": Product((Quotient(ONE, TWO), m)),
    r"{a \over b}": Quotient(a, b),
    "g/3a": Quotient(g, Product((THREE, a))),
    r"4g\cos^2\theta/a\sin\theta": Quotient(
        Product((Number("4"), g, Power(Call("cos", theta), TWO))),
        Product((a, Call("sin", theta))),
    ),
    r"m g\hat{\bf z}/2": Quotient(Product((m, g, hat("z"))), TWO),
    r"m g/2 \, \hat{\bf z}": Product((Quotient(Product((m, g)), TWO), hat("z"))),
    r"-\hat{\bf z} \times \mathbf v/r": Negative(Cross(hat("z"), Quotient(vector("v"), r))),
    "a/b/c": Quotient(Quotient(a, b), c),
    "a^2": Power(a, TWO),
    "a²": Power(a, TWO),
    "a^{-1}": Power(a, Negative(ONE)),
    r"x_1^2": Power(Name("x", "1"), TWO),
    r"x^2_1": Power(Name("x", "1"), TWO),
    "(a + b)^2": Power(Sum((a, b)), TWO),
    r"\sqrt{a}": Root(a),
    r"\sqrt[3]{a}": Root(a, THREE),
    r"\sqrt 2": Root(TWO),
    r"|\mathbf v|": Magnitude(vector("v")),
    r"\left|a + b\right|": Magnitude(Sum((a, b))),
    r"2|a||b|": Product((TWO, Magnitude(a), Magnitude(b))),
    r"(\mathbf v)_z": Component(vector("v"), "z"),
    r"m (\mathbf v)_z": Product((m, Component(vector("v"), "z"))),
    r"\theta(0)": At(theta, ZERO),
    r"V(\theta(t))": At(V, At(theta, t)),
    r"\omega(t')": At(omega, Name("t", primes=1)),
    r"v(x(t), \dot x)": At(v, ComponentList((At(x, t), dot(x)))),
    r"\dot\psi(0)": At(dot(psi), ZERO),
    r"\mathbf v(t)": At(vector("v"), t),
    "k(t - t_0)": Product((k, Sum((t, Negative(Name("t", "0")))))),
    r"90^\circ": Product((Number("90"), Name("degree"))),
    "0.35 m": Product((Number("0.35"), m)),
    r"(a, b, \theta)": ComponentList((a, b, theta)),
    r"\begin{pmatrix} a \\ b \end{pmatrix}": ComponentList((a, b)),
    r"\left(\begin{array}{c} a \\ b \end{array}\right)": ComponentList((a, b)),
    r"\int_0^{2\pi} \sin\phi \, d\phi": Integral(Call("sin", phi), phi, ZERO, Product((TWO, pi))),
    r"\int \frac{dx}{a}": Integral(Quotient(ONE, a), x),
}

LAID_OUT = {
    r"\displaystyle a\,\!\;b": "a b",
    r"\left[ a + b \right] c": "(a + b) c",
    r"\{a + b\} c": "(a + b) c",
    r"{ { a } } + { b }": "a + b",
    r"$a$": "a",
    r"$$a$$": "a",
    r"\[ a \]": "a",
    r"\begin{equation} a \label{eq:a} \end{equation}": "a",
    "a\n+ b.": "a + b",
    r"\boxed{a}": "a",
    r"\bigl( a + b \bigr)": "a + b",
    r"\left[ a + \right. \\ \left. + b \right]": "a + b",
    r"a + \\ b": "a + b",
    "a − b": "a - b",
}


@pytest.mark.parametrize(("latex", "tree"), LETTERS.items())
def test_letters(latex: str, tree: Node) -> None:
    assert read(latex) == tree


@pytest.mark.parametrize(("latex", "tree"), DERIVATIVES.items())
def test_derivatives(latex: str, tree: Node) -> None:
    assert read(latex) == tree


@pytest.mark.parametrize(("latex", "tree"), FUNCTIONS.items())
def test_functions(latex: str, tree: Node) -> None:
    assert read(latex) == tree


@pytest.mark.parametrize(("latex", "tree"), COMBINATIONS.items())
def test_combinations(latex: str, tree: Node) -> None:
    assert read(latex) == tree


@pytest.mark.parametrize(("latex", "plain"), LAID_OUT.items())
def test_layout_makes_no_difference(latex: str, plain: str) -> None:
    assert read(latex) == read(plain)
