"""The solutions that `polhode solve` writes, as texts to be reviewed."""

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import ROUTES, solution, write_solution


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build())


@cache
def written(name: str, format: str, route: str = "") -> str:
    """A solution as the text of a file; empty where the system has none by the route."""
    try:
        solved = solution(equations(name), **({"route": route} if route else {}))
    except ph.PolhodeError:
        return ""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"solution{format}"
        write_solution(solved, path)
        return path.read_text("utf-8")


def doubted(name: str, format: str, route: str = "") -> list[str]:
    """Formulas of it that a review marks as wrong or doubtful."""
    review = ph.review(written(name, format, route), equations(name), format=format, seconds=0.0)
    sound = (ph.Mark.TRUE, ph.Mark.NOT_JUDGED)
    return [line.latex for line in review.lines if line.mark not in sound]


#: Every system of the catalogue with every route; those that it does not have give no text.
ALL = [(name, route) for name in PROBLEM_SET for route in ("", *ROUTES)]
