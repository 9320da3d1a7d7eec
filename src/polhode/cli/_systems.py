"""The system that a NAME on the command line means."""

from __future__ import annotations

from pathlib import Path

from polhode.base import DeclarationError, look_up
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.cli._user_file import load
from polhode.model import System

NAME_HELP = "a system of 'polhode list', or path/to/file.py:name of a System"


def entry_of(name: str) -> CatalogueEntry:
    """The catalogue's entry, or one without defaults for a system in a file.

    Raises:
        DeclarationError: for a name that means no system, and for errors in a file.
        ParseError: for a file that is not Python.
        StoreError: for a file that cannot be read.
    """
    path, _, variable = name.rpartition(":")
    if path.endswith(".py"):
        return _declared(name, Path(path), variable)
    if name.endswith(".py"):
        return _declared(name, Path(name), "")
    try:
        return look_up(name, CATALOGUE, "system of the catalogue")
    except DeclarationError as error:
        expected = f"{error.expected}, or path/to/file.py:name"
        raise DeclarationError(error.given, expected=expected, advice=error.advice) from error


def _declared(name: str, path: Path, variable: str) -> CatalogueEntry:
    found = vars(load(path))
    systems = [key for key, value in found.items() if isinstance(value, System)]
    if variable not in systems:
        what = f"{variable!r} in {path} is no System" if variable else f"which system of {path}?"
        raise DeclarationError(
            what if variable not in found else f"{what} but a {type(found[variable]).__name__}",
            expected=" or ".join(f"{path}:{key}" for key in systems) or "a System in that file",
        )
    system: System = found[variable]
    return CatalogueEntry.bare(name, system.name, system)
