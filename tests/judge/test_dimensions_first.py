"""A reading that dimensions exclude never accuses, and a dimension that is lost is a failure."""

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.derive import derive
from polhode.judge import Answer, check

_ENERGY = r"(6\omega_3^2 + 5\dot\theta^2 + \dot\phi^2\sin^2\theta)"


@pytest.mark.parametrize("letter", ["K", "E_k", r"E_{\rm kin}", "KE", r"E_{\text{kin}}", "L"])
def test_an_energy_without_its_mass_is_no_definition(letter):
    potential = r" - mga\sin\theta" if letter == "L" else ""
    equations = derive(PROBLEM_SET["rolling-disk"].build())
    verdict = check(
        rf"{letter} = \frac{{a^2}}{{8}}{_ENERGY}{potential}", equations, context="identity"
    )
    assert verdict.answer is Answer.FAILS
    assert verdict.at_odds
    assert verdict.correction.what == "missing factor"


def test_a_definition_whose_terms_differ_in_dimension_fails():
    equations = derive(PROBLEM_SET["rolling-disk"].build())
    verdict = check(
        rf"Q = \frac{{a^2}}{{8}}{_ENERGY} + mga\sin\theta", equations, context="identity"
    )
    assert verdict.answer is Answer.FAILS
    assert "differ in dimension" in verdict.reason


@pytest.mark.parametrize(
    "definition",
    [
        r"K = \dot\theta^2",
        r"Q = 1 + \sin\theta",
        r"c = \frac{a}{2}",
        r"k = \sqrt{g/a}",
        "h = 3 + 2",
    ],
)
def test_letters_of_the_text_are_defined_as_it_likes(definition):
    verdict = check(definition, derive(PROBLEM_SET["rolling-disk"].build()), context="identity")
    assert verdict.answer is Answer.DEFINITION


def test_bold_type_of_a_declared_radius_is_the_arm_of_the_contact():
    """m against m/s²: the acceleration does not fit, though its z component vanishes."""
    equations = derive(PROBLEM_SET["marble-on-turntable"].build())
    assert check(r"\mathbf a = -a\hat{\mathbf z}", equations).holds
    wrong = check(r"\mathbf a = a\hat{\mathbf z}", equations)
    assert (wrong.answer, wrong.correction.what) == (Answer.FAILS, "wrong sign")
    rolling = r"\mathbf v = \boldsymbol\Omega\times\mathbf r - \boldsymbol\omega\times\mathbf a"
    assert check(rolling, equations).holds


def test_the_potential_energy_on_a_turning_hoop_with_and_without_its_rotation():
    """A bead at θ on a hoop that turns at ω: V = mga(1 - cos θ), less ½ma²ω² sin²θ as effective."""
    m, a, g, omega = ph.symbols("m a g omega", positive=True)
    lab = ph.Frame("lab")
    radius = lab.rotated(omega * ph.time, "z").rotated(-ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=m, axes=lab)
    hoop = ph.Pivot(bead, to=radius["z"] * -a, along=radius, name="hoop", force="N")
    equations = derive(ph.System(hoop, ph.Gravity(g), name="bead"))
    plain, rotation = r"mga(1 - \cos\theta)", r"\frac{1}{2} m a^2\omega^2\sin^2\theta"
    assert check(f"V = {plain}", equations).holds
    assert check(f"V = {plain} - {rotation}", equations).holds
    assert check(f"V = {plain} - 2 {rotation}", equations).answer is Answer.FAILS
    assert check(
        r"\frac{dV}{d\theta} = mga\sin\theta - ma^2\omega^2\sin\theta\cos\theta", equations
    ).holds


def test_moments_of_a_free_body_about_the_origin():
    """A rod thrown in a plane: about the origin its weight has a moment, about its centre none."""
    m, l, g = ph.symbols("m l g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="x")
    plane = ph.Pivot(rod, only="y", name="plane")
    system = ph.System(plane, ph.Hinge(rod, axis="y"), ph.Gravity(g), name="thrown rod")
    equations = derive(system)
    own = r"\frac{1}{12} m l^2\dot\theta\hat{\mathbf y}"
    assert check(rf"\mathbf L = {own}", equations).holds
    assert check(rf"\mathbf L = \mathbf r\times m\mathbf v + {own}", equations).holds
    assert check(r"\dot L_y = m g x", equations).holds
    assert check(r"\dot L_y = 2 m g x", equations).answer is Answer.FAILS


def test_an_l_that_stands_alone_is_the_lagrangian_where_a_length_has_its_letter():
    """A rod of length L on a hinge at its end: L = (1/6) m L² θ̇² + ½ mgL cos θ."""
    m, L, g = ph.symbols("m L g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=m, length=L, axes=axes, axis="z")
    pivot = ph.Pivot(rod, at=axes["z"] * (L / 2), name="pivot")
    equations = derive(ph.System(pivot, ph.Hinge(rod, axis="y"), ph.Gravity(g), name="rod"))
    right = r"L = \frac{1}{6} m L^2\dot\theta^2 + \frac{1}{2} m g L\cos\theta"
    assert check("L = T - V", equations).holds
    assert check(right, equations).holds
    assert check(right.replace("6", "3"), equations).answer is Answer.FAILS
    assert check(r"L = 2 g\dot\theta", equations).answer is Answer.FAILS


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"\int_{-L/2}^{L/2} x^2 dx = \frac{L^3}{12}", Answer.HOLDS),
        (r"I = \int_{-L/2}^{L/2} x^2\frac{m}{L} dx", Answer.HOLDS),
        (r"\frac{m}{L}\int_0^L x^2 dx = \frac{1}{3} m L^2", Answer.HOLDS),
        (r"\frac{m}{L}\int_0^L x^2 dx = \frac{1}{2} m L^2", Answer.FAILS),
    ],
)
def test_the_variable_of_an_integral_needs_no_other_meaning(latex, answer):
    m, L, g = ph.symbols("m L g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=m, length=L, axes=axes, axis="z")
    plane = ph.Hinge(rod, axis="y")
    equations = derive(ph.System(ph.Pivot(rod, name="pin"), plane, ph.Gravity(g), name="rod"))
    assert check(latex, equations).answer is answer


@pytest.mark.parametrize(
    "rate",
    [r"\dot\theta(t)", r"\dot{\theta}(t)", r"\dot{\theta(t)}", r"\frac{d\theta}{dt}(t)"],
)
def test_rates_as_functions_of_time(rate):
    equations = derive(PROBLEM_SET["rolling-disk"].build())
    assert check(rf"\omega_1 = {rate}", equations).holds
    assert check(rf"\omega_1 = 2 {rate}", equations).answer is Answer.FAILS
