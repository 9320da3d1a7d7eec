"""A key for what is found out once about a system."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.derive import Equations


@dataclass(frozen=True, eq=False)
class The:
    """Equations as a key: the same ones, not others that say the same."""

    equations: Equations

    def __eq__(self, other: object) -> bool:
        return isinstance(other, The) and self.equations is other.equations

    def __hash__(self) -> int:
        return id(self.equations)
