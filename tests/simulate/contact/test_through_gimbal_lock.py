"""Bodies in contact that go through gimbal lock, against the same bodies described otherwise.

In the other description the floor is turned, or the axes of the body are named otherwise: the same
attitudes are far from gimbal lock there.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import polhode as ph
from simulate.contact.boxes import MU, G, M

DURATION = 0.4


# -- a ball with three moments ---------------------------------------------------------------------

BALL = {"m": 1.1, "r": 0.3, "g": 9.81, "I_1": 0.03, "I_2": 0.04, "I_3": 0.05, "mu": 0.2}


def ball(contact, spin, turned):
    """A ball in three angles, on a floor that is turned by an angle about y."""
    m, r, g, mu, *moments = ph.symbols("m r g mu I_1 I_2 I_3", positive=True)
    axes = root = ph.Frame("N")
    floor = root.rotated(turned, "y")
    for angle, axis in (("phi", "z"), ("theta", "x"), ("psi", "z")):
        axes = axes.rotated(ph.coordinate(angle), axis)
    body = ph.Body("ball", mass=m, inertia=moments, axes=axes, spin=spin, surface=ph.Round(r, "z"))
    more = {"mu": mu} if contact is ph.Coulomb else {}
    up = floor["z"]
    return ph.System(contact(body, on=ph.Plane(floor), **more), ph.Gravity(g, up=up))


def start_of(angles, spin, beta):
    """The start with angles and an angular velocity against the floor, if that is not turned."""
    attitude = Rotation.from_euler("ZXZ", angles)
    there = Rotation.from_euler("y", beta) * attitude
    phi, theta, psi = there.as_euler("ZXZ") if beta else angles
    body = attitude.inv().apply(spin)  # along the axes of the body
    found = {"phi": phi, "theta": theta, "psi": psi}
    return found | {f"omega_{label}": w for label, w in zip("xyz", body, strict=True)}


@pytest.mark.parametrize("contact", [ph.Rolling, ph.Smooth, ph.Coulomb])
@pytest.mark.parametrize("distance", [1e-2, 1e-5, 1e-9, 0.0])
def test_a_ball_goes_through_the_pole_of_its_angles(contact, distance):
    angles = 0.7, distance, -0.4
    spin = np.array([1.3, -40.0, 2.1])
    moving = {} if contact is ph.Rolling else {"v_x": 3.0, "v_y": 1.0}
    runs = []
    for beta in (0.0, np.pi / 2):
        system = ball(contact, ph.Components(), ph.symbol("beta"))
        start = start_of(angles, spin, beta) | moving
        numbers = BALL | {"beta": beta}
        if contact is not ph.Coulomb:
            numbers.pop("mu")
        runs.append(ph.simulate(system, numbers, start, DURATION, samples=41))
    one, other = runs
    assert (one.doubt, other.doubt) == ("", "")
    assert one.drift.energy < 1e-13
    for name in ("x", "y", "v_x", "v_y", "energy", *one.reactions):
        assert one[name] == pytest.approx(other[name], rel=1e-9, abs=1e-10)
    turning = ((run["omega_x"], run["omega_y"], run["omega_z"]) for run in runs)
    assert np.array(next(turning)) == pytest.approx(np.array(next(turning)), abs=1e-9)
    for now in range(1, 41):
        attitudes = (
            Rotation.from_euler("ZXZ", [run[name][now] for name in ("phi", "theta", "psi")])
            for run in runs
        )
        on_the_floor, turned = attitudes
        left = Rotation.from_euler("y", np.pi / 2) * on_the_floor * turned.inv()
        assert left.magnitude() < 1e-8


@pytest.mark.parametrize("contact", [ph.Rolling, ph.Smooth, ph.Coulomb])
def test_rates_of_angles_do_as_well_as_components_of_the_spin(contact):
    """900 rad/s of precession against as much spin: only their difference is a turning."""
    start = {"phi": 0.7, "theta": 1e-3, "psi": -0.4}
    start |= {"phi_dot": 900.0, "theta_dot": 0.3, "psi_dot": -898.0}
    if contact is not ph.Rolling:
        start |= {"v_x": 3.0, "v_y": 1.0}
    numbers = {name: value for name, value in BALL.items() if name != "mu"}
    if contact is ph.Coulomb:
        numbers = BALL
    one, other = (
        ph.simulate(ball(contact, spin, 0), numbers, start, "0.2 s", samples=3)
        for spin in (ph.WithAxes(), ph.Components())
    )
    assert (one.doubt, other.doubt) == ("", "")
    assert one.drift.energy < 1e-13
    for name in ("phi", "theta", "psi", "x", "y", "v_x", "v_y", "phi_dot", "psi_dot"):
        assert one.final[name] == pytest.approx(other.final[name], rel=1e-12, abs=1e-12)


# -- a box -----------------------------------------------------------------------------------------

SIDES = (0.2, 0.3, 0.15)  # along x, y, z


def box(down):
    """A box in angles about z, y, x, with the corners of the face across one of its axes."""
    lab = ph.Frame("N")
    axes = lab
    for angle, label in zip(ph.coordinates("psi theta phi"), "zyx", strict=True):
        axes = axes.rotated(angle, label)
    sides = ph.symbols("a b c", positive=True)
    body = ph.box("box", mass=M, sides=sides, axes=axes)
    others = [k for k in range(3) if k != down]
    corners = []
    for name, (i, j) in zip("PQRS", ((1, 1), (1, -1), (-1, 1), (-1, -1)), strict=True):
        at = [side / 2 for side in sides]
        at[down] = -at[down]
        at[others[0]], at[others[1]] = i * at[others[0]], j * at[others[1]]
        corners.append(
            ph.Coulomb(body, on=ph.Plane(lab), at=axes.vector(*at), mu=MU, name=name, force=name)
        )
    return ph.System(*corners, ph.Gravity(G), impacts="Moreau", sharing="equal stiffness")


@pytest.mark.parametrize(("heading", "tilt"), [(0.3, 1e-7), (0.3, 0.02)])
def test_a_box_comes_to_rest_on_the_face_of_gimbal_lock(heading, tilt):
    """With the axis x down it lands in gimbal lock; with its axes named otherwise it does not."""
    # from the axes of the box that lands on the face across x to those of the other one: z is x
    renamed = Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    attitude = Rotation.from_euler("ZYX", (heading, -np.pi / 2 + 0.12, tilt))
    spin = np.array([0.4, -0.2, 0.5])  # in space
    runs = []
    for down, turned, sides in (
        (0, Rotation.identity(), SIDES),
        (2, renamed, (SIDES[1], SIDES[2], SIDES[0])),
    ):
        there = attitude * turned
        psi, theta, phi = there.as_euler("ZYX")
        rates = rates_of((psi, theta, phi), spin)
        start = {"psi": psi, "theta": theta, "phi": phi, **rates, "z": 0.16, "v_x": 0.3}
        numbers = {"m": 1.3, "g": 9.81, "mu": 0.4} | dict(zip("abc", sides, strict=True))
        runs.append(ph.simulate(box(down), numbers, start, 1.0, samples=11))
    one, other = runs
    assert [e.kind for e in one.events] == [e.kind for e in other.events]
    assert [e.time for e in one.events] == pytest.approx([e.time for e in other.events], abs=1e-9)
    for name in ("x", "y", "z", "v_x", "v_y", "v_z", "energy"):
        assert one[name] == pytest.approx(other[name], abs=1e-9)
    assert abs(abs(one.final["theta"]) - np.pi / 2) < 1e-9
    assert one.final["z"] == pytest.approx(SIDES[0] / 2, abs=1e-12)


def test_a_box_rocks_through_the_pole_until_it_lies():
    """Over its edges in turn, straight through the pole to rounding, ever faster."""
    start = {"psi": 0.3, "theta": -1.45, "phi": 0.02, "z": 0.16, "v_x": 0.3}
    numbers = {"m": 1.3, "g": 9.81, "mu": 0.4} | dict(zip("abc", (0.2, 0.3, 0.15), strict=True))
    run = ph.simulate(box(0), numbers, start, 0.6, samples=7)
    assert run.mode == "rolling"
    assert run.final["z"] == pytest.approx(0.1, abs=1e-12)
    assert run["theta"][-3:] == pytest.approx(-np.pi / 2, abs=1e-9)
    assert np.all(np.diff(run["energy"]) < 1e-12)


def test_a_motion_through_gimbal_lock_is_loaded_as_it_was_saved(tmp_path):
    angles = 0.3, -np.pi / 2 + 0.12, 0.02
    start = dict(zip(("psi", "theta", "phi"), angles, strict=True))
    start |= rates_of(angles, np.array([0.4, -0.2, 0.5])) | {"z": 0.16, "v_x": 0.3}
    numbers = {"m": 1.3, "g": 9.81, "mu": 0.4} | dict(zip("abc", SIDES, strict=True))
    run = ph.simulate(box(0), numbers, start, 0.5, samples=26)
    run.save(tmp_path / "box.polhode")
    again = ph.load(tmp_path / "box.polhode", seconds=None)
    for name in (*run.states, *run.reactions, "energy", "work"):
        assert again[name] == pytest.approx(run[name], rel=1e-10, abs=1e-10, nan_ok=True)


def test_a_free_body_through_gimbal_lock_is_loaded_as_it_was_saved(tmp_path):
    m, *moments = ph.symbols("m I_1 I_2 I_3", positive=True)
    axes = ph.Frame("N")
    for angle, axis in (("phi", "z"), ("theta", "x"), ("psi", "z")):
        axes = axes.rotated(ph.coordinate(angle), axis)
    system = ph.System(ph.Body("body", mass=m, inertia=moments, axes=axes))
    start = {"theta": 0.5, "theta_dot": -1.0, "phi_dot": 1e-7, "psi_dot": 0.3}
    run = ph.simulate(system, {"m": 1, "I_1": 1, "I_2": 2, "I_3": 2.5}, start, 1.5, samples=40)
    run.save(tmp_path / "body.polhode")
    again = ph.load(tmp_path / "body.polhode", seconds=None)
    for name in (*run.states, "energy"):
        assert again[name] == pytest.approx(run[name], rel=1e-9, abs=1e-12)


def rates_of(angles, spin):
    """Rates of angles about z, y, x that make up an angular velocity in space."""
    psi, theta, _ = angles
    first, second = np.array([0, 0, 1.0]), np.array([-np.sin(psi), np.cos(psi), 0])
    third = np.array([np.cos(theta) * np.cos(psi), np.cos(theta) * np.sin(psi), -np.sin(theta)])
    found = np.linalg.solve(np.array([first, second, third]).T, spin)
    return dict(zip(("psi_dot", "theta_dot", "phi_dot"), found, strict=True))
