"""The geometry of three rotations against products of rotation matrices."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from polhode.simulate._three_angles import PoleChoice, ThreeAngles

E = np.eye(3)
SEQUENCES = {
    "zxz": E[[2, 0, 2]],
    "xyz": E[[0, 1, 2]],
    "zyx": E[[2, 1, 0]],
    "oblique": np.array([[0, 0, 1.0], [1, 0, 0], [0, 0.6, 0.8]]),
}


def matrix(axes, angles):
    turns = [Rotation.from_rotvec(axis * q) for axis, q in zip(axes, angles, strict=True)]
    return (turns[0] * turns[1] * turns[2]).as_matrix()


@pytest.mark.parametrize("axes", SEQUENCES.values(), ids=SEQUENCES.keys())
def test_angles_axes_and_rates(axes):
    three, draws = ThreeAngles(*axes), np.random.default_rng(7)
    for _ in range(20):
        angles, rates, second = draws.uniform(-3, 3, (3, 3))
        turned, attitude = matrix(axes, angles), three.attitude(angles)
        assert attitude.third == pytest.approx(turned @ axes[2], abs=1e-14)
        assert attitude.mark == pytest.approx(turned @ axes[1], abs=1e-14)
        side = float(np.sign(np.sin(angles[1] - three.offset)))
        found = three.angles(attitude, PoleChoice(side), 0.0)
        assert np.exp(1j * found) == pytest.approx(np.exp(1j * angles), abs=1e-12)
        # the other side describes the same attitude
        assert matrix(axes, three.angles(attitude, PoleChoice(-side), 0.0)) == pytest.approx(
            turned, abs=1e-12
        )
        omega = three.angular_velocity(angles, rates)
        assert three.rates(angles, omega, PoleChoice()) == pytest.approx(rates, abs=1e-9)
        step = 1e-5
        before, after = (matrix(axes, angles + s * step * rates) for s in (-1, 1))
        spin = (after - before) / (2 * step) @ turned.T
        assert omega == pytest.approx([spin[2, 1], spin[0, 2], spin[1, 0]], abs=1e-7)
        moved = [
            three.angular_velocity(
                angles + s * step * rates + step**2 / 2 * second, rates + s * step * second
            )
            for s in (-1, 1)
        ]
        numeric = (moved[1] - moved[0]) / (2 * step)
        exact = three.angular_acceleration(angles, rates, second)
        assert exact == pytest.approx(numeric, abs=1e-6)


@pytest.mark.parametrize("axes", SEQUENCES.values(), ids=SEQUENCES.keys())
def test_turned_axes(axes):
    three = ThreeAngles(*axes)
    quarter = Rotation.from_rotvec(axes[1] * np.pi / 2)
    vector = np.array([0.3, -1.2, 0.7])
    assert three.turned(vector) == pytest.approx(quarter.inv().apply(vector), abs=1e-15)
    assert three.turned_back(three.turned(vector)) == pytest.approx(vector, abs=1e-15)
    angles = np.array([0.4, 1.1, -0.8])
    third = three.attitude(angles).third
    declared, own = three.sines(angles[0], angles[1])
    assert own == pytest.approx(np.linalg.norm(np.cross(third, axes[0])), abs=1e-14)
    back = np.cross(three.turned_back(third), axes[0])
    assert declared == pytest.approx(np.linalg.norm(back), abs=1e-14)
