"""A review as workflow commands of GitHub Actions, which annotate the lines of a change.

Source: GitHub documentation, "Workflow commands for GitHub Actions".
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge.output._messages import TITLES, message

_COMMANDS = {
    Mark.ERROR: "error",
    Mark.UNLINKED: "warning",
    Mark.NEEDS: "warning",
    Mark.DOUBT: "notice",
    Mark.FOLLOWS: "notice",
    Mark.NOT_JUDGED: "notice",
}
# The runner undoes these, so that a text can neither end a property nor begin another command.
_DATA = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A"})
_PROPERTY = _DATA | str.maketrans({":": "%3A", ",": "%2C"})


def github_annotations(review: Review) -> str:
    """A workflow command for every line that is not simply true, the errors first, and the notes.

    GitHub shows ten annotations of each kind for a step, so the order matters.
    """
    commands = [
        _command(command, line, review)
        for command in ("error", "warning", "notice")
        for line in review.lines
        if _COMMANDS.get(line.mark) == command
    ]
    notes = (f"::warning title=polhode::{_escaped(note, _DATA)}" for note in review.notes)
    return "\n".join([*commands, *notes])


def _command(command: str, line: ReviewedLine, review: Review) -> str:
    properties = ",".join(f"{name}={value}" for name, value in _properties(line))
    return f"::{command} {properties}::{_escaped(message(line, review), _DATA)}"


def _properties(line: ReviewedLine) -> Iterator[tuple[str, str]]:
    yield "file", _escaped(PurePath(line.file).as_posix(), _PROPERTY)
    yield "line", str(line.line)
    yield "col", str(line.column)
    yield "title", _escaped(f"polhode: {TITLES[line.mark]}", _PROPERTY)


def _escaped(text: str, signs: dict[int, str]) -> str:
    """Text with the signs of the commands, and other line ends, replaced."""
    return " ".join(text.translate(signs).splitlines())
