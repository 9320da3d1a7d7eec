"""A figure as flat lines and letters, in pixels from the upper left corner, for every kind of file.

`figure_of` in `_figure_drawing` makes one from a declaration; here it is written: as SVG that takes
the colours of the page around it, or as a file of its own, as TikZ, or as PNG.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from polhode.base import colours, extra

Flat = tuple[float, float]


@dataclass(frozen=True)
class LineName:
    """What stands at a line.

    Attributes:
        latex: for TeX.
        plain: the same for a page, without its subscript.
        low: the subscript.
    """

    latex: str
    plain: str
    low: str = ""

    @property
    def length(self) -> float:
        """Its width in letters."""
        return len(self.plain.replace("\u0302", "")) + 0.65 * len(self.low)


@dataclass(frozen=True)
class Pen:
    """How a line is drawn.

    Attributes:
        colour: that can be read on white and on black; empty for that of the text around.
        width: pixels; zero for none.
        fill: colour of an area.
        opacity: of the area.
        is_dashed: whether it is dashed.
    """

    colour: str = ""
    width: float = 1.3
    fill: str = ""
    opacity: float = 0.3
    is_dashed: bool = False


_GREY, _FORCE, _ANGLE, _LENGTH, _TURN, _BODY = (
    colours("anywhere")[name] for name in ("grey", "force", "angle", "length", "turn", "body")
)
PENS: dict[str, Pen] = {
    "support": Pen(_GREY, 0.8, _GREY, 0.16),
    "paper": Pen(_GREY, 1.0, "#ffffff", 0.85),
    "wall": Pen(_GREY, 2.2),
    "body": Pen("", 1.5, _BODY, 0.34),
    "rod": Pen("", 2.6),
    "dot": Pen("", 1.0, "ink", 1.0),
    "pin": Pen("", 1.4, "#ffffff", 1.0),
    "fixed": Pen(_GREY, 1.3),
    "axis": Pen("", 1.3),
    "dashed": Pen(_GREY, 1.0, is_dashed=True),
    "angle": Pen(_ANGLE, 1.3),
    "force": Pen(_FORCE, 2.0),
    "arm": Pen(_LENGTH, 1.6),
    "length": Pen(_LENGTH, 1.0),
    "turn": Pen(_TURN, 1.6),
}
_BOLD = {"axis", "force", "arm"}
_LETTER = 17.0  # pixels
_INK = {"": "currentColor", "ink": "currentColor"}


@dataclass(frozen=True)
class Stroke:
    """A line through points.

    Attributes:
        points: where it goes.
        style: one of PENS.
        is_arrow: whether it ends in a head.
        is_closed: whether it is an area.
    """

    points: tuple[Flat, ...]
    style: str
    is_arrow: bool = False
    is_closed: bool = False


@dataclass(frozen=True)
class Letter:
    """A name at its place.

    Attributes:
        name: what stands there.
        style: one of PENS.
        place: of its middle.
    """

    name: LineName
    style: str
    place: Flat


@dataclass(frozen=True)
class Figure:
    """A labelled figure.

    Attributes:
        title: of the figure, for those who cannot see it.
        caption: to be printed below it.
        size: width and height.
        strokes: lines, the first behind.
        letters: names, which stand above all lines.
    """

    title: str
    caption: str
    size: Flat
    strokes: tuple[Stroke, ...]
    letters: tuple[Letter, ...]

    # -- SVG ------------------------------------------------------------------------------------

    def svg(self) -> str:
        """An SVG element in the colours of the page that it is put into."""
        wide, tall = self.size
        drawn = [*map(_svg_line, self.strokes), *map(_svg_letter, self.letters)]
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="polhode-system" '
            f'viewBox="0 0 {wide:g} {tall:g}" width="{wide:g}" height="{tall:g}" role="img">'
            f"<title>{escape(self.title)}</title>{_MARKERS}{''.join(drawn)}</svg>"
        )

    def svg_file(self) -> str:
        """An SVG file of its own, on white."""
        opening, closing = self.svg().split("</title>", 1)
        paper = '<rect width="100%" height="100%" rx="6" fill="#fff"/>'
        coloured = opening.replace("<svg ", '<svg color="#111" ', 1)
        return f'<?xml version="1.0" encoding="UTF-8"?>\n{coloured}</title>{paper}{closing}\n'

    # -- TeX ------------------------------------------------------------------------------------

    def tikz(self) -> str:
        """A tikzpicture, with the letters set by TeX; it needs the packages tikz and xcolor."""
        lines = [
            rf"\begin{{tikzpicture}}[x={_POINTS}pt,y=-{_POINTS}pt,>={{Stealth[length=6pt]}},"
            "line join=round]"
        ]
        lines += [_tikz_line(stroke) for stroke in self.strokes]
        for letter in self.letters:
            x, y = letter.place
            colour = _tikz_colour(PENS[letter.style].colour)
            # In a group of its own: \boldmath acts after the group that it stands in.
            text = f"${letter.name.latex}$"
            text = rf"{{\boldmath{text}}}" if letter.style in _BOLD else text
            lines.append(rf"\node[inner sep=0pt,text={colour}] at ({x:g},{y:g}) {{{text}}};")
        return "\n".join([*lines, r"\end{tikzpicture}"])

    # -- PNG ------------------------------------------------------------------------------------

    def png(self) -> bytes:
        """A PNG file on white, of twice the size in pixels."""
        with extra("matplotlib", "figures"):
            from matplotlib import rc_context
            from matplotlib.backends.backend_agg import FigureCanvasAgg
            from matplotlib.figure import Figure as Canvas

        wide, tall = self.size
        with rc_context({"mathtext.fontset": "stix", "text.usetex": False}):
            canvas = Canvas(figsize=(wide / 100, tall / 100), dpi=200, facecolor="white")
            axes = canvas.add_axes((0, 0, 1, 1))
            axes.set(xlim=(0, wide), ylim=(tall, 0), aspect="equal")
            axes.set_axis_off()
            for stroke in self.strokes:
                _plot(axes, stroke)
            for letter in self.letters:
                x, y = letter.place
                text, colour = f"${letter.name.latex}$", PENS[letter.style].colour or "black"
                axes.text(x, y, text, ha="center", va="center", color=colour, fontsize=12.5)
            written = io.BytesIO()
            FigureCanvasAgg(canvas)
            canvas.savefig(written, format="png", dpi=200, facecolor="white")
        return written.getvalue()


# -- SVG -------------------------------------------------------------------------------------------


def _marker(colour: str) -> str:
    paint = _INK.get(colour, colour)
    return (
        f'<marker id="{_head(colour)}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="9" '
        'markerHeight="9" markerUnits="userSpaceOnUse" orient="auto">'
        f'<path d="M0 0.8L8 4L0 7.2Z" fill="{paint}"/></marker>'
    )


def _head(colour: str) -> str:
    return f"polhode-head{colour.replace('#', '-')}"


_MARKERS = "".join(
    ["<defs>", *(_marker(c) for c in dict.fromkeys(p.colour for p in PENS.values())), "</defs>"]
)


def _svg_line(stroke: Stroke) -> str:
    pen = PENS[stroke.style]
    path = "M" + "L".join(f"{x:g} {y:g}" for x, y in stroke.points)
    path += "Z" if stroke.is_closed else ""
    fill = _INK.get(pen.fill, pen.fill) if stroke.is_closed and pen.fill else "none"
    options = f'fill="{fill}" stroke="{_INK.get(pen.colour, pen.colour)}"'
    options += f' stroke-width="{pen.width:g}"'
    if stroke.is_closed and pen.fill:
        options += f' fill-opacity="{pen.opacity:g}"'
    if pen.is_dashed:
        options += ' stroke-dasharray="4 3"'
    if stroke.is_arrow:
        options += f' marker-end="url(#{_head(pen.colour)})"'
    return f'<path class="{stroke.style}" d="{path}" {options}/>'


def _svg_letter(letter: Letter) -> str:
    x, y = letter.place
    colour = PENS[letter.style].colour
    font = f"font:{_font(letter)} {_LETTER:g}px serif"
    # The stroke, in the colour of the page, keeps letters apart from the lines that they meet.
    halo = "stroke:Canvas;stroke-width:3;stroke-linejoin:round;paint-order:stroke"
    middle = "text-anchor:middle;dominant-baseline:central"
    low = f'<tspan dy="4" font-size="12">{escape(letter.name.low)}</tspan>'
    text = escape(letter.name.plain) + (low if letter.name.low else "")
    style = f"{font};{halo};{middle};fill:{_INK.get(colour, colour)}"
    return f'<text class="{letter.style}" x="{x:g}" y="{y:g}" style="{style}">{text}</text>'


def _font(letter: Letter) -> str:
    slant = "normal" if letter.name.plain.isdigit() else "italic"
    return f"{slant} {'bold' if letter.style in _BOLD else 'normal'}"


# -- TikZ ------------------------------------------------------------------------------------------

_POINTS = 0.66  # of a pixel, so that letters of 11 points are as large as on the page


def _tikz_colour(colour: str) -> str:
    return {"": "black", "ink": "black"}.get(colour) or f"polhode{colour[1:]}"


def tikz_colours() -> str:
    """The colours that `tikz` uses."""
    used = {c for pen in PENS.values() for c in (pen.colour, pen.fill) if c.startswith("#")}
    return "\n".join(
        rf"\definecolor{{polhode{c[1:]}}}{{HTML}}{{{c[1:].upper()}}}" for c in sorted(used)
    )


def _tikz_line(stroke: Stroke) -> str:
    return rf"\path[{','.join(_tikz_options(stroke))}] {_tikz_path(stroke)};"


def _tikz_options(stroke: Stroke) -> Iterator[str]:
    pen = PENS[stroke.style]
    yield f"draw={_tikz_colour(pen.colour)}"
    yield f"line width={pen.width * _POINTS:.2f}pt"
    if stroke.is_closed and pen.fill:
        yield f"fill={_tikz_colour(pen.fill)}"
        yield f"fill opacity={pen.opacity:g}"
    if pen.is_dashed:
        yield "dash pattern=on 2.6pt off 2pt"
    if stroke.is_arrow:
        yield "->"


def _tikz_path(stroke: Stroke) -> str:
    rows = [f"({x:g},{y:g})" for x, y in stroke.points]
    lines = [" -- ".join(rows[i : i + 8]) for i in range(0, len(rows), 8)]
    return " --\n  ".join(lines) + (" -- cycle" if stroke.is_closed else "")


# -- matplotlib ------------------------------------------------------------------------------------


def _plot(axes: object, stroke: Stroke) -> None:
    from matplotlib.axes import Axes
    from matplotlib.patches import FancyArrowPatch, PathPatch
    from matplotlib.path import Path

    assert isinstance(axes, Axes)
    pen = PENS[stroke.style]
    colour = pen.colour or "black"
    width = 0.72 * pen.width  # points of a pixel
    points = [*stroke.points, stroke.points[0]] if stroke.is_closed else list(stroke.points)
    path = Path(points)
    dashes = (0, (3, 2)) if pen.is_dashed else "solid"
    if stroke.is_closed and pen.fill:
        fill = "black" if pen.fill == "ink" else pen.fill
        axes.add_patch(PathPatch(path, facecolor=fill, alpha=pen.opacity, linewidth=0))
    if stroke.is_arrow:
        axes.add_patch(
            FancyArrowPatch(
                path=path,
                arrowstyle="-|>,head_length=4.5,head_width=1.9",
                mutation_scale=1,
                color=colour,
                linewidth=width,
                shrinkA=0,
                shrinkB=0,
                joinstyle="miter",
            )
        )
    else:
        axes.add_patch(
            PathPatch(path, fill=False, edgecolor=colour, linewidth=width, linestyle=dashes)
        )
