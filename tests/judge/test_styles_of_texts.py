"""True lines in the words of different authors beside false twins of them, each marked by its own.

Expectations are closed forms: a bead on a uniformly turning rod runs as r = b cosh Ωt; a rod let
fall from the horizontal presses on its hinge with (5/2)mg sin θ along itself and (1/4)mg cos θ
across (Loney, Dynamics of a Particle and of Rigid Bodies, § 148); a ball on a moving sheet
accelerates at 2/7 of the sheet's acceleration; a bead on a hoop oscillates about cos θ₀ = g/ω²R at
ω sin θ₀ (Taylor, Classical Mechanics, § 7.6).
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge import textbook_systems as systems
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

EXAMPLES = Path(__file__).parents[2] / "docs/examples/solutions"
MARKS = {"T": "true", "E": "error", "F": "follows", "?": "unlinked", "!": "needs"}
MARKS["-"] = "not-judged"
SIGNS = {mark: sign for sign, mark in MARKS.items()}


@cache
def turning_rod() -> ph.Equations:
    m, Omega = ph.symbols("m Omega", positive=True)
    r = ph.coordinate("r")
    turning = ph.Frame("lab").rotated(Omega * ph.time, "z", labels="r p z")
    bead = ph.point_mass("bead", mass=m, axes=ph.Frame("lab"))
    rod = ph.Pivot(bead, to=turning["r"] * r, along=turning, name="rod", force="N")
    return ph.derive(ph.System(rod, name="bead on a turning rod"))


@cache
def planet() -> ph.Equations:
    m, k = ph.symbols("m k", positive=True)
    r, phi = ph.coordinates("r phi")
    lab = ph.Frame("lab")
    body = ph.point_mass("planet", mass=m, axes=lab)
    arm = ph.Pivot(body, to=lab.rotated(phi, "z", labels="r f z")["r"] * r, name="arm")
    return ph.derive(ph.System(arm, ph.Potential(-k / r, on=body), name="planet"))


@cache
def system(name: str) -> ph.Equations:
    own = {"turning rod": turning_rod, "planet": planet}
    if name in own:
        return own[name]()
    if name in PROBLEM_SET:
        return ph.derive(PROBLEM_SET[name].build())
    if hasattr(systems, name) and name not in ("physical_pendulum", "spherical_pendulum"):
        return getattr(systems, name)()
    return ph.derive(runpy.run_path(str(EXAMPLES / f"{name}.py"))[name])


LETTERS = r"""$l\ddot\varphi + \ddot x\cos\varphi + g\sin\varphi = 0$.
Linearised about $\varphi = 0$:
\[ \ddot\varphi = %s\frac{(m_1+m_2)g}{m_1l}\varphi . \]"""
NONE = r"Linearised about $\varphi = 0$: \[ I\ddot\varphi = -2Mgl\varphi . \]"
COIN = r"""(a) The centre moves up and down, $z = a\sin\theta$.

(b) Vertical: $N - mg = %s m\ddot z$."""
BALL = r"""**Problem 3.** A ball rolls down a slope of $\alpha = 30°$.

(a) At least $\mu_0 = \frac27\tan\alpha = %s$ is needed."""
SHEET = r"""The sheet does not turn, $\dot\chi = 0$, and $k=2/5$.
\[ v_x - r\omega_y = \dot X, \qquad \dot v_x = \frac%s7\ddot X . \]"""
HINGE = r"""It is let fall from the horizontal, $\theta = 0$, where it is at rest.
The force along the rod is $P$ and that across it is $Q$. For the centre of mass
$P - mg\sin\theta = mb\dot\theta^2$ and $mg\cos\theta - Q = mb\ddot\theta$.
Thus $P = \frac%s2mg\sin\theta$ and $Q = \frac%s4mg\cos\theta$."""
BEAD = r"""The bead starts from rest at $r = b$, so that $r = b\cosh\Omega t$ and
$\dot r = %s b\Omega\sinh\Omega t$. Hence $\dot r^2 = \Omega^2(r^2 - b^2)$."""
PLACES = r"""Fixed points: $\theta = 0$, $\theta=\pi$ and $\cos\theta = \frac{g}{R\omega^2}$.
Near $\theta = 0$ we get $\ddot\theta = (%s\omega^2 - \frac gR)\theta$.
Around the other fixed point, $\cos\theta_0 = \frac{g}{R\omega^2}$, put $\theta = \theta_0 + \eta$;
for small $\eta$: $\ddot\eta = -\omega^2%s\,\eta$."""
AXLE = r"""Let $I = I_2 + Ma^2$ be the moment of inertia about a horizontal axis through the pivot.
\[ I\ddot\theta = I\dot\phi^2\sin\theta\cos\theta - I_1\omega_1\dot\phi\sin\theta
%s Mga\sin\theta \]"""
LENGTH = r"""$\ell = mr^2\dot\phi$. For a circular orbit of radius $r_0$, $\ell^2 = %s mkr_0$."""
RELEASED = r"""The top is released with $\dot\theta=0$ and $\dot\phi=0$ at $\theta = \theta_0$.
Thus \[ p_\phi = I_3\omega_3\cos\theta_0 %s . \]"""
ENERGY = r"""If the centre rests, $\omega_3 = 0$.

In steady motion $E = \frac38ma^2\cdot%s\omega_3^2 + \frac18ma^2\dot\phi^2\sin^2\theta
+ mga\sin\theta$."""
SWING = r"For small swings $\ddot\theta \approx -\frac{%sg}{2L}\theta$."
WINKEL = r"F\"ur kleine Winkel $\varphi$ gilt \[ m_1l\ddot\varphi %s (m_1+m_2)g\varphi = 0 . \]"
PULLS = r"""Let $\lambda$ be its push: $\lambda - mg\cos\theta = -ml(\dot\theta^2
+ \sin^2\theta\,\dot\phi^2)$. So $\lambda = 3mg\cos\theta - \frac{%sE}{l}$.
So the rod pulls ($\lambda<0$) as long as $E > \frac32mgl\cos\theta$."""
GOING = r"""If the body is set going at the bottom with $\dot\theta = \Omega$, energy gives
\[ \dot\theta^2 = \Omega^2 - \frac{mgl}{I_2+ml^2}(1-\cos\theta) . \]"""

TEXTS = {
    "the other form of a letter": ("cart", LETTERS % "-", "T - T"),
    "the other form of a letter, in a wrong line": ("cart", LETTERS % "-2", "T - E"),
    "a letter that the model does not have": ("compound_pendulum", NONE, "- -"),
    "letters of the part before": ("spinning-coin", COIN % "", "T T"),
    "letters of the part before, in a wrong line": ("spinning-coin", COIN % "2", "T E"),
    "what stands before the parts": ("ball_on_a_slope", BALL % "0.165", "- T"),
    "what stands before the parts, in a wrong line": ("ball_on_a_slope", BALL % "0.265", "- E"),
    "a prescribed motion that is chosen": ("ball-on-paper", SHEET % "2", "- - T T"),
    "a wrong line about a prescribed motion": ("ball-on-paper", SHEET % "3", "- - T E"),
    "a force by its first equation": ("falling_rod", HINGE % (5, 1), "- - - T T"),
    "a wrong force after its first equation": ("falling_rod", HINGE % (7, 3), "- - - E E"),
    "a motion in time from a start": ("turning rod", BEAD % "", "- T T T"),
    "a wrong motion in time is no start": ("turning rod", BEAD % "2", "- T E T"),
    "near a place": ("turning_hoop", PLACES % ("", r"\sin^2\theta_0"), "T T T - T T - T"),
    "wrong near a place": ("turning_hoop", PLACES % ("-", r"\cos^2\theta_0"), "T T T - E T - E"),
    "a moment of inertia about an axis": ("gyroscope", AXLE % "+", "- T"),
    "a wrong line with a moment of inertia": ("gyroscope", AXLE % "-", "- E"),
    "a radius that an orbit keeps": ("planet", LENGTH % "", "- T"),
    "a wrong line about a radius that an orbit keeps": ("planet", LENGTH % "2", "- !"),
    "a momentum from a start at rest": ("spinning_top", RELEASED % "", "- - - T"),
    "a wrong momentum from a start at rest": (
        "spinning_top",
        RELEASED % r"\sin\theta_0",
        "- - - E",
    ),
    "a speed that the line prints is not zero": ("rolling-disk", ENERGY % "2", "- T"),
    "a wrong line does not need a speed of zero": ("rolling-disk", ENERGY % "", "- E"),
    "an approximation for small swings": ("rod_pendulum", SWING % "3", "T"),
    "a wrong approximation for small swings": ("rod_pendulum", SWING % "2", "E"),
    "small angles in German": ("cart", WINKEL % "+", "T"),
    "a wrong line for small angles in German": ("cart", WINKEL % "-", "E"),
    "an inequality that is limited behind it": ("spherical_pendulum", PULLS % "2", "- T - -"),
    "a wrong line before it": ("spherical_pendulum", PULLS % "", "- ! - -"),
}


@pytest.mark.parametrize("said", TEXTS)
def test_a_line_and_its_false_twin(said: str) -> None:
    name, text, expected = TEXTS[said]
    lines = ph.review(text, system(name), format=".md", seconds=0.0).lines
    found = " ".join(SIGNS[blamed(line).value] for line in lines)
    assert found == expected, [(line.latex, line.needs or line.reason) for line in lines]


def test_a_line_that_prints_an_angle_with_its_rate_is_not_about_one_value_of_it() -> None:
    """Where θ = 0 at the bottom, any factor of 1 - cos θ would do."""
    lines = ph.review(GOING, system("physical_pendulum"), format=".md", seconds=0.0).lines
    assert blamed(lines[-1]) is not ph.Mark.TRUE
