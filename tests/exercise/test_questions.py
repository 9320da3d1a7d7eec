"""Answers of exercises against closed forms that are written out here."""

from math import cos, pi, radians, sin, sqrt

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.exercise import KINDS, Builder
from polhode.judge import Answer

#: All of them.
KINDS_OF_DISK = ["freedom", "velocities", "motion", "conserved", "reaction"]
KINDS_OF_DISK += ["steady", "threshold", "frequency", "wrong", "outcome"]
SEEDS = (1, 2, 3, 4)


@pytest.fixture(scope="module")
def coin():
    return Builder.of(CATALOGUE["spinning-coin"])


def numbers(exercise):
    """Parameters, SI."""
    return {
        k: float(v.split()[0]) * (1e-3 if v.endswith(" mm") else 1)
        for k, v in exercise.texts.items()
    }


def only(exercise, kind):
    (question,) = (q for q in exercise.questions if q.kind == kind)
    return question


def said(question, name):
    """A value that the statement of a question gives, such as \\omega_3 = 12 rad/s."""
    text = " ".join(p.words for p in question.statement)
    value = text.split(f"${name} = ", 1)[1]
    number = float(value.split("$")[0])
    return radians(number) if value.split("$")[1].startswith("°") else number


def test_the_disk_offers_every_kind(offered):
    assert [q.kind for q in offered.questions] == KINDS_OF_DISK == list(KINDS)


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_of_steady_precession(disk, seed):
    r"""a \dot\phi² sinθ cosθ - 6 a ω₃ \dot\phi sinθ - 4 g cosθ = 0, equation (39)."""
    made = disk.exercise(seed, kinds=["steady"])
    values, question = numbers(made), only(made, "steady")
    theta, omega = said(question, r"\theta"), said(question, r"\omega_3")
    a, g = values["a"], values["g"]
    roots = question.answers[1].values
    assert len(roots) == 2
    for rate in roots:
        left = a * rate**2 * sin(theta) * cos(theta) - 6 * a * omega * rate * sin(theta)
        assert left == pytest.approx(4 * g * cos(theta), rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_thresholds_and_what_becomes_of_the_disk(disk, seed):
    """ω₃ > √(g/3a) rolling upright, φ̇ > 2√(g/5a) spinning on edge."""
    made = disk.exercise(seed, kinds=["threshold", "outcome"])
    a, g = numbers(made)["a"], numbers(made)["g"]
    bounds = {r"\omega_3": sqrt(g / (3 * a)), r"\dot{\phi}": 2 * sqrt(g / (5 * a))}
    question = only(made, "threshold")
    speed = next(k for k in bounds if f"at any constant ${k}$" in question.statement[0].words)
    assert question.answers[1].values[0] == pytest.approx(bounds[speed], rel=1e-9)
    outcome = only(made, "outcome")
    (turning,) = (k for k in bounds if f"${k} = 0$" not in outcome.statement[0].words)
    right = "a" if said(outcome, turning) > bounds[turning] else "b"
    assert outcome.answers[0].right == {right}


@pytest.mark.parametrize("seed", SEEDS)
def test_the_acceleration_and_force_of_a_spherical_pendulum(seed):
    """θ̈ = sin θ (φ̇² cos θ + g/l), θ from the upward vertical; φ̈ sin θ = -2 θ̇ φ̇ cos θ."""
    m, l, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    system = ph.System(ph.Pivot(bob, at=axes["3"] * -l), ph.Gravity(g), name="bob on a rod")
    made = Builder.of(system).exercise(seed, kinds=["motion", "reaction"])
    values = numbers(made)
    question = only(made, "motion")
    angle, rate = said(question, r"\theta"), said(question, r"\dot{\phi}")
    expected = sin(angle) * (rate**2 * cos(angle) + values["g"] / values["l"])
    if r"\ddot{\theta}" in question.answers[1].prompt:
        assert question.answers[1].values[0] == pytest.approx(expected, rel=1e-9)
    reaction = only(made, "reaction")
    if r"\hat{\mathbf 3}" in reaction.answers[0].asked and len(reaction.answers) > 1:
        angle, rate = said(reaction, r"\theta"), said(reaction, r"\dot{\phi}")
        fall = said(reaction, r"\dot{\theta}")
        inward = fall**2 + rate**2 * sin(angle) ** 2
        force = values["m"] * (values["g"] * cos(angle) - values["l"] * inward)
        assert reaction.answers[1].values[0] == pytest.approx(force, rel=1e-9)


def test_a_physical_pendulum_swings_with_its_period():
    m, l, g, moment = ph.symbols("m l g J", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    bar = ph.Body("bar", mass=m, inertia=(moment, moment, moment), axes=axes)
    system = ph.System(ph.Pivot(bar, at=axes["3"] * l), ph.Gravity(g), name="bar")
    made = ph.exercise(system, 5, kinds=["frequency", "freedom"])
    v = numbers(made)
    period = 2 * pi * sqrt((v["J"] + v["m"] * v["l"] ** 2) / (v["m"] * v["g"] * v["l"]))
    assert only(made, "frequency").answers[1].values[0] == pytest.approx(period, rel=1e-9)
    assert [a.values for a in only(made, "freedom").answers] == [(1.0,), (5.0,)]


def test_the_modes_of_a_double_pendulum_are_found_together():
    """ω² = (2 ± √2) g/l for equal masses and lengths."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    lab = ph.Frame("lab")
    upper = ph.point_mass("upper", mass=m, axes=lab.rotated(alpha, "y", name="one"))
    lower = ph.point_mass("lower", mass=m, axes=lab.rotated(beta, "y", name="two"))
    system = ph.System(
        ph.Pivot(upper, at=upper.axes["z"] * l, name="nail"),
        ph.Pivot(lower, at=lower.axes["z"] * l, to=upper.point(), name="joint", force="G"),
        ph.Gravity(g),
        name="double-pendulum",
    )
    made = ph.exercise(system, 2, kinds=["frequency"])
    v = numbers(made)
    expected = [2 * pi / sqrt((2 + s * sqrt(2)) * v["g"] / v["l"]) for s in (1, -1)]
    found = only(made, "frequency").answers[0].values
    assert sorted(found) == pytest.approx(expected, rel=1e-9)
    assert "joint" in " ".join(p.words for p in made.statement)


def test_the_drift_of_a_marble_on_a_tilted_turntable():
    """v₃ = -(5/2) g sin α/Ω for a uniform marble."""
    made = ph.exercise(CATALOGUE["marble-on-turntable/tilted"], 1, kinds=["steady"])
    slope = radians(float(made.texts["alpha"].split()[0]))
    rate = float(made.texts["Omega"].split()[0]) * 2 * pi / 60
    found = only(made, "steady").answers[1].values[0]
    assert found == pytest.approx(-2.5 * 9.81 * sin(slope) / rate, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_contact_pushes_at_every_state_that_is_asked_about(coin, seed):
    """N = m (g + d²(a sin θ)/dt²) for the coin, with θ̈ from its equation of motion."""
    made = coin.exercise(seed, kinds=["reaction"])
    question = only(made, "reaction")
    assert question.answers[1].values[0] > 0
    t, w, f = (said(question, n) for n in (r"\theta", r"\omega_3", r"\dot{\phi}"))
    fall, a, g = said(question, r"\dot{\theta}"), numbers(made)["a"], 9.81
    mass = float(made.texts["m"].split()[0]) * 1e-3
    bend = 4 * a * fall**2 * sin(t) * cos(t) + a * f**2 * sin(t) * cos(t)
    bend += -2 * a * w * f * sin(t) - 4 * g * cos(t)
    bend /= a * (1 + 4 * cos(t) ** 2)
    force = mass * (g + a * bend * cos(t) - a * fall**2 * sin(t))
    assert question.answers[1].values[0] == pytest.approx(force, rel=1e-9)


def test_one_equation_of_four_is_refuted_and_the_others_hold(disk, offered):
    question = only(offered, "wrong")
    equations = disk.subject.equations
    judged = [ph.check(option.strip("$"), equations).answer for option in question.options]
    wrong = "abcd".index(next(iter(question.answers[0].right)))
    assert judged.pop(wrong) is Answer.FAILS
    assert judged == [Answer.HOLDS] * 3
    assert len(set(question.options)) == 4


def test_the_term_left_out_completes_the_equation(offered):
    question = only(offered, "motion")
    shown, term = question.statement[0].latex, question.answers[0].latex
    assert shown.replace("X", term, 1) == question.worked[0].latex
    assert "X" in shown
    assert term not in shown


def test_conserved_quantities_are_told_from_others(disk, offered):
    """The energy of the disk by hand: m a² (6 ω₃² + 5 θ̇² + φ̇² sin²θ)/8 + m g a sin θ."""
    question = only(offered, "conserved")
    kinetic = (
        r"\frac{m a^2 \left(6 \omega_3^2 + 5 \dot{\theta}^2 + \dot{\phi}^2 \sin^2\theta\right)}{8}"
    )
    energy = f"${kinetic} + m g a \\sin\\theta$"
    assert question.answers[0].right == {"abcd"[question.options.index(energy)]}


def test_the_same_seed_gives_the_same_and_another_student_other_numbers(disk):
    first, again = disk.exercise(3), disk.exercise(3)
    other = disk.exercise(3, student=2)
    assert first == again
    assert first.texts != other.texts
    assert [q.kind for q in first.questions] == [q.kind for q in other.questions]
    assert {k: type(a) for k, a in first.answers.items()} == {
        k: type(a) for k, a in other.answers.items()
    }


def test_the_frequency_formula_is_the_root_of_the_linear_equation(offered):
    """ε̈ = -(4/5)(3 ω₃² - g/a) ε rolling upright, or -(φ̇² - 4g/5a) ε spinning on edge."""
    question = only(offered, "frequency")
    values = numbers(offered)
    a, g = values["a"], values["g"]
    period = question.answers[1].values[0]
    words = question.statement[0].words
    if r"\omega_3 = 0" in words.split("about")[1].split("constant")[0]:
        square = said(question, r"\dot{\phi}") ** 2 - 4 * g / (5 * a)
    else:
        square = 4 * (3 * said(question, r"\omega_3") ** 2 - g / a) / 5
    assert (2 * pi / period) ** 2 == pytest.approx(square, rel=1e-9)


def test_the_couple_of_the_guide_of_a_gyrocompass():
    """τ₂ = I₃ω θ̇ - ..., to leading order in the rotation of the Earth."""
    made = ph.exercise(CATALOGUE["gyrocompass"], 1, kinds=["reaction"])
    question = only(made, "reaction")
    assert question.answers[0].asked == r"\tau_2"
    assert question.answers[1].unit == "N m"
    mass, a = (float(made.texts[k].split()[0]) for k in ("m", "a"))
    spin, rate = said(question, r"\omega"), said(question, r"\dot{\theta}")
    assert question.answers[1].values[0] == pytest.approx(mass * a**2 * spin * rate, rel=1e-3)


def test_a_primed_force_is_a_letter_that_the_question_explains():
    """The hand's force on the held gyroscope is F′, not the F of its other support."""
    offered = Builder.of(CATALOGUE["gyroscope/held"]).offered(1)
    assert "wrong" in offered
    words = offered["wrong"].statement[0].words
    if any(r"\mathbf F'" in option for option in offered["wrong"].options):
        assert r"$\mathbf F'$ is the force of “hand”" in words


def test_no_force_is_asked_for_that_is_always_zero():
    """A ball on a slope has none along the horizontal line of it, and mg cos α across."""
    m, R, g, alpha = ph.symbols("m R g alpha", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-alpha)
    ball = ph.sphere("ball", mass=m, radius=R, axes=slope.axes)
    system = ph.System(ph.Rolling(ball, on=slope, name="ground"), ph.Gravity(g), name="ball")
    for seed in range(1, 6):
        question = only(ph.exercise(system, seed, kinds=["reaction"]), "reaction")
        assert abs(question.answers[1].values[0]) > 0.1
