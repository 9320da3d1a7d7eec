"""What the lab answers to what its page asks."""

import csv
import io
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from starlette.testclient import TestClient

import polhode as ph
from lab.conftest import HERE, PORT, SMALL, opened
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.lab import Own
from polhode.lab._app import app_of
from polhode.lab._describe import plots_of, summary_of
from polhode.lab._files import KINDS
from polhode.lab._requests import RunRequest
from polhode.lab._system_session import SystemSession
from polhode.view import scene, scenery


def answer(response):
    assert response.status_code == 200, response.text
    return json.loads(response.content, parse_constant=pytest.fail)


@pytest.mark.parametrize("name", CATALOGUE)
def test_every_system_has_sliders_that_hold_their_values(ask, name):
    described = answer(ask("describe", system=name))
    assert described["title"] == CATALOGUE[name].title
    controls = described["parameters"] + described["start"]
    assert {control["name"] for control in controls} >= set(CATALOGUE[name].start)
    for control in controls:
        assert control["low"] < control["high"]
        assert control["low"] <= control["value"] <= control["high"]
        assert control["symbol"].startswith("<math")
        assert control["low"] > 0 or not control["ratio"]


def test_the_motion_is_that_of_the_numbers(ask):
    start = {"theta": "75 deg", "phi_dot": "1 rad/s", "omega_3": "40 rad/s"}
    found = opened(ask("read", system="rolling-disk", start=start, duration="1 s"))
    panel = found["account"]["panels"][0]
    assert panel["unit"] == "deg"
    theta = panel["series"][0]["values"]
    disk = ph.derive(CATALOGUE["rolling-disk"].build())
    run = ph.simulate(disk, {"m": 0.2, "a": 0.03, "g": 9.81}, start, "1 s")
    assert theta[0] == pytest.approx(75)
    assert theta[-1] == pytest.approx(math.degrees(run.final["theta"]), abs=1e-4)


def test_what_is_read_is_of_the_picture_and_not_computed_again():
    """Picture and account together are the scene of a page."""
    session, request = (
        SystemSession(CATALOGUE["gyroscope"]),
        RunRequest("gyroscope", duration="0.1 s"),
    )
    result = session.simulate(request)
    assert session.simulate(RunRequest("gyroscope", duration="0.1 s")) is result
    assert session.simulate(RunRequest("gyroscope", duration="0.2 s")) is not result
    whole = scene(result.run, plots=plots_of(result.variant, result.run))
    seen = scenery(result.run)
    assert (seen.panels, seen.motion, seen.evidence) == ((), (), ())
    found = summary_of(result.variant, result.run)
    assert [p.unit for p in found.panels] == [p.unit for p in whole.panels]
    assert (found.motion, found.start) == (whole.motion, whole.start)
    assert len(seen.arrows) == len(whole.arrows)


@pytest.mark.parametrize("name", ["marble-on-turntable/tilted", "ball-on-paper"])
def test_without_friction_the_support_still_moves(name):
    """The body does not feel it, but it is seen."""
    session = SystemSession(CATALOGUE[name])
    result = session.simulate(RunRequest(name, "smooth", duration="0.2 s"))
    assert len(scenery(result.run).supports[0].pose.turn) > 1 or name == "ball-on-paper"


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_motion_that_overflows_is_reported(ask):
    beyond = ask("run", system="ball-on-paper", settings={"X": "exp(exp(t))"})
    assert beyond.status_code == 422
    assert "is too large to be squared" in beyond.json()["given"]


def test_contacts_are_switched(ask):
    kinds = {}
    for contact in ("rolling", "smooth", "friction"):
        described = answer(ask("describe", system="rolling-disk", contact=contact))
        assert described["contact"] == contact
        found = opened(ask("read", system="rolling-disk", contact=contact, duration="0.5 s"))
        panels = found["account"]["panels"]
        kinds[contact] = {s["name"] for panel in panels for s in panel["series"]}
    assert kinds["rolling"] >= {"F_x", "F_y", "F_z"}
    assert "F_x" not in kinds["smooth"]
    assert "mu" in {c["name"] for c in described["parameters"]}


def test_without_friction_it_starts_as_if_it_rolled(ask):
    places = {}
    for contact in ("rolling", "smooth"):
        found = opened(ask("run", system="rolling-disk", contact=contact, duration="0.01 s"))
        place = found["bodies"][0]["pose"]["place"]
        places[contact] = place[-1] - place[0]
    assert np.linalg.norm(places["rolling"][:2]) > 0.01
    assert places["smooth"][:2] == pytest.approx(places["rolling"][:2], abs=1e-4)


def test_a_start_without_friction_is_as_the_sliders_say(ask):
    described = answer(ask("describe", system="ball-on-paper", contact="smooth"))
    found = {c["name"]: c["text"] for c in described["start"]}
    begun = opened(ask("read", system="ball-on-paper", contact="smooth"))["account"]["start"]
    values = {number["name"]: number["value"] for number in begun}
    assert abs(values["omega_y"]) > 1
    assert float(found["omega_y"].split()[0]) == pytest.approx(values["omega_y"])
    still = {**found, "omega_y": "0"}
    begun = opened(ask("read", system="ball-on-paper", contact="smooth", start=still))
    values = {number["name"]: number["value"] for number in begun["account"]["start"]}
    assert values["omega_y"] == 0


def test_friction_slips_where_rolling_needs_too_much(ask):
    numbers = {"settings": {"mu": "0.05"}, "contact": "friction", "duration": "0.6 s"}
    path = [[t / 60, 0.1 * (1 - math.cos(t / 4)), 0] for t in range(30)]
    found = opened(ask("read", system="ball-on-paper", sheet=path, **numbers))
    kinds = {event["what"].partition(":")[0] for event in found["account"]["happenings"]}
    assert kinds & {"slips", "sticks", "turns round"}  # it may slide from the first


def test_a_dragged_sheet_gives_the_velocity_back(ask):
    path = [[t / 60, 0.04 * math.sin(t / 20), 0.03 * (1 - math.cos(t / 15))] for t in range(80)]
    question = {"system": "ball-on-paper", "sheet": path, "duration": "3 s"}
    found = opened(ask("run", **question))
    speeds = {speed["name"]: speed for speed in opened(ask("read", **question))["outcome"]}
    for name in ("v_x", "v_y"):
        assert speeds[name]["end"] == pytest.approx(speeds[name]["start"], abs=1e-12)
    moved = found["supports"][0]["pose"]["place"]
    assert np.ptp(moved[:, 0]) > 0.03


def test_where_the_ball_goes_while_the_sheet_is_pulled(ask):
    """The same places as in the whole motion, without all that goes with it."""
    path = [[t / 60, 0.1 * (1 - math.cos(t / 10)), 0] for t in range(40)]
    following = ask("follow", system="ball-on-paper", sheet=path, duration="2 s")
    found = opened(following)
    whole = opened(ask("run", system="ball-on-paper", sheet=path, duration="2 s"))
    (pose,) = found["poses"]
    place = pose["place"]
    wanted = whole["bodies"][0]["pose"]["place"]
    assert (found["duration"], found["frames"]) == (2, len(place))
    assert np.allclose(place[[0, 30, -1]], wanted[[0, len(wanted) // 2, -1]], atol=1e-6)
    assert len(following.content) < 20_000


def test_standing_says_on_which_side_of_a_threshold(ask):
    """A disk on edge keeps rolling where ω₃² exceeds g/3a."""
    limit = math.sqrt(9.81 / (3 * 0.03))
    sides = {}
    for factor in (0.9, 1.1):
        start = {"theta": "90 deg", "omega_3": f"{factor * limit} rad/s"}
        family = answer(ask("standing", system="rolling-disk", start=start))["families"][0]
        condition = family["conditions"][0]
        sides[factor] = condition["holds"]
        assert condition["ratio"] == pytest.approx(factor**2, rel=1e-3)
        assert family["on"] == pytest.approx(0, abs=1e-12)
    assert sides == {0.9: False, 1.1: True}


def test_standing_gives_the_rate_of_steady_motion(ask):
    start = {"theta": "80 deg", "omega_3": "40 rad/s"}
    family = answer(ask("standing", system="rolling-disk", start=start))["families"][0]
    rate = min(branch["value"] for branch in family["branches"])
    kept = {**start, "phi_dot": f"{rate!r} rad/s"}
    found = opened(ask("read", system="rolling-disk", start=kept, duration="2 s"))
    assert np.ptp(found["account"]["panels"][0]["series"][0]["values"]) < 1e-4


def test_claims_are_listed_and_judged(ask):
    claims = answer(ask("claims", system="gyroscope"))["claims"]
    assert len(claims) > 5
    assert all(claim["formula"] or claim["words"] for claim in claims)
    assert all(claim["convention"] for claim in claims)
    (damaged,) = (claim for claim in claims if claim["id"] == "106")
    assert [note["label"] for note in damaged["notes"]] == ["read as", "because"]
    assert damaged["notes"][0]["formula"] != damaged["formula"]
    verdict = answer(ask("judge", system="gyroscope", id=claims[0]["id"]))
    assert verdict["verdict"] in {"holds", "fails", "approximate", "definition", "unread"}


def test_typed_equations_are_judged(ask):
    momentum = r"I_1 \dot\omega_1 = (I_2 - I_3)\,\omega_2\omega_3"
    assert answer(ask("check", system="tennis-racquet", latex=momentum))["verdict"] == "holds"
    wrong = momentum.replace("I_2 - I_3", "I_3 - I_2")
    found = answer(ask("check", system="tennis-racquet", latex=wrong))
    assert found["verdict"] == "fails"
    assert found["correction"]["formula"].startswith("<math")


def test_what_an_ambiguous_letter_means_can_be_typed(ask):
    question = {"system": "gyroscope", "latex": r"\dot L_z = 0"}
    assert answer(ask("check", **question))["verdict"] == "ambiguous"
    found = answer(ask("check", **question, read="L = about pivot;"))
    assert found["verdict"] == "holds"
    assert "L as angular momentum about pivot" in " ".join(found["remarks"])


@pytest.mark.parametrize(
    ("kind", "begins"),
    [
        ("page", b"<!DOCTYPE html>"),
        ("csv", b"# polhode {"),
        ("svg", b"<?xml"),
        ("png", b"\x89PNG"),
        ("gif", b"GIF89a"),
    ],
)
def test_files_are_made(ask, kind, begins):
    response = ask("export", system="gyroscope", duration="0.05 s", kind=kind)
    assert response.status_code == 200
    assert response.content.startswith(begins)
    called = response.headers["content-disposition"]
    assert called == f'attachment; filename="gyroscope.{KINDS[kind].ending}"'


def test_the_table_is_of_the_requested_motion(ask):
    start = {"theta": "50 deg", "omega_1": "100 rad/s"}
    response = ask("export", system="gyroscope", start=start, duration="0.2 s", kind="csv")
    rows = list(csv.DictReader(io.StringIO(response.text.partition("\n")[2])))
    assert float(rows[0]["theta"]) == pytest.approx(math.radians(50))
    assert float(rows[-1]["t"]) == pytest.approx(0.2)


def test_a_system_of_ones_own_is_offered():
    """It is sent to the workers as plain data, and given numbers to begin with."""
    m, l, g = ph.symbols("m l g", positive=True)
    swing = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", name="axes")
    rod = ph.rod("rod", mass=m, length=l, axes=swing, axis="z")
    pivot = ph.Pivot(rod, at=swing["z"] * (l / 2))
    system = ph.System(pivot, ph.Hinge(rod, axis="y"), ph.Gravity(g), name="<i>pendulum</i>")
    own = Own("file.py:swing", system.name, ph.model.write_declaration(system))
    with TestClient(app_of(PORT, own, SMALL), base_url=HERE) as client:
        page = client.get("/").text
        assert "&lt;i&gt;pendulum" in page
        assert "<i>" not in page
        described = client.post("/api/describe", json={"system": own.name}).json()
        assert {c["name"] for c in described["parameters"]} == {"m", "l", "g"}
        found = opened(client.post("/api/run", json={"system": own.name, "duration": "1 s"}))
        assert found["duration"] == 1


def test_numbers_of_ones_own_file_come_along():
    m, l, g = ph.symbols("m l g", positive=True)
    swing = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=swing)
    system = ph.System(ph.Pivot(bob, at=swing["z"] * l), ph.Gravity(g), name="swing")
    entry = replace(
        CatalogueEntry.bare("file.py:swing", "swing", system),
        values={"m": "300 g", "l": "2 m"},
        start={"theta": "25 deg", "theta_dot": "2 rad/s"},
        duration="3 s",
    )
    with TestClient(app_of(PORT, Own.of(entry), SMALL), base_url=HERE) as client:
        described = client.post("/api/describe", json={"system": entry.name}).json()
    texts = {c["name"]: c["text"] for c in described["parameters"] + described["start"]}
    assert texts["m"] == "300 g"
    assert texts["l"] == "2 m"
    assert texts["g"].startswith("9.81")  # which the file does not say
    assert texts["theta"] == "25 deg"
    assert texts["theta_dot"] == "2 rad/s"
    assert described["duration"] == "3 s"


def test_no_verdict_on_a_start_that_is_no_steady_motion(ask):
    """A disk let go at 80 degrees falls, whatever the condition would be for its spin."""
    start = {"theta": "80 deg", "omega_3": "40 rad/s"}
    family = answer(ask("standing", system="rolling-disk", start=start))["families"][0]
    assert not family["here"]
    assert family["verdict"] == ""
    assert family["conditions"]
    assert all("holds" not in c and c["ratio"] is None for c in family["conditions"])


@pytest.mark.parametrize(("friction", "slips"), [("0.3", False), ("0.05", True)])
def test_a_steady_motion_that_the_contact_cannot_hold_is_no_steady_motion(ask, friction, slips):
    start = {"theta": "80 deg", "omega_3": "40 rad/s"}
    asked = {"system": "rolling-disk", "contact": "friction", "settings": {"mu": friction}}
    family = answer(ask("standing", **asked, start=start))["families"][0]
    rate = min((b["value"] for b in family["branches"]), key=abs)
    kept = {**start, "phi_dot": f"{rate!r} rad/s"}
    there = answer(ask("standing", **asked, start=kept))["families"][0]
    assert there["here"]
    assert ("ground slips" in there["broken"]) == slips
    assert there["verdict"] == ("" if slips else "stable")


def test_only_what_can_be_started_is_offered(ask):
    """At θ = 0 the gyroscope's azimuth has no value, and a precession has one only beside it."""
    for start, precesses in (({"theta": "60 deg"}, True), ({"theta": "0 deg"}, False)):
        given = {**start, "omega_1": "150 rad/s"}
        precession, *upright = answer(ask("standing", system="gyroscope", start=given))["families"]
        assert {branch["startable"] for branch in precession["branches"]} == {precesses}
        assert not any(family["startable"] for family in upright)
    families = answer(ask("standing", system="gyroscope/upright"))["families"]
    assert all(family["startable"] for family in families)


def test_a_solution_is_marked_line_by_line(ask):
    text = (
        r"\newcommand{\rate}[1]{\dot{#1}} \section{Part (a)} It has $\omega_1 = \rate\theta$. "
        "\n"
        r"The potential energy is \[ V &= m g a \cos\theta \\ E - T &= m g a \cos\theta \]"
    )
    found = answer(ask("review", system="rolling-disk", text=text))
    marks = [line["mark"] for line in found["lines"]]
    assert marks == ["true", "error", "follows"]
    assert all("\\rate" not in line["latex"] for line in found["lines"])
    error = found["lines"][1]
    assert error["correction"]["formula"].startswith("<math")
    assert error["counterexample"]["left"]
    assert found["lines"][2]["of"] == 1
    assert found["counts"] == {"true": 1, "error": 1, "follows from an error": 1}


def test_a_text_without_relations_has_no_marks(ask):
    found = answer(ask("review", system="gyroscope", text="Only words.", format=".md"))
    assert found == {"lines": [], "counts": {}}
