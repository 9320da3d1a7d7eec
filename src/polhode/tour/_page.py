"""The site of the problem set: a front page, and a page for each problem."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files

from polhode.base import installed_version, provenance
from polhode.tour._claims import JudgedClaim, counted, verdicts
from polhode.tour._sections import problem_of, section, summary
from polhode.tour._work import Worked
from polhode.view import Markup, document, json_element, styled, tag

FIGURES = "figures"
CARD = (480, 300)
"""Width and height of the picture of a problem on the front page, pixels."""

_TITLE = "Seven problems in rigid-body mechanics"


@dataclass(frozen=True)
class Problem:
    """A problem of the text with its variants.

    Attributes:
        name: of its page, without ending.
        systems: worked through, the problem itself first.
        claims: what the text says about them.
    """

    name: str
    systems: tuple[Worked, ...]
    claims: tuple[JudgedClaim, ...]

    @property
    def title(self) -> str:
        """Heading."""
        return self.systems[0].entry.title


def problems(all_worked: Iterable[Worked], claims: Iterable[JudgedClaim]) -> tuple[Problem, ...]:
    """Systems and claims sorted by problem."""
    found: dict[str, list[Worked]] = {}
    for worked in all_worked:
        found.setdefault(problem_of(worked), []).append(worked)
    judged = tuple(claims)
    return tuple(
        Problem(name, tuple(systems), tuple(c for c in judged if c.problem == name))
        for name, systems in found.items()
    )


def front_page(all_problems: Sequence[Problem]) -> str:
    """The page that leads to all others."""
    cards = tag("div", *map(_card, all_problems), class_="cards")
    everything = [worked for problem in all_problems for worked in problem.systems]
    body = (
        tag("header", tag("h1", _TITLE), *_opening(all_problems)),
        tag(
            "main",
            cards,
            tag("h2", "All checks"),
            summary(everything),
            tag(
                "p",
                "Drifts are the largest along the default run: of the energy, relative to its "
                "size; and of the centre of mass, from the position found by integrating the "
                "velocity that the constraints allow.",
            ),
        ),
        tag("footer", *_closing(everything)),
    )
    return _page(f"polhode: {_TITLE.lower()}", body)


def problem_page(problem: Problem, all_problems: Sequence[Problem]) -> str:
    """The page of one problem."""
    first, *variants = problem.systems
    links = (
        tag("span", other.title, aria_current="page")
        if other.name == problem.name
        else tag("a", other.title, href=f"{other.name}.html")
        for other in all_problems
    )
    body = (
        tag("nav", tag("a", "All problems", href="index.html"), *links, aria_label="problems"),
        tag(
            "main",
            section(first, FIGURES, 1),
            *(section(variant, FIGURES, 2) for variant in variants),
            verdicts(problem.claims),
        ),
        tag("footer", *_closing(problem.systems)),
    )
    return _page(f"{problem.title} · polhode", body)


def _page(title: str, body: Iterable[Markup]) -> str:
    own = files("polhode.tour").joinpath("style.css").read_text("utf-8")
    return document(title, styled(own), *body)


def _opening(all_problems: Sequence[Problem]) -> Iterator[Markup]:
    everything = [worked for problem in all_problems for worked in problem.systems]
    judged = sum(worked.judged for worked in everything)
    yield tag(
        "p",
        "Seven solutions that answer the questions of a problem set in their order. Each system is "
        "declared once: its bodies, their contacts and joints, and the loads on them. Its "
        "equations, every reaction, the steady motions and their stability follow from that; "
        f"{judged} formulas are displayed, and every one was judged against the system when these "
        "pages were written.",
    )
    claims = [claim for problem in all_problems for claim in problem.claims]
    if claims:
        yield tag(
            "p",
            "The text they come from was checked as well: ",
            counted(claims),
            ". Where it is wrong, a remark says what it prints, what is right, and how one sees "
            "it.",
        )


def _card(problem: Problem) -> Markup:
    width, height = map(str, CARD)
    source = f"{FIGURES}/{problem.name}-card.png"
    image = tag("img", src=source, alt="", width=width, height=height)
    first_sentence = problem.systems[0].entry.about.partition(". ")[0].rstrip(".")
    words = tag("p", f"{first_sentence}.")
    address = f"{problem.name}.html"
    return tag("a", image, tag("h2", problem.title), words, class_="card", href=address)


def _closing(everything: Sequence[Worked]) -> tuple[Markup, ...]:
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
            for worked in sorted(everything, key=lambda worked: worked.entry.name)
        },
    }
    return (
        tag("p", "Written by ", tag("code", "polhode tour"), f", version {version}."),
        json_element("made-with", made_with),
    )
