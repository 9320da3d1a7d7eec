"""What a picture or a movie is asked for with: refused by name before anything is drawn."""

from __future__ import annotations

from collections.abc import Collection
from math import isfinite

from polhode.base import DeclarationError, NumericError
from polhode.view.stills._picture import ARROWS

_WIDEST = 10_000  # pixels
_LONGEST = 5_000  # frames of a movie


def pixels(size: tuple[int, int]) -> tuple[int, int]:
    """Width and height that can be drawn.

    Raises:
        NumericError: for anything but two whole numbers from 1 to some thousands.
    """
    whole = [n for n in size if isinstance(n, int) and 0 < n <= _WIDEST]
    if len(whole) != 2 or len(size) != 2:
        raise NumericError(
            f"a picture of {size} pixels",
            expected=f"width and height, whole numbers from 1 to {_WIDEST}",
        )
    return whole[0], whole[1]


def kinds(arrows: Collection[str]) -> frozenset[str]:
    """Kinds of arrows, given by one name or by several.

    Raises:
        DeclarationError: for a kind that there is not.
    """
    asked = frozenset([arrows] if isinstance(arrows, str) else arrows)
    unknown = sorted(asked - set(ARROWS))
    if unknown:
        raise DeclarationError(
            f"arrows {', '.join(map(repr, unknown))}", expected=f"some of {', '.join(ARROWS)}"
        )
    return asked


def count_of_frames(duration: float, speed: float, rate: float) -> int:
    """How many frames show a motion of this duration, s.

    Raises:
        NumericError: for a speed or rate that is not positive, or for too many frames.
    """
    if not (speed > 0 and rate > 0 and isfinite(rate)):
        raise NumericError(f"speed {speed} at {rate} frames per second", expected="positive ones")
    wanted = duration / speed * rate
    if wanted > _LONGEST:
        raise NumericError(
            f"a movie of {wanted:.3g} frames",
            expected=f"at most {_LONGEST}",
            advice=f"give a higher speed than {speed:g}, or a lower rate than {rate:g}",
        )
    return max(2, round(wanted))
