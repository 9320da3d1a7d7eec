"""An entry of the catalogue: declaration, default numbers, description, and what to plot."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from polhode.algebra import Expr, compile_program
from polhode.base import PURE, Dimension, PolhodeError, read_quantity
from polhode.derive import Equations
from polhode.model import Contact, Coulomb, Rolling, Sheet, System


@dataclass(frozen=True)
class Parameter:
    """A parameter of a catalogue system.

    Attributes:
        name: published name.
        unit: SI unit as text; empty for a number or an angle in radians.
        default: a value with a unit, or an expression of other parameters such as m*a**2/2.
        meaning: in words, such as "mass of the disk".
    """

    name: str
    unit: str
    default: str
    meaning: str


@dataclass(frozen=True)
class CatalogueEntry:
    """A system of the catalogue.

    Attributes:
        name: as on the command line.
        title: heading.
        about: the problem in a few sentences.
        build: returns the declaration.
        parameters: with their defaults.
        start: default start values; speeds not named start at zero.
        duration: of the default run.
        plots: groups of quantities worth plotting against time.
        forcing: prescribed functions of time, as expressions of t.
        whatever_touches: description that still holds with contacts of another kind.
        values: of parameters that are not described, as those of a user's file, like `default`.
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
    values: Mapping[str, str] = field(default_factory=dict)

    @property
    def defaults(self) -> dict[str, str]:
        """Values of parameters as text, by name."""
        return {p.name: p.default for p in self.parameters} | dict(self.values)

    def all_parameters(self, equations: Equations) -> tuple[Parameter, ...]:
        """Those described, and further ones of its equations or with a value, without a meaning.

        Without a value the default is empty.
        """
        described = {p.name for p in self.parameters}
        dimensions = {s.published: equations.dimensions.get(s) for s in equations.parameters}
        further = (name for name in dict.fromkeys((*dimensions, *self.values)))
        found = (
            Parameter(name, _unit(dimensions.get(name), text), text, "")
            for name in further
            if name not in described
            for text in [self.values.get(name, "")]
        )
        return (*self.parameters, *found)

    @classmethod
    def bare(cls, name: str, title: str, system: System) -> CatalogueEntry:
        """The entry of a user's own system, without defaults."""
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


def _unit(dimension: Dimension | None, text: str) -> str:
    """The unit of a parameter, or of its value where the equations do not tell."""
    if dimension is None:
        with suppress(PolhodeError):
            dimension = read_quantity(text).dimension
    return "" if dimension in (None, PURE) else dimension.unit


GRAVITY = Parameter("g", "m/s^2", "9.81 m/s^2", "acceleration of gravity")


# -- description of a system whose contacts a run has changed --------------------------------------


def about_with(entry: CatalogueEntry, system: System) -> str:
    """The description of an entry, adapted if the system has contacts of another kind."""
    declared = [type(contact) for contact in entry.build().contacts]
    contacts = system.contacts
    if [type(contact) for contact in contacts] == declared:
        return entry.about
    sentences = dict.fromkeys(_sentence(contact) for contact in contacts)
    return " ".join(filter(None, (entry.whatever_touches, *sentences)))


def contact_numbers(system: System) -> dict[str, float]:
    """Coefficients of friction and edges of sheets declared as numbers, by name, SI.

    Where contacts differ, each name is preceded by that of the contact: "ground_mu".
    """
    contacts = system.contacts
    by_contact = {contact.name: dict(_numbers(contact)) for contact in contacts}
    if all(numbers == by_contact[contacts[0].name] for numbers in by_contact.values()):
        return next(iter(by_contact.values()), {})
    return {
        f"{name}_{contact}": value
        for contact, numbers in by_contact.items()
        for name, value in numbers.items()
    }


def _numbers(contact: Contact) -> Iterator[tuple[str, float]]:
    declared = dict[str, Expr | None]()
    if isinstance(contact, Coulomb):
        declared["mu"] = contact.mu
        declared["mu_static"] = None if contact.mu_static == contact.mu else contact.mu_static
    if isinstance(contact.on, Sheet):
        declared["edge"] = contact.on.edge
    for name, value in declared.items():
        # an expression without symbols is a number
        if value is not None and not value.symbols():
            yield name, float(compile_program([value], ()).function()()[0])


def _sentence(contact: Contact) -> str:
    if isinstance(contact, Rolling):
        return "It rolls without slipping."
    if not isinstance(contact, Coulomb):
        return "There is no friction at the contact."
    known = dict(_numbers(contact))
    letters = {"mu": "μ", "mu_static": "static μ"}
    stated = " and ".join(
        f"{letters[name]} = {value:g}" for name, value in known.items() if name in letters
    )
    with_what = f" with {stated}" if stated else ""
    return (
        f"Coulomb friction{with_what} acts at the contact: it rolls while that is enough, and "
        "slides otherwise."
    )
