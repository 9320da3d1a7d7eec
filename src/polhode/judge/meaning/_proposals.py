"""Letters that the field uses for a quantity by habit, though a text may define them otherwise.

A plain L may be the Lagrangian, the magnitude of **L**, or **L** that lost its boldness; N a torque
or a normal force; T a tension or a period as well as the kinetic energy. Each letter is listed
with all such quantities of a system, the likeliest first. Which of them fits a formula is
decided by its dimensions, and by whether it is a vector.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import lru_cache, partial, reduce
from itertools import product

from polhode.algebra import Vector, as_symbol, time
from polhode.base import PolhodeError
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Name, Node
from polhode.judge.meaning._derived_quantities import (
    axis_of_rotation,
    direction_of_increasing,
    down_the_slope,
    effective_potential,
    generalised_force,
    has_gravity,
    holds_a_particle,
    moment_about_any_axis,
    outwards,
    own_moment_of_inertia,
    phase_space,
    radius_of_gyration,
)
from polhode.judge.meaning._letters import Entry, about_points, phrases_by_letter
from polhode.judge.meaning._mechanics import ALL_FORCES, Mechanics
from polhode.judge.meaning._small_oscillations import (
    ORDINALS,
    frequencies,
    has_speed,
    normal_frequencies,
)
from polhode.model import (
    Body,
    Constraint,
    Contact,
    Coulomb,
    Gravity,
    Pivot,
    Rope,
    Spring,
    TorsionSpring,
)

#: In place of a phrase: the letter is the text's own, and its first equation says what it means.
OWN = "defined by the text"

#: The beginning of the phrase for the length of a vector.
MAGNITUDE = "magnitude of "

#: The ends of phrases for what has a sign, as the one coordinate of a body counts it.
SENSES = _ALONG_AXIS, _ALONG_PATH = " along its axis of rotation", " along its path"
_AGAINST_PATH = " against its path"
_OPPOSITE = ", opposite in sign"

#: The label of the greatest value of a quantity: an upper bound of it.
GREATEST = "max"

_VECTOR = "vector"
_TURNING, _MOVING = ("rot", "rotation"), ("trans", "transl", "tr", "translation", "cm")
_KINETIC = ("K", "KE", "E", "T")
#: Letters that stand for an energy with a label of its kind, whose letter alone may be free.
_LABELLED_ENERGIES = {
    Name(letter, label): phrase
    for phrase, names in {
        "kinetic energy": (*product("ET", ("kin", "kinetic")), *product("E", "kK"), ("KE", "")),
        "rotational kinetic energy": product(_KINETIC, _TURNING),
        "translational kinetic energy": product(_KINETIC, _MOVING),
        "energy": product("E", ("total", "mech", "mechanical")),
        "potential energy": (
            *product("EUV", ("pot", "potential")),
            *product("E", "pP"),
            ("PE", ""),
        ),
    }.items()
    for letter, label in names
}
_OF_LOADS = (
    (Gravity, (*product("UVE", ("g", "grav")), ("GPE", ""))),
    ((Spring, TorsionSpring), (*product("UVE", ("s", "el", "spring")), ("EPE", ""))),
)
#: Quantities that one of these letters is always: no text uses them for anything of its own.
ALWAYS = {Name("omega", "0"), Name("T", "0"), Name("U", "eff"), Name("V", "eff"), Name("mu")}
_ROTATIONAL = ("L", "tau", "omega", "alpha", "N", "M", "K", "Gamma", "H", "J", "G", "Omega")
_NORMAL = ("N", "R")
_RADIUS = Name("r")
_FORCE = Name("F")  # of all forces that are given no letter, and of all together
_OSCILLATING = {
    Name("omega", "0"): "frequency",
    Name("omega", "n"): "frequency",
    Name("omega"): "frequency",
    Name("Omega"): "frequency",
    Name("T"): "period",
    Name("T", "0"): "period",
    Name("tau"): "period",
    Name("P"): "period",
    Name("f"): "number per second",
    Name("nu"): "number per second",
}
_UPRIGHT = ("v", "V", "vert")  # labels of vertical components
_SPINNING = (Name("omega"), Name("Omega"))
#: Letters for the frequencies of normal modes; which of them is which is the choice of the text.
NORMAL_MODES = {Name(n, label) for n in ("omega", "Omega") for label in ("1", "2", "3", "+", "-")}
#: Letters that texts define for themselves as often as not: a formula that fails for the quantity
#: proposed may be a definition, so that both answers are given.
FREE = frozenset({"alpha", "Omega", "omega", "K", "k", "P", "p", "r", "R", "G", "J", "Gamma", "W"})


def proposed_phrases(mechanics: Mechanics, letter: Name) -> tuple[str, ...]:
    """Phrases for what a letter may stand for by habit, the likeliest first."""
    declared = _declared_forces(mechanics).get(letter)
    found = _by_letter(mechanics).get(letter, ())
    if declared is not None and letter != _FORCE:
        # friction is as a rule given by its size, whichever way it points
        return (declared, declared + _OPPOSITE) if letter == Name("f") else (declared,)
    if declared is not None:
        found = (declared, declared + _OPPOSITE, *found)
    # Sought only for these letters, since it takes a while.
    if letter in _OSCILLATING:
        found = (*found, *_of_oscillations(mechanics, letter))
    if letter in {*NORMAL_MODES, Name("omega")} and not _is_axis(mechanics, letter.subscript):
        found = (*found, *_of_normal_modes(mechanics))
    is_own = letter not in ALWAYS and not _is_entry(letter)
    return (*found, OWN) if found and is_own else found


def _is_axis(mechanics: Mechanics, label: str) -> bool:
    """Whether a label is one of axes, so that ω₁ is a component and no frequency of a mode."""
    return Name(label, decoration="hat") in phrases_by_letter(mechanics)


def _is_entry(letter: Name) -> bool:
    """Whether a letter is an entry of the inertia tensor, which no text defines one by one."""
    return letter.letter == "I" and len(letter.subscript) == 2 and letter.subscript.isdigit()


@lru_cache(maxsize=16)  # systems; mechanics are compared by identity
def _by_letter(mechanics: Mechanics) -> dict[Node, tuple[str, ...]]:
    vectors = _merged(_vectors(mechanics))
    known = {**phrases_by_letter(mechanics), **vectors}
    plain = {
        replace(node, decoration=""): phrases
        for node, phrases in known.items()
        if isinstance(node, Name) and node.decoration == _VECTOR and node.letter not in "IK"
    }
    has_axis = _has(axis_of_rotation, mechanics)
    bold = {
        node: tuple(p for p in found if not _is_plain_force(node, p))
        for node, phrases in plain.items()
        for found in [_about_axis(phrases) if has_axis else phrases]
    }
    sizes = {node: _by_one_number(mechanics, node, found) for node, found in plain.items()}
    axes = (*_unit_vectors(mechanics), *_primed(mechanics), *_tensors(mechanics))
    return _merged((*vectors.items(), *axes, *bold.items(), *_scalars(mechanics), *sizes.items()))


@lru_cache(maxsize=16)  # systems; mechanics are compared by identity
def _declared_forces(mechanics: Mechanics) -> dict[Node, str]:
    """Letters that the declaration gives to a force of one component: R of R_x at a smooth wall.

    Components that always vanish, as across a guide in a plane, do not count.
    """
    found: dict[Node, list[str]] = {}
    for restraints in mechanics.equations.kinetics.restraints.values():
        for restraint in (r for r in restraints if not r.is_couple):
            letter = name_of(restraint.name)
            if isinstance(letter, Name):
                found.setdefault(replace(letter, subscript=""), []).append(restraint.name)
    values = mechanics.equations.components
    acting = {
        n: [name for name in names if len(names) == 1 or values[name]] for n, names in found.items()
    }
    return {n: f"declared {names[0]}" for n, names in acting.items() if len(names) == 1}


def _is_plain_force(letter: Node, phrase: str) -> bool:
    """Whether a letter is that of a force which is as a rule given by its size: N, R, f or T."""
    is_force = phrase.startswith("force of ")
    return is_force and isinstance(letter, Name) and letter.letter in (*_NORMAL, "f", "T")


def _about_axis(phrases: tuple[str, ...]) -> tuple[str, ...]:
    """Moments of a body that turns about a fixed axis: about a point that is held, if one is."""
    held = any(" about " in p and not p.endswith(" about cm") for p in phrases)
    return tuple(p for p in phrases if not held or not p.endswith(" about cm"))


def unsigned(phrase: str) -> str:
    """The phrase for the vector, of one for its magnitude or what an axis or path counts of it."""
    ends = (_ALONG_AXIS, _ALONG_PATH, _AGAINST_PATH, _OPPOSITE)
    phrase = phrase.removeprefix(MAGNITUDE).replace("friction of ", "tangential force of ")
    return reduce(str.removesuffix, ends, phrase)


def is_free(letter: Node, mechanics: Mechanics) -> bool:
    """Whether texts define a letter for themselves as often as not.

    Among them is the N of a body on a light arm, of which a text has to say what it is normal to.
    """
    if letter == Name("N"):
        elements = mechanics.equations.system.elements
        pivots = [e for e in elements if isinstance(e, Pivot)]
        on_arms = all(not isinstance(e.to, Vector) or e.body.is_massless for e in pivots)
        return on_arms and not any(isinstance(e, Contact) for e in elements)
    if not isinstance(letter, Name) or letter.decoration == "hat":
        return False
    if letter.letter == "p" and letter.subscript:
        return False  # p_2 is the momentum of a coordinate or of a body
    return letter.letter in FREE and letter not in ALWAYS and letter not in _LABELLED_ENERGIES


def _by_one_number(mechanics: Mechanics, letter: Node, phrases: tuple[str, ...]) -> tuple[str, ...]:
    """What the plain letter of a vector stands for: its length, or a component with a sign.

    Of a body that turns about a fixed axis, L, τ, ω and α count as the angle does; on a slope,
    accelerations count downwards and friction upwards. A plain N is a normal force.
    """
    name = letter.letter if isinstance(letter, Name) else ""
    forces = tuple(p for p in phrases if p.startswith("force of "))
    others = tuple(p for p in phrases if p not in forces)
    if name in _NORMAL and others:
        phrases = others
    if name in _ROTATIONAL and _has(axis_of_rotation, mechanics):
        held = _about_axis(phrases)
        counted = tuple(f"{phrase}{_ALONG_AXIS}" for phrase in held)
        return (*counted, *(f"{MAGNITUDE}{phrase}" for phrase in held))
    if name == "a" and _has(down_the_slope, mechanics):
        return tuple(f"{phrase} down the slope" for phrase in phrases)
    if name in ("f", "T"):
        return ()
    sizes = tuple(f"{MAGNITUDE}{phrase}" for phrase in phrases)
    moving = [p for p in phrases if p.startswith(("acceleration", "velocity"))]
    # Which way the parts of a machine move is the choice of the text.
    ways = (_ALONG_PATH, _AGAINST_PATH) if name == "a" and len(phrases) > 1 else (_ALONG_PATH,)
    return (*sizes, *(f"{phrase}{way}" for phrase in moving for way in ways))


def _has(find: Callable[[Mechanics], object], mechanics: Mechanics) -> bool:
    try:
        find(mechanics)
    except (PolhodeError, ZeroDivisionError):
        return False
    return True


def _merged(entries: Iterable[Entry]) -> dict[Node, tuple[str, ...]]:
    found: dict[Node, dict[str, None]] = {}
    for node, phrases in entries:
        found.setdefault(node, {}).update(dict.fromkeys(phrases))
    return {node: tuple(phrases) for node, phrases in found.items() if phrases}


# -- vectors ------------------------------------------------------------------------------------


def _vectors(mechanics: Mechanics) -> Iterator[Entry]:
    torques = about_points("torque", mechanics)
    momenta = about_points("angular momentum", mechanics)
    forces = tuple(f"force of {name}" for name in _holding(mechanics))
    for letter, phrases in (
        ("F", ("total force",) if _is_attracted(mechanics) else ()),
        ("Gamma", torques),
        ("N", (*torques, *forces)),
        ("K", torques),  # Landau and Lifshitz, Mechanics, § 34
        ("M", (*torques, *momenta)),  # the latter there, § 9
        ("G", torques),
        ("H", momenta),
        ("J", momenta),
        ("R", (*forces, "position of cm")),
        ("T", tuple(f"force of {name}" for name in _strings(mechanics))),
        ("f", (*_tangential(mechanics), *forces)),
        ("a", (*_accelerations(mechanics), *_arms(mechanics))),
        ("V", ("velocity of cm",)),
        ("Omega", tuple(_rotations(mechanics)) or ("angular velocity",)),
        ("alpha", ("angular acceleration",)),
    ):
        yield Name(letter, decoration=_VECTOR), phrases
    # G is the centre of mass, as a rule of the one body that is no particle.
    extended = [b.name for b in mechanics.bodies if not b.inertia.is_zero]
    of_each = ["cm", *(extended if len(mechanics.bodies) > 1 else [])]
    for load in mechanics.equations.system.loads:
        if isinstance(load, Gravity):
            for label in ("g", "G", "grav"):
                yield Name("F", label, decoration=_VECTOR), (f"force of {load.name}",)
    for letter, quantity in (("v", "velocity"), ("r", "position"), ("a", "acceleration")):
        yield Name(letter, "G", decoration=_VECTOR), tuple(f"{quantity} of {p}" for p in of_each)


def _arms(mechanics: Mechanics) -> Iterator[str]:
    """The vector from the centre to the contact, of a body whose radius is declared as a."""
    if Name("a") in mechanics.letters:
        contacts = mechanics.equations.system.contacts
        yield from (f"arm of {contact.name}" for contact in contacts)


def _accelerations(mechanics: Mechanics) -> tuple[str, ...]:
    """Of the centre of mass; of each body where they move together, as in Atwood's machine."""
    if len(mechanics.equations.speeds) != 1 or len(mechanics.bodies) == 1:
        return ("acceleration of cm",)
    moving = (b.name for b in mechanics.bodies if not mechanics.velocity(b.name).is_zero)
    return tuple(f"acceleration of {name}" for name in moving)


def _tangential(mechanics: Mechanics) -> Iterator[str]:
    """The friction of contacts that hold a body back, as vectors."""
    elements = mechanics.equations.system.contacts
    holding = _holding(mechanics)
    yield from (f"tangential force of {e.name}" for e in elements if e.name in holding)


def _rotations(mechanics: Mechanics) -> Iterator[str]:
    """The given rotations for whose rate the declaration has the letter Ω: turntable and Earth."""
    rate = mechanics.letters.get(Name("Omega"))
    if rate is None:
        return
    for contact in mechanics.equations.system.elements:
        if isinstance(contact, Contact) and contact.on.turning == rate:
            yield f"angular velocity of the support of {contact.name}"
    root = mechanics.body.axes.root
    if rate.symbol in {s for c in root.angular_velocity.components for s in c.symbols()}:
        yield f"angular velocity of {root.name}"


def _strings(mechanics: Mechanics) -> list[str]:
    """Names of the strings and light rods that hold particles."""
    pivots = (e for e in mechanics.equations.system.elements if isinstance(e, Pivot))
    return [pivot.name for pivot in pivots if holds_a_particle(pivot)]


def _holding(mechanics: Mechanics) -> list[str]:
    """Names of the contacts and joints that exert forces."""
    restraints = mechanics.equations.kinetics.restraints
    return [name for name, found in restraints.items() if any(not r.is_couple for r in found)]


def _unit_vectors(mechanics: Mechanics) -> Iterator[Entry]:
    """Axes numbered or primed: **E**₃ of the space, **e**₃ of the body, x̂′ after one rotation.

    As many primes as rotations from the frame at rest: O'Reilly, Intermediate Dynamics, § 6.8. One
    prime may also be for the axes before the last rotation: Taylor, Classical Mechanics, § 10.9.
    """
    axes = mechanics.body.axes
    chain = tuple(reversed(axes.lineage))
    named = (
        ("e", axes, 0),
        ("E", axes.root, 0),
        *((("e", f, n)) for n, f in enumerate(chain) if n),
        *((("e", f, 1)) for f in reversed(chain[2:-1])),
    )
    for (letter, frame, primes), decoration in product(named, (_VECTOR, "hat")):
        if mechanics.frames.get(frame.name) != frame:
            continue
        for number, label in enumerate(frame.labels, 1):
            phrase = (f"axis {label} of {frame.name}",)
            for below in (str(number), label) if primes or letter == "E" else (str(number),):
                yield Name(letter, below, primes, decoration), phrase
            if primes:
                yield Name(label, "", primes, decoration), phrase
    for letter, label in zip("ijk", axes.root.labels, strict=True):
        for decoration in (_VECTOR, "hat"):
            yield Name(letter, decoration=decoration), (f"axis {label} of {axes.root.name}",)


def _primed(mechanics: Mechanics) -> Iterator[Entry]:
    """Goldstein's ω_x' and ω'₁ along axes of the body; elsewhere x' is that after one rotation."""
    axes = mechanics.body.axes
    chain = tuple(reversed(axes.lineage))
    if mechanics.frames.get(axes.name) != axes or len(chain) < 2:
        return
    for label, own in zip(axes.root.labels, axes.labels, strict=True):
        after = [f"axis {label} of {chain[1].name}"] if label in chain[1].labels else []
        yield Name(f"{label}'", decoration="hat"), (f"axis {own} of {axes.name}", *after)
    for own in axes.labels:
        for letter, vector in (("omega", "angular velocity"), ("L", "angular momentum about cm")):
            yield Name(letter, own, 1), (f"{vector} along axis {own} of {axes.name}",)


def _tensors(mechanics: Mechanics) -> Iterator[Entry]:
    """Other ways to print the inertia tensor, and its components."""
    if len(mechanics.bodies) > 1:
        return
    phrases = about_points("inertia", mechanics)
    for decoration in ("tilde", "tilde vector", "bar", "bar vector", "hat"):
        yield Name("I", decoration=decoration), phrases
    for letter in ("cal I", "bb I"):
        yield Name(letter), phrases
    for row, column in product(mechanics.body.axes.labels, repeat=2):
        yield Name("I", f"{row}{column}"), (f"inertia component {row} {column}",)


# -- scalars ------------------------------------------------------------------------------------


def _scalars(mechanics: Mechanics) -> Iterator[Entry]:
    yield from _energies(mechanics)
    yield from _powers(mechanics)
    yield from _generalised_forces(mechanics)
    yield from _reactions(mechanics)
    yield from _moments_of_inertia(mechanics)
    yield from _without_tags(mechanics)
    yield from _in_polar_coordinates(mechanics)
    yield from _radii_of_gyration(mechanics)
    if len(mechanics.bodies) == 1:
        yield Name("v", GREATEST), ("greatest magnitude of velocity",)
    yield from _bodies(mechanics)


def _without_tags(mechanics: Mechanics) -> Iterator[Entry]:
    """x for the x_c of the cart, the one body of several that has such a coordinate."""
    found: dict[Node, list[str]] = {}
    for body in mechanics.bodies:
        for q in mechanics.declared.coordinates:
            if body.tag and q.published.endswith(body.tag):
                found.setdefault(name_of(q.published.removesuffix(body.tag)), []).append(
                    q.published
                )
    for letter, coordinates in found.items():
        if len(coordinates) == 1 and letter not in mechanics.letters:
            yield letter, (f"declared {coordinates[0]}",)


def _in_polar_coordinates(mechanics: Mechanics) -> Iterator[Entry]:
    """θ̂ of a particle and its F_θ, which by itself is the total force."""
    body = mechanics.body
    if len(mechanics.bodies) > 1 or not body.inertia.is_zero:
        return
    for symbol in mechanics.declared.coordinates:
        letter, towards = name_of(symbol.published), f"direction of increasing {symbol.published}"
        moves = partial(direction_of_increasing, coordinate=symbol.published)
        if isinstance(letter, Name) and not letter.subscript and _has(moves, mechanics):
            yield replace(letter, decoration="hat"), (towards,)
            yield Name("F", letter.letter), (f"total force in the {towards}",)
            if letter == _RADIUS and _is_attracted(mechanics):
                yield Name("F"), (f"total force in the {towards}",)
    is_radius = any(name_of(q.published) == _RADIUS for q in mechanics.declared.coordinates)
    if not is_radius and _has(outwards, mechanics):
        forces = ("total force", *(f"force of {name}" for name in _holding(mechanics)))
        yield Name("F", "r"), tuple(f"{force} along the position" for force in forces)


def _is_attracted(mechanics: Mechanics) -> bool:
    """Whether a particle moves under a load of its own, such as a central force."""
    loads = mechanics.equations.system.loads
    is_particle = len(mechanics.bodies) == 1 and mechanics.body.inertia.is_zero
    return is_particle and any(not isinstance(load, Gravity) for load in loads)


def _radii_of_gyration(mechanics: Mechanics) -> Iterator[Entry]:
    points = [p.rpartition(" about ")[2] for p in about_points("inertia", mechanics)]
    known = [p for p in points if _has(partial(radius_of_gyration, about=p), mechanics)]
    if len(mechanics.bodies) == 1 and known:
        yield Name("k"), tuple(f"radius of gyration about {point}" for point in known)


def _moments_of_inertia(mechanics: Mechanics) -> Iterator[Entry]:
    """Of a body that turns about a fixed axis, along that axis; of a ball, along any.

    Beside particles it is that of the only extended body, such as the pulley of a rope.
    """
    extended = [body.name for body in mechanics.bodies if not body.inertia.is_zero]
    is_one = len(extended) == 1 < len(mechanics.bodies)
    if is_one and _has(partial(own_moment_of_inertia, of=extended[0]), mechanics):
        yield Name("I"), (f"moment of inertia of {extended[0]} along its axis of rotation",)
    if not _has(axis_of_rotation, mechanics):
        if _has(partial(moment_about_any_axis, about="cm"), mechanics):
            for label in ("", "cm", "0", "C", "G"):
                yield Name("I", label), ("moment of inertia about cm along any axis",)
        return
    for phrase in about_points("moment of inertia", mechanics):
        along = (f"{phrase} along its axis of rotation",)
        point = phrase.rpartition(" about ")[2]
        usual = ("O", "P", "p") if point != "cm" else ("0", "C", "G")
        for label in ("", point, *usual):
            yield Name("I", label), along


def _energies(mechanics: Mechanics) -> Iterator[Entry]:
    yield Name("i"), ("imaginary unit",)
    yield Name("L"), ("lagrangian",)
    yield Name("K"), ("kinetic energy",)
    yield Name("S"), ("energy of acceleration",)
    yield from ((letter, (phrase,)) for letter, phrase in _LABELLED_ENERGIES.items())
    for load in mechanics.equations.system.loads:
        names = next((n for kind, n in _OF_LOADS if isinstance(load, kind)), ())
        yield from ((Name(*name), (f"potential energy of {load.name}",)) for name in names)
    if not mechanics.has_other_loads:
        yield Name("W"), ("work of all loads",)
    yield from _functions_of_phase_space(mechanics)


def _functions_of_phase_space(mechanics: Mechanics) -> Iterator[Entry]:
    """Hamiltonian, Routhian and effective potential, of a system that has them."""
    try:
        phase_space(mechanics)
    except (PolhodeError, ZeroDivisionError):
        return
    for letter in ("H", "cal H"):
        yield Name(letter), ("hamiltonian",)
    for letter in ("R", "cal R"):
        yield Name(letter), ("routhian", f"routhian{_OPPOSITE}")
    if as_symbol(time) in mechanics.lagrangian().symbols():
        return  # an effective potential is then one that is averaged over time
    for letter in ("U", "V"):
        for label in ("eff", "effective"):
            yield Name(letter, label), ("effective potential energy",)
        yield Name(letter, primes=1), ("effective potential energy",)
    # Of a bead on a hoop that is kept turning, texts call this the potential energy.
    if not phase_space(mechanics).cyclic and _has(effective_potential, mechanics):
        for letter in ("U", "V"):
            yield Name(letter), ("effective potential energy",)


def _powers(mechanics: Mechanics) -> Iterator[Entry]:
    loads = [load.name for load in mechanics.equations.system.loads]
    of_each = (*loads, *([ALL_FORCES] if len(loads) != 1 else []))
    yield Name("P"), tuple(f"power of {name}" for name in of_each)


def _generalised_forces(mechanics: Mechanics) -> Iterator[Entry]:
    for symbol in mechanics.declared.coordinates:
        coordinate = name_of(symbol.published)
        known = partial(generalised_force, coordinate=symbol.published)
        if isinstance(coordinate, Name) and _has(known, mechanics):
            label = coordinate.subscript or coordinate.letter
            yield Name("Q", label), (f"generalised force of {symbol.published}",)


def _reactions(mechanics: Mechanics) -> Iterator[Entry]:
    for number, element in enumerate(mechanics.equations.system.elements, 1):
        if isinstance(element, Contact):
            yield from _of_contact(element, _has(down_the_slope, mechanics))
        elif isinstance(element, Rope):
            yield from _of_rope(mechanics, element)
        elif isinstance(element, Constraint):
            yield from _of_constraint(mechanics, element)
        elif isinstance(element, Pivot):
            yield from _of_pivot(mechanics, element, number)


def _of_pivot(mechanics: Mechanics, pivot: Pivot, number: int) -> Iterator[Entry]:
    if has_gravity(mechanics):
        upright = f"vertical force of {pivot.name}"
        for letter in ("N", "R"):
            yield Name(letter), (upright, *_along_turning(mechanics, pivot))
        for letter, label in product(("F", "N", "R"), _UPRIGHT):
            yield Name(letter, label), (upright,)
    if holds_a_particle(pivot):
        for letter in ("T", "S"):
            yield Name(letter, GREATEST), (f"greatest tension of {pivot.name}",)
        for letter, label in product(("T", "S", "F"), ("", str(number), pivot.name)):
            yield Name(letter, label), (f"tension of {pivot.name}",)


def _along_turning(mechanics: Mechanics, pivot: Pivot) -> tuple[str, ...]:
    """Components of its force along axes that turn, as of a ball that is held on a sphere."""
    if not any(s.kind.varies for f in pivot.along.lineage for s in f.angle.symbols()):
        return ()
    equations, restraints = mechanics.equations, mechanics.equations.kinetics.restraints[pivot.name]
    forces = (r for r in restraints if not r.is_couple)
    acting = (r for r in forces if equations.on_shell(equations.components[r.name]))
    return tuple(f"declared {r.name}" for r in acting)


def _of_rope(mechanics: Mechanics, rope: Rope) -> Iterator[Entry]:
    """Its tension, as T with the label that the declaration gives it."""
    for restraint in mechanics.equations.kinetics.restraints[rope.name]:
        declared = name_of(restraint.name)
        if isinstance(declared, Name):
            for letter in ("T", "S"):
                for label in ("", declared.subscript, rope.name):
                    yield Name(letter, label), (f"declared {restraint.name}",)


def _of_constraint(mechanics: Mechanics, constraint: Constraint) -> Iterator[Entry]:
    """The force of an equation between lengths, as of the string of a yo-yo: z = -r θ."""
    restraints = mechanics.equations.kinetics.restraints[constraint.name]
    for restraint in (r for r in restraints if not r.is_couple):
        for letter in ("T", "S", "F", "f", "N", "R"):
            yield Name(letter), (f"declared {restraint.name}",)


def _of_contact(contact: Contact, is_on_slope: bool) -> Iterator[Entry]:
    normal = (Name("N"), Name("R"), *(Name("F", label) for label in ("N", "n", "normal")))
    yield from ((name, (f"normal force of {contact.name}",)) for name in normal)
    labels = product("Ff", ("f", "fr", "fric", "friction"))
    friction = (Name("f"), Name("f", "s"), Name("f", "k"), *(Name(*label) for label in labels))
    for name in (*friction, *_sliding(contact)):
        size = f"friction of {contact.name}"
        on_slope = f"force of {contact.name} up the slope"
        # A body that slides may do so in any direction.
        sliding = (on_slope, size) if isinstance(contact, Coulomb) else (on_slope,)
        yield name, (sliding if is_on_slope else (size,))
    if isinstance(contact, Coulomb):
        for label in ("", "k"):
            yield Name("mu", label), (f"friction coefficient of {contact.name}",)


def _sliding(contact: Contact) -> tuple[Name, ...]:
    return (Name("F"),) if isinstance(contact, Coulomb) else ()


def _bodies(mechanics: Mechanics) -> Iterator[Entry]:
    """Quantities of one of several bodies, by its number, tag or name; momenta p_1, p_2."""
    for symbol in mechanics.equations.coordinates:
        coordinate = name_of(symbol.published)
        if isinstance(coordinate, Name) and coordinate.subscript:
            yield Name("p", coordinate.subscript), (f"momentum conjugate to {symbol.published}",)
    bodies = mechanics.bodies
    if len(bodies) == 1:
        return
    for number, body in enumerate(bodies, 1):
        for label in dict.fromkeys([body.tag.strip("_") or str(number), body.name]):
            yield Name("T", label), (f"kinetic energy of {body.name}",)
            for letter, quantity in (
                *(("v", "velocity"), ("r", "position"), ("a", "acceleration")),
                ("p", "momentum"),
                *((("omega", "angular velocity"),) if _turns(mechanics, body) else ()),
            ):
                phrase = f"{quantity} of {body.name}"
                yield Name(letter, label, decoration=_VECTOR), (phrase,)
                yield Name(letter, label), (phrase, f"{MAGNITUDE}{phrase}")


def _turns(mechanics: Mechanics, body: Body) -> bool:
    return not mechanics.angular_velocity(body.name).is_zero


def _of_oscillations(mechanics: Mechanics, letter: Name) -> tuple[str, ...]:
    """Phrases for a letter that is a frequency, a period or the like about each steady motion.

    Only ω and Ω are frequencies that a spin decides: ω₀ is as a rule the spin itself.
    """
    known = frequencies(mechanics)
    return tuple(
        f"{_OSCILLATING[letter]} of small oscillations"
        + (f" about {family}" if len(known) > 1 else "")
        for family, value in known.items()
        if letter in _SPINNING or not has_speed(mechanics, value)
    )


def _of_normal_modes(mechanics: Mechanics) -> tuple[str, ...]:
    known = normal_frequencies(mechanics)
    return tuple(
        f"{ordinal} frequency of small oscillations"
        + (f" about {family}" if len(known) > 1 else "")
        for family, values in known.items()
        for ordinal, _ in zip(ORDINALS, values, strict=False)
    )
