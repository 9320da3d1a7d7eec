"""False statements that were once let through, with others of their families.

The truth of each is that of the textbooks: a fast top sleeps for I₁²ω₁² > 4Mga(I₂ + Ma²), a disk
rolls upright for ω₃² > g/3a, a pendulum has θ̈ = -(g/l)(θ - θ³/6 + ...), and so on.
"""

from functools import cache

import pytest

import polhode as ph
from catalogue import systems
from judge.judged import uncorrected
from polhode.judge import Answer

PASSES = (Answer.HOLDS, Answer.APPROXIMATE)

m, l, g, R, omega = ph.symbols("m l g R omega", positive=True)
M, h, A, C = ph.symbols("M h A C", positive=True)
I_1, I_2, I_3 = ph.symbols("I_1 I_2 I_3", positive=True)
phi, theta, psi = ph.coordinates("phi theta psi")
lab = ph.Frame("lab")


def _plane():
    axes = lab.rotated(-theta, "y")
    return _pendulum(axes, axes)


def _spherical():
    axes = lab.rotated(phi, "z").rotated(-theta, "y")
    return _pendulum(axes, axes)


def _pendulum(axes, along):
    bob = ph.point_mass("bob", mass=m, axes=axes)
    return ph.System(ph.Pivot(bob, at=axes["z"] * l, along=along), ph.Gravity(g), name="pendulum")


def _hoop():
    axes = ph.earth(omega, colatitude=0).rotated(-theta, "y")
    bead = ph.point_mass("bead", mass=m, axes=axes)
    wire = ph.Pivot(bead, at=axes["z"] * R, name="wire", along=axes)
    return ph.System(wire, ph.Hinge(bead, axis="y"), ph.Gravity(g), name="bead on a hoop")


def _top():
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    inertia = (A - M * h**2, A - M * h**2, C)
    body = ph.Body("top", mass=M, inertia=inertia, axes=axes, spin=ph.About("3", "psi"))
    return ph.System(ph.Pivot(body, at=axes["3"] * -h, along=lab), ph.Gravity(g), name="top")


def _slope():
    plane = ph.Plane(lab, tilt=-ph.symbol("alpha", positive=True))
    ball = ph.sphere("ball", mass=M, radius=R, axes=plane.axes)
    return ph.System(ph.Rolling(ball, on=plane, name="ground"), ph.Gravity(g), name="ball")


OWN = {"plane": _plane, "spherical": _spherical, "hoop": _hoop, "top": _top, "slope": _slope}


@cache
def equations(name):
    return ph.derive(OWN[name]()) if name in OWN else systems.equations(name)


def answer(name, latex, **options):
    return uncorrected(latex, equations(name), **options).answer


UPRIGHT = {"context": "threshold", "given": ["alpha = 0", "beta = 0"]}
ON_EDGE = {"context": "threshold", "given": ["theta = pi/2", "phi_dot = 0"]}

NO_THRESHOLDS = [
    *(
        ("gyroscope/upright", said, UPRIGHT)
        for said in (
            r"I_1^2\omega_1^2 > 2Mga(I_2+Ma^2)",
            r"I_1\omega_1 > \sqrt{2Mga(I_2+Ma^2)}",
            r"I_1^2\omega_1^2 > 3Mga(I_2+Ma^2)",
            r"I_1^2\omega_1^2 > 4Mga I_2",
            r"I_1^2\omega_1^2 < 4Mga(I_2+Ma^2)",
            r"I_1^2\omega_1^2 > 4Mga(I_2+Ma^2), \omega_1 < 5",
            r"I_1^2\omega_1^2 \gg 4Mga(I_2+Ma^2)",
            r"I_1^2\omega_1^2 \ge 4Mga(I_2+Ma^2)",
            r"\omega_1 > 0",
        )
    ),
    *(
        ("rolling-disk", said, ON_EDGE)
        for said in (
            r"\omega_3 > -\sqrt{g/3a}",
            r"-\omega_3 > \sqrt{g/3a}",
            r"-\omega_3 > -\sqrt{g/3a}",
            r"\omega_3 < -\sqrt{g/3a}",
            r"\omega_3 < \sqrt{g/3a}",
            r"\omega_3^2 > -g/3a",
            r"\omega_3 > \pm\sqrt{g/3a}",
            r"\omega_3 \gg \sqrt{g/3a}",
        )
    ),
]
THRESHOLDS = [
    *(
        ("gyroscope/upright", said, UPRIGHT)
        for said in (
            r"I_1^2\omega_1^2 > 4Mga(I_2+Ma^2)",
            r"\omega_1 > \frac{2}{I_1}\sqrt{Mga(I_2+Ma^2)}",
            r"4Mga(I_2+Ma^2) < I_1^2\omega_1^2",
            r"\frac{I_1^2\omega_1^2}{4Mga(I_2+Ma^2)} > 1",
            r"I_1^2\omega_1^2 > 4Mga(I_2+Ma^2), I_1^2\omega_1^2 > 2Mga(I_2+Ma^2)",
        )
    ),
    ("rolling-disk", r"\omega_3 > \sqrt{g/3a}", ON_EDGE),
    ("rolling-disk", r"|\omega_3| > \sqrt{g/3a}", ON_EDGE),
    ("rolling-disk", r"3a\omega_3^2 > g", ON_EDGE),
    (
        "gyroscope",
        r"\omega_1 > \frac{2}{I_1}\sqrt{Mga(I_2+Ma^2)\cos\theta} \quad (\theta < \pi/2)",
        {"context": "threshold"},
    ),
]


@pytest.mark.parametrize(("name", "latex", "options"), NO_THRESHOLDS)
def test_a_part_of_a_condition_is_not_the_condition(name, latex, options):
    assert answer(name, latex, **options) not in PASSES


@pytest.mark.parametrize(("name", "latex", "options"), THRESHOLDS)
def test_the_whole_condition_holds_in_every_form(name, latex, options):
    assert answer(name, latex, **options) is Answer.HOLDS


def test_a_threshold_is_refuted_by_physical_bodies():
    said = r"I_1^2\omega_1^2 > 2Mga(I_2+Ma^2)"
    values = uncorrected(said, equations("gyroscope/upright"), **UPRIGHT).counterexample.values
    found = {name: eval_fraction(values[name]) for name in ("M", "a", "g", "I_1", "I_2", "omega_1")}
    assert all(found[name] > 0 for name in ("M", "a", "g", "I_1", "I_2"))
    assert found["I_1"] <= 2 * found["I_2"]
    spin = (found["I_1"] * found["omega_1"]) ** 2
    whole = found["M"] * found["g"] * found["a"] * (found["I_2"] + found["M"] * found["a"] ** 2)
    assert 2 * whole < spin <= 4 * whole


def eval_fraction(text):
    above, _, below = text.partition("/")
    return float(above) / float(below or 1)


def limit(*small, **more):
    return {"context": "limit", "small": list(small), **more}


COMPASS = limit("Omega:1", "theta:1", given=["I_3 = 2*I_1"])
NO_LIMITS = [
    *(
        ("gyrocompass", said, COMPASS)
        for said in (
            r"\ddot\theta = 2\omega\Omega\sin\lambda\,\theta",
            r"\ddot\theta = -17\omega\Omega\sin\lambda\,\theta",
            r"\ddot\theta - 2\omega\Omega\sin\lambda\,\theta = 0",
            r"\omega\ddot\theta = 2\omega^2\Omega\sin\lambda\,\theta",
            r"\theta\ddot\theta = 2\omega\Omega\sin\lambda\,\theta^2",
            r"F_1 + 2\omega\Omega\sin\lambda\,\theta = 0",
        )
    ),
    *(
        ("plane", said, limit("theta:1"))
        for said in (
            r"T = ml^2\dot\theta^2",
            r"ml^2\dot\theta^2 = T",
            r"T - ml^2\dot\theta^2 = 0",
            r"3(T - ml^2\dot\theta^2) = 0",
            r"V \approx -mgl + 7mgl\theta^2",
            r"-mgl + 7mgl\theta^2 \approx V",
            r"V + mgl - 7mgl\theta^2 \approx 0",
            r"\ddot\theta \approx -\frac gl\left(\theta-\frac{\theta^3}{3}\right)",
            r"\ddot\theta + \frac gl\left(\theta-\frac{\theta^3}{3}\right) \approx 0",
            r"\ddot\theta - \frac{g\theta^3}{3l} \approx -\frac gl\theta",
            r"\ddot\theta \approx -\frac gl\sin(\theta-\theta^3)",
            r"l\ddot\theta \approx -\frac{g\theta}{1+\theta^2}",
            r"\ddot\theta \approx 0",
            r"T < ml^2\dot\theta^2",
        )
    ),
    ("plane", r"E \approx ml^2\dot\theta^2 + mgl\theta^2 - mgl", limit("theta")),
    ("plane", r"\ddot\theta = -\frac gl\theta", limit("theta")),
    ("plane", r"\ddot\theta \approx 0", limit("theta_dot:0")),
    ("plane", r"\ddot\theta \approx 0", limit("theta:1", "theta_dot:0")),
    (
        "plane",
        r"\ddot\theta \approx -\frac gl(\theta-\frac{\theta^3}{6}+\frac{\theta^5}{120}"
        r"-\frac{\theta^7}{9999})",
        limit("theta:7"),
    ),
    (
        "rolling-disk",
        r"T \approx 100ma^2\omega_3^2",
        limit("omega_3:1", "phi_dot:1", "theta_dot:1"),
    ),
    (
        "gyroscope",
        r"\dot\phi \approx \frac{Mga}{I_1\omega_1}, F_z \approx 17Mg",
        limit("1/omega_1:1"),
    ),
    (
        "gyroscope",
        r"\dot\phi \approx \frac{I_1\omega_1}{2(I_2+Ma^2)\cos\theta}"
        r"[1 \pm (1 - \frac{3Mga(I_2+Ma^2)\cos\theta}{I_1^2\omega_1^2})]",
        limit("1/omega_1:1"),
    ),
]
LIMITS = [
    *(
        ("gyrocompass", said, COMPASS)
        for said in (
            r"\ddot\theta = -2\omega\Omega\sin\lambda\,\theta",
            r"\ddot\theta + 2\omega\Omega\sin\lambda\,\theta = 0",
            r"\omega\ddot\theta = -2\omega^2\Omega\sin\lambda\,\theta",
            r"-2\omega\Omega\sin\lambda\,\theta = \ddot\theta",
        )
    ),
    ("plane", r"\ddot\theta \approx -\frac gl\theta", limit("theta")),
    ("plane", r"l\ddot\theta + g\theta \approx 0", limit("theta")),
    ("plane", r"(1+\theta^2)(l\ddot\theta + g\theta) \approx 0", limit("theta:1")),
    ("plane", r"\ddot\theta \approx -\frac gl(\theta-\frac{\theta^3}{6})", limit("theta:1")),
    ("plane", r"V \approx -mgl + \frac12mgl\theta^2", limit("theta:1")),
    ("plane", r"T \approx 0", {**limit("theta:1"), "read": ["T = kinetic energy"]}),
    (
        "gyroscope",
        r"\dot\phi \approx \frac{I_1\omega_1}{2(I_2+Ma^2)\cos\theta}"
        r"[1 \pm (1 - \frac{2Mga(I_2+Ma^2)\cos\theta}{I_1^2\omega_1^2})]",
        limit("1/omega_1:1"),
    ),
]


@pytest.mark.parametrize(("name", "latex", "options"), NO_LIMITS)
def test_a_printed_term_that_is_wrong_is_never_left_untested(name, latex, options):
    assert answer(name, latex, **options) not in PASSES


@pytest.mark.parametrize(("name", "latex", "options"), LIMITS)
def test_an_approximation_is_true_in_every_algebraic_form(name, latex, options):
    assert answer(name, latex, **options) is Answer.APPROXIMATE


ELSEWHERE = [
    # a relation in brackets is said as well
    ("plane", r"E = ml^2\dot\theta^2 - mgl\cos\theta \quad (T = ml^2\dot\theta^2)", {}),
    ("plane", r"F_z = mg\cos\theta \quad (v^2 = -l^2\dot\theta^2)", {}),
    ("tennis-racquet", r"E = T,\quad (\dot\omega_3 = 0)", {}),
    ("tennis-racquet", r"E = T\quad (E < 0)", {}),
    ("tennis-racquet", r"E = T\ (V = 1)", {}),
    ("tennis-racquet", r"\dot\omega_3 = 0\quad (\omega_1 = 0)", {}),
    ("tennis-racquet", r"E = T\quad (\text{since } \dot\omega_3 = 0)", {}),
    ("plane", r"F_z = 17mg\quad (\text{if } T = ml^2\dot\theta^2)", {}),
    # one choice of ± for the whole statement
    (
        "tennis-racquet",
        r"\mathbf L = I_1\omega_1\hat{\mathbf 1} \pm I_2\omega_2\hat{\mathbf 2}"
        r" \mp I_3\omega_3\hat{\mathbf 3}",
        {},
    ),
    ("plane", r"E = T \pm V", {}),
    ("plane", r"\ddot\theta = \pm\frac gl\sin\theta, E = T \pm V", {}),
    ("plane", r"E = T \pm V, E = T \mp V", {}),
    ("plane", r"\dot\theta^2 > \pm 5", {}),
    (
        "spherical",
        r"\dot\phi = \sqrt{\frac{g}{l\cos\theta}},\ \dot\phi = -\sqrt{\frac{g}{l\cos\theta}}",
        {"context": "steady"},
    ),
    # ≪ and ≫ bound nothing
    ("gyroscope", r"I_2 \ll I_2 + Ma^2", {}),
    ("gyroscope", r"I_2 + Ma^2 \gg I_2", {}),
    ("plane", r"m \ll 2m", {"context": "identity"}),
    ("hoop", r"R \ll 2R", {"context": "steady"}),
    ("plane", r"0 \ll l", {"context": "launch", "given": ["theta = 1", "theta_dot = 0"]}),
    # dE/dθ has two readings where E varies with more than θ
    ("gyroscope", r"\frac{d\dot\theta}{d\theta} = 0", {}),
    ("plane", r"\frac{dE}{d\theta} = mgl\sin\theta", {}),
    ("plane", r"\frac{dT}{d\theta} = 0", {}),
    ("gyroscope", r"\frac{d\phi}{d\theta} = 0", {}),
    ("plane", r"\frac{d\mathcal L}{d\theta} = -mgl\sin\theta", {}),
    ("plane", r"\frac{d^2E}{d\theta^2} = mgl\cos\theta", {}),
    # what may be equal is not greater
    ("gyroscope", r"\dot\theta^2 > 0", {}),
    ("plane", r"T > 0", {}),
    ("gyroscope", r"\dot\theta^2 + \dot\phi^2 > 0", {}),
    ("plane", r"1 - \cos^2\theta > 0", {}),
    ("plane", r"\dot\theta^2 \ne 0", {}),
    ("plane", r"l > l", {}),
    ("top", r"C^2\omega_3^2 > 4AMgh\cos\theta", {"context": "steady"}),
    # what holds on one family of steady motions need not on another
    ("hoop", r"\cos\theta = 1", {"context": "steady"}),
    ("hoop", r"\sin\theta = 0", {"context": "steady"}),
    ("hoop", r"R\omega^2 > g", {"context": "steady"}),
    ("rolling-disk", r"\theta = \pi/2", {"context": "steady", "given": ["omega_3 = 0"]}),
    # a definition is not judged
    ("gyroscope", "N = 17Mg", {}),
    ("plane", r"H = \frac{p_\theta^2}{ml^2} + mgl\cos\theta", {}),
    ("slope", r"a = \frac35g\sin\alpha", {}),
    ("plane", r"\omega_0 = \sqrt{l/g}", {}),
    ("plane", r"T_0 = 2\pi\sqrt{\frac{l}{2g}}", {}),
    ("plane", r"v_{\max} = \sqrt{gl}", {}),
    # a Lagrangian is free by a total derivative, not by anything
    ("plane", r"\mathcal L = \frac12ml^2\dot\theta^2 + mgl\cos\theta + 5", {}),
    ("plane", r"\mathcal L = \frac12ml^2\dot\theta^2 - mgl(2-\cos\theta)\cos\theta", {}),
    # true or false by what the slash divides, both of one dimension
    ("plane", r"\ddot\theta = -g/l \sin\theta", {}),
    # of two slashes the second leaves two readings of one dimension, whatever the first divides
    ("plane", r"1/2 m l^2\dot\theta^2 = E + m l^2 g/l \cos\theta", {}),
    # the hoop has no weight, so that its centre is held by no force, which has no direction
    ("gyrocompass", r"\hat{\mathbf N} = 3\hat{\mathbf y}", {"read": ["N = force of centre"]}),
    # on one family φ̇ = 0, but φ may have any value
    ("spinning-coin", r"I_3\omega_3\phi = 0", {"context": "steady", "given": [r"\theta = \pi/2"]}),
    # an ω that is set equal to a vector is no definition of the text's own
    ("gyroscope", r"\omega = \omega_1\hat 1 + \omega_2\hat 2 + \omega_2\hat 3", {}),
]


@pytest.mark.parametrize(("name", "latex", "options"), ELSEWHERE)
def test_what_is_false_or_unclear_does_not_hold(name, latex, options):
    verdict = uncorrected(latex, equations(name), **options)
    assert not verdict.holds
    assert verdict.reason


RIGHT = [
    ("tennis-racquet", r"\dot\omega_3 = 0\quad (\text{if } \omega_1 = 0)", {}),
    (
        "tennis-racquet",
        r"\dot\omega_3 = 0\quad (\text{for } \omega_1 = 0 \text{ and } \omega_2 = 0)",
        {},
    ),
    ("tennis-racquet", r"\dot\omega_3 = 0\quad (\omega_1 = 0)", {"given": ["omega_1 = 0"]}),
    ("tennis-racquet", r"E = T\quad (V = 0)", {}),
    ("plane", r"\dot\theta = \pm\sqrt{\dot\theta^2}", {}),
    ("plane", r"\dot\theta^2 \ge 0", {}),
    ("plane", r"l^2 > 0", {}),
    ("plane", r"\frac{dV}{d\theta} = mgl\sin\theta", {}),
    ("plane", r"\frac{\partial E}{\partial\theta} = mgl\sin\theta", {}),
    ("hoop", r"\cos\theta = \frac{g}{\omega^2R}", {"context": "steady"}),
    (
        "rolling-disk",
        r"\dot\phi^2\sin\theta = \frac{4g}{a}",
        {"context": "steady", "given": ["omega_3 = 0"]},
    ),
    (
        "spherical",
        r"\dot\phi = \sqrt{\frac{g}{l\cos\theta}} \text{ or } -\sqrt{\frac{g}{l\cos\theta}}",
        {"context": "steady"},
    ),
    (
        "spinning-coin",
        r"I_3\omega_3\dot\phi = 0",
        {"context": "steady", "given": [r"\theta = \pi/2"]},
    ),
    # of the two readings of a slash, one has the right dimensions
    ("rolling-disk", r"\omega_3 > \sqrt{I_1 m g a / I_3 (m a^2 + I_3)}", ON_EDGE),
    ("plane", r"T = 1/2 m l^2\dot\theta^2", {"read": ["T = kinetic energy"]}),
    ("plane", r"T = 1/2I\dot\theta^2", {"read": ["T = kinetic energy"], "let": ["I = m*l**2"]}),
    ("slope", r"|F_y| = \frac27Mg\sin\alpha", {"positive": ["sin(alpha)"]}),
    ("slope", r"|F_y| = -\frac27Mg\sin\alpha", {"positive": [r"-\sin\alpha"]}),
    ("plane", r"\mathcal L = \frac12ml^2\dot\theta^2 - mgl(1-\cos\theta)", {"context": "identity"}),
]


@pytest.mark.parametrize(("name", "latex", "options"), RIGHT)
def test_what_is_right_still_holds(name, latex, options):
    assert answer(name, latex, **options) is Answer.HOLDS


def test_steady_motions_to_which_a_relation_does_not_apply_are_named():
    said = ph.check(r"\cos\theta = \frac{g}{\omega^2R}", equations("hoop"), context="steady")
    assert any("does not cover theta = 0; theta = pi" in remark for remark in said.remarks)
    wrong = ph.check(r"\cos\theta = 1", equations("hoop"), context="steady")
    assert any("it holds on the steady motions theta = 0" in remark for remark in wrong.remarks)


def test_conditions_and_signs_that_were_used_are_shown():
    said = ph.check(r"\dot\omega_3 = 0\ (\text{if } \omega_1 = 0)", equations("tennis-racquet"))
    assert r"under the condition \omega_1 = 0" in said.remarks
    said = ph.check(r"|F_y| = \frac27Mg\sin\alpha", equations("slope"), positive="sin(alpha)")
    assert "taking sin(alpha) as positive" in said.remarks


def test_a_known_quantity_is_not_redefined():
    with pytest.raises(ph.ParseError, match="known as"):
        ph.check("E = 5", equations("plane"), let=["E = 5"])
    spelled_out = {"let": [r"\omega_3 = \dot\psi + \dot\phi\cos\theta"]}
    kept = r"\omega_3 = \dot\psi + \dot\phi\cos\theta"
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("top", mass=M, inertia=(I_1, I_1, I_3), axes=axes)
    top = ph.derive(ph.System(ph.Pivot(body, at=axes["3"] * -l), ph.Gravity(g), name="top"))
    assert ph.check(kept, top, **spelled_out).answer is Answer.HOLDS


def test_what_was_read_but_not_decided_says_so():
    said = ph.check(r"\ddot\theta = 17", equations("plane"), given=[r"\sin\theta = 2"])
    assert said.answer is Answer.UNREAD
    assert said.reason.startswith("it was read, but not decided")


@pytest.mark.parametrize(
    "latex",
    [
        r"\ddot\theta = -\frac gl\theta + O(\theta^4)",
        r"\ddot\theta + O(\theta^4) = -\frac gl\theta",
        r"\ddot\theta = -\frac gl\left(\theta + \mathcal{O}(\theta^4)\right)",
        r"\ddot\theta = -\frac gl\theta + \frac{g}{5l}\theta^3 + O(\theta^5)",
        r"V \approx mgl\theta^2",
        r"V \approx mgl\theta",
        r"E \approx ml^2\dot\theta^2 + \frac12mgl\theta^2",
    ],
)
def test_the_order_of_what_is_left_out_is_judged(latex: str) -> None:
    verdict = uncorrected(latex, equations("plane"), context="limit", small=["theta:1"])
    assert verdict.answer in (Answer.FAILS, Answer.UNREAD) or verdict.order >= 2


@pytest.mark.parametrize("latex", [r"\omega = \omega_0", r"\Omega = \omega_0", r"T = T_0"])
def test_two_letters_are_not_both_the_quantity_of_small_oscillations(latex: str) -> None:
    verdict = ph.check(latex, equations("plane"))
    assert verdict.answer in (Answer.AMBIGUOUS, Answer.FAILS)


def test_a_bold_zero_is_no_letter() -> None:
    assert ph.check(r"\mathbf 0 = mgl\sin\theta", equations("plane")).answer is Answer.UNREAD


@pytest.mark.parametrize(
    "latex",
    [
        r"T = \sum_i I_i\omega_i^2",
        r"H = \sum_i p_i\dot q_i + L",
        r"\begin{pmatrix}L_1\\L_2\\L_3\end{pmatrix} = \begin{pmatrix}I_1&0&0\\0&I_3&0\\0&0&I_1"
        r"\end{pmatrix}\begin{pmatrix}\omega_1\\\omega_2\\\omega_3\end{pmatrix}",
    ],
)
def test_sums_and_matrices_that_fail_are_corrected_without_breaking(latex: str) -> None:
    assert ph.check(latex, equations("tennis-racquet")).answer is Answer.FAILS


def test_a_level_of_energy_does_not_change_with_time():
    swung = lab.rotated(-phi, "y")
    bob = ph.point_mass("bob", mass=m, axes=swung)
    moved = lab["z"] * (R * ph.cos(omega * ph.time))
    support = ph.Pivot(bob, at=swung["z"] * l, to=moved, name="support")
    system = ph.derive(ph.System(support, ph.Gravity(g), name="pendulum"))
    for line in (r"V = mgR\cos\omega t - mgl\cos\phi", r"V = mgR\cos\omega t + mgl(1-\cos\phi)"):
        assert uncorrected(line, system).answer is Answer.HOLDS
    for line in (r"V = -mgR\cos\omega t - mgl\cos\phi", r"E = T + V + mgR\cos\omega t"):
        assert uncorrected(line, system).answer not in PASSES


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        (r"p_\theta = q l, \quad q = ml\dot\theta", Answer.HOLDS),
        (r"p_\theta = q l, \quad q = 2ml\dot\theta", Answer.FAILS),
        (r"p_\theta = 2q l, \quad q = b\dot\theta, \quad b = ml", Answer.UNREAD),
    ],
)
def test_a_definition_may_stand_behind_its_use(line, expected):
    assert uncorrected(line, equations("plane")).answer is expected


def test_the_L_under_a_partial_derivative_is_the_lagrangian_of_a_rod_of_length_L():
    """A rod of length L on a pin, pushed across its end by F: I θ̈ = F L - m g (L/2) sin θ."""
    m, L, F, g = ph.symbols("m L F g", positive=True)
    axes = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y", name="axes")
    rod = ph.rod("rod", mass=m, length=L, axes=axes, axis="z")
    equations = ph.derive(
        ph.System(
            ph.Pivot(rod, at=axes["z"] * (L / 2), name="pin"),
            ph.Hinge(rod, axis="y", name="plane"),
            ph.Force(rod.point(axes["z"] * (-L / 2)), axes["x"] * F, name="push"),
            ph.Gravity(g),
        )
    )
    rate = r"\frac{d}{dt}\left(\frac{\partial L}{\partial\dot\theta}\right)"
    slope = r"\frac{\partial L}{\partial\theta}"
    for load, answer in ((" = 0", "fails"), (" = F L", "holds"), (" = 2 F L", "fails")):
        verdict = ph.check(f"{rate} - {slope}{load}", equations)
        assert verdict.answer.value == answer, (load, verdict)
    momentum = r"\frac{\partial L}{\partial\dot\theta} = \frac{1}{3} m L^2\dot\theta"
    assert ph.check(momentum, equations).holds
    assert not ph.check(momentum.replace("3", "12"), equations).holds
