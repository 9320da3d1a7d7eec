"""Problem 4: a gyrocompass on the turning Earth."""

import polhode as ph
from polhode.catalogue._entry import CatalogueEntry, Parameter


def _rotor_and_supports() -> tuple[ph.Body, ph.Pivot, ph.Guide]:
    m, first, third = ph.symbols("m I_1 I_3", positive=True)
    ground = ph.earth(
        ph.symbol("Omega"), colatitude=ph.symbol("lambda_"), directions="up east north"
    )
    # Positive θ turns the axle from north to east, which about the upward vertical is negative.
    axes = ground.rotated(-ph.coordinate("theta"), "x", labels="1 2 3", name="axes")
    spin = ph.Relative("3", "omega")
    rotor = ph.Body("rotor", mass=m, inertia=(first, first, third), axes=axes, spin=spin)
    gimbal = ph.Guide(rotor, axis="3", normal=ground["x"], label="2", name="guide")
    return rotor, ph.Pivot(rotor, along=axes, name="centre"), gimbal


def _free() -> ph.System:
    return ph.System(*_rotor_and_supports(), name="gyrocompass")


def _driven() -> ph.System:
    rotor, centre, guide = _rotor_and_supports()
    motor = ph.Motor(rotor, axis="3", rate=ph.symbol("omega_0"))
    return ph.System(rotor, centre, guide, motor, name="gyrocompass/motor")


_PARAMETERS = (
    Parameter("m", "kg", "1 kg", "mass of the rotor, a hoop"),
    Parameter("a", "m", "0.1 m", "radius of the rotor"),
    Parameter("I_1", "kg m^2", "m*a**2/2", "moment of inertia about a diameter"),
    Parameter("I_3", "kg m^2", "m*a**2", "moment of inertia about the axle"),
    Parameter("Omega", "rad/s", "7.2921159e-5 rad/s", "angular velocity of the Earth"),
    Parameter("lambda_", "", "50 deg", "colatitude"),
)
_CONVENTION = (
    "Axis 1 is vertical, 3 the axle at θ to the north in the horizontal plane, so that the axes "
    "turn at -θ̇ about 1."
)

GYROCOMPASS = CatalogueEntry(
    name="gyrocompass",
    title="Gyrocompass",
    about=(
        "A spinning rotor whose axle is kept horizontal on the turning Earth swings about the "
        f"north. {_CONVENTION} Nothing acts about the axle."
    ),
    build=_free,
    parameters=_PARAMETERS,
    start={"theta": "20 deg", "omega": "3000 rpm"},
    duration="120 s",
    plots=(("theta",), ("omega",), ("tau_2",)),
)

MOTOR_DRIVEN = CatalogueEntry(
    name="gyrocompass/motor",
    title="Gyrocompass with a motor",
    about=(
        "The same gyrocompass with a motor that keeps the spin relative to the axes constant, and "
        f"the torque it needs. {_CONVENTION}"
    ),
    build=_driven,
    parameters=(*_PARAMETERS, Parameter("omega_0", "rad/s", "3000 rpm", "rate kept by the motor")),
    start={"theta": "20 deg"},
    duration="120 s",
    plots=(("theta",), ("tau_2",), ("tau_3",)),
)
