"""What holds only as the text defines a letter is not called true of the system."""

import pytest

import polhode as ph
from polhode.judge import Mark

M, L, G = ph.symbols("m l g", positive=True)


@pytest.fixture(scope="module")
def rod():
    """A rod that swings about one end, θ from hanging."""
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    body = ph.rod("rod", mass=M, length=L, axes=axes, axis="z")
    return ph.derive(ph.System(ph.Pivot(body, at=axes["z"] * (L / 2)), ph.Gravity(G)))


def marks(text, equations):
    return [line.mark for line in ph.review(text, equations, format=".md").lines]


def test_an_angle_up_to_turns_says_nothing_again(rod):
    """It defines n; what gives a letter may be the answer that is asked for."""
    text = r"So $\theta = \frac{\pi}{2} + n\pi$. Answer: $$\theta = \frac{\pi}{2} + n\pi.$$"
    assert marks(text, rod) == [Mark.NOT_JUDGED, Mark.NOT_JUDGED]
    text = r"Let $S = \sqrt{\frac{3g}{2l}}$. Then $$S = \sqrt{\frac{3g}{2l}}.$$"
    assert marks(text, rod) == [Mark.NOT_JUDGED, Mark.TRUE]


def test_what_follows_from_a_doubtful_definition_is_in_doubt(rod):
    text = r"""The centre of mass is at
    $$x_{\text{cm}} = -l\sin\theta, \quad z_{\text{cm}} = -\frac{l}{2}\cos\theta.$$
    So its velocity is
    $$\dot{x}_{\text{cm}} = -l\dot\theta\cos\theta,
      \quad \dot z_{\text{cm}} = \frac{l}{2}\dot\theta\sin\theta.$$"""
    assert marks(text, rod) == [Mark.DOUBT, Mark.TRUE, Mark.DOUBT, Mark.TRUE]


@pytest.mark.parametrize(
    ("chain", "mark"),
    [
        (r"\sqrt{\frac{3g}{2l}} = \frac{\sqrt{6 g l}}{2l}", Mark.TRUE),
        (r"\sqrt{\frac{g}{l}} = \frac{\sqrt{g l}}{l}", Mark.DOUBT),
        (r"\sqrt{\frac{g}{l}}", Mark.DOUBT),
    ],
)
def test_what_words_call_the_frequency_is_claimed_to_be_that(rod, chain, mark):
    """ω² = m g (l/2) / (m l²/3); a chain may hold behind a wrong first member."""
    text = rf"For small angles the rod oscillates with the frequency $$\omega = {chain}.$$"
    assert marks(text, rod) == [mark]


def test_a_condition_of_existence_elsewhere_is_none_of_stability_here():
    """A bead on a hoop that is turned at Ω: at the top it is never stable."""
    omega, radius = ph.symbols("Omega R", positive=True)
    turned = ph.earth(omega, colatitude=0)
    axes = turned.rotated(-ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=M, axes=axes)
    wire = ph.Pivot(bead, at=axes["z"] * radius, name="wire", along=axes)
    bodies = ph.System(wire, ph.Hinge(bead, axis="y"), ph.Gravity(G))
    hoop = ph.derive(bodies)
    text = r"""At the top, $\theta = \pi$. For stability: $$\Omega^2 > \frac{g}{R}.$$"""
    assert marks(text, hoop)[-1] is not Mark.TRUE
    text = r"There are equilibria beside the vertical if $$\Omega^2 > \frac{g}{R}.$$"
    assert marks(text, hoop)[-1] is Mark.TRUE
