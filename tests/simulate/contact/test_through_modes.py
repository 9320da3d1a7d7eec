"""Contacts that cannot be, starts that cannot be, events nobody knows: refused in words."""

import pytest

import polhode as ph
from simulate.contact.balls import on_table

LAB = ph.Frame("lab")
BALL = ph.sphere("ball", mass=1, radius=ph.symbol("a"), axes=LAB)
GOOD = {"m": 1.0, "a": 0.1, "k": 0.4, "g": 9.81, "mu": 0.2, "mu_s": 0.3, "e": 0.5}


def refused(**coefficients) -> str:
    with pytest.raises(ph.PolhodeError) as caught:
        ph.Coulomb(BALL, on=ph.Plane(LAB), **({"mu": 0.3} | coefficients))
    return str(caught.value)


def run_refused(start=(), duration=1.0, events=None, **numbers) -> str:
    with pytest.raises(ph.PolhodeError) as caught:
        ph.simulate(on_table(), GOOD | numbers, dict(start), duration, events=events)
    return str(caught.value)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"mu": -0.1}, "friction"),
        ({"mu": 0.3, "mu_static": 0.2}, "mu_static"),
        ({"mu_static": -1}, "static"),
        ({"restitution": -0.5}, "restitution"),
        ({"restitution": 1.5}, "restitution"),
        ({"viscous": -1}, "viscous"),
        ({"stribeck": 0}, "Stribeck"),
        ({"stribeck": -1}, "Stribeck"),
    ],
)
def test_declared(given: dict, message: str) -> None:
    assert message in refused(**given)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"mu": -0.1, "mu_s": -0.1}, "mu"),
        ({"mu": 0.4}, "mu"),
        ({"e": -0.2}, "restitution"),
        ({"e": 1.2}, "restitution"),
        ({"mu": float("nan")}, "mu"),
        ({"e": float("inf")}, "e"),
    ],
)
def test_in_numbers(numbers: dict, message: str) -> None:
    assert message in run_refused(**numbers)


def test_start_below_the_floor() -> None:
    assert "below" in run_refused({"z": 0.05, "v_z": 0.0}) or "in" in run_refused({"z": 0.05})


def test_start_far_below_the_floor() -> None:
    run_refused({"z": -3.0, "v_z": 1.0})


def test_unknown_names() -> None:
    assert "thetta" in run_refused({"thetta": 1.0})
    assert "nu" in run_refused(nu=1.0)


def test_events_that_are_not_known() -> None:
    message = run_refused(events={"over": ph.coordinate("thetta") - 1})
    assert "thetta" in message


def test_events_that_are_no_expressions() -> None:
    run_refused(events={"over": "x - 1"})


def test_duration() -> None:
    run_refused(duration=0.0)
    run_refused(duration=float("nan"))


def test_undetermined_normal_forces() -> None:
    """A body held to the same table by two contacts: which of them carries it nobody knows."""
    m, a, g = ph.symbols("m a g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    first = ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3, name="one", force="F")
    second = ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3, name="two", force="N")
    with pytest.raises(ph.PolhodeError) as caught:
        ph.simulate(
            ph.System(first, second, ph.Gravity(g)), {"m": 1, "a": 0.1, "g": 9.81}, {"v_x": 1}, 1.0
        )
    message = str(caught.value)
    assert "one" in message or "two" in message or "F_z" in message


# -- what a start leaves open ----------------------------------------------------------------------


def assumed(**start) -> dict[str, float]:
    return dict(ph.simulate(on_table(), GOOD, start, 0.1, samples=2).assumed)


AT_REST = {"x": 0.0, "y": 0.0, "omega_x": 0.0, "omega_z": 0.0, "v_y": 0.0}


def test_a_start_that_is_taken_to_roll_lists_the_speeds_that_follow():
    radius = GOOD["a"]
    assert assumed(v_x=1.0) == AT_REST | {"omega_y": 1 / radius}
    assert assumed(x_dot=1.0) == AT_REST | {"omega_y": 1 / radius}
    rolled = AT_REST | {"v_x": 7.0 * radius}
    assert assumed(omega_y=7.0) == pytest.approx(rolled)
    assert assumed(v_x=1.0, omega_y=1 / radius) == {"x": 0, "y": 0, "omega_z": 0, "v_y": 0}
    # Slips and starts at rest hide nothing: all that is not given is zero.
    assert assumed(v_x=1.0, omega_y=0.0) == AT_REST
    assert not any(assumed(omega_z=2.0).values())


def test_a_ball_declared_to_roll_assumes_nothing_of_the_kind():
    lab = ph.Frame("lab")
    m, a, g = ph.symbols("m a g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    system = ph.System(ph.Rolling(ball, on=ph.Plane(lab)), ph.Gravity(g))
    run = ph.simulate(system, {"m": 1, "a": 0.02, "g": 9.81}, {"v_x": 1.0}, 0.1, samples=2)
    assert dict(run.assumed) == {"x": 0.0, "y": 0.0, "omega_z": 0.0, "v_y": 0.0}
