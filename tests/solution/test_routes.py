"""What the routes say that are not taken by default."""

import importlib
import runpy
from pathlib import Path

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import ROUTES, Setting
from polhode.solution._integrals import conserved_quantities
from polhode.solution._kinematics import kinematics
from polhode.solution._squares import sum_of_squares
from solution import own_systems

FOLDER = Path(__file__).parents[2] / "docs/examples/solutions"


def setting_of(name):
    if name in PROBLEM_SET:
        return Setting(ph.derive(PROBLEM_SET[name].build()))
    return Setting(ph.derive(runpy.run_path(str(FOLDER / f"{name}.py"))[name]))


def lines_of(name, route):
    return list(ROUTES[route].lines(setting_of(name)))


def shown(lines, key):
    return next(line.latex for line in lines if line.key == key)


# -- couples of supports ---------------------------------------------------------------------------


def test_a_couple_of_a_support_is_in_the_law_of_torque():
    """The motor of the hoop exerts one on the bead; without it a × F = 0 would be false."""
    found = ph.solution(setting_of("bead_on_hoop").equations, "newton")
    assert any(r"\tau_1\,\hat{\mathbf 1} = 0" in step.latex for step in found.steps)


def test_the_torque_about_a_point_needs_supports_without_a_couple():
    with pytest.raises(ph.ConstraintError, match="supports that exert no couple"):
        lines_of("bead_on_hoop", "contact")


def test_the_torque_about_a_point_in_long_components_refers_to_what_it_shows():
    lines = lines_of("rolling-disk", "contact")
    words = next(line.words for line in lines if "the equal components" in line.words)
    assert "the rate of the angular momentum and the rest of [[torque]] have" in words


# -- Lagrange --------------------------------------------------------------------------------------


def test_energies_are_sums_of_squares():
    """As every text writes them for a heavy top."""
    lines = lines_of("gyroscope", "lagrange")
    assert r"\frac{I_1 \left(\dot{\psi} + \dot{\phi} \cos\theta\right)^2}{2}" in shown(
        lines, "kinetic"
    )
    effective = shown(lines, "effective")
    assert (
        r"\frac{\left(P_{\phi} - P_{\psi} \cos\theta\right)^2}"
        r"{2 \left(I_2 + M a^2\right) \sin^2\theta} + \frac{P_{\psi}^2}{2 I_1} + M g a \cos\theta"
    ) in effective


def test_squares_are_not_completed_where_nothing_cancels():
    kinetic = shown(lines_of("double_pendulum", "lagrange"), "kinetic")
    assert r"\dot{\alpha} \dot{\beta} \cos\left(\alpha - \beta\right)" in kinetic


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ((1, 0, 1), "x^2 + y^2"),
        ((1, 2, 1), r"\left(x + y\right)^2"),
        ((1, 1, 1), "x^2 + x y + y^2"),
    ],
)
def test_sum_of_squares(text, expected):
    x, y = ph.symbols("x y")
    a, b, c = text
    value = x**2 * a + x * y * b + y**2 * c
    assert sum_of_squares(value, [x.symbol, y.symbol]) == expected


def test_without_a_potential_the_lagrangian_is_the_kinetic_energy():
    words = " ".join(line.words for line in lines_of("tennis-racquet", "lagrange"))
    assert r"$\mathcal L = T$, since there is no potential energy" in words
    assert "T - V" not in words
    assert "Written out it has no short form." in words


# -- first integrals -------------------------------------------------------------------------------


def test_the_energy_alone_solves_a_motion_of_one_speed():
    lines = lines_of("sliding_ladder", "integrals")
    assert "equation for the only speed" in lines[-1].words
    assert "z" not in lines[-1].latex


def test_a_coordinate_that_is_kept_is_not_taken_as_zero():
    """The held gyroscope keeps any θ, and its potential energy is M g a cos θ."""
    lines = list(conserved_quantities(setting_of("gyroscope/held")))
    assert r"M g a \cos\theta" in lines[0].latex


# -- words -----------------------------------------------------------------------------------------


def test_a_spin_relative_to_the_axes_is_called_so():
    """For the gyrocompass ω is not the component along 3, which contains Ω too."""
    lines = {line.key: line for line in kinematics(setting_of("gyrocompass"))}
    assert "$\\omega$ for the spin relative to the axes about $3$" in lines["omega"].words
    assert lines["spin"].latex == r"\omega = \dot{\psi}"


def test_the_energy_of_acceleration_has_letters_of_its_own():
    words = lines_of("gyroscope", "appell")[0].words
    assert r"\int \ddot{\mathbf r}^2\,dm" in words
    assert r"of mass $M$" in words


def test_a_slope_is_described():
    found = ph.solution(own_systems.ball_on_incline())
    words = " ".join(step.words for step in found.steps)
    assert r"turned by $\alpha$ about their $x$-axis" in words
    assert "$v_x$ and $v_y$ along the axes $x$ and $y$ of the slope" in words


@pytest.mark.parametrize("build", [own_systems.weight_on_a_spring, own_systems.bead_on_a_high_rail])
def test_the_only_support_beside_other_loads(build, monkeypatch):
    """Its force is not the total force, and a height that no equation has is no letter of one."""
    module = importlib.import_module("polhode.solution._solution")
    monkeypatch.setattr(module, "_analysed", lambda setting: {})
    found = ph.solution(build())
    assert found.route == "newton"
    assert found.judged > 5
