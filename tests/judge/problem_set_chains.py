"""The chains of the problem set, worked out by SymPy from one equation to the next.

Each follows the solutions by the numbers of their equations. Vectors are triples of components
along axes that turn; their rates are worked out from the angular velocity of the axes.
"""

from __future__ import annotations

import sympy as sp

from judge.derivations import (
    Chain,
    Family,
    Omega,
    Quantity,
    a,
    about,
    by_name,
    g,
    i1,
    i2,
    i3,
    inertia,
    letter,
    m,
    phi,
    psi,
    rate,
    speed,
    theta,
    vx,
    vy,
    w1,
    w2,
    w3,
    x,
    y,
)

M = letter("M", "M")
w, lam = speed("w", r"\omega"), letter("lambda", r"\lambda")
square = letter("L2", "L^2")
_L2 = Quantity(square, sp.Integer(0), sp.Integer(0))
sin, cos = sp.sin(theta.value), sp.cos(theta.value)

Vector = sp.Matrix
#: Why a chain of the problem set is not among these.
LEFT_OUT = {
    "(48)-(51)": "R is a constant of integration of a vector equation, which no substitution gives",
    "(63)-(68)": "force and torque on an element of a hoop, which no model here has",
    "(81)-(86)": "a differential equation is integrated; (81) itself is in, as its square",
    "(87)-(89)": "changes over a time in which the ball slips: the model has no such time",
    "(154)-(162)": "forces on an element of a disk, which no model here has",
}


def cross(one: Vector, other: Vector) -> Vector:
    return sp.Matrix(one).cross(sp.Matrix(other))


def turning(vector: Vector, axes: Vector) -> Vector:
    """The rate of a vector whose components are along axes with this angular velocity."""
    return sp.Matrix([rate(entry) for entry in vector]) + cross(axes, vector)


def _printed(value: sp.Expr) -> str:
    from judge.derivations import NAMES

    return sp.latex(sp.expand(value), symbol_names=NAMES)


STEADY = {theta.rate: 0, theta.second: 0, phi.second: 0, w1.rate: 0, w3.rate: 0}


def disk(chain: Chain, share: sp.Rational) -> None:
    """(29) to (40): a rolling disk by Newton's law and the torque about its centre."""
    axes = sp.Matrix([theta.rate, phi.rate * sin, phi.rate * cos])
    z, arm = sp.Matrix([0, sin, cos]), sp.Matrix([0, -a, 0])
    chain.say(r"Let $\mathbf a = -a\,\hat{\mathbf 2}$ lead from the centre to the contact. Then")
    omega = chain.vector(r"\boldsymbol\omega", [theta.rate, phi.rate * sin, w3.value])
    chain.law(r"\mathbf v_{\rm cm} + \boldsymbol\omega\times\mathbf a", sp.Integer(0))
    velocity = chain.vector(r"\mathbf v_{\rm cm}", -cross(omega, arm))
    change = chain.vector(r"\frac{d\mathbf v_{\rm cm}}{dt}", turning(velocity, axes))
    chain.law(r"\mathbf F - mg\,\hat{\mathbf z}", r"m\frac{d\mathbf v_{\rm cm}}{dt}")
    force = chain.vector(r"\mathbf F", m * g * z + m * change)
    torque = chain.vector(r"\mathbf a\times\mathbf F", cross(arm, force))
    moments = sp.diag(m * a**2 / 4, m * a**2 / 4, m * a**2 / 2)
    momentum = chain.vector(r"\mathbf L_{\rm cm}", moments * omega)
    growth = chain.vector(r"\frac{d\mathbf L_{\rm cm}}{dt}", turning(momentum, axes))
    chain.law(r"\frac{d\mathbf L_{\rm cm}}{dt}", r"\mathbf a\times\mathbf F")
    chain.say("In steady motion its first component is")
    right = chain.line(_printed(growth[0].subs(STEADY)), torque[0].subs(STEADY))
    chain.say("that is, in steady motion,")
    rest = sp.expand((growth[0].subs(STEADY) - right) * 4 / (m * a**2))
    gravity = rest.coeff(g) * g
    chain.line(_printed(rest - gravity), -gravity)


def coin(chain: Chain, share: sp.Rational) -> None:
    """(15) to (24): a spinning coin by Lagrange's method."""
    chain.say(r"Assume that $v_x = 0$ and $v_y = 0$. The kinetic energy of rotation is")
    spin = psi.rate + phi.rate * cos
    turn = theta.rate**2 + phi.rate**2 * sin**2
    rotation = chain.line(r"T_{\rm rot}", m * a**2 / 8 * turn + m * a**2 / 4 * spin**2)
    travel = chain.line(r"T_{\rm cm}", m * a**2 * theta.rate**2 * cos**2 / 2)
    potential = chain.line("V", m * g * a * sin)
    chain.law(r"\mathcal{L}", r"T_{\rm cm} + T_{\rm rot} - V")
    lagrangian = rotation + travel - potential
    chain.line(r"P_\phi", sp.diff(rotation, phi.rate))
    chain.line(r"P_\psi", sp.diff(rotation, psi.rate))
    momentum = chain.line(
        r"\frac{\partial\mathcal L}{\partial\dot\theta}", sp.diff(lagrangian, theta.rate)
    )
    chain.line(_printed(rate(momentum)), sp.diff(lagrangian, theta.value))


def marble_by_vectors(chain: Chain, share: sp.Rational) -> None:
    """(43) to (47): a marble on a turntable, in vectors."""
    carried = letter("Omega v", r"\left(\boldsymbol\Omega\times\mathbf v\right)")
    fall = letter("v dot", r"\frac{d\mathbf v}{dt}")
    chain.say(r"Let $\mathbf a = -a\,\hat{\mathbf z}$ lead from the centre to the contact. Then")
    chain.law(r"\mathbf v + \boldsymbol\omega\times\mathbf a", r"\boldsymbol\Omega\times\mathbf r")
    given = chain.line(r"\frac{d\boldsymbol\omega}{dt}\times\mathbf a", carried - fall)
    chain.law(r"I\frac{d\boldsymbol\omega}{dt}", r"m\,\mathbf a\times\frac{d\mathbf v}{dt}")
    torque = chain.line(r"\mathbf a\times I\frac{d\boldsymbol\omega}{dt}", -m * a**2 * fall)
    chain.line(_printed(torque), -inertia * given)
    found = chain.line(fall, sp.solve(torque + inertia * given, fall)[0])
    chain.line(r"m\frac{d\mathbf v}{dt}", m * found)


def marble_by_components(chain: Chain, share: sp.Rational) -> None:
    """(43) to (55): the same along fixed axes, to the force."""
    chain.say(r"Let $\mathbf a = -a\,\hat{\mathbf z}$ lead from the centre to the contact. Then")
    chain.law(
        r"\mathbf v + \boldsymbol\omega\times\mathbf a",
        r"\Omega\left(-y\,\hat{\mathbf x} + x\,\hat{\mathbf y}\right)",
    )
    xyz = ("x", "y", "z")
    spin = letter("wz", r"\omega_z")
    omega = chain.vector(
        r"\boldsymbol\omega",
        [(Omega * x.value - vy.value) / a, (vx.value + Omega * y.value) / a, spin],
        xyz,
    )
    momentum = chain.vector(r"\mathbf L_{\rm cm}", inertia * omega, xyz)
    moving = {x.rate: vx.value, y.rate: vy.value}
    growth = sp.Matrix([rate(entry).subs(moving) for entry in momentum])
    chain.law(r"\frac{d\mathbf L_{\rm cm}}{dt}", r"m\,\mathbf a\times\frac{d\mathbf v}{dt}")
    for part, other, sign in ((0, vy, 1), (1, vx, -1)):
        left = growth[part]
        torque = chain.line(_printed(left), sign * m * a * other.rate)
        found = sp.solve(left - torque, other.rate)[0]
        chain.line(other.rate, sp.factor(found))


def gyrocompass(chain: Chain, share: sp.Rational) -> None:
    """(70) to (73): a gyrocompass seen from an inertial frame."""
    sinl, cosl = sp.sin(lam), sp.cos(lam)
    turn = chain.vector(
        r"\boldsymbol\omega_{123}",
        [-theta.rate + Omega * cosl, -Omega * sinl * sin, Omega * sinl * cos],
    )
    chain.law(r"\boldsymbol\omega", r"\boldsymbol\omega_{123} + \omega\,\hat{\mathbf 3}")
    omega = chain.vector(r"\boldsymbol\omega", turn + sp.Matrix([0, 0, w.value]))
    moments = sp.diag(i1, i1, i3)
    momentum = chain.vector(r"\mathbf L_{\rm cm}", moments * omega)
    growth = chain.vector(
        r"\frac{d\mathbf L_{\rm cm}}{dt}",
        sp.Matrix([rate(p) for p in momentum]) + cross(turn, momentum),
    )
    left = growth[0].coeff(theta.second) * theta.second
    chain.say("No torque acts along axis 1, hence")
    right = chain.line(_printed(left), -(growth[0] - left))
    if left != 0:
        chain.line(theta.second, sp.expand(right / left * theta.second))
    chain.say("Nor does one along axis 3, hence")
    chain.line(r"\dot\omega", sp.solve(growth[2], w.rate)[0])


def racquet(chain: Chain, share: sp.Rational) -> None:
    """(76) to (81): the separating polhodes of a free body."""
    s1, s2, s3 = (each.value**2 for each in (w1, w2, w3))
    chain.say(r"Assume that $L^2 = 2I_2T$. The kinetic energy is")
    kinetic = chain.line("T", (i1 * s1 + i2 * s2 + i3 * s3) / 2)
    total = chain.line("L^2", i1**2 * s1 + i2**2 * s2 + i3**2 * s3)
    double = chain.line("2 I_2 T", 2 * i2 * kinetic)
    one, three = sp.symbols("one three")
    images = {s1: one, s3: three}
    found = sp.solve(
        [double.subs(images) - square, total.subs(images) - square], [one, three], dict=True
    )[0]
    first = chain.line(r"\omega_1^2", sp.factor(found[one]))
    third = chain.line(r"\omega_3^2", sp.factor(found[three]))
    pull = chain.line(w2.rate, (i3 - i1) / i2 * w3.value * w1.value)
    factor = pull / (w1.value * w3.value)
    chain.line(r"\dot\omega_2^2", sp.factor(factor**2 * first * third))


_TOP = sp.Matrix([w1.value, theta.rate, phi.rate * sin])
_TRIAD = sp.Matrix([phi.rate * cos, theta.rate, phi.rate * sin])


def gyroscope_about_centre(chain: Chain, share: sp.Rational) -> None:
    """(96) to (116): a gyroscope, its moments about the centre of mass."""
    one = sp.Matrix([1, 0, 0])
    z = sp.Matrix([cos, 0, sin])
    chain.law(r"\mathbf v_{\rm cm}", r"\boldsymbol\omega\times a\,\hat{\mathbf 1}")
    omega = chain.vector(r"\boldsymbol\omega", _TOP)
    velocity = chain.vector(r"\mathbf v_{\rm cm}", cross(omega, a * one))
    momentum = chain.vector(r"\mathbf L_{\rm cm}", sp.diag(i1, i2, i2) * omega)
    growth = chain.vector(r"\frac{d\mathbf L_{\rm cm}}{dt}", turning(momentum, _TRIAD))
    change = chain.vector(r"\frac{d\mathbf v_{\rm cm}}{dt}", turning(velocity, _TRIAD))
    chain.law(r"\mathbf F - Mg\,\hat{\mathbf z}", r"M\frac{d\mathbf v_{\rm cm}}{dt}")
    force = chain.vector(r"\mathbf F", M * g * z + M * change)
    chain.law(r"\frac{d\mathbf L_{\rm cm}}{dt}", r"-a\,\hat{\mathbf 1}\times\mathbf F")
    torque = -a * cross(one, force)
    for part in range(3):
        chain.line(_printed(growth[part]), torque[part])


def gyroscope_about_pivot(chain: Chain, share: sp.Rational) -> None:
    """(117) to (124): the same about the pivot, and steady precession."""
    moment = i2 + M * a**2
    momentum = chain.vector(r"\mathbf L_p", sp.diag(i1, moment, moment) * _TOP)
    growth = chain.vector(r"\frac{d\mathbf L_p}{dt}", turning(momentum, _TRIAD))
    torque = chain.vector(r"\boldsymbol\tau_p", [0, M * g * a * sin, 0])
    chain.law(r"\frac{d\mathbf L_p}{dt}", r"\boldsymbol\tau_p")
    for part in range(3):
        chain.line(_printed(growth[part]), torque[part])
    chain.say("In steady precession")
    left = growth[1].subs(STEADY)
    right = chain.line(_printed(left), torque[1].subs(STEADY))
    chain.say("and therefore, in steady precession,")
    rest = sp.expand(sp.expand(left - right) / sin)
    gravity = rest.coeff(g) * g
    chain.line(_printed(rest - gravity), -gravity)


def gyroscope_launched(chain: Chain, share: sp.Rational) -> None:
    """(143) to (151): along ρ, φ and z, the forces of the pivot and the equations of motion."""
    cylinder = ("rho", "phi", "z")
    axes = sp.Matrix([0, 0, phi.rate])
    velocity = chain.vector(
        r"\mathbf v_{\rm cm}",
        [a * theta.rate * cos, a * phi.rate * sin, -a * theta.rate * sin],
        cylinder,
    )
    change = chain.vector(r"\frac{d\mathbf v_{\rm cm}}{dt}", turning(velocity, axes), cylinder)
    out = chain.line(r"F_\rho", M * change[0])
    side = chain.line(r"F_\phi", M * change[1])
    up = chain.line("F_z", M * g + M * change[2])
    spin = i1 * w1.value
    bend = spin * theta.rate - i2 * phi.second * sin - 2 * i2 * phi.rate * theta.rate * cos
    chain.law(_printed(bend), r"a F_\phi")
    chain.line(_printed(bend), a * side)
    nod = spin * phi.rate * sin - i2 * phi.rate**2 * sin * cos + i2 * theta.second
    chain.law(_printed(nod), r"a F_z\sin\theta - a F_\rho\cos\theta")
    chain.line(_printed(nod), sp.expand(a * up * sin - a * out * cos))


CHAINS = by_name(
    Family("(29)-(40)", disk, about("rolling-disk")),
    Family("(15)-(24)", coin, about("spinning-coin")),
    Family("(43)-(47)", marble_by_vectors, about("marble-on-turntable")),
    Family("(43)-(55)", marble_by_components, about("marble-on-turntable")),
    Family("(70)-(75)", gyrocompass, about("gyrocompass")),
    Family("(76)-(81)", racquet, about("tennis-racquet")),
    Family("(96)-(116)", gyroscope_about_centre, about("gyroscope")),
    Family("(117)-(124)", gyroscope_about_pivot, about("gyroscope")),
    Family("(143)-(151)", gyroscope_launched, about("gyroscope")),
)
