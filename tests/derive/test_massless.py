"""Massless links, pulleys and gimbals: they pass on forces, and change no motion."""

import pytest

import polhode as ph
from polhode.base import NumericError

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
M, m, R, a, b, g, A, C = ph.symbols("M m R a b g A C", positive=True)
PHI, THETA, ALPHA = ph.coordinates("phi theta alpha")


def _dumbbell(*held):
    """Two masses on a massless rod that turns about x."""
    axes = LAB.rotated(THETA, "x")
    rod = ph.Body("rod", mass=0, axes=axes, tag="r")
    ends = ((m, a, "1"), (M, -b, "2"))
    masses = [
        ph.Pivot(
            ph.point_mass(f"mass {tag}", mass=mass, axes=axes, tag=tag),
            to=rod.point(axes["z"] * place),
            name=f"end {tag}",
        )
        for mass, place, tag in ends
    ]
    joints = (ph.Pivot(rod, name="pivot", **dict(held)), ph.Hinge(rod, axis="x"))
    return ph.derive(ph.System(*joints, *masses, ph.Gravity(g)))


def test_two_masses_on_a_massless_rod_swing_as_one_rigid_body():
    equations = _dumbbell()
    torque = g * (m * a - M * b) * ph.sin(THETA)
    swing = equations.on_shell(THETA.dt().dt())
    assert (swing - torque / (m * a**2 + M * b**2)).is_zero
    axes = LAB.rotated(THETA, "x")
    inertia = m * a**2 + M * b**2 - (m * a - M * b) ** 2 / (m + M)
    centre = axes["z"] * ((m * a - M * b) / (m + M))
    rigid = ph.Body("rigid", mass=m + M, inertia=(inertia, inertia, 0), axes=axes)
    whole = ph.derive(
        ph.System(ph.Pivot(rigid, at=-centre), ph.Hinge(rigid, axis="x"), ph.Gravity(g))
    )
    assert (whole.on_shell(THETA.dt().dt()) - swing).is_zero
    for label in "xyz":
        own, other = equations.components[f"F_{label}_r"], whole.components[f"F_{label}"]
        assert (equations.on_shell(own) - whole.on_shell(other)).is_zero
    assert equations.rate(equations.energy).is_zero


def test_a_free_dumbbell_turns_at_a_constant_rate_as_it_falls():
    equations = _dumbbell(("only", "x"))
    assert equations.on_shell(THETA.dt().dt()).is_zero
    # the massless rod passes on the force between the masses: μ l θ̇², with the reduced mass μ
    pull = equations.reactions["end 1"].force.dot(LAB.rotated(THETA, "x")["z"])
    reduced = m * M / (m + M)
    assert (equations.on_shell(pull) + reduced * (a + b) * THETA.dt() ** 2).is_zero


def test_atwood_machine_with_a_massless_pulley():
    # Kleppner and Kolenkow, An Introduction to Mechanics, ex. 2.6: T = 2 m₁ m₂ g/(m₁ + m₂)
    pulley = ph.Body("pulley", mass=0, axes=LAB.rotated(ALPHA, "y"), tag="p")
    parts = [ph.Pivot(pulley, name="axle"), ph.Hinge(pulley, axis="y"), ph.Gravity(g)]
    for mass, side, tag in ((m, -1, "1"), (M, 1, "2")):
        weight = ph.point_mass(f"weight {tag}", mass=mass, axes=LAB, tag=tag)
        rim = pulley.point(X * (side * R))
        parts += [
            ph.Rope([weight.point(), rim], directions=[Z], name=f"rope {tag}"),
            ph.Pivot(weight, to=X * (side * R), only="x y", name=f"guide {tag}"),
        ]
    equations = ph.derive(ph.System(*parts))
    tension = 2 * m * M * g / (m + M)
    for name in ("S_1", "S_2"):
        assert (equations.on_shell(equations.components[name]) - tension).is_zero
    assert (equations.on_shell(equations.components["F_z_p"]) - 2 * tension).is_zero


def test_massless_gimbals_leave_a_gyroscope_as_it_is_without_them():
    outer = LAB.rotated(PHI, "z")
    inner = outer.rotated(THETA, "x")
    ring = ph.Body("outer gimbal", mass=0, axes=outer, tag="o")
    frame = ph.Body("inner gimbal", mass=0, axes=inner, tag="i")
    rotor = ph.Body("rotor", mass=m, inertia=(A, A, C), axes=inner, spin_about="z")
    gimballed = ph.derive(
        ph.System(
            ph.Pivot(ring, name="outer bearing"),
            ph.Hinge(ring, axis="z", name="outer hinge"),
            ph.Pivot(frame, to=ring.point(), name="inner bearing"),
            ph.Hinge(frame, axis="x", to=ring, name="inner hinge"),
            ph.Pivot(rotor, to=frame.point(), name="rotor bearing"),
            ph.Hinge(rotor, axis="z", to=frame, name="rotor hinge"),
        )
    )
    free = ph.derive(ph.System(ph.Pivot(rotor)))
    assert gimballed.motion == free.motion
    numbers, start = {"m": 1, "A": 1, "C": 2}, {"theta": 1, "phi_dot": 0.3, "omega_z": 5}
    run = ph.simulate(gimballed.system, numbers, start, "1 s")
    assert run.drift.energy < 1e-13


def test_two_links_about_one_axis_are_named():
    """Their angles turn the same bob: one combination moves only the massless link."""
    link = ph.Body("link", mass=0, axes=LAB.rotated(PHI, "y"), tag="l")
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(PHI, "y").rotated(THETA, "y"))
    parts = (
        ph.Pivot(link, name="shoulder"),
        ph.Hinge(link, axis="y"),
        ph.Pivot(bob, at=bob.axes["z"] * a, to=link.point(), name="elbow", force="G"),
        ph.Gravity(g),
    )
    with pytest.raises(NumericError, match="link, whose motion with theta_dot no mass"):
        ph.derive(ph.System(*parts))
