"""Identities decided at random states in a prime field, from restrictions to loops of bodies."""

from __future__ import annotations

from functools import cache

import pytest

import polhode as ph
from derive.bicycles import bicycle
from polhode.catalogue import PROBLEM_SET
from polhode.derive import Equations
from polhode.judge import Answer
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion

NAMES = ("rolling-disk", "gyroscope", "tennis-racquet", "ball-on-paper", "marble-on-turntable")


@cache
def known(name: str) -> Equations:
    return ph.derive(PROBLEM_SET[name].build())


@pytest.mark.parametrize("kind", [AnyState, TrueMotion])
@pytest.mark.parametrize("name", NAMES)
def test_it_agrees_with_the_normal_form(name: str, kind: type[ClaimDomain]) -> None:
    equations = known(name)
    states = kind(equations)
    assert states.field is not None
    energy, power = equations.energy, equations.power
    tried = [energy.dt(), energy.dt() - power, *equations.motion]
    tried += [row.dt() for row in equations.motion]
    speeds = map(ph.Expr.generator, equations.speeds)
    tried += [row + speed for row, speed in zip(equations.rows, speeds, strict=True)]
    for expression in tried:
        assert states.field.vanishing(expression).is_zero == (not states.on(expression))


def test_a_restriction_holds_at_every_state() -> None:
    equations = known("rolling-disk")
    theta = next(s for s in equations.coordinates if s.name == "theta")
    flat = TrueMotion(equations, {theta: ph.pi / 2})
    angle = ph.Expr.generator(theta)
    assert flat.vanishing(ph.cos(angle)).is_zero
    assert flat.vanishing(angle - ph.pi / 2).is_zero
    assert not flat.vanishing(ph.sin(angle)).is_zero
    assert not flat.vanishing(ph.Expr.generator(theta.derivative())).is_zero


def test_a_product_vanishes_where_one_factor_or_another_does() -> None:
    states = TrueMotion(known("rolling-disk"))
    speed = ph.Expr.generator(states.equations.speeds[0])
    size = ph.algebra.absolute(speed)
    assert not states.vanishing(size - speed).is_zero
    assert states.vanishing(size - speed, size + speed).is_zero


def test_laws_of_the_bicycle_hold() -> None:
    verdict = ph.check(r"\dot E = 0", bicycle())
    assert verdict.answer is Answer.HOLDS
    assert verdict.error_bound is not None
    assert 0 < verdict.error_bound < 1e-20


def test_the_bicycle_is_refuted_at_a_state_in_which_its_loop_is_closed() -> None:
    verdict = ph.check(r"\ddot\delta = 0", bicycle())
    assert verdict.answer is Answer.FAILS
    assert verdict.confirmation is not None  # exists only where all supports allow the state
    assert verdict.confirmation.agrees


def test_the_closure_of_a_loop_vanishes_though_it_does_not_where_lengths_are_free() -> None:
    equations = bicycle()
    (closure,) = equations.closures
    assert AnyState(equations).vanishing(closure).is_zero
    assert not AnyState(equations).vanishing(closure + 1).is_zero


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"m\dot{\mathbf v}_{\rm cm} = \mathbf F - mg\hat{\mathbf z}", Answer.HOLDS),
        (r"m\dot{\mathbf v}_{\rm cm} = \mathbf F - 2mg\hat{\mathbf z}", Answer.FAILS),
    ],
)
def test_a_driven_system_is_judged_like_any_other(latex: str, answer: Answer) -> None:
    assert ph.check(latex, known("ball-on-paper")).answer is answer
