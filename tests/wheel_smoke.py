"""What an installed wheel must do; `make wheel` runs it in an environment with nothing else."""

import sys
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

import polhode as ph
from polhode import base


def main() -> None:
    installed = Path(ph.__file__).resolve()
    assert installed.is_relative_to(Path(sys.prefix).resolve()), f"not the wheel: {installed}"
    assert files("polhode").joinpath("py.typed").is_file()
    assert ph.__version__ == base.provenance()["versions"]["polhode"]
    refuses_a_wrong_dimension()
    derives_and_simulates()
    heyoka = "with" if find_spec("heyoka") else "without"
    print(f"polhode {ph.__version__} works from its wheel, {heyoka} heyoka")


def derives_and_simulates() -> None:
    from polhode.catalogue import CATALOGUE

    equations = ph.derive(CATALOGUE["rolling-disk"].build())
    assert len(equations.motion) == 3
    numbers = {"m": "0.2 kg", "a": "30 mm", "g": 9.81}
    run = ph.simulate(equations, numbers, {"theta": "80 deg", "omega_3": 40}, "1 s")
    assert run.integrator == "kernel", run.integrator
    assert run.drift.energy < 1e-11, run.drift
    assert run["F_z"].min() > 0


def refuses_a_wrong_dimension() -> None:
    message = ""
    try:
        base.to_si("3 kg", base.LENGTH, "radius")
    except ph.UnitError as error:
        message = str(error)
    assert message.startswith("radius = '3 kg' is a quantity in kg; expected a quantity in m")


main()
