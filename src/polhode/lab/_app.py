"""The lab as a web application."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from html import escape
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Route

from polhode.base import PolhodeError
from polhode.base.http import hang_up
from polhode.lab._files import KINDS, PAGE, built
from polhode.lab._guard import Limits, RequestGuard
from polhode.lab._offer import Own, offered
from polhode.lab._requests import Fields
from polhode.lab._workers import (
    DONE,
    BrokenError,
    BusyError,
    GoneError,
    TooLongError,
    WorkerPool,
)

# By task, the kind of worker that does it: slow analyses must not delay the motion on display.
_PURPOSES = {
    "describe": "motion",
    "run": "motion",
    "read": "motion",
    "follow": "motion",
    "standing": "study",
    "claims": "claims",
    "judge": "claims",
    "check": "claims",
    "review": "claims",
    "export": "files",
}
_UNSAFE = re.compile(r"[^A-Za-z0-9._]+")  # in the name of a file
_PACKETS = ("run", "read", "follow")  # tasks whose reply is a packet of JSON and numbers
_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>polhode lab</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="/lab.css">
<script src="/lab.js" defer></script>
</head>
<body data-systems="{systems}">
<noscript><p>The lab needs JavaScript; please allow its script to run.</p></noscript>
</body>
</html>
"""


def app_of(port: int, own: Own | None = None, limits: Limits | None = None) -> Starlette:
    """The application, for a server at a port of this machine.

    Args:
        port: at which requests arrive; those addressed to another are refused.
        own: the user's own system, offered first.
        limits: on one request.
    """
    limits = limits or Limits()
    pool = WorkerPool(own)

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        pool.begin()
        yield
        await pool.end()

    async def page(request: Request) -> Response:
        systems = escape(json.dumps(offered(own)), quote=True)
        return Response(_PAGE.format(systems=systems), media_type="text/html")

    async def file(request: Request) -> Response:
        name = request.url.path[1:]
        return Response(built(name), media_type=PAGE[name])

    async def task(request: Request) -> Response:
        name = request.path_params["task"]
        if name not in _PURPOSES:
            raise HTTPException(404)
        return await _answer(request, name, pool, limits)

    return Starlette(
        routes=[
            Route("/", page),
            *(Route(f"/{name}", file) for name in PAGE),
            Route("/api/{task}", task, methods=["POST"]),
        ],
        middleware=[Middleware(RequestGuard, port=port, limits=limits)],
        exception_handlers={HTTPException: _refused, Exception: _failed},
        lifespan=lifespan,
    )


async def _answer(request: Request, task: str, pool: WorkerPool, limits: Limits) -> Response:
    body = await request.body()
    try:
        system = Fields.read(body).text("system")
    except PolhodeError as error:
        return _problem(400, error.given, error.expected, error.advice)
    own_limits = dict.fromkeys(_PACKETS, limits.motion) | {"export": limits.file}
    seconds = own_limits.get(task, limits.thought)
    gone = asyncio.Event()
    watch = asyncio.create_task(_watch(request, gone))
    task_and_body = f"{task}\n".encode() + body
    try:
        worker = await pool.worker(f"{_PURPOSES[task]} {system}")
        reply = await worker.ask(task_and_body, seconds, gone, limits.longest_wait)
    except GoneError:
        return _problem(499, "a request that was called off")  # 499: nginx's code for this
    except BusyError:
        advice = "try again when they are done, or restart the lab"
        return _problem(503, "a system with earlier requests that take long", advice=advice)
    except TooLongError:
        advice = "try a shorter duration, or other numbers"
        return _problem(503, f"this takes longer than {seconds:g} s", advice=advice)
    except BrokenError:
        return _problem(500, "the worker process ended unexpectedly; a new one was started")
    finally:
        watch.cancel()
    return _response(task, body, reply)


async def _watch(request: Request, gone: asyncio.Event) -> None:
    """Set `gone` when the client disconnects."""
    await hang_up(request.receive)
    gone.set()


def _response(task: str, body: bytes, reply: bytes) -> Response:
    kind, content = reply[:1], reply[1:]
    if kind != DONE:
        return Response(content, status_code=422, media_type="application/json")
    if task in _PACKETS:
        return Response(content, media_type="application/octet-stream")
    if task != "export":
        return Response(content, media_type="application/json")
    fields = Fields.read(body)
    file = KINDS[fields.text("kind")]
    name = _UNSAFE.sub("-", fields.text("system")).strip("-") or "polhode"
    headers = {"content-disposition": f'attachment; filename="{name}.{file.ending}"'}
    return Response(content, headers=headers, media_type=file.media)


def _problem(status: int, given: str, expected: str = "", advice: str = "") -> JSONResponse:
    problem = {"given": given, "expected": expected, "advice": advice}
    return JSONResponse(problem, status_code=status)


async def _refused(request: Request, error: Any) -> Response:
    return _problem(error.status_code, f"nothing at {request.url.path[:80]!r}")


async def _failed(request: Request, error: Exception) -> Response:
    return _problem(500, "an unexpected error in the lab", advice="please report it")
