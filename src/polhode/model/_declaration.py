"""Systems as JSON documents, from which all equations can be derived again."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from types import CodeType, UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

from polhode.algebra import SHAPES, Expr, Vector
from polhode.base import Codec, ShapeRecord, StoreError, digest
from polhode.model._body import Body
from polhode.model._declared import Declared, is_own, registered
from polhode.model._frame import Frame
from polhode.model._joints import Pivot, Weld
from polhode.model._system import System

_SOURCE = "source of its class"


def write_declaration(system: System) -> str:
    """A system as a JSON document, identical for equal declarations.

    Raises:
        StoreError: for a system with parts that are not dataclasses, or hold values other than
            expressions, vectors, text, whole numbers, and parts of declarations.
    """
    return _codec().write(system)


def read_declaration(text: str) -> System:
    """The system that a document declares, constructed and checked as in a script.

    Nothing in the document is executed.

    Raises:
        StoreError: for a document that is damaged, or declares something impossible.
    """
    return _codec().read(text, System)


def _codec() -> Codec:
    special = (
        ShapeRecord("Frame", (Frame,), _frame_fields, _frame),
        ShapeRecord("vector", (Vector,), _vector_fields, _vector),
        ShapeRecord("Body", (Body,), _fields, _body),
        ShapeRecord("System", (System,), _system_fields, _system),
    )
    others = (kind for kind in registered() if kind not in (Body, Frame, System))
    return Codec((*SHAPES, *special, *map(_record, others)))


def _record(kind: type[Declared]) -> ShapeRecord:
    """How objects of a class are written; for a user's class with a digest of its source."""
    if is_own(kind):
        return ShapeRecord(kind.__name__, (kind,), _fields, lambda **given: _declared(kind, given))

    def apart(value: Any) -> dict[str, Any]:
        return {**_fields(value), _SOURCE: source_digest(kind)}

    def together(**given: Any) -> Any:
        if given.pop(_SOURCE, None) != source_digest(kind):
            raise StoreError(
                f"a {kind.__name__}, whose class has changed since this was written",
                expected="the same class: with another, the motion would differ",
                advice=f"restore {kind.__name__}, or compute the motion again",
            )
        return _declared(kind, given)

    return ShapeRecord(kind.__name__, (kind,), apart, together)


def source_digest(kind: type) -> str:
    """A digest of the source of a class without comments and docstrings.

    If there is no source, as for a class typed into an interpreter, it is that of the compiled
    methods, which also depends on the version of Python.
    """
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(kind)))
    except (OSError, TypeError, SyntaxError):
        methods = (vars(kind)[name] for name in sorted(vars(kind)))
        return digest("\n".join(_compiled(m.__code__) for m in methods if inspect.isfunction(m)))
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
    return digest(ast.unparse(tree))


def _compiled(code: CodeType) -> str:
    constants = (_compiled(c) if isinstance(c, CodeType) else repr(c) for c in code.co_consts)
    return " ".join((code.co_name, code.co_code.hex(), *code.co_names, *constants))


def _fields(value: Any) -> dict[str, Any]:
    found = {field.name: getattr(value, field.name) for field in fields(value)}
    left_out = {name for name in getattr(value, "omitted", ()) if found.get(name) is None}
    return {name: part for name, part in found.items() if name not in left_out}


def _declared(kind: type, given: Mapping[str, Any]) -> Any:
    """An object made by its constructor; refused unless its fields then equal those given."""
    words = {**given, "only": " ".join(given["only"])} if "only" in given else given
    known = _words(kind)
    return _confirmed(kind(**{name: words[name] for name in words if name in known}), given)


@cache
def _words(kind: type[Any]) -> frozenset[str]:
    """Parameters of its constructor by name; a weld passes on those of a pivot."""
    kinds = (kind, Pivot) if kind is Weld else (kind,)
    return frozenset(name for one in kinds for name in inspect.signature(one).parameters)


def _confirmed(made: Any, given: Mapping[str, Any]) -> Any:
    hints = get_type_hints(type(made))
    if _fields(made).keys() != set(given):
        raise ValueError(f"fields {', '.join(given)} of a {type(made).__name__}")
    for name, value in given.items():
        if not _fits(value, hints[name]) or getattr(made, name) != value:
            raise ValueError(f"{name} of a {type(made).__name__}")
    return made


def _fits(value: Any, hint: Any) -> bool:
    """Whether a value is of an annotated type: a class, a tuple, or one of several."""
    among = get_args(hint)
    if get_origin(hint) in (Union, UnionType):
        return any(_fits(value, one) for one in among)
    if get_origin(hint) is not tuple:
        return isinstance(value, hint)
    if not isinstance(value, tuple):
        return False
    types = among[:1] * len(value) if among[-1] is Ellipsis else among
    return len(value) == len(types) and all(map(_fits, value, types))


def _frame_fields(frame: Frame) -> dict[str, Any]:
    """Its fields; without a compass where it has none, as in documents from before it was kept."""
    found = _fields(frame)
    return found if frame.compass else {k: v for k, v in found.items() if k != "compass"}


def _frame(**given: Any) -> Frame:
    given.setdefault("compass", ())
    frame: Frame = _confirmed(Frame(**given), given)
    if len(set(frame.labels)) != 3 or len(frame.labels) != 3 or len(frame.turned) != 3:
        raise ValueError("a frame without three directions")
    if len(frame.compass) not in (0, 3):
        raise ValueError("a frame with some directions of the compass")
    if len(frame.axis) != 3 or sum(part * part for part in frame.axis) != 1:
        raise ValueError("a frame turned about something other than a unit vector")
    return frame


def _vector_fields(vector: Vector) -> dict[str, Any]:
    return {"components": vector.components, "frame": vector.triad}


def _vector(components: tuple[Expr, ...], frame: Frame) -> Vector:
    if not _fits(components, tuple[Expr, Expr, Expr]) or not isinstance(frame, Frame):
        raise ValueError("a vector without three components along a frame")
    return Vector(components, frame)


def _body(**given: Any) -> Body:
    named = {**given, "tag": given["tag"].removeprefix("_")}
    return _confirmed(Body(**named), given)  # type: ignore[no-any-return]


_LAWS = ("impacts", "sharing")  # of a system, which may be left out


def _system_fields(system: System) -> dict[str, Any]:
    """Its fields; without those left empty that documents have not always had."""
    found = _fields(system)
    empty = {name for name in ("speeds", *_LAWS) if not found[name]}
    return {name: value for name, value in found.items() if name not in empty}


def _system(**given: Any) -> System:
    parts = (*given["bodies"], *given["elements"], *given["loads"])
    speeds = given.setdefault("speeds", ())
    chosen = {symbol.name: meaning for symbol, meaning in speeds}
    laws = {name: given.setdefault(name, "") for name in _LAWS}
    kept = given["independent"]
    made = System(*parts, name=given["name"], independent=kept, speeds=chosen, **laws)
    return _confirmed(made, given)  # type: ignore[no-any-return]
