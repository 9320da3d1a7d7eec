"""Where functions of one number change their signs."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count

_INSIDE = 0.005  # share of an interval by which guesses keep away from its ends


def bisected(function: Callable[[float], float], before: float, after: float) -> float:
    """Where a function that is positive before and not after changes its sign, to the last bit.

    Guesses are the roots of the chord (regula falsi), kept away from the ends; every third guess is
    the middle, which bounds their number where the chord converges from one side only.
    """
    first, last = function(before), function(after)
    for guesses in count(1):
        width = after - before
        middle = before + width / 2
        if middle in (before, after):
            break
        share = first / ((first - last) or 1.0)
        guess = before + width * min(max(share, _INSIDE), 1 - _INSIDE)
        if guesses % 3 == 0 or not before < guess < after:
            guess = middle
        value = function(guess)
        if value > 0:
            before, first = guess, value
        else:
            after, last = guess, value
    return after


def zero_between(function: Callable[[float], float], begin: float, end: float) -> float:
    """A zero of a function, to the last bit.

    Its sign at the end differs from that at the beginning, unless it is zero there.
    """
    first = function(begin)
    if first == 0:
        return begin
    return bisected(function if first > 0 else lambda x: -function(x), begin, end)
