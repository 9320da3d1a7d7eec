"""Options of a run: those of a case, a question that a motion answers; the period of time."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping, Sequence
from itertools import accumulate, chain

from polhode.algebra import read_value
from polhode.analyse import closed_form
from polhode.base import TIME, NumericError
from polhode.catalogue import RunCase, RunNumbers
from polhode.cli._parser import assignments
from polhode.derive import Equations
from polhode.simulate import SheetPath, sampled


def with_case(options: Namespace, case: RunCase) -> Namespace:
    """The options of a run, with the values of a case for everything not given."""
    return Namespace(
        **{
            **vars(options),
            "settings": _with_defaults(options.settings, case.settings),
            "start": _with_defaults(options.start, case.start),
            "duration": options.duration or case.duration,
            "mu": options.mu or case.mu,
            "path": _path(options, case),
            "period": options.period or case.period,
            "events": [*options.events, *(e for e in case.events if e not in options.events)],
        }
    )


def _path(options: Namespace, case: RunCase) -> SheetPath | None:
    """The path of the sheet in a case, unless the sheet is moved otherwise."""
    if not case.sheet or options.sheet or {"X", "Y"} & assignments(options.settings).keys():
        return None
    rows = list(chain.from_iterable(case.sheet))
    starts = list(accumulate(map(len, case.sheet)))[:-1]
    t, x, y = zip(*rows, strict=True)
    unturned = [0.0] * len(t)
    return SheetPath(*(sampled(t, values, starts=starts) for values in (x, y, unturned)))


def period_of(text: str, equations: Equations, numbers: RunNumbers) -> float | None:
    """The period T, s, in which a run counts time; None for the empty text.

    Args:
        text: a time, a formula of parameters, or "exact" for the period of the closed form.

    Raises:
        NumericError: where the motion has no closed form or no period, and for one that is not
            positive.
        ParseError, UnitError: for text that is no time.
    """
    if not text:
        return None
    if text == "exact":
        return float(closed_form(equations, numbers.parameters, numbers.start).period)
    values = {s: numbers.parameters[s.published] for s in equations.parameters}
    names = {s.published: s for s in values}
    given = read_value("period", text, names).in_dimension(TIME, equations.dimensions)
    if (period := given.rounded(values)) > 0:
        return period
    raise NumericError(f"a period of {period:g} s", expected="a positive one")


def _with_defaults(given: Sequence[str], defaults: Mapping[str, str]) -> list[str]:
    """Options of the form name=value, completed."""
    return [f"{name}={value}" for name, value in {**defaults, **assignments(given)}.items()]
