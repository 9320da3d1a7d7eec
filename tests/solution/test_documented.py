"""Worked solutions of the systems that the documents declare, against what is known of each."""

import runpy
from pathlib import Path

import pytest

import polhode as ph
from solution.letters import undefined_letters

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs/examples/solutions"

#: What textbooks say of them, as claims about the declared systems.
KNOWN = {
    "spherical_pendulum": (r"\ddot\theta = \dot\phi^2\sin\theta\cos\theta + \frac gl\sin\theta",),
    "physical_pendulum": (r"\ddot\theta = -\frac{m g l}{I_2 + m l^2}\sin\theta",),
    "foucault_pendulum": (  # the energy in axes that turn with the Earth
        r"\frac{d}{dt}\left(\frac{m l^2}{2}(\dot\beta^2 + \dot\alpha^2\cos^2\beta)"
        r" - \frac{m l^2\Omega^2}{2}(1 - \cos^2\beta\cos^2(\lambda + \alpha))"
        r" - m g l\cos\alpha\cos\beta\right) = 0",
    ),
    "double_pendulum": (
        r"(m_1 + m_2) l_1\ddot\alpha + m_2 l_2\ddot\beta\cos(\alpha - \beta)"
        r" + m_2 l_2\dot\beta^2\sin(\alpha - \beta) + (m_1 + m_2) g\sin\alpha = 0",
    ),
    "chaplygin_sleigh": (r"\dot v = a\omega^2", r"(I + m a^2)\dot\omega = -m a v\omega"),
    "sliding_ladder": (r"\ddot\theta = \frac{3g}{4l}\sin\theta",),
    "bead_on_hoop": (r"\ddot\theta = \Omega^2\sin\theta\cos\theta - \frac ga\sin\theta",),
    "top_with_friction": (),
    "two_wheeled_axle": (r"\ddot\phi = 0",),
    "ball_in_bowl": (
        r"\frac75\left(\ddot\theta - \dot\phi^2\sin\theta\cos\theta\right)(R - a) = "
        r"\frac25 a\omega_3\dot\phi\sin\theta - g\sin\theta",
    ),
    "gimballed_gyroscope": (
        r"(I_1 + A)\ddot\theta + I_3\omega_{3,r}\dot\phi\sin\theta = "
        r"(I_1 + B - C)\dot\phi^2\sin\theta\cos\theta",
    ),
}


@pytest.fixture(scope="module", params=KNOWN)
def derived(request):
    system = runpy.run_path(str(FOLDER / f"{request.param}.py"))[request.param]
    return request.param, ph.derive(system)


def test_every_declared_system_is_known():
    assert {file.stem for file in FOLDER.glob("*.py")} == {*KNOWN, "bicycle"}


def test_the_page_names_every_system():
    page = (ROOT / "docs/solved-systems.md").read_text("utf-8")
    for name in (*KNOWN, "bicycle"):
        assert f"(solutions/{name}.html)" in page
        assert f"(examples/solutions/{name}.py)" in page


def test_they_are_solved_and_obey_what_is_known(derived):
    name, equations = derived
    for claim in KNOWN[name]:
        verdict = ph.check(claim, equations)
        assert verdict.answer.value == "holds", verdict
    found = ph.solution(equations)
    assert found.judged > 5
    assert found.figure
    assert undefined_letters(found) == {}
    assert "Equations of motion" in found.sections


#: What a document has to say in words.
SAID = {
    "foucault_pendulum": (r"at the rate $-\Omega \cos\lambda$",),
    "bead_on_hoop": (r"at the angular frequency $\Omega \left|\sin\theta\right|$",),
    "double_pendulum": ("Small departures do not grow.",),
}


@pytest.mark.parametrize("name", SAID)
def test_what_a_reader_looks_for_is_said(name):
    found = ph.solution(runpy.run_path(str(FOLDER / f"{name}.py"))[name])
    words = " ".join(step.words for step in found.steps)
    assert all(phrase in words for phrase in SAID[name])
