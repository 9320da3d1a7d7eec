"""The systems against the balance of power; what a scenario refuses."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any

import numpy as np
import pytest

from . import balls, disks, extras, gyroscopes, linkages
from .constraints import Ellipsoid, Held, Parts
from .draws import (
    BALL,
    DISK,
    ELLIPSOID,
    FOUR_BAR,
    FREE,
    GIMBALS,
    PENDULUM,
    SHEET,
    TABLE,
    TOP,
    WHEELS,
    draw,
    near,
    seeds,
    sheet_velocity,
    sliding_contact,
)
from .parts import Array, Body, Driven, Z, vector
from .scenario import Numbers, Scenario

Oracle = Callable[..., dict[str, float]]

CONSERVATIVE: dict[Oracle, str] = {
    disks.spinning_coin: DISK + " v_x v_y",
    disks.rolling_disk: DISK,
    balls.rolling_on_paper: BALL,
    gyroscopes.free_body: FREE,
    gyroscopes.gyroscope: TOP + " theta_dot phi_dot",
    gyroscopes.held_gyroscope: TOP,
    gyroscopes.gyroscope_in_vertical_plane: TOP + " theta_dot",
    linkages.double_pendulum: PENDULUM,
    linkages.four_bar: FOUR_BAR,
    extras.wheels_on_axle: WHEELS,
    extras.gimballed_gyroscope: GIMBALS,
    extras.rolling_ellipsoid: ELLIPSOID,
}


@seeds
@pytest.mark.parametrize("oracle", CONSERVATIVE, ids=lambda oracle: oracle.__name__)
def test_supports_at_rest_do_no_work(oracle: Oracle, seed: int) -> None:
    found = oracle(**draw(CONSERVATIVE[oracle], seed, branch=1.0))
    assert found["T_dot"] + found["V_dot"] == pytest.approx(0, abs=1e-12 * scale(found))


def scale(found: dict[str, float]) -> float:
    return 1 + max(map(abs, found.values()))


@seeds
def test_a_moving_sheet_and_friction_do_the_work_they_should(seed: int) -> None:
    rolling = draw(f"{BALL} {SHEET}", seed)
    found = balls.rolling_on_paper(**rolling)
    assert found["T_dot"] == near(work(found, sheet_velocity(rolling)))

    sliding = draw(f"{BALL} mu omega_x omega_y {SHEET}", seed)
    found = balls.sliding_on_paper(**sliding)
    slip = sliding_contact(sliding) - sheet_velocity(sliding)
    heat = sliding["mu"] * sliding["m"] * sliding["g"] * hypot(*slip)
    assert found["T_dot"] == near(work(found, sheet_velocity(sliding)) - heat)


def work(found: dict[str, float], velocity: Array) -> float:
    return float(found["F_x"] * velocity[0] + found["F_y"] * velocity[1])


@seeds
def test_turntable_works_through_the_contact_force(seed: int) -> None:
    s = draw(TABLE, seed)
    found = balls.tilted_turntable(**s)
    works = s["Omega"] * (found["F_3"] * s["x_2"] - found["F_2"] * s["x_3"])
    assert found["T_dot"] + found["V_dot"] == near(works)


def test_a_misspelt_or_missing_number_is_refused() -> None:
    good = draw(DISK, 0)
    with pytest.raises(TypeError, match="needs"):
        disks.rolling_disk(**good, omega3=1.0)
    with pytest.raises(TypeError, match="needs"):
        disks.rolling_disk(**{name: good[name] for name in good if name != "theta"})


@pytest.mark.parametrize(
    ("wrong", "complaint"),
    [
        ({"spin": 0.0}, "velocities break the constraint contact"),
        ({"drift": 2.0}, "ball does not move as its velocity says"),
        ({"table_drift": 2.0}, "table does not move as its velocity says"),
        ({"table_push": 2.0}, "table does not move as its accelerations say"),
        ({"speeds": "v"}, "speeds cannot express these accelerations"),
    ],
)
def test_a_slip_in_a_placement_is_refused(wrong: dict[str, Any], complaint: str) -> None:
    with pytest.raises(AssertionError, match=complaint):
        ball_on_a_belt(**wrong).answer()


def test_ball_on_a_belt_set_up_rightly_takes_its_share() -> None:
    assert ball_on_a_belt().answer().speed_rates == near({"v": 2 / 7 * 0.6, "spin": -5 / 7 * 0.6})


def ball_on_a_belt(
    spin: float = 0.5,
    drift: float = 0.5,
    table_drift: float = 0.0,
    table_push: float = 0.6,
    speeds: str = "v spin",
) -> Scenario:
    """A unit ball on a belt starting from rest with acceleration 0.6; v = spin = 0.5."""

    def place(q: Numbers) -> Parts:
        belt = Driven(
            position=vector(q.belt, 0, 0),
            velocity=vector(q.belt_dot, 0, 0),
            acceleration=vector(0.6, 0, 0),
            rotation=np.eye(3),
            omega=np.zeros(3),
        )
        ball = Body(
            mass=1.0,
            moments=0.4 * np.ones(3),
            position=vector(q.x, 0, 1),
            velocity=vector(q.v, 0, 0),
            rotation=q.attitude,
            omega=vector(0, q.spin, 0),
        )
        return {"table": belt, "ball": ball}

    return Scenario(
        place=place,
        state=Numbers(x=0.0, v=0.5, spin=spin, belt=0.0, belt_dot=0.0, attitude=np.eye(3)),
        rates=lambda q, parts: {
            "x": drift,
            "belt": table_drift,
            "belt_dot": table_push,
            "attitude": parts["ball"].rotation_rate,
        },
        speeds=speeds,
        constraints={"contact": Held("ball", "table", Ellipsoid((1, 1, 1)))},
        gravity=-9.8 * Z,
    )
