"""JSON documents: one on standard output, and nothing else there."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from polhode.algebra import Expr
from polhode.base import NumericError, StoreError, provenance


def print_document(content: Mapping[str, Any]) -> None:
    """Print a document, with what it was made with.

    Raises:
        NumericError: for a number that is not finite.
    """
    print(document(content))


def document(content: Mapping[str, Any]) -> str:
    """The text of a document, with what it was made with.

    Raises:
        NumericError: for a number that is not finite.
    """
    try:
        return json.dumps({**provenance(), **content}, indent=2, allow_nan=False)
    except ValueError as error:
        raise NumericError("a result that is not finite", expected="finite numbers") from error


def printed_all(expressions: Sequence[Expr]) -> str:
    """Several expressions as `sympy.srepr` text: the one there is, or a Tuple of them."""
    texts = [printed(expression)["sympy"] for expression in expressions]
    return texts[0] if len(texts) == 1 else f"Tuple({', '.join(texts)})"


def printed(expression: Expr) -> dict[str, str]:
    """An expression as LaTeX and as `sympy.srepr` text in plain symbols.

    Raises:
        StoreError: where SymPy is not installed.
    """
    from polhode.algebra import to_sympy

    try:
        from sympy import srepr
    except ImportError as error:
        raise StoreError(
            "SymPy is not installed",
            expected="it, to write expressions into a JSON document",
            advice="pip install 'polhode[sympy]'",
        ) from error
    return {"latex": expression.latex(), "sympy": srepr(to_sympy(expression))}
