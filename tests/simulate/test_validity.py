"""Motions that cannot be relied on: contacts pull, a side is lost, the energy does not balance."""

import os
import subprocess
import sys
import warnings
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import polhode as ph
from derive.trailers import train
from polhode import DriftWarning, NumericError
from polhode.algebra import ZERO, symbol
from polhode.catalogue import CATALOGUE
from polhode.view import scene
from simulate.examples import oscillator, pendulum

# -- sides that are left, and contacts that pull ---------------------------------------------------

COIN = {"m": 0.2, "a": 0.03, "g": 9.81}


def test_a_disk_that_falls_flat_is_not_carried_through_the_floor():
    """Without spin it falls from 60° like a rod about its rim, and is flat in finite time."""
    rolling = CATALOGUE["rolling-disk"].build()
    with pytest.raises(NumericError, match=r"sin\(theta\) reaches zero at t = 0\.\d+ s"):
        ph.simulate(ph.derive(rolling), COIN, {"theta": "60 deg"}, 2.0)
    fallen = ph.simulate(ph.derive(rolling), COIN, {"theta": "60 deg"}, 0.05)
    assert fallen.final["theta"] > 0


def test_a_contact_that_would_pull_is_named_with_its_time():
    """An eccentric thought: a disk whirled so fast that its centre would be flung up."""
    m, a, g = ph.symbols("m a g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    body = ph.disk("disk", mass=m, radius=a, axes=axes)
    system = ph.System(ph.Rolling(body, on=ph.Plane(lab), name="ground"), ph.Gravity(g))
    start = {"theta": "60 deg", "theta_dot": "40 rad/s"}
    run = ph.simulate(ph.derive(system), COIN, start, 0.01)
    kinds = [event.kind for event in run.events]
    assert kinds == ["start", "ground pulls", "end"]
    pulled = run.evaluate("F_z", np.array([run.events[1].time]))
    assert pulled[0] <= 0


def test_a_rope_that_would_push_is_named_with_its_time():
    """Thrown down from the height of the pivot, its tension vanishes where 3 g L cos θ = -v₀²."""
    m, g, h = ph.symbols("m g h", positive=True)
    lab = ph.Frame("lab")
    bob = ph.point_mass("bob", mass=m, axes=lab)
    system = ph.System(ph.Rope([bob.point(), lab["z"] * h], name="string"), ph.Gravity(g))
    values = {m: 1, g: 9.81, h: 2}
    run = ph.simulate(system, values, {"x": 1, "z": 2, "v_z": -3}, 2.0)
    start, slack, end = run.events
    assert (start.kind, slack.kind, end.kind) == ("start", "string goes slack", "end")
    assert run.at(slack.time)["z"] - 2 == pytest.approx(9 / (3 * 9.81), abs=1e-3)
    taut = ph.simulate(system, values, {"x": 1, "z": 2, "v_z": -6}, 2.0)
    assert [event.kind for event in taut.events] == ["start", "end"]


@pytest.mark.parametrize("push", [{}, {"v_x": 1, "v_x_2": 1, "v_y": 0.3, "v_y_2": 0.3}])
def test_a_rope_without_a_load_is_not_told_to_be_slack(push):
    """Two bodies at rest, or in parallel flight."""
    m = ph.symbol("m", positive=True)
    ends = [ph.point_mass("p", mass=m, axes=ph.Frame("lab"))]
    ends.append(ph.point_mass("q", mass=m, axes=ends[0].axes, tag="2"))
    system = ph.System(ph.Rope([end.point() for end in ends]))
    run = ph.simulate(system, {m: 1}, {"x": 0.1, "x_2": 1.3, "y_2": 0.7, **push}, 2.0)
    assert [event.kind for event in run.events] == ["start", "end"]


def test_an_honest_run_has_only_its_ends():
    rolling = CATALOGUE["rolling-disk"].build()
    run = ph.simulate(rolling, COIN, {"theta": "80 deg", "omega_3": 40}, 1.0)
    assert [event.kind for event in run.events] == ["start", "end"]


# -- balances that are off by more than rounding ---------------------------------------------------

UNITS = {"m": 1, "g": 1, "l": 1}


def unbalanced(share):
    """A pendulum whose energy is off by a share of what gravity has in it."""
    right = pendulum()
    resting = dict.fromkeys(right.speeds, 0)
    return replace(right, energy=right.energy + right.energy.subs(resting) * share)


def test_a_wrong_energy_is_an_error():
    with pytest.raises(NumericError, match=r"a motion that is wrong: the energy balance is off by"):
        ph.simulate(unbalanced(1), UNITS, {"theta": 1}, 10)


@pytest.mark.parametrize("precision", [None, "quadruple"])
def test_a_balance_that_is_slightly_off_is_a_warning(precision):
    share = symbol("m") * 0 + (1e-6 if precision is None else ph.sqrt(2) / 10**20)
    with pytest.warns(DriftWarning, match=r"cannot be relied on: the energy balance is off by"):
        run = ph.simulate(unbalanced(share), UNITS, {"theta": 1}, 10, precision=precision)
    assert "CANNOT BE RELIED ON" in repr(run)
    assert run.doubt.startswith("the energy balance is off by")


def test_a_force_without_its_work_is_reported():
    forgotten = replace(oscillator(), power=ZERO)
    with pytest.raises(NumericError, match="the energy balance is off"):
        ph.simulate(forgotten, {"m": 1, "k": 1}, {}, 10, forcing={"X": ph.sin(ph.time)})


def silent(subject, *asked, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("error", DriftWarning)
        return ph.simulate(subject, *asked, **options)


def test_long_runs_are_healthy(integrator):
    run = silent(pendulum(), UNITS, {"theta": 0, "theta_dot": 3}, 5_000 * 2.5, samples=2)
    assert run.doubt == ""


def test_chaos_is_no_reason_for_doubt(integrator):
    m, g, a, I = ph.symbols("m g a I", positive=True)
    one, two = ph.coordinates("alpha beta")
    lab = ph.Frame("N")
    axes = [lab.rotated(angle, "y") for angle in (one, two)]
    upper, lower = (
        ph.Body(name, mass=m, inertia=(I, I, I), axes=frame, tag=tag)
        for name, frame, tag in (("upper", axes[0], ""), ("lower", axes[1], "l"))
    )
    joint = upper.point(axes[0]["z"] * -a)
    held = ph.Pivot(upper, at=axes[0]["z"] * a)
    hung = ph.Pivot(lower, at=axes[1]["z"] * a, to=joint, name="elbow", force="G")
    system = ph.System(held, hung, ph.Gravity(g))
    values = {"m": 1, "g": 9.81, "a": 0.5, "I": 0.01}
    assert silent(system, values, {"alpha": 2, "beta": 2.5}, 100).drift.energy < 1e-11


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-10])
def test_a_tolerance_is_taken_into_account(integrator, tolerance):
    assert silent(pendulum(), UNITS, {"theta": 2}, 50, tolerance=tolerance).doubt == ""


def test_a_small_part_of_a_large_energy(integrator):
    """A light pendulum high above where heights are counted from, and one that hardly swings."""
    high = pendulum()
    high = replace(high, energy=high.energy + 10**9 * symbol("m") * symbol("g") * symbol("l"))
    assert silent(high, UNITS, {"theta": 2}, 50).doubt == ""
    assert silent(pendulum(), UNITS, {"theta": 1e-9}, 50).doubt == ""


def test_a_motion_at_rest_is_no_reason_for_doubt():
    assert silent(pendulum(), UNITS, {"theta": 0}, 50).doubt == ""


MODULE = """
from fractions import Fraction
from simulate.test_validity import pushed
system = pushed(Fraction({share!r}))
"""


class Pushed(ph.Force):
    """A force towards x = 0 whose potential is off by a share."""

    share: Fraction

    def potential(self, bodies, places):
        return ph.symbol("k") * ph.coordinate("x") ** 2 / 2 * (1 + self.share)


def pushed(share) -> ph.System:
    x, lab = ph.coordinate("x"), ph.Frame("N")
    body = ph.point_mass("p", mass=ph.symbol("m"), axes=lab)
    force = Pushed(body.point(), lab["x"] * -ph.symbol("k") * x)
    object.__setattr__(force, "share", share)
    return ph.System(force, ph.Pivot(body, only="y z"), name="pushed")


SLIGHTLY = Fraction(1, 10**6)


def command(tmp_path, share, *options):
    path = tmp_path / "pushed.py"
    path.write_text(MODULE.format(share=share))
    settings = ("--set", "m=1kg", "--set", "k=1N/m", "--start", "x=1m", "--duration", "5s")
    asked = [sys.executable, "-m", "polhode", "run", f"{path}:system", *settings, *options]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [*sys.path]))}
    return subprocess.run(asked, capture_output=True, text=True, env=env, check=False)


def test_the_command_line_warns_beside_its_output(tmp_path):
    done = command(tmp_path, str(SLIGHTLY))
    assert done.returncode == 0, done.stderr
    assert "polhode: warning: this motion cannot be relied on: the energy balance" in done.stderr
    assert "DOUBT" in done.stdout
    quiet = command(tmp_path, str(SLIGHTLY), "--json")
    assert quiet.stdout.lstrip().startswith("{")
    assert "warning" in quiet.stderr


def test_the_command_line_refuses_what_is_wrong(tmp_path):
    done = command(tmp_path, "1")
    assert done.returncode == 2
    assert "a motion that is wrong: the energy balance is off by" in done.stderr
    assert "Traceback" not in done.stderr


def test_members_that_cannot_be_relied_on_fail_with_the_reason():
    values = {"m": 1, "k": np.ones(3)}
    found = ph.ensemble(pushed(SLIGHTLY), values, {"x": 1}, 5, outputs=["x"])
    assert found.failed == 3
    assert "cannot be relied on: the energy balance is off" in found.failures[0]


def test_a_page_says_so():
    with pytest.warns(DriftWarning):
        run = ph.simulate(pushed(SLIGHTLY), {"m": 1, "k": 1}, {"x": 1}, 5)
    assert scene(run).as_json()["doubt"] == run.doubt != ""


def test_a_loop_of_heights_that_stay_zero_has_no_scale_of_its_own():
    """Trailers on level ground: their loops close in x, y and z, and all z are rounding."""
    phi, v = ph.coordinate("phi_0").dt(), ph.speed("v_x_0")
    declared = train(4)
    level = ph.System(*declared.elements, *declared.loads, name="level", independent=(phi, v))
    numbers = {"m": 1.0, "J": 0.2, "b": 1.0, "c": 0.3, "g": 9.81}
    start = {f"phi_{k}": 0.1 * k for k in range(4)} | {"phi_0_dot": 0.5, "v_x_0": 1.0}
    run = ph.simulate(level, numbers, start, 0.01)
    assert not run.doubt
    assert run.drift.constraint < 1e-14


@pytest.mark.parametrize(("apart", "other"), [(1e-3, 1.0), (1e-9, 0.0), (1e-9, 1.0)])
def test_a_start_beside_the_singular_place_of_a_chosen_speed_says_what_it_costs(apart, other):
    """With u = θ̇ sin θ, the rate of a pendulum is known to the rounding of a speed over sin θ.

    That of u itself costs nothing; that of a bead on a spring, which moves independently, does.
    """
    m, l, k, g = ph.symbols("m l k g", positive=True)
    lab, theta, x = ph.Frame("lab"), ph.coordinate("theta"), ph.coordinate("x_p")
    axes = lab.rotated(theta, "y")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    bead = ph.point_mass("bead", mass=m, axes=lab, tag="p")
    parts = (
        ph.Pivot(bob, at=axes["z"] * l),
        ph.Hinge(bob, axis="y"),
        ph.Pivot(bead, only="y z", name="wire"),
        ph.Force(bead.point(), lab["x"] * (-k * x)),
        ph.Gravity(g),
    )
    numbers = {m: 1, l: 0.7, g: 9.81, k: 3}
    start = {theta: apart, "theta_dot": 2.0, x: 1.0, "x_p_dot": other}
    plain = ph.simulate(ph.System(*parts), numbers, start, "2 s")
    chosen = ph.System(*parts, speeds={"u": ph.sin(theta) * theta.dt()})
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        run = ph.simulate(chosen, numbers, start, "2 s")
    error = np.abs(run["theta"] - plain["theta"]).max()
    if other and apart < 1e-8:
        assert "theta_dot hardly follows from the chosen speeds at t = 0 s" in run.doubt
        assert "9 digits" in run.doubt
        assert len(told) == 1
        assert error < 1e-7
    else:
        assert not run.doubt
        assert error < 1e-9


def ladder(**wall):
    """On pivots that stand for a smooth floor and a smooth wall."""
    m, l, g = ph.symbols("m l g", positive=True)
    lab, theta = ph.Frame("lab"), ph.coordinate("theta")
    axes = lab.rotated(theta, "y")
    body = ph.rod("ladder", mass=m, length=2 * l, axes=axes, axis="z")
    floor = ph.Pivot(body, at=axes["z"] * -l, only="y z", name="floor")
    # the wall is on the left, where the upper end is for theta < 0, and pushes to the right
    ends = ph.Pivot(body, at=axes["z"] * l, only="x", name="wall", force="W", **wall)
    return ph.System(floor, ends, ph.Hinge(body, axis="y"), ph.Gravity(g), name="ladder")


@pytest.mark.parametrize("precision", [None, 30])
def test_a_joint_that_must_not_pull_is_named_where_it_would_have_to(precision):
    """The upper end leaves the wall at two thirds of its first height."""
    start = {"theta": "-20 deg"}
    run = ph.simulate(
        ladder(pulls=False), {"m": 1, "l": 1, "g": 9.81}, start, "1.3 s", precision=precision
    )
    start_, leaves, end = run.events
    assert (start_.kind, leaves.kind, end.kind) == ("start", "wall pulls", "end")
    height = np.cos(float(run.evaluate("theta", leaves.time)))
    assert height == pytest.approx(2 / 3 * np.cos(np.radians(20)), rel=1e-12)
    held = ph.simulate(ladder(), {"m": 1, "l": 1, "g": 9.81}, start, "1.3 s")
    assert [event.kind for event in held.events] == ["start", "end"]
    assert np.array_equal(
        held["theta"], ph.simulate(held.system, held.parameters, start, "1.3 s")["theta"]
    )


def test_a_run_with_such_a_joint_is_saved_and_opened(tmp_path):
    run = ph.simulate(ladder(pulls=False), {"m": 1, "l": 1, "g": 9.81}, {"theta": -0.5}, "1 s")
    run.save(tmp_path / "ladder.polhode")
    again = ph.load(tmp_path / "ladder.polhode")
    assert again.system.element("wall").pulls is False
    assert [event.kind for event in again.events] == [event.kind for event in run.events]


def test_a_joint_that_must_not_pull_pushes_in_one_direction():
    lab = ph.Frame("lab")
    bob = ph.point_mass("bob", mass=1, axes=lab)
    with pytest.raises(ph.DeclarationError, match="one direction"):
        ph.Pivot(bob, pulls=False)
