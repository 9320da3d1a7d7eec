"""A body that nothing places: its centre of mass has three coordinates of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Vector, coordinate, speed
from polhode.model._body import Body
from polhode.model._element import Element, Places, Restraint


@dataclass(frozen=True)
class Flight(Element):
    """Free motion of the centre of mass, by components along the root frame."""

    body: Body
    name: str = "flight"

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def rates(self) -> Mapping[Expr, Expr]:
        tag = self.body.tag
        labels = self.body.axes.root.labels
        return {coordinate(f"{label}{tag}"): speed(f"v_{label}{tag}") for label in labels}

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        return {self.body: Vector(tuple(self.rates()), self.body.axes.root)}

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return ()
