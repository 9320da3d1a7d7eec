"""A corrected statement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from polhode.claims.latex._tree import Statement
from polhode.claims.repair._edits import Edit
from polhode.claims.repair._places import put, tidied

_EQUALLY_SMALL = 0.15


@dataclass(frozen=True)
class Repaired:
    """A corrected statement and the changes that were made."""

    statement: Statement
    changes: tuple[Edit, ...]

    @property
    def size(self) -> float:
        """How much was changed."""
        return sum(change.size for change in self.changes)

    def with_changes(self, changes: Sequence[Edit]) -> Repaired:
        """With more places changed."""
        changed = self.statement
        for edit in changes:
            changed = put(changed, edit.path, edit.node)
        return Repaired(changed, (*self.changes, *changes))


def smallest(found: Sequence[Repaired]) -> tuple[Repaired, ...]:
    """The smallest, and all others of about its size."""
    ordered = sorted(found, key=lambda r: r.size)
    limit = ordered[0].size + _EQUALLY_SMALL
    kept = {tidied(r.statement): r for r in reversed(ordered) if r.size <= limit}
    return tuple(reversed(kept.values()))
