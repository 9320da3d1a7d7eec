"""What an installed wheel must do; `make wheel` runs it in environments with nothing else.

Its argument names the extras that are installed: "base" stands for none.
"""

import sys
import tempfile
from collections.abc import Callable
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

import polhode as ph
from polhode import base
from polhode.catalogue import CATALOGUE
from polhode.cli import main as polhode

BY_EXTRA = {"fast": "heyoka", "figures": "matplotlib", "study": "scipy"}
DISK = {"m": "0.2 kg", "a": "30 mm", "g": 9.81}
START = {"theta": "80 deg", "omega_3": 40}


def main(extras: set[str]) -> None:
    installed = Path(ph.__file__).resolve()
    assert installed.is_relative_to(Path(sys.prefix).resolve()), f"not the wheel: {installed}"
    assert files("polhode").joinpath("py.typed").is_file()
    assert ph.__version__ == base.provenance()["versions"]["polhode"]
    for extra, library in BY_EXTRA.items():
        assert bool(find_spec(library)) == (extra in extras), f"{library} with {extras or 'base'}"
    refuses_a_wrong_dimension()
    run = derives_and_simulates()
    draws(run, possible="figures" in extras)
    varies_many()
    fits(run, possible="study" in extras)
    works_on_the_command_line()
    with_extras = ", ".join(sorted(extras)) or "no extras"
    print(f"polhode {ph.__version__} works from its wheel, with {with_extras}")


def derives_and_simulates() -> ph.Trajectory:
    equations = ph.derive(CATALOGUE["rolling-disk"].build())
    assert len(equations.motion) == 3
    run = ph.simulate(equations, DISK, START, "1 s")
    assert run.integrator == "kernel", run.integrator
    assert run.drift.energy < 1e-11, run.drift
    assert run["F_z"].min() > 0
    return run


def draws(run: ph.Trajectory, *, possible: bool) -> None:
    with tempfile.TemporaryDirectory() as folder:
        ph.page(run, Path(folder, "disk.html"))
    needs("polhode[figures]", lambda: ph.plot(run, "theta"), possible=possible)


def varies_many() -> None:
    starts = START | {"omega_3": [39.0, 40.0]}
    found = ph.ensemble(CATALOGUE["rolling-disk"].build(), DISK, starts, "1 s", outputs=["theta"])
    assert len(found["theta"]) == 2


def fits(run: ph.Trajectory, *, possible: bool) -> None:
    """The radius, from the motion at two instants."""
    times, guess = [0.5, 1.0], DISK | {"a": "31 mm"}

    def fit() -> None:
        measured = {"theta": run.evaluate("theta", times)}
        found = ph.fit(run.system, guess, START, times, measured, vary=["a"])
        assert abs(found.values["a"] - 0.03) < 1e-6

    needs("polhode[study]", fit, possible=possible)


def works_on_the_command_line() -> None:
    for command in (
        ("list",),
        ("invariants", "tennis-racquet"),
        ("exact", "tennis-racquet"),
        ("check", "rolling-disk", "E = T + V"),
        ("run", "rolling-disk", "--mu", "0.1", "--events"),
    ):
        assert polhode(command) == 0, command


def needs(extra: str, action: Callable[[], object], *, possible: bool) -> None:
    """Do what needs an extra, or be told which."""
    message = ""
    try:
        action()
    except ph.StoreError as error:
        message = str(error)
    assert bool(message) != possible, message or f"done without {extra}"
    assert possible or extra in message, message


def refuses_a_wrong_dimension() -> None:
    message = ""
    try:
        base.to_si("3 kg", base.LENGTH, "radius")
    except ph.UnitError as error:
        message = str(error)
    assert message.startswith("radius = '3 kg' is a quantity in kg; expected a quantity in m")


main({*sys.argv[1].split(",")} - {"base"})
