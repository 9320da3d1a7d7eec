"""One problem stated in different ways: rotated worlds, other units, the other integrator."""

import numpy as np
import pytest

import polhode as ph
from simulate.contact.balls import on_table
from simulate.contact.disks import numbers, with_friction
from simulate.contact.paper import LAST, case

BALL = {"m": 0.3, "a": 0.05, "k": 0.4, "g": 9.81, "mu": 0.2, "mu_s": 0.25, "e": 0.5}


def turned(x: float, y: float, angle: float) -> tuple[float, float]:
    c, s = np.cos(angle), np.sin(angle)
    return c * x - s * y, s * x + c * y


@pytest.mark.parametrize("angle", [np.pi / 4, np.pi / 2, 2.0, -3.0])
def test_ball_along_any_direction(angle: float) -> None:
    """Thrown, bouncing, slipping and rolling: the same along the axes and along diagonals."""

    def thrown(by: float):
        v, w = turned(1.5, 0.3, by), turned(4.0, -20.0, by)
        start = {"v_x": v[0], "v_y": v[1], "omega_x": w[0], "omega_y": w[1], "z": 0.2, "v_z": 0}
        return ph.simulate(on_table(), BALL, start, 2.0, samples=2)

    one, other = thrown(0.0), thrown(angle)
    assert [e.kind for e in one.events] == [e.kind for e in other.events]
    times = zip(one.events, other.events, strict=True)
    assert max(abs(a.time - b.time) for a, b in times) < 1e-12
    for first, second in (("x", "y"), ("v_x", "v_y"), ("omega_x", "omega_y")):
        expected = turned(one.final[first], one.final[second], angle)
        found = (other.final[first], other.final[second])
        scale = 1 + np.hypot(*expected)
        assert np.abs(np.subtract(found, expected)).max() < 1e-12 * scale


def test_disk_in_any_direction() -> None:
    start = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 20.0}
    one = ph.simulate(with_friction(), numbers(0.2), start, 0.5, samples=2)
    other = ph.simulate(with_friction(), numbers(0.2), {**start, "phi": 0.8}, 0.5, samples=2)
    assert [e.kind for e in one.events] == [e.kind for e in other.events]
    assert abs(one.final["theta"] - other.final["theta"]) < 1e-11
    expected = turned(one.final["x"], one.final["y"], 0.8)
    assert np.abs(np.subtract((other.final["x"], other.final["y"]), expected)).max() < 1e-11


def test_disk_in_other_axes() -> None:
    """All axes moved on by one, z to x: the same slips, falls and places."""
    m, a, g = ph.symbols("m a g", positive=True)
    mu, mu_s, e = ph.symbols("mu mu_s e")
    lab = ph.Frame("lab")
    theta, phi = ph.coordinates("theta phi")
    axes = lab.rotated(phi, "x").rotated(theta, "y", labels="3 1 2", name="axes")
    disk = ph.disk("disk", mass=m, radius=a, axes=axes)
    touch = ph.Coulomb(disk, on=ph.Plane(lab, normal="x"), mu=mu, mu_static=mu_s, restitution=e)
    moved = ph.System(touch, ph.Gravity(g, up=lab["x"]))
    start = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 20.0}
    one = ph.simulate(with_friction(), numbers(0.2), start, 0.5, samples=2)
    other = ph.simulate(moved, numbers(0.2), start, 0.5, samples=2)
    assert [event.kind for event in one.events] == [event.kind for event in other.events]
    times = zip(one.events, other.events, strict=True)
    assert max(abs(a.time - b.time) for a, b in times) < 1e-11
    for name, same in (("theta", "theta"), ("omega_3", "omega_3"), ("x", "y"), ("y", "z")):
        assert abs(one.final[name] - other.final[same]) < 1e-10 * (1 + abs(one.final[name]))


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_rescaled(scale: float) -> None:
    """Lengths by λ and times by √λ: the same motion."""
    start = {"v_x": 1.5, "omega_y": -20.0, "z": 0.2, "v_z": 0.0}
    one = ph.simulate(on_table(), BALL, start, 2.0, samples=2)
    root = np.sqrt(scale)
    powers = {"v_x": root, "omega_y": 1 / root, "z": scale, "v_z": root}
    small = {name: value * powers[name] for name, value in start.items()}
    parameters = BALL | {"a": BALL["a"] * scale}
    other = ph.simulate(on_table(), parameters, small, 2.0 * root, samples=2)
    assert [e.kind for e in one.events] == [e.kind for e in other.events]
    times = zip(one.events, other.events, strict=True)
    assert max(abs(a.time - b.time / root) for a, b in times) < 1e-12
    assert abs(one.final["x"] - other.final["x"] / scale) < 1e-12


@pytest.mark.parametrize("seed", [1, 6, 10])
def test_the_other_integrator(seed: int, monkeypatch) -> None:
    pytest.importorskip("heyoka")
    one = case(seed)
    first = one.run()
    monkeypatch.setenv("POLHODE_INTEGRATOR", "scipy")
    second = one.run()
    assert first.integrator != second.integrator
    assert [e.kind for e in first.events] == [e.kind for e in second.events]
    times = zip(first.events, second.events, strict=True)
    assert max(abs(a.time - b.time) for a, b in times) < 1e-9
    grid = np.linspace(0.0, LAST, 20)
    for name in ("x", "y", "v_x", "v_y"):
        assert np.abs(first.evaluate(name, grid) - second.evaluate(name, grid)).max() < 1e-9
