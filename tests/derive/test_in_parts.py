"""What grows beyond use is kept under names, rather than worked at for hours."""

from collections.abc import Callable

import pytest

import polhode as ph
from derive import linkages
from polhode.derive import Equations


def test_a_loop_through_two_wheels_and_a_head_is_derived_in_parts() -> None:
    psi, phi, theta, delta = ph.coordinates("psi phi theta delta")
    tilt, *lengths = ph.symbols("lambda_ a b c d e f p q")
    mass, radius = ph.symbols("m r", positive=True)
    lab = ph.Frame("lab")
    lean = lab.rotated(psi, "z").rotated(phi, "x")
    rear = lean.rotated(theta, "y")
    fork = rear.rotated(tilt, "y").rotated(delta, "z")
    moments = (mass * radius**2, 2 * mass * radius**2, mass * radius**2)

    def wheel(name: str, axes: ph.Frame) -> ph.Body:
        return ph.Body(
            name, mass=mass, inertia=moments, axes=axes, spin_about="y", rim=radius, tag=name
        )

    def bar(name: str, axes: ph.Frame) -> ph.Body:
        return ph.Body(name, mass=mass, inertia=moments, axes=axes, tag=name)

    hind, front, frame, head = wheel("R", lean), wheel("F", fork), bar("B", rear), bar("H", fork)
    a, b, c, d, e, f, p, q = lengths
    ground = ph.Plane(lab)
    bicycle = ph.System(
        ph.Rolling(hind, on=ground, name="rear contact"),
        ph.Rolling(front, on=ground, name="front contact"),
        ph.Pivot(hind, to=frame.point(rear["x"] * a + rear["z"] * b), name="rear hub", force="G"),
        ph.Pivot(
            head,
            at=fork["x"] * c + fork["z"] * d,
            to=frame.point(rear["x"] * e + rear["z"] * f),
            name="steering",
            force="K",
        ),
        ph.Pivot(front, to=head.point(fork["x"] * p + fork["z"] * q), name="front hub", force="J"),
    )
    assert ph.derive(bicycle).in_parts


@pytest.mark.parametrize("declared", [linkages.four_bar, linkages.wheels_on_axle])
def test_what_elimination_outgrows_is_derived_in_parts(
    declared: Callable[[], Equations], monkeypatch: pytest.MonkeyPatch
) -> None:
    written = declared()
    undetermined = written.undetermined
    monkeypatch.setattr("polhode.algebra._elimination.LONGEST", 1)
    equations = declared.__wrapped__()  # type: ignore[attr-defined]
    assert equations.in_parts
    assert not written.in_parts
    assert equations.speeds == written.speeds
    assert equations.undetermined == undetermined
    assert equations.rate(equations.energy).is_zero
    for found, expected in zip(equations.mass.rows, written.mass.rows, strict=True):
        assert all((f - e).is_zero for f, e in zip(found, expected, strict=True))
