"""Newton's law with the torque equation: about the centre of mass, or about the contact."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ZERO, Expr, Vector
from polhode.base import ConstraintError
from polhode.model import Element, Gravity
from polhode.solution._bodies import body_by_body
from polhode.solution._kinematics import arm_let, arm_words, has_named_arm
from polhode.solution._lines import SolutionLine, is_sum, joined, letter_of, listed, unit
from polhode.solution._setting import LONGEST, WIDEST, Setting, bound

_LAW = r"\frac{d\mathbf v_{\rm cm}}{dt}"
_RATE = r"\frac{d\mathbf L_{\rm cm}}{dt}"


def about_the_centre_of_mass(setting: Setting) -> Iterator[SolutionLine]:
    """F from Newton's law, put into the torque about the centre of mass.

    Several bodies or supports are treated one by one. Raises `ConstraintError` for what this route
    does not cover.
    """
    if not _is_plain(setting):
        yield from body_by_body(setting)
        return
    for line in _for_one_force(setting):
        yield bound(setting, line)


def _for_one_force(setting: Setting) -> Iterator[SolutionLine]:
    leverage = [e for e in setting.forced if not setting.arm(e).is_zero]
    yield from _newtons_law(setting)
    if not leverage:
        yield from _without_leverage(setting)
    else:
        yield from _eliminated(setting, leverage[0])
    yield from _components(setting, leverage)


def about_the_contact(setting: Setting) -> Iterator[SolutionLine]:
    """The torque about the point where the unknown force acts, which has no moment there.

    Raises `ConstraintError` for what this route does not cover.
    """
    _require_plain(setting, "contact")
    leverage = [e for e in setting.forced if not setting.arm(e).is_zero]
    if len(leverage) != 1:
        raise _missing(setting, "contact", "one force that acts away from the centre of mass")
    (element,) = leverage
    if setting.is_fixed(element):
        yield from _about_fixed(setting, element)
        return
    yield from _about_moving(setting, element)


def _is_plain(setting: Setting) -> bool:
    """Whether there is one body, with one support away from its centre of mass at most.

    A couple of a support would have a moment besides that of such a force.
    """
    levers = [e for e in setting.forced if not setting.arm(e).is_zero]
    loads = setting.equations.system.loads
    few = setting.is_single and len(levers) <= 1 and len(setting.forced) <= max(len(levers), 1)
    few = few and not (levers and setting.twisting)
    return few and all(isinstance(load, Gravity) for load in loads)


def _require_plain(setting: Setting, route: str) -> None:
    if not setting.is_single:
        raise _missing(setting, route, "a single body")
    loads = [load for load in setting.equations.system.loads if not isinstance(load, Gravity)]
    if loads:
        raise _missing(setting, route, "no load but gravity")
    if len([e for e in setting.forced if not setting.arm(e).is_zero]) > 1:
        raise _missing(setting, route, "at most one support away from the centre of mass")
    if setting.twisting:
        raise _missing(setting, route, "supports that exert no couple")


def _missing(setting: Setting, route: str, expected: str) -> ConstraintError:
    return ConstraintError(
        f"the route {route} for {setting.equations.system.name!r}",
        expected=expected,
        advice="take another route, or none: the shortest is then found",
    )


# -- Newton's law ----------------------------------------------------------------------------------


def _newtons_law(setting: Setting) -> Iterator[SolutionLine]:
    if setting.velocity.is_zero:
        return
    forces = [setting.force_letter(e) for e in setting.forced]
    weight = [f"-{setting.weight_latex}"] if setting.weight_latex else []
    left = joined([*forces, *weight] or ["0"])
    words = "Newton's law for the centre of mass is"
    if setting.forced:
        words = f"Let {listed(f'${f}$' for f in forces)} be the force of the support. {words}"
    mass = setting.mass.latex()
    yield SolutionLine(words, f"{left} = {mass}{_LAW}", "newton")
    yield from acceleration(setting)
    yield from _pushed_one_way(setting)


def acceleration(setting: Setting) -> Iterator[SolutionLine]:
    """The acceleration of the centre of mass by components."""
    rate = setting.rate(setting.velocity)
    frame, written = setting.shortest(rate)
    if len(written) > LONGEST:
        return
    turning = setting.changes and frame == setting.axes
    turns = " and the rates [[unit1]] to [[unit3]] of the unit vectors" if turning else ""
    yield SolutionLine(
        f"in which, by the velocity [[velocity]]{turns},",
        f"{_LAW} = {written}",
        "acceleration",
    )


def _pushed_one_way(setting: Setting) -> Iterator[SolutionLine]:
    """What Newton's law says across a vertical force, the only one besides the weight."""
    if len(setting.forced) != 1 or setting.up is None:
        return
    carried = {s for c in setting.velocity.components for s in c.symbols()}
    for element in setting.forced:
        force = setting.equations.reactions[element.name].force
        frame, _ = setting.shortest(force)
        parts = zip(frame.labels, force.express(frame).components, strict=True)
        present = [label for label, component in parts if component]
        rates = sorted(setting.idle_speeds & carried, key=lambda s: s.published)
        if len(present) != 1 or not rates or not frame[present[0]].cross(setting.up).is_zero:
            continue
        text = r" = ".join(Expr.generator(s.derivative()).latex() for s in rates)
        yield SolutionLine(
            f"Since the support pushes along ${unit(present[0])}$ only, and the weight acts along "
            "it too, the centre of mass moves uniformly in the other directions:",
            f"{text} = 0",
            "uniform",
        )


def _without_leverage(setting: Setting) -> Iterator[SolutionLine]:
    if setting.spin.is_zero:
        return
    if not setting.twisting:
        yield SolutionLine(
            "No force has a moment about the centre of mass, so that the angular momentum does "
            "not change:",
            rf"{_RATE} = 0",
            "torque",
        )
        return
    sides = r"\boldsymbol\tau_{\rm cm}"
    yield SolutionLine(
        "The support exerts a couple, and the torque about the centre of mass changes the angular "
        "momentum:",
        rf"{sides} = {_RATE}",
        "torque",
    )


def _eliminated(setting: Setting, element: Element) -> Iterator[SolutionLine]:
    let = arm_let(setting, element)
    force = setting.force_letter(element)
    is_particle = setting.spin.is_zero
    no_momentum = "; a particle has no angular momentum about it" if is_particle else ""
    yield SolutionLine(
        f"The torque about the centre of mass is that of ${force}$ alone, which acts at "
        f"$\\mathbf a$, with ${let}${no_momentum}:",
        rf"\mathbf a\times {force} = {'0' if is_particle else _RATE}",
        "torque",
        let=(let,),
    )
    others = [e for e in setting.forced if e != element]
    if others:
        return
    inside = joined(
        [rf"{setting.mass.latex()}{_LAW}"]
        + ([setting.weight_latex] if setting.weight_latex else [])
    )
    moment = setting.shortest(setting.spin)[1]
    rate = "0" if is_particle else rf"\frac{{d}}{{dt}}\left({moment}\right)"
    inner = rf"\left({inside}\right)" if is_sum(inside) else inside
    yield SolutionLine(
        f"The force ${force}$ is not known, and we do not need it: take it from Newton's law "
        "[[newton]] and put it into [[torque]]. One vector equation is left for the motion,",
        rf"\mathbf a\times {inner} = {rate}",
        "eliminated",
        let=(let,),
    )


# -- about the point where the force acts ----------------------------------------------------------


def _introduced(setting: Setting, element: Element) -> str:
    """The words that define **a**, unless the velocity has been found with it."""
    if has_named_arm(setting, element):
        return ""
    words, let = arm_words(setting, element), arm_let(setting, element)
    return f" With $\\mathbf a$ from the centre of mass to {words}, ${let}$,"


def _about_fixed(setting: Setting, element: Element) -> Iterator[SolutionLine]:
    arm = setting.arm(element)
    let = arm_let(setting, element)
    mass = setting.mass.latex()
    name = r"\mathbf L_{\rm pivot}"
    total = setting.spin - arm.cross(setting.velocity) * setting.mass
    _, momentum = setting.shortest(total)
    introduced = _introduced(setting, element)
    yield SolutionLine(
        "Take moments about the fixed point. The unknown force acts there and has no moment."
        f"{introduced} {'the' if introduced else 'The'} angular momentum about it is",
        rf"{name} = \mathbf L_{{\rm cm}} - \mathbf a\times {mass}\mathbf v_{{\rm cm}} = {momentum}",
        "fixed",
        let=(let,),
    )
    torque = (-arm).cross(setting.weight)
    _, moment = setting.shortest(torque)
    law = rf"\frac{{d{name}}}{{dt}}"
    if setting.weight_latex:
        yield SolutionLine(
            "Only the weight has a moment about it:",
            rf"{law} = \mathbf a\times {setting.weight_latex} = {moment}",
            "torque",
            let=(let,),
        )
    else:
        yield SolutionLine("Nothing has a moment about it:", f"{law} = 0", "torque")
    rate = setting.rate(total)
    yield from _rate_line(setting, rate, law)
    yield from _rows(setting, rate, torque, _written_out(setting, rate, "fixed", "the torque"))


def _about_moving(setting: Setting, element: Element) -> Iterator[SolutionLine]:
    mass = setting.mass.latex()
    right = rf"\mathbf a\times {setting.weight_latex}" if setting.weight_latex else "0"
    introduced = _introduced(setting, element)
    yield SolutionLine(
        f"Take moments about {arm_words(setting, element)}: the unknown force acts there and has "
        f"no moment.{introduced} {'the' if introduced else 'The'} moment of the rate of change of "
        "momentum counts besides the rate of the angular momentum about the centre of mass:",
        rf"{_RATE} - \mathbf a\times {mass}{_LAW} = {right}",
        "torque",
        let=(arm_let(setting, element),),
    )
    yield from acceleration(setting)
    yield from _pushed_one_way(setting)
    yield from _across_the_force(setting, element)
    yield from _components(setting, [element], "torque")


def _across_the_force(setting: Setting, element: Element) -> Iterator[SolutionLine]:
    """Newton's law along axes to which the only force besides the weight is perpendicular."""
    if len(setting.forced) != 1:
        return
    force = setting.equations.reactions[element.name].force
    gained = setting.rate(setting.velocity) * setting.mass
    axes = setting.along
    rows = [
        (label, gained.dot(axes[label]), setting.weight.dot(axes[label]))
        for label in axes.labels
        if not force.dot(axes[label])
    ]
    shown = [(label, left, right) for label, left, right in rows if left or right]
    uniform = {s.derivative() for s in setting.idle_speeds}
    if any(left.symbols() & uniform for _, left, _ in shown):
        return  # said already: the centre of mass moves uniformly
    yield from _listed_rows(shown, "Along {along} that force has no component: by Newton's law")


# -- components ------------------------------------------------------------------------------------


def _components(
    setting: Setting, leverage: list[Element], law: str = "eliminated"
) -> Iterator[SolutionLine]:
    """dL/dt and the torque along the axes, each as it stands."""
    rate = setting.rate(setting.spin)
    if not setting.spin.is_zero:
        yield from _rate_line(setting, rate, _RATE)
    if not leverage:
        yield from _eulers_equations(setting, rate)
        return
    uniform = {s.derivative(): ZERO for s in setting.idle_speeds}
    gained = setting.rate(setting.velocity) * setting.mass
    needed = gained.subs(uniform) - setting.weight
    moment = setting.arm(leverage[0]).cross(needed)
    if setting.spin.is_zero:
        yield from _rows(setting, moment, rate, f"The components of [[{law}]] along {{along}} are")
        return
    equal = "the torque" if law == "eliminated" else f"the rest of [[{law}]]"
    yield from _rows(setting, rate, moment, _written_out(setting, rate, "momentum", equal))


def _rate_line(setting: Setting, rate: Vector, law: str) -> Iterator[SolutionLine]:
    _, written = setting.shortest(rate)
    if len(written) <= WIDEST:
        turns = setting.changes and not setting.body.is_isotropic
        why = ", since the unit vectors change too," if turns else ""
        yield SolutionLine(
            f"The rate of the angular momentum is{why}", f"{law} = {written}", "rate"
        )


def _written_out(setting: Setting, rate: Vector, key: str, equal: str) -> str:
    """What introduces the components of dL/dt, which is displayed before where it is short."""
    if len(setting.shortest(rate)[1]) <= WIDEST:
        return "Along {along} this says"
    changing = " and the rates [[unit1]] to [[unit3]] of the unit vectors"
    return (
        f"With [[{key}]]{changing if setting.changes else ''}, the rate of the angular momentum "
        f"and {equal} have, along {{along}}, the equal components"
    )


def _rows(setting: Setting, rate: Vector, moment: Vector, words: str) -> Iterator[SolutionLine]:
    axes = setting.along
    pairs = zip(
        axes.labels, rate.express(axes).components, moment.express(axes).components, strict=True
    )
    rows = [(label, a, b) for label, a, b in pairs if a or b]
    yield from _listed_rows(rows, words)


def _listed_rows(rows: list[tuple[str, Expr, Expr]], words: str) -> Iterator[SolutionLine]:
    """The rows short enough to be printed; `{along}` in the words stands for their axes."""
    texts = {label: (f"{a.latex()} = {b.latex()}", (a, b)) for label, a, b in rows}
    short = {label: pair for label, pair in texts.items() if len(pair[0]) <= LONGEST}
    if not short:
        return
    words = words.replace("{along}", listed(f"${letter_of(label)}$" for label in short))
    for label, (text, sides) in short.items():
        yield SolutionLine(words, text, f"row_{label}", sides=sides)
        words = ""
    if len(short) < len(texts):
        yield SolutionLine("What follows along the other axes has no short form.")


def _eulers_equations(setting: Setting, rate: Vector) -> Iterator[SolutionLine]:
    """Components of dL/dt, which vanish where no support exerts a couple."""
    axes = setting.along
    restrained = {
        label
        for element in setting.twisting
        for restraint in setting.equations.kinetics.restraints[element.name]
        for label in axes.labels
        if restraint.is_couple and restraint.direction.dot(axes[label])
    }
    free = [
        (label, value, Expr.of(0))
        for label, value in zip(axes.labels, rate.express(axes).components, strict=True)
        if label not in restrained and value
    ]
    why = "no torque acts:" if restrained else "this says"
    yield from _listed_rows(free, f"Along {{along}} {why}")
