"""Whether a claim is true, by numbers: states whose motion other programs work out.

Accelerations and reactions come from the oracles, which have all bodies in the inertial frame with
multipliers and know nothing of polhode. What the constraints alone make of them, such as the rate
of an angle that is no speed, comes from differentiating the declaration by numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property, partial
from itertools import islice

import numpy as np
from scipy.optimize import newton

from catalogue.test_newton_euler import as_on_paper, thin
from derive.states import evaluator
from oracles import balls, disks, gyroscopes
from polhode.algebra import Expr, Symbol
from polhode.base import PolhodeError
from polhode.judge.balance._newton_euler import constrained_motion
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import BoundClaim

Values = dict[str, float]
Motion = Callable[[Mapping[str, float]], Mapping[str, float]]

_STATES = 4
_TRIES = 60
_CLOSE = 1e-8
_NOT_SAID = ("pi",)


def _needing(oracle: Callable[..., Values], names: str) -> Motion:
    return lambda state: oracle(**{name: state[name] for name in names.split()})


_DISK = "m a g I_1 I_3 theta phi psi theta_dot phi_dot omega_3"
_TOP = "M a I_1 I_2 g theta phi psi omega_1"
_SHEET = "X Y chi X_dot Y_dot chi_dot X_ddot Y_ddot chi_ddot"
_BALL = f"m r k g x y v_x v_y omega_z {_SHEET}".split()

MOTIONS: dict[str, Motion] = {
    "spinning-coin": lambda s: _needing(disks.spinning_coin, f"{_DISK} v_x v_y")(thin(dict(s))),
    "rolling-disk": lambda s: _needing(disks.rolling_disk, _DISK)(thin(dict(s))),
    "marble-on-turntable": _needing(balls.level_turntable, "m a I g Omega x y v_x v_y omega_z"),
    "marble-on-turntable/tilted": _needing(
        balls.tilted_turntable, "m a I g Omega alpha x_2 x_3 v_2 v_3 omega_1"
    ),
    "gyrocompass": _needing(
        gyroscopes.free_rotor_compass, "I_1 I_3 Omega lambda_ theta theta_dot omega"
    ),
    "tennis-racquet": _needing(
        gyroscopes.free_body, "I_1 I_2 I_3 omega_1 omega_2 omega_3 phi theta psi"
    ),
    "ball-on-paper": lambda s: balls.rolling_on_paper(**as_on_paper({n: s[n] for n in _BALL})),
    "gyroscope": _needing(gyroscopes.gyroscope, f"{_TOP} theta_dot phi_dot"),
    "gyroscope/held": _needing(gyroscopes.held_gyroscope, _TOP),
    "gyroscope/vertical-plane": _needing(
        gyroscopes.gyroscope_in_vertical_plane, f"{_TOP} theta_dot"
    ),
}
#: In steady motion: what is at rest, and the speeds one of which lets it stay so.
_STEADY = {
    "spinning-coin": ("theta", ("omega_3", "phi_dot")),
    "rolling-disk": ("theta", ("omega_3", "phi_dot")),
    "gyroscope": ("theta", ("omega_1", "phi_dot")),
}
#: Numbers an oracle asks for on which the motion does not depend.
_ALSO = {"gyroscope/held": ("I_2",)}
#: Contexts that the oracle can speak of.
JUDGED = ("identity", "motion", "steady")


class Oracle:
    """Tells of claims of one notation, restricted alike, whether they are true."""

    def __init__(self, claim: BoundClaim, context: str, letters: Iterable[Symbol] = ()) -> None:
        self._claim, self._context = claim, context
        self._letters = frozenset(letters)

    @cached_property
    def states(self) -> list[Values]:
        """Numbers of every symbol at some states, each with the motion the context is about."""
        return list(islice(self._states(), _STATES))

    def _states(self) -> Iterator[Values]:
        for seed in range(_TRIES):
            try:
                state = self._drawn(seed).obeying_relations()
            except (PolhodeError, ArithmeticError, RuntimeError):
                continue
            if state is not None and all(x > 0 for x in _numbers(self._claim.positive, state)):
                yield state

    def _drawn(self, seed: int) -> _State:
        return _State(self._claim, self._context, seed, self._letters)

    def is_true(self, claim: BoundClaim) -> bool | None:
        """Whether a claim holds at all states; None where the oracle cannot tell."""
        try:
            if self._context == "steady" and (solved := _solved(claim)):
                return all(self._stays(quantity, value) for quantity, value in solved)
            return all(_met(claim, state) for state in self.states) if self.states else None
        except (KeyError, ArithmeticError, ValueError, TypeError):
            return None

    def _stays(self, quantity: str, value: Expr) -> bool:
        """Whether nothing speeds up where a speed has the value that is claimed."""
        name = self._claim.equations.system.name
        rest, _ = _STEADY[name]
        for state in self.states:
            still = {**state, quantity: _numbers([value], state)[0]}
            if not abs(MOTIONS[name](still)[f"{rest}_ddot"]) < _CLOSE:
                return False
        return True


class _State:
    """One draw of everything that is free."""

    def __init__(
        self, claim: BoundClaim, context: str, seed: int, letters: Collection[Symbol]
    ) -> None:
        self.claim, self.context, self.seed = claim, context, seed
        self.system = claim.equations.system
        every = {*_symbols(claim), *letters}
        self.symbols = {s.published: s for s in every if s.order < 3 or not s.kind.varies}
        random = np.random.default_rng(seed)
        self.drawn = {name: float(random.uniform(0.5, 1.2)) for name in sorted(self.symbols)}
        for name, symbol in self.symbols.items():
            if symbol.kind.varies and symbol.order and random.random() < 1 / 3:
                self.drawn[name] *= -1

    def obeying_relations(self) -> Values | None:
        """All numbers, with one quantity chosen for each relation so that it holds."""
        state = self.moving({})
        for relation in self.claim.relations:
            names = sorted(s.published for s in relation.symbols() if s.published in self.free)
            for name in names:
                chosen = self._root(partial(self._left, relation, name), name)
                if chosen is not None:
                    return self.moving({name: chosen})
            return None
        return state

    def _left(self, relation: Expr, name: str, value: float) -> float:
        return _numbers([relation], self.moving({name: value}))[0]

    def _root(self, function: Callable[[float], float], name: str) -> float | None:
        try:
            root = float(newton(function, self.drawn[name], maxiter=60))
        except (RuntimeError, ArithmeticError, ValueError, AssertionError):
            return None
        return root if root > 0 and abs(function(root)) < _CLOSE else None

    @property
    def free(self) -> list[str]:
        """Parameters first, then independent speeds."""
        equations = self.claim.equations
        return [s.published for s in (*equations.parameters, *equations.speeds)]

    def moving(self, chosen: Mapping[str, float]) -> Values:
        """All numbers, of a motion that the context is about."""
        state = {**self.drawn, **chosen}
        given = self.claim.given
        for _ in given:
            for symbol, value in given.items():
                state[symbol.published] = _numbers([value], state)[0]
        if self.context == "steady":
            state = self._steady(state)
        state |= self._rates(state)
        numbers = {self.symbols[n]: v for n, v in state.items() if n in self.symbols}
        wanted = {s: state[s.published] for s in self.claim.equations.acceleration_symbols}
        speeds = {*self.claim.equations.speeds, *self.claim.equations.coordinates}
        known = {
            s: v
            for s, v in numbers.items()
            if s in speeds or not s.kind.varies or s.base() in _prescribed(self.claim)
        }
        whole = constrained_motion(self.system, known, wanted)
        return {**state, **{s.published: v for s, v in whole.items()}}

    def _rates(self, state: Values) -> Values:
        """Accelerations and reactions: as drawn for an identity, of the motion otherwise."""
        if self.context == "identity":
            return {}
        found = dict(MOTIONS[self.system.name](state))
        return {n: v for n, v in found.items() if n in self.symbols}

    def _steady(self, state: Values) -> Values:
        rest, turning = _STEADY[self.system.name]
        speed = turning[self.seed % len(turning)]  # a relation between both has several branches

        def excess(rate: float) -> float:
            still = {**state, f"{rest}_dot": 0.0, speed: rate}
            return MOTIONS[self.system.name](still)[f"{rest}_ddot"]

        return {**state, f"{rest}_dot": 0.0, speed: float(newton(excess, state[speed]))}


def _prescribed(claim: BoundClaim) -> set[Symbol]:
    return {s.base() for s in claim.equations.functions}


def _symbols(claim: BoundClaim) -> set[Symbol]:
    equations = claim.equations
    sides = [
        s
        for b in range(len(claim.branches))
        for c in claim.components(b)
        for s in (c.left, c.right)
    ]
    expressions = [*sides, *claim.relations, *claim.positive, *claim.given.values()]
    found = {s for e in expressions for s in e.symbols()} | set(claim.given)
    found |= {*equations.coordinates, *equations.speeds, *equations.parameters}
    found |= set(equations.acceleration_symbols)
    found |= {Symbol(name, positive=True) for name in _ALSO.get(equations.system.name, ())}
    for function in equations.functions:
        for _ in range(4):
            found.add(function)
            function = function.derivative()
    return {s for s in found if s.published not in _NOT_SAID}


def _numbers(expressions: list[Expr] | tuple[Expr, ...], state: Values) -> list[float]:
    return [float(x) for x in evaluator(list(expressions))(state)] if expressions else []


def _met(claim: BoundClaim, state: Values) -> bool:
    """Whether at a state one of the branches is met, in every component."""
    every = [claim.components(branch) for branch in range(len(claim.branches))]
    return all(any(_equal(c, state) for c in alike) for alike in zip(*every, strict=True))


def _equal(component: ScalarRelation, state: Values) -> bool:
    left, right = _numbers([component.left, component.right], state)
    return bool(abs(left - right) <= _CLOSE * (1 + abs(left) + abs(right)))


def _solved(claim: BoundClaim) -> list[tuple[str, Expr]]:
    """Speeds that a claim on steady motion gives, with their values on every branch."""
    rest, _ = _STEADY[claim.equations.system.name]
    speeds = {s for s in claim.equations.speeds if s.published != f"{rest}_dot"}
    every = [c for b in range(len(claim.branches)) for c in claim.components(b)]
    return [
        (c.left.symbol.published, c.right)
        for c in every
        if c.left.symbol in speeds and c.left.symbol not in c.right.symbols()
    ]
