"""Every letter in the formulas of a solution is defined."""

import importlib
import runpy
from contextlib import suppress
from pathlib import Path

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import ROUTES
from polhode.solution._letters import letters_in
from solution import own_systems
from solution.letters import undefined_letters

FOLDER = Path(__file__).parents[2] / "docs/examples/solutions"
OWN = (
    "ball_on_incline",
    "two_on_a_spring",
    "smooth_ball",
    "machine_of_atwood",
    "weights_on_a_long_rope",
)
DECLARED = sorted(file.stem for file in FOLDER.glob("*.py") if file.stem != "bicycle")


@pytest.mark.parametrize(
    ("latex", "letters"),
    [
        (r"\dot{v}_x\,\hat{\mathbf x} + v_{z,2}", {"v_x", "v_{z,2}"}),
        (r"\frac{d}{dt}\left(m g z_1\right) = \mathbf v_{\rm cm}", {"m", "g", "z_1", "t"}),
        (r"\frac{\partial\mathcal L}{\partial \dot{\phi}} = P_{\phi}", {r"\phi", r"P_{\phi}"}),
        (r"\operatorname{sn}(u, k)\,d\theta + F'_z", {"u", "k", r"\theta", "F'_z"}),
        (r"\hat{\boldsymbol\rho}\cdot\boldsymbol\omega_{123} + \sin\chi", {r"\chi"}),
    ],
)
def test_letters_of_a_formula(latex, letters):
    assert letters_in(latex) == letters


@pytest.fixture
def opening(monkeypatch):
    """Solutions without their analysis, whose lines are not judged: what is left is quick."""
    module = importlib.import_module("polhode.solution._solution")
    monkeypatch.setattr(module, "judged", lambda line, equations: None)
    monkeypatch.setattr(module, "_analysed", lambda setting: {})
    return ph.solution


def systems():
    yield from ((name, PROBLEM_SET[name].build) for name in PROBLEM_SET if "/" not in name)
    yield from ((name, getattr(own_systems, name)) for name in OWN)
    for name in DECLARED[::3]:  # the others are solved by their first route in `test_documented`
        yield name, lambda name=name: runpy.run_path(str(FOLDER / f"{name}.py"))[name]


@pytest.mark.parametrize(("name", "build"), [pytest.param(*s, id=s[0]) for s in systems()])
def test_every_route_defines_its_letters(name, build, opening):
    equations, built = ph.derive(build()), 0
    for route in ROUTES:
        with suppress(ph.PolhodeError):  # a route that the system does not have
            assert undefined_letters(opening(equations, route)) == {}, route
            built += 1
    assert built


@pytest.mark.parametrize("name", ["spinning-coin", "gyroscope", "tennis-racquet", "gyrocompass"])
def test_whole_solutions_define_their_letters(name, solved):
    assert undefined_letters(solved(name)) == {}


def words_of(solution):
    return " ".join(step.words for step in solution.steps)


def test_coordinates_that_supports_fix_have_their_values(opening):
    """x₁ = -R and y₁ = 0 throughout: the weights hang at fixed distances from the axle."""
    found = opening(own_systems.weights_on_a_long_rope())
    words = words_of(found)
    assert not any(letter in step.latex for step in found.steps for letter in ("x_1", "y_1"))
    assert r"through the fixed points $-R\,\hat{\mathbf x} + l\,\hat{\mathbf z}$" in words


def test_heights_in_an_energy_are_introduced(opening):
    words = words_of(opening(own_systems.machine_of_atwood()))
    assert "$z_1$ is the coordinate of the centre of mass of the left weight along $z$." in words
    assert r"is held at $-R\,\hat{\mathbf x}$ along $x$ and $y$ only" in words
