"""A web server whose clients cannot hold it: uvicorn, with limits on connections that it lacks.

uvicorn limits the time of a connection between two requests, but neither the time in which the
headers of a request arrive, nor that in which a client takes a response. Connections that wait for
a request also give way to new ones, so that no number of them keeps others out.
"""

from __future__ import annotations

import asyncio
import logging
import socket
from contextlib import suppress
from typing import Any

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

HEADERS_WITHIN = 10.0  # s in which a request has to begin, with all its headers
TAKEN_WITHIN = 30.0  # s in which a client has to take what is ready for it
_GRACE = 1  # s for running requests to finish when the server stops


def serve_application(app: Any, listener: socket.socket, connections: int) -> None:
    """Serve an ASGI application until the process is interrupted or terminated.

    Args:
        app: the application.
        listener: a socket that listens.
        connections: at a time.
    """
    server = server_of(app, connections)
    log = logging.getLogger("uvicorn.error")

    def is_told(record: logging.LogRecord) -> bool:
        return not server.should_exit  # requests dropped because the server stops are no errors

    log.addFilter(is_told)
    try:
        with suppress(KeyboardInterrupt):  # the usual way to stop it
            server.run(sockets=[listener])
    finally:
        log.removeFilter(is_told)


def server_of(
    app: Any,
    connections: int,
    headers_within: float = HEADERS_WITHIN,
    taken_within: float = TAKEN_WITHIN,
) -> uvicorn.Server:
    """The server of `serve_application`.

    Args:
        app: an ASGI application.
        connections: at a time; with more, the one that has waited longest for a request is closed.
        headers_within: s in which a request has to begin, with all its headers.
        taken_within: s in which a client has to take what is ready for it.
    """
    config = uvicorn.Config(
        app,
        http=_connection_class(connections, headers_within, taken_within),
        ws="none",
        log_level="error",  # warnings are of what clients send
        limit_concurrency=connections + 1,  # for the case that none of them waits for a request
        timeout_graceful_shutdown=_GRACE,
        server_header=False,
    )
    return uvicorn.Server(config)


def _connection_class(
    most: int, headers_within: float, taken_within: float
) -> type[asyncio.Protocol]:
    waiting: dict[_Connection, None] = {}  # for a request, the longest first

    class LimitedConnection(_Connection):
        """A connection with these limits, which shares them with the others of its server."""

        limits = most, headers_within, taken_within
        without_request = waiting

    return LimitedConnection


class _Connection(H11Protocol):
    """A connection that is closed when its client keeps it waiting."""

    limits: tuple[int, float, float]
    without_request: dict[_Connection, None]
    _overdue: asyncio.TimerHandle | None = None
    _untaken: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait; one that has done so for longest gives way where there are too many."""
        super().connection_made(transport)
        self._note()
        longest = next(iter(self.without_request))
        if len(self.connections) > self.limits[0] and longest is not self:
            longest.transport.abort()
            # Its end is noted later, perhaps after that of others has been asked for.
            self.without_request.pop(longest)
            self.connections.discard(longest)

    def data_received(self, data: bytes) -> None:
        """Part of a request."""
        super().data_received(data)
        self._note()

    def on_response_complete(self) -> None:
        """The end of a response, behind which another request may come."""
        super().on_response_complete()
        self._note()

    def pause_writing(self) -> None:
        """The client does not take what is ready for it."""
        super().pause_writing()
        self._untaken = self._untaken or self.loop.call_later(self.limits[2], self.transport.abort)

    def resume_writing(self) -> None:
        """It takes it again."""
        super().resume_writing()
        if self._untaken is not None:
            self._untaken.cancel()
            self._untaken = None

    def connection_lost(self, exc: Exception | None) -> None:
        """The end."""
        for timer in (self._overdue, self._untaken):
            if timer is not None:
                timer.cancel()
        self.without_request.pop(self, None)
        super().connection_lost(exc)

    def _note(self) -> None:
        """Note whether it waits for a request: its headers, or the client's taking the response.

        The time is counted from when the wait begins, whatever arrives meanwhile.
        """
        cycle: Any = self.cycle
        if cycle is None or cycle.response_complete:
            if self._overdue is None:
                self._overdue = self.loop.call_later(self.limits[1], self.transport.abort)
                self.without_request[self] = None
        elif self._overdue is not None:
            self._overdue.cancel()
            self._overdue = None
            self.without_request.pop(self, None)
