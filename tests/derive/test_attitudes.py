"""Which attitudes may be described by other angles, and which refer to the axes in between."""

import pytest

import polhode as ph
from polhode.derive import attitudes, derive_in_parts, with_turned_angles

LAB = ph.Frame("lab")
M, A, C = ph.symbols("M A C", positive=True)
PHI, THETA, PSI = ph.coordinates("phi theta psi")
FIRST = LAB.rotated(PHI, "z")
NUTATING = FIRST.rotated(THETA, "x")
FIXED = NUTATING.rotated(PSI, "z")


def names(system):
    return [tuple(q.published for q in attitude.angles) for attitude in attitudes(system)]


def body(axes, **options):
    return ph.Body("body", mass=M, inertia=(A, A, C), axes=axes, **options)


@pytest.mark.parametrize(
    "turned",
    [body(FIXED), body(FIXED, spin=ph.Components()), body(NUTATING, spin_about="z")],
)
def test_the_attitude_of_a_free_body(turned):
    assert names(ph.System(turned)) == [("phi", "theta", "psi")]


def test_a_support_may_name_its_forces_along_axes_in_between():
    """Held in all directions, the body moves alike whatever they are; held in some, it does not."""
    turned = body(NUTATING, spin_about="z")
    free = ph.System(ph.Pivot(turned, at=NUTATING["z"] * -A, along=FIRST))
    assert names(free) == [("phi", "theta", "psi")]
    slot = ph.System(ph.Pivot(turned, at=NUTATING["z"] * -A, along=FIRST, only="x y"))
    assert names(slot) == []


def test_a_constant_in_an_angle_is_no_hindrance():
    """As in the catalogue's gyroscope, whose axle is horizontal at θ = 90°."""
    nutating = FIRST.rotated(THETA - ph.pi / 2, "y")
    top = ph.Body("top", mass=M, inertia=(C, A, A), axes=nutating, spin_about="x")
    (attitude,) = attitudes(ph.System(top))
    assert attitude.alignment in (ph.cos(THETA), -ph.cos(THETA))


@pytest.mark.parametrize(
    "parts",
    [
        # rings with inertia: the angles are those of the rings, and never singular
        (body(FIXED), ph.Body("ring", mass=M, inertia=(A, A, A), axes=FIRST)),
        (body(FIXED), ph.Body("ring", mass=M, inertia=(A, A, A), axes=NUTATING)),
        # a couple about the line of nodes, and a force that depends on an angle
        (ph.Torque(body(FIXED), NUTATING["x"] * A),),
        (ph.Torque(body(NUTATING, spin_about="z"), NUTATING["x"] * A),),
        (ph.Torque(body(FIXED), LAB["z"] * (A * PHI)),),
        # two angles, four angles, and axes that are not perpendicular
        (body(NUTATING),),
        (body(FIXED.rotated(ph.coordinate("chi"), "x")),),
        (
            body(
                FIRST.rotated(THETA, (0, ph.Expr.constant(3) / 5, ph.Expr.constant(4) / 5)).rotated(
                    PSI, "z"
                )
            ),
        ),
    ],
)
def test_angles_that_cannot_be_counted_otherwise(parts):
    assert names(ph.System(*parts)) == []


def test_a_body_on_another_one_has_an_attitude_of_its_own():
    on = FIXED
    for name, axis in (("alpha", "x"), ("beta", "y"), ("gamma", "z")):
        on = on.rotated(ph.coordinate(name), axis)
    carried = ph.Body("carried", mass=M, inertia=(A, A, C), axes=on, tag="c")
    found = names(ph.System(body(FIXED), carried))
    assert found == [("phi", "theta", "psi"), ("alpha", "beta", "gamma")]


def test_the_same_system_in_turned_angles():
    """The energy is the same function of the attitude; the declaration is otherwise untouched."""
    turned = body(NUTATING, spin_about="z")
    pivot = ph.Pivot(turned, at=NUTATING["z"] * -A, name="tip")
    system = ph.System(pivot, ph.Gravity(ph.symbol("g")), name="top")
    (attitude,) = attitudes(system)
    other = with_turned_angles(system, [attitude])
    assert other.name == system.name
    assert other.body("body").mass == M
    assert [q.published for q in derive_in_parts(other).coordinates] == [
        "phi_turned",
        "theta_turned",
        "psi_turned",
    ]
    # the vertical of the declared pole lies across the turned first axis
    lab, axes = other.root, other.body("body").axes
    up = axes["z"].express(lab).components
    still = dict.fromkeys(attitude.turned_angles, 0)
    assert [c.subs(still) for c in up] == [0, -1, 0]
    assert ph.derive(system).coordinates[0].published == "phi"


def test_the_alignment_of_the_axes():
    (attitude,) = attitudes(ph.System(body(FIXED)))
    assert attitude.alignment == ph.cos(THETA)
    cardan = LAB.rotated(PHI, "x").rotated(THETA, "y").rotated(PSI, "z")
    (attitude,) = attitudes(ph.System(body(cardan)))
    assert attitude.alignment in (ph.sin(THETA), -ph.sin(THETA))
