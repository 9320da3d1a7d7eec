"""Bodies on contacts whose forces Newton's laws leave open: whether they stay, how they start."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import polhode as ph

G = 9.81
m, g = ph.symbols("m g", positive=True)
mu, nu = ph.symbols("mu nu")
LAB = ph.Frame("lab")


def ladder() -> ph.System:
    """A uniform ladder at alpha to the floor, with coefficients mu on it and nu on the wall."""
    length = ph.symbol("l", positive=True)
    axes = LAB.rotated(ph.coordinate("alpha"), "y")
    rod = ph.rod("ladder", mass=m, length=length, axes=axes)
    foot, top = axes["x"] * (length / 2), axes["x"] * (-length / 2)
    return ph.System(
        ph.Coulomb(rod, on=ph.Plane(LAB), at=foot, mu=mu, name="floor", force="N"),
        ph.Coulomb(rod, on=ph.Plane(LAB, normal="x"), at=top, mu=nu, name="wall", force="W"),
        ph.Hinge(rod, axis="y"),
        ph.Gravity(g),
    )


LADDER = ph.automaton(ladder())


def leaning(alpha: float, floor: float, wall: float, duration: float = 0.1) -> ph.Trajectory:
    numbers = {"m": 8.0, "l": 3.0, "g": G, "mu": floor, "nu": wall}
    return ph.simulate(LADDER, numbers, {"alpha": alpha}, duration)


@given(floor=st.floats(0.05, 0.9), wall=st.floats(0.0, 0.9), side=st.sampled_from([-1, 1]))
def test_a_ladder_stands_from_an_angle_on(floor: float, wall: float, side: int) -> None:
    """tan α = (1 - μ ν)/(2 μ): at its limit at both ends, it is held by one distribution alone."""
    wall = wall if wall > 1e-6 else 0.0
    least = np.arctan2(1 - floor * wall, 2 * floor)
    run = leaning(least + side * 1e-6, floor, wall)
    stands = run.segments[0].mode == "rolling"
    assert stands == (side > 0)
    assert (run.final["alpha_dot"] == 0) == stands


def oracle(alpha: float, floor: float, wall: float, times: np.ndarray) -> np.ndarray:
    """α of a ladder that slides at both ends, by the three balances in a plane.

    m ẍ = W - μ N and m z̈ = N + ν W - m g of the centre, m l² α̈/12 = (N + ν W ... ) about it, with
    x = l/2 cos α, z = l/2 sin α.
    """
    mass, length = 8.0, 3.0

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        angle, rate = state
        c, s, half = np.cos(angle), np.sin(angle), length / 2
        # unknown: α̈, N, W
        rows = np.array(
            [
                [-mass * half * s, floor, -1.0],
                [mass * half * c, -1.0, -wall],
                # foot at (half c, -half s), top at (-half c, half s) from the centre; α grows with
                # the ladder turned up, against the sense from x to z
                [
                    mass * length**2 / 12,
                    half * c - half * s * floor,
                    -(half * s + half * c * wall),
                ],
            ]
        )
        right = np.array([mass * half * c * rate**2, mass * half * s * rate**2 - mass * G, 0.0])
        return np.array([rate, np.linalg.solve(rows, right)[0]])

    found = solve_ivp(rates, (0, times[-1]), [alpha, 0.0], "DOP853", times, rtol=1e-13, atol=1e-14)
    return found.y[0]


@pytest.mark.parametrize(("floor", "wall"), [(0.2, 0.2), (0.1, 0.4), (0.3, 0.0)])
def test_a_ladder_slides_at_both_ends_at_once(floor: float, wall: float) -> None:
    run = leaning(0.8, floor, wall, 0.25)
    assert [event.kind for event in run.events] == ["start", "end"]
    times = np.linspace(0.05, 0.25, 5)
    found = [float(run.evaluate("alpha", t)) for t in times]
    assert found == pytest.approx(oracle(0.8, floor, wall, times), rel=1e-11)
    assert run.drift.energy < 1e-13


# -- a block on its two lower edges ----------------------------------------------------------------


def block() -> ph.System:
    """Half as wide as w and as high as h, on a slope that falls by alpha along -x."""
    inertia, w, h = ph.symbols("I w h", positive=True)
    alpha = ph.symbol("alpha")
    axes = LAB.rotated(ph.coordinate("q"), "y")
    body = ph.Body("block", mass=m, inertia=(inertia, inertia, inertia), axes=axes)
    edges = {"lower": axes["x"] * -w - axes["z"] * h, "upper": axes["x"] * w - axes["z"] * h}
    contacts = [
        ph.Coulomb(body, on=ph.Plane(LAB), at=at, mu=mu, name=name, force=name[0])
        for name, at in edges.items()
    ]
    up = LAB["z"] * ph.cos(alpha) + LAB["x"] * ph.sin(alpha)
    return ph.System(*contacts, ph.Hinge(body, axis="y"), ph.Gravity(g, up=up))


BLOCK = ph.automaton(block())
WIDE = {"m": 2.0, "I": 0.05, "w": 0.1, "h": 0.1, "g": G}
TALL = WIDE | {"h": 0.2}


@pytest.mark.parametrize(
    ("numbers", "friction", "slope", "mode"),
    [
        (WIDE, 0.5, 0.3, "rolling"),
        (WIDE, 0.31, 0.3, "rolling"),  # tan 0.3 = 0.3093
        (WIDE, 0.3, 0.3, "sliding"),
        (TALL, 0.9, 0.46, "rolling"),  # tan 0.46 = 0.4954, and w/h = 0.5
        (TALL, 0.9, 0.47, "lower rolling, upper flight"),
        (TALL, 0.4, 0.47, "sliding"),
    ],
)
def test_a_block_stands_slides_or_tips(numbers, friction, slope, mode) -> None:
    run = ph.simulate(BLOCK, numbers | {"mu": friction, "alpha": slope}, {}, 0.2)
    assert run.segments[0].mode == mode
    final, c, s = run.final, np.cos(slope), np.sin(slope)
    if mode == "rolling":
        assert final["v_x"] == final["q"] == 0
    if mode == "sliding":
        assert final["v_x"] == pytest.approx(-0.2 * G * (s - friction * c), rel=1e-12)
    if mode.startswith("lower"):  # about the lower edge: (I + m r²) q̈ = -m g (h sin α - w cos α)
        w, h, mass = (numbers[k] for k in ("w", "h", "m"))
        rate = mass * G * (h * s - w * c) / (numbers["I"] + mass * (w**2 + h**2))
        early = 1e-3
        assert run.evaluate("q", early) == pytest.approx(-rate * early**2 / 2, rel=1e-4)


def test_a_block_that_slides_comes_to_rest() -> None:
    run = ph.simulate(BLOCK, WIDE | {"mu": 0.3, "alpha": 0.0}, {"v_x": 1.5}, 1e5)
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    assert run.events[1].time == pytest.approx(1.5 / (0.3 * G), rel=1e-13)
    assert run.final["x"] == pytest.approx(1.5**2 / (2 * 0.3 * G), rel=1e-13)
    assert run.final["v_x"] == 0


# -- a box on four corners -------------------------------------------------------------------------


def box() -> ph.System:
    w, d, h, alpha = ph.symbols("w d h alpha", positive=True)
    axes = LAB
    for angle, label in zip(ph.coordinates("r q p"), "zyx", strict=True):
        axes = axes.rotated(angle, label)
    body = ph.Body("box", mass=m, inertia=ph.symbols("I_1 I_2 I_3", positive=True), axes=axes)
    corners = [
        axes["x"] * (w * i) + axes["y"] * (d * j) - axes["z"] * h for i in (1, -1) for j in (1, -1)
    ]
    contacts = [
        ph.Coulomb(body, on=ph.Plane(LAB), at=at, mu=mu, name=f"corner {k}", force="ABCD"[k])
        for k, at in enumerate(corners)
    ]
    up = LAB["z"] * ph.cos(alpha) + LAB["x"] * ph.sin(alpha)
    return ph.System(*contacts, ph.Gravity(g, up=up))


def test_a_box_on_a_slope_does_not_creep() -> None:
    """Six of the twelve forces are open; MuJoCo documents 155 µm/s of slip at rest."""
    numbers = {"m": 1, "g": G, "w": 0.1, "d": 0.15, "h": 0.1, "alpha": 0.3, "mu": 0.31}
    numbers |= {f"I_{k}": 0.01 for k in "123"}
    system = box()
    run = ph.simulate(system, numbers, {}, 1e5)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert all(run.final[name] == 0 for name in ("x", "y", "v_x", "v_y", "p", "q", "r"))
    with pytest.raises(ph.ConstraintError, match="undetermined"):  # which corner rubs how much
        ph.simulate(system, numbers | {"mu": 0.3}, {}, 1.0)
