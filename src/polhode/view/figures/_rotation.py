"""How a body turns: its axis on the unit sphere, polhodes and the herpolhode."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Vector
from polhode.base import DeclarationError
from polhode.model import About, Body, Components, Relative
from polhode.simulate import Trajectory
from polhode.view._quantities import Array, equations_of, instants
from polhode.view.figures._figure import Drawn, axes_or_new
from polhode.view.figures._style import COLOURS, FAINT, INK, MUTED, house_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D


Mask = NDArray[np.bool_]

_BEHIND = 0.28  # opacity of hidden lines
_CIRCLE = np.linspace(0, 2 * np.pi, 361)
_ROUND = np.linspace(0, 2 * np.pi, 241)
_FAMILY = 4  # polhodes drawn about each stable axis
_NODES = 8  # of a quadrature, between two instants
_SIGNS = (-1, 1)


# --- a transparent surface seen from a little above: hidden lines are faint ---


@dataclass(frozen=True)
class View:
    """Parallel projection: the eye looks along minus `towards`; the third axis points up.

    Attributes:
        azimuth: of the eye, from the first axis, degrees.
        elevation: of the eye above the plane of the first two axes, degrees.
    """

    azimuth: float
    elevation: float

    @property
    def towards(self) -> Array:
        """Unit vector towards the eye."""
        turn, rise = np.radians([self.azimuth, self.elevation])
        return np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])

    def project(self, points: Array) -> Array:
        """Places on the page, shape (2, n), of points of shape (3, n)."""
        turn = np.radians(self.azimuth)
        right = np.array([-np.sin(turn), np.cos(turn), 0.0])
        return np.array([right @ points, np.cross(self.towards, right) @ points])


def draw_on(
    axes: Axes, view: View, points: Array, outward: Array, **style: Any
) -> tuple[Line2D, Line2D]:
    """A curve on a closed surface, bold in front and faint behind.

    Args:
        axes: to draw in.
        view: how it is seen.
        points: of the curve, shape (3, n).
        outward: normals of the surface there, shape (3, n).
        style: of the line.
    """
    page = view.project(points)
    seen = view.towards @ outward >= 0
    front, behind = (np.where(shown, page, np.nan) for shown in (_grown(seen), _grown(~seen)))
    hidden = {**style, "alpha": _BEHIND * style.get("alpha", 1.0), "zorder": 1, "label": None}
    return axes.plot(*front, **style)[0], axes.plot(*behind, **hidden)[0]


def _grown(mask: Mask) -> Mask:
    """A mask one sample longer at each end, so that front and back meet."""
    grown: Mask = mask | np.roll(mask, 1)
    grown[0] = mask[0]
    return grown


def arrow(axes: Axes, view: View, along: Array, name: str) -> None:
    """A labelled arrow out of a surface, from the first point of `along` to the second."""
    foot, tip = view.project(along).T
    style = {"arrowstyle": "-|>", "color": INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tip, foot, arrowprops=style)
    beyond = tip + 0.07 * (tip - foot) / np.linalg.norm(tip - foot)
    axes.annotate(name, beyond, color=INK, ha="center", va="center")
    axes.update_datalim([tip, beyond])


def bare(axes: Axes) -> None:
    """No frame, no ticks, equal scales."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.04)
    axes.autoscale_view()


_SKY = View(azimuth=-60, elevation=28)
_BODY = View(azimuth=38, elevation=24)


# --- the axis of a top ---


@house_style()
def nutation(run: Trajectory, *, axis: Vector | None = None, ax: Axes | None = None) -> Drawn:
    """Trace of a body's axis on the unit sphere, the third direction of the laboratory up.

    Dashed circles are the least and greatest inclination reached; a dot marks the start.

    Args:
        run: the motion.
        axis: unit vector; by default the axis the first body spins about.
        ax: axes to draw in.

    Raises:
        DeclarationError: where no axis is given and no body spins about one.
    """
    axes = axes_or_new(ax, 3.8)
    root = equations_of(run).system.root
    direction = (axis or spin_axis(run)).express(root)
    t = instants(run)
    points = np.array([run.evaluate(component, t) for component in direction.components])
    sky = _before(points)
    for height in np.sin(np.radians([-60, -30, 0, 30, 60])):
        _draw(axes, sky, _parallel(height), color=FAINT, linewidth=0.6)
    for turn in np.radians(np.arange(0, 180, 30)):
        meridian = np.array(
            [np.cos(turn) * np.sin(_CIRCLE), np.sin(turn) * np.sin(_CIRCLE), np.cos(_CIRCLE)]
        )
        _draw(axes, sky, meridian, color=FAINT, linewidth=0.6)
    axes.plot(np.cos(_CIRCLE), np.sin(_CIRCLE), color=MUTED, linewidth=0.8)
    arrow(axes, sky, np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 1.25]]), f"${root.labels[2]}$")
    for height in (float(np.min(points[2])), float(np.max(points[2]))):
        _draw(axes, sky, _parallel(height), color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    trace = _draw(axes, sky, points, color=COLOURS[0], linewidth=1.4)
    start = sky.project(points[:, :1])
    axes.plot(*start, "o", color=COLOURS[0], markersize=4.5, zorder=3)
    bare(axes)
    return Drawn(axes, trace)


def spin_axis(run: Trajectory) -> Vector:
    """The axis that a body spins about, a unit vector along its axes.

    Raises:
        DeclarationError: where no body does.
    """
    for body in equations_of(run).system.bodies:
        if isinstance(body.spin, About | Relative):
            return body.axes[body.spin.axis]
    raise DeclarationError(
        f"no body of {run.system.name} spins about one of its axes",
        expected="a body with a spin axis, or the axis itself",
        advice="name the axis to follow, as axis=body.axes['3']",
    )


def _parallel(height: float) -> Array:
    radius = np.sqrt(max(0.0, 1 - height**2))
    return np.array([radius * np.cos(_CIRCLE), radius * np.sin(_CIRCLE), 0 * _CIRCLE + height])


def _before(points: Array) -> View:
    """The usual view, or from the side on which an axis stays that does not go round."""
    turned = np.unwrap(np.arctan2(points[1], points[0]))
    if not 0 < np.ptp(turned) < np.pi:
        return _SKY
    middle = (float(np.min(turned)) + float(np.max(turned))) / 2
    return View(float(np.degrees(middle)), _SKY.elevation)


def _draw(axes: Axes, sky: View, points: Array, **style: object) -> tuple[Line2D, Line2D]:
    return draw_on(axes, sky, points, points, **style)


# --- a free body: polhodes and the herpolhode ---


@house_style()
def polhodes(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Polhodes of a free body on its inertia ellipsoid, I₁ω₁² + I₂ω₂² + I₃ω₃² = 2T.

    Those of other angular momenta are thin, the separatrix is dashed, and the run's own is bold.
    The ellipsoid is drawn to scale along the principal axes (Poinsot 1834).

    Raises:
        DeclarationError: where no body turns freely with its principal axes, or two of its
            principal moments are equal.
    """
    axes = axes_or_new(ax, 3.8)
    body = free_body(run)
    moments = moments_of(run, body)
    rates = rates_of(run, body, instants(run))
    unit = rates * np.sqrt(moments)[:, None]  # on a ball, 2T its radius squared
    unit = unit / np.sqrt(np.sum(unit**2, axis=0))
    stretch = np.sqrt(np.min(moments) / moments)[:, None]
    for curve in _family(moments):
        _on_ellipsoid(axes, curve, stretch, color=MUTED, linewidth=0.6)
    for curve in _separatrices(moments):
        style = {"color": COLOURS[1], "linewidth": 1.1, "linestyle": (0, (4, 2))}
        _on_ellipsoid(axes, curve, stretch, **style)
    own = _on_ellipsoid(axes, unit, stretch, color=COLOURS[0], linewidth=2.0, alpha=1.0)
    _outline(axes, stretch)
    for i, name in enumerate(body.axes.labels):
        along = np.zeros((3, 2))
        along[i] = stretch[i, 0], stretch[i, 0] + 0.22
        arrow(axes, _BODY, along, name)
    bare(axes)
    return Drawn(axes, own)


def free_body(run: Trajectory) -> Body:
    """The body whose speeds are the components of its angular velocity along its own axes."""
    for body in equations_of(run).system.bodies:
        if isinstance(body.spin, Components):
            return body
    raise DeclarationError(
        f"{run.equations.system.name} has no free body to draw polhodes of",
        expected="a body whose speeds are the components of its angular velocity (Components)",
    )


def rates_of(run: Trajectory, body: Body, t: Array) -> Array:
    """Angular velocity along the body's axes, rad/s, shape (3, instants)."""
    return np.array([run.evaluate(c, t) for c in body.angular_velocity.components])


def moments_of(run: Trajectory, body: Body) -> Array:
    """Principal moments of inertia, three different ones, kg m²."""
    inertia = np.array([[run.evaluate(e, 0.0) for e in row] for row in body.inertia.rows])
    moments = np.diag(inertia)
    if np.any(inertia - np.diag(moments)) or len(set(moments)) < 3:
        raise DeclarationError(
            f"the moments of inertia of {body.name} have no polhodes to draw",
            expected="three different moments of inertia along principal axes",
        )
    return moments


def _family(moments: Array) -> list[Array]:
    least, middle, greatest = np.sort(moments)
    share = (np.arange(_FAMILY) + 0.5) / _FAMILY
    ratios = [*(least + (middle - least) * share**2), *(greatest + (middle - greatest) * share**2)]
    return [
        sign * curve for ratio in ratios for curve in [_polhode(moments, ratio)] for sign in _SIGNS
    ]


def _polhode(moments: Array, ratio: float) -> Array:
    """One of the two closed curves with L²/2T equal to `ratio`, on the unit ball, shape (3, n).

    With e_i the share of the energy of each axis, Σ e_i = 1 and Σ I_i e_i = ratio.
    """
    order = np.argsort(moments)
    around, others = (order[0], order[1:]) if ratio < np.median(moments) else (order[2], order[:2])
    widths = np.sqrt((ratio - moments[around]) / (moments[others] - moments[around]))
    curve = np.empty((3, len(_ROUND)))
    curve[others[0]], curve[others[1]] = widths[0] * np.cos(_ROUND), widths[1] * np.sin(_ROUND)
    curve[around] = np.sqrt(np.maximum(0.0, 1 - np.sum(curve[others] ** 2, axis=0)))
    return curve


def _separatrices(moments: Array) -> list[Array]:
    """The two great ellipses through the middle axis."""
    least, middle, greatest = np.argsort(moments)
    low, mid, high = np.sort(moments)
    tilt = np.arctan2(np.sqrt(mid - low), np.sqrt(high - mid))
    curves = []
    for sign in _SIGNS:
        curve = np.empty((3, len(_ROUND)))
        curve[middle] = np.cos(_ROUND)
        curve[least], curve[greatest] = (
            np.sin(_ROUND) * np.cos(tilt),
            sign * np.sin(_ROUND) * np.sin(tilt),
        )
        curves.append(curve)
    return curves


def _on_ellipsoid(
    axes: Axes, ball: Array, stretch: Array, **style: object
) -> tuple[Line2D, Line2D]:
    return draw_on(axes, _BODY, ball * stretch, ball / stretch, **style)


def _outline(axes: Axes, stretch: Array) -> None:
    """The outline of the ellipsoid: where its normal is perpendicular to the line of sight."""
    normal = _BODY.towards[:, None] / stretch
    normal = (normal / np.linalg.norm(normal)).ravel()
    first = np.cross(normal, [0.0, 0.0, 1.0])
    first = first / np.linalg.norm(first)
    second = np.cross(normal, first)
    rim = first[:, None] * np.cos(_ROUND) + second[:, None] * np.sin(_ROUND)
    axes.fill(
        *_BODY.project(rim * stretch),
        facecolor=FAINT,
        edgecolor=MUTED,
        alpha=0.35,
        zorder=0,
    )
    axes.plot(*_BODY.project(rim * stretch), color=MUTED, linewidth=0.8)


@house_style()
def herpolhode(run: Trajectory, *, ax: Axes | None = None) -> Drawn:
    """Path of the tip of ω on the plane perpendicular to the constant angular momentum, rad/s.

    Dashed circles are the least and greatest distance from the angular momentum (the cross); a
    dot marks the start, which is drawn to the right (Poinsot 1834).

    Raises:
        DeclarationError: where no body turns freely with its principal axes.
    """
    axes = axes_or_new(ax, 3.8)
    path = invariable_path(run)
    (line,) = axes.plot(*path, color=COLOURS[0], linewidth=1.1)
    axes.plot(*path[:, 0], "o", color=COLOURS[0], markersize=4.5, zorder=3)
    distances = np.hypot(*path)
    for radius in (float(np.min(distances)), float(np.max(distances))):
        circle = radius * np.array([np.cos(_ROUND), np.sin(_ROUND)])
        axes.plot(*circle, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.plot(0, 0, "+", color=MUTED, markersize=8)
    axes.set_aspect("equal")
    axes.margins(0.05)
    axes.set_xlabel(r"$\omega_\xi$ (rad/s)")
    axes.set_ylabel(r"$\omega_\eta$ (rad/s)")
    return Drawn(axes, [line])


def invariable_path(run: Trajectory) -> Array:
    """The angular velocity perpendicular to the angular momentum, in fixed axes, shape (2, n).

    With n along L and w the part of ω perpendicular to it, w turns about n at the rate
    n·(w × dw/dt)/w², dw/dt being taken in space. This rate is integrated by Gauss's quadrature,
    since the attitude itself is not needed.
    """
    t = instants(run)
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = np.diff(t)[:, None] / 2
    within = (t[:-1, None] + half * (1 + nodes)).ravel()
    turned = np.sum(half * weights * _swept(run, within).reshape(-1, _NODES), axis=1)
    angle = np.concatenate([[0.0], np.cumsum(turned)])
    across, _ = _across(run, t)
    path: Array = np.linalg.norm(across, axis=0) * np.array([np.cos(angle), np.sin(angle)])
    return path


def _across(run: Trajectory, t: Array) -> tuple[Array, Array]:
    """The part of ω perpendicular to the angular momentum, in body axes, and the normal."""
    body = free_body(run)
    rates = rates_of(run, body, t)
    momentum = moments_of(run, body)[:, None] * rates
    normal = momentum / np.linalg.norm(momentum, axis=0)
    return rates - normal * np.sum(normal * rates, axis=0), normal


def _swept(run: Trajectory, t: Array) -> Array:
    """Rate at which ω turns about the angular momentum, rad/s."""
    body = free_body(run)
    moments, rates = moments_of(run, body)[:, None], rates_of(run, body, t)
    across, normal = _across(run, t)
    gained = -np.cross(rates, moments * rates, axis=0) / moments  # Euler's equations
    drift = gained - normal * np.sum(normal * gained, axis=0)
    swept = np.sum(normal * np.cross(across, drift, axis=0), axis=0)
    distance = np.sum(across**2, axis=0)
    rate: Array = np.divide(swept, distance, out=np.zeros_like(t), where=distance > 0)
    return rate
