"""Solutions of systems whose equations are kept in named parts: the bicycle."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

import polhode as ph
from polhode.solution import Example, _named_parts

FILE = Path(__file__).parents[2] / "docs/examples/solutions/bicycle.py"


@pytest.fixture(scope="module")
def names():
    return runpy.run_path(str(FILE))


@pytest.fixture(scope="module")
def equations(names):
    return ph.derive(names["bicycle"])


@pytest.fixture(scope="module")
def solved(names, equations):
    example = Example(equations, names["numbers"], names["start"], names["duration"])
    return ph.solution(equations, example=example)


def matrix(solved, name):
    (text,) = (s.latex for s in solved.steps if s.latex.startswith(rf"\mathbf {name} = "))
    return np.array(re.findall(r"-?\d+(?:\.\d+)?", text.split("pmatrix")[1]), float)


def test_the_matrices_are_those_of_the_published_benchmark(solved):
    # Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007), table 2 onwards
    published = {
        "M": (80.81722, 2.31941332208709, 2.31941332208709, 0.29784188199686),
        "C_1": (0, 33.86641391492494, -0.85035641456978, 1.68540397397560),
        "K_0": (-80.95, -2.59951685249872, -2.59951685249872, -0.80329488458618),
        "K_2": (0, 76.59734589573222, 0, 2.65431523794604),
    }
    for name, values in published.items():
        assert matrix(solved, name) == pytest.approx(values, rel=2e-5), name


def test_weave_and_capsize_are_found(solved):
    lines = [s.latex for s in solved.steps if re.match(r"v = \d\.\d{4}", s.latex)]
    assert [float(re.search(r"\d\.\d+", line)[0]) for line in lines] == [4.2924, 6.0243]


def test_every_formula_was_judged_and_no_part_is_without_a_name(solved):
    assert all(s.verdict.answer.value == "holds" for s in solved.steps if s.latex)
    assert not any(re.search(r"[zZ]_\{?\d", s.latex + s.words) for s in solved.steps)
    assert "The equations of motion in named parts" in solved.sections


def test_a_system_too_large_for_a_document_is_refused(equations, monkeypatch):
    monkeypatch.setattr(_named_parts, "_BODIES", 3)
    with pytest.raises(ph.NumericError, match="with 4 bodies and 3 independent speeds"):
        ph.solution(equations)


def test_other_routes_are_refused(equations):
    with pytest.raises(ph.ConstraintError, match="the route lagrange"):
        ph.solution(equations, "lagrange")
