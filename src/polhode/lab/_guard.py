"""Which requests are accepted: from the lab's own page on this machine, and of limited size."""

from __future__ import annotations

import json
from dataclasses import dataclass

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from polhode.base.http import raw_headers, replayed, whole_body

# Any page in the browser can send requests to a local server. The host check stops DNS rebinding,
# the origin checks stop requests of other sites, and the policy keeps scripts out of the page.
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "content-security-policy": _POLICY,
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
    "cache-control": "no-store",
}
_NAMES = ("127.0.0.1", "localhost", "[::1]")


@dataclass(frozen=True)
class Limits:
    """Limits on one request.

    Attributes:
        body: bytes.
        arriving: s within which the body has to arrive.
        motion: s for a simulation.
        thought: s for checking a claim, or an analysis.
        file: s for writing a file, such as a movie.
        waiting: requests at a time.
    """

    body: int = 150_000
    arriving: float = 5.0
    motion: float = 30.0
    thought: float = 60.0
    file: float = 240.0
    waiting: int = 24


class RequestGuard:
    """Refuses foreign hosts and origins, large and slow bodies, and too many requests.

    Args:
        app: receives the accepted requests.
        port: at which the server listens.
        limits: on one request.
    """

    def __init__(self, app: ASGIApp, port: int, limits: Limits) -> None:
        self._app = app
        self._hosts = {f"{name}:{port}" for name in _NAMES}
        if port == 80:
            self._hosts |= set(_NAMES)
        self._limits = limits
        self._inside = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on a request that is accepted."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":
            return
        refusal = self._refusal(scope["method"], Headers(scope=scope))
        if refusal:
            await _refuse(send, *refusal)
            return
        self._inside += 1
        try:
            await self._pass(scope, receive, send)
        finally:
            self._inside -= 1

    def _refusal(self, method: str, headers: Headers) -> tuple[int, str] | None:
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return 403, "a host that is not this machine"
        if any(origin.lower() != f"http://{hosts[0].lower()}" for origin in origins):
            return 403, "an origin that is not this lab"
        if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
            return 403, "a request from another site"
        if self._inside >= self._limits.waiting:
            return 503, "too many requests at a time"
        if method == "POST":
            if headers.get("content-type", "").split(";")[0].strip().lower() != "application/json":
                return 415, "a body that is not JSON"
            length = headers.get("content-length", "0")
            if not (length.isascii() and length.isdigit()) or int(length[:20]) > self._limits.body:
                return 413, f"a body of more than {self._limits.body} bytes"
            return None
        return None

    async def _pass(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", []), *raw_headers(HEADERS.items())]
            await send(message)

        if scope["method"] != "POST":
            await self._app(scope, receive, with_headers)
            return
        try:
            body = await whole_body(receive, self._limits.body, self._limits.arriving)
        except TimeoutError:
            await _refuse(send, 408, "a body that does not arrive in time")
            return
        if body is None:
            await _refuse(send, 413, f"a body of more than {self._limits.body} bytes")
            return
        await self._app(scope, replayed(body, receive), with_headers)


async def _refuse(send: Send, status: int, given: str) -> None:
    problem = {"given": given, "expected": "a request of the lab's own page", "advice": ""}
    headers = {**HEADERS, "content-type": "application/json", "connection": "close"}
    start = {
        "type": "http.response.start",
        "status": status,
        "headers": raw_headers(headers.items()),
    }
    await send(start)
    await send({"type": "http.response.body", "body": json.dumps(problem).encode()})
