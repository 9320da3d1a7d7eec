"""Computations that answer questions about a system: forces, instants, oscillations, torques."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, Vector, sqrt, taylor
from polhode.analyse import (
    departures,
    fictitious_torque,
    frame_along,
    frames_of,
    relative_momentum,
    relative_rate,
    steady,
    values_given,
)
from polhode.base import ConstraintError, DeclarationError, look_up
from polhode.derive import Equations, derive
from polhode.model import Contact, Coulomb, Element, Frame, System
from polhode.solution._lines import SolutionLine, inline, letter_of, listed, unit, vector_latex
from polhode.solution._questions import Derivation
from polhode.solution._setting import LONGEST, Setting

_EPSILON = Expr.generator(Symbol("epsilon", SymbolKind.COORDINATE))


def _known(setting: Setting, name: str) -> Expr:
    """A coordinate, speed, rate, acceleration or reaction by its published name."""
    equations = setting.equations
    symbols = (*equations.coordinates, *equations.speeds, *equations.kinematics)
    found = {s.published: Expr.generator(s) for s in symbols}
    for function in map(Expr.generator, equations.functions):  # prescribed, with their rates
        found |= {s.published: Expr.generator(s) for s in _rates(function)}
    found |= {s.derivative().published: Expr.generator(s.derivative()) for s in equations.speeds}
    found |= {name: Expr.generator(Symbol(name)) for name in equations.components}
    return look_up(name, found, f"quantity of {equations.system.name}")


def _rates(value: Expr) -> Iterator[Symbol]:
    for each in (value, value.dt(), value.dt().dt()):
        if each.symbol is not None:
            yield each.symbol


def _conditions(setting: Setting, given: Mapping[str, str]) -> tuple[str, ...]:
    """Values of quantities of the motion as LaTeX relations."""
    return tuple(f"{_known(setting, name).latex()} = {value}" for name, value in given.items())


@dataclass(frozen=True)
class ForceAlong:
    """The force of a support by its components along some axes.

    Attributes:
        element: name of the contact or joint.
        axes: labels, such as "rho,phi,z".
        given: what restricts the motion, by published name; accelerations that it makes vanish
            are named too.
        context: motion, or steady.
        when: words for that restriction.
    """

    element: str
    axes: str
    given: Mapping[str, str] = field(default_factory=dict)
    context: str = "motion"
    when: str = ""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """One line for each component."""
        setting = found.setting
        equations = setting.equations
        frame, labels = frame_along(equations.system, self.axes)
        element = equations.system.element(self.element)
        force = equations.reactions[self.element].force
        parts = dict(zip(frame.labels, force.express(frame).components, strict=True))
        values = _values(setting, self.given)
        start = f"{self.when} the" if self.when else "The"
        along = listed(f"${letter_of(label)}$" for label in labels)
        words = f"{start} force of {setting.source(element)} along {along} is"
        for label in labels:
            name = _component(setting, element, frame, label)
            value = parts[label].subs(values)
            if not parts[label] and not name.startswith(Expr.generator(Symbol("F")).latex()):
                continue
            text = f"{name} = {value.latex()}"
            if len(text) <= LONGEST:
                kept = () if self.context == "steady" else _conditions(setting, self.given)
                yield SolutionLine(words, text, f"along_{label}", context=self.context, given=kept)
                words = ""


def _values(setting: Setting, given: Mapping[str, str]) -> dict[Symbol, Expr]:
    values: dict[Symbol, Expr] = {}
    for name, value in given.items():
        symbol = _known(setting, name).symbol
        if symbol is not None:
            values[symbol] = Expr.constant(int(value))
    return values


def _component(setting: Setting, element: Element, frame: Frame, label: str) -> str:
    """LaTeX of the component of a force: its own letter, or a product with the unit vector."""
    for restraint in setting.equations.kinetics.restraints[element.name]:
        if not restraint.is_couple and (restraint.direction - frame[label]).is_zero:
            return Expr.generator(Symbol(restraint.name)).latex()
    return rf"{setting.force_letter(element)}\cdot {unit(label)}"


@dataclass(frozen=True)
class AtInstant:
    """Accelerations and reactions at an instant, in terms of the state there.

    Attributes:
        given: the state, by published name, such as {"theta_dot": "0"}.
        quantities: published names of accelerations and reactions.
        when: words for the instant.
    """

    given: Mapping[str, str]
    quantities: tuple[str, ...]
    when: str

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """One line for each quantity."""
        setting = found.setting
        equations = setting.equations
        state = _values(setting, self.given)
        words = f"{self.when}, the equations of motion and the forces give"
        for name in self.quantities:
            quantity = _known(setting, name)
            exact = equations.on_shell(equations.components.get(name, quantity)).subs(state)
            yield SolutionLine(
                words,
                f"{quantity.latex()} = {exact.latex()}",
                f"instant_{name}",
                given=_conditions(setting, self.given),
            )
            words = ""


@dataclass(frozen=True)
class RateOf:
    """How the rate of a coordinate changes.

    Attributes:
        coordinate: published name.
        why: words for the reason.
    """

    coordinate: str
    why: str = ""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """Its second derivative, without the speeds that stay constant."""
        setting = found.setting
        letter = _known(setting, self.coordinate)
        rates = {s.published: rate for s, rate in setting.equations.kinematics.items()}
        rate = look_up(f"{self.coordinate}_dot", rates, "rate of a coordinate")
        derivatives = [s.derivative() for s in setting.equations.speeds]
        idle = {s: ZERO for s in derivatives if Expr.generator(s) in setting.equations.motion}
        change = rate.dt().subs(idle)
        yield SolutionLine(self.why, f"{letter.dt().dt().latex()} = {change.latex()}", "rate_of")


@dataclass(frozen=True)
class SmallOscillation:
    """The small oscillation of an angle about a steady value, for some small parameter.

    Attributes:
        angle: published name of the coordinate.
        value: about which it oscillates, such as "0".
        small: parameter of which only the first power counts.
        body: ratios of moments of inertia, such as {"I_3": "2*I_1"}, and the words for them.
        kind: words for that body, such as "for a hoop".
    """

    angle: str
    value: str
    small: str
    body: Mapping[str, str] = field(default_factory=dict)
    kind: str = ""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """The linear equation to first order, for a body of that kind, and its frequency."""
        setting = found.setting
        angle = _known(setting, self.angle).symbol
        small = _parameter(setting, self.small)
        if angle is None:
            return
        slope = self._slope(setting, angle, small)
        letter = _known(setting, self.angle)
        bend = letter.dt().dt().latex()
        order = (f"{self.small}:1", f"{self.angle}:1")
        yield SolutionLine(
            f"For small {inline(letter)}, and to first order in {inline(small)},",
            rf"{bend} \approx {(slope * letter).latex()}",
            "swing",
            "limit",
            small=order,
        )
        images = _read(setting, self.body)
        special = slope.subs(images)
        given = tuple(f"{name} = {value}" for name, value in self.body.items())
        if self.body:
            yield SolutionLine(
                f"and {self.kind}, with {listed(_equalities(setting, self.body))},",
                rf"{bend} \approx {(special * letter).latex()}",
                "swing_of_kind",
                "limit",
                small=order,
                given=given,
            )
        rate = sqrt(-special)
        squared = SolutionLine(
            "",
            rf"{bend} \approx -\left({rate.latex()}\right)^2 {letter.latex()}",
            context="limit",
            small=order,
            given=given,
            positive=tuple(str(Expr.generator(s)) for s in rate.symbols()),
        )
        yield SolutionLine(
            f"This is a simple harmonic motion of angular frequency {inline(rate)}.",
            stated=(squared,),
        )

    def _slope(self, setting: Setting, angle: Symbol, small: Symbol) -> Expr:
        """The factor of the angle in its second derivative, to first order."""
        for family in steady(setting.equations, {angle: self.value}):
            if family.relations or any(s.order == 0 and s != angle for s in family.fixed):
                continue
            rows = departures(family, names={angle: _EPSILON}).equations
            bend = _EPSILON.dt().dt().symbol
            row = next((r for r in rows if bend in r.symbols()), None)
            if row is not None and bend is not None and _EPSILON.symbol is not None:
                return taylor(-row.diff(_EPSILON.symbol) / row.diff(bend), small, 1)
        raise ConstraintError(
            f"small oscillations of {self.angle} about {self.value} in "
            f"{setting.equations.system.name!r}",
            expected="a steady motion there with any speeds",
        )


def _read(setting: Setting, values: Mapping[str, str]) -> dict[Symbol, Expr]:
    """Values of parameters, which may contain others."""
    parameters = {s.published: s for s in setting.equations.parameters}
    return values_given(setting.equations, values, parameters)


def _equalities(setting: Setting, values: Mapping[str, str]) -> Iterator[str]:
    images = _read(setting, values)
    for symbol, value in images.items():
        yield f"${Expr.generator(symbol).latex()} = {value.latex()}$"


@dataclass(frozen=True)
class CoriolisTorque:
    """The torque of the Coriolis force on the body, about its centre of mass.

    Attributes:
        frame: name of the turning frame.
        given: published names with values, such as {"theta_dot": "0"}.
        when: words for that.
        free: label of an axis of the body about which nothing else acts to first order; empty for
            none.
        small: the parameter whose first power counts there.
    """

    frame: str
    given: Mapping[str, str] = field(default_factory=dict)
    when: str = ""
    free: str = ""
    small: str = ""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """The sum over all elements of the body."""
        setting = found.setting
        equations, axes = setting.equations, setting.axes
        frame = look_up(self.frame, frames_of(equations.system), "frame")
        turning = equations.kinetics.resolve(frame.angular_velocity)
        values = _values(setting, self.given)
        relative = _with(setting.angular_velocity - turning, values, axes)
        torque = _with(fictitious_torque(equations, setting.body, frame).coriolis, values, axes)
        yield SolutionLine(
            f"The frame “{self.frame}” turns at",
            rf"\boldsymbol\Omega = {vector_latex(turning, axes)}",
            "turning",
            "identity",
            bindings={r"\boldsymbol\Omega": f"angular velocity of {self.frame}"},
        )
        yield SolutionLine(
            f"As seen from them the {setting.body.name} turns at ${vector_latex(relative, axes)}$"
            f"{f' {self.when}' if self.when else ''}. An element $dm$ at $\\mathbf r$ from the "
            "centre, which moves at $\\mathbf v$ there, is subject to the Coriolis force "
            "$-2\\,dm\\,\\boldsymbol\\Omega\\times\\mathbf v$. Its torque "
            "$-2\\,dm\\,\\mathbf r\\times(\\boldsymbol\\Omega\\times\\mathbf v)$, summed over the "
            "body by means of the moments of inertia, is",
            rf"\boldsymbol\tau = {vector_latex(torque, axes)}",
            "coriolis",
            "identity",
            given=_conditions(setting, self.given),
            bindings={r"\boldsymbol\tau": f"Coriolis torque in {self.frame}"},
        )
        if self.free:
            yield self._consequence(setting, frame, torque)

    def _consequence(self, setting: Setting, frame: Frame, torque: Vector) -> SolutionLine:
        """The rate of the relative angular momentum along the free axis, and the torque."""
        equations, axes = setting.equations, setting.axes
        place = axes.labels.index(self.free)
        momentum = relative_momentum(equations, setting.body, frame)
        rate = relative_rate(equations, momentum, frame).express(axes).components[place]
        return SolutionLine(
            f"About axis ${letter_of(self.free)}$ the supports exert no torque, and to first order "
            f"in {inline(_parameter(setting, self.small))} this alone changes the angular momentum "
            "as seen from there:",
            rf"{rate.latex()} \approx {torque.express(axes).components[place].latex()}",
            "free_axis",
            "limit",
            small=(f"{self.small}:1",),
        )


def _parameter(setting: Setting, name: str) -> Symbol:
    return look_up(name, {s.published: s for s in setting.equations.parameters}, "parameter")


def _with(vector: Vector, values: Mapping[Symbol, Expr], axes: Frame) -> Vector:
    return axes.vector(*(c.subs(dict(values)) for c in vector.express(axes).components))


@dataclass(frozen=True)
class WhateverForce:
    """What a contact leaves unchanged whatever force it exerts, and what that fixes.

    Attributes:
        contact: name of the contact, at a constant vector from the centre of mass.
        at_rest: published names of the rates of the support with the value zero.
    """

    contact: str
    at_rest: tuple[str, ...] = ()

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """The conserved vector, rolling and sliding, and its value for rolling at rest."""
        setting = found.setting
        equations = setting.equations
        element = equations.system.element(self.contact)
        arm, mass = setting.arm(element), setting.mass.latex()
        if not setting.rate(arm).is_zero or not arm.cross(setting.weight).is_zero:
            raise ConstraintError(
                f"what the contact {self.contact!r} leaves unchanged",
                expected="a contact straight below or above the centre of mass",
            )
        let = (rf"\mathbf a = {vector_latex(arm, setting.along)}",)
        kept = rf"\mathbf L_{{\rm cm}} - \mathbf a\times {mass}\mathbf v_{{\rm cm}}"
        yield SolutionLine(
            f"Let $\\mathbf F$ be whatever force the support exerts at $\\mathbf a$, "
            f"${let[0]}$. Its torque about the centre of mass is",
            r"\frac{d\mathbf L_{\rm cm}}{dt} = \mathbf a\times\mathbf F",
            "whatever_torque",
            let=let,
        )
        words = (
            "By Newton’s law $\\mathbf F$ is the rate of the momentum less the weight, and the "
            "weight has no torque about a point above or below it. Since $\\mathbf a$ is constant,"
        )
        law = rf"\frac{{d}}{{dt}}\left({kept}\right) = 0"
        yield SolutionLine(words, law, "whatever", let=let)
        yield SolutionLine(
            "That it rolls was not used, and friction may be of any kind. While it slides with "
            "Coulomb’s friction, for instance, with any coefficient $\\mu$ the same holds:",
            law,
            "whatever_sliding",
            let=let,
            of=_sliding(setting, element),
        )
        values = _values(setting, dict.fromkeys(self.at_rest, "0"))
        total = setting.spin - arm.cross(setting.velocity * setting.mass)
        written = vector_latex(_with(total, values, setting.along), setting.along)
        yield SolutionLine(
            "On a support at rest rolling makes this",
            f"{kept} = {written}",
            "whatever_rolling",
            "identity",
            let=let,
            given=_conditions(setting, dict.fromkeys(self.at_rest, "0")),
        )
        speeds = listed(inline(s) for s in equations.speeds)
        yield SolutionLine(
            f"The vector that stays constant thus determines {speeds}. Whatever happens between, "
            "they have their first values again whenever it rolls on a support at rest."
        )


def _sliding(setting: Setting, element: Element) -> Equations:
    """The same system with a contact that slides with Coulomb's friction."""
    system = setting.equations.system
    if not isinstance(element, Contact):
        raise DeclarationError(
            f"friction at {element.name!r}, which is no contact", expected="a contact"
        )
    mu = Expr.generator(Symbol("mu", positive=True))
    slides = Coulomb(element.body, on=element.on, mu=mu, name=element.name)
    others = [slides if e is element else e for e in system.elements]
    return derive(System(*others, *system.loads, name=system.name))


@dataclass(frozen=True)
class SlidingOnRest:
    """How the centre moves while a contact slides over a support at rest.

    Attributes:
        contact: name of the contact.
        at_rest: published names of the rates of the support with the value zero.
    """

    contact: str
    at_rest: tuple[str, ...] = ()

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """The force is constant while it slides, and zero while it rolls."""
        setting = found.setting
        element = setting.equations.system.element(self.contact)
        given = _conditions(setting, dict.fromkeys(self.at_rest, "0"))
        yield SolutionLine(
            "While it slides over a support at rest with Coulomb’s friction, the force keeps its "
            "direction besides its magnitude:",
            r"\frac{d\mathbf F}{dt} = 0",
            "sliding",
            given=given,
            of=_sliding(setting, element),
        )
        yield SolutionLine(
            "The acceleration is constant, and the path a parabola, or a straight line if the "
            "velocity lies along it. Once it rolls there,",
            r"\frac{d\mathbf v_{\rm cm}}{dt} = 0",
            "straight",
            given=given,
        )


@dataclass(frozen=True)
class LeastForces:
    """The forces of supports that Newton's laws do not determine, and the least of them."""

    def lines(self, found: Derivation) -> Iterator[SolutionLine]:
        """What is determined, what is open, and the choice with the least sum of squares."""
        equations = found.setting.equations
        open_ = equations.undetermined
        letters = {name: Expr.generator(Symbol(name)) for name in equations.components}
        words = "Newton’s laws determine"
        for name, letter in letters.items():
            if name not in open_:
                value = equations.components[name]
                yield SolutionLine(words, f"{letter.latex()} = {value.latex()}", f"force_{name}")
                words = ""
        free = [name for name in open_ if equations.components[name] == letters[name]]
        bound = [name for name in open_ if name not in free]
        words = f"{listed(inline(letters[n]) for n in free)} may have any value; then"
        for name in bound:
            value = equations.components[name]
            yield SolutionLine(words, f"{letters[name].latex()} = {value.latex()}", f"open_{name}")
            words = ""
        words = "Of all these the choice with the least sum of squares is"
        for name in open_:
            value = equations.least[name]
            yield SolutionLine(
                words,
                f"{letters[name].latex()} = {value.latex()}",
                f"least_{name}",
                bindings={letters[name].latex(): f"least {name}"},
            )
            words = ""
