"""Saved motions with altered contents and a right checksum."""

import json
import math
import random
from collections.abc import Callable
from typing import Any

from polhode.simulate.files import _store
from polhode.simulate.files._archive import counted

Document = dict[str, Any]
Path = tuple[Any, ...]

STRANGE: tuple[Any, ...] = (
    *(10**9, 10**30, 10**400, -(10**9), 2**63, -1, 0, 3, 7, 64, 999, 1000),
    *(1.5, 1e308, -1e308, 1e-320, math.nan, math.inf),
    *(True, None, "", "x", "10**9", [], {}, [[]]),
)


# -- files -----------------------------------------------------------------------------------------


def opened(content: bytes) -> tuple[bytes, Document, bytes]:
    """What precedes a motion in its file, its document, and its numbers."""
    inside = content[: -len(_store._seal(b""))]
    length = int.from_bytes(inside[-8:], "little")
    before, payload = inside[: -8 - length], inside[-8 - length : -8]
    size = int.from_bytes(payload[:8], "little")
    return before, json.loads(payload[8 : 8 + size]), payload[8 + size :]


def sealed(before: bytes, document: Document | bytes, numbers: bytes) -> bytes:
    """A file with a right checksum, whatever is in it."""
    text = document if isinstance(document, bytes) else json.dumps(document).encode()
    payload = counted(len(text)) + text + numbers
    inside = before + payload + counted(len(payload))
    return inside + _store._seal(inside)


def altered(rng: random.Random, content: bytes) -> tuple[str, bytes]:
    """What was altered in a file, and the file."""
    before, document, numbers = opened(content)
    kind = rng.choice(list(_KINDS))
    return kind, sealed(before, *_KINDS[kind](rng, document, numbers))


# -- what can be altered ---------------------------------------------------------------------------

Alteration = Callable[[random.Random, Document, bytes], tuple[Document | bytes, bytes]]


def _declaration(rng: random.Random, document: Document, numbers: bytes) -> Any:
    declared = tree(rng, json.loads(document["declaration"]))
    return {**document, "declaration": json.dumps(declared)}, numbers


def _expressions(rng: random.Random, document: Document, numbers: bytes) -> Any:
    name, details = rng.choice(["forcing", "invariants"]), document["details"]
    changed = json.dumps(tree(rng, json.loads(details[name])))
    return {**document, "details": {**details, name: changed}}, numbers


def _document(rng: random.Random, document: Document, numbers: bytes) -> Any:
    return tree(rng, document), numbers


def _numbers(rng: random.Random, document: Document, numbers: bytes) -> Any:
    changed = bytearray(numbers)
    for _ in range(rng.choice([1, 1, 3, 20])):
        changed[rng.randrange(len(changed))] ^= rng.randrange(1, 256)
    return document, bytes(changed)


def _text(rng: random.Random, document: Document, numbers: bytes) -> Any:
    changed = bytearray(json.dumps(document).encode())
    for _ in range(rng.choice([1, 1, 3])):
        changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed), numbers


def _length(rng: random.Random, document: Document, numbers: bytes) -> Any:
    by = rng.choice([8, -8, 80, 1, -3])
    return document, numbers[:by] if by < 0 else numbers + bytes(by)


_KINDS: dict[str, Alteration] = {
    "declaration": _declaration,
    "expressions": _expressions,
    "document": _document,
    "numbers": _numbers,
    "text": _text,
    "length": _length,
}


# -- JSON ------------------------------------------------------------------------------------------


def tree(rng: random.Random, document: Any) -> Any:
    """A document with one to four values altered, anywhere in it."""
    for _ in range(rng.choice([1, 1, 1, 2, 4])):
        places = [place for place in _places(document) if place]
        if places:
            document = _put(rng, document, rng.choice(places))
    return document


def _places(node: Any, at: Path = ()) -> list[Path]:
    inside: Any = ()
    if isinstance(node, dict | list):
        inside = node.items() if isinstance(node, dict) else enumerate(node)
    return [at, *(place for key, value in inside for place in _places(value, (*at, key)))]


def _put(rng: random.Random, node: Any, at: Path) -> Any:
    if not at:
        return _value(rng, node)
    copied = node.copy()
    copied[at[0]] = _put(rng, node[at[0]], at[1:])
    return copied


def _value(rng: random.Random, value: Any) -> Any:
    kinds = {int: _number, float: _number, str: _word, list: _list, dict: _names}
    if type(value) in kinds and rng.random() < 0.75:
        return kinds[type(value)](rng, value)
    return rng.choice(STRANGE)


def _number(rng: random.Random, value: float) -> Any:
    scaled = [value + 1, value - 1, -value, 2 * value, value * 1000, value * 10**6, value * 10**9]
    return rng.choice([*scaled, rng.randint(0, 20), rng.randint(0, 1000)])


def _word(rng: random.Random, value: str) -> Any:
    at = rng.randrange(len(value) + 1)
    other = value[:at] + chr(rng.randrange(32, 500)) + value[at + 1 :]
    return rng.choice([other, value[:at], value * 2, value[::-1], value.upper(), "\ud800"])


def _list(rng: random.Random, value: list[Any]) -> Any:
    at = rng.randrange(len(value) + 1)
    mixed = rng.sample(value, len(value))
    changes = [value[:at] + value[at + 1 :], value[:at] + value[max(at - 1, 0) :], value * 100]
    return rng.choice([*changes, mixed, value[: len(value) // 2], [value]])


def _names(rng: random.Random, value: dict[str, Any]) -> Any:
    if not value:
        return {"new": 1}
    one, other = rng.choice(list(value)), rng.choice(list(value))
    without = {name: item for name, item in value.items() if name != one}
    swapped = {**value, one: value[other], other: value[one]}
    return rng.choice([without, {**without, one + "x": value[one]}, swapped, {**value, one: value}])
