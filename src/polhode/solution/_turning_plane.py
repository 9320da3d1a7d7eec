"""The plane of an oscillation that turns, as of Foucault's pendulum."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, Vector, is_positive, sqrt
from polhode.solution._lines import SolutionLine, inline
from polhode.solution._setting import Setting


@dataclass(frozen=True)
class _Oscillation:
    """One of two coupled oscillations, ẍ + k x + c ẏ + ... = 0.

    Attributes:
        stiffness: k, 1/s².
        coupling: c, 1/s, of the first order in the rotation of the axes.
        row: the left-hand side times the inertia, with a constant of the second order.
    """

    stiffness: Expr
    coupling: Expr
    row: Expr


def turning_plane(setting: Setting, angles: tuple[Symbol, ...]) -> Iterator[SolutionLine]:
    """Two equal oscillations coupled by the rotation of the ground, whose plane turns at some rate.

    To first order in the rotation the pair x, y obeys ẍ + k x + 2 n ẏ = 0, ÿ + k y - 2 n ẋ = 0. In
    axes that turn at the rate n from x to y, the terms with velocities drop out.
    """
    spin = _rotation(setting)
    motion = setting.equations.motion
    if spin is None or setting.up is None or len(angles) != 2 or len(motion) != 2:
        return
    found = [_oscillation(motion[i], angles, i, spin) for i in (0, 1)]
    first, second = found
    if first is None or second is None:
        return
    equal = first.stiffness == second.stiffness and is_positive(first.stiffness)
    if not equal or first.coupling + second.coupling:
        return
    x, y = map(inline, angles)
    small = tuple(f"{s.published}:1" for s in (*angles, spin))
    words = f"For small {x} and {y}, and {inline(spin)} small too, to second order,"
    for i, one in enumerate((first, second)):
        latex = rf"{one.row.latex()} \approx 0"
        yield SolutionLine("" if i else words, latex, f"earth_{i}", "limit", small=small)
    rate = first.coupling / 2
    root = setting.axes.root
    vertical = Vector(root.turned, root).dot(setting.up)
    meaning = ", opposite to the vertical part of the Earth's rotation" if rate == -vertical else ""
    yield SolutionLine(
        f"A constant term only shifts the place of rest. Draw {x} and {y}, less this shift, along "
        "two perpendicular axes, and turn the axes from the first towards the second at the rate "
        f"{inline(rate)}{meaning}: in these axes the terms with velocities drop out, to first "
        f"order in {inline(spin)}, and both components oscillate at the angular frequency "
        f"{inline(sqrt(first.stiffness))}. So the plane of the oscillation turns at this rate."
    )


def _rotation(setting: Setting) -> Symbol | None:
    """The one symbol without which the ground does not turn, such as Ω of the Earth."""
    turned = setting.axes.root.turned
    symbols = {s for rate in turned for s in rate.symbols()}
    spins = [s for s in symbols if all(rate.subs({s: ZERO}).is_zero for rate in turned)]
    return spins[0] if len(spins) == 1 else None


def _oscillation(
    row: Expr, angles: tuple[Symbol, ...], i: int, spin: Symbol
) -> _Oscillation | None:
    """An equation of motion to first order in the angles, if it is that of such an oscillation."""
    rates = [q.derivative() for q in angles]
    bends = [rate.derivative() for rate in rates]
    moving = (*angles, *rates, *bends)
    rest = dict.fromkeys(moving, ZERO)
    still = {spin: ZERO}
    shift = row.subs(rest)
    slopes = {s: row.diff(s).subs(rest) for s in moving}
    plain = {s: slope.subs(still) for s, slope in slopes.items()}
    turning = {s: slope.diff(spin).subs(still) for s, slope in slopes.items()}
    inertia, other = plain[bends[i]], rates[1 - i]
    is_other = (
        not inertia
        or shift.subs(still)
        or shift.diff(spin).subs(still)
        or any(one for s, one in plain.items() if s not in (bends[i], angles[i]))
        or any(one for s, one in turning.items() if s != other)
    )
    if is_other:
        return None
    omega = Expr.generator(spin)
    constant = shift.diff(spin).diff(spin).subs(still) / 2 * omega**2
    terms = (Expr.generator(s) * (plain[s] + omega * turning[s]) for s in moving)
    coupling = turning[other] * omega / inertia
    return _Oscillation(plain[angles[i]] / inertia, coupling, sum(terms, start=constant))
