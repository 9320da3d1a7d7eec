"""Every family of steady motions of a system, with its existence and its stability."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, roots_in, with_roots
from polhode.analyse import (
    ALWAYS,
    PROVES,
    Branch,
    Condition,
    Stability,
    SteadyMotion,
    Truth,
    expand,
    stability,
    steady,
)
from polhode.base import NumericError, ParseError, look_up
from polhode.catalogue import CATALOGUE
from polhode.cli._exact_options import add_exact_options, exact_system
from polhode.cli._parser import Parser
from polhode.cli._printing import in_decimals, print_document, printed, printed_all
from polhode.derive import Equations


@dataclass(frozen=True)
class _Small:
    """A small quantity, or one over a large one.

    Attributes:
        symbol: the quantity.
        is_large: whether it is large, and one over it small.
        order: the highest power to keep.
        positive: what the system assumes to be positive, such as sin(theta).
    """

    symbol: Symbol
    is_large: bool
    order: int
    positive: tuple[Expr, ...]

    def expanded(self, value: Expr) -> tuple[Expr, Expr | None]:
        """The Taylor polynomial, and the first term left out.

        Raises:
            NumericError: where there is no expansion in powers.
        """
        size = Expr.generator(self.symbol)
        found = expand(value, 1 / size if self.is_large else size, self.order)
        return self._signed(found.polynomial), found.dropped and self._signed(found.dropped[1])

    def _signed(self, value: Expr) -> Expr:
        """An expression with |x| replaced by x where x is positive."""
        known = {root: root.plain for root in roots_in([value]) if root.plain in self.positive}
        return with_roots(value, {root: plain for root, plain in known.items() if plain})

    @property
    def limit(self) -> str:
        name = Expr.generator(self.symbol).pretty()
        return f"for large {name} > 0" if self.is_large else f"for small {name}"


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    add_exact_options(parser)
    parser.add_option(
        "--small QUANTITY:ORDER",
        "expand the steady speeds in a small quantity, or in one over a large one, up to this "
        "power: --small 1/omega_1:1",
    )


def run(options: Namespace) -> int:
    """Find the steady motions of one system and print their existence and stability."""
    entry, equations, at = exact_system(options)
    small = _small(equations, options.small) if options.small else None
    families = [(family, _judged(family)) for family in steady(equations, at)]
    if options.json:
        described = [_document(family, judged, small) for family, judged in families]
        print_document({"system": entry.name, "families": described})
    else:
        print(f"Steady motions of {entry.name}")
        for family, judged in families:
            print(in_decimals("\n".join(_lines(family, judged, small))))
        singular = any(isinstance(judged, NumericError) for _, judged in families)
        if f"{entry.name}/upright" in CATALOGUE and singular:
            print(f"\nFor an upright axle see polhode steady {entry.name}/upright.")
        print(f"\n{PROVES}")
    return 0


def _judged(family: SteadyMotion) -> Stability | NumericError:
    """Its stability, or why that cannot be said, for instance in singular coordinates."""
    try:
        found = stability(family)
        tuple(found.conditions)  # which may turn out to be too long
    except NumericError as undecided:
        return undecided
    return found


def _small(equations: Equations, text: str) -> _Small:
    """The small quantity of an option such as 1/omega_1:2; to first order where none is stated."""
    quantity, colon, order = (part.strip() for part in text.partition(":"))
    if colon and not order.isdecimal():
        raise ParseError(f"the order {order!r}", expected="a whole number, as in 1/omega_1:2")
    name = quantity.removeprefix("1/").strip()
    known = {s.published: s for s in (*equations.parameters, *equations.speeds)}
    symbol = look_up(name, known, f"parameter or speed of {equations.system.name}")
    return _Small(symbol, quantity.startswith("1/"), int(order or 1), equations.assumed_positive)


def _document(
    family: SteadyMotion, judged: Stability | NumericError, small: _Small | None
) -> dict[str, Any]:
    exists = family.branches[0].exists if family.branches else ()
    document: dict[str, Any] = {
        "latex": family.latex(),
        "sympy": printed_all(family.conditions),
        "branches": [
            {
                "quantity": printed(branch.quantity),
                **printed(branch.value),
                **_expanded_document(branch, small),
                "exists_when": _inequalities(branch.exists)[0],
            }
            for branch in family.branches
        ],
        "exists_when": _inequalities(exists)[0],
    }
    if isinstance(judged, NumericError):
        document |= {"stable_when": None, "frequencies": [], "growth": [], "loss": None}
        return document | {"undecided": str(judged)}
    return document | {
        "stable_when": _inequalities(judged.conditions),
        "frequencies": [printed(value) for value in judged.frequencies],
        "growth": [printed(value) for value in judged.growth],
        "loss": judged.loss,
        "drifts": judged.drifts,
    }


def _expanded_document(branch: Branch, small: _Small | None) -> dict[str, Any]:
    """The expansion of a steady speed, and the first term left out; nothing if not asked for."""
    if small is None:
        return {}
    try:
        kept, dropped = small.expanded(branch.value)
    except NumericError:  # no expansion in powers
        return {"expanded": None, "dropped": None}
    return {"expanded": printed(kept), "dropped": dropped and printed(dropped)}


def _inequalities(conditions: Sequence[Condition]) -> list[dict[str, str]]:
    return [_inequality(condition) for condition in conditions or (ALWAYS,)]


def _inequality(condition: Condition) -> dict[str, str]:
    if condition.truth is not Truth.OPEN:
        word = condition.truth.value
        return {"latex": rf"\mathrm{{{word}}}", "sympy": word}
    left = printed(condition.expression)["sympy"]
    return {"latex": condition.latex(), "sympy": f"StrictGreaterThan({left}, Integer(0))"}


def _lines(
    family: SteadyMotion, judged: Stability | NumericError, small: _Small | None
) -> Iterator[str]:
    yield f"\n  {family}"
    for branch in family.branches:
        yield f"    {branch.quantity.pretty()} = {branch.value.pretty()}"
        if small is not None:
            yield _expanded_line(branch, small)
    if small is not None and not family.branches:
        yield "    no speed that is solved for, to be expanded"
    if family.branches:
        yield f"    exists when {' and '.join(map(str, family.branches[0].exists)) or 'always'}"
    if isinstance(judged, NumericError):
        yield f"    undecided: {judged}"
        return
    yield f"    {judged}"
    if judged.frequencies:
        yield f"    frequencies {_listed(judged.frequencies)}"
    if judged.truth is Truth.NEVER and judged.growth:
        yield f"    grows at {_listed(judged.growth)}"
    if judged.loss:
        yield f"    loss: {judged.loss}"


def _expanded_line(branch: Branch, small: _Small) -> str:
    try:
        kept, dropped = small.expanded(branch.value)
    except NumericError as error:
        return f"      no expansion {small.limit}: {error}"
    rest = f"; the next term is {dropped.pretty()}" if dropped else ", exactly"
    return f"      ≈ {kept.pretty()} {small.limit}{rest}"


def _listed(values: Sequence[Expr]) -> str:
    return ", ".join(value.pretty() for value in values)
