"""Motions that are kept and taken up again: the same at every instant, through every mode."""

import json
from dataclasses import replace

import numpy as np
import pytest

import polhode as ph
from polhode.base import StoreError
from polhode.simulate import Trajectory
from polhode.simulate._trajectory import archive_of, samples_of, unit_of
from polhode.simulate.files._archive import Archive
from polhode.simulate.files._saved import load, trajectory_of
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.forcing._samples import sampled

m, r, k, g, mu, a = ph.symbols("m r k g mu a", positive=True)
lab = ph.Frame("lab")


def ball_on_sheet() -> ph.System:
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    x, y = ph.functions("X Y")
    on = ph.Sheet(lab, motion=(x, y))
    return ph.System(ph.Coulomb(ball, on=on, mu=mu, name="sheet"), ph.Gravity(g), name="yanked")


def path() -> tuple[Pieces, Pieces]:
    """Pulled slowly, then yanked back."""
    times = np.concatenate([np.linspace(0.1, 0.5, 9), np.linspace(0.5, 0.8, 7)])
    along = np.where(np.arange(16) < 9, (times - 0.1) ** 2, 0.16 - (times - 0.5))
    return sampled(times, along, starts=[9]), sampled(times, 0 * times, starts=[9])


@pytest.fixture(scope="module")
def yanked() -> Trajectory:
    x, y = path()
    values = {m: 0.05, r: 0.02, k: 0.4, g: 9.81, mu: 0.05}
    return ph.simulate(
        ball_on_sheet(), values, {"v_y": 0.2}, 1.2, forcing={"X": x, "Y": y}, samples=101
    )


def wheel() -> ph.System:
    theta, phi = ph.coordinates("theta phi")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    disk = ph.disk("wheel", mass=m, radius=a, axes=axes)
    return ph.System(ph.Rolling(disk, on=ph.Plane(lab)), ph.Gravity(g))


@pytest.fixture(scope="module")
def rolled() -> Trajectory:
    start = {"theta": 1.3, "phi_dot": 0.5, "omega_3": 15.0}
    watched = {"bare": ph.speeds("omega_3")[0] ** 2}
    return ph.simulate(wheel(), {m: 1, a: 0.1, g: 9.81}, start, 8.0, invariants=watched)


def swung() -> Trajectory:
    (alpha,) = ph.coordinates("alpha")
    rod = ph.rod("rod", mass=m, length=a, axes=lab.rotated(alpha, "x"), axis="z")
    system = ph.System(ph.Pivot(rod, at=rod.axes["z"] * (a / 2)), ph.Gravity(g))
    return ph.simulate(system, {m: 1, a: 1, g: 9.81}, {"alpha": 1.0}, 2.0)


@pytest.fixture(scope="module")
def bounced() -> Trajectory:
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    floor = ph.Coulomb(ball, on=ph.Plane(lab), mu=mu, name="floor", restitution=0.6)
    values = {m: 0.05, r: 0.02, k: 0.4, g: 9.81, mu: 0.1}
    start = {"z": 0.02, "v_z": 0.5, "v_x": 1.5}
    return ph.simulate(ph.System(floor, ph.Gravity(g)), values, start, 1.0, samples=101)


def kept(path, run: Trajectory) -> Trajectory:
    run.save(path / "motion.h5")
    return load(path / "motion.h5")


def assert_same(first: Trajectory, second: Trajectory) -> None:
    assert [e.as_json() for e in first.events] == [e.as_json() for e in second.events]
    assert (first.duration, first.mode, first.assumed) == (
        second.duration,
        second.mode,
        second.assumed,
    )
    assert np.array_equal(first.t, second.t)
    times = np.linspace(0, first.duration, 500)
    before, after = (run.table(first.quantities, times) for run in (first, second))
    for name in first.quantities:
        scale = np.max(np.abs(before[name])) or 1.0
        assert after[name] == pytest.approx(before[name], abs=1e-15 + 3e-14 * scale), name
    for one, other in zip(first.events, second.events, strict=True):
        assert other.state_before == pytest.approx(one.state_before, abs=3e-13)
        assert other.state_after == pytest.approx(one.state_after, abs=3e-13)


def test_a_motion_with_slip_and_velocity_jumps(tmp_path, yanked):
    assert {"slips", "sticks", "jerk"} <= {event.kind for event in yanked.events}
    again = kept(tmp_path, yanked)
    assert_same(yanked, again)
    assert again.drift.energy < 1e-13
    assert again.parameters == yanked.parameters


def test_a_motion_of_many_impacts(tmp_path, bounced):
    assert len(bounced.segments) > 20
    again = kept(tmp_path, bounced)
    assert_same(bounced, again)
    times = np.linspace(0, 1, 400)
    for name in ("x", "v_x", "omega_y", "F_z", "power_floor", "slip_x_floor", "work"):
        first, second = bounced.evaluate(name, times), again.evaluate(name, times)
        assert np.max(np.abs(second - first)) <= 1e-14 * (1 + np.max(np.abs(first))), name


def test_a_motion_in_one_mode_of_a_contact(tmp_path):
    modes = ph.automaton(ball_on_sheet())
    equations = modes.mode(modes.named("flight")).equations
    run = ph.simulate(equations, {m: 1, r: 1, k: 0.4, g: 9.81}, {"v_z": 2.0}, 1.0)
    again = kept(tmp_path, run)
    assert_same(run, again)
    assert again.final["z"] == pytest.approx(2 - 9.81 / 2)


def test_a_rolling_wheel_whose_angles_are_turned_back(tmp_path, rolled):
    again = kept(tmp_path, rolled)
    assert_same(rolled, again)
    assert list(again.invariants) == ["bare"]
    assert np.allclose(again["bare"], again["omega_3"] ** 2)


def test_a_system_without_contacts(tmp_path):
    run = swung()
    again = kept(tmp_path, run)
    assert_same(run, again)
    assert again.equations.motion == run.equations.motion


def test_a_loaded_motion_is_saved_identically(tmp_path, yanked):
    first = archive_of(yanked)
    second = archive_of(trajectory_of(first))
    assert first.declaration == second.declaration
    assert first.details == second.details
    for one, other in zip(first.stretches, second.stretches, strict=True):
        assert one.states == other.states
        assert one.constants == other.constants
        assert np.array_equal(one.steps, other.steps)


# -- samples ---------------------------------------------------------------------------------------


def test_samples_have_units(rolled):
    samples = samples_of(rolled)
    units = {name: sampled.unit for name, sampled in samples.items()}
    assert units["theta"] == "rad"
    assert units["theta_dot"] == units["omega_3"] == "rad/s"
    assert units["x"] == "m"
    assert units["F_z"] == "N"
    assert units["energy"] == "J"
    assert units["bare"] == "1/s^2"
    assert np.array_equal(samples["theta"].values, rolled["theta"])
    assert unit_of(rolled, "theta_ddot") == "rad/s^2"
    assert list(samples_of(rolled, ["F_z"])) == ["F_z"]


def test_couples_are_in_newton_metres():
    assert unit_of(swung(), "F_x") == "N"


def test_friction_is_a_force(yanked):
    assert unit_of(yanked, "F_x") == "N"
    assert unit_of(yanked, "X") == "m"


# -- what does not fit -----------------------------------------------------------------------------


def changed(archive: Archive, **details) -> Archive:
    return replace(archive, details={**archive.details, **details})


BAD = {
    "no details": lambda archive: replace(archive, details={}),
    "no declaration": lambda archive: replace(archive, declaration=""),
    "another system": lambda archive: replace(archive, declaration=archive_of(swung()).declaration),
    "no events": lambda archive: replace(archive, events=({"time": 0.0},)),
    "forcing that is none": lambda archive: changed(archive, forcing="{}"),
    "no forcing": lambda archive: changed(
        archive, forcing=json.dumps({**json.loads(archive.details["forcing"]), "parts": []})
    ),
    "angles of nothing": lambda archive: changed(archive, turned={"here": "there"}),
    "a duration in words": lambda archive: changed(archive, duration="long"),
    "an unknown mode": lambda archive: replace(
        archive, stretches=tuple(replace(s, mode="floating") for s in archive.stretches)
    ),
    "unknown states": lambda archive: replace(
        archive, stretches=tuple(replace(s, states=("x",)) for s in archive.stretches)
    ),
    "missing constants": lambda archive: replace(
        archive, stretches=tuple(replace(s, constants={}) for s in archive.stretches)
    ),
    "no motion": lambda archive: replace(archive, stretches=()),
}


@pytest.mark.parametrize("name", BAD)
def test_inconsistent_archives_are_refused(yanked, name):
    archive = archive_of(yanked)
    with pytest.raises(StoreError):
        trajectory_of(BAD[name](archive))
