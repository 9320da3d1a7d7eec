"""Fifty true statements, each said in six ways by a reader who knew the systems but not polhode."""

import json
import runpy
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import polhode as ph
from polhode.catalogue import CATALOGUE

FOLDER = Path(__file__).with_name("paraphrases")
JUDGED = (ph.Mark.TRUE, ph.Mark.NEEDS, ph.Mark.DOUBT, ph.Mark.ERROR, ph.Mark.FOLLOWS)
ACCUSING = (ph.Mark.ERROR, ph.Mark.FOLLOWS, ph.Mark.UNLINKED)


@dataclass(frozen=True)
class Statement:
    system: str
    ways: tuple[str, ...]

    def reviewed(self, way: int) -> tuple[ph.ReviewedLine, ...]:
        """The lines of one way to say it."""
        review = ph.review(self.ways[way], equations(self.system), format=".tex")
        return tuple(review.lines)


@cache
def statements() -> tuple[Statement, ...]:
    found = json.loads((FOLDER / "sentences.json").read_text("utf-8"))
    return tuple(Statement(each["system"], tuple(each["ways"])) for each in found)


@cache
def equations(name: str) -> ph.Equations:
    if name in CATALOGUE:
        return ph.derive(CATALOGUE[name].build())
    path, _, attribute = name.partition(":")
    return ph.derive(runpy.run_path(str(FOLDER / Path(path).name))[attribute])
