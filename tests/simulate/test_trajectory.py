"""What can be read from a trajectory, and how it is written down."""

import csv
import json
import os

import numpy as np
import pytest

from polhode.algebra import coordinates, cos, sin, time
from polhode.base import DeclarationError, NumericError, StoreError
from polhode.simulate import simulate
from simulate.examples import ByHand, oscillator, pendulum, wheel

UNITS = {"m": 1, "l": 1, "g": 1}


@pytest.fixture(scope="module")
def run():
    return simulate(pendulum(), UNITS, {"theta": 1.2}, 5, samples=11)


def test_quantities_are_read_by_name_symbol_and_expression(run):
    (theta,) = coordinates("theta")
    assert run["theta"].shape == run.t.shape == (11,)
    assert run[theta] == pytest.approx(run["theta"])
    assert run.evaluate(cos(theta) ** 2) == pytest.approx(np.cos(run["theta"]) ** 2)
    assert run.evaluate(theta.dt().dt()) == pytest.approx(-np.sin(run["theta"]))
    assert run.evaluate("theta", 2.5) == pytest.approx(run["theta"][5])
    assert run.evaluate("t", [[0.0, 1.0], [2.0, 3.0]]).tolist() == [[0, 1], [2, 3]]
    assert run["g"].tolist() == [1.0] * 11


def test_several_quantities_are_computed_together(run):
    table = run.table(["theta", "N"], np.array([1.0, 2.0]))
    assert table["N"] == pytest.approx(run.evaluate("N", np.array([1.0, 2.0])))
    assert set(run.at(1.0)) == {"theta", "theta_dot"}


def test_the_final_state(run):
    assert run.final["theta"] == run["theta"][-1]
    assert set(run.final) == {"theta", "theta_dot", "N", "S", "energy", "mode"}
    assert run.final["mode"] == "as declared"
    assert [event.as_json() for event in run.events] == [
        {"time": 0.0, "kind": "start", "from": None, "to": "as declared"},
        {"time": 5.0, "kind": "end", "from": "as declared", "to": None},
    ]
    assert set(run.seconds) == {"derive", "compile", "integrate"}
    json.dumps([run.final, run.drift.as_json(), dict(run.assumed), dict(run.seconds)])


def test_rates_of_all_orders_up_to_accelerations_are_known():
    run = simulate(wheel(), {"a": 0.1}, {"u": 1, "Omega": 2}, 3)
    assert run["x_ddot"] == pytest.approx(-2 * np.sin(2 * run.t), abs=1e-12)
    assert run["v_x_dot"] == pytest.approx(run["x_ddot"])
    assert run["psi_ddot"] == pytest.approx(4 * np.sin(2 * run.t), abs=1e-12)


def test_prescribed_functions_are_quantities_too():
    drive = {"X": sin(time) / 2}
    run = simulate(oscillator(), {"m": 1, "k": 3}, {}, 3, forcing=drive)
    assert run["X"] == pytest.approx(np.sin(run.t) / 2)
    (end,) = run.equations.functions
    assert run[end.derivative()] == pytest.approx(np.cos(run.t) / 2)


def test_unknown_quantities_and_times_outside_are_refused(run):
    with pytest.raises(DeclarationError, match="did you mean theta"):
        run["theto"]
    with pytest.raises(DeclarationError, match="phi has no value"):
        run[coordinates("phi")[0]]
    with pytest.raises(DeclarationError, match="rate of an acceleration"):
        run[coordinates("theta")[0].dt().dt().dt()]
    with pytest.raises(NumericError, match="within the motion"):
        run.evaluate("theta", 5.1)


def test_an_undetermined_reaction_is_named_and_not_made_up():
    loose = ByHand(**{**vars(pendulum()), "undetermined": ("S",)})
    run = simulate(loose, UNITS, {"theta": 1}, 1)
    assert run.reactions == ("N",)
    assert "S" not in run.final
    with pytest.raises(NumericError, match="S is not determined"):
        run["S"]


def test_a_table_is_written_to_the_last_digit(run, tmp_path):
    path = tmp_path / "run.csv"
    run.to_csv(path)
    first, *rest = path.read_text().splitlines()
    origin = json.loads(first.removeprefix("# polhode "))
    assert origin["system"] == "by hand"
    assert origin["parameters"] == {"g": 1.0, "l": 1.0, "m": 1.0}
    assert origin["assumed"] == {"theta_dot": 0.0}
    rows = list(csv.DictReader(rest))
    assert list(rows[0]) == ["t", "theta", "theta_dot", "N", "S", "energy"]
    assert [float(row["theta"]) for row in rows] == run["theta"].tolist()


def test_chosen_columns_replace_a_file(run, tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("before")
    run.to_csv(path, ["N", "work"])
    assert path.read_text().splitlines()[1] == "t,N,work"
    assert os.listdir(tmp_path) == ["run.csv"]


def test_a_file_that_cannot_be_written_is_reported_and_not_left(run, tmp_path):
    with pytest.raises(StoreError, match="cannot be written"):
        run.to_csv(tmp_path / "nowhere" / "run.csv")
    with pytest.raises(StoreError, match="cannot be written"):
        run.to_csv(tmp_path)
    assert os.listdir(tmp_path) == []


class Counting:
    """A listener that counts."""

    def __init__(self):
        self.began, self.steps, self.finished = [], 0, 0

    def begin(self, task, total=None):
        self.began.append(task)

    def advance(self, steps=1):
        self.steps += steps

    def finish(self):
        self.finished += 1


def test_progress_is_reported(integrator):
    listener = Counting()
    simulate(pendulum(), UNITS, {"theta": 1}, 5, progress=listener)
    assert listener.began == ["integrating"]
    assert listener.steps > 5
    assert listener.finished == 1
