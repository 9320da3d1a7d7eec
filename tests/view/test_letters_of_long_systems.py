"""Letters for long parts of equations are defined where they are shown, each with one meaning."""

import re

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import compile_program, has_parts
from polhode.derive import derive_in_parts, symbols_of
from polhode.view import html_of
from polhode.view._scene_text import equations_shown
from solution.own_systems import rattleback

LETTER = re.compile("z[₀-₉]+")
NUMBERS = {"m": 1.0, "a": 0.2, "b": 0.03, "c": 0.02, "h": 0.01, "g": 9.81}
NUMBERS |= {"A": 2e-4, "B": 1.6e-3, "C": 1.7e-3, "D": -2e-4}


@pytest.fixture(scope="module")
def run():
    A, B, C, D = ph.symbols("A B C D", positive=True)
    celt = rattleback(((A, D, 0), (D, B, 0), (0, 0, C)))
    return ph.simulate(celt, NUMBERS, {"theta": 0.01, "psi": 0.01, "omega_3": -5.0}, "0.1 s")


def letters(text):
    return set(LETTER.findall(text))


def test_the_page_defines_every_letter_once(run):
    shown = equations_shown(run)
    spoken = [formula.spoken for formula in (*shown.motion, *shown.reactions)]
    used = set().union(*map(letters, spoken))
    defined = [text.partition(" = ")[0] for text in spoken if LETTER.match(text)]
    assert len(used) > 5
    assert sorted(defined) == sorted(used)


def test_the_notebook_defines_every_letter(run):
    html = html_of(derive_in_parts(run.system))
    assert "<summary>where</summary>" in html
    labels = re.findall(r'alttext="([^"]*)"|<msub><mi>z</mi><mn>(\d+)</mn></msub>', html)
    assert labels


def test_what_stands_for_a_letter_is_the_expression(run):
    """The rows with their letters put back in, by numbers, against the rows themselves."""
    equations = run.segments[0].dynamics.equations
    rows = [row for row in equations.motion if has_parts(row)]
    assert rows
    written, defined = ph.algebra.under_defined_letters(rows, symbols_of(equations))
    random = np.random.default_rng(5)
    plain = {s for row in (*written, *defined.values()) for s in row.symbols()} - set(defined)
    values = {s: random.uniform(0.2, 1.0) for s in plain}

    def evaluated(expression):
        symbols = tuple(expression.symbols())
        for symbol in symbols:
            if symbol not in values:
                values[symbol] = evaluated(defined[symbol])
        arguments = [values[symbol] for symbol in symbols]
        return float(compile_program([expression], symbols).function()(*arguments)[0])

    for row, short in zip(rows, written, strict=True):
        symbols = tuple(row.symbols())
        whole = compile_program([row], symbols).function()(*(values[s] for s in symbols))[0]
        assert evaluated(short) == pytest.approx(float(whole), rel=1e-10)
