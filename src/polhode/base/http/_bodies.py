"""Bodies of requests, read whole within limits before an application sees them."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from typing import Any

Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]


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
