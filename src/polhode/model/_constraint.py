"""Constraints that a user writes as equations in coordinates and speeds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import (
    ONE,
    Expr,
    ExprLike,
    Symbol,
    SymbolKind,
    as_symbol,
    coordinate,
    linear_parts,
    read_expression,
    sqrt,
    total,
    variables,
)
from polhode.base import DeclarationError, NumericError, ParseError
from polhode.model._body import Body, bodies_of
from polhode.model._conjugate import conjugate_shares, power_at_rest, spin_rates
from polhode.model._declared import is_rate, is_varying, quantity
from polhode.model._element import Element, Places, Restraint, Share


@dataclass(frozen=True, init=False)
class Constraint(Element):
    """An equation that the motion obeys.

    An equation in coordinates is holonomic; one in speeds or rates of coordinates must be linear
    in them. It acts by generalized forces: for the rate of an angle, a couple on the body that
    turns with the angle and the opposite couple on the body from which it is measured; for the
    rate of a position, a force on the body that moves and the opposite force on the body along
    which it moves. They do no work on any other motion of that body.

    Its gradient may not vanish where it holds, as that of 1 - cos(theta) = 0 does: its rate would
    restrain nothing.

    The reaction is the Lagrange multiplier of the equation, differentiated once if it is
    holonomic: of `x - R*theta = 0` the force along x. If no rate has a constant as its coefficient,
    the equation is first divided by the length of its gradient with respect to positions: of
    `x**2 + z**2 - L**2 = 0` it is the normal force.

    Args:
        equation: an expression that vanishes, or text such as "x - R*theta = 0".
        on: the bodies whose coordinates and speeds occur in it.
        where: meanings of further names in the text, such as parameters.
        force: name of the reaction.

    Raises:
        DeclarationError: for an equation without coordinates or speeds, or not linear in speeds;
            and, when the equations are derived, for one whose gradient vanishes where it holds.
        ParseError: for text that cannot be read.
    """

    equation: Expr
    on: tuple[Body, ...]
    name: str
    force: str

    def __init__(
        self,
        equation: ExprLike,
        *,
        on: Body | Iterable[Body] = (),
        where: Mapping[str, ExprLike] | None = None,
        name: str = "",
        force: str = "Q",
    ) -> None:
        called = name or "constraint"
        bodies = bodies_of(on, f"{called!r}")
        if isinstance(equation, str):
            meanings = {n: quantity(e, f"{n} in {called!r}") for n, e in (where or {}).items()}
            equation = _read(equation, {**_names(bodies), **meanings}, called)
        vanishing = quantity(equation, f"equation of {called!r}")
        if not any(s.kind in _MOVING for s in vanishing.symbols()):
            raise DeclarationError(
                f"{called!r}: {vanishing} = 0",
                expected="an equation in coordinates or speeds",
                advice="write it as an expression that vanishes, such as x - R*theta",
            )
        self._set(equation=vanishing, on=bodies, name=called, force=force)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.on

    @property
    def is_holonomic(self) -> bool:
        """Whether it restrains the configuration, without speeds."""
        return not any(map(is_rate, self.equation.symbols()))

    @property
    def gradient(self) -> tuple[Expr, ...]:
        """Its slopes by coordinates; of an equation in speeds, by these and by rates."""
        occurring = sorted(self.equation.symbols(), key=lambda s: s.published)
        wanted = is_rate if not self.is_holonomic else _is_coordinate
        return tuple(self.equation.diff(s) for s in occurring if wanted(s))

    def closures(self, places: Places) -> tuple[Expr, ...]:
        return (self.equation,) if self.is_holonomic else ()

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        rate = self.equation.dt() if self.is_holonomic else self.equation
        rate = rate.subs(spin_rates(places))
        speeds = sorted(filter(is_rate, rate.symbols()), key=lambda s: s.published)
        try:
            coefficients, rest = linear_parts(rate, speeds)
        except NumericError as error:
            raise DeclarationError(
                f"{self.name!r}: {self.equation} = 0",
                expected="an equation in coordinates, or one that is linear in speeds",
            ) from error
        unit = [tuple(conjugate_shares(speed, ONE, places, self.name)) for speed in speeds]
        # The first share names the reaction: that of a rate with a constant as its coefficient, so
        # that the multiplier is a force or a couple. Otherwise all are divided by the length of the
        # gradient; coefficients of positions and of angles have different dimensions.
        plain = [i for i, c in enumerate(coefficients) if not any(map(is_varying, c.symbols()))]
        pushing = [i for i, shares in enumerate(unit) if shares[0].arm is not None]
        if plain:
            chosen, scale = min(plain, key=lambda i: bool(coefficients[i].symbols())), ONE
        else:
            alike = pushing or range(len(unit))
            chosen, scale = alike[0], _length(coefficients[i] for i in alike)
        order = sorted(range(len(speeds)), key=lambda i: i != chosen)
        shares = [
            Share(share.body, share.direction * (coefficients[i] / scale), share.arm)
            for i in order
            for share in unit[i]
        ]
        length = shares[0].direction.norm()
        if not any(map(is_varying, length.symbols())):
            scale = scale * length
            shares = [Share(s.body, s.direction / length, s.arm) for s in shares]
        main, more = shares[0], tuple(shares[1:])
        # The velocity is prescribed by its component along the first share, Σ rates = -rest; to
        # the rates the velocities of the shares add what moves with time alone.
        along = power_at_rest(shares, places) - rest / scale
        velocity = main.direction * (along / main.direction.dot(main.direction))
        return (Restraint(self.force, main.body, main.direction, velocity, main.arm, more=more),)


def _is_coordinate(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.COORDINATE and not symbol.order


def _length(coefficients: Iterable[Expr]) -> Expr:
    """The length of a gradient."""
    return sqrt(total(c * c for c in coefficients))


# -- equations as text -----------------------------------------------------------------------------

_MOVING = (SymbolKind.COORDINATE, SymbolKind.SPEED)


def _read(text: str, known: Mapping[str, Expr], name: str) -> Expr:
    if text.count("=") > 1 or any(sign in text for sign in "<>≤≥"):
        raise DeclarationError(
            f"{name!r}: {text}",
            expected="one equation, with at most one equals sign",
            advice="declare a Constraint for each equation; a contact that may open is a Smooth or "
            "Coulomb contact",
        )
    left, equals, right = text.partition("=")
    try:
        found = read_expression(left, known)
        return found - read_expression(right, known) if equals else found
    except ParseError as error:
        unknown = "give the meaning of further names: where={'R': R}"
        raise ParseError(
            f"{name!r}: {error.given}",
            expected=error.expected,
            advice=error.advice or (unknown if "is not known" in error.given else ""),
        ) from error


def _names(bodies: Sequence[Body]) -> dict[str, Expr]:
    """Coordinates, speeds and parameters of bodies by their published names."""
    found: list[Expr] = []
    for body in bodies:
        inertia = body.inertia.entries
        given = (body.mass, *inertia, *(frame.angle for frame in body.axes.lineage), *body.speeds)
        found += map(Expr.generator, variables(given))
        # s is the distance along a Slider's guide
        found += (*body.rates, *(coordinate(q + body.tag) for q in "xyzs"))
    coordinates = [e for e in found if as_symbol(e).kind is SymbolKind.COORDINATE]
    every = (*found, *(q.dt() for q in coordinates))
    velocities = {f"v_{q}{b.tag}": coordinate(q + b.tag).dt() for b in bodies for q in "xyz"}
    return velocities | {as_symbol(e).published: e for e in every}
