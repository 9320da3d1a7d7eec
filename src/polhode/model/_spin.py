"""The rotation of a body relative to the axes of its inertia, and the speeds that describe it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from polhode.algebra import Expr, SymbolKind, Vector, coordinate, solve, speed, variables
from polhode.base import DeclarationError
from polhode.model._declared import Declared
from polhode.model._frame import Frame


class Spin(Declared, ABC):
    """Chooses the rotational speeds of a body."""

    @abstractmethod
    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        """Angular velocity of the body in inertial space."""

    def speeds(self, axes: Frame, tag: str) -> tuple[Expr, ...]:
        """Speeds that are not rates of coordinates."""
        return ()

    def rates(self, axes: Frame, tag: str) -> dict[Expr, Expr]:
        """Rates of coordinates in terms of those speeds."""
        return {}

    def fixed_axes(self, axes: Frame, tag: str) -> Frame | None:
        """Axes that are fixed in the body; None if its attitude has no coordinates."""
        return axes

    def loose(self, axes: Frame) -> tuple[str, ...]:
        """Labels of the axes about which the body turns relative to them."""
        return ()


@dataclass(frozen=True)
class WithAxes(Spin):
    """The body turns with its axes; the speeds are the rates of their angles."""

    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        return axes.angular_velocity


@dataclass(frozen=True)
class About(Spin):
    """The body spins about one of its axes, which follow its tilt but not its spin.

    The speed is the total angular velocity along that axis: omega_3 = psi_dot + ω(axes)·3.

    Args:
        axis: label of the axis.
        angle: name of the coordinate that counts the turns relative to the axes.
    """

    axis: str
    angle: str = "psi"

    def _speed(self, tag: str) -> Expr:
        return speed(f"omega_{self.axis}{tag}")

    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        along = axes[self.axis]
        carried = axes.angular_velocity
        return carried + along * (self._speed(tag) - carried.dot(along))

    def speeds(self, axes: Frame, tag: str) -> tuple[Expr, ...]:
        return (self._speed(tag),)

    def rates(self, axes: Frame, tag: str) -> dict[Expr, Expr]:
        carried = axes.angular_velocity.dot(axes[self.axis])
        return {coordinate(self.angle + tag): self._speed(tag) - carried}

    def fixed_axes(self, axes: Frame, tag: str) -> Frame:
        return axes.rotated(coordinate(self.angle + tag), self.axis, name=f"{axes.name} spun")

    def loose(self, axes: Frame) -> tuple[str, ...]:
        return (self.axis,)


@dataclass(frozen=True)
class Relative(Spin):
    """As `About`, but the speed is the spin relative to the axes: omega = psi_dot.

    Args:
        axis: label of the axis.
        name: name of the speed.
        angle: name of the coordinate that counts the turns.
    """

    axis: str
    name: str = "omega"
    angle: str = "psi"

    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        return axes.angular_velocity + axes[self.axis] * speed(self.name + tag)

    def speeds(self, axes: Frame, tag: str) -> tuple[Expr, ...]:
        return (speed(self.name + tag),)

    def rates(self, axes: Frame, tag: str) -> dict[Expr, Expr]:
        return {coordinate(self.angle + tag): speed(self.name + tag)}

    def fixed_axes(self, axes: Frame, tag: str) -> Frame:
        return axes.rotated(coordinate(self.angle + tag), self.axis, name=f"{axes.name} spun")

    def loose(self, axes: Frame) -> tuple[str, ...]:
        return (self.axis,)


@dataclass(frozen=True)
class Components(Spin):
    """The speeds are the components of the angular velocity along the body's axes.

    The rates of the three angles that turn the axes follow, except where the angles are singular.

    Args:
        angles: names of these three coordinates, in full, if the axes turn with more than three; a
            tag of the body is not appended to them.

    Raises:
        DeclarationError: for other than three names; when the rates are asked for, for names of
            coordinates that do not turn the axes, and without names for axes that other than three
            coordinates turn.
    """

    angles: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        names = (self.angles,) if isinstance(self.angles, str) else tuple(self.angles)
        if len(names) not in (0, 3):
            raise DeclarationError(
                f"spin by components with angles={', '.join(names)}",
                expected="the names of three angles, or none",
                advice="leave them out where three angles turn the axes",
            )
        object.__setattr__(self, "angles", names)

    def speeds(self, axes: Frame, tag: str) -> tuple[Expr, ...]:
        return tuple(speed(f"omega_{label}{tag}") for label in axes.labels)

    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        return Vector(self.speeds(axes, tag), axes)

    def rates(self, axes: Frame, tag: str) -> dict[Expr, Expr]:
        # ω = J q̇ + ω₀, solved for the rates q̇ of the angles; ω₀ is due to prescribed rotations
        angles = self._angles_of(axes)
        columns = [[w.diff(angle.dt()) for angle in angles] for w in axes.turning]
        still = {angle.dt(): 0 for angle in angles}
        carried = [w.subs(still) for w in axes.turning]
        right = [w - c for w, c in zip(self.speeds(axes, tag), carried, strict=True)]
        try:
            return dict(zip(angles, solve(columns, right), strict=True))
        except ZeroDivisionError:
            raise DeclarationError(
                f"spin by components along {axes.name!r}, whose attitude is not determined by "
                + ", ".join(map(str, angles)),
                expected="axes that these three angles turn about different directions",
            ) from None

    def _angles_of(self, axes: Frame) -> tuple[Expr, ...]:
        """The three angles that turn the axes, from the root on."""
        turning: dict[str, Expr] = {}
        for frame in reversed(axes.lineage):
            for symbol in sorted(variables([frame.angle]), key=lambda s: s.published):
                if symbol.kind is SymbolKind.COORDINATE:
                    turning.setdefault(symbol.published, Expr.generator(symbol))
        names = self.angles or tuple(turning)
        if len(names) != 3 or not turning.keys() >= set(names):
            named = f" with angles={', '.join(self.angles)}" if self.angles else ""
            raise DeclarationError(
                f"spin by components{named} along the axes {axes.name!r}, which turn with "
                f"{', '.join(turning) or 'no coordinate'}",
                expected="axes turned by three angles, or the full names of three of their angles",
                advice="turn the axes by three angles; if they turn with more, name the body's own "
                "three: spin=Components(('phi', 'theta', 'psi'))",
            )
        return tuple(turning[name] for name in names)


@dataclass(frozen=True)
class Free(Spin):
    """Components along axes that do not follow the body: for balls, whose attitude is idle."""

    def speeds(self, axes: Frame, tag: str) -> tuple[Expr, ...]:
        return tuple(speed(f"omega_{label}{tag}") for label in axes.labels)

    def angular_velocity(self, axes: Frame, tag: str) -> Vector:
        return Vector(self.speeds(axes, tag), axes)

    def fixed_axes(self, axes: Frame, tag: str) -> None:
        return None

    def loose(self, axes: Frame) -> tuple[str, ...]:
        return axes.labels
