"""Numbers drawn for an exercise: parameters near typical values, legal inertias, states."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from math import isfinite, radians, sqrt

from polhode.algebra import PI, Expr, Symbol, SymbolKind, is_positive, read_value
from polhode.base import LENGTH, PURE, TIME, DeclarationError, Dimension, PolhodeError
from polhode.exercise._admissible import Admissible
from polhode.exercise._draws import Draws, rounded
from polhode.exercise._quantities import Amount, plain_amount, unit_of
from polhode.exercise._subject import ExerciseSubject, value_of
from polhode.model import Gravity

_MASS, _LENGTH = 0.4, 0.25  # kg and m, where nothing says what is typical
_TIME = sqrt(_LENGTH / 9.81)
_FREE = 0.2  # s, of what nothing drives
_INERTIA = 0.2  # moments of inertia over typical mass times length squared
_SPREAD = (0.7, 1.4)
_WIDE = (0.2, 8.0)  # of parameters without a typical value, where none near it are possible
_WIDENED = 40  # attempts after which
_TRIES = 800
_SMALL = 0.02
_TURNED = 6.0  # from where on obtuse angles are tried
_GRAVITY, _EARTH = "9.81 m/s^2", "7.292e-5 rad/s"


@dataclass(frozen=True)
class DrawnNumbers:
    """The numbers of one exercise.

    Attributes:
        amounts: of parameters that are stated, by symbol.
        formulas: of parameters that follow from others, by symbol, as LaTeX.
        values: of all parameters, SI.
    """

    amounts: Mapping[Symbol, Amount]
    formulas: Mapping[Symbol, Expr]
    values: Mapping[Symbol, float]

    @property
    def texts(self) -> dict[str, str]:
        """Values as text, by published name, for `simulate` and exact analysis."""
        stated = {s.published: a.text for s, a in self.amounts.items()}
        return stated | {s.published: repr(self.values[s]) for s in self.formulas}


def draw(subject: ExerciseSubject, draws: Draws, fixed: Mapping[str, str]) -> DrawnNumbers:
    """Values of all parameters, to two significant figures.

    Args:
        subject: the system.
        draws: from the seed.
        fixed: values that are not drawn, by name.

    Raises:
        DeclarationError: where no legal moments of inertia are found near the typical values, and
            for impossible values; UnitError for one of the wrong dimension.
    """
    symbols = _parameters(subject)
    _refuse_impossible(subject, symbols, fixed)
    admissible = Admissible.of(subject)
    for attempt in range(_TRIES):
        own = draws.about(attempt)
        spread = _SPREAD if attempt < _WIDENED else _WIDE
        found = _drawn(subject, symbols, own, fixed, spread)
        if admissible.admits(found.values) and _in_order(subject, symbols, found, fixed):
            return found
    raise DeclarationError(
        f"the parameters of {subject.equations.system.name!r}",
        expected="bodies that can be: positive masses, moments of inertia of which none is above "
        "the sum of the two others, and places on bodies that lie within them",
        advice="set values of some of them",
    )


def _refuse_impossible(
    subject: ExerciseSubject, symbols: Iterable[Symbol], fixed: Mapping[str, str]
) -> None:
    """Refuse given values of the wrong dimension or sign."""
    names = {s.published: s for s in symbols}
    dimensions = {s: d for s in symbols if (d := subject.dimension(s)) is not None}
    for name, text in fixed.items():
        symbol = names.get(name)
        if symbol is None:
            raise DeclarationError(
                f"{name}, on which nothing depends", expected=f"one of {', '.join(names)}"
            )
        given = read_value(name, text, names)
        value = given.in_dimension(dimensions.get(symbol), dimensions)
        is_number = not value.symbols
        if is_number and is_positive(Expr.generator(symbol)) and not value.rounded() > 0:
            raise DeclarationError(f"{name} = {text}", expected="a positive value")


def _parameters(subject: ExerciseSubject) -> tuple[Symbol, ...]:
    """Parameters of the equations and the bodies; lengths that only typical values depend on."""
    bodies = [e for b in subject.bodies for e in (b.mass, *sum(b.inertia.rows, ()))]
    own = set(subject.equations.parameters).union(*(e.symbols() for e in bodies))
    names = {s.published: s for s in own}
    wanted = list(own)
    for symbol in wanted:
        text = subject.typical.get(symbol.published, "")
        if text and plain_amount(text) is None:
            others = {n: names.get(n, Symbol(n)) for n in subject.typical}
            used = read_value(symbol.published, text, others).symbols
            wanted += [s for s in used if s not in wanted]
    order = {name: i for i, name in enumerate(subject.typical)}
    kept = (s for s in wanted if s.name != "pi")
    return tuple(sorted(kept, key=lambda s: (order.get(s.published, len(order)), s.published)))


def _drawn(
    subject: ExerciseSubject,
    symbols: tuple[Symbol, ...],
    draws: Draws,
    fixed: Mapping[str, str],
    spread: tuple[float, float],
) -> DrawnNumbers:
    amounts, formulas = dict[Symbol, Amount](), dict[Symbol, Expr]()
    values = dict[Symbol, float]()
    names = {s.published: s for s in symbols}
    constants = _gravities(subject) | _turning_ground(subject)
    for symbol in symbols:
        text = fixed.get(symbol.published) or _typical(subject, symbol)
        amount = _with_unit(subject, symbol, plain_amount(text))
        if amount is None:
            given = read_value(symbol.published, text, names)
            if not isinstance(given.number, Expr):
                values[symbol] = given.rounded()
                amounts[symbol] = Amount(values[symbol])
                continue
            if given.symbols:
                formulas[symbol] = given.number
            else:  # a pure fraction such as 2/5
                values[symbol] = given.rounded()
                formulas[symbol] = given.number
            continue
        if symbol.published not in fixed and symbol not in constants:
            is_typical = symbol.published in subject.typical
            amount = _varied(symbol, amount, draws, _SPREAD if is_typical else spread)
        amounts[symbol], values[symbol] = amount, amount.si
    for _ in formulas:  # each round gives those that need only earlier ones
        ready = {s: e for s, e in formulas.items() if e.symbols() <= {*values}}
        values |= {s: value_of(e, values) for s, e in ready.items()}
    return DrawnNumbers(amounts, formulas, values)


def _with_unit(subject: ExerciseSubject, symbol: Symbol, amount: Amount | None) -> Amount | None:
    """A bare number with the SI unit in which it is taken."""
    if amount is None or amount.unit:
        return amount
    dimension = subject.dimension(symbol) or PURE
    unit = "rad" if dimension == PURE and subject.is_angle(symbol) else unit_of(dimension)
    return Amount(amount.number, unit)


def _typical(subject: ExerciseSubject, symbol: Symbol) -> str:
    if text := subject.typical.get(symbol.published):
        return text
    if symbol in _gravities(subject):
        return _GRAVITY
    if symbol in _turning_ground(subject):
        return _EARTH
    if subject.dimension(symbol) == PURE / TIME:  # slow enough for a hoop to keep its bead low
        return f"{rounded(0.5 / _TIME)!r} rad/s"
    if subject.is_angle(symbol):
        return "25 deg"
    dimension = subject.dimension(symbol) or PURE
    if dimension == PURE:
        return "0.4"
    size = _scale(dimension)
    if str(dimension) == "kg m^2":
        size *= _INERTIA
    return f"{rounded(size)!r} {unit_of(dimension)}".strip()


def _scale(dimension: Dimension) -> float:
    mass, length, time = map(float, (dimension.mass, dimension.length, dimension.time))
    return float(_MASS**mass * _LENGTH**length * _TIME**time)


def _gravities(subject: ExerciseSubject) -> set[Symbol]:
    loads = (load for load in subject.equations.system.loads if isinstance(load, Gravity))
    return {s for load in loads for s in load.g.symbols()}


def _turning_ground(subject: ExerciseSubject) -> set[Symbol]:
    """Parameters of the rotation of the Earth, which is about an axis that is not vertical.

    Ground that turns about a vertical axis is a turntable, or carries a hoop.
    """
    turned = [s for body in subject.bodies for c in body.axes.root.turned for s in c.symbols()]
    rates = {s for s in turned if not subject.is_angle(s)}
    return rates if len(rates) < len({*turned}) else set()


def _varied(symbol: Symbol, amount: Amount, draws: Draws, spread: tuple[float, float]) -> Amount:
    name = symbol.published
    if amount.unit == "deg":
        return Amount(float(round(draws.scaled(name, amount.number, *_SPREAD))) or 1.0, "deg")
    sign = -1.0 if amount.number < 0 else 1.0
    size = draws.scaled(name, abs(amount.number), *spread)
    return Amount(sign * rounded(size), amount.unit)


def _in_order(
    subject: ExerciseSubject,
    symbols: Iterable[Symbol],
    found: DrawnNumbers,
    fixed: Mapping[str, str],
) -> bool:
    """Whether moments of inertia that differ typically come in the same order."""
    drawn = [s for s in found.amounts if s.published not in fixed]
    moments = [s for s in symbols if str(subject.dimension(s)) == "kg m^2" and s in drawn]
    typical = {
        s: a.si for s in moments if (a := plain_amount(subject.typical.get(s.published, "")))
    }
    pairs = [(p, q) for p in typical for q in typical if typical[p] < 0.98 * typical[q]]
    return all(found.values[p] < 0.97 * found.values[q] for p, q in pairs)


# -- states ----------------------------------------------------------------------------------------


def draw_state(
    subject: ExerciseSubject,
    symbols: Iterable[Symbol],
    drawn: DrawnNumbers,
    draws: Draws,
    accepts: Callable[[Mapping[Symbol, float]], bool] = lambda values: True,
) -> dict[Symbol, Amount] | None:
    """Values of coordinates and speeds, drawn until they are accepted; None if none are."""
    wanted = sorted(set(symbols), key=lambda s: (s.order, s.kind is SymbolKind.SPEED, s.published))
    for attempt in range(_TRIES):
        tried = draws.about(f"state {attempt}")
        wide = 1.0 + attempt / 20
        found = {s: _state_value(subject, s, drawn, tried, wide) for s in wanted}
        values = {s: a.si for s, a in found.items()} | dict(drawn.values)
        if accepts(values) and _fits(subject, values):
            return found
    return None


def _fits(subject: ExerciseSubject, values: Mapping[Symbol, float]) -> bool:
    """Whether bodies touch curved supports at single points, as far as the values tell."""
    known = (limit for limit in subject.equations.limits if limit.symbols() <= {*values, PI})
    return all(value_of(limit, values) > 0 for limit in known)


def _state_value(
    subject: ExerciseSubject, symbol: Symbol, drawn: DrawnNumbers, draws: Draws, wide: float
) -> Amount:
    name = symbol.published
    dimension = subject.dimension(symbol) or PURE
    if not symbol.order and dimension == PURE and subject.is_angle(symbol):
        angle = float(round(draws.between(name, 25, 75)))
        return Amount(angle if wide < _TURNED else 180 - angle, "deg")
    unit = unit_of(dimension, False)
    typical = _typical_state(subject, symbol, dimension, drawn)
    return Amount(rounded(draws.scaled(name, typical, 0.6 / wide, 1.6 * wide)), unit)


def _typical_state(
    subject: ExerciseSubject, symbol: Symbol, dimension: Dimension, drawn: DrawnNumbers
) -> float:
    """A typical value: stated, or as large as the system moves by itself."""
    stated = _stated_start(subject, symbol)
    same = [s for s in subject.equations.speeds if subject.dimension(s) == dimension]
    alike = (_stated_start(subject, s) for s in (*same, symbol))
    largest = max((v for v in alike if v is not None), default=0.0)
    if stated and stated > _SMALL * largest:  # others are small departures
        return stated
    if stated:
        return largest
    if natural := natural_size(subject, symbol, drawn.values):
        return natural
    others = (natural_size(subject, s, drawn.values) for s in same)
    slowest = min(filter(None, others), default=0.0)
    return slowest or largest or float(_LENGTH**dimension.length * _FREE**dimension.time)


def natural_size(
    subject: ExerciseSubject, symbol: Symbol, values: Mapping[Symbol, float]
) -> float | None:
    """How fast a system becomes by itself: from rest, over a radian or its smallest length.

    The acceleration is that at an angle of 50°, while other speeds have their typical values. None
    for a coordinate, and where nothing drives a speed.
    """
    equations = subject.equations
    length = _smallest_length(subject, values)
    if symbol.order == 0 and symbol in equations.coordinates:
        return length if subject.dimension(symbol) == LENGTH else None
    state = {q: _at_rest(subject, q, length) for q in equations.coordinates}
    state |= {s: _stated_start(subject, s) or 0.0 for s in equations.speeds if s != symbol}
    try:
        rate = equations.accelerations[symbol.derivative()]
        found = abs(value_of(rate, {**state, **values, symbol: 0.0}))
    except (PolhodeError, KeyError):
        return None
    over = length if subject.dimension(symbol) == LENGTH / TIME else 1.0
    return sqrt(found * over) if isfinite(found) and found > 0 else None


def _at_rest(subject: ExerciseSubject, coordinate: Symbol, length: float) -> float:
    return radians(50) if subject.is_angle(coordinate) else length


def _smallest_length(subject: ExerciseSubject, values: Mapping[Symbol, float]) -> float:
    lengths = (v for s, v in values.items() if subject.dimension(s) == LENGTH and v > 0)
    return min(lengths, default=_LENGTH)


def _stated_start(subject: ExerciseSubject, symbol: Symbol) -> float | None:
    """A typical value that is given for a coordinate or a speed, SI."""
    amount = plain_amount(subject.start.get(symbol.published, ""))
    return None if amount is None else abs(amount.si)


def as_text(amounts: Mapping[Symbol, Amount]) -> dict[str, str]:
    """Values of a state as text, by published name."""
    return {s.published: a.text for s, a in amounts.items()}
