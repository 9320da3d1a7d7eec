"""Gibbs's and Appell's equations, from the energy of acceleration.

J. W. Gibbs, On the fundamental formulae of dynamics, American Journal of Mathematics 2 (1879) 49;
P. Appell, Journal für die reine und angewandte Mathematik 121 (1900) 310.
"""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ZERO, Expr, Symbol, Vector
from polhode.base import ConstraintError, NumericError
from polhode.model import Gravity
from polhode.solution._bodies import partial_products
from polhode.solution._judge import judged
from polhode.solution._lines import SolutionLine, inline, listed
from polhode.solution._setting import LONGEST, Setting, bound


def by_appell(setting: Setting) -> Iterator[SolutionLine]:
    """The energy of acceleration and its derivatives.

    Raises:
        ConstraintError: for loads besides gravity.
        NumericError: for an energy of acceleration too long to be printed.
    """
    equations = setting.equations
    if any(not isinstance(load, Gravity) for load in equations.system.loads):
        raise ConstraintError(
            f"the route appell for {equations.system.name!r}",
            expected="no load but gravity",
            advice="take another route, or none: the shortest is then found",
        )
    energy = _energy_of_acceleration(setting)
    text = energy.latex()
    if len(text) > LONGEST:
        raise NumericError(
            f"the energy of acceleration of {equations.system.name!r}, {len(text)} characters of "
            "LaTeX",
            expected=f"one of at most {LONGEST} characters, to be printed",
            advice="take another route, or none: the shortest is then found",
        )
    mass = setting.mass.latex() if setting.is_single else "m"
    yield SolutionLine(
        "Gibbs and Appell put accelerations in place of the velocities in the kinetic energy, "
        r"$S = \frac{1}{2}\int \ddot{\mathbf r}^2\,dm$. Forces of supports that do no work do not "
        "occur then, and constraints on velocities, such as rolling, need no multipliers. For a "
        rf"rigid body of mass ${mass}$, "
        rf"$S = \frac{{1}}{{2}}{mass} \dot{{\mathbf v}}_{{\rm cm}}^2 + "
        r"\frac{1}{2}\dot{\boldsymbol\omega}\cdot \mathsf I_{\rm cm}\dot{\boldsymbol\omega} + "
        r"\dot{\boldsymbol\omega}\cdot(\boldsymbol\omega\times\mathbf L_{\rm cm})$, with the "
        r"tensor of inertia $\mathsf I_{\rm cm}$, apart from terms without accelerations, which do "
        "not matter. Here",
        f"S = {text}",
        "appell",
        verdict=judged(_derivatives(setting, energy), equations),
    )
    yield from _equations(setting, energy)


def _energy_of_acceleration(setting: Setting) -> Expr:
    """S without the terms that contain no acceleration, J/s²."""
    total = ZERO
    for one in setting.each:
        rate, bend = one.rate(one.velocity), one.rate(one.angular_velocity)
        moment = one.rate(one.spin)
        turned = _of_inertia(one, bend)
        total = total + rate.dot(rate) * one.mass / 2 + bend.dot(moment) - bend.dot(turned) / 2
    resting = {speed.derivative(): ZERO for speed in setting.equations.speeds}
    return total - total.subs(resting)


def _of_inertia(setting: Setting, vector: Vector) -> Vector:
    """The tensor of inertia applied to a vector."""
    components = vector.express(setting.axes).components
    rows = setting.body.inertia.rows
    return Vector(
        tuple(sum((a * b for a, b in zip(row, components, strict=True)), ZERO) for row in rows),
        setting.axes,
    )


def _derivatives(setting: Setting, energy: Expr) -> SolutionLine:
    """That ∂S/∂u̇ is the product of the laws with the partial velocities, for every speed."""
    claims = [
        f"{products} = {_slope(energy, speed).latex()}"
        for speed in setting.equations.speeds
        if (products := partial_products(setting, speed))
    ]
    let = tuple(definition for one in setting.each for definition in one.let)
    return bound(setting, SolutionLine("", r", \qquad ".join(claims), let=let))


def _slope(energy: Expr, speed: Symbol) -> Expr:
    return energy.diff(speed.derivative())


def _equations(setting: Setting, energy: Expr) -> Iterator[SolutionLine]:
    """∂S/∂u̇ = Q for every speed."""
    speeds = setting.equations.speeds
    names = listed(inline(speed) for speed in speeds)
    power = "the power of the weight when $u$ is 1 and all other speeds are zero"
    if setting.gravity is None:
        power = "zero, since no load acts"
    words = (
        r"Appell's equations say that $\partial S/\partial \dot u = Q_u$ for each of the speeds "
        f"$u$, which are {names}; $Q_u$ is {power}:"
    )
    for speed in speeds:
        force = ZERO
        for one in setting.each:
            force = force + one.weight.dot(one.velocity.diff(Expr.generator(speed)))
        text = f"{_slope(energy, speed).latex()} = {force.latex()}"
        if len(text) <= LONGEST:
            yield SolutionLine(words, text, f"appell_{speed.published}")
        else:
            yield SolutionLine(
                f"{words} The equation for {inline(speed)} has no short form.".strip()
            )
        words = ""
