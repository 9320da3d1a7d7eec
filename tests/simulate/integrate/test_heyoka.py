"""Compiled once: for a process, and for those that share the folder of what was compiled."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

import polhode as ph
from polhode import base

heyoka = pytest.importorskip("heyoka")

_PROGRAM = """
import polhode as ph
(alpha,) = ph.coordinates("alpha")
m, a, g = ph.symbols("m a g", positive=True)
rod = ph.rod("rod", mass=m, length=a, axes=ph.Frame("lab").rotated(alpha, "x"), axis="z")
system = ph.System(ph.Pivot(rod, at=rod.axes["z"] * (a / 2)), ph.Gravity(g))
run = ph.simulate(system, {"m": 1, "a": 1, "g": 9.81}, {"alpha": 1.0}, 2.0, samples=3)
print(run.final["alpha"].hex())
"""


def started(cache) -> subprocess.Popen[str]:
    settings = {**os.environ, "POLHODE_CACHE": str(cache), "POLHODE_INTEGRATOR": "heyoka"}
    command = [sys.executable, "-c", _PROGRAM]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, env=settings, stdout=pipe, stderr=pipe, text=True)


def ended(process: subprocess.Popen[str]) -> str:
    out, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    return out


def test_two_processes_share_it_and_a_damaged_one_is_made_anew(tmp_path):
    first, second = started(tmp_path), started(tmp_path)
    found = ended(first)
    assert found == ended(second)
    kept = [file for file in (tmp_path / "heyoka").iterdir() if file.name.startswith("cache.db")]
    assert kept
    for file in kept:
        file.write_bytes(b"no data base" * 100)
    assert ended(started(tmp_path)) == found


def test_what_is_kept_on_disk_is_bounded():
    from polhode.simulate.integrate._heyoka import library

    assert library().llvm_state.get_diskcache_limit() == base.cache.LIMIT


def rolling() -> ph.System:
    theta, phi = ph.coordinates("theta phi")
    m, a, g = ph.symbols("m a g", positive=True)
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    wheel = ph.disk("wheel", mass=m, radius=a, axes=axes)
    return ph.System(ph.Rolling(wheel, on=ph.Plane(axes.root)), ph.Gravity(g))


@pytest.mark.parametrize("subject", [lambda system: system, ph.automaton, ph.derive])
def test_a_second_run_compiles_nothing(subject, monkeypatch):
    from polhode.simulate import _dynamics
    from polhode.simulate.integrate import _heyoka

    monkeypatch.setenv("POLHODE_INTEGRATOR", "heyoka")
    values = {"m": 1, "a": 0.1, "g": 9.81}
    moved = subject(rolling())
    first = ph.simulate(moved, values, {"theta": 1.3, "omega_3": 15.0}, 0.5, samples=3)
    ended = first.final["theta"]
    compiled = _heyoka._compiled.cache_info().misses

    def compile_program(*given):
        raise AssertionError("compiled again")

    monkeypatch.setattr(_dynamics, "compile_program", compile_program)
    second = ph.simulate(moved, values, {"theta": 1.2, "omega_3": 15.0}, 0.5, samples=3)
    assert _heyoka._compiled.cache_info().misses == compiled
    assert second.final["theta"] != ended


def test_it_is_compiled_without_the_disk_where_the_cache_fails(monkeypatch):
    from polhode.simulate.integrate import _heyoka

    library, switched = _heyoka.library(), []

    def adaptive(*given, **settings):
        if not switched:
            raise RuntimeError("disk I/O error")
        return library.taylor_adaptive(*given, **settings)

    disk = SimpleNamespace(set_diskcache_enabled=switched.append)
    failing = SimpleNamespace(**vars(library) | {"taylor_adaptive": adaptive, "llvm_state": disk})
    monkeypatch.setattr(_heyoka, "library", lambda: failing)
    _heyoka._compiled.cache_clear()
    monkeypatch.setenv("POLHODE_INTEGRATOR", "heyoka")
    found = ph.simulate(
        rolling(), {"m": 1, "a": 0.1, "g": 9.81}, {"theta": 1.3, "omega_3": 15.0}, 0.1, samples=3
    )
    assert switched == [False]
    assert found.final["theta"] != 1.3
