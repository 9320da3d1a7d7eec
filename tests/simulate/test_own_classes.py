"""Loads and surfaces that a user defines move as they should, and are saved."""

import linecache
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import own_classes
import polhode as ph
from own_classes import planet, tyre
from polhode.model import _declared

RADIUS, TUBE, G = 0.3, 0.05, 9.81
TIMES = np.linspace(0, 2, 21)


@pytest.fixture(autouse=True)
def _registered(monkeypatch):
    """Examples of the documents that ran before may have classes of the same names."""
    for kind in (own_classes.Attraction, own_classes.Tyre):
        monkeypatch.setitem(_declared._REGISTERED, kind.__name__, kind)


@pytest.fixture(scope="module")
def orbit():
    """Eccentricity 0.36, semi-major axis 1/1.36 m, mean motion 1.36^1.5 /s."""
    start = {"x": 1, "v_y": 0.8}
    return ph.simulate(planet(), {"m": 2, "k": 2}, start, 2 * np.pi / 1.36**1.5)


@pytest.fixture(scope="module")
def rolling():
    numbers = {"m": 1, "a": RADIUS, "b": TUBE, "g": G}
    start = {"theta": 1.4, "phi_dot": 1.0, "omega_3": 8.0}
    return ph.simulate(tyre(), numbers, start, 2)


def test_a_planet_keeps_its_ellipse_and_returns(orbit):
    x, y = (orbit[name] for name in ("x", "y"))
    r = np.hypot(x, y)
    a, e = 1 / 1.36, 0.36
    assert r == pytest.approx(a * (1 - e**2) / (1 - e * x / r), abs=1e-13)
    assert [orbit.final["x"], orbit.final["y"]] == pytest.approx([1, 0], abs=1e-12)
    assert orbit.drift.energy < 1e-14


def tyre_by_hand():
    """cos θ by forces and moments in space: r to the contact, e along the axis, mass 1."""
    up, a, c = np.array([0, 0, 1.0]), RADIUS**2 / 2, RADIUS**2

    def contact(e, e_dot):
        s = up - e * e[2]
        s_dot = -e_dot * e[2] - e * e_dot[2]
        size = np.sqrt(s @ s)
        r_dot = -RADIUS * (s_dot / size - s * (s @ s_dot) / size**3)
        return -RADIUS * s / size - TUBE * up, r_dot

    def rates(_, state):
        omega, e = state[:3], state[3:]
        e_dot = np.cross(omega, e)
        r, r_dot = contact(e, e_dot)
        # L' = r x F with v = -omega x r and F = v' + g up
        force = -np.cross(omega, r_dot) + G * up
        inertia = a * np.eye(3) + (c - a) * np.outer(e, e)
        about_contact = inertia + (r @ r) * np.eye(3) - np.outer(r, r)
        moment = np.cross(r, force) - (c - a) * e_dot * (e @ omega)
        return np.concatenate([np.linalg.solve(about_contact, moment), e_dot])

    theta = 1.4
    e = np.array([0, -np.sin(theta), np.cos(theta)])
    spin = 8.0 - 1.0 * np.cos(theta)  # omega_3 holds a part of the turning of the axes
    start = np.concatenate([up * 1.0 + spin * e, e])
    found = solve_ivp(rates, (0, 2), start, method="DOP853", t_eval=TIMES, rtol=1e-12, atol=1e-13)
    return found.y[5]


def test_a_tyre_rolls_as_forces_and_moments_have_it(rolling):
    assert np.cos(rolling.evaluate("theta", TIMES)) == pytest.approx(tyre_by_hand(), abs=1e-9)
    assert rolling.drift.energy < 1e-13


def test_dimensions_follow_from_what_they_do():
    dimensions = {s.published: str(d) for s, d in ph.derive(planet()).dimensions.items()}
    assert dimensions["k"] == "kg m^3/s^2"


@pytest.mark.parametrize("name", ["orbit", "rolling"])
def test_a_saved_motion_is_the_same_motion(name, tmp_path, request):
    run = request.getfixturevalue(name)
    run.save(tmp_path / "run.h5")
    again = ph.load(tmp_path / "run.h5")
    assert again.system == run.system
    assert again.final == pytest.approx(run.final, abs=1e-13)


def test_without_its_class_a_motion_is_refused(orbit, tmp_path, monkeypatch):
    orbit.save(tmp_path / "run.h5")
    monkeypatch.delitem(_declared._REGISTERED, "Attraction")
    with pytest.raises(ph.StoreError, match=r"class 'Attraction'; .* import the module"):
        ph.load(tmp_path / "run.h5")


def other_attraction(monkeypatch, change):
    """The same module once more, with another text of its own."""
    monkeypatch.setattr(_declared, "_REGISTERED", dict(_declared._REGISTERED))
    text = change(Path(own_classes.__file__).read_text("utf-8"))
    linecache.cache["<changed>"] = (len(text), None, text.splitlines(keepends=True), "<changed>")
    module = type(sys)("changed")
    module.__file__ = "<changed>"
    monkeypatch.setitem(sys.modules, "changed", module)
    exec(compile(text, "<changed>", "exec"), vars(module))


def test_with_another_class_a_motion_is_refused(orbit, tmp_path, monkeypatch):
    orbit.save(tmp_path / "run.h5")
    other_attraction(monkeypatch, lambda text: text.replace("** 3", "** 4"))
    with pytest.raises(ph.StoreError, match="a Attraction, whose class has changed"):
        ph.load(tmp_path / "run.h5")


def test_other_words_about_a_class_change_nothing(orbit, tmp_path, monkeypatch):
    orbit.save(tmp_path / "run.h5")
    other_attraction(monkeypatch, lambda text: text.replace("Towards the origin", "Inwards"))
    assert ph.load(tmp_path / "run.h5").final == pytest.approx(orbit.final, abs=1e-13)


def test_a_name_of_polhode_is_taken():
    with pytest.raises(ph.DeclarationError, match="a class 'Spring', derived from Load"):
        type("Spring", (ph.Load,), {})
