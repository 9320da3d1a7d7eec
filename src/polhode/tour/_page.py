"""The page of all systems: one document that needs nothing but the figures beside it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.resources import files

from polhode.base import installed_version, provenance
from polhode.tour._html import Markup, joined, tag
from polhode.tour._sections import picture, section, summary
from polhode.tour._work import Worked

FIGURES = "figures"
_TITLE = "polhode: seven problems in rigid-body mechanics"


def page(all_worked: Sequence[Worked]) -> str:
    """The whole document."""
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="color-scheme", content="light dark"),
        tag("title", _TITLE),
        tag("link", rel="icon", href="data:,"),
        tag("style", Markup(_style())),
    )
    body = tag(
        "body",
        tag("header", *_opening(all_worked)),
        tag("main", *(_section(worked) for worked in all_worked)),
        tag("footer", *_closing(all_worked)),
    )
    return f"<!DOCTYPE html>\n{tag('html', head, body, lang='en')}\n"


def _style() -> str:
    return files("polhode.tour").joinpath("style.css").read_text("utf-8")


def _opening(all_worked: Sequence[Worked]) -> tuple[Markup, ...]:
    return (
        tag("h1", "Seven problems in rigid-body mechanics"),
        tag(
            "p",
            "Each system is declared once: its bodies, what touches or holds them, what pulls. "
            "From that follow, exactly, its equations of motion and every reaction; they are "
            "checked against a second formulation, run with default numbers, and drawn. "
            "Everything here was computed when this page was written.",
        ),
        summary(all_worked),
        tag(
            "p",
            "Drifts are the largest along the default run: of the energy, relative to its size; "
            "and of the place of the centre of mass from where the velocities that the "
            "constraints allow would have taken it.",
        ),
    )


def _section(worked: Worked) -> Markup:
    shown = (picture(worked, drawing, FIGURES) for drawing in worked.drawings)
    return section(worked, tag("div", *shown, class_="figures"))


def _closing(all_worked: Sequence[Worked]) -> tuple[Markup, ...]:
    version = installed_version("polhode") or "(not installed)"
    made_with = {
        **provenance(),
        "runs": {
            worked.entry.name: {
                "parameters": dict(worked.run.parameters),
                "start": dict(worked.entry.start),
                "duration": worked.run.duration,
                "integrator": worked.run.integrator,
            }
            for worked in all_worked
        },
    }
    text = json.dumps(made_with, sort_keys=True).replace("<", "\\u003c")
    return (
        tag("p", joined(["Written by ", tag("code", "polhode tour"), f", version {version}."])),
        tag("script", Markup(text), type="application/json", id="made-with"),
    )
