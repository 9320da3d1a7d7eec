"""Frames: right-handed triads of directions, each rotated from its parent."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    ExprLike,
    Matrix,
    Row,
    SymbolKind,
    Vector,
    cos,
    pi,
    rotation,
    sin,
    variables,
    words,
    zero_vector,
)
from polhode.base import DeclarationError, Shown
from polhode.model._declared import without_rates

IDENTITY = Matrix.diagonal([1, 1, 1])
_FREE = (SymbolKind.COORDINATE, SymbolKind.SPEED)  # not prescribed


@dataclass(frozen=True)
class Frame(Shown):
    """Three orthonormal directions, along which vectors are resolved.

    A frame without a parent is a root: the laboratory. `turned` is the angular velocity of a root
    in inertial space (rad/s, components along its own directions): zero except for the Earth.

    Args:
        name: of the frame.
        parent: the frame it is rotated from.
        angle: of the rotation, rad.
        axis: of the rotation, by components along either frame, in which they are equal.
        labels: of its directions.
        turned: for a root, its angular velocity in inertial space.
        compass: where the directions of a root on the Earth point: three of east, west, north,
            south, up, down; empty elsewhere.
    """

    name: str
    parent: Frame | None = None
    angle: Expr = ZERO
    axis: Row = (ZERO, ZERO, ONE)
    labels: tuple[str, ...] = ("x", "y", "z")
    turned: Row = (ZERO, ZERO, ZERO)
    compass: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        labels = words(self.labels, f"labels of frame {self.name!r}")
        if len(labels) != 3 or len(set(labels)) != 3:
            raise DeclarationError(f"labels {self.labels!r}", expected="three different labels")
        object.__setattr__(self, "labels", labels)

    @cached_property
    def _hash(self) -> int:
        return hash((self.name, self.parent, self.angle, self.axis, self.labels, self.turned))

    def __hash__(self) -> int:
        return self._hash

    def __str__(self) -> str:
        return f"{self.name} ({' '.join(self.labels)})"

    def __repr__(self) -> str:
        if self.parent is None:
            return f"Frame {self}"
        named = dict(zip(IDENTITY.rows, self.parent.labels, strict=True))
        about = named.get(self.axis, f"({', '.join(map(str, self.axis))})")
        return f"Frame {self}: {self.parent.name} turned by {self.angle} about {about}"

    def rotated(
        self,
        angle: ExprLike,
        about: str | Sequence[ExprLike],
        labels: str | Sequence[str] = "",
        name: str = "",
    ) -> Frame:
        """The frame rotated from this one by an angle (rad) about one of its directions.

        Args:
            angle: an expression of coordinates, parameters, time.
            about: label of a direction of this frame, or three components of a unit vector.
            labels: names of the new directions, such as "1 2 3"; those of this frame by default.
            name: name of the new frame.
        """
        new = words(labels, f"labels of a frame turned from {self.name!r}") or self.labels
        axis = self._components(about)
        turned = Expr.of(angle)
        without_rates([turned], f"a rotation of {self.name!r} by {turned}")
        return Frame(name or f"{self.name}'", self, turned, axis, new)

    def _components(self, about: str | Sequence[ExprLike]) -> Row:
        if isinstance(about, str):
            return self[about].components
        axis = tuple(Expr.of(c) for c in about)
        if len(axis) != 3 or sum((c * c for c in axis), ZERO) != 1:
            raise DeclarationError(
                f"rotation about {tuple(map(str, axis))}",
                expected="three components of a unit vector",
                advice="divide them by their length",
            )
        return axis

    def __getitem__(self, label: str) -> Vector:
        """Unit vector along the direction with this label; 1, 2, 3 are labels in any frame."""
        position = self.position(label)
        return Vector(tuple(ONE if i == position else ZERO for i in range(3)), self)

    def position(self, label: str) -> int:
        """The index of the direction with a label: 0, 1 or 2."""
        for names in (self.labels, ("1", "2", "3")):
            if label in names:
                return names.index(label)
        raise DeclarationError(
            f"direction {label!r} of frame {self.name!r}",
            expected=f"one of {', '.join(self.labels)}",
        )

    @property
    def directions(self) -> tuple[Vector, Vector, Vector]:
        """The three unit vectors."""
        first, second, third = (self[label] for label in self.labels)
        return first, second, third

    def others(self, label: str) -> tuple[str, str]:
        """The two labels that follow one in cyclic order."""
        position = self.position(label)
        return self.labels[(position + 1) % 3], self.labels[(position + 2) % 3]

    def vector(self, *components: ExprLike) -> Vector:
        """The vector with these three components."""
        return Vector.along(self, components)

    @property
    def zero(self) -> Vector:
        """The zero vector."""
        return zero_vector(self)

    @property
    def skyward(self) -> Vector | None:
        """Unit vector upwards, of a root on the Earth whose directions are known."""
        for name, sign in (("up", 1), ("down", -1)):
            if name in self.compass:
                return self[self.labels[self.compass.index(name)]] * sign
        return None

    @property
    def lineage(self) -> tuple[Frame, ...]:
        """This frame, its parent, and so on to the root."""
        return (self,) if self.parent is None else (self, *self.parent.lineage)

    @property
    def root(self) -> Frame:
        """The frame without a parent from which this one descends."""
        return self.lineage[-1]

    @property
    def turning(self) -> Row:
        """Angular velocity in inertial space, components along these directions, rad/s."""
        return _turning(self)

    @property
    def angular_velocity(self) -> Vector:
        """Angular velocity in inertial space, rad/s."""
        return Vector(self.turning, self)

    @property
    def turns_freely(self) -> bool:
        """Whether its rotation depends on coordinates or speeds, not on time alone."""
        return any(s.kind in _FREE for s in variables(self.turning))

    def rotation_to(self, other: Frame) -> Matrix:
        """The matrix from components along these directions to components along the other's."""
        return _rotation_between(self, other)


def earth(Omega: ExprLike, *, colatitude: ExprLike, directions: str = "east north up") -> Frame:
    """The laboratory on the rotating Earth: a root frame with the Earth's angular velocity.

    The origin moves with the ground; its centripetal acceleration is included in g.

    Args:
        Omega: angular velocity of the Earth, rad/s.
        colatitude: angle between the vertical and the Earth's axis, rad.
        directions: of x, y and z, right-handed: three of east, west, north, south, up, down.
    """
    spin = {"north": sin(colatitude) * Omega, "up": cos(colatitude) * Omega, "east": ZERO}
    opposite = {"south": "north", "down": "up", "west": "east"}
    names = directions.split()
    axes = [opposite.get(name, name) for name in names]
    signs = [-1 if name in opposite else 1 for name in names]
    if sorted(axes) != ["east", "north", "up"] or not _right_handed(axes, signs):
        raise DeclarationError(
            f"directions {directions!r} of the Earth frame",
            expected="three perpendicular right-handed directions, such as 'east north up'",
        )
    turned = tuple(s * spin[a] for s, a in zip(signs, axes, strict=True))
    return Frame("Earth", turned=turned, compass=tuple(names))


def _right_handed(axes: list[str], signs: list[int]) -> bool:
    cyclic = (axes.index("north") - axes.index("east")) % 3 == 1
    return (signs[0] * signs[1] * signs[2] > 0) == cyclic


def upright(frame: Frame, labels: str = "1 2 3") -> Frame:
    """The frame whose first direction is the third (the vertical) of the given one."""
    return frame.rotated(-pi / 2, frame.labels[1], labels=labels)


@lru_cache(maxsize=1024)
def _step(frame: Frame) -> Matrix:
    """Components along the frame → components along its parent."""
    return rotation(frame.axis, cos(frame.angle), sin(frame.angle))


@lru_cache(maxsize=4096)
def _turning(frame: Frame) -> Row:
    if frame.parent is None:
        return frame.turned
    carried = _step(frame).T.times(frame.parent.turning)
    # angular velocities add: that of the parent, and the rate about an axis common to both frames
    rate = frame.angle.dt()
    return tuple(w + rate * axis for w, axis in zip(carried, frame.axis, strict=True))


@lru_cache(maxsize=4096)
def _rotation_between(source: Frame, target: Frame) -> Matrix:
    if source == target:
        return IDENTITY
    down, up = source.lineage, target.lineage
    shared = next((frame for frame in down if frame in up), None)
    if shared is None:
        raise DeclarationError(
            f"frames {source.name!r} and {target.name!r} in one system",
            expected="frames that descend from one root",
            advice="build both from the same Frame with rotated",
        )
    matrix = IDENTITY
    for frame in down[: down.index(shared)]:
        matrix = _step(frame) @ matrix
    for frame in reversed(up[: up.index(shared)]):
        matrix = _step(frame).T @ matrix
    return matrix
