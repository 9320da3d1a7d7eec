"""Every worked solution compiled by LaTeX: no error, no letter missing, no line too long."""

import re
import runpy
import shutil
import subprocess
from contextlib import suppress
from pathlib import Path

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import ROUTES, answered_solution

ROOT = Path(__file__).parents[2]
DECLARED = sorted((ROOT / "docs/examples/solutions").glob("*.py"))
WIDEST = 3.0  # points by which a line may be too long, which nobody sees

pytestmark = pytest.mark.skipif(
    shutil.which("pdflatex") is None, reason="LaTeX is not installed here"
)


def compiled(solution, folder):
    """The log of LaTeX."""
    ph.write_solution(solution, folder / "it.tex")
    options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    done = subprocess.run(
        ["pdflatex", *options, "it.tex"], cwd=folder, capture_output=True, timeout=120, check=False
    )
    log = (folder / "it.log").read_text("latin-1")
    assert done.returncode == 0, log[-2000:]
    return log


def assert_well_set(log):
    assert "Missing character" not in log
    assert "undefined" not in log
    wide = [float(w) for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", log)]
    assert not [w for w in wide if w > WIDEST], wide


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_the_catalogue_with_its_motions(name, tmp_path):
    assert_well_set(compiled(answered_solution(name), tmp_path))


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("name", PROBLEM_SET)
def test_every_route_of_the_catalogue(name, route, tmp_path):
    found = None
    with suppress(ph.PolhodeError):  # a sentence is the right answer of a missing route
        found = ph.solution(PROBLEM_SET[name].build(), route)
    if found is not None:
        assert_well_set(compiled(found, tmp_path))


@pytest.mark.parametrize("file", DECLARED, ids=lambda file: file.stem)
def test_systems_of_the_documents(file, tmp_path):
    system = runpy.run_path(str(file))[file.stem]
    assert_well_set(compiled(ph.solution(system), tmp_path))
