"""A computed motion as plain data, and as bytes: JSON and doubles, read without trust.

The bytes are the length of the JSON document as eight bytes, the document as UTF-8, and the
doubles; integers and doubles are little-endian. The document gives the length of every array, and
the total must be that of the doubles present: the memory and time taken to read are bounded by the
length of the bytes, whatever they contain.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import isfinite, prod
from typing import Any, NoReturn

import numpy as np
from numpy.polynomial import chebyshev

from polhode.base import SCHEMA, provenance
from polhode.simulate.integrate._quadrature import resolved
from polhode.simulate.integrate._stepping import Array

_NODES = chebyshev.chebpts1(16)


# The matrix from values at the nodes to coefficients: the inverse of V, refined by one step of
# Newton's method, X + (1 − X V) X, in long doubles.
_VALUES = chebyshev.chebvander(_NODES.astype(np.longdouble), 15)
_ROUGH = np.linalg.inv(_VALUES.astype(float))
_ANALYSIS = np.asarray(_ROUGH + (np.eye(16) - _ROUGH @ _VALUES) @ _ROUGH, dtype=float)
_ROUNDING = 2.0**-50  # relative to the largest coefficient: smaller trailing ones are rounding


@dataclass(frozen=True, eq=False)
class ChebyshevPiece:
    """A stretch of motion with constant parameters, as Chebyshev series between knots.

    Attributes:
        segment: number of the segment of the motion that it belongs to.
        mode: name of the contact mode.
        states: names of the states.
        constants: values of the constants of the stretch, by name.
        steps: ends of the steps of the integrator, s.
        knots: ends of the pieces, s, shape (pieces + 1,).
        series: coefficients over each piece, shape (pieces, order, states).
    """

    segment: int
    mode: str
    states: tuple[str, ...]
    constants: Mapping[str, float]
    steps: Array
    knots: Array
    series: Array

    @property
    def begin(self) -> float:
        """s."""
        return float(self.knots[0])

    @property
    def end(self) -> float:
        """s."""
        return float(self.knots[-1])

    def at(self, times: Array) -> Array:
        """The states at some times, shape (states, times)."""
        piece = np.clip(np.searchsorted(self.knots, times, "right") - 1, 0, len(self.knots) - 2)
        left, right = self.knots[piece], self.knots[piece + 1]
        place = (2 * times - left - right) / (right - left)
        return np.asarray(chebyshev.chebval(place, np.moveaxis(self.series[piece], 0, 2), False))


def series_of(states: Callable[[Array], Array], steps: Array) -> tuple[Array, Array]:
    """Knots and Chebyshev series, to rounding, of states that are smooth within each step.

    Args:
        states: at some times, shape (states, times).
        steps: increasing times, s.
    """
    left, right, _ = resolved(states, steps)
    times = (left[:, None] + right[:, None] + (right - left)[:, None] * _NODES) / 2
    values = states(times.ravel())
    values = values.reshape(len(values), len(left), len(_NODES))
    offset = values[:, :, :1]  # subtracted first: rounding is relative to the size of the values
    series = (values - offset) @ _ANALYSIS.T
    sizes = np.abs(series)
    significant = sizes > _ROUNDING * np.max(sizes, axis=2, keepdims=True)
    followed = np.logical_or.accumulate(significant[:, :, ::-1], axis=2)[:, :, ::-1]
    series = np.where(followed, series, 0.0)  # trailing coefficients that are rounding are zero
    series[:, :, :1] += offset
    return np.append(left, right[-1:]), np.moveaxis(series, 0, 2)


@dataclass(frozen=True, eq=False)
class Sampled:
    """Samples of one quantity.

    Attributes:
        unit: SI, empty for a pure number.
        values: shape (times,).
    """

    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Archive:
    """A motion together with the data it was computed from.

    Attributes:
        declaration: document of the system.
        parameters: values by name, in SI units.
        stretches: in order of time.
        events: each by its time, kind and modes.
        times: of the samples, s.
        details: everything else about it, as JSON values.
        origin: schema, versions and seed it was made with.
    """

    declaration: str
    parameters: Mapping[str, float]
    stretches: tuple[ChebyshevPiece, ...]
    events: tuple[Mapping[str, Any], ...]
    times: Array
    details: Mapping[str, Any] = field(default_factory=dict)
    origin: Mapping[str, Any] = field(default_factory=lambda: dict(provenance()))


FORMAT = "polhode motion"

_LENGTH = 8  # bytes of a length
_DOUBLE = np.dtype("<f8")


# -- writing ---------------------------------------------------------------------------------------


def packed(archive: Archive) -> bytes:
    """A motion as bytes; equal motions give equal bytes."""
    document = {
        "format": FORMAT,
        "schema": SCHEMA,
        "declaration": archive.declaration,
        "parameters": dict(archive.parameters),
        "events": [dict(event) for event in archive.events],
        "details": dict(archive.details),
        "origin": dict(archive.origin),
        "times": len(archive.times),
        "stretches": [
            {
                "segment": stretch.segment,
                "mode": stretch.mode,
                "states": list(stretch.states),
                "constants": dict(stretch.constants),
                "steps": len(stretch.steps),
                "pieces": len(stretch.series),
                "order": stretch.series.shape[1],
            }
            for stretch in archive.stretches
        ],
    }
    head = json.dumps(document).encode()
    parts = [a for s in archive.stretches for a in (s.steps, s.knots, s.series)]
    arrays = b"".join(np.ascontiguousarray(a, _DOUBLE).tobytes() for a in (archive.times, *parts))
    return counted(len(head)) + head + arrays


def counted(length: int) -> bytes:
    """A length as bytes."""
    return length.to_bytes(_LENGTH, "little")


# -- reading ---------------------------------------------------------------------------------------


def unpacked(content: bytes) -> Archive:
    """The motion that was packed into bytes.

    Raises:
        ValueError: for bytes that are not a motion.
    """
    length = int.from_bytes(content[:_LENGTH], "little")
    head, rest = content[_LENGTH : _LENGTH + length], content[_LENGTH + length :]
    if len(head) < length or len(rest) % _DOUBLE.itemsize:
        raise ValueError("its length is not the one it states")
    try:
        document = mapping(json.loads(head, parse_constant=_no_number))
    except RecursionError as error:
        raise ValueError("lists nested too deeply") from error
    if document.get("format") != FORMAT:
        raise ValueError("it has another format")
    if document.get("schema") != SCHEMA:
        raise ValueError(f"it is of schema {document.get('schema')!r}, not {SCHEMA}")
    missing = _KEYS - set(document)
    if missing:
        raise ValueError(f"{', '.join(sorted(missing))} missing")
    arrays = _Arrays(rest)
    times = arrays.take(_count(document, "times", 0))
    stretches = tuple(_stretch(item, arrays) for item in _listed(document["stretches"]))
    arrays.finish()
    return Archive(
        declaration=text(document["declaration"]),
        parameters=numbers(document["parameters"]),
        stretches=stretches,
        events=tuple(mapping(event) for event in _listed(document["events"])),
        times=times,
        details=mapping(document["details"]),
        origin=mapping(document["origin"]),
    )


_KEYS = {"declaration", "parameters", "events", "details", "origin", "times", "stretches"}


def _no_number(name: str) -> NoReturn:
    raise ValueError(f"{name} for a number")


class _Arrays:
    """Doubles, taken one array after the other."""

    def __init__(self, content: bytes) -> None:
        self._left = np.frombuffer(content, dtype=_DOUBLE)

    def take(self, *shape: int) -> Array:
        count = prod(shape)
        if count > len(self._left):
            raise ValueError(f"{len(self._left)} numbers instead of {count}")
        taken, self._left = self._left[:count], self._left[count:]
        if not np.all(np.isfinite(taken)):
            raise ValueError("a number that is not finite")
        return taken.astype(float).reshape(shape)

    def finish(self) -> None:
        """Check that none are left over."""
        if len(self._left):
            raise ValueError(f"{len(self._left)} numbers too many")


def _stretch(item: Any, arrays: _Arrays) -> ChebyshevPiece:
    part = mapping(item)
    states = tuple(text(state) for state in _listed(part["states"]))
    pieces, order = _count(part, "pieces"), _count(part, "order")
    if not states:
        raise ValueError("a stretch without states")
    steps = arrays.take(_count(part, "steps", 2))
    knots = arrays.take(pieces + 1)
    for times in (steps, knots):
        if not np.all(np.diff(times) > 0) or times[0] != steps[0] or times[-1] != steps[-1]:
            raise ValueError("times of a stretch that do not increase from its start to its end")
    return ChebyshevPiece(
        segment=_count(part, "segment", 0),
        mode=text(part["mode"]),
        states=states,
        constants=numbers(part["constants"]),
        steps=steps,
        knots=knots,
        series=arrays.take(pieces, order, len(states)),
    )


def _count(table: Mapping[str, Any], name: str, least: int = 1) -> int:
    value = table[name]
    if type(value) is not int or not least <= value < 2**60:
        raise ValueError(f"{name} = {str(value)[:30]}")
    return value


def text(value: Any) -> str:
    """A string.

    Raises:
        ValueError: for anything else, and for a lone surrogate.
    """
    if not isinstance(value, str):
        raise ValueError(f"{str(value)[:30]} where text is expected")
    value.encode()
    return value


def _listed(value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise ValueError("no list where a list is expected")
    return value


def mapping(value: Any) -> dict[str, Any]:
    """A JSON object.

    Raises:
        ValueError: for anything else.
    """
    if not isinstance(value, dict):
        raise ValueError("no object where an object is expected")
    return value


def number(value: Any) -> float:
    """A finite number.

    Raises:
        ValueError: for anything else.
    """
    if type(value) not in (int, float) or not isfinite(value):
        raise ValueError(f"{str(value)[:30]} where a number is expected")
    return float(value)


def numbers(value: Any) -> dict[str, float]:
    """Finite numbers by name.

    Raises:
        ValueError: for anything else.
    """
    return {name: number(item) for name, item in mapping(value).items()}
