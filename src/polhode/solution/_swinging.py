"""A pendulum and a gyrocompass by elliptic functions, with every letter defined.

Whittaker, Analytical Dynamics, § 44.
"""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr, pi, sqrt
from polhode.analyse import Gyrocompass, Pendulum
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
    while_touching = "As long as everything touches, the" if equations.system.contacts else "The"
    yield SolutionLine(
        f"{while_touching} motion is that of a simple pendulum. {measured} obeys",
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
    yield from if_true(_over_the_top(family, bottom, name, (n, k), tuple(let[:-1])), equations)


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
    family: Pendulum, lowest: str, name: str, letters: tuple[str, str], let: tuple[str, ...]
) -> Iterator[SolutionLine]:
    """The motion that reaches the unstable equilibrium after an infinite time."""
    n, k = letters
    angle, rate = (Expr.generator(s).latex() for s in (family.angle, family.angle.derivative()))
    yield SolutionLine(
        f"In between, for ${k} = 1$, it approaches the unstable equilibrium and never reaches it. "
        f"With the time $t$ counted from the passage of the stable one, where ${rate} = 2 {n}$,",
        rf"\sin\frac{{{name}}}{{2}} = \tanh\left({n} t\right)",
        "separatrix",
        "launch",
        let=let,
        given=(f"{{{angle}}} = {lowest}", f"{{{rate}}} = 2 {n}"),
    )


# -- gyrocompass -----------------------------------------------------------------------------------


def gyrocompass(setting: Setting, family: Gyrocompass) -> Iterator[SolutionLine]:
    """A swing between two harmonics of its angle: constants, small swings, cn and its modulus."""
    equations = setting.equations
    if not family.parts["A"]:
        return
    theta, let = Expr.generator(family.angle).latex(), list[str]()
    rate = Expr.generator(family.angle.derivative()).latex()
    bend = rf"\ddot{{{theta}}}"
    first, second = family.parts.values()
    A = letter_latex(free_letter(equations, "A", "C", "p"))
    B = letter_latex(free_letter(equations, "B", "D", "q"))
    if family.shift:
        shifted = (Expr.generator(family.angle) + family.shift).latex()
        theta = letter_latex(free_letter(equations, "chi", "zeta"))
        let.append(definition(theta, shifted))
        yield SolutionLine(f"Let ${theta} = {shifted}$.")
    if family.spin is not None:
        n = free_letter(equations, "n", "nu", "N")
        first = -(family.push + family.drag * Expr.generator(n))
        let.append(definition(letter_latex(n), family.whole_spin.latex()))
        spin = Expr.generator(family.spin).latex()
        yield SolutionLine(
            f"The rate of ${spin}$ is that of a function of ${theta}$. Hence there is another "
            f"constant of the motion, which gives ${spin}$ in terms of ${theta}$:",
            f"{letter_latex(n)} = {family.whole_spin.latex()}",
            "whole_spin",
            "identity",
            let=tuple(let),
            stated=(SolutionLine("", rf"\frac{{d {letter_latex(n)}}}{{dt}} = 0", let=tuple(let)),),
        )
    words = f"The equation for ${theta}$ is{' then' if let else ''}"
    let += [definition(A, first.latex()), definition(B, second.latex())]
    yield SolutionLine(
        words,
        rf"{bend} = -{A} \sin {theta} + {B} \sin {theta} \cos {theta}",
        "compass",
        let=tuple(let),
    )
    frequency = sqrt(family.parts["A"] - second)
    yield SolutionLine(
        "with the constants",
        rf"{A} = {first.latex()}, \qquad {B} = {second.latex()}",
        "compass_constants",
        "identity",
        let=tuple(let),
        values=((rf"\frac{{2\pi}}{{\sqrt{{{A} - {B}}}}}", 2 * pi / frequency),),
    )
    yield SolutionLine(
        f"Let ${A} > 0$; otherwise measure ${theta}$ from the opposite direction. If ${A} > {B}$, "
        f"small swings about ${theta} = 0$ are harmonic, with the angular frequency "
        rf"$\sqrt{{{A} - {B}}}$.",
        stated=_small_swings(family, theta, f"{A} - {B}", tuple(let)),
    )
    yield from _swings_by_cn(setting, (theta, rate, A, B), let)


def _small_swings(
    family: Gyrocompass, theta: str, stiffness: str, let: tuple[str, ...]
) -> tuple[SolutionLine, ...]:
    """The linear equation, where the coordinate itself is small."""
    if family.shift:
        return ()
    linear = rf"\ddot{{{theta}}} \approx -\left({stiffness}\right) {theta}"
    return (SolutionLine("", linear, let=let, small=(f"{family.angle.published}:1",)),)


def _swings_by_cn(
    setting: Setting, letters: tuple[str, str, str, str], let: list[str]
) -> Iterator[SolutionLine]:
    """The energy, the equation for x = tan θ/2, and its solutions."""
    theta, rate, A, B = letters
    h, x, X, w, k = (
        letter_latex(free_letter(setting.equations, *names))
        for names in (
            ("eta", "h", "E_1"),
            ("x", "u", "zeta"),
            ("X", "U", "Z"),
            ("w", "W", "sigma"),
            ("k", "q", "xi"),
        )
    )
    energy = rf"\frac{{{rate}^2}}{{2}} - {A} \cos {theta} - \frac{{{B}}}{{2}} \sin^2 {theta}"
    let.append(definition(h, energy))
    yield SolutionLine(
        f"Multiply the equation for ${theta}$ by ${rate}$ and integrate. Constant is",
        f"{h} = {energy}",
        "compass_energy",
        "identity",
        let=tuple(let),
        stated=(SolutionLine("", rf"\frac{{d {h}}}{{dt}} = 0", let=tuple(let)),),
    )
    tangent = rf"\tan\frac{{{theta}}}{{2}}"
    let.append(definition(x, tangent))
    yield SolutionLine(
        rf"With ${x} = \tan({theta}/2)$ this becomes",
        rf"2 \dot{{{x}}}^2 = \left({h} - {A}\right) {x}^4 + 2 \left({h} + {B}\right) {x}^2 + {h} "
        f"+ {A}",
        "compass_quartic",
        let=tuple(let),
    )
    above = f"{w}^2 + {h} + {B}"
    squares = {
        w: rf"\sqrt{{{A}^2 + 2 {h} {B} + {B}^2}}",
        X: rf"\frac{{{above}}}{{{A} - {h}}}",
        k: rf"\frac{{{above}}}{{2 {w}^2}}",
    }
    named = (*let, *(definition(f"{name}^2", value) for name, value in squares.items()))
    yield SolutionLine(
        rf"For $-{A} < {h} < {A}$ the right side vanishes at ${x} = \pm {X}$ and at no other real "
        "value. Put",
        r", \qquad ".join(f"{name}^2 = {value}" for name, value in squares.items()),
        "compass_modulus",
        "identity",
        let=named,
    )
    yield SolutionLine(
        "and the equation takes the form that defines Jacobi's function cn,",
        rf"\dot{{{x}}}^2 = {w}^2 \left({X}^2 - {x}^2\right) \left(1 - {k}^2 + "
        rf"{k}^2 \frac{{{x}^2}}{{{X}^2}}\right)",
        "compass_cn",
        let=named,
    )
    yield SolutionLine(
        rf"Hence $\tan({theta}/2) = {X}\operatorname{{cn}}[{w}(t - t_0), {k}]$, with a constant "
        rf"$t_0$ given by the start. The greatest angle is $2\arctan {X}$ and the period "
        rf"$4 K({k})/{w}$, with the complete elliptic integral $K({k}) = "
        rf"\int_0^{{\pi/2}} d\chi/\sqrt{{1 - {k}^2\sin^2\chi}}$."
    )
    yield SolutionLine(
        rf"If ${B} > {A}$, ${h}$ may also be less than $-{A}$. Then ${k} > 1$, and with "
        rf"$\operatorname{{cn}}(u, {k}) = \operatorname{{dn}}({k} u, 1/{k})$ the angle stays on "
        rf"one side of zero. For ${h} > {A}$ and ${B} > -{A}$ it turns over and over. In "
        rf"between, at ${h} = {A}$, it approaches ${theta} = \pi$ and never reaches it: "
        rf"${x} = \sqrt{{{A}/({A} + {B})}}\,\sinh[\sqrt{{{A} + {B}}}\,(t - t_0)]$, "
        rf"because at ${h} = {A}$",
        rf"\dot{{{x}}}^2 = \left({A} + {B}\right) {x}^2 + {A}",
        "compass_separatrix",
        let=tuple(let),
        given=(
            rf"{{{rate}}} = 2 \cos\frac{{{theta}}}{{2}} "
            rf"\sqrt{{{A} + {B} \sin^2\frac{{{theta}}}{{2}}}}",
        ),
    )
