"""What is true stays true in other words, and a correction speaks in the letters of the text."""

from __future__ import annotations

import re
from functools import cache

from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from catalogue.systems import equations
from polhode.judge import Answer, Verdict, read_latex, write_latex
from polhode.judge.latex._tree import Negative, Node, Number, Product, Relation, Sum

TRUE = (
    r"I_1\omega_1\dot\phi\sin\theta - (I_2 + Ma^2)\dot\phi^2\sin\theta\cos\theta"
    r" + (I_2 + Ma^2)\ddot\theta = Mga\sin\theta",
    r"F_z = Mg - Ma\ddot\theta\sin\theta - Ma\dot\theta^2\cos\theta",
    r"\dot\omega_1 = \ddot\psi + \ddot\phi\cos\theta - \dot\phi\dot\theta\sin\theta",
)
FACTORS = (
    "2",
    r"\frac{1}{3}",
    "M",
    r"g a",
    r"I_2 + M a^2",
    r"e^{\theta}",
    r"1 + \dot\theta^2",
    "-1",
)


def terms_of(node: Node) -> list[Node]:
    return list(node.terms) if isinstance(node, Sum) else [node]


def sum_of(terms: list[Node]) -> Node:
    if len(terms) < 2:
        return [*terms, Number("0")][0]
    return Sum(tuple(terms))


@st.composite
def in_other_words(draw: st.DrawFn) -> str:
    """A true equation with terms taken across, in another order, and multiplied through."""
    (relation,) = read_latex(draw(st.sampled_from(TRUE))).relations
    left, right = map(terms_of, relation.sides)
    signed = [*((term, 0) for term in left), *((term, 1) for term in right)]
    sides: tuple[list[Node], list[Node]] = ([], [])
    for term, side in draw(st.permutations(signed)):
        place = draw(st.integers(0, 1))
        sides[place].append(term if place == side else Negative(term))
    ((factor,),) = (r.sides for r in read_latex(draw(st.sampled_from(FACTORS))).relations)
    scaled = [Product((factor, sum_of(side))) for side in draw(st.permutations(sides))]
    return write_latex(Relation(tuple(scaled), ("=",)))


@given(in_other_words())
@settings(max_examples=25)
def test_a_true_claim_holds_in_other_words(latex: str) -> None:
    assert ph.check(latex, equations("gyroscope")).answer is Answer.HOLDS


LETTERS = ("m", "l", "g", "theta")


@cache
def pendulum(mass: str, length: str, gravity: str, angle: str) -> ph.Equations:
    m, l, g = (ph.symbol(name, positive=True) for name in (mass, length, gravity))
    (turn,) = ph.coordinates(angle)
    axes = ph.Frame("lab").rotated(turn, "y")
    bob = ph.Body("bob", mass=m, inertia=(0, 0, 0), axes=axes)
    return ph.derive(ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g)))


def written(name: str) -> str:
    return name if len(name) == 1 else rf"\{name}"


def said(mass: str, length: str, gravity: str, angle: str) -> Verdict:
    m, l, g, theta = (written(name) for name in (mass, length, gravity, angle))
    wrong = rf"{m} {l} \ddot{{{theta}}} = -2 {m} {g} \sin {theta}"
    return ph.check(wrong, pendulum(mass, length, gravity, angle))


@given(
    mass=st.sampled_from(["m", "M", "mu"]),
    length=st.sampled_from(["l", "a", "R"]),
    gravity=st.sampled_from(["g", "f"]),
    angle=st.sampled_from(["theta", "phi", "alpha"]),
)
@settings(max_examples=10)
def test_a_correction_speaks_in_the_letters_of_the_text(
    mass: str, length: str, gravity: str, angle: str
) -> None:
    letters = dict(zip(LETTERS, (mass, length, gravity, angle), strict=True))
    first, other = said(*LETTERS), said(*letters.values())
    assert first.answer is other.answer is Answer.FAILS
    corrected = [c for c in (first.correction, *first.alternatives) if c is not None]
    again = [c for c in (other.correction, *other.alternatives) if c is not None]
    assert corrected
    assert [c.what for c in again] == [c.what for c in corrected]
    assert {renamed(c.latex, letters) for c in corrected} == {c.latex for c in again}


def renamed(latex: str, letters: dict[str, str]) -> str:
    def other(word: re.Match[str]) -> str:
        return written(letters[word[2]])

    return re.sub(r"(\\?)\b(m|l|g|theta)\b", other, latex)
