"""Members that slip and stick go side by side in every mode, with the answers of single runs."""

import numpy as np
import pytest

from polhode.derive import automaton
from polhode.model import with_friction
from polhode.simulate import simulate
from polhode.study import (
    EndMode,
    EventCount,
    EventKinds,
    EventTime,
    EventTimes,
    Fate,
    Final,
    Reason,
    TimeSeries,
    ensemble,
    members_of,
)
from polhode.study._ensemble_runner import BatchRunner, EnsembleSpec, ResultChunk
from study.examples import NUMBERS, Case, disk, rough_balls, rough_disks

MEMBERS, ALONE = 20, 5
EVENT_OUTPUTS = {
    "mode": EndMode(),
    "kinds": EventKinds(16),
    "times": EventTimes(16),
    "sticks": EventCount("sticks"),
    "again": EventTime("slips", occurrence=1),
    "fate": Fate(),
}


def nobody(count: int) -> None: ...


@pytest.mark.parametrize("case", [rough_disks(), rough_balls()], ids=lambda case: case.name)
def test_members_are_single_runs(case: Case):
    looks = tuple(case.duration * share for share in (0.0, 0.3, 0.7, 1.0))
    series = {f"{name} seen": TimeSeries(name, looks) for name in case.outputs}
    found = ensemble(
        case.modes, case.parameters, case.start, case.duration, seed=2, count=MEMBERS,
        outputs={**case.outputs, **series, **EVENT_OUTPUTS}, **case.options,
    )  # fmt: skip
    assert found.failed == 0
    assert np.sum(found["sticks"]) > MEMBERS / 10
    for i in range(ALONE):
        parameters, start = case.member(found, i)
        run = simulate(case.modes, parameters, start, case.duration, **case.options)
        happened = run.events[1:-1]
        kinds = np.reshape(found.named("kinds"), (MEMBERS, -1))[i]
        assert [kind for kind in kinds if kind] == [event.kind for event in happened]
        times = found["times"][i, : len(happened)]
        assert times == pytest.approx([e.time for e in happened], abs=1e-11)
        slips = [event.time for event in happened if event.kind == "slips"]
        assert np.isnan(found["again"][i]) == (len(slips) < 2)
        assert found.named("mode")[i] == run.mode
        for name in case.outputs:
            size = 1 + abs(run.final[name])
            assert found[name][i] == pytest.approx(run.final[name], abs=1e-10 * size)
            there = [time for time in looks if time <= run.duration]
            expected = run.evaluate(name, np.array(there))
            seen = found[f"{name} seen"][i, : len(there)]
            assert seen == pytest.approx(expected, abs=1e-10 * (1 + np.max(np.abs(expected))))


@pytest.mark.parametrize("case", [rough_disks(), rough_balls()], ids=lambda case: case.name)
def test_no_member_is_followed_from_its_start_again(case: Case):
    order = EnsembleSpec(case.modes, case.duration, {**case.outputs, **EVENT_OUTPUTS}, case.options)
    members = members_of(case.parameters, case.start, MEMBERS, 2)
    alone = BatchRunner(order).follow(members, ResultChunk.empty(order, MEMBERS), nobody)
    assert len(alone) == 0


def test_members_that_fly_land_and_roll_on():
    rough = automaton(with_friction(disk(), 0.25, 0.3))
    starts = {"theta": 1.2, "z": np.linspace(0.0285, 0.035, 9), "omega_3": 20.0}
    outputs = {"z": Final("z"), "omega_3": Final("omega_3"), "kinds": EventKinds(8)}
    found = ensemble(rough, NUMBERS, starts, 0.1, outputs=outputs)
    for i in (1, 8):
        run = simulate(rough, NUMBERS, {**starts, "z": found["z_start"][i]}, 0.1)
        kinds = np.reshape(found.named("kinds"), (9, -1))[i]
        assert [kind for kind in kinds if kind] == [event.kind for event in run.events[1:-1]]
        assert found["z"][i] == pytest.approx(run.final["z"], rel=1e-10)
        assert found["omega_3"][i] == pytest.approx(run.final["omega_3"], rel=1e-10)


def test_a_coefficient_that_no_contact_has_is_recorded():
    case = rough_balls()
    friction = np.linspace(-0.1, 0.3, 9)
    found = ensemble(
        case.modes, {**case.parameters, "mu": friction}, {"v_x": 0.1}, 0.1, **case.options
    )
    assert np.array_equal(found.reason == Reason.DECLARATION, friction < 0)
    assert "mu = -0.1" in found.failures[0]


#: Slips that turn round within a few of the shortest steps, and one that only comes near to it.
TURNS = {
    "theta": [0.6296978156520171, 0.8161852831688498, 0.6289972429524758],
    "phi_dot": [-0.9008231900323654, -2.5613704836114413, -2.2187715714192136],
    "omega_3": [14.633594164788322, 5.356721251729089, 11.546250448057028],
}


@pytest.mark.parametrize("member", [0, 1, 2])
def test_a_slip_that_all_but_vanishes_sticks(member: int):
    case = rough_disks()
    start = {name: values[member] for name, values in TURNS.items()}
    run = simulate(case.modes, case.parameters, start, case.duration, **case.options)
    starts = {name: [*values] * 4 for name, values in TURNS.items()}
    outputs = {**case.outputs, "times": EventTimes(4)}
    found = ensemble(
        case.modes, case.parameters, starts, case.duration, outputs=outputs, **case.options
    )
    times = [event.time for event in run.events[1:-1]]
    assert found["times"][member, : len(times)] == pytest.approx(times, abs=1e-11)
    for name in case.outputs:
        assert found[name][member] == pytest.approx(run.final[name], rel=1e-10)
