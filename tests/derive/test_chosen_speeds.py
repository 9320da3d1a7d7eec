"""Speeds that a user chooses: textbook equations in them, and the same motion in any of them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import polhode as ph
from derive.sleighs import sleigh
from polhode.model import read_declaration, write_declaration

LAB = ph.Frame("lab")


def along_the_body():
    phi, x, y = ph.coordinates("phi x y")
    return {
        "v": x.dt() * ph.cos(phi) + y.dt() * ph.sin(phi),
        "omega": phi.dt(),
    }


def test_a_sleigh_has_chaplygins_equations():
    """v̇ = a ω², (J + m a²) ω̇ = −m a v ω: Neimark and Fufaev (1972), § III.4."""
    equations = ph.derive(sleigh(speeds=along_the_body()))
    m, J, a = ph.symbols("m J a", positive=True)
    v, omega = ph.speeds("v omega")
    phi = ph.coordinate("phi")
    assert [s.published for s in equations.speeds] == ["v", "omega"]
    assert equations.accelerations[v.symbol.derivative()] == a * omega**2
    assert equations.accelerations[omega.symbol.derivative()] == -m * a * v * omega / (J + m * a**2)
    x_dot = equations.kinematics[ph.coordinate("x").symbol.derivative()]
    assert x_dot == v * ph.cos(phi) - a * omega * ph.sin(phi)


def test_claims_runs_and_files_use_the_names(tmp_path):
    system = sleigh(speeds=along_the_body())
    equations = ph.derive(system)
    assert ph.check(r"\dot v = a\omega^2", equations).answer.value == "holds"
    assert ph.check(r"\dot v = -a\omega^2", equations).answer.value == "fails"
    numbers = {"m": 1.5, "J": 0.5, "a": 0.3}
    run = ph.simulate(system, numbers, {"phi": 0.4, "omega": -2, "v": 0.1}, "3 s")
    assert len(run.segments) == 1  # these speeds are singular nowhere
    other = ph.simulate(
        sleigh(), numbers, {"phi": 0.4, "phi_dot": -2, "v_x": run["x_dot"][0]}, "3 s"
    )
    for name in ("phi", "x", "y", "x_dot", "y_dot", "F_y", "energy"):
        assert run[name] == pytest.approx(other[name], abs=1e-11)
    run.save(tmp_path / "sleigh.h5")
    assert ph.load(tmp_path / "sleigh.h5")["v"] == pytest.approx(run["v"], abs=1e-12)
    assert read_declaration(write_declaration(system)) == system


def test_components_of_the_angular_velocity_give_eulers_equations():
    """A ω̇₁ = (B − C) ω₂ ω₃ and so on, written out by the user, and by ph.Components."""
    A, B, C = ph.symbols("A B C", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    f, t, p = phi.dt(), theta.dt(), psi.dt()
    speeds = {
        "w_1": f * ph.sin(theta) * ph.sin(psi) + t * ph.cos(psi),
        "w_2": f * ph.sin(theta) * ph.cos(psi) - t * ph.sin(psi),
        "w_3": f * ph.cos(theta) + p,
    }
    body = ph.Body("body", mass=1, inertia=(A, B, C), axes=axes)
    equations = ph.derive(ph.System(ph.Pivot(body), speeds=speeds))
    w = ph.speeds("w_1 w_2 w_3")
    euler = ((B - C) * w[1] * w[2] / A, (C - A) * w[2] * w[0] / B, (A - B) * w[0] * w[1] / C)
    found = [equations.accelerations[s.symbol.derivative()] for s in w]
    assert found == list(euler)


def test_a_momentum_as_a_speed_gives_hamiltons_equations():
    m, l, g = ph.symbols("m l g", positive=True)
    theta = ph.coordinate("theta")
    bob = ph.Body("bob", mass=m, axes=LAB.rotated(theta, "x"))
    held = (ph.Pivot(bob, at=bob.axes["z"] * l), ph.Hinge(bob, axis="x"), ph.Gravity(g))
    equations = ph.derive(ph.System(*held, speeds={"p": m * l**2 * theta.dt()}))
    p = ph.speed("p")
    energy = equations.energy
    (acceleration,) = equations.accelerations.values()
    assert equations.kinematics[theta.symbol.derivative()] == energy.diff(p.symbol)
    assert acceleration == -energy.diff(theta.symbol)
    start = {"theta": 1.0, "p": 0.2}
    run = ph.simulate(ph.System(*held, speeds={"p": m * l**2 * theta.dt()}), _NUMBERS, start, "5 s")
    plain = ph.simulate(ph.System(*held), _NUMBERS, {"theta": 1.0, "theta_dot": 0.2 / 0.5}, "5 s")
    assert run["theta"] == pytest.approx(plain["theta"], abs=1e-12)


_NUMBERS = {"m": 2.0, "l": 0.5, "g": 9.81}


def test_speeds_with_constraints_and_contacts():
    """A ball on a table, by the slip of its lowest point and its spin: it slides, then rolls."""
    m, R, g = ph.symbols("m R g", positive=True)
    x = ph.coordinate("x")
    omega_y = ph.speed("omega_y")
    ball = ph.sphere("ball", mass=m, radius=R, axes=LAB, spin=ph.Free())
    table = ph.Plane(LAB)
    speeds = {"slip": x.dt() - R * omega_y}
    numbers = {"m": 0.2, "R": 0.03, "g": 9.81}
    runs = [
        ph.simulate(
            ph.System(ph.Coulomb(ball, on=table, mu=0.3), ph.Gravity(g), **options),
            numbers,
            start,
            "1 s",
        )
        for options, start in (
            ({"speeds": speeds}, {"slip": 1.0, "omega_y": 0.0}),
            ({}, {"v_x": 1.0, "omega_y": 0.0}),
        )
    ]
    assert [e.kind for e in runs[0].events] == [e.kind for e in runs[1].events]
    assert runs[0].final["x"] == pytest.approx(runs[1].final["x"], abs=1e-12)
    assert runs[0].final["slip"] == pytest.approx(0.0, abs=1e-12)


@settings(max_examples=8, deadline=None)
@given(
    st.lists(st.integers(-2, 2), min_size=4, max_size=4).filter(
        lambda a: a[0] * a[3] - a[1] * a[2]
    ),
    st.booleans(),
)
def test_the_motion_does_not_depend_on_the_speeds(entries, turned):
    """A double pendulum in any two combinations of its rates, against Lagrange by hand."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    upper = ph.point_mass("upper", mass=m, axes=LAB.rotated(alpha, "x"))
    lower = ph.point_mass("lower", mass=m, axes=LAB.rotated(beta, "x"), tag="2")
    held = (
        ph.Pivot(upper, at=upper.axes["z"] * l, name="a"),
        ph.Pivot(lower, at=lower.axes["z"] * l, to=upper.point(), name="b"),
        ph.Hinge(upper, axis="x", name="c"),
        ph.Hinge(lower, axis="x", name="d"),
        ph.Gravity(g),
    )
    a, b, c, d = entries
    factor = 2 + ph.sin(alpha - beta) if turned else 1
    speeds = {
        "u": (a * alpha.dt() + b * beta.dt()) * factor,
        "w": c * alpha.dt() + d * beta.dt(),
    }
    system = ph.System(*held, speeds=speeds)
    start = {"alpha": 0.7, "beta": -0.3, "alpha_dot": 0.5, "beta_dot": -1.0}
    run = ph.simulate(system, _NUMBERS, start, "1 s")

    def rates(t, y):
        al, be, u, w = y
        g_l = 9.81 / 0.5
        mass = np.array([[2.0, np.cos(al - be)], [np.cos(al - be), 1.0]])
        right = [
            -np.sin(al - be) * w * w - 2 * g_l * np.sin(al),
            np.sin(al - be) * u * u - g_l * np.sin(be),
        ]
        return [u, w, *np.linalg.solve(mass, right)]

    exact = solve_ivp(
        rates, (0, 1), [0.7, -0.3, 0.5, -1.0], method="DOP853", rtol=1e-13, atol=1e-13
    )
    found = [run.final[name] for name in ("alpha", "beta", "alpha_dot", "beta_dot")]
    assert found == pytest.approx(exact.y[:, -1], abs=1e-10)


PHI, X = ph.coordinates("phi x")


@pytest.mark.parametrize(
    ("speeds", "message"),
    [
        ({"v": X.dt() ** 2}, "linear"),
        ({"v": X}, "nothing moves"),
        ({"x": X.dt()}, "has already"),
        ({"phi_dot": X.dt()}, "without _dot"),
        ({"v": X.dt(), "w": 2 * X.dt()}, "follows from the others"),
        ({"v": ph.coordinate("q").dt()}, "v = q_dot"),
        ({"v": X.dt() + PHI.dt().dt()}, "v = "),
        ({PHI: X.dt()}, "a speed named phi"),
    ],
)
def test_what_is_no_speed_is_refused(speeds, message):
    with pytest.raises(ph.PolhodeError, match=message):
        ph.derive(sleigh(speeds=speeds))
