"""The motions that show the answers: what each question of the text is about, simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import degrees, pi, sqrt

import numpy as np

from polhode.algebra import ZERO, Expr, read_expression
from polhode.analyse import Truth, stability, steady
from polhode.base import LENGTH, PURE, TIME, ConstraintError
from polhode.catalogue import CatalogueEntry, numbers_of
from polhode.derive import Equations, derive
from polhode.model import System, with_edge, with_friction
from polhode.simulate import Trajectory, simulate
from polhode.view.figures import figure_of_run, origin_of, svg_of

_SAMPLES = 8001
_FINE = 100001
_ENDS = ("start", "end")
#: Changes of contact that are reported one by one.
_TOLD = 8
_ROUNDING = 1e-13


@dataclass(frozen=True)
class NearThreshold:
    """A speed as a fraction of the least one that is stable.

    Attributes:
        angle: published name of the coordinate that has a steady value.
        value: that value, such as "pi/2".
        speed: published name of the speed.
        fraction: of its threshold.
    """

    angle: str
    value: str
    speed: str
    fraction: float


@dataclass(frozen=True)
class Motion:
    """A motion that belongs to a question.

    Attributes:
        name: for its files.
        question: title of the question.
        title: heading.
        caption: what to look at, in a sentence or two.
        start: coordinates and speeds, with units.
        duration: with its unit.
        plots: groups of quantities drawn against time.
        extremes: quantities whose least and greatest values are listed.
        near: a speed chosen close to its threshold.
        settings: parameters and prescribed functions in place of the defaults.
        mu: coefficient of friction at the contact; empty for a contact as declared.
        edge: where the sheet ends, m; empty for no end.
        finals: quantities whose last value is reported.
        period: a time in which the motion is drawn and counted, as a formula of parameters.
        passes: a quantity and a value whose first time is reported, as (name, value).
    """

    name: str
    question: str
    title: str
    caption: str
    start: Mapping[str, str]
    duration: str
    plots: tuple[tuple[str, ...], ...]
    extremes: tuple[str, ...] = ()
    near: NearThreshold | None = None
    settings: Mapping[str, str] = field(default_factory=dict)
    mu: str = ""
    edge: str = ""
    finals: tuple[str, ...] = ()
    period: str = ""
    passes: tuple[str, float] | None = None


@dataclass(frozen=True)
class Extreme:
    """The least and the greatest value of a quantity along a motion, SI, with their times, s."""

    quantity: str
    least: float
    least_at: float
    greatest: float
    greatest_at: float


@dataclass(frozen=True)
class ShownMotion:
    """A motion, simulated.

    Attributes:
        motion: what was asked for.
        run: the trajectory.
        extremes: of the quantities asked for.
        happened: what happened, in words with `$…$` around formulas.
        svg: its history as a picture.
    """

    motion: Motion
    run: Trajectory
    extremes: tuple[Extreme, ...]
    happened: str
    svg: str


def shown_motion(entry: CatalogueEntry, motion: Motion) -> ShownMotion:
    """Simulate and draw a motion of a system of the catalogue."""
    system = _system(entry, motion)
    declared = derive(entry.build())
    numbers = numbers_of(entry, declared, motion.settings, motion.start, motion.duration)
    start = dict(numbers.start)
    ratio = ""
    if motion.near is not None:
        critical = threshold(declared, motion.near, numbers.exact.parameters)
        start[motion.near.speed] = motion.near.fraction * critical
        ratio = f"{motion.near.fraction:g} of the threshold, which is {critical:.4g} rad/s"
    run = simulate(
        system if motion.mu or motion.edge else declared,
        {**numbers.parameters},
        start,
        numbers.duration,
        forcing={**numbers.forcing},
    )
    extremes = tuple(_extremes(run, motion.extremes))
    period = _period(run, motion.period)
    figure = figure_of_run(run, motion.plots, period=period)
    return ShownMotion(
        motion,
        run,
        extremes,
        " ".join([*_happened(run, ratio, motion), *_passed(run, motion, period)]),
        svg_of(figure, origin=origin_of(run)),
    )


def _system(entry: CatalogueEntry, motion: Motion) -> System:
    system = entry.build()
    if motion.edge:
        system = with_edge(system, Expr.of(Fraction(motion.edge)))
    return with_friction(system, Expr.of(Fraction(motion.mu))) if motion.mu else system


def threshold(equations: Equations, near: NearThreshold, parameters: Mapping[str, Expr]) -> float:
    """The least speed at which a steady motion with one angle is stable, rad/s.

    Raises `ConstraintError` where stability does not depend on the square of that speed alone.
    """
    symbols = {s.published: s for s in (*equations.coordinates, *equations.speeds)}
    angle, speed = symbols[near.angle], symbols[near.speed]
    values = {s: parameters[s.published] for s in equations.parameters if s.published in parameters}
    for family in steady(equations, {angle: near.value}):
        if family.relations or speed in family.fixed:
            continue
        judged = stability(family)
        if judged.truth is not Truth.OPEN:
            continue
        for condition in judged.conditions:
            square = (condition.expression.diff(speed).diff(speed) / 2).subs(values)
            rest = condition.expression.subs({speed: ZERO}).subs(values)
            if square.rational and rest.rational:
                return sqrt(float(-rest.rational / square.rational))
    raise ConstraintError(
        f"a threshold of {near.speed} at {near.angle} = {near.value}",
        expected="a steady motion there whose stability depends on the square of that speed",
    )


_UNITS = {LENGTH: "m", LENGTH / TIME: "m/s", PURE: "rad", PURE / TIME: "rad/s"}


def unit_of(run: Trajectory, name: str) -> str:
    """The SI unit of a coordinate, a speed or a component of a force; "rad" for an angle."""
    if name in run.reactions:
        return "N"
    symbol = run.quantities[name].symbol
    dimensions = derive(run.system).dimensions
    if symbol is None or symbol.base() not in dimensions:
        return ""
    return _UNITS.get(dimensions[symbol.base()] / TIME**symbol.order, "")


def _extremes(run: Trajectory, names: tuple[str, ...]) -> Iterator[Extreme]:
    times = np.linspace(0.0, run.duration, _SAMPLES)
    for name in names:
        values = run.evaluate(name, times)
        low, high = int(np.argmin(values)), int(np.argmax(values))
        yield Extreme(
            name,
            float(values[low]),
            float(times[low]),
            float(values[high]),
            float(times[high]),
        )


def _happened(run: Trajectory, ratio: str, motion: Motion) -> Iterator[str]:
    """How it was started, its changes of contact, and where it ends, in words."""
    if ratio:
        yield f"Started at {ratio}."
    changes = [event for event in run.events if event.kind not in _ENDS]
    if changes:
        told = [f"at {event.time:.4g} s it {event.kind}" for event in changes[:_TOLD]]
        more = "; more follow" if len(changes) > _TOLD else ""
        yield f"In order: {', '.join(told)}{more}."
    if motion.finals:
        values = [
            f"${run.quantities[name].latex()} = {_rounded(float(run.final[name]))}$ m/s"
            for name in motion.finals
        ]
        yield f"At the end {' and '.join(values)}."


def _period(run: Trajectory, formula: str) -> float | None:
    if not formula:
        return None
    known = {s.published: Expr.generator(s) for s in derive(run.system).parameters}
    return float(run.evaluate(read_expression(formula, known), 0.0))


def _passed(run: Trajectory, motion: Motion, period: float | None) -> Iterator[str]:
    """When a quantity first has a value, found between samples by straight lines."""
    if motion.passes is None:
        return
    name, value = motion.passes
    times = np.linspace(0.0, run.duration, _FINE)
    beyond = run.evaluate(name, times) - value
    crossed = np.flatnonzero(np.sign(beyond[:-1]) * np.sign(beyond[1:]) <= 0)
    if not crossed.size:
        return
    i = int(crossed[0])
    time = float(np.interp(0.0, beyond[i : i + 2], times[i : i + 2]))
    letter = run.quantities[name].latex()
    counted = "" if period is None else f", that is {time / period:.3f} T with T = {period:.4g} s"
    shown = f"{degrees(value):.5g}°" if unit_of(run, name) == "rad" else f"{value:.5g}"
    yield f"${letter}$ first reaches {shown} after {time:.4g} s{counted}."


def _rounded(value: float) -> str:
    """A number with the digits that a run is good for at least."""
    return f"{0.0 if abs(value) < _ROUNDING else value:.12g}"


# -- by system -------------------------------------------------------------------------------------

_ON_EDGE = (("theta",), ("phi_dot", "omega_3"))
_FORCE = ("F_rho", "F_phi", "F_z")
_TOP = (("theta",), ("phi_dot",), _FORCE)
_COIN_ASKED, _DISK_ASKED = "The coin on edge", "Rolling on edge"


def _pair(
    what: str, question: str, speed: str, duration: str, below: str, above: str
) -> tuple[Motion, ...]:
    """A motion on edge on either side of its threshold."""
    return tuple(
        Motion(
            name=name,
            question=question,
            title=title,
            caption=caption,
            start={"theta": "89.9 deg"},
            duration=duration,
            plots=_ON_EDGE,
            extremes=("theta", "phi_dot", "omega_3"),
            near=NearThreshold("theta", "pi/2", speed, fraction),
        )
        for name, title, fraction, caption in (
            ("below", f"{what} a little too slowly", 0.95, below),
            ("above", f"{what} a little faster than needed", 1.05, above),
        )
    )


#: The motions that belong to questions, by system.
MOTIONS: Mapping[str, tuple[Motion, ...]] = {
    "spinning-coin": _pair(
        "spinning on edge",
        _COIN_ASKED,
        "phi_dot",
        "2 s",
        "Set up a tenth of a degree from the vertical, the coin leans over further and further, "
        "and then rises again to where it started: without friction nothing is lost. The "
        "further it is below the threshold, the further it falls.",
        "Set up in the same way, it only trembles.",
    ),
    "rolling-disk": _pair(
        "rolling on edge",
        _DISK_ASKED,
        "omega_3",
        "4 s",
        "Set up a tenth of a degree from the vertical, the disk leans over and swerves, which "
        "makes it upright again, and so on.",
        "Set up in the same way, it wobbles a little about its way.",
    ),
    "ball-on-paper": (
        Motion(
            name="pulled",
            question="The final velocity",
            title="the paper is jerked to and fro, and the ball rolls off it",
            caption=(
                "The paper shakes harder than friction can follow, so that the ball slips on it, "
                "then runs over its edge onto the table, slips there, and rolls on at the velocity "
                "with which it began."
            ),
            start={"v_x": "0.2 m/s"},
            duration="2 s",
            plots=(("v_x", "v_y"), ("F_x", "F_y")),
            extremes=("v_x", "v_y"),
            settings={"X": "(1 - cos(12*t))/30", "Y": "sin(8*t)**3/40", "chi": "0"},
            mu="1/10",
            edge="3/20",
            finals=("v_x", "v_y"),
        ),
        Motion(
            name="tablecloth",
            question="The final velocity",
            title="the tablecloth trick",
            caption=(
                "The ball is at rest, and the paper is pulled away from under it. The ball comes "
                "to rest again, and close to where it was if the pull is quick."
            ),
            start={"v_x": "0 m/s"},
            duration="1 s",
            plots=(("x",), ("v_x",)),
            extremes=("x", "v_x"),
            settings={"X": "-20*t**2", "Y": "0", "chi": "0"},
            mu="1/10",
            edge="1/20",
            finals=("v_x",),
        ),
    ),
    "gyroscope": tuple(
        Motion(
            name=name,
            question="Launched from rest",
            title=title,
            caption=caption,
            start={"theta": "60 deg", "omega_1": "150 rad/s", "phi_dot": rate},
            duration="0.4 s",
            plots=_TOP,
            extremes=("theta", "phi_dot", *_FORCE),
        )
        for name, title, rate, caption in (
            (
                "cusps",
                "released from rest: cusps, as in part (c) of the text’s figure",
                "0 rad/s",
                "The precession stops wherever the axle is back at its first inclination.",
            ),
            (
                "waves",
                "with a push forwards: waves, part (a)",
                "1.5 rad/s",
                "The precession becomes faster and slower, and never turns back.",
            ),
            (
                "loops",
                "with a push backwards: loops, part (b)",
                "-3 rad/s",
                "At the upper limit the axle moves backwards.",
            ),
        )
    ),
    "gyroscope/vertical-plane": (
        Motion(
            name="fall",
            question="Kept in a vertical plane",
            title="the fall from close to the upright position",
            caption=(
                "Drawn against t/T, where T is the period of small swings of the same body about "
                "its lowest position, 2π√((I₂ + Ma²)/Mga), as in the text. The guide pushes "
                "backwards, the more so the faster it falls."
            ),
            start={"theta": "0.1 rad", "omega_1": "150 rad/s"},
            duration="0.8 s",
            plots=(("theta",), ("Fprime_phi",), _FORCE),
            extremes=("theta", "Fprime_phi", *_FORCE),
            period="2*pi*sqrt((I_2 + M*a**2)/(M*g*a))",
            passes=("theta", pi),
        ),
    ),
}

#: Titles of the questions that the catalogue's own run shows.
DEFAULT_RUN: Mapping[str, str] = {
    "spinning-coin": "How fast the coin precesses",
    "rolling-disk": "Steady rolling",
    "marble-on-turntable": "The circle",
    "marble-on-turntable/tilted": "The tilted turntable",
    "gyrocompass": "In the frame of the Earth",
    "tennis-racquet": "The special case T = L²/2I₂",
    "ball-on-paper": "While the paper moves",
    "gyroscope": "The force on the pivot",
    "gyroscope/held": "Held fixed by a second force",
    "gyroscope/vertical-plane": "Kept in a vertical plane",
}
