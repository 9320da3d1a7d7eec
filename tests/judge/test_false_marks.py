"""Lines as students write them that a mark could easily wrong."""

from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge.derivations import derivation
from judge.marking import blamed, marked
from polhode.catalogue import PROBLEM_SET
from polhode.cli import main
from polhode.judge import sentence

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
NEEDS, NOT_JUDGED = ph.Mark.NEEDS, ph.Mark.NOT_JUDGED


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build())


def reviewed(text: str, system: str = "rolling-disk") -> tuple[ph.ReviewedLine, ...]:
    return ph.review(text, equations(system), seconds=0.0).lines


def marks(text: str, system: str = "rolling-disk") -> list[ph.Mark]:
    return [blamed(line) for line in reviewed(text, system)]


# -- what does not follow from a wrong line --------------------------------------------------------

# On a disk 3 domega_3/dt = 2 dtheta/dt dphi/dt sin(theta): to say that it is zero makes the product
# vanish, and no factor of it by itself.
SPIN = r"The spin is constant: \[ \dot\omega_3 = 0 . \] "


@pytest.mark.parametrize(
    "slip",
    [
        r"V = mga\cos\theta",
        r"T = \frac{ma^2}{8}(6\omega_3^2 + 5\dot\theta^2 + 2\dot\phi^2\sin^2\theta)",
        r"\ddot\phi\sin\theta - \omega_3\dot\theta + 2\dot\theta\dot\phi\cos\theta = 0",
        r"F_z = m(a\ddot\theta\cos\theta + a\dot\theta^2\sin\theta + g)",
        r"\omega_2 = \dot\phi\cos\theta",
    ],
)
def test_a_slip_is_not_excused_by_one_factor_of_a_product_that_vanishes(slip: str) -> None:
    assert marks(rf"{SPIN} Now \[ {slip} \]") == [ERROR, ERROR]


def test_that_the_product_vanishes_follows() -> None:
    assert marks(SPIN + r"Therefore \[ \dot\phi\dot\theta\sin\theta = 0 . \]") == [ERROR, FOLLOWS]


def test_no_energy_follows_from_rest() -> None:
    text = r"Hence \[ \dot\theta = 0 . \] \[ V = mga\cos\theta \]"
    assert marks(text) == [NOT_JUDGED, ERROR]  # which states it speaks of, and a slip


def test_a_moment_of_inertia_has_no_sense_to_be_counted_in() -> None:
    """Lines of the generator of slips; an ω that is counted the other way is no slip."""
    made = derivation(127, with_slip=True)
    assert made.text.splitlines()[1] == r"\[ I = - \frac{a^{2} m}{2} . \]"
    assert marked(made).is_named


# -- axes that the model does not have -------------------------------------------------------------

ALONG_BODY = r"""
\[ \omega_{i} = \dot\phi\sin\theta\sin\psi + \dot\theta\cos\psi \]
\[ \omega_{j} = \dot\phi\sin\theta\cos\psi - \dot\theta\sin\psi \]
"""


@pytest.mark.parametrize(
    ("system", "i", "j"),
    [("rolling-disk", "1", "2"), ("spinning-coin", "x", "y"), ("gyroscope", "2", "3")],
)
def test_components_along_axes_that_spin_with_the_body_are_not_called_wrong(
    system: str, i: str, j: str
) -> None:
    text = ALONG_BODY.replace("{i}", i).replace("{j}", j)
    lines = reviewed(text, system)
    assert [blamed(line) for line in lines] == [NOT_JUDGED] * 2
    assert all("axes" in line.reason and "psi" in line.reason for line in lines)


def test_components_are_judged_where_the_axes_of_the_model_spin_with_the_body() -> None:
    text = ALONG_BODY.replace("{i}", "1").replace("{j}", "2")
    assert marks(text, "tennis-racquet") == [TRUE, TRUE]
    assert marks(text.replace("-", "+"), "tennis-racquet") == [TRUE, ERROR]


def test_words_about_axes_fixed_in_the_body_are_heeded() -> None:
    # Along axes that do not spin with the body, Euler's equations have further terms.
    line = r"\[ I_1\dot\omega_1 = (I_1 - I_3)\omega_2\omega_3 + F_y a\cos\theta \]"
    assert marks(rf"Along body-fixed axes {line}") == [NOT_JUDGED]
    assert marks(line) == [ERROR]


# -- bodies that a text has chosen, or takes for granted -------------------------------------------


def test_a_body_chosen_in_one_sentence_is_named_in_later_ones() -> None:
    text = r"For a hollow sphere $I = \frac23 ma^2$. Then $\dot v_x = -\frac25\Omega v_y$."
    _, line = reviewed(text, "marble-on-turntable")
    assert blamed(line) is NEEDS
    assert line.needs == r"I = \frac23 ma^2"


def test_the_usual_body_may_be_taken_for_granted() -> None:
    (line,) = reviewed(r"\[ \dot v_x = -\frac27\Omega v_y \]", "marble-on-turntable")
    assert blamed(line) is NEEDS
    assert line.needs == r"I = \frac{2 m a^2}{5}"
    assert marks(r"\[ \dot v_x = -\frac25\Omega v_y \]", "marble-on-turntable") == [ERROR]


# -- approximations --------------------------------------------------------------------------------

NORTH = r"\[ I_1\ddot\theta = -I_3\Omega\omega\sin\theta\sin\lambda \]"


def test_a_line_that_leaves_out_terms_named_in_words_is_not_called_wrong() -> None:
    text = rf"We drop the terms in $\Omega^2$: {NORTH}"
    assert marks(text, "gyrocompass") == [NOT_JUDGED]
    assert marks(rf"Friction is neglected. {NORTH}", "gyrocompass") == [ERROR]


def test_what_is_much_smaller_is_stated_and_terms_of_higher_order_may_go() -> None:
    text = rf"Since $\Omega\ll\omega$ we have {NORTH}"
    assumed, line = reviewed(text, "gyrocompass")
    assert blamed(assumed) is NOT_JUDGED
    assert "small" in assumed.reason
    assert blamed(line) is NEEDS
    assert "leading order" in line.needs
    assert marks(text.replace("-I_3", "-2I_3"), "gyrocompass") == [NOT_JUDGED, ERROR]


def test_an_angle_that_is_said_to_be_small_after_its_letter_is_small() -> None:
    text = r"Write $\theta = \frac{\pi}{2} + \epsilon$ with $\epsilon$ small. "
    true, wrong = (
        r"\[ V \approx mga(1 - \frac12\epsilon^2) \]",
        r"\[ V \approx mga(1 - \epsilon^2) \]",
    )
    assert marks(text + true) == [NOT_JUDGED, TRUE]
    assert marks(text + wrong) == [NOT_JUDGED, ERROR]


# -- letters that a text chooses -------------------------------------------------------------------

PRECESSION = r"\[ (I_2 + Ma^2)\Omega^2\cos\theta_0 - I_1\omega_1\Omega + Mga = 0 \]"


def test_a_letter_for_a_steady_speed_is_defined_and_known_in_later_lines() -> None:
    text = rf"In steady precession at $\theta = \theta_0$ let $\dot\phi = \Omega$: {PRECESSION}"
    assert marks(text, "gyroscope") == [TRUE, NOT_JUDGED, TRUE]
    assert marks(text.replace("+ Mga", "- Mga"), "gyroscope") == [TRUE, NOT_JUDGED, ERROR]


def test_a_speed_that_is_drawn_from_other_lines_is_a_claim() -> None:
    (line,) = reviewed(r"Hence \[ \omega_2 = \dot\phi . \]")
    assert line.needs.startswith("small")  # ω₂ = φ̇ sin θ, and θ = π/2 is a place to depart from


def test_a_component_that_is_set_to_a_speed_is_a_claim() -> None:
    assert marks(r"\[ \omega_2 = 2\dot\phi \]") == [ERROR]
    assert marks(r"\[ v_x = \dot\theta \]") == [ERROR]


# -- two systems -----------------------------------------------------------------------------------


def test_a_comment_that_names_another_system_is_mentioned(tmp_path: Path, capsys) -> None:
    file = tmp_path / "a.tex"
    file.write_text("% polhode: rolling-disk\n$V = mga\\sin\\theta$\n")
    main(["review", str(file), "--system", "spinning-coin"])
    assert "names rolling-disk in a comment, but was reviewed on spinning-coin" in (
        capsys.readouterr().out
    )
    main(["review", str(file), "--system", "rolling-disk"])
    assert "comment" not in capsys.readouterr().out


# -- letters and instants that the text chooses ----------------------------------------------------

CIRCLE = r"""Let $$ \Lambda = \frac{I\Omega}{I + ma^2} $$
The centre $\mathbf R$ of the circle stays at rest:
$$ \mathbf R = (x - \frac{v_y}{\Lambda})\hat{\mathbf x} + (y + \frac{v_x}{\Lambda})\hat{\mathbf y},
\qquad \frac{d\mathbf R}{dt} = 0 $$
With the time $t$ counted from an instant at which the marble moves along $x$,
$$ v_x = u \cos(\Lambda t), \qquad v_y = u \sin(\Lambda t) $$
"""


def test_a_centre_named_in_words_and_an_instant_of_the_texts_own():
    found = marks(CIRCLE, "marble-on-turntable")
    assert found == [NOT_JUDGED, NOT_JUDGED, TRUE, NOT_JUDGED, NOT_JUDGED]
    assert ERROR in marks(CIRCLE.replace("y + ", "y - "), "marble-on-turntable")


# -- small departures from steady motion -----------------------------------------------------------

UPRIGHT = r"Let $\theta = \frac\pi2 + \epsilon$ with small $\epsilon$. "
OSCILLATES = r"\[ \ddot\epsilon \approx -\frac45\left(3\omega_3^2 - \frac ga\right)\epsilon \]"
SLOW_TURN = r"\[ \dot\phi \approx 2\epsilon\omega_3 \]"


def test_a_departure_from_steady_rolling_needs_a_constant_of_integration() -> None:
    text = UPRIGHT.replace(r"small $\epsilon$", r"small $\epsilon$ and small $\dot\phi$")
    _, turn, line = reviewed(text + SLOW_TURN + OSCILLATES)
    assert (blamed(turn), blamed(line)) == (NEEDS, NEEDS)
    assert turn.needs == line.needs == "a constant of integration that is zero"
    assert marks(text + OSCILLATES.replace("3", "2"))[-1] is ERROR
    assert marks(text + "We integrate to" + SLOW_TURN + "and get" + OSCILLATES)[-1] is TRUE


@pytest.mark.parametrize("small", [r"small $\epsilon$", r"$|\epsilon| \ll 1$"])
def test_the_steady_motion_that_is_departed_from_has_no_speed_of_turning(small: str) -> None:
    text = UPRIGHT.replace(r"small $\epsilon$", small)
    for line in (OSCILLATES, OSCILLATES.replace(r"\approx", "=")):
        found = reviewed(text + line)[-1]
        assert blamed(found) is NEEDS
        assert r"small \dot{\phi} and a constant of integration that is zero" in found.needs
    assert marks(text + OSCILLATES.replace(r"\frac ga", r"\frac{2g}a"))[-1] is ERROR


def test_a_coin_on_edge_that_does_not_spin() -> None:
    line = r"\[ \ddot\epsilon \approx -\left(\dot\phi^2 - \frac{4g}{a}\right)\epsilon \]"
    assert reviewed(UPRIGHT + line, "spinning-coin")[-1].needs == r"\omega_3 = 0"
    assert marks(UPRIGHT + line.replace("4", "2"), "spinning-coin")[-1] is ERROR


def test_a_departure_of_a_speed_from_a_value_of_the_texts_own() -> None:
    text = r"""Let $\omega_2 = \omega_0 + \epsilon$, with $\omega_1, \omega_3, \epsilon$ small.
    \[ \dot\omega_3 \approx \frac{I_1 - I_2}{I_3}\omega_0\omega_1 \]"""
    assert marks(text, "tennis-racquet") == [NOT_JUDGED, TRUE]
    assert marks(text.replace("I_1 - I_2", "I_2 - I_1"), "tennis-racquet") == [NOT_JUDGED, ERROR]


def test_a_departure_from_precession_whose_constants_have_to_fit_is_not_judged() -> None:
    text = r"""Let $\theta = \theta_0 + \epsilon$ and $\dot\phi = \Omega + \delta$, both small:
    \[ (I_2 + Ma^2)\ddot\phi \approx (I_1\omega_1 - 2(I_2 + Ma^2)\Omega\cos\theta_0)
       \frac{\dot\epsilon}{\sin\theta_0}, \qquad \ddot\epsilon \approx \Omega^2\epsilon \]"""
    assert ERROR not in marks(text, "gyroscope")


def test_small_oscillations_about_the_meridian_and_their_period() -> None:
    text = r"""Near the meridian $\sin\theta \approx \theta$, so that
    \[ I_1\ddot\theta + I_3\omega\Omega\sin\lambda\,\theta = 0 \]
    with period \[ T = 2\pi\sqrt{\frac{I_1}{I_3\omega\Omega\sin\lambda}} \]"""
    angle, line, period = reviewed(text, "gyrocompass")
    assert (blamed(angle), blamed(line), blamed(period)) == (NOT_JUDGED, NEEDS, NOT_JUDGED)
    assert r"small \Omega" in line.needs
    assert period.reason == "defines T"
    assert marks(text.replace(r"\sin\lambda", r"\cos\lambda"), "gyrocompass")[1] is ERROR


@pytest.mark.parametrize("words", ["Unless", "Except where", "Away from"])
def test_an_exception_is_neither_judged_nor_in_force(words: str) -> None:
    text = rf"{words} $\sin\theta = 0$, the spin is not constant: \[ \dot\omega_3 = 0 . \]"
    assert marks(text, "rolling-disk") == [NOT_JUDGED, ERROR]
    assert reviewed(text)[0].reason.startswith("an exception")


def test_a_case_is_told_by_a_conserved_quantity() -> None:
    """On the gyrocompass the axle's precession about the meridian conserves n = ω + Ω cosθ sinλ."""
    n = r"\omega + \Omega\cos\theta\sin\lambda"
    text = rf"In between, at ${n} = 2\Omega$, the axle turns slowly."
    assert marks(text, "gyrocompass") == [NOT_JUDGED]
    (line,) = reviewed(rf"We find ${n} = 2\Omega$.", "gyrocompass")
    assert line.needs.startswith("a start")


def test_a_paragraph_that_goes_on_from_steady_motion_is_about_it() -> None:
    text = r"""In a steady motion $\theta$, $\dot\phi$ and $\omega_3$ are constant.

    Then the equations of motion require
    \[ a\dot\phi^2\sin\theta\cos\theta - 2a\omega_3\dot\phi\sin\theta - 4g\cos\theta = 0 . \]"""
    assert marks(text, "spinning-coin") == [TRUE]
    assert marks(text.replace("4g", "2g"), "spinning-coin") == [ERROR]


# -- slashes that writers read in two ways ---------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "mark", "read_as"),
    [
        (r"V = 1/2 m a\cdot 2g\sin\theta", TRUE, r"V = \frac{1}{2} m a\cdot 2g\sin\theta"),
        (r"I_3 = 1/2 m a^2", TRUE, r"I_3 = \frac{1}{2} m a^2"),
        (r"I_3 = 1/4 m a^2", ERROR, r"I_3 = \frac{1}{4} m a^2"),
        (
            r"T = 1/2 m v^2 + 1/2 I_1 (\dot\theta^2 + \dot\phi^2\sin^2\theta) + 1/2 I_3\omega_3^2",
            TRUE,
            r"T = \frac{1}{2} m v^2 + \frac{1}{2} I_1 (\dot\theta^2 + \dot\phi^2\sin^2\theta)"
            r" + \frac{1}{2} I_3\omega_3^2",
        ),
        (r"\kappa = 1/2 m a^2", NOT_JUDGED, r"\kappa = \frac{1}{2} m a^2"),
        (r"\kappa = g/a \sin\theta", NEEDS, ""),
    ],
)
def test_a_slash_is_read_in_the_way_whose_dimensions_are_right(
    latex: str, mark: ph.Mark, read_as: str
) -> None:
    (line,) = reviewed(rf"Let \[ {latex} . \]")
    assert (blamed(line), line.read_as.removeprefix("read as ")) == (mark, read_as)
    review = ph.Review("rolling-disk", ("",), (line,))
    assert (rf", read as {read_as}" in sentence(line, review)) == bool(read_as)


def test_a_letter_that_a_slash_defines_is_used_in_that_reading() -> None:
    text = r"Let $\kappa = 1/2 m a^2$. Then $I_3 = \kappa$ and $I_1 = \kappa$."
    assert marks(text) == [NOT_JUDGED, TRUE, ERROR]
