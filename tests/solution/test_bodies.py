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
        r"\mathbf F - \mathbf G - m g\,\hat{\mathbf z} = "
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
        r"\mathbf W = m l \left(\dot{\theta}^2 \sin\theta - \ddot{\theta} "
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
    assert r"$\mathbf P$ (“left bearing”)" in words(found)
    row = (
        r"\left(8 M b^2 + 3 m a^2 + 36 m b^2\right) \ddot{\phi} - 6 a b \left(M + 3 m\right) "
        r"\dot{\omega}_{2,R} = 0"
    )
    assert row in laws  # with v̇ = a ω̇_R - b φ̈ = 0 it is (2 M b² + 3 m a² + 18 m b²) φ̈ = 0


def test_equilibrium_is_not_called_steady_motion(pendulum):
    assert r"Equilibrium is possible at $\alpha = 0$ and $\beta = 0$" in words(pendulum)


def test_normal_modes_of_the_double_pendulum(pendulum):
    """ω² = (2 ∓ √2) g/l with β = ±√2 α: Landau and Lifshitz, Mechanics, § 23, problem 2."""
    found = shown(pendulum)
    assert r"l^2 \omega^4 - 4 g l \omega^2 + 2 g^2 = 0" in found
    assert r"\omega_{1,2}^2 = \frac{g \left(2 \mp \sqrt{2}\right)}{l}" in found
    shapes = r"In the first mode $\beta = \sqrt{2} \alpha$ and in the second mode $\beta = -\sqrt"
    assert shapes in words(pendulum)


def test_oscillations_that_are_independent_have_their_own_frequencies():
    """A bar on two springs at its ends: 2k/m up and down, 6k/m about its centre."""
    m, l, g, k = ph.symbols("m l g k", positive=True)
    theta, z = ph.coordinates("theta z")
    axes = ph.Frame("lab").rotated(theta, "y", labels="1 2 3")
    bar = ph.rod("bar", mass=m, length=2 * l, axes=axes, axis="1")
    energy = k * ((z - l * ph.sin(theta)) ** 2 + (z + l * ph.sin(theta)) ** 2) / 2
    guided = (ph.Pivot(bar, only="x y", name="guide"), ph.Hinge(bar, axis="2"))
    springs = ph.Potential(energy, on=bar, name="springs")
    text = words(ph.solution(ph.System(*guided, springs, ph.Gravity(g), name="bar")))
    assert r"$z = -\frac{m g}{2 k}$" in text
    assert r"$\theta$ at the angular frequency $\sqrt{\frac{6 k}{m}}$" in text
    assert r"$\epsilon$ at the angular frequency $\sqrt{\frac{2 k}{m}}$" in text


def test_a_pendulum_on_a_cart():
    """ω² = (M + m) g/(M l), the cart eliminated; nothing trivial is called conserved."""
    M, m, l, g = ph.symbols("M m l g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "y", labels="1 2 3")
    cart = ph.point_mass("cart", mass=M, axes=lab, tag="c")
    bob = ph.point_mass("bob", mass=m, axes=axes, tag="b")
    joint = ph.Pivot(bob, at=axes["3"] * l, to=cart.point(), name="joint", force="G")
    rail = ph.Pivot(cart, only="y z", name="rail", force="N")
    found = ph.solution(ph.System(rail, joint, ph.Gravity(g), name="cart"))
    assert r"\ddot{\epsilon} \approx -\frac{g \left(M + m\right) \epsilon}{M l}" in shown(found)
    assert r"$\sqrt{\frac{g \left(M + m\right)}{M l}}$" in words(found)
    assert not any("y_c" in line or "z_c" in line for line in shown(found))


def test_a_constant_acceleration_is_solved_for():
    """A yo-yo on a string held still: its acceleration, and the tension by means of it."""
    m, r, I, g = ph.symbols("m r I g", positive=True)
    lab = ph.Frame("lab")
    yoyo = ph.Body("yo-yo", mass=m, inertia=(I, I, I), axes=lab.rotated(ph.coordinate("phi"), "y"))
    string = ph.Rack(yoyo, at=lab["x"] * -r, along=lab["z"], name="string", force="S")
    guided = (ph.Pivot(yoyo, only="x y", name="hand"), ph.Hinge(yoyo, axis="y"))
    found = shown(ph.solution(ph.System(*guided, string, ph.Gravity(g), name="yo-yo")))
    assert r"\ddot{\phi} = \frac{m g r}{I + m r^2}" in found
    assert r"\mathbf S = \frac{m I g}{I + m r^2}\,\hat{\mathbf z}" in found


def test_axes_of_a_body_without_mass_may_have_letters_of_their_own():
    """The axes t, y, r of an arm, along which the cylinder at its end is described."""
    m, a, R, g = ph.symbols("m a R g", positive=True)
    theta, psi = ph.coordinates("theta psi")
    lab = ph.Frame("lab")
    turned = lab.rotated(theta, "y", labels="t y r")
    arm = ph.Body("arm", mass=0, axes=turned, tag="arm")
    inertia = (m * a**2 / 2,) * 3
    cylinder = ph.Body("cylinder", mass=m, inertia=inertia, axes=lab.rotated(psi, "y"))
    trough = ph.System(
        ph.Pivot(arm, name="middle", force="P"),
        ph.Hinge(arm, axis="y"),
        ph.Pivot(cylinder, to=arm.point(turned["r"] * (a - R)), name="arm end", force="N"),
        ph.Hold(cylinder, at=turned["r"] * -a, along=turned, only="t", name="rolling"),
        ph.Hinge(cylinder, axis="y", name="guide"),
        ph.Gravity(g),
        name="trough",
    )
    text = words(ph.solution(trough))
    assert r"angular frequency $\sqrt{\frac{2 g}{3 \left(R - a\right)}}$ if" in text


def test_pendulums_joined_by_a_spring():
    """g/l and g/l + 2k/m, though the equations of motion are too long to be written out."""
    m, l, g, k, D = ph.symbols("m l g k D", positive=True)
    lab = ph.Frame("lab")
    bobs = []
    for name, angle in (("left", "alpha"), ("right", "beta")):
        axes = lab.rotated(ph.coordinate(angle), "y")
        bobs.append(ph.point_mass(name, mass=m, axes=axes, tag=name[0]))
    nails = [
        ph.Pivot(bob, at=bob.axes["z"] * l, to=lab["x"] * (i * D), name=f"{bob.name} nail")
        for i, bob in enumerate(bobs)
    ]
    spring = ph.Spring(bobs[0].point(), bobs[1].point(), stiffness=k, length=D)
    found = ph.solution(ph.System(*nails, spring, ph.Gravity(g), name="coupled"), "lagrange")
    modes = r"\omega_1^2 = \frac{g}{l}, \qquad \omega_2^2 = \frac{2 k}{m} + \frac{g}{l}"
    assert modes in shown(found)
    assert r"In the first mode $\beta = \alpha$ and in the second mode $\beta = -\alpha$" in words(
        found
    )
