"""Quantities named by phrases: "axis 3", "angular momentum about pivot", "kinetic energy"."""

from __future__ import annotations

import re
from collections.abc import Callable
from difflib import get_close_matches
from functools import lru_cache

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    Vector,
    as_symbol,
    lengths_written_out,
    linear_parts,
    read_expression,
    solve,
    sqrt,
    time,
)
from polhode.base import DeclarationError, ParseError
from polhode.judge.meaning import _derived_quantities as derived
from polhode.judge.meaning import _small_oscillations as oscillations
from polhode.judge.meaning._initial_values import INITIAL, at_the_start
from polhode.judge.meaning._meaning import IMAGINARY, BindingError, Meaning
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.meaning._small_oscillations import ORDINALS


@lru_cache(maxsize=4096)
def quantity(mechanics: Mechanics, phrase: str) -> Meaning:
    """The quantity of a model named by a phrase; docs/claims-format.md lists all phrases.

    Raises `BindingError` for any other phrase, and for quantities that the system does not have.
    """
    words = " ".join(phrase.split())
    for pattern, method in _PHRASES:
        match = pattern.fullmatch(words)
        if match is None:
            continue
        try:
            return method(mechanics, **match.groupdict(default=""))
        except DeclarationError as error:
            raise BindingError(
                f"{words!r}: {error.given}", expected=error.expected, advice=error.advice
            ) from None
    return _by_expression(mechanics, words)


def _by_expression(mechanics: Mechanics, words: str) -> Meaning:
    """An expression of published names."""
    try:
        return read_expression(words, mechanics.scalars)
    except ParseError as error:
        near = get_close_matches(words, _EXAMPLES, n=2, cutoff=0.5) or _EXAMPLES[:3]
        raise BindingError(
            f"{words!r}, which names no quantity of {mechanics.equations.system.name}",
            expected=f"something like {', '.join(map(repr, near))}, or an expression",
            advice=f"as an expression: {error}",
        ) from None


def _components(mechanics: Mechanics, entries: str, along: str) -> Vector:
    parts = [read_expression(entry, mechanics.scalars) for entry in entries.split(",")]
    if len(parts) != 3:
        raise DeclarationError(f"({entries})", expected="three components with commas between")
    return Vector.along(mechanics.frame(along), parts)


def _least(mechanics: Mechanics, name: str) -> Expr:
    least = mechanics.equations.least
    if name not in least:
        raise DeclarationError(f"reaction {name!r}", expected=f"one of {', '.join(least)}")
    return least[name]


def _component(mechanics: Mechanics, vector: str, label: str, of: str) -> Expr:
    """Of a vector along an axis."""
    return _along(mechanics, vector, mechanics.axis(label, of))


def _along(mechanics: Mechanics, vector: str, axis: Vector) -> Expr:
    whole = quantity(mechanics, vector)
    if not isinstance(whole, Vector):
        raise DeclarationError(f"{vector!r} along an axis", expected="a vector")
    return whole.dot(axis)


def _published(mechanics: Mechanics, name: str) -> Expr:
    """The symbol that the declaration has under a name."""
    if name not in mechanics.scalars:
        raise DeclarationError(f"the symbol {name!r}", expected="one of the declaration")
    return mechanics.scalars[name]


def _initial(mechanics: Mechanics, of: str) -> Expr:
    """The value of a function of coordinates and rates at the start of the motion."""
    whole = quantity(mechanics, of)
    found = at_the_start(mechanics, whole) if isinstance(whole, Expr) else None
    if found is None:
        raise DeclarationError(
            f"{INITIAL}{of}", expected="a scalar that changes with coordinates and their rates"
        )
    return found


def _length(mechanics: Mechanics, letter: str) -> Expr:
    """A distance or slip speed under the letter that the derived equations print for it."""
    lengths = mechanics.equations.lengths
    if letter not in lengths:
        raise DeclarationError(f"the length {letter!r}", expected=f"one of {', '.join(lengths)}")
    return lengths_written_out(lengths[letter].meaning)


def _magnitude(mechanics: Mechanics, vector: str) -> Expr:
    """The length of a vector."""
    whole = mechanics.in_speeds(quantity(mechanics, vector))
    if not isinstance(whole, Vector):
        raise DeclarationError(f"the magnitude of {vector!r}", expected="a vector")
    return derived.magnitude(whole)


def _directed(mechanics: Mechanics, vector: str, direction: str) -> Expr:
    """A component along a direction that the motion itself has."""
    whole = mechanics.in_speeds(quantity(mechanics, vector))
    if not isinstance(whole, Vector):
        raise DeclarationError(f"{vector!r} along a direction", expected="a vector")
    return derived.component(mechanics, whole, direction, vector.partition(" of ")[2])


def _kinetic_energy(mechanics: Mechanics, of: str) -> Expr:
    """Of all bodies, or of one, J."""
    if not of:
        return mechanics.kinetic_energy()
    return derived.kinetic_energy_of(mechanics, mechanics.equations.system.body(of))


def _radius_of_curvature(mechanics: Mechanics) -> Vector:
    """From the centre of curvature of a curved path to the point, m.

    With v and a × the velocity and acceleration, it is v × (v × a) v²/|v × a|².
    """
    velocity = mechanics.position().dt()
    across = velocity.cross(velocity.dt())
    outwards = velocity.cross(across)
    return outwards * (velocity.dot(velocity) / across.dot(across))


def _uniform_velocity(mechanics: Mechanics) -> Vector:
    """The only velocity at which all accelerations vanish, m/s."""
    equations, velocity = mechanics.equations, mechanics.velocity()
    unknowns = tuple(
        speed
        for speed in equations.speeds
        if any(speed in a.symbols() for a in equations.accelerations.values())
    )
    resolved = equations.kinetics.resolve(velocity)
    rows = [linear_parts(equations.accelerations[s.derivative()], unknowns) for s in unknowns]
    try:
        found = solve([row for row, _ in rows], [-rest for _, rest in rows])
    except ZeroDivisionError:
        raise DeclarationError(
            "the uniform velocity", expected="a system with exactly one constant velocity"
        ) from None
    return resolved.subs({Expr.generator(s): v for s, v in zip(unknowns, found, strict=True)})


def _fictitious(mechanics: Mechanics, kind: str, frame: str) -> Vector:
    from polhode.analyse import fictitious_torque  # loaded only for the few texts that need it

    equations, turning = mechanics.equations, mechanics.frame(frame)
    torques = fictitious_torque(equations, mechanics.body, turning)
    found: Vector = getattr(torques, kind.lower())
    return found


def _precession(mechanics: Mechanics, pace: str, coordinate: str) -> Expr:
    """The smaller or larger of two rates of steady motion, for quick spin, rad/s."""
    from polhode.analyse import steady  # loaded only for the few texts that need it

    rate = mechanics.scalars.get(f"{coordinate}_dot")
    if rate is None:
        raise DeclarationError(f"coordinate {coordinate!r}", expected="one of the system")
    symbol = as_symbol(rate)
    for family in steady(mechanics.equations):
        for relation in family.relations:
            if len(values := roots(relation, symbol)) > 1:
                return values[0 if pace == "slow" else 1]
    raise DeclarationError(
        f"slow and fast {symbol.published}", expected="a steady motion with two values of it"
    )


def roots(relation: Expr, symbol: Symbol) -> tuple[Expr, ...]:
    """The values of a symbol for which a x² + b x + c vanishes; none for another function of x.

    They are written as -b/(2a) (1 ∓ √(1 - 4ac/b²)). So the first vanishes with c, whatever the sign
    of b: it is the slow rate of a precession.
    """
    at_zero = {symbol: ZERO}
    slope = relation.diff(symbol)
    a, b, c = slope.diff(symbol) / 2, slope.subs(at_zero), relation.subs(at_zero)
    if symbol in a.symbols():
        return ()
    if not a:
        return (-c / b,)
    if not b:
        return (root := sqrt(-c / a)), -root
    root = sqrt(1 - 4 * a * c / b**2)
    return -b / (2 * a) * (1 - root), -b / (2 * a) * (1 + root)


_Method = Callable[..., Meaning]
_OF = r"(?: of (?P<of>.+?))?"
_ABOUT = r"(?: about (?P<about>.+))?"
_PHRASES: tuple[tuple[re.Pattern[str], _Method], ...] = tuple(
    (re.compile(pattern), method)
    for pattern, method in (
        (rf"{INITIAL}(?P<of>.+)", _initial),
        (r"magnitude of (?P<vector>.+)", _magnitude),
        (r"moment of inertia about (?P<about>\S+) along any axis", derived.moment_about_any_axis),
        (
            r"(?P<vector>.+) along the position",
            lambda m, vector: _along(m, vector, derived.outwards(m)),
        ),
        (r"radius of gyration about (?P<about>.+)", derived.radius_of_gyration),
        (r"direction of increasing (?P<coordinate>\w+)", derived.direction_of_increasing),
        (r"greatest (?P<of>.+)", lambda m, of: quantity(m, of)),
        (
            r"moment of inertia about (?P<about>.+) along its axis of rotation",
            derived.moment_of_inertia,
        ),
        (
            r"moment of inertia of (?P<of>.+) along its axis of rotation",
            derived.own_moment_of_inertia,
        ),
        (r"(?P<vector>.+) along (?P<direction>its axis of rotation|its path)", _directed),
        (
            r"(?P<vector>.+) in the direction of increasing (?P<coordinate>\w+)",
            lambda m, vector, coordinate: _along(
                m, vector, derived.direction_of_increasing(m, coordinate)
            ),
        ),
        (r"(?P<vector>.+) (?P<direction>down the slope)", _directed),
        (r"(?P<vector>.+) against its path", lambda m, vector: -_directed(m, vector, "its path")),
        (r"(?P<vector>.+) up the slope", lambda m, vector: -_directed(m, vector, "down")),
        (r"declared (?P<name>\w+)(?:, along axis .+)?", _published),
        (rf"(?P<vector>.+) along axis (?P<label>\S+){_OF}", _component),
        (r"declared (?P<name>\w+), opposite in sign", lambda m, name: -_published(m, name)),
        (rf"axis (?P<label>\S+){_OF}", Mechanics.axis),
        (r"fixed vector of (?P<of>.+)", Mechanics.fixed),
        (rf"position{_OF}", Mechanics.position),
        (r"arm of (?P<of>.+)", Mechanics.arm),
        (rf"velocity{_OF}", Mechanics.velocity),
        (rf"acceleration{_OF}", Mechanics.acceleration),
        (r"angular velocity of the support of (?P<of>.+)", derived.rotation_of_support),
        (rf"angular velocity{_OF}", Mechanics.angular_velocity),
        (rf"angular acceleration{_OF}", lambda m, of: m.angular_velocity(of).dt()),
        (rf"frequency of small oscillations{_ABOUT}", oscillations.frequency),
        (
            rf"(?P<which>{'|'.join(ORDINALS)}) frequency of small oscillations{_ABOUT}",
            oscillations.normal_frequency,
        ),
        (rf"number per second of small oscillations{_ABOUT}", oscillations.number_per_second),
        (rf"period of small oscillations{_ABOUT}", oscillations.period),
        (rf"inertia{_OF}{_ABOUT}", Mechanics.inertia),
        (r"inertia component (?P<row>\S+) (?P<column>\S+)", Mechanics.inertia_component),
        (r"moment of inertia (?P<axis>\S+)", Mechanics.moment_of_inertia),
        (rf"momentum{_OF}", Mechanics.momentum),
        (
            r"angular momentum(?: about (?P<about>.+?))?(?: relative to (?P<relative>.+))?",
            Mechanics.angular_momentum,
        ),
        (r"force of (?P<of>.+)", Mechanics.force),
        (r"power of (?P<of>.+)", Mechanics.power),
        (r"tension of (?P<of>.+)", derived.tension),
        (r"normal force of (?P<of>.+)", derived.normal_force),
        (r"friction of (?P<of>.+)", derived.friction),
        (r"tangential force of (?P<of>.+)", derived.tangential_force),
        (r"vertical force of (?P<of>.+)", derived.vertical_force),
        (r"friction coefficient of (?P<of>.+)", derived.friction_coefficient),
        (r"total force", Mechanics.total_force),
        (r"torque(?: about (?P<about>.+))?", Mechanics.torque),
        (r"gravity", Mechanics.gravity),
        (r"translational kinetic energy", Mechanics.translational_energy),
        (r"rotational kinetic energy", Mechanics.rotational_energy),
        (rf"kinetic energy{_OF}", _kinetic_energy),
        (r"effective potential energy", derived.effective_potential),
        (r"hamiltonian", derived.hamiltonian),
        (r"routhian", derived.routhian),
        (r"routhian, opposite in sign", lambda m: -derived.routhian(m)),
        (r"work of all loads", lambda m: -m.potential_energy()),
        (rf"potential energy{_OF}", Mechanics.potential_energy),
        (r"energy", Mechanics.energy),
        (r"lagrangian", Mechanics.lagrangian),
        (r"energy of acceleration|Gibbs(?:-Appell)? function", Mechanics.energy_of_acceleration),
        (r"generalised force of (?P<coordinate>\S+)", derived.generalised_force),
        (r"momentum conjugate to (?P<coordinate>\S+)", derived.conjugate_momentum),
        (r"\((?P<entries>.*,.*)\) along (?P<along>.+)", _components),
        (r"(?P<kind>Coriolis|centrifugal|Euler) torque in (?P<frame>.+)", _fictitious),
        (r"least (?P<name>\w+)", _least),
        (r"time", lambda _: time),
        (r"length (?P<letter>\w+) of the equations", _length),
        (r"imaginary unit", lambda _: Expr.generator(IMAGINARY)),
        (r"radius of curvature", _radius_of_curvature),
        (r"uniform velocity", _uniform_velocity),
        (r"(?P<pace>slow|fast) steady (?P<coordinate>\w+?)_dot", _precession),
    )
)

_EXAMPLES = (
    *("axis 3", "angular velocity", "angular momentum about cm", "kinetic energy"),
    *("angular velocity of axes", "velocity of cm", "force of contact", "torque about cm"),
    *("potential energy", "lagrangian", "momentum conjugate to phi", "position", "inertia"),
)
