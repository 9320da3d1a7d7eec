"""Members on a sheet whose motion was sampled go side by side too, from knot to knot."""

from math import sin

import numpy as np
import pytest

from polhode.algebra import symbol
from polhode.base import DeclarationError
from polhode.catalogue import CATALOGUE
from polhode.derive import automaton, derive
from polhode.model import with_friction
from polhode.simulate import sampled, simulate
from polhode.study import EventKinds, EventTimes, Final, TimeSeries, ensemble, members_of
from polhode.study._ensemble_runner import BatchRunner, EnsembleSpec, ResultChunk

MEMBERS = 12
NUMBERS = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81}
NAMES = ("x", "y", "v_x", "v_y", "omega_z")
LOOKS = (0.0, 0.11, 0.25, 0.5, 0.61)
TIMES = np.linspace(0.0, 0.5, 11)

TORN = {
    "X": sampled(TIMES, 0.05 * np.sin(8 * TIMES) ** 2, starts=(6,)),
    "Y": sampled(TIMES + 0.06, 0.04 * np.sin(5 * TIMES)),
    "chi": 0,
}
PYTHON = {"X": lambda t: 0.03 * sin(9 * t) ** 2, "Y": 0, "chi": 0}


def ball():
    return CATALOGUE["ball-on-paper"].build()


def rough():
    mu = symbol("mu")
    return automaton(with_friction(ball(), mu, 1.2 * mu))


def case(subject):
    """Numbers and starts: balls of all frictions where there is friction."""
    random = np.random.default_rng(4)
    friction = {"mu": random.uniform(0.05, 0.3, MEMBERS)} if subject == "rough" else {}
    speeds = random.normal(0, 0.2, (2, MEMBERS))
    return {**NUMBERS, **friction}, {"v_x": speeds[0], "v_y": speeds[1]}


@pytest.fixture(scope="module")
def subjects():
    return {"rough": rough(), "rolling": automaton(ball())}


@pytest.mark.parametrize(
    ("subject", "forcing"),
    [("rough", TORN), ("rough", PYTHON), ("rolling", TORN)],
    ids=["rough, torn", "rough, python", "rolling, torn"],
)
def test_members_are_single_runs(subjects, subject, forcing):
    numbers, starts = case(subject)
    outputs = {name: Final(name) for name in NAMES}
    series = {f"{name} seen": TimeSeries(name, LOOKS) for name in NAMES}
    happened = {"kinds": EventKinds(12), "times": EventTimes(12)}
    asked = {**outputs, **series, **happened}
    order = EnsembleSpec(subjects[subject], 0.7, asked, {"forcing": forcing})
    members = members_of(numbers, starts, None, 0)
    alone = BatchRunner(order).follow(
        members, ResultChunk.empty(order, MEMBERS), lambda count: None
    )
    assert len(alone) == 0
    found = ensemble(order.subject, numbers, starts, 0.7, outputs=asked, forcing=forcing)
    kinds = np.reshape(found.named("kinds"), (MEMBERS, -1))
    for i in (0, 7):
        own = [members.parameters_of(i), members.start_of(i)]
        run = simulate(order.subject, *own, 0.7, forcing=forcing)
        events = run.events[1:-1]
        assert [kind for kind in kinds[i] if kind] == [event.kind for event in events]
        times = [event.time for event in events]
        assert found["times"][i, : len(events)] == pytest.approx(times, abs=1e-10)
        for name in NAMES:
            assert found[name][i] == pytest.approx(run.final[name], rel=1e-10, abs=1e-11)
            seen = run.evaluate(name, np.array(LOOKS))
            assert found[f"{name} seen"][i] == pytest.approx(seen, rel=1e-10, abs=1e-11)


def test_equations_are_kept_to():
    equations, sheet = derive(ball()), {**TORN, "X": 0}
    numbers, starts = case("rolling")
    asked = {"x": Final("x"), "v": TimeSeries("v_y", (0.06, 0.3, 0.5))}
    order = EnsembleSpec(equations, 0.5, asked, {"forcing": sheet})
    members = members_of(numbers, starts, None, 0)
    block = ResultChunk.empty(order, MEMBERS)
    assert len(BatchRunner(order).follow(members, block, lambda count: None)) == 0
    run = simulate(equations, numbers, members.start_of(5), 0.5, forcing=sheet)
    assert block.values["x"][5] == pytest.approx(run.final["x"], rel=1e-10)
    seen = run.evaluate("v_y", np.array([0.06, 0.3, 0.5]))
    assert block.values["v"][5] == pytest.approx(seen, rel=1e-10)


def test_equations_alone_cannot_take_a_jerk():
    numbers, starts = case("rolling")
    with pytest.raises(DeclarationError, match="jerks"):
        ensemble(derive(ball()), numbers, starts, 0.7, forcing=TORN, outputs=["x"])
