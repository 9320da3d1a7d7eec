"""Equations between differentials: every term has the same number of them."""

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.judge import Answer
from polhode.judge.latex import read_latex
from polhode.judge.meaning._differentials import unequal_differentials


@pytest.mark.parametrize(
    "latex",
    [
        r"d\theta = \dot\theta\,dt",
        r"dt = \frac{d\theta}{\dot\theta}",
        r"\frac{d\mathbf L}{dt} = \boldsymbol\tau",
        r"\boldsymbol\tau\,dt - d\mathbf L = 0",
        r"\frac{d\omega_2}{A^2 - \omega_2^2} = k\,dt, \qquad k = 2",
        r"\sqrt{dx^2 + dy^2} = v\,dt",
    ],
)
def test_terms_of_one_order_in_dt(latex: str) -> None:
    assert unequal_differentials(read_latex(latex)) == ""


@pytest.mark.parametrize(
    "latex", [r"\theta = \frac{\theta}{dt}", r"d\theta = \dot\theta + dt", r"d\theta = dt^2"]
)
def test_terms_of_different_orders_in_dt(latex: str) -> None:
    assert "differentials" in unequal_differentials(read_latex(latex))


@pytest.mark.parametrize(
    "latex", [r"\dot\theta = \frac{\dot\theta}{dt}", r"\theta = \frac{\theta}{dt}"]
)
def test_a_quantity_is_not_itself_over_dt(latex: str) -> None:
    """With dt read as 1, these held."""
    assert ph.check(latex, equations("gyroscope")).answer is Answer.FAILS


def test_a_lost_differential_is_put_back() -> None:
    verdict = ph.check(r"\boldsymbol\tau = \frac{\mathbf L}{dt}", equations("gyroscope"))
    assert verdict.correction is not None
    assert verdict.correction.what == "differential lost"
    assert verdict.correction.latex == r"\boldsymbol\tau = \frac{d\mathbf L}{dt}"


@pytest.mark.parametrize(
    "latex",
    [
        r"dV = -Mga\sin\theta\,d\theta",
        r"dE = 0",
        r"dT = -dV",
        r"dV = \frac{\partial V}{\partial\theta}\,d\theta",
    ],
)
def test_without_dt_an_equation_between_differentials_of_the_state_is_one_of_rates(
    latex: str,
) -> None:
    assert ph.check(latex, equations("gyroscope")).answer is Answer.HOLDS


def test_a_slip_between_differentials_without_dt_is_corrected() -> None:
    verdict = ph.check(r"dV = Mga\sin\theta\,d\theta", equations("gyroscope"))
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    assert verdict.correction.latex == r"dV = -Mga\sin\theta\,d\theta"


@pytest.mark.parametrize("latex", [r"dF_z = a\,dm", r"dV = \dot V", r"dV = d\theta^2"])
def test_elements_of_a_body_and_unequal_differentials_are_not_rates(latex: str) -> None:
    """Of these only the second could be one, and it lacks the dt."""
    assert ph.check(latex, equations("gyroscope")).answer in (Answer.UNREAD, Answer.DEFINITION)
