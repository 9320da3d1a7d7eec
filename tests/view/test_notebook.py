"""Rich display: executed in a notebook, and well-formed whatever names are used."""

import re
from html.parser import HTMLParser

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient

import polhode as ph
from model.parts import PARTS
from polhode.catalogue import CATALOGUE
from polhode.view import html_of, page_of

CELLS = (
    "import polhode as ph\n"
    "from polhode.catalogue import CATALOGUE\n"
    "system = CATALOGUE['gyroscope'].build()\nsystem",
    "equations = ph.derive(system)\nequations",
    "ph.steady(equations)[0]",
    "numbers = {'M': 0.5, 'a': 0.06, 'I_1': 6.25e-4, 'I_2': 3.5e-4, 'g': 9.81}\n"
    "ph.simulate(equations, numbers, {'theta': '60 deg', 'omega_1': 150}, '0.5 s')",
    "ph.figures.history(_, 'theta')[0].axes.figure",
)


@pytest.fixture(scope="module")
def executed():
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(c) for c in CELLS])
    NotebookClient(notebook, timeout=600, startup_timeout=600, kernel_name="python3").execute()
    return [cell.outputs[-1]["data"] for cell in notebook.cells]


def test_everything_is_shown_as_html(executed):
    system, equations, steady, motion, figure = executed
    assert "<caption>bodies</caption>" in system["text/html"]
    assert equations["text/html"].count('class="row"') >= 3
    assert "<summary>reactions</summary>" in equations["text/html"]
    assert "exists where" in steady["text/html"]
    assert "stable" in steady["text/html"]
    assert motion["text/html"].startswith("<iframe")
    assert "image/png" in figure


def test_a_motion_is_a_frame_that_reaches_nothing(executed):
    html = executed[3]["text/html"]
    assert re.findall(r'sandbox="([^"]*)"', html[:300]) == ["allow-scripts"]
    assert len(html) < 1_500_000
    (inner,) = framed(html)
    assert "default-src 'none'" in inner
    assert inner.startswith("<!DOCTYPE html>")
    assert inner.rstrip().endswith("</html>")


def framed(html):
    """Documents within the frames of some HTML."""

    class Frames(HTMLParser):
        def __init__(self):
            super().__init__()
            self.found = []

        def handle_starttag(self, tag, attributes):
            if tag == "iframe":
                self.found.append(dict(attributes)["srcdoc"])

    frames = Frames()
    frames.feed(html)
    return frames.found


def test_formulas_need_no_script_from_a_network(tmp_path):
    """A notebook that shows LaTeX alone has MathJax set it, which an exported file has to fetch."""
    theta = ph.coordinates("theta")[0]
    closed = ph.closed_form(
        ph.derive(CATALOGUE["gyroscope"].build()),
        {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81},
        {"theta": "60 deg", "omega_1": 150},
    )
    for thing in (ph.sin(theta) / 2, ph.Matrix.of([[theta, 1]]), closed):
        html = thing._repr_html_()
        assert "<math" in html
        assert "\\" not in html
    assert "$" in (ph.sin(theta) / 2)._repr_latex_()  # for a notebook that is printed with LaTeX


def test_names_are_text():
    m, g = ph.symbols("m g", positive=True)
    lab = ph.Frame("lab")
    name = "<script>alert('1')</script>"
    ball = ph.sphere(name, mass=m, radius=1, axes=lab)
    system = ph.System(ph.Rolling(ball, on=ph.Plane(lab), name="<b>"), ph.Gravity(g), name=name)
    for thing in (system, ph.derive(system)):
        html = html_of(thing)
        assert "<script" not in html
        assert "<b>" not in html


def test_a_family_of_every_state_says_so():
    racquet = ph.derive(CATALOGUE["gyroscope/held"].build())
    for family in ph.steady(racquet):
        assert "Steady motion" in html_of(family)


def test_what_is_unknown_is_text():
    assert html_of("1 < 2") == "<pre>1 &lt; 2</pre>"


def test_without_a_renderer_there_is_text_alone(monkeypatch):
    from polhode.base import _display

    monkeypatch.setattr(_display, "_RENDERERS", [])
    assert CATALOGUE["gyroscope"].build()._repr_html_() is None


def test_what_holds_anyway_is_not_asked():
    """The root of a rolling disk's steady motions is real at every spin."""
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    html = html_of(ph.steady(disk)[0])
    assert "exists where" not in html
    assert "stable when" in html
    assert "sin" in html
    assert 'width="0.17em"' in html  # a thin space around functions, in conditions too


def test_stability_and_invariants_are_typeset():
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    upright = ph.steady(disk, {ph.coordinate("theta"): ph.pi / 2})[0]
    found = ph.stability(upright)
    assert "<math" in found._repr_html_()
    assert repr(found).startswith("Stability: stable when ")
    constants = ph.invariants(disk)
    assert "energy" in constants._repr_html_()
    assert "Searched: " in constants._repr_html_()
    assert constants["E"].meaning == "energy"
    with pytest.raises(ph.PolhodeError, match="no invariant that was found"):
        constants["K"]


def test_an_ensemble_is_summed_up():
    numbers, starts = {"m": 0.2, "a": 0.03, "g": 9.81}, {"theta": [1.0, 0.0], "omega_3": 20.0}
    outputs = {"theta": ph.Final("theta"), "fate": ph.Fate()}
    disk = CATALOGUE["rolling-disk"].build()
    found = ph.ensemble(disk, numbers, starts, 0.1, outputs=outputs)
    assert repr(found) == "Ensemble of 2 members, 1 failed: theta, fate"
    html = found._repr_html_()
    assert "2 members, 1 failed" in html
    assert "none of these: 1" in html
    assert "member 1: sin(theta) = 0" in html


def test_parts_of_results_are_typeset():
    disk = CATALOGUE["rolling-disk"].build()
    equations = ph.derive(disk)
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": "80 deg", "omega_3": 40}
    force = equations.reactions["ground"]
    assert "Reaction of ground on disk" in force._repr_html_()
    assert force._repr_html_().count("<math") == 3
    assert "along lab" in force.force._repr_html_()
    needed = ph.contact_forces(equations, "ground")
    assert "tangential" in needed._repr_html_()
    steady = ph.steady(equations)[0]
    assert '<mo form="infix" lspace="0" rspace="0.25em">=</mo>' in steady.branches[0]._repr_html_()
    assert "&gt;" in ph.stability(steady).conditions[0]._repr_html_()
    constants = ph.invariants(equations)
    assert "energy" in constants["E"]._repr_html_()
    assert "derivatives by" in constants.linear._repr_html_()
    drift = ph.simulate(disk, numbers, start, "0.05 s").drift
    assert f"{drift.energy:.6g}" in drift._repr_html_()
    grown = ph.linearise(disk, numbers, {"theta": "90 deg", "omega_3": 40})
    assert "phi_dot" in grown._repr_html_()


def test_contact_modes_are_named_with_what_is_known_of_them():
    modes = ph.automaton(ph.with_friction(CATALOGUE["rolling-disk"].build(), ph.symbol("mu")))
    assert "rolling; sliding; frictionless; flight" in modes._repr_html_()
    assert "lasts while" not in modes._repr_html_()
    assert modes.together.name == "rolling"
    assert "rolling lasts while" in modes._repr_html_()


def test_derivatives_and_fits_are_tables():
    disk = CATALOGUE["rolling-disk"].build()
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": "80 deg", "omega_3": 40}
    times = np.linspace(0.0, 0.05, 6)
    found = ph.sensitivities(disk, numbers, start, "0.05 s", of=["theta"], by=["a"])
    assert "<td>theta</td><td>a</td>" in found._repr_html_()
    measured = {"theta": ph.simulate(disk, numbers, start, "0.05 s").evaluate("theta", times)}
    best = ph.fit(disk, numbers | {"a": 0.031}, start, times, measured, vary=["a"])
    assert "<td>a</td><td>0.03</td>" in best._repr_html_()


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_a_part_of_a_declaration_is_a_table_of_its_fields(part):
    html = part._repr_html_()
    assert f"<caption>{type(part).__name__} {part.name}</caption>" in html
    for name, value in part.parts:
        assert f"<td>{name}</td>" in html
        if isinstance(value, ph.Expr):
            assert f"<td>{name}</td><td><math" in html


def test_supports_points_and_frames_are_shown():
    lab = ph.Frame("lab")
    theta = ph.coordinates("theta")[0]
    axes = lab.rotated(theta, "x", labels="1 2 3", name="<tilted>")
    ball = ph.sphere("ball", mass=1, radius=2, axes=lab)
    turning = ph.Turntable(lab, ph.symbol("Omega"))._repr_html_()
    assert "<td>Omega</td><td><math" in turning
    assert "<td>body</td><td>ball</td>" in ball.point()._repr_html_()
    shown = axes._repr_html_()
    assert "out of lab (x y z)" in shown
    assert "&lt;tilted&gt; (1 2 3)</td><td><math" in shown
    assert "</td><td>x</td>" in shown
    assert "<strong>Frame lab (x y z)</strong></div>" in lab._repr_html_()


def test_a_scene_is_played_as_its_motion_is():
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}
    start = {"theta": "60 deg", "omega_1": 150}
    run = ph.simulate(CATALOGUE["gyroscope"].build(), numbers, start, "0.1 s")
    scene = ph.scene(run, title="it's a top")
    html = scene._repr_html_()
    assert html.startswith('<iframe title="it\'s a top, played" sandbox=')
    (inner,) = framed(html)
    assert inner == page_of(scene)
    assert repr(scene) == f'Scene "it\'s a top": gyroscope, {scene.frames} frames over 0.1 s'
