"""Formulas as MathML, spaced as a text would print them."""

import re

import pytest

import polhode as ph
from polhode.view import inline, typeset


def test_functions_stand_apart_from_what_they_are_of():
    thin = '<mspace width="0.17em"></mspace>'
    assert typeset(r"\sin\theta\cos\theta") == (
        '<math display="inline"><mrow>'
        f"<mi>sin</mi>{thin}<mi>θ</mi>{thin}<mi>cos</mi>{thin}<mi>θ</mi>"
        "</mrow></math>"
    )
    assert thin not in typeset(r"a + b\omega")


def test_a_bracket_stands_close_to_its_function():
    a, b = ph.symbols("a b")
    assert "mspace" not in inline(ph.sin(a + b))
    assert "mspace" in inline(ph.sin(a))


@pytest.mark.parametrize(
    ("latex", "shown"),
    [
        (r"\mathbf L", "𝐋"),
        (r"\hat{\mathbf 3}", "𝟑"),
        (r"\boldsymbol\tau", "𝝉"),
        (r"\boldsymbol\Omega", "𝜴"),
        (r"\bm{v}", "𝒗"),
        (r"\mathcal L", "ℒ"),
    ],
)
def test_letters_of_other_alphabets_are_their_own_characters(latex, shown):
    """Browsers follow MathML Core, which knows no mathvariant but normal."""
    formula = typeset(latex)
    assert shown in formula
    assert "mathvariant" not in formula


@pytest.mark.parametrize(
    "latex",
    [
        r"\text{<script>alert(1)</script>}",
        r"\text{<img src='x' onerror='alert(1)'/>}",
        r"x = \mbox{<a href='https://example.org'>y</a>}",
        r"\text{<style>*{display:none}</style>}",
    ],
)
def test_elements_of_html_in_a_formula_leave_it_untypeset(latex):
    assert typeset(latex) == ""


def test_links_and_styles_in_a_formula_are_left_out():
    shown = typeset(r"\href{javascript:alert(1)}{x} \style{color:red}{y} \class{note}{z}")
    assert not re.search("href|style|class|javascript|color", shown)
    assert re.sub("<[^>]*>", "", shown) == "xyz"


def test_a_single_upright_letter_stays_upright():
    """Browsers print an mi of one letter in italics unless its variant is normal."""
    assert '<mi mathvariant="normal">m</mi>' in typeset(r"3\,\mathrm{m}")


def test_the_exponent_of_a_dotted_letter_is_as_high_as_of_the_letter():
    """Its base is as high as a letter without dots, from which browsers count."""
    written = typeset(r"\dot\phi^2 + \theta^2 + \ddot{x}_1^2")
    base = '<msup><mpadded height="0.6em"><mover><mi>ϕ</mi><mo>˙</mo></mover></mpadded>'
    assert base in written
    assert "<msup><mi>θ</mi>" in written
    assert written.count("mpadded height") == written.count("<mover>")
