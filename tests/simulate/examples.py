"""Equations of motion written out by hand, in the shape in which they are simulated."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace

import polhode as ph
from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Matrix,
    Symbol,
    as_symbol,
    coordinates,
    cos,
    functions,
    sin,
    speeds,
    symbols,
)


@dataclass(frozen=True)
class ByHand:
    """Equations of one contact mode, each part as it was written down."""

    coordinates: tuple[Symbol, ...]
    speeds: tuple[Symbol, ...]
    kinematics: Mapping[Symbol, Expr]
    mass: Matrix
    forcing: tuple[Expr, ...]
    energy: Expr
    parameters: tuple[Symbol, ...] = ()
    functions: tuple[Symbol, ...] = ()
    power: Expr = ZERO
    dependent: Mapping[Symbol, Expr] = field(default_factory=dict)
    components: Mapping[str, Expr] = field(default_factory=dict)
    undetermined: tuple[str, ...] = ()
    closures: tuple[Expr, ...] = ()
    assumed_positive: tuple[Expr, ...] = ()
    dimensions: Mapping[Symbol, object] = field(default_factory=dict)
    system: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(name="by hand"))

    @property
    def computed(self) -> "ByHand":
        """As they were written down."""
        return self


def of(*expressions: Expr) -> tuple[Symbol, ...]:
    """The symbols that these expressions are."""
    return tuple(as_symbol(e) for e in expressions)


def pendulum() -> ByHand:
    """A point mass m on a light rod l, theta from the hanging position; tension N."""
    (theta,) = coordinates("theta")
    m, g, length = symbols("m g l", positive=True)
    omega, alpha = theta.dt(), theta.dt().dt()
    return ByHand(
        coordinates=of(theta),
        speeds=of(omega),
        kinematics={as_symbol(omega): omega},
        mass=Matrix.of([[m * length**2]]),
        forcing=(-m * g * length * sin(theta),),
        energy=m * length**2 * omega**2 / 2 - m * g * length * cos(theta),
        parameters=of(g, length, m),
        components={
            "N": m * length * omega**2 + m * g * cos(theta),
            "S": m * length * alpha + m * g * sin(theta),
        },
    )


def oscillator() -> ByHand:
    """A mass m on a spring k, pushed by X(t) at its free end."""
    (x,) = coordinates("x")
    m, k = symbols("m k", positive=True)
    (end,) = functions("X")
    v = x.dt()
    return ByHand(
        coordinates=of(x),
        speeds=of(v),
        kinematics={as_symbol(v): v},
        mass=Matrix.of([[m]]),
        forcing=(-k * (x - end),),
        energy=m * v**2 / 2 + k * (x - end) ** 2 / 2,
        power=-k * (x - end) * end.dt(),
        parameters=of(k, m),
        functions=of(end),
    )


def free_body() -> ByHand:
    """Euler's equations of a free body."""
    names = speeds("omega_1 omega_2 omega_3")
    moments = symbols("I_1 I_2 I_3", positive=True)
    (a, b, c), (p, q, r) = moments, names
    return ByHand(
        coordinates=(),
        speeds=of(*names),
        kinematics={},
        mass=Matrix.diagonal(moments),
        forcing=((b - c) * q * r, (c - a) * r * p, (a - b) * p * q),
        energy=(a * p**2 + b * q**2 + c * r**2) / 2,
        parameters=of(*moments),
    )


def free_body_invariants() -> dict[str, Expr]:
    """The square of its angular momentum."""
    names, moments = speeds("omega_1 omega_2 omega_3"), symbols("I_1 I_2 I_3", positive=True)
    return {"L^2": sum((i * i * w * w for i, w in zip(moments, names, strict=True)), ZERO)}


def wheel() -> ByHand:
    """A knife-edged wheel steered at a constant rate: speed u along its heading phi."""
    x, y, phi, psi = coordinates("x y phi psi")
    u, steer = speeds("u Omega")
    vx, vy = speeds("v_x v_y")
    (a,) = symbols("a", positive=True)
    along, across = u * cos(phi), u * sin(phi)
    return ByHand(
        coordinates=of(x, y, phi, psi),
        speeds=of(u, steer),
        kinematics={
            as_symbol(x.dt()): along,
            as_symbol(y.dt()): across,
            as_symbol(phi.dt()): steer,
            as_symbol(psi.dt()): u / a - steer * cos(phi),
        },
        mass=Matrix.of([[ONE, ZERO], [ZERO, ONE]]),
        forcing=(ZERO, ZERO),
        energy=(u**2 + steer**2) / 2,
        parameters=of(a),
        dependent={as_symbol(vx): along, as_symbol(vy): across},
    )


def four_bar() -> ByHand:
    """A crank p, a coupler q and a rocker r on a base d; the crank turns freely, the rest follow.

    The rods are light, and the crank is a flywheel of moment I.
    """
    alpha, beta, gamma = coordinates("alpha beta gamma")
    p, q, r, d, moment = symbols("p q r d I", positive=True)
    turn = alpha.dt()
    closures = (
        p * cos(alpha) + q * cos(beta) - r * cos(gamma) - d,
        p * sin(alpha) + q * sin(beta) - r * sin(gamma),
    )
    between = sin(gamma) * cos(beta) - cos(gamma) * sin(beta)
    return ByHand(
        coordinates=of(alpha, beta, gamma),
        speeds=of(turn),
        kinematics={
            as_symbol(turn): turn,
            as_symbol(beta.dt()): turn
            * p
            * (cos(gamma) * sin(alpha) - sin(gamma) * cos(alpha))
            / (q * between),
            as_symbol(gamma.dt()): turn
            * p
            * (cos(beta) * sin(alpha) - sin(beta) * cos(alpha))
            / (r * between),
        },
        mass=Matrix.of([[moment]]),
        forcing=(ZERO,),
        energy=moment * turn**2 / 2,
        parameters=of(d, moment, p, q, r),
        closures=closures,
    )


def declared_four_bar():
    """Crank a, coupler b and rocker c between fixed pivots at a distance d, turning about y."""
    m, g, d = ph.symbols("m g d", positive=True)
    lab, lengths = ph.Frame("lab"), ph.symbols("a b c", positive=True)
    angles = ph.coordinates("alpha beta gamma")
    u, v, w = bars = [
        ph.rod(name, mass=m, length=length, axes=lab.rotated(angle, "y"), axis="x", tag=name)
        for name, length, angle in zip("uvw", lengths, angles, strict=True)
    ]
    ends = [bar.axes["x"] * (length / 2) for bar, length in zip(bars, lengths, strict=True)]
    return ph.System(
        ph.Pivot(u, at=-ends[0], name="first"),
        ph.Pivot(v, at=-ends[1], to=u.point(ends[0]), name="second"),
        ph.Pivot(w, at=-ends[2], to=lab["x"] * d, name="third"),
        ph.Pivot(v, at=ends[1], to=w.point(ends[2]), only="x z", name="fourth", force="H"),
        *(ph.Hinge(bar, axis="y") for bar in bars),
        ph.Gravity(g),
    )
