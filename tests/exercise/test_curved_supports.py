"""Numbers of exercises on curved supports: the body fits into its hollow."""

from __future__ import annotations

import pytest

import polhode as ph

M, A, R, G = ph.symbols("m a R g", positive=True)


@pytest.mark.parametrize("seed", [1, 3])
def test_the_ball_fits_into_its_bowl(seed):
    bowl = ph.Sphere(ph.Frame("N"), radius=R, inside=True)
    ball = ph.sphere("ball", mass=M, radius=A, axes=bowl.axes)
    system = ph.System(ball, ph.Rolling(ball, on=bowl), ph.Gravity(G), name="ball in a bowl")
    made = ph.exercise(system, seed=seed)
    assert made.questions
    assert float(made.texts["R"].split()[0]) > float(made.texts["a"].split()[0])
