"""Solutions with distances: every law is written out, with a letter that is defined."""

import polhode as ph
from literature.published_forms import FORMS


def test_two_masses_on_a_spring_are_written_out():
    found = ph.solution(FORMS["two masses on a spring"].build())
    assert "short form" not in " ".join(step.words for step in found.steps)
    formulas = [step.latex for step in found.steps if step.latex]
    assert (
        formulas.count(
            r"\rho = \sqrt{\left(x_1 - x_2\right)^2 + \left(y_1 - y_2\right)^2"
            r" + \left(z_1 - z_2\right)^2}"
        )
        == 1
    )
    assert (
        r"M \ddot{x}_1 = -\frac{k \left(\rho - l\right) \left(x_1 - x_2\right)}{\rho}" in formulas
    )


def test_coupled_pendulums_are_written_out():
    found = ph.solution(FORMS["coupled pendulums"].build())
    formulas = [step.latex for step in found.steps if step.latex]
    assert (
        r"V = \frac{k \left(\rho - a\right)^2}{2}"
        r" - m g l \left(\cos\theta_1 + \cos\theta_2\right)"
    ) in formulas
    assert (
        r"m l^2 \ddot{\theta}_2 = \frac{k l \left(a \cos\theta_2 + l \sin\left(\theta_1 -"
        r" \theta_2\right)\right) \left(\rho - a\right)}{\rho} - m g l \sin\theta_2"
    ) in formulas


def test_newtons_law_has_the_force_of_the_spring():
    found = ph.solution(FORMS["coupled pendulums"].build(), "newton")
    law = next(step for step in found.steps if step.words.startswith("On the bob 1 act"))
    assert r"\frac{k \left(\rho - a\right)}{\rho}" in law.latex
