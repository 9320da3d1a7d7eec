"""The service as a web application: one endpoint for answers, and one for its health."""

from __future__ import annotations

import hmac
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from typing import Any

from starlette.applications import Starlette
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from polhode.base import PolhodeError
from polhode.base.http import (
    Application,
    HungUpError,
    LimitedRequests,
    Scope,
    json_object,
    while_connected,
)
from polhode.judge.service._platforms import previewed, reply_to, task_of
from polhode.judge.service._pool import TRIAL, BusyError, MarksPool
from polhode.judge.service._settings import ServiceSettings
from polhode.model import System

_COMMANDS = ("eval", "preview", "healthcheck")
_HEADERS = {"x-content-type-options": "nosniff", "cache-control": "no-store"}


def app_of(system: System, settings: ServiceSettings | None = None) -> Starlette:
    """The application.

    Args:
        system: that every answer is about.
        settings: limits, and how much is shown.
    """
    limits = settings or ServiceSettings()
    pool = MarksPool(system, limits)

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        pool.begin()
        try:
            yield
        finally:
            pool.end()

    async def answer(request: Request) -> Response:
        return await _answer(request, pool, limits)

    async def health(request: Request) -> Response:
        workers = len(pool.pids)
        state = {
            "status": "ok" if pool.has_begun else "starting",
            "system": system.name,
            "workers": workers,
            "waiting": pool.waiting,
        }
        return JSONResponse(state, headers=_HEADERS)

    return Starlette(
        routes=[Route("/", answer, methods=["POST"]), Route("/health", health)],
        middleware=[Middleware(ServiceGuard, settings=limits)],
        exception_handlers={HTTPException: _refused, Exception: _failed},
        lifespan=lifespan,
    )


async def _answer(request: Request, pool: MarksPool, settings: ServiceSettings) -> Response:
    raw = await request.body()
    try:
        body = json_object(raw) if raw else {}
        command = str(body.get("command") or request.headers.get("command") or "eval")
        if command == "healthcheck":
            return _reply(await while_connected(request.receive, _healthcheck(pool)))
        if command == "preview":
            return _reply(previewed(body, settings))
        if command != "eval":
            return _problem(400, f"command {command[:40]!r}", f"one of {', '.join(_COMMANDS)}")
        marking = pool.marked(task_of(body, settings))
        marked = await while_connected(request.receive, marking)
    except PolhodeError as error:
        return _problem(400, error.given, error.expected, error.advice)
    except BusyError:
        return _problem(503, "too many answers at a time", advice="try again in a moment")
    except HungUpError:
        return _problem(499, "a request that was called off")  # 499: nginx's code for this
    return _reply(reply_to(body, marked))


async def _healthcheck(pool: MarksPool) -> dict[str, Any]:
    """The reply to lambdafeedback's command of that name, after a trial."""
    marked = await pool.marked(TRIAL)
    name = {"name": "an identity is judged"}
    tests = {
        "tests_passed": marked.is_judged,
        "successes": [name] if marked.is_judged else [],
        "failures": [] if marked.is_judged else [name],
        "errors": [],
    }
    return {"command": "healthcheck", "result": tests}


def _reply(content: Mapping[str, Any]) -> JSONResponse:
    return JSONResponse(content, headers=_HEADERS)


def _problem(status: int, given: str, expected: str = "", advice: str = "") -> JSONResponse:
    message = "; ".join(filter(None, [given, expected and f"expected {expected}", advice]))
    return JSONResponse({"error": {"message": message}}, status_code=status, headers=_HEADERS)


async def _refused(request: Request, error: Any) -> Response:
    return _problem(error.status_code, "nothing there", "POST to /, or GET of /health")


async def _failed(request: Request, error: Exception) -> Response:
    return _problem(500, "an unexpected error of the service", advice="please report it")


class ServiceGuard(LimitedRequests):
    """Refuses requests of web pages, without the key, and large, slow or many ones.

    Args:
        app: receives the accepted requests.
        settings: limits.
    """

    def __init__(self, app: Application, settings: ServiceSettings) -> None:
        most = 2 * (settings.waiting + settings.workers)
        super().__init__(app, settings.body, settings.arriving, most)
        self._key = settings.key

    def refusal(self, scope: Scope) -> Application | None:
        """The response to requests of pages, and to those without the key."""
        headers = Headers(scope=scope)
        # A page of any site could make a browser within the network send requests.
        if "origin" in headers or headers.get("sec-fetch-site", "none") not in ("none",):
            return _problem(403, "a request of a web page", "one of a learning platform's server")
        shown = headers.get("authorization", "").removeprefix("Bearer ")
        # Headers are bytes, which Starlette reads as Latin-1.
        if self._key and not hmac.compare_digest(shown.encode("latin-1"), self._key.encode()):
            return _problem(401, "a request without the key", "Authorization: Bearer KEY")
        return None

    def problem(self, status: int, given: str) -> Application:
        """The response that tells what was wrong."""
        return _problem(status, given, advice="try again in a moment" if status == 503 else "")
