"""`polhode solve`: the document of the contract, files, and refusals."""

import json

import pytest


def test_the_document(document):
    found = document("solve", "rolling-disk")
    assert set(found) >= {"steps", "questions", "figures", "seconds", "route"}
    keys = {"section", "words", "latex", "number", "context", "verdict"}
    assert all(keys <= set(step) for step in found["steps"])
    shown = [step for step in found["steps"] if step["latex"]]
    assert {step["verdict"] for step in shown} <= {"holds", "approximate"}
    assert r"\omega_3 > \sqrt{\frac{g}{3 a}}" in [step["latex"] for step in shown]
    assert found["figures"][0]["svg"].startswith("<svg")


def test_without_a_file_it_prints_markdown(polhode):
    code, out, err = polhode("solve", "marble-on-turntable", "--route", "newton")
    assert (code, err) == (0, "")
    assert out.startswith("# Marble on a turntable")
    assert "\\tag{1}" in out


def test_several_files_at_once(polhode, tmp_path):
    files = [tmp_path / f"held{ending}" for ending in (".html", ".tex", ".md", ".ipynb")]
    words = [word for file in files for word in ("-o", str(file))]
    code, out, _ = polhode("solve", "gyroscope/held", *words)
    assert code == 0
    assert all(file.is_file() for file in files)
    assert "all judged" in out
    json.loads(files[-1].read_text("utf-8"))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("rolling-disk", "--route", "lagrange"), "no constraint on velocities"),
        (("rolling-disk", "--route", "hamilton"), "newton"),
        (("gyroscope/held", "--route", "contact"), "at most one support"),
        (("rolling-disk", "-o", "disk.docx"), "ends in .html"),
        (("nothing",), "is no system"),
        (("gyroscope", "--at", "theta=pi/2"), "ask steady for motions"),
    ],
)
def test_bad_input_is_a_sentence(polhode, words, message):
    code, out, err = polhode("solve", *words)
    assert (code, out) == (2, "")
    assert message in err


def test_a_system_in_a_file(polhode, tmp_path):
    file = tmp_path / "swing.py"
    file.write_text(
        "import polhode as ph\n"
        "m, l, g = ph.symbols('m l g', positive=True)\n"
        "axes = ph.Frame('lab').rotated(ph.coordinate('theta'), 'y', name='axes')\n"
        "bob = ph.point_mass('bob', mass=m, axes=axes)\n"
        "swing = ph.System(ph.Pivot(bob, at=axes['z'] * l), ph.Gravity(g), name='swing')\n"
    )
    code, out, _ = polhode("solve", f"{file}:swing")
    assert code == 0
    assert r"l \ddot{\theta} + g \sin\theta = 0" in out


def test_a_file_has_numbers_and_questions(polhode, tmp_path):
    file = tmp_path / "swing.py"
    file.write_text(
        "import polhode as ph\n"
        "from polhode.solution import AtInstant, TextQuestion\n"
        "m, l, g = ph.symbols('m l g', positive=True)\n"
        "axes = ph.Frame('lab').rotated(ph.coordinate('theta'), 'y', name='axes')\n"
        "bob = ph.point_mass('bob', mass=m, axes=axes)\n"
        "swing = ph.System(ph.Pivot(bob, at=axes['z'] * l), ph.Gravity(g), name='swing')\n"
        "numbers = {m: 0.2, 'l': '1 m', 'g': 9.81}\n"
        "start, duration = {'theta': '30 deg'}, 2\n"
        "rest = AtInstant({'theta_dot': '0'}, ('theta_ddot',), 'At rest')\n"
        "questions = (TextQuestion('At the turn', 'what happens?', (rest,), part='(a)'),)\n"
    )
    code, out, _ = polhode("solve", f"{file}:swing", "--set", "l=4m")
    assert code == 0
    assert "## (a) At the turn" in out
    assert r"\sqrt{\frac{l}{g}} = 4.01\,\mathrm{s}" in out  # 2π √(4 / 9.81)
