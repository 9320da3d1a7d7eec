"""Systems that a solution could not be written of: other axes, other names, other loads, time."""

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import to_sympy
from polhode.analyse import stability, steady
from polhode.base import DeclarationError
from polhode.derive import derive_in_parts
from polhode.judge import check
from polhode.solution._judge import judged
from polhode.solution._named_parts import _NamedParts, _velocities
from polhode.solution._setting import Setting
from solution.letters import undefined_letters

lab = ph.Frame("lab")


def formulas_of(found):
    return [step.latex for step in found.steps if step.latex]


def words_of(found):
    return " ".join(step.words for step in found.steps)


# -- two frames of one name ------------------------------------------------------------------------


def cylinder_with_a_pendulum():
    """The axes of both are called lab', and only those of the bob have the labels 1 2 3."""
    m, M, R, l, g = ph.symbols("m M R l g", positive=True)
    theta, beta = ph.coordinates("theta beta")
    x, z = lab["x"], lab["z"]
    inertia = (M * R**2 / 2,) * 3
    cylinder = ph.Body("cylinder", mass=M, inertia=inertia, axes=lab.rotated(beta, "y"), tag="c")
    bob = ph.point_mass("bob", mass=m, axes=lab.rotated(theta, "y", labels="1 2 3"), tag="b")
    return ph.System(
        ph.Pivot(cylinder, only="y z", name="floor"),
        ph.Hinge(cylinder, axis="y"),
        ph.Rack(cylinder, at=z * -R, along=x, force="Q"),
        ph.Pivot(bob, at=bob.axes["3"] * l, to=cylinder.point(), name="string", force="T"),
        ph.Hinge(bob, axis="2", name="plane"),
        ph.Gravity(g),
        name="cylinder with a pendulum",
    )


def test_the_axes_of_one_of_two_bodies_have_their_own_labels():
    found = ph.solution(cylinder_with_a_pendulum())
    assert any(r"\hat{\mathbf 3}" in text for text in formulas_of(found))
    assert undefined_letters(found) == {}


# -- a ball with three moments of inertia ----------------------------------------------------------


def chaplygins_ball():
    r, m, g, I_1, I_2, I_3 = ph.symbols("r m g I_1 I_2 I_3", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    ball = ph.Body(
        "ball",
        mass=m,
        inertia=(I_1, I_2, I_3),
        axes=axes,
        spin=ph.Components(),
        surface=ph.Round(r, "3", 0),
    )
    return ph.System(ph.Rolling(ball, on=ph.Plane(lab)), ph.Gravity(g), name="Chaplygin's ball")


def chaplygin(state, moments, m=1.3, r=0.7):
    """K' = K × ω, γ' = γ × ω along axes of the body, with K = I ω + m r² γ × (ω × γ) (1903)."""
    omega, up = state[:3], state[3:]
    tensor = np.diag(moments) + m * r**2 * (np.eye(3) - np.outer(up, up))
    turned = np.cross(up, omega)
    change = -m * r**2 * (np.outer(turned, up) + np.outer(up, turned)) @ omega
    rates = np.linalg.solve(tensor, np.cross(tensor @ omega, omega) - change)
    return np.concatenate([rates, turned])


def eigenvalues(state, moments):
    h = 1e-6
    columns = [
        (chaplygin(state + h * e, moments) - chaplygin(state - h * e, moments)) / (2 * h)
        for e in np.eye(6)
    ]
    return np.linalg.eigvals(np.array(columns).T)


@pytest.fixture(scope="module")
def steady_of_the_ball():
    return steady(ph.derive(chaplygins_ball()))


def test_chaplygins_ball_rolls_steadily_about_each_axis_that_is_vertical(steady_of_the_ball):
    moments = (0.31, 0.23, 0.42)
    turning = [f for f in steady_of_the_ball if {"psi", "theta"} <= {s.name for s in f.fixed}]
    vertical = {str(f) for f in turning}
    assert len(vertical) == 8  # axes 1 and 2, up and down, each at two tilts of opposite sign
    for family in turning:
        (free,) = [s for s in family.free if s.name.startswith("omega")]
        angles = {s.name: to_sympy(v) for s, v in family.fixed.items() if not s.order}
        theta, psi = float(angles["theta"]), float(angles["psi"])
        up = np.array([np.sin(theta) * np.sin(psi), np.sin(theta) * np.cos(psi), np.cos(theta)])
        omega = np.array([2.5 if f"omega_{i}" == free.name else 0.0 for i in (1, 2, 3)])
        assert chaplygin(np.concatenate([omega, up]), moments) == pytest.approx(np.zeros(6))


def test_about_its_axis_of_the_middle_moment_it_is_unstable(steady_of_the_ball):
    names = ph.symbols("I_1 I_2 I_3 m r", positive=True)
    for family in steady_of_the_ball:
        if {"psi", "theta"} <= {s.name for s in family.fixed}:
            free = next(s for s in family.free if s.name.startswith("omega"))
            axis = int(free.name[-1]) - 1
            for moments in ((0.31, 0.23, 0.42), (0.23, 0.31, 0.42), (0.42, 0.31, 0.23)):
                values = dict(
                    zip(("I_1", "I_2", "I_3", "m", "r"), (*moments, 1.3, 0.7), strict=True)
                )
                at = {n: values[str(n)] for n in names}
                found = stability(family, {**at, ph.Expr.generator(free): 2.5})
                state = np.zeros(6)
                state[axis], state[3 + axis] = 2.5, 1.0
                grows = np.max(eigenvalues(state, moments).real) > 1e-4
                assert (str(found) == "stable") == (not grows)
                assert grows == (sorted(moments)[1] == moments[axis])


def test_its_solution_is_written():
    found = ph.solution(chaplygins_ball())
    assert r"\psi = \frac{\pi}{2}" in words_of(found)
    assert undefined_letters(found) == {}


# -- names of programs -----------------------------------------------------------------------------


def bar(mass="m1", length="l1", moment="Ixx", angle="theta1"):
    m, l, I, g = ph.symbols(f"{mass} {length} {moment} g", positive=True)
    axes = lab.rotated(ph.coordinate(angle), "y", labels="1 2 3")
    body = ph.Body("bar", mass=m, inertia=(I, I, 0), axes=axes)
    hinge = ph.Hinge(body, axis="2", name="axle")
    return ph.System(ph.Pivot(body, at=axes["3"] * l), hinge, ph.Gravity(g), name="bar")


def test_letters_with_numbers_are_printed_and_read_as_texts_have_them():
    found = ph.solution(bar())
    assert "mass $m_1$" in words_of(found)
    assert undefined_letters(found) == {}
    system = ph.derive(bar())
    law = r"(I_{xx} + m_1 l_1^2)\ddot{\theta}_1 = m_1 g l_1 \sin\theta_1"
    flipped = law.replace("= m_1", "= -m_1")
    answers = {check(text, system).answer.value for text in (law,)}, check(flipped, system)
    assert {*answers[0], answers[1].answer.value} == {"holds", "fails"}


def test_a_word_is_no_letter_of_a_solution():
    with pytest.raises(DeclarationError, match="quantities called mass"):
        ph.solution(bar(mass="mass"))


def test_names_that_are_printed_alike_are_refused():
    with pytest.raises(DeclarationError, match="m1 and m_1, which are printed as one letter"):
        ph.derive(bar(moment="m_1"))


# -- what else could not be judged -----------------------------------------------------------------


def test_loads_count_in_named_parts():
    """A cart on two wheels with a steered one that a damper turns: equations in named parts."""
    m, M, I, J, a, b, c, k = ph.symbols("m M I J a b c k", positive=True)
    phi, beta = ph.coordinates("phi beta")
    turned = lab.rotated(phi, "z")
    frame = ph.Body("frame", mass=m, inertia=(I, I, I), axes=turned, spin=ph.WithAxes())
    forward = turned.rotated(beta, "z")
    fork = ph.Body("fork", mass=M, inertia=(J, J, J), axes=forward, spin=ph.WithAxes(), tag="_f")
    sides = [turned["x"] * -a + turned["y"] * (sign * b) for sign in (1, -1)]
    system = ph.System(
        ph.Pivot(frame, only="z", name="floor"),
        ph.Hinge(frame, axis="z", name="upright"),
        ph.KnifeEdge(frame, across="y", at=sides[0], name="left", force="L"),
        ph.KnifeEdge(frame, across="y", at=sides[1], name="right", force="R"),
        ph.Pivot(fork, to=frame.point(turned["x"] * c), name="head", force="H"),
        ph.Hinge(fork, axis="z", to=frame, name="steering", torque="sigma"),
        ph.KnifeEdge(fork, across="y", at=forward["x"] * -b, name="front", force="N"),
        ph.TorsionDamper(beta, damping=k, on=(frame, fork)),
        name="steered cart",
    )
    # each formula is compared with the rows that are derived, and refused if it differs
    lines = list(_NamedParts(derive_in_parts(system)).lines())
    assert any(r"- \boldsymbol\tau_b" in line.latex for line in lines)
    assert any(r"$\boldsymbol\tau_b$ for the force of the other loads" in s.words for s in lines)


@pytest.mark.parametrize("labels", ["x y z", "1 2 3"])
def test_the_lowest_point_of_a_wheel_whose_axes_have_the_labels_of_the_laboratory(labels):
    """Along its own axle: ŷ of the laboratory is another direction than axis y of the wheel."""
    m, r, g, A, B = ph.symbols("m r g A B", positive=True)
    phi, theta = ph.coordinates("phi theta")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels=labels)
    axle = labels.split()[1]
    wheel = ph.Body(
        "wheel", mass=m, inertia=(A, B, A), axes=axes, spin_about=axle, surface=ph.Rim(r, axle)
    )
    rolling = ph.Rolling(wheel, on=ph.Plane(lab), name="ground")
    equations = derive_in_parts(ph.System(rolling, ph.Gravity(g), name="wheel"))
    lines = [line for line in _velocities(Setting(equations)) if line.latex]
    assert any(r"\boldsymbol\omega\times" in line.latex for line in lines)
    assert all(judged(line, equations).holds for line in lines)
