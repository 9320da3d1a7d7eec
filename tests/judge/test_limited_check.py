"""Claims judged in processes that end where they take too long, asked for from Python."""

from __future__ import annotations

import os
import signal
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from itertools import count
from select import select

import pytest

import polhode as ph
from polhode.base import within
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, CheckRequest, Verdict
from polhode.judge.processes import _limited_check

WRONG = r"F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)"
RIGHT = r"\dot\omega_1 = 0"
SUMS = [
    "+".join(rf"\cosh({one}{other})" for one in ("M", "a", "g", r"\omega_1"))
    for other in (r"\theta", r"\phi", "I_1")
]
ENDLESS = "".join(rf"\frac{{1}}{{{unlike}}}" for unlike in SUMS) + "= 0"


@pytest.fixture(scope="module")
def gyroscope():
    return ph.derive(PROBLEM_SET["gyroscope"].build())


@pytest.fixture
def alone(monkeypatch):
    """With no process kept from before, or for later."""
    end_all()
    yield
    end_all()


def end_all():
    while _limited_check._idle:
        _limited_check._idle.popitem()[1].close()


def compiled(*_):
    deque(count(), maxlen=0)  # never comes back to Python, and heeds no signal handler


def python(*_):
    while True:
        pass


@pytest.mark.parametrize("latex", [RIGHT, WRONG, "F_z = q"])
def test_the_verdict_is_the_same_with_a_bound_and_without(latex, gyroscope):
    assert ph.check(latex, gyroscope) == ph.check(latex, gyroscope, seconds=None)


def test_what_is_computed_for_ever_is_given_up(gyroscope):
    with pytest.raises(ph.NumericError, match=r"more than 0\.5 s of computing"):
        ph.check(ENDLESS, gyroscope, seconds=0.5)
    assert ph.check(RIGHT, gyroscope, seconds=30).holds  # by another process


def test_one_process_judges_claim_after_claim(gyroscope, alone):
    judging = set()
    for _ in range(3):
        ph.check(RIGHT, gyroscope)
        judging |= {worker.pid for worker in _limited_check._idle.values()}
    assert len(judging) == 1


@pytest.mark.usefixtures("alone")
def test_no_more_processes_are_kept_than_a_few():
    systems = [PROBLEM_SET["gyroscope"].build() for _ in range(4)]
    for system in systems:
        ph.check(RIGHT, ph.derive(system))
    assert len(_limited_check._idle) == _limited_check._KEPT


def test_a_process_that_somebody_ended_is_replaced(gyroscope, alone):
    ph.check(RIGHT, gyroscope)
    (worker,) = _limited_check._idle.values()
    os.kill(worker.pid, signal.SIGKILL)
    os.waitid(os.P_PID, worker.pid, os.WEXITED | os.WNOWAIT)
    assert ph.check(RIGHT, gyroscope).holds


def test_threads_may_ask_at_once(gyroscope):
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(lambda latex: ph.check(latex, gyroscope), [RIGHT, WRONG] * 4))
    assert [v.answer for v in found] == [Answer.HOLDS, Answer.FAILS] * 4


def test_a_process_parted_from_this_one_asks_its_own(gyroscope):
    ph.check(RIGHT, gyroscope)
    child = os.fork()
    if not child:
        os._exit(int(bool(_limited_check._idle)) or int(not ph.check(RIGHT, gyroscope).holds))
    _, status = os.waitpid(child, 0)
    assert status == 0
    assert ph.check(WRONG, gyroscope).answer is Answer.FAILS


def test_a_failure_is_told_even_where_no_correction_is_found_in_time(gyroscope, alone, monkeypatch):
    def failing(request, equations, tell):
        tell(Verdict(Answer.FAILS, "motion", reason="for a reason"))
        compiled()

    told = []
    monkeypatch.setattr(CheckRequest, "judged", failing)
    verdict = ph.check(WRONG, gyroscope, seconds=0.5, tell=told.append)
    assert (verdict.answer, verdict.reason) == (Answer.FAILS, "for a reason")
    assert verdict.remarks == ("looking for a correction took more than 0.5 s of computing",)
    assert [failure.remarks for failure in told] == [()]


def test_a_claim_that_takes_too_much_memory_is_told(gyroscope, alone, monkeypatch):
    monkeypatch.setattr(CheckRequest, "judged", lambda *_: bytearray(64 << 30))
    with pytest.raises(ph.NumericError, match="memory"):
        ph.check(RIGHT, gyroscope)


def test_what_is_refused_is_refused_in_its_own_words(gyroscope):
    with pytest.raises(ph.ParseError, match="context 'sometimes'"):
        ph.check(RIGHT, gyroscope, context="sometimes")
    for seconds in (0, float("nan"), float("inf"), "5"):
        with pytest.raises(
            ph.NumericError, match=r"a time limit of .* s; expected a positive number, or None"
        ):
            ph.check(RIGHT, gyroscope, seconds=seconds)
    with pytest.raises(ph.ParseError, match="an equation of type int; expected LaTeX"):
        ph.check(5, gyroscope)


def test_a_restriction_may_stand_alone(gyroscope):
    listed = ph.check(r"\sin\theta = 1", gyroscope, given=["theta = pi/2"])
    alone = ph.check(r"\sin\theta = 1", gyroscope, given="theta = pi/2")
    assert alone == listed
    assert alone.answer is Answer.HOLDS


def test_where_a_process_cannot_be_parted_it_is_interrupted(gyroscope, monkeypatch):
    monkeypatch.setenv("POLHODE_DEBUG", "1")
    assert ph.check(RIGHT, gyroscope).holds
    monkeypatch.setattr(CheckRequest, "judged", python)
    with pytest.raises(ph.NumericError, match=r"more than 0\.1 s of computing"):
        ph.check(RIGHT, gyroscope, seconds=0.1)
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)


def test_an_interruption_ends_the_process_that_judges(gyroscope, alone, monkeypatch):
    def interrupting(*_):
        os.kill(os.getppid(), signal.SIGINT)
        compiled()

    monkeypatch.setattr(CheckRequest, "judged", interrupting)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            ph.check(RIGHT, gyroscope)
    finally:
        signal.signal(signal.SIGINT, before)
    assert not _limited_check._idle


def test_a_motion_can_be_followed_there_after_one_was_followed_here():
    roll = PROBLEM_SET["rolling-disk"].build()
    start = {"theta": "70 deg", "omega_3": "20 rad/s"}

    def tilt(duration):
        run = ph.simulate(roll, {"m": 1, "a": 1, "g": 9.81}, start, duration)
        return float(run.evaluate("theta", 0.1))

    here = tilt("0.2 s")
    assert within(60, lambda tell: tilt("0.3 s"), advice="") == pytest.approx(here, rel=1e-12)


def test_what_is_open_is_not_held_open_by_the_process_that_judges():
    """Who reads from a pipe of ours hears of its end, though a copy of us waits for claims."""
    anew = ph.derive(PROBLEM_SET["gyroscope"].build())
    reading, writing = os.pipe()
    assert ph.check(RIGHT, anew).answer is Answer.HOLDS
    os.close(writing)
    ready, _, _ = select([reading], [], [], 60.0)
    assert ready
    assert os.read(reading, 1) == b""
    os.close(reading)
