"""Peer: the contact tasks by SciPy's DOP853 with events, one right side for each mode, by hand.

The slip speed has a corner where a slip ends, so the event is a small threshold before it, and
what is left is done in one step along the tangent. Where a slip begins the equations are stiff
without bound, so the first moment of it is done by its series. Plain complex numbers and floats:
quicker here than arrays.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import cos, hypot, sin
from pathlib import Path
from typing import Any

from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).parents[1]))
import contact_tasks as tasks

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
G = tasks.G
State = list[float]
Rates = Callable[[float, State], Any]


def main() -> None:
    settings = dict.fromkeys(tasks.TASKS, TOLERANCES)
    tasks.tell(__doc__, {"sheet": sheet, "slide": slide, "disk": disk}, settings)


def ended(threshold: float, slip: Callable[[float, State], float]) -> Any:
    def event(t: float, y: State) -> float:
        return slip(t, y) - threshold

    event.terminal, event.direction = True, -1
    return event


def threshold_at(tolerance: float) -> float:
    return min(1e-5, max(1e-10, tolerance))


def finished(rates: Rates, slip: Callable[[float, State], float], t: float, y: State) -> Any:
    """Time and state where a slip that is nearly over ends, along the tangent."""
    rate, left = rates(t, y), slip(t, y)
    look = 1e-2 * left
    loss = (left - slip(t + look, [a + look * b for a, b in zip(y, rate, strict=True)])) / look
    rest = left / loss
    return t + rest, [a + rest * b for a, b in zip(y, rate, strict=True)]


def exceeded(needed: Callable[[float, State], float]) -> Any:
    event = lambda t, y: needed(t, y)  # noqa: E731
    event.terminal, event.direction = True, 1
    return event


def until(rates: Rates, t: float, end: float, y: State, tolerance: float, event: Any) -> Any:
    """Time and state at the event or the end, and whether it was the event."""
    found = solve_ivp(
        rates, (t, end), y, "DOP853", rtol=tolerance, atol=tolerance * 1e-2, events=event
    )
    return float(found.t[-1]), found.y[:, -1].tolist(), found.status == 1


# -- a ball: place, velocity v and rim velocity u = a ω × ẑ, as x, y, v_x, v_y, u_x, u_y -----------


class Rolls:
    """A ball on a moving sheet, or on a table, whose sheet rests."""

    def __init__(self, piece: int | None) -> None:
        self.piece = piece
        self.k, self.grip = tasks.BALL["k"], tasks.BALL["mu"] * G
        self.limit = (1 + 1 / self.k) * self.grip

    def below(self, t: float, place: complex) -> complex:
        """Velocity of the sheet under the ball."""
        if self.piece is None:
            return 0j
        (x, y, _), (v_x, v_y, turn), _ = tasks.sheet(self.piece, t)
        return complex(v_x, v_y) + 1j * turn * (place - complex(x, y))

    def drag(self, t: float, place: complex, velocity: complex) -> complex:
        """Rate of that velocity, along the way of the ball."""
        if self.piece is None:
            return 0j
        (x, y, _), (v_x, v_y, turn), (a_x, a_y, bend) = tasks.sheet(self.piece, t)
        arm, past = place - complex(x, y), velocity - complex(v_x, v_y)
        return complex(a_x, a_y) + 1j * (bend * arm + turn * past)

    def slip(self, t: float, y: State) -> complex:
        return complex(y[2] - y[4], y[3] - y[5]) - self.below(t, complex(y[0], y[1]))

    def speed(self, t: float, y: State) -> float:
        return abs(self.slip(t, y))

    def sliding(self, t: float, y: State) -> tuple[float, ...]:
        slip = self.slip(t, y)
        push = -self.grip * slip / abs(slip)
        spun = -push / self.k
        return y[2], y[3], push.real, push.imag, spun.real, spun.imag

    def rolling(self, t: float, y: State) -> tuple[float, ...]:
        drag = self.drag(t, complex(y[0], y[1]), complex(y[2], y[3]))
        push = self.k / (1 + self.k) * drag
        spun = -push / self.k
        return y[2], y[3], push.real, push.imag, spun.real, spun.imag

    def needed(self, t: float, y: State) -> float:
        return abs(self.drag(t, complex(y[0], y[1]), complex(y[2], y[3]))) - self.limit

    def changed(self, y: State, slip: complex) -> State:
        """With so much more slip, and what friction keeps."""
        push = self.k / (1 + self.k) * slip
        spun = -push / self.k
        return [*y[:2], y[2] + push.real, y[3] + push.imag, y[4] + spun.real, y[5] + spun.imag]

    def follow(self, t: float, end: float, y: State, tolerance: float) -> State:
        slips = self.speed(t, y) > 1e-12
        if not slips and self.needed(t, y) > 0:
            t, y, slips = *self.begun(t, y, tolerance), True
        while t < end:
            if slips:
                event = ended(threshold_at(tolerance), self.speed)
                t, y, happened = until(self.sliding, t, end, y, tolerance, event)
                if happened:
                    t, y = finished(self.sliding, self.speed, t, y)
                    y = self.changed(y, -self.slip(t, y))
                    slips = False
            else:
                event = exceeded(self.needed)
                t, y, slips = until(self.rolling, t, end, y, tolerance, event)
                if slips:
                    t, y = self.begun(t, y, tolerance)
        return y

    def begun(self, t: float, y: State, tolerance: float) -> tuple[float, State]:
        """A moment after slip has begun, against the pull of the sheet."""
        moment = max(tolerance ** (1 / 3), 4 * threshold_at(tolerance) ** 0.5 / 10)
        excess = self.needed(t, y)
        event = exceeded(lambda t, y: -1.0)
        later, y, _ = until(self.rolling, t, t + moment, y, tolerance, event)
        drag = self.drag(later, complex(y[0], y[1]), complex(y[2], y[3]))
        gained = (excess + self.needed(later, y)) / 2 * moment
        slip = -gained * drag / abs(drag)
        way = self.k / (1 + self.k) * slip * moment / 3
        return later, self.changed([y[0] + way.real, y[1] + way.imag, *y[2:]], slip)


def sheet(tolerance: float) -> dict[str, float]:
    v_x, v_y = tasks.SHEET_START
    y = [0.0, 0.0, v_x, v_y, v_x, v_y]
    ends = [0.0, *tasks.KNOTS.tolist(), tasks.SHEET_DURATION]
    for i in range(len(ends) - 1):
        y = Rolls(i - 1).follow(ends[i], ends[i + 1], y, tolerance)
    return dict(zip(tasks.ANSWERS["sheet"], y, strict=False))


def slide(tolerance: float) -> dict[str, float]:
    begin, r = tasks.SLIDE_START, tasks.BALL["r"]
    rim = r * begin["omega_y"], -r * begin["omega_x"]
    y = [0.0, 0.0, begin["v_x"], begin["v_y"], *rim]
    y = Rolls(None).follow(0.0, tasks.SLIDE_DURATION, y, tolerance)
    return dict(zip(tasks.ANSWERS["slide"], y, strict=False))


# -- a disk: θ, θ̇, φ, φ̇, ω₃, x, y and velocity v_x, v_y of its centre -----------------------------


def disk(tolerance: float) -> dict[str, float]:
    begin, end = tasks.DISK_START, tasks.DISK_DURATION
    y = [begin["theta"], 0.0, 0.0, begin["phi_dot"], begin["omega_3"], 0.0, 0.0]
    y += [begin["v_x"], begin["v_y"]]
    t, slips = 0.0, True
    while t < end:
        if slips:
            event = ended(threshold_at(tolerance), disk_speed)
            t, y, happened = until(disk_slides, t, end, y, tolerance, event)
            if happened:
                t, y = finished(disk_slides, disk_speed, t, y)
                slips = False
        else:
            t, y, slips = until(disk_rolls, t, end, y, tolerance, exceeded(disk_needs))
            y[7:] = disk_velocity(y)
    return {"x": y[5], "y": y[6], "theta": y[0], "omega_3": y[4]}


def disk_slip(y: State) -> tuple[float, float]:
    """Along the horizontal line of the disk, and across it."""
    a, s = tasks.DISK["a"], sin(y[0])
    cp, sp = cos(y[2]), sin(y[2])
    return y[7] * cp + y[8] * sp + a * y[4], -y[7] * sp + y[8] * cp + a * y[1] * s


def disk_speed(_: float, y: State) -> float:
    return hypot(*disk_slip(y))


def disk_slides(_: float, y: State) -> tuple[float, ...]:
    theta_dot, phi_dot, omega = y[1], y[3], y[4]
    a, mu = tasks.DISK["a"], tasks.DISK["mu"]
    s, c = sin(y[0]), cos(y[0])
    along, across = disk_slip(y)
    size = hypot(along, across)
    along, across = -mu * along / size, -mu * across / size
    gyration = phi_dot * s * (2 * omega - phi_dot * c)  # of the moments, over m a²/4
    lever = 4 / a * (c - s * across)
    normal = (G - a * s * theta_dot**2 - a * c * gyration) / (1 + a * c * lever)
    force = normal * along, normal * across
    cp, sp = cos(y[2]), sin(y[2])
    return (
        theta_dot,
        -lever * normal - gyration,
        phi_dot,
        (2 * omega - 2 * phi_dot * c) * theta_dot / s,
        2 / a * force[0],
        y[7],
        y[8],
        force[0] * cp - force[1] * sp,
        force[0] * sp + force[1] * cp,
    )


def disk_accelerates(y: State) -> tuple[float, float, float]:
    theta_dot, phi_dot, omega = y[1], y[3], y[4]
    s, c = sin(y[0]), cos(y[0])
    bend = phi_dot * phi_dot * s * c - 6 * omega * phi_dot * s - 4 * G / tasks.DISK["a"] * c
    return bend / 5, 2 * theta_dot * (omega - phi_dot * c) / s, 2 * theta_dot * phi_dot * s / 3


def disk_velocity(y: State) -> list[float]:
    a, s = tasks.DISK["a"], sin(y[0])
    along, across = -a * y[4], -a * y[1] * s
    cp, sp = cos(y[2]), sin(y[2])
    return [along * cp - across * sp, along * sp + across * cp]


def disk_rolls(_: float, y: State) -> tuple[float, ...]:
    theta, phi, spin = disk_accelerates(y)
    return y[1], theta, y[3], phi, spin, *disk_velocity(y), 0.0, 0.0


def disk_needs(_: float, y: State) -> float:
    """Friction that rolling takes, less its limit, per mass."""
    theta_dot, phi_dot, omega, a = y[1], y[3], y[4], tasks.DISK["a"]
    s, c = sin(y[0]), cos(y[0])
    theta, _, spin = disk_accelerates(y)
    along = -a * spin + a * theta_dot * s * phi_dot
    across = -a * omega * phi_dot - a * (theta * s + theta_dot**2 * c)
    normal = G + a * (theta * c - theta_dot**2 * s)
    return hypot(along, across) - tasks.DISK["mu"] * normal


if __name__ == "__main__":
    main()
