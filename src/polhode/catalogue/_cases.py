"""Questions that a motion answers, most of the problem set: starts, pushes and what to look at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from polhode.base import DeclarationError, look_up
from polhode.catalogue._entry import CatalogueEntry


@dataclass(frozen=True)
class RunCase:
    """A motion that answers a question of the text.

    Attributes:
        name: as on the command line.
        asks: what the text asks or says, in a sentence.
        start: coordinates and speeds; speeds not named start at zero.
        duration: of the motion.
        settings: parameters, prescribed functions, and the edge of a sheet.
        sheet: path of the sheet as rows t, x, y (s, m, m), in segments between which its velocity
            jumps; empty where prescribed functions move it.
        mu: coefficient of friction; empty for contacts as they are declared.
        watch: quantities whose least and greatest values answer it.
        compare: quantities whose values at the start and at the end answer it.
        events: formulas whose zeros answer it.
        beside: coordinates and speeds of the steady motion that it starts close to.
        period: a time T in which to count time, as an expression of parameters.
    """

    name: str
    asks: str
    start: Mapping[str, str]
    duration: str
    settings: Mapping[str, str] = field(default_factory=dict)
    sheet: tuple[tuple[tuple[float, float, float], ...], ...] = ()
    mu: str = ""
    watch: tuple[str, ...] = ()
    compare: tuple[str, ...] = ()
    events: tuple[str, ...] = ()
    beside: Mapping[str, str] = field(default_factory=dict)
    period: str = ""


def _on_edge(name: str, speeds: Mapping[str, str], still: str, asks: str) -> RunCase:
    """A disk or coin that starts a degree away from standing on edge.

    For the disk φ̇ = 2 ε ω₃ with ε = 1°, the value from which it departs from this steady motion
    and not from a neighbouring one (bullet 2 after (42)).
    """
    return RunCase(
        name,
        asks,
        start={"theta": "91 deg", **speeds},
        duration="2 s",
        watch=("theta",),
        beside={"theta": "pi/2", still: "0"},
    )


_COIN = (
    _on_edge(
        "stays-up",
        {"phi_dot": "1.1*2*sqrt(g/a)"},
        "omega_3",
        "Spinning on edge is stable if phi_dot > 2 sqrt(g/a).",
    ),
    _on_edge(
        "falls",
        {"phi_dot": "0.9*2*sqrt(g/a)"},
        "omega_3",
        "Unless phi_dot > 2 sqrt(g/a), the coin on edge falls over.",
    ),
)

_DISK = (
    _on_edge(
        "stays-up",
        {"omega_3": "1.1*sqrt(g/(3*a))", "phi_dot": "2*pi/180*1.1*sqrt(g/(3*a))"},
        "phi_dot",
        "Rolling on edge is stable if omega_3 > sqrt(g/3a).",
    ),
    _on_edge(
        "falls",
        {"omega_3": "0.9*sqrt(g/(3*a))", "phi_dot": "2*pi/180*0.9*sqrt(g/(3*a))"},
        "phi_dot",
        "Unless omega_3 > sqrt(g/3a), the disk on edge falls over.",
    ),
)

_MARBLE = (
    RunCase(
        "stays",
        "The centre of the marble may remain at rest in the lab, with omega a = Omega r.",
        start={"x": "0.1 m", "y": "0 m"},
        duration="10 s",
        watch=("x", "y"),
        compare=("x", "y", "omega_x"),
    ),
)

_FINAL = "The final velocity of the ball is the same as its initial velocity"


def _pulled(name: str, asks: str, pull: str, v_x: str, edge: str = "0.3 m") -> RunCase:
    """The paper is pulled along -x with this acceleration until the ball comes off its edge."""
    return RunCase(
        name,
        asks,
        start={"v_x": v_x, "v_y": "0.05 m/s" if v_x != "0 m/s" else "0 m/s"},
        duration="3 s",
        settings={"X": f"-{pull}*t**2/2", "Y": "0", "edge": edge},
        mu="0.2",
        watch=("x",),
        compare=("v_x", "v_y"),
    )


_BALL = (
    RunCase(
        "pulled",
        f"{_FINAL} when the paper is moved under it and comes to rest again.",
        start={"v_x": "0.2 m/s", "v_y": "0.05 m/s"},
        duration="3*pi s",
        settings={"X": "(1 - cos(2*t))/20", "Y": "sin(t)**3/10", "chi": "0"},
        watch=("v_x", "v_y"),
        compare=("v_x", "v_y"),
    ),
    _pulled(
        "rolls-off",
        f"{_FINAL} when it rolls on the paper, comes off its edge, slips on the table, and rolls.",
        pull="2",
        v_x="0.2 m/s",
    ),
    _pulled(
        "slipping",
        f"{_FINAL} when the paper is pulled so hard that the ball slips on it as well.",
        pull="20",
        v_x="0.2 m/s",
    ),
    RunCase(
        "jerked",
        f"{_FINAL} also where the motion of the paper includes jerks.",
        start={"v_x": "0.2 m/s", "v_y": "0.05 m/s"},
        duration="3 s",
        settings={"edge": "0.3 m"},
        sheet=(
            ((0.0, 0.0, 0.0), (0.1, -0.01, 0.0), (0.2, -0.04, 0.01), (0.3, -0.09, 0.03)),
            ((0.3, -0.09, 0.03), (0.45, -0.065, 0.02), (0.6, -0.04, 0.0)),
            ((0.6, -0.04, 0.0), (0.75, -0.2, 0.0), (0.9, -0.36, 0.0)),
        ),
        mu="0.2",
        watch=("v_x", "v_y"),
        compare=("v_x", "v_y"),
    ),
    _pulled(
        "at-rest",
        "A ball at rest on the paper comes to rest after it rolls off, however the paper is moved.",
        pull="2",
        v_x="0 m/s",
    ),
    _pulled(
        "tablecloth",
        "Yanked out quickly, the paper leaves the ball at rest, at its initial position.",
        pull="500",
        v_x="0 m/s",
        edge="0.1 m",
    ),
)


def _nutation(name: str, phi_dot: str, asks: str) -> RunCase:
    """A gyroscope that starts with its axle at rest but for the precession."""
    return RunCase(
        name,
        asks,
        start={"theta": "60 deg", "omega_1": "150 rad/s", "phi_dot": phi_dot},
        duration="0.5 s",
        watch=("theta", "phi_dot", "F_rho", "F_phi", "F_z"),
        events=("F_z-M*g",),
    )


_GYROSCOPE = (
    _nutation("a", "1.5 rad/s", "Fig. 11-17 (a): phi_dot does not change sign."),
    _nutation("b", "-1.5 rad/s", "Fig. 11-17 (b): phi_dot changes sign, and the axle loops."),
    _nutation("c", "0 rad/s", "Fig. 11-17 (c): released from rest, the axle runs through cusps."),
)

_VERTICAL_PLANE = (
    RunCase(
        "falls",
        "Released at 0.1 rad, it falls to theta = pi in about 0.7 T, where T is the period of a "
        "simple pendulum of length I_2p/Ma.",
        start={"theta": "0.1 rad", "omega_1": "150 rad/s"},
        duration="0.75 s",
        watch=("theta", "Fprime_phi", "F_rho", "F_z"),
        events=("theta-pi",),
        period="2*pi*sqrt((I_2+M*a**2)/(M*g*a))",
    ),
)

_TIPPE_TOP = (
    RunCase(
        "turns-over",
        "With friction the tippe top slides, and turns over.",
        start={"theta": "0.1 rad", "phi_dot": "200 rad/s", "omega_3": "199 rad/s"},
        duration="2 s",
        mu="0.3",
        watch=("theta",),
    ),
)

_CASES: dict[str, tuple[RunCase, ...]] = {
    "spinning-coin": _COIN,
    "rolling-disk": _DISK,
    "marble-on-turntable": _MARBLE,
    "ball-on-paper": _BALL,
    "gyroscope": _GYROSCOPE,
    "gyroscope/vertical-plane": _VERTICAL_PLANE,
    "tippe-top": _TIPPE_TOP,
}


def cases_of(entry: CatalogueEntry) -> tuple[RunCase, ...]:
    """The questions of the problem set about a system that a motion answers."""
    return _CASES.get(entry.name, ())


def case_of(entry: CatalogueEntry, name: str) -> RunCase:
    """One of them by name.

    Raises:
        DeclarationError: for another name.
    """
    known = {case.name: case for case in cases_of(entry)}
    if not known:
        raise DeclarationError(
            f"case {name!r} of {entry.name}",
            expected="a system with named cases, such as ball-on-paper",
            advice="give a start and parameters of your own",
        )
    return look_up(name, known, f"case of {entry.name}")
