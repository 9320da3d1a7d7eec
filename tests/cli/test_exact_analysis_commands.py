"""`polhode lagrangian`, `linearise`, `vectors` and `fictitious`: documents, text, refusals."""

import pytest
import sympy
from sympy import cos, sin

from cli.sympy_text import from_srepr

m, a, g = sympy.symbols("m a g")
theta, phi_dot, theta_dot, omega_3 = sympy.symbols("theta phi_dot theta_dot omega_3")


def agree(text, expected):
    return sympy.simplify(from_srepr(text["sympy"]) - expected) == 0


def test_the_momenta_of_the_coin_are_those_of_the_text(document):
    """Problem set, equations (18) and (19), with I₁ = m a²/4 and I₃ = m a²/2."""
    found = document("lagrangian", "spinning-coin")
    psi_dot = sympy.symbols("psi_dot")
    first, third = m * a**2 / 4, m * a**2 / 2
    about_z = (first * sin(theta) ** 2 + third * cos(theta) ** 2) * phi_dot
    assert agree(found["momenta"]["P_phi"], about_z + third * psi_dot * cos(theta))
    assert agree(found["momenta"]["P_psi"], third * (phi_dot * cos(theta) + psi_dot))
    assert found["conserved"] == ["P_phi", "P_psi", "P_x", "P_y"]
    assert {force["sympy"] for force in found["forces"].values()} == {"Integer(0)"}


def test_lagranges_equation_of_the_coin_by_sympys_calculus(document):
    found = document("lagrangian", "spinning-coin")
    psi_dot, theta_ddot = sympy.symbols("psi_dot theta_ddot")
    value = from_srepr(found["L"]["sympy"])
    slope = value.diff(theta_dot)
    # θ is the only coordinate in ∂L/∂θ̇
    row = slope.diff(theta) * theta_dot + slope.diff(theta_dot) * theta_ddot - value.diff(theta)
    assert psi_dot in row.free_symbols
    assert agree(found["equations"]["theta"], row)


def test_a_rolling_constraint_has_no_such_lagrangian(polhode):
    code, out, err = polhode("lagrangian", "rolling-disk")
    assert (code, out) == (2, "")
    assert "no constraint on velocities" in err


def test_departures_of_the_disk_on_edge(document):
    """ε̈ and φ̇ = 2 ε ω₃ of the problem set's bullets, from the linear equations."""
    found = document("linearise", "rolling-disk", "--at", "theta=pi/2", "--at", "phi_dot=0")
    (family,) = found["families"]
    departure, bend, turn = sympy.symbols("delta_theta delta_theta_ddot delta_phi_dot")
    rows = [from_srepr(row["sympy"]) for row in family["equations"]]
    steered = next(row for row in rows if bend in row.free_symbols)
    constants = [from_srepr(one["sympy"]) for one in family["constant"]]
    assert any(sympy.expand(c - (turn - 2 * omega_3 * departure)) == 0 for c in constants)
    rate = sympy.solve(steered.subs(turn, 2 * omega_3 * departure), bend)[0]
    expected = -sympy.Rational(4, 5) * (3 * omega_3**2 - g / a) * departure
    assert sympy.simplify(rate - expected) == 0


def test_departures_in_singular_coordinates_are_undecided(document, polhode):
    found = document("linearise", "gyroscope")
    upright = [family for family in found["families"] if "undecided" in family]
    assert upright
    assert all(family["equations"] == [] for family in upright)
    code, out, _ = polhode("linearise", "gyroscope")
    assert code == 0
    assert "two tilts" in out


def test_the_force_on_the_disk_is_short_along_its_axes(document):
    """Problem set, (34): F = m g ẑ + m a d/dt(ω × 2̂), by components."""
    found = document("vectors", "rolling-disk")
    assert found["along"] == ["1", "2", "3"]
    force = found["vectors"]["F_ground"]
    rate_3, bend = sympy.symbols("omega_3_dot theta_ddot")
    assert agree(force["1"], m * a * (theta_dot * phi_dot * sin(theta) - rate_3))
    assert agree(
        force["2"], m * (g * sin(theta) - a * theta_dot**2 - a * omega_3 * phi_dot * cos(theta))
    )
    assert agree(force["3"], m * (a * bend + a * omega_3 * phi_dot * sin(theta) + g * cos(theta)))


def test_vectors_along_other_axes_have_the_same_length(document):
    along_body = document("vectors", "gyroscope")["vectors"]["F_pivot"]
    along_triad = document("vectors", "gyroscope", "--along", "rho,phi,z")["vectors"]["F_pivot"]
    squares = [
        sum(from_srepr(part["sympy"]) ** 2 for part in parts.values())
        for parts in (along_body, along_triad)
    ]
    s, c = sympy.symbols("s c")
    difference = (squares[0] - squares[1]).subs({sin(theta): s, cos(theta): c})
    _, rest = sympy.reduced(sympy.expand(difference), [s**2 + c**2 - 1], s, c)
    assert rest == 0


def test_values_are_put_into_vectors(document):
    found = document("vectors", "rolling-disk", "--at", "theta=pi/2")["vectors"]["omega"]
    assert found["2"]["sympy"] == "Symbol('phi_dot')"


@pytest.mark.parametrize("command", ["vectors", "fictitious"])
def test_axes_that_do_not_exist_are_refused(polhode, command):
    code, out, err = polhode(command, "rolling-disk", "--along", "1,2,7")
    assert (code, out) == (2, "")
    assert "expected one of" in err
    assert "1,2,3" in err


def test_the_coriolis_torque_on_a_hoop(document):
    """Problem set, (10): τ₁ = m a² ω Ω sin λ sin θ; the text leaves out Ω cos λ in τ₂."""
    torques = document("fictitious", "gyrocompass")["bodies"]["rotor"]["torques"]
    third, spin, turn, colatitude = sympy.symbols("I_3 omega Omega lambda_")
    assert agree(torques["coriolis"]["1"], third * spin * turn * sin(colatitude) * sin(theta))


def test_no_torques_in_a_frame_at_rest(polhode):
    code, out, _ = polhode("fictitious", "rolling-disk", "--frame", "lab")
    assert code == 0
    assert "total = 0" in out


@pytest.mark.parametrize("command", ["lagrangian", "linearise", "vectors", "fictitious"])
def test_the_text_of_every_command(polhode, command):
    code, out, err = polhode(command, "gyroscope")
    assert (code, err) == (0, "")
    assert "θ̇" in out or "δ̇_θ" in out


def test_the_force_in_steady_precession(document):
    """Problem set, (122): F = -M a φ̇² sin θ ρ̂ + M g ẑ."""
    words = ("vectors", "gyroscope", "--along", "rho,phi,z", "--steady")
    force = document(*words)["vectors"]["F_pivot"]
    mass = sympy.symbols("M")
    assert agree(force["rho"], -mass * a * phi_dot**2 * sin(theta))
    assert agree(force["phi"], sympy.Integer(0))
    assert agree(force["z"], mass * g)
