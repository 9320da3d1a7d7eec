"""What the sentences of solutions say, against what is known of the motion."""

import pytest

import polhode as ph
from polhode.analyse import Truth
from polhode.catalogue import PROBLEM_SET
from polhode.solution._normal_modes import by_potential
from polhode.solution._problem_set import catalogue_example
from polhode.solution._typical import _repeats


def words_of(found):
    return " ".join(step.words for step in found.steps)


def two_coupled_wheels(strength):
    """Wheels at the tops of their potentials, coupled by torques that do no work."""
    inertia, k = ph.symbols("I k", positive=True)
    one, other = ph.coordinates("alpha beta")
    lab = ph.Frame("lab")
    first, second = (
        ph.Body(
            f"wheel {n}",
            mass=ph.symbol("m"),
            inertia=[inertia] * 3,
            axes=lab.rotated(q, "z"),
            tag=n,
        )
        for n, q in (("1", one), ("2", other))
    )
    return ph.System(
        *(ph.Pivot(wheel, name=f"pivot {wheel.name}") for wheel in (first, second)),
        *(ph.Hinge(wheel, axis="z", name=f"hinge {wheel.name}") for wheel in (first, second)),
        ph.Potential(-k * (one**2 + other**2) / 2, on=(first, second)),
        ph.Torque(first, lab["z"] * (strength * other.dt()), name="to"),
        ph.Torque(second, lab["z"] * (-strength * one.dt()), name="fro"),
    )


@pytest.mark.parametrize(("strength", "truth"), [("b", Truth.OPEN), ("0", Truth.NEVER)])
def test_forces_without_work_leave_the_potential_open(strength, truth):
    """They make a maximum of the potential stable where b² > 4 k I."""
    b = ph.symbol("b", positive=True) if strength == "b" else 0
    (family,) = ph.steady(ph.derive(two_coupled_wheels(b)))
    assert by_potential(family) is truth


def test_a_coordinate_that_a_torque_drives_has_its_equation_of_lagrange():
    """The Lagrangian of a compass needle does not contain its angle, but a torque acts along it."""
    inertia, mu, b = ph.symbols("I mu B", positive=True)
    theta = ph.coordinate("theta")
    lab = ph.Frame("lab")
    needle = ph.Body(
        "needle", mass=ph.symbol("m"), inertia=[inertia] * 3, axes=lab.rotated(theta, "z")
    )
    torque = ph.Torque(needle, lab["z"] * (-mu * b * ph.sin(theta)), name="field")
    system = ph.System(ph.Pivot(needle), ph.Hinge(needle, axis="z"), torque)
    found = ph.solution(system, "lagrange")
    shown = [step.latex for step in found.steps]
    assert r"I \ddot{\theta} = -B \mu \sin\theta" in shown
    words = words_of(found)
    assert r"The couple $-B \mu \sin\theta\,\hat{\mathbf z}$ (“field”) acts on the needle." in words
    assert "this equilibrium is unstable" in words
    assert "highest" not in words


def test_no_formula_has_two_signs(solved):
    shown = [step.latex for step in solved("gimballed_gyro").steps]
    assert len(shown) > 20
    assert not any("--" in latex for latex in shown)


def test_equations_of_motion_stand_once(solved):
    """Those of the gyroscope are components of the torque equation already."""
    found = solved("gyroscope")
    rows = found.sections["Equations of motion"]
    assert [step.latex for step in rows] == [r"\dot{\omega}_1 = 0"]
    assert rows[0].words.endswith("besides those that stand above already,")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("marble-on-turntable", "The motion that is drawn below repeats after"),
        ("marble-on-turntable/tilted", "below $x_2$ and $v_3$ repeat after"),
        ("spinning-coin", r"below $\theta$ and $\dot{\phi}$ repeat after"),
        ("gyroscope/upright", "Except for a rotation the motion that is drawn below repeats after"),
    ],
)
def test_what_repeats_after_a_period(name, sentence):
    """A drift goes on, and so do the angles of a precession and of a spin."""
    entry = PROBLEM_SET[name]
    example = catalogue_example(entry, ph.derive(entry.build()))
    assert f"{_repeats(example)} after".endswith(sentence.removeprefix("below"))


def test_the_tension_of_a_rope_has_its_letter():
    """S₁ = m₁ g (I + 2 m₂ R²)/(I + m₁ R² + m₂ R²), by hand from the laws of both weights."""
    m, moment, radius, m_1, m_2, g = ph.symbols("m I R m_1 m_2 g", positive=True)
    lab = ph.Frame("lab")
    x, z = lab["x"], lab["z"]
    axes = lab.rotated(ph.coordinate("alpha"), "y")
    pulley = ph.Body("pulley", mass=m, inertia=[moment] * 3, axes=axes, tag="p")
    left = ph.point_mass("left weight", mass=m_1, axes=lab, tag="1")
    right = ph.point_mass("right weight", mass=m_2, axes=lab, tag="2")
    ends = [(left, x * -radius), (right, x * radius)]
    found = ph.solution(
        ph.System(
            ph.Pivot(pulley, name="axle"),
            ph.Hinge(pulley, axis="y"),
            *(
                ph.Rope([w.point(), pulley.point(at)], directions=[z], name=f"rope of {w.name}")
                for w, at in ends
            ),
            *(ph.Pivot(w, to=at, only="x y", name=f"guide of {w.name}") for w, at in ends),
            ph.Gravity(g),
        )
    )
    shown = [step.latex for step in found.sections["Forces of the supports"]]
    below = r"I + R^2 \left(m_1 + m_2\right)"
    assert rf"S_1 = \frac{{m_1 g \left(I + 2 m_2 R^2\right)}}{{{below}}}" in shown
    assert "letters for the components" not in words_of(found)


def test_the_energy_has_no_coordinates_that_others_determine(solved):
    """Of the sliding ladder it is 2 m l² θ̇²/3 + m g l cos θ, without the height z."""
    (energy,) = solved("sliding_ladder").sections["Conserved quantities"]
    value = r"\frac{2 m l^2 \dot{\theta}^2}{3} + m g l \cos\theta"
    assert energy.latex == rf"\frac{{d}}{{dt}}\left({value}\right) = 0"


def test_a_declared_speed_is_introduced(solved):
    """The spin of a rotor in gimbals, whose axes are not those along which vectors are short."""
    spoken = words_of(solved("gimballed_gyro"))
    assert "for its component along axis $3$ of the body, is" in spoken


def test_coordinates_of_a_free_place_are_not_prescribed():
    """Polar coordinates of a particle: its place moved "as prescribed"."""
    lab, (r, theta) = ph.Frame("lab"), ph.coordinates("r theta")
    m, k = ph.symbols("m k", positive=True)
    planet = ph.point_mass("planet", mass=m, axes=lab)
    placed = ph.Pivot(planet, to=lab.rotated(theta, "z")["x"] * r)
    words = words_of(ph.solution(ph.System(placed, ph.Potential(-k / r, on=planet))))
    assert r"with $r$ and $\theta$ as coordinates." in words
    assert "prescribed" not in words
