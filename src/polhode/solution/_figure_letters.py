"""Places for the letters of a figure: beside what they name, away from lines and other letters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, hypot, pi, sin

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
class _Box:
    """Where a letter may stand, and what is wrong with that."""

    middle: Flat
    half: Flat
    cost: float

    def overlap(self, other: _Box) -> float:
        """How far two boxes are one over the other, in pixels."""
        return min(
            self.half[i] + other.half[i] - abs(self.middle[i] - other.middle[i]) for i in (0, 1)
        )


def placed(tags: Sequence[Tag], strokes: Sequence[Stroke], size: Flat) -> tuple[Letter, ...]:
    """Every name at the place where it disturbs least."""
    lines = _points([stroke for stroke in strokes if stroke.style not in ("support", "paper")])
    offers = [list(_offers(tag, lines, size)) for tag in tags]
    taken: list[_Box | None] = [None] * len(tags)
    for _ in range(_ROUNDS):
        for i, boxes in enumerate(offers):
            others = [box for j, box in enumerate(taken) if j != i and box is not None]
            costs = [_total(box, others) for box in boxes]
            taken[i] = boxes[costs.index(min(costs))]
    return tuple(
        Letter(tag.name, tag.style, box.middle)
        for tag, box in zip(tags, taken, strict=True)
        if box is not None
    )


def overlaps(letters: Sequence[Letter]) -> float:
    """How far letters are one over the other at the most, in pixels; negative where none are."""
    boxes = [_Box(letter.place, _half(letter.name), 0.0) for letter in letters]
    pairs = [a.overlap(b) for i, a in enumerate(boxes) for b in boxes[:i]]
    return max(pairs, default=-1.0)


def _total(box: _Box, others: Sequence[_Box]) -> float:
    return box.cost + sum(60.0 + 20.0 * o for b in others if (o := box.overlap(b) + 2.0) > 0)


def _half(name: LineName) -> Flat:
    return 4.6 * name.length + 1.5, 8.5


def _offers(tag: Tag, lines: NDArray[np.float64], size: Flat) -> Iterator[_Box]:
    half = _half(tag.name)
    expected = atan2(tag.away[1], tag.away[0])
    for k in range(_TURNS):
        turn = 2 * pi * k / _TURNS
        across, down = cos(expected + turn), sin(expected + turn)
        reach = abs(across) * (half[0] - 4.0) + abs(down) * (half[1] - 8.0)
        for step in _STEPS:
            distance = step + max(reach, 0.0)
            x = round(tag.at[0] + distance * across, 1)
            y = round(tag.at[1] + distance * down, 1)
            aside = min(turn, 2 * pi - turn)
            cost = 4.0 * aside**2 + 1.2 * (step - _STEPS[0]) + _crossed((x, y), half, lines)
            if not (half[0] < x < size[0] - half[0] and half[1] < y < size[1] - half[1]):
                cost += 500.0
            yield _Box((x, y), half, cost)


def _crossed(middle: Flat, half: Flat, lines: NDArray[np.float64]) -> float:
    """Points of lines within a box, and near it."""
    aside = np.abs(lines - middle)
    inside = np.count_nonzero((aside < half).all(axis=1))
    near = np.count_nonzero((aside < (half[0] + 3.0, half[1] + 2.0)).all(axis=1))
    return 9.0 * inside + 2.0 * near


def _points(strokes: Sequence[Stroke]) -> NDArray[np.float64]:
    """Points along all lines."""
    found: list[Flat] = []
    for stroke in strokes:
        points = [*stroke.points, stroke.points[0]] if stroke.is_closed else stroke.points
        for (a, b), (c, d) in pairwise(points):
            count = max(1, int(hypot(c - a, d - b) / _APART))
            found += [(a + (c - a) * k / count, b + (d - b) * k / count) for k in range(count + 1)]
    return np.array(found, dtype=float).reshape(-1, 2)
