"""The family of everything that polhode draws: one file of colours, fonts and sizes, `family.json`.

Pages take `pages` and `sizes` as custom properties of CSS; the front end, stills and figures read
the same file. What is drawn once for light and dark pages has the colours of `anywhere`, which can
be read on white and on black (3:1 at least).
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def _family() -> Mapping[str, Any]:
    return json.loads((files("polhode.base") / "family.json").read_text("utf-8"))  # type: ignore[no-any-return]


def colour(name: str, *, dark: bool = False) -> str:
    """A colour of pages by day or by night."""
    return str(_family()["pages"][name][int(dark)])


def series_colours() -> tuple[str, ...]:
    """The colours of lines in plots, which the colour-blind can tell apart (Okabe and Ito)."""
    return tuple(colour(f"series-{i}") for i in range(4))


def colours(part: str) -> Mapping[str, str]:
    """The colours of one part of the file by name: materials, stills, figures, anywhere."""
    return _family()[part]  # type: ignore[no-any-return]


@cache
def family_style(within: str = ":root") -> str:
    """Custom properties of CSS by day and by night, and how a verdict looks.

    Args:
        within: the selector of what has the properties.
    """
    pages, sizes = _family()["pages"], _family()["sizes"]

    def given(values: Mapping[str, str]) -> str:
        return "".join(f"--{name}:{value};" for name, value in values.items())

    day, night = ({name: pair[i] for name, pair in pages.items()} for i in (0, 1))
    first = f"{within}{{color-scheme:light dark;{given(sizes | day)}}}"
    dark = f"@media (prefers-color-scheme:dark){{{within}{{{given(night)}}}}}"
    verdicts = (files("polhode.base") / "verdict.css").read_text("utf-8")
    return f"{first}{dark}\n{verdicts}"
