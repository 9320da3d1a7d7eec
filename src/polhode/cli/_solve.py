"""A worked solution: from the declaration to a text in which every formula was judged.

Without -o the text is printed as Markdown. Every displayed formula is judged against the system
while the solution is built; one that does not hold ends it with an error.
"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from polhode.base import look_up
from polhode.catalogue import CATALOGUE, exact_values
from polhode.cli._parser import Parser, assignments, refuse_other_endings
from polhode.cli._printing import print_document
from polhode.cli._systems import declared_in_file, entry_of
from polhode.derive import derive
from polhode.solution import (
    ROUTES,
    SOLUTION_FILES,
    Solution,
    TextQuestion,
    answered_solution,
    catalogue_example,
    markdown_of_solution,
    solution,
    special_case,
    write_solution,
)

_EXAMPLES = """examples:
  polhode solve rolling-disk
  polhode solve gyroscope --route lagrange -o gyroscope.html
  polhode solve spinning-coin --at g=0
  polhode solve top.py:top -o top.tex -o top.ipynb
  polhode solve top.py:top --set m=0.2kg --set g=9.81 --start theta=60deg --duration 2s
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_system()
    parser.add_option("--route R", f"{', '.join(ROUTES)}; by default the one that displays least")
    parser.add_list(
        "--at k=v",
        "put in an exact value of a parameter of the loads: --at g=0; without the questions "
        "of the text",
    )
    parser.add_list(
        "-o FILE",
        f"write it to a file ending in {', '.join(SOLUTION_FILES)}; may be repeated",
        dest="files",
        type=Path,
    )
    parser.add_motion(
        "value of a parameter for typical numbers, such as M=0.4kg",
        "a coordinate or speed at the start of the motion that is drawn",
        "length of the motion that is drawn",
    )
    parser.add_json()


def run(options: Namespace) -> int:
    """Work out one system and print or write its solution."""
    for file in options.files:
        refuse_other_endings("-o", file, SOLUTION_FILES)
    if options.route:
        look_up(options.route, ROUTES, "route")
    entry = entry_of(options.name)
    motion = assignments(options.settings), assignments(options.start), options.duration
    at = assignments(options.at)
    if entry.name in CATALOGUE and not at:
        found = answered_solution(entry.name, options.route, None, *motion)
    else:
        equations = derive(entry.build())
        if at:
            equations = special_case(equations, exact_values(equations, at, entry))
            free = tuple(p for p in entry.parameters if p.name not in at)
            values = {name: text for name, text in entry.values.items() if name not in at}
            entry = replace(entry, parameters=free, values=values)
        example = catalogue_example(entry, equations, *motion)
        case = "".join(f", {text}" for text in options.at)
        questions = () if at else _questions(options.name)
        found = solution(equations, options.route, questions=questions, example=example)
        title = f"{entry.title}{case}"
        found = replace(found, title=f"{title[:1].upper()}{title[1:]}")
    for file in options.files:
        write_solution(found, file)
    if options.json:
        print_document(
            {
                "system": entry.name,
                "route": found.route,
                "steps": [step.to_json() for step in found.steps],
                "questions": [question.to_json() for question in found.questions],
                "figures": list(_figures(found)),
                "files": [str(file) for file in options.files],
                "seconds": found.seconds,
            }
        )
    elif options.files:
        for file in options.files:
            print(file)
        print(f"{found.counted}, all judged, in {found.seconds:.1f} s")
    else:
        print(markdown_of_solution(found), end="")
    return 0


def _questions(name: str) -> tuple[TextQuestion, ...]:
    """The questions that the user's file asks, under the name `questions`."""
    found = declared_in_file(name, "questions")
    asked = tuple(found) if isinstance(found, Sequence) and not isinstance(found, str) else ()
    return asked if all(isinstance(question, TextQuestion) for question in asked) else ()


def _figures(found: Solution) -> Iterator[dict[str, str]]:
    if found.figure:
        yield {"name": "system", "svg": found.figure.svg()}
    if found.motion:
        yield {"name": "motion", "svg": found.motion}
