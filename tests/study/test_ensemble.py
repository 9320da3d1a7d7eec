"""Ensembles give the answers of single runs, whichever way their members are followed."""

import numpy as np
import pytest
import scipy.stats as st

from polhode.base import DeclarationError, NumericError, UnitError
from polhode.derive import automaton, derive
from polhode.simulate import simulate
from polhode.study import (
    Duration,
    EndMode,
    EventCount,
    EventKinds,
    EventTime,
    EventTimes,
    Fate,
    Final,
    Maximum,
    Minimum,
    Reason,
    TimeSeries,
    ensemble,
)
from study.examples import FLAT, NUMBERS, STARTS, disk, rough_disk

EVERYTHING = {
    "theta": Final("theta"),
    "x": Final("x"),
    "normal": Final("F_z"),
    "when": TimeSeries("omega_3", (0.0, 0.3, 0.9, 5.0)),
    "mode": EndMode(),
    "fate": Fate(),
    "duration": Duration(),
    "flat": EventTime("goes flat"),
    "flats": EventCount("goes flat"),
    "times": EventTimes(2),
    "kinds": EventKinds(2),
}
HERE = {"near_flat": FLAT, "until": ("lifts off",)}


@pytest.fixture(scope="module")
def rolling():
    return automaton(disk())


def single(subject, member, found, **options):
    """The same member by itself."""
    parameters = {n: v.value(member) for n, v in found.numbers.items() if n in NUMBERS}
    start = {
        n.removesuffix("_start"): v.value(member)
        for n, v in found.numbers.items()
        if n not in NUMBERS
    }
    return simulate(subject, NUMBERS | parameters, start, 1.0, **options)


def test_members_agree_with_single_runs(rolling):
    found = ensemble(rolling, NUMBERS, STARTS, 1.0, outputs=EVERYTHING, count=24, seed=1, **HERE)
    assert found.failed == 0
    assert {"none of these", "goes flat"} <= set(found.named("fate"))
    for member in range(0, 24, 4):
        run = single(rolling, member, found, near_flat=FLAT)
        if run.duration < 1.0 and run.mode != "near-flat":
            continue
        assert found["theta"][member] == pytest.approx(run.final["theta"], rel=1e-10)
        assert found["x"][member] == pytest.approx(run.final["x"], rel=1e-10, abs=1e-12)
        assert found["normal"][member] == pytest.approx(run.final["F_z"], rel=1e-10)
        assert found["duration"][member] == pytest.approx(run.duration, rel=1e-12)
        for k, time in enumerate((0.0, 0.3, 0.9)):
            if time <= run.duration:
                expected = float(run.evaluate("omega_3", time))
                assert found["when"][member, k] == pytest.approx(expected, rel=1e-10, abs=1e-11)
    assert np.all(np.isnan(found["when"][:, 3]))


def test_side_by_side_and_one_by_one_agree(rolling):
    """An output that needs the whole path makes every member be followed by itself."""
    quick = ensemble(rolling, NUMBERS, STARTS, 1.0, outputs=EVERYTHING, count=8, seed=5, **HERE)
    slowly = {**EVERYTHING, "top": Maximum("theta")}
    slow = ensemble(rolling, NUMBERS, STARTS, 1.0, outputs=slowly, count=8, seed=5, **HERE)
    for name in EVERYTHING:
        assert quick[name] == pytest.approx(slow[name], rel=1e-10, abs=1e-11, nan_ok=True), name


def test_the_bits_of_a_member_do_not_depend_on_the_other_members(rolling):
    """Lanes are taken up again one by one, in whatever order threads and motions come to it."""
    angles, spins = np.linspace(0.1, 1.5, 40), np.linspace(40.0, 0.0, 40)
    outputs = {"theta": Final("theta"), "when": TimeSeries("omega_3", (0.01, 0.02, 0.7))}

    def found(rows):
        start = {"theta": angles[rows], "omega_3": spins[rows], "phi_dot": 1.0}
        return ensemble(rolling, NUMBERS, start, 1.0, outputs=outputs, **HERE)

    whole, part = found(slice(None)), found(slice(33, 2, -1))
    assert whole.failed == 0
    for name in outputs:
        assert np.array_equal(whole[name][33:2:-1], part[name], equal_nan=True)


def test_motions_that_cannot_be_continued_do_not_stop_the_others():
    """Flat after a while, in equations that end there: beside them the others go on."""
    rolls = np.arange(24) % 3 > 0
    falling = {"theta": np.where(rolls, 1.2, 0.4), "omega_3": np.where(rolls, 30.0, 0.0)}
    found = ensemble(derive(disk()), NUMBERS, falling, 1.0, outputs=["theta"])
    assert np.array_equal(found.done, rolls)
    assert len(set(found["theta"][found.done])) == 1


def test_switching_members_are_single_runs():
    rough = automaton(rough_disk())
    outputs = ["omega_3", "mode"]
    starts = {"theta": [1.0, 1.2], "phi_dot": [3.0, 1.0], "omega_3": [10.0, 14.0]}
    found = ensemble(rough, NUMBERS, starts, 0.35, outputs=outputs)
    switched = 0
    for member in range(2):
        start = {name: values[member] for name, values in starts.items()}
        run = simulate(rough, NUMBERS, start, 0.35)
        switched += len(run.events) > 2
        assert found["omega_3"][member] == pytest.approx(run.final["omega_3"], rel=1e-10)
        assert found.named("mode")[member] == run.mode
    assert switched


def test_equations_are_kept_to():
    equations = derive(disk())
    found = ensemble(equations, NUMBERS, STARTS, 1.0, outputs=["theta", "energy"], count=8, seed=2)
    for member in (0, 5):
        run = single(equations, member, found)
        assert found["theta"][member] == pytest.approx(run.final["theta"], rel=1e-10)
        assert found["energy"][member] == pytest.approx(run.final["energy"], rel=1e-10)


def test_extremes_are_found_between_steps():
    equations = derive(disk())
    start = {"theta": [1.0, 1.3], "omega_3": 30.0, "phi_dot": 1.0}
    outputs = {"top": Maximum("theta"), "bottom": Minimum("theta")}
    found = ensemble(equations, NUMBERS, start, 0.2, outputs=outputs)
    run = simulate(equations, NUMBERS, {**start, "theta": 1.3}, 0.2, samples=20_001)
    assert found["top"][1] == pytest.approx(run["theta"].max(), rel=1e-8)
    assert found["bottom"][1] == pytest.approx(run["theta"].min(), rel=1e-8)
    assert found["top"][1] >= run["theta"].max()


def test_draws_depend_on_the_seed_and_the_name_alone(rolling):
    first = ensemble(rolling, NUMBERS, STARTS, 0.01, count=4, seed=7)
    more = {**STARTS, "theta_dot": st.norm(0, 1)}
    second = ensemble(rolling, NUMBERS, more, 0.01, count=4, seed=7)
    third = ensemble(rolling, NUMBERS, STARTS, 0.01, count=4, seed=8)
    for name in STARTS:
        assert np.array_equal(first[name], second[name])
        assert not np.array_equal(first[name], third[name])
    assert first.seed == 7
    assert ensemble(rolling, NUMBERS, STARTS, 0.01, count=2).seed >= 0


def test_units_stand_beside_the_values(rolling):
    start = {"theta": ([60.0, 80.0], "deg"), "omega_3": ["300 rpm", "100 rpm"]}
    found = ensemble(rolling, NUMBERS, start, 0.1, outputs=["theta"])
    run = simulate(rolling, NUMBERS, {"theta": "80 deg", "omega_3": "100 rpm"}, 0.1)
    assert found["theta"][1] == pytest.approx(run.final["theta"], rel=1e-12)
    assert found.to_xarray()["theta_start"].attrs["units"] == "deg"


def test_a_member_that_fails_does_not_stop_the_rest(rolling):
    start = {"theta": [1.0, 0.0, np.nan, 1.2], "omega_3": 20.0}
    found = ensemble(rolling, NUMBERS, start, 0.1, outputs=["theta", "mode"])
    assert list(found.done) == [True, False, False, True]
    assert found.reason[2] == Reason.UNIT
    assert found.failed == 2
    assert "theta" in found.failures[1]
    assert np.isnan(found["theta"][1])
    assert found.named("mode")[1] == ""
    run = simulate(rolling, NUMBERS, {"theta": 1.2, "omega_3": 20.0}, 0.1)
    assert found["theta"][3] == pytest.approx(run.final["theta"], rel=1e-12)


def test_impossible_numbers_are_recorded(rolling):
    found = ensemble(rolling, {**NUMBERS, "a": [0.03, -0.01, 0.02]}, {"theta": 1.2}, 0.01)
    assert list(found.reason) == [Reason.DONE, Reason.DECLARATION, Reason.DONE]
    assert "a = -0.01" in found.failures[1]


def test_processes_give_the_same(rolling):
    outputs = {"theta": Final("theta"), "top": Maximum("theta")}
    one, two = (
        ensemble(rolling, NUMBERS, STARTS, 0.05, outputs=outputs, count=12, seed=3, workers=w)
        for w in (1, 2)
    )
    assert np.array_equal(one["theta"], two["theta"])
    assert np.array_equal(one["top"], two["top"])


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"start": {"theta": 1.0}}, DeclarationError, "unknown number of members"),
        ({"start": {"theta": [1.0, 1.1], "omega_3": [1.0]}}, DeclarationError, "do not agree"),
        ({"start": {"theta": [1.0]}, "count": 2}, DeclarationError, "do not agree"),
        ({"start": {"theta": np.ones((2, 2))}}, DeclarationError, "shape"),
        ({"outputs": []}, DeclarationError, "no outputs"),
        ({"workers": 0}, DeclarationError, "0 workers"),
        ({"seed": -1}, DeclarationError, "seed"),
        ({"duration": -1.0}, UnitError, "duration"),
        ({"tolerance": 2.0}, NumericError, "tolerance"),
    ],
)
def test_invalid_arguments_are_refused(rolling, change, error, words):
    asked = {"parameters": NUMBERS, "start": {"theta": [1.0, 1.1]}, "duration": 0.1} | change
    with pytest.raises(error, match=words):
        ensemble(rolling, **asked)
