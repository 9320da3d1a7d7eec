"""Lists where text is expected, and numbers where lists are: read, or refused in words."""

import pytest

import polhode as ph

LAB = ph.Frame("lab")
P = ph.point_mass("p", mass=1, axes=LAB)


def test_directions_and_names_may_be_lists():
    assert ph.Pivot(P, only=["x", "y"]).only == ph.Pivot(P, only="x y").only == ("x", "y")
    assert ph.Pivot(P, only="").only == ("x", "y", "z")
    assert ph.symbols(["a", "b"]) == ph.symbols("a b")
    assert LAB.rotated(1, "z", labels=["1", "2", "3"]).labels == ("1", "2", "3")


@pytest.mark.parametrize(
    "declared",
    [
        lambda: ph.Pivot(P, only=()),
        lambda: ph.Pivot(P, only=[]),
        lambda: ph.Pivot(P, only=0),
        lambda: ph.Pivot(P, only="x x"),
        lambda: ph.Pivot(P, only="q"),
        lambda: ph.Frame("a", labels=()),
        lambda: ph.Frame("a", labels="x y"),
        lambda: LAB.rotated(1, "z", labels="1 1 2"),
        lambda: ph.symbols(0),
        lambda: ph.coordinates(3),
        lambda: ph.functions([1]),
        lambda: ph.Matrix(0),
        lambda: ph.Matrix([0, 1]),
        lambda: ph.Matrix([[1, 2], [3]]),
        lambda: ph.Matrix("ab"),
        lambda: ph.Matrix.of(0),
        lambda: ph.Body("b", mass=1, inertia=ph.Matrix([[1, 0], [0, 1]]), axes=LAB),
        lambda: ph.System(P, independent=0),
        lambda: ph.System(P, speeds=0),
    ],
)
def test_what_cannot_be_read_is_refused_in_words(declared):
    with pytest.raises(ph.DeclarationError) as refused:
        declared()
    assert "expected" in str(refused.value)


def test_a_matrix_of_plain_numbers_is_exact():
    """An entry 0 was left a number without the methods of an expression."""
    matrix = ph.Matrix([[0, 1], [1, 0]])
    assert matrix.is_zero is False
    assert matrix @ matrix == ph.Matrix([[1, 0], [0, 1]])
    assert matrix.latex() == r"\begin{bmatrix} 0 & 1 \\ 1 & 0 \end{bmatrix}"
    body = ph.Body("b", mass=1, inertia=ph.Matrix([[2, 0, 0], [0, 2, 0], [0, 0, 3]]), axes=LAB)
    assert body.inertia.entries[8] == 3
