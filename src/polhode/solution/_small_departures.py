"""Small departures from steady motions: linear equations, thresholds, frequencies."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import prod

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, factors, pi, sqrt
from polhode.analyse import (
    Departures,
    Stability,
    SteadyMotion,
    Truth,
    departures,
    reduced,
    stability,
    steady,
)
from polhode.base import PolhodeError
from polhode.solution._judge import if_true
from polhode.solution._lines import SolutionLine, inline, listed
from polhode.solution._setting import LONGEST, WIDEST, Setting
from polhode.solution._steady_motions import fixed_words, given_of, holds, threshold_forms
from polhode.solution._turning_plane import turning_plane

#: Angles at which a motion may be simpler than elsewhere.
_SPECIAL = (pi / 2, ZERO, pi)
_EPSILON = Expr.generator(Symbol("epsilon", SymbolKind.COORDINATE))


def special_motions(setting: Setting) -> Iterator[SolutionLine]:
    """Steady motions at an upright or level attitude, their linear equations and thresholds."""
    try:
        essential = reduced(setting.equations).essential
        general = steady(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    if len(essential) == 1:
        (angle,) = essential
        for value in _SPECIAL:
            try:
                families = steady(setting.equations, {angle: value})
            except (PolhodeError, ZeroDivisionError):
                continue
            yield from if_true(_alternatives(general, families, angle, value), setting.equations)
            for family in families:
                yield from _special(setting, family, angle, value)
        for family in general:
            yield from _of_relation(family, angle)
        return
    for family in general:
        if not family.relations:
            yield from _special(setting, family, None, ZERO)
    yield from if_true(turning_plane(setting, essential), setting.equations)


def _alternatives(
    general: Sequence[SteadyMotion], families: Sequence[SteadyMotion], angle: Symbol, value: Expr
) -> Iterator[SolutionLine]:
    """What the condition for steady motion leaves at one attitude: a product that vanishes."""
    relations = [relation for family in general for relation in family.relations]
    zeros = {s for family in families for s, v in family.fixed.items() if s != angle and not v}
    zeros -= {s for family in general for s in family.fixed}
    if len(relations) != 1 or len(families) < 2:
        return
    _, powers = factors(relations[0].subs({angle: value}))
    varying = [f for f in powers if any(s.kind.varies for s in f.symbols())]
    if {f.symbol for f in varying} == zeros:
        place = f"{Expr.generator(angle).latex()} = {value.latex()}"
        yield SolutionLine(
            f"At ${place}$ the condition for steady motion becomes",
            f"{prod(varying, start=ONE).latex()} = 0",
            context="steady",
            given=(place,),
        )


def _special(
    setting: Setting, family: SteadyMotion, angle: Symbol | None, value: Expr
) -> Iterator[SolutionLine]:
    if family.relations:
        return
    try:
        judged = stability(family)
        names = {angle: _EPSILON} if angle is not None else {}
        found = departures(family, names=names)
    except (PolhodeError, ZeroDivisionError):
        return
    where = fixed_words(family)
    if not where:
        return
    idle = setting.idle_speeds
    arbitrary = [inline(s) for s in family.reduced.speeds if s not in {*family.fixed, *idle}]
    free = f" with any {listed(arbitrary)}" if arbitrary else ""
    moves = arbitrary or any(s.kind is SymbolKind.SPEED and v for s, v in family.fixed.items())
    state = "Steady motion" if moves else "Equilibrium"
    if angle is not None:
        small = "" if not value else f" - {value.latex()}"
        intro = (
            f"{state} is possible at {where}{free}. Let "
            f"$\\epsilon = {Expr.generator(angle).latex()}{small}$ be a small departure from it. "
            "To first order the equations of motion become"
        )
    else:
        intro = f"{state} is possible at {where}{free}. Close to it, to first order,"
    lines = list(_linear_lines(found, angle, value, intro))
    yield from lines
    if not lines:
        yield SolutionLine(f"{state} is possible at {where}{free}.")
    swing = tuple(_swing(judged.frequencies, lines)) if angle is not None else ()
    swing = tuple(if_true(swing, family.reduced.equations))
    draws = "$\\epsilon$ is drawn back, and " if any(x.key == "oscillator" for x in lines) else ""
    yield from _threshold(family, judged, draws, swing)


def _of_relation(family: SteadyMotion, angle: Symbol) -> Iterator[SolutionLine]:
    """Whether the equilibria that a relation gives are stable, by its help in few letters."""
    if len(family.relations) != 1 or family.reduced.speeds != (angle.derivative(),):
        return
    (relation,) = family.relations
    try:
        judged = stability(family)
    except (PolhodeError, ZeroDivisionError):
        return
    if judged.truth is Truth.OPEN or len(judged.frequencies) > 1:
        return
    where = f"The equilibrium where ${relation.latex()} = 0$"
    if judged.truth is Truth.NEVER:
        yield SolutionLine(f"{where} is unstable: small departures grow.")
        return
    squares = [rate**2 for rate in judged.frequencies]
    for symbol in relation.symbols() if squares else ():
        slope = relation.diff(symbol)
        if slope and symbol != angle and symbol not in slope.symbols():
            value = Expr.generator(symbol) - relation / slope
            squares.append(squares[0].subs({symbol: value}))
    rates = [sqrt(square) for square in squares]
    shortest = min(rates, key=lambda rate: len(rate.latex()), default=None)
    how = "" if shortest is None else f", but oscillate at the angular frequency {inline(shortest)}"
    yield SolutionLine(f"{where} is stable: small departures do not grow{how}.")


def _swing(frequencies: tuple[Expr, ...], lines: list[SolutionLine]) -> Iterator[SolutionLine]:
    """That ε oscillates at the only frequency, where nothing else varies with it."""
    first = next((line for line in lines if line.let), None)
    if len(frequencies) == 1 and first is not None:
        (rate,) = frequencies
        text = rf"\ddot{{\epsilon}} \approx {(-(rate**2) * _EPSILON).latex()}"
        yield SolutionLine("", text, context="limit", let=first.let, small=first.small)


def _linear_lines(
    found: Departures, angle: Symbol | None, value: Expr, intro: str
) -> Iterator[SolutionLine]:
    """The linear equations in ε and in the speeds that vanish on the family."""
    family = found.family
    images, speeds = dict[Symbol, Expr](), list[Symbol]()
    for symbol, departure in found.names.items():
        if angle is not None and symbol.base() == angle:
            continue
        own = departure.symbol
        if own is None:
            return
        if symbol in family.fixed and not family.fixed[symbol]:
            speeds.append(symbol)
            images[own] = Expr.generator(symbol)
        images[own.derivative()] = Expr.generator(symbol.derivative())
    rows = [row.subs(images) for row in found.equations]
    hidden = {s for row in rows for s in row.symbols() if s.name.startswith("delta_")}
    if hidden or not rows:
        return
    let = () if angle is None else (f"epsilon = {angle.published} - ({value})",)
    small = (*(["epsilon:1"] if let else []), *(f"{speed.published}:1" for speed in speeds))
    if not small or any(len(row.latex()) > WIDEST for row in rows):
        return
    exact = family.reduced.equations.motion
    rows = [row for row in rows if not (row in exact and _is_linear(row))]
    for i, row in enumerate(rows):
        yield SolutionLine(
            intro if i == 0 else "",
            rf"{row.latex()} \approx 0",
            _key(i, let, small),
            "limit",
            let=let,
            small=small,
        )
    following = _first_order(rows, speeds, small)
    if let:
        following = _oscillator(found, rows, images, let, small)
    yield from if_true(following, family.reduced.equations)


def _key(row: int, let: Sequence[str], small: Sequence[str]) -> str:
    """The key of a linear equation, by what is small in it."""
    return re.sub(r"\W+", "_", "_".join(("linear", str(row), *let, *small)))


def _is_linear(row: Expr) -> bool:
    """Whether every term contains one varying quantity at most."""
    varying = (
        sum(p for g, p in powers.items() if any(s.kind.varies for s in g.symbols()))
        for powers, _ in row.terms()
    )
    return all(count <= 1 for count in varying)


def _oscillator(
    found: Departures,
    rows: list[Expr],
    images: dict[Symbol, Expr],
    let: tuple[str, ...],
    small: tuple[str, ...],
) -> Iterator[SolutionLine]:
    """ε̈ by ε; a small speed in its equation is given by one that is a derivative."""
    bend, epsilon = _EPSILON.dt().dt(), _EPSILON.symbol
    target = next((row for row in rows if bend.symbol in row.symbols()), None)
    if target is None or bend.symbol is None or epsilon is None:
        return
    speeds = [s for s in target.symbols() if f"{s.published}:1" in small and s.base() != epsilon]
    integrals = [i.subs(images) for i in found.integrals]
    fixed = [
        c
        for c in integrals
        for s in speeds
        if c.diff(s) and _EPSILON.dt().symbol not in c.symbols()
    ]
    if len(speeds) > 1 or len(fixed) != len(speeds):
        return
    words = "so that"
    given: tuple[str, ...] = ()
    for speed, constant in zip(speeds, fixed, strict=True):
        letter = Expr.generator(speed)
        value = letter - constant / constant.diff(speed)
        start = f"{inline(speed)} stays constant, and"
        if epsilon in value.symbols():
            start = "A constant of integration"
            place = next(i for i, row in enumerate(rows) if speed.derivative() in row.symbols())
            others = constant.symbols() - {speed, epsilon}
            steady_ones = [inline(s) for s in others if s.kind.varies]
            constants = f", with {listed(steady_ones)} constant" if steady_ones else ""
            yield SolutionLine(
                f"Equation [[{_key(place, let, small)}]] can be integrated{constants}:",
                rf"\frac{{d}}{{dt}}\left({constant.latex()}\right) \approx 0",
                "steering",
                "limit",
                let=let,
                small=small,
            )
        words = (
            f"{start} would only shift the origin of $\\epsilon$, to a neighbouring steady motion; "
            f"we take it as zero. Then ${letter.latex()} = {value.latex()}$, and"
        )
        target, given = target.subs({speed: value}), (f"{speed.published} = {value!s}",)
    inertia = target.diff(bend.symbol)
    rate = bend - target / inertia
    slope = rate.diff(epsilon)
    if not slope or rate != slope * _EPSILON or (inertia == ONE and not speeds):
        return
    yield SolutionLine(
        words,
        rf"{bend.latex()} \approx {rate.latex()}",
        "oscillator",
        "limit",
        let=let,
        small=small,
        given=given,
    )


def _first_order(
    rows: list[Expr], speeds: list[Symbol], small: tuple[str, ...]
) -> Iterator[SolutionLine]:
    """What follows where rates of small speeds are given by one of them each."""
    rates = dict[Symbol, Expr]()
    for row in rows:
        for speed in (s for s in speeds if s.kind is SymbolKind.SPEED):
            if inertia := row.diff(speed.derivative()):
                rates[speed] = Expr.generator(speed.derivative()) - row / inertia
    for speed, rate in rates.items():
        others = [s for s in speeds if s in rate.symbols()]
        if len(others) != 1:
            continue
        (other,) = others
        if other == speed:
            text = rf"{Expr.generator(speed.derivative()).latex()} \approx {rate.latex()}"
            yield SolutionLine("so that", text, context="limit", small=small)
        elif set(speeds) & rates.get(other, ZERO).symbols() == {speed}:
            bend = Expr.generator(speed.derivative().derivative())
            text = rf"{bend.latex()} \approx {(rate.diff(other) * rates[other]).latex()}"
            words = (
                f"Differentiate the equation for ${Expr.generator(speed.derivative()).latex()}$ "
                f"and put in that for ${Expr.generator(other.derivative()).latex()}$:"
            )
            yield SolutionLine(words, text, context="limit", small=small)
            return


def _threshold(
    family: SteadyMotion, judged: Stability, draws: str, swing: tuple[SolutionLine, ...]
) -> Iterator[SolutionLine]:
    truth, frequencies = judged.truth, judged.frequencies
    if truth is Truth.NEVER:
        yield SolutionLine("Small departures grow: this motion is unstable.")
        return
    if truth is Truth.ALWAYS:
        rates = [f for f in frequencies if len(f.latex()) <= LONGEST]
        how = f", but oscillate at the angular frequency {inline(rates[0])}" if rates else ""
        words = f"Small departures do not grow{how if len(frequencies) == 1 else ''}."
        yield SolutionLine(words, stated=swing)
        return
    given = given_of(family)
    for condition in judged.conditions:  # one of several may imply the others
        for form in threshold_forms(condition.expression, family):
            if len(form.latex) > LONGEST or not holds(form.latex, "threshold", given, family):
                continue
            sign = "" if form.speed is None else f", with {inline(form.speed)} counted positive,"
            stay = f"{draws}small departures stay small if{sign}"
            words = stay if draws else f"S{stay[1:]}"
            values = () if form.bound is None else ((form.bound.latex(), form.bound),)
            yield SolutionLine(
                words, form.latex, "threshold", "threshold", given=given, values=values
            )
            return
    yield SolutionLine("The conditions of stability have no short form; steady prints them.")
