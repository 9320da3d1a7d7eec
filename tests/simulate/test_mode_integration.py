"""One mode, piece by piece: what is handed from piece to piece, and what ends the mode."""

from __future__ import annotations

from typing import Any

from polhode.algebra import ONE
from polhode.derive import Guard
from polhode.simulate._absolute_values import SideChangeCount
from polhode.simulate._mode_integration import ModeRun, PieceEnd, integrate_mode

SLIPS = Guard(None, "slips", ONE)


class Planned:
    """Pieces of length 1 s, named by their number; the last two may end by a guard, or the mode."""

    name, whole, dynamics = "rolling", None, None

    def __init__(self, guard: Guard | None = None, last: int = -1) -> None:
        self.asked: list[Any] = []
        self._guard = guard
        self._last = last

    def stored_time(self, time: float) -> str:
        return f"{time} s"

    def next(self, state: int, now: float, end: float, before: str | None) -> PieceEnd:
        self.asked.append((state, now, before))
        guard = self._guard if len(self.asked) == 2 else None
        is_last = len(self.asked) == self._last
        return PieceEnd(f"piece {len(self.asked)}", state + 1, min(now + 1, end), guard, is_last)


def followed(pieces: Planned) -> ModeRun:
    return integrate_mode(pieces, 0, 0.0, 2.5, SideChangeCount())


def test_every_piece_continues_the_one_before():
    pieces = Planned()
    run = followed(pieces)
    assert pieces.asked == [(0, 0.0, None), (1, 1.0, "piece 1"), (2, 2.0, "piece 2")]
    (segment,) = run.segments
    assert segment.parts == ("piece 1", "piece 2", "piece 3")
    assert (segment.begin, segment.end) == ("0.0 s", "2.5 s")
    assert (run.last.time, run.last.guard, run.switches) == (2.5, None, ())


def test_a_guard_ends_the_mode():
    run = followed(Planned(SLIPS))
    assert run.last.guard is SLIPS
    assert run.segments[0].end == "2.0 s"


def test_a_mode_that_is_left_without_a_guard_has_none():
    run = followed(Planned(last=1))
    assert (run.last.time, run.last.guard) == (1.0, None)
    assert run.segments[0].parts == ("piece 1",)
