"""Derivations made up by rules of algebra that polhode has no part in, with or without a slip.

Each is a chain of equations in SymPy's symbols. A slip changes one term of one of them, and every
later line is worked out from it as it stands, as an author would. What a line says is never judged
here: a later line counts as wrong where it differs from the same line of the chain without a slip.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, partial
from random import Random

import sympy as sp

import polhode as ph
from polhode.catalogue import PROBLEM_SET

NAMES: dict[sp.Symbol, str] = {}
_VARYING: list[Quantity] = []


def letter(name: str, latex: str) -> sp.Symbol:
    """A symbol that is printed in this way."""
    found = sp.Symbol(name)
    NAMES[found] = latex
    return found


m, a, g, l, k, alpha, Omega = (
    letter("m", "m"),
    letter("a", "a"),
    letter("g", "g"),
    letter("l", "l"),
    letter("k", "k"),
    letter("alpha", r"\alpha"),
    letter("Omega", r"\Omega"),
)
mu = letter("mu", r"\mu")
inertia, i1, i2, i3 = (
    letter("I", "I"),
    letter("I1", "I_1"),
    letter("I2", "I_2"),
    letter("I3", "I_3"),
)


@dataclass(frozen=True)
class Quantity:
    """A quantity that varies, with its first two rates."""

    value: sp.Symbol
    rate: sp.Symbol
    second: sp.Symbol


def quantity(name: str, latex: str, second: str = "") -> Quantity:
    """A coordinate; its rates have dots."""
    return _varying(
        letter(name, latex),
        letter(f"{name}_d", rf"\dot{{{latex}}}"),
        letter(f"{name}_dd", second or rf"\ddot{{{latex}}}"),
    )


def _varying(*symbols: sp.Symbol) -> Quantity:
    _VARYING.append(Quantity(*symbols))
    return _VARYING[-1]


theta, phi, psi = (
    quantity("theta", r"\theta"),
    quantity("phi", r"\phi"),
    quantity("psi", r"\psi"),
)
x, y = quantity("x", "x"), quantity("y", "y")


def speed(name: str, latex: str) -> Quantity:
    """A speed; its rate has a dot."""
    return _varying(
        letter(name, latex), letter(f"{name}_d", rf"\dot{{{latex}}}"), letter(f"{name}_dd", "")
    )


w1, w2, w3, wx, wy = (
    speed("w1", r"\omega_1"),
    speed("w2", r"\omega_2"),
    speed("w3", r"\omega_3"),
    speed("wx", r"\omega_x"),
    speed("wy", r"\omega_y"),
)
vx, vy = speed("vx", "v_x"), speed("vy", "v_y")


def rate(expression: sp.Expr) -> sp.Expr:
    """The time derivative."""
    found = sum(
        sp.diff(expression, q.value) * q.rate + sp.diff(expression, q.rate) * q.second
        for q in _VARYING
    )
    return sp.expand(found)


Side = sp.Expr | sp.ImmutableMatrix
Slip = Callable[[sp.Expr], sp.Expr]


@dataclass
class Chain:
    """The lines of one derivation, worked out in order.

    Attributes:
        slip: changes the right side of line `at`, or None.
        at: the line with the slip; -1 for none.
        place: of the component that it changes, from 0 to 1, where that line is one of vectors.
        lines: left and right sides so far.
        words: what stands before lines, by their number.
        laws: numbers of lines that are laws and take no slip.
    """

    slip: Slip | None = None
    at: int = -1
    place: float = 0.0
    lines: list[tuple[str, Side]] = field(default_factory=list)
    words: dict[int, str] = field(default_factory=dict)
    laws: set[int] = field(default_factory=set)
    axes: dict[int, tuple[str, str, str]] = field(default_factory=dict)

    def say(self, words: str) -> None:
        """Put words before the next line."""
        self.words[len(self.lines)] = words

    def law(self, left: str, right: sp.Expr | str) -> None:
        """Write a line that takes no slip, since nothing is worked out in it."""
        self.laws.add(len(self.lines))
        self.lines.append((left, right if isinstance(right, sp.Expr) else letter(right, right)))

    def line(self, left: str | sp.Symbol, right: sp.Expr) -> sp.Expr:
        """Write a line; returns its right side as it stands on the page."""
        right = sp.expand(right)
        if len(self.lines) == self.at and self.slip is not None:
            right = self.slip(right)
        self.lines.append((left if isinstance(left, str) else NAMES[left], right))
        return right

    def vector(
        self, left: str, right: sp.Matrix, axes: tuple[str, str, str] = ("1", "2", "3")
    ) -> sp.Matrix:
        """Write a line that gives a vector by its components along axes."""
        right = sp.ImmutableMatrix(right).applyfunc(sp.expand)
        if len(self.lines) == self.at and self.slip is not None:
            places = [i for i in range(3) if right[i] != 0]
            spoilt = places[int(self.place * len(places))] if places else 0
            rows = [self.slip(right[i]) if i == spoilt else right[i] for i in range(3)]
            right = sp.ImmutableMatrix(rows)
        self.axes[len(self.lines)] = axes
        self.lines.append((left, right))
        return right

    def printed(self, place: int) -> str:
        """The right side of a line as LaTeX."""
        right = self.lines[place][1]
        if not isinstance(right, sp.MatrixBase):
            return sp.latex(right, symbol_names=NAMES)
        terms = [
            rf"\left({sp.latex(value, symbol_names=NAMES)}\right) {_UNIT[axis]}"
            for value, axis in zip(right, self.axes[place], strict=True)
            if value != 0
        ]
        return " + ".join(terms) or "0"


_UNIT = {
    **{axis: rf"\hat{{\mathbf {axis}}}" for axis in "123xyz"},
    "rho": r"\hat{\boldsymbol\rho}",
    "phi": r"\hat{\boldsymbol\phi}",
}


# -- chains ----------------------------------------------------------------------------------------


def energy_on_slope(chain: Chain, share: sp.Rational) -> None:
    """Energy of what rolls down a slope, y downwards: Iω²/2 with I = share·ma²."""
    moment = chain.line("I", share * m * a**2)
    spin = chain.line(wx.value, -y.rate / a)
    law = chain.line("T", m * y.rate**2 / 2 + inertia * wx.value**2 / 2)
    kinetic = chain.line("T", law.subs({inertia: moment, wx.value: spin}))
    energy = chain.line("E", kinetic - m * g * y.value * sp.sin(alpha))
    change = sp.expand(rate(energy) / y.rate)
    left = change.coeff(y.second) * y.second
    pull = chain.line(sp.latex(left, symbol_names=NAMES), -(change - left))
    fall = chain.line(y.second, sp.solve(left - pull, y.second)[0])
    chain.line("F_y", m * fall - m * g * sp.sin(alpha))


def forces_on_slope(chain: Chain, share: sp.Rational) -> None:
    """Newton's and Euler's equations of the same."""
    force = letter("Fy", "F_y")
    moment = chain.line("I", share * m * a**2)
    turning = chain.line(wx.rate, -y.second / a)
    torque = chain.line(r"I\dot\omega_x", a * force)
    friction = chain.line("F_y", sp.solve(moment * turning - torque, force)[0])
    fall = chain.line(r"m\ddot y", m * g * sp.sin(alpha) + friction)
    found = sp.solve(m * y.second - fall, y.second)[0]
    fall = chain.line(y.second, found)
    chain.line("F_y", friction.subs(y.second, fall))


def top_energy(chain: Chain, share: sp.Rational) -> None:
    """A heavy top: energies, Lagrangian, momenta and the equation for its nodding."""
    spin = psi.rate + phi.rate * sp.cos(theta.value)
    turning = theta.rate**2 + phi.rate**2 * sp.sin(theta.value) ** 2
    kinetic = chain.line("T", (i1 + mu * l**2) * turning / 2 + i3 * spin**2 / 2)
    potential = chain.line("V", mu * g * l * sp.cos(theta.value))
    chain.line("E", kinetic + potential)
    lagrangian = chain.line(r"\mathcal{L}", kinetic - potential)
    chain.line(r"p_\phi", sp.diff(lagrangian, phi.rate))
    chain.line(r"p_\psi", sp.diff(lagrangian, psi.rate))
    momentum = sp.diff(lagrangian, theta.rate)
    change = rate(momentum)
    chain.line(sp.latex(sp.factor(change), symbol_names=NAMES), sp.diff(lagrangian, theta.value))


def disk_energy(chain: Chain, share: sp.Rational) -> None:
    """Energies of a rolling disk."""
    moment = chain.line("I_1", m * a**2 / 4)
    axial = chain.line("I_3", m * a**2 / 2)
    travel = chain.line("v^2", a**2 * (w3.value**2 + theta.rate**2))
    turning = theta.rate**2 + phi.rate**2 * sp.sin(theta.value) ** 2
    kinetic = chain.line("T", m * travel / 2 + moment * turning / 2 + axial * w3.value**2 / 2)
    potential = chain.line("V", m * g * a * sp.sin(theta.value))
    chain.line("E", kinetic + potential)
    chain.line(r"\mathcal{L}", kinetic - potential)


def marble(chain: Chain, share: sp.Rational) -> None:
    """A marble on a turntable, from the rolling condition to the acceleration."""
    turn = chain.line(wy.value, (vx.value + Omega * y.value) / a)
    change = rate(turn).subs(y.rate, vy.value)
    change = chain.line(wy.rate, change)
    force = chain.line("F_x", -inertia * change / a)
    push = chain.line(r"m\dot v_x", force)
    found = sp.solve(m * vx.rate - push, vx.rate)[0]
    found = chain.line(vx.rate, sp.factor(found))
    chain.line("F_x", m * found)


def pendulum(chain: Chain, share: sp.Rational) -> None:
    """A rod that swings about its end."""
    moment = chain.line("I_O", m * l**2 / 3)
    kinetic = chain.line("T", moment * theta.rate**2 / 2)
    potential = chain.line("V", -m * g * l * sp.cos(theta.value) / 2)
    energy = chain.line("E", kinetic + potential)
    change = sp.expand(rate(energy) / theta.rate)
    left = change.coeff(theta.second) * theta.second
    torque = chain.line(sp.latex(left, symbol_names=NAMES), -(change - left))
    chain.line(theta.second, sp.solve(left - torque, theta.second)[0])


def racquet(chain: Chain, share: sp.Rational) -> None:
    """Euler's equations of a free body, the energy and its rate."""
    first = chain.line(w1.rate, (i2 - i3) / i1 * w2.value * w3.value)
    second = chain.line(w2.rate, (i3 - i1) / i2 * w3.value * w1.value)
    kinetic = chain.line("T", (i1 * w1.value**2 + i2 * w2.value**2 + i3 * w3.value**2) / 2)
    chain.line("L^2", i1**2 * w1.value**2 + i2**2 * w2.value**2 + i3**2 * w3.value**2)
    chain.line(r"I_1\omega_1\dot\omega_1", i1 * w1.value * first)
    power = chain.lines[-1][1]
    chain.line(r"I_1\omega_1\dot\omega_1 + I_2\omega_2\dot\omega_2", power + i2 * w2.value * second)
    chain.line("2 T", 2 * kinetic)


# -- systems ---------------------------------------------------------------------------------------


def _slope(share: sp.Rational) -> ph.System:
    mass, radius, gravity = ph.symbols("m a g", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))
    moment = mass * radius**2 * ph.Expr.of(int(share.p)) / int(share.q)
    body = ph.Body(
        "wheel",
        mass=mass,
        inertia=(moment, moment, moment),
        axes=slope.axes,
        surface=ph.Round(radius),
        spin=ph.About("x", "beta"),
    )
    return ph.System(
        ph.Rolling(body, on=slope, name="ground"),
        ph.Hinge(body, axis="x"),
        ph.Gravity(gravity),
        name="what rolls down a slope",
    )


def _top() -> ph.System:
    mass, length, gravity, first, third = ph.symbols("mu l g I_1 I_3", positive=True)
    f, t, p = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(f, "z").rotated(t, "x").rotated(p, "z", labels="1 2 3")
    body = ph.Body("top", mass=mass, inertia=(first, first, third), axes=axes)
    return ph.System(ph.Pivot(body, at=axes["3"] * -length), ph.Gravity(gravity), name="heavy top")


def _rod() -> ph.System:
    mass, length, gravity = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "x")
    rod = ph.rod("rod", mass=mass, length=length, axes=axes, axis="z")
    return ph.System(
        ph.Pivot(rod, at=axes["z"] * (length / 2), name="O"), ph.Gravity(gravity), name="rod"
    )


@dataclass(frozen=True)
class Family:
    """A kind of derivation.

    Attributes:
        name: of the kind.
        chain: writes it.
        system: that it is about, by the share of ma² in the moment of inertia.
        shares: of which one is drawn.
    """

    name: str
    chain: Callable[[Chain, sp.Rational], None]
    system: Callable[[sp.Rational], ph.System]
    shares: tuple[sp.Rational, ...] = (sp.Rational(1),)


_ROUND = (sp.Rational(1, 2), sp.Rational(2, 5), sp.Rational(2, 3), sp.Rational(1))


def by_name(*kinds: Family) -> dict[str, Family]:
    """Kinds of derivations by their names."""
    return {kind.name: kind for kind in kinds}


@cache
def catalogue(name: str) -> ph.System:
    """A system of the catalogue."""
    return PROBLEM_SET[name].build()


def about(name: str) -> Callable[[sp.Rational], ph.System]:
    """A system of the catalogue, whatever the share."""
    return partial(_whatever, name)


def _whatever(name: str, share: sp.Rational) -> ph.System:
    return catalogue(name)


FAMILIES = by_name(
    Family("energy on a slope", energy_on_slope, _slope, _ROUND),
    Family("forces on a slope", forces_on_slope, _slope, _ROUND),
    Family("heavy top", top_energy, lambda share: _top()),
    Family("rolling disk", disk_energy, about("rolling-disk")),
    Family("marble", marble, about("marble-on-turntable")),
    Family("rod", pendulum, lambda share: _rod()),
    Family("racquet", racquet, about("tennis-racquet")),
)


@cache
def equations(kind: Family, share: sp.Rational) -> ph.Equations:
    """The equations of motion of the system that derivations of a kind are about."""
    return ph.derive(kind.system(share))


# -- slips -----------------------------------------------------------------------------------------


def slips(random: Random) -> Iterator[Slip]:
    """Ways to spoil one term of a sum, in random order."""

    def on_term(change: Callable[[sp.Expr], sp.Expr]) -> Callable[[sp.Expr], sp.Expr]:
        place = random.random()

        def spoilt(right: sp.Expr) -> sp.Expr:
            terms = sp.Add.make_args(right)
            chosen = terms[int(place * len(terms))]
            return sp.expand(right - chosen + change(chosen))

        return spoilt

    changes: list[Callable[[sp.Expr], sp.Expr]] = [
        lambda term: -term,
        lambda term: 2 * term,
        lambda term: term / 2,
        lambda term: sp.Rational(2, 3) * term,
        lambda term: sp.Integer(0),
        lambda term: term.subs(
            {sp.sin(alpha): sp.cos(alpha), sp.sin(theta.value): sp.cos(theta.value)}
        ),
    ]
    random.shuffle(changes)
    yield from map(on_term, changes)


@dataclass(frozen=True)
class Derivation:
    """A derivation as a text.

    Attributes:
        kind: of derivation.
        share: of ma² in the moment of inertia.
        text: LaTeX, one display for each line.
        slip: the line that is wrong by itself; None for none.
        changed: lines that differ from those without a slip.
        format: of the text, if it is not LaTeX.
    """

    kind: Family
    share: sp.Rational
    text: str
    slip: int | None
    changed: tuple[int, ...]
    format: str = ".tex"

    @property
    def equations(self) -> ph.Equations:
        """Of its system."""
        return equations(self.kind, self.share)


_WORDS = ("We have", "Hence", "This gives", "Then", "It follows that", "Next,", "Now", "Thus")


def _differ(one: Side, other: Side) -> bool:
    if isinstance(one, sp.MatrixBase) and isinstance(other, sp.MatrixBase):
        return any(sp.simplify(entry) != 0 for entry in one - other)
    return sp.simplify(one - other) != 0


def derivation(
    seed: int, *, with_slip: bool, families: Mapping[str, Family] = FAMILIES
) -> Derivation:
    """A derivation drawn at random; equal seeds give equal ones."""
    random = Random(seed)
    family = random.choice(sorted(families))
    kind = families[family]
    share = random.choice(kind.shares)
    right = Chain()
    kind.chain(right, share)
    if not with_slip:
        return Derivation(kind, share, _text(right, random), None, ())
    at = random.choice([i for i in range(len(right.lines)) if i not in right.laws])
    place = random.random()
    for slip in slips(random):
        spoilt = Chain(slip, at, place)
        try:
            kind.chain(spoilt, share)
        except (IndexError, ZeroDivisionError):
            continue  # the equation that was left could not be solved
        if any(not _is_printed(value) for _, value in spoilt.lines):
            continue
        changed = tuple(
            i
            for i, (one, other) in enumerate(zip(right.lines, spoilt.lines, strict=True))
            if one[0] != other[0] or _differ(one[1], other[1])
        )
        if changed and changed[0] == at:
            return Derivation(kind, share, _text(spoilt, random), at, changed)
    return derivation(seed + 1_000_000, with_slip=True, families=families)


def _is_printed(value: Side) -> bool:
    if isinstance(value, sp.MatrixBase):
        return all(_is_printed(entry) for entry in value)
    return value.is_finite is not False and not value.has(sp.zoo, sp.nan)


def _text(chain: Chain, random: Random) -> str:
    lines = []
    for place, (left, _) in enumerate(chain.lines):
        words = random.choice(_WORDS)
        lines.append(chain.words.get(place, words))
        lines.append(rf"\[ {left} = {chain.printed(place)} . \]")
    return "\n".join(lines)


def shortened(made: Derivation, seed: int) -> Derivation:
    """A derivation whose author leaves two lines of five out, but not the one with the slip."""
    random = Random(seed)
    rows = made.text.split("\n")
    pairs = ["\n".join(rows[place : place + 2]) for place in range(0, len(rows), 2)]
    kept = [i for i in range(len(pairs)) if i == made.slip or random.random() < 0.6]
    return Derivation(
        made.kind,
        made.share,
        "\n".join(pairs[i] for i in kept),
        None if made.slip is None else kept.index(made.slip),
        tuple(kept.index(i) for i in made.changed if i in kept),
    )
