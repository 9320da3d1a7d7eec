"""How a contact mode is entered, and what its constraints do to the speeds there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.model import Phase
from polhode.simulate._dynamics import WORK
from polhode.simulate.contact._auxiliary_states import (
    edge_distance_symbol,
    gap_symbol,
    slip_symbols,
)
from polhode.simulate.contact._contact_kinematics import ContactKinematics, State
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._number_types import DOUBLES, NumberType


@dataclass(frozen=True)
class ModeState:
    """A contact mode, and the state in which it is entered.

    Attributes:
        phases: of every contact.
        shared: the shared state, after the impulses of the constraints.
        coordinates: of the mode.
        speeds: of the mode.
        onset: for contacts that begin to slip, the direction of the slip to come, rad.
        slips: slip velocities, by contact.
        gaps: heights above the support of contacts that have just left it.
        edge_distances: of contacts that touch a support with an edge, from that edge.
    """

    phases: tuple[Phase, ...]
    shared: State
    coordinates: Array
    speeds: Array
    onset: dict[int, Any] = field(default_factory=dict)
    slips: dict[int, Array] = field(default_factory=dict)
    gaps: dict[int, float] = field(default_factory=dict)
    edge_distances: dict[int, float] = field(default_factory=dict)

    @property
    def state(self) -> Array:
        """Coordinates and speeds of the mode."""
        return np.concatenate([self.coordinates, self.speeds])

    def rounded(self) -> ModeState:
        """This state in doubles."""
        double = DOUBLES.array
        return replace(
            self,
            shared=self.shared.rounded(),
            coordinates=double(self.coordinates),
            speeds=double(self.speeds),
            onset={i: float(angle) for i, angle in self.onset.items()},
            slips={i: double(slip) for i, slip in self.slips.items()},
            gaps={i: float(gap) for i, gap in self.gaps.items()},
            edge_distances={
                i: float(edge_distance) for i, edge_distance in self.edge_distances.items()
            },
        )


def entered(
    hybrid: HybridSystem,
    shared: State,
    phases: tuple[Phase, ...],
    points: Sequence[ContactKinematics],
    starting: frozenset[int],
) -> ModeState:
    """Enter a mode: its constraints project the speeds.

    Args:
        starting: contacts that begin to slip, in a direction that is found later.
    """
    mode = hybrid.mode(phases)
    coordinates, speeds = mode.entered(shared)
    after = _after(hybrid, shared, mode, coordinates, speeds, points, phases)
    sliding = [i for i, phase in enumerate(phases) if phase.slides]
    no_slip = hybrid.numbers.array(np.zeros(2))
    slips = {i: no_slip if i in starting else points[i].velocity[:2] for i in sliding}
    onset = dict.fromkeys(sorted(starting), 0.0)
    there = zip(mode.mode.touches, mode.mode.phases, points, strict=True)
    edge_distances = {
        i: point.edge_distance(is_beyond=phase.is_beyond)
        for i, (touch, phase, point) in enumerate(there)
        if touch.reserve and not phase.flies
    }
    return ModeState(
        phases, after, coordinates, speeds, onset, slips, edge_distances=edge_distances
    )


def _after(
    hybrid: HybridSystem,
    shared: State,
    mode: CompiledMode,
    coordinates: Array,
    speeds: Array,
    points: Sequence[ContactKinematics],
    phases: tuple[Phase, ...],
) -> State:
    """The shared state in the mode, with the work of the impulses of the constraints added."""
    own = (*mode.mode.equations.coordinates, *mode.mode.equations.speeds)
    values: dict[Any, float] = dict(zip(own, (*coordinates, *speeds), strict=True))
    embedding = mode.embedding(shared.time, values, shared.work)
    change = embedding.speeds - shared.speeds
    touching = [m for m, p in zip(points, phases, strict=True) if not p.flies]
    if not touching or not np.any(change):
        return embedding
    # The impulse p at the contacts follows from the change of momentum, Jᵀ p = M Δu; the least one
    # where contacts are redundant. Its work is p times the mean of the velocities before and after.
    jacobian = np.vstack([m.jacobian for m in touching])
    impulse = hybrid.numbers.least(jacobian.T, hybrid.separated.mass(shared) @ change)
    middle = [m.velocity + m.support + m.jacobian @ change / 2 for m in touching]
    return embedding.with_impulse(np.zeros_like(change), impulse @ np.concatenate(middle))


def directions_of(entry: ModeState, numbers: NumberType = DOUBLES) -> list[Any]:
    """Components of the slip directions, and slip speeds, of all sliding contacts."""
    found = list[Any]()
    for i, slip in sorted(entry.slips.items()):
        size = numbers.size(slip)
        if i in entry.onset:
            found += [*numbers.direction(entry.onset[i]), 0.0]
        else:
            found += [slip[0] / size, slip[1] / size, size]
    return found


def state_on(hybrid: HybridSystem, entry: ModeState) -> dict[Symbol, Any]:
    """All states where a mode is entered, auxiliary ones included."""
    mode = hybrid.mode(entry.phases)
    equations, auxiliary = mode.mode.equations, mode.dynamics.auxiliary
    own = (*equations.coordinates, *equations.speeds)
    state = dict(zip(own, entry.state.tolist(), strict=True))
    points = hybrid.touching.at(entry.shared, beyond(entry.phases))
    for i, touch in enumerate(mode.mode.touches):
        gap, edge_distance = gap_symbol(touch.contact), edge_distance_symbol(touch.contact)
        slips = slip_symbols(touch.contact)
        if gap in auxiliary:
            state[gap] = entry.gaps.get(i, points[i].gap)
        if edge_distance in auxiliary:
            state[edge_distance] = entry.edge_distances[i]
        if slips[0] in auxiliary:
            state |= zip(slips, entry.slips[i].tolist(), strict=True)
    return {**state, WORK: entry.shared.work}


def beyond(phases: tuple[Phase, ...]) -> frozenset[int]:
    """The contacts that are beyond the edge of their support."""
    return frozenset(i for i, phase in enumerate(phases) if phase.is_beyond)
