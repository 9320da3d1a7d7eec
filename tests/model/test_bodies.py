"""Mass and inertia that a body can have are accepted, sharp cases too; shapes have theirs."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import Matrix
from polhode.model import check_inertia

m, a, b, c, h = ph.symbols("m a b c h", positive=True)
LAB = ph.Frame("lab")

numbers = st.integers(-9, 9).map(lambda n: Fraction(n, 4))
clouds = st.lists(st.tuples(st.integers(1, 9), numbers, numbers, numbers), min_size=1, max_size=5)


def inertia_of(cloud) -> list[list[Fraction]]:
    """Of point masses (mass, x, y, z) about the origin."""
    total = [[Fraction(0)] * 3 for _ in range(3)]
    for mass, *place in cloud:
        square = sum(x * x for x in place)
        for i in range(3):
            for j in range(3):
                total[i][j] += mass * ((square if i == j else 0) - place[i] * place[j])
    return total


@given(cloud=clouds)
def test_any_masses_anywhere_make_an_inertia(cloud) -> None:
    exact = inertia_of(cloud)
    assert check_inertia("cloud", exact) == Matrix.of(exact)
    rounded = [[float(entry) for entry in row] for row in exact]
    assert check_inertia("cloud", rounded) == Matrix.of(exact)


@given(cloud=clouds)
def test_their_principal_moments_do_in_floating_point(cloud) -> None:
    moments = np.linalg.eigvalsh(np.array(inertia_of(cloud), dtype=float))
    check_inertia("cloud", moments.tolist())


@given(moments=st.tuples(*[st.floats(0.01, 100)] * 3))
def test_three_moments_are_refused_exactly_where_no_triangle_has_these_sides(moments) -> None:
    longest, others = max(moments), sum(moments) - max(moments)
    assume(abs(longest - others) > 1e-9 * longest)
    if longest < others:
        assert check_inertia("body", moments).shape == (3, 3)
    else:
        with pytest.raises(ph.DeclarationError, match="triangle inequality"):
            check_inertia("body", moments)


def test_numbers_of_a_thin_disk_may_be_rounded() -> None:
    across = 0.1 * 0.07**2 / 4
    check_inertia("disk", (across, across, 0.1 * 0.07**2 / 2))
    check_inertia("disk", (across, across, across + across * (1 + 1e-15)))


def test_symbols_are_taken_at_their_word() -> None:
    moments = ph.symbols("I_1 I_2 I_3", positive=True)
    assert check_inertia("body", moments) == Matrix.diagonal(moments)


def moments(body: ph.Body) -> tuple[ph.Expr, ...]:
    assert body.inertia == Matrix.diagonal([body.inertia[i, i] for i in range(3)])
    return tuple(body.inertia[i, i] for i in range(3))


def test_shapes_have_the_moments_of_the_textbook() -> None:
    axes = {"mass": m, "axes": LAB}
    across, along = m * (3 * a**2 + h**2) / 12, m * a**2 / 2
    assert moments(ph.disk("d", radius=a, axis="z", **axes)) == (
        m * a**2 / 4, m * a**2 / 4, m * a**2 / 2,
    )  # fmt: skip
    assert moments(ph.hoop("h", radius=a, axis="x", **axes)) == (
        m * a**2, m * a**2 / 2, m * a**2 / 2,
    )  # fmt: skip
    assert moments(ph.sphere("s", radius=a, **axes)) == (2 * m * a**2 / 5,) * 3
    assert moments(ph.sphere("s", radius=a, inertia=c, **axes)) == (c, c, c)
    assert moments(ph.rod("r", length=h, axis="y", **axes)) == (m * h**2 / 12, 0, m * h**2 / 12)
    assert moments(ph.cylinder("c", radius=a, height=h, axis="z", **axes)) == (
        across, across, along,
    )  # fmt: skip
    assert moments(ph.ellipsoid("e", half_axes=(a, b, c), **axes)) == (
        m * (b**2 + c**2) / 5, m * (c**2 + a**2) / 5, m * (a**2 + b**2) / 5,
    )  # fmt: skip
    assert moments(ph.point_mass("p", **axes)) == (0, 0, 0)


def test_contacts_and_joints_are_called_by_what_they_are_and_the_tag() -> None:
    axes = LAB.rotated(ph.coordinates("theta")[0], "z")
    plain, tagged = (
        ph.Body("b", mass=m, inertia=(m, m, m), axes=axes, surface=ph.Round(a), tag=tag)
        for tag in ("", "2")
    )
    for body, suffix in ((plain, ""), (tagged, "_2")):
        plane = ph.Plane(LAB)
        assert ph.Rolling(body, on=plane).name == f"contact{suffix}"
        assert ph.Smooth(body, on=plane).name == f"contact{suffix}"
        assert ph.Coulomb(body, on=plane, mu=1).name == f"contact{suffix}"
        assert ph.Pivot(body).name == f"pivot{suffix}"
        assert ph.Weld(body).name == f"weld{suffix}"
        assert ph.Hold(body, at=LAB.zero).name == f"hold{suffix}"
        assert ph.Hinge(body, axis="z").name == f"hinge{suffix}"
        assert ph.Motor(body, axis="z", rate=1).name == f"motor{suffix}"
        arms = {"arm": axes["x"], "other_arm": LAB["z"]}
        assert ph.Universal(body, **arms).name == f"universal{suffix}"
        assert ph.Guide(body, axis="x", normal=LAB["z"], label="z").name == f"guide{suffix}"


def test_boxes_and_cones_have_the_inertia_of_their_points() -> None:
    """Against sums over boxes within a box, and over disks within a cone."""
    body = ph.box("box", mass=m, sides=(a, b, c), axes=LAB)
    assert body.inertia == Matrix.diagonal(
        [m * (b**2 + c**2) / 12, m * (c**2 + a**2) / 12, m * (a**2 + b**2) / 12]
    )
    # of eight boxes of half its sides, by the theorem of parallel axes
    part = ph.box("part", mass=m / 8, sides=(a / 2, b / 2, c / 2), axes=LAB).inertia
    moved = [m / 8 * (b**2 + c**2) / 16, m / 8 * (c**2 + a**2) / 16, m / 8 * (a**2 + b**2) / 16]
    assert body.inertia == Matrix.diagonal([8 * (part[i, i] + moved[i]) for i in range(3)])
    cone = ph.cone("cone", mass=1.0, radius=0.3, height=0.7, axes=LAB.rotated(0, "z", "1 2 3"))
    z, weight = np.polynomial.legendre.leggauss(6)
    z, radius = 0.7 * (1 + z) / 2, 0.3 * (1 - (1 + z) / 2)  # from the base to the apex
    masses = 3 / 0.3**2 * radius**2 * weight / 2
    height = np.sum(masses * z)
    assert height == pytest.approx(0.7 / 4)
    about = np.sum(masses * radius**2) / 2
    across = np.sum(masses * (radius**2 / 4 + (z - height) ** 2))
    moments = ph.compile_program([cone.inertia[i, i] for i in range(3)], ()).function()()
    assert list(moments) == pytest.approx([across, across, about])


@pytest.mark.parametrize("sides", [(1, 2), (1, 2, -3), "abc"])
def test_a_box_has_three_positive_sides(sides) -> None:
    with pytest.raises(ph.DeclarationError):
        ph.box("box", mass=1, sides=sides, axes=LAB)


def test_a_contact_names_the_corner_of_a_box() -> None:
    box = ph.box("box", mass=m, sides=(a, b, c), axes=LAB)
    with pytest.raises(ph.DeclarationError, match=r"corner that touches.*at=axes\.vector"):
        ph.Smooth(box, on=ph.Plane(LAB))
    assert not box.surface.is_symmetric(LAB, 2)
    square = ph.box("square", mass=m, sides=(a, a, c), axes=LAB)
    assert square.surface.is_symmetric(LAB, 2)
    assert not square.surface.is_symmetric(LAB, 0)


def test_an_upright_cone_stands_on_the_edge_of_its_base_until_its_side_touches() -> None:
    """Released leaning, it falls on its edge: the apex comes down to the table."""
    theta, axes = ph.coordinate("theta"), LAB.rotated(ph.coordinate("theta"), "y", "1 2 3")
    cone = ph.cone("cone", mass=1, radius=a, height=h, axes=axes, spin=ph.WithAxes())
    leaning = cone.surface.assumed_positive(axes, LAB["z"])
    program = ph.compile_program(leaning[-1:], (theta.symbol, a.symbol, h.symbol))
    (above,) = program.function()(0.3, 0.3, 0.7)
    assert above == pytest.approx(0.7 * np.cos(0.3) + 0.3 * np.sin(0.3))
