"""The free rotation of a rigid body written out: tanh and sech, and Jacobi's functions elsewhere.

Landau and Lifshitz, Mechanics, § 37.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import Expr
from polhode.analyse import FreeBody, recognise
from polhode.base import PolhodeError
from polhode.solution._letters import definition, free_letter, letter_latex
from polhode.solution._lines import SolutionLine, bracketed
from polhode.solution._setting import Setting


@dataclass(frozen=True)
class _Letters:
    """LaTeX of moments A < B < C, of the angular velocities, and of L and T.

    Attributes:
        moments, rates: along the three axes.
        names: of the axes.
        bend: rate of the angular velocity along the second.
        momentum, energy: L and T, or other letters where the system has these.
    """

    moments: tuple[str, str, str]
    rates: tuple[str, str, str]
    names: tuple[str, str, str]
    bend: str
    momentum: str
    energy: str

    def less(self, i: int, j: int) -> str:
        """The difference of two moments."""
        return rf"\left({self.moments[i]} - {self.moments[j]}\right)"

    @property
    def square(self) -> str:
        """L²."""
        terms = (rf"{m}^2 {w}^2" for m, w in zip(self.moments, self.rates, strict=True))
        return " + ".join(terms)

    @property
    def double(self) -> str:
        """2T."""
        terms = (f"{m} {w}^2" for m, w in zip(self.moments, self.rates, strict=True))
        return " + ".join(terms)

    @property
    def let(self) -> tuple[str, ...]:
        """Definitions of L and T."""
        return (
            definition(self.momentum, rf"\sqrt{{{self.square}}}"),
            definition(self.energy, rf"\frac{{1}}{{2}}\left({self.double}\right)"),
        )

    @property
    def ordered(self) -> tuple[str, ...]:
        """What is positive if the moments grow from the first to the third."""
        return tuple(f"{{{self.moments[i]}}} - {self.moments[j]}" for i, j in ((1, 0), (2, 1)))


def free_rotation(setting: Setting, family: FreeBody) -> Iterator[SolutionLine]:
    """The rotation on the separatrix by tanh and sech, and elsewhere by Jacobi's functions."""
    letters = _letters(setting, family)
    yield from _integrals(letters)
    yield from _separatrix(setting, letters)
    yield from _elliptic(setting, letters)


def about_each_axis(setting: Setting) -> Iterator[SolutionLine]:
    """About which principal axis of a free body rotation is unstable, and how fast.

    Nothing for other systems, and for moments of which two are equal.
    """
    try:
        family = recognise(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    if not isinstance(family, FreeBody) or len(set(family.moments)) < 3:
        return
    x = _letters(setting, family)
    (A, B, C), (_, v, _), (_, second, _) = x.moments, x.rates, x.names
    growth = rf"\left|{v}\right|\sqrt{{{_gap(x, 2, 1)} {_gap(x, 1, 0)}/({A} {C})}}"
    yield SolutionLine(
        f"Let ${A} < {B} < {C}$. Then the condition fails for axis ${second}$ alone, that of the "
        "middle moment: rotation about it is unstable, and a departure grows as "
        rf"$e^{{\sigma t}}$ at the rate $\sigma = {growth}$."
    )


def _letters(setting: Setting, family: FreeBody) -> _Letters:
    equations = setting.equations
    a, b, c = (bracketed(moment.latex()) for moment in family.moments)
    u, v, w = (Expr.generator(speed).latex() for speed in family.speeds)
    first, second, third = setting.axes.labels
    return _Letters(
        (a, b, c),
        (u, v, w),
        (first, second, third),
        Expr.generator(family.speeds[1].derivative()).latex(),
        letter_latex(free_letter(equations, "L", "Lambda", "H")),
        letter_latex(free_letter(equations, "T", "K", "W")),
    )


def _integrals(x: _Letters) -> Iterator[SolutionLine]:
    L, T = x.momentum, x.energy
    A, B, C = x.moments
    yield SolutionLine(
        f"Let ${A} < {B} < {C}$; otherwise rename the axes. The kinetic energy ${T}$ and the "
        f"magnitude ${L}$ of the angular momentum are constant, with",
        rf"2 {T} = {x.double}, \qquad {L}^2 = {x.square}",
        "free_integrals",
        "identity",
        let=x.let,
    )
    for i, other in ((0, 2), (2, 0)):
        words = "and" if i else f"They give two of the angular velocities by ${x.rates[1]}$,"
        yield SolutionLine(
            words,
            rf"{x.rates[i]}^2 = \frac{{{_excess(x, other)} - {x.moments[1]} {_gap(x, other, 1)} "
            rf"{x.rates[1]}^2}}{{{x.moments[i]} {_gap(x, other, i)}}}",
            f"free_{i + 1}",
            "identity",
            let=x.let,
        )


def _gap(x: _Letters, i: int, j: int) -> str:
    """The difference of two moments, the greater first."""
    return x.less(i, j) if i > j else x.less(j, i)


def _excess(x: _Letters, i: int) -> str:
    """2 T C - L² or L² - 2 T A, positive."""
    product = f"2 {x.moments[i]} {x.energy}"
    return f"{product} - {x.momentum}^2" if i else f"{x.momentum}^2 - {product}"


def _separatrix(setting: Setting, x: _Letters) -> Iterator[SolutionLine]:
    equations = setting.equations
    L, T, (A, B, C), (u, v, w) = x.momentum, x.energy, x.moments, x.rates
    k = letter_latex(free_letter(equations, "k", "q", "xi"))
    value = rf"\sqrt{{\frac{{{x.less(2, 1)} {x.less(1, 0)}}}{{{A} {C}}}}}"
    let = (*x.let, definition(k, value))
    ratio = rf"\sqrt{{\frac{{{A} {x.less(1, 0)}}}{{{C} {x.less(2, 1)}}}}}"
    given = (f"{{{w}}} = {ratio} {u}",)
    positive = (*x.ordered, f"{{{u}}}")
    squares = [
        rf"{x.rates[i]}^2 = \frac{{{gap} \left({L}^2 - {B}^2 {v}^2\right)}}"
        rf"{{{x.moments[i]} {B} {x.less(2, 0)}}}"
        for i, gap in ((0, x.less(2, 1)), (2, x.less(1, 0)))
    ]
    yield SolutionLine(
        f"A body that is set turning about axis ${x.names[1]}$, with a slight push, moves close to "
        f"the curve ${L}^2 = 2 {B} {T}$, which separates motions about axis ${x.names[0]}$ from "
        f"those about axis ${x.names[2]}$. Since",
        rf"{L}^2 - 2 {B} {T} = {C} {x.less(2, 1)} {w}^2 - {A} {x.less(1, 0)} {u}^2",
        "separatrix_difference",
        "identity",
        let=x.let,
    )
    yield SolutionLine(
        f"it consists of four branches, with different signs of ${u}$ and ${w}$. We take the one "
        f"on which both are positive, ${w} = {ratio}\\,{u}$. On all of them "
        f"${L}^2 = 2 {B} {T}$, and [[free_1]] and [[free_3]] become",
        squares[0],
        "separatrix_square_1",
        let=x.let,
        given=given,
        positive=positive,
    )
    yield SolutionLine("and", squares[1], let=x.let, given=given, positive=positive)
    yield SolutionLine(
        f"Put their roots into the equation of motion for ${v}$:",
        rf"{x.bend} = {k} \left(\frac{{{L}^2}}{{{B}^2}} - {v}^2\right), \qquad {k} = {value}",
        "separatrix_rate",
        let=let,
        given=given,
        positive=positive,
        stated=(
            SolutionLine("", rf"{L}^2 = 2 {B} {T}", let=x.let, given=given, positive=positive),
        ),
    )
    argument = rf"\left(\frac{{{k} {L}}}{{{B}}} t\right)"
    sizes = (
        rf"\frac{{{L}}}{{{B}}} \sqrt{{\frac{{{B} {x.less(2, 1)}}}{{{A} {x.less(2, 0)}}}}} "
        rf"\operatorname{{sech}}{argument}",
        rf"\frac{{{L}}}{{{B}}} \tanh{argument}",
        rf"\frac{{{L}}}{{{B}}} \sqrt{{\frac{{{B} {x.less(1, 0)}}}{{{C} {x.less(2, 0)}}}}} "
        rf"\operatorname{{sech}}{argument}",
    )
    words = (
        f"The variables separate. With the time $t$ counted from the instant at which ${v} = 0$,"
    )
    for i in (1, 0, 2):
        yield SolutionLine(
            words,
            f"{x.rates[i]} = {sizes[i]}",
            f"separatrix_{i + 1}",
            "launch",
            let=let,
            given=(*given, f"{{{v}}} = 0"),
            positive=positive,
        )
        words = "and with the relations above," if i == 1 else ""
    yield SolutionLine(
        "On the other branches two of the three signs are reversed. As $t \\to \\pm\\infty$ "
        f"${u}$ and ${w}$ vanish and ${v}$ tends to $\\pm {L}/{B}$: the body turns over once, "
        f"from rotation about axis ${x.names[1]}$ in one sense to the other, and takes for ever to "
        "do so."
    )


def _elliptic(setting: Setting, x: _Letters) -> Iterator[SolutionLine]:
    equations = setting.equations
    L, T, (A, B, C), (u, v, w) = x.momentum, x.energy, x.moments, x.rates
    names = (
        free_letter(equations, "kappa", "xi", "zeta"),
        free_letter(equations, "lambda_", "nu", "mu"),
        free_letter(equations, "alpha", "p"),
        free_letter(equations, "beta", "q"),
        free_letter(equations, "gamma", "s"),
    )
    k, rate, a, b, c = map(letter_latex, names)
    above, below = _excess(x, 2), _excess(x, 0)
    squares = {
        a: rf"\frac{{{above}}}{{{A} {x.less(2, 0)}}}",
        b: rf"\frac{{{above}}}{{{B} {x.less(2, 1)}}}",
        c: rf"\frac{{{below}}}{{{C} {x.less(2, 0)}}}",
        rate: rf"\frac{{{x.less(2, 1)} \left({below}\right)}}{{{A} {B} {C}}}",
        k: rf"\frac{{{x.less(1, 0)} \left({above}\right)}}{{{x.less(2, 1)} \left({below}\right)}}",
    }
    let = (*x.let, *(definition(f"{name}^2", value) for name, value in squares.items()))
    amplitudes = r", \quad ".join(f"{n}^2 = {squares[n]}" for n in (a, b, c))
    others = r", \quad ".join(f"{n}^2 = {squares[n]}" for n in (rate, k))
    yield SolutionLine(
        f"In general let ${L}^2 > 2 {B} {T}$, so that the motion goes round axis ${x.names[2]}$; "
        f"for ${L}^2 < 2 {B} {T}$ exchange the axes ${x.names[0]}$ and ${x.names[2]}$ in what "
        "follows. Define the amplitudes",
        amplitudes,
        "amplitudes",
        "identity",
        let=let,
    )
    yield SolutionLine("a rate and a modulus,", others, "modulus", "identity", let=let)
    yield SolutionLine(
        f"where ${k}$ lies between 0 and 1. The integrals become",
        rf"\frac{{{u}^2}}{{{a}^2}} + \frac{{{v}^2}}{{{b}^2}} = 1, \qquad "
        rf"\frac{{{w}^2}}{{{c}^2}} + {k}^2 \frac{{{v}^2}}{{{b}^2}} = 1",
        "jacobi_squares",
        let=let,
    )
    yield SolutionLine(
        f"and with them the square of the equation for ${v}$,",
        rf"{x.bend}^2 = {rate}^2 {b}^2 \left(1 - \frac{{{v}^2}}{{{b}^2}}\right) "
        rf"\left(1 - {k}^2 \frac{{{v}^2}}{{{b}^2}}\right)",
        "jacobi_rate",
        let=let,
    )
    since = rf"{rate}(t - t_0)"
    yield SolutionLine(
        f"This is the equation that defines Jacobi's function sn: ${v} = {b}\\operatorname{{sn}}"
        rf"\left[{since}, {k}\right]$, with a constant $t_0$ given by the start, and therefore "
        rf"${u} = \pm {a}\operatorname{{cn}}\left[{since}, {k}\right]$ and ${w} = \pm "
        rf"{c}\operatorname{{dn}}\left[{since}, {k}\right]$, with signs whose product is positive. "
        rf"They repeat after the time $4 K({k})/{rate}$, with the complete elliptic integral "
        rf"$K({k}) = \int_0^{{\pi/2}} d\chi/\sqrt{{1 - {k}^2\sin^2\chi}}$; close to the "
        "separatrix this time grows beyond all bounds."
    )
