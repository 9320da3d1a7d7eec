"""Worked solutions of bodies on curved supports: what they say of the support."""

from __future__ import annotations

import polhode as ph
from polhode.solution import markdown_of_solution

M, G, A, R, ALPHA = ph.symbols("m g a R alpha")
LAB = ph.Frame("N")


def text_of(support) -> str:
    ball = ph.sphere("ball", mass=M, radius=A, axes=support.axes)
    system = ph.System(ball, ph.Rolling(ball, on=support), ph.Gravity(G), name="ball")
    return markdown_of_solution(ph.solution(system))


def test_a_drum():
    text = text_of(ph.Cylinder(LAB, radius=R, inside=True, axis="z"))
    assert "rolls without slipping on the inside of a cylinder of radius $R$" in text
    assert "$u$ is its angle about the axis and $v$ its distance along it" in text
    assert "plane" not in text.split("## Velocities")[0]


def test_a_funnel():
    text = text_of(ph.Cone(LAB, half_angle=ALPHA, inside=True))
    assert r"on the inside of a cone of half-angle $\alpha$ with its axis along $z$" in text
