"""Declarations as they are read: line by line as text, in a notebook as a table."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import Any

from polhode.base import Shown


class FieldwiseRepr(Shown):
    """A dataclass that prints its fields on lines of their own."""

    @property
    def brief(self) -> str:
        """What it is called within another declaration."""
        return " ".join([type(self).__name__, *map(repr, self._called)])

    @property
    def parts(self) -> Iterator[tuple[str, object]]:
        """Its fields by name, but for its own name and those that are left empty."""
        named: Any = self
        for field in fields(named):
            value = getattr(self, field.name)
            if field.name != "name" and value not in (None, "", ()):
                yield field.name.replace("_", " "), value

    @property
    def _called(self) -> list[str]:
        return [name] if (name := getattr(self, "name", "")) else []

    def __str__(self) -> str:
        told = [(name, brief(value)) for name, value in self.parts]
        width = max((len(name) for name, _ in told), default=0)
        return "\n".join([self.brief, *(f"  {name:{width}}  {text}" for name, text in told)])


def brief(value: object) -> str:
    """A part of a declaration on one line."""
    if isinstance(value, tuple):
        return ", ".join(map(brief, value))
    return str(getattr(value, "brief", value))
