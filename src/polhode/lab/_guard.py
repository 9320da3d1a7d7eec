"""Which requests are accepted: from the lab's own page on this machine, and of limited size."""

from __future__ import annotations

from dataclasses import dataclass

from starlette.datastructures import Headers
from starlette.responses import JSONResponse

from polhode.base.http import (
    Application,
    LimitedRequests,
    Message,
    Receive,
    Scope,
    Send,
    raw_headers,
)

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
        longest_wait: s that one may wait for earlier ones about the same.
    """

    body: int = 150_000
    arriving: float = 5.0
    motion: float = 30.0
    thought: float = 60.0
    file: float = 240.0
    waiting: int = 24
    longest_wait: float = 60.0


class RequestGuard(LimitedRequests):
    """Refuses foreign hosts and origins, large and slow bodies, and too many requests.

    Args:
        app: receives the accepted requests.
        port: at which the server listens.
        limits: on one request.
    """

    def __init__(self, app: Application, port: int, limits: Limits) -> None:
        super().__init__(_with_headers(app), limits.body, limits.arriving, limits.waiting)
        self._hosts = {f"{name}:{port}" for name in _NAMES}
        if port == 80:
            self._hosts |= set(_NAMES)

    def refusal(self, scope: Scope) -> Application | None:
        """The response to requests that do not come from the lab's own page."""
        headers = Headers(scope=scope)
        hosts, origins = headers.getlist("host"), headers.getlist("origin")
        if len(hosts) != 1 or hosts[0].lower() not in self._hosts:
            return self.problem(403, "a host that is not this machine")
        if any(origin.lower() != f"http://{hosts[0].lower()}" for origin in origins):
            return self.problem(403, "an origin that is not this lab")
        if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
            return self.problem(403, "a request from another site")
        kind = headers.get("content-type", "").split(";")[0].strip().lower()
        if scope["method"] == "POST" and kind != "application/json":
            return self.problem(415, "a body that is not JSON")
        return None

    def problem(self, status: int, given: str) -> Application:
        """The response that tells the page what was wrong."""
        problem = {"given": given, "expected": "a request of the lab's own page", "advice": ""}
        return JSONResponse(problem, status, {**HEADERS, "connection": "close"})


def _with_headers(app: Application) -> Application:
    """An application whose responses have the headers that protect the page."""

    async def protected(scope: Scope, receive: Receive, send: Send) -> None:
        async def with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", []), *raw_headers(HEADERS.items())]
            await send(message)

        await app(scope, receive, with_headers)

    return protected
