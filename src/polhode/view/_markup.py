"""Pieces of the HTML that a notebook shows."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from html import escape
from importlib.resources import files

from polhode.view._scene import Formula

_STYLE = (
    ".polhode{max-width:60em;overflow-x:auto}"
    ".polhode math{font-size:1.1em;font-family:var(--polhode-math)}"
    ".polhode .row{margin:.45em 0 .45em 1.2em;line-height:1.9}"
    ".polhode table{border-collapse:collapse;margin:.3em 0}"
    ".polhode table td,.polhode table th{text-align:left;vertical-align:baseline;"
    "padding:.15em .8em .15em 0}"
    ".polhode summary{cursor:pointer;font-weight:600}"
    ".polhode table caption{text-align:left;white-space:nowrap;font-weight:600;"
    "padding:.2em 0}"
)


def framed(inner: str) -> str:
    """A block with the style of all of them."""
    return f"<div class='polhode'><style>{math_fonts()}{_STYLE}</style>{inner}</div>"


@cache
def math_fonts() -> str:
    """The style that names the fonts of formulas, `--polhode-math`, on one line."""
    text = files("polhode.view").joinpath("math.css").read_text("utf-8")
    return " ".join(re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL).split())


def table(title: str, header: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Cells of HTML under a title."""
    head = "".join(f"<th scope='col'>{cell}</th>" for cell in header)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><caption>{title}</caption><tr>{head}</tr>{body}</table>"


def rows(formulas: Iterable[Formula]) -> str:
    """Formulas, each on a line of its own."""
    return "".join(f"<div class='row'>{formula(f)}</div>" for f in formulas)


def formula(found: Formula) -> str:
    """Its pieces, or what is said in their place."""
    return " ".join(found.pieces) or escape(found.spoken)


def folded(title: str, formulas: list[Formula]) -> str:
    """Formulas that are seen once asked for; nothing where there are none."""
    if not formulas:
        return ""
    return f"<details><summary>{title}</summary>{rows(formulas)}</details>"
