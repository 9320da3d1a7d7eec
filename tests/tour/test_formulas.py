"""Formulas on the page: nothing lost where a line may break, nothing unescaped."""

import re
from collections import Counter
from xml.etree import ElementTree

import polhode as ph
from polhode.tour._formulas import equation, listed, power_of_ten, raised, scientific, with_formulas
from polhode.view import inline

a, b, c = ph.symbols("a b c")
theta = ph.coordinate("theta")
ZERO = ph.Expr.constant(0)


def tokens(markup):
    """Letters, figures and signs in their order."""
    return [
        element.text
        for element in ElementTree.fromstring(str(markup)).iter()
        if element.text and element.tag in ("mi", "mn", "mo")
    ]


def written(expression):
    text = re.sub(' xmlns="[^"]*"', "", expression.mathml())
    return tokens(text)


def long_sum():
    names = [f"{letter}_{i}" for letter in "abcdef" for i in range(8)]
    return sum((ph.symbol(name) for name in names), ZERO)


def test_an_equation_holds_all_of_both_sides():
    left, right = a * ph.sin(theta) + b, c**2 / 2 - theta.dt()
    assert tokens(equation(left, right)) == [*written(left), "=", *written(right)]


def test_a_line_may_break_before_every_sign_between_terms():
    pieces = list(ElementTree.fromstring(equation(a - b + c, ZERO)))
    assert [next(iter(tokens(ElementTree.tostring(p, encoding="unicode")))) for p in pieces] == [
        "a",
        *"−+",
        "=",
    ]


def test_what_may_be_scrolled_is_reached_by_the_keyboard():
    assert 'tabindex="0"' in equation(long_sum(), ZERO)
    assert "tabindex" not in equation(a - b + c, ZERO)


def test_no_line_breaks_after_a_leading_minus():
    pieces = list(ElementTree.fromstring(equation(a, -b)))
    assert len(pieces) == 2


def test_short_brackets_and_fractions_stay_whole():
    shown = equation(a * (b + c), (a + b) / c)
    assert len(list(ElementTree.fromstring(shown))) == 2


def test_a_long_fraction_opens_into_a_factor_and_a_bracket():
    total = long_sum()
    shown = equation(a, total / 2)
    extra = Counter(tokens(shown)) - Counter(tokens(equation(a, total)))
    assert extra == Counter("12()")
    assert len(list(ElementTree.fromstring(shown))) > 40


def test_a_long_bracket_opens_with_nothing_lost():
    product = a * long_sum() * theta
    assert tokens(equation(b, product)) == ["b", "=", *written(product)]
    assert len(list(ElementTree.fromstring(equation(b, product)))) > 40


def test_functions_stand_apart_from_what_is_before_and_after():
    shown = inline(a * ph.sin(theta) ** 2)
    assert [child.tag for child in ElementTree.fromstring(shown)[0]] == [
        "mi",
        "mspace",
        "msup",
        "mspace",
        "mi",
    ]


def test_a_formula_can_be_read_aloud():
    assert 'aria-label="a = −b"' in equation(a, -b)
    assert 'role="math"' in equation(a, -b)


def test_a_list_of_symbols_has_commas_between():
    assert re.sub("<[^>]*>", "", listed([theta.symbol, a.symbol])) == "θ, a"
    assert re.sub("<[^>]*>", "", listed([a.symbol])) == "a"


def test_dotted_letters_in_prose_become_formulas():
    shown = with_formulas("turn at -θ̇ about <1>")
    assert re.sub("<[^>]*>", "", shown) == "turn at −θ˙ about &lt;1&gt;"
    assert "<math>" in shown


def test_powers_of_ten():
    assert power_of_ten(1.44e-17, "m") == "1.4 × 10⁻¹⁷ m"
    assert power_of_ten(0.0) == "0"
    assert scientific("6.25e-4 kg") == "6.25 × 10⁻⁴ kg"
    assert scientific("a red-4 key") == "a red-4 key"
    assert raised("10⁻¹⁷ m²") == "10<sup>−17</sup> m<sup>2</sup>"
