"""`polhode steady`: documents that SymPy reads, and answers a text would give."""

import pytest
import sympy

from cli.sympy_text import from_srepr
from polhode.cli import main


def test_rolling_on_edge(document):
    families = document("steady", "rolling-disk", "--at", "theta=pi/2")["families"]
    rolling = next(f for f in families if "phi_dot" in f["sympy"])
    (condition,) = rolling["stable_when"]
    a, g, spin = sympy.symbols("a g omega_3")
    relation = from_srepr(condition["sympy"])
    assert sympy.simplify(relation.lhs.subs(spin, sympy.sqrt(g / (3 * a)))) == 0
    assert relation.subs({a: 1, g: 1, spin: 1}) == sympy.true
    assert from_srepr(rolling["exists_when"]["sympy"]) == sympy.true


def test_precession_has_branches_and_a_condition_of_existence(document):
    families = document("steady", "gyroscope")["families"]
    precession = next(f for f in families if f["branches"])
    assert len(precession["branches"]) == 2
    relation = from_srepr(precession["sympy"])
    rate = sympy.Symbol("phi_dot")
    for branch in precession["branches"]:
        assert sympy.simplify(relation.subs(rate, from_srepr(branch["sympy"]))) == 0
    assert from_srepr(precession["stable_when"][0]["sympy"]) == sympy.true
    singular = [f for f in families if f["stable_when"] is None]
    assert all("not singular" in f["undecided"] for f in singular)
    assert singular


def test_the_text_output(capsys):
    assert main(["steady", "gyroscope", "--at", "theta=60deg"]) == 0
    assert "exists when" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["steady", "ball-on-paper"], "depend on time"),
        (["steady", "gyroscope", "--at", "thet=1"], "did you mean theta"),
        (["steady", "gyroscope", "--at", "theta=3kg"], "expected a pure number or an angle"),
        (["steady", "gyroscope/vertical-plane", "--at", "theta=pi/2"], "contradict"),
    ],
)
def test_impossible_requests_are_explained(capsys, words, said):
    assert main(words) == 2
    captured = capsys.readouterr()
    assert said in captured.err
    assert not captured.out


def test_an_angle_without_exact_sine_is_printed_in_decimals(capsys):
    assert main(["steady", "rolling-disk", "--at", "theta=80deg"]) == 0
    out = capsys.readouterr().out
    assert "theta = 1.396263402" in out
    assert "0.984807753" in out
    assert "/2500000000000000" not in out


def test_what_is_declared_positive_has_no_other_value(polhode):
    code, out, err = polhode("steady", "rolling-disk", "--at", "a=-1")
    assert (code, out) == (2, "")
    assert "expected a positive a" in err


def test_a_disk_that_lies_flat_is_outside_the_equations(polhode):
    code, out, err = polhode("steady", "spinning-coin", "--at", "theta=0")
    assert (code, out) == (2, "")
    assert "sin(theta) > 0" in err
    assert "theta_ddot tends to -4*g/(5*a)" in err


def test_gravity_may_be_absent_but_a_mass_may_not(document, polhode):
    """Without gravity a symmetric body precesses at any rate with ω₁ = I₂ₚ φ̇ cos θ/I₁."""
    families = document("steady", "gyroscope", "--at", "g=0")["families"]
    regular = next(f for f in families if "omega_1" in f["sympy"])
    _, relation = from_srepr(regular["sympy"])
    M, a, first, second, theta, spin, rate = sympy.symbols("M a I_1 I_2 theta omega_1 phi_dot")
    regular_precession = (second + M * a**2) * rate * sympy.cos(theta) / first
    assert sympy.simplify(relation - (spin - regular_precession)) == 0
    code, _, err = polhode("steady", "gyroscope", "--at", "M=0")
    assert code == 2
    assert "positive M" in err


def test_steady_precession_of_a_fast_top(document, polhode):
    """(128) of the problem set, and the next term by SymPy's own series."""
    words = ("steady", "gyroscope", "--small", "1/omega_1:1")
    slow = document(*words)["families"][0]["branches"][0]
    M, g, a, first, second, theta, spin, w = sympy.symbols("M g a I_1 I_2 theta omega_1 w")
    assert sympy.simplify(from_srepr(slow["expanded"]["sympy"]) - M * g * a / (first * spin)) == 0
    moment = second + M * a**2
    root = sympy.sqrt(1 - 4 * M * g * a * moment * sympy.cos(theta) * w**2 / first**2)
    exact = first / (2 * moment * sympy.cos(theta) * w) * (1 - root)
    cubic = sympy.series(exact, w, 0, 4).removeO().coeff(w, 3)
    assert sympy.simplify(from_srepr(slow["dropped"]["sympy"]) - cubic / spin**3) == 0
    _, out, _ = polhode(*words)
    assert "≈ M g a/(I₁ ω₁) for large ω₁ > 0" in out


def test_a_sine_that_is_assumed_positive_has_no_bars(polhode):
    _, out, _ = polhode("steady", "rolling-disk", "--small", "1/omega_3:1")
    assert "≈ −2 g cosθ/(3 a ω₃ sinθ) for large ω₃ > 0" in out


def test_a_small_quantity_has_to_exist(polhode):
    code, _, err = polhode("steady", "gyroscope", "--small", "1/omega_9:1")
    assert code == 2
    assert "omega_1" in err
    code, _, err = polhode("steady", "gyroscope", "--small", "1/omega_1:x")
    assert code == 2
    assert "a whole number" in err
