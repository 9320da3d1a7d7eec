"""Constraints as forces: Newton's and Euler's equations of every body, with reactions.

A restraint prescribes one component of relative velocity; a rolling contact has three, such as the
problem set's eqs. (29) and (43). `derive._constraints` eliminates speeds with it. Here the same
restraint supplies an unknown reaction along the same direction: a `ReactionColumn`, as F in
eqs. (34), (35) and (44). The balance of every body is

    Σ reaction · column = required wrench,

with the wrench m dv/dt - F and dL/dt - τ about the centre of mass. `derive._derive` projects these
balances on the motions that the constraints allow, which gives the equations of motion;
`derive._reactions` solves them for the reactions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from polhode.algebra import (
    Expr,
    LengthLetter,
    OutgrownError,
    Vector,
    kept_length,
    kept_sum,
    length,
    named,
    principal_root,
    total,
)
from polhode.base import ConstraintError
from polhode.derive._form import IN_PARTS
from polhode.derive._motion import Kinematics
from polhode.model import Action, Body, Friction, Restraint, Share

#: Terms of two forces times those of the denominators of the other.
_MOST_PRODUCTS = 30_000
#: Of the components of a slip velocity, in the square of its length.
_LONGEST_SLIP = 3_000


@dataclass(frozen=True)
class Wrench:
    """A force (N) through the centre of mass and a couple (N m), along the body's axes."""

    force: Vector
    couple: Vector

    def __add__(self, other: Wrench) -> Wrench:
        return Wrench(self.force + other.force, self.couple + other.couple)


@dataclass(frozen=True)
class ReactionColumn:
    """The wrench that one unit of a reaction component exerts on a body (and its opposite).

    Attributes:
        restraint: whose reaction it is.
        direction: of the reaction; for a normal force with sliding friction, that of both.
        friction: components of friction per unit of the reaction, by their names.
        couples: those of them that are couples, with the bodies on which they act.
        loads: the forces and couples of loads per unit of the reaction.
    """

    restraint: Restraint
    direction: Vector
    friction: Mapping[str, Expr] = field(default_factory=dict)
    couples: tuple[Share, ...] = ()
    loads: tuple[Action, ...] = ()

    @property
    def name(self) -> str:
        """Name of the reaction component."""
        return self.restraint.name

    @property
    def without_friction(self) -> ReactionColumn:
        """The same reaction without the friction and the loads that go with it."""
        return ReactionColumn(self.restraint, self.restraint.direction)

    @property
    def does_work(self) -> bool:
        """Whether forces that may do work go with the reaction: friction, or loads."""
        return bool(self.friction or self.loads)

    @property
    def shares(self) -> tuple[Share, ...]:
        """All bodies on which one unit acts, and where."""
        return self.restraint.shares(self.direction) + self.couples

    def on(self, body: Body) -> Wrench | None:
        """The wrench of one unit on a body; None for a body it does not act on."""
        return self._wrenches.get(body)

    @cached_property
    def with_loads(self) -> dict[Body, Wrench]:
        """The wrenches of one unit, those of the loads that are proportional to it included."""
        found = dict(self._wrenches)
        for action in self.loads:
            before = found.get(action.body)
            moment = action.couple + action.arm.cross(action.force)
            wrench = Wrench(action.force, moment.express(action.body.axes))
            found[action.body] = wrench if before is None else before + wrench
        return found

    @property
    def wrenches(self) -> tuple[tuple[Body, Wrench], ...]:
        """The bodies that one unit acts on, with its wrench on each."""
        return tuple(self._wrenches.items())

    @cached_property
    def _wrenches(self) -> dict[Body, Wrench]:
        found: dict[Body, Wrench] = {}
        for share in self.shares:
            force, arm = share.direction, share.arm
            if arm is None:
                wrench = Wrench(share.body.axes.zero, force)
            else:
                wrench = Wrench(force, arm.cross(force))
            before = found.get(share.body)
            found[share.body] = wrench if before is None else before + wrench
        return found


def required_wrenches(motion: Kinematics, actions: Sequence[Action]) -> dict[Body, Wrench]:
    """The sum that the reactions on every body must have: m dv/dt - F and dL/dt - τ.

    Newton's and Euler's equations about the centre of mass, with F and τ the loads.

    Args:
        motion: of the system.
        actions: of the loads, without those in proportion to reactions.
    """
    system, form = motion.system, motion.form
    wrenches = {}
    for body in system.bodies:
        velocity, _ = motion.velocities[body]
        force = motion.derivative(velocity) * body.mass
        couple = motion.derivative(motion.spin(body))
        for action in actions:
            if action.body == body:
                moment = action.couple + action.arm.cross(action.force).express(body.axes)
                if form != IN_PARTS:
                    _refuse_long_sum(force, action.force)
                    _refuse_long_sum(couple, moment)
                force, couple = force - action.force, couple - moment
        wrench = Wrench(
            form.kept(force, motion.accelerations), form.kept(couple, motion.accelerations)
        )
        form.refuse_outgrown((*wrench.force.components, *wrench.couple.components))
        wrenches[body] = wrench
    return wrenches


def _refuse_long_sum(one: Vector, other: Vector) -> None:
    """Refuse forces of loads that would take minutes to be brought over one denominator."""
    pairs = zip(one.components, other.express(one.triad).components, strict=True)
    products = sum(len(a.num) * len(b.den) + len(b.num) * len(a.den) for a, b in pairs)
    if products > _MOST_PRODUCTS:
        raise OutgrownError(
            f"a sum of forces with {products} products of terms",
            expected=f"at most {_MOST_PRODUCTS}",
            advice="keep long expressions under names",
        )


def reaction_columns(
    motion: Kinematics, proportional: Mapping[str, tuple[Action, ...]]
) -> tuple[ReactionColumn, ...]:
    """One column for every restraint; sliding friction is inclined with its normal force.

    Args:
        motion: of the system.
        proportional: forces and couples of loads per unit of a component, by its name.
    """
    columns = []
    rubbing = [(e, f) for e in motion.elements for f in e.friction(motion.places)]
    sliding = sum(not f.is_couple for _, f in rubbing)
    for restraint in (r for e in motion.elements for r in motion.restraints[e.name]):
        direction, loads = restraint.direction, proportional.get(restraint.name, ())
        components, couples = dict[str, Expr](), list[Share]()
        for element, friction in rubbing:
            if friction.normal.name != restraint.name:
                continue
            letter = friction.letter or ("v_c" if sliding == 1 else f"v_{element.name}")
            found = _friction(motion, friction, letter)
            components |= zip(friction.names, found, strict=True)
            for part, share in zip(friction.sliding, found, strict=True):
                if friction.is_couple:
                    couples += part.shares(part.direction * share)
                else:
                    direction = direction + part.direction * share
                loads += tuple(a.scaled(share) for a in proportional.get(part.name, ()))
        columns.append(ReactionColumn(restraint, direction, components, tuple(couples), loads))
    return tuple(columns)


def _friction(motion: Kinematics, friction: Friction, letter: str) -> list[Expr]:
    """Dry friction per unit of normal force: -μ along the slip velocity, with its letter."""
    if friction.slip is not None:
        return [share * -friction.coefficient for share in friction.slip]
    kept = motion.form.directions
    parts = tuple(motion.slip(r).dot(r.direction) for r in friction.sliding)
    if sum(length(part) ** 2 for part in parts) > _LONGEST_SLIP:
        if motion.form is not IN_PARTS:
            raise OutgrownError(
                "the length of a slip velocity that is too long to divide by",
                expected=f"at most {_LONGEST_SLIP} products of terms in its square",
                advice="keep it under a name",
            )
        along = [named(part) for part in parts]
        speed = principal_root(named(total(part * part for part in along)))
    else:
        along = [kept(kept_sum(part)) for part in parts]
        speed = kept(kept_length(along, LengthLetter(letter, of_velocity=True)))
    if not speed:
        raise ConstraintError(
            f"sliding friction at {friction.normal.name}, a contact that cannot slip",
            expected="a slip velocity that is not identically zero",
            advice="declare the contact Rolling",
        )
    return [part * (-friction.coefficient / speed) for part in along]
