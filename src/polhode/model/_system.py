"""A system: bodies, their contacts and joints, and their loads."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from polhode.algebra import Expr, ExprLike, Symbol, SymbolKind, as_symbol, speed
from polhode.base import DeclarationError, Shown, look_up
from polhode.model._body import Body
from polhode.model._contact_law import ContactLaw
from polhode.model._contacts import Contact, Coulomb, Rolling
from polhode.model._declared import is_rate, quantity
from polhode.model._element import Element, Flight
from polhode.model._frame import Frame
from polhode.model._loads import Load
from polhode.model._planes import Sheet

Part = Body | Element | Load

#: Laws of impacts at several contacts; without one they are refused.
IMPACT_LAWS = ("", "Moreau")
#: Laws by which contacts share a load where Newton's laws leave it open.
SHARING_LAWS = ("", "equal stiffness")


@dataclass(frozen=True, init=False)
class System(Shown):
    """An immutable declaration; building it computes nothing.

    Args:
        parts: bodies, contacts, joints and loads, in any order. Bodies that another
            part names need not be listed again.
        name: short name.
        independent: speeds to be kept as independent where the constraints leave a choice.
        speeds: speeds of your own, by name, as expressions that are linear in speeds and rates:
            velocities along the body, quasi-velocities, momenta. Equations are written in them;
            each takes the place of a speed in its expression.
        impacts: the law of impacts that several contacts feel at once: "Moreau", Newton's
            restitution and Coulomb's friction of the impulses at each. By default such impacts are
            refused, since rigid bodies alone do not determine them.
        sharing: the law by which more contacts than are needed share a load: "equal stiffness", the
            limit of supports that all give way alike. By default their forces stay open.

    Raises:
        DeclarationError: for parts that do not fit together, or speeds that are no speeds.
    """

    bodies: tuple[Body, ...]
    elements: tuple[Element, ...]
    loads: tuple[Load, ...]
    name: str
    independent: tuple[Symbol, ...]
    speeds: tuple[tuple[Symbol, Expr], ...]
    impacts: str
    sharing: str

    def __init__(
        self,
        *parts: Part,
        name: str = "system",
        independent: Iterable[Expr] = (),
        speeds: Mapping[str | Expr, Expr] = MappingProxyType({}),
        impacts: str = "",
        sharing: str = "",
    ) -> None:
        bodies = _bodies(parts)
        elements = tuple(part for part in parts if isinstance(part, Element))
        loads = tuple(part for part in parts if isinstance(part, Load))
        _refuse_other_types(parts)
        if not bodies:
            raise DeclarationError("a system without a body", expected="at least one Body")
        for kind, named in (("body", bodies), ("contact or joint", elements), ("load", loads)):
            _refuse_same_names(kind, named)
        roots = {body.axes.root for body in bodies}
        if len(roots) > 1:
            names = ", ".join(sorted(frame.name for frame in roots))
            raise DeclarationError(
                f"bodies whose axes start from different frames: {names}",
                expected="frames that descend from one root",
                advice="build all axes from the same Frame",
            )
        _refuse_alone(elements)
        if impacts not in IMPACT_LAWS:
            raise DeclarationError(
                f"impacts={impacts!r}",
                expected='"Moreau", or nothing, so that impacts at several contacts are refused',
            )
        if sharing not in SHARING_LAWS:
            raise DeclarationError(
                f"sharing={sharing!r}",
                expected='"equal stiffness", or nothing, so that forces may stay open',
            )
        _refuse_unlisted(independent, speeds)
        kept = tuple(as_symbol(speed) for speed in independent)
        values = {
            "bodies": bodies,
            "elements": elements,
            "loads": loads,
            "name": name,
            "independent": kept,
            "speeds": tuple(_speed(name, meaning) for name, meaning in speeds.items()),
            "impacts": impacts,
            "sharing": sharing,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    def __repr__(self) -> str:
        parts: tuple[Part, ...] = (*self.bodies, *self.elements, *self.loads)
        listed = ", ".join(f"{type(part).__name__} {part.name!r}" for part in parts)
        return f"System {self.name!r}: {listed}"

    @property
    def root(self) -> Frame:
        """The laboratory frame from which all axes descend."""
        return self.bodies[0].axes.root

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """The contacts, in the order in which they were declared."""
        return tuple(element for element in self.elements if isinstance(element, Contact))

    @property
    def contact_laws(self) -> tuple[ContactLaw, ...]:
        """The contacts, and the couples beside their forces, likewise."""
        return tuple(element for element in self.elements if isinstance(element, ContactLaw))

    def body(self, name: str) -> Body:
        """The body with this name."""
        return look_up(name, {body.name: body for body in self.bodies}, "body of the system")

    def element(self, name: str) -> Element:
        """The contact or joint with this name."""
        known = {element.name: element for element in self.elements}
        return look_up(name, known, "contact or joint of the system")

    def load(self, name: str) -> Load:
        """The load with this name."""
        return look_up(name, {load.name: load for load in self.loads}, "load of the system")

    def flights(self, placed: Iterable[Body]) -> tuple[Flight, ...]:
        """Free motion for the bodies that nothing places."""
        known = set(placed)
        return tuple(Flight(b, f"flight{b.tag}") for b in self.bodies if b not in known)


def _speed(name: str | Expr, meaning: Expr) -> tuple[Symbol, Expr]:
    """A user's speed and its meaning, checked as far as it can be without the motion."""
    if not isinstance(name, str):
        given = name.symbol if isinstance(name, Expr) else None
        if given is None or given.kind is not SymbolKind.SPEED or given.order:
            raise DeclarationError(
                f"a speed named {name}",
                expected="a name, or a symbol made by ph.speed",
                advice='write speeds={"v": x.dt()*ph.cos(phi) + y.dt()*ph.sin(phi)}',
            )
        name = given.name
    symbol, expression = as_symbol(speed(name)), quantity(meaning, f"speed {name!r}")
    if not any(is_rate(s) for s in expression.symbols()):
        raise DeclarationError(
            f"the speed {name} = {expression}, in which nothing moves",
            expected="an expression that is linear in speeds and rates of coordinates",
            advice="rates are written x.dt(), or as the name of a speed",
        )
    return symbol, expression


def _bodies(parts: Iterable[Part]) -> tuple[Body, ...]:
    """The bodies of a system, and those that its contacts, joints and loads name."""
    found: dict[Body, None] = {}
    for part in parts:
        if isinstance(part, Body):
            found.setdefault(part)
        elif isinstance(part, Element | Load):
            for body in part.bodies:
                found.setdefault(body)
    return tuple(found)


def _refuse_other_types(parts: Iterable[object]) -> None:
    for part in parts:
        if isinstance(part, Body | Element | Load):
            continue
        advice = "a support belongs in a contact: Rolling(body, on=Plane(lab))"
        what = f"a {type(part).__name__}"
        if isinstance(part, type):
            what = f"the class {part.__name__}"
            advice = f"create one with its arguments: {part.__name__}(...)"
        elif isinstance(part, list | tuple | set):
            advice = "give the parts one by one: System(*parts)"
        raise DeclarationError(
            f"{what} in a system", expected="bodies, contacts, joints and loads", advice=advice
        )


def _refuse_alone(elements: Iterable[Element]) -> None:
    """Refuse couples beside the force of a contact that is not there."""
    known = {element.name for element in elements}
    for element in elements:
        if isinstance(element, ContactLaw) and element.pressed_by not in known:
            raise DeclarationError(
                f"{element.name!r}, which belongs to {element.pressed_by!r}",
                expected="a system with that contact",
                advice="give both: System(contact, RollingResistance(contact, mu=...), ...)",
            )


def _refuse_same_names(kind: str, parts: Sequence[Part]) -> None:
    first: dict[str, Part] = {}
    for part in parts:
        other = first.setdefault(part.name, part)
        if other is part:
            continue
        one, two = type(other).__name__, type(part).__name__
        given = f"two of the class {one}" if one == two else f"a {one} and a {two}"
        raise DeclarationError(
            f"{given} named {part.name!r} in one system",
            expected=f"a different name for every {kind}",
            advice=f"name one of them, as in {two}(..., name={part.name + ' 2'!r})",
        )
    if len(first) < len(parts):
        twice = next(name for name in first if sum(p.name == name for p in parts) > 1)
        raise DeclarationError(f"{twice!r} twice in one system", expected=f"every {kind} once")


# -- the same system with one thing changed --------------------------------------------------------


def with_elements(system: System, elements: dict[str, Element]) -> System:
    """The same system with other contacts or joints under some of the names."""
    changed = [elements.get(element.name, element) for element in system.elements]
    return rebuilt(system, (*system.bodies, *changed, *system.loads))


def with_loads(system: System, *loads: Load) -> System:
    """The same system with further loads."""
    return rebuilt(system, (*system.bodies, *system.elements, *system.loads, *loads))


def with_independent(system: System, speeds: Iterable[Expr]) -> System:
    """The same system with other speeds to be kept as independent."""
    return rebuilt(system, (*system.bodies, *system.elements, *system.loads), speeds)


def rebuilt(
    system: System,
    parts: tuple[Part, ...],
    independent: Iterable[Expr] | None = None,
    speeds: Mapping[str | Expr, Expr] | None = None,
) -> System:
    """A system of these parts, otherwise as declared."""
    kept = [Expr.generator(symbol) for symbol in system.independent]
    chosen: Mapping[str | Expr, Expr] = {s.name: meaning for s, meaning in system.speeds}
    return System(
        *parts,
        name=system.name,
        independent=kept if independent is None else independent,
        speeds=chosen if speeds is None else speeds,
        impacts=system.impacts,
        sharing=system.sharing,
    )


def with_friction(system: System, mu: ExprLike, mu_static: ExprLike | None = None) -> System:
    """The same system with Coulomb friction at every contact.

    Raises:
        DeclarationError: for a system without a contact, and for impossible coefficients.
    """
    if not system.contacts:
        raise DeclarationError(
            f"friction for {system.name!r}, in which nothing touches a support",
            expected="a system with a contact",
            advice="leave out mu, or declare a contact",
        )
    return with_elements(system, {c.name: _rough(c, mu, mu_static) for c in system.contacts})


def _rough(contact: Contact, mu: ExprLike, mu_static: ExprLike | None) -> Coulomb:
    if isinstance(contact, Rolling) and contact.tangential is not None:
        raise DeclarationError(
            f"friction at {contact.name!r}, whose impacts reverse the slip",
            expected="a contact without tangential restitution",
            advice="leave out one of the two",
        )
    return Coulomb(
        contact.body,
        on=contact.on,
        mu=mu,
        mu_static=mu_static,
        name=contact.name,
        force=contact.force,
        restitution=contact.restitution,
        at=contact.at,
    )


def with_edge(system: System, edge: ExprLike) -> System:
    """The same system with every sheet ending at an edge (m); beyond lies a table at rest.

    Raises:
        DeclarationError: for a system without a sheet.
    """
    contacts = [contact for contact in system.contacts if isinstance(contact.on, Sheet)]
    if not contacts:
        raise DeclarationError(
            f"an edge for {system.name!r}, in which nothing lies on a sheet",
            expected="a system with a contact on a Sheet",
        )
    cut = {c.name: c.on_support(c.on.ending(edge)) for c in contacts if isinstance(c.on, Sheet)}
    return with_elements(system, dict(cut))


def _refuse_unlisted(independent: object, speeds: object) -> None:
    """Refuse speeds that are not given as a list or by name."""
    if not isinstance(independent, Iterable):
        raise DeclarationError(
            f"independent={independent!r}", expected="a list of speeds, such as [v_x]"
        )
    if not isinstance(speeds, Mapping):
        raise DeclarationError(
            f"speeds={speeds!r}", expected='a dictionary, such as {"J": x*y.dt() - y*x.dt()}'
        )
