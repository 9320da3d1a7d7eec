"""The command line: an argparse parser, ``name=value`` options, and endings of file names."""

from __future__ import annotations

from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NoReturn

from polhode.base import ParseError, StoreError


class Parser(ArgumentParser):
    """An argument parser that raises `ParseError` and takes no abbreviations.

    Only options that were declared begin with a single dash, so that ``-2*a`` is a value.
    """

    def __init__(self, **settings: Any) -> None:
        settings.setdefault("formatter_class", RawDescriptionHelpFormatter)
        super().__init__(allow_abbrev=False, **settings)

    def error(self, message: str) -> NoReturn:
        """Refuse the command line."""
        raise ParseError(message, advice=f"see '{self.prog} --help'")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse as usual, but refuse what is left over, also for subcommands."""
        known, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return known, unknown

    def _get_values(self, action: Any, arg_strings: Any) -> Any:
        if action.option_strings and arg_strings == ["--"]:  # argparse would take it as no value
            self.error(f"argument {'/'.join(action.option_strings)}: -- where a value is expected")
        return super()._get_values(action, arg_strings)

    def _parse_optional(self, arg_string: str) -> Any:
        if not arg_string.startswith("--") and arg_string not in self._option_string_actions:
            return None
        return super()._parse_optional(arg_string)


def assignments(texts: Iterable[str]) -> dict[str, str]:
    """The values of ``name=value`` options, by name.

    Raises:
        ParseError: for text without "=", or a name that comes twice.
    """
    values: dict[str, str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise ParseError(f"{text!r}", expected="name=value, such as theta=80deg")
        if name in values:
            raise ParseError(f"{name} is given twice", expected="a single value")
        values[name] = value
    return values


def add_motion_options(parser: Parser, settings: str, start: str, duration: str) -> None:
    """Add --set, --start and --duration, each with its help."""
    for option, where, meaning in (
        ("--set", "settings", settings),
        ("--start", "start", start),
    ):
        parser.add_argument(
            option, dest=where, metavar="k=v", action="append", default=[], help=meaning
        )
    parser.add_argument("--duration", metavar="T", default="", help=duration)


#: Help of --start for a single motion.
START_HELP = "set an initial coordinate or speed; if any is set, speeds not named start at zero"
DURATION_HELP = "length of the motion, such as 10s"


# -- endings of file names -------------------------------------------------------------------------

PAGES = (".html", ".htm")
MOTIONS = (".h5", ".hdf5")


def refuse_other_endings(option: str, path: Path | None, endings: tuple[str, ...]) -> None:
    """Refuse a file name whose ending stands for another format; one without an ending passes.

    Raises:
        StoreError: with the endings that are possible.
    """
    if path is None or not path.suffix or path.suffix.lower() in endings:
        return
    first = endings[0]
    raise StoreError(
        f"{option} {path}: {path.suffix} files are not written there",
        expected=f"a name that ends in {' or '.join(endings)}",
        advice=f"for instance {option} {path.with_suffix(first)}",
    )
