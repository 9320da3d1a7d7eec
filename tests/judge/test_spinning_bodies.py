"""Lines of texts on spinning bodies: each true one, and its twin with a slip, get their marks.

Free bodies: Landau and Lifshitz, Mechanics, §§ 35-37. Disks and hoops: O'Reilly, Engineering
Dynamics. Tops: Goldstein, Classical Mechanics, ch. 5. Governor: Whittaker, Analytical Dynamics.
"""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

MARKS = {
    "true": "T",
    "error": "E",
    "follows": "F",
    "unlinked": "U",
    "needs": "!",
    "not-judged": "-",
}
A, B, C, D, I, J, M, R, a, g, h, l, m, n, tau = ph.symbols(
    "A B C D I J M R a g h l m n tau", positive=True
)
I_1, I_3 = ph.symbols("I_1 I_3", positive=True)
phi, theta, psi = ph.coordinates("phi theta psi")
alpha, beta = ph.coordinates("alpha beta")
LAB = ph.Frame("lab")
TILTED = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
TURNED = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")


def _free() -> ph.System:
    """A body by the rates of Euler's angles, not by the components of its angular velocity."""
    return ph.System(ph.Pivot(ph.Body("body", mass=M, inertia=(A, B, C), axes=TURNED)))


def _top() -> ph.System:
    body = ph.Body("top", mass=m, inertia=(I_1, I_1, I_3), axes=TURNED)
    return ph.System(ph.Pivot(body, at=TURNED["3"] * -l), ph.Gravity(g))


def _hoop() -> ph.System:
    body = ph.hoop("hoop", mass=m, radius=R, axes=TILTED)
    return ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g))


def _pendulum() -> ph.System:
    axes = LAB.rotated(theta, "y")
    body = ph.Body("pendulum", mass=m, inertia=(I, I, I), axes=axes)
    held = ph.Pivot(body, at=axes["z"] * h)
    return ph.System(held, ph.Hinge(body, axis="y"), ph.Gravity(g))


def _satellite() -> ph.System:
    body = ph.Body("satellite", mass=M, inertia=(A, B, C), axes=LAB.rotated(theta, "y"))
    gradient = ph.Potential(3 * n**2 * (A - C) * ph.sin(theta) ** 2 / 2, on=body)
    return ph.System(ph.Pivot(body), ph.Hinge(body, axis="y"), gradient)


def _wheel() -> ph.System:
    """A satellite and its reaction wheel, turned by a motor between them."""
    axes = LAB.rotated(alpha, "z")
    hull = ph.Body("hull", mass=M, inertia=(I, I, I), axes=axes)
    wheel = ph.Body("wheel", mass=m, inertia=(J, J, J), axes=axes.rotated(beta, "z"), tag="w")
    held = (ph.Pivot(hull), ph.Hinge(hull, axis="z"), ph.Pivot(wheel, to=hull.point()))
    motor = (ph.Torque(wheel, LAB["z"] * tau), ph.Torque(hull, LAB["z"] * -tau, name="back"))
    return ph.System(*held, ph.Hinge(wheel, axis="z"), *motor)


def _shaft() -> ph.System:
    """A body mounted askew: its products of inertia load the bearings."""
    body = ph.Body("disk", mass=m, inertia=((A, 0, 0), (0, B, D), (0, D, C)), axes=_about(phi))
    return ph.System(ph.Pivot(body), ph.Hinge(body, axis="z", torque="N"))


def _about(angle: ph.Expr) -> ph.Frame:
    return LAB.rotated(angle, "z")


def _governor() -> ph.System:
    held = []
    for tag, angle in (("1", -theta), ("2", theta)):
        axes = _about(phi).rotated(angle, "y")
        ball = ph.point_mass(f"ball {tag}", mass=m, axes=axes, tag=tag)
        held.append(ph.Pivot(ball, at=axes["z"] * l, name=f"arm {tag}"))
    return ph.System(*held, ph.Gravity(g))


OWN = {
    "free": _free,
    "top": _top,
    "hoop": _hoop,
    "pendulum": _pendulum,
    "satellite": _satellite,
    "wheel": _wheel,
    "shaft": _shaft,
    "governor": _governor,
}


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build() if name in PROBLEM_SET else OWN[name]())


def marks(text: str, name: str, format: str = ".tex") -> str:
    found = ph.review(text, equations(name), seconds=0.0, format=format).lines
    return "".join(MARKS[blamed(line).value] for line in found)


# Each a text with @ where the true line and its twin differ, both, and the marks of both texts.
TEXTS = {
    "components of a turning are chosen, and the others small": (
        "free",
        r"Let $\omega_1 = \Omega$ and the other two be small. Then $\dot\omega_1 = 0$ and"
        r" \[ \ddot\omega_2 = @\frac{(C-A)(B-A)}{BC}\Omega^2\omega_2 . \]",
        ("-", ""),
        ("-TT", "-TE"),
    ),
    "a permanent rotation": (
        "free",
        r"A permanent rotation is $\omega_1 = \omega_2 = 0$, $\omega_3 = \Omega$. For small"
        r" $\omega_1, \omega_2$ \[ \ddot\omega_1 = @\frac{(C-A)(C-B)}{AB}\Omega^2\omega_1 . \]",
        ("-", ""),
        ("--T", "--E"),
    ),
    "a macro in what words call small": (
        "tennis-racquet",
        r"\newcommand{\w}{\omega} Let $\w_2 = \Omega$, while $\w_1$ and $\w_3$ are small. To first"
        r" order $@ = 0$.",
        (r"\dot\w_2", r"\dot\w_1"),
        ("-T", "-E"),
    ),
    "the rate beside omega x L is that seen from the body": (
        "tennis-racquet",
        r"So $\dot{\vec L} @ \vec\omega\times\vec L = 0$.",
        ("+", "-"),
        ("T", "E"),
    ),
    "a linear part of two lines, one of them wrong": (
        "tennis-racquet",
        r"\[ I_1\dot\omega_1 = @(I_2-I_3)\omega_2\omega_3 . \] Let $\omega_3 = \omega_0$, and let"
        r" $\omega_1$ and $\omega_2$ be small, so"
        r" \[ \dot\omega_2 = \frac{I_3-I_1}{I_2}\omega_0\omega_1 \] \[ \ddot\omega_1 ="
        r" @\frac{(I_2-I_3)(I_3-I_1)}{I_1I_2}\omega_0^2\omega_1 \]",
        ("", "-"),
        ("T-TT", "E-TF"),
    ),
    "the z axis along the angular momentum": (
        "free",
        r"The $z$ axis is along the constant angular momentum $\mathbf L$. Then"
        r" $L@\theta = C\omega_3$.",
        (r"\cos", r"\sin"),
        ("T", "E"),
    ),
    "regular precession": (
        "top",
        r"In regular precession $\dot\theta = 0$ and $\ddot\theta = 0$, so that"
        r" \[ (I_1+ml^2)\dot\phi^2\cos\theta @ p_\psi\dot\phi + mgl = 0 . \]",
        ("-", "+"),
        ("TTT", "TTE"),
    ),
    "a rate that is zero lasts": (
        "top",
        r"Let $\dot\theta = 0$ and $\ddot\theta = 0$;"
        r" \[ (I_1+ml^2)\dot\phi^2\cos\theta @ p_\psi\dot\phi + mgl = 0 . \]",
        ("-", "+"),
        ("--T", "--!"),
    ),
    "at the instant of the release": (
        "gyroscope",
        r"Let it be released from rest, $\dot\theta = \dot\phi = 0$, at $\theta = \pi/2$. At this"
        r" instant \[ F_z = Mg @ Ma\ddot\theta . \]",
        ("-", "+"),
        ("--T", "--E"),
    ),
    "the start goes on to be meant, and is named": (
        "gyroscope",
        r"Let it be released from rest, $\dot\theta = \dot\phi = 0$, at $\theta = \pi/2$. At this"
        r" instant $F_z = Mg - Ma\ddot\theta$. The table carries $F_z = Mg @ Ma\ddot\theta$.",
        ("-", "+"),
        ("--T!", "--TE"),
    ),
    "a radius that an equation determines, and a value of it": (
        "rolling-disk",
        r"In steady motion the centre describes a circle of radius $R$, where"
        r" $R\dot\phi = -a\omega_3$. If the centre is at rest, $R = 0$,"
        r" \[ \dot\phi^2 = @\frac{g}{a\sin\theta} . \]",
        ("4", "2"),
        ("--T", "--E"),
    ),
    "a speed whose sign decides": (
        "rolling-disk",
        r"Near $\theta = \pi/2$ let $\epsilon = \theta - \pi/2$ and $\dot\phi$ be small. The speed"
        r" is $v = @a\omega_3$.",
        ("", "2"),
        ("--!", "--E"),
    ),
    "stability by a wrong equation": (
        "rolling-disk",
        r"Near $\theta = \pi/2$ let $\epsilon = \theta - \pi/2$ and $\dot\phi$ be small. An"
        r" integration gives $\dot\phi = 2\omega_3\epsilon$. Hence"
        r" \[ 5a\ddot\epsilon + (@a\omega_3^2 - 4g)\epsilon = 0 . \] It is stable if"
        r" \[ \omega_3^2 > \frac{4g}{@a} . \]",
        ("12", "8"),
        ("---TT", "---EF"),
    ),
    "bold heads separate motions": (
        "hoop",
        r"\textbf{On the spot.} Let $\theta = \pi/2+\eta$ and $\dot\phi = \Omega$, with $\eta$ and"
        r" $\omega_3$ small. Then $2\dot\omega_3 = \Omega\dot\eta$."
        "\n\n"
        r"\textbf{Rolling straight.} Now $\dot\phi$ and $\eta$ are small, and $\omega_3 = \omega$"
        r" is not. \[ \ddot\phi = @\omega\dot\eta \]",
        ("2", "3"),
        ("--T-T", "--T-E"),
    ),
    "on a separatrix": (
        "satellite",
        r"On the separatrix \[ \dot\theta = \pm n\sqrt{\frac{3(A-C)}{B}}@\theta . \]",
        (r"\cos", r"\sin"),
        ("-", "E"),
    ),
    "momentum that is zero from the start": (
        "wheel",
        r"Everything starts at rest, so $L = 0$ and $\dot\alpha = -\frac{J}{@}\dot\beta$. When the"
        r" wheel has turned by $\beta$ the hull has by $\alpha = -\frac{J}{@}\beta$.",
        ("I+J", "I"),
        ("-T!", "-E-"),
    ),
    "either one equilibrium or another": (
        "governor",
        r"Let $\dot\phi = \Omega$ in steady rotation. Either $@ = 0$ or"
        r" \[ \cos\theta_0 = \frac{g}{l\Omega^2} . \]",
        (r"\sin\theta", r"\cos\theta"),
        ("-TT", "--T"),
    ),
    "a frequency of which the paragraph speaks": (
        "governor",
        r"Small oscillations about it. In steady rotation let $\dot\phi = \Omega$. Then"
        r" \[ \omega^2 = \Omega^2(1+@\cos^2\theta_0) . \]",
        ("3", "2"),
        ("-T", "-E"),
    ),
    "a chain that defines two letters": (
        "shaft",
        r"Let $I_1 = I_2 = A$. Then $I_1+I_2 = @A$.",
        ("2", "3"),
        ("-T", "-E"),
    ),
    "a period of the wrong dimension": (
        "pendulum",
        r"The period is \[ \tau = 2\pi\sqrt{\frac{@}} . \]",
        (r"I+mh^2}{mgh", r"mgh}{I+mh^2"),
        ("T", "E"),
    ),
    "a complex combination of small angles": (
        "gyroscope/upright",
        r"Here $\alpha$ and $\beta$ are its two small angles. Let $I = I_2+Ma^2$, and let"
        r" $z = \alpha+i\beta$. Then \[ I\ddot z @ iI_1\omega_1\dot z - Mga\,z = 0 . \]",
        ("-", "+"),
        ("--T", "--E"),
    ),
    "the Routhian of one of two cyclic coordinates": (
        "top",
        r"Let $I = I_1+ml^2$. As $\psi$ is cyclic, $\mathcal R = \mathcal L-p_\psi\dot\psi$. Thus"
        r" \[ \mathcal R = \frac I2(\dot\theta^2+\dot\phi^2\sin^2\theta)"
        r" @ p_\psi\dot\phi\cos\theta - \frac{p_\psi^2}{2I_3} - mgl\cos\theta . \]",
        ("+", "-"),
        ("--T", "--E"),
    ),
    "numbers put in, with the unit at the end": (
        "pendulum",
        r"Let $m = 2$ kg and $h = 0.3$ m. At $\theta = 60^\circ$ the torque is"
        r" $mgh\sin\theta = 2\cdot9.81\cdot0.3\cdot@$ N m.",
        ("0.866 = 5.10", "0.5 = 2.94"),
        ("---T", "---E"),
    ),
    "a number beside an angle whose sine is no root": (
        "pendulum",
        r"Let $m = 2$ kg and $h = 0.3$ m. With $\theta = 20^\circ$ and $g = 9.81$ m/s$^2$ we get"
        r" $V = @$ J.",
        ("-5.53", "-5.35"),
        ("----T", "----E"),
    ),
    "a superscript in a unit": (
        "pendulum",
        r"Let $I = 0.05$ kg m², $m = 2$ kg and $h = 0.3$ m. Then $I+mh^2 = @$ kg m².",
        ("0.23", "0.32"),
        ("---T", "---E"),
    ),
}
CASES = [
    pytest.param(name, text.replace("@", put), expected, id=f"{title}: {put or 'plain'}")
    for title, (name, text, both, marked) in TEXTS.items()
    for put, expected in zip(both, marked, strict=True)
]


@pytest.mark.parametrize(("name", "text", "expected"), CASES)
def test_a_true_line_and_its_twin_with_a_slip(name, text, expected):
    assert marks(text, name) == expected


def test_a_turning_that_is_a_consequence_is_a_claim():
    assert marks(r"It follows that \[ \omega_3 = 0 . \]", "free") == "E"


@pytest.mark.parametrize(
    ("number", "mark"), [("0.2943", "-"), ("0.5886", "E")], ids=["right", "wrong"]
)
def test_a_number_in_a_chain_is_judged_whatever_its_first_letter_is(number, mark):
    """Ω is one of two roots, but what is put in for Mga and I₁ω₁ is right or wrong."""
    text = (
        r"Let $M=0.5$ kg, $a=6$ cm, $I_1=6.25\cdot10^{-4}$ kg m$^2$, $\omega_1=150$ rad/s. In"
        r" steady motion $\dot\phi \approx \frac{Mga}{I_1\omega_1} = "
        rf"\frac{{{number}}}{{0.09375}}$."
    )
    assert marks(text, "gyroscope")[-1] == mark
