"""Names: parameters, coordinates, speeds, functions of time, and time itself."""

from __future__ import annotations

import re
from collections.abc import Sequence
from keyword import iskeyword

from polhode.algebra._expression import Expr
from polhode.algebra._ring import Symbol, SymbolKind
from polhode.base import DeclarationError

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*_?")


def words(text: str | Sequence[str], what: str) -> tuple[str, ...]:
    """Names separated by blanks, or in a list.

    Raises:
        DeclarationError: for anything else.
    """
    if isinstance(text, str):
        return tuple(text.split())
    if isinstance(text, list | tuple) and all(isinstance(word, str) for word in text):
        return tuple(text)
    raise DeclarationError(
        f"{what}: {text!r}"[:200], expected="text, with blanks between names", advice='as in "x y"'
    )


def symbols(names: str | Sequence[str], *, positive: bool = False) -> tuple[Expr, ...]:
    """Constant parameters, from names separated by blanks: `M, a = symbols("M a")`.

    `positive` declares the sign, so that √(a²) = a.
    """
    return tuple(_named(name, SymbolKind.PARAMETER, positive) for name in words(names, "names"))


def symbol(name: str, *, positive: bool = False) -> Expr:
    """One constant parameter."""
    return _named(name, SymbolKind.PARAMETER, positive)


def coordinates(names: str | Sequence[str]) -> tuple[Expr, ...]:
    """Generalised coordinates; the rate of `theta` is `theta_dot`."""
    return tuple(_named(name, SymbolKind.COORDINATE) for name in words(names, "names"))


def coordinate(name: str) -> Expr:
    """One generalised coordinate."""
    return _named(name, SymbolKind.COORDINATE)


def speeds(names: str | Sequence[str]) -> tuple[Expr, ...]:
    """Generalised speeds that are not the rate of a coordinate, such as `omega_3`."""
    return tuple(_named(name, SymbolKind.SPEED) for name in words(names, "names"))


def speed(name: str) -> Expr:
    """One generalised speed."""
    return _named(name, SymbolKind.SPEED)


def functions(names: str | Sequence[str]) -> tuple[Expr, ...]:
    """Prescribed functions of time, such as the position X of a sheet that is pulled."""
    return tuple(_named(name, SymbolKind.FUNCTION) for name in words(names, "names"))


def reaction(name: str) -> Expr:
    """A component of the reaction of a contact or joint, for loads that are proportional to it.

    `reaction("F_z")` is the component that `equations.components["F_z"]` gives, in N or N m.
    """
    return _named(name, SymbolKind.REACTION)


def is_name(name: str) -> bool:
    """Whether it is a name: letters, digits and single underscores, a letter first."""
    return _NAME.fullmatch(name) is not None


def _named(name: str, kind: SymbolKind, positive: bool = False) -> Expr:
    if not is_name(name) or name == "t" or iskeyword(name):
        raise DeclarationError(
            f"the name {name!r}",
            expected="letters and digits with underscores, not t or a Python keyword",
            advice="write lambda_ for λ and theta for θ",
        )
    if name.endswith(("_dot", "_ddot", "_dddot")):
        raise DeclarationError(
            f"the name {name!r}",
            expected="a name without _dot, which means a time derivative",
            advice="declare the quantity and call .dt() on it",
        )
    return Expr.generator(Symbol(name, kind, 0, positive))


time = Expr.generator(Symbol("t", SymbolKind.TIME))
"""Time t, s."""
