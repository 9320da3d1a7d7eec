"""Lines as students write them, each with the verdict that the mechanics gives it.

Compound pendulum from rest: ½Iθ̇² = mgl(cos θ - cos θ₀). Ladder: it leaves the wall at
cos θ = ⅔ cos θ₀ (Timoshenko and Young, Advanced Dynamics). Upright disk: ω₃² > g/3a. Symmetric free
body: Landau and Lifshitz, Mechanics, § 36.
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer

EXAMPLES = Path(__file__).parents[2] / "docs/examples/solutions"
TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
OPEN = ph.Mark.NOT_JUDGED

SWING = r"""Let $I=I_2+ml^2$. It is released from rest at $\theta_0$.
Energy: $\frac12 I\dot\theta^2 = %s mgl(\cos\theta-\cos\theta_0)$.
At the bottom $\dot\theta^2 = \frac{%s mgl}{I}(1-\cos\theta_0)$."""
LADDER = r"""Energy from rest at $\theta_0$: $\frac23 l\dot\theta^2 = g(\cos\theta_0-\cos\theta)$.
%s $\cos\theta=\frac23\cos\theta_0$. Then $\dot\theta^2=\frac{g\cos\theta_0}{2l}$."""
FREE = r"""With $I_1=I_2$, $\dot\omega_1 = \frac{I_1-I_3}{I_1}\omega_3\omega_2$.
Thus $\ddot\omega_1 = %s\Gamma^2\omega_1$ with $\Gamma = \frac{I_3-I_1}{I_1}\omega_3$."""


@cache
def system(name: str) -> ph.Equations:
    if name in PROBLEM_SET:
        return ph.derive(PROBLEM_SET[name].build())
    return ph.derive(runpy.run_path(str(EXAMPLES / f"{name}.py"))[name])


def marks(text: str, name: str) -> list[ph.Mark]:
    return [blamed(line) for line in ph.review(text, system(name), seconds=0.0).lines]


@pytest.mark.parametrize(
    "words",
    ["It leaves the wall when", "Contact with the wall is lost when", "It loses contact at"],
)
def test_what_is_said_of_the_end_of_a_contact_is_no_line_of_its_own(words):
    assert marks(LADDER % words, "sliding_ladder") == [TRUE, TRUE, OPEN]


@pytest.mark.parametrize(("sign", "mark"), [("-", TRUE), ("", ERROR)])
def test_a_letter_defined_behind_a_line_is_none_of_the_field(sign, mark):
    assert marks(FREE % sign, "tennis-racquet") == [OPEN, TRUE, mark, OPEN]


@pytest.mark.parametrize(("bound", "mark"), [("3", TRUE), ("2", ERROR)])
def test_a_disk_that_rolls_upright_stands_at_a_right_angle(bound, mark):
    limit = rf"\frac{{g}}{{{bound}a}}"
    text = rf"Rolling upright in a straight line, stability requires $\omega_3^2 > {limit}$."
    assert marks(text, "rolling-disk") == [mark]


def test_a_sine_of_what_has_a_dimension_is_refused_before_it_is_worked_out():
    found = ph.check(r"\cos\alpha = \frac{I_3\omega_3}{L}", system("tennis-racquet"), seconds=5)
    assert found.answer is Answer.UNREAD
    assert "does not fit" in found.reason
    odd = ph.check(r"\sin\omega_3 = 1", system("tennis-racquet"))
    assert "terms of different dimensions: 1 and 1/s" in odd.reason


FALL = r"""The body stands upright and falls from rest.
$\frac12(I_2+ml^2)\dot\theta^2 = mgl(%s+\cos\theta)$,
so $\dot\theta = \sqrt{\frac{2mgl(1+\cos\theta)}{I_2+ml^2}}$."""


@pytest.mark.parametrize(("constant", "marked"), [("1", TRUE), ("2", ERROR)])
def test_a_fall_from_upright_starts_where_the_potential_energy_is_greatest(constant, marked):
    energy, speed = ph.review(FALL % constant, system("physical_pendulum"), seconds=0.0).lines
    assert blamed(energy) is marked
    assert blamed(speed) is ph.Mark.NEEDS
    assert "theta} > 0" in speed.needs


@cache
def planet() -> ph.Equations:
    m, k = ph.symbols("m k", positive=True)
    r, phi = ph.coordinates("r phi")
    lab = ph.Frame("lab")
    body = ph.point_mass("planet", mass=m, axes=lab)
    arm = ph.Pivot(body, to=lab.rotated(phi, "z", labels="r f z")["r"] * r, name="arm")
    return ph.derive(ph.System(arm, ph.Potential(-k / r, on=body), name="planet"))


@pytest.mark.parametrize(("sign", "mark"), [("+", TRUE), ("-", ERROR)])
def test_a_constant_radius_is_not_small_where_its_disturbance_is(sign, mark):
    text = r"""A circular orbit of radius $r_0$ has $\dot\phi^2=\frac{k}{mr_0^3}$.
    For a small disturbance $r=r_0+\eta$: $\ddot\eta %s \frac{k}{mr_0^3}\eta=0$."""
    found = ph.review(text % sign, planet(), seconds=0.0).lines
    assert [blamed(line) for line in found] == [TRUE, OPEN, mark]


AXES = r"""The body spins about axis 3: $\omega_3=\Omega$ with small $\omega_1$ and $\omega_2$.
To first order $\ddot\omega_1 = -\frac{(I_3-I_1)(I_3-I_2)}{I_1I_2}\Omega^2\omega_1$.
About axis 1, $\ddot\omega_2 = %s\frac{(I_2-I_1)(I_3-I_1)}{I_2I_3}\omega_1^2\omega_2$ for
small $\omega_2,\omega_3$."""


@pytest.mark.parametrize(("sign", "mark"), [("-", TRUE), ("", ERROR)])
def test_what_is_small_in_the_sentence_itself_counts_about_another_axis(sign, mark):
    assert marks(AXES % sign, "tennis-racquet") == [OPEN, TRUE, mark]


def test_the_speed_of_an_end_is_a_letter_of_the_text():
    text = r"The speed of its end is $v = 2l\dot\theta$ and $v^2 = %s l^2\dot\theta^2$."
    assert marks(text % "4", "physical_pendulum") == [OPEN, TRUE]
    assert marks(text % "3", "physical_pendulum") == [OPEN, ERROR]


ORDER = r"""%s $I_1<I_2<I_3$%s $\sqrt{(I_2-I_1)^2} = I_2-I_1$. Besides,
$\sqrt{(I_3-I_1)^2} = I_3-I_1$ and $\sqrt{(I_3-I_2)^2} = I_2-I_3$."""


@pytest.mark.parametrize(
    ("words", "expected"),
    [(("Take", "."), [TRUE, TRUE, ERROR]), (("For", ","), [TRUE, ERROR, ERROR])],
)
def test_the_order_of_moments_of_inertia_holds_where_it_is_stated(words, expected):
    assert marks(ORDER % words, "tennis-racquet") == [OPEN, *expected]
