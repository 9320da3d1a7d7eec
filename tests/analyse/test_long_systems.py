"""First integrals of systems whose accelerations are too long to be written out."""

import polhode as ph


def chain(size: int, damping: bool = False) -> ph.Equations:
    """Pendulums, one hung from the other."""
    m, l, g, k = ph.symbols("m l g k", positive=True)
    lab, parts, before = ph.Frame("lab"), [], None
    for i in range(size):
        axes = lab.rotated(ph.coordinate(f"theta_{i}"), "x")
        bob = ph.Body(f"bob {i}", mass=m, axes=axes, tag=str(i))
        held = {} if before is None else {"to": before.point()}
        parts.append(ph.Pivot(bob, at=axes["z"] * l, name=f"pivot {i}", **held))
        before = bob
    if damping:
        parts.append(ph.Torque(before, before.axes["x"] * (-k * ph.coordinate("theta_0").dt())))
    return ph.derive(ph.System(*parts, ph.Gravity(g), name="chain"))


def test_six_pendulums_keep_their_energy_and_nothing_else_that_is_tried():
    found = ph.invariants(chain(6))
    assert [one.name for one in found] == ["E"]
    assert "too long to be written out" in str(found)


def test_with_a_damper_they_do_not():
    assert not ph.invariants(chain(6, damping=True))


def test_in_space_they_keep_momenta_too():
    """A free chain without gravity: linear and angular momentum about the origin."""
    m, r = ph.symbols("m r", positive=True)
    lab, parts, before = ph.Frame("lab"), [], None
    for i in range(4):
        axes = lab.rotated(ph.coordinate(f"theta_{i}"), "x")
        rod = ph.Body(f"rod {i}", mass=m, inertia=(m * r**2,) * 3, axes=axes, tag=str(i))
        if before is None:
            parts.append(ph.Pivot(rod, only="x", name="plane"))
        else:
            end = before.point(before.axes["z"] * -r)
            parts.append(ph.Pivot(rod, at=axes["z"] * r, to=end, name=f"pivot {i}"))
        before = rod
    found = ph.invariants(ph.derive(ph.System(*parts, name="free chain")))
    # The angular momenta about z and y are x₀ P_y and -x₀ P_z, with x₀ at rest: P_z follows.
    assert [one.name for one in found] == ["E", "C_1", "C_2", "C_3", "P_total_y"]
