"""Answers wait for a worker no longer than they may, nor than someone waits for them.

Real sockets, and workers that answer when the test lets them: no clock decides but where an answer
waits as long as it may, and then the worker is never let go.
"""

import json
import signal
import socket
import subprocess
import sys
import threading
from contextlib import ExitStack, closing, contextmanager

import pytest

pytest.importorskip("uvicorn")

from polhode.base.http_server import server_of
from polhode.catalogue import PROBLEM_SET
from polhode.judge._review_worker import ReviewRecord
from polhode.judge.service import MarkedAnswer, ServiceSettings, _pool
from polhode.judge.service._app import app_of

LONG = 120.0  # s within which something is seen to happen, on a machine that has other work
SYSTEM = PROBLEM_SET["rolling-disk"].build()


class Seats:
    """Stands in for workers; they answer once the test lets them."""

    def __init__(self):
        self.asked = []
        self.is_busy = threading.Event()
        self.let_go = threading.Event()
        self.is_ready = threading.Event()
        self.is_ready.set()

    def __call__(self, system):
        return Seat(self)

    def end(self):
        self.let_go.set()
        self.is_ready.set()


class Seat:
    pid = 1

    def __init__(self, seats):
        self._seats = seats

    def ask(self, task, seconds):
        self._seats.asked.append(task.text)
        self._seats.is_busy.set()
        assert self._seats.let_go.wait(LONG)
        return MarkedAnswer(ReviewRecord(), is_correct=True, is_judged=True)

    def is_ready(self):
        return self._seats.is_ready.wait(LONG)

    def kill(self):
        pass

    def end(self):
        self._seats.end()


class Service:
    """What a platform sees of a service."""

    def __init__(self, port, lines):
        self._port, self._lines = port, lines

    def sent(self, text):
        """A connection over which an answer was sent."""
        body = json.dumps({"text": text}).encode()
        return self._asked(b"POST / HTTP/1.1\r\nhost: x\r\ncontent-length: %d\r\n\r\n%s", body)

    def _asked(self, form, body=b""):
        address = ("127.0.0.1", self._port)
        line = self._lines.enter_context(socket.create_connection(address, timeout=LONG))
        line.sendall(form % (len(body), body) if body else form)
        return line

    def health(self):
        return reply(self._asked(b"GET /health HTTP/1.1\r\nhost: x\r\n\r\n"))[1]

    def until(self, waiting, **others):
        """Until so many answers wait."""
        for _ in range(int(LONG / 0.02)):
            if self.health().items() >= {"waiting": waiting, **others}.items():
                return
            threading.Event().wait(0.02)
        raise AssertionError(self.health())


def reply(line):
    """Status and content."""
    found = b""
    while True:
        head, is_whole, body = found.partition(b"\r\n\r\n")
        if is_whole:
            length = next(r for r in head.lower().splitlines() if r.startswith(b"content-length"))
            if len(body) >= int(length.split()[1]):
                return int(head.split()[1]), json.loads(body)
        part = line.recv(65536)
        assert part, found
        found += part


@contextmanager
def service(monkeypatch, seats=None, **settings):
    seats = seats or Seats()
    monkeypatch.setattr(_pool, "_AnsweringSeat", seats)
    app = app_of(SYSTEM, ServiceSettings(workers=1, seconds=LONG, **settings))
    server = server_of(app, 100)
    with closing(socket.create_server(("127.0.0.1", 0))) as listener, ExitStack() as lines:
        run = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        run.start()
        yield Service(listener.getsockname()[1], lines), seats
        seats.end()
        server.should_exit = True
        lines.close()
        run.join(LONG)
        assert not run.is_alive()


def test_answers_that_nobody_waits_for_leave_the_queue(monkeypatch):
    with service(monkeypatch, longest_wait=3600.0) as (platform, seats):
        first = platform.sent("first")
        assert seats.is_busy.wait(LONG)
        abandoned = [platform.sent(f"abandoned {n}") for n in range(5)]
        platform.until(waiting=5)
        for line in abandoned:
            line.close()
        platform.until(waiting=0)
        last = platform.sent("last")
        platform.until(waiting=1)
        seats.let_go.set()
        assert reply(first)[1]["is_correct"]
        assert reply(last)[1]["is_correct"]
        assert seats.asked == ["first", "last"]


def test_one_who_hangs_up_does_not_lose_the_worker_for_others(monkeypatch):
    with service(monkeypatch, longest_wait=3600.0) as (platform, seats):
        abandoned = platform.sent("abandoned")
        assert seats.is_busy.wait(LONG)
        abandoned.close()
        kept = platform.sent("kept")
        platform.until(waiting=1)
        seats.let_go.set()
        assert reply(kept)[1]["is_correct"]


def test_an_answer_that_has_waited_long_enough_is_turned_away(monkeypatch):
    with service(monkeypatch, longest_wait=0.2) as (platform, seats):
        kept = platform.sent("kept")
        assert seats.is_busy.wait(LONG)
        for _ in range(3):
            status, told = reply(platform.sent("too late"))
            assert status == 503
            assert "try again" in told["error"]["message"]
        assert not seats.let_go.is_set()
        assert platform.health()["waiting"] == 0
        seats.let_go.set()
        assert reply(kept)[1]["is_correct"]
        assert reply(platform.sent("next"))[1]["is_correct"]


def test_health_says_that_no_worker_is_ready_yet(monkeypatch):
    seats = Seats()
    seats.is_ready.clear()
    with service(monkeypatch, seats, longest_wait=3600.0) as (platform, _):
        early = platform.sent("early")
        platform.until(waiting=1, status="starting")
        seats.is_ready.set()
        seats.let_go.set()
        assert reply(early)[1]["is_correct"]
        platform.until(waiting=0, status="ok")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_service_that_is_ended_while_answers_wait_is_quiet(number):
    with closing(socket.create_server(("127.0.0.1", 0))) as free:
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "polhode", "serve-marks", "--system", "rolling-disk"]
    command += ["--port", str(port), "--workers", "1"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    slow = "\n\n".join(rf"$V = m g a \sin\theta + {n} - {n}$" for n in range(400))
    with subprocess.Popen(command, **pipes) as run, ExitStack() as lines:
        assert f":{port}/" in run.stdout.readline()
        platform = Service(port, lines)
        asked = [platform.sent(slow) for _ in range(4)]
        platform.until(waiting=3)
        run.send_signal(number)
        assert [reply(line)[0] for line in asked] == [503] * 4
        out, err = run.communicate(timeout=LONG)
    assert (out, err) == ("", "")
    assert run.returncode == (0 if number == signal.SIGINT else -signal.SIGTERM)
