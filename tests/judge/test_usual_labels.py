"""Energies, forces and the centre of mass by the labels that students and textbooks print.

KE, E_k, K_rot, U_g, v_CM, F_net: Young and Freedman, University Physics; Kleppner and Kolenkow, An
Introduction to Mechanics; Demtröder, Experimentalphysik 1 (E_kin, E_pot).
"""

from functools import cache

import pytest

import polhode as ph
from judge import textbook_systems
from judge.judged import uncorrected
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer


@cache
def disk() -> ph.Equations:
    return ph.derive(PROBLEM_SET["rolling-disk"].build())


@cache
def weight_on_a_spring() -> ph.Equations:
    """Of two potential energies: each has labels of its own."""
    m, k, g = ph.symbols("m k g", positive=True)
    lab = ph.Frame("lab")
    weight = ph.point_mass("weight", mass=m, axes=lab)
    guide = ph.Pivot(weight, only="x y", name="guide", force="N")
    spring = ph.Spring(weight.point(), lab.zero, stiffness=k)
    return ph.derive(ph.System(guide, spring, ph.Gravity(g), name="weight on a spring"))


KINETIC = r"\frac{ma^2}{8}(6\omega_3^2 + 5\dot\theta^2 + \dot\phi^2\sin^2\theta)"
TRANSLATION = r"\frac{ma^2}{2}(\omega_3^2 + \dot\theta^2)"
ROTATION = r"\frac{ma^2}{8}(2\omega_3^2 + \dot\theta^2 + \dot\phi^2\sin^2\theta)"
VALUES = {
    KINETIC: ["E_k", "E_K", r"E_{\rm kin}", "KE", r"T_{\text{kin}}"],
    TRANSLATION: [r"T_{\text{trans}}", r"K_{\rm tr}", r"KE_{\rm trans}", r"T_{\rm CM}"],
    ROTATION: [r"K_{\text{rot}}", r"E_{\rm rot}", r"T_{rot}"],
    r"mga\sin\theta": ["E_p", r"E_{\rm pot}", "PE", "U_g", r"V_{\rm grav}", r"U_{\rm pot}"],
    rf"{KINETIC} + mga\sin\theta": [r"E_{\rm tot}", r"E_{\text{mech}}", r"E_{\text{total}}"],
}
LABELLED = [(letter, value) for value, letters in VALUES.items() for letter in letters]


@pytest.mark.parametrize(("letter", "value"), LABELLED)
def test_a_labelled_energy_is_judged(letter: str, value: str) -> None:
    assert uncorrected(f"{letter} = {value}", disk()).answer is Answer.HOLDS
    slip = value.replace(r"mga\sin", r"mga\cos").replace(r"\dot\theta^2", r"2\dot\theta^2")
    assert uncorrected(f"{letter} = {slip}", disk()).answer is Answer.FAILS


HOLD = [
    r"E_{\rm tot} = E_k + E_p",
    r"E_k = \frac12 m v_{\rm CM}^2 + E_{\rm rot}",
    r"KE + PE = \text{const}",
    r"PE = mga(\sin\theta - 1)",  # counted from another level
    r"\mathbf F_{\rm net} = m\mathbf a_{\rm CM}",
    r"\mathbf F_g + \mathbf F = m\mathbf a_{\rm c.m.}",
    r"\boldsymbol\tau_{\rm net} = \frac{d\mathbf L_{\rm com}}{dt}",
    r"E_i = E_f",
    r"KE_i + PE_i = KE_f + PE_f",
    r"E_{k,i} + E_{p,i} = E_{k,f} + E_{p,f}",
    r"F_N = F_z",
    r"\sum F_z = F_N - mg",
    r"\sum\boldsymbol\tau = \frac{d\mathbf L_{\rm cm}}{dt}",
    r"v_{\rm CM}^2 = a^2(\omega_3^2 + \dot\theta^2)",
]
FAIL = [
    r"E_{\rm tot} = E_k - E_p",
    r"E_k = m v_{\rm CM}^2 + E_{\rm rot}",
    r"KE - PE = \text{const}",
    r"PE = mga(\cos\theta - 1)",
    r"\mathbf F_{\rm net} = 2m\mathbf a_{\rm CM}",
    r"\mathbf F_g - \mathbf F = m\mathbf a_{\rm c.m.}",
    r"\boldsymbol\tau_{\rm net} = 2\frac{d\mathbf L_{\rm com}}{dt}",
    r"KE_i - PE_i = KE_f - PE_f",
    r"\mathbf L_i = \mathbf L_f",
    r"F_N = 2F_z",
    r"\sum F_z = F_N + mg",
    r"\sum\boldsymbol\tau = 2\frac{d\mathbf L_{\rm cm}}{dt}",
    r"v_{\rm CM}^2 = a^2(\omega_3^2 + 2\dot\theta^2)",
    r"F_g = 2mg",
]


@pytest.mark.parametrize("latex", HOLD)
def test_labels_in_laws_hold(latex: str) -> None:
    assert uncorrected(latex, disk()).answer is Answer.HOLDS


@pytest.mark.parametrize("latex", FAIL)
def test_their_slips_fail(latex: str) -> None:
    assert uncorrected(latex, disk()).answer is Answer.FAILS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"U_g = mgz", Answer.HOLDS),
        (r"U_g = mg(z - z_0)", Answer.HOLDS),
        (r"U_{\rm el} = \frac12 kz^2", Answer.HOLDS),
        (r"E_p = mgz + \frac12 kz^2", Answer.HOLDS),
        (r"EPE + GPE = E_{\rm pot}", Answer.HOLDS),
        (r"U_g = mgz + \frac12 kz^2", Answer.FAILS),
        (r"U_{\rm el} = kz^2", Answer.FAILS),
        (r"E_p = mgz", Answer.FAILS),
    ],
)
def test_gravity_and_spring_have_an_energy_each(latex: str, answer: Answer) -> None:
    assert uncorrected(latex, weight_on_a_spring()).answer is answer


def test_a_sum_over_several_bodies_has_to_say_of_which() -> None:
    verdict = uncorrected(r"\sum F_z = 0", textbook_systems.beads())
    assert verdict.answer is Answer.UNREAD


def test_a_text_may_define_such_a_letter() -> None:
    own = {"let": [r"E_k = \frac12 I_3\omega_3^2"]}
    assert uncorrected(r"E_k = \frac{ma^2}{4}\omega_3^2", disk(), **own).answer is Answer.HOLDS
