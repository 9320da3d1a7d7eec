"""Declarations print as lines that can be read."""

import pytest

import polhode as ph
from model.parts import PARTS


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_every_line_is_short_and_none_is_raw(part):
    lines = str(part).splitlines()
    assert lines[0].startswith(f"{type(part).__name__} {part.name!r}")
    assert max(map(len, lines)) < 110
    assert not any("=" in line or "None" in line for line in lines)


def test_a_contact_tells_what_touches_what():
    lab = ph.Frame("lab")
    m, a = ph.symbols("m a", positive=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    table = ph.Turntable(lab, ph.symbol("Omega"))
    assert str(ph.Coulomb(ball, on=table, mu=0.3, name="felt")).splitlines() == [
        "Coulomb 'felt'",
        "  body         ball",
        "  on           Turntable in lab (x y z), z up",
        "  force        F",
        "  restitution  0",
        "  mu           3/10",
        "  mu static    3/10",
        "  viscous      0",
    ]
    assert str(table).splitlines()[-1].split() == ["Omega", "Omega"]
    assert str(ball.point(lab["z"] * a)).startswith("point (0, 0, a) along lab (x y z) of ball")
