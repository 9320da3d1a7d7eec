"""Worked solutions: what they contain, the route taken, and lines that do not hold."""

import sys

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.derive import derive
from polhode.judge import Answer
from solution import own_systems

ph.solution  # noqa: B018 - loads the package, whose module the tests alter
module = sys.modules["polhode.solution._solution"]

OWN = (
    "physical_pendulum",
    "spherical_pendulum",
    "renamed_top",
    "double_pendulum",
    "ball_on_incline",
    "rolling_hoop",
    "foucault_pendulum",
    "two_on_a_spring",
)
SOLVED = (
    "spinning-coin",
    "rolling-disk",
    "marble-on-turntable",
    "marble-on-turntable/tilted",
    "gyrocompass",
    "gyrocompass/motor",
    "tennis-racquet",
    "ball-on-paper",
    "gyroscope",
)


def displayed(solution):
    return [step.latex for step in solution.steps if step.latex]


def all_hold(solution):
    shown = [step for step in solution.steps if step.latex]
    answers = {step.verdict.answer for step in shown}
    return len(shown) > 8 and answers <= {Answer.HOLDS, Answer.APPROXIMATE}


@pytest.mark.parametrize("name", SOLVED)
def test_every_displayed_formula_of_the_catalogue_was_judged_and_holds(solved, name):
    assert all_hold(solved(name))


@pytest.mark.parametrize("name", OWN)
def test_systems_outside_the_catalogue_are_solved(solved, name):
    assert all_hold(solved(name))


def test_numbers_are_in_order_and_references_lead_back(solved):
    for name in SOLVED:
        seen = []
        for step in solved(name).steps:
            assert all(number in seen for number in step.references), (name, step.words)
            if step.number is not None:
                seen.append(step.number)
        assert seen == list(range(1, len(seen) + 1))


def test_no_mark_of_the_source_is_left_in_the_words(solved):
    for name in SOLVED:
        for step in solved(name).steps:
            assert "[[" not in step.words
            assert "None" not in step.words
            assert step.words.count("$") % 2 == 0


# -- what the problem set asks to be shown ---------------------------------------------------------


def test_the_disk_is_answered(solved):
    """Problem set, (33), (36)-(38) as rates, (40), the three bullets and the threshold."""
    found = solved("rolling-disk", "newton")
    shown = displayed(found)
    assert r"\omega_3 > \sqrt{\frac{g}{3 a}}" in shown
    assert r"\mathbf a\times \mathbf F = \frac{d\mathbf L_{\rm cm}}{dt}" in shown
    assert (
        r"a \dot{\phi}^2 \sin\theta \cos\theta - 6 a \omega_3 \dot{\phi} \sin\theta"
        r" - 4 g \cos\theta = 0" in shown
    )
    assert any(r"\dot{\phi} = 2 \epsilon \omega_3" in step.words for step in found.steps)
    oscillator = next(line for line in shown if line.startswith(r"\ddot{\epsilon} \approx"))
    assert r"-\frac{4 \epsilon \left(3 a \omega_3^2 - g\right)}{5 a}" in oscillator
    assert any("put it into" in step.words for step in found.steps)  # F is eliminated


def test_the_coin_is_answered(solved):
    """Problem set, (1) and (27): both roots, and φ̇ > 2 √(g/a) on edge."""
    shown = displayed(solved("spinning-coin"))
    root = r"\sqrt{\omega_3^2 + \frac{4 g \cos^2\theta}{a \sin\theta}}"
    roots = rf"\dot{{\phi}} = \frac{{1}}{{\cos\theta}}\left(\omega_3 \pm {root}\right)"
    assert roots in shown
    assert r"\dot{\phi} > 2 \sqrt{\frac{g}{a}}" in shown


def test_the_momenta_of_the_coin(solved):
    """Problem set, (18) and (19), by Lagrange's route."""
    shown = displayed(solved("spinning-coin", "lagrange"))
    momenta = [line for line in shown if line.startswith(("P_{\\phi}", "P_{\\psi}"))]
    assert len(momenta) == 2
    assert any(line.startswith("E = ") and "P_{\\phi}" in line for line in shown)


def test_the_gyroscope_is_answered(solved):
    """Problem set, (126)-(128): when precession is steady, and its rates for fast spin."""
    shown = displayed(solved("gyroscope"))
    assert r"\dot{\phi} \approx \frac{M g a}{I_1 \omega_1}" in shown
    assert any(line.startswith(r"I_1^2 \omega_1^2 - 4 M g a") for line in shown)


def test_the_words_follow_the_declaration(solved):
    disk = " ".join(step.words for step in solved("rolling-disk").steps)
    ball = " ".join(step.words for step in solved("marble-on-turntable").steps)
    assert "rolls without slipping on a horizontal plane" in disk
    assert "do not spin with it" in disk
    assert "horizontal turntable" in ball
    assert "do not spin with it" not in ball
    spindle = " ".join(s.words for s in solved("renamed_top").steps)
    assert "The spindle has mass $W$" in spindle
    assert "disk" not in spindle


# -- routes ----------------------------------------------------------------------------------------


def test_the_default_route_displays_least(solved):
    chosen = solved("gyroscope")
    sizes = {
        route: sum(map(len, displayed(solved("gyroscope", route))))
        for route in ("newton", "contact", "lagrange")
    }
    assert sum(map(len, displayed(chosen))) == min(sizes.values())
    assert chosen.route == min(sizes, key=sizes.__getitem__)


@pytest.mark.parametrize("route", ["newton", "contact", "lagrange", "integrals"])
def test_routes_agree_on_the_equations_of_motion(solved, route):
    """Whatever the route, the equations are those that derive gives."""
    equations = derive(PROBLEM_SET["gyroscope"].build())
    shown = displayed(solved("gyroscope", route))
    still = dict.fromkeys((*equations.speeds, *equations.acceleration_symbols), ph.Expr.of(0))
    for row in equations.motion:
        rest = row.subs(still)
        moved = f"{(row - rest).latex()} = {(-rest).latex()}"
        assert moved in shown or any(row.latex() in line for line in shown)


def test_rolling_has_no_such_lagranges_equations():
    with pytest.raises(ph.DeclarationError, match="no constraint on velocities"):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), "lagrange")


def test_an_unknown_route_names_the_known_ones():
    with pytest.raises(ph.DeclarationError, match="newton"):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), "hamilton")


def test_of_redundant_supports_it_says_what_stays_open():
    held = ph.solution(PROBLEM_SET["gyroscope/held"].build())
    (words,) = (s.words for s in held.steps if "redundant" in s.words)
    assert "$F'_z$ may have any value" in words
    assert all(step.verdict != "fails" for step in held.steps)


def test_sliding_friction_is_refused():
    disk = ph.with_friction(PROBLEM_SET["rolling-disk"].build(), 0.2)
    with pytest.raises(ph.ConstraintError, match="sliding friction"):
        ph.solution(disk)


def test_several_bodies_have_no_single_contact():
    with pytest.raises(ph.ConstraintError, match="a single body"):
        ph.solution(own_systems.double_pendulum(), "contact")


# -- judging ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "words"),
    [
        (r"\ddot\theta = 0", "fails"),
        (r"\omega_3 = \dot\psi - \dot\phi\cos\theta", "fails"),
        (r"q = 3", "definition"),
        (r"\theta = \alephnull", "cannot be judged"),
    ],
)
def test_a_line_that_does_not_hold_ends_the_build(monkeypatch, latex, words):
    def wrong(setting):
        yield module.SolutionLine("A line that nobody should print:", latex)

    monkeypatch.setitem(module.ROUTES, "newton", module.Route("Wrong", wrong))
    with pytest.raises(ph.NumericError, match=words):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), "newton")


# -- sentences that were false or missing ----------------------------------------------------------


def paragraph_before(solution, latex):
    return next(step.words for step in solution.steps if step.latex.startswith(latex))


def test_a_vertical_push_says_nothing_about_the_rotation():
    found = ph.solution(own_systems.smooth_ball())
    uniform = next(step for step in found.steps if "moves uniformly" in step.words)
    assert uniform.latex == r"\dot{v}_x = \dot{v}_y = 0"


def test_rates_of_unit_vectors_are_not_named_where_they_are_not_used(solved):
    """The coin's velocity stands along the axes of the laboratory, the disk's along 1, 2, 3."""
    acceleration = r"\frac{d\mathbf v_{\rm cm}}{dt} ="
    assert "unit vectors" not in paragraph_before(solved("spinning-coin"), acceleration)
    assert "unit vectors" in paragraph_before(solved("rolling-disk"), acceleration)


def test_a_condition_of_either_sign_is_displayed_as_it_stands():
    """φ̇²(C - A - m l²) + m g l > 0 bounds φ̇ from above or holds always, as the moments are."""
    found = ph.solution(own_systems.bar_on_a_universal_joint())
    shown = displayed(found)
    assert r"\left(C - A - m l^2\right) \dot{\phi}^2 + m g l > 0" in shown
    assert "and it can turn freely" not in " ".join(step.words for step in found.steps)


def test_an_asymmetric_top_by_newtons_route():
    """Its first printed component is introduced, and motions that share a relation appear once."""
    found = ph.solution(own_systems.asymmetric_top(), "newton")
    row = next(step for step in found.steps if step.latex.startswith(r"I_3 \ddot{\psi}"))
    assert "along $3$" in row.words
    steady = [step.latex for step in found.sections["Steady motions"] if step.latex]
    assert len(steady) == len(set(steady))
    together = r"With $\psi = 0$ or $\psi = \pi$, the equations of motion require"
    assert any(step.words == together for step in found.steps)


def test_letters_are_defined(solved):
    def words(name):
        return " ".join(step.words for step in solved(name).steps)

    assert "The disk of radius $a$ rolls" in words("rolling-disk")
    assert "$X$ and $Y$ are the coordinates of its origin" in words("ball-on-paper")
    assert r"\Omega\left(\cos\lambda\,\hat{\mathbf x} + " in words("gyrocompass")
    assert r"at $-a\,\hat{\mathbf 1}$ from its centre of mass" in words("gyroscope")


def test_roots_say_where_they_exist(solved):
    found = solved("rolling-disk")
    assert r"for $\cos\theta \ne 0$" in paragraph_before(
        found, r"\dot{\phi} = \frac{1}{\cos\theta}\left(3 \omega_3 \pm"
    )


def test_isolated_steady_motions_come_before_what_the_others_require(solved):
    """At θ = 0 the guided rotor is at rest whether or not the relation in cos θ holds."""
    words = [step.words for step in solved("gyrocompass/motor").steps]
    isolated = next(i for i, text in enumerate(words) if "with $\\theta = 0$; or with" in text)
    assert words[isolated + 1] == "Otherwise the equations of motion require"


def test_a_spring_is_in_the_laws_of_the_body_that_it_pulls():
    """A spring and a contact that rolls: Newton's law covers both, the other routes do not."""
    rolling = own_systems.ball_on_incline()
    pull = ph.Spring(rolling.bodies[0].point(), ph.Frame("lab").zero, stiffness=ph.symbol("k"))
    system = ph.System(*rolling.elements, pull, *rolling.loads, name="pulled")
    found = ph.solution(system)
    assert found.route == "newton"
    assert any(r"k\left(-x" in step.latex for step in found.steps)
    with pytest.raises(ph.ConstraintError, match="no load but gravity"):
        ph.solution(system, "contact")


def test_a_claim_in_words_that_does_not_hold_ends_the_build(monkeypatch):
    def wrong(setting):
        false = module.SolutionLine("", r"\theta = 0")
        yield module.SolutionLine("It stays upright, as nobody should say.", stated=(false,))

    monkeypatch.setitem(module.ROUTES, "newton", module.Route("Wrong", wrong))
    with pytest.raises(ph.NumericError, match="fails"):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), "newton")


def test_claims_in_words_are_judged_and_counted(solved):
    found = solved("gyrocompass")
    claims = [claim for step in found.steps for claim in step.stated]
    assert found.stated == len(claims) > 0
    assert all(verdict.holds for _, verdict in claims)
    assert str(found).endswith(f"{found.judged} formulas and {found.stated} claims in words judged")
