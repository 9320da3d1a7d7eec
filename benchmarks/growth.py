"""How the cost of each step grows with the number of bodies: exponents, as a table.

Every system of a family is derived, printed, compiled and run for a second in a process of its
own. The exponent p of cost ~ n^p is the slope of a straight line through log cost by log n, over
the larger half of the sizes: constant costs would hide it over the smaller ones.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path
from statistics import median
from typing import Any

from run import ENVIRONMENT, HERE, machine

STEPS = ("derive", "print", "compile", "run")
SIZES = {
    "pendulums": (2, 4, 8, 12, 16, 24, 32),
    "arm": (2, 3, 4, 5, 6, 7),
    "trailers": (1, 2, 3, 4, 5, 6, 8),
    "rolling-chain": (1, 2, 4, 8, 12, 16),
}
#: A process that takes longer is ended, and its size and larger ones are left out.
LONGEST = 300.0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--largest", type=int, default=32, help="leave out systems beyond this")
    parser.add_argument("--only", action="append", choices=sorted(SIZES), help="one family")
    parser.add_argument("--output", type=Path, default=HERE / "growth.json")
    choice = parser.parse_args()

    families = {
        name: grown(name, [n for n in sizes if n <= choice.largest], choice.repetitions)
        for name, sizes in SIZES.items()
        if not choice.only or name in choice.only
    }
    print(table(families))
    document = {"schema": 1, "machine": machine(), "families": families}
    choice.output.write_text(json.dumps(document, indent=1) + "\n")
    return 0


def grown(family: str, sizes: list[int], repetitions: int) -> list[dict[str, Any]]:
    """The cost of every step at every size, or why the larger ones were left out."""
    rows: list[dict[str, Any]] = []
    for size in sizes:
        try:
            samples = [run(family, size) for _ in range(repetitions)]
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError) as error:
            rows.append({"size": size, "ended": reason(error)})
            break
        costs = {step: median(sample[step] for sample in samples) for step in STEPS}
        rows.append({"size": size, **costs, "drift": max(s["drift"] for s in samples)})
        print(f"{family} {size}: " + ", ".join(f"{s} {c:.3g} s" for s, c in costs.items()))
    return rows


def run(family: str, size: int) -> dict[str, float]:
    done = subprocess.run(
        [sys.executable, str(HERE / "ours/growth.py"), family, str(size)],
        capture_output=True,
        text=True,
        check=True,
        env=ENVIRONMENT,
        timeout=LONGEST,
    )
    document: dict[str, float] = json.loads(done.stdout)
    return document


def reason(error: subprocess.SubprocessError) -> str:
    if isinstance(error, subprocess.CalledProcessError):
        return str(error.stderr.strip().splitlines()[-1])
    return f"more than {LONGEST:g} s"


def table(families: dict[str, list[dict[str, Any]]]) -> str:
    lines = ["| family | n | " + " | ".join(STEPS) + " | print / derive |", "| --- " * 7 + "|"]
    for name, rows in families.items():
        done = [row for row in rows if "ended" not in row]
        if len(done) < 2:
            continue
        cells = [f"{exponent(done, step):.1f}" for step in STEPS]
        last = done[-1]
        ratio = f"{last['print'] / last['derive']:.2f}"
        sizes = f"{done[0]['size']} to {last['size']}"
        lines.append(f"| {name} | {sizes} | " + " | ".join([*cells, ratio]) + " |")
        lines += [f"(n = {r['size']}: {r['ended']})" for r in rows if "ended" in r]
    return "\n".join(lines)


def exponent(rows: list[dict[str, Any]], step: str) -> float:
    """The slope of log cost by log size over the larger half of the sizes."""
    larger = rows[(len(rows) - 1) // 2 :]
    points = [(math.log(row["size"]), math.log(max(row[step], 1e-6))) for row in larger]
    middle = [sum(values) / len(points) for values in zip(*points, strict=True)]
    above = sum((x - middle[0]) * (y - middle[1]) for x, y in points)
    return above / sum((x - middle[0]) ** 2 for x, _ in points)


if __name__ == "__main__":
    sys.exit(main())
