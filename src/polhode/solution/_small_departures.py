"""Small departures from steady motions: linear equations, thresholds, frequencies."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
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
from polhode.derive import Equations
from polhode.solution._judge import if_true
from polhode.solution._letters import free_letter
from polhode.solution._lines import (
    SolutionLine,
    bracketed,
    fraction,
    inline,
    listed,
    negative_multiple,
    root_latex,
)
from polhode.solution._normal_modes import Oscillations, by_potential, normal_modes
from polhode.solution._setting import LONGEST, WIDEST, Setting
from polhode.solution._steady_motions import explicit, fixed_words, given_of, holds, threshold_forms
from polhode.solution._turning_plane import turning_plane

#: Angles at which a motion may be simpler than elsewhere.
_SPECIAL = (ZERO, pi, pi / 2)
_EPSILON = Expr.generator(Symbol("epsilon", SymbolKind.COORDINATE))
#: Terms of a frequency or condition that is printed within words.
_TERMS = 16
#: Key of the line that says so.
_UNSTABLE = "unstable"


def special_motions(setting: Setting) -> Iterator[SolutionLine]:
    """Steady motions at an upright or level attitude, their linear equations and thresholds."""
    try:
        essential = reduced(setting.equations).essential
        general = steady(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    if len(essential) == 1:
        (angle,) = essential
        told = dict[tuple[str, ...], str]()
        for value in _SPECIAL:
            try:
                families = steady(setting.equations, {angle: value})
            except (PolhodeError, ZeroDivisionError):
                continue
            yield from if_true(_alternatives(general, families, angle, value), setting.equations)
            special = [(f, tuple(_special(setting, f, angle, value))) for f in families]
            yield from _without_repetition(special, told)
        for family in general:
            yield from _of_relation(family, angle)
        return
    shown = [(family, tuple(_special(setting, family, None, ZERO))) for family in general]
    unstable = [f for f, lines in shown if lines and lines[-1].key == _UNSTABLE]
    apart = len(unstable) > 1
    yield from _without_repetition([p for p in shown if not (apart and p[0] in unstable)], {})
    if apart:
        places = "; at ".join(fixed_words(explicit(family)) for family in unstable)
        yield SolutionLine(f"Small departures grow, and the state is unstable, at {places}.")
    yield from if_true(turning_plane(setting, essential), setting.equations)


def close_to_rest(setting: Setting) -> Iterator[SolutionLine]:
    """Small departures from the equilibrium where all coordinates are zero, if it is one."""
    try:
        system = reduced(setting.equations)
        rest = SteadyMotion(system, dict.fromkeys(system.state, ZERO), ())
        forces = [row.subs(rest.fixed) for row in setting.equations.forcing]
    except (PolhodeError, ZeroDivisionError):
        return
    if not any(forces) and len(system.essential) == len(system.speeds) > 1:
        yield from _special(setting, rest, None, ZERO)


def _without_repetition(
    found: Sequence[tuple[SteadyMotion, tuple[SolutionLine, ...]]],
    told: dict[tuple[str, ...], str],
) -> Iterator[SolutionLine]:
    """The lines about each family; where they say what was told of another, only that they do."""
    for family, lines in found:
        formulas = (*(line.latex for line in lines), *(line.words for line in lines[1:]))
        where = fixed_words(explicit(family))
        if not any(line.latex for line in lines) or formulas not in told:
            told[formulas] = where
            yield from lines
            continue
        claims = [replace(line, words="", key="") for line in lines if line.latex]
        claims += [claim for line in lines for claim in line.stated]
        departure = lines[0].words.partition("Let ")[2].partition(" be ")[0]
        yield SolutionLine(
            f"Close to {where}, with {departure}, the same formulas hold as at {told[formulas]}.",
            stated=tuple(claims),
        )


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
    varying = [f for f in powers if f.varies]
    if {f.symbol for f in varying} == zeros:
        place = f"{Expr.generator(angle).latex()} = {value.latex()}"
        yield SolutionLine(
            f"At ${place}$ the condition for steady motion becomes",
            f"{prod(varying, start=ONE).latex()} = 0",
            context="steady",
            given=(place,),
        )


def _special(
    setting: Setting, found: SteadyMotion, angle: Symbol | None, value: Expr
) -> Iterator[SolutionLine]:
    family = explicit(found)
    where = fixed_words(family)
    if family.relations or not where:
        return
    letters = {angle: _EPSILON} if angle is not None else _letters(family)
    try:
        judged = stability(family)
        linear = departures(family, names=letters)
        truth = judged.truth if judged.truth is not Truth.OPEN else by_potential(family)
    except (PolhodeError, ZeroDivisionError):
        return
    idle = setting.idle_speeds
    arbitrary = [inline(s) for s in family.reduced.speeds if s not in {*family.fixed, *idle}]
    free = f" with any {listed(arbitrary)}" if arbitrary else ""
    possible = f"{_kind(family, bool(arbitrary)).capitalize()} is possible at {where}{free}."
    intro = f"{possible[:-1]}. Close to it, to first order,"
    if letters:
        defined = [
            f"${letter.latex()} = {_less(q, family.fixed.get(q, value))}$"
            for q, letter in letters.items()
        ]
        small = "be a small departure" if len(defined) == 1 else "be small departures"
        intro = (
            f"{possible} Let {listed(defined)} {small} from it. "
            "To first order the equations of motion become"
        )
    equations = _first_order(linear, letters)
    lines = [] if equations is None else list(_linear_lines(equations, truth, intro))
    yield from lines or [SolutionLine(possible)]
    swing = tuple(_swing(judged.frequencies, lines)) if angle is not None else ()
    swing = tuple(if_true(swing, family.reduced.equations))
    draws = "$\\epsilon$ is drawn back, and " if any(x.key == "oscillator" for x in lines) else ""
    if truth is Truth.NEVER:
        kind = _kind(family, bool(arbitrary))
        yield SolutionLine(f"Small departures grow: this {kind} is unstable.", key=_UNSTABLE)
        return
    modes: tuple[SolutionLine, ...] = ()
    if equations is not None and not equations.rates and angle is None:
        rows, letters_of_all = equations.rows, tuple(equations.letters.values())
        about = Oscillations(found, judged, rows, letters_of_all, equations.let)
        modes = tuple(normal_modes(about))
    if truth is Truth.ALWAYS and not modes and (rates := _two_rates(judged.frequencies)):
        yield SolutionLine(
            f"Small departures do not grow, but oscillate at the angular frequencies {rates}."
        )
        return
    yield from _threshold(family, judged, truth, draws, swing)
    yield from modes


def _two_rates(frequencies: Sequence[Expr]) -> str:
    """Two angular frequencies in words, without roots within roots where that is possible."""
    if len(frequencies) != 2:
        return ""
    first, second = frequencies
    squares, product = first**2 + second**2, sqrt(first**2 * second**2)
    half_sum, half_gap = sqrt(squares + 2 * product) / 2, sqrt(squares - 2 * product) / 2
    texts = [root_latex(first**2), root_latex(second**2)]
    if {(half_sum - half_gap) ** 2, (half_sum + half_gap) ** 2} == {first**2, second**2}:
        apart = [(half_sum - half_gap).latex(), (half_sum + half_gap).latex()]
        texts = min(texts, apart, key=lambda pair: sum(map(len, pair)))
    return listed(f"${text}$" for text in texts) if max(map(len, texts)) <= WIDEST / 2 else ""


def _kind(family: SteadyMotion, moves: bool) -> str:
    """What a family is called, which moves in any case, or at the speeds that are fixed."""
    fixed = any(s.kind is SymbolKind.SPEED and value for s, value in family.fixed.items())
    return "steady motion" if moves or fixed else "equilibrium"


def _less(q: Symbol, value: Expr) -> str:
    """A coordinate less its value."""
    name, text = Expr.generator(q).latex(), value.latex()
    if not value:
        return name
    return f"{name} + {(-value).latex()}" if text.startswith("-") else f"{name} - {bracketed(text)}"


def _letters(family: SteadyMotion) -> dict[Symbol, Expr]:
    """Letters for departures of coordinates whose value on the family is not zero."""
    names = ["epsilon", "eta", "zeta", "xi"]
    found = dict[Symbol, Expr]()
    for q in family.reduced.essential:
        if family.fixed.get(q) and names:
            letter = free_letter(family.reduced.equations, *names)
            names = names[names.index(letter.name) + 1 :]
            found[q] = Expr.generator(Symbol(letter.name, SymbolKind.COORDINATE))
    return found


def _of_relation(family: SteadyMotion, angle: Symbol) -> Iterator[SolutionLine]:
    """Whether the equilibria that a relation gives are stable, by its help in few letters."""
    if len(family.relations) != 1 or family.fixed.keys() - {angle.derivative()}:
        return
    (relation,) = family.relations
    try:
        judged = stability(family)
    except (PolhodeError, ZeroDivisionError):
        return
    if len(judged.frequencies) > 1:
        return
    state = "equilibrium" if family.reduced.speeds == (angle.derivative(),) else "steady motion"
    where = f"The {state} where ${relation.latex()} = 0$"
    if judged.truth is Truth.NEVER:
        yield SolutionLine(f"{where} is unstable: small departures grow.")
        return
    if not all(map(_is_short, (condition.expression for condition in judged.conditions))):
        return
    squares = [one for rate in judged.frequencies for one in _by_relation(rate**2, relation, angle)]
    rates = [text for text in map(root_latex, squares) if len(text) <= WIDEST / 2]
    oscillate = f"oscillate at the angular frequency ${min(rates, key=len)}$" if rates else ""
    if judged.truth is Truth.ALWAYS:
        how = f", but {oscillate}" if rates else ""
        yield SolutionLine(f"{where} is stable: small departures do not grow{how}.")
        return
    given = given_of(family)
    stays = f"; small departures then {oscillate}" if rates else ""
    for condition in judged.conditions if len(judged.conditions) == 1 else ():
        forms = _by_relation(condition.expression, relation, angle)
        for text in sorted((f"{fraction(form)} > 0" for form in forms), key=len):
            if len(text) <= LONGEST and holds(text, "threshold", given, family):
                words = f"{where} is stable if the following holds{stays}:"
                yield SolutionLine(words, text, "threshold", "threshold", given=given)
                return


def _by_relation(value: Expr, relation: Expr, angle: Symbol) -> Iterator[Expr]:
    """An expression as it is, and with one letter put in that a relation gives; short ones."""
    if not _is_short(value):
        return
    yield value
    for symbol in relation.symbols() & value.symbols() - {angle}:
        slope = relation.diff(symbol)
        if slope and symbol not in slope.symbols():
            with suppress(PolhodeError, ZeroDivisionError):
                other = value.subs({symbol: Expr.generator(symbol) - relation / slope})
                if _is_short(other):
                    yield other


def _is_short(value: Expr) -> bool:
    """Whether an expression is worth printing, by its terms."""
    return sum(1 for part in (value.numerator, value.denominator) for _ in part.terms()) <= _TERMS


def _swing(frequencies: tuple[Expr, ...], lines: list[SolutionLine]) -> Iterator[SolutionLine]:
    """That ε oscillates at the only frequency, where nothing else varies with it."""
    first = next((line for line in lines if line.let), None)
    if len(frequencies) == 1 and first is not None:
        (rate,) = frequencies
        text = rf"\ddot{{\epsilon}} \approx {negative_multiple(rate**2, _EPSILON)}"
        yield SolutionLine("", text, context="limit", let=first.let, small=first.small)


@dataclass(frozen=True)
class _FirstOrder:
    """The linear equations about a family, in the letters in which they are displayed.

    Attributes:
        found: the departures.
        rows: expressions that vanish to first order.
        letters: the departure of every coordinate.
        let: definitions of those letters that are no coordinates.
        rates: small speeds that are not the rates of these letters.
        images: what the letters of `found` are replaced by.
    """

    found: Departures
    rows: tuple[Expr, ...]
    letters: dict[Symbol, Expr]
    let: tuple[str, ...]
    rates: tuple[Symbol, ...]
    images: dict[Symbol, Expr]

    @property
    def small(self) -> tuple[str, ...]:
        """What is small in claims about them."""
        return tuple(f"{s.published}:1" for s in (*self._quantities, *self.rates))

    @property
    def _quantities(self) -> Iterator[Symbol]:
        return (letter.symbol for letter in self.letters.values() if letter.symbol)

    @property
    def equations(self) -> Equations:
        """Of the system."""
        return self.found.family.reduced.equations


def _first_order(found: Departures, chosen: Mapping[Symbol, Expr]) -> _FirstOrder | None:
    """The linear equations in the chosen letters; None where something else departs too."""
    family = found.family
    system = family.reduced
    images, rates = dict[Symbol, Expr](), list[Symbol]()
    letters = dict[Symbol, Expr]()
    for q in system.essential:
        own = found.names[q].symbol
        if own is None or not (q in chosen or family.fixed.get(q) == ZERO):
            return None
        letters[q] = chosen.get(q, Expr.generator(q))
        images[own] = letters[q]
        images[own.derivative()] = letters[q].dt()
        images[own.derivative().derivative()] = letters[q].dt().dt()
    same = {system.equations.kinematics[q.derivative()].symbol: q for q in letters}
    for speed in system.speeds:
        shift = found.names[speed].symbol
        if shift is None or speed.base() in letters:
            continue
        if speed in same:
            rate = letters[same[speed]].dt()
            images[shift], images[shift.derivative()] = rate, rate.dt()
            continue
        if family.fixed.get(speed) == ZERO:
            rates.append(speed)
            images[shift] = Expr.generator(speed)
        images[shift.derivative()] = Expr.generator(speed.derivative())
    rows = [row for row in (one.subs(images) for one in found.equations) if row]
    if any(s.name.startswith("delta_") for row in rows for s in row.symbols()):
        return None
    exact = system.equations.motion
    rows = [row for row in rows if not (row in exact and _is_linear(row))]
    let = tuple(f"{letter} = {q.published} - ({family.fixed[q]})" for q, letter in chosen.items())
    return _FirstOrder(found, tuple(rows), letters, let, tuple(rates), images)


def _linear_lines(linear: _FirstOrder, truth: Truth, intro: str) -> Iterator[SolutionLine]:
    """The linear equations, and what follows from them for one departure."""
    let, small, rows = linear.let, linear.small, linear.rows
    if not small or any(len(row.latex()) > WIDEST for row in rows):
        return
    for i, row in enumerate(rows):
        yield SolutionLine(
            intro if i == 0 else "",
            rf"{row.latex()} \approx 0",
            _key(i, let, small),
            "limit",
            let=let,
            small=small,
        )
    if len(linear.letters) == 1 and _EPSILON in linear.letters.values():
        following = _oscillator(linear, truth)
    else:
        following = _by_differentiation(linear)
    yield from if_true(following, linear.equations)


def _key(row: int, let: Sequence[str], small: Sequence[str]) -> str:
    """The key of a linear equation, by what is small in it."""
    return re.sub(r"\W+", "_", "_".join(("linear", str(row), *let, *small)))


def _is_linear(row: Expr) -> bool:
    """Whether every term contains one varying quantity at most."""
    varying = (sum(p for g, p in powers.items() if g.varies) for powers, _ in row.terms())
    return all(count <= 1 for count in varying)


def _oscillator(linear: _FirstOrder, truth: Truth) -> Iterator[SolutionLine]:
    """ε̈ by ε; small speeds in its equation are given by those that are derivatives, or solved."""
    rows, let, small = linear.rows, linear.let, linear.small
    bend, epsilon = _EPSILON.dt().dt(), _EPSILON.symbol
    target = next((row for row in rows if bend.symbol in row.symbols()), None)
    if target is None or bend.symbol is None or epsilon is None:
        return
    speeds = [s for s in target.symbols() if f"{s.published}:1" in small and s.base() != epsilon]
    integrals = [i.subs(linear.images) for i in linear.found.integrals]
    fixed = [
        c
        for c in integrals
        for s in speeds
        if c.diff(s) and _EPSILON.dt().symbol not in c.symbols()
    ]
    if len(speeds) > 1 or len(fixed) != len(speeds):
        return
    words = "so that"
    for other in (s for s in linear.equations.acceleration_symbols if s in target.symbols()):
        row = next((r for r in rows if r != target and r.diff(other)), None)
        if row is not None and bend.symbol in row.symbols():
            target = target - row * target.diff(other) / row.diff(other)
            words = f"Eliminate {inline(other)}:"
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
    if not slope or rate != slope * _EPSILON or (inertia == ONE and words == "so that"):
        return
    right = fraction(rate) if truth is Truth.NEVER else negative_multiple(-slope, _EPSILON)
    yield SolutionLine(
        words,
        rf"{bend.latex()} \approx {right}",
        "oscillator",
        "limit",
        let=let,
        small=small,
        given=given,
    )


def _by_differentiation(linear: _FirstOrder) -> Iterator[SolutionLine]:
    """What follows where rates of small speeds are given by one of them each."""
    rows, speeds, small = linear.rows, linear.rates, linear.small
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
    family: SteadyMotion,
    judged: Stability,
    truth: Truth,
    draws: str,
    swing: tuple[SolutionLine, ...],
) -> Iterator[SolutionLine]:
    frequencies = judged.frequencies
    rates = [text for text in (root_latex(rate**2) for rate in frequencies) if len(text) <= LONGEST]
    oscillate = f"oscillate at the angular frequency ${rates[0]}$" if rates else ""
    if truth is Truth.ALWAYS:
        how = f", but {oscillate}" if rates and len(frequencies) == 1 else ""
        yield SolutionLine(f"Small departures do not grow{how}.", stated=swing)
        return
    given = given_of(family)
    for condition in judged.conditions:  # one of several may imply the others
        for form in threshold_forms(condition.expression, family):
            if len(form.latex) > LONGEST or not holds(form.latex, "threshold", given, family):
                continue
            sign = "" if form.speed is None else f", with {inline(form.speed)} counted positive,"
            stays = f"stay small and {oscillate}" if swing and oscillate else "stay small"
            stay = f"{draws}small departures {stays} if{sign}"
            words = stay if draws else f"S{stay[1:]}"
            bound = form.bound
            values = () if bound is None else ((root_latex(bound**2), bound),)
            yield SolutionLine(
                words,
                form.latex,
                "threshold",
                "threshold",
                given=given,
                values=values,
                stated=swing,
            )
            return
    yield SolutionLine("The conditions of stability have no short form; steady prints them.")
