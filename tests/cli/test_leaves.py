"""`polhode leaves`: text, document and refusals."""

from __future__ import annotations

import pytest

SYSTEM = """
import polhode as ph
m, a, R, g = ph.symbols("m a R g", positive=True)
lab = ph.Frame("N")
hill = ph.Sphere(lab, radius=R)
ball = ph.sphere("ball", mass=m, radius=a, axes=hill.axes)
system = ph.System(ph.Rolling(ball, on=hill), ph.Gravity(g), name="ball")
"""


@pytest.fixture
def named(tmp_path) -> str:
    (tmp_path / "hill.py").write_text(SYSTEM, "utf-8")
    return f"{tmp_path / 'hill.py'}:system"


def test_text(polhode, named):
    code, out, err = polhode("leaves", named, "--from", "u=60deg", "--at", "m=2kg")
    assert (code, err) == (0, "")
    assert "opens where cos u = 5/17" in out
    assert "N = 2 g (17 cos u − 5)/7" in out


def test_document(document, named):
    contacts = document("leaves", named)["contacts"]
    assert [c["what"] for c in contacts] == ["opens", "greatest", "slips"]
    assert contacts[0]["latex"] == r"\cos u = \frac{10}{17}"
    assert contacts[0]["least_mu"]["sympy"]


def test_refusals(polhode, named):
    for words, said in (
        (("leaves", named, "--from", "q=1"), "q"),
        (("leaves", "gyroscope"), "a system with a contact"),
        (("leaves", named, "--from", "u=1m"), "u"),
    ):
        code, _, err = polhode(*words)
        assert code == 2
        assert said in err


def test_an_angle_without_a_short_sine(polhode, named):
    """Its cosine in decimals, which no other fraction of the line runs into."""
    _, out, _ = polhode("leaves", named, "--from", "u=3deg")
    assert "opens where cos u = 10·0.9986295348/17" in out
