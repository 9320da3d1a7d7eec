"""A reading that dimensions exclude never accuses, and a dimension that is lost is a failure."""

import pytest

from polhode.catalogue import CATALOGUE
from polhode.claims import Answer, check
from polhode.derive import derive

_ENERGY = r"(6\omega_3^2 + 5\dot\theta^2 + \dot\phi^2\sin^2\theta)"


@pytest.mark.parametrize("letter", ["K", "E_k", r"E_{\rm kin}", "KE", r"E_{\text{kin}}", "L"])
def test_an_energy_without_its_mass_is_no_definition(letter):
    potential = r" - mga\sin\theta" if letter == "L" else ""
    equations = derive(CATALOGUE["rolling-disk"].build())
    verdict = check(
        rf"{letter} = \frac{{a^2}}{{8}}{_ENERGY}{potential}", equations, context="identity"
    )
    assert verdict.answer is Answer.FAILS
    assert verdict.at_odds
    assert verdict.correction.what == "missing factor"


def test_a_definition_whose_terms_differ_in_dimension_fails():
    equations = derive(CATALOGUE["rolling-disk"].build())
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
    verdict = check(definition, derive(CATALOGUE["rolling-disk"].build()), context="identity")
    assert verdict.answer is Answer.DEFINITION


def test_bold_type_of_a_declared_radius_is_the_arm_of_the_contact():
    """m against m/s²: the acceleration does not fit, though its z component vanishes."""
    equations = derive(CATALOGUE["marble-on-turntable"].build())
    assert check(r"\mathbf a = -a\hat{\mathbf z}", equations).holds
    wrong = check(r"\mathbf a = a\hat{\mathbf z}", equations)
    assert (wrong.answer, wrong.correction.what) == (Answer.FAILS, "wrong sign")
    rolling = r"\mathbf v = \boldsymbol\Omega\times\mathbf r - \boldsymbol\omega\times\mathbf a"
    assert check(rolling, equations).holds
