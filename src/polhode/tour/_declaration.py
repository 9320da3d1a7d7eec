"""The source text of a declaration, with the functions of the catalogue it is made of."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from types import FunctionType

from polhode import catalogue


def source_of(build: Callable[[], object]) -> str:
    """Source of a function and of the catalogue's own functions it calls, callers last."""
    needed = list(dict.fromkeys(reversed(list(_reached(build)))))
    return "\n\n".join(inspect.getsource(function).rstrip() for function in needed)


def _reached(function: object) -> Iterator[FunctionType]:
    if isinstance(function, FunctionType) and function.__module__.startswith(catalogue.__name__):
        yield function
        for name in function.__code__.co_names:
            yield from _reached(function.__globals__.get(name))
