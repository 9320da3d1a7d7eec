"""The systems that the sentences of `sentences.json` are about."""

import polhode as ph

m, M, l, R, g, k, I, Omega = ph.symbols("m M l R g k I Omega", positive=True)
alpha = ph.symbol("alpha", positive=True)
theta, phi, psi = ph.coordinates("theta phi psi")
lab = ph.Frame("lab")

# A uniform rod of mass m and length l that swings about its upper end; θ from the downward
# vertical.
swung = lab.rotated(-theta, "y")
rod = ph.rod("rod", mass=m, length=l, axes=swung, axis="z")
pendulum = ph.System(
    ph.Pivot(rod, at=swung["z"] * (l / 2), name="pivot", along=swung),
    ph.Hinge(rod, axis="y"),
    ph.Gravity(g),
    name="rod pendulum",
)

# A bead on a smooth hoop of radius R that turns at the given rate Ω about its vertical diameter;
# θ from the lowest point.
hoop = ph.earth(Omega, colatitude=0).rotated(-theta, "y")
on_hoop = ph.point_mass("bead", mass=m, axes=hoop)
bead = ph.System(
    ph.Pivot(on_hoop, at=hoop["z"] * R, name="wire", along=hoop),
    ph.Hinge(on_hoop, axis="y"),
    ph.Gravity(g),
    name="bead on a rotating hoop",
)

# A solid cylinder of mass m and radius R that rolls down a slope α; y points down the slope.
slope = ph.Plane(lab, tilt=-alpha)
roller = ph.cylinder(
    "cylinder",
    mass=m,
    radius=R,
    height=2 * R,
    axes=slope.axes,
    axis="x",
    spin=ph.About("x", "beta"),
)
cylinder = ph.System(
    ph.Rolling(roller, on=slope, name="ground"),
    ph.Hinge(roller, axis="x"),
    ph.Gravity(g),
    name="cylinder on a slope",
)

# A symmetric top with a fixed point; I_1 and I_3 are moments of inertia about that point, its
# centre of mass lies at l along axis 3; θ from the upward vertical.
I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
spun = ph.Body("top", mass=M, inertia=(I_1 - M * l**2, I_1 - M * l**2, I_3), axes=axes)
top = ph.System(ph.Pivot(spun, at=axes["3"] * -l, along=lab), ph.Gravity(g), name="heavy top")

# A block of mass m on a smooth horizontal table, held by a spring of constant k; x from where the
# spring is relaxed.
cart = ph.point_mass("block", mass=m, axes=lab)
block = ph.System(
    ph.Pivot(cart, only="y z", name="table"),
    ph.Spring(cart.point(), lab["x"] * 0, stiffness=k),
    ph.Gravity(g),
    name="block on a spring",
)
