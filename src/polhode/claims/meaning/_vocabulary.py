"""What the letters of a text stand for in a model: by themselves, or as the text says."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cached_property, lru_cache, partial
from itertools import chain

from polhode.algebra import Expr, Kind, Symbol, Vector, pi, time
from polhode.claims.latex._tree import At, Call, Component, Differential, Dots, Name, Node, Number
from polhode.claims.meaning._meaning import BindingError, Meaning, dot, positive_root
from polhode.claims.meaning._mechanics import Mechanics
from polhode.claims.meaning._phrases import quantity
from polhode.claims.meaning._the import The
from polhode.derive import Equations
from polhode.model import Contact, Element, Gravity, Pivot

_VECTOR, _HAT = "vector", "hat"
_KEPT = 16


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """The letters of one text about one system.

    Attributes:
        mechanics: of the system.
        told: what the text says its letters stand for; goes before what is known by itself.
        positive: quantities that the text takes as positive.
        columns: name of the frame that components in a bracket are along.
    """

    mechanics: Mechanics
    told: Mapping[Node, Meaning] = field(default_factory=dict)
    positive: tuple[Expr, ...] = ()
    columns: str = ""

    @cached_property
    def found(self) -> dict[tuple[Node, bool, bool], Meaning]:
        """What nodes were found to stand for, by how ± and differentials were read."""
        return {}

    @classmethod
    def of(cls, equations: Equations) -> Vocabulary:
        """What is known from the declaration alone."""
        return cls(_mechanics(The(equations)))

    def saying(self, told: Mapping[Node, Meaning]) -> Vocabulary:
        """With more letters, or with other meanings."""
        return replace(self, told={**self.told, **told})

    @property
    def declared(self) -> dict[Node, Expr]:
        """Letters that the declaration itself uses, with their dots; they have their meaning."""
        return _declared(self.mechanics)

    @property
    def _known(self) -> dict[Node, Callable[[], Meaning]]:
        return _known(self.mechanics)

    def has(self, node: Node) -> bool:
        """Whether a letter stands for something."""
        return self.find(node) is not None

    def meaning(self, node: Node) -> Meaning:
        """What a letter stands for.

        Raises `BindingError` for one that stands for nothing, with names that resemble it.
        """
        found = self.find(node)
        if found is None:
            raise self._unknown(node)
        return found

    def find(self, node: Node) -> Meaning | None:
        """What a letter stands for, or None.

        Transcripts lose boldness and hats: a plain letter may be a vector, and the reverse.
        """
        if isinstance(node, Name):
            return self._named(node)
        if node in self.told:
            return self.told[node]
        if isinstance(node, At) and node.argument == Name("t"):
            return self.find(node.of)
        return None

    def _named(self, name: Name) -> Meaning | None:
        return next((found for found in self._candidates(name) if found is not None), None)

    def _candidates(self, name: Name) -> Iterator[Meaning | None]:
        """What a letter may mean, likeliest first: what the text says goes before what is known."""
        yield self.told.get(name)
        yield self._component(name, self.told.get)
        yield self._exactly(name)
        for form in _FORMS[name.decoration]:
            found = self._exactly(replace(name, decoration=form))
            yield self._unit(found) if name.decoration == _HAT else found
        yield self._component(name, self._exactly)
        if name.letter == "e":  # e_z for a unit vector
            yield self._exactly(Name(name.subscript, decoration=_HAT))

    def _exactly(self, name: Name) -> Meaning | None:
        if name in self.told:
            return self.told[name]
        return self._known[name]() if name in self._known else None

    def _unit(self, meaning: Meaning | None) -> Meaning | None:
        if not isinstance(meaning, Vector):
            return None
        return meaning / positive_root(meaning.dot(meaning), self.positive)

    def _component(self, name: Name, known: Callable[[Name], Meaning | None]) -> Meaning | None:
        """L_z, F_ρ, τ_1: a vector with the label of an axis below."""
        whole, _, label = name.subscript.rpartition(",")
        vector = known(replace(name, subscript=whole, decoration=_VECTOR)) if label else None
        if not isinstance(vector, Vector):
            return None
        axis = self._named(Name(label, decoration=_HAT))
        return dot(vector, axis) if isinstance(axis, Vector) else None

    def _unknown(self, node: Node) -> BindingError:
        names = {spelled(known): known for known in (*self.told, *self._known)}
        near = tuple(get_close_matches(spelled(node), names, n=3, cutoff=0.6))
        return BindingError(
            f"{spelled(node)}, which stands for nothing in {self.system}",
            expected="a quantity of the system, or a symbol that the text defines",
            advice=f"did you mean {' or '.join(near)}?" if near else "define it with --let",
            symbol=spelled(node),
            near=near,
        )

    @property
    def system(self) -> str:
        """Name of the system."""
        return self.mechanics.equations.system.name

    def letters(self) -> Iterator[Node]:
        """Letters of the text, scalars with their dots, and functions of the angles."""
        yield from (node for node in self.told if isinstance(node, Name))
        for name, value in self.mechanics.scalars.items():
            symbol = value.symbol
            if symbol is not None and symbol.order < 3:
                yield name_of(name)
        frames = self.mechanics.frames.values()
        turned = (sorted(frame.angle.symbols(), key=str) for frame in frames)
        for angle in dict.fromkeys(chain.from_iterable(turned)):
            if angle.kind is Kind.COORDINATE:
                yield from (Call(name, name_of(angle.published)) for name in ("sin", "cos"))

    def vectors(self) -> Iterator[Node]:
        """Letters of vectors that a text on this system may use, those of the text first."""
        named = (node for node, _ in automatic(self.mechanics))
        for node in dict.fromkeys([*self.told, *named]):
            if isinstance(node, Name) and node.decoration != _HAT:
                yield node


@lru_cache(maxsize=_KEPT)
def _mechanics(the: The) -> Mechanics:
    """The same for all texts on one system, with all that was found out about it."""
    return Mechanics(the.equations)


@lru_cache(maxsize=_KEPT)
def _declared(mechanics: Mechanics) -> dict[Node, Expr]:
    return {name_of(name): value for name, value in mechanics.scalars.items()}


@lru_cache(maxsize=_KEPT)
def _known(mechanics: Mechanics) -> dict[Node, Callable[[], Meaning]]:
    found: dict[Node, Callable[[], Meaning]] = {
        node: partial(quantity, mechanics, phrase) for node, phrase in automatic(mechanics)
    }
    fixed = {**_declared(mechanics), Name("pi"): pi, Name("t"): time}
    plain = {node: value for node, value in fixed.items() if isinstance(node, Name)}
    return found | {node: partial(Expr.of, value) for node, value in plain.items()}


#: How else a letter may have been printed, likeliest first.
_FORMS: dict[str, tuple[str, ...]] = {
    "": (_VECTOR,),
    _VECTOR: ("",),
    _HAT: (_VECTOR,),
    "bar": (),
    "tilde": (),
    "bar vector": ("bar",),
    "tilde vector": ("tilde",),
}


def automatic(mechanics: Mechanics) -> Iterator[tuple[Node, str]]:
    """Letters that mean the same in most texts, with the quantity of the model.

    Of two entries for one letter the later holds.
    """
    yield from _energies(mechanics)
    yield from _elements(mechanics)
    yield from _motion(mechanics)
    yield from _directions(mechanics)


def _energies(mechanics: Mechanics) -> Iterator[tuple[Node, str]]:
    yield from {
        Name("T"): "kinetic energy",
        Name("V"): "potential energy",
        Name("U"): "potential energy",
        Name("E"): "energy",
        Name("cal L"): "lagrangian",
        Name("T", "rot"): "rotational kinetic energy",
        Name("T", "cm"): "translational kinetic energy",
    }.items()
    for symbol in mechanics.equations.coordinates:
        name = name_of(symbol.published)
        for letter in ("P", "p"):
            label = name.letter if isinstance(name, Name) and not name.subscript else symbol.name
            yield Name(letter, label), f"momentum conjugate to {symbol.published}"


def _motion(mechanics: Mechanics) -> Iterator[tuple[Node, str]]:
    yield from {
        Name("omega", decoration=_VECTOR): "angular velocity",
        Name("omega", "total", decoration=_VECTOR): "angular velocity",
        Name("v", decoration=_VECTOR): "velocity",
        Name("v", "cm", decoration=_VECTOR): "velocity",
        Name("a", "cm", decoration=_VECTOR): "acceleration",
        Name("r", decoration=_VECTOR): "position",
        Name("r", "cm", decoration=_VECTOR): "position",
        Name("P", decoration=_VECTOR): "momentum",
        Name("p", decoration=_VECTOR): "momentum",
        Name("L", decoration=_VECTOR): "angular momentum about cm",
        Name("L", "cm", decoration=_VECTOR): "angular momentum about cm",
        Name("L", "O", decoration=_VECTOR): "angular momentum about origin",
        Name("P", "total", decoration=_VECTOR): "momentum",
        Name("tau", decoration=_VECTOR): "torque about cm",
        Name("tau", "cm", decoration=_VECTOR): "torque about cm",
        Name("I", decoration=_VECTOR): "inertia",
        Name("I", "cm", decoration=_VECTOR): "inertia",
        Name("F", "total", decoration=_VECTOR): "total force",
    }.items()
    if any(isinstance(load, Gravity) for load in mechanics.equations.system.loads):
        yield Name("g", decoration=_VECTOR), "gravity"
    for label in mechanics.body.axes.labels:
        yield Name("I", label), f"moment of inertia {label}"


def _elements(mechanics: Mechanics) -> Iterator[tuple[Node, str]]:
    """Velocity, force and moments of contacts and pivots; a plain F is that of the first."""
    kinetics = mechanics.equations.kinetics
    for element in reversed(kinetics.elements):
        forces = [r for r in kinetics.restraints[element.name] if not r.is_couple]
        if not forces:
            continue
        letter = name_of(forces[0].name)
        if isinstance(letter, Name):
            plain = replace(letter, subscript="", decoration=_VECTOR)
            yield plain, f"force of {element.name}"
        for label in (element.name, *_labels(element)):
            yield Name("F", label, decoration=_VECTOR), f"force of {element.name}"
            yield Name("v", label, decoration=_VECTOR), f"velocity of {element.name}"
            yield Name("L", label, decoration=_VECTOR), f"angular momentum about {element.name}"
            yield Name("tau", label, decoration=_VECTOR), f"torque about {element.name}"


def _labels(element: Element) -> tuple[str, ...]:
    """What texts write below a letter for the kind of contact or joint."""
    kinds = ((Contact, ("contact",)), (Pivot, ("pivot", "p")))
    return next((labels for kind, labels in kinds if isinstance(element, kind)), ())


def _directions(mechanics: Mechanics) -> Iterator[tuple[Node, str]]:
    axes = mechanics.body.axes
    between = reversed(axes.lineage[1:-1])
    # The laboratory's z goes before that of frames between it and the body's axes.
    for frame in dict.fromkeys((*between, axes.root, axes)):
        for label in frame.labels:
            yield Name(label, decoration=_HAT), f"axis {label} of {frame.name}"
        short = all(len(label) == 1 for label in frame.labels)
        joined = "".join(frame.labels) if short else " ".join(frame.labels)
        for subscript in (joined, f"({','.join(frame.labels)})", ",".join(frame.labels)):
            yield Name("omega", subscript, decoration=_VECTOR), f"angular velocity of {frame.name}"


_DOTS = {"_dot": 1, "_ddot": 2, "_dddot": 3}


def name_of(published: str) -> Node:
    """The letter that a published name is printed as: `Fprime_rho`, `theta_ddot`."""
    for ending, count in _DOTS.items():
        if published.endswith(ending):
            return Dots(name_of(published.removesuffix(ending)), count)
    stem, *subscripts = published.rstrip("_").split("_")
    letter = stem
    while letter.endswith("prime") and letter != "prime":
        letter = letter.removesuffix("prime")
    primes = (len(stem) - len(letter)) // len("prime")
    return Name(letter, ",".join(subscripts), primes)


def spelled(node: Node) -> str:
    """A letter in ASCII for messages: `omega_3`, `theta_dot`, `hat 3`, `vector L_cm`."""
    match node:
        case Name(letter, subscript, primes, decoration):
            below = f"_{subscript}" if subscript else ""
            prefix = f"{decoration} " if decoration else ""
            return f"{prefix}{letter}{'prime' * primes}{below}"
        case Number(text):
            return text
        case Dots(of, count):
            return f"{spelled(of)}_{'d' * (count > 1) * (count - 1)}dot"
        case Differential(of, sign):
            return f"{sign}{spelled(of)}"
        case At(of, argument):
            return f"{spelled(of)}({spelled(argument)})"
        case Component(of, subscript):
            return f"({spelled(of)})_{subscript}"
    return type(node).__name__.lower()


def constant(node: Node) -> Expr:
    """A new constant of the text, such as a time t₀."""
    name = "".join(c if c.isalnum() else "_" for c in spelled(node)).strip("_")
    return Expr.generator(Symbol(name, Kind.PARAMETER))
