"""Objects as keys of caches in memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

Subject = TypeVar("Subject")


@dataclass(frozen=True, eq=False)
class ByIdentity(Generic[Subject]):
    """An object as the key of a cache, equal only to a key of the same object.

    Systems and equations are compared by content, which would be slow.
    """

    subject: Subject

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ByIdentity) and self.subject is other.subject

    def __hash__(self) -> int:
        return id(self.subject)
