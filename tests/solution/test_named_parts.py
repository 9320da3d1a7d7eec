"""Solutions of systems whose equations are kept in named parts: the bicycle."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

import polhode as ph
from polhode.solution import Example, _linearised, _named_parts
from polhode.solution._linearised import linearised
from polhode.solution._setting import Setting

FILE = Path(__file__).parents[2] / "docs/examples/solutions/bicycle.py"


@pytest.fixture(scope="module")
def names():
    return runpy.run_path(str(FILE))


@pytest.fixture(scope="module")
def equations(names):
    return ph.derive(names["bicycle"])


@pytest.fixture(scope="module")
def departures(names, equations):
    example = Example(equations, names["numbers"], names["start"], names["duration"])
    return list(linearised(equations, example))


def matrix(departures, name):
    (text,) = (s.latex for s in departures if s.latex.startswith(rf"\mathbf {name} = "))
    return np.array(re.findall(r"-?\d+(?:\.\d+)?", text.split("pmatrix")[1]), float)


def test_the_matrices_are_those_of_the_published_benchmark(departures):
    # Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007), table 2 onwards
    published = {
        "M": (80.81722, 2.31941332208709, 2.31941332208709, 0.29784188199686),
        "C_1": (0, 33.86641391492494, -0.85035641456978, 1.68540397397560),
        "K_0": (-80.95, -2.59951685249872, -2.59951685249872, -0.80329488458618),
        "K_2": (0, 76.59734589573222, 0, 2.65431523794604),
    }
    for name, values in published.items():
        assert matrix(departures, name) == pytest.approx(values, rel=2e-5), name


def test_weave_and_capsize_are_found(departures):
    lines = [s.latex for s in departures if re.match(r"v = \d\.\d{4}", s.latex)]
    assert [float(re.search(r"\d\.\d+", line)[0]) for line in lines] == [4.2924, 6.0243]


def test_every_number_was_compared_with_a_second_computation(departures):
    assert all(s.verdict.answer.value == "holds" for s in departures if s.latex)


def test_a_wrong_digit_is_noticed():
    _linearised._require_digits(80.817, 80.8172, 80.0)
    with pytest.raises(ph.NumericError, match="a second computation does not confirm"):
        _linearised._require_digits(80.817, 80.822, 80.0)


def test_bodies_and_parts_are_defined_and_judged(equations):
    sections = _named_parts.in_named_parts(Setting(equations), None)
    lines = [line for part in sections.values() for line in part]
    assert not any(re.search(r"[zZ]_\{?\d", line.latex + line.words) for line in lines)
    (parts,) = (sections[k] for k in sections if "named parts" in k)
    assert sum(line.verdict.answer.value == "holds" for line in parts if line.latex) == 5


def test_a_system_too_large_for_a_document_is_refused(equations, monkeypatch):
    monkeypatch.setattr(_named_parts, "_BODIES", 3)
    with pytest.raises(ph.NumericError, match="with 4 bodies and 3 independent speeds"):
        ph.solution(equations)


def test_other_routes_are_refused(equations):
    with pytest.raises(ph.ConstraintError, match="the route lagrange"):
        ph.solution(equations, "lagrange")
