"""Balls in bowls, shots of two balls, boxes that are pushed and boxes that are thrown, at random.

Energy never grows, nothing passes through anything, and what is not followed is counted by cause.
"""

from __future__ import annotations

import signal
from collections import Counter
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

import polhode as ph
from polhode.derive import Automaton, automaton
from proof.ledger import Ledger
from simulate.contact.boxes import on_corners

FIRST = 700_000
SLOWEST = 40  # seconds for one motion, beyond which it counts as not followed

M, A, G, R = ph.symbols("m a g R", positive=True)
MU, MU_BALLS, E = ph.symbols("mu mu_b e")

Draw = tuple[dict[str, float], dict[str, float]]

#: What an error says, and what it is called.
CAUSES = {
    "gimbal lock": "gimbal lock",
    "jams": "Painlevé's paradox",
    "several directions": "slip in several directions",
    "no contact mode is possible": "no contact mode",
    "exclude each other": "no contact mode",
    "impulses are not found": "impulses",
    "cannot be followed": "begin of a slip",
    "has no directions": "begin of a slip",
}


class TooSlowError(Exception):
    """Raised by the clock."""


def campaign(
    ledger: Ledger,
    count: int,
    system: Callable[[], Automaton],
    draw: Callable[[np.random.Generator], Draw],
    duration: float,
    above: tuple[str, ...] = (),
) -> None:
    """Simulate motions drawn at random.

    Args:
        above: quantities that must not become negative, m.
    """
    causes = Counter[str]()
    for seed in range(FIRST, FIRST + count):
        numbers, start = draw(np.random.default_rng(seed))
        ledger.cases += 1
        try:
            run = _within(SLOWEST, lambda n=numbers, s=start: ph.simulate(system(), n, s, duration))
        except (ph.PolhodeError, TooSlowError) as error:
            ledger.aside += 1
            found = (cause for words, cause in CAUSES.items() if words in str(error))
            causes[next(found, type(error).__name__)] += 1
            continue
        energy = run["energy"]
        scale, where = np.max(np.abs(energy)), f"seed {seed}"
        gained = float(np.max(np.diff(energy))) / scale
        # a few times rounding more where the independent speeds change
        ledger.error(max(gained, 0.0), 1e-11, 1.0, f"energy, {where}")
        ledger.error(float(run.drift.energy), 1e-10, 1.0, f"balance, {where}")
        for name in above:
            ledger.error(max(-float(np.min(run[name])), 0.0), 1e-11, 1.0, f"{name}, {where}")
    ledger.part = ", ".join(f"{cause} {n}" for cause, n in causes.most_common())


def _within(seconds: int, work: Callable[[], Any]) -> Any:
    def too_slow(*_: object) -> None:
        raise TooSlowError

    signal.signal(signal.SIGALRM, too_slow)
    signal.alarm(seconds)
    try:
        return work()
    finally:
        signal.alarm(0)


# -- balls -----------------------------------------------------------------------------------------


@cache
def bowl() -> Automaton:
    support = ph.Sphere(ph.Frame("lab"), radius=R, inside=True)
    ball = ph.sphere("ball", mass=M, radius=A, axes=support.axes)
    contact = ph.Coulomb(ball, on=support, mu=MU, restitution=E, name="bowl")
    return automaton(ph.System(contact, ph.Gravity(G)))


def in_bowl(rng: np.random.Generator) -> Draw:
    numbers = {
        "m": 0.05,
        "a": 0.02,
        "g": 9.81,
        "R": rng.uniform(0.05, 0.4),
        "mu": rng.choice([0.02, 0.1, 0.3, 0.8]),
        "e": rng.choice([0.0, 0.0, 0.4, 0.9]),
    }
    start = {name: rng.uniform(-1.4, 1.4) for name in ("u", "v")}
    start |= {name: rng.normal(0, 6) for name in ("u_dot", "v_dot")}
    start |= {name: rng.normal(0, 40) for name in ("omega_u", "omega_v", "omega_n")}
    return numbers, start | ({"gap": rng.uniform(0.001, 0.03)} if rng.random() < 1 / 3 else {})


def test_balls_in_bowls(ledger: Ledger) -> None:
    campaign(ledger, 500, bowl, in_bowl, 3.0, above=("gap",))


@cache
def table() -> Automaton:
    lab = ph.Frame("lab")
    one = ph.sphere("one", mass=M, radius=A, axes=lab, tag="1")
    two = ph.sphere("two", mass=M, radius=A, axes=lab, tag="2")
    cloth = ph.Plane(lab)
    contacts = (
        ph.Coulomb(one, on=cloth, mu=MU, name="cloth 1", force="P"),
        ph.Coulomb(
            two,
            on=ph.Sphere(one, radius=A, axis="x"),
            mu=MU_BALLS,
            restitution=E,
            name="hit",
            force="H",
        ),
        ph.Coulomb(two, on=cloth, mu=MU, name="cloth 2", force="Q"),
    )
    return automaton(ph.System(one, two, *contacts, ph.Gravity(G), impacts="Moreau"))


def shot(rng: np.random.Generator) -> Draw:
    """The first ball goes along x with any spin, and hits the second one, at rest."""
    numbers = {
        "m": 0.17,
        "a": 0.0285,
        "g": 9.81,
        "mu": rng.choice([0.1, 0.2]),
        "mu_b": rng.choice([0.03, 0.06, 0.2]),
        "e": rng.choice([0.5, 0.9, 0.95]),
    }
    speed, gap = rng.uniform(0.3, 3), rng.uniform(0.02, 0.3)
    away = 2 * 0.0285 + gap
    aside = rng.uniform(-0.98, 0.98) * 2 * 0.0285 / away  # sine of where the second one is
    start = {
        "v_x_1": speed,
        "gap_2": gap,
        "u_2": np.arcsin(aside),
        "gap_2_dot": -speed * np.sqrt(1 - aside**2),
        "u_2_dot": speed * aside / away,
    }
    spins = zip("xyz", (30, 60, 60), strict=True)
    return numbers, start | {f"omega_{label}_1": rng.normal(0, size) for label, size in spins}


def test_shots_of_two_balls(ledger: Ledger) -> None:
    campaign(ledger, 1000, table, shot, 1.5, above=("gap_2",))


# -- boxes -----------------------------------------------------------------------------------------


@cache
def on_slope() -> Automaton:
    return automaton(on_corners(lambda lab: ph.Plane(lab, tilt=ph.symbol("alpha"))))


def pushed(rng: np.random.Generator) -> Draw:
    """Flat boxes, which do not tip."""
    numbers = {
        "m": 1.0,
        "a": rng.uniform(0.2, 0.4),
        "b": rng.uniform(0.2, 0.4),
        "c": rng.uniform(0.02, 0.1),
        "g": 9.81,
        "mu": rng.uniform(0.05, 0.9),
        "alpha": rng.uniform(0, 0.5),
    }
    start = {"v_x": rng.normal(), "v_y": rng.normal(), "psi_dot": rng.normal(0, 8)}
    return numbers, start


def test_boxes_that_are_pushed(ledger: Ledger) -> None:
    campaign(ledger, 300, on_slope, pushed, 2.0)


@cache
def thrown() -> Automaton:
    corners = tuple((i, j) for i in (1, -1) for j in (1, -1))
    return automaton(on_corners(corners=corners, faces=(-1, 1)))


def throw(rng: np.random.Generator) -> Draw:
    sizes = {name: rng.uniform(0.1, 0.3) for name in "abc"}
    numbers = {"m": 1.0, **sizes, "g": 9.81, "mu": rng.choice([0.05, 0.2, 0.3, 0.5, 0.8])}
    start = {"z": 0.5} | {name: rng.uniform(-1.2, 1.2) for name in ("psi", "theta", "phi")}
    start |= {name: rng.normal(0, 4) for name in ("psi_dot", "theta_dot", "phi_dot")}
    return numbers, start | {name: rng.normal() for name in ("v_x", "v_y", "v_z")}


def test_boxes_that_are_thrown(ledger: Ledger) -> None:
    campaign(ledger, 40, thrown, throw, 3.0)
