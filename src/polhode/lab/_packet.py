"""What is sent with many numbers: JSON, and the numbers as they are after it."""

from __future__ import annotations

import json
from typing import Any

from polhode.view import plain

_WORD = 4  # bytes of a number, float32, and of the length of the JSON before it, little-endian


def packet(document: Any) -> bytes:
    """Length of the JSON, the JSON, and the numbers of all arrays one after the other.

    An array becomes {"shape": [...], "float32": [begin, end]}, places among the numbers.
    """
    numbers = bytearray()

    def placed(more: bytes) -> list[int]:
        begin = len(numbers) // _WORD
        numbers.extend(more)
        return [begin, len(numbers) // _WORD]

    text = json.dumps(plain(document, placed), ensure_ascii=False, allow_nan=False).encode("utf-8")
    text += b" " * (-len(text) % _WORD)
    return len(text).to_bytes(_WORD, "little") + text + numbers
