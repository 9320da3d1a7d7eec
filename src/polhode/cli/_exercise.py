"""Exercises on systems: questions with numbers drawn from a seed, whose answers were judged.

Without -o one sheet is printed as Markdown. With -o the answers and worked solutions are written
apart, beside the sheets, and a key by which --mark marks what students hand in.
"""

from __future__ import annotations

import csv
import io
import re
from argparse import Namespace
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from polhode.base import ParseError, StoreError, write_whole
from polhode.catalogue import CATALOGUE, entry_named_in
from polhode.cli._parser import NAME_HELP, Parser, assignments, refuse_other_endings
from polhode.cli._printing import document, print_document
from polhode.cli._systems import entry_of
from polhode.derive import Equations, derive
from polhode.exercise import (
    EXERCISE_FILES,
    KINDS,
    USUAL,
    Builder,
    ExerciseSheet,
    HandedIn,
    MarkedPart,
    PartMark,
    counts,
    key_document,
    markdown_of,
    marked_submission,
    read_key,
    read_submission,
    sheet_blocks,
    solution_blocks,
    title_of,
    write_document,
)

_MOST_STUDENTS = 1000
_EXAMPLES = """examples:
  polhode exercise rolling-disk --seed 3
  polhode exercise gyroscope --seed 3 --kind steady --kind wrong -o gyroscope.html
  polhode exercise spinning-coin rolling-disk --seed 3 --students 30 -o sheets/week5.md
  polhode exercise --key sheets/week5-key.json --mark handed-in/ --marks marks.csv
  polhode exercise top.py:top --key top-key.json --mark handed-in/
  polhode exercise top.py:top --list
"""


def configure(parser: Parser) -> None:
    """Add the options of the command."""
    parser.epilog = _EXAMPLES
    parser.add_argument("names", metavar="NAME", nargs="*", help=NAME_HELP)
    parser.add_option("--seed N", "of the numbers drawn (default: 1)", type=int, default=None)
    parser.add_option(
        "--students N",
        "sheets with the same questions and other numbers (default: 1)",
        type=int,
        default=1,
    )
    parser.add_list(
        "--kind KIND", f"of question, may be repeated: {', '.join(KINDS)}", dest="kinds"
    )
    parser.add_option(
        "--questions N",
        f"on each system, unless kinds are given (default: {USUAL})",
        type=int,
        default=USUAL,
    )
    parser.add_list("--set NAME=VALUE", "a parameter that is not drawn", dest="settings")
    parser.add_switch("--list", "list the kinds that systems offer")
    parser.add_file(
        "-o FILE",
        f"write to a file ending in {', '.join(EXERCISE_FILES)}, one for each student",
        dest="file",
    )
    parser.add_file(
        "--solution FILE", "where answers and worked solutions go (default: beside the sheets)"
    )
    parser.add_file("--key KEY.json", "mark answers by this key")
    parser.add_list(
        "--mark FILE",
        "answers to be marked, or a folder of them; may be repeated",
        dest="answers",
        type=Path,
    )
    parser.add_file("--marks F.csv", "write the marks as a table")
    parser.add_json()


def run(options: Namespace) -> int:
    """Make exercises, list their kinds, or mark answers."""
    if options.key or options.answers or options.marks:
        return _mark(options)
    _check(options)
    entries = [entry_of(name) for name in options.names]
    builders = [Builder.of(entry) for entry in entries]
    if options.list:
        return _list(builders, options)
    sheets = [_sheet(builders, options, student) for student in range(1, options.students + 1)]
    written = _written(sheets, options)
    if options.json:
        print_document(_document(sheets, written))
    elif written:
        print("\n".join(map(str, written)))
    else:
        blocks = [b for sheet in sheets for b in sheet_blocks(sheet)]
        print(markdown_of(blocks, "", options.names, _seed(options)), end="")
    return 0


def _check(options: Namespace) -> None:
    if not options.names:
        raise ParseError(
            "no system", expected="the NAME of at least one", advice="see polhode list"
        )
    if len(set(options.names)) < len(options.names):
        raise ParseError("a system that is named twice", expected="every system once")
    if not 1 <= options.students <= _MOST_STUDENTS:
        raise ParseError(
            f"--students {options.students}", expected=f"a number from 1 to {_MOST_STUDENTS}"
        )
    if not 1 <= options.questions <= len(KINDS):
        raise ParseError(
            f"--questions {options.questions}", expected=f"a number from 1 to {len(KINDS)}"
        )
    if options.settings and len(options.names) > 1:
        raise ParseError("--set with several systems", expected="one system, whose parameter it is")
    for option, file in (("-o", options.file), ("--solution", options.solution)):
        refuse_other_endings(option, file, EXERCISE_FILES)


def _seed(options: Namespace) -> int:
    return 1 if options.seed is None else int(options.seed)


def _sheet(builders: list[Builder], options: Namespace, student: int) -> ExerciseSheet:
    seed, values = _seed(options), assignments(options.settings)
    kinds, most = tuple(dict.fromkeys(options.kinds)), options.questions
    made = (b.exercise(seed, student, kinds, most, values) for b in builders)
    return ExerciseSheet(seed, student, tuple(made))


def _list(builders: list[Builder], options: Namespace) -> int:
    offered = {b.subject.name: list(b.offered(_seed(options))) for b in builders}
    if options.json:
        systems = [{"name": name, "kinds": kinds} for name, kinds in offered.items()]
        print_document({"systems": systems, "meanings": {k: v.meaning for k, v in KINDS.items()}})
        return 0
    for name, kinds in offered.items():
        print(name)
        print("\n".join(f"  {kind:<12} {KINDS[kind].meaning}" for kind in kinds))
    return 0


# -- files -----------------------------------------------------------------------------------------


def _written(sheets: list[ExerciseSheet], options: Namespace) -> list[Path]:
    systems, seed = options.names, _seed(options)
    files: list[Path] = []
    if options.file is not None:
        for sheet in sheets:
            path = _numbered(options.file, sheet.student, len(sheets))
            blocks = list(sheet_blocks(sheet))
            files += write_document(blocks, path, title_of(sheet), systems, seed)
        key = options.file.with_name(f"{options.file.stem}-key.json")
        write_whole(key, document(key_document(sheets)).encode("utf-8"))
        files.append(key)
    solution = options.solution or (options.file and _beside(options.file))
    if solution is not None:
        blocks = list(solution_blocks(sheets))
        files += write_document(blocks, solution, "Answers and worked solutions", systems, seed)
    return files


def _numbered(path: Path, student: int, students: int) -> Path:
    if students == 1:
        return path
    return path.with_name(f"{path.stem}-{student:0{len(str(students))}}{path.suffix}")


def _beside(path: Path) -> Path:
    return path.with_name(f"{path.stem}-solution{path.suffix}")


def _document(sheets: list[ExerciseSheet], files: list[Path]) -> dict[str, object]:
    return {
        "sheets": [
            {
                "student": sheet.student,
                "exercises": [
                    {
                        "system": one.system,
                        "title": one.title,
                        "statement": [{"words": p.words, "latex": p.latex} for p in one.statement],
                        "numbers": dict(one.texts),
                        "figure": one.figure.svg(),
                        "questions": [question.to_json() for question in one.questions],
                    }
                    for one in sheet.exercises
                ],
            }
            for sheet in sheets
        ],
        "seed": sheets[0].seed,
        "files": [str(file) for file in files],
    }


# -- marks -----------------------------------------------------------------------------------------


def _mark(options: Namespace) -> int:
    if options.key is None or not options.answers:
        raise ParseError("marking", expected="--key KEY.json and --mark FILE, both")
    key = read_key(options.key)
    own = {_without_folder(name): name for name in options.names}

    @cache
    def equations_of(name: str) -> Equations:
        """Of a system that the key names; one in a file only if the command names it too."""
        given = own.get(_without_folder(name))
        advice = "polhode exercise FILE.py:NAME --key ..."
        entry = entry_of(given) if given else entry_named_in(str(options.key), name, advice=advice)
        return derive(entry.build())

    found = [read_submission(path, key) for path in _files(options.answers)]
    marked = [(one, marked_submission(one, key, equations_of)) for one in found]
    if options.marks:
        write_whole(options.marks, _table(marked).encode("utf-8"))
    if options.json:
        print_document({"submissions": [_submission(one, marks) for one, marks in marked]})
    else:
        print("\n".join(line for one, marks in marked for line in _lines(one, marks)))
    return int(any(counts(marks)[PartMark.WRONG.value] for _, marks in marked))


def _without_folder(name: str) -> str:
    """The NAME of a system without the folder of its file, which may have been another."""
    return name if name in CATALOGUE else re.split(r"[/\\]", name)[-1]


def _files(paths: list[Path]) -> list[Path]:
    found = []
    for path in paths:
        found += sorted(p for p in path.iterdir() if p.is_file()) if path.is_dir() else [path]
    if not found:
        raise StoreError(f"no answers in {paths[0]}", expected="at least one file")
    return found


def _submission(one: HandedIn, marks: Mapping[str, MarkedPart]) -> dict[str, object]:
    parts = {k: {"mark": m.mark.value, "message": m.message} for k, m in marks.items()}
    return {"file": one.name, "student": one.student, "summary": counts(marks), "parts": parts}


_SIGNS = {PartMark.RIGHT: "✓", PartMark.WRONG: "✗", PartMark.NOT_JUDGED: "·"}


def _lines(one: HandedIn, marks: Mapping[str, MarkedPart]) -> Iterator[str]:
    number = counts(marks)
    yield f"{one.name}, sheet {one.student}: {number['right']} of {len(marks)} right"
    for name, part in marks.items():
        given = " ".join(one.answers.get(name, "").split())
        note = f"  ({part.message})" if part.message else ""
        yield f"  {_SIGNS[part.mark]} {name:<5} {given[:60]}{note}"


def _table(marked: list[tuple[HandedIn, dict[str, MarkedPart]]]) -> str:
    names = list(dict.fromkeys(name for _, marks in marked for name in marks))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["file", "student", "right", "wrong", "not-judged", *names])
    for one, marks in marked:
        parts = [marks[name].mark.value if name in marks else "" for name in names]
        file = f"'{one.name}" if re.match(r"[=+\-@\t]", one.name) else one.name  # no formula
        writer.writerow([file, one.student, *counts(marks).values(), *parts])
    return text.getvalue()
