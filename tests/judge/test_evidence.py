"""What makes an accusation a proof, and what only a doubt.

Truths by hand. Pendulum, θ from the bottom: θ̈ = -(g/l) sin θ, E = ½ml²θ̇² - mgl cos θ. Rolling disk
in steady motion: the problem set, (6).
"""

from functools import cache

import pytest

import polhode as ph
from polhode import Mark
from polhode.catalogue import PROBLEM_SET

TRUE, ERROR, DOUBT, FOLLOWS = Mark.TRUE, Mark.ERROR, Mark.DOUBT, Mark.FOLLOWS
NEEDS, OPEN = Mark.NEEDS, Mark.NOT_JUDGED


@cache
def pendulum() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    theta = ph.coordinate("theta")
    axes = ph.Frame("lab").rotated(theta, "y")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    system = ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g), name="pendulum")
    return ph.derive(system)


@cache
def named(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build())


def marks(text: str, equations: ph.Equations, format: str = ".md") -> list[Mark]:
    return [line.mark for line in ph.review(text, equations, format=format).lines]


@pytest.mark.parametrize(
    ("formula", "mark"),
    [
        (r"\ddot\theta = -\frac gl\sin\theta", TRUE),
        (r"\ddot\theta = -\frac gl\cos\theta", ERROR),
        (r"\ddot\theta = -\frac{2g}{l}\sin\theta", ERROR),
        (r"\ddot\theta = -\frac lg\sin\theta", ERROR),
        (r"\ddot\theta = -\frac gl\sin\theta + \frac{g^2}{l^2}", ERROR),  # of another dimension
        (r"\ddot\theta = -\frac gl\sin\theta + \frac{g}{7l}", DOUBT),  # a term more proves nothing
    ],
)
def test_one_slip_in_letters_of_the_declaration_is_proved(formula, mark):
    (line,) = ph.review(f"$${formula}$$", pendulum(), format=".md").lines
    assert line.mark is mark
    assert line.is_first is (mark is ERROR)


@pytest.mark.parametrize(
    ("before", "mark"), [("The kinetic energy is ", ERROR), ("We have ", DOUBT)]
)
def test_a_letter_that_is_read_by_usage_alone_accuses_nobody(before, mark):
    assert marks(rf"{before}$T = m l^2\dot\theta^2$.", pendulum()) == [mark]


def test_a_line_that_holds_closes_the_letters_in_it():
    right = r"E = \frac12 ml^2\dot\theta^2 - mgl\cos\theta"
    text = rf"$${right}$$ Hence $$E = ml^2\dot\theta^2 - mgl\cos\theta$$"
    assert marks(text, pendulum()) == [TRUE, ERROR]


def test_a_doubt_shows_no_state_that_refutes_it_and_changes_no_exit_code():
    (line,) = ph.review(r"$$\ddot\theta = \frac gl$$", pendulum(), format=".md").lines
    assert line.mark is DOUBT
    assert line.verdict is not None
    assert line.verdict.counterexample is None
    assert line.to_json()["counterexample"] is None


def test_what_is_drawn_from_a_doubt_is_a_doubt():
    text = r"""We have $$T = m l^2\dot\theta^2 .$$
Then $$L = T - V = m l^2\dot\theta^2 + mgl\cos\theta .$$"""
    found = ph.review(text, pendulum(), format=".md").lines
    assert [line.mark for line in found] == [DOUBT, DOUBT]
    assert found[1].of == 0


@pytest.mark.parametrize(
    "text",
    [
        r"The acceleration is $\ddot\theta = -g/l$ when $\theta = \pi/2$.",
        r"When $\theta = \pi/2$ the acceleration is $\ddot\theta = -g/l$.",
        r"One finds $\ddot\theta = -g/l$, provided $\theta = \pi/2$.",
    ],
)
def test_a_condition_counts_before_its_claim_and_behind_it(text):
    (claim,) = (m for m in marks(text, pendulum()) if m is not OPEN)
    assert claim is TRUE


@pytest.mark.parametrize("angle", [r"\theta", r"\vartheta"])
def test_small_departures_are_tried_whatever_the_words_say(angle):
    text = rf"Let us keep what matters: $$\ddot{angle} + \frac gl {angle} = 0.$$"
    assert marks(text, pendulum()) == [NEEDS]


def test_an_assumption_holds_to_the_end_of_its_part():
    text = r"""The centre stays where it is, so that $\omega_3=0$. In steady motion
$$\dot\phi^2\sin\theta=\frac{4g}{a},$$
and the energy is $$E=\frac32mga\sin\theta .$$"""
    assert marks(text, named("rolling-disk")) == [OPEN, TRUE, TRUE]


@pytest.mark.parametrize("rate", [r"\dot x", "v_x"])
def test_a_speed_is_mentioned_where_the_rate_of_its_coordinate_is(rate):
    other = rate.replace("x", "y")
    text = (
        rf"The kinetic energy of the centre is $T_{{\rm cm}}=m({rate}^2+{other}^2)"
        r"+\frac12ma^2\dot\theta^2\cos^2\theta$."
    )
    assert marks(text, named("spinning-coin")) == [ERROR]


def test_an_angle_from_the_other_end_is_a_convention_of_the_text():
    text = r"""The potential energy is $$V = mgl\cos\theta,$$ so that
$$ml^2\ddot\theta = mgl\sin\theta, \qquad \ddot\theta = \frac gl\sin\theta .$$"""
    found = ph.review(text, pendulum(), format=".md").lines
    assert {line.mark for line in found} == {NEEDS}
    assert all("counted as" in line.needs for line in found)


def test_the_sense_of_a_coordinate_is_in_question_where_one_line_tells_it():
    text = r"Hence $$\omega_1 = -\dot\theta .$$"
    (line,) = ph.review(text, named("spinning-coin"), format=".md").lines
    assert line.mark is not ERROR


def test_a_sign_against_another_line_of_the_text_is_no_convention():
    text = r"""The potential energy is $$V = -mgl\cos\theta,$$
so that $$\ddot\theta = \frac gl\sin\theta .$$"""
    assert marks(text, pendulum()) == [TRUE, ERROR]


@pytest.mark.parametrize(
    ("q", "sign", "is_true"), [("q_i", "-", True), ("s", "-", True), (r"\theta", "+", False)]
)
def test_lagranges_equation_is_true_of_the_lagrangian_of_the_text(q, sign, is_true):
    momentum, slope = (
        rf"\frac{{\partial L}}{{\partial\dot {q}}}",
        rf"\frac{{\partial L}}{{\partial {q}}}",
    )
    (mark,) = marks(rf"$$\frac{{d}}{{dt}}{momentum} {sign} {slope} = 0$$", pendulum())
    assert (mark is TRUE) is is_true


def test_a_lagrangian_may_have_another_zero_of_the_potential_energy():
    text = r"$$L = T - V = \frac12 ml^2\dot\theta^2 - mgl(1 - \cos\theta)$$"
    assert marks(text, pendulum()) == [TRUE]


@pytest.mark.parametrize("formula", [r"\dot\theta = 0", r"\cos\theta = \frac12"])
def test_what_chooses_states_is_a_condition(formula):
    assert marks(f"$${formula}$$", pendulum()) == [OPEN]


@cache
def cylinder_on_a_slope() -> ph.Equations:
    """Rolling down the slope, (3/2) m ẍ = mg sin α: half of its mass more by its turning."""
    m, g, R, alpha = ph.symbols("m g R alpha", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-alpha)
    body = ph.cylinder(
        "cylinder",
        mass=m,
        radius=R,
        height=R,
        axes=slope.axes,
        axis="x",
        spin=ph.About("x", "beta"),
    )
    ground = ph.Rolling(body, on=slope, name="ground")
    return ph.derive(ph.System(ground, ph.Hinge(body, axis="x"), ph.Gravity(g), name="cylinder"))


def test_where_accelerations_are_constant_a_wrong_one_needs_no_start():
    """Its rate is zero like that of the right one, and nothing else of it is right."""
    right = r"\frac{d}{dt}\left(\frac{3}{2} m \dot{y}\right) = m g\sin\alpha"
    wrong = r"\frac{d}{dt}\left(\frac{3}{2} m \dot{y}\right) = 2 m g\sin\alpha"
    (true,) = ph.review(f"$${right}$$", cylinder_on_a_slope(), format=".md").lines
    (false,) = ph.review(f"$${wrong}$$", cylinder_on_a_slope(), format=".md").lines
    assert (true.mark, false.mark) == (TRUE, ERROR)


def test_a_later_line_is_an_error_only_where_it_contradicts_itself():
    first = r"$$\ddot\theta = -\frac gl\cos\theta$$"
    later = rf"{first} And $$ml^2\ddot\theta = mgl\sin\theta$$"
    assert marks(later, pendulum())[0] is ERROR
    assert marks(later, pendulum())[1] in (DOUBT, FOLLOWS)
    itself = rf"{first} And $$mgl = \frac12 mgl + \frac13 mgl$$"
    assert marks(itself, pendulum()) == [ERROR, DOUBT]
    other = f"# Problem 1\n{first}\n\n# Problem 2\n" + r"$$\ddot\theta = -\frac{g}{2l}\sin\theta$$"
    assert marks(other, pendulum()) == [ERROR, ERROR]
    parts = other.replace("Problem 1", "Energy").replace("Problem 2", "Motion")
    assert marks(parts, pendulum()) == [ERROR, DOUBT]


def test_what_repeats_an_assumption_is_no_claim():
    text = r"Let $\theta = \frac\pi2$. Hence it is $\theta = \frac\pi2$ all the time."
    assert marks(text, pendulum()) == [OPEN, OPEN]


# -- numbers --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "due"),
    [
        (r"$l = 0.5$ m and $m = 2$ kg. The drop is $h = \frac{l}{2} = 0.25$ m.", TRUE),
        (r"$s = 2.4$ m. The drop is $h = s\sin 30^\circ = 1.2$ m.", TRUE),
        (r"$s = 2.4$ m. It is $h = \frac{s}{2} = \frac{s^2}{2 s} = 1.2$ m.", TRUE),
    ],
)
def test_letters_that_are_given_as_numbers_keep_their_dimension(text, due):
    assert marks(text, pendulum())[-1] is due


def test_a_length_that_is_given_as_a_number_is_no_area():
    text = r"$s = 2.4$ m. It is $h = \frac{s^2}{2} = 2.88$ m."
    assert marks(text, pendulum())[-1] in (ERROR, DOUBT)


def test_a_number_is_the_last_link_of_a_chain_whose_first_letter_is_defined():
    """12 · 2²/(49 · 9.81) = 0.0999: the other links hold, and this one has to as well."""
    given = r"$v_0 = 2$ m/s and $g = 9.81$ m/s². "
    chain = r"It has slid $$d = \frac{{12 v_0^2}}{{49 g}} = \frac{{24 v_0^2}}{{98 g}} = {}$$"
    right = chain.format(r"0.0999\,\mathrm{m}")
    wrong = chain.format(r"0.41\,\mathrm{m}")
    assert marks(given + right, pendulum())[-1] is TRUE
    assert marks(given + wrong, pendulum())[-1] in (ERROR, DOUBT)
