"""Small departures from steady motions: linear equations, thresholds, frequencies."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, pi, sqrt
from polhode.analyse import (
    Condition,
    Departures,
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
            for family in families:
                yield from _special(setting, family, angle, value)
        for family in general:
            yield from _of_relation(family, angle)
        return
    for family in general:
        if not family.relations:
            yield from _special(setting, family, None, ZERO)
    yield from if_true(turning_plane(setting, essential), setting.equations)


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
    yield from _threshold(family, judged.conditions, judged.truth, judged.frequencies, swing)


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
    images = dict[Symbol, Expr]()
    small = list[str]()
    for symbol, departure in found.names.items():
        if angle is not None and symbol.base() == angle:
            continue
        vanishing = symbol in family.fixed and not family.fixed[symbol]
        own = departure.symbol
        if own is None:
            return
        if vanishing:
            small.append(symbol.published)
            images[own] = Expr.generator(symbol)
        images[own.derivative()] = Expr.generator(symbol.derivative())
    rows = [row.subs(images) for row in found.equations]
    hidden = {s for row in rows for s in row.symbols() if s.name.startswith("delta_")}
    if hidden or not rows:
        return
    let: tuple[str, ...] = ()
    given_small = [f"{name}:1" for name in small if angle is None or name != f"{angle.name}_dot"]
    if angle is not None:
        let = (f"epsilon = {angle.published} - ({value})",)
        given_small.insert(0, "epsilon:1")
    if not given_small or any(len(row.latex()) > WIDEST for row in rows):
        return
    exact = family.reduced.equations.motion
    rows = [row for row in rows if not (row in exact and _is_linear(row))]
    for i, row in enumerate(rows):
        yield SolutionLine(
            intro if i == 0 else "",
            rf"{row.latex()} \approx 0",
            f"linear_{i + 1}",
            "limit",
            let=let,
            small=tuple(given_small),
        )
    if angle is not None:
        equations = family.reduced.equations
        yield from if_true(_oscillator(rows, let, tuple(given_small)), equations)
        together = _put_together(found, rows, images, let, tuple(given_small))
        yield from if_true(together, equations)


def _oscillator(
    rows: list[Expr], let: tuple[str, ...], small: tuple[str, ...]
) -> Iterator[SolutionLine]:
    """ε̈ in terms of ε alone, where nothing else varies with it."""
    bend = _EPSILON.dt().dt().symbol
    target = next((row for row in rows if bend in row.symbols()), None)
    if target is None or bend is None:
        return
    inertia = target.diff(bend)
    value = -(target - inertia * Expr.generator(bend)) / inertia
    slope = value.diff(_EPSILON.symbol) if _EPSILON.symbol is not None else ZERO
    if not slope or inertia == ONE or value != slope * _EPSILON:
        return
    if any(f"{s.published}:1" in small for s in slope.symbols()):
        return
    yield SolutionLine(
        "so that",
        rf"{Expr.generator(bend).latex()} \approx {value.latex()}",
        "oscillator",
        "limit",
        let=let,
        small=small,
    )


def _is_linear(row: Expr) -> bool:
    """Whether every term contains one varying quantity at most."""
    varying = (
        sum(p for g, p in powers.items() if any(s.kind.varies for s in g.symbols()))
        for powers, _ in row.terms()
    )
    return all(count <= 1 for count in varying)


def _put_together(
    found: Departures,
    rows: list[Expr],
    images: dict[Symbol, Expr],
    let: tuple[str, ...],
    small: tuple[str, ...],
) -> Iterator[SolutionLine]:
    """A row that is a derivative gives a speed in terms of ε, which is put into that of ε̈."""
    bend = _EPSILON.dt().dt()
    steering = [i.subs(images) for i in found.integrals if _EPSILON.symbol in i.symbols()]
    target = next((row for row in rows if bend.symbol in row.symbols()), None)
    if len(steering) != 1 or target is None or bend.symbol is None:
        return
    (constant,) = steering
    both = constant.symbols() & target.symbols()
    speeds = [s for s in both if s.order and f"{s.published}:1" in small]
    if len(speeds) != 1:
        return
    (speed,) = speeds
    slope = constant.diff(speed)
    value = -(constant - slope * Expr.generator(speed)) / slope
    row = target.subs({speed: value})
    rate = -(row - row.diff(bend.symbol) * bend) / row.diff(bend.symbol)
    shown = value / _EPSILON
    whole = constant / slope
    yield SolutionLine(
        "The first of these equations can be integrated:",
        rf"\frac{{d}}{{dt}}\left({whole.latex()}\right) \approx 0",
        "steering",
        "limit",
        let=let,
        small=small,
    )
    yield SolutionLine(
        "A constant of integration would only shift the origin of $\\epsilon$, to a neighbouring "
        "steady motion; we take it as zero. Then "
        f"${Expr.generator(speed).latex()} = {_times_epsilon(shown)}$, which put into the other "
        "equation gives",
        rf"{bend.latex()} \approx {_times_epsilon(rate / _EPSILON)}",
        "oscillator",
        "limit",
        let=let,
        small=small,
        given=(f"{speed.published} = {value!s}",),
    )


def _times_epsilon(coefficient: Expr) -> str:
    return (coefficient * _EPSILON).latex()


def _threshold(
    family: SteadyMotion,
    conditions: tuple[Condition, ...],
    truth: Truth,
    frequencies: tuple[Expr, ...],
    swing: tuple[SolutionLine, ...] = (),
) -> Iterator[SolutionLine]:
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
    for condition in conditions:  # one of several may imply the others
        for form in threshold_forms(condition.expression, family):
            if len(form.latex) > LONGEST or not holds(form.latex, "threshold", given, family):
                continue
            sign = "" if form.speed is None else f", with {inline(form.speed)} counted positive,"
            words = f"Small departures stay small if{sign}"
            values = () if form.bound is None else ((form.bound.latex(), form.bound),)
            yield SolutionLine(
                words, form.latex, "threshold", "threshold", given=given, values=values
            )
            return
    yield SolutionLine("The conditions of stability have no short form; steady prints them.")
