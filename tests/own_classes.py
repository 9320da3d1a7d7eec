"""A load and a surface as a user would define them."""

from __future__ import annotations

from dataclasses import dataclass

import polhode as ph
from polhode.algebra import principal_root
from polhode.model import Action, Load, Surface


@dataclass(frozen=True)
class Attraction(Load):
    """Towards the origin, falling with the square of the distance."""

    body: ph.Body
    strength: ph.Expr  # N m²
    name: str = "attraction"

    @property
    def bodies(self):
        return (self.body,)

    def actions(self, bodies, places, velocities):
        place = places[self.body]
        force = place * (-self.strength / place.norm() ** 3)
        return (Action.at(self.body.point(), force),)

    def potential(self, bodies, places):
        return -self.strength / places[self.body].norm()


@dataclass(frozen=True)
class Tyre(Surface):
    """The tube of a thick ring about one of the axes."""

    radius: ph.Expr
    tube: ph.Expr
    axis: str

    def lowest(self, axes, normal):
        steepest = self._steepest(axes, normal)
        length = principal_root(steepest.dot(steepest))
        return steepest * (-self.radius / length) - normal.express(axes) * self.tube

    @property
    def profile(self):
        angles = [ph.pi * k / 6 for k in range(13)]
        return ph.Profile(
            self.axis,
            tuple((-self.tube * ph.sin(a), self.radius + self.tube * ph.cos(a)) for a in angles),
        )

    def is_symmetric(self, axes, axis):
        return axes.position(self.axis) == axis

    def assumed_positive(self, axes, normal):
        steepest = self._steepest(axes, normal)
        return (principal_root(steepest.dot(steepest)),)

    def _steepest(self, axes, normal):
        along, upright = axes[self.axis], normal.express(axes)
        return upright - along * upright.dot(along)


LAB = ph.Frame("lab")
THETA, PHI = ph.coordinates("theta phi")
AXES = LAB.rotated(PHI, "z").rotated(THETA, "x", labels="1 2 3")


def planet() -> ph.System:
    """A point mass in the plane z = 0 about a centre of attraction."""
    m, k = ph.symbols("m k", positive=True)
    body = ph.point_mass("planet", mass=m, axes=LAB)
    guide = ph.Pivot(body, only="z", to=LAB.vector(0, 0, 0))
    return ph.System(guide, Attraction(body, k), name="planet")


def tyre() -> ph.System:
    """A thick ring that rolls."""
    m, a, b, g = ph.symbols("m a b g", positive=True)
    moments = [m * a**2 / 2, m * a**2 / 2, m * a**2]
    spin, surface = ph.About("3"), Tyre(a, b, "3")
    body = ph.Body("tyre", mass=m, inertia=moments, axes=AXES, spin=spin, surface=surface)
    return ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g), name="tyre")
