"""Both sides of a claim by numbers, read from the LaTeX tree independently of the first reading.

Checking a verdict at a state does not reveal that a letter was misread. So the tree is read again
here, with a separate table of letters and separate rules for signs and rates: vectors are three
components along the root frame, and rates are carried along as jets. Anything that is not in this
table is left unread; nothing is guessed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce, singledispatchmethod
from operator import add
from typing import Any

import numpy as np

from polhode.algebra import Expr, Op, Symbol, Vector
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.balance._jets import JETS, Jet
from polhode.judge.balance._trial import Jets, Trial, cross, dot
from polhode.judge.latex import _tree as tree
from polhode.model import Body, Pivot, Restraint, System

_EQUAL = ("=", "≡")
_CONSTANT = ("constant", "const")
_TURNING = ("'", "rot", "body", "b", "r", "rel")  # labels of rates seen from the body

_sin, _cos = JETS.functions[Op.SIN], JETS.functions[Op.COS]
_sinh, _cosh = JETS.functions[Op.SINH], JETS.functions[Op.COSH]
_exp, _sqrt = JETS.functions[Op.EXP], JETS.functions[Op.SQRT]
_FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    "sin": _sin,
    "cos": _cos,
    "tan": lambda x: _sin(x) / _cos(x),
    "sec": lambda x: 1.0 / _cos(x),
    "csc": lambda x: 1.0 / _sin(x),
    "cot": lambda x: _cos(x) / _sin(x),
    "sinh": _sinh,
    "cosh": _cosh,
    "tanh": lambda x: _sinh(x) / _cosh(x),
    "sech": lambda x: 1.0 / _cosh(x),
    "exp": _exp,
}


@dataclass(frozen=True)
class Sides:
    """Values of the two sides of one member: one for a scalar, three for a vector."""

    left: tuple[float, ...]
    right: tuple[float, ...]

    @property
    def differ_by(self) -> float:
        """The largest difference, relative to the size of the sides or 1."""
        size = max(1.0, *map(abs, (*self.left, *self.right)))
        return max(abs(a - b) for a, b in zip(self.left, self.right, strict=True)) / size

    @property
    def is_known(self) -> bool:
        """Whether all are numbers; rates that nothing determines are nan."""
        return bool(np.all(np.isfinite([*self.left, *self.right])))


def read_members(
    statement: tree.Statement,
    system: System,
    numbers: Mapping[Symbol, float],
    trial: Trial,
    defined: Mapping[tree.Node, object],
    meant: Mapping[tree.Node, str],
) -> Iterator[Sides | None]:
    """The two sides of every member of a statement; None for inequalities and unread members.

    Args:
        statement: the claim.
        system: the declaration.
        numbers: reactions, by symbol.
        trial: the motion of all bodies.
        defined: letters that the text defines, as expressions and vectors.
        meant: letters of several meanings, each with the quantity that it is read as.
    """
    reader = _SecondReader(system, numbers, trial, defined, meant)
    for relation in statement.relations:
        pairs = zip(relation.sides, relation.signs, relation.sides[1:], strict=False)
        for left, sign, right in pairs:
            yield reader.sides(left, right) if sign in _EQUAL else None


class _SecondReader:
    def __init__(
        self,
        system: System,
        numbers: Mapping[Symbol, float],
        trial: Trial,
        defined: Mapping[tree.Node, object],
        meant: Mapping[tree.Node, str],
    ) -> None:
        self._trial = trial
        self._definitions = defined
        self._meant = meant
        self._letters = Letters(system, numbers, trial)

    # -- members --------------------------------------------------------------------------------

    def sides(self, left: tree.Node, right: tree.Node) -> Sides | None:
        """The two sides by numbers."""
        try:
            one = self.value(left)
            match right:
                case tree.Name(letter=text) | tree.Words(text=text) if (
                    text.strip(" .,") in _CONSTANT
                ):  # "x = constant" claims that the rate of x vanishes
                    one, other = self._rate(one), Jet.of(0.0)
                case _:
                    other = self.value(right)
            if isinstance(one, np.ndarray) != isinstance(other, np.ndarray):
                one, other = _vector_of_zero(one), _vector_of_zero(other)
            return Sides(_plain(one), _plain(other))
        except (UnreadError, KeyError, ZeroDivisionError):
            return None

    # -- pieces ---------------------------------------------------------------------------------

    @singledispatchmethod
    def value(self, node: tree.Node) -> Any:
        """A scalar as a jet, a vector as three along the root frame."""
        raise UnreadError

    @value.register
    def _(self, node: tree.Number) -> Any:
        return Jet.of(float(Fraction(node.text)))

    @value.register
    def _(self, node: tree.Dots) -> Any:
        if isinstance(node.of, tree.Name) and node.of.subscript == "0":
            return self._letters.initial_rate(node.of.letter, node.count)
        if self._meant.get(node) == "rate seen from the body":
            return self._rate_from_body(self.value(node.of))
        return reduce(lambda found, _: self._rate(found), range(node.count), self.value(node.of))

    @value.register
    def _(self, node: tree.Derivative) -> Any:
        if node.partial or node.by != tree.Name("t"):
            raise UnreadError
        if node.frame:
            return self._rate_seen(self.value(node.of), node)
        return reduce(lambda found, _: self._rate(found), range(node.order), self.value(node.of))

    def _rate_seen(self, found: Any, node: tree.Derivative) -> Any:
        """(dL/dt)_rot = dL/dt - ω × L, seen from the only body."""
        if node.order != 1 or node.frame not in _TURNING:
            raise UnreadError
        return self._rate_from_body(found)

    def _rate_from_body(self, found: Any) -> Any:
        if not isinstance(found, np.ndarray):
            raise UnreadError
        return self._rate(found) - cross(self._letters.turning, found)

    def _rate(self, found: Any) -> Any:
        if isinstance(found, Inertia):
            raise UnreadError
        return self._trial.inertial_rate(found) if isinstance(found, np.ndarray) else found.dt

    @value.register
    def _(self, node: tree.Sum) -> Any:
        return reduce(self._sum, map(self.value, node.terms))

    def _sum(self, one: Any, other: Any) -> Any:
        if isinstance(one, Inertia) or isinstance(other, Inertia):
            raise UnreadError
        if isinstance(one, np.ndarray) != isinstance(other, np.ndarray):
            one, other = _vector_of_zero(one), _vector_of_zero(other)
        return one + other

    @value.register
    def _(self, node: tree.Negative) -> Any:
        return self._times(Jet.of(-1.0), self.value(node.of))

    @value.register
    def _(self, node: tree.Product) -> Any:
        return reduce(self._times, map(self.value, node.factors))

    def _times(self, one: Any, other: Any) -> Any:
        if isinstance(one, Inertia) and isinstance(other, np.ndarray):
            return self._trial.mapped_by_inertia(one.body, other)
        vectors = [isinstance(side, np.ndarray | Inertia) for side in (one, other)]
        if any(isinstance(side, Inertia) for side in (one, other)) or all(vectors):
            raise UnreadError
        # NumPy scales an object array by its right operand, so the vector has to stand left.
        return other * one if vectors[1] else one * other

    @value.register
    def _(self, node: tree.Cross) -> Any:
        one, other = self.value(node.left), self.value(node.right)
        if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
            return cross(one, other)
        return self._times(one, other)

    @value.register
    def _(self, node: tree.Dot) -> Any:
        return self._dot(self.value(node.left), self.value(node.right))

    def _dot(self, one: Any, other: Any) -> Any:
        if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
            return dot(one, other)
        return self._times(one, other)

    @value.register
    def _(self, node: tree.Quotient) -> Any:
        above, below = self.value(node.above), self.value(node.below)
        if not isinstance(below, Jet) or isinstance(above, Inertia):
            raise UnreadError
        return above * (1.0 / below) if isinstance(above, np.ndarray) else above / below

    @value.register
    def _(self, node: tree.Power) -> Any:
        base = self.value(node.base)
        if not isinstance(node.exponent, tree.Number) or isinstance(base, Inertia):
            raise UnreadError
        exponent = Fraction(node.exponent.text)
        if isinstance(base, np.ndarray):  # a power of a vector is one of its length
            base, exponent = self._dot(base, base), exponent / 2
        if exponent.denominator == 2:
            base, exponent = _sqrt(base), exponent * 2
        if exponent.denominator != 1 or not 0 < exponent <= 8:
            raise UnreadError
        return reduce(self._times, [base] * int(exponent))

    @value.register
    def _(self, node: tree.Root) -> Any:
        found = self.value(node.of)
        if node.index is not None or not isinstance(found, Jet):
            raise UnreadError
        return _sqrt(found)

    @value.register
    def _(self, node: tree.Call) -> Any:
        found = self.value(node.argument)
        if node.function not in _FUNCTIONS or not isinstance(found, Jet):
            raise UnreadError
        return _FUNCTIONS[node.function](found)

    @value.register
    def _(self, node: tree.Magnitude) -> Any:
        found = self.value(node.of)
        return _sqrt(self._dot(found, found))

    @value.register
    def _(self, node: tree.Component) -> Any:
        return self._dot(self.value(node.of), self._unit(node.subscript))

    # -- letters --------------------------------------------------------------------------------

    @value.register
    def _(self, node: tree.Name) -> Any:
        if node in self._meant and node not in self._definitions:
            return self._letters.quantity(self._meant[node])
        for found in (self._by_definition, self._letters.scalar, self._letters.mechanical):
            value = found(node)
            if value is not None:
                return value
        whole, _, label = node.subscript.rpartition(",")
        if label:
            stem = tree.Name(node.letter, whole, node.primes, "vector")
            found, axis = self.value(stem), self._unit(label)
            if isinstance(found, Inertia):  # I_1 is a moment of inertia, not a vector
                found = self._trial.mapped_by_inertia(found.body, axis)
            return self._dot(found, axis)
        if not node.decoration:  # a letter that has lost its boldness
            return self.value(tree.Name(node.letter, node.subscript, node.primes, "vector"))
        raise UnreadError

    def _by_definition(self, name: tree.Name) -> Any:
        meaning = self._definitions.get(name)
        if isinstance(meaning, Expr):
            return self._trial.scalar(meaning)
        if isinstance(meaning, Vector):
            return self._trial.vector(meaning)
        if meaning is not None:
            raise UnreadError
        return None

    def _unit(self, label: str) -> Jets:
        return self.value(tree.Name(label, decoration="hat"))


def _plain(side: Any) -> tuple[float, ...]:
    if isinstance(side, Inertia):
        raise UnreadError
    return tuple(float(np.ravel(jet.value)[0]) for jet in np.atleast_1d(side))


def _vector_of_zero(side: Any) -> Any:
    """The number 0 as a vector; any other scalar beside a vector is not read."""
    if isinstance(side, np.ndarray):
        return side
    if isinstance(side, Jet) and side.is_constant and not np.any(side.value):
        return np.array([side, side, side], dtype=object)
    raise UnreadError


# -- the table of letters -------------------------------------------------------------------------


class UnreadError(Exception):
    """A piece of LaTeX that this reader does not know, though the first one may."""


@dataclass(frozen=True, eq=False)
class Inertia:
    """The inertia tensor of a body about its centre of mass."""

    body: Body


class Letters:
    """Meanings of letters: scalars as jets, vectors as three of them along the root frame.

    Args:
        system: the declaration.
        numbers: reactions, by symbol.
        trial: the motion of all bodies.
    """

    def __init__(
        self,
        system: System,
        numbers: Mapping[Symbol, float],
        trial: Trial,
    ) -> None:
        self._system = system
        self._numbers = numbers
        self._trial = trial
        self._root = system.root
        self._names = {s.published: s for s in trial.symbols}

    def scalar(self, name: tree.Name) -> Any:
        """A symbol of the declaration, or a component of a force."""
        if name.decoration:
            return None
        published = name.letter + "prime" * name.primes
        published += f"_{name.subscript.replace(',', '_')}" if name.subscript else ""
        for spelling in (published, f"{published}_"):
            if (found := self._published(spelling)) is not None:
                return found
        if name == tree.Name("pi"):
            return Jet.of(np.pi)
        return None

    def _published(self, name: str) -> Jet | None:
        """A symbol of the declaration, or a component of a force, by its published name."""
        if name in self._names:
            return self._trial.number(self._names[name])
        if (force := reaction_symbol(name)) in self._numbers:
            return _without_rates(self._numbers[force])
        return None

    def initial_rate(self, letter: str, dots: int) -> Jet:
        """The constant for a rate at the start, such as the rate of θ with the label 0."""
        published = f"{letter}_{'d' * (dots - 1)}dot_0"
        if published not in self._names:
            raise UnreadError
        return self._trial.number(self._names[published])

    def mechanical(self, name: tree.Name) -> Any:
        """A unit vector, a vector of the motion or a kinetic energy; None for other letters."""
        if name.primes:
            return None
        if name.decoration == "hat" and not name.subscript:
            # An axis of the laboratory if it has this label, otherwise one of the only body.
            for frame in (self._root, self._only_body.axes):
                if name.letter in frame.labels:
                    return self._trial.vector(frame[name.letter])
            return None
        if name.decoration == "vector":
            return self._vector(name)
        if not name.decoration and name.letter == "T" and name.subscript in ("", "rot", "cm"):
            return self._kinetic_energy(name.subscript)
        return None

    def _kinetic_energy(self, part: str) -> Jet:
        """ω·Iω/2 of rotation about the centres of mass, m v²/2 of translation, or both."""
        trial, half = self._trial, Jet.of(0.5)
        total = Jet.of(0.0)
        for body, moving in trial.bodies.items():
            if part != "cm":
                total = total + half * dot(moving.angular, trial.angular_momentum(body))
            if part != "rot":
                speed = dot(moving.velocity, moving.velocity)
                total = total + half * trial.scalar(body.mass) * speed
        return total

    @property
    def turning(self) -> Jets:
        """The angular velocity of the only body."""
        return self._trial.bodies[self._only_body].angular

    @property
    def _only_body(self) -> Body:
        bodies = self._system.bodies
        if len(bodies) != 1:
            raise UnreadError
        return bodies[0]

    def _vector(self, name: tree.Name) -> Any:
        trial = self._trial
        match name.letter, name.subscript:
            case "omega", "" | "total":
                return trial.bodies[self._only_body].angular
            case "v", "" | "cm":
                return trial.bodies[self._only_body].velocity
            case "a", "cm":
                return trial.inertial_rate(trial.bodies[self._only_body].velocity)
            case "r", "" | "cm":
                return trial.place(self._only_body)
            case "P" | "p", "":
                return self._momentum()
            case "L", point:
                return self._angular_momentum(point)
            case "F", "":
                return self._force()
            case "I", "" | "cm":
                return Inertia(self._only_body)
        return None

    def quantity(self, phrase: str) -> Any:
        """The quantity that a letter of several meanings is read as, by the words for it."""
        what, _, of = phrase.partition(" of ")
        kind, _, point = phrase.partition(" about ")
        if what == "magnitude":
            vector = self.quantity(of)
            return _sqrt(dot(vector, vector))
        if kind == "angular momentum":
            return self._angular_momentum(point)
        if phrase in ("kinetic energy", "momentum"):
            return self._kinetic_energy("") if what == "kinetic energy" else self._momentum()
        if what in ("velocity", "angular velocity", "position", "acceleration"):
            return self._of_body(what, of)
        if what == "force":
            return self._force_of(of)
        if what == "tension":
            return self._tension(of)
        published, _, sense = phrase.removeprefix("declared ").partition(", ")
        if published != phrase and (found := self._published(published)) is not None:
            return -found if sense == "opposite in sign" else found
        raise UnreadError

    def _of_body(self, what: str, name: str) -> Jets:
        """A vector of the motion of one body, or of the only one."""
        named = [body for body in self._system.bodies if body.name == name]
        body = named[0] if named else self._only_body
        if name not in ("", "cm", body.name):
            raise UnreadError
        moving = self._trial.bodies[body]
        match what:
            case "velocity":
                return moving.velocity
            case "angular velocity":
                return moving.angular
            case "position":
                return self._trial.place(body)
        return self._trial.inertial_rate(moving.velocity)

    def _momentum(self) -> Jets:
        trial = self._trial
        momenta = (m.velocity * trial.scalar(b.mass) for b, m in trial.bodies.items())
        return reduce(add, momenta)

    def _angular_momentum(self, point_name: str) -> Jets:
        """About the centre of mass, or about the point where a pivot holds the body."""
        trial, body = self._trial, self._only_body
        centre = point = trial.place(body)
        if point_name not in ("", "cm"):
            pivots = [e for e in self._system.elements if isinstance(e, Pivot)]
            meant = [
                e
                for e in pivots
                if e.name == point_name or (point_name == "p" and len(pivots) == 1)
            ]
            if len(meant) != 1:
                raise UnreadError
            point = centre + trial.vector(meant[0].at)
        # L about a point P: that about the centre of mass C, plus (C - P) × m v.
        momentum = trial.bodies[body].velocity * trial.scalar(body.mass)
        return trial.angular_momentum(body) + cross(centre - point, momentum)

    def _force(self) -> Jets:
        """The force of the only contact or joint, from its components."""
        forces = [r for r in self._trial.restraints if r.arm is not None]
        stems = {r.name.partition("_")[0] for r in forces}
        holding = [e for e in self._system.elements if any(r.body in e.bodies for r in forces)]
        if len(stems) != 1 or len(holding) != 1:
            raise UnreadError
        return self._sum_of(forces)

    def _force_of(self, name: str) -> Jets:
        """The force of one contact or joint on its first body."""
        found = [e for e in self._system.elements if e.name == name]
        if len(found) != 1:
            raise UnreadError
        places = self._trial.places
        own = {r.name for r in found[0].restraints(places) if r.arm is not None}
        return self._sum_of([r for r in self._trial.restraints if r.name in own])

    def _tension(self, name: str) -> Jet:
        """The force of a string along the line from a particle to the point that holds it."""
        found = [e for e in self._system.elements if e.name == name and isinstance(e, Pivot)]
        if len(found) != 1:
            raise UnreadError
        arm = self._trial.vector(found[0].at)
        along, square = dot(self._force_of(name), arm), dot(arm, arm)
        return Jet.of(along * (1.0 / _sqrt(square)))

    def _sum_of(self, forces: Sequence[Restraint]) -> Jets:
        """Reactions with the friction that they cause; their rates are unknown."""
        if not forces:
            raise UnreadError
        numbers = (self._numbers[reaction_symbol(r.name)] for r in forces)
        shares = zip(forces, map(_without_rates, numbers), strict=True)
        return reduce(add, (self._trial.pull(r) * share for r, share in shares))


def _without_rates(number: float) -> Jet:
    unknown = np.array(np.nan)
    return Jet(np.array(number), unknown, unknown)
