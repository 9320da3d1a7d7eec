"""A pendulum and a symmetric top by elliptic functions, with every letter defined.

Whittaker, Analytical Dynamics, §§ 44 and 71.
"""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr, pi, sqrt
from polhode.analyse import Pendulum
from polhode.solution._judge import if_true
from polhode.solution._letters import definition, free_letter, letter_latex
from polhode.solution._lines import SolutionLine
from polhode.solution._setting import Setting

# -- pendulum --------------------------------------------------------------------------------------


def pendulum(setting: Setting, family: Pendulum) -> Iterator[SolutionLine]:
    """The swing of a body about a horizontal axis: its modulus, sn, the period, the separatrix."""
    equations = setting.equations
    signs = {Expr.generator(s) for s in equations.parameters if s.positive}
    strength, positive = _positive(family.strength, signs)
    if strength is None:
        return
    theta = Expr.generator(family.angle) + family.shift
    lowest = theta if not positive else theta - pi
    rate = Expr.generator(family.angle.derivative()).latex()
    n = letter_latex(free_letter(equations, "n", "nu", "p"))
    k = letter_latex(free_letter(equations, "k", "q", "xi"))
    angle = lowest.latex()
    name = angle
    let = [definition(n, rf"\sqrt{{{strength.latex()}}}")]
    if lowest.symbol is None:
        name = letter_latex(free_letter(equations, "chi", "eta", "zeta"))
        let.append(definition(name, angle))
    half = rf"\sin^2\frac{{{name}}}{{2}}"
    modulus = rf"\frac{{{rate}^2}}{{4 {n}^2}} + {half}"
    measured = "It" if name == angle else f"With ${name} = {angle}$, the angle from below, it"
    bend = rf"\ddot{{{Expr.generator(family.angle).latex()}}}"
    yield SolutionLine(
        f"The motion is that of a simple pendulum. {measured} obeys",
        rf"{bend} = -{n}^2 \sin {name}, \qquad {n}^2 = {strength.latex()}",
        "pendulum",
        let=tuple(let),
        values=((rf"\frac{{2\pi}}{{{n}}}", 2 * pi / sqrt(strength)),),
    )
    let.append(definition(f"{k}^2", modulus))
    yield SolutionLine(
        f"Multiply by ${rate}$ and integrate. The energy gives a constant ${k}^2$, with",
        rf"{rate}^2 = 4 {n}^2 \left({k}^2 - {half}\right)",
        "swing_energy",
        let=tuple(let),
        stated=(
            SolutionLine("", rf"\frac{{d}}{{dt}}\left({modulus}\right) = 0", let=tuple(let[:-1])),
        ),
    )
    period = rf"4 K({k})/{n}"
    yield SolutionLine(
        f"For ${k} < 1$ it swings, and ${k}$ is the sine of half the greatest angle. Put "
        rf"$\sin({name}/2) = {k}\,s$; then $\dot s^2 = {n}^2 (1 - s^2)(1 - {k}^2 s^2)$, which "
        rf"defines Jacobi's function: "
        rf"$\sin({name}/2) = {k}\operatorname{{sn}}[{n}(t - t_0), {k}]$, with a constant $t_0$ "
        rf"given by the start. The period is ${period}$, with the complete elliptic integral "
        rf"$K({k}) = \int_0^{{\pi/2}} d\chi/\sqrt{{1 - {k}^2\sin^2\chi}}$, and $2\pi/{n}$ for "
        rf"small swings. For ${k} > 1$ it turns over and over.",
        stated=_sine_rate(name, n, k, tuple(let)),
    )
    bottom = (theta - lowest - family.shift).latex()
    yield from if_true(_over_the_top(family, bottom, name, n, tuple(let[:-1])), equations)


def _positive(strength: Expr, signs: set[Expr]) -> tuple[Expr | None, bool]:
    """|μ|, and whether μ is positive, where the declared signs of the parameters decide it."""
    for value, positive in ((strength, True), (-strength, False)):
        terms = (*value.numerator.terms(), *value.denominator.terms())
        letters = {Expr.generator(s) for s in value.symbols()}
        if letters <= signs and all(number > 0 for _, number in terms):
            return value, positive
    return None, False


def _sine_rate(name: str, n: str, k: str, let: tuple[str, ...]) -> tuple[SolutionLine, ...]:
    sine, square = (rf"\sin{power}\frac{{{name}}}{{2}}" for power in ("", "^2"))
    return (
        SolutionLine(
            "",
            rf"\left(\frac{{d}}{{dt}}{sine}\right)^2 = {n}^2 \left({k}^2 - {square}\right)"
            rf"\left(1 - {square}\right)",
            let=let,
        ),
    )


def _over_the_top(
    family: Pendulum, lowest: str, name: str, n: str, let: tuple[str, ...]
) -> Iterator[SolutionLine]:
    """The motion that reaches the highest point after an infinite time."""
    angle, rate = (Expr.generator(s).latex() for s in (family.angle, family.angle.derivative()))
    yield SolutionLine(
        "In between it approaches the highest point and never reaches it. With the time $t$ "
        f"counted from the passage of the lowest point, where ${rate} = 2 {n}$,",
        rf"\sin\frac{{{name}}}{{2}} = \tanh\left({n} t\right)",
        "separatrix",
        "launch",
        let=let,
        given=(f"{{{angle}}} = {lowest}", f"{{{rate}}} = 2 {n}"),
    )
