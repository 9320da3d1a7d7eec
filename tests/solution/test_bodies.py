"""Solutions of several bodies and of several supports, against textbooks and SymPy."""

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import polhode as ph
from polhode.algebra import to_sympy
from solution import own_systems


@pytest.fixture(scope="module")
def pendulum():
    return ph.solution(own_systems.double_pendulum(), "newton")


@pytest.fixture(scope="module")
def ladder():
    return ph.solution(own_systems.sliding_ladder())


@pytest.fixture(scope="module")
def gyro():
    return ph.solution(own_systems.gimballed_gyro(), "newton")


def shown(solution, section=""):
    steps = solution.sections[section] if section else solution.steps
    return [step.latex for step in steps if step.latex]


def words(solution):
    return " ".join(step.words for step in solution.steps)


def test_each_body_has_its_velocity_and_its_law(pendulum):
    found = shown(pendulum)
    for body in ("upper", "lower"):
        assert any(line.startswith(rf"\mathbf v_{{\rm {body}}} =") for line in found)
    law = (
        r"\mathbf F_{\rm nail} - \mathbf F_{\rm joint} - m g\,\hat{\mathbf z} = "
        r"m\frac{d\mathbf v_{\rm upper}}{dt}"
    )
    assert law in found
    assert "the reaction of its neighbour" in words(pendulum)
    assert "d'Alembert's principle" in words(pendulum)


def test_the_double_pendulum_moves_as_lagrange_says(pendulum):
    """The rows displayed are combinations of those that SymPy finds from T - V."""
    m, l, g = sp.symbols("m l g", positive=True)
    t = dynamicsymbols._t
    alpha, beta = dynamicsymbols("alpha beta")
    x = [-l * sp.sin(alpha), -l * sp.sin(alpha) - l * sp.sin(beta)]
    z = [-l * sp.cos(alpha), -l * sp.cos(alpha) - l * sp.cos(beta)]
    lagrangian = sum(
        m * (a.diff(t) ** 2 + b.diff(t) ** 2) / 2 - m * g * b for a, b in zip(x, z, strict=True)
    )
    for row, q in zip(ph.derive(own_systems.double_pendulum()).motion, (alpha, beta), strict=True):
        assert f"{row.latex()} = 0" in shown(pendulum)
        expected = (lagrangian.diff(q.diff(t)).diff(t) - lagrangian.diff(q)) / (m * l)
        numbers = {alpha: 0.7, beta: -0.4, l: 1.3, g: 9.1, m: 0.6}
        rates = {alpha.diff(t): 0.9, beta.diff(t): -1.7}
        bends = {alpha.diff(t, 2): 2.1, beta.diff(t, 2): 0.3}
        wanted = float(expected.subs(bends).subs(rates).subs(numbers))
        names = {"alpha": 0.7, "beta": -0.4, "l": 1.3, "g": 9.1, "m": 0.6}
        names |= {"alpha_dot": 0.9, "beta_dot": -1.7, "alpha_ddot": 2.1, "beta_ddot": 0.3}
        value = float(to_sympy(row).subs({sp.Symbol(k): v for k, v in names.items()}))
        assert value == pytest.approx(wanted)


def test_the_ladder_leaves_the_wall_at_two_thirds_of_its_height(ladder):
    """Textbook: 4 l θ̈ = 3 g sin θ, and the wall no longer pushes where cos θ = 2 cos θ₀/3."""
    assert r"4 l \ddot{\theta} - 3 g \sin\theta = 0" in shown(ladder)
    wall = (
        r"\mathbf F_{\rm wall} = m l \left(\dot{\theta}^2 \sin\theta - \ddot{\theta} "
        r"\cos\theta\right)\,\hat{\mathbf x}"
    )
    assert wall in shown(ladder)
    c, c_0, g, l = sp.symbols("c c_0 g l", positive=True)
    rate2, over_sine = 3 * g / (2 * l) * (c_0 - c), 3 * g / (4 * l)  # from rest at θ₀
    assert sp.solve(rate2 - over_sine * c, c) == [2 * c_0 / 3]


def test_the_ladders_point_and_the_sleighs_edge_are_described(ladder):
    said = words(ladder)
    assert r"The point of the ladder at $l\,\hat{\mathbf 3}$ from its centre of mass" in said
    assert "cannot move along $x$" in said
    sleigh = words(ph.solution(own_systems.chaplygin_sleigh()))
    assert "is a sharp edge, which cannot move along its axis $2$" in sleigh


def test_the_couples_between_gimbals_are_letters_in_the_torques(gyro):
    torques = [line for line in shown(gyro) if line.endswith(r"\frac{d\mathbf L_{\rm rotor}}{dt}")]
    assert len(torques) == 1
    assert r"\tau_{1,r}\,\hat{\mathbf 1}" in torques[0]
    assert "stays at rest; its angular velocity is" in words(gyro)
    assert r"\dot{\omega}_{3,r} = 0" in shown(gyro, "Equations of motion")


def test_constraints_that_act_on_several_bodies_have_letters():
    """Two wheels on an axle, whose torques contain the forces by which they roll."""
    found = ph.solution(own_systems.two_wheels())
    laws = shown(found)
    assert any(r"\frac{T_L \cos\phi}{a}" in line for line in laws)
    assert r"$\mathbf F_{3}$ (“left bearing”)" in words(found)
    row = (
        r"\left(8 M b^2 + 3 m a^2 + 36 m b^2\right) \ddot{\phi} - 6 a b \left(M + 3 m\right) "
        r"\dot{\omega}_{2,R} = 0"
    )
    assert row in laws  # with v̇ = a ω̇_R - b φ̈ = 0 it is (2 M b² + 3 m a² + 18 m b²) φ̈ = 0


def test_equilibrium_is_not_called_steady_motion(pendulum):
    assert r"Equilibrium is possible at $\alpha = \pi$ and $\beta = 0$" in words(pendulum)
