"""A scene as short text in a page: its numbers as differences, all of it compressed."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import replace
from math import prod
from typing import Any
from zlib import compress

import numpy as np

from polhode.view._quantities import Array
from polhode.view._scene import Scene, plain

_DIGITS = 14  # binary digits of what is only drawn


def packed(data: Mapping[str, Any]) -> str:
    """Data as compressed JSON in base64, which `unpacked` in web/src/packed.ts reads."""
    return b64encode(compress(json.dumps(data, allow_nan=False).encode(), 9)).decode("ascii")


def packed_scene(shown: Scene) -> str:
    """A scene as compressed text: less than half as long as its numbers in base64.

    Arrows and portraits come with 14 binary digits, more than a page shows of them.
    An array becomes {"shape": [...], "steps": ...}, or {"shape": [...], "same": n} where it is
    equal to the one that is the n-th with steps.
    """
    places = dict[tuple[tuple[int, ...], str], int]()

    def once(values: Array) -> dict[str, object]:
        steps = _differences(values)
        key = (values.shape, steps)
        if key in places:
            return {"same": places[key]}
        places[key] = len(places)
        return {"steps": steps}

    arrows = tuple(replace(arrow, along=_rounded(arrow.along)) for arrow in shown.arrows)
    portraits = tuple(
        replace(portrait, columns=tuple(map(_rounded, portrait.columns)))
        for portrait in shown.portraits
    )
    return packed(plain(replace(shown, arrows=arrows, portraits=portraits), once))


def _rounded(values: Array) -> Array:
    if len(values) == 1:  # a constant, which is short anyway
        return values
    mantissa, exponent = np.frexp(values)
    rounded: Array = np.ldexp(np.round(np.ldexp(mantissa, _DIGITS)), exponent - _DIGITS)
    return rounded


def _differences(values: Array) -> str:
    """The numbers of an array without any loss, in a form that compresses well.

    From one row to the next, the bits of a single-precision number, read as an integer, change
    little. The differences (modulo 2**32) come column by column, even ones for increases and odd
    ones for decreases, and of all of them first the lowest byte, then the next ones.
    """
    width = prod(values.shape[1:])
    bits = values.astype("<f4").view("<u4").reshape(len(values), width)
    steps = np.diff(bits, axis=0, prepend=np.zeros((1, width), "<u4")).view("<i4")
    signless = ((steps << 1) ^ (steps >> 31)).view("<u4")
    planes = np.ascontiguousarray(signless.T).view("u1").reshape(-1, 4).T
    return b64encode(planes.tobytes()).decode("ascii")
