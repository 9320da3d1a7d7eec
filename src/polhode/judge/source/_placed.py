"""Text that remembers, for every character, where it stands in a file."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from re import Match, Pattern


@dataclass(frozen=True)
class PlacedText:
    """Text with the offset of each character in the file that it was taken from.

    Parts of it, texts joined from parts and texts with macros expanded keep these offsets.

    Args:
        text: the characters.
        places: the offset of each in the file, as many as characters.
        end: the offset behind the last of them.
    """

    text: str
    places: Sequence[int]
    end: int

    @classmethod
    def of(cls, text: str) -> PlacedText:
        """The whole text of a file."""
        return cls(text, range(len(text)), len(text))

    @classmethod
    def at(cls, text: str, place: int, end: int) -> PlacedText:
        """Text that all comes from one place, as the body of a macro does."""
        return cls(text, array("q", [place]) * len(text), end)

    @classmethod
    def joined(cls, parts: Iterable[PlacedText]) -> PlacedText:
        """Parts one behind the other."""
        found = list(parts)
        if len(found) == 1:
            return found[0]
        text = "".join(part.text for part in found)
        places = array("q", chain.from_iterable(part.places for part in found))
        return cls(text, places, found[-1].end if found else 0)

    def __len__(self) -> int:
        return len(self.text)

    def __getitem__(self, part: slice) -> PlacedText:
        start, stop, _ = part.indices(len(self.text))
        last, behind = self.places[stop - 1] if stop > start else -1, stop
        while behind < len(self.text) and self.places[behind] <= last:
            behind += 1  # what goes on within the body of a macro ends where the macro does
        end = self.places[behind] if behind < len(self.text) else self.end
        return PlacedText(self.text[part], self.places[part], end)

    def masked(self, pattern: Pattern[str]) -> PlacedText:
        """With blanks for all matches of a pattern; line ends stay."""
        return self.with_text(pattern.sub(_blank, self.text))

    def with_text(self, text: str) -> PlacedText:
        """With other characters at the same places."""
        return PlacedText(text, self.places, self.end)

    def stripped(self) -> PlacedText:
        """Without space at the ends."""
        start = len(self.text) - len(self.text.lstrip())
        return self[start : max(start, len(self.text.rstrip()))]


def _blank(match: Match[str]) -> str:
    return "".join("\n" if character == "\n" else " " for character in match[0])


@dataclass(frozen=True)
class Lines:
    """The lines of a text, to tell the place of an offset as people do."""

    text: str

    @cached_property
    def _starts(self) -> list[int]:
        starts = [0]
        starts.extend(i + 1 for i, character in enumerate(self.text) if character == "\n")
        return starts

    def place(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both counted from 1."""
        line = bisect_right(self._starts, offset)
        return line, offset - self._starts[line - 1] + 1
