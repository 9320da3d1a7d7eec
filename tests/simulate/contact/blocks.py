"""Blocks, that slide but cannot roll, on a shaking sheet and on a tilting plane."""

from __future__ import annotations

from functools import cache
from typing import Any

import polhode as ph
from polhode.derive import Automaton, automaton
from polhode.model import Face

M, J, H, G, R, W = ph.symbols("m J h g R w", positive=True)
MU, MU_S, LEAN = ph.symbols("mu mu_s lean")


@cache
def on_sheet() -> Automaton:
    lab = ph.Frame("lab")
    (x,) = ph.functions("X")
    block = ph.Body("block", mass=M, inertia=(J, J, J), axes=lab, surface=Face(H))
    touch = ph.Coulomb(block, on=ph.Sheet(lab, motion=(x, 0)), mu=MU, mu_static=MU_S)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def on_plane() -> Automaton:
    lab = ph.Frame("lab")
    (beta,) = ph.functions("beta")
    plane = ph.Plane(lab, tilt=beta)
    block = ph.Body("block", mass=M, inertia=(J, J, J), axes=plane.axes, surface=Face(H))
    touch = ph.Coulomb(block, on=plane, mu=MU, mu_static=MU_S)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def on_rocking_sheet() -> Automaton:
    """Shaken along a plane that tilts."""
    lab = ph.Frame("lab")
    x, beta = ph.functions("X beta")
    plane = ph.Plane(lab, tilt=beta)
    block = ph.Body("block", mass=M, inertia=(J, J, J), axes=plane.axes, surface=Face(H))
    touch = ph.Coulomb(block, on=ph.Sheet(plane.axes, motion=(x, 0)), mu=MU, mu_static=MU_S)
    return automaton(ph.System(touch, ph.Gravity(G, up=lab["z"])))


def numbers(mu: float, mu_static: float, **more: float) -> dict[str, Any]:
    return {"m": 2.0, "J": 0.1, "h": 0.2, "g": 9.81, "mu": mu, "mu_s": mu_static} | more


def shaken(mu: float, mu_static: float, reach: float, w: float, duration: float, **more: Any):
    """X = R sin(w t), with the block at rest on it."""
    return ph.simulate(
        on_sheet(),
        numbers(mu, mu_static, R=reach, w=w),
        {"v_x": reach * w},
        duration,
        forcing={"X": R * ph.sin(W * ph.time)},
        **more,
    )


def rocked(mu: float, reach: float, lean: float, w: float, duration: float, **more: Any):
    """X = R sin(w t), on a plane tilted by lean·sin(w t/3), with the block at rest on it."""
    return ph.simulate(
        on_rocking_sheet(),
        numbers(mu, mu, R=reach, w=w, lean=lean),
        {"v_x": reach * w},
        duration,
        forcing={"X": R * ph.sin(W * ph.time), "beta": LEAN * ph.sin(W / 3 * ph.time)},
        **more,
    )


def tilted(mu: float, rate: float, y: float, duration: float):
    """Up a plane tilted at a constant rate."""
    return ph.simulate(
        on_plane(),
        numbers(mu, mu),
        {"y": y},
        duration,
        forcing={"beta": rate * ph.time},
        samples=2,
    )
