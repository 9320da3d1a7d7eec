"""What a run can be given besides the parameters of its system."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.model import Contact, Sheet, System


@dataclass(frozen=True)
class Settable:
    """Something besides the parameters that a run can be given.

    Attributes:
        name: as in the documents of runs.
        unit: SI unit as text; empty for a number or a file.
        option: as it is written.
        meaning: in words.
    """

    name: str
    unit: str
    option: str
    meaning: str


def settable(system: System) -> tuple[Settable, ...]:
    """What a run of a system can be given besides its parameters: friction, an edge, a path."""
    contacts = [element for element in system.elements if isinstance(element, Contact)]
    found: list[Settable] = []
    if contacts:
        found += [
            Settable("mu", "", "--mu MU", "kinetic friction at every contact"),
            Settable("mu_static", "", "--mu-static MU", "static friction, mu by default"),
        ]
    if any(isinstance(contact.on, Sheet) for contact in contacts):
        found += [
            Settable("edge", "m", "--set edge=0.3m", "end of the sheet, where x_sheet = edge"),
            Settable("sheet", "", "--sheet FILE.csv", "path of the sheet, columns t,x,y"),
        ]
    return tuple(found)
