"""The one family of errors, their exit codes, and the errors that many modules raise."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from enum import IntEnum
from functools import partial
from typing import TypeVar


class PolhodeError(Exception):
    """Input, or a situation in a computation, that polhode cannot handle.

    Prints as "given; expected ...; advice", without the parts that were left empty.

    Args:
        given: what was given, with the name of the quantity or declaration.
        expected: what would have been accepted, without the word "expected".
        advice: how to correct it.
        option: the command-line option for that, such as "let"; only the command line prints it.
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
        # Worker processes send back their errors; Exception alone would lose the keywords.
        words = {"expected": self.expected, "advice": self.advice, "option": self.option}
        return partial(type(self), **words), (self.given,)


class DeclarationError(PolhodeError):
    """A body, contact, load or system that is contradictory or incomplete."""


class ConstraintError(PolhodeError):
    """Constraints that contradict one another, or start values that violate them."""


class UnitError(PolhodeError):
    """A value that cannot be read, is not finite, or has the wrong dimension."""


class ParseError(PolhodeError):
    """Text that cannot be read as an expression, a formula or a name."""


class NumericError(PolhodeError):
    """A computation that cannot be done, or not to the requested accuracy."""


class StoreError(PolhodeError):
    """A file or store that is missing, damaged or of another schema."""


class DriftWarning(UserWarning):
    """A motion that cannot be relied on.

    Its energy balance or closed loops err by more than rounding explains, or bodies pass through
    each other.
    """


class Exit(IntEnum):
    """Exit codes of the command line."""

    DONE = 0
    FAILED = 1
    REFUSED = 2
    INTERRUPTED = 130


def exit_code(error: BaseException) -> int:
    """The exit code of a command that `error` has ended.

    It is never `Exit.FAILED`, since a failed check is an answer and not an error: bad input,
    undecidable questions and unforeseen errors are all `Exit.REFUSED`.
    """
    return Exit.INTERRUPTED if isinstance(error, KeyboardInterrupt) else Exit.REFUSED


# -- errors that many modules raise ----------------------------------------------------------------


@contextmanager
def extra(library: str, name: str) -> Iterator[None]:
    """Wraps the import of an optional library, which the extra `name` of polhode installs.

    Raises:
        StoreError: where the library is not installed.
    """
    try:
        yield
    except ImportError as error:
        raise StoreError(
            f"{library} is not installed",
            expected="the optional dependency of polhode that contains it",
            advice=f"pip install 'polhode[{name}]'",
        ) from error


Known = TypeVar("Known")


def look_up(name: str, known: Mapping[str, Known], what: str) -> Known:
    """The value that a name has in a table.

    Raises:
        DeclarationError: for an unknown name, with the nearest known ones.
    """
    if name in known:
        return known[name]
    raise DeclarationError(
        f"{name!r} is no {what}",
        expected=f"one of {', '.join(known)}" if known else "no name, since none is defined",
        advice=did_you_mean(name, known),
    )


def did_you_mean(name: str, known: Iterable[str], likeness: float = 0.5) -> str:
    """The question whether one of the most similar known names was meant; empty without any.

    Names that begin with what was given come first, in either case of letters.
    """
    form, by_form = name.casefold(), {one.casefold(): one for one in known}
    longer = [one for one in by_form if form and one.startswith(form)]
    near = longer[:3] or get_close_matches(form, by_form, n=3, cutoff=likeness)
    return f"did you mean {' or '.join(by_form[form] for form in near)}?" if near else ""
