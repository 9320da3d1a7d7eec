"""The one family of errors, their exit codes, and the errors that many modules raise."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from enum import IntEnum
from typing import TypeVar


class PolhodeError(Exception):
    """Something polhode was given, or met, that it cannot work with.

    Prints as "given; expected ...; advice", without the parts that were left empty.

    Args:
        given: what came, naming the quantity or the declaration it came in.
        expected: what would have been accepted, without the word "expected".
        advice: what to do about it.
        option: the argument of a command with which it is done, such as "let"; not printed, for
            only the command line has it.
    """

    def __init__(
        self, given: str, *, expected: str = "", advice: str = "", option: str = ""
    ) -> None:
        self.given = given
        self.expected = expected
        self.advice = advice
        self.option = option
        parts = (given, expected and f"expected {expected}", advice)
        super().__init__("; ".join(filter(None, parts)))

    def __reduce__(self) -> tuple[object, ...]:
        # Worker processes send their errors home; Exception alone would forget the keywords.
        return _rebuilt, (type(self), self.given, self.expected, self.advice, self.option)


class DeclarationError(PolhodeError):
    """A body, contact, load or system that contradicts itself or is incomplete."""


class ConstraintError(PolhodeError):
    """Constraints that contradict one another, or start values that contradict them."""


class UnitError(PolhodeError):
    """A value that cannot be read, is not finite, or has the wrong dimension."""


class ParseError(PolhodeError):
    """Text that cannot be read as an expression, a formula or a name."""


class NumericError(PolhodeError):
    """A computation that could not reach the accuracy asked of it."""


class StoreError(PolhodeError):
    """A file or store that is missing, damaged or of another schema."""


class DriftWarning(UserWarning):
    """A motion whose energy balance or closed loops are off by more than rounding explains."""


class Exit(IntEnum):
    """Exit codes of the command line."""

    DONE = 0
    FAILED = 1
    REFUSED = 2
    INTERRUPTED = 130


def exit_code(error: BaseException) -> int:
    """The exit code with which a command ended by `error` leaves.

    A failed check is an answer, not an error, so `Exit.FAILED` is never returned: bad input,
    what could not be read or decided, and what went wrong unforeseen are all `Exit.REFUSED`.
    """
    return Exit.INTERRUPTED if isinstance(error, KeyboardInterrupt) else Exit.REFUSED


def _rebuilt(
    kind: type[PolhodeError], given: str, expected: str, advice: str, option: str
) -> PolhodeError:
    return kind(given, expected=expected, advice=advice, option=option)


# -- errors that many modules raise ----------------------------------------------------------------


@contextmanager
def extra(library: str, name: str) -> Iterator[None]:
    """Around the import of a library that an extra of polhode brings.

    Raises:
        StoreError: where it is not installed.
    """
    try:
        yield
    except ImportError as error:
        raise StoreError(
            f"{library} is not installed",
            expected="the extra of polhode that brings it",
            advice=f"pip install 'polhode[{name}]'",
        ) from error


Known = TypeVar("Known")


def look_up(name: str, known: Mapping[str, Known], what: str) -> Known:
    """What is known under a name.

    Raises:
        DeclarationError: for a name that is not known, with the nearest ones that are.
    """
    if name in known:
        return known[name]
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    raise DeclarationError(
        f"{name!r} is no {what}",
        expected=f"one of {', '.join(known)}" if known else "none: it has none",
        advice=f"did you mean {' or '.join(near)}?" if near else "",
    )
