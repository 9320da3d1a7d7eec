"""One problem stated in different ways: other names of the axes, the other integrator."""

import numpy as np
import pytest

import polhode as ph
from simulate.contact.disks import numbers, with_friction
from simulate.contact.paper import LAST, case


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


@pytest.mark.parametrize("seed", [1, 6, 10])
def test_another_integrator(seed: int, monkeypatch) -> None:
    pytest.importorskip("heyoka")
    one = case(seed)
    monkeypatch.delenv("POLHODE_INTEGRATOR", raising=False)
    first = one.run()
    monkeypatch.setenv("POLHODE_INTEGRATOR", "heyoka")
    second = one.run()
    assert first.integrator != second.integrator
    assert [e.kind for e in first.events] == [e.kind for e in second.events]
    times = zip(first.events, second.events, strict=True)
    assert max(abs(a.time - b.time) for a, b in times) < 1e-9
    grid = np.linspace(0.0, LAST, 20)
    for name in ("x", "y", "v_x", "v_y"):
        assert np.abs(first.evaluate(name, grid) - second.evaluate(name, grid)).max() < 1e-9
