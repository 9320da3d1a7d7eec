"""Poisson brackets, by their algebra and by the motion: df/dt = {f, H}."""

from __future__ import annotations

import pytest

from catalogue.systems import equations
from judge import textbook_systems as systems
from judge.judged import uncorrected
from polhode.judge import Answer
from polhode.judge.latex import read_latex, write_latex

HOLDS, FAILS, AMBIGUOUS = Answer.HOLDS, Answer.FAILS, Answer.AMBIGUOUS


@pytest.mark.parametrize(
    ("system", "latex", "answer"),
    [
        ("pendulum", r"\{\theta, p_\theta\} = 1", HOLDS),
        ("pendulum", r"\{\theta, p_\theta\} = 2", FAILS),
        ("pendulum", r"\{p_\theta, H\} = -mgl\sin\theta", HOLDS),
        ("pendulum", r"\{p_\theta, H\} = -mgl\cos\theta", FAILS),
        ("pendulum", r"\dot\theta = \left[\theta, H\right]", HOLDS),
        ("spherical_pendulum", r"\{L_x, L_y\} = L_z", HOLDS),
        ("spherical_pendulum", r"\{L_y, L_z\} = L_x", HOLDS),
        ("spherical_pendulum", r"\{L_x, L_y\} = 2L_z", FAILS),
        ("spherical_pendulum", r"\{L_x, L_y\} = L_x", FAILS),
        ("spherical_pendulum", r"\{L_z, H\} = 0", HOLDS),
        ("spherical_pendulum", r"\{L_x, H\} = 0", FAILS),
        ("spherical_pendulum", r"\dot L_x = \{L_x, H\}", HOLDS),
        ("spherical_pendulum", r"\{q_i, q_j\} = 0", HOLDS),
        ("spherical_pendulum", r"\{\phi, p_\theta\} = 1", FAILS),
        ("spherical_pendulum", r"\{L_x, \{L_y, L_z\}\} + \{L_y, \{L_z, L_x\}\} = 0", HOLDS),
        # The opposite sign is that of Landau and Lifshitz, § 42.
        ("spherical_pendulum", r"\{L_x, L_y\} = -L_z", AMBIGUOUS),
        ("pendulum", r"\{H, \theta\} = \dot\theta", AMBIGUOUS),
    ],
)
def test_a_bracket_is_what_it_is_by_definition(system: str, latex: str, answer: Answer) -> None:
    verdict = uncorrected(latex, getattr(systems, system)())
    assert verdict.answer is answer, verdict.reason


def test_the_sign_is_chosen_for_all_brackets() -> None:
    model = systems.spherical_pendulum()
    for way, answer in (("df/dq", FAILS), ("df/dp", HOLDS)):
        sign = {"df/dq": "(df/dp)(dg/dq)", "df/dp": "(df/dq)(dg/dp)"}[way]
        other = {"df/dq": "(df/dq)(dg/dp)", "df/dp": "(df/dp)(dg/dq)"}[way]
        chosen = f"bracket = sum of {other} - {sign}"
        found = uncorrected(r"\{L_x, L_y\} = -L_z", model, read=[chosen])
        assert found.answer is answer
        assert found.readings[0].letter == r"\mathrm{bracket}" or len(found.readings) > 1


@pytest.mark.parametrize(
    ("latex", "why"),
    [
        (r"\{\theta, F_z\} = 0", "Poisson bracket with F_z"),
        (r"[p_\theta, H] = 0", "two quantities in square brackets that equal 0"),
        (r"\{\theta, \ddot\theta\} = 0", "Poisson bracket with theta_ddot"),
    ],
)
def test_what_is_no_bracket_says_why(latex: str, why: str) -> None:
    verdict = uncorrected(latex, systems.pendulum())
    assert verdict.answer is Answer.UNREAD
    assert why in verdict.reason


def test_rolling_bodies_have_no_brackets() -> None:
    verdict = uncorrected(r"\{\theta, p_\theta\} = 1", equations("rolling-disk"))
    assert verdict.answer is Answer.UNREAD
    assert "a Poisson bracket: the conjugate momenta" in verdict.reason


@pytest.mark.parametrize("latex", [r"\{q, p\} = 1", r"[q, p] = \{q, p\}", r"[a, b] = [c, d]"])
def test_brackets_are_written_as_they_are_read(latex: str) -> None:
    read = read_latex(latex)
    assert read_latex(write_latex(read)) == read
