"""`polhode derive`: exact equations for scripts and for people."""

import pytest
import sympy

from cli.shapes import DERIVE, EXPRESSION, misshapen
from polhode.catalogue import CATALOGUE

SREPR = {name: getattr(sympy, name) for name in ("Symbol", "Integer", "Rational", "Add", "Mul")}
SREPR |= {name: getattr(sympy, name) for name in ("Pow", "sin", "cos", "Abs", "pi")}


def read(text):
    """An expression of `sympy.srepr`, with nothing but its own vocabulary in reach."""
    return eval(text, {"__builtins__": {}}, SREPR)


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_document_of_every_system(document, name):
    found = document("derive", name)
    assert [*misshapen(found, DERIVE)] == []
    assert found["system"] == name
    assert len(found["motion"]) == len(found["speeds"])
    for expression in (*found["motion"], *found["reactions"].values()):
        assert sympy.srepr(read(expression["sympy"])) == expression["sympy"]


def test_equations_of_the_rolling_disk(document):
    """Against the problem set: (25) to (27) for I_1 = I_2 = m a²/4, I_3 = m a²/2."""
    found = document("derive", "rolling-disk")
    a, g, theta, phi_dot, theta_dot, omega_3 = sympy.symbols("a g theta phi_dot theta_dot omega_3")
    phi_ddot, theta_ddot, omega_3_dot = sympy.symbols("phi_ddot theta_ddot omega_3_dot")
    sine, cosine = sympy.sin(theta), sympy.cos(theta)
    expected = [
        phi_ddot * sine + 2 * theta_dot * phi_dot * cosine - 2 * omega_3 * theta_dot,
        5 * a * theta_ddot
        - a * phi_dot**2 * sine * cosine
        + 6 * a * omega_3 * phi_dot * sine
        + 4 * g * cosine,
        3 * omega_3_dot - 2 * phi_dot * theta_dot * sine,
    ]
    rows = [read(row["sympy"]) for row in found["motion"]]
    assert [sympy.expand(r - e) for r, e in zip(rows, expected, strict=True)] == [0, 0, 0]


def test_undetermined_reactions_are_given_with_the_least_forces(document):
    found = document("derive", "gyroscope/held")
    assert set(found["undetermined"]) == {"F_rho", "F_z", "Fprime_rho", "Fprime_z"}
    assert [*misshapen(found["least"], {str: EXPRESSION})] == []
    half_the_weight = sympy.symbols("M") * sympy.symbols("g") / 2
    assert read(found["least"]["F_z"]["sympy"]) == half_the_weight


def test_the_text_output_is_complete(polhode):
    code, out, err = polhode("derive", "rolling-disk")
    assert (code, err) == (0, "")
    for line in (
        "Rolling disk (rolling-disk)",
        "  coordinates   phi theta psi x y",
        "  5 a θ̈ − a φ̇² sinθ cosθ + 6 a ω₃ φ̇ sinθ + 4 g cosθ = 0",
        "  ψ̇ = ω₃ − φ̇ cosθ",
        "  F_z = m (a θ̈ cosθ − a θ̇² sinθ + g)",
        "  E = m a² (6 ω₃² + 5 θ̇² + φ̇² sin²θ)/8 + m g a sinθ",
        "  sinθ > 0",
    ):
        assert f"\n{line}\n" in f"\n{out}"


def test_the_text_output_has_the_least_forces(polhode):
    _, out, _ = polhode("derive", "gyroscope/held")
    assert "Not determined: F_rho, F_z, Fprime_rho, Fprime_z" in out
    assert "  Fprime_z = M g/2\n" in out
