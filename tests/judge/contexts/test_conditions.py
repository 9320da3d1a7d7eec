"""The simple conditions under which what fails in general holds."""

import pytest

import polhode as ph
from judge.judged import uncorrected
from judge.test_false_passes import M, R, equations, g, lab
from polhode.judge import Answer

FOUND = [
    ("plane", r"\sqrt{1-\cos^2\theta} = \sin\theta", "it holds where sin(theta) > 0"),
    ("spherical", r"|\dot\phi| = -\dot\phi", "it holds where phi_dot < 0"),
    (
        "plane",
        r"\dot\theta\sin\theta = \sqrt{\frac{p_\theta^2\sin^2\theta}{m^2l^4}}",
        "it holds where sin(theta) > 0 and theta_dot > 0 or sin(theta) < 0 and theta_dot < 0",
    ),
    ("tennis-racquet", r"\dot\omega_3 = 0", "it holds where I_1 = I_2"),
    # of a solid and of a hollow ball
    ("marble-on-turntable", r"\dot v_x = -\frac27\Omega v_y", "it holds where I = 2*m*a**2/5"),
    (
        "marble-on-turntable",
        r"\dot{\mathbf v} = \frac25\boldsymbol\Omega\times\mathbf v",
        "it holds where I = 2*m*a**2/3",
    ),
    ("tennis-racquet", r"L_3 > 0", "it holds where omega_3 > 0"),
]


@pytest.mark.parametrize(("name", "latex", "remark"), FOUND)
def test_a_simple_condition_is_named(name, latex, remark):
    verdict = uncorrected(latex, equations(name))
    assert verdict.answer is Answer.FAILS
    assert verdict.remarks == (remark,)
    alternatives = remark.removeprefix("it holds where ").split(" or ")
    listed = [" and ".join(map(str, each)) for each in verdict.holds_where]
    assert listed == alternatives  # the same as data


@pytest.mark.parametrize("latex", [r"\ddot\theta = \frac gl\cos\theta", r"T = ml^2\dot\theta^2"])
def test_where_both_sides_vanish_or_nothing_simple_helps_no_condition_is_named(latex):
    assert uncorrected(latex, equations("plane")).remarks == ()


def test_a_sign_that_no_state_decides_has_to_be_stated():
    plane = ph.Plane(lab, tilt=-ph.symbol("eta", positive=True))
    ball = ph.sphere("ball", mass=M, radius=R, axes=plane.axes)
    slope = ph.System(ph.Rolling(ball, on=plane, name="ground"), ph.Gravity(g), name="slope")
    said = uncorrected(r"|F_y| = \frac27Mg\sin\eta", ph.derive(slope))
    assert said.answer is Answer.UNREAD
    assert said.option == "positive"
    assert "it holds where sin(eta) > 0" in said.reason
