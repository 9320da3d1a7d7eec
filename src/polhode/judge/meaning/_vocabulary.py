"""The meaning of the letters of a text in a model: by common usage, or as the text states."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from functools import cached_property, lru_cache
from itertools import chain

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, pi, time
from polhode.base import ByIdentity, Dimension, ParseError, PolhodeError
from polhode.derive import Equations
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import (
    At,
    Call,
    Component,
    Derivative,
    Dots,
    Name,
    Node,
    Number,
    Piece,
    walk,
)
from polhode.judge.meaning._initial_values import INITIAL, initial_value
from polhode.judge.meaning._letters import phrases_by_letter, with_usual_label
from polhode.judge.meaning._meaning import (
    Meaning,
    UnknownLetterError,
    alike,
    dot,
    positive_root,
    signed,
)
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.meaning._phrases import quantity
from polhode.judge.meaning._proposals import ALWAYS, OWN, proposed_phrases

LAGRANGIAN = Name("L")  # where it is no angular momentum

_VECTOR, _HAT = "vector", "hat"
_KEPT = 16
_PACES = ("slow", "fast")
_OF_OSCILLATIONS = "of small oscillations"  # in phrases for what belongs to no single instant


@dataclass(frozen=True)
class Reading:
    """The meaning that a letter of a text was given.

    Attributes:
        letter: as printed, such as **L** or ẑ.
        phrase: the quantity, such as "angular momentum about cm".
        phrases: all quantities of the system that the field uses the letter for.
    """

    letter: Node
    phrase: str
    phrases: tuple[str, ...]


@dataclass(frozen=True)
class Sense:
    """The meaning of a letter, and the readings behind it: those of **L** and ẑ for L_z."""

    meaning: Meaning
    readings: tuple[Reading, ...] = ()


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """The letters of one text about one system.

    Attributes:
        mechanics: of the system.
        stated: meanings that the text itself states, which override all others.
        bound: the quantities, in words, that the text binds letters to; each is among `stated`.
        positive: quantities that the text takes as positive.
        columns: name of the frame that components in a bracket are along.
        allowed: letters that the field uses for several quantities, with those that the reader
            says are meant.
        chosen: of these, the one that a letter is read as here; for a derivative dE/dθ, the way
            that it is taken.
        measured: letters whose value the text gives as a number, with its dimension where a unit
            says it.
    """

    mechanics: Mechanics
    stated: Mapping[Node, Meaning] = field(default_factory=dict)
    bound: Mapping[Node, str] = field(default_factory=dict)
    positive: tuple[Expr, ...] = ()
    columns: str = ""
    allowed: Mapping[Node, tuple[str, ...]] = field(default_factory=dict)
    chosen: Mapping[Node, str] = field(default_factory=dict)
    measured: Mapping[Node, Dimension | None] = field(default_factory=dict)

    @cached_property
    def values(self) -> dict[tuple[Node, bool, bool], Meaning]:
        """Values of nodes found so far, by how ± and differentials were read."""
        return {}

    @classmethod
    def of(cls, equations: Equations) -> Vocabulary:
        """The vocabulary given by the declaration alone."""
        return cls(_mechanics(ByIdentity(equations)))

    def stating(self, meanings: Mapping[Node, Meaning]) -> Vocabulary:
        """With more letters, or with other meanings."""
        bound = {node: words for node, words in self.bound.items() if node not in meanings}
        measured = {node: of for node, of in self.measured.items() if node not in meanings}
        stated = {**self.stated, **meanings}
        return replace(self, stated=stated, bound=bound, measured=measured)

    def binding(self, phrases: Mapping[Node, str]) -> Vocabulary:
        """With letters bound to quantities of the model, each in words.

        Raises `ParseError` for words that name no quantity, and for a letter bound to two vectors,
        in bold and in plain type.
        """
        full = {node: self._in_full(node, words) for node, words in phrases.items()}
        meanings = {node: quantity(self.mechanics, words) for node, words in full.items()}
        for node, meaning in meanings.items():
            plain = replace(node, decoration="") if isinstance(node, Name) else node
            if plain == node or not isinstance(meaning, Vector):
                continue
            if isinstance(meanings.get(plain), Vector) and full[plain] != full[node]:
                raise ParseError(
                    f"{spelled(plain)} bound to {full[plain]!r} and, in bold type, to "
                    f"{full[node]!r}",
                    expected="one meaning for a letter, whose bold type may be lost",
                    advice="leave out one of the two bindings",
                )
        stating = self.stating(meanings)
        return replace(stating, bound={**stating.bound, **full})

    def _in_full(self, node: Node, words: str) -> str:
        """The phrase that a binding means: of **L**, "about pivot" is enough."""
        sense = self._exactly(node) if isinstance(node, Name) else None
        phrases = [p for r in (sense.readings if sense else ()) for p in r.phrases]
        found = [phrase for phrase in phrases if phrase.endswith(f" {words}")]
        return found[0] if len(found) == 1 and words not in phrases else words

    @property
    def declared(self) -> dict[Node, Expr]:
        """Letters that the declaration itself uses, with their dots, and their meanings."""
        return self.mechanics.letters

    def choosing(self, chosen: Mapping[Node, str]) -> Vocabulary:
        """With letters of several meanings read as quantities of the model."""
        return replace(self, chosen={**self.chosen, **chosen}) if chosen else self

    def allowing(self, allowed: Mapping[Node, tuple[str, ...]]) -> Vocabulary:
        """With only some of the meanings of letters that have several."""
        return replace(self, allowed={**self.allowed, **allowed})

    @property
    def states_usual(self) -> bool:
        """Whether the text states, for some letter, a quantity that the field uses it for."""
        in_speeds = self.mechanics.in_speeds
        for node, stated in self.stated.items():
            letter = node.of if isinstance(node, At) else node
            phrases = self._usual(letter) if isinstance(letter, Name) else ()
            known = _distinct(self.mechanics, tuple(p for p in phrases if p != OWN))
            if any(alike(in_speeds(stated), in_speeds(quantity(self.mechanics, p))) for p in known):
                return True
        return False

    def way(self, letter: Node, ways: tuple[str, ...]) -> str:
        """The way in which something other than a letter is read: chosen, or the likeliest."""
        return self.chosen.get(letter) or self.allowed.get(letter, ways)[0]

    def has(self, node: Node) -> bool:
        """Whether a letter stands for something."""
        return self.find(node) is not None

    def readings(self, pieces: Iterable[Piece]) -> tuple[Reading, ...]:
        """The meanings that letters of some pieces of text were given, by common usage."""
        senses = (self.sense(name) for piece in pieces for name in _names(piece))
        found = (reading for sense in senses if sense for reading in sense.readings)
        return tuple(dict.fromkeys(found))

    def lagrangians(self, pieces: Iterable[Piece]) -> tuple[Reading, ...]:
        """The reading of the L of ∂L/∂q̇, whatever L means elsewhere; empty if it has none."""
        is_differentiated = any(_lagrangians(list(walk(piece))) for piece in pieces)
        if not is_differentiated or LAGRANGIAN in self.stated or not self.has(LAGRANGIAN):
            return ()
        return (Reading(LAGRANGIAN, "lagrangian", ("lagrangian",)),)

    def readings_of(self, letter: Name) -> tuple[Reading, ...]:
        """The readings of a letter that has several, printed with or without hat or boldness."""
        forms = dict.fromkeys([letter.decoration, "", _VECTOR, _HAT])
        senses = (self._exactly(replace(letter, decoration=form)) for form in forms)
        found = (reading for sense in senses if sense for reading in sense.readings)
        return tuple(dict.fromkeys(r for r in found if len(r.phrases) > 1))

    def firmly(self, node: Node) -> tuple[Meaning, ...]:
        """What a letter stands for in the declaration or by common usage, not by habit alone."""
        sense = self.sense(node)
        firm = phrases_by_letter(self.mechanics)
        if sense is None or not sense.readings:
            return () if sense is None else (sense.meaning,)
        letters = (r.letter for r in sense.readings)
        known = [firm.get(with_usual_label(n) if isinstance(n, Name) else n) for n in letters]
        if not all(known):
            return ()
        if len(known) > 1:
            return (sense.meaning,)
        return tuple(quantity(self.mechanics, p) for p in known[0] or ())

    def meaning(self, node: Node) -> Meaning:
        """What a letter stands for.

        Raises `BindingError` for one without a meaning, with names that resemble it.
        """
        found = self.find(node)
        if found is None:
            raise self._unknown(node)
        return found

    def find(self, node: Node) -> Meaning | None:
        """What a letter stands for, or None."""
        sense = self.sense(node)
        return None if sense is None else sense.meaning

    def sense(self, node: Node) -> Sense | None:
        """What a letter stands for and the readings behind that, or None.

        Transcripts lose boldness and hats: a plain letter may be a vector, and the reverse.
        """
        if isinstance(node, Name):
            return self._named(node)
        if node in self.stated:
            return Sense(self.stated[node])
        if isinstance(node, At) and node.argument == Name("t"):
            return self.sense(node.of)
        if isinstance(node, At) and node.argument == Number("0"):
            return self._at_the_start(node.of)
        if isinstance(node, Dots):
            return self._slow_or_fast(node)
        return None

    def _at_the_start(self, node: Node) -> Sense | None:
        """What θ(0) or θ̇(0) stands for: the initial value of a coordinate or of its rate."""
        of, dots = (node.of, node.count) if isinstance(node, Dots) else (node, 0)
        value = self.find(of)
        for _ in range(dots):
            value = value.dt() if isinstance(value, Expr) else None
        symbol = value.symbol if isinstance(value, Expr) else None
        if symbol is None or symbol.base() not in self.mechanics.declared.coordinates:
            return None
        return Sense(Expr.generator(initial_value(symbol))) if symbol.order < 2 else None

    def _slow_or_fast(self, node: Dots) -> Sense | None:
        """The slow or the fast one of two rates of precession, as texts label it."""
        name = node.of
        if node.count != 1 or not isinstance(name, Name) or name.subscript not in _PACES:
            return None
        rate = f"{self.mechanics.published(replace(name, subscript=''))}_dot"
        phrase = f"{name.subscript} steady {rate}"
        try:
            return Sense(quantity(self.mechanics, phrase), (Reading(node, phrase, (phrase,)),))
        except PolhodeError:
            return None

    def _named(self, name: Name) -> Sense | None:
        if name not in self._senses:
            self._senses[name] = next(filter(None, self._candidates(name)), None)
        return self._senses[name]

    @cached_property
    def _senses(self) -> dict[Name, Sense | None]:
        """The meanings of letters found so far."""
        return {}

    def _candidates(self, name: Name) -> Iterator[Sense | None]:
        """Possible meanings of a letter, likeliest first; those the text states come before all."""
        yield self._stated(name)
        yield self._component(name, self._stated)
        if not name.decoration and name not in self._symbols:
            yield self._stated(replace(name, decoration=_VECTOR))
        if self.chosen.get(name) == OWN:
            return
        yield self._exactly(name)
        for form in _FORMS[name.decoration]:
            found = self._exactly(replace(name, decoration=form))
            if found and any(r.phrase.startswith(INITIAL) for r in found.readings):
                continue  # a bold **L**₀ is no value of a scalar L
            yield self._unit(found) if name.decoration == _HAT else found
        yield self._component(name, self._exactly)
        if name.letter == "e":  # e_z for a unit vector
            yield self._exactly(Name(name.subscript, decoration=_HAT))
        yield self._initial(name)

    def _initial(self, name: Name) -> Sense | None:
        """θ₀, the constant value of a coordinate at the start."""
        whole, zero, rest = name.subscript.rpartition("0")
        value = self._symbols.get(replace(name, subscript=whole.rstrip(", "))) if zero else None
        symbol = value.symbol if value is not None and not rest else None
        if symbol is None or symbol not in self.mechanics.declared.coordinates:
            return None
        phrase = f"{INITIAL}{symbol.published}"
        meaning = Expr.generator(initial_value(symbol))
        return Sense(meaning, (Reading(name, phrase, (phrase,)),))

    def _stated(self, name: Name) -> Sense | None:
        if name not in self.stated:
            return None
        phrases = (self.bound[name],) if name in self.bound else ()
        return Sense(self.stated[name], tuple(Reading(name, p, phrases) for p in phrases))

    def _exactly(self, name: Name) -> Sense | None:
        """The meaning of a letter as printed, by the text, the declaration or common usage.

        A letter with the label of an axis may also be meant as a component: an F_z declared along
        a swinging rod is not F·ẑ, nor is one along the normal of a slope; so all are kept.
        """
        if name in self.stated:
            return self._stated(name)
        if name in self.chosen:
            return self._read(name, (self.chosen[name],))
        published, of = self.mechanics.forces_by_letter.get(name, ("", ""))
        symbol = self.mechanics.scalars.get(published) or self._symbols.get(name)
        phrases = self._usual(name)
        if symbol is not None:
            phrases = (f"declared {published or self.mechanics.published(name)}",)
        component = self._component(name, self._exactly) if phrases else None
        if component is not None and len(component.readings) == 2:
            vector, axis = component.readings
            whole = f"force of {of}" if of else vector.phrase
            # A length that is taken out of a vector has no axis.
            axes = [phrase for phrase in axis.phrases if phrase.startswith("axis ")]
            own = next((a for a in axes if symbol and self._is_along(symbol, whole, a)), "")
            if own:
                phrases = (f"{phrases[0]}, along {own}",)
            phrases = (*phrases, *(f"{whole} along {a}" for a in axes if a != own))
        found = self._read(name, phrases)
        # Where no other quantity can be meant there is nothing to tell of a published name.
        is_one = found is None or len(found.readings[0].phrases) == 1
        if name in self._symbols and name not in self.allowed and is_one:
            return Sense(self._symbols[name])
        return found

    def _is_along(self, symbol: Expr, vector: str, axis: str) -> bool:
        """Whether a symbol of the declaration is the component of a vector along an axis."""
        component = quantity(self.mechanics, f"{vector} along {axis}")
        return alike(self.mechanics.in_speeds(symbol), self.mechanics.in_speeds(component))

    def _usual(self, name: Name) -> tuple[str, ...]:
        """What a letter usually stands for, and what the field uses it for by habit."""
        if name in self._symbols:
            return ()
        name = with_usual_label(name)
        firm = phrases_by_letter(self.mechanics).get(name, ())
        if name.letter != "F" and any(phrase.startswith("force of ") for phrase in firm):
            return firm  # the declaration itself gives the letter to a force
        proposed = (*proposed_phrases(self.mechanics, name), *self._initially(name))
        found = [p for p in dict.fromkeys([*firm, *proposed]) if p != OWN]
        return (*found, OWN) if OWN in proposed and not firm else tuple(found)

    def _initially(self, name: Name) -> Iterator[str]:
        """What ω₀, v₀ or E₀ may stand for: the value at the start of what the letter stands for."""
        whole, zero, rest = name.subscript.rpartition("0")
        if not zero or rest:
            return
        stem = replace(name, subscript=whole.rstrip(", "))
        sense = self._named(stem)
        if sense is None or self._initial(name):
            return
        match sense.readings:
            case ():
                yield f"{INITIAL}{self.mechanics.published(stem)}"
            case (reading,):
                lasting = (p for p in reading.phrases if p != OWN and _OF_OSCILLATIONS not in p)
                known = ((p, quantity(self.mechanics, p)) for p in lasting)
                yield from (f"{INITIAL}{p}" for p, found in known if isinstance(found, Expr))
            case (vector, axis) if axis.phrase.startswith("axis "):
                yield f"{INITIAL}{vector.phrase} along {axis.phrase}"
        if name not in ALWAYS or not proposed_phrases(self.mechanics, name):
            yield OWN  # ω₀ is a frequency only of what oscillates

    def _read(self, name: Name, phrases: tuple[str, ...]) -> Sense | None:
        allowed = self.allowed.get(name, phrases)
        distinct = _distinct(self.mechanics, tuple(p for p in phrases if p in allowed))
        if not distinct or distinct[0] == OWN:
            return None
        meaning = signed(quantity(self.mechanics, distinct[0]), self.positive)
        return Sense(meaning, (Reading(name, distinct[0], distinct),))

    @cached_property
    def _symbols(self) -> dict[Node, Expr]:
        """Letters that stand for a symbol: those of the declaration, π, a degree and the time."""
        constants: dict[Node, Expr] = {Name("pi"): pi, Name("degree"): pi / 180}
        return {**self.declared, **constants, Name("t"): time}

    def _unit(self, sense: Sense | None) -> Sense | None:
        if sense is None or not isinstance(sense.meaning, Vector):
            return None
        length = positive_root(sense.meaning.dot(sense.meaning), self.positive)
        if not length:
            return None
        return replace(sense, meaning=sense.meaning / length)

    def _component(self, name: Name, known: Callable[[Name], Sense | None]) -> Sense | None:
        """The component that L_z, F_ρ or τ_1 stands for: a vector with the label of an axis."""
        whole, _, label = name.subscript.rpartition(",")
        vector = known(replace(name, subscript=whole, decoration=_VECTOR)) if label else None
        if vector is None or not isinstance(vector.meaning, Vector):
            return None
        axis = self._named(Name(label, decoration=_HAT))
        if axis is None or not isinstance(axis.meaning, Vector):
            return None
        if any(r.phrase.startswith(_MOMENTS) for r in axis.readings):
            return None  # v_G is the velocity of G, not a component along a torque **G**
        along = dot(vector.meaning, axis.meaning)
        if not along and any(r.phrase.startswith(_CURVED) for r in axis.readings):
            return None  # ω_r is a frequency of r, where ω has no component along r̂
        return Sense(along, (*vector.readings, *axis.readings))

    @cached_property
    def generalised(self) -> tuple[tuple[Node, Node], ...]:
        """The letters of every coordinate and of the momentum conjugate to it."""
        phrases = phrases_by_letter(self.mechanics)
        momenta = {
            found[0]: node
            for node, found in phrases.items()
            if isinstance(node, Name) and node.letter == "p" and not node.decoration
        }
        return tuple(
            (name_of(q.published), momenta[f"momentum conjugate to {q.published}"])
            for q in self.mechanics.equations.coordinates
        )

    def _unknown(self, node: Node) -> UnknownLetterError:
        known = (*self.stated, *phrases_by_letter(self.mechanics), *self._symbols)
        names = {spelled(node): node for node in known}
        near = tuple(get_close_matches(spelled(node), names, n=3, cutoff=0.6))
        return UnknownLetterError(
            f"{spelled(node)}, which has no meaning in {self.system}",
            expected="a quantity of the system, or a symbol that the text defines",
            advice=f"did you mean {' or '.join(near)}?" if near else "define it",
            option="" if near else "let",
            symbol=spelled(node),
            near=near,
        )

    @property
    def system(self) -> str:
        """Name of the system."""
        return self.mechanics.equations.system.name

    def letters(self) -> Iterator[Node]:
        """Letters of the text, scalars with their dots, and functions of the angles."""
        yield from (node for node in self.stated if isinstance(node, Name))
        for name, value in self.mechanics.scalars.items():
            symbol = value.symbol
            if symbol is not None and symbol.order < 3:
                yield name_of(name)
        frames = self.mechanics.frames.values()
        turned = (sorted(frame.angle.symbols(), key=str) for frame in frames)
        for angle in dict.fromkeys(chain.from_iterable(turned)):
            if angle.kind is SymbolKind.COORDINATE:
                yield from (Call(name, name_of(angle.published)) for name in ("sin", "cos"))

    def vectors(self) -> Iterator[Node]:
        """Letters of vectors that a text on this system may use, those of the text first."""
        named = phrases_by_letter(self.mechanics)
        for node in dict.fromkeys([*self.stated, *named]):
            if isinstance(node, Name) and node.decoration != _HAT:
                yield node


def _names(piece: Piece) -> Iterator[Name]:
    """The letters of a piece of text; the L of ∂L/∂q̇ is a Lagrangian whatever L means elsewhere.

    In U'(θ) the letter is U, and the W of W(θ) has no meaning by usage.
    """
    pieces = list(walk(piece))
    lagrangians = {id(letter) for letter in _lagrangians(pieces)}
    functions = {id(p.of): is_of_place(p) for p in pieces if isinstance(p, At)}
    for found in pieces:
        if isinstance(found, Name) and id(found) not in lagrangians:
            if id(found) not in functions:
                yield found
            elif not functions[id(found)]:
                yield replace(found, primes=0) if found.letter in POTENTIALS else found
        if isinstance(found, Component):
            yield Name(found.subscript, decoration=_HAT)


#: Functions of a coordinate, whose primes are derivatives; x(0) is a value at a time instead.
POTENTIALS = ("U", "V", "W")
_WORK = "W"


def is_of_place(node: At) -> bool:
    """Whether it is W(θ), a function of place, which the work done on the way is not."""
    of, argument = node.of, node.argument
    is_place = isinstance(argument, Name) and argument != Name("t")
    return is_place and isinstance(of, Name) and of.letter == _WORK and not of.subscript


def _lagrangians(pieces: Iterable[object]) -> list[Node]:
    return [p.of for p in pieces if isinstance(p, Derivative) and p.partial and p.of == LAGRANGIAN]


@lru_cache(maxsize=_KEPT)
def _mechanics(key: ByIdentity[Equations]) -> Mechanics:
    """One object for all texts about a system, so that computed quantities are kept."""
    return Mechanics(key.subject)


@lru_cache(maxsize=4096)
def _distinct(mechanics: Mechanics, phrases: tuple[str, ...]) -> tuple[str, ...]:
    """The phrases that name different quantities, the first of each."""
    found: dict[str, Meaning] = {}
    for phrase in phrases:
        if phrase == OWN:
            continue
        try:
            meaning = mechanics.in_speeds(quantity(mechanics, phrase))
        except (PolhodeError, ZeroDivisionError):
            continue  # the system does not have it, such as an effective potential
        if not any(alike(meaning, other) for other in found.values()):
            found[phrase] = meaning
    return (*found, *(phrase for phrase in phrases if phrase == OWN))


#: The beginnings of phrases for what no component is along.
_MOMENTS = ("torque ", "angular momentum ")

#: The beginning of phrases for directions such as r̂ and θ̂, after which texts label other things.
_CURVED = "direction of increasing "

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


def constant(node: Node) -> Expr:
    """A new constant of the text, such as a time t₀."""
    name = "".join(c if c.isalnum() else "_" for c in spelled(node)).strip("_")
    return Expr.generator(Symbol(name, SymbolKind.PARAMETER))
