"""Lines as students and lecturers write them, in systems of textbooks: what words around them say.

The marks were fixed by hand.
"""

import pytest

import polhode as ph
from judge import textbook_systems as systems
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

MARKS = {
    "T": ph.Mark.TRUE,
    "E": ph.Mark.ERROR,
    "F": ph.Mark.FOLLOWS,
    "N": ph.Mark.NEEDS,
    "-": ph.Mark.NOT_JUDGED,
}
#: A system, a text about it, and the mark of each line.
TEXTS = {
    "released from rest at a value": (
        "rod_pendulum",
        r"The rod starts from rest at $\theta = \pi/2$. Then $\frac16ML^2\dot\theta^2 ="
        r" \frac12MgL\cos\theta$, but not $\frac16ML^2\dot\theta^2 = MgL\cos\theta$.",
        "- T E",
    ),
    "released from rest at a letter": (
        "gyroscope",
        r"Released from rest at $\theta_1$, so"
        r" $(I_2+Ma^2)\dot\phi\sin^2\theta = I_1\omega_1(\cos\theta_1-\cos\theta)$ and not"
        r" $(I_2+Ma^2)\dot\phi\sin^2\theta = 2I_1\omega_1(\cos\theta_1-\cos\theta)$.",
        "T E",
    ),
    "nearly at rest in equilibrium": (
        "ladder",
        r"Starting from (almost) rest at $\theta = 0$:"
        r" \[ \tfrac23ml^2\dot\theta^2 = mgl(1-\cos\theta) \] and wrong by a factor,"
        r" \[ \tfrac23ml^2\dot\theta^2 = 2mgl(1-\cos\theta) \]",
        "- T E",
    ),
    "about which point": (
        "rod_pendulum",
        r"The moment of inertia about the end is $I = 1/3 M L^2$ and about the centre of mass"
        r" $I = 1/12 M L^2$.",
        "T T",
    ),
    "a frequency, not a rate": (
        "rod_pendulum",
        r"For small oscillations: $\omega = \sqrt{3g/2L}$. Small oscillations have"
        r" $\omega = \sqrt{3g/L}$.",
        "T E",
    ),
    "constants of the catalogue": (
        "gyrocompass",
        r"For a hoop $I_1 = \frac12ma^2$ and $I_3 = ma^2$, so"
        r" $I_1\ddot\theta + I_3\omega\Omega\sin\lambda\sin\theta = 0$.",
        "- - E",
    ),
    "thresholds of stability": (
        "spinning-coin",
        r"On edge, $\theta = \pi/2$. With $\omega_3=0$ this is stable if $\dot\phi > 2\sqrt{g/a}$."
        r" It is unstable if $\dot\phi < 2\sqrt{g/a}$. With $\omega_3=0$ stability requires"
        r" $\dot\phi > \sqrt{2g/a}$. It is stable for $a > b$.",
        "- - T T - E -",
    ),
    "a threshold at an angle that is not said": (
        "rolling-disk",
        r"Straight rolling is stable if $\omega_3 > \sqrt{g/3a}$, or stable for"
        r" $\omega_3 > \sqrt{g/2a}$.",
        "N -",
    ),
    "a threshold at a singular angle": (
        "heavy_top",
        r"A sleeping top ($\theta = 0$) is stable if $I_3^2\omega_3^2 > 4MglI_1$.",
        "- -",
    ),
    "linearized": (
        "beads",
        r"Linearize: $l_2\ddot\theta_2 + l_1\ddot\theta_1 + g\theta_2 = 0$. For small oscillations"
        r" $l_2\ddot\theta_2 + l_1\ddot\theta_1 - g\theta_2 = 0$.",
        "T E",
    ),
    "a departure that is not said to be small": (
        "spinning-coin",
        r"Let $\theta = \pi/2+\epsilon$. With $\omega_3=0$ we find"
        r" $\ddot\epsilon = -(\dot\phi^2 - 4g/a)\epsilon$ and not"
        r" $\ddot\epsilon = -(\dot\phi^2 - 2g/a)\epsilon$.",
        "- - N E",
    ),
    "a departure to first order": (
        "rolling-disk",
        r"Let $\theta = \pi/2 + \epsilon$, and keep first order. Then"
        r" $\ddot\phi = 2\omega_3\dot\epsilon$, not $\ddot\phi = \omega_3\dot\epsilon$.",
        "- T E",
    ),
    "a letter defined behind the line": (
        "marble-on-turntable",
        r"No slipping: $\vec v + \vec\omega\times\vec a = \vec\Omega\times\vec r$ with"
        r" $\vec a = -a\hat z$.",
        "T T",
    ),
    "a number defined behind the line": (
        "cylinder_on_a_slope",
        r"The acceleration is $a = k g\sin\alpha$, where $k = 2/3$. It is not"
        r" $a = c g\sin\alpha$, where $c = 1/3$.",
        "T - E -",
    ),
    "an angle counted the other way": (
        "yo_yo",
        r"$M\ddot z = T - Mg$, $I\ddot\theta = bT$, $\ddot z = -b\ddot\theta$, so"
        r" $\ddot\theta = \frac{Mgb}{I+Mb^2}$, not $\ddot\theta = -\frac{Mgb}{I+Mb^2}$.",
        "T - T T E",
    ),
    "an angle in space has one sense": (
        "heavy_top",
        r"$\omega_3 = \dot\psi - \dot\phi\cos\theta$",
        "E",
    ),
    "a start in equilibrium says nothing": (
        "ladder",
        r"It starts from rest at $\theta = 0$ we have (1). Then $\ddot x = 0$.",
        "- E",
    ),
    "a number between quantities that vary": (
        "rod_pendulum",
        r"For $g = 10$ we have $\theta = \theta - \frac{\pi}{2}$.",
        "- E",
    ),
    "carried on in steady motion": (
        "gyroscope",
        r"$V = -Mga\cos\theta$. In steady motion"
        r" $(I_2+Ma^2)\dot\phi^2\cos\theta - I_1\omega_1\dot\phi - Mga = 0$, and so"
        r" $\dot\phi = \frac{I_1\omega_1 \pm\sqrt{I_1^2\omega_1^2 +"
        r" 4(I_2+Ma^2)Mga\cos\theta}}{2(I_2+Ma^2)\cos\theta}$ and not"
        r" $(I_2+Ma^2)\dot\phi^2\cos\theta - 2I_1\omega_1\dot\phi - Mga = 0$.",
        "E F F E",
    ),
    "an arrow in the formula": (
        "rod_pendulum",
        r"$\Rightarrow \ddot\theta = -\frac{g}{L}\sin\theta$",
        "E",
    ),
    "signs that keyboards have": (
        "rod_pendulum",
        "For $θ = 90°$ we have $\\ddotθ = -3g/2L$. The kinetic energy is $T = ½·⅓ML^2\\dotθ^2$.",
        "- T T",
    ),
}


def equations(name: str) -> ph.Equations:
    if name in PROBLEM_SET:
        return ph.derive(PROBLEM_SET[name].build())
    found: ph.Equations = getattr(systems, name)()
    return found


@pytest.mark.parametrize("said", TEXTS)
def test_words_and_signs_of_students(said: str) -> None:
    system, text, expected = TEXTS[said]
    lines = ph.review(text, equations(system), format=".md", seconds=0.0).lines
    found = [blamed(line) for line in lines]
    assert found == [MARKS[sign] for sign in expected.split()], [str(line) for line in lines]


def test_conditions_hold_for_their_sentence_in_typst() -> None:
    text = "For a solid sphere $I = 2/5 m a^2$ so $dot(v)_x = -2/7 Omega v_y$."
    lines = ph.review(text, equations("marble-on-turntable"), format=".typ", seconds=0.0).lines
    assert [blamed(line) for line in lines] == [ph.Mark.NOT_JUDGED, ph.Mark.TRUE]
