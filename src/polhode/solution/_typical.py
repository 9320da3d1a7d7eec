"""Typical numbers: thresholds, periods, lengths and forces for one motion, with units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import degrees

import numpy as np

from polhode.algebra import (
    Expr,
    Symbol,
    SymbolKind,
    dimension_of,
    read_expression,
    variables,
)
from polhode.base import PURE, TIME, NumericError, PolhodeError
from polhode.derive import Equations, is_angle
from polhode.judge import Answer, Verdict, check
from polhode.model import Contact
from polhode.solution._example import Example
from polhode.solution._lines import SolutionLine, listed
from polhode.solution._setting import PATIENCE, Setting
from polhode.view import si_unit

_DIGITS = 3
_SHORT = 100  # characters of a formula that is repeated with its value


def typical_numbers(
    setting: Setting, lines: Iterable[SolutionLine], example: Example
) -> Iterator[SolutionLine]:
    """Values of what the lines found, and how large the forces are along the motion."""
    yield SolutionLine(f"For instance, let {listed(_given(setting.equations, example))}.")
    yield from _special_bodies(setting, lines, example)
    yield from _values(setting, lines, example)
    yield from _forces(setting, example)


def number_latex(value: float, digits: int = _DIGITS) -> str:
    """A number rounded to significant digits; from 100 on with one decimal more than needed.

    Digits after a point show to which precision a number is meant, as those before it do not.
    """
    if value == 0:
        return "0"
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    power = int(exponent)
    if -3 < power < 5:
        return f"{value:.{max(digits - 1 - power, 1)}f}"
    return rf"{mantissa}\times 10^{{{power}}}"


def given_latex(equations: Equations, symbol: Symbol, value: float) -> str:
    """A value that was chosen, with its unit; angles in degrees."""
    if is_angle(equations, symbol):
        return rf"{degrees(value):.4g}^\circ"
    mantissa, _, exponent = f"{value:.4g}".partition("e")
    printed = rf"{mantissa}\times 10^{{{int(exponent)}}}" if exponent else mantissa
    return _with_unit(printed, unit_of(equations, Expr.generator(symbol)))


def quantity_latex(value: float, unit: str, digits: int = _DIGITS) -> str:
    """A number with its unit."""
    return _with_unit(number_latex(value, digits), unit)


def _with_unit(printed: str, unit: str) -> str:
    if not unit:
        return printed
    upright = unit.replace("²", "^2").replace("³", "^3").replace(" ", r"\,")
    return rf"{printed}\,\mathrm{{{upright}}}"


def unit_of(equations: Equations, expression: Expr) -> str:
    """The SI unit of an expression; empty for a pure number, an angle among them."""
    known = dict(equations.dimensions)
    rates = [value for body in equations.system.bodies for value in body.rates.values()]
    for rate in rates:  # those of spins, which equations in named parts do not show
        known |= {s: PURE / TIME for s in rate.symbols() if s.kind is SymbolKind.SPEED}
    for speed, meaning in equations.system.speeds:
        if speed not in known and meaning.symbols() <= known.keys():
            known[speed] = dimension_of(meaning, known) or PURE
    dimension = dimension_of(expression, known)
    return "" if dimension is None else si_unit(dimension, angle=False)


def _given(equations: Equations, example: Example) -> Iterator[str]:
    for symbol in equations.parameters:
        name = symbol.published
        if name not in example.parameters or name in example.formulas:
            continue
        value = given_latex(equations, symbol, float(example.parameters[name]))
        yield f"${Expr.generator(symbol).latex()} = {value}$"


def _formulas(setting: Setting, example: Example) -> dict[Symbol, Expr]:
    """Parameters that the example gives by others."""
    known = {s.published: s for s in setting.equations.parameters}
    letters = {name: Expr.generator(s) for name, s in known.items()}
    found = {}
    for name, text in example.formulas.items():
        try:
            found[known[name]] = read_expression(text, letters)
        except PolhodeError:  # a number with a unit
            continue
    return found


def _special_bodies(
    setting: Setting, lines: Iterable[SolutionLine], example: Example
) -> Iterator[SolutionLine]:
    """What was found, with moments of inertia in terms of mass and size."""
    images = _formulas(setting, example)
    if not images:
        return
    given = tuple(f"{s.published} = {value!s}" for s, value in images.items())
    each = listed(f"${Expr.generator(s).latex()} = {v.latex()}$" for s, v in images.items())
    words = f"Moreover let {each}. Then"
    seen = set[str]()
    for name, expression in (pair for line in lines for pair in line.values):
        special = expression.subs(images)
        text = f"{name} = {special.latex()}"
        if (
            special == expression
            or text in seen
            or name == expression.latex()
            or len(text) > _SHORT
        ):
            continue
        seen.add(text)
        let = () if _is_known(setting, name) else (f"{{{name}}} = {expression.latex()}",)
        yield SolutionLine(words, text, context="identity", let=let, given=given)
        words = ""
    if not seen:
        yield SolutionLine(f"Moreover let {each}.")


def _is_known(setting: Setting, name: str) -> bool:
    letters = (*setting.equations.parameters, *setting.equations.speeds)
    return any(Expr.generator(s).latex() == name for s in letters)


def _values(
    setting: Setting, lines: Iterable[SolutionLine], example: Example
) -> Iterator[SolutionLine]:
    found = [
        (name, expression, value)
        for name, expression in dict.fromkeys(pair for line in lines for pair in line.values)
        if (value := example.value(expression)) is not None
    ]
    words = "What was found above then amounts to"
    if any(symbol.kind.varies for _, expression, _ in found for symbol in expression.symbols()):
        words += ", with the values at the start of the motion that is drawn below,"
    if any(name.endswith("_2") for name, _, _ in found):
        words = words.removesuffix(",") + " and with subscripts for two roots,"
    for name, expression, value in found:
        formula = expression.latex()
        is_root = name.endswith(("_1", "_2"))
        sides = [name] if is_root or len(formula) > _SHORT else [name, formula]
        sides.append(quantity_latex(value, unit_of(setting.equations, expression)))
        verdict = _number(setting, expression, value, example)
        yield SolutionLine(
            words, " = ".join(dict.fromkeys(sides)), context="number", verdict=verdict
        )
        words = ""
    if example.period is not None:
        yield SolutionLine(f"{_repeats(example)} after ${quantity_latex(example.period, 's')}$.")


def _repeats(example: Example) -> str:
    """What repeats after a period: the motion, or those of its quantities that do not advance."""
    names = example.repeating
    if names is None:
        return "The motion that is drawn below repeats"
    if not names:  # two tilts of an axis that precesses
        return "Except for a rotation the motion that is drawn below repeats"
    state = (*example.equations.coordinates, *example.equations.speeds)
    letters = {s.published: f"${Expr.generator(s).latex()}$" for s in state}
    what = listed(letters[name] for name in names)
    return f"Along the motion that is drawn below {what} repeat{'s' * (len(names) == 1)}"


def _number(setting: Setting, expression: Expr, value: float, example: Example) -> Verdict:
    """The verdict on a number, whose unit is that of the International System."""
    sign = -1 if value < 0 else 1  # the digits of a number with a sign are not looked at
    text = f"{(sign * expression).latex()} = {number_latex(abs(value))}"
    known = example.known
    given = tuple(
        f"{s.published} = {known[s.published]!r}"
        for s in expression.symbols()
        if s.published in known
    )
    verdict = check(text, setting.equations, context="number", given=given, seconds=PATIENCE)
    if verdict.answer is not Answer.HOLDS:
        raise NumericError(
            f"the number {text} of the solution of {setting.equations.system.name!r}, judged as "
            f"{verdict.answer.value}: {verdict.reason}",
            expected="a formula that holds",
            advice="report it with the declaration",
        )
    return verdict


# -- forces along the motion -----------------------------------------------------------------------


def _forces(setting: Setting, example: Example) -> Iterator[SolutionLine]:
    """The least and the greatest force of each support, beside the weight."""
    run = example.run
    determined = [e for e in setting.forced if not setting.equations.undetermined]
    for element in determined:
        components = setting.equations.reactions[element.name].force.components
        names = {symbol.name for symbol in variables(components)}
        if names & set(setting.equations.undetermined):
            continue  # not determined: another support takes any share of it
        size = np.sqrt(sum(run.evaluate(c) ** 2 for c in components))
        least, greatest = float(np.min(size)), float(np.max(size))
        letter = setting.force_letter(element)
        bounds = f"between ${number_latex(least)}$ and ${quantity_latex(greatest, 'N')}$"
        if number_latex(least) == number_latex(greatest):
            bounds = f"at ${quantity_latex(greatest, 'N')}$"
        words = f"Along this motion the magnitude of ${letter}$ stays {bounds}"
        if setting.gravity is not None and setting.is_single and element == determined[0]:
            weight = example.value(setting.mass * setting.gravity.g)
            if weight:
                words += f", and the weight is ${quantity_latex(weight, 'N')}$"
        yield SolutionLine(f"{words}.{_friction(setting, element, example)}")


def _friction(setting: Setting, element: object, example: Example) -> str:
    """The least coefficient of friction with which a contact would hold, or why none would."""
    if not isinstance(element, Contact):
        return ""
    force = setting.equations.reactions[element.name].force
    support, run = element.on, example.run
    normal = run.evaluate(force.dot(support.up))
    across = [run.evaluate(force.dot(support.axes[label])) for label in support.tangents]
    friction = np.hypot(*across)
    if np.any(normal < -1e-9 * np.max(np.abs(normal))):
        return " At times the support would have to pull; one that can only push lets go."
    if not np.any(friction > 1e-12 * np.abs(normal)):
        return ""
    if np.any(normal <= 1e-12 * friction):
        return " Without a normal force no friction can exert it: the body would slip."
    needed = float(np.max(friction / np.abs(normal)))
    return (
        " It does not slip if the coefficient of static friction is at least "
        f"${number_latex(needed)}$."
    )
