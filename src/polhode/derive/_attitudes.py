"""Attitudes described by three angles, and the same system with its angles counted otherwise.

Three successive rotations describe every attitude, but are singular where the first and the third
axis coincide (gimbal lock): for φ about z, θ about x', ψ about z'' at θ = 0. If the axes from which
the first angle is counted are turned by a right angle about the second axis, the same rotations are
regular there, and singular elsewhere. A motion can thus go through any attitude in one description
or the other. With real gimbals, that is, with bodies or forces on the axes in between, there is no
such choice, but no singularity either.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from typing import Any

from polhode.algebra import (
    ZERO,
    Expr,
    Row,
    Symbol,
    SymbolKind,
    Vector,
    cos,
    dot,
    pi,
    sin,
)
from polhode.model import (
    About,
    Body,
    Components,
    Frame,
    Hold,
    Pivot,
    Spin,
    System,
    WithAxes,
    rebuilt,
)

#: Appended to the names of angles that are counted from turned axes.
_TURNED = "_turned"


@dataclass(frozen=True)
class AngleTriple:
    """Three successive rotations that turn a body, and nothing else.

    Attributes:
        bodies: those that turn with all three.
        first: the frame after the first rotation.
        second: the frame before the last one; the axes of a body that spins relative to them.
        last: the frame after the last rotation.
        angles: of the rotations.
        axes: of the three rotations at zero angles, along the axes from which the first starts.
    """

    bodies: tuple[Body, ...]
    first: Frame
    second: Frame
    last: Frame
    angles: tuple[Symbol, Symbol, Symbol]
    axes: tuple[Row, Row, Row]

    @property
    def base(self) -> Frame:
        """The frame from which the first angle is counted."""
        assert self.first.parent is not None
        return self.first.parent

    @cached_property
    def turned_angles(self) -> tuple[Symbol, Symbol, Symbol]:
        """The angles counted from turned axes."""
        first, second, third = (self._turned(angle) for angle in self.angles)
        return first, second, third

    @cached_property
    def alignment(self) -> Expr:
        """Cosine of the angle between the first and the third axis: ±1 in gimbal lock."""
        first, second, last = self.axes
        across = Vector(second, self.base).cross(Vector(last, self.base)).components
        angle = Expr.generator(self.angles[1])
        return cos(angle) * dot(first, last) + sin(angle) * dot(first, across)

    def angular_velocity(self, angles: Iterable[Symbol]) -> Row:
        """Of the bodies relative to the base, along the axes from which the angles are counted.

        Args:
            angles: the declared ones or the turned ones.
        """
        first, second, last = angles
        _, nodes, axis = self._axes_at(first, second)
        rates = [Expr.generator(q.derivative()) for q in (first, second, last)]
        return tuple(dot(rates, column) for column in zip(self.axes[0], nodes, axis, strict=True))

    def rates(self, angular_velocity: Sequence[Expr]) -> dict[Symbol, Expr]:
        """Rates of the declared angles, from the angular velocity along the axes of the base."""
        first, second, last = self.angles
        across, nodes, axis = self._axes_at(first, second)
        spin = dot(angular_velocity, across) / dot(axis, across)
        return {
            first.derivative(): dot(angular_velocity, self.axes[0]) - spin * self.alignment,
            second.derivative(): dot(angular_velocity, nodes),
            last.derivative(): spin,
        }

    def _axes_at(self, first: Symbol, second: Symbol) -> tuple[Row, Row, Row]:
        """Perpendicular to the first two axes of rotation; the second one; the third one."""
        one, nodes, last = self.axes
        aside = Vector(one, self.base).cross(Vector(nodes, self.base)).components
        (c, s), (u, v) = ((cos(Expr.generator(q)), sin(Expr.generator(q))) for q in (first, second))
        across = tuple(s * b - c * a for a, b in zip(aside, nodes, strict=True))
        along, beside = dot(last, one), dot(last, aside)
        parts = (along * u + beside * v, along * v - beside * u)
        return (
            across,
            tuple(c * b + s * a for a, b in zip(aside, nodes, strict=True)),
            tuple(parts[0] * a + parts[1] * d for a, d in zip(one, across, strict=True)),
        )

    def _turned(self, angle: Symbol) -> Symbol:
        tag = next((b.tag for b in self.bodies if b.tag and angle.name.endswith(b.tag)), "")
        return Symbol(angle.name.removesuffix(tag) + _TURNED + tag, SymbolKind.COORDINATE)

    def is_same_along(self, frame: Frame) -> bool:
        """Whether components along a frame mean the same for any angles of this attitude."""
        lineage = frame.lineage
        return self.first not in lineage or self.last in lineage


def attitudes(system: System) -> tuple[AngleTriple, ...]:
    """The attitudes of a system that can be described otherwise."""
    use = _Use.of(system)
    names = {symbol.name for symbol in use.symbols | use.angles.keys()}
    return tuple(
        attitude
        for attitude in _found(system, use.frames)
        if not any(s.name in names for s in attitude.turned_angles)
        and all(use.angles.get(q, 0) <= 1 and q not in use.symbols for q in attitude.angles)
        and use.symbols.isdisjoint(_chosen_in(system, attitude.angles))
    )


def singular_attitudes(system: System) -> tuple[AngleTriple, ...]:
    """All attitudes that are singular in gimbal lock, described otherwise or not.

    Loads and joints may refer to the axes between the rotations or to the angles. With a body on
    these axes there is no gimbal lock: these are real gimbals.
    """
    turned = (b for b in system.bodies if not b.inertia.is_zero)
    return tuple(_found(system, frozenset(b.fixed_axes or b.axes for b in turned)))


def _found(system: System, used: frozenset[Frame]) -> Iterable[AngleTriple]:
    """The attitudes along the axes of all bodies, between frames that are used otherwise."""
    found: dict[Frame, AngleTriple] = {}
    for body in system.bodies:
        for attitude in _along(body, used):
            known = found.get(attitude.last)
            bodies = (*(known.bodies if known else ()), body)
            found[attitude.last] = replace(attitude, bodies=bodies)
    return found.values()


def _chosen_in(system: System, angles: Iterable[Symbol]) -> frozenset[Symbol]:
    """The speeds that a user chose in which some angles or their rates occur."""
    found = set(angles)
    for symbol, meaning in system.speeds:
        if any(s.base() in found for s in meaning.symbols()):
            found.add(symbol)
    return frozenset(found.difference(angles))


def with_turned_angles(system: System, chosen: Iterable[AngleTriple]) -> System:
    """The same system with the angles of some attitudes counted from turned axes.

    Speeds that a user chose are left out if these angles occur in them: they may be as singular as
    the angles. So is the choice of independent speeds if it names any of these.
    """
    attitudes = tuple(chosen)
    copier = _Copier(attitudes)
    angles = {q for attitude in attitudes for q in attitude.angles}
    left_out = angles | _chosen_in(system, angles)
    kept: dict[str | Expr, Expr] = {
        s.name: meaning for s, meaning in system.speeds if s not in left_out
    }
    independent = system.independent
    if any(s.base() in left_out for s in independent):
        independent = ()
    parts = (*system.bodies, *system.elements, *system.loads)
    return rebuilt(system, tuple(map(copier.copied, parts)), map(Expr.generator, independent), kept)


@dataclass(frozen=True)
class _Use:
    """What a declaration depends on.

    Attributes:
        frames: along which something is given, other than by the spin of a symmetric body.
        symbols: in anything but angles of frames.
        angles: how many frames each symbol turns.
    """

    frames: frozenset[Frame]
    symbols: frozenset[Symbol]
    angles: Mapping[Symbol, int]

    @classmethod
    def of(cls, system: System) -> _Use:
        spinning = {
            body.axes: body.axes.position(body.spin.axis)
            for body in system.bodies
            if isinstance(body.spin, About)
        }
        frames, symbols = set[Frame](), set[Symbol]()
        # Speeds are left out: they only say how the motion is described.
        for part in _leaves((*system.bodies, *system.elements, *system.loads)):
            if isinstance(part, Frame):
                frames.add(part)
            elif isinstance(part, Vector) and isinstance(part.triad, Frame):
                axis = spinning.get(part.triad)
                across = [c for i, c in enumerate(part.components) if i != axis]
                if axis is None or any(across):
                    frames.add(part.triad)
                symbols.update(*(c.symbols() for c in part.components))
            elif isinstance(part, Expr):
                symbols |= part.symbols()
        carried = {f for used in (*frames, *spinning) for f in used.lineage}
        carried |= {f for b in system.bodies if b.fixed_axes for f in b.fixed_axes.lineage}
        angles: dict[Symbol, int] = {}
        for frame in carried:
            for symbol in frame.angle.symbols():
                angles[symbol] = angles.get(symbol, 0) + 1
        return cls(frozenset(frames), frozenset(s.base() for s in symbols), angles)


def _leaves(value: Any) -> Iterator[Any]:
    """The frames, vectors and expressions of a declaration, axes of spinning bodies left out."""
    if isinstance(value, Frame | Vector | Expr):
        yield value
    elif isinstance(value, Body):
        if not isinstance(value.spin, About):
            yield value.axes
        for part in (value.mass, *value.inertia.rows, value.surface):
            yield from _leaves(part)
    elif isinstance(value, tuple):
        for part in value:
            yield from _leaves(part)
    elif type(value) in (Hold, Pivot) and set(value.only) == set(value.along.labels):
        # held along all axes: which they are decides the components of the force alone
        yield from _leaves((value.bodies, value.at, value.to if isinstance(value, Pivot) else ()))
    elif is_dataclass(value) and not isinstance(value, Symbol | Spin | type):
        for field in fields(value):
            yield from _leaves(getattr(value, field.name))


def _along(body: Body, used: frozenset[Frame]) -> Iterator[AngleTriple]:
    """The attitudes along the rotations that lead from the root to a body."""
    fixed = body.fixed_axes
    if fixed is None or not isinstance(body.spin, About | Components | WithAxes):
        return
    run: list[Frame] = []
    for frame in reversed(fixed.lineage[:-1]):
        run.append(frame)
        if frame == fixed or frame in used:
            attitude = _attitude(body, run)
            if attitude is not None:
                yield attitude
            run = []


def _attitude(body: Body, run: list[Frame]) -> AngleTriple | None:
    """The attitude that successive rotations describe, if they are of the right kind."""
    turning = [frame for frame in run if any(map(_moves, frame.angle.symbols()))]
    symbols = [_angle(frame) for frame in turning]
    if len(turning) != 3 or None in symbols:
        return None
    first, _, last = turning
    base, second = first.parent, last.parent
    assert base is not None
    assert second is not None
    if last != run[-1]:  # axes turned once more by a constant angle: the rotations end there
        last = run[-1]
    still = dict.fromkeys((s for s in symbols if s is not None), ZERO)

    def at_rest(frame: Frame) -> Row:
        along = frame.rotation_to(base).times(frame.axis)
        return tuple(c.subs(still) for c in along)

    axes = tuple(map(at_rest, turning))
    crosswise = [dot(axes[1], axes[k]) for k in (0, 2)]
    known = not any(s.name != "pi" for axis in axes for c in axis for s in c.symbols())
    if not known or any(crosswise):
        return None
    q1, q2, q3 = (s for s in symbols if s is not None)
    return AngleTriple((body,), first, second, last, (q1, q2, q3), (axes[0], axes[1], axes[2]))


def _angle(frame: Frame) -> Symbol | None:
    """The coordinate that turns a frame, but for a constant; None for any other angle."""
    found = [s for s in frame.angle.symbols() if _moves(s)]
    if len(found) != 1 or found[0].kind is not SymbolKind.COORDINATE:
        return None
    rest = frame.angle - Expr.generator(found[0])
    return None if any(map(_moves, rest.symbols())) else found[0]


def _moves(symbol: Symbol) -> bool:
    return symbol.kind.varies or symbol.kind is SymbolKind.TIME


class _Copier:
    """Copies a declaration with other frames; what does not depend on them is kept.

    Args:
        attitudes: whose angles are counted from turned axes in the copy.
    """

    def __init__(self, attitudes: tuple[AngleTriple, ...]) -> None:
        self._attitudes = attitudes
        self._angles = {
            old: new for a in attitudes for old, new in zip(a.angles, a.turned_angles, strict=True)
        }
        self._frames: dict[Frame, Frame] = {}
        self._copies: dict[int, tuple[Any, Any]] = {}  # with the originals, so that ids stay valid

    def copied(self, value: Any) -> Any:
        if id(value) not in self._copies:
            self._copies[id(value)] = (value, self._copy(value))
        return self._copies[id(value)][1]

    def _copy(self, value: Any) -> Any:
        if isinstance(value, Frame):
            return self._frame(value)
        if isinstance(value, Vector) and isinstance(value.triad, Frame):
            return Vector(value.components, self._frame(value.triad))
        if isinstance(value, Symbol):
            return self._symbol(value)
        if isinstance(value, tuple):
            return tuple(map(self.copied, value))
        if isinstance(value, Expr) or not is_dataclass(value) or isinstance(value, type):
            return value
        made = copy(value)
        for field in fields(value):
            object.__setattr__(made, field.name, self.copied(getattr(value, field.name)))
        for cached in set(vars(made)) - {field.name for field in fields(value)}:
            object.__delattr__(made, cached)
        if isinstance(value, Body):
            object.__setattr__(made, "spin", self._spin(value))
        return made

    def _symbol(self, symbol: Symbol) -> Symbol:
        new = self._angles.get(symbol.base())
        return symbol if new is None else Symbol(new.name, symbol.kind, symbol.order)

    def _frame(self, frame: Frame) -> Frame:
        if frame.parent is None:
            return frame
        if frame not in self._frames:
            parent = self._frame(frame.parent)
            turned = next((a for a in self._attitudes if a.first == frame), None)
            if turned is not None:
                parent = parent.rotated(pi / 2, turned.axes[1], name=f"{parent.name} turned")
            angle = frame.angle.subs({q: Expr.generator(new) for q, new in self._angles.items()})
            self._frames[frame] = replace(frame, parent=parent, angle=angle)
        return self._frames[frame]

    def _spin(self, body: Body) -> Spin:
        spin = body.spin
        if isinstance(spin, About):
            new = self._named(spin.angle + body.tag)
            return replace(spin, angle=new.removesuffix(body.tag))
        if isinstance(spin, Components):
            return replace(spin, angles=tuple(map(self._named, spin.angles)))
        return spin

    def _named(self, angle: str) -> str:
        new = self._angles.get(Symbol(angle, SymbolKind.COORDINATE))
        return angle if new is None else new.name
