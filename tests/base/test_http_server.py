"""Clients that send nothing, half a request, or take no response hold neither server nor others.

Sockets on this machine. Where a server is to close a connection by the clock, its time is short and
that of the test is long; where another connection is to give way, no clock is involved.
"""

import asyncio
import socket
import threading
from contextlib import ExitStack, closing, contextmanager, suppress

import pytest

pytest.importorskip("uvicorn")

from polhode.base.http import HungUpError, LimitedRequests, while_connected
from polhode.base.http_server import server_of

LONG = 120.0  # s within which something is seen to happen, on a machine that has other work
NEVER = 3600.0
SHORT = 0.2
LARGE = 50_000_000  # bytes, more than sockets hold
ASK = b"GET / HTTP/1.1\r\nhost: x\r\n\r\n"


async def application(scope, receive, send):
    """Answers at once; at /large with more than a client takes without reading."""
    if scope["type"] == "lifespan":
        while True:
            message = await receive()
            await send({"type": f"{message['type']}.complete"})
            if message["type"] == "lifespan.shutdown":
                return
    body = b"x" * (LARGE if scope["path"] == "/large" else 2)
    headers = [(b"content-length", str(len(body)).encode())]
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    await send({"type": "http.response.body", "body": body})


@contextmanager
def served(connections=100, headers_within=NEVER, taken_within=NEVER, app=application):
    """A server in a thread, as a function that connects to it."""
    server = server_of(app, connections, headers_within, taken_within)
    with closing(socket.create_server(("127.0.0.1", 0))) as listener, ExitStack() as lines:
        port = listener.getsockname()[1]
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()

        def connected():
            return lines.enter_context(socket.create_connection(("127.0.0.1", port), timeout=LONG))

        yield connected
        server.should_exit = True
        lines.close()
        thread.join(LONG)
        assert not thread.is_alive()


def is_closed(line):
    """Whether the server closes a connection, waited for."""
    try:
        while line.recv(65536):
            pass
    except ConnectionError:
        return True
    return True  # a connection that stays open ends the test with TimeoutError


def answered(line, request=ASK):
    """What comes back, to the end of the body."""
    line.sendall(request)
    reply = b""
    while not reply.endswith(b"\r\n\r\nxx"):
        part = line.recv(65536)
        assert part, reply
        reply += part
    return reply


@pytest.mark.parametrize("begun", [b"", b"GET", ASK[:-2], b"POST / HTTP/1.1\r\nhost: x\r\n"])
def test_a_request_that_does_not_arrive_ends_its_connection(begun):
    with served(headers_within=SHORT) as connected:
        line = connected()
        line.sendall(begun)
        assert is_closed(line)


def test_the_time_is_not_extended_by_what_arrives():
    with served(headers_within=SHORT) as connected:
        line = connected()
        line.sendall(b"GET / HTTP/1.1\r\n")
        line.setblocking(False)
        for _ in range(int(LONG / 0.01)):
            try:
                line.sendall(b"a: b\r\n")
                assert line.recv(1) == b""  # the end of the connection
                return
            except BlockingIOError:
                threading.Event().wait(0.01)
            except ConnectionError:
                return
        raise AssertionError("the connection stays open")


def test_a_body_behind_its_answer_does_not_keep_the_connection():
    with served(headers_within=SHORT) as connected:
        line = connected()
        line.sendall(b"GET / HTTP/1.1\r\nhost: x\r\ncontent-length: 1000000\r\n\r\n")
        assert b"200 OK" in line.recv(65536)
        assert is_closed(line)


def test_several_requests_of_one_connection_are_answered():
    with served() as connected:
        line = connected()
        assert [b"200 OK" in answered(line) for _ in range(5)] == [True] * 5


def taken_after(connected, seconds):
    """Bytes of a large response of which one was read, and the others this much later."""
    line = connected()
    line.sendall(ASK.replace(b"/ ", b"/large "))
    assert line.recv(1) == b"H"
    threading.Event().wait(seconds)
    # What is in the sockets can still be read.
    taken = 1
    with suppress(ConnectionError):
        while part := line.recv(1 << 20):
            taken += len(part)
    return taken


def test_a_response_that_is_not_taken_ends_its_connection():
    """What comes is not the whole; on a busy machine the server may notice late."""
    with served(taken_within=SHORT) as connected:
        assert any(taken_after(connected, times * SHORT) < LARGE for times in (2, 10, 50))


def test_a_large_response_that_is_taken_comes_whole():
    with served(headers_within=NEVER, taken_within=NEVER) as connected:
        line = connected()
        line.sendall(ASK.replace(b"/ ", b"/large ").replace(b"host", b"connection: close\r\nhost"))
        taken = 0
        while part := line.recv(1 << 20):
            taken += len(part)
        assert taken > LARGE


def test_the_connection_that_has_waited_longest_gives_way():
    with served(connections=4) as connected:
        first = connected()
        first.sendall(ASK[:-2])
        others = [connected() for _ in range(3)]
        for line in others:
            assert b"200 OK" in answered(line)  # so that it waits for less time than the first
        for _ in range(3):
            assert b"200 OK" in answered(connected())
        assert is_closed(first)


def test_half_open_connections_keep_nobody_out():
    with served(connections=8) as connected:
        half = [connected() for _ in range(100)]
        for line in half:
            with suppress(ConnectionError):  # it has given way already
                line.sendall(ASK[:-2])
        assert b"200 OK" in answered(connected())


# -- clients that hang up, and a server that stops -------------------------------------------------


class Unlimited(LimitedRequests):
    def refusal(self, scope):
        return None

    def problem(self, status, given):
        async def told(scope, receive, send):
            await send({"type": "http.response.start", "status": status, "headers": []})
            await send({"type": "http.response.body", "body": given.encode()})

        return told


def test_work_is_cancelled_when_the_client_hangs_up():
    begun, ended = threading.Event(), threading.Event()

    async def work():
        begun.set()
        try:
            await asyncio.Event().wait()
        finally:
            ended.set()

    async def asked(scope, receive, send):
        if scope["type"] == "lifespan":
            await application(scope, receive, send)
        try:
            await while_connected(receive, work())
        except HungUpError:
            return

    app = Unlimited(asked, 1000, LONG, 10)
    with served(app=app) as connected:
        line = connected()
        line.sendall(b"POST / HTTP/1.1\r\nhost: x\r\ncontent-length: 2\r\n\r\nab")
        assert begun.wait(LONG)
        assert not ended.is_set()
        line.close()
        assert ended.wait(LONG)


def test_a_server_that_stops_says_so_to_those_who_wait():
    begun = threading.Event()

    async def asked(scope, receive, send):
        if scope["type"] == "lifespan":
            await application(scope, receive, send)
        begun.set()
        await asyncio.Event().wait()

    server = server_of(Unlimited(asked, 1000, LONG, 10), 10)
    with closing(socket.create_server(("127.0.0.1", 0))) as listener:
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()
        line = socket.create_connection(listener.getsockname(), timeout=LONG)
        line.sendall(b"POST / HTTP/1.1\r\nhost: x\r\ncontent-length: 2\r\n\r\nab")
        assert begun.wait(LONG)
        server.should_exit = True
        assert b"503" in line.recv(65536)
        line.close()
        thread.join(LONG)
        assert not thread.is_alive()
