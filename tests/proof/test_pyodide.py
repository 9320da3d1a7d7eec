"""polhode in a browser says what it says here: Pyodide under Node, from files of npm and PyPI.

The same script (`pyodide/asked.py`) derives all systems of the catalogue and analyses some, and the
kernel integrates by the WebAssembly of Node: texts and bits agree.
"""

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import polhode

HERE = Path(__file__).parent / "pyodide"
ASKED = HERE / "asked.py"
PLATFORM = ("--platform", "pyemscripten_2026_0_wasm32", "--python-version", "3.14")
PACKAGES = ("python-flint", "mpmath", "latex2mathml")


def answered(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout


@pytest.fixture(scope="module")
def there(tmp_path_factory):
    """The answers in Pyodide."""
    folder = tmp_path_factory.mktemp("pyodide")
    for file in HERE.iterdir():
        if file.is_file():
            shutil.copy(file, folder)
    answered(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=folder)
    wheels, site = folder / "wheels", folder / "site"
    download = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary=:all:"]
    answered([*download, *PLATFORM, "--dest", str(wheels), *PACKAGES])
    for wheel in wheels.iterdir():
        zipfile.ZipFile(wheel).extractall(site)
    ours = Path(polhode.__file__).parents[1]
    command = ["node", "run.mjs", "asked.py", str(site), str(ours)]
    return json.loads(answered(command, cwd=folder))


@pytest.fixture(scope="module")
def here():
    return json.loads(answered([sys.executable, str(ASKED)]))


def test_equations_and_analyses_are_the_same(there, here):
    assert len(here) > 20
    assert {n: text for n, text in there.items() if n != "kernel"} == {
        n: text for n, text in here.items() if n != "kernel"
    }


def test_the_kernel_has_the_same_bits(there, here):
    goal = 1
    assert here["kernel"][-3] == goal
    assert there["kernel"] == here["kernel"]
