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


PAIR = """
import polhode as ph

lab = ph.Frame("lab")
m, M, k, l = ph.symbols("m M k l", positive=True)
one = ph.point_mass("one", mass=M, axes=lab, tag="1")
two = ph.point_mass("two", mass=m, axes=lab, tag="2")
spring = ph.Spring(one.point(), two.point(), stiffness=k, length=l)
pair = ph.System(one, two, spring, name="pair")
"""


def test_lengths_are_letters_that_are_defined(document, polhode, tmp_path):
    file = tmp_path / "own.py"
    file.write_text(PAIR)
    found = document("derive", f"{file}:pair")
    assert [*misshapen(found, DERIVE)] == []
    x_1, x_2, y_1, y_2, z_1, z_2 = sympy.symbols("x_1 x_2 y_1 y_2 z_1 z_2")
    rho = sympy.sqrt((x_1 - x_2) ** 2 + (y_1 - y_2) ** 2 + (z_1 - z_2) ** 2)
    assert sympy.simplify(read(found["lengths"]["rho"]["sympy"]) - rho) == 0
    M, k, l, a = sympy.symbols("M k l v_x_1_dot")
    first = read(found["motion"][0]["sympy"])
    assert sympy.simplify(first - M * a - k * (rho - l) * (x_1 - x_2) / rho) == 0
    code, out, _ = polhode("derive", f"{file}:pair")
    assert code == 0
    assert "  M v̇ₓ₁ + k (ρ − l) (x₁ − x₂)/ρ = 0\n" in out
    assert out.count("  ρ = √((x₁ − x₂)² + (y₁ − y₂)² + (z₁ − z₂)²)\n") == 1


def test_what_it_prints_of_lengths_is_judged(polhode, tmp_path):
    file = tmp_path / "own.py"
    file.write_text(PAIR)
    for line, expected in (
        ("M v̇ₓ₁ + k (ρ − l) (x₁ − x₂)/ρ = 0", 0),
        (r"m \dot v_{y,2} = k (\rho - l) (y_1 - y_2)/\rho", 0),
        ("M v̇ₓ₁ + k (ρ + l) (x₁ − x₂)/ρ = 0", 1),
    ):
        code, out, _ = polhode("check", f"{file}:pair", line)
        assert code == expected, out
        assert "length rho of the equations" in out
