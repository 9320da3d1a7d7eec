"""Measure polhode against its peers in one run: print the ratios, write results.json.

Each side of a comparison is a script that prints one JSON document; the time of its whole process
is added to it as `wall`. Every repetition runs all the commands in turn, each in a fresh process,
after one round that is not counted. Figures are medians.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

HERE = Path(__file__).parent
SAME = 1e-9  # if the answers of the two sides differ by more, they did not do the same thing

# As a user has it: compiled modules are kept. Those of the peers were compiled when installed.
ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}

Command = tuple[str, ...]
Samples = Mapping[Command, list[dict[str, Any]]]


@dataclass(frozen=True)
class Figure:
    """A number in the document that a command prints."""

    command: Command
    key: str


@dataclass(frozen=True)
class Aim:
    text: str
    met: Callable[[float, float], bool]


@dataclass(frozen=True)
class Comparison:
    name: str
    ours: Figure
    peer: Figure
    aim: Aim


def times_less(factor: float) -> Aim:
    return Aim(f"{factor:g}×", lambda ours, peer: peer >= factor * ours)


def ours_at_most(most: float) -> Aim:
    return Aim(f"≤ {most:g}", lambda ours, _: ours <= most)


FOR_SCALE = Aim("for scale", lambda ours, peer: True)


OUR_DISK = ("ours/derive_disk.py",)
OUR_GYROSCOPE = ("ours/derive_gyroscope.py",)
OUR_COLD_RUN = ("ours/run_disk.py", "--cold")
OUR_WARM_RUN = ("ours/run_disk.py", "--warm")
OUR_DISKS = ("ours/ensemble_disk.py",)
BARE_DISKS = ("ours/ensemble_disk.py", "--bare")
OUR_ROUGH = ("ours/ensemble_rough.py",)
ALONE_ROUGH = ("ours/ensemble_rough.py", "--alone", "--members", "64")
SCIPY_DISKS = ("peers/scipy_disks.py",)
DIFFRAX_DISKS = ("peers/diffrax_disks.py",)
KANE_DISK = ("peers/kane_disk.py",)
KANE_GYROSCOPE = ("peers/kane_gyroscope.py",)
OUR_CONTACT = ("ours/contact.py", "--task")
SCIPY_CONTACT = ("peers/contact_scipy.py", "--task")
OUR_BICYCLE = ("ours/bicycle.py",)
SYMPY_BICYCLE = ("peers/sympy_bicycle.py",)
PYDY = ("peers/pydy_disk.py",)
PYDY_CYTHON = ("peers/pydy_disk.py", "--generator", "cython")
PYDY_ODEINT = ("peers/pydy_disk.py", "--integrator", "odeint")


def derivation(name: str, ours: Command, peer: Command, aim: Aim, effort: str = "") -> Comparison:
    return Comparison(name, Figure(ours, "seconds"), Figure(peer, "seconds" + effort), aim)


def process(name: str, ours: Command, peer: Command, aim: Aim) -> Comparison:
    return Comparison(name, Figure(ours, "wall"), Figure(peer, "wall"), aim)


def contact(name: str, task: str) -> Comparison:
    """Both at rounding; errors at other costs: contact.py."""
    ours, peer = (Figure((*side, task), "seconds") for side in (OUR_CONTACT, SCIPY_CONTACT))
    return Comparison(f"{name} / SciPy events", ours, peer, times_less(100))


def arm(links: int, peer: str) -> Comparison:
    """Accelerations of one state: ours compiled, over an array; the peer called from Python."""
    ours, theirs = ("ours/arm_evaluation.py", str(links)), (f"peers/arm_{peer}.py", str(links))
    return derivation(f"accelerations of a {links}R arm / {peer}", ours, theirs, FOR_SCALE)


COMPARISONS = (
    derivation("derive disk / Kane", OUR_DISK, KANE_DISK, times_less(20)),
    derivation("derive disk / Kane, raw", OUR_DISK, KANE_DISK, times_less(1), "_raw"),
    derivation("derive gyroscope / Kane", OUR_GYROSCOPE, KANE_GYROSCOPE, times_less(20)),
    derivation(
        "derive gyroscope / Kane, raw", OUR_GYROSCOPE, KANE_GYROSCOPE, times_less(1), "_raw"
    ),
    Comparison(
        "operations, disk / Kane",
        Figure(OUR_DISK, "operations"),
        Figure(KANE_DISK, "operations"),
        ours_at_most(52),
    ),
    derivation("bicycle to eigenvalues / SymPy", OUR_BICYCLE, SYMPY_BICYCLE, ours_at_most(2)),
    *(arm(links, peer) for links in (3, 5, 7) for peer in ("pinocchio", "mujoco")),
    derivation("each of 2048 disks / bare heyoka", OUR_DISKS, BARE_DISKS, times_less(0.9)),
    derivation("each of 2048 disks / SciPy", OUR_DISKS, SCIPY_DISKS, times_less(100)),
    derivation("each of 2048 disks / diffrax", OUR_DISKS, DIFFRAX_DISKS, times_less(20)),
    derivation("each of 512 slipping balls / alone", OUR_ROUGH, ALONE_ROUGH, times_less(2.5)),
    contact("ball on a sheet", "sheet"),
    contact("ball that slides", "slide"),
    contact("disk that slips", "disk"),
    process("10 s of disk, cold / PyDy", OUR_COLD_RUN, PYDY, times_less(4)),
    process("10 s of disk, warm / PyDy", OUR_WARM_RUN, PYDY, times_less(8)),
    process("10 s of disk, cold / PyDy cython", OUR_COLD_RUN, PYDY_CYTHON, times_less(4)),
    process("10 s of disk, warm / PyDy cython", OUR_WARM_RUN, PYDY_CYTHON, times_less(8)),
    process("10 s of disk, cold / PyDy odeint", OUR_COLD_RUN, PYDY_ODEINT, times_less(1)),
    process("10 s of disk, warm / PyDy odeint", OUR_WARM_RUN, PYDY_ODEINT, times_less(1)),
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--only", default="", help="those with this in their names; others stay")
    parser.add_argument("--output", type=Path, default=HERE / "results.json")
    choice = parser.parse_args()

    wanted = [comparison for comparison in COMPARISONS if choice.only in comparison.name]
    samples = measure(commands_present(wanted), choice.repetitions)
    rows = [row(comparison, samples) for comparison in wanted]
    print(table(rows))
    known = json.loads(choice.output.read_text()) if choice.output.exists() and choice.only else {}
    by_name = {r["name"]: r for r in (*known.get("comparisons", ()), *rows)}
    ordered = [by_name[c.name] for c in COMPARISONS if c.name in by_name]
    every = known.get("samples", {}) | named(samples)
    document = {"schema": 1, "machine": machine(), "comparisons": ordered, "samples": every}
    choice.output.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n")
    return int(any(r["difference"] is not None and r["difference"] > SAME for r in rows))


def commands_present(comparisons: Iterable[Comparison]) -> list[Command]:
    sides = (side.command for c in comparisons for side in (c.ours, c.peer))
    return [command for command in dict.fromkeys(sides) if (HERE / command[0]).exists()]


def measure(commands: list[Command], repetitions: int) -> Samples:
    samples: dict[Command, list[dict[str, Any]]] = {command: [] for command in commands}
    for command in commands:
        run(command)
    for _ in range(repetitions):
        for command in commands:
            samples[command].append(run(command))
    return samples


def run(command: Command) -> dict[str, Any]:
    script, *options = command
    started = perf_counter()
    done = subprocess.run(
        [sys.executable, str(HERE / script), *options],
        capture_output=True,
        text=True,
        check=False,
        env=ENVIRONMENT,
    )
    wall = perf_counter() - started
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or ["no message"]
        sys.exit(f"{' '.join(command)} failed: {last[0]}; see benchmarks/README.md")
    return {**json.loads(done.stdout), "wall": wall}


def row(comparison: Comparison, samples: Samples) -> dict[str, Any]:
    ours, peer = (typical(side, samples) for side in (comparison.ours, comparison.peer))
    both = ours is not None and peer is not None
    return {
        "name": comparison.name,
        "ours": ours,
        "peer": peer,
        "ratio": peer / ours if both else None,
        "aim": comparison.aim.text,
        "met": comparison.aim.met(ours, peer) if both else None,
        "difference": difference(comparison, samples) if both else None,
    }


def typical(figure: Figure, samples: Samples) -> float | None:
    if figure.command not in samples:
        return None
    return median(document[figure.key] for document in samples[figure.command])


def difference(comparison: Comparison, samples: Samples) -> float:
    """How far apart the two sides' answers are, relative to the larger of one and the answer."""
    ours, peer = (samples[s.command][0]["answer"] for s in (comparison.ours, comparison.peer))
    return max(abs(ours[name] - value) / max(1, abs(value)) for name, value in peer.items())


def table(rows: list[dict[str, Any]]) -> str:
    head = ("comparison", "ours", "peer", "ratio", "aim", "met", "answers differ by")
    verdicts = {True: "yes", False: "no", None: "–"}
    cells = [
        (
            r["name"],
            shown(r["ours"]),
            shown(r["peer"]),
            shown(r["ratio"]),
            r["aim"],
            verdicts[r["met"]],
            shown(r["difference"]),
        )
        for r in rows
    ]
    widths = [max(map(len, column)) for column in zip(head, *cells, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in [head, *cells]
    )


def shown(value: float | None) -> str:
    return "absent" if value is None else f"{value:.3g}"


def named(samples: Samples) -> dict[str, list[dict[str, Any]]]:
    return {" ".join(command): documents for command, documents in samples.items()}


def machine() -> dict[str, Any]:
    return {
        "system": platform.system(),
        "processor": platform.machine(),
        "cores": os.cpu_count(),
        "load": os.getloadavg(),  # beside other work, only the ratios of one run count
        "python": platform.python_version(),
    }


if __name__ == "__main__":
    sys.exit(main())
