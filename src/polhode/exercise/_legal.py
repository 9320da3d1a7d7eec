"""States that a system can be in: every contact pushes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import PolhodeError
from polhode.exercise._subject import ExerciseSubject, value_of

_LEAST_PUSH = 0.1  # of the weight


@dataclass(frozen=True)
class LegalStates:
    """What has to be positive in a state.

    Attributes:
        pushes: forces of contacts along their normals, less a tenth of the weight.
    """

    pushes: tuple[Expr, ...]

    @classmethod
    def of(cls, subject: ExerciseSubject) -> LegalStates:
        """From the contacts of a system; none where their forces are not known."""
        equations, setting = subject.equations, subject.setting
        found = []
        for contact in setting.contacts:
            reaction = equations.reactions.get(contact.name)
            if reaction is None or equations.undetermined:
                continue
            try:
                push = equations.on_shell(reaction.force.dot(contact.on.up))
            except PolhodeError:
                continue
            if setting.gravity is not None:
                push -= setting.mass * setting.gravity.g * Expr.of(_LEAST_PUSH)
            if not any(s.kind is SymbolKind.FUNCTION for s in push.symbols()):
                found.append(push)
        return cls(tuple(found))

    @property
    def symbols(self) -> set[Symbol]:
        """Coordinates and speeds that decide."""
        return {s for push in self.pushes for s in push.symbols() if s.kind.varies}

    def accepts(self, values: Mapping[Symbol, float]) -> bool:
        """Whether every contact pushes."""
        return all(value_of(push, values) > 0 for push in self.pushes)
