"""Reactions: solved from the balances of the bodies, component by component.

Each body has six balances, and each restraint one unknown. As many balances as there are
independent speeds are left over: the equations of motion. Components that Newton's laws leave
undetermined (a body on redundant supports) remain as symbols.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from polhode.algebra import (
    ONE,
    ZERO,
    Elimination,
    Expr,
    OutgrownError,
    Row,
    Symbol,
    SymbolKind,
    Triad,
    Vector,
    dependent_columns,
    dot,
    has_parts,
    linear_parts,
    total,
)
from polhode.base import ConstraintError
from polhode.derive._balance import ReactionColumn, Wrench
from polhode.derive._form import IN_PARTS, Form
from polhode.derive._motion import Kinematics
from polhode.model import Body, Frame


@dataclass(frozen=True)
class Reactions:
    """All reaction components of a system.

    Attributes:
        values: each component in terms of coordinates, speeds and accelerations; components that
            are not determined appear in the others as symbols with their names.
        undetermined: components that Newton's laws leave open, or that depend on such components.
        unexplained: remainders of balances that no component can supply.
        general: all components in terms of those that are open, where any is.
    """

    values: dict[str, Expr]
    undetermined: tuple[str, ...]
    unexplained: tuple[Expr, ...]
    general: _General | None = field(default=None, repr=False)

    @cached_property
    def least(self) -> dict[str, Expr]:
        """The values with the smallest sum of squares of all forces.

        If couples are still undetermined then, with the smallest sum of squares of all couples.
        """
        return self.values if self.general is None else self.general.least()

    @property
    def singular(self) -> int:
        """How many components have a denominator that may vanish somewhere."""
        return sum(value.denominator.varies for value in self.values.values())


def solve_reactions(
    motion: Kinematics, required: Mapping[Body, Wrench], columns: tuple[ReactionColumn, ...]
) -> Reactions:
    """Every reaction component, from the balances of all bodies, the last declared first.

    A body that hangs from others is usually declared after them, and the reactions that carry it
    follow from its own balance: starting at the end of a chain keeps expressions short.
    """
    balances, spare = list(_balances(motion, required, columns)), len(motion.speeds)
    shared = _equal_stiffness(motion, balances, columns) if motion.system.sharing else []
    works = any(column.does_work for column in columns)
    if works:
        # With friction, and with loads that depend on reactions, the equations of motion contain
        # the normal force, which must therefore be solved from other balances.
        spare = 0

    def chosen(more: Sequence[_Balance]) -> list[_Balance]:
        if works:
            return _along_reactions(motion, balances, columns, more)
        return [*balances, *more]

    def solved(those: list[_Balance]) -> Reactions:
        try:
            return _solved(motion, motion.form, those, columns, spare, shared)
        except OutgrownError:
            return _solved(motion, IN_PARTS, those, columns, spare, shared)

    try:
        found = solved(chosen(()))
    except ConstraintError:
        if not (held := _held_places(motion)):
            raise
        return solved([balance.at(held) for balance in chosen(())])
    if not found.singular or any(map(has_parts, found.values.values())):
        return found
    # A balance along an axis in which a reaction turns determines nothing where that reaction is
    # perpendicular to it. Along the reaction itself there is no such place.
    more = [b for b in _balances(motion, required, columns, along_all=True) if b not in balances]
    try:
        again = _solved(motion, motion.form, chosen(more), columns, spare, shared)
    except (OutgrownError, ConstraintError):  # left over: balances that hold on closed loops only
        return found
    return again if again.singular < found.singular else found


@dataclass(frozen=True)
class SupportRank:
    """What the rank of the balances tells of the reactions without solving for them.

    Attributes:
        is_supported: the reactions can supply whatever the bodies need; if not, only
            `solve_reactions` tells whether something is missing.
        is_determined: no reaction is left open; if not, only `solve_reactions` tells which.
    """

    is_supported: bool = False
    is_determined: bool = False


def support_rank(motion: Kinematics, columns: tuple[ReactionColumn, ...]) -> SupportRank:
    """The rank of the balances, where no reaction does work."""
    if any(column.does_work for column in columns):
        return SupportRank()
    none = Vector.along(motion.system.root, (0, 0, 0))
    required = dict.fromkeys(motion.system.bodies, Wrench(none, none))
    rows = [balance.row for balance in _balances(motion, required, columns)]
    dependent = len(dependent_columns(rows))
    rank = len(columns) - dependent
    return SupportRank(rank + len(motion.speeds) == len(rows), not dependent)


@dataclass(frozen=True)
class _Balance:
    """One component of the balance of forces or couples on a body.

    Attributes:
        body: that body.
        row: the component of every reaction column.
        required: the component of the required wrench.
        moved: the conjugate velocity: of the centre of mass, or angular.
        triad: the component is along one of its axes.
        axis: index of that axis.
        is_couple: whether couples are balanced, or forces.
    """

    body: Body
    row: Row
    required: Expr
    moved: Vector
    triad: Triad
    axis: int
    is_couple: bool

    def at(self, places: Mapping[Symbol, Expr]) -> _Balance:
        """The same with some coordinates at their places."""
        row = tuple(entry.subs(places) for entry in self.row)
        return replace(self, row=row, required=self.required.subs(places))


def _balances(
    motion: Kinematics,
    required: Mapping[Body, Wrench],
    columns: tuple[ReactionColumn, ...],
    along_all: bool = False,
) -> Iterator[_Balance]:
    """Forces along the axes in which the first reaction is written, couples along the body's.

    Args:
        along_all: both along all axes in which reactions on the body are written.
    """
    for body in tuple(required)[::-1]:
        velocity, angular = motion.velocities[body]
        unit = [column.with_loads.get(body) for column in columns]
        written = [w.force.triad for w in unit if w and w.force.components]
        written += [c.restraint.direction.triad for c, w in zip(columns, unit, strict=True) if w]
        triads = dict.fromkeys([*written, body.axes])
        first = next(iter(triads))
        for triad in triads if along_all else (first,):
            forces = required[body].force.express(triad).components
            for i in range(3):
                row = tuple(_component(w.force, triad, i) if w else ZERO for w in unit)
                yield _Balance(body, row, forces[i], velocity, triad, i, False)
        for triad in triads if along_all else (body.axes,):
            couples = required[body].couple.express(triad).components
            for i in range(3):
                row = tuple(_component(w.couple, triad, i) if w else ZERO for w in unit)
                yield _Balance(body, row, couples[i], angular, triad, i, True)


def _equal_stiffness(
    motion: Kinematics, balances: list[_Balance], columns: tuple[ReactionColumn, ...]
) -> list[Row]:
    """Combinations of reactions that vanish where contacts share a load as springs do.

    With the virtual displacement δ of the bodies and one stiffness k of all contacts, pressed in
    by J δ, the normal forces are N = k J δ. However large k is, they are perpendicular to all
    normal forces that the bodies do not feel, Jᵀ N = 0.
    """
    pushes = {element.push for element in motion.elements} - {None}
    places = [j for j, column in enumerate(columns) if column.name in pushes]
    ideal = [columns[j].without_friction.with_loads for j in places]
    rows = [tuple(_supplied(c.get(b.body), b) for c in ideal) for b in balances]
    outcome = motion.form.eliminate(rows, [ZERO] * len(rows), [0] * len(ideal), ())
    unfelt = _in_terms_of_free(outcome)
    found = []
    for k in range(len(outcome.free)):
        row = [ZERO] * len(columns)
        for place, j in enumerate(places):
            row[j] = unfelt[place][0][k]
        found.append(tuple(row))
    return found


def _held_places(motion: Kinematics) -> dict[Symbol, Expr]:
    """Coordinates that a closure keeps at one place, as a guide keeps a bar at its height.

    Anywhere else the reactions might have a couple about the bar that nothing supplies.
    """
    held: dict[Symbol, Expr] = {}
    for element in motion.elements:
        for closure in element.closures(motion.places):
            moving = [s for s in closure.symbols() if s.kind.varies]
            if len(moving) == 1 and (slope := closure.diff(moving[0])) in (ONE, -ONE):
                held[moving[0]] = Expr.generator(moving[0]) - closure * slope
    return held


def _along_reactions(
    motion: Kinematics,
    balances: list[_Balance],
    columns: tuple[ReactionColumn, ...],
    more: Sequence[_Balance],
) -> list[_Balance]:
    """As many balances as reactions of ideal constraints can supply independently.

    More balances of the same bodies, along other axes, may take the place of some.

    Without friction and loads, elimination selects them with constant pivots where there are any,
    as in the balances of forces at a pivot. The others then determine the motion of the speeds at
    every position: the reactions at one without motion, and the velocities of one that nothing
    resists, span complementary spaces.
    """
    # a particle on axes that turn has balances of couples that say 0 = 0
    balances = [b for b in balances if b.required or any(b.row)]
    ideal = [column.without_friction.with_loads for column in columns]
    every = [*balances, *more]
    supplied = [tuple(_supplied(wrenches.get(b.body), b) for b in every) for wrenches in ideal]
    kept = _selected(motion, supplied, len(every))
    if len(kept) + len(motion.speeds) == len(balances):
        if motion.form is IN_PARTS:
            return [_along(weights, every) for weights in supplied]
        return [b for i, b in enumerate(every) if i in kept]
    # Something is not supported. The balances along which the bodies can move are left out.
    rates = [_component(b.moved, b.triad, b.axis) for b in balances]
    partial = [tuple(rate.diff(speed) for rate in rates) for speed in motion.speeds]
    movable = _selected(motion, partial, len(balances))
    return [b for i, b in enumerate(balances) if i not in movable]


def _along(weights: Row, balances: list[_Balance]) -> _Balance:
    """The balance of all bodies along one reaction, which supplies these parts of their balances.

    A selection of balances determines no reaction that is perpendicular to them, as the tension of
    a rope is to an axis at some positions; these balances do everywhere, as long as the reactions
    are independent.
    """
    pairs = [(w, b) for w, b in zip(weights, balances, strict=True) if w]
    width = range(len(balances[0].row))
    row = tuple(total(w * b.row[j] for w, b in pairs if b.row[j]) for j in width)
    required = total(w * b.required for w, b in pairs)
    return replace(pairs[0][1] if pairs else balances[0], row=row, required=required)


def _selected(motion: Kinematics, rows: Sequence[Row], width: int) -> Collection[int]:
    """The columns of a matrix that elimination selects as its basis."""
    zeros, equal = [ZERO] * len(rows), [0] * width
    return motion.form.eliminate(rows, zeros, equal, motion.accelerations).solved


def _supplied(wrench: Wrench | None, balance: _Balance) -> Expr:
    """What a wrench contributes to a balance."""
    if wrench is None:
        return ZERO
    is_couple = balance.is_couple
    return _component(wrench.couple if is_couple else wrench.force, balance.triad, balance.axis)


def _component(vector: Vector, triad: Triad, axis: int) -> Expr:
    return vector.express(triad).components[axis] if any(vector.components) else ZERO


def _solved(
    motion: Kinematics,
    form: Form,
    balances: list[_Balance],
    columns: tuple[ReactionColumn, ...],
    spare: int,
    shared: Sequence[Row],
) -> Reactions:
    """Solve balances of which at most `spare` may be left over as equations of motion.

    Args:
        shared: combinations of reactions that vanish by a law of sharing.
    """

    solve = _Solver(form, motion.accelerations)
    rows, right = [b.row for b in balances], [b.required for b in balances]
    outcome = solve([*rows, *shared], [*right, *(ZERO for _ in shared)])
    leftover = tuple(outcome.leftover[i] for i in outcome.contradictory)
    if len(leftover) > spare and not (spare and _agree(leftover, motion, form)):
        if proportional := [column.name for column in columns if column.loads]:
            raise _jammed(proportional)
        raise _missing_support(motion, [balances[i].body for i in outcome.contradictory])
    names = [column.name for column in columns]
    if not outcome.free:
        values = {names[j]: constant for j, (_, constant) in outcome.solved.items()}
        ordered = {name: values[name] for name in names}
        return Reactions(ordered, (), leftover)
    general = _General(columns, _in_terms_of_free(outcome), solve)
    symbols = tuple(Expr.generator(Symbol(names[j])) for j in outcome.free)
    undetermined = tuple(name for j, name in enumerate(names) if any(general.values[j][0]))
    return Reactions(general.at(symbols), undetermined, leftover, general)


@dataclass(frozen=True)
class _Solver:
    """Solves linear equations for reactions.

    Attributes:
        form: of the solutions.
        accelerations: those of the motion, which the equations may contain.
    """

    form: Form
    accelerations: tuple[Symbol, ...]

    def __call__(self, table: Sequence[Row], values: Sequence[Expr]) -> Elimination:
        ranks = [0] * (len(table[0]) if table else 0)
        return self.form.eliminate(table, values, ranks, self.accelerations)


def _agree(leftover: Sequence[Expr], motion: Kinematics, form: Form) -> bool:
    """Whether balances that are left over have a solution as equations for the accelerations.

    Of balances along many axes, more are left over than there are equations of motion.
    """
    parts = [linear_parts(entry, motion.accelerations) for entry in leftover]
    rows, right = [row for row, _ in parts], [-rest for _, rest in parts]
    ranks = [0] * len(motion.accelerations)
    return not form.eliminate(rows, right, ranks, motion.accelerations).contradictory


def _jammed(names: list[str]) -> ConstraintError:
    """The error where the loads that go with reactions cancel what the reactions have to supply."""
    return ConstraintError(
        f"loads in proportion to {', '.join(names)}, with which no finite reactions balance the "
        "bodies",
        expected="loads that leave the reactions determined",
        advice="look for a brake that locks by its own friction, or a load that cancels the "
        "reaction; support what nothing else holds",
    )


def _shared_angle(bodies: Iterable[Body]) -> tuple[Symbol, list[str]] | None:
    """A coordinate by which several frames are turned independently, and the bodies along these."""
    turned = dict[Symbol, dict[Frame, list[str]]]()
    for body in bodies:
        for frame in body.axes.lineage:
            for q in (s for s in frame.angle.symbols() if s.kind is SymbolKind.COORDINATE):
                turned.setdefault(q, {}).setdefault(frame, []).append(body.name)
    for q, frames in turned.items():
        if len(frames) > 1:
            return q, list(dict.fromkeys(name for names in frames.values() for name in names))
    return None


def _missing_support(motion: Kinematics, unbalanced: list[Body]) -> ConstraintError:
    """The error where more balances are left over than there are equations of motion."""
    held = {r.body for group in motion.restraints.values() for r in group if r.is_couple}
    suspects = [body.name for body in unbalanced if body not in held]
    shared = None if suspects else _shared_angle(motion.system.bodies)
    if shared is not None:
        angle, names = shared[0].published, ", ".join(shared[1])
        return ConstraintError(
            f"nothing supplies the couple that turns {names} by the same angle {angle}",
            expected="an angle of its own for every body that turns by itself",
            advice="let each turn by its own angle, and couple these with a Gear or a Constraint",
        )
    names = ", ".join(dict.fromkeys(suspects or [body.name for body in motion.system.bodies]))
    return ConstraintError(
        f"nothing supplies the couple that keeps the axes of {names} as they are declared",
        expected="a Hinge, Guide, Universal or Motor for every rotation that is ruled out",
        advice="add one, or let the axes turn with one more coordinate",
    )


#: A linear expression: coefficients, and the constant term.
Linear = tuple[Row, Expr]


@dataclass(frozen=True)
class _General:
    """The reactions in terms of those that are open.

    Attributes:
        columns: the reactions.
        values: of each, by its place.
        solve: for further equations.
    """

    columns: tuple[ReactionColumn, ...]
    values: Mapping[int, Linear]
    solve: _Solver

    def at(self, free: Row) -> dict[str, Expr]:
        """All reactions by name, with given values for the open ones."""
        return {c.name: _value(self.values[j], free) for j, c in enumerate(self.columns)}

    def least(self) -> dict[str, Expr]:
        """Those with the least squares."""
        try:
            return self.at(_least_squares(self.values, self.columns, self.solve))
        except OutgrownError:
            in_parts = replace(self.solve, form=IN_PARTS)
            return self.at(_least_squares(self.values, self.columns, in_parts))


def _value(linear: Linear, values: Row) -> Expr:
    coefficients, constant = linear
    return dot(coefficients, values) + constant


def _in_terms_of_free(outcome: Elimination) -> dict[int, Linear]:
    """Every unknown in terms of those that stay free, these included."""
    size = len(outcome.free)
    return outcome.solved | {j: (_unit(k, size), ZERO) for k, j in enumerate(outcome.free)}


def _unit(place: int, size: int) -> Row:
    return tuple(ONE if i == place else ZERO for i in range(size))


def _least_squares(
    general: Mapping[int, Linear], columns: tuple[ReactionColumn, ...], solve: _Solver
) -> Row:
    """Undetermined components that minimise the sum of squares of all forces, then of all couples.

    A force and a couple differ in dimension: a sum of squares of both would depend on the unit of
    length. The couples are minimised over the components that the forces leave free.
    """
    size = len(general[0][0])
    chosen: list[Linear] = [(_unit(k, size), ZERO) for k in range(size)]
    for couples in (False, True):
        group = [general[j] for j, c in enumerate(columns) if c.restraint.is_couple is couples]
        unknowns = range(len(chosen[0][0]))
        if group and unknowns:
            # normal equations Σ r rᵀ x = -Σ r c of the components r · x + c in this group
            terms = [_composed(one, chosen) for one in group]
            normal = [
                tuple(sum((row[i] * row[j] for row, _ in terms), ZERO) for j in unknowns)
                for i in unknowns
            ]
            right = [-sum((row[i] * constant for row, constant in terms), ZERO) for i in unknowns]
            best = _in_terms_of_free(solve(normal, right))
            chosen = [_composed(one, [best[j] for j in unknowns]) for one in chosen]
    return tuple(constant for _, constant in chosen)


def _composed(linear: Linear, inner: Sequence[Linear]) -> Linear:
    """A linear expression of linear expressions."""
    coefficients, constant = linear
    columns = zip(*(row for row, _ in inner), strict=True)
    return (
        tuple(dot(coefficients, column) for column in columns),
        dot(coefficients, [c for _, c in inner]) + constant,
    )
