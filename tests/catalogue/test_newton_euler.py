"""Every catalogue system against brute-force Newton-Euler at random states: motion and reactions.

The oracles know nothing of polhode: all bodies in the inertial frame, with multipliers.
"""

from collections.abc import Callable
from math import cos, sin

import numpy as np
import pytest

from catalogue.systems import numeric
from derive.states import Numeric, Values, agree, draw
from oracles import balls, disks, gyroscopes
from polhode.catalogue import PROBLEM_SET

Comparison = Callable[[Numeric, int], None]
COMPARISONS: dict[str, Comparison] = {}


def compares(name: str) -> Callable[[Comparison], Comparison]:
    """Marks the comparison of a catalogue system with its oracle at the state of a seed."""
    return lambda comparison: COMPARISONS.setdefault(name, comparison)


DISK = "m a g theta phi psi theta_dot phi_dot omega_3"
TABLE = "m a I g Omega"
COMPASS = "I_1 I_3 Omega lambda_ theta theta_dot omega"
TOP = "M a I_1 I_2 g theta phi psi omega_1"
SHEET = "X Y chi X_dot Y_dot chi_dot X_ddot Y_ddot chi_ddot"

ENERGIES = ["T_dot", "V_dot"]
IN_LAB = ["F_x", "F_y", "F_z"]


def thin(state: dict[str, float]) -> dict[str, float]:
    """The state of a uniform disk, with the moments of inertia that the oracle has."""
    share = state["m"] * state["a"] ** 2 / 4
    return {**state, "I_1": share, "I_3": 2 * share}


@compares("spinning-coin")
def spinning_coin(system: Numeric, seed: int) -> None:
    state = draw(f"{DISK} v_x v_y", seed)
    expected = disks.spinning_coin(**thin(state))
    found = system.at(**state)
    agree(found, expected, ["theta_ddot", "phi_ddot", "omega_3_dot"])
    agree(found, expected, ["v_x_dot", "v_y_dot", "F_z"])
    agree(found, expected, ENERGIES)


@compares("rolling-disk")
def rolling_disk(system: Numeric, seed: int) -> None:
    state = draw(DISK, seed)
    expected = disks.rolling_disk(**thin(state))
    found = system.at(**state)
    agree(found, expected, ["theta_ddot", "phi_ddot", "omega_3_dot"])
    agree(found, expected, IN_LAB)
    agree(found, expected, ENERGIES)


@compares("marble-on-turntable")
def marble_on_turntable(system: Numeric, seed: int) -> None:
    state = draw(f"{TABLE} x y v_x v_y omega_z", seed)
    expected = balls.level_turntable(**state)
    found = system.at(**state)
    agree(found, expected, ["v_x_dot", "v_y_dot", "omega_z_dot"])
    agree(found, expected, ["omega_x", "omega_y", "omega_x_dot", "omega_y_dot"])
    agree(found, expected, IN_LAB)
    agree(found, expected, ENERGIES)


@compares("marble-on-turntable/tilted")
def marble_on_a_tilted_turntable(system: Numeric, seed: int) -> None:
    state = draw(f"{TABLE} alpha x_2 x_3 v_2 v_3 omega_1", seed)
    expected = balls.tilted_turntable(**state)
    found = system.at(**state)
    agree(found, expected, ["v_2_dot", "v_3_dot", "omega_1_dot"])
    agree(found, expected, ["omega_2", "omega_3", "omega_2_dot", "omega_3_dot"])
    agree(found, expected, ["F_1", "F_2", "F_3"])
    agree(found, expected, ENERGIES)


@compares("gyrocompass")
def gyrocompass(system: Numeric, seed: int) -> None:
    state = draw(COMPASS, seed)
    expected = gyroscopes.free_rotor_compass(**state)
    found = system.at(**state, m=1.0, psi=0.3)
    agree(found, expected, ["theta_ddot", "omega_dot"])
    agree(found, expected, ["tau_2"])
    assert expected["tau_1"] == pytest.approx(0, abs=1e-11)
    assert expected["tau_3"] == pytest.approx(0, abs=1e-11)


@compares("gyrocompass/motor")
def gyrocompass_with_a_motor(system: Numeric, seed: int) -> None:
    state = draw(COMPASS, seed)
    expected = gyroscopes.motor_driven_compass(**state)
    found = system.at(**state, omega_0=state["omega"], m=1.0, psi=0.3)
    agree(found, expected, ["theta_ddot"])
    assert found["tau_2"] == pytest.approx(expected["tau_2"], rel=1e-12)
    assert found["tau_3"] == pytest.approx(expected["tau_motor_3"], rel=1e-12)
    assert found["omega"] == state["omega"]
    assert found["omega_dot"] == 0


@compares("tennis-racquet")
def tennis_racquet(system: Numeric, seed: int) -> None:
    state = draw("I_1 I_2 I_3 omega_1 omega_2 omega_3 phi theta psi", seed)
    expected = gyroscopes.free_body(**state)
    found = system.at(**state, m=1.0)
    agree(found, expected, ["omega_1_dot", "omega_2_dot", "omega_3_dot"])
    assert [found[name] for name in IN_LAB] == [0, 0, 0]


@compares("ball-on-paper")
def ball_on_paper(system: Numeric, seed: int) -> None:
    state = draw(f"m r k g x y v_x v_y omega_z {SHEET}", seed)
    expected = balls.rolling_on_paper(**as_on_paper(state))
    found = system.at(**state)
    agree(found, expected, ["v_x_dot", "v_y_dot", "omega_z_dot"])
    agree(found, expected, ["omega_x", "omega_y", "omega_x_dot", "omega_y_dot"])
    agree(found, expected, IN_LAB)
    agree(found, expected, ENERGIES)


def as_on_paper(state: Values) -> dict[str, float]:
    """The oracle calls the radius a, and the angle of the sheet angle."""
    return {n.replace("chi", "angle").replace("r", "a"): v for n, v in state.items()}


@compares("gyroscope")
def gyroscope(system: Numeric, seed: int) -> None:
    state = draw(f"{TOP} theta_dot phi_dot", seed)
    expected = gyroscopes.gyroscope(**state)
    found = system.at(**state)
    agree(found, expected, ["theta_ddot", "phi_ddot", "omega_1_dot"])
    agree(found, expected, ["F_rho", "F_phi", "F_z"])
    agree(found, expected, ENERGIES)


@compares("gyroscope/upright")
def upright_gyroscope(system: Numeric, seed: int) -> None:
    tilts = draw("M a I_1 I_2 g alpha beta psi omega_1 alpha_dot beta_dot", seed)
    found = system.at(**tilts)
    axle, velocity, acceleration = path(tilted, found, "alpha", "beta")
    theta, phi = np.arccos(axle[2]), np.arctan2(axle[1], axle[0])
    state = {name: tilts[name] for name in ["M", "a", "I_1", "I_2", "g", "psi", "omega_1"]}
    state |= {"theta": theta, "phi": phi, "theta_dot": -velocity[2] / sin(theta)}
    state["phi_dot"] = (axle[0] * velocity[1] - axle[1] * velocity[0]) / sin(theta) ** 2
    expected = gyroscopes.gyroscope(**state)
    _, _, wanted = path(polar, {**state, **expected}, "theta", "phi")
    size = max(1, *abs(wanted))
    assert acceleration == pytest.approx(wanted, abs=3e-12 * size)
    agree(found, expected | across_and_along(expected, phi), IN_LAB, tolerance=3e-12)
    agree(found, expected, ["omega_1_dot", *ENERGIES], tolerance=3e-12)


def tilted(alpha: complex, beta: complex) -> np.ndarray:
    """The axle, turned out of the vertical by alpha about x and by beta about the new y."""
    across = np.cos(beta)
    return np.array([np.sin(beta), -np.sin(alpha) * across, np.cos(alpha) * across])


def polar(theta: complex, phi: complex) -> np.ndarray:
    """The axle by its polar angles."""
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


def path(place: Callable, values: Values, *names: str) -> tuple[np.ndarray, ...]:
    """A point that depends on angles, its velocity and acceleration, by complex and by real steps.

    Both derivatives are exact to rounding: the second is taken of the first, worked by hand.
    """
    q, rate, second = (
        np.array([values[name + dots] for name in names]) for dots in ("", "_dot", "_ddot")
    )
    step = 1e-30

    def velocity(q: np.ndarray, rate: np.ndarray) -> np.ndarray:
        quarter = np.pi / 2 * np.eye(2)
        return sum(rate[i] * turned(place, q, quarter[i]) for i in range(2))

    later = velocity(q + 1j * step * rate, rate + 1j * step * second)
    return place(*q), velocity(q, rate), later.imag / step


def turned(place: Callable, q: np.ndarray, quarter: np.ndarray) -> np.ndarray:
    """The derivative of a point by an angle: of a sine or cosine it is a quarter turn on.

    What does not depend on the angle cancels between the quarter turns on and back.
    """
    return (place(*(q + quarter)) - place(*(q - quarter))) / 2


def across_and_along(forces: Values, phi: float) -> dict[str, float]:
    rho, azimuthal = forces["F_rho"], forces["F_phi"]
    return {
        "F_x": rho * cos(phi) - azimuthal * sin(phi),
        "F_y": rho * sin(phi) + azimuthal * cos(phi),
    }


@compares("gyroscope/held")
def held_gyroscope(system: Numeric, seed: int) -> None:
    state = draw(TOP, seed)
    expected = gyroscopes.held_gyroscope(**state)
    found = system.at(**state)
    forces = [f"{letter}_{along}" for letter in ("F", "Fprime") for along in ("rho", "phi", "z")]
    agree(found, expected, forces)
    agree(found, expected, ["omega_1_dot"])
    open_ = system.equations.undetermined
    assert open_ == ("F_rho", "F_z", "Fprime_rho", "Fprime_z")


@compares("gyroscope/vertical-plane")
def gyroscope_in_a_vertical_plane(system: Numeric, seed: int) -> None:
    state = draw(f"{TOP} theta_dot", seed)
    expected = gyroscopes.gyroscope_in_vertical_plane(**state)
    found = system.at(**state)
    agree(found, expected, ["theta_ddot", "omega_1_dot"])
    agree(found, expected, ["F_rho", "F_phi", "F_z", "Fprime_phi"])
    agree(found, expected, ENERGIES)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("name", PROBLEM_SET)
def test_motion_and_reactions(name: str, seed: int) -> None:
    COMPARISONS[name](numeric(name), seed)
