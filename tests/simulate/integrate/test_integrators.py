"""Which integrator is used: by what is installed, and by choice."""

import math
import subprocess
import sys

import pytest

from polhode.base import DeclarationError
from polhode.simulate.integrate import _integrators

# A block slides from rest down a rough slope.
_WITHOUT_HEYOKA = """
import sys
sys.modules["heyoka"] = None  # as if it were not installed
import polhode as ph
m, h, i, g = ph.symbols("m h i g", positive=True)
lab = ph.Frame("lab")
block = ph.Body("block", mass=m, inertia=(i, i, i), axes=lab, surface=ph.Face(h))
slope = ph.Plane(lab, tilt=ph.symbol("alpha"))
system = ph.System(ph.Coulomb(block, on=slope, mu=0.2), ph.Gravity(g))
numbers = {"m": 1, "h": 0.1, "i": 0.1, "g": 10, "alpha": "30 deg"}
run = ph.simulate(system, numbers, {}, 3.0)
moved = max(abs(run.final["x"]), abs(run.final["y"]))
print(run.integrator, moved)
"""


def test_without_heyoka_the_kernel_follows_friction():
    command = [sys.executable, "-c", _WITHOUT_HEYOKA]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    name, moved = run.stdout.split()
    assert name == "kernel"
    # with the acceleration g (sin α − μ cos α), for three seconds
    expected = 10 * (math.sin(math.pi / 6) - 0.2 * math.cos(math.pi / 6)) * 9 / 2
    assert float(moved) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    ("installed", "expected"),
    [
        ({"heyoka", "wasmtime", "scipy"}, "heyoka"),
        ({"wasmtime", "scipy"}, "kernel"),
        ({"scipy"}, "scipy"),
    ],
)
def test_the_default(installed, expected, monkeypatch):
    monkeypatch.delenv("POLHODE_INTEGRATOR", raising=False)
    monkeypatch.setattr(_integrators, "find_spec", lambda name: name in installed or None)
    assert _integrators.chosen().name == expected


@pytest.mark.parametrize("name", ["heyoka", "kernel", "scipy"])
def test_the_choice(name, monkeypatch):
    monkeypatch.setenv("POLHODE_INTEGRATOR", name)
    monkeypatch.setattr(_integrators, "find_spec", lambda _: True)
    assert _integrators.chosen().name == name
    monkeypatch.setattr(
        _integrators, "find_spec", lambda library: library not in (name, "wasmtime")
    )
    if name != "scipy":
        with pytest.raises(DeclarationError, match=f"POLHODE_INTEGRATOR = '{name}'"):
            _integrators.chosen()
