"""Displays that begin with a sign of a relation go on with the left side of the one before."""

from polhode.judge.source import read_source

_TEXT = r"""The Lagrangian is

$$
L = T - V
$$

$$
= \frac12 m l^2\dot\theta^2 + mgl\cos\theta
$$

$$
\approx \frac12 m l^2\dot\theta^2 - \frac12 mgl\theta^2 .
$$
"""


def test_they_are_relations_of_the_letter_before():
    found = read_source(_TEXT, ".md")
    assert [r.printed.partition(" ")[0] for r in found] == ["L", "L", "L"]
    assert [r.line for r in found] == [4, 8, 12]
    assert [r.latex[:2] for r in found] == ["L ", "= ", r"\a"]


def test_a_first_display_has_nothing_to_go_on_with():
    (found,) = read_source("$$ = m g $$", ".md")
    assert not found.read
    assert "left side" in found.why


def test_what_was_not_read_is_not_gone_on_with():
    first, second = read_source("$$ a = b + $$\n\n$$ = m g $$", ".md")
    assert not first.read
    assert not second.read
