"""Verdicts and marks compared with those that were committed: `make golden`.

    python benchmarks/golden.py            compares, and lists every line that differs
    python benchmarks/golden.py --write    accepts what is found, to be committed with the reasons

`golden/` has a file for each kind: the audit of the problem set, the paraphrased statements of
the tests, and, where the folders of texts of others lie beside this repository, their marks, by the
name of the text and the number of the line alone.
"""

from __future__ import annotations

import argparse
import difflib
import json
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[1]
GOLDEN = ROOT / "golden"
TEXTS = ROOT.parent / "shared" / "reviews"
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true", help="accept what is found")
    write = parser.parse_args().write
    changed = 0
    kinds = {"audit": audit, "paraphrases": paraphrases}
    if TEXTS.is_dir():
        kinds["reviews"] = reviews
    for name, find in kinds.items():
        path = GOLDEN / f"{name}.txt"
        found = list(find())
        known = path.read_text("utf-8").splitlines() if path.exists() else []
        differences = list(difflib.unified_diff(known, found, "committed", "found", n=0))
        state = "changed" if differences else "as committed"
        print(f"{name}: {len(found)} lines, {state}")
        print(*differences, sep="\n", end="\n" if differences else "")
        changed += bool(differences)
        if write:
            GOLDEN.mkdir(exist_ok=True)
            path.write_text("\n".join(found) + "\n", "utf-8")
    return 0 if write else min(changed, 1)


def audit() -> Iterator[str]:
    """The verdict on every claim of the problem set, and how its letters were read."""
    command = [sys.executable, "-m", "polhode", "audit", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    for claim in json.loads(done.stdout)["claims"]:
        read = "; ".join(f"{r['letter']} as {r['meaning']}" for r in claim["readings"])
        correction = (claim["correction"] or {}).get("latex", "")
        yield " | ".join([claim["id"], claim["verdict"], read, correction]).rstrip(" |")


def paraphrases() -> Iterator[str]:
    from judge.paraphrased import statements

    cases = [(number, way) for number, s in enumerate(statements()) for way in range(len(s.ways))]
    with ProcessPoolExecutor(2) as pool:
        for (number, way), marks in zip(
            cases, pool.map(_paraphrase, cases, chunksize=6), strict=True
        ):
            yield f"{number}.{way} {marks}"


def _paraphrase(case: tuple[int, int]) -> str:
    from judge.paraphrased import statements

    number, way = case
    return " ".join(line.mark.value for line in statements()[number].reviewed(way))


def reviews() -> Iterator[str]:
    from reviews import read, reviewed

    texts = [text for folder in sorted(TEXTS.iterdir()) if folder.is_dir() for text in read(folder)]
    with ThreadPoolExecutor(2) as pool:  # each review is a process of its own
        answers = pool.map(lambda text: reviewed(text.path, text.system, 600.0), texts)
        for text, lines in zip(texts, answers, strict=True):
            if isinstance(lines, str):
                yield f"{text.name}: {lines}"
            else:
                yield from (f"{text.name}:{l['line']}:{l['column']} {l['mark']}" for l in lines)


if __name__ == "__main__":
    sys.exit(main())
