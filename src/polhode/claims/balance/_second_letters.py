"""Quantities of a trial motion by the letters of a text, from a table of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import Any

import numpy as np

from polhode.algebra import Symbol
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.balance._jets import Jet
from polhode.claims.balance._trial import Jets, Trial, cross, dot
from polhode.claims.latex import _tree as tree
from polhode.model import Body, Pivot, Restraint, System


class UnreadError(Exception):
    """A piece of LaTeX that this reader does not know; a first reader may."""


@dataclass(frozen=True, eq=False)
class Inertia:
    """The inertia tensor of a body about its centre of mass."""

    body: Body


class Letters:
    """What letters stand for: scalars as jets, vectors as three of them along the root frame.

    Args:
        system: the declaration.
        numbers: reactions, by symbol.
        trial: the motion of all bodies.
        points: of moments that may be about several points, which is meant.
    """

    def __init__(
        self,
        system: System,
        numbers: Mapping[Symbol, float],
        trial: Trial,
        points: Mapping[tree.Name, str],
    ) -> None:
        self._system = system
        self._numbers = numbers
        self._trial = trial
        self._points = points
        self._root = system.root
        self._names = {s.published: s for s in trial.symbols}

    def scalar(self, name: tree.Name) -> Any:
        """A symbol of the declaration, or a component of a force."""
        if name.decoration:
            return None
        published = name.letter + "prime" * name.primes
        published += f"_{name.subscript.replace(',', '_')}" if name.subscript else ""
        for spelling in (published, f"{published}_"):
            if spelling in self._names:
                return self._trial.number(self._names[spelling])
            if (force := reaction_symbol(spelling)) in self._numbers:
                return _without_rates(self._numbers[force])
        if name == tree.Name("pi"):
            return Jet.of(np.pi)
        return None

    def mechanical(self, name: tree.Name) -> Any:
        if name.primes:
            return None
        if name.decoration == "hat" and not name.subscript:
            return self._direction(name.letter)
        if name.decoration == "vector":
            return self._vector(name)
        if not name.decoration and name.letter == "T" and name.subscript in ("", "rot", "cm"):
            return self._kinetic(name.subscript)
        return None

    def _direction(self, label: str) -> Any:
        """Of the laboratory where it has the label, or else of the only body's own axes."""
        for frame in (self._root, self._only_body.axes):
            if label in frame.labels:
                return self._trial.vector(frame[label])
        return None

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
                momenta = (m.velocity * trial.scalar(b.mass) for b, m in trial.bodies.items())
                return reduce(add, momenta)
            case "L", _:
                return self._angular_momentum(self._point(name))
            case "F", "":
                return self._force()
            case "I", "" | "cm":
                return Inertia(self._only_body)
        return None

    def _point(self, name: tree.Name) -> Jets:
        """About which point: the centre of mass, or where a pivot holds the body."""
        said = self._points.get(name, "cm" if name.subscript in ("", "cm") else name.subscript)
        centre = self._trial.place(self._only_body)
        if said == "cm":
            return centre
        pivots = [e for e in self._system.elements if isinstance(e, Pivot)]
        meant = [e for e in pivots if e.name == said or (said == "p" and len(pivots) == 1)]
        if len(meant) != 1:
            raise UnreadError
        return centre + self._trial.vector(meant[0].at)

    def _angular_momentum(self, point: Jets) -> Jets:
        trial, body = self._trial, self._only_body
        lever = trial.place(body) - point
        momentum = trial.bodies[body].velocity * trial.scalar(body.mass)
        return trial.angular_momentum(body) + cross(lever, momentum)

    def _force(self) -> Jets:
        """Of the only contact or joint, by the numbers of its components; without their rates."""
        forces = [r for r in self._trial.restraints if r.arm is not None]
        if len({_letter(r) for r in forces}) != 1 or self._several_elements(forces):
            raise UnreadError
        return reduce(add, (self._share(r) for r in forces))

    def _several_elements(self, forces: list[Restraint]) -> bool:
        holding = [e for e in self._system.elements if any(r.body in e.bodies for r in forces)]
        return len(holding) != 1

    def _share(self, restraint: Restraint) -> Jets:
        number = self._numbers[reaction_symbol(restraint.name)]
        return self._trial.vector(restraint.direction) * _without_rates(number)

    def _kinetic(self, kind: str) -> Jet:
        trial, half = self._trial, Jet.of(0.5)
        total = Jet.of(0.0)
        for body, moving in trial.bodies.items():
            if kind != "cm":
                total = total + half * dot(moving.angular, trial.angular_momentum(body))
            if kind != "rot":
                speed = dot(moving.velocity, moving.velocity)
                total = total + half * trial.scalar(body.mass) * speed
        return total


def _without_rates(number: float) -> Jet:
    unknown = np.array(np.nan)
    return Jet(np.array(number), unknown, unknown)


def _letter(restraint: Restraint) -> str:
    return restraint.name.partition("_")[0]
