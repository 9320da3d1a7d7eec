"""Worked solutions as files: pages, LaTeX, Markdown, notebooks, and the figure."""

import base64
import json
import math
import re
import shutil
from dataclasses import replace
from xml.etree import ElementTree

import nbformat
import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import (
    _figure_drawing,
    _figure_letters,
    _figure_numbers,
    _figure_shapes,
    _figure_view,
    _setting,
)
from solution import own_systems


@pytest.fixture
def disk(solved):
    return solved("rolling-disk")


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


def test_without_latex_a_pdf_is_refused(disk, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
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
    return {"".join(e.itertext()) for e in ElementTree.fromstring(figure.svg()).iter(f"{SVG}text")}


def setting_named(name):
    build = PROBLEM_SET[name].build if name in PROBLEM_SET else getattr(own_systems, name)
    return _setting.Setting(ph.derive(build()))


FIGURES = ["gyroscope", "gyrocompass", "marble-on-turntable/tilted", "ball-on-paper"]
OWN_FIGURES = ["double_pendulum", "rolling_hoop", "asymmetric_top", "spherical_pendulum"]


@pytest.fixture(scope="module")
def figures():
    return {n: _figure_drawing.figure_of(setting_named(n)) for n in (*FIGURES, *OWN_FIGURES)}


def test_the_figure_names_axes_angles_and_forces(disk):
    found = letters(disk.figure)
    assert {"1", "2", "3", "x", "y", "z", "θ", "φ", "a", "F", "mg"} <= found


@pytest.mark.parametrize("name", [*FIGURES, *OWN_FIGURES])
def test_letters_of_figures_do_not_cover_each_other(figures, name):
    assert _figure_letters.overlaps(figures[name].letters) < 0


@pytest.mark.parametrize("name", [*FIGURES, *OWN_FIGURES])
def test_figures_stay_on_their_paper(figures, name):
    wide, tall = figures[name].size
    places = [letter.place for letter in figures[name].letters]
    places += [point for stroke in figures[name].strokes for point in stroke.points]
    assert all(0 <= x <= wide and 0 <= y <= tall for x, y in places)


@pytest.mark.parametrize("name", [*FIGURES, "asymmetric_top"])
def test_every_angle_is_drawn_between_directions_that_enclose_it(name):
    """An arc's letter stands for the angle of the arc, measured in space."""
    view = next(_figure_view.views_of(setting_named(name).equations))
    for symbol in _figure_numbers.angles_of(view.equations):
        for frame, _ in _figure_numbers.frames_of(view.equations):
            if symbol in frame.angle.symbols():
                pair = _figure_shapes.between(view, frame, ph.Expr.generator(symbol))
                assert pair is not None
                cosine = sum(a * b for a, b in zip(*pair, strict=True))
                assert cosine == pytest.approx(math.cos(view.values[symbol]))


def test_loops_are_closed_before_they_are_drawn():
    """Both ends of the rods are where they are held, whatever the angles."""
    setting = setting_named("double_pendulum")
    view = next(_figure_view.views_of(setting.equations))
    upper, lower = setting.equations.system.bodies
    joint = view.point(lower.axes["z"])  # its length is one
    assert view.centre(upper) == pytest.approx(
        [a + b for a, b in zip(view.centre(lower), joint, strict=True)]
    )


def test_a_motion_in_a_plane_is_seen_straight_on(figures):
    found = letters(figures["double_pendulum"])
    assert {"x", "y", "z", "α", "β", "F", "G", "l", "mg"} <= found
    view = next(_figure_view.views_of(setting_named("double_pendulum").equations))
    assert view.is_straight


def test_the_figure_is_in_every_kind_of_file(disk, tmp_path):
    tex = written(disk, tmp_path / "disk.tex")
    assert tex.count(r"\begin{tikzpicture}") == tex.count(r"\end{tikzpicture}") == 1
    assert all(f"${letter.name.latex}$" in tex for letter in disk.figure.letters)
    used = set(re.findall(r"polhode[0-9a-f]{6}", tex))
    assert all(rf"\definecolor{{{colour}}}" in tex for colour in used)
    markdown = written(disk, tmp_path / "my disk.md")
    assert "](my%20disk-figure.svg)" in markdown
    picture = ElementTree.parse(tmp_path / "my disk-figure.svg").getroot()
    assert picture.tag == f"{SVG}svg"
    notebook = json.loads(written(disk, tmp_path / "disk.ipynb"))
    attached = notebook["cells"][0]["attachments"]["figure.png"]["image/png"]
    assert base64.b64decode(attached).startswith(b"\x89PNG")
    assert "(attachment:figure.png)" in "".join(notebook["cells"][0]["source"])


def test_the_file_that_cannot_be_written_is_named(disk, tmp_path):
    with pytest.raises(ph.StoreError, match=r"disk\.md cannot be written"):
        ph.write_solution(disk, tmp_path / "missing" / "disk.md")


def test_json_of_a_step(disk):
    json.dumps([step.to_json() for step in disk.steps])
    first = next(step for step in disk.steps if step.latex).to_json()
    assert first["number"] == 1
    assert first["verdict"] == "holds"
