"""Other units of length, time and mass: the same motion, and the same digits."""

import mpmath
import numpy as np
import pytest

import polhode as ph
from simulate.contact import balls, disks

DIGITS = mpmath.MPContext()
DIGITS.dps = 60

# Powers of two change no digit of what is given.
UNITS = [  # of length, time and mass
    (1.0, 2.0**-7, 1.0),
    (1.0, 2.0**-20, 1.0),
    (1.0, 2.0**12, 1.0),
    (2.0**-12, 1.0, 1.0),
    (2.0**12, 1.0, 1.0),
    (1.0, 1.0, 2.0**20),
    (2.0**-12, 2.0**-14, 2.0**-10),
]
STARTS = [  # θ, ω₃, φ̇, v_x, v_y; all of them end a slip along a curve
    (0.9312, 13.5, 1.85, 0.4, -0.36),
    (1.2335, 20.8, -4.5, -0.3, -0.61),
]


def disk(length, time, mass, start):
    theta, omega_3, phi_dot, *v = start
    numbers = {"m": 0.2 * mass, "a": 0.03 * length, "g": 9.81 * length / time**2}
    v_x, v_y = (speed * length / time for speed in v)
    given = {"theta": theta, "omega_3": omega_3 / time, "phi_dot": phi_dot / time}
    return ph.simulate(
        disks.with_friction(),
        numbers | {"mu": 0.2, "mu_s": 0.2, "e": 0.0},
        given | {"v_x": v_x, "v_y": v_y},
        0.5 * time,
        samples=2,
    )


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("units", UNITS)
def test_a_disk_that_slips_along_curves_and_sticks(units, start):
    length, time, mass = units
    own, other = disk(1.0, 1.0, 1.0, start), disk(*units, start)
    assert "sticks" in {event.kind for event in own.events}
    assert [event.kind for event in own.events] == [event.kind for event in other.events]
    pairs = zip(own.events, other.events, strict=True)
    assert max(abs(one.time - two.time / time) for one, two in pairs) < 1e-11
    for name, unit in {"theta": 1, "v_x": length / time, "v_y": length / time, "x": length}.items():
        assert abs(own.final[name] - other.final[name] / unit) < 1e-11
    energy = mass * length**2 / time**2
    assert abs(own.final["energy"] - other.final["energy"] / energy) < 1e-13


# A ball across a slope slips along a curve. With the slip s, its direction ŝ, e down the slope,
# friction's rate α = 7/2 μ g cos and gravity's β = g sin: ṡ = β e − α ŝ, so that α |s| + β s·e
# falls at the constant rate α² − β². It vanishes where the slip ends.


def curved_slip(context, mu, tilt, g, slip):
    along, down = slip
    friction = context.mpf(7) / 2 * mu * g * context.cos(tilt)
    weight = g * context.sin(tilt)
    held = friction * context.hypot(along, down) + weight * down
    return held / (friction**2 - weight**2)


SLOPE = {"m": "0.05", "a": "0.02", "k": "0.4", "mu": "0.3", "alpha": "0.3"}


@pytest.mark.parametrize(
    ("precision", "error"), [("extended", 1e-17), ("quadruple", 1e-31), (45, 1e-42)]
)
def test_where_a_curved_slip_ends_in_many_digits(precision, error):
    """Its last steps are so short that derivatives of high order are beyond the largest double."""
    run = ph.simulate(
        balls.on_slope(),
        SLOPE | {"g": "9.81"},
        {"v_x": "0.7", "v_y": "0.5", "omega_x": "1", "omega_y": "0"},
        "0.2 s",
        precision=precision,
        samples=2,
    )
    slip = DIGITS.mpf("0.7"), -(DIGITS.mpf("0.5") + DIGITS.mpf("0.02"))
    ends = curved_slip(DIGITS, DIGITS.mpf("0.3"), DIGITS.mpf("0.3"), DIGITS.mpf("9.81"), slip)
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    assert abs(DIGITS.mpf(str(run.events[1].time)) - ends) < error
    assert run.drift.energy < error


@pytest.mark.parametrize("power", [0, -7, -12, -20, -30, 10])
def test_where_a_curved_slip_ends_in_any_unit_of_time(power):
    unit = 2.0**power
    run = ph.simulate(
        balls.on_slope(),
        SLOPE | {"g": 9.81 / unit**2},
        {"v_x": 0.7 / unit, "v_y": 0.5 / unit, "omega_x": 1 / unit, "omega_y": 0},
        0.2 * unit,
        samples=2,
    )
    ends = float(curved_slip(DIGITS, 0.3, 0.3, DIGITS.mpf("9.81"), (0.7, -0.52)))
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    assert abs(run.events[1].time / unit - ends) < 1e-13


def test_members_of_a_batch_in_a_fine_unit_of_time():
    unit, speeds = 2.0**-14, np.linspace(0.3, 0.9, 5)
    found = ph.ensemble(
        balls.on_slope(),
        {**{k: float(v) for k, v in SLOPE.items()}, "g": 9.81 / unit**2},
        {"v_x": 0.7 / unit, "v_y": speeds / unit, "omega_x": 1 / unit, "omega_y": 0},
        0.3 * unit,
        outputs={"t": ph.EventTime("sticks")},
    )
    for time, speed in zip(found["t"], speeds, strict=True):
        ends = float(curved_slip(DIGITS, 0.3, 0.3, DIGITS.mpf("9.81"), (0.7, -(speed + 0.02))))
        assert abs(time / unit - ends) < 1e-11
