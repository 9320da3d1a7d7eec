"""Where contacts open along a level of the energy, without integration.

A system that moves in one coordinate q has there a speed q̇² = 2 (E − V)/m(q), and with Newton's law
every reaction is a function of q alone. A contact opens where its normal force vanishes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from polhode.algebra import ZERO, Expr, ExprLike, Symbol, absolute, cos, factors, sin
from polhode.analyse._steady import broken_sign
from polhode.base import DeclarationError, Shown
from polhode.derive import Equations, equations_only
from polhode.model import Contact


@dataclass(frozen=True)
class Opening(Shown):
    """Where a contact opens, from a given start on.

    Attributes:
        contact: its name.
        coordinate: in which the system moves.
        normal: normal force along the level of the energy, N, as a function of the coordinate.
        friction: force along the support over the normal force: the coefficient of friction with
            which it is about to slip. None where there is no such force, or one in two directions.
        places: where the normal force vanishes: the cosine or sine of the coordinate, or itself,
            and its value there.
        greatest: the same where the normal force is stationary, as at its greatest.
    """

    contact: str
    coordinate: Expr
    normal: Expr
    friction: Expr | None
    places: tuple[tuple[Expr, Expr], ...]
    greatest: tuple[tuple[Expr, Expr], ...]

    def subs(self, values: Mapping[Symbol, Expr]) -> Opening:
        """With values of parameters put in."""

        def put(places: tuple[tuple[Expr, Expr], ...]) -> tuple[tuple[Expr, Expr], ...]:
            return tuple((left, value.subs(values)) for left, value in places)

        return replace(
            self,
            normal=self.normal.subs(values),
            friction=None if self.friction is None else self.friction.subs(values),
            places=put(self.places),
            greatest=put(self.greatest),
        )

    def __str__(self) -> str:
        lines = [f"{self.contact} opens"]
        lines += [f"  where {left} = {value}" for left, value in self.places]
        if not self.places:
            lines[0] += f" where {self.normal} = 0"
        return "\n".join(lines)


def leaves(
    equations: Equations,
    start: Mapping[Any, ExprLike],
    *,
    contacts: Iterable[str] = (),
) -> tuple[Opening, ...]:
    """Where contacts open along the energy of a start.

    Args:
        equations: of a system that conserves its energy.
        start: values of coordinates and speeds, as expressions of parameters; others are zero.
            Speeds and coordinates that stay as they are do so throughout.
        contacts: their names; by default all.

    Raises:
        DeclarationError: for a motion in more than one coordinate, a system that does not conserve
            its energy, or one without a contact.
    """
    equations_only(equations, "openings of contacts")
    wanted = tuple(contacts)
    found = [c for c in equations.system.contacts if not wanted or c.name in wanted]
    if not found:
        raise DeclarationError(
            f"openings of contacts of {equations.system.name!r}",
            expected="a system with a contact",
        )
    level = _Level.of(equations, {_symbol(q): Expr.of(value) for q, value in start.items()})
    return tuple(level.opening(contact) for contact in found)


def _symbol(given: Symbol | Expr) -> Symbol:
    if isinstance(given, Symbol):
        return given
    if given.symbol is None:
        raise DeclarationError(f"a start for {given}", expected="a coordinate or a speed")
    return given.symbol


@dataclass(frozen=True)
class _Level:
    """A level of the energy of a motion in one coordinate.

    Attributes:
        equations: of the system.
        coordinate: that changes.
        fixed: values of all other coordinates and speeds.
        speed: that changes.
        square: of that speed, as a function of the coordinate.
    """

    equations: Equations
    coordinate: Symbol
    fixed: dict[Symbol, Expr]
    speed: Symbol
    square: Expr

    @classmethod
    def of(cls, equations: Equations, start: Mapping[Symbol, Expr]) -> _Level:
        if equations.power:
            raise DeclarationError(
                f"a level of the energy of {equations.system.name!r}, which changes with the power "
                f"{equations.power}",
                expected="a system that conserves its energy",
            )
        states = (*equations.coordinates, *equations.speeds)
        unknown = [s.published for s in start if s not in states]
        if unknown:
            raise DeclarationError(
                f"a start for {', '.join(unknown)}",
                expected=f"values of {', '.join(s.published for s in states)}",
            )
        initial = {s: start.get(s, ZERO) for s in states}
        sign = broken_sign(equations, initial)
        if sign is not None:
            raise DeclarationError(
                f"a start at which {sign} = {sign.subs(initial)}",
                expected="a positive value, for which the equations were derived",
                advice="give the coordinates in it",
            )
        coordinate, speed = _moving(equations, initial)
        fixed = {s: v for s, v in initial.items() if s not in (speed, coordinate)}
        energy = equations.kinetics.on_speeds(equations.energy).subs(fixed)
        inertia = energy.diff(speed).diff(speed) / 2
        if not inertia:
            raise DeclarationError(
                f"a level of the energy of {equations.system.name!r}, which does not depend on "
                f"{speed.published} at this start",
                expected="a start from which the energy determines the motion",
                advice="simulate it, and look at the event 'lifts off'",
            )
        at_rest = energy.subs({speed: ZERO})
        begun = energy.subs({coordinate: initial[coordinate], speed: initial[speed]})
        return cls(equations, coordinate, fixed, speed, (begun - at_rest) / inertia)

    def along(self, expression: Expr) -> Expr:
        """An expression on this level, as a function of the coordinate.

        Raises:
            DeclarationError: for one that depends on the direction of the motion.
        """
        value = self.equations.on_shell(expression).subs(self.fixed)
        rest = value.subs({self.speed: ZERO})
        slope = value.diff(self.speed)
        curvature = slope.diff(self.speed) / 2
        if slope.subs({self.speed: ZERO}) or value - rest - curvature * self._speed**2:
            raise DeclarationError(
                f"{expression}, which depends on the direction of the motion",
                expected="a force that is the same there and back",
            )
        return rest + curvature * self.square

    @property
    def _speed(self) -> Expr:
        return Expr.generator(self.speed)

    def opening(self, contact: Contact) -> Opening:
        """Where a contact opens on this level."""
        components = self.equations.components
        normal = self.along(components[contact.component(contact.on.normal)])
        along = [components.get(contact.component(x)) for x in contact.on.tangents]
        rubbed = [part for part in (self.along(a) for a in along if a is not None) if part]
        friction = absolute(rubbed[0] / normal) if len(rubbed) == 1 else None
        q = Expr.generator(self.coordinate)
        stationary = tuple(_roots(normal.diff(self.coordinate), q))
        return Opening(contact.name, q, normal, friction, tuple(_roots(normal, q)), stationary)


def _moving(equations: Equations, initial: Mapping[Symbol, Expr]) -> tuple[Symbol, Symbol]:
    """The coordinate and the speed that alone change in a motion from a start.

    The others keep their values as long as their accelerations vanish, whatever it does.
    """
    speeds = equations.speeds
    accelerations = {s: equations.accelerations[s.derivative()] for s in speeds}
    for speed in speeds:
        steady = {s: v for s, v in initial.items() if s in speeds and s != speed}
        moved = _changing(equations, steady)
        held = steady | {q: initial[q] for q in equations.coordinates if q not in moved}
        if len(moved) == 1 and not any(accelerations[s].subs(held) for s in steady):
            return moved[0], speed
    raise DeclarationError(
        f"a motion of {equations.system.name!r} in more than one coordinate",
        expected="a start from which a single coordinate changes",
        advice="simulate it, and look at the event 'lifts off'",
    )


def _changing(equations: Equations, steady: Mapping[Symbol, Expr]) -> list[Symbol]:
    """Coordinates of the forces that change where these speeds are as given.

    Angles such as that of a spin may change besides, if nothing depends on them.
    """
    used = set[Symbol]().union(
        equations.energy.symbols(), *(e.symbols() for e in equations.components.values())
    )
    rates = {q: equations.kinematics[q.derivative()].subs(steady) for q in equations.coordinates}
    return [q for q, rate in rates.items() if rate and q in used]


def _roots(normal: Expr, q: Expr) -> Iterator[tuple[Expr, Expr]]:
    """The factors of a normal force that are linear in cos q, in sin q, or in q, solved."""
    (symbol,) = q.symbols()
    for factor in factors(normal.numerator)[1]:
        if symbol not in factor.symbols():
            continue
        for function in (cos(q), sin(q), q):
            letter = Symbol("value of the function", symbol.kind)
            replaced = factor.recast({function.generators[0]: Expr.generator(letter)})
            slope = replaced.diff(letter)
            if symbol in replaced.symbols() or letter in slope.symbols() or not slope:
                continue
            yield function, -replaced.subs({letter: ZERO}) / slope
            break
