"""A solution says where a contact opens: the textbooks' answer for ladder and cylinder."""

import polhode as ph
from polhode.catalogue import CATALOGUE


def section(system: ph.System) -> list:
    return list(ph.solution(system).sections.get("Where contacts open", ()))


def test_a_ladder_leaves_the_wall_at_two_thirds_of_its_height() -> None:
    force, opens = section(CATALOGUE["ladder"].build())
    assert force.latex == (
        r"W_x = \frac{3 m g \cos\alpha \left(3 \sin\alpha - 2 \sin\alpha_0\right)}{4}"
    )
    assert force.verdict.holds
    assert r"Where $\sin\alpha = \frac{2 \sin\alpha_0}{3}$" in opens.words
    assert "the contact “wall” opens" in opens.words


def test_a_cylinder_leaves_a_cylinder_at_four_sevenths() -> None:
    _, opens = section(CATALOGUE["cylinder-in-cylinder"].build())
    assert r"\cos u = \frac{4 \cos u_0}{7}" in opens.words


def test_a_disk_that_moves_in_several_coordinates_has_no_such_place() -> None:
    assert section(CATALOGUE["rolling-disk"].build()) == []


def test_several_contacts_of_a_body_are_told_apart_and_a_wall_is_vertical() -> None:
    text = " ".join(s.words for s in ph.solution(CATALOGUE["ladder"].build()).steps)
    assert "slides without friction on a vertical plane" in text
    assert "(the contact “floor”)" in text
    assert "As long as everything touches, the motion is that of a simple pendulum" in text
