"""A figure of one motion, against the time or against the number of periods."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import TYPE_CHECKING

from polhode.algebra import Expr
from polhode.solution._example import Example
from polhode.solution._lines import SolutionLine, listed
from polhode.solution._typical import given_latex, quantity_latex
from polhode.view import figure_of_run, origin_of, svg_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def motion_words(example: Example) -> Iterator[SolutionLine]:
    """The start of the motion, and what the figure shows."""
    equations = example.equations
    letters = {s.published: s for s in (*equations.coordinates, *equations.speeds)}
    names = [n for n in example.start if n in letters and float(example.start[n])]
    chosen = [
        f"${Expr.generator(letters[n]).latex()} = "
        f"{given_latex(equations, letters[n], float(example.start[n]))}$"
        for n in names
    ]
    started = f"starts with {listed(chosen)}" if chosen else "starts from rest"
    others = ", and with all other coordinates and speeds zero" if chosen else ""
    against = "the time"
    if example.period is not None:
        against = f"$t/T$, with the period $T = {quantity_latex(example.period, 's')}$"
    said = f"The motion in the figure {started}{others}. It is drawn against {against}."
    shown = [picture.what for picture in example.pictures]
    yield SolutionLine(f"{said} Below, the figure shows {listed(shown)}." if shown else said)


def motion_figure(example: Example) -> str:
    """The motion as SVG."""
    return svg_of(_drawn(example), origin=origin_of(example.run))


def motion_file(example: Example, kind: str) -> bytes:
    """The motion as a file: "pdf" or "png"."""
    written = io.BytesIO()
    _drawn(example).savefig(written, format=kind, dpi=150, facecolor="white")
    return written.getvalue()


def _drawn(example: Example) -> Figure:
    run = example.run
    pictures = [picture.draw for picture in example.pictures]
    figure = figure_of_run(run, example.groups, beneath=pictures)
    if example.period is not None:
        _in_periods(figure, example.period)
    return figure


def _in_periods(figure: Figure, period: float) -> None:
    """Mark the axis of time in periods."""
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    axes = figure.axes[-1]
    axes.xaxis.set_major_locator(MultipleLocator(period / 2))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda t, _: f"{t / period:g}"))
    axes.set_xlabel("$t/T$")
