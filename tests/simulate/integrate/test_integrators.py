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
    ("named", "installed", "follows", "heyoka"),
    [
        ("", True, "kernel", True),
        ("", False, "kernel", False),
        ("kernel", True, "kernel", False),
        ("heyoka", True, "heyoka", True),
    ],
)
def test_which_is_used_for_what(named, installed, follows, heyoka, monkeypatch):
    """Heyoka follows single motions if asked for; many side by side wherever it is installed."""
    monkeypatch.setenv("POLHODE_INTEGRATOR", named)
    monkeypatch.setattr(_integrators, "find_spec", lambda _: installed or None)
    assert _integrators.chosen().name == follows
    assert _integrators.heyoka_is_used() == heyoka


@pytest.mark.parametrize(
    ("named", "message"),
    [
        ("scipy", "POLHODE_INTEGRATOR = 'scipy'; expected kernel or heyoka.*SciPy's is no longer"),
        ("euler", "POLHODE_INTEGRATOR = 'euler'; expected kernel or heyoka"),
        ("heyoka", r"'heyoka', which is not installed; .*pip install 'polhode\[fast\]'"),
    ],
)
def test_others_are_refused(named, message, monkeypatch):
    monkeypatch.setenv("POLHODE_INTEGRATOR", named)
    monkeypatch.setattr(_integrators, "find_spec", lambda _: None)
    for use in (_integrators.chosen, _integrators.heyoka_is_used):
        with pytest.raises(DeclarationError, match=message):
            use()
