"""The command line: an argparse parser, ``name=value`` options, and endings of file names."""

from __future__ import annotations

from argparse import PARSER, Action, ArgumentParser, RawDescriptionHelpFormatter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NoReturn

from polhode.base import ParseError, StoreError, did_you_mean, look_up

NAME_HELP = "a system from 'polhode list', or path/to/file.py:name of your own System"


class _HelpFormatter(RawDescriptionHelpFormatter):
    """Puts summaries of commands beside their names, whose indentation argparse forgets."""

    def add_argument(self, action: Action) -> None:
        super().add_argument(action)
        if action.nargs == PARSER:
            self._action_max_length += 2


class Parser(ArgumentParser):
    """An argument parser that raises `ParseError` and takes no abbreviations.

    Only options that were declared begin with a single dash, so that ``-2*a`` is a value.
    """

    def __init__(self, **settings: Any) -> None:
        settings.setdefault("formatter_class", _HelpFormatter)
        super().__init__(allow_abbrev=False, **settings)

    def add_system(self) -> None:
        """Add NAME, the system that a command is about."""
        self.add_argument("name", metavar="NAME", help=NAME_HELP)

    def add_json(self) -> None:
        """Add --json."""
        self.add_switch("--json", "print one JSON document")

    def add_switch(self, flag: str, meaning: str) -> None:
        """Add an option without a value."""
        self.add_argument(flag, action="store_true", help=meaning)

    def add_option(self, form: str, meaning: str, **settings: Any) -> None:
        """Add an option with a value, written as ``--duration T``; by default an empty text."""
        flag, value = form.split(maxsplit=1)
        self.add_argument(flag, metavar=value, help=meaning, **{"default": "", **settings})

    def add_list(self, form: str, meaning: str, **settings: Any) -> None:
        """Add an option that may be repeated; its values are a list."""
        self.add_option(form, meaning, action="append", default=[], **settings)

    def add_file(self, form: str, meaning: str, **settings: Any) -> None:
        """Add an option with the path of a file or folder, by default None."""
        self.add_option(form, meaning, type=Path, default=None, **settings)

    def add_motion(
        self,
        settings: str,
        start: str = "set an initial coordinate or speed, such as theta=80deg; a bare number is in "
        "SI units, an angle in radians. If any is set, speeds not named start at zero",
        duration: str = "length of the motion, such as 10s",
    ) -> None:
        """Add --set, --start and --duration, each with its help."""
        self.add_list("--set k=v", settings, dest="settings")
        self.add_list("--start k=v", start)
        self.add_option("--duration T", duration)

    def error(self, message: str) -> NoReturn:
        """Refuse the command line; `message` is argparse's."""
        expected = ""
        if message.startswith("the following arguments are required: "):
            message = f"no {message.partition(': ')[2].replace(', ', ', no ')}"
            required = (_usage(action) for action in self._actions if action.required)
            expected = f"'{' '.join([self.prog, *required])}'"
        raise ParseError(message, expected=expected, advice=self._advice)

    @property
    def _advice(self) -> str:
        return f"see '{self.prog} --help'"

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse as usual, but refuse what is left over, also for subcommands."""
        known, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self._refuse(unknown)
        return known, unknown

    def _refuse(self, unknown: Sequence[str]) -> NoReturn:
        first = unknown[0]
        if first.startswith("--"):
            name = first.partition("=")[0]
            # the dashes, which all options share, ask for a higher likeness
            advice = did_you_mean(name, self._option_string_actions, 0.6)
            raise ParseError(f"{self.prog} has no option {name}", advice=advice or self._advice)
        flags = [o for o in ("--set", "--start", "--at") if o in self._option_string_actions]
        if "=" in first and flags:
            advice = f"did you mean {' or '.join(f'{flag} {first}' for flag in flags)}?"
        else:
            advice = "write a value that contains blanks in quotes, as in 'M=0.2 kg'"
        raise ParseError(f"{self.prog} takes no argument {' '.join(unknown)!r}", advice=advice)

    def _check_value(self, action: Any, value: Any) -> None:
        if action.choices is not None:
            flag = "".join(action.option_strings[:1])
            what = f"value of {flag}" if flag else f"{action.dest} of {self.prog}"
            look_up(value, dict.fromkeys(action.choices), what)

    def _get_values(self, action: Any, arg_strings: Any) -> Any:
        if action.option_strings and arg_strings == ["--"]:  # argparse would take it as no value
            self.error(f"argument {'/'.join(action.option_strings)}: -- where a value is expected")
        return super()._get_values(action, arg_strings)

    def _parse_optional(self, arg_string: str) -> Any:
        if not arg_string.startswith("--") and arg_string not in self._option_string_actions:
            return None
        return super()._parse_optional(arg_string)


def _usage(action: Action) -> str:
    """A required argument as it is written."""
    value = str(action.metavar or action.dest)
    return " ".join([*action.option_strings[:1], value])


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
