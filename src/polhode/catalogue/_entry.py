"""What the catalogue knows of a system: its declaration, default numbers, and what to plot."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from polhode.model import System


@dataclass(frozen=True)
class Parameter:
    """A parameter of a catalogue system.

    Attributes:
        name: published name.
        unit: SI unit as text; empty for a number or an angle in radians.
        default: a value with a unit, or an expression of other parameters such as m*a**2/2.
        meaning: what it is.
    """

    name: str
    unit: str
    default: str
    meaning: str


@dataclass(frozen=True)
class CatalogueEntry:
    """A system of the catalogue.

    Attributes:
        name: what the command line calls it.
        title: heading.
        about: the problem in a few sentences.
        build: makes the declaration.
        parameters: with their defaults.
        start: default start values; speeds not named start at zero.
        duration: of the default run.
        plots: groups of quantities worth plotting against time.
        forcing: prescribed functions of time, as expressions of t.
        whatever_touches: what of `about` holds with other contacts than those declared.
    """

    name: str
    title: str
    about: str
    build: Callable[[], System]
    parameters: tuple[Parameter, ...]
    start: Mapping[str, str]
    duration: str
    plots: tuple[tuple[str, ...], ...]
    forcing: Mapping[str, str] = field(default_factory=dict)
    whatever_touches: str = ""

    @classmethod
    def bare(cls, name: str, title: str, system: System) -> CatalogueEntry:
        """A system of somebody's own, with no defaults."""
        return cls(
            name=name,
            title=title,
            about="",
            build=lambda: system,
            parameters=(),
            start={},
            duration="",
            plots=(),
        )


GRAVITY = Parameter("g", "m/s^2", "9.81 m/s^2", "acceleration of gravity")
