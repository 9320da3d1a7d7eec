"""Why a member of an ensemble has no result."""

from __future__ import annotations

from enum import IntEnum

from polhode.base import (
    ConstraintError,
    DeclarationError,
    NumericError,
    ParseError,
    StoreError,
    UnitError,
)


class Reason(IntEnum):
    """How a member ended, as stores keep it.

    DONE is that it was followed to its end, which a disk that falls flat reaches early.
    """

    DONE = 0
    DECLARATION = 1
    CONSTRAINT = 2
    UNIT = 3
    PARSE = 4
    NUMERIC = 5
    STORE = 6
    UNFORESEEN = 7
    NOT_YET = -1


_REASONS: dict[type[Exception], Reason] = {
    DeclarationError: Reason.DECLARATION,
    ConstraintError: Reason.CONSTRAINT,
    UnitError: Reason.UNIT,
    ParseError: Reason.PARSE,
    NumericError: Reason.NUMERIC,
    StoreError: Reason.STORE,
}


def reason_of(error: Exception) -> Reason:
    """The code of an error."""
    return _REASONS.get(type(error), Reason.UNFORESEEN)


def told(error: Exception) -> str:
    """An error in words."""
    known = type(error) in _REASONS
    return str(error) if known else f"{type(error).__name__}: {error}"
