"""Which equations have a closed form, and what is said of those that have none."""

import pytest

import polhode as ph
from analyse.systems import equations
from polhode.analyse import closed_form, recognise
from polhode.base import DeclarationError, NumericError, UnitError

FAMILIES = {
    "spinning-coin": "spinning coin",
    "marble-on-turntable": "circling",
    "marble-on-turntable/tilted": "circling",
    "gyrocompass": "gyrocompass",
    "gyrocompass/motor": "gyrocompass",
    "tennis-racquet": "free body",
    "gyroscope": "symmetric top",
    "gyroscope/vertical-plane": "pendulum",
    "gyroscope/upright": "symmetric top",
}


@pytest.mark.parametrize(("name", "family"), FAMILIES.items())
def test_recognised_by_structure(name, family):
    assert recognise(equations(name)).name == family


@pytest.mark.parametrize("name", ["rolling-disk", "ball-on-paper", "gyroscope/held"])
def test_none_is_known(name):
    with pytest.raises(NumericError, match=f"{name} has no closed form that is known here; exp"):
        recognise(equations(name))


def test_two_bodies_are_not_taken_for_one():
    """A pendulum that carries another obeys neither's equation."""
    theta, beta = ph.coordinates("theta beta")
    m, l, g = ph.symbols("m l g", positive=True)
    lab = ph.Frame("lab")
    first = ph.Body("first", mass=m, inertia=(m * l**2,) * 3, axes=lab.rotated(theta, "x"))
    second = ph.Body("second", mass=m, inertia=(m * l**2,) * 3, axes=lab.rotated(beta, "x"))
    both = ph.System(
        ph.Pivot(first, at=first.axes["z"] * l, name="upper"),
        ph.Pivot(second, at=second.axes["z"] * (2 * l), name="lower", force="G"),
        ph.Gravity(g),
        name="two pendulums",
    )
    with pytest.raises(NumericError, match="two pendulums has no closed form"):
        recognise(ph.derive(both))


def test_latex_names_the_constants():
    motion = closed_form(
        equations("gyroscope/vertical-plane"),
        {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 1},
        {"theta": 1},
    )
    assert r"\ddot\theta = \mu\sin\theta" in motion.latex()
    assert r"\mu = " in motion.latex()
    assert str(motion).startswith("pendulum: swing, period ")


def racquet(start, **numbers):
    moments = {"I_1": 1, "I_2": 2, "I_3": 3} | numbers
    return closed_form(equations("tennis-racquet"), moments, start)


def test_a_start_may_be_an_expression_of_parameters():
    """ω₁² I₁ (I₂ - I₁) = ω₃² I₃ (I₃ - I₂) puts it on the separatrix exactly (equation 12)."""
    I_1, I_2, I_3 = (ph.symbol(f"I_{i}", positive=True) for i in (1, 2, 3))
    ratio = I_3 * (I_3 - I_2) / (I_1 * (I_2 - I_1))
    start = {"omega_1": ph.sqrt(ratio) / 10, "omega_2": 3, "omega_3": "0.1"}
    assert racquet(start, I_1=1.25, I_2=1.5, I_3=2.5).kind == "separatrix"


def test_bad_values_are_refused():
    with pytest.raises(DeclarationError, match="'omega_4' is no coordinate or independent speed"):
        racquet({"omega_4": 1})
    with pytest.raises(DeclarationError, match="I_1 = -1; expected a positive value"):
        racquet({"omega_1": 1}, I_1=-1)
    with pytest.raises(DeclarationError, match="without a value for k; expected numbers for all"):
        racquet({"omega_1": ph.symbol("k")})
    with pytest.raises(UnitError, match="omega_1 = "):
        racquet({"omega_1": "3 kg"})


def test_missing_parameters_are_named():
    with pytest.raises(DeclarationError, match="I_3 has no value"):
        closed_form(equations("tennis-racquet"), {"I_1": 1, "I_2": 2}, {"omega_1": 1})
