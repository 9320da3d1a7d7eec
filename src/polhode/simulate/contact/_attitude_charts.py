"""Contact modes near gimbal lock: in angles counted from turned axes, as free motions are.

A box that lies on the face across the axis of its last rotation is in gimbal lock. All modes go
over to other angles together (`HybridSystem.in_angles`); the motion is read in those of the
declaration (`TurnedPiece`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from polhode.algebra import ONE, Symbol
from polhode.base import PolhodeError
from polhode.model import Phase
from polhode.simulate._absolute_values import Instant
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._gimbal_lock import NumericAttitude, passes_straight
from polhode.simulate._segment import TrajectoryPiece, state_at
from polhode.simulate._start import Start, check_start
from polhode.simulate._turned_piece import TurnedPiece, turned_piece
from polhode.simulate.contact._contact_kinematics import State
from polhode.simulate.contact._description_changes import DescriptionChange
from polhode.simulate.contact._hybrid_system import Chart, CompiledMode, HybridSystem
from polhode.simulate.contact._regular_speeds import on_regular_speeds
from polhode.simulate.integrate._arrays import Array


@dataclass(frozen=True)
class AnglesChange(DescriptionChange):
    """Ends a piece where angles have to be counted otherwise.

    Attributes:
        chart: the attitudes of which.
    """

    chart: Chart = ()

    def applied(self, hybrid: HybridSystem, phases: tuple[Phase, ...], shared: State) -> State:
        return on_regular_speeds(hybrid, phases, _in_angles(hybrid, self.chart, shared))


def passing_straight(hybrid: HybridSystem, mode: CompiledMode, here: Instant) -> frozenset[int]:
    """The attitudes that are near a pole and go straight through it: their angles stay regular.

    So do those that rest beside it.
    """
    values = partial(here.values, mode.dynamics)
    return frozenset(
        i
        for i, attitude in enumerate(hybrid.attitudes)
        if i not in hybrid.chart
        and attitude.geometry.is_near_pole(here.state[attitude.angles[1]], attitude.near)
        and passes_straight(attitude, here.state, values)
    )


def angles_change(
    hybrid: HybridSystem, state: Mapping[Symbol, Any], straight: frozenset[int]
) -> AnglesChange | None:
    """The change to angles that are regular in a state of any mode; None where these are.

    Args:
        hybrid: the modes.
        state: of one of them.
        straight: attitudes that pass straight through the pole.
    """
    chart = _chart_at(hybrid, state, straight)
    return None if chart == hybrid.chart else AnglesChange(None, "other angles", ONE, chart)


def in_regular_angles(hybrid: HybridSystem, shared: State) -> State:
    """A shared state in angles that are regular there, with which all modes then go on.

    Beside the pole all speeds have to be regular for contacts to be opened and closed, whichever
    way it is passed; until then, attitudes that pass it straight remain as they are.
    """
    separated = hybrid.separated
    own = np.concatenate([shared.coordinates, shared.speeds])
    here = dict(zip(separated.dynamics.without_auxiliary.states, own, strict=True))
    straight = frozenset[int]()
    if hybrid.attitudes:
        found = passing_straight(hybrid, separated, separated.instant(here, shared.time))
        straight = frozenset(i for i in found if not _is_beside_pole(hybrid.attitudes[i], here))
    chart = _chart_at(hybrid, here, straight)
    return shared if chart == hybrid.chart else _in_angles(hybrid, chart, shared)


def _is_beside_pole(attitude: NumericAttitude, state: Mapping[Symbol, Any]) -> bool:
    """Whether equations in the declared angles lose so many digits that they are doubtful."""
    return attitude.geometry.is_near_pole(state[attitude.angles[1]], attitude.doubtful)


def is_regular_in_other_angles(
    hybrid: HybridSystem, phases: tuple[Phase, ...], state: Mapping[Symbol, float]
) -> bool:
    """Whether a motion starts near gimbal lock, in a state from which other angles can go on.

    Args:
        hybrid: the modes, in the declared angles.
        phases: of the one that it starts in.
        state: of it.

    Raises:
        ConstraintError, NumericError: where it cannot start in these either.
    """
    chart = _chart_at(hybrid, state, frozenset())
    if chart == hybrid.chart:
        return False
    declared, turned = (hybrid.dynamics_in(c, phases).without_auxiliary for c in ((), chart))
    angles = hybrid.angles_between(declared, turned, chart)
    there = angles.state(state, _numbers(hybrid, declared), 0.0)
    known = dict(zip(turned.parameters, _numbers(hybrid, turned).tolist(), strict=True))
    check_start(turned, Start(there, {}), known)
    return True


def has_left_angles(
    hybrid: HybridSystem, core: Sequence[Symbol], straight: frozenset[int]
) -> Callable[[float, Sequence[float]], bool] | None:
    """Whether angles have to be counted otherwise at the end of a step; None if they never have.

    Args:
        hybrid: the modes.
        core: the states that are integrated.
        straight: attitudes that pass straight through the pole.
    """
    if not hybrid.attitudes:
        return None
    angles = {q for a in hybrid.attitudes for q in (*a.angles, *a.turned)}
    places = [(q, i) for i, q in enumerate(core) if q in angles]

    def over(time: float, state: Sequence[float]) -> bool:
        return _chart_at(hybrid, {q: state[i] for q, i in places}, straight) != hybrid.chart

    return over


def as_declared(hybrid: HybridSystem, mode: CompiledMode, piece: TrajectoryPiece) -> TurnedPiece:
    """A piece of a mode in other angles, as it is read."""
    declared = hybrid.dynamics_in((), mode.mode.phases)
    angles = hybrid.angles_between(declared, mode.dynamics, hybrid.chart)
    # as they hold on the piece: those of prescribed motions may have changed where it ends
    known = dict(zip(mode.dynamics.parameters, piece.constants.tolist(), strict=True))
    constants = np.array([known[s] for s in declared.parameters])
    found = turned_piece(angles, piece, hybrid.declared_angles, constants)
    there = state_at(found, found.end)
    hybrid.declared_angles = {q: there[q] for q in hybrid.declared_angles}
    return found


# -- which angles ----------------------------------------------------------------------------------


def _chart_at(hybrid: HybridSystem, known: Mapping[Symbol, Any], straight: frozenset[int]) -> Chart:
    """The attitudes whose angles are to be counted otherwise, from the angles of a state.

    Those whose angles are not known stay as they are, and so do those that pass straight.
    """
    chart = []
    for i, attitude in enumerate(hybrid.attitudes):
        (first, second, _), geometry = attitude.turned, attitude.geometry
        if i not in hybrid.chart:
            angle = attitude.angles[1]
            near = i not in straight and angle in known
            near = near and geometry.is_near_pole(known[angle], attitude.near)
        elif known.keys() >= {first, second}:
            declared, own = geometry.sines(known[first], known[second])
            near = declared < attitude.far and own > attitude.near
        else:
            near = True
        if near:
            chart.append(i)
    found = tuple(chart)
    return found if found == hybrid.chart or _is_same_motion(hybrid, found) else hybrid.chart


def _is_same_motion(hybrid: HybridSystem, chart: Chart) -> bool:
    """Whether the system can be described in some angles."""
    if chart not in hybrid.possible_charts:
        hybrid.possible_charts[chart] = not chart or _agrees(hybrid, chart)
    return hybrid.possible_charts[chart]


def _agrees(hybrid: HybridSystem, chart: Chart) -> bool:
    declared = _separated(hybrid, ())
    anywhere = dict.fromkeys(declared.states, 0.4)
    try:
        angles = hybrid.angles_between(declared, _separated(hybrid, chart), chart)
        return angles.is_same_motion(anywhere, partial(_numbers, hybrid))
    except PolhodeError:  # what was declared along the axes between needs them as they are
        return False


# -- states in other angles ------------------------------------------------------------------------


def _in_angles(hybrid: HybridSystem, chart: Chart, shared: State) -> State:
    """Go on with other angles, in which a shared state is then described."""
    before, own = hybrid.chart, np.concatenate([shared.coordinates, shared.speeds])
    both = tuple(sorted({*before, *chart}))
    if both != before:
        own = _turned(hybrid, before, both, own, shared.time)
    if both != chart:
        own = _turned_back(hybrid, both, chart, own, shared.time)
    hybrid.in_angles(chart)
    count = len(shared.coordinates)
    return State(shared.time, own[:count], own[count:], shared.work)


def _turned(hybrid: HybridSystem, before: Chart, after: Chart, own: Array, time: float) -> Array:
    """A state with the angles of further attitudes turned; the declared ones are followed then."""
    source, target = _separated(hybrid, before), _separated(hybrid, after)
    angles = hybrid.angles_between(source, target, sorted({*after} - {*before}))
    known = dict(zip(source.states, own.tolist(), strict=True))
    hybrid.declared_angles |= {q: known[q] for a in angles.chosen for q in a.angles}
    return angles.turned_states(own[:, None], _numbers(hybrid, source), np.array([time]))[:, 0]


def _turned_back(
    hybrid: HybridSystem, before: Chart, after: Chart, own: Array, time: float
) -> Array:
    """A state with the declared angles of some attitudes again, on the turns they have come to."""
    source, target = _separated(hybrid, before), _separated(hybrid, after)
    angles = hybrid.angles_between(target, source, sorted({*before} - {*after}))
    followed, constants = hybrid.declared_angles, _numbers(hybrid, source)
    choices = angles.choices(followed, time)
    found = angles.declared_states(own[:, None], constants, np.array([time]), choices)[:, 0]
    for q in [q for a in angles.chosen for q in a.angles]:
        place = target.states.index(q)
        found[place] += 2 * np.pi * np.round((followed[q] - found[place]) / (2 * np.pi))
    hybrid.declared_angles = {q: followed[q] for q in followed if q not in target.states}
    return found


def _numbers(hybrid: HybridSystem, dynamics: Dynamics) -> Array:
    return np.array([hybrid.constants[s] for s in dynamics.parameters])


def _separated(hybrid: HybridSystem, chart: Chart) -> Dynamics:
    """The mode in which nothing touches, in some angles, on coordinates and speeds alone."""
    return hybrid.dynamics_in(chart, hybrid.separated.mode.phases).without_auxiliary
