"""The motion from its first integrals: what is conserved, and the quadrature that is left."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    linear_parts,
    solve,
    taylor,
)
from polhode.analyse import Invariant, invariants, reduced
from polhode.base import ConstraintError, NumericError
from polhode.derive import Equations
from polhode.solution._judge import if_true
from polhode.solution._letters import free_letter, letter_latex
from polhode.solution._lines import SolutionLine, inline, joined, letter_of, listed
from polhode.solution._setting import LONGEST, WIDEST, Setting, dependent_coordinates
from polhode.solution._squares import sum_of_squares

_FEW = 2
_PHRASE = re.compile(r"about (.+) along (\w+)$")
_DIRECTION = re.compile(r"\b(along|axis) (\w+)$")


def by_integrals(setting: Setting) -> Iterator[SolutionLine]:
    """The first integrals, and the rate of the one coordinate that is left.

    Raises `ConstraintError` where fewer than two integrals are known, of several speeds.
    """
    found = [i for i in moving_integrals(setting.equations) if len(i.expression.latex()) <= LONGEST]
    found = _one_for_one_speed(setting, found)
    if len(found) < min(_FEW, len(setting.equations.speeds)):
        raise ConstraintError(
            f"the route integrals for {setting.equations.system.name!r}",
            expected="at least two first integrals, or one of a single speed",
            advice="take another route, or none: the shortest is then found",
        )
    yield from conserved(setting, found)
    yield from _quadrature(setting, found)


def conserved_quantities(setting: Setting) -> Iterator[SolutionLine]:
    """The first integrals that are short enough to be printed, for the end of a solution."""
    try:
        found = moving_integrals(setting.equations)
    except NumericError:
        return
    plain = [i for i in found if len(i.expression.latex()) <= WIDEST and not i.expression.symbol]
    yield from conserved(setting, _one_for_one_speed(setting, plain))


def _one_for_one_speed(setting: Setting, found: list[Invariant]) -> list[Invariant]:
    """Of several first integrals of a single speed one says it all."""
    if len(setting.equations.speeds) > 1 or len(found) < _FEW:
        return found
    return [one for one in found if not one.meaning.startswith("found")] or found[:1]


def moving_integrals(equations: Equations) -> tuple[Invariant, ...]:
    """The first integrals that contain speeds, without coordinates that others determine."""
    images = dependent_coordinates(equations)
    moved = [replace(one, expression=one.expression.subs(images)) for one in invariants(equations)]
    return tuple({one.expression: one for one in moved if _moves(one)}.values())


def _moves(one: Invariant) -> bool:
    """Whether it contains speeds: without them it is a condition on the coordinates."""
    return any(s.order or s.kind is SymbolKind.SPEED for s in one.expression.symbols())


def conserved(setting: Setting, found: list[Invariant]) -> Iterator[SolutionLine]:
    """Every first integral: claims that its rate vanishes, and that it is what it is called."""
    for i, one in enumerate(found):
        value = one.expression
        text = rf"\frac{{d}}{{dt}}\left({value.latex()}\right) = 0"
        if value.symbol is not None:
            text = f"{value.dt().latex()} = 0"
        start = "Constant along the motion is" if i == 0 else "so is"
        start = "and so is" if i and one is found[-1] else start
        called = tuple(_named(setting, one))
        words = f"{start} {_meaning(setting, one)},"
        yield SolutionLine(words, text, f"integral_{i + 1}", stated=called)


def _named(setting: Setting, one: Invariant) -> Iterator[SolutionLine]:
    """That an expression is the quantity after which it is called."""
    phrase = (
        one.meaning
        if one.meaning == "energy"
        else _PHRASE.sub(r"about \1 along axis \2", one.meaning)
    )
    if phrase == one.meaning != "energy":
        return
    for body in setting.equations.system.bodies if setting.is_single else ():
        own = f"angular momentum of {body.name} about its centre of mass along axis"
        phrase = phrase.replace(own, "angular momentum about cm along axis")
    letter = letter_latex(free_letter(setting.equations, "Q", "J", "C_0"))
    claim = SolutionLine("", f"{letter} = {one.expression.latex()}", bindings={letter: phrase})
    yield from if_true([claim], setting.equations)


def _meaning(setting: Setting, one: Invariant) -> str:
    if one.meaning.startswith("the speed"):
        return f"the speed {inline(one.expression)}"
    words = {"Jellett's": one.meaning, "found": "the combination in brackets"}
    meaning = words.get(one.meaning.split()[0].rstrip(":"), f"the {one.meaning}")
    for body in setting.equations.system.bodies:
        meaning = meaning.replace(f" of {body.name} ", f" of the {body.name} ")
    for element in setting.equations.system.elements:
        if element in setting.contacts and len(setting.contacts) == 1:
            meaning = meaning.replace(f"contact at {element.name}", "contact")
        elif setting.is_fixed(element):
            meaning = meaning.replace(f"about {element.name} along", "about the fixed point along")
        elif f"about {element.name} along" in meaning:
            at = f"about the point of the support “{element.name}” along"
            meaning = meaning.replace(f"about {element.name} along", at)
    return _DIRECTION.sub(lambda found: f"{found[1]} ${letter_of(found[2])}$", meaning)


def _quadrature(setting: Setting, found: list[Invariant]) -> Iterator[SolutionLine]:
    system = reduced(setting.equations)
    angles = [q for q in system.essential if setting.equations.kinematics.get(q.derivative())]
    energy = next((i for i in found if i.name == "E"), None)
    if energy is None or len(angles) != 1:
        return
    (angle,) = angles
    rate = angle.derivative()
    others = [i for i in found if i is not energy and rate not in i.expression.symbols()]
    solved = _speeds(setting, angle, others)
    if solved is None:
        return
    values, letters = solved
    expression = energy.expression.subs(values)
    if rate not in expression.symbols() or expression - taylor(expression, rate, 2):
        return
    inertia = expression.diff(rate).diff(rate)
    rest = expression.subs({rate: ZERO})
    if {s for s in rest.symbols() if s.kind is SymbolKind.SPEED}:
        return
    kinetic = (inertia * Expr.generator(rate) ** 2 / 2).latex()
    alone = rest.subs(dict.fromkeys(letters, ZERO))
    terms = [kinetic, sum_of_squares(rest - alone, list(letters)), alone.latex()]
    text = f"E = {joined([t for t in terms if t != '0'])}"
    if len(text) > LONGEST:
        return
    if letters:
        named = listed(f"${Expr.generator(s).latex()}$" for s in letters)
        meanings = listed(
            f"${Expr.generator(letter).latex()} = {value.latex()}$"
            for letter, value in letters.items()
        )
        left = (
            f"With {meanings} the speeds other than {inline(rate)} follow from {named}. Put into "
            "the energy they leave an equation of one dimension. Solved"
        )
    else:
        left = "The energy is an equation for the only speed. Solved"
    yield SolutionLine(
        f"{left} for {inline(rate)}, it gives the time as an integral over {inline(angle)}:",
        text,
        "quadrature",
        let=tuple(f"{letter.published} = {value}" for letter, value in letters.items()),
    )


def _speeds(
    setting: Setting, angle: Symbol, others: list[Invariant]
) -> tuple[Mapping[Symbol, Expr], dict[Symbol, Expr]] | None:
    """The speeds other than the rate of the angle in terms of constants, and these constants."""
    wanted = [s for s in setting.equations.speeds if s != angle.derivative()]
    linear: list[tuple[tuple[Expr, ...], Expr]] = []
    for one in others:
        try:
            parts, rest = linear_parts(one.expression, wanted)
        except NumericError:
            continue
        if not rest and not any(s.kind.varies and s != angle for p in parts for s in p.symbols()):
            linear.append((parts, one.expression))
    if len(linear) != len(wanted):
        return None
    letters = {Symbol(f"C_{i + 1}"): value for i, (_, value) in enumerate(linear)}
    right = [Expr.generator(letter) for letter in letters]
    try:
        values = solve([parts for parts, _ in linear], right)
    except (NumericError, ZeroDivisionError):
        return None
    return dict(zip(wanted, values, strict=True)), letters
