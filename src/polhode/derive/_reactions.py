"""Reactions: solved from the balance of every body, component by component."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import (
    ONE,
    ZERO,
    Elimination,
    Expr,
    OutgrownError,
    Row,
    Symbol,
    Triad,
    Vector,
    dot,
)
from polhode.base import ConstraintError
from polhode.derive._balance import Wrench
from polhode.derive._form import IN_PARTS, Form
from polhode.derive._motion import Kinematics
from polhode.model import Body, Friction, Restraint

Solve = Callable[[Sequence[Row], Sequence[Expr]], Elimination]


@dataclass(frozen=True)
class ReactionColumn:
    """The force or couple that one unit of a reaction puts on a body (and its opposite)."""

    restraint: Restraint
    direction: Vector

    @property
    def name(self) -> str:
        """Name of the reaction component."""
        return self.restraint.name

    @property
    def leans(self) -> bool:
        """Whether friction goes with it."""
        return self.direction != self.restraint.direction

    def on(self, body: Body) -> Wrench | None:
        """What one unit does to a body."""
        if body == self.restraint.body:
            return _acting(body, self.direction, self.restraint.arm)
        if body == self.restraint.other:
            return _acting(body, -self.direction, self.restraint.other_arm)
        return None


def _acting(body: Body, direction: Vector, arm: Vector | None) -> Wrench:
    if arm is None:
        return Wrench(body.axes.zero, direction)
    return Wrench(direction, arm.cross(direction))


@dataclass(frozen=True)
class Reactions:
    """All reaction components of a system.

    Attributes:
        values: each component in terms of coordinates, speeds and accelerations; components that
            are not determined appear in the others as symbols of their own names.
        undetermined: components that Newton's laws leave open, or that depend on open ones.
        least: the values with the smallest sum of squares of all forces and, where these leave
            couples open, with the smallest sum of squares of all couples.
        unexplained: what the balances demand that no component can supply.
    """

    values: dict[str, Expr]
    undetermined: tuple[str, ...]
    least: dict[str, Expr]
    unexplained: tuple[Expr, ...]


def lines(motion: Kinematics) -> tuple[ReactionColumn, ...]:
    """Lines of action of all reactions; a normal force with friction leans against the slip."""
    found = []
    for element in motion.elements:
        leaning = {f.normal.name: f for f in element.friction(motion.places)}
        for restraint in motion.restraints[element.name]:
            direction = restraint.direction
            if restraint.name in leaning:
                direction = direction + friction_lean(motion, leaning[restraint.name])
            found.append(ReactionColumn(restraint, direction))
    return tuple(found)


def friction_lean(motion: Kinematics, friction: Friction) -> Vector:
    """Friction per unit of normal force: -μ along the slip velocity."""
    (_, first), (_, second) = friction.directions
    if friction.slip is not None:
        along, across = friction.slip
        return (first * along + second * across) * -friction.coefficient
    slip = motion.slip(friction.normal)
    along, across = slip.dot(first), slip.dot(second)
    speed = (first * along + second * across).norm()
    if not speed:
        raise ConstraintError(
            f"sliding friction at {friction.normal.name} of a contact that cannot slip",
            expected="a slip velocity that is not zero identically",
            advice="declare the contact Rolling",
        )
    return (first * along + second * across) * (-friction.coefficient / speed)


def solve_reactions(
    motion: Kinematics, demands: Mapping[Body, Wrench], columns: tuple[ReactionColumn, ...]
) -> Reactions:
    """Every reaction component, from the balance of all bodies, the last declared first.

    What hangs on others is mostly declared after them, and tells the reactions that carry it.
    """
    balances = list(_balances(motion, demands, columns))
    if any(line.leans for line in columns):
        return _from(_held(balances, motion), motion, columns, 0)
    return _from(balances, motion, columns, len(motion.speeds))


def _held(balances: list[_Balance], motion: Kinematics) -> list[_Balance]:
    """Without as many as there are independent speeds, for which the projections on these stand.

    With friction a projection would tell a reaction too, over the slip; and what is told by it,
    put into the same projection, would leave no equation of motion.
    """
    rates = [_part(b.moved, b.triad, b.place) for b in balances]
    reach = [tuple(rate.diff(speed) for rate in rates) for speed in motion.speeds]
    nothing = [ZERO] * len(reach)
    told = motion.form.eliminate(reach, nothing, [0] * len(balances), motion.accelerations).solved
    return [b for i, b in enumerate(balances) if i not in told]


@dataclass(frozen=True)
class _Balance:
    """One component of the balance of forces or couples on a body.

    Attributes:
        body: that body.
        row: what a unit of each reaction gives to it.
        demand: what the motion asks for.
        moved: what it does work on: the body's velocity, or its angular velocity.
        triad: along one of whose axes it is taken.
        place: of that axis.
    """

    body: Body
    row: Row
    demand: Expr
    moved: Vector
    triad: Triad
    place: int


def _balances(
    motion: Kinematics, demands: Mapping[Body, Wrench], columns: tuple[ReactionColumn, ...]
) -> Iterator[_Balance]:
    for body in tuple(demands)[::-1]:
        demand = demands[body]
        velocity, angular = motion.velocities[body]
        unit = [line.on(body) for line in columns]
        triad = next((w.force.triad for w in unit if w and w.force.components), body.axes)
        forces = demand.force.express(triad).components
        for i in range(3):
            row = tuple(_part(w.force, triad, i) if w else ZERO for w in unit)
            yield _Balance(body, row, forces[i], velocity, triad, i)
        for i in range(3):
            row = tuple(_part(w.couple, body.axes, i) if w else ZERO for w in unit)
            yield _Balance(body, row, demand.couple.components[i], angular, body.axes, i)


def _from(
    balances: list[_Balance], motion: Kinematics, columns: tuple[ReactionColumn, ...], spare: int
) -> Reactions:
    """From balances of which some, but no more, may be left over as equations of motion."""
    try:
        return _solved(motion, motion.form, balances, columns, spare)
    except OutgrownError:
        return _solved(motion, IN_PARTS, balances, columns, spare)


def _solved(
    motion: Kinematics,
    form: Form,
    balances: list[_Balance],
    columns: tuple[ReactionColumn, ...],
    spare: int,
) -> Reactions:
    def eliminated(table: Sequence[Row], values: Sequence[Expr]) -> Elimination:
        ranks = [0] * (len(table[0]) if table else len(columns))
        return form.eliminate(table, values, ranks, motion.accelerations)

    outcome = eliminated([b.row for b in balances], [b.demand for b in balances])
    if len(outcome.contradictory) > spare:
        raise _unheld(motion, [balances[i].body for i in outcome.contradictory])
    return _named(outcome, columns, eliminated)


def _part(vector: Vector, triad: Triad, index: int) -> Expr:
    return vector.express(triad).components[index] if any(vector.components) else ZERO


def _unheld(motion: Kinematics, demanding: list[Body]) -> ConstraintError:
    """Balances are left over that are no equations of motion: a support is missing."""
    held = {r.body for group in motion.restraints.values() for r in group if r.is_couple}
    suspects = [body.name for body in demanding if body not in held]
    names = ", ".join(dict.fromkeys(suspects or [body.name for body in motion.system.bodies]))
    return ConstraintError(
        f"nothing supplies the couple that keeps the axes of {names} as they are declared",
        expected="a Hinge, Guide, Universal or Motor for every rotation that is ruled out",
        advice="add it, or turn the axes by one more coordinate",
    )


def _named(
    outcome: Elimination, columns: tuple[ReactionColumn, ...], eliminated: Solve
) -> Reactions:
    names = [line.name for line in columns]
    left = tuple(outcome.leftover[i] for i in outcome.contradictory)
    if not outcome.free:
        values = {names[j]: constant for j, (_, constant) in outcome.solved.items()}
        ordered = {name: values[name] for name in names}
        return Reactions(ordered, (), ordered, left)
    told = _in_terms_of_open(outcome)
    open_ = tuple(Expr.generator(Symbol(names[j])) for j in outcome.free)
    least_open = _least(told, columns, eliminated)
    return Reactions(
        {name: _sum(told[j], open_) for j, name in enumerate(names)},
        tuple(name for j, name in enumerate(names) if any(told[j][0])),
        {name: _sum(told[j], least_open) for j, name in enumerate(names)},
        left,
    )


#: A linear expression: coefficients, and the rest.
Linear = tuple[Row, Expr]


def _sum(linear: Linear, values: Row) -> Expr:
    coefficients, rest = linear
    return dot(coefficients, values) + rest


def _in_terms_of_open(outcome: Elimination) -> dict[int, Linear]:
    """Every component in terms of those that stay open."""
    return outcome.solved | {j: (_unit(k, outcome.free), ZERO) for k, j in enumerate(outcome.free)}


def _unit(place: int, among: Sequence[int]) -> Row:
    return tuple(ONE if i == place else ZERO for i in range(len(among)))


def _least(
    told: Mapping[int, Linear], columns: tuple[ReactionColumn, ...], eliminated: Solve
) -> Row:
    """Open components that make the sum of squares of all forces smallest, then of all couples.

    A force and a couple are not of one dimension: a sum of squares of both would depend on the
    unit of length.
    """
    size = len(told[0][0])
    open_: list[Linear] = [(_unit(k, range(size)), ZERO) for k in range(size)]
    for couples in (False, True):
        group = [told[j] for j, line in enumerate(columns) if line.restraint.is_couple is couples]
        unknowns = len(open_[0][0])
        if group and unknowns:
            chosen = _smallest([_composed(one, open_) for one in group], unknowns, eliminated)
            open_ = [_composed(one, chosen) for one in open_]
    return tuple(rest for _, rest in open_)


def _composed(linear: Linear, inner: Sequence[Linear]) -> Linear:
    """A linear expression of linear expressions."""
    coefficients, rest = linear
    columns = zip(*(row for row, _ in inner), strict=True)
    return (
        tuple(dot(coefficients, column) for column in columns),
        dot(coefficients, [constant for _, constant in inner]) + rest,
    )


def _smallest(group: Sequence[Linear], unknowns: int, eliminated: Solve) -> list[Linear]:
    """The unknowns that make the sum of squares smallest, in terms of those it leaves free."""
    size = range(unknowns)
    normal = [tuple(sum((row[i] * row[j] for row, _ in group), ZERO) for j in size) for i in size]
    right = [-sum((row[i] * rest for row, rest in group), ZERO) for i in size]
    told = _in_terms_of_open(eliminated(normal, right))
    return [told[j] for j in size]
