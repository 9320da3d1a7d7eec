"""The system that a NAME on the command line means."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

from polhode.base import DeclarationError, ParseError, PolhodeError, StoreError, look_up
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.model import System, declared_functions

# -- a user's Python file, loaded as a module; errors name the line in it --------------------------


def load(path: Path) -> ModuleType:
    """Run a Python file as a module; what it prints goes to standard error.

    Raises:
        DeclarationError: for an error in the file (polhode's own errors keep their kind).
        ParseError: where the file is not Python.
        StoreError: where it cannot be read.
    """
    if not path.is_file():
        raise StoreError(
            f"the file {path} does not exist", expected="a Python file that declares a System"
        )
    name = f"polhode_file_{path.stem}"
    loader = SourceFileLoader(name, str(path))
    spec = spec_from_loader(name, loader)
    assert spec is not None  # a loader of source files always has one
    module = module_from_spec(spec)
    sys.modules[name] = module
    folder = str(path.resolve().parent)  # the file may import its neighbours
    sys.path.insert(0, folder)
    try:
        with _failures_located(path), redirect_stdout(sys.stderr):
            loader.exec_module(module)
    finally:
        sys.path.remove(folder)
    return module


@contextmanager
def _failures_located(path: Path) -> Iterator[None]:
    try:
        yield
    except SyntaxError as error:
        place = f"{error.filename}, line {error.lineno}" if error.filename else str(path)
        raise ParseError(f"{place}: {error.msg}", expected="a Python file") from error
    except PolhodeError as error:
        given = f"{_place(path, error)}: {error.given}"
        raise type(error)(given, expected=error.expected, advice=error.advice) from error
    except OSError as error:
        raise StoreError(f"{_place(path, error)}: {error}") from error
    except (Exception, SystemExit) as error:
        raise DeclarationError(
            f"{_place(path, error)}: {type(error).__name__}: {error}",
            expected="a file that declares a System",
        ) from error


def _place(path: Path, error: BaseException) -> str:
    """The last line of the file in the traceback of an error."""
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == str(path)
    ]
    return f"{path}, line {lines[-1]}" if lines else str(path)


# -- the NAME --------------------------------------------------------------------------------------


def entry_of(name: str) -> CatalogueEntry:
    """The entry of the catalogue, or one for a system in a file, named there if there are several.

    A file with one system may have values for its motion, under the names that `simulate` takes
    them by: `numbers` for parameters and prescribed functions, `start`, and `duration`.

    Raises:
        DeclarationError: for a name without a system, and for errors in a file.
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
    if len(systems) == 1 and not variable:
        (variable,) = systems
    if variable not in systems:
        what = f"which system of {path}?" if systems else f"{path} without a System"
        what = f"{variable!r} in {path} is not a System" if variable else what
        raise DeclarationError(
            what if variable not in found else f"{what} but a {type(found[variable]).__name__}",
            expected=" or ".join(f"{path}:{key}" for key in systems) or "a System in that file",
        )
    system: System = found[variable]
    entry = CatalogueEntry.bare(name, system.name, system)
    if len(systems) > 1:  # the values below may be those of another
        return entry
    values, start = (_as_texts(found.get(key)) for key in ("numbers", "start"))
    duration = found.get("duration", "")
    functions = {s.published for s in declared_functions(system)}
    return replace(
        entry,
        values={name: text for name, text in values.items() if name not in functions},
        forcing={name: text for name, text in values.items() if name in functions},
        start=start,
        duration=str(duration) if isinstance(duration, int | float | str) else "",
    )


def _as_texts(values: object) -> dict[str, str]:
    if not isinstance(values, Mapping):
        return {}
    return {str(name): str(value) for name, value in values.items()}


def declared_in_file(name: str, variable: str) -> object:
    """What the file of a NAME that was looked up declares under another name; None for nothing."""
    path = Path(name.rpartition(":")[0] or name)
    module = sys.modules.get(f"polhode_file_{path.stem}")
    return None if module is None else vars(module).get(variable)
