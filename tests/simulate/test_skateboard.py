"""A board that steers as its rider leans it: two constraints of different dimensions.

On other independent speeds than the derived ones, its equations are kept in named parts, which add
the squares of both. Compared with Kane's equations by hand, in the forward speed and the lean.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph
from polhode.algebra import as_symbol
from polhode.derive import derive_in_parts

m, J_x, J_y, J_z, k, steer = ph.symbols("m J_x J_y J_z k kappa", positive=True)
theta, rho, x, y = ph.coordinates("theta rho x y")
NUMBERS = {m: 3, J_x: 0.1, J_y: 0.12, J_z: 0.15, k: 2, steer: "0.8 /m"}


def declared():
    lab = ph.Frame("lab")
    axes = lab.rotated(theta, "z").rotated(rho, "x")
    board = ph.Body("board", mass=m, inertia=(J_x, J_y, J_z), axes=axes)
    forward = x.dt() * ph.cos(theta) + y.dt() * ph.sin(theta)
    across = y.dt() * ph.cos(theta) - x.dt() * ph.sin(theta)
    return ph.System(
        ph.Pivot(board, only="z"),
        ph.Guide(board, axis="x", normal=lab["z"], label="2"),
        ph.Constraint(across, on=board, name="wheels", force="Q"),
        ph.Constraint(theta.dt() - steer * rho * forward, on=board, name="steering", force="K"),
        ph.TorsionSpring(rho, stiffness=k, on=board),
        name="skateboard",
    )


def by_hand(_, state):
    lean, leaning, v, heading, *_ = state
    about = 0.15 * np.cos(lean) ** 2 + 0.12 * np.sin(lean) ** 2
    slope = 2 * (0.12 - 0.15) * np.sin(lean) * np.cos(lean)
    turning = 0.8 * lean * v
    slowing = 0.8**2 * v * lean * leaning * (about + slope * lean)
    return [
        leaning,
        (slope * turning**2 / 2 - 2 * lean) / 0.1,
        -slowing / (3 + about * (0.8 * lean) ** 2),
        turning,
        v * np.cos(heading),
        v * np.sin(heading),
    ]


def test_it_weaves_as_by_hand_and_passes_the_upright_position():
    run = ph.simulate(declared(), NUMBERS, {rho: 0.4, "x_dot": 2}, 4)
    found = solve_ivp(by_hand, (0, 4), [0.4, 0, 2, 0, 0, 0], rtol=1e-12, atol=1e-13).y[:, -1]
    names = ("rho", "rho_dot", "theta", "x", "y")
    assert [run.final[name] for name in names] == pytest.approx(
        [found[i] for i in (0, 1, 3, 4, 5)], rel=1e-8
    )
    assert run.drift.energy < 1e-12


def test_named_parts_have_the_same_dimensions():
    written, parts = ph.derive(declared()), derive_in_parts(declared())
    assert parts.dimensions == {
        s: d for s, d in written.dimensions.items() if s in parts.dimensions
    }
    assert str(parts.dimensions[as_symbol(steer)]) == "1/m"
