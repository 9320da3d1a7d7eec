"""JSON of strangers."""

from __future__ import annotations

import json
from typing import Any, NoReturn

from polhode.base._errors import ParseError


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
