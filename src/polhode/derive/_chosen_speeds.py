"""Speeds that a user chooses: each takes the place of a rate or of another speed.

A chosen speed is u = Σ aₖ sₖ + b with the speeds sₖ that the system has otherwise (Kane and
Levinson, Dynamics: Theory and Applications, 1985, § 2.12). These equations are solved for as many
of the sₖ, preferably rates of coordinates, and the solutions inserted everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, linear_parts
from polhode.base import DeclarationError
from polhode.derive._form import Form

_ADVICE = "write it as a sum of rates and speeds of the system, times expressions of coordinates"


@dataclass(frozen=True)
class ChosenSpeeds:
    """The speeds of a system once a user has chosen some.

    Attributes:
        chosen: the user's.
        replaced: the speeds whose places they took, in terms of all that remain.
    """

    chosen: tuple[Symbol, ...]
    replaced: Mapping[Symbol, Expr]


def chosen_speeds(
    given: Sequence[tuple[Symbol, Expr]],
    speeds: Sequence[Symbol],
    rates: Mapping[Symbol, Expr],
    ranks: Mapping[Symbol, int],
    form: Form,
) -> ChosenSpeeds:
    """Solve the meanings of chosen speeds for those that they replace.

    Args:
        given: the chosen speeds and their meanings.
        speeds: of the system without them.
        rates: of the coordinates that are not speeds themselves.
        ranks: which speeds are replaced first.
        form: closed, or in named parts.

    Raises:
        DeclarationError: for meanings that are not linear in the speeds or not independent, and
            for names that are taken.
    """
    chosen = tuple(symbol for symbol, _ in given)
    taken = {symbol.published for symbol in (*speeds, *rates)}
    taken |= {symbol.base().published for symbol in (*speeds, *rates)}
    rows, right = [], []
    for symbol, meaning in given:
        if symbol.published in taken:
            raise DeclarationError(
                f"a chosen speed {symbol.published}, which the system has already",
                expected="names that coordinates and speeds do not have",
                advice="choose another name",
            )
        inserted = meaning.subs(rates)
        coefficients, rest = linear_parts(inserted, speeds)
        if not any(coefficients) or any(_moves(e, speeds) for e in (*coefficients, rest)):
            raise DeclarationError(
                f"the speed {symbol.published} = {meaning}",
                expected=f"an expression that is linear in {', '.join(map(str, speeds))}",
                advice=_ADVICE,
            )
        rows.append(coefficients)
        right.append(Expr.generator(symbol) - rest)
    outcome = form.eliminate(rows, right, [ranks[s] for s in speeds], chosen)
    if len(outcome.solved) < len(rows):
        names = ", ".join(symbol.published for symbol in chosen)
        raise DeclarationError(
            f"the speeds {names}, of which one follows from the others",
            expected="speeds that are independent before constraints are imposed",
            advice="leave one out",
        )
    return ChosenSpeeds(chosen, outcome.in_free(speeds))


def _moves(expression: Expr, speeds: Sequence[Symbol]) -> bool:
    """Whether speeds occur, or rates that are none of the system's."""
    found = expression.symbols()
    return bool(found & set(speeds)) or any(s.kind.varies and s.order > 0 for s in found)
