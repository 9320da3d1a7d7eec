"""Systems of the catalogue, many at a time and one by one."""

import numpy as np
import pytest

from polhode.catalogue import CATALOGUE, numbers_of
from polhode.derive import automaton
from polhode.simulate import simulate
from polhode.study import EndMode, Final, TimeSeries, ensemble

SPREAD = 1e-3


@pytest.mark.parametrize("name", ["ball-on-paper", "gyroscope", "marble-on-turntable/tilted"])
def test_members_agree_with_single_runs(name):
    entry = CATALOGUE[name]
    modes = automaton(entry.build())
    numbers = numbers_of(entry, modes.together.equations)
    random = np.random.default_rng(len(name))
    jitter = {key: 1 + SPREAD * random.standard_normal(8) for key in numbers.start}
    starts = {key: value * jitter[key] for key, value in numbers.start.items()}
    time = min(numbers.duration, 0.5)
    names = [s.published for s in modes.together.equations.speeds]
    outputs = {key: Final(key) for key in (*names, "energy")}
    series = {"half": TimeSeries(names[0], (time / 2,))}
    found = ensemble(
        modes, numbers.parameters, starts, time, forcing=numbers.forcing,
        outputs={**outputs, **series, "mode": EndMode()},
    )  # fmt: skip
    start = {key: float(values[1]) for key, values in starts.items()}
    run = simulate(modes, numbers.parameters, start, time, forcing=numbers.forcing)
    assert found.failed == 0, found.failures
    assert found.named("mode")[1] == run.mode
    for key in outputs:
        size = float(np.max(np.abs(run.evaluate(key, np.linspace(0, time, 20))))) or 1.0
        assert found[key][1] == pytest.approx(float(run.evaluate(key, time)), abs=1e-10 * size)
    size = float(np.max(np.abs(run.evaluate(names[0], np.linspace(0, time, 20))))) or 1.0
    half = float(run.evaluate(names[0], time / 2))
    assert found["half"][1, 0] == pytest.approx(half, abs=1e-10 * size)
