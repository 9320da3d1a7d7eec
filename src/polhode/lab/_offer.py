"""The systems on offer: those of the catalogue, and the user's own as plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from polhode.base import look_up
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.model import read_declaration, write_declaration


@dataclass(frozen=True)
class Own:
    """The user's own system as workers receive it: data, with no code to run.

    Attributes:
        name: on the page.
        title: heading.
        declaration: the document that `polhode.model` writes.
        values, forcing, start, duration: numbers of its motion, as in `CatalogueEntry`.
    """

    name: str
    title: str
    declaration: str
    values: Mapping[str, str] = field(default_factory=dict)
    forcing: Mapping[str, str] = field(default_factory=dict)
    start: Mapping[str, str] = field(default_factory=dict)
    duration: str = ""

    @classmethod
    def of(cls, entry: CatalogueEntry) -> Own:
        """An entry as data."""
        return cls(
            entry.name,
            entry.title,
            write_declaration(entry.build()),
            dict(entry.values),
            dict(entry.forcing),
            dict(entry.start),
            entry.duration,
        )

    @property
    def entry(self) -> CatalogueEntry:
        """The entry again."""
        bare = CatalogueEntry.bare(self.name, self.title, read_declaration(self.declaration))
        return replace(
            bare,
            values=self.values,
            forcing=self.forcing,
            start=self.start,
            duration=self.duration,
        )


def entry_of(name: str, own: Own | None) -> CatalogueEntry:
    """The entry of that name.

    Raises:
        DeclarationError: for an unknown name.
    """
    if own is not None and name == own.name:
        return own.entry
    return look_up(name, CATALOGUE, "system of the lab")


def offered(own: Own | None) -> list[dict[str, str]]:
    """Names and titles, one's own system first."""
    mine = [] if own is None else [{"name": own.name, "title": own.title}]
    return mine + [{"name": entry.name, "title": entry.title} for entry in CATALOGUE.values()]
