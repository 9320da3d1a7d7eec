"""Every body on every curved support obeys Newton, Euler, Coulomb and stays outside the surface."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph
from simulate.supports.laws import errors, seen
from simulate.supports.shapes import KINDS, MASS, THINGS, G, numbers

SIDES = ("inside", "outside")
LAWS = {
    "rolls": lambda body, on: ph.Rolling(body, on=on),
    "frictionless": lambda body, on: ph.Smooth(body, on=on),
    "slides": lambda body, on: ph.Coulomb(body, on=on, mu=0.2),
}


BALLS = [(kind, side, "ball", law) for kind in KINDS for side in SIDES for law in LAWS]
OTHERS = [
    ("sphere", "inside", "coin", "rolls"),
    ("torus", "outside", "coin", "frictionless"),
    ("cylinder", "inside", "pebble", "rolls"),
    ("cone", "outside", "pebble", "frictionless"),
]


@pytest.mark.parametrize(("kind", "side", "thing", "law"), [*BALLS, *OTHERS])
def test_laws_of_motion(kind, side, thing, law):
    inside = side == "inside"
    lab = ph.Frame("N")
    ground, body = KINDS[kind](lab, inside), THINGS[thing](lab)
    system = ph.System(body.body, LAWS[law](body.body, ground.support), ph.Gravity(G))
    start = {**ground.start, **body.start}
    if law == "slides":
        start |= {"u_dot": 1.0, "v_dot": 0.7}
    run = ph.simulate(system, numbers(system), start, "0.05 s")
    assert run.doubt == ""
    assert run.drift.energy < 1e-13
    begin = 0.01
    found = errors(run, begin, MASS, body.moments, ground.surface)
    assert found.force < 1e-7
    assert found.couple < 1e-6
    assert found.gap < 1e-13
    here = seen(run, np.linspace(0, 0.05, 5))
    for centre, turn in zip(here.centre, here.turn, strict=True):
        outside, _ = ground.surface(centre + body.points @ turn.T, 0.0)
        assert np.min(outside) > -1e-12
    mode = run.segments[0].mode
    if law == "rolls":
        assert np.max(np.abs(found.slip)) < 1e-9
    elif law == "frictionless":
        assert np.max(np.abs(found.rubbed)) < 1e-14
    elif mode == "sliding":
        speed = np.linalg.norm(found.slip, axis=1)[:, None]
        wanted = -0.2 * found.normal[:, None] * found.slip / speed
        assert found.rubbed == pytest.approx(wanted, abs=1e-7)
    else:
        assert mode == "flight"
