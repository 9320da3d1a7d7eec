"""The scene: one plain structure with everything that there is to see of a motion.

The page, the notebook and the maker of stills all draw a `Scene` and nothing else. Lengths are in
metres, times in seconds, vectors along the directions of the root frame; attitudes are unit
quaternions (x, y, z, w) that turn the body's axes into the root frame's. Along the first axis of
an array run the frames: `frames` instants, equally spaced from 0 to `duration`; an array with one
row stays the same throughout.
"""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from math import hypot
from typing import Any

import numpy as np

from polhode.base import Shown
from polhode.view._judgement import Judgement
from polhode.view._mathml import Formula
from polhode.view._quantities import Array

Triple = tuple[float, float, float]

#: Nothing, as rows of three numbers.
NOWHERE: Array = np.zeros((0, 3))


@dataclass(frozen=True)
class Pose:
    """Where something is and how it is turned.

    Attributes:
        place: m, shape (frames or 1, 3).
        turn: quaternions, shape (frames or 1, 4).
        spin: angle turned besides about `axis`, rad, shape (frames,); empty where there is none.
            Kept apart so that a fast spin can be followed between two frames.
        axis: unit vector along the turned axes.
    """

    place: Array
    turn: Array
    spin: Array
    axis: Triple


@dataclass(frozen=True)
class BodyShape:
    """What a body looks like.

    Attributes:
        kind: ball (radius), ellipsoid (three half-axes), disk, hoop or wheel (radius, height),
            rod (length, radius), box (three sides), racquet (length, width, thickness), or
            revolution (height along the axis and radius of every point of the outline).
        size: the lengths named, m.
        axis: unit vector along the body's axes: of symmetry, or the long one.
        across: unit vector along the body's axes, perpendicular to it.
        centre: from the centre of mass to its middle, along the body's axes, m.
    """

    kind: str
    size: tuple[float, ...]
    axis: Triple = (0.0, 0.0, 1.0)
    across: Triple = (1.0, 0.0, 0.0)
    centre: Triple = (0.0, 0.0, 0.0)

    @property
    def reach(self) -> float:
        """Distance from the centre of mass to the farthest point, m."""
        if self.kind == "revolution":
            return max(map(hypot, self.size[::2], self.size[1::2]))
        halves = {"box": 0.87, "rod": 0.5, "racquet": 0.6}
        return max(self.size) * halves.get(self.kind, 1.0) + hypot(*self.centre)


@dataclass(frozen=True)
class SceneBody:
    """A body.

    Attributes:
        name: as declared.
        shape: what it looks like.
        pose: of its axes, with the spin about one of them.
        arms: from the centre of mass to the points at which it is held, along its axes, m.
        labels: names of its axes, those that do not turn with its spin; none for a ball without.
    """

    name: str
    shape: BodyShape
    pose: Pose
    arms: tuple[Triple, ...]
    labels: tuple[str, ...] = ()

    @property
    def reach(self) -> float:
        """Distance from the centre of mass to the farthest point, joints included, m."""
        return max([self.shape.reach, *(float(np.linalg.norm(arm)) for arm in self.arms)])


@dataclass(frozen=True)
class Joint:
    """What a body turns on where it is held.

    Attributes:
        kind: pivot (turns freely), hinge (about its axis), universal (a cross; this is one of its
            arms) or weld (not at all).
        name: as declared.
        body: position of the body it is drawn with, among the bodies.
        place: from the centre of mass of that body, along its axes, m.
        axis: unit vector along the body's axes; means nothing for a pivot.
    """

    kind: str
    name: str
    body: int
    place: Triple
    axis: Triple


@dataclass(frozen=True)
class Link:
    """What pulls or pushes between two points.

    Attributes:
        kind: spring, damper or rope.
        name: as declared.
        start, end: the points, m, shape (frames or 1, 3).
        thick: radius that it is drawn with, m.
    """

    kind: str
    name: str
    start: Array
    end: Array
    thick: float


@dataclass(frozen=True)
class Support:
    """A surface. The first two directions of the pose of a flat one lie in it, the third points up.

    Attributes:
        name: of the first contact on it.
        kind: plane, turntable, sheet or curved.
        pose: of the surface as it moves.
        middle: of what is drawn of a flat one, along the two directions, m.
        reach: half its width along each, m.
        points: of a curved one, along the axes of its pose, m, shape (rows, columns, 3). From the
            side of the bodies, points (i, j), (i + 1, j), (i + 1, j + 1) go round
            counter-clockwise.
    """

    name: str
    kind: str
    pose: Pose
    middle: tuple[float, float]
    reach: tuple[float, float]
    points: Array = field(default_factory=lambda: np.zeros((0, 0, 3)))


@dataclass(frozen=True)
class Arrow:
    """A vector drawn as an arrow.

    Attributes:
        kind: force, load, torque, omega or momentum.
        name: what it is, in words.
        symbol: MathML, as m g; empty for the letter of its kind.
        body: position of its body among the bodies.
        unit: of its components.
        foot: where it begins, m; empty for the centre of mass of the body.
        along: components, in `unit`.
        usual: length that it keeps below for nine tenths of the motion.
        largest: greatest length.
        normal: of a contact, a unit vector; empty where the force has no other part.
        friction: coefficient of static friction of a contact; 0 where none is declared.
    """

    kind: str
    name: str
    symbol: str
    body: int
    unit: str
    foot: Array
    along: Array
    usual: float
    largest: float
    normal: Array = field(default_factory=lambda: NOWHERE)
    friction: float = 0.0


@dataclass(frozen=True)
class Rotation:
    """One of the rotations that lead from the root frame to some axes, with the arc of its angle.

    Attributes:
        symbol: MathML of the angle; empty where no arc is drawn.
        angle: by which it turns, rad, shape (frames or 1,).
        axis: unit vector along the directions before the rotation, or after it.
        begin: unit vector along the directions before it from which the arc begins.
        offset: the angle where the arc begins, rad.
        coordinate: published name of the coordinate, or parameter, that the arc is; empty for
            other angles.
        sign: 1, or -1 where it turns the other way round.
    """

    symbol: str
    angle: Array
    axis: Triple
    begin: Triple
    offset: float
    coordinate: str = ""
    sign: int = 1


@dataclass(frozen=True)
class Angles:
    """The angles that lead to some axes, drawn around a point.

    Attributes:
        name: of the body or contact whose axes they are.
        body: position among the bodies of the one by whose size they are drawn.
        vertex: the point, m, shape (frames or 1, 3).
        rotations: from the first to the last.
    """

    name: str
    body: int
    vertex: Array
    rotations: tuple[Rotation, ...]


@dataclass(frozen=True)
class Trace:
    """A path that is left behind.

    Attributes:
        kind: contact, centre or axis.
        name: what it is, in words.
        points: m; not a number where there is nothing to draw.
        support: position of the support it is drawn on and moves with, or -1.
    """

    kind: str
    name: str
    points: Array
    support: int = -1


@dataclass(frozen=True)
class PlotSeries:
    """A quantity against time.

    Attributes:
        name: published name.
        symbol: MathML.
        values: in the unit of its panel, at equally spaced instants from 0 to the duration.
    """

    name: str
    symbol: str
    values: Array


@dataclass(frozen=True)
class Panel:
    """Quantities that share an axis.

    Attributes:
        unit: of their values.
        series: the quantities.
        kind: lines, or energies: total, kinetic and potential energy, of which the kinetic one is
            drawn as what the total has above the potential one.
    """

    unit: str
    series: tuple[PlotSeries, ...]
    kind: str = "lines"


@dataclass(frozen=True)
class Portrait:
    """A motion against something other than time.

    Attributes:
        kind: plane (a curve); well (a curve at the height of `level`, over the potential
            `curve`); sphere (directions on the unit sphere); or axis (those of an axis of a body).
        title: what it shows, in words.
        names: of its axes: published names of quantities in a plane, labels of directions.
        symbols: MathML of them; empty where the names are the letters.
        units: of the columns; empty on a sphere.
        columns: values along the axes, at equally spaced instants from 0 to the duration.
        curve: of a well, places and heights of its potential.
        level: of a well, the energy.
        body: of an axis, position of its body among the bodies, whose pose has its directions.
        axis: unit vector along the axes of that body.
    """

    kind: str
    title: str
    names: tuple[str, ...]
    symbols: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    columns: tuple[Array, ...] = ()
    curve: tuple[Array, ...] = ()
    level: float = 0.0
    body: int = -1
    axis: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class SceneNumber:
    """A named number.

    Attributes:
        name: published name.
        symbol: MathML; empty for the name as it is.
        value: in its unit.
        unit: SI unit, or deg for an angle.
        meaning: in words.
    """

    name: str
    symbol: str
    value: float
    unit: str
    meaning: str = ""


@dataclass(frozen=True)
class SceneEvent:
    """An event of the motion."""

    time: float
    what: str


@dataclass(frozen=True)
class ModeSpan:
    """A stay in a contact mode."""

    name: str
    begin: float
    end: float


@dataclass(frozen=True)
class MotionSummary:
    """What there is to read of a motion; see `Scene` for what each part is."""

    panels: tuple[Panel, ...]
    portraits: tuple[Portrait, ...]
    motion: tuple[Formula, ...]
    reactions: tuple[Formula, ...]
    parameters: tuple[SceneNumber, ...]
    start: tuple[SceneNumber, ...]
    evidence: tuple[SceneNumber, ...]
    happenings: tuple[SceneEvent, ...]
    modes: tuple[ModeSpan, ...] = ()
    doubt: str = ""


@dataclass(frozen=True)
class Scene(Shown):
    """All there is to see of a motion; `as_json` gives the document that a page is made of.

    Attributes:
        title: heading.
        about: a few sentences; empty for none.
        duration: s.
        frames: number of instants that poses are given at.
        up: unit vector that is upright on the screen.
        floor: height of a faint floor beneath everything, m; None where a support is one.
        directions: names of the directions of the root frame; on the Earth with where they point.
        bodies, joints, links, supports, arrows, angles, traces, panels, portraits: what is
            drawn.
        motion, reactions: the equations.
        parameters, start: numbers it was made with.
        evidence: relative drift of conserved quantities.
        happenings: events.
        modes: contact modes, one after the other.
        doubt: why the motion may be wrong; empty where nothing suggests it.
        judgements: verdicts on claims.
        origin: schema, versions, declaration and seed.
    """

    title: str
    about: str
    duration: float
    frames: int
    up: Triple
    floor: float | None
    directions: tuple[str, ...]
    bodies: tuple[SceneBody, ...]
    joints: tuple[Joint, ...]
    links: tuple[Link, ...]
    supports: tuple[Support, ...]
    arrows: tuple[Arrow, ...]
    angles: tuple[Angles, ...]
    traces: tuple[Trace, ...]
    panels: tuple[Panel, ...] = ()
    portraits: tuple[Portrait, ...] = ()
    motion: tuple[Formula, ...] = ()
    reactions: tuple[Formula, ...] = ()
    parameters: tuple[SceneNumber, ...] = ()
    start: tuple[SceneNumber, ...] = ()
    evidence: tuple[SceneNumber, ...] = ()
    happenings: tuple[SceneEvent, ...] = ()
    modes: tuple[ModeSpan, ...] = ()
    doubt: str = ""
    judgements: tuple[Judgement, ...] = ()
    origin: Mapping[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        bodies = ", ".join(body.name for body in self.bodies)
        return f"Scene {self.title!r}: {bodies}, {self.frames} frames over {self.duration:g} s"

    def as_json(self) -> dict[str, Any]:
        """As plain data under the names of the attributes.

        An array becomes {"shape": [...], "float32": base64 of its numbers, little-endian}.
        """
        document: dict[str, Any] = plain(self)
        return document


def in_base64(values: Array) -> dict[str, str]:
    """The numbers of an array as text."""
    return {"float32": base64.b64encode(single_precision(values)).decode("ascii")}


def single_precision(values: Array) -> bytes:
    """The numbers of an array, little-endian."""
    return values.astype("<f4").tobytes()


def plain(value: Any, encode: Callable[[Array], Mapping[str, object]] = in_base64) -> Any:
    """A part of a scene as plain data.

    Args:
        value: the part.
        encode: gives what stands beside the shape of an array for its numbers.
    """
    if is_dataclass(value):
        return {f.name: plain(getattr(value, f.name), encode) for f in fields(value)}
    if isinstance(value, np.ndarray):
        return {"shape": list(value.shape), **encode(value)}
    if isinstance(value, tuple | list):
        return [plain(item, encode) for item in value]
    if isinstance(value, Mapping):
        return {str(key): plain(item, encode) for key, item in value.items()}
    return value
