"""Lines as students write them, with the marks that a teacher gives them by hand."""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer
from solution import own_systems

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
NEEDS, NOT_JUDGED = ph.Mark.NEEDS, ph.Mark.NOT_JUDGED


@cache
def equations(name: str) -> ph.Equations:
    if name in PROBLEM_SET:
        return ph.derive(PROBLEM_SET[name].build())
    return ph.derive(getattr(own_systems, name)())


def lines(text: str, system: str, format: str = ".tex") -> tuple[ph.ReviewedLine, ...]:
    return ph.review(text, equations(system), format=format, seconds=0.0).lines


def marks(text: str, system: str, format: str = ".tex") -> list[ph.Mark]:
    return [blamed(line) for line in lines(text, system, format)]


# -- numbers with units ----------------------------------------------------------------------------

#: A bar 24 cm long that swings about its end: I₁ = m (2l)²/12, and the period is 0.80 s.
NUMBERS = r"""A bar has $m = 0.20$ kg and $l = 120$~mm, so that $I_1 = 9.6\times10^{-4}$ kg\,m$^2$;
$g=9.81$ m/s$^2$. Hence \[ \frac{2\pi}{\sqrt{mgl/(I_1 + ml^2)}} = %s\,\mathrm{s}. \]"""


@pytest.mark.parametrize(("period", "mark"), [("0.80", TRUE), ("0.81", ERROR), ("25", ERROR)])
def test_units_in_the_words_behind_a_number(period: str, mark: ph.Mark) -> None:
    found = lines(NUMBERS % period, "physical_pendulum")
    assert [blamed(line) for line in found] == [NOT_JUDGED] * 4 + [mark]
    units = ("kg", "mm", "kg m^2", "m/s^2")
    assert all(rf"\unit{{{unit}}}" in f.read_as for unit, f in zip(units, found, strict=False))


def test_degrees_are_read_and_the_word_in_is_no_inch() -> None:
    text = r"At $\theta = 90$ degrees \[ (I_1 + ml^2)\ddot\theta = -mgl . \]"
    assert marks(text, "physical_pendulum") == [NOT_JUDGED, TRUE]
    (line,) = lines(r"We take $l = 2$ in the end.", "physical_pendulum")
    assert not line.read_as


# -- small motions ---------------------------------------------------------------------------------

SMALL = r"For small oscillations (first order in $\alpha$ and $\beta$) \[ %s . \]"


def test_rates_are_small_in_small_oscillations_and_words_stand_for_the_whole_display() -> None:
    """Both equations of the double pendulum, linear; with one wrong factor."""
    second = r"\ddot\alpha+\ddot\beta = -\frac gl\beta"
    right = rf"2\ddot\alpha + \ddot\beta = -2\frac gl\alpha, \qquad {second}"
    assert marks(SMALL % right, "double_pendulum") == [TRUE, TRUE]
    wrong = right.replace(r"-2\frac", r"-\frac")
    assert marks(SMALL % wrong, "double_pendulum") == [ERROR, TRUE]


def test_linearised_equations_need_no_sign_of_approximation() -> None:
    text = (
        r"Linearise for small $\alpha,\beta$: \[ 2\ddot\alpha + \ddot\beta + 2\frac gl\alpha = 0 \]"
    )
    assert marks(text, "double_pendulum") == [TRUE]
    assert marks(text.replace("+ 2", "- 2"), "double_pendulum") == [ERROR]


# -- what words say of other lines -----------------------------------------------------------------

# Of a horizontal axis, I₁ω₁ dφ/dt = Mga exactly; in steady motion at other angles it is not.
PRECESSION = r"""In steady precession at $\theta = \pi/2$ we have $\ddot\theta = 0$. The rate is
\[ \dot\phi = %s . \]"""


@pytest.mark.parametrize(
    ("value", "mark"), [(r"\frac{Mga}{I_1\omega_1}", NEEDS), (r"\frac{2Mga}{I_1\omega_1}", ERROR)]
)
def test_the_state_of_the_sentence_before_may_be_meant_on(value: str, mark: ph.Mark) -> None:
    line = lines(PRECESSION % value, "gyroscope")[-1]
    assert blamed(line) is mark
    assert line.needs == (r"\theta = \pi/2" if mark is NEEDS else "")


def test_a_vector_that_words_alone_describe_is_not_taken_as_the_position() -> None:
    law = r"Rolling: $\mathbf v = \boldsymbol\omega\times\mathbf r$"
    described = rf"{law}, where $\mathbf r$ leads from the contact to the centre."
    assert marks(described, "rolling-disk") == [NOT_JUDGED]
    assert marks(f"{law}.", "rolling-disk") == [ERROR]


def test_an_ambiguous_line_advises_the_reading_in_which_it_holds() -> None:
    claim = r"L_z = (I_2 + Ma^2)\dot\phi\sin^2\theta + I_1\omega_1\cos\theta"
    verdict = ph.check(claim, equations("gyroscope"))
    assert verdict.answer is Answer.AMBIGUOUS
    assert verdict.reason.endswith("state the reading 'L = angular momentum about pivot'")


# -- instability -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "mark"),
    [
        # Of the bead on a turning hoop: a small θ obeys d²θ/dt² = (Ω² - g/a) θ.
        (r"$\theta = 0$ is unstable if $\Omega^2 > g/a$.", TRUE),
        (r"$\theta = 0$ is stable if $\Omega^2 < g/a$, and unstable if $\Omega^2 > g/a$.", TRUE),
        (r"$\theta = 0$ is unstable if $\Omega^2 < g/a$.", ERROR),
        (r"$\theta = 0$ is unstable if $\Omega^2 > 2g/a$.", ERROR),
        (r"$\theta = 0$ is unstable if $\Omega^2 + g/a > 0$, i.e. always.", ERROR),
    ],
)
def test_a_condition_of_instability_is_that_of_stability_turned_round(words, mark) -> None:
    found = ph.review(words, bead(), seconds=0.0).lines[1:]
    assert {blamed(line) for line in found} == {mark}
    assert all(line.context == "threshold" for line in found)


@cache
def bead() -> ph.Equations:
    """A bead on a hoop that is turned about its vertical diameter."""
    m, a, g, Omega = ph.symbols("m a g Omega", positive=True)
    hoop = ph.Frame("lab").rotated(Omega * ph.time, "z", labels="r n z", name="hoop")
    axes = hoop.rotated(ph.coordinate("theta"), "n", labels="1 2 3")
    body = ph.point_mass("bead", mass=m, axes=axes)
    drives = (
        ph.Motor(body, axis="1", rate=0, relative_to=hoop, name="drive"),
        ph.Motor(body, axis="3", rate=0, relative_to=hoop, name="axle", torque="sigma"),
    )
    held = ph.Pivot(body, at=axes["3"] * a, name="hoop")
    return ph.derive(ph.System(held, *drives, ph.Gravity(g), name="bead"))


# -- what follows ----------------------------------------------------------------------------------

YOYO = r"""The string does not slip: \[ \dot z = -r\dot\phi, \qquad \ddot z = -r\ddot\phi . \]
\[ m\ddot z = mg - S_t \] \[ I\ddot\phi = rS_t \] Hence \[ %s . \]"""


@pytest.mark.parametrize(
    ("latex", "mark"),
    [
        (r"-mr\ddot\phi = mg - I\ddot\phi/r", FOLLOWS),
        (r"\ddot\phi = \frac{mgr}{I - mr^2}", FOLLOWS),
        (r"-mr\ddot\phi = mg - 2I\ddot\phi/r", ERROR),  # a slip of its own
        (r"\ddot\phi = \frac{2mgr}{I - mr^2}", ERROR),
    ],
)
def test_a_wrong_line_is_solved_together_with_two_true_ones(latex: str, mark: ph.Mark) -> None:
    m, r, I, g = ph.symbols("m r I g", positive=True)
    lab = ph.Frame("lab")
    body = ph.Body("yo-yo", mass=m, inertia=(I, I, I), axes=lab.rotated(ph.coordinate("phi"), "y"))
    string = ph.Rack(body, at=lab["x"] * -r, along=lab["z"], name="string", force="S")
    guided = (ph.Pivot(body, only="x y", name="hand"), ph.Hinge(body, axis="y"))
    system = ph.derive(ph.System(*guided, string, ph.Gravity(g), name="yo-yo"))
    found = ph.review(YOYO % latex, system, seconds=0.0).lines
    assert [blamed(line) for line in found] == [TRUE, TRUE, ERROR, TRUE, mark]


@pytest.mark.parametrize(
    ("latex", "mark"),
    [
        (r"\ddot\theta = \left(\Omega^2 + \frac ga\right)\theta", FOLLOWS),
        (r"\ddot\theta = \left(\Omega^2 + \frac{2g}a\right)\theta", ERROR),  # a slip of its own
        (r"\ddot\theta = \left(\Omega^2 - \frac ga\right)\theta", ph.Mark.TRUE),
    ],
)
def test_the_linear_part_of_a_wrong_equation_follows(latex: str, mark: ph.Mark) -> None:
    text = rf"""\[ a\ddot\theta = a\Omega^2\sin\theta\cos\theta + g\sin\theta \]
For small $\theta$, \[ {latex} . \]"""
    found = ph.review(text, bead(), seconds=0.0).lines
    assert [blamed(line) for line in found] == [ERROR, mark]
