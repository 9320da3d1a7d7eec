"""Claims about motions of which an acceleration is given, as of a translation: θ̇ = 0 and θ̈ = 0."""

import pytest

import polhode as ph
from polhode.judge import Mark

M, L, G = ph.symbols("M L g", positive=True)
ALPHA = ph.symbol("alpha")
STILL = [r"\dot\theta = 0", r"\ddot\theta = 0"]


@pytest.fixture(scope="module")
def rod():
    """A rod of which one end slides down a slope without friction; θ from hanging.

    By Lagrange, M s̈ + ½ M L (θ̈ cos(θ - α) - θ̇² sin(θ - α)) + M g sin α = 0.
    """
    s, theta = ph.coordinates("s theta")
    lab = ph.Frame("lab")
    slope = lab.rotated(-ALPHA, "y")
    axes = lab.rotated(-theta, "y")
    body = ph.rod("rod", mass=M, length=L, axes=axes, axis="z")
    end = ph.Pivot(body, at=axes["z"] * (L / 2), to=slope["x"] * s, along=slope, name="slope")
    return ph.derive(ph.System(end, ph.Hinge(body, axis="y", name="plane"), ph.Gravity(G)))


@pytest.mark.parametrize(
    ("claim", "given", "answer"),
    [
        (r"M \ddot s + M g \sin\alpha = 0", STILL, "holds"),
        (r"\ddot s = -g \sin\alpha", STILL, "holds"),
        # the state of such a motion is that of a cubic equation in sines and cosines
        (r"M \ddot s + M g \cos\alpha = 0", STILL, "unread"),
        (r"M \ddot s + M g \sin\alpha = 0", STILL[:1], "fails"),
        (
            r"\ddot s - \tfrac12 L \dot\theta^2 \sin(\theta - \alpha) + g \sin\alpha = 0",
            STILL[1:],
            "holds",
        ),
        (
            r"\ddot s - \tfrac13 L \dot\theta^2 \sin(\theta - \alpha) + g \sin\alpha = 0",
            STILL[1:],
            "fails",
        ),
    ],
)
def test_other_accelerations_follow_from_rows(rod, claim, given, answer):
    assert ph.check(claim, rod, given=given).answer.value == answer


def test_a_text_that_sets_rates_to_zero_is_followed(rod):
    text = r"""For pure translation $\dot\theta = 0$ and $\ddot\theta = 0$.
    $$M \ddot s + M g \sin\alpha = 0$$"""
    line = ph.review(text, rod, format=".md").lines[-1]
    assert line.mark in (Mark.TRUE, Mark.NEEDS)
