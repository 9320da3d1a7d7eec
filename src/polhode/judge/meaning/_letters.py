"""Letters with a common meaning, each with the quantities of a model it may stand for.

Where the field uses a letter for more than one quantity of a system, all of them are listed, the
likeliest first: **L** may be about the centre of mass or about a fixed point, **v** the velocity of
one body or of another. Unit vectors x, y, z are those of frames at rest, never those of a frame
that turns with the body and happens to have the same labels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Name, Node
from polhode.judge.meaning._mechanics import Mechanics
from polhode.model import Contact, Gravity, Pivot

_VECTOR, _HAT = "vector", "hat"

#: A letter with phrases for the quantities it may stand for, the likeliest first.
Entry = tuple[Node, tuple[str, ...]]


#: Labels that texts print for others: v_CM for v_cm, F_net for the total force.
_USUAL_LABELS = {
    **dict.fromkeys(("cm", "com"), "cm"),
    **dict.fromkeys(("net", "tot", "sum"), "total"),  # but F_ext may be applied, F_res resist
}


def with_usual_label(name: Name) -> Name:
    """The letter with the label under which it is listed: v_cm for v_CM and v_{c.m.}."""
    label = _USUAL_LABELS.get(name.subscript.replace(".", "").lower())
    return replace(name, subscript=label) if label else name


@lru_cache(maxsize=16)  # systems; mechanics are compared by identity
def phrases_by_letter(mechanics: Mechanics) -> dict[Node, tuple[str, ...]]:
    """Phrases for what each letter may stand for, the likeliest first."""
    found: dict[Node, dict[str, None]] = {}
    for entries in (_energies, _elements, _motion, _directions):
        for node, phrases in entries(mechanics):
            found.setdefault(node, {}).update(dict.fromkeys(phrases))
    return {node: tuple(phrases) for node, phrases in found.items()}


def _energies(mechanics: Mechanics) -> Iterator[Entry]:
    yield from {
        Name("T"): ("kinetic energy",),
        Name("V"): ("potential energy",),
        Name("U"): ("potential energy",),
        Name("E"): ("energy",),
        Name("cal L"): ("lagrangian",),
        Name("T", "rot"): ("rotational kinetic energy",),
        Name("T", "cm"): ("translational kinetic energy",),
    }.items()
    for symbol in mechanics.equations.coordinates:
        name = name_of(symbol.published)
        for letter in ("P", "p"):
            label = name.letter if isinstance(name, Name) and not name.subscript else symbol.name
            yield Name(letter, label), (f"momentum conjugate to {symbol.published}",)


def _motion(mechanics: Mechanics) -> Iterator[Entry]:
    bodies = mechanics.bodies
    total = Name("omega", "total", decoration=_VECTOR)
    if len(bodies) == 1:
        yield total, ("angular velocity",)
        yield Name("I", "cm", decoration=_VECTOR), ("inertia",)
        for label in mechanics.body.axes.labels:
            yield Name("I", label), (f"moment of inertia {label}",)
    for letter, quantity in (
        ("omega", "angular velocity"),
        ("v", "velocity"),
        ("r", "position"),
        ("I", "inertia"),
    ):
        of_each = [""] if len(bodies) == 1 else [f" of {body.name}" for body in bodies]
        if letter == "I" and len(bodies) == 1:
            yield Name(letter, decoration=_VECTOR), about_points("inertia", mechanics)
            continue
        yield Name(letter, decoration=_VECTOR), tuple(f"{quantity}{of}" for of in of_each)
    yield from {
        Name("v", "cm", decoration=_VECTOR): ("velocity of cm",),
        Name("a", "cm", decoration=_VECTOR): ("acceleration of cm",),
        Name("r", "cm", decoration=_VECTOR): ("position of cm",),
        Name("P", decoration=_VECTOR): ("momentum",),
        Name("P", "total", decoration=_VECTOR): ("momentum",),
        Name("p", decoration=_VECTOR): ("momentum",),
        Name("L", decoration=_VECTOR): about_points("angular momentum", mechanics),
        Name("L", "cm", decoration=_VECTOR): ("angular momentum about cm",),
        Name("L", "O", decoration=_VECTOR): ("angular momentum about origin",),
        Name("tau", decoration=_VECTOR): about_points("torque", mechanics),
        Name("tau", "cm", decoration=_VECTOR): ("torque about cm",),
        Name("tau", "O", decoration=_VECTOR): ("torque about origin",),
        Name("tau", "total", decoration=_VECTOR): about_points("torque", mechanics),
        Name("F", "total", decoration=_VECTOR): ("total force",),
    }.items()
    if any(isinstance(load, Gravity) for load in mechanics.equations.system.loads):
        yield Name("g", decoration=_VECTOR), ("gravity",)


def about_points(quantity: str, mechanics: Mechanics) -> tuple[str, ...]:
    """The quantity about the centre of mass, and about every point that a pivot keeps at rest.

    Where none is kept at rest, the origin of the laboratory is such a point. A particle has no
    moment about itself.
    """
    fixed = [
        e.name
        for e in mechanics.equations.kinetics.elements
        if isinstance(e, Pivot) and e.is_at_rest
    ]
    bodies = mechanics.bodies
    is_particle = len(bodies) == 1 and bodies[0].inertia.is_zero
    points = [*(() if is_particle else ("cm",)), *(fixed or ("origin",))]
    return tuple(f"{quantity} about {point}" for point in points)


def _elements(mechanics: Mechanics) -> Iterator[Entry]:
    """Velocity, force and moments of contacts and pivots, and forces of loads.

    A plain letter, without the label of an element, may mean any of them.
    """
    kinetics = mechanics.equations.kinetics
    for element in kinetics.elements:
        forces = [r for r in kinetics.restraints[element.name] if not r.is_couple]
        if not forces:
            continue
        letter = name_of(forces[0].name)
        # What holds a light link acts on no body that a letter could speak of.
        if isinstance(letter, Name) and set(element.bodies) & set(mechanics.bodies):
            plain = replace(letter, subscript="", decoration=_VECTOR)
            yield plain, (f"force of {element.name}",)
        kinds = ((Contact, ("contact",)), (Pivot, ("pivot", "p")))
        usual = next((labels for kind, labels in kinds if isinstance(element, kind)), ())
        for label in (element.name, *usual):
            yield Name("F", label, decoration=_VECTOR), (f"force of {element.name}",)
            yield Name("v", label, decoration=_VECTOR), (f"velocity of {element.name}",)
            yield Name("L", label, decoration=_VECTOR), (f"angular momentum about {element.name}",)
            yield Name("tau", label, decoration=_VECTOR), (f"torque about {element.name}",)
    for load in mechanics.equations.system.loads:
        yield Name("F", load.name, decoration=_VECTOR), (f"force of {load.name}",)


def _directions(mechanics: Mechanics) -> Iterator[Entry]:
    """Unit vectors: of frames at rest, then of the body's axes, then of the frames between."""
    axes = mechanics.body.axes
    named = mechanics.frames
    # Of two frames with one name, only the one that the name stands for is listed.
    chain = tuple(f for f in reversed(axes.lineage) if named[f.name] == f)
    turning = {frame.name: frame for frame in chain}
    known: set[str] = set()
    for labels, frames in (
        (axes.root.labels, mechanics.frames_at_rest),
        (axes.labels, {axes.name: axes}),
        ((), turning),
    ):
        for name, frame in frames.items():
            for label in labels or set(frame.labels) - known:
                if label in frame.labels and label not in known:
                    yield Name(label, decoration=_HAT), (f"axis {label} of {name}",)
        known.update(labels)
    for frame in reversed(chain):
        # As a subscript of ω, texts write the labels of a triad: 123, (1,2,3) or 1,2,3.
        short = all(len(label) == 1 for label in frame.labels)
        joined = "".join(frame.labels) if short else " ".join(frame.labels)
        for subscript in (joined, f"({','.join(frame.labels)})", ",".join(frame.labels)):
            yield (
                Name("omega", subscript, decoration=_VECTOR),
                (f"angular velocity of {frame.name}",),
            )
