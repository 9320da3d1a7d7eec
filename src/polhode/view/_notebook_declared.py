"""What a notebook shows of the parts of a declaration: bodies, frames, contacts, joints, loads."""

from __future__ import annotations

from collections.abc import Iterable
from functools import singledispatch
from html import escape

from polhode.algebra import Expr, Matrix, Vector
from polhode.model import Declared, Frame, brief
from polhode.view._markup import formula, framed, table
from polhode.view._mathml import alone, symbol
from polhode.view._notebook_parts import html_of as html_of


@html_of.register
def _(thing: Declared) -> str:
    parts = [(escape(name), _told(value)) for name, value in thing.parts]
    return framed(table(_title(thing), ("", ""), parts))


@html_of.register
def _(thing: Frame) -> str:
    """The turns that lead to it from the laboratory, the first one first."""
    steps = [_step(frame) for frame in reversed(thing.lineage[:-1])]
    root = f"<p>out of {escape(str(thing.root))}</p>"
    turns = table("", ("", "turned by, rad", "about"), steps) if steps else ""
    return framed(f"<strong>Frame {escape(str(thing))}</strong>{root if steps else ''}{turns}")


def _title(thing: Declared) -> str:
    kind = type(thing).__name__
    name = str(getattr(thing, "name", ""))
    return escape(f"{kind} {name}".strip())


def _step(frame: Frame) -> tuple[str, str, str]:
    return escape(str(frame)), _told(frame.angle), _about(frame)


def _about(frame: Frame) -> str:
    """The direction turned about: its label where it is one of the parent's."""
    labels = frame.parent.labels if frame.parent else frame.labels
    chosen = [label for label, part in zip(labels, frame.axis, strict=True) if part == 1]
    return escape(chosen[0]) if chosen else _listed(frame.axis)


@singledispatch
def _told(value: object) -> str:
    """A part of a declaration within a table."""
    return escape(brief(value))


@_told.register
def _(value: Expr) -> str:
    return formula(alone(value))


@_told.register
def _(value: tuple) -> str:  # type: ignore[type-arg]
    return ", ".join(map(_told, value))


@_told.register
def _(value: Vector) -> str:
    return f"{_listed(value.components)} along {escape(str(value.triad))}"


@_told.register
def _(value: Matrix) -> str:
    return "; ".join(_listed(row) for row in value.rows)


def _listed(entries: Iterable[Expr]) -> str:
    return f"({', '.join(map(symbol, entries))})"
