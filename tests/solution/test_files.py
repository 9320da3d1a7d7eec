"""Worked solutions as files: pages, LaTeX, Markdown, notebooks, and the figure."""

import json
import math
import re
import shutil
import sys
from dataclasses import replace
from xml.etree import ElementTree

import nbformat
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from solution import own_systems


@pytest.fixture(scope="module")
def disk():
    return ph.solution(CATALOGUE["rolling-disk"].build())


def written(solution, path):
    ph.write_solution(solution, path)
    return path.read_text("utf-8")


def test_the_page_has_every_equation_typeset(disk, tmp_path):
    page = written(disk, tmp_path / "disk.html")
    assert page.count('class="equation"') == disk.judged
    assert all(f'id="eq{n}"' in page for n in range(1, disk.judged + 1))
    body = page.partition("<body")[2]
    assert "$" not in body
    assert "\\" not in re.sub(r"<style>.*?</style>", "", body, flags=re.DOTALL)
    assert "http" not in re.sub(r'xmlns="[^"]*"', "", body)  # no external resources


def test_references_are_links_to_equations(disk, tmp_path):
    page = written(disk, tmp_path / "disk.html")
    targets = set(re.findall(r'class="reference" href="#(eq\d+)"', page))
    assert targets
    assert all(f'id="{target}"' in page for target in targets)


def test_a_title_is_escaped(disk, tmp_path):
    page = written(replace(disk, title="<b>disk</b> & co_1"), tmp_path / "disk.html")
    assert "<h1>&lt;b&gt;disk&lt;/b&gt; &amp; co_1</h1>" in page


def test_latex_is_balanced(disk, tmp_path):
    source = written(replace(disk, title="co_1 & 50%"), tmp_path / "disk.tex")
    assert r"\title{co\_1 \& 50\%}" in source
    for kind in ("equation", "multline", "document"):
        assert source.count(rf"\begin{{{kind}}}") == source.count(rf"\end{{{kind}}}")
    shown = source.count(r"\begin{equation}") + source.count(r"\begin{multline}")
    assert shown == disk.judged
    for line in re.findall(r"\\begin\{(?:equation|multline)\}\n(.*?)\n\\end", source, re.DOTALL):
        for row in line.split("\\\\\n"):  # \left and \right must not be parted by a line break
            assert row.count(r"\left") == row.count(r"\right"), row


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="LaTeX is not installed")
def test_a_pdf_where_latex_is_installed(disk, tmp_path):
    ph.write_solution(disk, tmp_path / "disk.pdf")
    assert (tmp_path / "disk.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.skipif(shutil.which("pdflatex") is not None, reason="LaTeX is installed")
def test_without_latex_a_pdf_is_refused(disk, tmp_path):
    with pytest.raises(ph.StoreError, match="pdflatex"):
        ph.write_solution(disk, tmp_path / "disk.pdf")


def test_the_notebook_is_valid(disk, tmp_path):
    notebook = nbformat.reads(written(disk, tmp_path / "disk.ipynb"), as_version=4)
    nbformat.validate(notebook)
    assert len(notebook.cells) == len(disk.sections) + 1


def test_markdown_tags_every_equation(disk, tmp_path):
    text = written(disk, tmp_path / "disk.md")
    assert [int(n) for n in re.findall(r"\\tag\{(\d+)\}", text)] == list(range(1, disk.judged + 1))


def test_other_endings_are_refused(disk, tmp_path):
    with pytest.raises(ph.StoreError, match=r"\.ipynb"):
        ph.write_solution(disk, tmp_path / "disk.docx")


def test_a_notebook_shows_the_solution(disk):
    assert 'class="equation"' in disk._repr_html_()


# -- the figure ------------------------------------------------------------------------------------

SVG = "{http://www.w3.org/2000/svg}"


def letters(figure):
    return {element.text for element in ElementTree.fromstring(figure).iter(f"{SVG}text")}


def test_the_figure_names_axes_angles_and_forces(disk):
    found = letters(disk.figure)
    assert {"1", "2", "3", "x", "y", "z", "θ", "φ", "a", "F", "mg"} <= found


@pytest.mark.parametrize("name", ["gyroscope", "gyrocompass", "marble-on-turntable/tilted"])
def test_every_angle_is_drawn_between_directions_that_enclose_it(name):
    """An arc's letter stands for the angle of the arc, measured in space."""
    figure = sys.modules["polhode.solution._figure"]
    setting = sys.modules["polhode.solution._setting"].setting_of(
        ph.derive(CATALOGUE[name].build())
    )
    view = figure._View(setting, 40.0)
    for symbol, value in view.values.items():
        for frame in setting.axes.lineage:
            if symbol in frame.angle.symbols():
                pair = figure._between(view, frame, ph.Expr.generator(symbol))
                assert pair is not None
                cosine = sum(a * b for a, b in zip(*pair, strict=True))
                assert cosine == pytest.approx(math.cos(value))


def test_several_bodies_have_no_figure():
    assert ph.solution(own_systems.double_pendulum()).figure == ""


def test_json_of_a_step(disk):
    json.dumps([step.to_json() for step in disk.steps])
    first = next(step for step in disk.steps if step.latex).to_json()
    assert first["number"] == 1
    assert first["verdict"] == "holds"
