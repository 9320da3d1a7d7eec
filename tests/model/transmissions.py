"""Systems with gears, ropes and equations as constraints."""

import polhode as ph

LAB = ph.Frame("lab")
X, Z = LAB["x"], LAB["z"]
M, J, R, g, k = ph.symbols("M J R g k", positive=True)
ALPHA = ph.coordinate("alpha")


def atwood():
    """Two masses on a rope that turns a pulley about y without slipping."""
    m_1, m_2 = ph.symbols("m_1 m_2", positive=True)
    turned = LAB.rotated(ALPHA, "y")
    pulley = ph.Body("pulley", mass=M, inertia=(J, J, J), axes=turned, tag="p")
    left = ph.point_mass("left", mass=m_1, axes=LAB, tag="1")
    right = ph.point_mass("right", mass=m_2, axes=LAB, tag="2")
    return ph.System(
        ph.Pivot(pulley, name="axle"),
        ph.Hinge(pulley, axis="y"),
        ph.Rope([left.point(), pulley.point(X * -R)], directions=[Z], name="left rope"),
        ph.Rope([right.point(), pulley.point(X * R)], directions=[Z], name="right rope"),
        ph.Pivot(left, to=X * -R, only="x y", name="left guide"),
        ph.Pivot(right, to=X * R, only="x y", name="right guide"),
        ph.Gravity(g),
        name="Atwood",
    )


def everything() -> ph.System:
    """One of each transmission and potential, whether or not they fit together."""
    wheel = ph.Body("wheel", mass=M, inertia=(J, J, J), axes=LAB.rotated(ALPHA, "z"))
    other = ph.Body("other", mass=M, inertia=(J, J, J), axes=LAB, tag="o")
    return ph.System(
        ph.Gear(wheel, radius=R, to=other, other_radius=2 * R, axis=Z, teeth="internal"),
        ph.Rack(wheel, at=X * R, along=LAB["y"], to=other),
        ph.Screw(wheel, axis=Z, pitch=k, to=other),
        ph.Slider(other, axis="x", to=X * R),
        ph.KnifeEdge(wheel, across="y"),
        ph.Constraint("y_o = R*alpha", on=(wheel, other), where={"R": R}),
        ph.Potential(k * R * ALPHA, on=wheel),
        ph.TorsionSpring(ALPHA, stiffness=k, rest=1, on=wheel),
        ph.TorsionDamper(ALPHA, damping=k, on=wheel),
        ph.CentralForce(wheel.point(), other.point(), energy=-k / R, distance=R),
        ph.MagneticMoment(other, X * k, Z * g),
        ph.Rope([wheel.point(), other.point(), X * R]),
        name="everything",
    )
