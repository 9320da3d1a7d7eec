"""Scenes of systems whose parts are not all supports and bodies with numbers."""

import pytest

import polhode as ph


def test_a_constraint_on_a_body_is_no_support(tmp_path):
    """Nor does a page need the mass of a wheel that the motion does not depend on."""
    m, I, R, tau = ph.symbols("m I R tau", positive=True)
    lab = ph.Frame("lab")
    wheels = [
        ph.Body(name, mass=m, inertia=(I, I, I), axes=lab.rotated(ph.coordinate(q), "y"), tag=tag)
        for name, q, tag in (("near", "alpha", "n"), ("far", "beta", "f"))
    ]
    axles = [part for w in wheels for part in (ph.Pivot(w), ph.Hinge(w, axis="y"))]
    belt = ph.Constraint("alpha - R*beta = 0", on=tuple(wheels), where={"R": R})
    system = ph.System(*axles, belt, ph.Torque(wheels[0], lab["y"] * tau))
    run = ph.simulate(system, {"I": 0.1, "R": 2.0, "tau": 0.3}, {}, "1 s")
    assert run.final["alpha"] == pytest.approx(0.3 / (0.1 * (1 + 1 / 4)) / 2, abs=1e-13)
    ph.page(run, tmp_path / "belt.html")
