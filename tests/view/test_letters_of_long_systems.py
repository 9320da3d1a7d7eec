"""Letters for long parts of equations are defined where they are shown, each with one meaning."""

import re

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import compile_program, has_parts, under_defined_letters
from polhode.derive import derive_in_parts, symbols_of
from polhode.view._notebook import html_of
from polhode.view._scene_text import equations_shown

LETTER = re.compile("z[₀-₉]+")
TYPESET = r"<msub><mi>z</mi>(?:<mrow>)?<mn>(\d+)</mn>(?:</mrow>)?</msub>"
NUMBERS = {"m": 1.0, "b1": 0.2, "b2": 0.03, "b3": 0.02, "h": 0.01, "g": 9.81}
NUMBERS |= {"Ixx": 2e-4, "Iyy": 1.6e-3, "Izz": 1.7e-3, "Ixy": -2e-4}


def celt():
    m, b1, b2, b3, h, g = ph.symbols("m b1 b2 b3 h g", positive=True)
    Ixx, Iyy, Izz, Ixy = ph.symbols("Ixx Iyy Izz Ixy")
    phi, theta, psi = ph.coordinates("phi theta psi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "y", labels="1 2 3")
    inertia = ((Ixx, Ixy, 0), (Ixy, Iyy, 0), (0, 0, Izz))
    surface = ph.Ellipsoidal((b1, b2, b3), (0, 0, h))
    body = ph.Body(
        "celt", mass=m, inertia=inertia, axes=axes, spin=ph.Components(), surface=surface
    )
    return ph.System(ph.Rolling(body, on=ph.Plane(lab), name="table"), ph.Gravity(g), name="celt")


@pytest.fixture(scope="module")
def run():
    start = {"theta": 0.01, "psi": 0.01, "omega_3": -5.0}
    return ph.simulate(celt(), NUMBERS, start, "0.1 s")


def letters(text):
    return set(LETTER.findall(text))


def test_the_page_defines_every_letter_once(run):
    shown = equations_shown(run)
    spoken = [formula.spoken for formula in (*shown.motion, *shown.reactions)]
    used = set().union(*map(letters, spoken))
    defined = [text.partition(" = ")[0] for text in spoken if LETTER.match(text)]
    assert len(used) > 5
    assert sorted(defined) == sorted(used)


def test_the_notebook_defines_every_letter():
    html = html_of(derive_in_parts(celt()))
    assert "<summary>where</summary>" in html
    used = set(re.findall(TYPESET, html))
    _, _, after = html.partition("<summary>where</summary>")
    rows = re.findall(r'<div class="row">(.*?)</div>', after)
    defined = [re.search(TYPESET, row)[1] for row in rows]
    assert sorted(defined) == sorted(used)


def test_what_stands_for_a_letter_is_the_expression(run):
    """The rows with their letters put back in, by numbers, against the rows themselves."""
    equations = run.segments[0].dynamics.equations
    rows = [row for row in equations.motion if has_parts(row)]
    assert rows
    written, defined = under_defined_letters(rows, symbols_of(equations))
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
