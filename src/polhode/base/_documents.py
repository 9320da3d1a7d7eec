"""Documents: the schema number and provenance that each carries, and declarations as plain JSON.

A declaration is a list of parts, and contains no code. A part names its shape and its fields; a
field is a number, a text, null, a list, or {"#": k}, a reference to the earlier part number k. Each
part is written once, so a reader needs no recursion, and it builds every object with the same
constructor, and hence the same checks, as a user's script.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, NoReturn, TypedDict, TypeVar

from polhode.base._errors import PolhodeError, StoreError

SCHEMA = 2
"""Number of the layout of every JSON document, file, page and store."""

LIBRARIES = (
    "python-flint",
    "numpy",
    "scipy",
    "heyoka",
    "wasmtime",
    "sympy",
    "matplotlib",
    "latex2mathml",
)
"""Distributions whose version a result may depend on."""


class Provenance(TypedDict):
    """Versions and seed behind a document; a library that is not installed has the version None."""

    schema: int
    versions: dict[str, str | None]
    seed: int | None


def provenance(seed: int | None = None) -> Provenance:
    """The provenance of a document being written, determined without importing any library.

    Args:
        seed: of the random numbers that went into it, None if none did.
    """
    import platform

    versions: dict[str, str | None] = {
        "polhode": installed_version("polhode"),
        "python": platform.python_version(),
    }
    versions |= {library: installed_version(library) for library in LIBRARIES}
    return {"schema": SCHEMA, "versions": versions, "seed": seed}


@cache
def installed_version(distribution: str) -> str | None:
    """The version of an installed distribution, None where it is not installed."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(distribution)
    except PackageNotFoundError:
        return None


# -- declarations ----------------------------------------------------------------------------------

T = TypeVar("T")

_MOST_TEXT = 32 * 1024**2
_MOST_PARTS = 100_000
_DEEPEST = 200  # parts nested in one another
_DEEPEST_LIST = 6
_REFERENCE = "#"
_FORMAT = "polhode declaration"

_UNFIT = (
    PolhodeError,
    ArithmeticError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
)
"""Exceptions that constructors may raise for invalid fields."""


@dataclass(frozen=True)
class ShapeRecord:
    """How objects of some classes are written as plain fields and read back.

    Attributes:
        name: in documents.
        kinds: the classes.
        apart: the fields of an object: numbers, texts, None, tuples, objects that have a shape.
        together: makes the object from those fields, and refuses ones that do not fit.
    """

    name: str
    kinds: tuple[type, ...]
    apart: Callable[[Any], Mapping[str, Any]]
    together: Callable[..., Any]


class Codec:
    """Writes and reads objects of known shapes only."""

    def __init__(self, shapes: Iterable[ShapeRecord]) -> None:
        self._by_name = {shape.name: shape for shape in shapes}
        self._by_kind = {kind: s for s in self._by_name.values() for kind in s.kinds}

    def write(self, value: object) -> str:
        """An object as a JSON document, identical for equal objects.

        Raises:
            StoreError: for an object of an unknown class.
        """
        writer = _PlainWriter(self._by_kind)
        writer.reference(value)
        parts = ",\n".join(writer.parts)
        return f'{{"format": "{_FORMAT}", "schema": {SCHEMA}, "parts": [\n{parts}\n]}}\n'

    def read(self, text: str, kind: type[T]) -> T:
        """The object that a document stands for.

        Raises:
            StoreError: for a document that is damaged, of another schema, not of this kind, or
                larger than any declaration.
        """
        made: list[Any] = []
        depths: list[int] = []
        for number, part in enumerate(_parts(text)):
            reader = _PlainReader(made, depths)
            try:
                made.append(self._made(part, reader))
            except StoreError:
                raise
            except _UNFIT as error:
                raise _damaged(f"part {number}: {error}") from error
            depths.append(reader.depth + 1)
        if not made or not isinstance(made[-1], kind):
            raise _damaged(f"it does not end with a {kind.__name__}")
        return made[-1]

    def _made(self, part: Any, reader: _PlainReader) -> Any:
        if not isinstance(part, dict) or not isinstance(part.get("is"), str):
            raise ValueError("a part without a class")
        if part["is"] not in self._by_name:
            raise StoreError(
                f"a declaration that cannot be read: it has a part of class {part['is'][:80]!r}",
                expected="a class of polhode, or one defined in this session",
                advice="import the module that defines it before reading the declaration",
            )
        fields = {name: reader.value(field) for name, field in part.items() if name != "is"}
        if reader.depth >= _DEEPEST:
            raise ValueError("parts nested too deeply")
        return self._by_name[part["is"]].together(**fields)


def digest(text: str) -> str:
    """A short identifier of a document: SHA-256 in hexadecimal."""
    return hashlib.sha256(text.encode()).hexdigest()


class _PlainWriter:
    def __init__(self, shapes: Mapping[type, ShapeRecord]) -> None:
        self.parts: list[str] = []
        self._shapes = shapes
        self._known: dict[str, int] = {}
        self._seen: dict[int, tuple[object, int]] = {}

    def reference(self, value: object) -> dict[str, int]:
        """A reference to an object, which is written first if necessary."""
        if id(value) not in self._seen:
            shape = self._shapes.get(type(value))
            if shape is None:
                raise StoreError(
                    f"a {type(value).__name__} in a declaration",
                    expected="expressions, vectors, text, whole numbers and parts of declarations",
                )
            fields = {name: self._field(field) for name, field in shape.apart(value).items()}
            part = json.dumps({"is": shape.name, **fields})
            if part not in self._known:
                self._known[part] = len(self.parts)
                self.parts.append(part)
            # the object is kept alive, as the id of a deleted one may be reused
            self._seen[id(value)] = (value, self._known[part])
        return {_REFERENCE: self._seen[id(value)][1]}

    def _field(self, value: object) -> object:
        if value is None or isinstance(value, bool | int | str):
            return value
        if isinstance(value, tuple):
            return [self._field(item) for item in value]
        return self.reference(value)


class _PlainReader:
    """Reads the fields of one part, and counts how deeply the parts below it are nested."""

    def __init__(self, made: list[Any], depths: list[int]) -> None:
        self.depth = 0
        self._made = made
        self._depths = depths

    def value(self, field: Any, nested: int = 0) -> Any:
        if nested > _DEEPEST_LIST:
            raise ValueError("lists nested too deeply")
        if isinstance(field, list):
            return tuple(self.value(item, nested + 1) for item in field)
        if not isinstance(field, dict):
            return field
        number = field.get(_REFERENCE)
        if len(field) != 1 or type(number) is not int or not 0 <= number < len(self._made):
            raise ValueError("a reference to something other than an earlier part")
        self.depth = max(self.depth, self._depths[number])
        return self._made[number]


def _parts(text: str) -> list[Any]:
    if len(text) > _MOST_TEXT:
        raise _damaged(f"it has {len(text)} characters, more than any declaration")
    try:
        document = json.loads(text, parse_float=_no_number, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise _damaged(f"not JSON ({error})") from error
    if not isinstance(document, dict) or document.get("format") != _FORMAT:
        raise _damaged("it is another kind of document")
    if document.get("schema") != SCHEMA:
        raise StoreError(
            f"a declaration of schema {document.get('schema')!r}",
            expected=f"schema {SCHEMA}",
            advice="read it with the version of polhode that wrote it",
        )
    parts = document.get("parts")
    if not isinstance(parts, list) or len(parts) > _MOST_PARTS:
        raise _damaged("it has no proper list of parts")
    return parts


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text[:20]}, where only integers are allowed")


def _damaged(what: str) -> StoreError:
    return StoreError(
        f"a declaration that cannot be read: {what[:300]}",
        expected="one that polhode wrote, unchanged",
    )
