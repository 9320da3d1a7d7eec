"""Problem 7: a gyroscope with one point fixed, and the force on its pivot."""

import polhode as ph
from polhode.catalogue._entry import GRAVITY, CatalogueEntry, Parameter


def _top() -> tuple[ph.Body, ph.Pivot, ph.Gravity]:
    mass, a, first, second, g = ph.symbols("M a I_1 I_2 g", positive=True)
    # Directions ρ, φ, z that turn with the azimuth φ about the vertical (problem 7).
    cylindrical = ph.Frame("lab").rotated(
        ph.coordinate("phi"), "z", labels="rho phi z", name="cylindrical"
    )
    # Axes 1 along the axle at θ to the vertical, 2 along φ, 3 = 1 × 2 (equation 90).
    theta = ph.coordinate("theta")
    axes = cylindrical.rotated(theta - ph.pi / 2, "phi", labels="1 2 3", name="axes")
    moments = (first, second, second)
    top = ph.Body("gyroscope", mass=mass, inertia=moments, axes=axes, spin_about="1")
    return top, ph.Pivot(top, at=axes["1"] * -a, along=cylindrical), ph.Gravity(g)


def _with_hand(only: str, name: str) -> ph.System:
    """The gyroscope also held at the far end of its axle, a distance 2a from the pivot."""
    top, pivot, gravity = _top()
    hand = ph.Hold(top, at=-pivot.at, along=pivot.along, only=only, name="hand")
    return ph.System(top, pivot, hand, gravity, name=name)


def _free() -> ph.System:
    return ph.System(*_top(), name="gyroscope")


def _upright() -> ph.System:
    """The gyroscope described by two tilts, regular where θ and φ are singular: axle vertical."""
    mass, a, first, second, g = ph.symbols("M a I_1 I_2 g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    axes = ph.Frame("lab").rotated(alpha, "x").rotated(beta, "y", labels="2 3 1", name="axes")
    moments = (second, second, first)
    top = ph.Body("gyroscope", mass=mass, inertia=moments, axes=axes, spin_about="1")
    pivot = ph.Pivot(top, at=axes["1"] * -a)
    return ph.System(top, pivot, ph.Gravity(g), name="gyroscope/upright")


def _held() -> ph.System:
    return _with_hand("rho phi z", "gyroscope/held")


def _in_vertical_plane() -> ph.System:
    return _with_hand("phi", "gyroscope/vertical-plane")


_PARAMETERS = (
    Parameter("M", "kg", "0.5 kg", "mass"),
    Parameter("a", "m", "60 mm", "distance of the centre of mass from the pivot"),
    Parameter("I_1", "kg m^2", "6.25e-4 kg m^2", "moment of inertia about the axle"),
    Parameter("I_2", "kg m^2", "3.5e-4 kg m^2", "about a diameter through the centre of mass"),
    GRAVITY,
)
_FORCES = ("F_rho", "F_phi", "F_z")

GYROSCOPE = CatalogueEntry(
    name="gyroscope",
    title="Gyroscope",
    about=(
        "A symmetric top turns about a fixed pivot. Axis 1 runs along the axle away from the "
        "pivot, at θ to the vertical; the pivot's force is given along ρ, φ, z. Released from "
        "rest its centre of mass runs through cusps."
    ),
    build=_free,
    parameters=_PARAMETERS,
    start={"theta": "60 deg", "omega_1": "150 rad/s"},
    duration="2 s",
    plots=(("theta",), ("phi_dot", "psi_dot"), _FORCES),
)

UPRIGHT = CatalogueEntry(
    name="gyroscope/upright",
    title="Sleeping top",
    about=(
        "The same top described by two tilts α and β of its axle about horizontal axes, for "
        "motions near the vertical, where θ and φ are singular. Axis 1 runs along the axle."
    ),
    build=_upright,
    parameters=_PARAMETERS,
    start={"alpha": "1 deg", "omega_1": "150 rad/s"},
    duration="2 s",
    plots=(("alpha", "beta"), ("F_x", "F_y", "F_z")),
)

HELD = CatalogueEntry(
    name="gyroscope/held",
    title="Gyroscope held fixed",
    about=(
        "A second force at the far end of the axle keeps it from moving while the flywheel spins. "
        "How the two supports share the load along the axle is not determined."
    ),
    build=_held,
    parameters=_PARAMETERS,
    start={"theta": "60 deg", "omega_1": "150 rad/s"},
    duration="1 s",
    plots=(("theta", "omega_1"),),
)

IN_VERTICAL_PLANE = CatalogueEntry(
    name="gyroscope/vertical-plane",
    title="Gyroscope kept in a vertical plane",
    about=(
        "A guide at the far end of the axle keeps it in a vertical plane; it falls like a "
        "pendulum while the guide pushes sideways against the precession."
    ),
    build=_in_vertical_plane,
    parameters=_PARAMETERS,
    start={"theta": "0.1 rad", "omega_1": "150 rad/s"},
    duration="1 s",
    plots=(("theta",), ("Fprime_phi",), _FORCES),
)
