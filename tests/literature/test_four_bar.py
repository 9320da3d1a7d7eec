"""A four-bar linkage under a constant torque, from its velocity coefficients and its energy.

B. Paul, Kinematics and Dynamics of Planar Machinery (1979): with one input angle θ the energy is
M(θ) θ̇²/2, where M follows from the velocity coefficients of the links. From rest under a torque τ,
M θ̇² = 2 τ (θ − θ₀), which gives the time by a quadrature.
"""

from math import atan2, cos, hypot, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import polhode as ph

CRANK, COUPLER, ROCKER, GROUND = 0.1, 0.35, 0.3, 0.32
MASSES = (0.5, 0.9, 0.7)
TORQUE, BEGIN = 0.4, 0.3


def angles(theta):
    """Of coupler and rocker, by the triangle between the end of the crank and the far pivot."""
    x, y = GROUND - CRANK * cos(theta), -CRANK * sin(theta)
    diagonal = hypot(x, y)
    inner = np.arccos((COUPLER**2 + diagonal**2 - ROCKER**2) / (2 * COUPLER * diagonal))
    coupler = atan2(y, x) + inner
    end = (CRANK * cos(theta) + COUPLER * cos(coupler), CRANK * sin(theta) + COUPLER * sin(coupler))
    return coupler, atan2(end[1], end[0] - GROUND)


def inertia(theta):
    """M(θ), with uniform rods: velocity coefficients from the loop, differentiated."""
    coupler, rocker = angles(theta)
    # −a sin θ − b sin β β' = −c sin γ γ', a cos θ + b cos β β' = c cos γ γ'
    matrix = [
        [-COUPLER * sin(coupler), ROCKER * sin(rocker)],
        [COUPLER * cos(coupler), -ROCKER * cos(rocker)],
    ]
    b, c = np.linalg.solve(matrix, [CRANK * sin(theta), -CRANK * cos(theta)])
    crank, middle, last = MASSES
    centre = CRANK**2 + (COUPLER * b / 2) ** 2 + CRANK * COUPLER * b * cos(theta - coupler)
    own = crank * CRANK**2 / 3 + last * ROCKER**2 * c**2 / 3
    return own + middle * (centre + COUPLER**2 * b**2 / 12)


def test_a_crank_and_rocker_over_several_turns():
    lab = ph.Frame("lab")
    a, b, c, d, tau = ph.symbols("a b c d tau", positive=True)
    m = ph.symbols("m_1 m_2 m_3", positive=True)
    theta, beta, gamma = ph.coordinates("theta beta gamma")
    frames = [lab.rotated(q, "z") for q in (theta, beta, gamma)]
    crank, coupler, rocker = (
        ph.rod(name, mass=mass, length=length, axes=axes, axis="x", tag=name[0])
        for name, mass, length, axes in zip(
            ("crank", "link", "rocker"), m, (a, b, c), frames, strict=True
        )
    )
    first, second, third = (axes["x"] for axes in frames)
    system = ph.System(
        ph.Pivot(crank, at=first * (-a / 2), name="input"),
        ph.Hinge(crank, axis="z", name="input hinge"),
        ph.Pivot(coupler, at=second * (-b / 2), to=crank.point(first * (a / 2)), name="pin"),
        ph.Hinge(coupler, axis="z", name="coupler hinge"),
        ph.Pivot(rocker, at=third * (-c / 2), to=lab["x"] * d, name="output"),
        ph.Hinge(rocker, axis="z", name="output hinge"),
        ph.Pivot(
            coupler,
            at=second * (b / 2),
            to=rocker.point(third * (c / 2)),
            only="x y",
            along=lab,
            name="joint",
            force="G",
        ),
        ph.Torque(crank, lab["z"] * tau),
    )
    numbers = {"a": CRANK, "b": COUPLER, "c": ROCKER, "d": GROUND, "tau": TORQUE}
    numbers |= dict(zip(("m_1", "m_2", "m_3"), MASSES, strict=True))
    start = dict(zip(("theta", "beta", "gamma"), (BEGIN, *angles(BEGIN)), strict=True))

    def time(angle):
        """From rest to an angle; with θ = θ₀ + u² the integrand is smooth."""

        def integrand(u):
            return 2 * sqrt(inertia(BEGIN + u * u) / (2 * TORQUE))

        return quad(integrand, 0, sqrt(angle - BEGIN), epsabs=1e-14, epsrel=1e-13, limit=400)[0]

    duration = 1.2
    run = ph.simulate(system, numbers, start, duration)
    expected = brentq(lambda angle: time(angle) - duration, 5.0, 80.0, xtol=1e-13)
    assert expected > 4 * np.pi
    assert run.final["theta"] == pytest.approx(expected, abs=1e-10)
    coupler_angle, rocker_angle = angles(expected)
    assert sin(run.final["beta"] - coupler_angle) == pytest.approx(0, abs=1e-10)
    assert sin(run.final["gamma"] - rocker_angle) == pytest.approx(0, abs=1e-10)
    assert run.drift.energy < 1e-12


def test_peaucelliers_linkage_draws_a_straight_line():
    """A. Peaucellier (1864): |OP| |OQ| = a² − b²; with P on a circle through O, x(Q) is fixed."""
    a, b, c, m = ph.symbols("a b c m", positive=True)
    lab = ph.Frame("lab")
    bars, joints = {}, []
    for name, length, start, end in (
        ("OA", a, "O", "A"),
        ("OB", a, "O", "B"),
        ("CP", c, "C", "P"),
        ("AP", b, "A", "P"),
        ("AQ", b, "A", "Q"),
        ("BP", b, "B", "P"),
        ("BQ", b, "B", "Q"),
    ):
        axes = lab.rotated(ph.coordinate(f"angle_{name}"), "z")
        bar = ph.rod(name, mass=m, length=length, axes=axes, axis="x", tag=name)
        half = axes["x"] * (length / 2)
        place = {"O": lab["x"] * 0, "C": lab["x"] * c}.get(start, bars.get(start))
        joints += [
            ph.Pivot(bar, at=-half, to=place, name=f"{start} of {name}"),
            ph.Hinge(bar, axis="z", name=f"axis of {name}"),
        ]
        if end in bars:
            joints.append(
                ph.Pivot(bar, at=half, to=bars[end], only="x y", name=f"{end} of {name}", force="G")
            )
        bars.setdefault(end, bar.point(half))
    linkage = ph.derive(ph.System(*joints))
    numbers = {"a": 2.5, "b": 1, "c": 0.9, "m": 1}
    # at the start from the crank's angle: A and B at the distance a from O and b from P
    place = 0.9 * (1 + np.exp(0.3j))
    apart = (abs(place) ** 2 + 2.5**2 - 1) / (2 * abs(place))
    corners = [place / abs(place) * (apart + k * 1j * sqrt(2.5**2 - apart**2)) for k in (1, -1)]
    start = dict(zip(("angle_OA", "angle_OB"), np.angle(corners), strict=True))
    start |= {"angle_AQ": np.angle(corners[1] - place), "angle_CP": 0.3, "angle_CP_dot": 1}
    run = ph.simulate(linkage, numbers, start, "0.5 s")
    across, along = (2.5 * f(run["angle_OA"]) + f(run["angle_AQ"]) for f in (np.cos, np.sin))
    assert across == pytest.approx(np.full(len(run.t), (2.5**2 - 1) / (2 * 0.9)), abs=1e-11)
    assert np.ptp(along) > 0.5
    # By symmetry the loops close first where the rhombus is folded flat, with A on B, and Q turns
    # freely; another configuration is found, in which angles have no whole turns.
    run = ph.simulate(linkage, numbers, {"angle_CP": 0.3, "angle_CP_dot": 1}, "0.1 s")
    assert all(abs(run[f"angle_{name}"][0]) <= np.pi for name in ("OA", "OB", "AP", "BP"))
    assert run.drift.energy < 1e-10
    # started folded it has one more degree of freedom than its equations
    a_to_p = np.angle(place - corners[0])
    folded = dict.fromkeys(("angle_AP", "angle_BP"), a_to_p)
    folded |= dict.fromkeys(("angle_OA", "angle_OB"), np.angle(corners[0]))
    folded |= {"angle_AQ": 0.4, "angle_BQ": 0.4, "angle_CP": 0.3, "angle_CP_dot": 1}
    with pytest.raises(ph.ConstraintError, match="2 degrees of freedom, not 1 as elsewhere"):
        ph.simulate(linkage, numbers, folded, "0.1 s")


@pytest.mark.parametrize("cranks", [2, 3])
def test_a_parallelogram_turns_with_its_coupler_parallel_to_the_ground(cranks):
    """The rate of the coupler, zero, determines no other; three cranks move by their lengths."""
    d, length, m = ph.symbols("d l m", positive=True)
    lab = ph.Frame("lab")
    names = ["first", "second", "third"][:cranks]
    bars = [
        ph.rod(n, mass=m, length=length, axes=lab.rotated(ph.coordinate(n), "z"), axis="x", tag=n)
        for n in names
    ]
    along = lab.rotated(ph.coordinate("phi"), "z")
    coupler = ph.rod("coupler", mass=m, length=2 * d, axes=along, axis="x", tag="k")
    tips = [bar.point(bar.axes["x"] * (length / 2)) for bar in bars]
    joints = [
        ph.Pivot(coupler, at=along["x"] * -d, to=tips[0], name="pin"),
        ph.Hinge(coupler, axis="z"),
    ]
    for k, bar in enumerate(bars):
        half = bar.axes["x"] * (length / 2)
        place = lab["x"] * (d * (0, 2, 1)[k])
        joints += [ph.Pivot(bar, at=-half, to=place, name=f"o{k}"), ph.Hinge(bar, axis="z")]
        if k:
            pin = coupler.point(along["x"] * (d * (0, 1, 0)[k]))
            joints.append(ph.Pivot(bar, at=half, to=pin, only="x y", name=f"p{k}", force="G"))
    start = dict.fromkeys(names, 1) | {"phi": 0, "first_dot": 1}
    numbers = {"m": 1, "l": 1, "d": 0.7}
    if cranks == 3:
        with pytest.raises(ph.ConstraintError, match="1 degrees of freedom, not 0 as elsewhere"):
            ph.simulate(ph.System(*joints), numbers, start, "1 s")
        return
    run = ph.simulate(ph.System(*joints), numbers, start, "2 s")
    assert run.final["second"] == pytest.approx(3, abs=1e-12)
    assert np.max(np.abs(run["phi"])) < 1e-12
