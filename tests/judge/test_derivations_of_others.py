"""What derivations by others, written without knowing the rules, have in common."""

import pytest

import polhode as ph
from polhode.judge import Mark

m, M, l, g, R, alpha, mu = ph.symbols("m M l g R alpha mu", positive=True)
LAB = ph.Frame("lab")


def marks(text, equations):
    return [line.mark for line in ph.review(text, equations, format=".md").lines]


@pytest.fixture(scope="module")
def spherical_rod():
    """A rod that hangs from a ball joint, θ from hanging, φ its azimuth."""
    theta, phi = ph.coordinates("theta phi")
    axes = LAB.rotated(phi, "z").rotated(-theta, "y", labels="1 2 3")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="3")
    return ph.derive(ph.System(ph.Pivot(rod, at=axes["3"] * (l / 2), name="joint"), ph.Gravity(g)))


@pytest.fixture(scope="module")
def falling_rod():
    """A rod on a hinge, θ below the horizontal."""
    axes = LAB.rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="x")
    hinge = ph.Pivot(rod, at=axes["x"] * (-l / 2), name="hinge", force="F")
    return ph.derive(ph.System(hinge, ph.Hinge(rod, axis="y", name="plane"), ph.Gravity(g)))


@pytest.fixture(scope="module")
def thrown_ball():
    """A ball on a rough table that slides along a line."""
    phi = ph.coordinate("phi")
    ball = ph.sphere("ball", mass=m, radius=R, axes=LAB.rotated(phi, "y"), spin=ph.WithAxes())
    system = ph.System(
        ph.Pivot(ball, only="y", name="line", force="S"),
        ph.Hinge(ball, axis="y", name="level axis"),
        ph.Coulomb(ball, on=ph.Plane(LAB), mu=mu, name="table", force="F"),
        ph.Gravity(g),
        speeds={"v": ph.coordinate("x").dt(), "omega": phi.dt()},
    )
    return ph.derive(system)


@pytest.fixture(scope="module")
def roller():
    """A cylinder that rolls down a wedge on a smooth table; the friction on it is f."""
    slope = LAB.rotated(alpha, "y")
    wedge = ph.point_mass("wedge", mass=M, axes=LAB)
    carriage = ph.Body("carriage", mass=0, axes=slope)
    inertia = (m * R**2, m * R**2 / 2, m * R**2)
    axes = slope.rotated(ph.coordinate("theta"), "y")
    cylinder = ph.Body("cylinder", mass=m, inertia=inertia, axes=axes, tag="m")
    slides = {"to": wedge.point(), "distance": "s", "torque": "tau_c"}
    rolls = {"at": slope["z"] * -R, "along": slope["x"], "to": wedge}
    system = ph.System(
        ph.Slider(wedge, axis="x", distance="X", name="table", force="P", torque="tau_w"),
        ph.Slider(carriage, axis="x", along=slope, name="face", force="N", **slides),
        ph.Pivot(cylinder, to=carriage.point(), name="centre"),
        ph.Hinge(cylinder, axis="y", name="level axis"),
        ph.Rack(cylinder, name="rolling", force="f", **rolls),
        ph.Gravity(g),
    )
    return ph.derive(system)


MOMENTUM = r"""# Lagrange

Its momentum is $$p = \frac{ml^2}{3}\dot\phi\sin^2\theta.$$

# Effective potential

"""
W = r"W(\theta) = \frac{3p^2}{2ml^2\sin^2\theta} - \frac{mgl}{2}\cos\theta"
ENERGY = r"E = \frac{ml^2}{6}\dot\theta^2 + W(\theta)"


def test_letters_of_an_earlier_part_are_tried_where_usual_meanings_fail(spherical_rod):
    """p = m v would be of another dimension."""
    text = rf"{MOMENTUM} The energy is $${ENERGY}, \qquad {W}.$$ So $${W}$$ and $${ENERGY}.$$"
    _, *found = marks(text, spherical_rod)
    assert found == [Mark.TRUE, Mark.NOT_JUDGED, Mark.TRUE, Mark.TRUE]


def test_a_wrong_energy_in_a_function_of_place_is_no_definition(spherical_rod):
    wrong = ENERGY.replace("6", "3")
    _, _, found = marks(rf"{MOMENTUM} With $${W}$$ the energy is $${wrong}.$$", spherical_rod)
    assert found in (Mark.DOUBT, Mark.ERROR)


@pytest.mark.parametrize(
    ("slope", "mark"), [(r"mR\sin\theta\,(g - R\Omega^2\cos\theta)", Mark.TRUE), ("mgR", None)]
)
def test_primes_of_a_potential_are_derivatives(slope, mark):
    """Of a bead on a hoop that is turned at Ω."""
    turned = ph.earth(ph.symbol("Omega", positive=True), colatitude=0)
    axes = turned.rotated(-ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=m, axes=axes)
    wire = ph.Pivot(bead, to=axes["z"] * -R, name="wire", along=axes)
    hoop = ph.derive(ph.System(wire, ph.Gravity(g)))
    text = r"The effective potential is $U(\theta) = -mgR\cos\theta"
    text += rf"- \tfrac12mR^2\Omega^2\sin^2\theta$. Then $$U'(\theta) = {slope}.$$"
    first, found = marks(text, hoop)
    assert first == Mark.TRUE
    assert found == mark if mark else found in (Mark.DOUBT, Mark.ERROR)


def test_rest_at_an_angle_is_a_start(falling_rod):
    text = r"Energy (rest at $\theta=0$): $\frac16 ml^2\dot\theta^2=\frac12 mgl\sin\theta$."
    assert marks(text, falling_rod) == [Mark.NOT_JUDGED, Mark.TRUE]
    wrong = text.replace("16", "13")
    assert marks(wrong, falling_rod)[1] in (Mark.DOUBT, Mark.ERROR)


@pytest.mark.parametrize(("number", "mark"), [(3, Mark.TRUE), (12, Mark.ERROR)])
def test_a_moment_of_inertia_that_words_name_is_a_claim(falling_rod, number, mark):
    """With a label of the text's own, and the words in the sentence before."""
    text = "I need the moment of inertia about the hinge. For a thin rod we know that it is "
    assert marks(rf"{text} $$I_h=\frac{{1}}{{{number}}}ml^2.$$", falling_rod) == [mark]


@pytest.mark.parametrize("line", [r"m\dot v = -\mu mg", r"\dot\omega = \frac{5\mu g}{2R}"])
def test_friction_of_one_direction_needs_that_direction(thrown_ball, line):
    (found,) = ph.review(f"$${line}$$", thrown_ball, format=".md").lines
    assert found.mark == Mark.NEEDS
    assert found.needs == r"R \omega - v < 0"


def test_wrong_friction_is_needed_in_neither_direction(thrown_ball):
    (found,) = marks(r"$$m\dot v = -2\mu mg$$", thrown_ball)
    assert found in (Mark.DOUBT, Mark.ERROR)


BALANCES = r"""Along the face $$m(\ddot s + \ddot X\cos\alpha) = mg\sin\alpha - f,$$
about the axis $$\tfrac12 mR^2\ddot\theta = fR,$$ and so $$f = \tfrac12 m\ddot s.$$
"""


@pytest.mark.parametrize(("sign", "mark"), [("+", Mark.TRUE), ("-", Mark.DOUBT)])
def test_a_force_has_one_sense_in_a_part(roller, sign, mark):
    """The model counts f down the face, the text up."""
    wedge = rf"Of the wedge $$M\ddot X = -N\sin\alpha {sign} f\cos\alpha.$$"
    assert marks(BALANCES + wedge, roller) == [*[Mark.TRUE] * 3, mark]


def test_a_force_of_the_text_is_not_the_reaction_of_another_dimension():
    """A constraint in coordinates has a couple for its reaction f here; the text means a force."""
    r = ph.symbol("r", positive=True)
    theta, phi = ph.coordinates("theta phi")
    line = LAB.rotated(-theta, "y")
    ball = ph.sphere("ball", mass=m, radius=r, axes=LAB.rotated(phi, "y"), spin=ph.WithAxes())
    system = ph.System(
        ph.Pivot(ball, to=line["z"] * (r - R), along=line, name="wall", force="N"),
        ph.Hinge(ball, axis="y", name="level axis"),
        ph.Constraint((R - r) * theta - r * phi, on=ball, name="rolling", force="f"),
        ph.Gravity(g),
    )
    text = r"With the friction $f$, $$m(R-r)\ddot\theta = f - mg\sin\theta.$$"
    assert marks(text, ph.derive(system)) == [Mark.DOUBT]


def test_the_size_of_a_complex_number():
    """ζ = ω₁ + iω₂ of a free symmetric body."""
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    a = ph.symbol("A", positive=True)
    body = ph.Body("body", mass=m, inertia=(a, a, 2 * a), axes=axes)
    equations = ph.derive(ph.System(ph.Pivot(body)))
    text = r"Let $\zeta := \omega_1 + i\omega_2$ and $\rho := |\zeta|$. Then "
    text += r"$$\rho^2 = \omega_1^2 + \omega_2^2.$$"
    assert marks(text, equations)[-1] == Mark.TRUE


def test_parameters_in_a_ratio_are_let():
    """It is an assumption, and no claim about every system."""
    k = ph.symbol("k", positive=True)
    body = ph.point_mass("body", mass=m, axes=LAB)
    system = ph.System(
        ph.Pivot(body, only="y z", name="rail"),
        ph.Spring(body.point(), LAB.zero, stiffness=k, length=l, name="spring"),
        ph.Gravity(g),
    )
    assert marks("Let $kl = 2mg$.", ph.derive(system)) == [Mark.NOT_JUDGED]


def test_a_letter_that_no_line_confirms_makes_no_doubt(spherical_rod):
    """Ω may be the magnitude of the angular velocity, or whatever the text has in mind."""
    line = r"$$2\Omega^2 l\cos\theta = 3g + l\Omega^2.$$"
    assert marks(line, spherical_rod) == [Mark.NOT_JUDGED]
    known = r"In steady precession $\dot\phi = \Omega$ and $\theta = \text{const}$. Then "
    assert marks(known + line, spherical_rod)[-1] in (Mark.DOUBT, Mark.ERROR)
    right = r"$$\Omega^2\cos\theta = \frac{3g}{2l}.$$"
    assert marks(known + right, spherical_rod)[-1] == Mark.TRUE
