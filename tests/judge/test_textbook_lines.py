"""Lines as mechanics texts print them, true and false: `textbook_lines.txt`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from catalogue import systems as catalogue
from judge import textbook_systems as systems
from judge.judged import uncorrected
from polhode.derive import Equations
from polhode.judge import Answer

LINES = Path(__file__).with_suffix("").with_name("textbook_lines.txt")
ANSWERS = {
    "true": (Answer.HOLDS, Answer.APPROXIMATE),
    "false": (Answer.FAILS,),
    "ambiguous": (Answer.AMBIGUOUS,),
    "definition": (Answer.DEFINITION,),
    "unread": (Answer.UNREAD,),
}


def _lines() -> Iterator[Any]:
    """System, LaTeX, options and truth of every line."""
    system = ""
    for line in LINES.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            system = line.strip("[]")
        elif line and not line.startswith("#"):
            words, _, options = line.partition(" | ")
            truth, latex = words.split(maxsplit=1)
            yield pytest.param(system, latex, _options(options), truth, id=f"{system}: {latex}")


def _options(text: str) -> dict[str, Any]:
    """Options such as ``context=limit; small=theta:1``; all but the context may be repeated."""
    found: dict[str, Any] = {}
    for option in filter(None, text.split("; ")):
        key, _, value = option.partition("=")
        if key == "context":
            found[key] = value
        else:
            found.setdefault(key, []).append(value)
    return found


def _equations(system: str) -> Equations:
    if hasattr(systems, system):
        found: Equations = getattr(systems, system)()
        return found
    return catalogue.equations(system)


@pytest.mark.parametrize(("system", "latex", "options", "truth"), [*_lines()])
def test_a_line_has_its_truth(system: str, latex: str, options: dict[str, Any], truth: str) -> None:
    verdict = uncorrected(latex, _equations(system), **options)
    assert verdict.answer in ANSWERS[truth], verdict.reason
