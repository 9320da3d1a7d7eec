"""Every integral that is listed is one by the judge of claims too, also by the name it is given.

The judge forms the quantities of the declaration by itself: a name is right if what it means there
is conserved and equal to the expression listed.
"""

import pytest

import polhode as ph
from analyse.systems import equations
from polhode.catalogue import PROBLEM_SET
from polhode.judge import check

#: Letters that a text defines for itself, and no quantity of mechanics goes by.
_OWN = ("C_", "S_", "J")

LISTED = [
    pytest.param(name, invariant, id=f"{name}-{invariant.name}")
    for name in PROBLEM_SET
    for invariant in ph.invariants(equations(name))
]


@pytest.mark.parametrize(("name", "invariant"), LISTED)
def test_the_expression_is_conserved(name, invariant):
    claim = rf"\frac{{d}}{{dt}}\left({invariant.expression.latex()}\right) = 0"
    assert check(claim, equations(name)).answer.value == "holds"


NAMED = [p for p in LISTED if not p.values[1].name.startswith(_OWN)]


@pytest.mark.parametrize(("name", "invariant"), NAMED)
def test_the_name_means_what_is_listed(name, invariant):
    letter = invariant.letter
    for claim in (
        rf"{letter} = \text{{const}}",
        rf"\frac{{d}}{{dt}}{letter} = 0",
        rf"{letter} = {invariant.expression.latex()}",
    ):
        assert check(claim, equations(name)).answer.value == "holds", claim


def test_a_momentum_says_about_which_point():
    found = ph.invariants(equations("gyroscope"))
    (momentum,) = (i for i in found if i.name.startswith("L"))
    assert momentum.name == "L_pivot_z"
    assert momentum.meaning == "angular momentum about pivot along z"
    assert momentum.letter == r"L_{\mathrm{pivot},z}"
    claim = r"\frac{d}{dt} L_{\mathrm{cm},z} = 0"
    assert check(claim, equations("gyroscope")).answer.value == "fails"


def test_momenta_of_a_pivot_that_is_not_the_origin():
    """About the origin nothing is conserved that the pivot's force turns."""
    M, a, A, C, g, d = ph.symbols("M a I_2 I_1 g d", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    top = ph.Body("top", mass=M, inertia=(A, A, C), axes=axes, spin_about="3")
    aside = ph.Pivot(top, at=axes["3"] * -a, to=lab.vector(d, 0, 0), name="foot")
    found = ph.invariants(ph.derive(ph.System(top, aside, ph.Gravity(g), name="top")))
    assert [i.name for i in found] == ["E", "omega_3", "L_foot_z"]


def test_a_letter_is_not_used_for_two_directions():
    """Axes called x, y, z like those of the laboratory: L_z would be along the body's."""
    m, I_1, I_2, I_3 = ph.symbols("m I_1 I_2 I_3", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("a"), "z").rotated(ph.coordinate("b"), "x")
    axes = axes.rotated(ph.coordinate("c"), "y")
    body = ph.Body("body", mass=m, inertia=(I_1, I_2, I_3), axes=axes)
    found = ph.invariants(ph.derive(ph.System(ph.Pivot(body), name="body")))
    along_rest = [i for i in found if "along" in i.meaning]
    assert len(along_rest) == 3
    assert all(i.name.startswith("C_") for i in along_rest)
