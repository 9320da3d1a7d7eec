"""What local servers share: strict JSON, requests within limits, a socket to listen at.

It needs no package beyond the standard library; messages are those of ASGI.
"""

from __future__ import annotations

import asyncio
import json
import socket
from abc import ABC, abstractmethod
from collections.abc import Awaitable, Callable, Coroutine, Iterable, MutableMapping
from typing import Any, NoReturn, TypeVar

from polhode.base._errors import ParseError, StoreError

Result = TypeVar("Result")
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Scope = MutableMapping[str, Any]
Send = Callable[[Message], Awaitable[None]]
#: An application, or a response, of ASGI.
Application = Callable[[Scope, Receive, Send], Awaitable[None]]


def listening_socket(host: str, ports: Iterable[int]) -> socket.socket:
    """A socket bound to the first of these ports that is free; 0 is any free one.

    Raises:
        StoreError: where none is.
    """
    reason, port = "", 0
    for port in ports:
        listener = socket.socket()
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host, port))
            return listener
        except OSError as error:
            listener.close()
            reason = error.strerror or str(error)
    where = "this machine" if host == "127.0.0.1" else host
    raise StoreError(
        f"port {port} of {where} ({reason})",
        expected="a free port",
        advice="choose another one, or leave it out",
        option="port",
    )


# -- JSON of strangers -----------------------------------------------------------------------------


def json_object(body: bytes) -> dict[str, Any]:
    """The members of a JSON object, without NaN, infinities and repeated names.

    Raises:
        ParseError: for anything else.
    """
    try:
        document = json.loads(
            body.decode("utf-8"), parse_constant=_no_number, object_pairs_hook=_once
        )
    except (ValueError, RecursionError) as error:
        raise ParseError("a request that is not JSON", expected="a JSON object") from error
    if not isinstance(document, dict):
        raise ParseError("a request that is not a JSON object", expected="a JSON object")
    return document


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("a name comes twice")
    return found


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a number in JSON")


# -- requests within limits ------------------------------------------------------------------------


class LimitedRequests(ABC):
    """An ASGI application that passes on to another the requests that it accepts.

    Args:
        app: receives the accepted requests, with bodies that have arrived whole.
        body: bytes of a body at most.
        arriving: s within which it has to arrive.
        most: requests with bodies at a time; they are read before they are worked on.
    """

    def __init__(self, app: Application, body: int, arriving: float, most: int) -> None:
        self._app = app
        self._body = body
        self._arriving = arriving
        self._most = most
        self._inside = 0

    @abstractmethod
    def refusal(self, scope: Scope) -> Application | None:
        """The response to a request that is refused by its headers."""

    @abstractmethod
    def problem(self, status: int, given: str) -> Application:
        """The response that tells a problem."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on a request that is accepted."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            return
        refusal = self.refusal(scope)
        if refusal is None and scope["method"] != "POST":  # no body: it tells how the server is
            await self._app(scope, receive, send)
            return
        refusal = refusal or self._excess(scope)
        if refusal is not None:
            await refusal(scope, receive, send)
            return
        self._inside += 1
        try:
            await self._pass(scope, receive, send)
        finally:
            self._inside -= 1

    def _excess(self, scope: Scope) -> Application | None:
        if self._inside >= self._most:
            return self.problem(503, "too many requests at a time")
        length = dict(scope["headers"]).get(b"content-length", b"0")
        if not length.isdigit() or int(length[:20]) > self._body:
            return self._too_large()
        return None

    def _too_large(self) -> Application:
        return self.problem(413, f"a body of more than {self._body} bytes")

    async def _pass(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            body = await whole_body(receive, self._body, self._arriving)
        except TimeoutError:
            await self.problem(408, "a body that does not arrive in time")(scope, receive, send)
            return
        if body is None:
            await self._too_large()(scope, receive, send)
            return
        has_begun = False

        async def noted(message: Message) -> None:
            nonlocal has_begun
            has_begun = True
            await send(message)

        try:
            await self._app(scope, replayed(body, receive), noted)
        except asyncio.CancelledError:  # the server cancels what is left when it stops
            if has_begun:
                raise
            await self.problem(503, "a request to a server that is stopping")(scope, receive, send)


# -- clients that hang up --------------------------------------------------------------------------


class HungUpError(Exception):
    """The client has closed its connection."""


async def hang_up(receive: Receive) -> None:
    """Wait until the client closes its connection; the body of its request has been read."""
    while (await receive())["type"] != "http.disconnect":
        pass


async def while_connected(receive: Receive, work: Coroutine[Any, Any, Result]) -> Result:
    """The result of some work, which is cancelled when the client hangs up.

    Raises:
        HungUpError: where it did.
    """
    task = asyncio.create_task(work)
    gone = asyncio.create_task(hang_up(receive))
    try:
        await asyncio.wait({task, gone}, return_when=asyncio.FIRST_COMPLETED)
        if not task.done():
            raise HungUpError
        return task.result()
    finally:
        task.cancel()
        gone.cancel()


async def whole_body(receive: Receive, most: int, seconds: float) -> bytes | None:
    """The body of a request; None if it is larger than `most` bytes.

    Raises:
        TimeoutError: where it has not arrived within so many seconds.
    """
    body = bytearray()
    more = True
    async with asyncio.timeout(seconds):
        while more:
            message = await receive()
            body += message.get("body", b"")
            more = message.get("more_body", False)
            if len(body) > most:
                return None
    return bytes(body)


def replayed(body: bytes, receive: Receive) -> Receive:
    """Messages with the body that has already been read, followed by those after it."""
    rest = iter([{"type": "http.request", "body": body, "more_body": False}])

    async def next_message() -> Message:
        return next(rest, None) or await receive()

    return next_message


def raw_headers(headers: Iterable[tuple[str, str]]) -> list[tuple[bytes, bytes]]:
    """Headers as messages have them."""
    return [(name.encode("latin-1"), value.encode("latin-1")) for name, value in headers]
