"""Places for the letters of a figure: beside what they name, away from lines and other letters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.solution._figure import Flat, Letter, LineName, Stroke

_TURNS = 24  # directions that are tried
_STEPS = (11.0, 14.0, 18.0, 24.0, 32.0)  # pixels between a letter's edge and its line
_APART = 6.0  # pixels between points of a line
_ROUNDS = 3


@dataclass(frozen=True)
class Tag:
    """A name that needs a place.

    Attributes:
        name: what is to stand there.
        style: of the letter.
        at: the point that it names, in pixels.
        away: the direction from there in which it is expected.
    """

    name: LineName
    style: str
    at: Flat
    away: Flat


@dataclass(frozen=True)
class _Boxes:
    """Where a letter may stand, and what is wrong with each place.

    Attributes:
        middles: in pixels, (places, 2).
        half: half of its width and height, pixels.
        costs: of the places.
    """

    middles: NDArray[np.float64]
    half: NDArray[np.float64]
    costs: NDArray[np.float64]

    def overlap(self, middle: NDArray[np.float64], half: NDArray[np.float64]) -> Any:
        """How far each place is under a letter elsewhere, in pixels; negative where it is not."""
        return (self.half + half - np.abs(self.middles - middle)).min(axis=1)


def placed(tags: Sequence[Tag], strokes: Sequence[Stroke], size: Flat) -> tuple[Letter, ...]:
    """Every name at the place where it disturbs least."""
    lines = _points([stroke for stroke in strokes if stroke.style not in ("support", "paper")])
    offers = [_offers(tag, lines, size) for tag in tags]
    taken: dict[int, NDArray[np.float64]] = {}
    for _ in range(_ROUNDS):
        for i, boxes in enumerate(offers):
            costs = boxes.costs.copy()
            for j in (j for j in taken if j != i):
                over = boxes.overlap(taken[j], offers[j].half) + 2.0
                costs += np.where(over > 0, 60.0 + 20.0 * over, 0.0)
            taken[i] = boxes.middles[costs.argmin()]
    return tuple(
        Letter(tag.name, tag.style, (float(taken[i][0]), float(taken[i][1])))
        for i, tag in enumerate(tags)
    )


def overlaps(letters: Sequence[Letter]) -> float:
    """How far letters are one over the other at the most, in pixels; negative where none are."""
    places = [np.array([letter.place]) for letter in letters]
    boxes = [
        _Boxes(place, _half(letter.name), np.zeros(1))
        for place, letter in zip(places, letters, strict=True)
    ]
    pairs = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i]]
    return max((float(a.overlap(b.middles, b.half)[0]) for a, b in pairs), default=-1.0)


def _half(name: LineName) -> NDArray[np.float64]:
    return np.array([4.6 * name.length + 1.5, 8.5])


def _offers(tag: Tag, lines: NDArray[np.float64], size: Flat) -> _Boxes:
    """Around what is named, beginning where the name is expected."""
    half = _half(tag.name)
    turn = np.repeat(np.arange(_TURNS) * (2 * pi / _TURNS), len(_STEPS))
    step = np.tile(_STEPS, _TURNS)
    angle = atan2(tag.away[1], tag.away[0]) + turn
    across = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    reach = np.abs(across) @ (half - (4.0, 8.0))
    middles = np.round(tag.at + (step + np.maximum(reach, 0.0))[:, None] * across, 1)
    costs = 4.0 * np.minimum(turn, 2 * pi - turn) ** 2 + 1.2 * (step - _STEPS[0])
    costs += _crossed(middles, half, lines)
    outside = (middles <= half) | (middles >= size - half)
    return _Boxes(middles, half, costs + 500.0 * outside.any(axis=1))


def _crossed(
    middles: NDArray[np.float64], half: NDArray[np.float64], lines: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Points of lines within boxes, and near them."""
    aside = np.abs(lines - middles[:, None])
    inside = (aside < half).all(axis=2).sum(axis=1)
    near = (aside < half + np.array([3.0, 2.0])).all(axis=2).sum(axis=1)
    return np.asarray(9.0 * inside + 2.0 * near)


def _points(strokes: Sequence[Stroke]) -> NDArray[np.float64]:
    """Points along all lines."""
    found: list[Flat] = []
    for stroke in strokes:
        points = [*stroke.points, stroke.points[0]] if stroke.is_closed else stroke.points
        for (a, b), (c, d) in pairwise(points):
            count = max(1, int(hypot(c - a, d - b) / _APART))
            found += [(a + (c - a) * k / count, b + (d - b) * k / count) for k in range(count + 1)]
    return np.array(found, dtype=float).reshape(-1, 2)
