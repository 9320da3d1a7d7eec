"""`polhode list`: what there is, under the names that scripts use."""

import json
import subprocess
import sys

from cli.shapes import LIST, misshapen
from polhode.catalogue import CATALOGUE

CONTRACT = {
    "spinning-coin",
    "rolling-disk",
    "marble-on-turntable",
    "marble-on-turntable/tilted",
    "gyrocompass",
    "tennis-racquet",
    "ball-on-paper",
    "gyroscope",
    "gyroscope/held",
    "gyroscope/vertical-plane",
}


def test_the_document(document):
    found = document("list")
    assert [*misshapen(found, LIST)] == []
    systems = {system["name"]: system for system in found["systems"]}
    assert systems.keys() >= CONTRACT
    disk = systems["rolling-disk"]
    assert disk["speeds"] == ["phi_dot", "theta_dot", "omega_3"]
    assert disk["reactions"] == ["F_x", "F_y", "F_z"]
    assert disk["parameters"][0] == {
        "name": "m",
        "unit": "kg",
        "default": "0.2 kg",
        "meaning": "mass of the disk",
    }
    assert "Fprime_phi" in systems["gyroscope/vertical-plane"]["reactions"]


def test_the_table_names_every_system_with_its_parameters(polhode):
    code, out, err = polhode("list")
    assert (code, err) == (0, "")
    for entry in CATALOGUE.values():
        assert f"\n{entry.name} " in f"\n{out}"
        assert entry.title in out
    assert "parameters    m=0.2 kg, a=30 mm, g=9.81 m/s^2" in out


def test_it_starts_without_numerical_or_symbolic_libraries():
    heavy = {"numpy", "sympy", "scipy", "matplotlib", "heyoka", "pandas", "pint"}
    program = (
        "import sys; from polhode.cli import main; code = main(['list', '--json']);"
        f"print(code, *sorted({heavy} & sys.modules.keys()), file=sys.stderr)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stderr == "0\n"
    assert json.loads(run.stdout)["schema"] == 3


def test_what_else_can_be_set_is_listed(document, polhode):
    systems = {system["name"]: system for system in document("list")["systems"]}
    names = [option["name"] for option in systems["ball-on-paper"]["options"]]
    assert names == ["mu", "mu_static", "edge", "sheet"]
    assert systems["tennis-racquet"]["options"] == []
    assert systems["rolling-disk"]["start"]["theta"] == "80 deg"
    _, out, _ = polhode("list")
    assert "--set edge=0.3m" in out


def test_one_system_by_name(document, polhode):
    (found,) = document("list", "ball-on-paper")["systems"]
    assert found["name"] == "ball-on-paper"
    code, _, err = polhode("list", "ball-on-papr")
    assert code == 2
    assert "ball-on-paper" in err
