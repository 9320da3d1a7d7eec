"""Quaternions against SciPy's rotations."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from polhode.view import _rotations

VECTORS = st.tuples(*[st.floats(-4, 4)] * 3)


def same(found, expected):
    """q and −q are one rotation."""
    signs = np.sign(np.sum(found * expected, axis=1))[:, None]
    assert found * signs == pytest.approx(expected, abs=1e-14)


@given(st.lists(VECTORS, min_size=1, max_size=5), st.lists(VECTORS, min_size=5, max_size=5))
def test_they_are_scipys(first, second):
    second = second[: len(first)]
    p, q = (Rotation.from_rotvec(np.array(v)) for v in (first, second))
    same(_rotations.about(np.array(first)), p.as_quat())
    same(_rotations.of_matrices(p.as_matrix()), p.as_quat())
    same(_rotations.product(p.as_quat(), q.as_quat()), (p * q).as_quat())
    same(_rotations.inverse(p.as_quat()), p.inv().as_quat())
    turned = p.apply(np.array(second))
    assert _rotations.applied(p.as_quat(), second) == pytest.approx(turned, abs=1e-14)
    assert _rotations.matrix(p[0].as_quat()) == pytest.approx(p[0].as_matrix(), abs=1e-15)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, -2, 0)])
def test_half_a_turn_has_no_scalar_part(axis):
    half = Rotation.from_rotvec(np.pi * np.array(axis) / np.linalg.norm(axis))
    same(_rotations.of_matrices(half.as_matrix()[None]), half.as_quat()[None])


def test_the_length_of_a_quaternion_does_not_matter():
    turn = np.array([0.1, -0.4, 0.3, 0.8])
    assert _rotations.matrix(3 * turn) == pytest.approx(_rotations.matrix(turn), abs=1e-15)
