"""`polhode run`: numbers in, a motion out, and files that are whole."""

import csv
import math

import pytest

from cli.shapes import RUN, misshapen
from polhode.catalogue import CATALOGUE


def table(path):
    with path.open(encoding="utf-8") as stream:
        next(stream)
        return list(csv.DictReader(stream))


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_document_of_every_system(document, name):
    found = document("run", name, "--duration", "50 ms")
    assert [*misshapen(found, RUN)] == []
    assert (found["system"], found["duration"]) == (name, 0.05)
    assert found["drift"]["energy"] < 1e-12
    assert [event["kind"] for event in found["events"]] == ["start", "end"]
    assert found["files"] == []


def test_settings_and_start_values_are_used(document):
    found = document(
        *("run", "rolling-disk", "--duration", "0.1s"),
        *("--set", "m=2*a/a", "--set", "a = 20mm"),
        *("--start", "theta=pi/2", "--start", "omega_3=-600rpm"),
    )
    assert found["parameters"] == {"m": 2.0, "a": 0.02, "g": 9.81}
    spin = -20 * math.pi
    assert found["start"] == {"theta": math.pi / 2, "omega_3": pytest.approx(spin)}
    assert found["assumed"].keys() == {"phi", "psi", "x", "y", "phi_dot", "theta_dot"}
    final = found["final"]
    assert final["theta"] == pytest.approx(math.pi / 2)
    assert final["x"] == pytest.approx(-0.02 * spin * 0.1)
    assert final["F_z"] == pytest.approx(2 * 9.81)


def test_conserved_quantities_are_checked(document):
    drifts = document("run", "gyroscope", "--duration", "0.2s")["drift"]["invariants"]
    assert drifts.keys() == {"E", "omega_1", "L_pivot_z"}
    assert max(drifts.values()) < 1e-13


def test_a_prescribed_motion_is_a_formula(document):
    """The ball takes 2/7 of every change of the sheet's velocity (a uniform ball, problem 6)."""
    still = ("run", "ball-on-paper", "--duration", "1s", "--set", "Y=0")
    assert document(*still, "--set", "X=0")["final"]["x"] == pytest.approx(0.2)
    moved = document(*still, "--set", "X=-sin(t)/10")["final"]["x"]
    assert moved == pytest.approx(0.2 + 2 / 70 * (1 - math.sin(1)), rel=1e-13)


def test_files_hold_the_samples_and_a_figure(document, tmp_path):
    folder = tmp_path / "new" / "results"
    found = document("run", "gyroscope/held", "--duration", "0.1s", "--out", str(folder))
    assert found["files"] == [str(folder / f"gyroscope-held.{kind}") for kind in ("csv", "png")]
    assert sorted(path.name for path in folder.iterdir()) == [
        "gyroscope-held.csv",
        "gyroscope-held.png",
    ]
    rows = table(folder / "gyroscope-held.csv")
    assert float(rows[-1]["t"]) == 0.1
    assert float(rows[-1]["psi"]) == pytest.approx(found["final"]["psi"], rel=1e-15)
    assert (folder / "gyroscope-held.png").read_bytes().startswith(b"\x89PNG")


def test_the_text_output_has_the_final_state_and_the_drift(polhode):
    code, out, err = polhode("run", "rolling-disk", "--duration", "1s")
    assert (code, err) == (0, "")
    assert out.startswith("Rolling disk (rolling-disk), 1 s, in SI units\n")
    for word in ("parameters", "start", "assumed", "final", "drift", "events", "seconds"):
        assert f"\n  {word} " in out


def test_times_of_events_are_printed_like_other_numbers(polhode):
    code, out, _ = polhode(
        *("run", "ball-on-paper", "--mu", "0.2", "--duration", "0.2s", "--events"),
        *("--set", "X=0", "--set", "Y=0", "--start", "v_x=0.7", "--start", "omega_y=0"),
    )
    assert code == 0
    sticks = 0.7 / (3.5 * 0.2 * 9.81)
    assert f"  {sticks:<14.9g} s  sticks: sliding to rolling\n" in out


def test_without_a_duration_the_catalogues_is_taken(document):
    assert document("run", "spinning-coin")["duration"] == 1.0


@pytest.mark.parametrize(("first", "jerks"), [(-0.5, [0.5]), (-5.0, []), (5.0, []), (0.2, [1.2])])
def test_a_sheet_may_begin_before_the_motion_or_end_after_it(document, tmp_path, first, jerks):
    """It is at rest before its first row and after its last, whenever these are."""
    path = tmp_path / "sheet.csv"
    rows = [f"{first + i / 10},{3 * i * i / 1000},0" for i in range(11)]
    path.write_text("\n".join(["t,x,y", *rows]))
    found = document(
        "run", "ball-on-paper", "--sheet", str(path), "--mu", "0.2", "--duration", "2s"
    )
    assert [e["time"] for e in found["events"] if e["kind"] == "jerk"] == pytest.approx(jerks)
    assert found["drift"]["energy"] < 1e-13


def test_a_ball_that_is_dropped_on_the_paper(document):
    found = document(
        *("run", "ball-on-paper", "--duration", "0.2s", "--set", "X=0", "--set", "Y=0"),
        *("--start", "z=0.12m", "--start", "v_x=0.3m/s"),
    )
    assert found["start"] == {"z": 0.12, "v_x": 0.3}
    start, landing, _ = found["events"]
    assert (start["to"], landing["kind"]) == ("flight", "touches down")
    assert landing["time"] == pytest.approx(math.sqrt(2 * 0.1 / 9.81), abs=1e-14)
    assert found["final"]["z"] == 0.02


def test_paper_without_friction_leaves_the_ball_where_it_is(document):
    """It slips from the start, and nothing but its spin and its velocity tells of before."""
    found = document(
        *("run", "ball-on-paper", "--mu", "0", "--duration", "1s", "--set", "X=t^2"),
        *("--set", "Y=sin(9*t)/9", "--start", "v_x=0.2m/s", "--start", "omega_z=3rad/s"),
    )
    final = found["final"]
    assert final["x"] == pytest.approx(0.2, abs=1e-15)
    assert final["v_x"] == pytest.approx(0.2, abs=1e-15)
    assert abs(final["y"]) < 1e-15
    assert final["omega_z"] == pytest.approx(3.0, abs=1e-14)
    assert found["drift"]["energy"] < 1e-15


def test_a_reaction_may_be_an_event(document):
    """The pivot carries the weight whenever the centre has no vertical acceleration."""
    found = document("run", "gyroscope", "--duration", "0.1s", "--events", "F_z-M*g")
    times = [e["time"] for e in found["events"] if e["kind"] == "F_z-M*g"]
    assert len(times) == 1
    at_event = document("run", "gyroscope", "--duration", f"{times[0]!r}s")["final"]
    assert at_event["F_z"] == pytest.approx(0.5 * 9.81, rel=1e-9)


def test_a_reaction_of_a_contact_is_read_in_the_mode_it_is_in(document, polhode):
    """The force on a ball that rolls is proportional to the acceleration of the sheet."""
    words = ("run", "ball-on-paper", "--mu", "0.2", "--duration", "1s", "--events", "F_x")
    times = [e["time"] for e in document(*words)["events"] if e["kind"] == "F_x"]
    # the sheet's x-acceleration cos(2 t)/5 vanishes at t = pi/4
    assert times == pytest.approx([math.pi / 4], rel=1e-9)
    _, out, _ = polhode(*words)
    assert "F_x = 0, rolling" in out
