"""For which lines words hold: equilibria, an effective potential, ≠, and full stops in displays."""

from functools import cache

import pytest

import polhode as ph
from judge import textbook_systems as systems
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

MARKS = {"T": "true", "E": "error", "F": "follows", "?": "unlinked", "!": "needs"}
MARKS["-"] = "not-judged"
MARKS_BY_VALUE = {value: sign for sign, value in MARKS.items()}

# Of a bead on a turning hoop, θ from the bottom: R d²θ/dt² = (ω² R cos θ - g) sin θ.
TEXTS = {
    "equilibria are no assumption": (
        r"Equilibria: \[ \theta = 0 . \] The potential energy is \[ V = -mgR . \]",
        "- !",
    ),
    "an equation of motion is none of equilibrium": (
        r"The equilibria are \[ \sin\theta = 0, \qquad \cos\theta = \frac{g}{\omega^2R} . \]"
        r" The equation of motion is \[ \ddot\theta = 2\sin\theta(\omega^2\cos\theta - g/R) . \]",
        "T T E",
    ),
    "what holds only in equilibrium needs it": (
        r"Equilibrium: $\sin\theta = 0$ or $\cos\theta = \frac{g}{\omega^2R}$."
        r" The potential energy is $V = -m g^2/\omega^2$."
        r" In equilibrium $V = -m g^2/\omega^2$.",
        "T T ! T",
    ),
    "at rest in equilibrium nothing is drawn from a wrong equation of motion": (
        r"The equation of motion is \[ \ddot\theta = \sin\theta(\omega^2\cos\theta + g/R) . \]"
        r" In equilibrium $\ddot\theta = 0$.",
        "E T",
    ),
    "an effective potential by a plain letter": (
        r"The effective potential is \[ U = -mgR\cos\theta - \frac12m\omega^2R^2\sin^2\theta . \]"
        r" Its slope is $\frac{dU}{d\theta} = mgR\sin\theta - m\omega^2R^2\sin\theta\cos\theta$.",
        "T T",
    ),
    "a wrong effective potential": (
        r"With the effective potential $U(\theta) = -mgR\cos\theta - m\omega^2R^2\sin^2\theta$"
        r" the energy is conserved.",
        "E",
    ),
    "a letter named behind it": (
        r"$\frac12mR^2\dot\theta^2 + V = E'$, where $V$ is the effective potential"
        r" \[ V = -mgR\cos\theta - \frac12m\omega^2R^2\sin^2\theta . \]",
        "- T",
    ),
    "sides that are equal are not unequal": (
        r"\[ \ddot\theta \neq \sin\theta(\omega^2\cos\theta - g/R) \] Let $\theta \neq 0$.",
        "E -",
    ),
}


@pytest.mark.parametrize("said", TEXTS)
def test_scope(said: str) -> None:
    text, expected = TEXTS[said]
    lines = ph.review(text, systems.turning_hoop(), seconds=0.0).lines
    assert [blamed(line).value for line in lines] == [MARKS[sign] for sign in expected.split()]


PULLEY = r"""\[ S_1 - m_1 g = m_1R\ddot\alpha \] \[ S_2 - m_2 g = -m_2R\ddot\alpha \]
\[ I\ddot\alpha = R(S_2 - S_1) \] \[ \ddot\alpha = \frac{(m_2-m_1)gR}{I + (m_1 %s m_2)R^2} \]
%s \[ S_1 = \frac{m_1g(I + 2m_2R^2)}{I + (m_1+m_2)R^2} \]"""
WRONG = r"\[ S_2 = m_2g + m_2\frac{(m_2-m_1)gR^2}{I + (m_1+m_2)R^2} \]"


@cache
def after_slip(sign: str, between: str) -> list[str]:
    lines = ph.review(PULLEY % (sign, between), systems.pulley(), seconds=0.0).lines
    return [blamed(line).value for line in lines]


CHAIN = r"""\[ S_1 - m_1 g = m_1R\ddot\alpha, \quad S_2 - m_2 g = -m_2R\ddot\alpha \]
\[ a = R\ddot\alpha = \frac{(m_2-m_1)gR^2}{I + (m_1-m_2)R^2} \]
\[ S_1 = m_1(g+a) = %s \]"""


@pytest.mark.parametrize(
    ("value", "mark"),
    [
        (r"\frac{m_1gI}{I + (m_1-m_2)R^2}", "follows"),
        (r"\frac{2m_1gI}{I + (m_1-m_2)R^2}", "error"),  # a slip of its own
    ],
)
def test_what_is_right_of_a_chain_draws_the_rest_from_a_wrong_line(value: str, mark: str) -> None:
    """And a is the acceleration for which the first equation of the wrong chain holds."""
    lines = ph.review(CHAIN % value, systems.pulley(), seconds=0.0).lines
    assert [blamed(line).value for line in lines] == ["true", "true", "error", mark]
    assert lines[2].reason.startswith("the sides differ in member 2")


# Lines in the styles of texts, each with a slip that is carried on.
CARRIED = {
    "a chain is gone on with by its first and last side": (
        "wedge",
        r"\[ T = \tfrac12M\dot X_w^2 + \tfrac12m[(\dot X_w + \dot s_b\cos\alpha)^2"
        r" + \dot s_b^2\sin^2\alpha] = \tfrac12(M+m)\dot X_w^2 + m\dot X_w\dot s_b\sin\alpha"
        r" + \tfrac12m\dot s_b^2 \]"
        r"\[ (M+m)\ddot X_w + m\ddot s_b\sin\alpha = 0, \quad"
        r" \ddot s_b + \ddot X_w\sin\alpha = g\sin\alpha \]",
        "E F F",
    ),
    "a sense that a line chooses is a fact": (
        "yo_yo",
        r"$M\ddot z = T - Mg$, $I\ddot\theta = bT$, $\dot z = -b\dot\theta$."
        r" Hence $\ddot\theta = \frac{Mgb}{I-Mb^2}$ and $T = \frac{MgI}{I-Mb^2}$.",
        "T - T E F",
    ),
    "a wrong line put into the linear part of a true one": (
        "cart",
        r"\[ (m_1+m_2)\ddot x + m_2l\ddot\phi\cos\phi - m_2l\dot\phi^2\sin\phi = 0, \quad"
        r" l\ddot\phi + \ddot x\cos\phi + g\sin\phi = 0 \]"
        r" For small oscillations $\ddot x = -\frac{m_2l}{m_1-m_2}\ddot\phi$, hence"
        r" \[ \ddot\phi = -\frac{m_1-m_2}{m_1-2m_2}\frac gl\phi . \]",
        "T T E F",
    ),
    "a circular orbit is a steady motion": (
        "planet",
        r"\[ m\ddot r = mr\dot\phi^2 - \frac{k}{r^2} \] For a circular orbit $\ddot r = 0$ and"
        r" \[ \dot\phi^2 = \frac{k}{mr^3}, \qquad \dot\phi^2 = \frac{2k}{mr^3} . \]",
        "T T T E",
    ),
    "links of a chain that hold in contexts of their own": (
        "turning_hoop",
        r"With $R = 0.10$ m, $g = 9.81$ m/s$^2$ and $\omega = 12$ rad/s the equilibrium is given by"
        r" $\cos\theta = \frac{g}{\omega^2R} = 0.68$, and not by"
        r" $\cos\theta = \frac{g}{\omega^2R} = 0.86$.",
        "- - - T E",
    ),
    "a number from a wrong one": (
        "yo_yo",
        r"With $M = 60$ g, $b = 5.0$ mm, $I = 3.0\times 10^{-5}$ kg m$^2$ and $g = 9.81$ m/s$^2$"
        r" \[ -\ddot z = \frac{g}{1 + I/(Mb^2)} = 4.67\ \mathrm{m/s^2} . \] Hence"
        r" \[ T = M(g + \ddot z) = 0.308\,\mathrm{N} , \] and not"
        r" \[ T = M(g + \ddot z) = 0.318\,\mathrm{N} . \]",
        "- - - - E F E",
    ),
    "in steady motion by a true line": (
        "string_through_a_hole",
        r"$M\ddot r = T - Mg$ gives $T = \frac{mM}{m+M}(g - r\dot\phi^2)$."
        r" In steady motion $T = Mg$.",
        "T E T",
    ),
    "a wrong torque stands in the equation of motion, with the moment that words have chosen": (
        "rod_pendulum",
        r"Let $I = \frac13ML^2$ be the moment of inertia about the pivot. The torque of gravity is"
        r" $\tau = -MgL\sin\theta$, so $I\ddot\theta = -MgL\sin\theta$, and not"
        r" $I\ddot\theta = -\frac13MgL\sin\theta$. For small angles"
        r" \[ \ddot\theta + \frac{3g}{L}\theta = 0 . \]",
        "T E F E F",
    ),
    "conical motion is steady": (
        "spherical_pendulum",
        r"\[ \ddot\theta = \dot\phi^2\sin\theta\cos\theta + \frac gl\sin\theta \]"
        r" In a conical motion \[ \dot\phi^2 = -\frac{g}{l\cos\theta} . \]"
        r" It should be \[ \dot\phi^2 = \frac{g}{l\cos\theta} . \]",
        "E F T",
    ),
    "numbers are no multiples of one another": (
        "turning_hoop",
        r"With $R = 0.10$ m and $g = 9.81$ m/s$^2$, for small $\theta$ the critical value is"
        r" $\sqrt{g/R} = 8.9$ s$^{-1}$. With $\omega = 12$ rad/s"
        r" \[ \frac{g}{\omega^2R} = 0.86 . \]",
        "- - E - E",
    ),
}


@pytest.mark.parametrize("said", CARRIED)
def test_slips_carried_on(said: str) -> None:
    name, text, expected = CARRIED[said]
    lines = ph.review(text, getattr(systems, name)(), seconds=0.0).lines
    assert [blamed(line).value for line in lines] == [MARKS[sign] for sign in expected.split()]


@pytest.mark.parametrize("verb", ["demands", "requires", "calls for"])
@pytest.mark.parametrize(("value", "mark"), [("3a", ph.Mark.TRUE), ("4a", ph.Mark.ERROR)])
def test_what_stability_demands_is_its_condition(verb, value, mark):
    said = r"A disk is upright at $\theta = \pi/2$. Rolling straight on, $\dot\phi = 0$, stability"
    text = rf"{said} {verb} \[ \omega_3^2 > \frac{{g}}{{{value}}}. \]"
    found = ph.review(text, ph.derive(PROBLEM_SET["rolling-disk"].build()), seconds=0.0).lines
    assert blamed(found[-1]) is mark


def test_a_formula_behind_words_with_for_is_no_condition():
    text = r"""Euler's equations for a free body are \begin{align}
    I_1\dot\omega_1 &= (I_2-I_3)\omega_2\omega_3,\\
    I_2\dot\omega_2 &= (I_1-I_3)\omega_3\omega_1. \end{align}
    About axis 3, $\omega_3\approx\Omega$, with small $\omega_1,\omega_2$,
    \[ \ddot\omega_1 \approx \frac{(I_2-I_3)(I_3-I_1)}{I_1I_2}\Omega^2\omega_1 . \]"""
    found = ph.review(text, ph.derive(PROBLEM_SET["tennis-racquet"].build()), seconds=0.0).lines
    assert [MARKS_BY_VALUE[blamed(line).value] for line in found] == list("TE-T")
