"""Letters, departures and alternatives that a text names in words."""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
NEEDS, NOT_JUDGED = ph.Mark.NEEDS, ph.Mark.NOT_JUDGED


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build())


def marks(text: str, system: str = "rolling-disk", format: str = ".tex") -> list[ph.Mark]:
    return [
        blamed(line)
        for line in ph.review(text, equations(system), format=format, seconds=0.0).lines
    ]


ROLLING = r"\[ \mathbf v + \boldsymbol\omega\times\mathbf a = \boldsymbol\Omega\times\mathbf r \]"


def test_a_vector_that_the_text_describes_is_its_own() -> None:
    text = (
        r"Let $\mathbf a$ lead from the centre to the contact, $\mathbf a = -a\hat{\mathbf z}$. "
        + ROLLING
    )
    assert marks(text, "marble-on-turntable") == [TRUE, TRUE]
    wrong = text.replace(r"+ \boldsymbol\omega", r"- \boldsymbol\omega")
    assert marks(wrong, "marble-on-turntable") == [TRUE, ERROR]


def test_a_wrong_acceleration_is_not_excused_as_a_letter_of_its_own() -> None:
    text = r"Let $\mathbf a$ be the acceleration, $\mathbf a = a\ddot\theta\hat{\mathbf 1}$."
    assert marks(text) == [ERROR]


def test_a_letter_is_defined_once_more() -> None:
    text = (
        r"Let $\epsilon = \theta - \frac{\pi}{2}$. \[ V = mga\cos\epsilon \] "
        r"Now let $\epsilon = \theta$. \[ V = mga\sin\epsilon \]"
    )
    assert marks(text) == [NOT_JUDGED, TRUE, NOT_JUDGED, TRUE]


def test_small_departures_from_a_steady_motion_and_an_integration() -> None:
    text = (
        r"Steady motion is possible at $\theta = \frac{\pi}{2}$ and $\dot\phi = 0$. "
        r"Let $\epsilon = \theta - \frac{\pi}{2}$ be a small departure from it. Then "
        r"\[ 5a\ddot\epsilon + 6a\omega_3\dot\phi - 4g\epsilon \approx 0. \] "
        r"With a constant of integration taken as zero, $\dot\phi = 2\epsilon\omega_3$. Hence "
        r"\[ 5a\ddot\epsilon \approx 4\epsilon(g - 3a\omega_3^2). \]"
    )
    expected = [NOT_JUDGED, NOT_JUDGED, NOT_JUDGED, TRUE, NOT_JUDGED, TRUE]
    assert marks(text) == expected
    assert marks(text.replace("g - 3a", "g - 2a"))[-1] is ERROR
    assert marks(text.replace(r"= 2\epsilon", r"= 3\epsilon"))[4] is ERROR


def test_an_alternative_is_not_under_the_condition_before_it() -> None:
    spin = r"\frac{\Omega(I_1 - I_3)\cos\theta\sin\lambda}{I_3}"
    text = rf"Steady motion is possible with $\theta = 0$, or with $\omega = {spin}$."
    assert marks(text, "gyrocompass") == [NOT_JUDGED, TRUE]


def test_what_is_large_makes_its_inverse_small() -> None:
    text = (
        r"In steady precession with large $\omega_1$ \[ \dot\phi \approx \frac{Mga}{I_1\omega_1} \]"
    )
    assert marks(text, "gyroscope") == [TRUE]
    assert marks(text.replace("{Mga}", "{2Mga}"), "gyroscope") == [ERROR]


@pytest.mark.parametrize("words", ["", "In general, "])
def test_a_conserved_quantity_may_be_assumed_to_have_a_value(words: str) -> None:
    text = (
        rf"Assume that $L^2 = 2I_2T$. {words}\[ I_1I_2(I_3 - I_1)\omega_1^2 "
        r"= (I_3 - I_2)(L^2 - I_2^2\omega_2^2) \]"
    )
    assert marks(text, "tennis-racquet") == [NOT_JUDGED, TRUE]
    assert marks("Assume that $V = mga\\cos\\theta$.") == [ERROR]


def test_words_before_a_blank_line_count_for_the_display_after_it() -> None:
    text = "Let $\\theta = \\pi/2 + \\epsilon$. For small $\\epsilon$\n\n$$ V \\approx mga $$"
    assert marks(text, format=".md") == [NOT_JUDGED, TRUE]


def test_conditions_of_an_earlier_sentence_are_named() -> None:
    text = (
        r"The centre moves vertically, $v_x = 0$ and $v_y = 0$. "
        r"\[ T_{\rm cm} = \tfrac12 m a^2\dot\theta^2\cos^2\theta \]"
    )
    *_, line = ph.review(text, equations("spinning-coin"), seconds=0.0).lines
    assert blamed(line) is NEEDS
    assert line.needs == "v_x = 0 and v_y = 0"


# -- vectors ---------------------------------------------------------------------------------------


def test_a_wrong_vector_is_carried_on_to_its_rate_the_force_and_the_motion() -> None:
    text = (
        r"\[ \mathbf v_{\rm cm} = a\dot\phi\sin\theta\hat{\mathbf 2}"
        r" + a\dot\theta\hat{\mathbf 3} \]"
        r"\[ \frac{d\mathbf v_{\rm cm}}{dt}"
        r" = a(\dot\theta^2 - \dot\phi^2\sin^2\theta)\hat{\mathbf 1}"
        r" + a\ddot\phi\sin\theta\hat{\mathbf 2}"
        r" + a(\ddot\theta + \dot\phi^2\sin\theta\cos\theta)\hat{\mathbf 3} \]"
        r"\[ \mathbf F - Mg\hat{\mathbf z} = M\frac{d\mathbf v_{\rm cm}}{dt} \]"
        r"\[ \mathbf F\cdot\hat{\mathbf 3} = Mg\sin\theta"
        r" + Ma(\ddot\theta + \dot\phi^2\sin\theta\cos\theta) \]"
    )
    assert marks(text, "gyroscope") == [ERROR, FOLLOWS, TRUE, FOLLOWS]


def test_a_coefficient_that_vanishes_in_truth_stops_no_review() -> None:
    text = (
        r"Let $\mathbf a = -a\,\hat{\mathbf z}$ lead from the centre to the contact. "
        + ROLLING.replace("+", "-")
        + r"\[ \frac{d\mathbf v}{dt} = 2\boldsymbol\Omega\times\mathbf v \]"
    )
    assert marks(text, "marble-on-turntable")[1] is ERROR


# -- starts, limits and letters in words -----------------------------------------------------------

REST = (
    r"The gyro is released from rest at $\theta = \theta_1$, $\dot\theta = \dot\phi = 0$. "
    r"Let $I_{2p} = I_2 + Ma^2$. Then "
    r"\[ \tfrac12 I_{2p}(\dot\theta^2 + \dot\phi^2\sin^2\theta) = Mga(\cos\theta_1 - \cos\theta) \]"
    r"\[ I_{2p}\dot\phi\sin^2\theta = I_1\omega_1(\cos\theta_1 - \cos\theta) \]"
)


def test_a_letter_for_the_value_at_a_start_is_constant() -> None:
    assert marks(REST, "gyroscope") == [NOT_JUDGED, NOT_JUDGED, NOT_JUDGED, TRUE, TRUE]
    assert marks(REST.replace("= Mga", "= 2Mga"), "gyroscope")[3] is ERROR


@pytest.mark.parametrize(
    "words",
    [
        r"Let $\omega_1, \omega_3 \ll \omega_2$. Then",
        r"Since $\omega_1 \ll \omega_2$ and $\omega_3 \ll \omega_2$,",
        r"Where $\omega_1$ and $\omega_3$ are small,",
    ],
)
def test_a_product_of_two_small_quantities_vanishes_to_first_order(words: str) -> None:
    assert marks(rf"{words} \[ \dot\omega_2 \approx 0. \]", "tennis-racquet")[-1] is TRUE
    assert marks(rf"{words} to first order \[ \dot\omega_2 = 0. \]", "tennis-racquet")[-1] is TRUE
    assert marks(rf"{words} \[ \dot\omega_1 \approx 0. \]", "tennis-racquet")[-1] is ERROR


def test_a_radius_of_the_text_is_no_force_and_a_fast_top_no_exact_statement() -> None:
    circle = r"In steady rolling on a circle of radius $R$ we have $v = R\dot\phi$."
    assert marks(circle) == [NOT_JUDGED]
    fast = r"For a fast top $\tau = I_1\omega_1\dot\phi\sin\theta$."
    assert marks(fast, "gyroscope") == [NOT_JUDGED]


def test_bold_f_may_be_the_friction_alone() -> None:
    text = (
        r"\[ \mathbf f = m\dot{\mathbf v} \]"
        r"\[ I\dot{\boldsymbol\omega} = -a\hat{\mathbf z}\times\mathbf f \]"
    )
    assert marks(text, "marble-on-turntable")[0] is not ERROR
    assert marks(text.replace("= m", "= 2m"), "marble-on-turntable")[0] is ERROR
