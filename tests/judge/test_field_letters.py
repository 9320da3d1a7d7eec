"""Letters that the field uses for several quantities, and the quantities it knows by one letter.

The formulas are those of Goldstein, Landau and Lifshitz, Taylor, and Kleppner and Kolenkow; each
slip differs from its original by a factor, a sign or a function.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

import polhode as ph
from judge import textbook_systems as systems
from judge.judged import uncorrected
from polhode.derive import Equations
from polhode.judge import Answer

System = Callable[[], Equations]

TRUE: list[tuple[System, str, str]] = [
    (systems.pendulum, r"T = mg\cos\theta + ml\dot\theta^2", "tension of string"),
    (systems.pendulum, r"T = \frac12 mv^2", "kinetic energy"),
    (systems.pendulum, r"T = 2\pi\sqrt{l/g}", "period of small oscillations"),
    (systems.pendulum, r"\omega_0 = \sqrt{g/l}", "frequency of small oscillations"),
    (systems.pendulum, r"\omega = \sqrt{g/l}", "frequency of small oscillations"),
    (systems.pendulum, r"L = \frac12 ml^2\dot\theta^2 + mgl\cos\theta", "lagrangian"),
    (
        systems.pendulum,
        r"L = ml^2\dot\theta",
        "angular momentum about string along its axis of rotation",
    ),
    (
        systems.pendulum,
        r"\alpha = -\frac gl\sin\theta",
        "angular acceleration along its axis of rotation",
    ),
    (systems.pendulum, r"H = \frac{p_\theta^2}{2ml^2} - mgl\cos\theta", "hamiltonian"),
    (systems.pendulum, r"U(\theta) = mgl(1-\cos\theta)", "potential energy"),
    (systems.physical_pendulum, r"T_0 = 2\pi\sqrt{\frac{h^2+k^2}{gh}}", "period of small osc"),
    (systems.spherical_pendulum, r"p_\phi = M_z", "angular momentum about string"),
    (
        systems.spherical_pendulum,
        r"U_{\rm eff}(\theta) = \frac{p_\phi^2}{2ml^2\sin^2\theta} - mgl\cos\theta",
        "effective potential energy",
    ),
    (
        systems.heavy_top,
        r"V_{\rm eff} = \frac{(p_\phi - p_\psi\cos\theta)^2}{2I_1\sin^2\theta} + Mgl\cos\theta",
        "effective potential energy",
    ),
    (systems.ball_on_a_slope, r"a = \frac57 g\sin\alpha", "acceleration of cm down the slope"),
    (systems.ball_on_a_slope, r"f = \frac27 Mg\sin\alpha", "force of contact up the slope"),
    (systems.ball_on_a_slope, r"N = Mg\cos\alpha", "normal force of contact"),
    (systems.sliding_ball, r"f = \mu N", "friction of cloth"),
    (systems.sliding_ball, r"F_x^2 + F_y^2 = \mu^2M^2g^2", "force of cloth"),
    (systems.yo_yo_by_an_equation, r"M\ddot z = T - Mg", "declared Q"),
    (systems.yo_yo_by_an_equation, r"I\ddot\theta = Tb", "declared Q"),
    (systems.yo_yo_by_an_equation, r"T = \frac12 M\dot z^2 + \frac12 I\dot\theta^2", "kinetic"),
    (systems.beads, r"T = \frac12 m_1v_1^2 + \frac12 m_2v_2^2", "velocity of upper"),
    (systems.free_body, r"\mathbf L = \tilde{\mathbf I}\boldsymbol\omega", "inertia about cm"),
    (systems.heavy_top, r"\boldsymbol\omega = \dot\phi\mathbf E_3 + \dot\theta\mathbf e_1'"
     r" + \dot\psi\mathbf e_3", "axis x of lab'"),
]  # fmt: skip


@pytest.mark.parametrize(("system", "latex", "meaning"), TRUE)
def test_a_letter_is_read_as_the_quantity_that_fits(
    system: System, latex: str, meaning: str
) -> None:
    verdict = ph.check(latex, system(), seconds=None)
    assert verdict.answer is Answer.HOLDS
    assert any(read.meaning.startswith(meaning) for read in verdict.readings)


@pytest.mark.parametrize(
    ("system", "latex"),
    [
        (systems.pendulum, r"T = mg\cos\theta - ml\dot\theta^2"),
        (systems.pendulum, r"T_0 = 2\pi\sqrt{l/2g}"),
        (systems.pendulum, r"\omega_0 = \sqrt{l/g}"),
        (systems.pendulum, r"L = ml^2\dot\theta^2 + mgl\cos\theta"),
        (systems.pendulum, r"H = \frac{p_\theta^2}{ml^2} + mgl\cos\theta"),
        (systems.pendulum, r"U(\theta) = mgl(1+\cos\theta)"),
        (
            systems.heavy_top,
            r"U_{\rm eff}(\theta) = \frac{(p_\phi-p_\psi\cos\theta)^2}{2I_1\sin\theta}"
            r" + Mgl\cos\theta",
        ),
        (systems.ball_on_a_slope, r"a = \frac35 g\sin\alpha"),
        (systems.ball_on_a_slope, r"N = Mg\sin\alpha"),
        (systems.sliding_ball, r"f = 2\mu Mg"),
        (systems.yo_yo_by_an_equation, r"M\ddot z = 2T - Mg"),
        (systems.yo_yo_by_an_equation, r"I\ddot\theta = -Tb"),
        (systems.free_body, r"L = -\sqrt{I_1^2\omega_1^2+I_2^2\omega_2^2+I_3^2\omega_3^2}"),
        (systems.pendulum, r"v = -l\dot\theta"),
    ],
)
def test_what_is_false_of_the_quantity_that_fits_fails(system: System, latex: str) -> None:
    assert uncorrected(latex, system()).answer is Answer.FAILS


def test_dimensions_choose_and_the_verdict_says_so() -> None:
    verdict = ph.check(r"T = mg\cos\theta + ml\dot\theta^2", systems.pendulum())
    assert "T is not read as kinetic energy, which does not fit the formula" in verdict.remarks


@pytest.mark.parametrize(
    ("read", "answer"),
    [
        ("T = tension", Answer.HOLDS),
        ("T = kinetic energy", Answer.FAILS),
        ("T = period", Answer.FAILS),
    ],
)
def test_a_reading_is_chosen_by_a_word(read: str, answer: Answer) -> None:
    latex = r"T = mg\cos\theta + ml\dot\theta^2"
    assert uncorrected(latex, systems.pendulum(), read=[read]).answer is answer


def test_an_unknown_reading_lists_the_known_ones() -> None:
    with pytest.raises(ph.ParseError, match="kinetic energy; tension of string; period of small"):
        ph.check("T = 1", systems.pendulum(), read=["T = temperature"])


@pytest.mark.parametrize(
    "latex", [r"\beta = \frac{2Mgl}{I_1}", "N = 3I_3", r"a = \frac{p_\psi}{I_1}"]
)
def test_a_letter_of_another_dimension_is_the_texts_own(latex: str) -> None:
    assert ph.check(latex, systems.heavy_top()).answer is Answer.DEFINITION


@pytest.mark.parametrize("latex", [r"M\ddot z = T - Mg", r"T = M(\ddot z + g)", "T = Mg"])
def test_a_letter_is_no_kinetic_energy_where_it_has_to_be_a_force(latex: str) -> None:
    """A stick on smooth ice has no string: what T is the text alone knows."""
    verdict = uncorrected(latex, systems.falling_stick())
    assert verdict.answer is Answer.UNREAD
    assert "which tension" in verdict.reason
    read = ph.check(latex, systems.falling_stick(), read=["T = kinetic energy"])
    assert read.answer is Answer.FAILS


@pytest.mark.parametrize("latex", [r"T = M\dot z", r"E = T + V\dot\theta", r"T = \frac12 M\dot z"])
def test_a_kinetic_energy_of_a_dimension_that_no_quantity_has_fails(latex: str) -> None:
    assert uncorrected(latex, systems.falling_stick()).answer is Answer.FAILS


def test_a_letter_that_texts_define_freely_is_ambiguous_where_it_fails() -> None:
    verdict = ph.check(r"\alpha = \frac{2E}{I_1}", systems.heavy_top())
    assert verdict.answer is Answer.AMBIGUOUS
    assert "definition if alpha is defined by the text" in verdict.reason


def test_what_the_text_states_under_a_usual_letter_chooses_among_readings() -> None:
    """U_eff is the effective potential only if **L** is about the pivot."""
    effective = (
        r"U_{\rm eff} = \frac{(L_z-L_3\cos\theta)^2}{2I_1\sin^2\theta} + \frac{L_3^2}{2I_3}"
        r" + Mgl\cos\theta"
    )
    latex = r"E = \frac12 I_1\dot\theta^2 + U_{\rm eff}"
    assert ph.check(latex, systems.heavy_top(), let=[effective]).answer is Answer.HOLDS
    wrong = r"E = I_1\dot\theta^2 + U_{\rm eff}"
    assert uncorrected(wrong, systems.heavy_top(), let=[effective]).answer is Answer.FAILS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"v_{\max} = \sqrt{gl}", Answer.FAILS),  # nothing bounds the speed of all motions
        (r"v_{\max} = \sqrt{2gl(1-\cos\theta_0)}", Answer.UNREAD),
    ],
)
def test_the_greatest_speed_is_one_that_is_never_exceeded(latex: str, answer: Answer) -> None:
    assert uncorrected(latex, systems.pendulum()).answer is answer


# --- chains ---


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"p_\psi = I_3(\dot\psi + \dot\phi\cos\theta) = I_1a", Answer.HOLDS),
        (r"p_\psi = I_3(\dot\psi - \dot\phi\cos\theta) = I_1a", Answer.FAILS),
        (r"p_\psi = I_1a = I_3(\dot\psi + \dot\phi\cos\theta)", Answer.HOLDS),
        (r"p_\psi = I_1a = I_3\dot\psi", Answer.FAILS),
    ],
)
def test_a_link_with_a_new_letter_defines_it_and_the_others_are_judged(
    latex: str, answer: Answer
) -> None:
    verdict = uncorrected(latex, systems.heavy_top(), context="identity")
    assert verdict.answer is answer
    assert "defines a; not judged, since nothing else determines it" in verdict.remarks


# --- momenta as variables ---


@pytest.mark.parametrize(
    "latex",
    [
        r"\dot\theta = \frac{\partial H}{\partial p_\theta}",
        r"\dot p_\theta = -\frac{\partial H}{\partial\theta}",
        r"\dot p_\phi = -\frac{\partial H}{\partial\phi} = 0",
        r"\frac{\partial H}{\partial p_\phi} = \frac{p_\phi}{ml^2\sin^2\theta}",
        r"\frac{d}{dt}\frac{\partial L}{\partial\dot q_i} = \frac{\partial L}{\partial q_i}",
        r"\dot q_i = \frac{\partial H}{\partial p_i},\quad i = 1,\ldots,n",
    ],
)
def test_hamiltons_and_lagranges_equations(latex: str) -> None:
    assert ph.check(latex, systems.spherical_pendulum()).answer is Answer.HOLDS


@pytest.mark.parametrize(
    "latex",
    [
        r"\dot p_\theta = \frac{\partial H}{\partial\theta}",
        r"\frac{d}{dt}\frac{\partial L}{\partial\dot q_i} + \frac{\partial L}{\partial q_i} = 0",
    ],
)
def test_their_slips(latex: str) -> None:
    assert uncorrected(latex, systems.spherical_pendulum()).answer is Answer.FAILS


# --- derivatives and rates of two meanings ---


def test_a_rate_by_an_angle_is_along_the_motion_where_the_other_reading_is_trivial() -> None:
    latex = r"\dot\theta\frac{d\dot\theta}{d\theta} = -\frac gl\sin\theta"
    assert ph.check(latex, systems.pendulum()).answer is Answer.HOLDS


@pytest.mark.parametrize(
    ("read", "answer"),
    [
        ([], Answer.AMBIGUOUS),
        (["d/dtheta = along the motion"], Answer.HOLDS),
        (["d/dtheta = at fixed speeds"], Answer.FAILS),
    ],
)
def test_the_derivative_of_the_energy_by_an_angle(read: list[str], answer: Answer) -> None:
    latex = r"\frac{dE}{d\theta} = 0"
    assert uncorrected(latex, systems.pendulum(), read=read).answer is answer


@pytest.mark.parametrize(
    ("read", "answer"),
    [
        ([], Answer.AMBIGUOUS),
        (["L_dot = seen from the body"], Answer.HOLDS),
        (["L_dot = rate in space"], Answer.FAILS),
    ],
)
def test_dots_beside_a_transport_term(read: list[str], answer: Answer) -> None:
    latex = r"\dot{\mathbf L} + \boldsymbol\omega\times\mathbf L = \boldsymbol\Gamma"
    assert uncorrected(latex, systems.free_body(), read=read).answer is answer


@pytest.mark.parametrize("label", ["rot", "body"])
def test_a_rate_that_names_its_frame(label: str) -> None:
    rate = rf"\left(\frac{{d\mathbf L}}{{dt}}\right)_{{\rm {label}}}"
    latex = rf"{rate} + \boldsymbol\omega\times\mathbf L = 0"
    assert ph.check(latex, systems.free_body()).answer is Answer.HOLDS


# --- initial values ---


@pytest.mark.parametrize(
    "latex",
    [
        r"\dot\theta^2 = \frac{2g}{l}(\cos\theta - \cos\theta_0)",
        r"v^2 = 2gl(\cos\theta - \cos\theta_0)",
        r"T = mg(3\cos\theta - 2\cos\theta_0)",
        r"E = -mgl\cos\theta_0",
    ],
)
def test_a_release_from_rest(latex: str) -> None:
    verdict = ph.check(latex, systems.pendulum())
    assert verdict.answer is Answer.HOLDS
    assert any("start at rest" in remark for remark in verdict.remarks)


def test_a_start_with_a_printed_rate_is_not_at_rest() -> None:
    latex = r"\dot\theta^2 = \dot\theta_0^2 + \frac{2g}{l}(\cos\theta - \cos\theta_0)"
    verdict = ph.check(latex, systems.pendulum())
    assert verdict.answer is Answer.HOLDS
    assert not any("at rest" in remark for remark in verdict.remarks)


@pytest.mark.parametrize(
    ("system", "latex", "answer"),
    [
        (systems.spherical_pendulum, r"\dot\theta^2 = \frac{2g}{l}(\cos\theta - \cos\theta_0)",
         Answer.AMBIGUOUS),
        (systems.spherical_pendulum, r"\dot\theta^2 = \frac gl(\cos\theta - \cos\theta_0)",
         Answer.FAILS),
        # With θ̇ = 0 at the start, and the momentum as it is.
        (systems.spherical_pendulum, r"\dot\theta^2 = \frac{2g}{l}(\cos\theta - \cos\theta_0)"
         r" + \frac{p_\phi^2}{m^2l^4}(\frac1{\sin^2\theta_0} - \frac1{\sin^2\theta})",
         Answer.HOLDS),
        (systems.spherical_pendulum, r"\dot\theta^2 = \frac{2g}{l}(\cos\theta - \cos\theta_0)"
         r" + \frac{p_\phi^2}{2m^2l^4}(\frac1{\sin^2\theta_0} - \frac1{\sin^2\theta})",
         Answer.FAILS),
        (systems.spherical_pendulum, r"v^2 = v_0^2 + 2gl(\cos\theta - \cos\theta_0)", Answer.HOLDS),
        (systems.spherical_pendulum, r"v^2 = v_0^2 - 2gl(\cos\theta - \cos\theta_0)", Answer.FAILS),
        (systems.pendulum, r"v^2 = v_0^2 - 2gl(1-\cos\theta)", Answer.HOLDS),
        (systems.pendulum, r"v^2 = v_0^2 + 2gl(1-\cos\theta)", Answer.UNREAD),
        (systems.pendulum, r"\dot\theta^2 = 2\omega_0^2(\cos\theta - \cos\theta_0)", Answer.HOLDS),
        (systems.pendulum, r"\dot\theta^2 = \omega_0^2(\cos\theta - \cos\theta_0)", Answer.FAILS),
        (systems.physical_pendulum, r"\dot\theta^2 = \omega_0^2"
         r" + \frac{2gh}{h^2+k^2}(\cos\theta - \cos\theta_0)", Answer.HOLDS),
        (systems.physical_pendulum, r"\dot\theta^2 = \omega_0^2"
         r" + \frac{2gh}{h^2-k^2}(\cos\theta - \cos\theta_0)", Answer.FAILS),
        (systems.heavy_top, r"E = E_0", Answer.HOLDS),
        (systems.heavy_top, r"p_\phi = p_{\phi0}", Answer.HOLDS),
        (systems.heavy_top, r"p_\theta = p_{\theta0}", Answer.FAILS),
        (systems.free_body, r"\mathbf L = \mathbf L_0", Answer.HOLDS),
        (systems.free_body, r"\boldsymbol\omega = \boldsymbol\omega_0", Answer.FAILS),
    ],
)  # fmt: skip
def test_what_a_formula_does_not_say_of_the_start_is_not_assumed(
    system: System, latex: str, answer: Answer
) -> None:
    assert uncorrected(latex, system()).answer is answer


def test_energy_is_not_conserved_where_the_wire_is_turned() -> None:
    """Kept turning at ω, a bead conserves its Hamiltonian T_θ - T_ω + V instead."""
    turned = ph.earth(ph.symbol("omega"), colatitude=0).rotated(-ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=systems.m, axes=turned)
    wire = ph.Pivot(bead, at=turned["z"] * systems.R, name="wire", along=turned)
    hinge, gravity = ph.Hinge(bead, axis="y"), ph.Gravity(systems.g)
    hoop = ph.derive(ph.System(wire, hinge, gravity, name="bead on a turning hoop"))
    released = r"\dot\theta^2 = \frac{2g}{R}(\cos\theta - \cos\theta_0)"
    assert uncorrected(released, hoop).answer is Answer.FAILS
    turning = released + r" + \omega^2(\sin^2\theta - \sin^2\theta_0)"
    assert uncorrected(turning, hoop).answer is Answer.HOLDS


def test_a_wrong_release_fails() -> None:
    latex = r"\dot\theta^2 = \frac gl(\cos\theta - \cos\theta_0)"
    assert uncorrected(latex, systems.pendulum()).answer is Answer.FAILS


# --- bad input ---


def test_a_known_letter_is_not_redefined_and_the_error_says_why() -> None:
    with pytest.raises(ph.ParseError, match="E = 5, though E is known as"):
        ph.check("E = 5", systems.pendulum(), let=["E = 5"])


def test_a_given_that_fits_one_reading_only_chooses_it() -> None:
    """**L** = L ẑ makes sense only where the plain L is a length, though it may not be decided."""
    verdict = ph.check(
        r"\dot\phi = \frac{L}{I_3}", systems.free_body(), given=[r"\mathbf L = L\hat{\mathbf z}"]
    )
    assert verdict.answer in (Answer.UNREAD, Answer.FAILS)
    assert "lost hat" not in verdict.reason


@pytest.mark.parametrize(
    "latex",
    [
        r"\frac12 ml^2\dot\theta^2\sin\frac\theta2 = K\left(\sin\frac\theta2\right)",
        r"K(\sin\theta) = \frac12 ml^2\dot\theta^2\sin\theta",
        r"T = 4\sqrt{\frac lg}\,K\left(\sin\frac{\theta_0}{2}\right)",
        r"E\left(\sqrt{1 - k^2}\right) = E\sqrt{1 - k^2}",
        r"\dot\theta F(\theta, \sin\theta) = 0",
    ],
)
def test_an_elliptic_integral_is_no_product(latex: str) -> None:
    """K(sin θ/2) is no kinetic energy times a sine: nothing is judged."""
    answer = ph.check(latex, systems.pendulum()).answer
    assert answer in (Answer.UNREAD, Answer.DEFINITION)


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"Tb = I\alpha", Answer.HOLDS),
        (r"Tb = -I\alpha", Answer.AMBIGUOUS),
        (r"\alpha = -\frac{Mgb}{I + Mb^2}", Answer.AMBIGUOUS),
        (r"Tb = 2I\alpha", Answer.FAILS),
    ],
)
def test_a_sign_that_only_the_declared_axis_explains_is_ambiguous(
    latex: str, answer: Answer
) -> None:
    """A yo-yo's angular acceleration is negative along its axis on every motion."""
    assert uncorrected(latex, systems.yo_yo()).answer is answer
