"""The property tests of the suite, over more examples."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

from hypothesis import given, settings

Test = Callable[..., None]


def widened(test: Test, examples: int) -> Test:
    """The same property over so many examples; it counts those that it held for."""
    handle: Any = test.hypothesis  # type: ignore[attr-defined]
    property_ = handle.inner_test
    held: list[int] = []

    @wraps(property_)
    def counted(*args: object, **kwargs: object) -> None:
        property_(*args, **kwargs)
        held.append(1)

    wide: Any = settings(max_examples=examples, deadline=None)(
        given(**handle._given_kwargs)(counted)
    )
    wide.held = held
    wide.pytestmark = getattr(test, "pytestmark", [])
    return wide
