"""Balls on supports, declared; each derived once."""

from __future__ import annotations

from functools import cache

import polhode as ph
from polhode.derive import Automaton, automaton

M, A, K, G = ph.symbols("m a k g", positive=True)
MU, MU_S, E, ALPHA, U = ph.symbols("mu mu_s e alpha U")


def _ball(lab: ph.Frame) -> ph.Body:
    return ph.sphere("ball", mass=M, radius=A, inertia=K * M * A**2, axes=lab)


@cache
def on_table() -> Automaton:
    """Friction on a level table at rest."""
    lab = ph.Frame("lab")
    touch = ph.Coulomb(_ball(lab), on=ph.Plane(lab), mu=MU, mu_static=MU_S, restitution=E)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def on_slope() -> Automaton:
    """Friction on a table tilted by alpha."""
    lab = ph.Frame("lab")
    touch = ph.Coulomb(_ball(lab), on=ph.Plane(lab, tilt=ALPHA), mu=MU)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def on_belt() -> Automaton:
    """Friction on a table that moves evenly along x, with restitution e."""
    lab = ph.Frame("lab")
    belt = ph.Sheet(lab, motion=(U * ph.time, 0))
    touch = ph.Coulomb(_ball(lab), on=belt, mu=MU, restitution=E)
    return automaton(ph.System(touch, ph.Gravity(G)))
