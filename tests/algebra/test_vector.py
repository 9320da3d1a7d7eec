"""Vectors along triads that turn."""

from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from algebra.backends import KERNEL, a, evaluated, phi, simple, theta, theta_dot, x, y
from polhode.algebra import ZERO, Expr, Matrix, Vector, cos, rotation, sin, sqrt, zero_vector


@dataclass(frozen=True)
class Turned:
    """Turned by an angle about the z axis of inertial space."""

    angle: Expr

    def rotation_to(self, other: "Turned") -> Matrix:
        angle = self.angle - other.angle
        return rotation((ZERO, ZERO, Expr.of(1)), cos(angle), sin(angle))

    @property
    def turning(self):
        return (ZERO, ZERO, self.angle.dt())

    @property
    def angular_velocity(self) -> Vector:
        return Vector(self.turning, self)


SPACE, BODY, OTHER = Turned(ZERO), Turned(theta), Turned(phi + theta)
TRIADS = [SPACE, BODY, OTHER]

components = st.tuples(simple, simple, simple).map(
    lambda trees: tuple(evaluated(tree, KERNEL) for tree in trees)
)
vectors = st.builds(Vector.along, st.sampled_from(TRIADS), components)


@settings(max_examples=30)
@given(vectors, vectors, vectors)
def test_the_laws_of_products(u, v, w):
    assert u.dot(v) == v.dot(u)
    assert (u.cross(v) + v.cross(u)).is_zero
    assert u.cross(v).dot(u) == 0
    assert u.cross(v).dot(w) == v.cross(w).dot(u)
    triple = u.cross(v.cross(w)) - (v * u.dot(w) - w * u.dot(v))
    assert triple.is_zero


@settings(max_examples=30)
@given(vectors, vectors, st.sampled_from(TRIADS))
def test_products_do_not_depend_on_the_triad(u, v, triad):
    assert (u.express(triad) - u).is_zero
    assert u.express(triad).dot(v.express(triad)) == u.dot(v)
    assert (u.express(triad).cross(v) - u.cross(v)).is_zero


@settings(max_examples=30)
@given(vectors, vectors)
def test_the_rules_of_differentiation(u, v):
    assert u.dot(v).dt() == u.dt().dot(v) + u.dot(v.dt())
    assert (u.cross(v).dt() - u.dt().cross(v) - u.cross(v.dt())).is_zero
    assert (u.express(SPACE).dt() - u.dt()).is_zero


def test_a_vector_fixed_in_a_turning_triad():
    radius = Vector.along(BODY, (a, 0, 0))
    assert radius.dt() == Vector.along(BODY, (0, a * theta_dot, 0))
    assert radius.dt(seen_from=BODY).is_zero
    seen = radius.dt(seen_from=OTHER)
    assert seen == Vector.along(BODY, (0, -a * phi.dt(), 0))


def test_arithmetic():
    u = Vector.along(SPACE, (x, 2, 0))
    assert 3 * u == u * 3 == u + u + u
    assert a * u == u * a
    assert (u / a).component(Vector.along(SPACE, (1, 0, 0))) == x / a
    assert (u - u).is_zero
    assert zero_vector(BODY) + u == u
    assert -u + u == zero_vector(SPACE)
    assert u.norm() == sqrt(x**2 + 4)
    assert u.subs({x: y}) == Vector.along(SPACE, (y, 2, 0))
    assert u.diff(x) == Vector.along(SPACE, (1, 0, 0))


def test_dividing_a_vector_by_nothing():
    with pytest.raises(ZeroDivisionError):
        Vector.along(SPACE, (1, 0, 0)) / (x - x)
