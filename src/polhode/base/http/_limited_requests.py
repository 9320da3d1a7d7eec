"""Requests within limits: of a number at a time, with bodies of limited size, in good time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

from polhode.base.http._bodies import Message, Receive, replayed, whole_body

Scope = MutableMapping[str, Any]
Send = Callable[[Message], Awaitable[None]]
#: An application, or a response, of ASGI.
Application = Callable[[Scope, Receive, Send], Awaitable[None]]


class LimitedRequests(ABC):
    """An ASGI application that passes on to another the requests that it accepts.

    Args:
        app: receives the accepted requests, with bodies that have arrived whole.
        body: bytes of a body at most.
        arriving: s within which it has to arrive.
        most: requests at a time; bodies are read before they are worked on.
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
        refusal = self.refusal(scope) or self._excess(scope)
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
        if scope["method"] != "POST":
            await self._app(scope, receive, send)
            return
        try:
            body = await whole_body(receive, self._body, self._arriving)
        except TimeoutError:
            await self.problem(408, "a body that does not arrive in time")(scope, receive, send)
            return
        if body is None:
            await self._too_large()(scope, receive, send)
            return
        await self._app(scope, replayed(body, receive), send)
