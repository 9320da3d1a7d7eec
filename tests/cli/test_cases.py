"""`polhode run --case`: motions that answer the text's questions, and what became of them."""

from math import cos, pi, sqrt

import pytest
from scipy.special import ellipk

from polhode.catalogue import CATALOGUE, cases_of

ALL = [(entry.name, case.name) for entry in CATALOGUE.values() for case in cases_of(entry)]
BALL = [name for system, name in ALL if system == "ball-on-paper"]


@pytest.fixture(scope="module")
def runs():
    """Documents of runs, since several tests read the same ones."""
    return {}


@pytest.fixture
def course(document, runs):
    """The document of a case."""

    def found(system, case):
        if (system, case) not in runs:
            runs[system, case] = document("run", system, "--case", case)
        return runs[system, case]

    return found


@pytest.mark.parametrize(("system", "case"), ALL)
def test_every_case_is_listed_and_runs(document, course, system, case):
    (listed,) = document("list", system)["systems"]
    assert case in [one["name"] for one in listed["cases"]]
    found = course(system, case)
    assert found["case"]["name"] == case
    assert found["drift"]["energy"] < 1e-13


@pytest.mark.parametrize("system", ["spinning-coin", "rolling-disk"])
def test_a_disk_on_edge_stays_or_falls_on_either_side_of_the_threshold(course, system):
    above, below = (course(system, case)["beside"] for case in ("stays-up", "falls"))
    assert (above["stable"], below["stable"]) == (True, False)
    assert above["departures"]["theta"]["start"] == pytest.approx(pi / 180)
    assert above["departures"]["theta"]["max"] < 1.01 * pi / 180
    assert below["departures"]["theta"]["max"] > 20 * pi / 180


@pytest.mark.parametrize("case", BALL)
def test_the_final_velocity_of_the_ball_is_its_initial_velocity(course, case):
    compared = course("ball-on-paper", case)["compared"]
    for name in ("v_x", "v_y"):
        assert compared[name]["end"] == pytest.approx(compared[name]["start"], abs=1e-13)


def test_the_ball_slips_on_the_table_and_when_pulled_hard_on_the_paper_too(course):
    rolls, slips = (course("ball-on-paper", case)["events"] for case in ("rolls-off", "slipping"))
    assert [e["kind"] for e in rolls] == ["start", "crosses the edge", "sticks", "end"]
    assert (rolls[0]["to"], slips[0]["to"]) == ("rolling", "sliding")


def test_jerks_of_the_paper_are_jumps_of_its_velocity(course):
    times = [e["time"] for e in course("ball-on-paper", "jerked")["events"] if e["kind"] == "jerk"]
    assert times == pytest.approx([0.3, 0.6, 0.9])


def test_under_a_yanked_tablecloth_the_ball_moves_by_less_than_a_millimetre(course):
    far = course("ball-on-paper", "tablecloth")["extremes"]["x"]
    assert 0 < far["max"] - far["min"] < 1e-3


def test_nutations_with_loops_cusps_and_neither(course):
    least = {case: course("gyroscope", case)["extremes"]["phi_dot"]["min"] for case in "abc"}
    assert least["a"] > 0
    assert least["b"] < 0
    assert least["c"] == 0


def test_where_the_pivot_carries_the_weight_the_centre_has_no_vertical_acceleration(document):
    found = document("run", "gyroscope", "--case", "c", "--extremes", "theta_dot")
    times = [e["time"] for e in found["events"] if e["kind"] == "F_z-M*g"]
    # d(sin θ θ̇)/dt = 0 there: one such instant in each half of the nutation
    assert len(times) == 7
    forces = found["extremes"]["F_z"]
    assert forces["min"] < 0.5 * 9.81 < forces["max"]


def test_a_gyroscope_in_a_vertical_plane_falls_as_a_pendulum_does(course):
    """A quarter period of a pendulum that swings to π - 0.1 is √(I/Mga) K(cos² 0.05)."""
    found = course("gyroscope/vertical-plane", "falls")
    moment, torque = 3.5e-4 + 0.5 * 0.06**2, 0.5 * 9.81 * 0.06
    (falls,) = [e["time"] for e in found["events"] if e["kind"] == "theta-pi"]
    assert falls == pytest.approx(sqrt(moment / torque) * ellipk(cos(0.05) ** 2), rel=1e-9)
    assert found["period"] == pytest.approx(2 * pi * sqrt(moment / torque))


def test_the_words(polhode):
    _, out, _ = polhode("run", "spinning-coin", "--case", "falls")
    flat = " ".join(out.split())
    assert "which is not so here. theta begins 1 deg from it and leaves it by up to 29.5276" in flat
    _, out, _ = polhode("run", "marble-on-turntable", "--case", "stays")
    assert "omega_x = 43.1969 rad/s at the start, 43.1969 rad/s at the end" in out


def test_options_take_the_place_of_those_of_the_case(document):
    words = ("run", "ball-on-paper", "--case", "rolls-off", "--start", "v_x=0.3", "--mu", "0.5")
    found = document(*words)
    assert found["parameters"]["mu"] == 0.5
    assert found["compared"]["v_x"]["start"] == 0.3
    assert found["compared"]["v_x"]["end"] == pytest.approx(0.3)


def test_other_names_are_refused(polhode):
    code, _, err = polhode("run", "gyroscope", "--case", "d")
    assert code == 2
    assert "a, b, c" in err
    code, _, err = polhode("run", "tennis-racquet", "--case", "a")
    assert code == 2
    assert "named cases" in err
    code, _, err = polhode("run", "gyroscope", "--extremes", "F_x")
    assert code == 2
    assert "F_z" in err


def test_time_is_counted_in_a_period(document, polhode):
    words = ("run", "gyroscope", "--duration", "0.2s")
    exact = document("exact", "gyroscope", "--duration", "0.2s")["period"]
    assert document(*words, "--period", "exact")["period"] == pytest.approx(exact)
    found = document(*words, "--period", "2*sqrt(a/g)")["period"]
    assert found == pytest.approx(2 * sqrt(0.06 / 9.81))
    code, _, err = polhode(*words, "--period", "3m")
    assert code == 2
    assert "expected a quantity in s" in err


def test_more_digits_change_nothing_in_the_words(document):
    words = ("run", "gyroscope", "--case", "c", "--duration", "0.1s")
    double, finer = (document(*words, *more) for more in ((), ("--precision", "quadruple")))
    for name, found in double["extremes"].items():
        assert finer["extremes"][name]["max"] == pytest.approx(found["max"], rel=1e-9), name
