"""Integrates a motion from contact mode to contact mode; the loop is the same in all precisions.

Within a mode, pieces are integrated (`integrate_mode`, with the `ModePieces` of a type of numbers)
until a guard falls: friction reaches its limit, or a slip, a normal force or a height vanishes
(`GuardMonitor`). There `Transitions` applies the impact, if there is one, and `select_mode` chooses
the next mode: the one whose contacts can supply the forces that it needs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from polhode.base import NumericError
from polhode.model import Contact, Rolling
from polhode.simulate._absolute_values import SideChangeCount
from polhode.simulate._event import ModeSwitch
from polhode.simulate._mode_integration import ModeRun, integrate_mode
from polhode.simulate._segment import Segment
from polhode.simulate.contact._attitude_charts import in_regular_angles
from polhode.simulate.contact._description_changes import (
    DescriptionChange,
    SpeedChange,
    described_otherwise,
)
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_pieces import ModePieces
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._transition import Transitions
from polhode.simulate.integrate._stop_criteria import Stop

_MOST_EVENTS = 50_000  # changes of mode: more are chatter, and would fill the memory
# After the first so many changes their number is extrapolated, unless they come ever faster, as the
# bounces of a ball that comes to rest do; it must not exceed the limit by this factor.
_EXTRAPOLATED_AT = 1000
_BEYOND = 10.0
# Modes alternate without progress if so many changes take no more than this share of the whole
# duration. One instant of a motion with a few contacts needs far fewer.
_NO_TIME = 1e-11
_MOST_AT_ONCE = 32


@dataclass(frozen=True)
class HybridSolution:
    """Segments and the changes between them; the motion may end before its time.

    Attributes:
        speed_changes: where other speeds became independent of all contact modes, with the times.
    """

    segments: tuple[Segment, ...]
    changes: tuple[ModeSwitch, ...]
    ending: str
    speed_changes: tuple[tuple[float, SpeedChange], ...] = ()


class HybridIntegrator:
    """Follows one motion from mode to mode.

    Args:
        hybrid: the modes.
        pieces: integrates a mode from where it is entered, in the numbers of `hybrid`.
        until: events that end the motion.
    """

    def __init__(
        self,
        hybrid: HybridSystem,
        pieces: Callable[[ModeState], ModePieces],
        until: frozenset[str] = frozenset(),
    ) -> None:
        self._hybrid = hybrid
        self._pieces = pieces
        self._until = until
        self._segments: list[Segment] = []
        self._changes: list[ModeSwitch] = []
        self._described: list[tuple[float, DescriptionChange]] = []
        self._instants: list[float] = []
        self._transitions = Transitions(hybrid)
        self._side_changes = SideChangeCount()

    def integrate(self, entry: ModeState, end: float) -> HybridSolution:
        """Follow the motion up to a time, or to where it goes flat.

        Raises:
            NumericError: where it cannot be continued.
        """
        while (begin := entry.shared.time) < end:
            pieces = self._pieces(entry)
            run = integrate_mode(pieces, pieces.start, begin, end, self._side_changes)
            self._segments.extend(run.segments)
            self._changes.extend(run.switches)
            now, interrupted = run.last.time, run.last.piece.solution.stop is Stop.INTERRUPTED
            if run.last.guard is None and (now >= end or interrupted):
                break
            last = self._last(run)
            if last is not None:
                self._changes.append(last)
                return self._solution(last.after)
            leaving = pieces.exit(run.last)
            if isinstance(change := run.last.guard, DescriptionChange):
                self._described.append((now, change))
                entry = described_otherwise(self._hybrid, change, entry, leaving, run.last.state)
                continue
            leaving = replace(leaving, shared=in_regular_angles(self._hybrid, leaving.shared))
            kind, entry = self._transitions.next(entry, leaving)
            time, before = run.segments[-1].end, pieces.name
            after = self._hybrid.mode(entry.phases).mode.name
            self._changes.append(ModeSwitch(time, kind, before, after))
            self._instants.append(now)
            self._refuse_chatter(float(time), float(end))
            if self._stands_still(end):
                raise self._undecided(time, {before, after})
        return self._solution(self._segments[-1].mode)

    def _solution(self, ending: str) -> HybridSolution:
        speeds = tuple((time, c) for time, c in self._described if isinstance(c, SpeedChange))
        return HybridSolution(tuple(self._segments), tuple(self._changes), ending, speeds)

    def _refuse_chatter(self, time: float, end: float) -> None:
        """Refuse a motion with more changes of mode than can be followed.

        Raises:
            NumericError: where there are too many already, or will be.
        """
        changes, some = len(self._changes), _EXTRAPOLATED_AT // 10
        if changes == _EXTRAPOLATED_AT:
            begin, early, late = (float(self._instants[i]) for i in (0, some, -some))
            if time - late <= (early - begin) / 2:  # the intervals shrink
                return
            changes = int(changes * min((end - begin) / (time - begin) / _BEYOND, _MOST_EVENTS))
        if changes > _MOST_EVENTS:
            raise NumericError(
                f"a motion up to t = {end:g} s, whose contact mode changes {len(self._changes)} "
                f"times up to t = {time:.9g} s",
                expected=f"a motion that settles, or no more than {_MOST_EVENTS} changes",
                advice="end the motion before that time, or change the friction or the restitution",
            )

    def _stands_still(self, end: float) -> bool:
        """Whether modes alternate without time passing.

        A contact with restitution rebounds at ever shorter intervals, whose sum is finite: then
        only intervals within the rounding of the time count as none.
        """
        last = self._instants[-_MOST_AT_ONCE:]
        passed = last[-1] - last[0]
        if len(last) < _MOST_AT_ONCE or passed > _NO_TIME * end:
            return False
        instant = 8 * self._hybrid.numbers.spacing(last[-1])
        contacts = self._hybrid.automaton.contacts
        given = [c.restitution for c in contacts if isinstance(c, Contact)]
        rebounds = any(self._hybrid.value(restitution) > 0 for restitution in given)
        rebounds = rebounds or bool(self._hybrid.declared.system.impacts)  # a block that rocks
        return bool(passed <= instant) or not rebounds

    def _undecided(self, time: float, modes: set[str]) -> NumericError:
        # Where N vanishes while pure rolling still needs friction, the contact cannot open, since
        # without friction it would close again; nor can it stay closed, since it would have to
        # pull (Painlevé's paradox). Coulomb friction may drive a ball back to an edge from both
        # sides.
        names = " and ".join(sorted(modes) if len(modes) > 1 else [*modes, "contact"])
        unlimited = any(isinstance(c, Rolling) for c in self._hybrid.automaton.contacts)
        lifts_off = any(change.kind == "lifts off" for change in self._changes[-2:])
        cause = "no contact mode lasts"
        if unlimited and lifts_off:
            cause = "the normal force vanishes, but pure rolling forbids lift-off"
        use_friction = "use Coulomb friction (a coefficient mu), or " if unlimited else ""
        return NumericError(
            f"at t = {float(time):.9g} s {cause}: {names} exclude each other",
            expected="friction that gives way before the contact has to open"
            if unlimited
            else "a contact mode that lasts for some time",
            advice=f"{use_friction}end the motion before that time",
        )

    def _last(self, run: ModeRun) -> ModeSwitch | None:
        """The change that ends the motion, if this is one."""
        guard = run.last.guard
        kind = guard.kind if guard is not None else ""
        time, mode = run.segments[-1].end, run.segments[-1].mode
        if guard is not None and guard.ends:
            after = "near-flat" if guard.ends == "goes flat" else mode
            return ModeSwitch(time, guard.ends, mode, after)
        return ModeSwitch(time, kind, mode, mode) if kind in self._until else None
