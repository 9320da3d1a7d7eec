"""How far the marks of `polhode review` can be trusted: texts of others, whose truth is known.

    python benchmarks/reviews.py ../shared/reviews/physics ../shared/reviews/referee

A folder of texts has `truth.json`, in one of two forms:

- for each text its file, its system and its relations, each with line, LaTeX and truth ("right",
  "wrong", "carried", "assumption/definition", "not mechanics"), and the place of its first wrong
  relation;
- for each text a letter per relation as `review` lists them (T right, F wrong, C carried on from a
  wrong one, A assumption, D definition, X not to be judged), and `map.txt` with the file and the
  system of each.

With `--keep FOLDER` the answers are kept, and texts that have one are not reviewed again.
"""

from __future__ import annotations

import argparse
import difflib
import json
import re
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import mkdtemp
from time import perf_counter

TRUTHS = ("right", "wrong", "carried", "assumption", "other")
MARKS = (
    "true",
    "needs",
    "not-judged",
    "follows",
    "unlinked",
    "doubt",
    "error",
    "unlisted",
)
LETTERS = {
    "T": "right",
    "F": "wrong",
    "C": "carried",
    "A": "assumption",
    "D": "assumption",
    "X": "other",
}
NAMES = {"assumption/definition": "assumption", "not mechanics": "other"}


@dataclass(frozen=True)
class Relation:
    """A relation of a text, as a person judged it; `line` and `latex` where they are known."""

    truth: str
    line: int = 0
    latex: str = ""


@dataclass(frozen=True)
class Text:
    name: str
    path: Path
    system: str
    relations: tuple[Relation, ...]
    # Places of the first wrong relation; several where one slip is printed several times.
    first_wrong: frozenset[int] = frozenset()


@dataclass
class Tally:
    """Marks of a set of texts, counted by truth."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    firsts: Counter[str] = field(default_factory=Counter)
    failed: list[str] = field(default_factory=list)

    def of(self, truths: tuple[str, ...], *marks: str) -> int:
        return sum(self.counts[t, m] for t in truths for m in marks or MARKS)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--keep", type=Path, default=Path(mkdtemp()), help="folder of the answers")
    parser.add_argument("--bare", action="store_true", help="review without the words")
    parser.add_argument("--only", default="", help="names of texts, separated by commas")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=600, help="limit for each text")
    parser.add_argument("--list", default="", help="marks whose lines are printed: error,follows")
    options = parser.parse_args()
    for folder in options.folders:
        began = perf_counter()
        texts = [t for t in read(folder) if not options.only or t.name in options.only.split(",")]
        with ThreadPoolExecutor(options.workers) as pool:
            answers = list(
                pool.map(lambda t: answer(t, options, without_words=options.bare), texts)
            )
        tally = Tally()
        for text, lines in zip(texts, answers, strict=True):
            count(text, lines, tally, options.list.split(",") if options.list else ())
        print(f"\n{folder.name}{' (bare)' if options.bare else ''}: {len(texts)} texts,", end=" ")
        print(f"{tally.of(TRUTHS)} relations, {perf_counter() - began:.0f} s")
        print_table(tally)


def read(folder: Path) -> list[Text]:
    truth = json.loads((folder / "truth.json").read_text())
    if (folder / "map.txt").exists():
        rows = [row.split() for row in (folder / "map.txt").read_text().splitlines() if row.strip()]
        return [lettered(folder, file, system, truth[file.split("_")[0]]) for file, system in rows]
    return [listed(folder, name, entry) for name, entry in truth.items()]


def lettered(folder: Path, file: str, system: str, letters: list[str]) -> Text:
    firsts = [letters.index("F")] if "F" in letters else []
    return Text(
        file.split("_")[0],
        folder / file,
        located(folder, system),
        tuple(Relation(LETTERS[letter]) for letter in letters),
        frozenset(firsts),
    )


def listed(folder: Path, name: str, entry: dict) -> Text:
    first = entry["first_wrong"]
    firsts = [] if first is None else [first, *entry["first_wrong_also"]]
    return Text(
        name,
        folder / entry["text"],
        located(folder, entry["system"]),
        tuple(
            Relation(NAMES.get(r["truth"], r["truth"]), r["line"], r["latex"])
            for r in entry["relations"]
        ),
        frozenset(firsts),
    )


def located(folder: Path, system: str) -> str:
    return str(folder / system) if ".py" in system else system


def answer(text: Text, options: argparse.Namespace, *, without_words: bool) -> list[dict] | str:
    """The lines of a review, or why there are none."""
    kept = options.keep / f"{text.name}{'-bare' if without_words else ''}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    path = bare(text, options) if without_words else text.path
    found = reviewed(path, text.system, options.seconds)
    kept.parent.mkdir(parents=True, exist_ok=True)
    kept.write_text(json.dumps(found, indent=1, ensure_ascii=False))
    return found


def reviewed(path: Path, system: str, seconds: float) -> list[dict] | str:
    command = [sys.executable, "-m", "polhode", "review", str(path), "--system", system, "--json"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return f"more than {seconds:g} s"
    if done.returncode not in (0, 1):
        return done.stderr.strip() or f"exit code {done.returncode}"
    return json.loads(done.stdout)["lines"]


def bare(text: Text, options: argparse.Namespace) -> Path:
    """The relations of a text alone, each a display, behind its macros."""
    lines = answer(text, options, without_words=False)
    shown = [] if isinstance(lines, str) else [line["latex"].replace("&", "") for line in lines]
    macros = re.findall(r"(?m)^\\newcommand.*$", text.path.read_text())
    path = options.keep / f"{text.name}-bare.tex"
    path.write_text("\n".join([*macros, *(f"\n\\[{latex}\\]" for latex in shown)]))
    return path


def count(text: Text, lines: list[dict] | str, tally: Tally, shown: tuple[str, ...]) -> None:
    if isinstance(lines, str):
        tally.failed.append(f"{text.name}: {lines}")
        places: list[int | None] = [None] * len(text.relations)
        lines = []
    elif text.relations[0].latex:
        places = aligned(text.relations, lines)
    elif len(lines) == len(text.relations):
        places = list(range(len(lines)))
    else:
        tally.failed.append(f"{text.name}: {len(lines)} lines, {len(text.relations)} in its truth")
        return
    marks = ["unlisted" if at is None else lines[at]["mark"] for at in places]
    for i, (relation, mark) in enumerate(zip(text.relations, marks, strict=True)):
        tally.counts[relation.truth, mark] += 1
        if mark in shown:
            line = {} if places[i] is None else lines[places[i]]
            print(f"{text.name} line {line.get('line')}: {relation.truth}, {mark}:", end=" ")
            print(f"{line.get('latex')} | {line.get('reason')} | {line.get('correction')}")
    if text.first_wrong:
        found = {marks[i] for i in text.first_wrong}
        tally.firsts[next((m for m in ("error", "doubt") if m in found), "other")] += 1


def aligned(relations: tuple[Relation, ...], lines: list[dict]) -> list[int | None]:
    """For each relation its line, or none: the greatest likeness in all, in their order."""
    rows, columns = len(relations), len(lines)
    best = [[0.0] * (columns + 1) for _ in range(rows + 1)]
    alike = [[likeness(relation, line) for line in lines] for relation in relations]
    for i in reversed(range(rows)):
        for j in reversed(range(columns)):
            best[i][j] = max(best[i + 1][j], best[i][j + 1], alike[i][j] + best[i + 1][j + 1])
    places: list[int | None] = [None] * rows
    i = j = 0
    while i < rows and j < columns:
        if alike[i][j] and best[i][j] == alike[i][j] + best[i + 1][j + 1]:
            places[i] = j
            i, j = i + 1, j + 1
        elif best[i][j] == best[i + 1][j]:
            i += 1
        else:
            j += 1
    return places


def likeness(relation: Relation, line: dict) -> float:
    """From 0 to 1.2: letters in common, and a little for the same line of the file."""
    if abs(relation.line - line["line"]) > 12:
        return 0.0
    ours, theirs = letters_of(relation.latex), letters_of(line["latex"])
    ratio = difflib.SequenceMatcher(None, ours, theirs, autojunk=False).ratio()
    if min(len(ours), len(theirs)) > 3 and (ours in theirs or theirs in ours):
        ratio = max(ratio, 0.85)
    return 0.0 if ratio < 0.75 else ratio + 0.2 * (relation.line == line["line"])


def letters_of(latex: str) -> str:
    words = r"left|right|[Bb]igg?[lr]?|displaystyle|text|mathrm|rm|quad|qquad"
    latex = re.sub(rf"\\(?:{words})(?![A-Za-z])|\\[,;:! ]", "", latex)
    latex = latex.replace(r"\dfrac", r"\frac").replace(r"\varphi", r"\phi")
    return re.sub(r"[\s{}&]+", "", latex).rstrip(".,;:")


def print_table(tally: Tally) -> None:
    for failure in tally.failed:
        print(f"no answer: {failure}")
    print(f"{'':<12}" + "".join(f"{mark:>12}" for mark in MARKS) + f"{'all':>8}")
    for truth in TRUTHS:
        cells = "".join(f"{tally.counts[truth, mark]:>12}" for mark in MARKS)
        print(f"{truth:<12}{cells}{tally.of((truth,)):>8}")
    claims = ("right", "wrong", "carried")
    false = ("wrong", "carried")
    firsts = sum(tally.firsts.values())
    rows = [
        ("errors on a wrong line", tally.of(false, "error"), tally.of(TRUTHS, "error"), "≥ 90"),
        ("errors on a slip", tally.of(("wrong",), "error"), tally.of(TRUTHS, "error"), "≥ 80"),
        ("right accused", tally.of(("right",), "error", "follows"), tally.of(("right",)), "≤ 1"),
        ("first errors named", tally.firsts["error"], firsts, "≥ 25"),
        ("… or doubted", tally.firsts["error"] + tally.firsts["doubt"], firsts, "≥ 65"),
        ("wrong called true", tally.of(false, "true"), tally.of(false), "≤ 2"),
        ("right called true", tally.of(("right",), "true"), tally.of(("right",)), "≥ 50"),
        ("right doubted", tally.of(("right",), "doubt"), tally.of(("right",)), "≤ 5"),
        ("not judged", tally.of(claims, "not-judged", "unlisted"), tally.of(claims), "≤ 30"),
    ]
    for words, part, whole, aim in rows:
        share = f"{100 * part / whole:.1f} %" if whole else "–"
        print(f"{words:<24}{part:>5} of {whole:<5}{share:>8}   (aim {aim} %)")


if __name__ == "__main__":
    main()
