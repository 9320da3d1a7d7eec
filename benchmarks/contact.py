"""Error against cost of motions that stick and slip: ours, SciPy, MuJoCo, fixed steps, in one run.

Prints a table and writes contact.json and contact.svg beside this file. Errors are against the
closed form of the sliding ball, and against a solution of the ball on the sheet in 22 digits. Of
the disk, ours is held to SciPy's finest and all others to ours. Cost is processor time of one
motion, the quickest of five in a process that has done it before; `first` is that of the first
one, with all that is derived and compiled, imports left out.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import contact_tasks as tasks
import numpy as np
from run import ENVIRONMENT, machine

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests"))

SIDES = {
    "polhode": "ours/contact.py",
    "SciPy DOP853": "peers/contact_scipy.py",
    "MuJoCo": "peers/contact_mujoco.py",
    "Moreau–Jean": "peers/contact_stepping.py",
}
LEAST = 1e-16  # an error of nothing is drawn here
TITLES = {
    "sheet": "ball on a sheet that jerks and turns",
    "slide": "ball that slides, then rolls",
    "disk": "disk that slips, then rolls",
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=HERE / "contact.json")
    choice = parser.parse_args()
    documents = {side: answered(script) for side, script in SIDES.items()}
    rows = [row for task in tasks.TASKS for row in rows_of(task, documents)]
    print("\n".join(table(rows)))
    document = {"schema": 1, "machine": machine(), "rows": rows}
    choice.output.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n")
    draw(rows, choice.output.with_suffix(".svg"))
    return 0


def answered(script: str) -> dict[str, list[dict[str, Any]]]:
    done = subprocess.run(
        [sys.executable, str(HERE / script)],
        capture_output=True,
        text=True,
        check=False,
        env=ENVIRONMENT,
    )
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or ["no message"]
        sys.exit(f"{script} failed: {last[0]}; see benchmarks/README.md")
    return dict(json.loads(done.stdout))


def rows_of(task: str, documents: dict[str, dict[str, list[dict[str, Any]]]]) -> list[Any]:
    ours, scipys = (documents[side][task][-1]["answer"] for side in ("polhode", "SciPy DOP853"))
    exact = {"slide": tasks.slide_answer, "sheet": sheet_answer}.get(task, lambda: ours)()
    rows = []
    for side, document in documents.items():
        for run in document[task]:
            right = scipys if exact is ours and side == "polhode" else exact
            error = max(abs(run["answer"][key] - value) for key, value in right.items())
            figures = {key: run[key] for key in ("setting", "seconds", "first")}
            rows.append({"task": task, "side": side, "error": error} | figures)
    return rows


def sheet_answer() -> dict[str, float]:
    """The velocity is the one it had; the place by another method, in 22 digits."""
    from flint import arb

    from oracles.ball_on_paper_digits import Ball, follow, pieces

    k, mu, g = (arb(value) for value in (tasks.BALL["k"], tasks.BALL["mu"], tasks.G))
    velocity = [arb(v) for v in tasks.SHEET_START]
    ends = np.array([tasks.SHEET_DURATION])
    course = follow(Ball(k, mu, mu, g), pieces(tasks.KNOTS, list(tasks.TABLES)), velocity, ends)
    values = (*map(float, course.places[-1]), *tasks.SHEET_START)
    return dict(zip(tasks.ANSWERS["sheet"], values, strict=True))


def table(rows: list[Any]) -> list[str]:
    head = ("task", "side", "tolerance or step", "error", "CPU s", "first", "SciPy's cost / ours")
    lines = [head]
    for row in rows:
        figures = (f"{row['error']:.1e}", f"{row['seconds']:.2g}", f"{row['first']:.2g}")
        lines.append((row["task"], row["side"], row["setting"], *figures, ratio(row, rows)))
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    ]


def ratio(row: Any, rows: list[Any]) -> str:
    """Told for SciPy: times of ours."""
    if row["side"] != "SciPy DOP853":
        return ""
    ours = next(r for r in rows if r["task"] == row["task"] and r["side"] == "polhode")
    return f"{row['seconds'] / ours['seconds']:.2g}"


def draw(rows: list[Any], file: Path) -> None:
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams["svg.hashsalt"] = "polhode"
    figure, panels = plt.subplots(1, len(tasks.TASKS), figsize=(12, 4.2), sharey=True)
    markers = dict(zip(SIDES, "*osv", strict=True))
    for panel, task in zip(panels, tasks.TASKS, strict=True):
        for side, marker in markers.items():
            own = [row for row in rows if (row["task"], row["side"]) == (task, side)]
            panel.loglog(
                [row["seconds"] for row in own],
                [max(row["error"], LEAST) for row in own],
                marker=marker,
                markersize=13 if side == "polhode" else 5,
                zorder=3 if side == "polhode" else 2,
                linewidth=1,
                label=side,
            )
        panel.set(title=TITLES[task], xlabel="processor time of one motion, s")
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("error of the last place and velocity, SI")
    panels[-1].legend(loc="lower right")  # away from all that is drawn
    figure.tight_layout()
    figure.savefig(file, metadata={"Date": None})


if __name__ == "__main__":
    sys.exit(main())
