"""Angular velocities, the velocity from the constraint, and the angular momentum."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr, Matrix, SymbolKind, Vector
from polhode.model import Contact, Element, Frame, Rolling
from polhode.solution._lines import (
    SolutionLine,
    inline,
    joined,
    letter_of,
    listed,
    unit,
    vector_latex,
)
from polhode.solution._setting import Setting


def kinematics(setting: Setting) -> Iterator[SolutionLine]:
    """ω of the axes and of the body, v of the centre of mass, L, and rates of the unit vectors."""
    yield from _turning(setting)
    if _is_spin_tied(setting):
        yield from _spin_from_velocity(setting)
    else:
        yield from _angular_velocity(setting)
        yield from _velocity(setting)
    yield from _momentum(setting)
    yield from rates_of_units(setting)


def turning_letter(setting: Setting) -> str:
    """LaTeX of the angular velocity of the axes, such as ω₁₂₃."""
    return rf"\boldsymbol\omega_{{{''.join(setting.axes.labels)}}}"


def _turning(setting: Setting) -> Iterator[SolutionLine]:
    axes = setting.axes
    if not setting.changes or setting.body.fixed_axes == axes:
        return
    steps = [f for f in reversed(axes.lineage) if f.parent is not None and f.angle.dt()]
    pieces = [
        vector_latex(Vector(frame.axis, frame) * frame.angle.dt(), _named(setting, frame))
        for frame in steps
    ]
    sides = [turning_letter(setting)]
    if not any(axes.root.turned) and len(pieces) > 1:
        sides.append(joined(pieces))
    sides.append(vector_latex(setting.turning, axes))
    yield SolutionLine(
        "The angular velocity of the axes is the sum of the rates of their angles, each about its "
        "own axis" + (", and of the rotation of the laboratory," if any(axes.root.turned) else ","),
        " = ".join(dict.fromkeys(sides)),
        "turning",
        "identity",
    )


def _named(setting: Setting, frame: Frame) -> Frame:
    """A frame with unambiguous labels along which the axis of a rotation is one direction."""
    axis = Vector(frame.axis, frame)
    for known in setting.frames:
        if sum(1 for c in axis.express(known).components if c) == 1:
            return known
    return setting.axes


def _angular_velocity(setting: Setting) -> Iterator[SolutionLine]:
    body, axes = setting.body, setting.axes
    if setting.angular_velocity.is_zero and setting.spin.is_zero:
        return
    fixed = body.fixed_axes
    spins = fixed is None or fixed != axes
    letters = [s for s in body.speeds if s.symbol is not None]
    named = [s for s in letters if s.symbol in setting.equations.speeds]
    words = f"The angular velocity of the {body.name} is"
    if spins and setting.changes:
        words = f"The angular velocity of the {body.name} is that of the axes and its spin together"
    elif setting.equations.dependent and axes.parent is None:
        words += ", with the components that the constraint requires"
    if named and axes.parent is not None and axes == setting.along:
        words += f", {_named_speeds(setting, named)}"
    _, written = setting.shortest(setting.angular_velocity)
    yield SolutionLine(
        words + ("," if "," in words else ""), rf"\boldsymbol\omega = {written}", "omega", "motion"
    )
    for speed in named if spins else ():
        yield from _meaning(setting, speed)


def _named_speeds(setting: Setting, speeds: list[Expr]) -> str:
    """What speeds are that are no rates: components of ω, or of that relative to the axes."""
    names, many = listed(map(inline, speeds)), "s" if len(speeds) > 1 else ""
    omega = setting.angular_velocity.express(setting.axes)
    relative = (setting.angular_velocity - setting.turning).express(setting.axes)
    for vector in (omega, relative):
        along = {v: k for k, v in zip(setting.axes.labels, vector.components, strict=True)}
        if all(speed in along for speed in speeds):
            labels = listed(f"${letter_of(along[speed])}$" for speed in speeds)
            if vector is relative:
                return f"with {names} for the spin relative to the axes about {labels}"
            return f"with {names} for its component{many} along {labels}"
    return f"in terms of {names}"


def _meaning(setting: Setting, speed: Expr) -> Iterator[SolutionLine]:
    """ω₃ = ψ̇ + φ̇ cos θ, where the angle of spin is a coordinate."""
    for angle, value in setting.body.rates.items():
        rest = setting.equations.kinetics.on_speeds(value) - speed
        if not rest.diff(speed):
            right = joined([angle.dt().latex(), *([(-rest).latex()] if rest else [])])
            yield SolutionLine(
                f"where, with the angle of spin {inline(angle)} relative to the axes,",
                f"{speed.latex()} = {right}",
                "spin",
            )


# -- rolling where the constraint gives the angular velocity ---------------------------------------


def _is_spin_tied(setting: Setting) -> bool:
    """Whether the constraint gives ω in terms of the velocity of the centre of mass."""
    tied = tying(setting)
    if not isinstance(tied, Contact):
        return False
    free = {s.symbol for s in tied.rates().values()} & set(setting.equations.speeds)
    return any(free & c.symbols() for c in setting.angular_velocity.components)


def _spin_from_velocity(setting: Setting) -> Iterator[SolutionLine]:
    tied = next(e for e in setting.contacts if isinstance(e, Rolling))
    _, velocity = setting.shortest(setting.velocity)
    _, angular = setting.shortest(setting.angular_velocity)
    yield SolutionLine(
        f"The velocity of the centre of mass has the components{_on_a_slope(setting)}",
        rf"\mathbf v_{{\rm cm}} = {velocity}",
        "velocity",
    )
    yield from _constraint(setting, tied)
    named = [s for s in setting.body.speeds if s.symbol in setting.equations.speeds]
    free = f" except for {listed(map(inline, named))}, which remains free" if named else ""
    yield SolutionLine(
        f"This determines the angular velocity{free}:",
        rf"\boldsymbol\omega = {angular}",
        "omega",
    )


# -- velocity --------------------------------------------------------------------------------------


def arm_words(setting: Setting, element: Element) -> str:
    """What the vector a from the centre of mass leads to."""
    if isinstance(element, Contact):
        return "the point of contact"
    return "the fixed point" if setting.is_fixed(element) else f"where “{element.name}” acts"


def arm_let(setting: Setting, element: Element) -> str:
    """The definition of **a** for claims."""
    _, written = setting.shortest(setting.arm(element))
    return rf"\mathbf a = {written}"


def _velocity(setting: Setting) -> Iterator[SolutionLine]:
    if setting.velocity.is_zero:
        yield SolutionLine(
            "The centre of mass stays at rest.", r"\mathbf v_{\rm cm} = 0", "velocity"
        )
        return
    _, written = setting.shortest(setting.velocity)
    tied = tying(setting)
    if tied is None:
        words = "The velocity of the centre of mass follows from its place:"
        if setting.contacts and setting.velocity.dot(setting.contacts[0].on.up):
            words = (
                "The height of the centre of mass follows from the attitude, since the body "
                "touches its support. Hence the velocity of the centre of mass is"
            )
        elif any(
            s.kind is SymbolKind.SPEED for c in setting.velocity.components for s in c.symbols()
        ):
            words = f"The velocity of the centre of mass has the components{_on_a_slope(setting)}"
        yield SolutionLine(words, rf"\mathbf v_{{\rm cm}} = {written}", "velocity")
        return
    if setting.arm(tied).is_zero:
        yield SolutionLine("The velocity is", rf"\mathbf v_{{\rm cm}} = {written}", "velocity")
        return
    yield from _constraint(setting, tied)
    yield SolutionLine(
        "so that the velocity of the centre of mass is",
        rf"\mathbf v_{{\rm cm}} = {written}",
        "velocity",
    )


def _on_a_slope(setting: Setting) -> str:
    """Speeds along a slope whose axes have the names of others, so that nothing shows them."""
    if not setting.contacts or (axes := setting.contacts[0].on.axes) in setting.frames:
        return ""
    pairs = zip(axes.labels, setting.velocity.express(axes).components, strict=True)
    named = {k: v for k, v in pairs if v.symbol in setting.equations.speeds}
    if not named:
        return ""
    names, along = listed(map(inline, named.values())), listed(f"${letter_of(k)}$" for k in named)
    return f" {names} along the axes {along} of the slope, that is,"


def _constraint(setting: Setting, tied: Element) -> Iterator[SolutionLine]:
    """v + ω × a is the velocity of the support."""
    let = arm_let(setting, tied)
    support = _support_velocity(setting, tied)
    what = "is at rest" if support == "0" else "moves with the support"
    yield SolutionLine(
        f"Let $\\mathbf a$ lead from the centre of mass to {arm_words(setting, tied)}, "
        f"${let}$. The point of the {setting.body.name} there {what}:",
        rf"\mathbf v_{{\rm cm}} + \boldsymbol\omega\times\mathbf a = {support}",
        "constraint",
        let=(let,),
    )


def tying(setting: Setting) -> Element | None:
    """The element that fixes the velocity of one point of the body, and so introduces **a**."""
    for element in setting.equations.system.elements:
        if isinstance(element, Rolling) or setting.is_fixed(element):
            return element
    return None


def has_named_arm(setting: Setting, element: Element) -> bool:
    """Whether the velocity has been found with **a** to where an element acts."""
    is_found = _is_spin_tied(setting) or not setting.velocity.is_zero
    return is_found and tying(setting) == element and not setting.arm(element).is_zero


def _support_velocity(setting: Setting, element: Element) -> str:
    if not isinstance(element, Contact):
        return "0"
    place = setting.equations.kinetics.places[setting.body] + setting.arm(element)
    _, written = setting.shortest(setting.equations.kinetics.resolve(element.on.velocity(place)))
    return written


# -- momentum and unit vectors ---------------------------------------------------------------------


def _momentum(setting: Setting) -> Iterator[SolutionLine]:
    if setting.spin.is_zero:
        return
    words = "The angular momentum about the centre of mass is"
    inertia = setting.body.inertia
    if not setting.body.is_isotropic and inertia == Matrix.diagonal(
        tuple(inertia[i, i] for i in range(3))
    ):
        words += ", with the principal moments,"
    _, written = setting.shortest(setting.spin)
    yield SolutionLine(words, rf"\mathbf L_{{\rm cm}} = {written}", "momentum")


def rates_of_units(setting: Setting) -> Iterator[SolutionLine]:
    """How the unit vectors along the axes change, if they do."""
    axes = setting.axes
    if not setting.changes:
        return
    fixed = setting.body.fixed_axes == axes
    omega = r"\boldsymbol\omega" if fixed else turning_letter(setting)
    vector = r"\hat{\mathbf e}"
    words = (
        rf"A unit vector ${vector}$ along these axes changes at the rate ${omega}\times {vector}$"
    )
    for i, label in enumerate(axes.labels):
        rate = setting.turning.cross(axes[label])
        yield SolutionLine(
            f"{words}:" if i == 0 else "",
            rf"\frac{{d{unit(label)}}}{{dt}} = {omega}\times {unit(label)} = "
            f"{vector_latex(rate, axes)}",
            f"unit{i + 1}",
        )
