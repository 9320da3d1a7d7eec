"""The same equations with distances and slip speeds as one quantity each."""

import pytest

import polhode as ph
from literature.published_forms import FORMS
from polhode.algebra import lengths_written_out

m, M, k, l, a, g = ph.symbols("m M k l a g", positive=True)
LAB = ph.Frame("lab")
X, Y, Z = (LAB[n] for n in "xyz")


def swinging_atwood_machine():
    """A rope over two pulleys, whose directions are not declared."""
    bob = ph.point_mass("bob", mass=m, axes=LAB, tag="1")
    weight = ph.point_mass("weight", mass=M, axes=LAB, tag="2")
    return ph.System(
        ph.Pivot(bob, only="y", name="plane"),
        ph.Pivot(weight, to=X * a, only="x y", name="guide", force="G"),
        ph.Rope([bob.point(), X * 0, X * a, weight.point()]),
        ph.Gravity(g),
    )


def towed():
    """Two particles on a rope."""
    one = ph.point_mass("one", mass=m, axes=LAB, tag="1")
    two = ph.point_mass("two", mass=M, axes=LAB, tag="2")
    return ph.System(one, two, ph.Rope([one.point(), two.point()]))


SYSTEMS = {name: form.build for name, form in FORMS.items() if form.lengths} | {
    "swinging Atwood machine": swinging_atwood_machine,
    "two on a rope": towed,
}


@pytest.mark.parametrize("name", SYSTEMS)
def test_written_out_they_are_the_same(name):
    equations = ph.derive(SYSTEMS[name]())
    short = equations.in_lengths
    assert short is not equations
    assert short.in_lengths is short
    assert short.speeds == equations.speeds
    if equations.motion_in_parts:
        assert all(not (one - other) for one, other in zip(short.rows, equations.rows, strict=True))
        return
    assert tuple(map(lengths_written_out, short.rows)) == equations.rows
    assert tuple(map(lengths_written_out, short.mass.entries)) == tuple(equations.mass.entries)
    for quantity, value in equations.components.items():
        other = lengths_written_out(short.components[quantity])
        assert other == value or not equations.on_shell(other - value)
    assert lengths_written_out(short.energy) == equations.energy


def test_without_lengths_they_are_the_equations_themselves():
    for name in ("plane pendulum", "rolling disk", "gyroscope"):
        equations = ph.derive(FORMS[name].build())
        assert equations.in_lengths is equations
        assert equations.lengths == {}


def test_they_are_what_is_printed():
    equations = ph.derive(FORMS["sliding billiard ball"].build())
    printed = str(equations).splitlines()
    assert "  2 R ω̇ₓ + 5 g μ (v_y + R ωₓ)/|v_c| = 0" in printed
    assert "  |v_c| = √((vₓ − R ω_y)² + (v_y + R ωₓ)²)" in printed
    assert r"\left|v_c\right| &= \sqrt{" in equations.latex()


def test_several_lengths_have_numbers_in_their_order():
    equations = ph.derive(FORMS["three bodies"].build())
    assert [*equations.lengths] == ["rho_1", "rho_2", "rho_3"]
    one, two = (equations.lengths[f"rho_{i}"].meaning for i in (1, 3))
    assert str(one) == "sqrt((x_1 - x_2)**2 + (y_1 - y_2)**2 + (z_1 - z_2)**2)"
    assert str(two) == "sqrt((x_2 - x_3)**2 + (y_2 - y_3)**2 + (z_2 - z_3)**2)"


def test_a_letter_of_the_declaration_is_left_alone():
    (rho,) = ph.symbols("rho", positive=True)
    one = ph.point_mass("one", mass=rho, axes=LAB, tag="1")
    spring = ph.Spring(one.point(), X * a, stiffness=k, length=l)
    assert [*ph.derive(ph.System(one, spring)).lengths] == ["r"]


def test_a_root_that_is_no_length_has_no_letter():
    """1/√(1 + θ²) is a number."""
    theta = ph.coordinate("theta")
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(theta, "y"))
    stored = ph.Potential(m * g * l / ph.sqrt(1 + theta**2), on=[bob])
    system = ph.System(ph.Pivot(bob, at=bob.axes["z"] * l), stored)
    assert ph.derive(system).lengths == {}


def test_springs_of_a_body_in_general_attitude_are_derived():
    """Two springs, whose lengths multiplied out would take minutes to be added."""
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    moments = ph.symbols("I_1 I_2 I_3", positive=True)
    body = ph.Body("body", mass=m, inertia=moments, axes=axes, spin=ph.Components())
    springs = [
        ph.Spring(body.point(axes[n] * a), end * a, stiffness=k, length=l, name=f"spring {n}")
        for n, end in (("1", X), ("2", Y))
    ]
    equations = ph.derive(ph.System(body, ph.Gravity(g), *springs))
    short = equations.in_lengths
    assert short is not equations
    assert max(len(row.num) for row in short.rows) < 20
    assert all(not (one - two) for one, two in zip(short.rows, equations.rows, strict=True))
    assert sorted(equations.lengths) == ["rho_1", "rho_2"]
