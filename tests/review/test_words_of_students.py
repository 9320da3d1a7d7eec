"""Lines as students write them, each with the verdict that the mechanics gives it.

Compound pendulum from rest: ½Iθ̇² = mgl(cos θ - cos θ₀). Ladder: it leaves the wall at
cos θ = ⅔ cos θ₀ (Timoshenko and Young, Advanced Dynamics). Upright disk: ω₃² > g/3a. Symmetric free
body: Landau and Lifshitz, Mechanics, § 36.
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.claims import Answer

EXAMPLES = Path(__file__).parents[2] / "docs/examples/solutions"
TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.FIRST_ERROR, ph.Mark.FOLLOWS
OPEN = ph.Mark.NOT_JUDGED

SWING = r"""Let $I=I_2+ml^2$. It is released from rest at $\theta_0$.
Energy: $\frac12 I\dot\theta^2 = %s mgl(\cos\theta-\cos\theta_0)$.
At the bottom $\dot\theta^2 = \frac{%s mgl}{I}(1-\cos\theta_0)$."""
LADDER = r"""Energy from rest at $\theta_0$: $\frac23 l\dot\theta^2 = g(\cos\theta_0-\cos\theta)$.
%s $\cos\theta=\frac23\cos\theta_0$. Then $\dot\theta^2=\frac{g\cos\theta_0}{2l}$."""
FREE = r"""With $I_1=I_2$, $\dot\omega_1 = \frac{I_1-I_3}{I_1}\omega_3\omega_2$.
Thus $\ddot\omega_1 = %s\Gamma^2\omega_1$ with $\Gamma = \frac{I_3-I_1}{I_1}\omega_3$."""


@cache
def system(name: str) -> ph.Equations:
    if name in CATALOGUE:
        return ph.derive(CATALOGUE[name].build())
    return ph.derive(runpy.run_path(str(EXAMPLES / f"{name}.py"))[name])


def marks(text: str, name: str) -> list[ph.Mark]:
    return [line.mark for line in ph.review(text, system(name), seconds=0.0).lines]


@pytest.mark.parametrize(
    ("factors", "expected"),
    [
        (("", "2"), [TRUE, TRUE]),
        (("2", "4"), [ERROR, FOLLOWS]),
        (("2", "5"), [ERROR, ERROR]),
        (("", "5"), [TRUE, ERROR]),
    ],
)
def test_what_is_said_at_the_bottom_of_a_swing_from_rest(factors, expected):
    assert marks(SWING % factors, "physical_pendulum") == [OPEN, *expected]


@pytest.mark.parametrize(
    "words",
    ["It leaves the wall when", "Contact with the wall is lost when", "It loses contact at"],
)
def test_what_is_said_of_the_end_of_a_contact_is_no_line_of_its_own(words):
    assert marks(LADDER % words, "sliding_ladder") == [TRUE, TRUE, OPEN]


@pytest.mark.parametrize(("sign", "mark"), [("-", ph.Mark.NEEDS), ("", ERROR)])
def test_a_letter_defined_behind_a_line_is_none_of_the_field(sign, mark):
    assert marks(FREE % sign, "tennis-racquet") == [OPEN, TRUE, mark, OPEN]


@pytest.mark.parametrize(("bound", "mark"), [("3", TRUE), ("2", ERROR)])
def test_a_disk_that_rolls_upright_stands_at_a_right_angle(bound, mark):
    limit = rf"\frac{{g}}{{{bound}a}}"
    text = rf"Rolling upright in a straight line, stability requires $\omega_3^2 > {limit}$."
    assert marks(text, "rolling-disk") == [mark]


def test_a_sine_of_what_has_a_dimension_is_refused_before_it_is_worked_out():
    found = ph.check(r"\cos\alpha = \frac{I_3\omega_3}{L}", system("tennis-racquet"), seconds=5)
    assert found.answer is Answer.UNREAD
    assert "does not fit" in found.reason
    odd = ph.check(r"\sin\omega_3 = 1", system("tennis-racquet"))
    assert "terms of different dimensions: 1 and 1/s" in odd.reason
