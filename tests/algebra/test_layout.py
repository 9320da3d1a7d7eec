"""Printing: the textbook form, in ASCII, Unicode, LaTeX and MathML; and nothing lost by it."""

import re

import mpmath
import pytest
from hypothesis import assume, given, settings

from algebra.backends import (
    NAMES,
    NUMBERS,
    POINT,
    are_close,
    evaluated,
    expression_of,
    trees,
    value,
)
from polhode.algebra import (
    Expr,
    Symbol,
    absolute,
    as_symbol,
    coordinates,
    cos,
    cosh,
    exp,
    functions,
    latex_of_symbol,
    layout,
    mathml,
    pi,
    read_expression,
    sin,
    speeds,
    sqrt,
    symbol,
    symbols,
    tanh,
    time,
)
from polhode.algebra._reading import LONGEST

m, M, a, b, g, k = symbols("m M a b g k", positive=True)
I, I_1, I_2, I_3, Omega, alpha, lambda_ = symbols(
    "I I_1 I_2 I_3 Omega alpha lambda_", positive=True
)
x, y = symbols("x y")
theta, phi, psi, r = coordinates("theta phi psi r")
omega_1, omega_3, v_x = speeds("omega_1 omega_3 v_x")
(X,) = functions("X")
theta_dot, phi_dot, psi_dot = theta.dt(), phi.dt(), psi.dt()
theta_ddot, phi_ddot = theta_dot.dt(), phi_dot.dt()
s, c = sin(theta), cos(theta)

MECHANICS = {
    # equations of motion
    5 * m * a**2 * theta_ddot + 4 * m * g * a * c: "m*a*(5*a*theta_ddot + 4*g*cos(theta))",
    5 * a * theta_ddot + 4 * g * c: "5*a*theta_ddot + 4*g*cos(theta)",
    (I_2 + M * a**2) * (theta_ddot - phi_dot**2 * s * c)
    + I_1 * omega_1 * phi_dot * s
    - M * g * a * s: "(I_2 + M*a**2)*(theta_ddot - phi_dot**2*sin(theta)*cos(theta))"
    " + I_1*omega_1*phi_dot*sin(theta) - M*g*a*sin(theta)",
    phi_ddot * s
    - 2 * omega_3 * theta_dot
    + 2 * theta_dot * phi_dot * c: "phi_ddot*sin(theta) - 2*omega_3*theta_dot"
    " + 2*theta_dot*phi_dot*cos(theta)",
    phi_dot**2 * s * c
    - 6 * omega_3 * phi_dot * s
    - 4 * g / a * c: "phi_dot**2*sin(theta)*cos(theta) - 6*omega_3*phi_dot*sin(theta)"
    " - 4*g*cos(theta)/a",
    (I + m * a**2) * v_x.dt() + I * Omega * v_x: "(I + m*a**2)*v_x_dot + I*Omega*v_x",
    # energies, forces, momenta
    m * g * a * s: "m*g*a*sin(theta)",
    I_1 / 2 * (theta_dot**2 + phi_dot**2 * s**2)
    + I_3 / 2 * (psi_dot + phi_dot * c) ** 2: "(I_1*(theta_dot**2 + phi_dot**2*sin(theta)**2)"
    " + I_3*(psi_dot + phi_dot*cos(theta))**2)/2",
    (I_1 * s**2 + I_3 * c**2) * phi_dot
    + I_3 * psi_dot * c: "I_3*psi_dot*cos(theta) + I_1*phi_dot*sin(theta)**2"
    " + I_3*phi_dot*cos(theta)**2",
    m * g
    - m * a * theta_ddot * s
    - m * a * theta_dot**2 * c: "m*(g - a*theta_ddot*sin(theta) - a*theta_dot**2*cos(theta))",
    (I_2 - I_3) * omega_1 * omega_3 / I_1: "(I_2 - I_3)*omega_1*omega_3/I_1",
    -theta_dot * phi_dot * s / (I_1 * s**2 + m * a**2): "-theta_dot*phi_dot*sin(theta)"
    "/(m*a**2 + I_1*sin(theta)**2)",
    # steady motions and frequencies
    (omega_3 + sqrt(omega_3**2 + 4 * g * c**2 / (a * s))) / c: "(omega_3 + sqrt(omega_3**2"
    " + 4*g*cos(theta)**2/(a*sin(theta))))/cos(theta)",
    2 * sqrt(g / a): "2*sqrt(g/a)",
    sqrt(g / (3 * a)): "sqrt(g/(3*a))",
    sqrt(2 * Omega * omega_3 * sin(lambda_)): "sqrt(2*Omega*omega_3*sin(lambda_))",
}

SINGLE = {
    # sines or cosines, whichever is shorter
    1 - s**2: "cos(theta)**2",
    1 - 2 * s**2: "1 - 2*sin(theta)**2",
    5 - 4 * s**2: "1 + 4*cos(theta)**2",
    (1 - s**2) * (1 + s): "cos(theta)**2*(1 + sin(theta))",
    I_3 + (I_1 - I_3) * s**2: "I_1*sin(theta)**2 + I_3*cos(theta)**2",
    1 + tanh(x) ** 2: "(1 + 2*sinh(x)**2)/cosh(x)**2",
    # denominators
    1 / c: "1/cos(theta)",
    s / c: "sin(theta)/cos(theta)",
    1 / (a + b * c): "1/(a + b*cos(theta))",
    s * (b + c) / (a + b * c): "sin(theta)*(b + cos(theta))/(a + b*cos(theta))",
    1 / (s + c): "1/(sin(theta) + cos(theta))",
    1 / sqrt(x): "1/sqrt(x)",
    1 / sqrt(a): "1/sqrt(a)",
    x / sqrt(x**2 + y**2): "x/sqrt(x**2 + y**2)",
    2 / (3 * sqrt(a + b * c)): "2/(3*sqrt(a + b*cos(theta)))",
    1 / cosh(x) ** 2: "1/cosh(x)**2",
    # numbers
    Expr.of(0): "0",
    Expr.of(-3) / 4: "-3/4",
    -a / 4: "-a/4",
    (x + y) / 2: "(x + y)/2",
    x / 2 + y / 3: "x/2 + y/3",
    x + 1 / x: "x + 1/x",
    pi * a / 3: "pi*a/3",
    # sums
    b - a: "b - a",
    -a - b: "-a - b",
    -(a + b) * c: "-(a + b)*cos(theta)",
    (a - b) * (b - a): "-(a - b)**2",
    (a + b) ** 3: "(a + b)**3",
    x**2 - y**2: "x**2 - y**2",
    # roots and absolute values
    sqrt(s**2): "abs(sin(theta))",
    absolute(x * cos(phi) + y * sin(phi)): "abs(x*cos(phi) + y*sin(phi))",
    sqrt(x) * sqrt(y): "sqrt(x)*sqrt(y)",
    sqrt(2) / 2: "sqrt(2)/2",
    sqrt(6) * a: "sqrt(6)*a",
    1 / absolute(x): "1/abs(x)",
    # exponentials
    exp(-a * time) * sin(b * time): "exp(-a*t)*sin(b*t)",
    exp(2 * x) * exp(y) / 2: "exp(2*x + y)/2",
    x * exp(1): "x*exp(1)",
    sin(theta / 2) ** 2: "sin(theta/2)**2",
}


@pytest.mark.parametrize(("expression", "printed"), [*MECHANICS.items(), *SINGLE.items()])
def test_text_is_the_textbook_form(expression, printed):
    assert str(expression) == repr(expression) == printed


@pytest.mark.parametrize("expression", [*MECHANICS, *SINGLE])
def test_text_is_read_back(expression):
    known = {as_symbol(e).published: e for e in map(Expr.generator, expression.symbols())}
    assert read_expression(str(expression), known) == expression


@pytest.mark.parametrize(
    ("expression", "printed"),
    [
        (5 * a * theta_ddot + 4 * g * c, r"5 a \ddot{\theta} + 4 g \cos\theta"),
        (I_2 * phi_dot**2 * s**2, r"I_2 \dot{\phi}^2 \sin^2\theta"),
        (omega_3.dt() - Omega / 2, r"\dot{\omega}_3 - \frac{\Omega}{2}"),
        (-(a + b) * c, r"-\left(a + b\right) \cos\theta"),
        ((a + b) ** 2 / (M * a), r"\frac{\left(a + b\right)^2}{M a}"),
        (sqrt(g / a), r"\sqrt{\frac{g}{a}}"),
        (absolute(s) ** 3, r"\sin^2\theta \left|\sin\theta\right|"),
        (cosh(x) ** 2, r"\cosh^2 x"),
        (sin(theta / 2), r"\sin\left(\frac{\theta}{2}\right)"),
        (exp(-k * time), r"\exp\left(-k t\right)"),
        (symbol("Fprime_rho") ** 2, r"{F'_{\rho}}^2"),
        (lambda_ * pi, r"\pi \lambda"),
        (a**10 * x, r"a^{10} x"),
    ],
)
def test_latex_is_the_textbook_form(expression, printed):
    assert expression.latex() == printed
    assert expression._repr_latex_() == f"$\\displaystyle {printed}$"


@pytest.mark.parametrize(
    ("expression", "printed"),
    [
        (5 * a * theta_ddot - 4 * g * c**2, "5 a θ̈ − 4 g cos²θ"),
        (omega_3.dt() + Omega / 2, "ω̇₃ + Ω/2"),
        (sqrt(g / a), "√(g/a)"),
        (sqrt(x) - absolute(y), "√x − |y|"),
        (absolute(s) / cosh(x), "|sinθ|/cosh x"),
        (symbol("Fprime_rho") * symbol("mu_static") * symbol("alpha_1_2"), "F′ᵨ α₁₂ μ_static"),
        (Expr.of(-1) / 2, "−1/2"),
        (theta_ddot.dt() + theta_ddot.dt().dt(), "θ⁽⁴⁾ + θ⃛"),
        (sin(theta / 2) ** 2, "sin²(θ/2)"),
        ((a + b) ** 12, "(a + b)¹²"),
    ],
)
def test_pretty_is_one_line_of_unicode(expression, printed):
    assert expression.pretty() == printed


@pytest.mark.parametrize(
    ("name", "printed"),
    [
        ("theta", r"\theta"),
        ("omega_3", r"\omega_3"),
        ("omega_rho", r"\omega_{\rho}"),
        ("Omega", r"\Omega"),
        ("lambda_", r"\lambda"),
        ("lambda_1", r"\lambda_1"),
        ("F_z", "F_z"),
        ("Fprime_rho", r"F'_{\rho}"),
        ("Fprimeprime", "F''"),
        ("v_cm", r"v_{\mathrm{cm}}"),
        ("v_cm_x", r"v_{\mathrm{cm},x}"),
        ("x_12", "x_{12}"),
        ("mu_static", r"\mu_{\mathrm{static}}"),
        ("Ixx", r"I_{\mathrm{xx}}"),
        ("x1", "x_1"),
        ("theta12", r"\theta_{12}"),
        ("Ab", r"\mathrm{Ab}"),
        ("prime", r"\mathrm{prime}"),
    ],
)
def test_latex_of_names(name, printed):
    assert latex_of_symbol(as_symbol(symbol(name))) == printed


@pytest.mark.parametrize(
    ("quantity", "order", "printed"),
    [
        (omega_3, 1, r"\dot{\omega}_3"),
        (theta, 3, r"\dddot{\theta}"),
        (theta, 4, r"\theta^{(4)}"),
        (X, 2, r"\ddot{X}"),
        (speeds("Fprime_rho")[0], 1, r"\dot{F}'_{\rho}"),
        (time, 0, "t"),
    ],
)
def test_latex_of_derivatives(quantity, order, printed):
    for _ in range(order):
        quantity = quantity.dt()
    assert latex_of_symbol(as_symbol(quantity)) == printed


# --- nothing is lost ---


class _AsNumbers:
    """A style that works the tree out instead of writing it."""

    def number(self, value):
        return mpmath.mpf(value)

    def name(self, symbol: Symbol):
        return POINT[symbol.published]

    def call(self, function, argument):
        return NUMBERS.function(function)(argument.drawn(self))

    def power(self, base, exponent):
        return base.drawn(self) ** exponent

    def product(self, factors):
        return mpmath.fprod(f.drawn(self) for f in factors)

    def sum(self, terms):
        return mpmath.fsum(t.drawn(self) for t in terms)

    def fraction(self, above, below):
        return above.drawn(self) / below.drawn(self)

    def radical(self, radicand):
        return mpmath.sqrt(radicand.drawn(self))


@given(trees)
def test_the_tree_has_the_value_of_the_expression(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    assert are_close(layout(expression).drawn(_AsNumbers()), evaluated(tree, NUMBERS))


@settings(max_examples=60)
@given(trees)
def test_text_of_anything_is_read_back(tree):
    expression = expression_of(tree)
    assume(expression is not None and len(str(expression)) <= LONGEST)
    again = read_expression(str(expression), NAMES)
    assert are_close(value(again), value(expression))
    assert (again - expression) * (again + expression) == 0


@given(trees)
def test_latex_is_well_formed(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    printed = expression.latex()
    assert printed.count("{") == printed.count("}")
    assert printed.count(r"\left") == printed.count(r"\right")
    assert not re.search(r"\+ -|- -|\^\d+\^|\d \d", printed)
    assert printed.isascii()
    assert "^{" not in expression.pretty()


def test_mathml_holds_the_symbols():
    document = mathml((5 * a * theta_ddot).latex())
    assert document.startswith("<math")
    assert (m * g * s).mathml() == mathml((m * g * s).latex())
    assert "sin" in (m * g * s).mathml()


@given(trees)
def test_the_form_does_not_depend_on_how_it_was_made(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    detour = (expression + M * sin(phi)) - M * sin(phi)
    assert str(detour) == str(expression)
