"""Single bodies on any ground, as a user would declare them."""

import polhode as ph
from polhode.derive import Equations

m, a, g = ph.symbols("m a g", positive=True)
I_1, I_2, I_3 = ph.symbols("I_1 I_2 I_3", positive=True)
b_1, b_2, b_3 = ph.symbols("b_1 b_2 b_3", positive=True)
theta, phi, psi = ph.coordinates("theta phi psi")

LAB = ph.Frame("lab")


def following(ground: ph.Frame, **named: str) -> ph.Frame:
    """Axes that follow a disk or top but do not spin with it."""
    return ground.rotated(phi, "z").rotated(theta, "x", **{"labels": "1 2 3", **named})


def euler(ground: ph.Frame) -> ph.Frame:
    """Axes fixed in a body, by Euler's angles z, x, z."""
    return following(ground).rotated(psi, "3")


def aircraft(ground: ph.Frame) -> ph.Frame:
    """Axes fixed in a body, by yaw, pitch and roll about z, y and x."""
    alpha, beta, gamma = ph.coordinates("alpha beta gamma")
    return ground.rotated(alpha, "z").rotated(beta, "y").rotated(gamma, "x", labels="1 2 3")


def gravity(ground: ph.Frame) -> ph.Gravity:
    return ph.Gravity(g, up=ground["z"])


def wheel(axes: ph.Frame, **more: object) -> ph.Body:
    """A disk with moments of its own."""
    spun = {"spin_about": "3", "rim": a, **more}
    return ph.Body("wheel", mass=m, inertia=(I_1, I_1, I_3), axes=axes, **spun)


def rolling(ground: ph.Frame) -> Equations:
    """A wheel rolling on the ground, under gravity across it."""
    contact = ph.Rolling(wheel(following(ground)), on=ph.Plane(ground))
    return ph.derive(ph.System(contact, gravity(ground)))


def sliding(ground: ph.Frame) -> Equations:
    """The same, sliding with friction."""
    contact = ph.Coulomb(wheel(following(ground)), on=ph.Plane(ground), mu=ph.symbol("mu"))
    return ph.derive(ph.System(contact, gravity(ground)))


def marble(ground: ph.Frame) -> Equations:
    """A ball rolling on a tilted turntable."""
    table = ph.Turntable(ground, ph.symbol("Omega"), tilt=ph.symbol("alpha"))
    ball = ph.sphere("ball", mass=m, radius=a, inertia=I_1, axes=table.axes)
    return ph.derive(ph.System(ph.Rolling(ball, on=table), gravity(ground)))


def top(ground: ph.Frame, at: ph.Vector | None = None) -> Equations:
    """A heavy top on a pivot, at the origin or another place."""
    axes = following(ground)
    body = ph.Body("top", mass=m, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3")
    pivot = ph.Pivot(body, at=axes["3"] * -a, to=at, along=ground)
    return ph.derive(ph.System(pivot, gravity(ground)))


def pebble(axes: ph.Frame, angles: tuple[str, str, str], ground: ph.Frame = LAB) -> Equations:
    """A triaxial ellipsoid rolling on the ground, by its angular velocity along its own axes."""
    body = ph.Body(
        "pebble",
        mass=m,
        inertia=(I_1, I_2, I_3),
        axes=axes,
        spin=ph.Components(angles),
        surface=ph.Ellipsoidal((b_1, b_2, b_3)),
    )
    return ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(ground)), gravity(ground)))


def rock(axes: ph.Frame, angles: tuple[str, str, str]) -> Equations:
    """A heavy body of any shape on a pivot, its centre of mass anywhere in it."""
    at = axes.vector(*ph.symbols("c_1 c_2 c_3"))
    body = ph.Body("rock", mass=m, inertia=(I_1, I_2, I_3), axes=axes, spin=ph.Components(angles))
    return ph.derive(ph.System(ph.Pivot(body, at=-at), ph.Gravity(g)))
