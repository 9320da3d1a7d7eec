"""What happens where a contact mode ends: impacts on landing, and how the next mode is entered.

The event fixes the status of some contacts; `select_mode` decides the rest by the forces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.derive import Guard
from polhode.model import Contact, ContactLaw, Coulomb, Rolling
from polhode.simulate.contact._contact_kinematics import (
    NO_NORMAL_SPEED,
    ContactKinematics,
    State,
    fall_of,
)
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._impact import (
    Impact,
    Roughness,
    coulomb_impact,
    rough_impact,
    smooth_impact,
)
from polhode.simulate.contact._joint_impact import ImpactLaw, joint_impact
from polhode.simulate.contact._mode_state import ModeState, beyond, directions_of
from polhode.simulate.contact._onset_directions import NO_SLIP
from polhode.simulate.contact._open_forces import GivesWay
from polhode.simulate.contact._select_mode import ContactStatus, select_mode
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._number_types import DOUBLES, NumberType

# A bouncing contact takes infinitely many hops in a finite time: they end, and the contact stays
# closed, when the rebound is this much slower than its hardest landing (its energy is then below
# rounding), or the next hop lasts only so many units in the last place of the time.
_REBOUND = 1e-13
_INSTANT = 32
# A contact at this height lands at the same time as another: of its distance from the origin of the
# support; and what it falls in so many units in the last place of the time.
_TOGETHER = 1e-12
_AT_ONCE = 64
_UNCOUPLED = 1e-12  # of its effect where it acts: an impulse with less effect elsewhere has none


@dataclass(frozen=True)
class ModeExit:
    """Where a mode ends.

    Attributes:
        guard: what ended it; None for a jerk of a support.
        shared: the shared state.
        gaps: heights of the contacts that are open, as integrated, m.
        edge_distances: distances to an edge, likewise, m.
        still: contacts whose slip has ended.
    """

    guard: Guard | None
    shared: State
    gaps: dict[int, float]
    edge_distances: dict[int, float]
    still: frozenset[int] = frozenset()


class Transitions:
    """The changes of mode along one motion; keeps the hardest landing of every contact.

    Args:
        hybrid: the modes.
    """

    def __init__(self, hybrid: HybridSystem) -> None:
        self._hybrid = hybrid
        self._hardest: dict[int, float] = {}

    def next(self, before: ModeState, leaving: ModeExit) -> tuple[str, ModeState]:
        """What happens where a mode ends, and how the next mode is entered."""
        self._hybrid.update_forcing(leaving.shared.time)
        kind, entry, opened = self._next(before, leaving)
        # Distances to edges: as integrated, or zero where an edge has just been crossed. A support
        # that jerks may have shifted its edge: then they are those of the state.
        edge_distances = dict(entry.edge_distances)
        if leaving.guard is not None:
            for i in entry.edge_distances.keys() & leaving.edge_distances.keys():
                crossed = entry.phases[i].is_beyond != before.phases[i].is_beyond
                edge_distances[i] = 0.0 if crossed else leaving.edge_distances[i]
        # Heights of open contacts: as integrated, and zero for those that have just opened.
        gaps = {
            k: leaving.gaps[k] if before.phases[k].flies and k != opened else 0.0
            for k, phase in enumerate(entry.phases)
            if phase.flies and not self._hybrid.automaton.contacts[k].is_beside
        }
        return kind, replace(entry, gaps=gaps, edge_distances=edge_distances)

    def _next(self, before: ModeState, leaving: ModeExit) -> tuple[str, ModeState, int | None]:
        """The event, the next mode, and the contact that has landed, if one has.

        If that contact bounces, its height starts again from exactly zero.
        """
        guard, shared = leaving.guard, leaving.shared
        separated = frozenset(k for k, phase in enumerate(before.phases) if phase.flies)
        if guard is None:
            return "jerk", select_mode(self._hybrid, shared, ContactStatus(separated)), None
        i = index_of(guard, self._hybrid)
        sticking = frozenset(k for k, phase in enumerate(before.phases) if phase.rolls)
        if guard.kind == "touches down":
            return *self._land(before, shared, i), i
        off_edge = beyond(before.phases)
        # Contacts that have begun to slip at this very instant have no slip speed yet, and would
        # count as sticking by their speeds alone.
        starting = frozenset(before.onset) if before.shared.time == shared.time else frozenset()
        slipping = guard.places if isinstance(guard, GivesWay) else frozenset({i})
        lifted = separated | self._hybrid.closing_with(i) if i >= 0 else separated
        # Where the last slips end, their directions and with them the forces are only rounding.
        kind, sliding = guard.kind, {k for k, phase in enumerate(before.phases) if phase.slides}
        if kind == "lifts off" and sliding and sliding <= leaving.still:
            kind = "sticks"
        known = {
            "lifts off": ContactStatus(lifted, sticking - lifted, beyond=off_edge),
            "crosses the edge": ContactStatus(separated, sticking - {i}, beyond=off_edge ^ {i}),
            "slips": ContactStatus(separated, sticking - slipping, starting | slipping, off_edge),
            "sticks": ContactStatus(separated, sticking | leaving.still | {i}, beyond=off_edge),
        }
        entry = select_mode(self._hybrid, shared, known[kind])
        turned = kind == "sticks" and entry.phases[i].slides
        return "turns round" if turned else kind, entry, None

    def _lands_too(self, point: ContactKinematics, time: Any) -> bool:
        """Whether an open contact lands at this very instant, to within rounding."""
        return bool(-point.velocity[2] > self._slow(point) and self._is_near(point, time))

    def _is_near(self, point: ContactKinematics, time: Any) -> bool:
        """Whether the height of an open contact is zero, to within rounding."""
        numbers = self._hybrid.numbers
        falls = max(-point.velocity[2], 0) * _AT_ONCE * numbers.spacing(time)
        return bool(point.gap <= numbers.finer(_TOGETHER) * point.extent + falls)

    def _land(self, before: ModeState, shared: State, i: int) -> tuple[str, ModeState]:
        """An impact, if it approaches; then contact, or flight again if it rebounds."""
        hybrid, numbers = self._hybrid, self._hybrid.numbers
        contacts, contact = hybrid.automaton.contacts, hybrid.automaton.contacts[i]
        assert isinstance(contact, Contact)
        separated = frozenset(k for k, phase in enumerate(before.phases) if phase.flies)
        sticking = frozenset(k for k, phase in enumerate(before.phases) if phase.rolls)
        off_edge = beyond(before.phases) | (hybrid.touching.beyond(shared) & separated)
        points = hybrid.touching.at(shared, off_edge)
        mass = hybrid.separated.mass(shared)
        own = [k for k, one in enumerate(contacts) if not one.is_beside]
        touching = [k for k in own if not before.phases[k].flies]
        # Contacts that land at the same time would bounce in an order that rounding decides.
        meeting = [
            k for k in own if k in separated - {i} and self._lands_too(points[k], shared.time)
        ]
        # A contact at rest pushes back where the impulse changes its normal velocity, and one that
        # never slips also where it changes the others. Without a normal impulse there is none of
        # friction either: a contact that stuck then slips.
        acting = _TANGENTIAL + _NORMAL if _is_rough(contact) else _NORMAL

        def affects(k: int, directions: list[int]) -> bool:
            return _affects(points[k], points[i], mass, numbers, directions, acting)

        def feels(k: int) -> bool:
            sticks = isinstance(contacts[k], Rolling) or (k in meeting and _is_rough(contacts[k]))
            return affects(k, _NORMAL) or (sticks and affects(k, _TANGENTIAL))

        if affected := [contacts[k].name for k in (*touching, *meeting) if feels(k)]:
            if hybrid.declared.system.impacts:
                return self._land_together(before, shared, [i, *touching, *meeting])
            raise NumericError(
                f"{contact.name} lands at t = {float(shared.time):.9g} s, and the contact "
                f"{affected[0]} feels the impact",
                expected="one contact of connected bodies at a time: impacts at several contacts "
                "are not determined by rigid bodies alone",
                advice='declare a law, System(..., impacts="Moreau"), or end the motion before '
                "that time",
            )
        sticking -= {k for k in sticking if affects(k, _TANGENTIAL)}
        point = points[i]
        slow = self._slow(point)
        open_again = ContactStatus(separated, sticking, beyond=off_edge)
        closed = ContactStatus(separated - hybrid.closing_with(i), sticking, beyond=off_edge)
        # A contact whose height falls through zero while it opens was found by rounding: no impact.
        if point.velocity[2] > slow:
            return "touches down", select_mode(hybrid, shared, open_again)
        if point.velocity[2] >= -slow:  # without an impact
            return "touches down", select_mode(hybrid, shared, closed)
        self._refuse_impulsive_loads(i, shared.time)
        inverse_mass = point.jacobian @ numbers.solved(mass, point.jacobian.T)
        impact = self._impact(contact, inverse_mass, point.velocity, shared.time)
        # Work of an impulse: impulse times the mean of the velocities before and after, here of the
        # body's point in inertial space, so that a moving support does its share.
        work = impact.impulse @ (point.support + (point.velocity + impact.velocity) / 2)
        change = numbers.solved(mass, point.jacobian.T @ impact.impulse)
        after = shared.with_impulse(change, work)
        hardest = max(self._hardest.get(i, 0.0), -point.velocity[2])
        self._hardest[i] = hardest
        if impact.velocity[2] > numbers.finer(_REBOUND) * hardest:
            bounced = select_mode(hybrid, after, open_again)
            time = bounced.shared.time
            directions = directions_of(bounced, numbers)
            fall = hybrid.mode(bounced.phases).closing_rates(bounced.state, time, directions)[i]
            hop = fall_of(0.0, impact.velocity[2], fall) if fall < 0 else np.inf
            if hop > _INSTANT * numbers.spacing(time):
                return "bounces", bounced
        if impact.sticks:
            closed = replace(closed, stuck=sticking | {i})
        return "touches down", select_mode(hybrid, after, closed)

    def _land_together(
        self, before: ModeState, shared: State, taking: list[int]
    ) -> tuple[str, ModeState]:
        """An impact that several contacts feel, the first of which lands."""
        hybrid, i = self._hybrid, taking[0]
        where = f"an impact at several contacts at t = {float(shared.time):.9g} s"
        if hybrid.numbers is not DOUBLES:
            raise NumericError(
                where, expected="double precision", advice="leave out precision for this motion"
            )
        for k in taking:
            self._refuse_impulsive_loads(k, shared.time)
        points = hybrid.touching.at(shared, beyond(before.phases))
        jacobian = np.vstack([points[k].jacobian for k in taking])
        change = np.linalg.solve(hybrid.separated.mass(shared), jacobian.T)
        velocities = np.array([points[k].velocity for k in taking])
        laws = [self._law(hybrid.automaton.contacts[k]) for k in taking]
        impulses, after = joint_impact(jacobian @ change, velocities, laws, where)
        supports = np.array([points[k].support for k in taking])
        work = float(np.sum(impulses * (supports + (velocities + after) / 2)))
        left = shared.with_impulse(change @ impulses.ravel(), work)
        self._hardest[i] = max(self._hardest.get(i, 0.0), -float(velocities[0, 2]))
        # What leaves more slowly than rounding of the hardest landing stays.
        still = _REBOUND * max(self._hardest.values())
        opened = {k for k, v in zip(taking, after[:, 2], strict=True) if v > still}
        flying = {k for k, phase in enumerate(before.phases) if phase.flies}
        closed = [*taking, *self._left_touching(left, flying - set(taking), still)]
        # A slip of no more than the rounding of the velocities before has ended in the impact.
        fastest = max(*(points[k].scale for k in taking), *self._hardest.values())
        there = hybrid.touching.at(left, beyond(before.phases))
        stuck = {
            k
            for k in closed
            if k not in opened
            and self._law(hybrid.automaton.contacts[k]).friction
            and np.hypot(*there[k].velocity[:2]) <= NO_SLIP * fastest
        }
        separated = frozenset.union(
            frozenset(flying - {j for k in closed for j in hybrid.closing_with(k)}),
            *(hybrid.closing_with(k) for k in opened),
        )
        known = ContactStatus(separated, frozenset(stuck), beyond=beyond(before.phases))
        return "bounces" if i in opened else "touches down", select_mode(hybrid, left, known)

    def _left_touching(self, shared: State, open_: set[int], still: float) -> list[int]:
        """The open contacts that an impact leaves without a distance and without a normal speed.

        Such is the last corner of a box that clatters until it lies flat.
        """
        points = self._hybrid.touching.at(shared, frozenset())
        contacts = self._hybrid.automaton.contacts
        return [
            k
            for k in sorted(open_)
            if not contacts[k].is_beside
            and self._is_near(points[k], shared.time)
            and abs(points[k].velocity[2]) <= max(still, self._slow(points[k]))
        ]

    def _law(self, contact: ContactLaw) -> ImpactLaw:
        """What a contact does in an impact at several."""
        assert isinstance(contact, Contact)
        value, along, friction = self._hybrid.value, 0.0, 0.0
        if isinstance(contact, Coulomb):
            friction = float(value(contact.mu))
        if isinstance(contact, Rolling):
            friction = np.inf
            along = 0.0 if contact.tangential is None else float(value(contact.tangential))
        return ImpactLaw((float(value(contact.restitution)), along), friction)

    def _slow(self, point: ContactKinematics) -> Any:
        """Normal velocity of a contact that counts as none, m/s."""
        return self._hybrid.numbers.finer(NO_NORMAL_SPEED) * point.scale

    def _refuse_impulsive_loads(self, i: int, time: float) -> None:
        """Refuse an impact in a system with loads or couples in proportion to reactions."""
        modes = self._hybrid.declared
        lines, name = modes.together.equations.lines, modes.contacts[i].name
        found = [f"loads in proportion to {line.name}" for line in lines if line.loads]
        found += [modes.contacts[k].name for k in self._hybrid.closing_with(i) - {i}]
        if found:
            raise NumericError(
                f"an impact of {name} at t = {float(time):.9g} s, with {', '.join(found)}",
                expected="a landing without an impact: the impulse of such loads is not known",
                advice="end the motion before that time, or start in contact",
            )

    def _impact(
        self, contact: Contact, inverse_mass: Array, velocity: Array, time: float
    ) -> Impact:
        numbers = self._hybrid.numbers
        restitution = self._hybrid.value(contact.restitution)
        if isinstance(contact, Coulomb):
            kinetic, static = (self._hybrid.value(m) for m in (contact.mu, contact.mu_static))
            roughness = Roughness(kinetic, static, restitution)
            where = f"{contact.name} at t = {float(time):.9g} s"
            return coulomb_impact(inverse_mass, velocity, roughness, where, numbers)
        if isinstance(contact, Rolling):
            along = 0 if contact.tangential is None else self._hybrid.value(contact.tangential)
            return rough_impact(inverse_mass, velocity, (restitution, along), numbers)
        return smooth_impact(inverse_mass, velocity, restitution)


_NORMAL, _TANGENTIAL = [2], [0, 1]


def _is_rough(contact: ContactLaw) -> bool:
    """Whether an impact has a tangential impulse."""
    return isinstance(contact, Coulomb | Rolling)


def _affects(
    one: ContactKinematics,
    other: ContactKinematics,
    mass: Array,
    numbers: NumberType,
    directions: list[int],
    acting: list[int],
) -> bool:
    """Whether an impulse at one contact changes velocities at another: J₁ M⁻¹ J₂ᵀ is not zero.

    Args:
        one: the contact whose velocities may change.
        other: the contact of the impulse.
        mass: the mass matrix.
        numbers: in which it is given.
        directions: of the first contact that matter.
        acting: directions of the impulse.
    """
    shared = (one.jacobian @ numbers.solved(mass, other.jacobian.T))[np.ix_(directions, acting)]
    own = one.jacobian @ numbers.solved(mass, one.jacobian.T)
    return bool(np.max(np.abs(shared)) > _UNCOUPLED * np.max(np.abs(own)))


def index_of(guard: Guard, hybrid: HybridSystem) -> int:
    """Which contact a guard watches; -1 for none."""
    names = [contact.name for contact in hybrid.automaton.contacts]
    return names.index(guard.contact.name) if guard.contact is not None else -1
