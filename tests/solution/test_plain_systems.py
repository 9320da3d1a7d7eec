"""Solutions of ten plain systems as a student reads them: letters, loads, frequencies, figures."""

import re
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

import polhode as ph
from polhode.solution import item_tex
from polhode.solution._tex_rows import WIDE, width
from solution.letters import undefined_letters

M, m, m_2, k, l, a, b, c, g, R, h = ph.symbols("M m m_2 k l a b c g R h", positive=True)
J, I = ph.symbols("J I", positive=True)
Omega, beta = ph.symbol("Omega"), ph.symbol("beta")
lab = ph.Frame("lab")
theta, phi = ph.coordinates("theta phi")
upright = lab.rotated(theta, "y", labels="1 2 3", name="rod axes")


def words_of(solution):
    return " ".join(step.words for step in solution.steps)


def formulas_of(solution):
    return [step.latex for step in solution.steps if step.latex]


def cart_and_rod():
    cart = ph.Body("cart", mass=M, inertia=(J, J, J), axes=lab, spin=ph.WithAxes(), tag="c")
    rod = ph.rod("rod", mass=m, length=2 * l, axes=upright, axis="3")
    return ph.System(
        ph.Slider(cart, axis="x", name="rail", force="N"),
        ph.Pivot(rod, at=upright["3"] * l, to=cart.point(), name="pin"),
        ph.Gravity(g),
        name="cart and rod",
    )


def drum_and_spring():
    axes = lab.rotated(theta, "y", name="spokes")
    drum = ph.cylinder("drum", mass=m, radius=a, height=b, axes=axes, axis="y", spin=ph.WithAxes())
    return ph.System(
        ph.Pivot(drum, only="y z", name="rails", force="N"),
        ph.Hinge(drum, axis="y", name="level"),
        ph.Rack(drum, at=lab["z"] * -a, along=lab["x"], name="floor"),
        ph.Spring(drum.point(), lab["x"] * 0, stiffness=k),
        name="drum and spring",
    )


def weights_on_a_pulley():
    axes = lab.rotated(ph.coordinate("psi"), "y", name="wheel axes")
    pulley = ph.cylinder(
        "pulley", mass=M, radius=R, height=b, axes=axes, axis="y", tag="p", spin=ph.WithAxes()
    )
    first = ph.point_mass("first weight", mass=m, axes=lab, tag="1")
    second = ph.point_mass("second weight", mass=m_2, axes=lab, tag="2")
    ends = [(first, lab["x"] * -R), (second, lab["x"] * R)]
    ropes = (
        ph.Rope([w.point(), pulley.point(at)], directions=[lab["z"]], name=f"rope of {w.name}")
        for w, at in ends
    )
    guides = (ph.Pivot(w, to=at, only="x y", name=f"guide of {w.name}") for w, at in ends)
    held = (ph.Pivot(pulley, name="axle"), ph.Hinge(pulley, axis="y"))
    return ph.System(*held, *ropes, *guides, ph.Gravity(g), name="weights on a pulley")


def two_balls_on_a_light_rod():
    axes = lab.rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="arm axes")
    arm = ph.Body("arm", mass=0, axes=axes, spin=ph.WithAxes(), tag="l")
    near = ph.point_mass("near ball", mass=m, axes=axes, tag="1")
    far = ph.point_mass("far ball", mass=M, axes=axes, tag="2")
    return ph.System(
        ph.Pivot(arm, name="joint"),
        ph.Pivot(near, to=arm.point(axes["3"] * -a), name="near end", force="S"),
        ph.Pivot(far, to=arm.point(axes["3"] * -b), name="far end", force="T"),
        ph.Universal(arm, arm=axes["2"], other_arm=lab["z"], name="cross"),
        ph.Gravity(g),
        name="two balls on a light rod",
    )


def rattleback(moments):
    """Of T. R. Kane and D. A. Levinson (1982), with axes that have letters of their own."""
    axes = lab.rotated(ph.coordinate("psi"), "z").rotated(phi, "x")
    axes = axes.rotated(theta, "y", labels="1 2 3")
    halves = ph.symbols("a b c", positive=True)
    stone = ph.ellipsoid("stone", mass=m, half_axes=halves, axes=axes, inertia=moments)
    return ph.System(ph.Rolling(stone, on=ph.Plane(lab)), ph.Gravity(g), name="rattleback")


# -- forces ----------------------------------------------------------------------------------------


def test_forces_have_the_letters_of_the_declaration_in_text_and_figure():
    found = ph.solution(cart_and_rod(), "newton")
    assert r"\mathbf N - \mathbf F - M g\,\hat{\mathbf z} = M\frac{d\mathbf v_{\rm cart}}{dt}" in (
        formulas_of(found)
    )
    named = {letter.name.latex for letter in found.figure.letters if letter.style == "force"}
    assert named == {r"\mathbf{N}", r"\mathbf{F}", "M g", "m g"}


def test_the_only_force_may_have_another_letter_than_F():
    axes = lab.rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="top axes")
    I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
    top = ph.Body("top", mass=m, inertia=(I_1, I_1, I_3), axes=axes, spin_about="3")
    table = ph.Pivot(top, at=axes["3"] * -l, only="z", name="table", force="N")
    found = ph.solution(ph.System(table, ph.Gravity(g), name="top on a smooth table"), "newton")
    assert any(line.startswith(r"\mathbf N = m ") for line in formulas_of(found))
    assert not any(r"\mathbf F" in line for line in formulas_of(found))
    once = [line for line in formulas_of(found) if r"\dot{v}_x" in line and line.endswith("= 0")]
    assert once == [r"\dot{v}_x = \dot{v}_y = 0"]


def test_accelerations_stand_between_the_laws_and_the_equations_of_motion():
    """d²/dt² of s + ... by hand: the rod's middle is at s x̂ - l 3̂."""
    lines = formulas_of(ph.solution(cart_and_rod(), "newton"))
    assert r"\frac{d\mathbf v_{\rm cart}}{dt} = \ddot{s}_c\,\hat{\mathbf x}" in lines
    (rod,) = (x for x in lines if x.startswith(r"\frac{d\mathbf v_{\rm rod}}{dt} = "))
    assert r"l \dot{\theta}^2" in rod
    assert r"l \ddot{\theta}" in rod
    assert r"\frac{d\mathbf L_{\rm rod}}{dt} = \frac{m l^2 \ddot{\theta}}{3}\,\hat{\mathbf 2}" in (
        lines
    )


def test_a_factor_of_all_components_stands_in_front():
    lines = formulas_of(ph.solution(two_balls_on_a_light_rod(), "newton"))
    velocity = (
        r"-a\left(\dot{\theta}\,\hat{\mathbf 1} + \dot{\phi} \sin\theta\,\hat{\mathbf 2}\right)"
    )
    assert rf"\mathbf v_{{\rm near}} = {velocity}" in lines


def test_coordinates_that_supports_keep_at_zero_are_left_out():
    found = ph.solution(drum_and_spring())
    assert not any(re.search(r"\b[yz]\\,", line) for line in formulas_of(found))
    assert r"\mathbf F = \frac{k x}{3}\,\hat{\mathbf x}" in formulas_of(found)
    assert r"\sqrt{\frac{2 k}{3 m}}" in words_of(found)  # 3 m a θ̈ + 2 k x = 0, by hand


# -- what is declared is said ----------------------------------------------------------------------


def test_loads_are_given_with_their_constants_and_points():
    stick = ph.rod("stick", mass=m, length=2 * l, axes=upright, axis="3")
    loads = (
        ph.TorsionDamper(theta, damping=c, on=stick),
        ph.TorsionSpring(theta, stiffness=k, rest=beta, on=stick),
        ph.Damper(stick.point(), lab["x"] * a, damping=b),
        ph.Spring(stick.point(), lab["x"] * a, stiffness=M, length=R),
    )
    held = ph.Pivot(stick, at=upright["3"] * l, name="nail")
    found = ph.solution(ph.System(held, *loads, ph.Gravity(g), name="stick"))
    said = words_of(found)
    assert r"A torsion damper exerts the couple $-c \dot{\theta}$ on the stick." in said
    assert r"A torsion spring exerts the couple $-k \left(\theta - \beta\right)$" in said
    assert "natural length $R$ joins the centre of mass of the stick to the place $a" in said
    assert "A damper of constant $b$ joins" in said


@cache
def solved_rattleback():
    A, B, C, D = ph.symbols("A B C D", positive=True)
    return ph.solution(rattleback(((A, D, 0), (D, B, 0), (0, 0, C))), "contact")


def test_inertia_and_surface_of_a_rattleback_are_said():
    found = solved_rattleback()
    said = words_of(found)
    assert "$I_{33} = C$ and $I_{12} = D$ along them; the others are zero" in said
    assert "an ellipsoid with the half-axes $a$, $b$ and $c$ along $1, 2, 3$" in said
    assert "principal moments" not in said  # the axes are not principal axes
    assert undefined_letters(found) == {}
    assert (
        "about the point of contact: the unknown force acts there and has no moment. The moment"
        in said
    )


@pytest.mark.parametrize("ending", ["md", "html", "tex"])
def test_a_long_formula_within_words_is_displayed(tmp_path, ending):
    found = solved_rattleback()
    ph.write_solution(found, tmp_path / f"stone.{ending}")
    text = (tmp_path / f"stone.{ending}").read_text("utf-8")
    before, _, after = text.partition("to the point of contact")
    assert before
    display = {"md": "$$\n\\mathbf a", "html": '<span class="formula"', "tex": r"\begin{multline*}"}
    assert display[ending] in after[:80]


def test_a_tip_has_a_place():
    axes = lab.rotated(theta, "y", labels="1 2 3", name="wheel axes")
    tip = ph.Round(R, "3", h)
    wheel = ph.Body("wheel", mass=m, inertia=(I, I, I), axes=axes, spin=ph.WithAxes(), surface=tip)
    rolls = (ph.Rolling(wheel, on=ph.Plane(lab)), ph.Hinge(wheel, axis="2"))
    found = ph.solution(ph.System(*rolls, ph.Gravity(g), name="loaded wheel"))
    assert (
        r"which touches with a sphere of radius $R$, whose centre is at $h\,\hat{\mathbf 3}$"
        in words_of(found)
    )


# -- frequencies -----------------------------------------------------------------------------------


def test_a_spring_through_its_own_end_is_solved():
    """m s̈ = -k (s - l sign s) + m g sin β: |s| is linear on each side, hence √(k/m)."""
    wire = lab.rotated(beta, "y", name="wire")
    bead = ph.point_mass("bead", mass=m, axes=wire)
    pull = ph.Spring(bead.point(), wire["x"] * 0, stiffness=k, length=l)
    slides = ph.Slider(bead, axis="x", along=wire, name="wire", force="N")
    found = ph.solution(ph.System(slides, pull, ph.Gravity(g), name="bead on a wire"))
    assert r"oscillate at the angular frequency $\sqrt{\frac{k}{m}}$" in words_of(found)


def test_two_frequencies_coupled_by_rotation():
    """7 m ẍ + 2 m Ω ẏ + 5 k x = 0 and the like for y, with x + i y proportional to exp(iwt)."""
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    table = ph.Rolling(ball, on=ph.Turntable(lab, Omega), name="table")
    pull = ph.Spring(ball.point(), lab["z"] * a, stiffness=k)
    found = ph.solution(ph.System(table, pull, ph.Gravity(g), name="tethered ball"))
    root = r"\frac{\sqrt{\frac{35 k}{m} + \Omega^2}}{7}"
    assert rf"${root} - \frac{{\left|\Omega\right|}}{{7}}$ and" in words_of(found)
    ratio, spin = 3.7, 1.9
    rates = (np.sqrt(35 * ratio + spin**2) + np.array([-spin, spin])) / 7
    assert np.abs(np.roots([7, 2 * spin, -5 * ratio])) == pytest.approx(rates[::-1])


def test_equilibria_of_a_relation_and_their_condition():
    """A rod on a pin at a distance b from a turning shaft, against its effective potential."""
    turning = ph.Frame("ground").rotated(Omega * ph.time, "z", name="turning")
    axes = turning.rotated(theta, "y", labels="1 2 3", name="pendulum axes")
    rod = ph.rod("rod", mass=m, length=2 * l, axes=axes, axis="3")
    found = ph.solution(
        ph.System(
            ph.Pivot(rod, at=axes["3"] * l, to=turning["x"] * b, name="pin"),
            ph.Motor(rod, axis="1", rate=0, relative_to=turning, name="fork"),
            ph.Motor(rod, axis="3", rate=0, relative_to=turning, name="bush", torque="sigma"),
            ph.Gravity(g),
            name="rod on a turning shaft",
        )
    )
    said = words_of(found)
    assert r"frequency $\sqrt{\frac{3 g}{4 l \cos\theta} - \Omega^2 \cos^2\theta}$" in said
    assert r"\frac{3 g}{\cos\theta} - 4 l \Omega^2 \cos^2\theta > 0" in formulas_of(found)
    # m = l = 1: the centre is at b - sin θ from the shaft, and I about the pin is 4/3
    gravity, spin, angle = 9.81, 1.3, 0.4
    away = np.tan(angle) * (4 * spin**2 * np.cos(angle) - 3 * gravity) / (3 * spin**2)

    def effective(x):
        turned = (away - np.sin(x)) ** 2 + np.sin(x) ** 2 / 3
        return -gravity * np.cos(x) - spin**2 * turned / 2

    step = 1e-4
    slope = (effective(angle + step) - effective(angle - step)) / (2 * step)
    assert slope == pytest.approx(0, abs=1e-6)
    middle, sides = effective(angle), effective(angle + step) + effective(angle - step)
    square = 3 * gravity / (4 * np.cos(angle)) - (spin * np.cos(angle)) ** 2
    assert (sides - 2 * middle) / step**2 / (4 / 3) == pytest.approx(square, rel=1e-5)


def test_the_swing_of_a_hanging_rod_by_sn():
    """The sentence with sn, for a rod that hangs, against an integration of its equations."""
    steps = ph.solution(two_balls_on_a_light_rod()).sections["The motion in closed form"]
    cubic = r"\left(1 - u^2\right) \left(\eta + 2 \mu u\right) - \alpha^2"
    assert rf"\dot{{u}}^2 = {cubic}" in [step.latex for step in steps]
    said = " ".join(step.words for step in steps)
    assert r"where $\mu = \frac{g \left(M b + m a\right)}{M b^2 + m a^2}$" in said
    assert r"$w^2 = \frac{\mu}{2}\left(u_3 - u_1\right)$" in said
    assert r"$k^2 = \frac{u_3 - u_2}{u_3 - u_1}$" in said
    assert r"$\cos\theta = u_3 - (u_3 - u_2)\operatorname{sn}^2[w(t - t_0), k]$" in said
    mu, start, turning, t = 2.3, 0.9, 1.1, 1.4

    def rates(_, y):
        return y[1], np.sin(y[0]) * (y[2] ** 2 * np.cos(y[0]) - mu), -2 * y[1] * y[2] / np.tan(y[0])

    reached = solve_ivp(rates, (0, t), (start, 0.0, turning), rtol=1e-11, atol=1e-12).y[:, -1]
    alpha = turning * np.sin(start) ** 2
    eta = turning**2 * np.sin(start) ** 2 - 2 * mu * np.cos(start)
    first, second, third = sorted(np.roots([-2 * mu, -eta, 2 * mu, eta - alpha**2]).real)
    w, square = np.sqrt(mu * (third - first) / 2), (third - second) / (third - first)
    since = 0.0 if np.isclose(np.cos(start), third) else ellipk(square) / w
    sn = ellipj(w * (t + since), square)[0]
    assert np.cos(reached[0]) == pytest.approx(third - (third - second) * sn**2, rel=1e-7)


# -- figures and sheets ----------------------------------------------------------------------------


def test_a_figure_of_ropes_is_seen_straight_on_with_their_tensions():
    found = ph.solution(weights_on_a_pulley())
    figure = found.figure
    named = {letter.name.latex for letter in figure.letters if letter.style == "force"}
    assert named == {"M g", "m g", "m_2 g", "S_1", "S_2", r"\mathbf{F}"}
    fixed = {letter.name.latex for letter in figure.letters if letter.style == "fixed"}
    assert fixed == {"x", "y", "z"}
    assert r"- M g\,\hat{\mathbf z} = 0" in " ".join(formulas_of(found))  # the pulley is at rest


def test_bodies_on_one_rod_are_drawn_apart():
    figure = ph.solution(two_balls_on_a_light_rod(), "newton").figure
    dots = {s.points for s in figure.strokes if s.style == "dot" and s.is_closed}
    assert len(dots) >= 2


def test_an_option_of_a_sheet_is_broken_into_rows():
    terms = " + ".join(rf"I_{i} \dot{{\theta}}^2 \sin^2\theta \cos\theta" for i in range(1, 9))
    written = item_tex(f"${terms} = 0$")
    rows = re.findall(r"&(.*?)(?: \\\\ | \\end)", written)
    assert len(rows) > 1
    assert all(width(row) <= WIDE + 4 for row in rows)
    assert "$" + item_tex("$x$").strip("$").replace(r"\displaystyle ", "") + "$" == "$x$"
