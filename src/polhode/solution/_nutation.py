"""The nutation of a symmetric top by Jacobi's functions, and of a coin by an integral.

Whittaker, Analytical Dynamics, § 71.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ONE, Expr, cos, is_positive
from polhode.analyse import HeavyTop, SpinningCoin
from polhode.solution._letters import definition, free_letter, letter_latex
from polhode.solution._lines import SolutionLine, bracketed
from polhode.solution._setting import Setting


@dataclass(frozen=True)
class _NutationLetters:
    """LaTeX of the angles and of the letters introduced.

    Attributes:
        theta, phi: of the axis.
        a, b, h: the constants: momenta about the vertical and the axis, and the energy.
        mu: strength of gravity, where its sign is known counted positive.
        sign: of the term with it in the energy: - where the centre of mass hangs below.
        height: what gravity multiplies: cos θ for a top, sin θ for a coin on a table.
        inertia: factor of θ̇² in the energy; empty where it is 1.
        u: cos θ.
        spin: κ n, the momentum about the axis; empty where there is none.
        weight: value of μ; empty without gravity.
    """

    theta: str
    phi: str
    a: str
    b: str
    h: str
    mu: str
    height: str
    inertia: str
    u: str
    spin: str
    weight: str
    sign: str = "+"

    @property
    def constants(self) -> dict[str, str]:
        """The constants by their letters."""
        theta, phi = self.theta, self.phi
        about = rf"\dot{{{phi}}} \sin^2{theta}" + (rf" + {self.b} \cos{theta}" if self.spin else "")
        energy = rf"{self.inertia}\dot{{{theta}}}^2 + \dot{{{phi}}}^2 \sin^2{theta}"
        energy += rf" {self.sign} 2 {self.mu} {self.height}" if self.weight else ""
        spin = {self.b: self.spin} if self.spin else {}
        return {**spin, self.a: about, self.h: energy}

    @property
    def let(self) -> tuple[str, ...]:
        """Definitions of all letters but u."""
        weight = {self.mu: self.weight} if self.weight else {}
        defined = {**weight, **self.constants}
        return tuple(definition(name, value) for name, value in defined.items())

    def momentum(self, cosine: str) -> str:
        """α - β cos θ."""
        return f"{self.a} - {self.b} {cosine}" if self.spin else self.a

    def less_weight(self, height: str) -> str:
        """What the potential energy at a height takes from the energy; empty without gravity."""
        return f" {'-' if self.sign == '+' else '+'} 2 {self.mu} {height}" if self.weight else ""

    @property
    def polynomial(self) -> str:
        """The polynomial f(u) that is u̇²."""
        height = self.less_weight(self.u)
        level = rf"\left({self.h}{height}\right)" if height else self.h
        momentum = self.momentum(self.u)
        square = rf"\left({momentum}\right)^2" if self.spin else f"{self.a}^2"
        return rf"\left(1 - {self.u}^2\right) {level} - {square}"


def nutation(setting: Setting, family: HeavyTop) -> Iterator[SolutionLine]:
    """The constants, the cubic and its roots, cos θ by sn, the precession and its patterns."""
    x = _letters(setting, family, rf"\cos{Expr.generator(family.axle.theta).latex()}")
    yield _constants(x)
    let = (*x.let, definition(x.u, rf"\cos{x.theta}"))
    where = f"where ${x.mu} = {x.weight}$. " if x.weight else ""
    yield SolutionLine(
        rf"{where}With ${x.u} = \cos{x.theta}$ they leave an equation of one dimension,",
        rf"\dot{{{x.u}}}^2 = {x.polynomial}",
        "top_rate",
        let=let,
    )
    yield SolutionLine(
        f"and the precession follows from the moment{'a' if x.spin else 'um'},",
        rf"\dot{{{x.phi}}} = \frac{{{x.momentum(x.u)}}}{{1 - {x.u}^2}}",
        "top_precession",
        let=let,
    )
    if x.weight:
        yield _by_jacobi(setting, x)
    if x.spin:
        yield _patterns(x)


def coin(setting: Setting, family: SpinningCoin) -> Iterator[SolutionLine]:
    """The constants, the integral that gives the time, and why it has no shorter form."""
    theta = Expr.generator(family.axle.theta)
    inertia = ONE + family.lift * cos(theta) ** 2
    x = _letters(setting, family, rf"\sin{theta.latex()}", rf"\left({inertia.latex()}\right) ")
    yield _constants(x)
    height = x.less_weight(x.height)
    momentum = x.momentum(rf"\cos{x.theta}")
    level = rf"{x.h}{height} - \frac{{\left({momentum}\right)^2}}{{\sin^2{x.theta}}}"
    where = f"where ${x.mu} = {x.weight}$. " if x.weight else ""
    yield SolutionLine(
        f"{where}They leave an equation of one dimension,",
        rf"{x.inertia}\dot{{{x.theta}}}^2 = {level}",
        "coin_rate",
        let=x.let,
    )
    yield SolutionLine(
        f"and the precession follows from the moment{'a' if x.spin else 'um'},",
        rf"\dot{{{x.phi}}} = \frac{{{momentum}}}{{\sin^2{x.theta}}}",
        "coin_precession",
        let=x.let,
    )
    low, high = (f"{x.theta}_{i}" for i in (1, 2))
    bounds = rf"\pm {x.b}" if x.spin else "0"
    integrand = rf"\sqrt{{\frac{{{inertia.latex()}}}{{{level}}}}}\,d{x.theta}"
    yield SolutionLine(
        f"Unless ${x.a} = {bounds}$, when the axis may reach the vertical, "
        f"${x.theta}$ goes to and fro between angles ${low}$ and ${high}$ at which the right side "
        "of [[coin_rate]] vanishes. Separate the variables: the time from one to the other is "
        rf"$\int_{{{low}}}^{{{high}}} {integrand}$, and the period twice that. Up to ${x.theta}$ "
        rf"instead of ${high}$ the integral gives the time as a function of ${x.theta}$, and with "
        rf"$\dot{{{x.phi}}}$ under it the azimuth."
    )
    yield from _why_no_shorter_form(setting, x, family)


def _why_no_shorter_form(
    setting: Setting, x: _NutationLetters, family: SpinningCoin
) -> Iterator[SolutionLine]:
    """The degree of the polynomial under the root."""
    if not x.weight:
        yield SolutionLine(
            rf"In terms of $\cos{x.theta}$ it contains the root of a polynomial of the fourth "
            "degree: it is an elliptic integral."
        )
        return
    s = letter_latex(free_letter(setting.equations, "xi", "zeta", "s"))
    plus, minus = rf"\left(1 + {s}^2\right)", rf"\left(1 - {s}^2\right)"
    momentum = f"{x.a} {plus} - {x.b} {minus}" if x.spin else f"{x.a} {plus}"
    lift = bracketed(family.lift.latex())
    weight = rf"16 {x.mu} {s}^3"
    yield SolutionLine(
        f"There is no shorter form in general. With ${s} = \\tan({x.theta}/2)$ the equation "
        "becomes",
        rf"16 {s}^2 \left({plus}^2 + {lift} {minus}^2\right) \dot{{{s}}}^2 = {plus}^3 "
        rf"\left(4 {x.h} {s}^2 {plus} - {weight} - {plus} \left({momentum}\right)^2\right)",
        "coin_hyperelliptic",
        let=(*x.let, definition(s, rf"\tan\frac{{{x.theta}}}{{2}}")),
    )
    yield SolutionLine(
        rf"so that $dt/d{s}$ is a rational function of ${s}$ times the root of a polynomial of the "
        "twelfth degree. Its integral is hyperelliptic, in general neither elementary nor "
        "elliptic, and has to be evaluated numerically."
    )


def _constants(x: _NutationLetters) -> SolutionLine:
    """The momenta and the energy."""
    names = ["the momenta about the vertical and about the axis", "the energy"]
    if not x.spin:
        names[0] = "the momentum about the vertical"
    return SolutionLine(
        f"Constant along the motion are, up to factors, {' and '.join(names)}:",
        r", \qquad ".join(f"{name} = {value}" for name, value in x.constants.items()),
        "top_constants",
        "identity",
        let=x.let,
        stated=tuple(
            SolutionLine("", rf"\frac{{d {name}}}{{dt}} = 0", let=x.let) for name in x.constants
        ),
    )


def _letters(
    setting: Setting, family: HeavyTop | SpinningCoin, height: str, inertia: str = ""
) -> _NutationLetters:
    equations, axle = setting.equations, family.axle
    hangs = isinstance(family, HeavyTop) and is_positive(-family.weight)

    def letter(*names: str) -> str:
        return letter_latex(free_letter(equations, *names))

    return _NutationLetters(
        Expr.generator(axle.theta).latex(),
        Expr.generator(axle.phi).latex(),
        letter("alpha", "p_1", "A_1"),
        letter("beta", "p_2", "B_1"),
        letter("eta", "h", "E_1"),
        letter("mu", "nu", "sigma"),
        height,
        inertia,
        letter("u", "U", "s"),
        (axle.ratio * axle.n).latex() if axle.spin else "",
        (-family.weight if hangs else family.weight).latex() if family.weight else "",
        "-" if hangs else "+",
    )


def _by_jacobi(setting: Setting, x: _NutationLetters) -> SolutionLine:
    """cos θ between two roots of the cubic."""
    equations = setting.equations
    w = letter_latex(free_letter(equations, "w", "W", "nu"))
    k = letter_latex(free_letter(equations, "k", "q", "xi"))
    u, mu, hangs = x.u, x.mu, x.sign == "-"
    roots = [f"{u}_{i}" for i in (1, 2, 3)]
    low, high, far = reversed(roots) if hangs else roots
    upper, lower = (low, far) if hangs else (far, low)
    between = f"{low} - ({low} - {high})" if hangs else f"{low} + ({high} - {low})"
    part = f"{low} - {high}" if hangs else f"{high} - {low}"
    rate = rf"\frac{{{mu}}}{{2}}\left({upper} - {lower}\right)"
    start = f"Call the polynomial on the right $f({u})$"
    if not hangs:
        start += f" and let ${mu} > 0$; otherwise measure the angle from the opposite direction"
    end = "first of them not greater than $-1$" if hangs else "last of them not less than 1"
    return SolutionLine(
        f"{start}. $f$ is not positive at ${u} = \\pm 1$ and grows beyond all bounds with "
        f"${'-' if hangs else ''}{u}$, so that it has three real roots ${roots[0]} \\le {roots[1]} "
        f"\\le {roots[2]}$, the {end}. The axis nods between the angles at which "
        rf"$\cos{x.theta}$ is ${low}$ and ${high}$. With ${u} = {between} s^2$ the "
        rf"equation becomes $\dot s^2 = {w}^2(1 - s^2)(1 - {k}^2 s^2)$, where ${w}^2 = {rate}$ and "
        rf"${k}^2 = \frac{{{part}}}{{{upper} - {lower}}}$, and this equation defines Jacobi's "
        rf"function sn: $\cos{x.theta} = {between}\operatorname{{sn}}^2[{w}(t - t_0), {k}]$, "
        rf"with a constant $t_0$ given by the start. The period of the nutation is $2 K({k})/{w}$, "
        rf"with the complete elliptic integral $K({k}) = \int_0^{{\pi/2}} d\chi/\sqrt{{1 - "
        rf"{k}^2\sin^2\chi}}$."
    )


def _patterns(x: _NutationLetters) -> SolutionLine:
    u, ratio = x.u, f"{x.a}/{x.b}"
    turns = [f"{u}_{i}" for i in ((2, 3) if x.sign == "-" else (1, 2))]
    if not x.weight:
        return SolutionLine(
            rf"The right side is quadratic in ${u}$, so that ${u}$ oscillates harmonically about a "
            "mean: without gravity the axis runs round a cone about the fixed angular momentum."
        )
    return SolutionLine(
        f"The precession stops where ${u} = {ratio}$. If this lies outside the range of ${u}$, the "
        rf"axis draws waves and $\dot{{{x.phi}}}$ keeps its sign; if it lies between "
        f"${turns[0]}$ and ${turns[1]}$, loops, with motion backwards at one end; and if it is one "
        "of them, cusps, as when the axis is released at rest.",
    )
