"""The look of every figure: sober, readable in print, safe for the colour-blind."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from polhode.base import colour, colours, extra, series_colours

#: Lines are told apart by colour and by dashes.
COLOURS = series_colours()
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.6)), (0, (1.3, 1.3)), (0, (6, 1.5, 1.3, 1.5)))
SHADES = tuple(colours("figures")[f"shade-{i}"] for i in range(4))
INK, MUTED, FAINT = (colour(name) for name in ("ink", "muted", "line"))

WIDTH = 4.6
"""Width of a figure in inches, so that text is legible at the width of a phone."""

_SEEN = ("ink", "muted", "line", "card", *(f"series-{i}" for i in range(4)))
_DARK = {colour(name): colour(name, dark=True) for name in _SEEN}

RULES: Any = {
    "font.family": "STIXGeneral",
    "font.size": 10,
    "mathtext.fontset": "stix",
    "text.color": INK,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.labelsize": 10.5,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 5),
    "axes.xmargin": 0,
    "axes.ymargin": 0.08,
    "grid.color": FAINT,
    "grid.linewidth": 0.5,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "xtick.major.size": 3,
    "ytick.major.size": 3,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.3,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
    "lines.dash_capstyle": "butt",
    "legend.frameon": False,
    "legend.fontsize": 10,
    "legend.handlelength": 2.2,
    "legend.borderaxespad": 0.2,
    "legend.columnspacing": 1.6,
    "figure.constrained_layout.use": True,
    "figure.dpi": 100,
    "savefig.dpi": 200,
    "savefig.transparent": False,
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
    "svg.fonttype": "path",
}


@contextmanager
def house_style() -> Iterator[None]:
    """The style of these figures for all that is drawn or saved within; also a decorator."""
    with extra("matplotlib", "figures"):
        from matplotlib import rc_context

    with rc_context(RULES):
        yield


def line_style(number: int) -> dict[str, Any]:
    """Colour and dashes of the line with this number in a panel; the first sixteen are unlike."""
    again = number // len(COLOURS)
    return {
        "color": COLOURS[number % len(COLOURS)],
        "linestyle": DASHES[(number + again) % len(DASHES)],
    }


def worded(name: str) -> str:
    """A user's name as a legend shows it: taken neither for a formula nor for a hidden entry."""
    plain = name.replace("$", r"\$")
    return f" {plain}" if plain.startswith("_") else plain


def for_dark_pages(svg: str) -> str:
    """The same picture for a dark background."""
    for light, dark in _DARK.items():
        svg = svg.replace(light, dark)
    return svg
