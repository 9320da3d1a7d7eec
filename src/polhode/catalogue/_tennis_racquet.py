"""Problem 5: a free rigid body near its middle axis."""

import polhode as ph
from polhode.catalogue._entry import CatalogueEntry, Parameter


def _racquet() -> ph.System:
    m, *moments = ph.symbols("m I_1 I_2 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    turned = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x")
    axes = turned.rotated(psi, "z", labels="1 2 3", name="axes")
    racquet = ph.Body("racquet", mass=m, inertia=moments, axes=axes, spin=ph.Components())
    return ph.System(ph.Pivot(racquet, name="centre"), name="tennis-racquet")


TENNIS_RACQUET = CatalogueEntry(
    name="tennis-racquet",
    title="Tennis racquet",
    about=(
        "A rigid body with I₁ < I₂ < I₃ turns freely about its centre of mass, which is taken at "
        "rest. Set turning almost about the middle axis it flips over, again and again."
    ),
    build=_racquet,
    parameters=(
        Parameter("m", "kg", "0.33 kg", "mass"),
        Parameter("I_1", "kg m^2", "0.0012 kg m^2", "least principal moment of inertia"),
        Parameter("I_2", "kg m^2", "0.0164 kg m^2", "middle principal moment of inertia"),
        Parameter("I_3", "kg m^2", "0.0176 kg m^2", "greatest principal moment of inertia"),
    ),
    start={
        "theta": "90 deg",
        "omega_1": "0.01 rad/s",
        "omega_2": "10 rad/s",
        "omega_3": "0.01 rad/s",
    },
    duration="20 s",
    plots=(("omega_1", "omega_2", "omega_3"),),
)
