"""No process is left of a judgement that nobody waits for, however the one who asked was ended."""

import json
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

SUMS = [
    "+".join(rf"\cosh({one}{other})" for one in ("M", "a", "g", r"\omega_1"))
    for other in (r"\theta", r"\phi", "I_1")
]
ENDLESS = "".join(rf"\frac{{1}}{{{unlike}}}" for unlike in SUMS) + "= 0"
POLHODE = (sys.executable, "-m", "polhode")
LONG = 60.0  # s within which what ends is seen to end, on a machine that has other work

pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="no /proc to look in")


def started(*words):
    """A command as the first process of a session of its own."""
    return subprocess.Popen(
        (*POLHODE, *words),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def alive(session):
    """Processes of a session, with the processor time that each has taken, in ticks."""
    found = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found[int(stat.parent.name)] = int(fields[11]) + int(fields[12])
    return found


def until(condition):
    end = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.1)


def busy(session, but=()):
    """Whether a process of a session computes."""
    before = alive(session)
    time.sleep(1.0)
    return any(
        ticks - before.get(number, ticks) > 5
        for number, ticks in alive(session).items()
        if number not in but
    )


def asked(port):
    """A judgement that takes for ever, asked for."""
    body = json.dumps({"system": "gyroscope", "latex": ENDLESS, "context": "motion"}).encode()
    here = f"127.0.0.1:{port}"
    head = f"POST /api/check HTTP/1.1\r\nHost: {here}\r\nOrigin: http://{here}\r\n"
    head += f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
    connection = socket.create_connection(("127.0.0.1", port))
    connection.sendall(head.encode() + body)
    return connection


@pytest.fixture
def lab():
    """A lab that is at a judgement, and the connection that this was asked through."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    server = started("lab", "--no-browser", "--port", str(port))
    assert "The lab is at" in server.stdout.readline()
    connection = asked(port)
    time.sleep(3.0)  # until the processes that get ready have done so
    until(lambda: busy(server.pid))
    yield server, connection
    server.kill()
    server.communicate()
    connection.close()


def test_a_judgement_is_given_up_when_the_one_who_asked_leaves(lab):
    server, connection = lab
    connection.close()
    until(lambda: not busy(server.pid))
    assert server.poll() is None


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_a_lab_that_is_ended_leaves_no_process(lab, number):
    server, _ = lab
    server.send_signal(number)
    _, told = server.communicate()
    assert told == ""
    until(lambda: not alive(server.pid))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_a_check_that_is_ended_leaves_no_process(number):
    check = started("check", "gyroscope", ENDLESS)
    until(lambda: len(alive(check.pid)) > 1 and busy(check.pid, but=[check.pid]))
    check.send_signal(number)
    check.wait()
    until(lambda: not alive(check.pid))
    assert "Traceback" not in check.communicate()[1]
