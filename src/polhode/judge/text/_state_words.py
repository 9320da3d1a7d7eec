"""States that words name: upright, at the bottom, without spin, in a straight line."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum


class StateKind(Enum):
    """What a state that a sentence names in words alone is about."""

    STRAIGHT = "motion in a straight line"
    NO_SPIN = "no spin about an axis of the body"
    NO_TURNING = "no rate of an angle"
    LOWEST = "the place where the potential energy is least"
    HIGHEST = "the place where it is greatest"
    UPRIGHT = "a right angle, or none"


@dataclass(frozen=True)
class StateInWords:
    """A state that a sentence names in words.

    Attributes:
        kind: what it is about.
        words: as they stand there.
    """

    kind: StateKind
    words: str


_IF = r"\b(?:if|when|while|once|where|as long as|suppos\w+|assum\w+)\b[^.,;:]{0,40}?\b"
_NOT = (
    rf"(?:{_IF}(?:not|n['’]t|never|no longer)|\bwithout(?: any)?|\b(?:with|has|have) no) (?:\w+ )?"
)
_STATES = {
    StateKind.STRAIGHT: r"\b(?:roll|mov|go|travel)\w* (?:in a )?straight(?: line)?"
    r"|\bstraight rolling",
    StateKind.NO_SPIN: rf"{_NOT}(?:spin|rotat)\w*",
    StateKind.NO_TURNING: rf"{_NOT}(?:precess|turn|tilt|nutat|nod|wobbl)\w*",
    StateKind.LOWEST: r"\b(?:at|in|through|past) (?:the |its )?(?:very )?(?:bottom|lowest point)\b",
    StateKind.HIGHEST: r"\bat (?:the |its )?(?:very )?(?:highest point|top)\b",
    StateKind.UPRIGHT: rf"{_IF}(?:upright|vertical|horizontal)\b(?! [a-z])|\bon edge\b|\bsleeping\b"
    r"|\b(?:upright|vertical|horizontal) position\b|\b(?:roll|spin|stand)\w* upright\b"
    r"|\bupright (?:roll|spin|motion|top|disk|disc|coin|wheel)\w*",
}


def state_in_words(words: str) -> StateInWords | None:
    """The state that words name first."""
    found = ((re.search(said, words, re.I), kind) for kind, said in _STATES.items())
    states = ((m.start(), StateInWords(kind, m[0].strip())) for m, kind in found if m is not None)
    return min(states, key=lambda pair: pair[0], default=(0, None))[1]
