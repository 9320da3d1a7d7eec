"""A mistake that all members share is reported before any is followed, and leaves nothing."""

import numpy as np
import pytest
import scipy.stats as st

from polhode.algebra import symbol
from polhode.base import DeclarationError, NumericError, ParseError, StoreError, UnitError
from polhode.derive import automaton, derive
from polhode.study import (
    EventTime,
    EventTimes,
    Final,
    Maximum,
    TimeSeries,
    ensemble,
    refine_map,
    sweep,
)
from study.examples import NUMBERS, disk, rough_balls

MISTAKES = [
    ({"start": {"thta": 1.0}}, DeclarationError, "'thta' is no coordinate.*did you mean theta"),
    ({"parameters": {**NUMBERS, "q": 1.0}}, DeclarationError, "'q' is no parameter"),
    ({"parameters": {"m": 0.2}}, DeclarationError, "no value for a, g"),
    ({"outputs": ["thta"]}, DeclarationError, "'thta' is no quantity"),
    ({"outputs": {"top": Maximum("nope")}}, DeclarationError, "'nope' is no quantity"),
    ({"outputs": {"top": 3}}, DeclarationError, "the output 3"),
    ({"outputs": {"when": EventTime("slip")}}, DeclarationError, "'slip' is no event"),
    ({"until": ("slip",)}, DeclarationError, "'slip' is no event.*did you mean slips"),
    ({"near_flat": np.nan}, NumericError, "near_flat = nan"),
    ({"near_flat": -1.0}, NumericError, "near_flat = -1"),
    ({"forcing": {"X": 1}}, DeclarationError, "'X' is no prescribed function"),
    ({"start": {"theta": "1 kg"}}, UnitError, "theta = '1 kg' is a quantity in kg"),
    ({"start": {"theta": "much"}}, UnitError, "'much' is not a value"),
    ({"start": {"theta": symbol("q")}}, DeclarationError, "theta = q without a value for q"),
    ({"parameters": {**NUMBERS, "a": "3 s"}}, UnitError, "a quantity in s; expected .* in m"),
    ({"parameters": {**NUMBERS, "a": -0.03}}, DeclarationError, "a = -0.03 for every member"),
    ({"parameters": {**NUMBERS, "a": np.nan}}, UnitError, "nan is not a value"),
    ({"outputs": {"q": symbol("q") + 1}}, DeclarationError, "'q' is no parameter"),
    ({"workers": "2"}, DeclarationError, "'2' workers"),
    ({"workers": 0}, DeclarationError, "0 workers"),
]


@pytest.fixture(scope="module")
def rolling():
    return automaton(disk())


@pytest.mark.parametrize(("change", "error", "words"), MISTAKES)
def test_by_ensembles(rolling, change, error, words):
    asked = {"parameters": NUMBERS, "start": {"theta": 1.0}, "duration": 0.1, "count": 3} | change
    with pytest.raises(error, match=words):
        ensemble(rolling, **asked)


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        *MISTAKES,
        ({"axes": {"nope": [1.0]}}, DeclarationError, "'nope' is no coordinate"),
        ({"chunk": 0}, DeclarationError, "0 members in a chunk"),
        ({"chunk": "a"}, DeclarationError, "'a' members in a chunk"),
        ({"client": 3}, DeclarationError, "the client 3"),
        ({"address": "rubbish"}, StoreError, "no scheduler answers"),
        ({"axes": {"theta": np.ones(10**5), "psi": np.ones(10**5)}}, DeclarationError, "members"),
    ],
)
def test_by_sweeps(rolling, tmp_path, change, error, words):
    asked = {"axes": {"omega_3": [1.0, 2.0]}, "parameters": NUMBERS, "start": {}} | change
    with pytest.raises(error, match=words):
        sweep(rolling, out=tmp_path / "store", **{"duration": 0.1, "outputs": ["theta"]} | asked)
    assert not (tmp_path / "store").exists()


def test_by_refined_maps(rolling):
    with pytest.raises(DeclarationError, match="'nope' is no coordinate"):
        refine_map(rolling, {"theta": (0.6, 1.5), "nope": (0.0, 16.0)}, NUMBERS, {}, 0.3)


@pytest.mark.parametrize(
    "angles", [(np.ones(9), "kg"), ["1 rad", "2 s"]], ids=["a column", "one of its texts"]
)
def test_units_that_members_have_in_common(rolling, angles):
    with pytest.raises(UnitError, match="theta"):
        ensemble(rolling, NUMBERS, {"theta": angles, "omega_3": 20.0}, 0.1)


@pytest.mark.parametrize(
    ("sheet", "error", "words"),
    [
        ({"X": 0}, DeclarationError, "no motion for Y, chi"),
        ({"X": 0, "Y": 0, "chi": lambda t: 1 / (t - 0.05)}, NumericError, "prescribed motion"),
        ({"X": 0, "Y": 0, "chi": "sin(q)"}, ParseError, "'q' is not known"),
        ({"X": 0, "Y": 0, "chi": []}, NumericError, "not an expression"),
    ],
)
def test_motions_of_supports_on_which_no_member_can_be_followed(sheet, error, words):
    case = rough_balls()
    with pytest.raises(error, match=words):
        ensemble(case.modes, case.parameters, {}, 0.1, count=9, forcing=sheet)


@pytest.mark.parametrize("count", [-1, 0, 2.5, 10**12, True])
def test_members_are_counted_in_whole_numbers(rolling, count):
    with pytest.raises(DeclarationError, match=f"{count} members"):
        ensemble(rolling, NUMBERS, {"theta": st.uniform(1, 0.1)}, 0.1, count=count)


def test_outputs_that_make_no_sense():
    with pytest.raises(DeclarationError, match="-1 events"):
        EventTimes(-1)
    with pytest.raises(NumericError, match="times"):
        TimeSeries("theta", (0.1, -1.0))


def test_names_of_any_mode_are_known(rolling):
    """A height is a coordinate only in flight, a force one of contact; a forcing has its own."""
    found = ensemble(
        rolling, NUMBERS, {"theta": 1.0, "z": 0.1}, 0.01, count=2, outputs=["v_z", "F_z"]
    )
    assert found.failed == 0
    case, w = rough_balls(), symbol("w")
    forcing = {**case.options["forcing"], "chi": w}
    numbers = {**case.parameters, "mu": 0.3, "w": 0.1}
    outputs = {"w": Final("w"), "slip": Final("slip_x_sheet")}
    shaken = ensemble(
        case.modes, numbers, {"v_x": [0.1, 0.2]}, 0.01, forcing=forcing, outputs=outputs
    )
    assert shaken["w"] == pytest.approx([0.1, 0.1])
    kept = ensemble(derive(disk()), NUMBERS, {"theta": [1.0]}, 0.01, outputs=["F_z", "energy"])
    assert kept.failed == 0
