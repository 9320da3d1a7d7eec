"""A System in a file of the user's own, and errors in such a file."""

import json

import pytest

RING = """
import polhode as ph
from neighbour import WIDTH

print("loading")
M, b, g, I_1, I_3 = ph.symbols("M b g I_1 I_3", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")
axes = lab.rotated(phi, "z").rotated(theta, "x")
ring = ph.Body("ring", mass=M, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3", rim=b)
roll = ph.System(ph.Rolling(ring, on=ph.Plane(lab)), ph.Gravity(g), name="ring")
"""
HOOP = ("M=0.2kg", "b=30mm", "g=9.81", "I_3=M*b**2", "I_1=I_3/2")
NUMBERS = tuple(word for pair in HOOP for word in ("--set", pair))


@pytest.fixture
def ring(tmp_path):
    (tmp_path / "neighbour.py").write_text("WIDTH = 3\n")
    path = tmp_path / "ring.py"
    path.write_text(RING)
    return path


def test_it_is_derived_like_any_other(polhode, ring):
    code, out, err = polhode("derive", f"{ring}:roll")
    assert code == 0
    assert "(I₃ + M b²) ω̇₃ − M b² θ̇ φ̇ sinθ = 0" in out
    assert err == "loading\n"  # what it prints never mixes with the answer


def test_it_runs_with_the_numbers_given(polhode, ring, tmp_path):
    start = ("--start", "theta=80deg", "--start", "omega_3=40")
    words = ("run", f"{ring}:roll", *NUMBERS, *start, "--duration", "0.2s")
    code, out, _ = polhode(*words, "--out", str(tmp_path / "out"))
    assert code == 0
    assert "I_1 = 9e-05, I_3 = 0.00018, M = 0.2" in out
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"roll.csv", "roll.png"}


def test_its_missing_numbers_are_named(polhode, ring):
    code, out, err = polhode("run", f"{ring}:roll", *NUMBERS[:4], "--duration", "1s")
    assert (code, out) == (2, "")
    assert "no value for I_1, I_3, g" in err
    code, out, err = polhode("run", f"{ring}:roll", *NUMBERS)
    assert (code, out) == (2, "")
    assert "no duration" in err


def test_the_only_system_of_a_file_need_not_be_named(polhode, ring):
    named, only = (polhode("vectors", f"{ring}{variable}")[1] for variable in (":roll", ""))
    assert named.replace(":roll", "") == only
    ring.write_text("x = 1")
    assert f"{ring} without a System; expected a System in" in polhode("list", str(ring))[2]
    ring.write_text(f"{RING}\nother = roll\n")
    assert f"which system of {ring}?; expected {ring}:roll or" in polhode("list", str(ring))[2]


def test_its_parameters_are_listed_with_their_units(polhode, ring):
    (system,) = json.loads(polhode("list", str(ring), "--json")[1])["systems"]
    assert {p["name"]: p["unit"] for p in system["parameters"]} == {
        "M": "kg",
        "b": "m",
        "g": "m/s^2",
        "I_1": "kg m^2",
        "I_3": "kg m^2",
    }
    assert "parameters    I_1, I_3, M, b, g" in polhode("list", str(ring))[1]


@pytest.mark.parametrize(
    ("variable", "said"),
    [
        (":lab", "is not a System but a Frame"),
        (":nothing", "is not a System"),
    ],
)
def test_the_systems_of_the_file_are_offered(polhode, ring, variable, said):
    code, out, err = polhode("derive", f"{ring}{variable}")
    assert (code, out) == (2, "")
    assert said in err
    assert f"expected {ring}:roll" in err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = (\n", "line 1: '(' was never closed"),
        ("\nx = 1/0\n", "line 2: ZeroDivisionError: division by zero"),
        ("import polhode as ph\nph.System()\n", "line 2: a system without a body"),
        ("import missing_library\n", "line 1: ModuleNotFoundError"),
        ("open('no such file')\n", "line 1: [Errno 2] No such file"),
        ("raise SystemExit(0)\n", "line 1: SystemExit: 0"),
        ("def f():\n    return g\n\nf()\n", "line 2: NameError"),
        ("x = 1\n", "expected a System in that file"),
        ("\x00", "null bytes"),
    ],
)
def test_errors_are_located_by_file_and_line(polhode, tmp_path, text, said):
    path = tmp_path / "bad.py"
    path.write_text(text)
    code, out, err = polhode("derive", f"{path}:roll")
    assert (code, out) == (2, "")
    assert said in err
    assert str(path) in err
    assert err.count("\n") == 1


def test_a_file_that_is_not_there(polhode, tmp_path):
    code, out, err = polhode("derive", f"{tmp_path}/none.py:roll")
    assert (code, out) == (2, "")
    assert "none.py does not exist" in err


FORCED = """
import polhode as ph

m, l, g = ph.symbols("m l g", positive=True)
(lift,) = ph.functions("Z")
lab = ph.Frame("lab")
axes = lab.rotated(ph.coordinate("theta"), "y", name="axes")
bob = ph.point_mass("bob", mass=m, axes=axes)
swing = ph.System(
    ph.Pivot(bob, at=axes["z"] * l, to=lab["z"] * lift), ph.Gravity(g), name="swing"
)
numbers = {m: "200 g", "l": "1 m", "g": 9.81, "Z": "sin(3*t)/20"}
start, duration = {"theta": "30 deg", "theta_dot": "2 rad/s"}, "3 s"
"""


def test_its_numbers_are_told_from_what_is_prescribed(polhode, tmp_path):
    file = tmp_path / "swing.py"
    file.write_text(FORCED)
    (system,) = json.loads(polhode("list", str(file), "--json")[1])["systems"]
    assert {p["name"]: (p["unit"], p["default"]) for p in system["parameters"]} == {
        "m": ("kg", "200 g"),
        "l": ("m", "1 m"),
        "g": ("m/s^2", "9.81"),
    }
    assert system["forcing"] == {"Z": "sin(3*t)/20"}
    assert system["start"] == {"theta": "30 deg", "theta_dot": "2 rad/s"}
    assert "forcing       Z=sin(3*t)/20" in polhode("list", str(file))[1]
    document = json.loads(polhode("run", str(file), "--json")[1])
    assert document["parameters"] == {"m": 0.2, "l": 1.0, "g": 9.81}


def test_exercises_draw_near_the_numbers_of_a_file(polhode, tmp_path):
    file = tmp_path / "swing.py"
    file.write_text(FORCED.replace("lab['z'] * lift", "lab.zero").replace('"1 m"', '"50 m"'))
    words = ("exercise", str(file), "--kind", "freedom", "--json")
    (sheet,) = json.loads(polhode(*words)[1])["sheets"]
    drawn = sheet["exercises"][0]["numbers"]
    assert 30 < float(drawn["l"].removesuffix(" m")) < 75
    assert drawn["m"].endswith(" g")
    assert drawn["g"] == "9.81 m/s^2"
