"""What has been worked out from an object, kept for as long as the object lives."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Made = TypeVar("Made")

_MOST = 2048  # results kept of one object


class Memory(Generic[Made]):
    """Results by the object they come from, and by what was asked of it.

    The object is known by its identity; results must not hold on to it, or it would live on.
    """

    def __init__(self) -> None:
        self._of: dict[int, dict[Hashable, Made]] = {}

    def recall(self, owner: object, asked: Hashable, make: Callable[[], Made]) -> Made:
        """The result that was made before, or else that of `make`, which is then kept."""
        results = self._results(owner)
        found = results.get(asked)
        if found is None:
            found = make()
            if len(results) >= _MOST:
                results.clear()
            results[asked] = found
        return found

    def _results(self, owner: object) -> dict[Hashable, Made]:
        place = id(owner)
        if place not in self._of:
            self._of[place] = {}
            weakref.finalize(owner, self._of.pop, place, None)
        return self._of[place]


class Same(Generic[Made]):
    """A key that is equal to another only if it stands for the very same object."""

    def __init__(self, thing: Made) -> None:
        self.thing = thing

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self.thing is other.thing

    def __hash__(self) -> int:
        return id(self.thing)
