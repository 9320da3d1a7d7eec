"""Several bodies or several supports: the laws of each body, and d'Alembert's principle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, Vector, has_parts
from polhode.base import NumericError
from polhode.model import Action, Contact, Element, Gravity, Load, Rim, Share
from polhode.solution._lines import (
    SolutionLine,
    bracketed,
    inline,
    is_sum,
    joined,
    letter_of,
    listed,
)
from polhode.solution._setting import LONGEST, Setting, bound


def body_by_body(setting: Setting) -> Iterator[SolutionLine]:
    """Newton's law and the torque for each body, and the forces of the supports eliminated."""
    yield from laws_of_bodies(setting)
    bodies = [_Body(one) for one in setting.each]
    for line in (*_rates(bodies), *_without_reactions(setting, bodies)):
        yield bound(setting, line)


def laws_of_bodies(setting: Setting) -> Iterator[SolutionLine]:
    """Newton's law and the torque for each body."""
    for one in setting.each:
        for line in _laws(_Body(one)):
            yield bound(setting, line)


def applied_to(one: Setting) -> tuple[Action, ...]:
    """The forces and couples of the loads besides gravity on the body of a setting."""
    return _Body(one).applied


@dataclass(frozen=True)
class _Body:
    """One body with what acts on it.

    Attributes:
        setting: with this body chosen.
    """

    setting: Setting

    @property
    def name(self) -> str:
        """In words."""
        return self.setting.body.name

    @property
    def velocity(self) -> str:
        """LaTeX of v."""
        return rf"\mathbf v{self.setting.subscript}"

    @property
    def momentum(self) -> str:
        """LaTeX of the angular momentum about the centre of mass."""
        return self.setting.momentum_letter

    @property
    def let(self) -> tuple[str, ...]:
        """The definition of the angular momentum."""
        return self.setting.let

    def written(self, vector: Vector) -> str:
        """A vector along the axes in which it is shortest."""
        return self.setting.shortest(vector)[1]

    def shares(self, element: Element) -> Iterator[tuple[Expr, Share]]:
        """The components of a reaction, each with how one unit of it acts on this body."""
        equations = self.setting.equations.in_lengths
        for restraint in equations.kinetics.restraints[element.name]:
            for share in restraint.shares():
                if share.body == self.setting.body:
                    yield Expr.generator(Symbol(restraint.name)), share

    def sign(self, element: Element) -> int:
        """1 for the body that a support holds, -1 for the one that it is fixed to."""
        return 1 if self.setting.equations.reactions[element.name].body == self.setting.body else -1

    def arm(self, element: Element) -> Vector:
        """From the centre of mass to where the force of a support acts."""
        arms = (share.arm for _, share in self.shares(element) if share.arm is not None)
        return next(arms, self.setting.axes.zero)

    @property
    def supports(self) -> tuple[Element, ...]:
        """Supports whose force acts on this body, with its opposite on a neighbour."""
        forced = [e for e in self.setting.forced if not self._spreads(e)]
        return tuple(e for e in forced if any(s.arm is not None for _, s in self.shares(e)))

    @property
    def spread(self) -> tuple[tuple[str, Vector, Vector], ...]:
        """Forces of constraints on several bodies: their letters, the forces and their arms."""
        return tuple(
            (f"{inline(value)} (“{element.name}”)", share.direction * value, share.arm)
            for element in self.setting.supports
            if self._spreads(element)
            for value, share in self.shares(element)
            if share.arm is not None and self.occurs(value)
        )

    @property
    def loads(self) -> tuple[tuple[Load, Action], ...]:
        """The forces and couples of the loads besides gravity, with the loads."""
        equations = self.setting.equations.in_lengths
        return tuple(
            (load, action)
            for load in equations.system.loads
            if not isinstance(load, Gravity)
            for action in equations.actions(load)
            if action.body == self.setting.body
        )

    @property
    def applied(self) -> tuple[Action, ...]:
        """Those forces and couples alone."""
        return tuple(action for _, action in self.loads)

    def _spreads(self, element: Element) -> bool:
        restraints = self.setting.equations.kinetics.restraints[element.name]
        return any(restraint.more for restraint in restraints)

    def couple(self) -> Vector:
        """The sum of all couples, by the letters of their components."""
        total = self.setting.axes.zero
        for element in self.setting.supports:
            for value, share in self.shares(element):
                if share.arm is None and self.occurs(value):
                    total = total + share.direction * value
        for action in self.applied:
            total = total + action.couple + action.arm.cross(action.force)
        return total

    def occurs(self, value: Expr) -> bool:
        """Whether a component of a reaction is not zero throughout."""
        symbol = value.symbol
        components = self.setting.equations.components
        return symbol is not None and bool(components.get(symbol.published, ZERO))


# -- laws ------------------------------------------------------------------------------------------


def _laws(body: _Body) -> Iterator[SolutionLine]:
    setting = body.setting
    if setting.body.is_massless:
        yield SolutionLine(f"The {body.name} has no mass; the forces on it balance.")
        return
    pushed = any(not action.force.is_zero for action in body.applied)
    if not setting.velocity.is_zero or body.supports or body.spread or pushed:
        yield _newton(body)
    yield from _torque(body)


def velocities_of_bodies(setting: Setting) -> Iterator[SolutionLine]:
    """Velocity, angular velocity and angular momentum of each body."""
    for one in setting.each:
        if not one.body.is_massless:
            for line in _motion(_Body(one)):
                yield bound(setting, line)


def _named_components(setting: Setting) -> str:
    """The letters of components of the angular velocity along the body's axes, as declared."""
    axes = setting.body.axes
    pairs = zip(axes.labels, setting.angular_velocity.express(axes).components, strict=True)
    named = [
        f"{inline(value)} for its component along axis ${letter_of(label)}$ of the body"
        for label, value in pairs
        if value.symbol is not None
        and value.symbol.kind is SymbolKind.SPEED
        and not value.symbol.order
    ]
    return f", with {listed(named)}," if named else ""


def _motion(body: _Body) -> Iterator[SolutionLine]:
    setting, start = body.setting, f"The {body.name}:"
    subject = [(body.velocity, setting.velocity, "the velocity of its centre of mass is")]
    if setting.velocity.is_zero:
        subject = []
        start = f"The centre of mass of the {body.name} stays at rest;"
    if not setting.spin.is_zero:
        omega = setting.omega_letter
        words = f"its angular velocity{_named_components(setting)} is"
        subject.append((omega, setting.angular_velocity, words))
    for letter, vector, words in subject:
        written = body.written(vector)
        if len(written) > LONGEST:
            yield SolutionLine(f"{start} {words} too long to be written out.")
        else:
            yield SolutionLine(f"{start} {words}", f"{letter} = {written}")
        start = "and"
    if not setting.spin.is_zero and len(body.let[0]) <= LONGEST:
        yield SolutionLine(
            "and its angular momentum about the centre of mass is",
            body.let[0].replace("{" + body.momentum + "}", body.momentum, 1),
            context="identity",
            let=body.let,
        )


def _newton(body: _Body) -> SolutionLine:
    setting = body.setting
    forces = [f"{'-' if body.sign(e) < 0 else ''}{setting.force_letter(e)}" for e in body.supports]
    weight = [f"-{setting.weight_latex}"] if setting.weight_latex else []
    pushed = [(load, action.force) for load, action in body.loads if not action.force.is_zero]
    unnamed = [force for _, force, _ in body.spread] + [force for _, force in pushed]
    written = map(body.written, unnamed)
    spread = [bracketed(text) if is_sum(text) else text for text in written]
    left = joined([*forces, *spread, *weight] or ["0"])
    own = [e for e in body.supports if body.sign(e) > 0]
    acting = [f"${setting.force_letter(e)}${setting.called(e)}" for e in own]
    passed = [f"$-{setting.force_letter(e)}$" for e in body.supports if body.sign(e) < 0]
    if passed:
        whose = "the reaction of its neighbour" if len(passed) == 1 else "reactions of neighbours"
        acting.append(f"{listed(passed)} ({whose})")
    acting += dict.fromkeys(name for name, _, _ in body.spread)
    acting += dict.fromkeys(f"“{load.name}”" for load, _ in pushed)
    acting += ["the weight"] if weight and acting else []
    words = f"Newton's law for the {body.name} is"
    if acting:
        verb = "acts" if len(body.supports) + len(weight) + len(spread) == 1 else "act"
        words = f"On the {body.name} {verb} {listed(acting)}. Newton's law is"
    right = "0"
    if not setting.velocity.is_zero:
        right = rf"{setting.mass.latex()}\frac{{d{body.velocity}}}{{dt}}"
    text = f"{left} = {right}"
    if len(text) > LONGEST:
        return SolutionLine(f"{words.removesuffix(' is')} has no short form.")
    key = "newton" if setting.is_single else f"newton_{setting.subscript}"
    return SolutionLine(words, text, key)


def lowest_point(one: Setting, element: Element, arm: Vector) -> tuple[str, tuple[str, ...]]:
    """The vector to where a force acts, and the definition of its letter where it needs one."""
    rim = one.body.surface
    if not any(map(has_parts, arm.components)) or not isinstance(rim, Rim):
        return bracketed(one.shortest(arm)[1]), ()
    if not isinstance(element, Contact):
        raise NumericError(
            f"the arm of {element.name!r}, which is kept in named parts",
            expected="an arm that can be written out",
            advice="work on a part of the system, or simulate",
        )
    up = one.shortest(element.on.up)[1]
    axle = bracketed(one.shortest(one.axes[rim.axis])[1])
    across = rf"{up}\cdot {axle}"
    text = (
        rf"-\frac{{{rim.radius.latex()}}}{{\sqrt{{1 - \left({across}\right)^2}}}}"
        rf"\left({up} - \left({across}\right){axle}\right)"
    )
    return r"\mathbf a", (rf"{{\mathbf a}} = {text}",)


def _torque(body: _Body) -> Iterator[SolutionLine]:
    setting = body.setting
    levers = [e for e in body.supports if not body.arm(e).is_zero]
    couple = body.couple()
    terms, let = [], body.let
    for element in levers:
        lever, named = lowest_point(setting, element, body.arm(element) * body.sign(element))
        terms.append(rf"{lever}\times {setting.force_letter(element)}")
        let = (*let, *named)
    for _, force, arm in body.spread:
        if not arm.is_zero:
            lever = bracketed(body.written(arm))
            terms.append(rf"{lever}\times {bracketed(body.written(force))}")
    if not couple.is_zero:
        terms.append(body.written(couple))
    if setting.spin.is_zero and not terms:
        return
    right = "0" if setting.spin.is_zero else rf"\frac{{d{body.momentum}}}{{dt}}"
    text = f"{joined(terms or ['0'])} = {right}"
    if len(text) > LONGEST:
        yield SolutionLine(
            f"The torque about the centre of mass of the {body.name} has no short form."
        )
        return
    shares = (pair for element in setting.supports for pair in body.shares(element))
    has_letters = any(share.arm is None and body.occurs(value) for value, share in shares)
    letters = ", with letters for the components of the couples," if has_letters else ""
    words = f"The torque about the centre of mass of the {body.name}{letters} is"
    if setting.spin.is_zero:
        words = (
            "Since its moments of inertia vanish, so does the torque about its centre of "
            f"mass{letters.rstrip(',')}:"
        )
    yield SolutionLine(words, text, let=let)


# -- rates -----------------------------------------------------------------------------------------


def _rates(bodies: list[_Body]) -> Iterator[SolutionLine]:
    """Accelerations and rates of angular momenta, where they are short."""
    found = list[tuple[str, str, tuple[str, ...]]]()
    names = dict[str, None]()
    for body in bodies:
        setting = body.setting
        if not setting.body.is_massless and not setting.velocity.is_zero:
            found.append((body.velocity, body.written(setting.rate(setting.velocity)), ()))
            names["the acceleration"] = None
        if not setting.spin.is_zero:
            found.append((body.momentum, body.written(setting.rate(setting.spin)), body.let))
            names["the rate of the angular momentum"] = None
    shown = [one for one in found if len(one[1]) <= LONGEST]
    words = f"{listed(names)} {'is' if len(found) == 1 else 'are'}" if found else ""
    if len(bodies) > 1:
        words = words.replace("acceleration", "accelerations").replace("momentum", "momenta")
        words = words.replace("rate of", "rates of").replace(" is", " are")
    if len(bodies) > 1 and any(body.setting.changes for body in bodies):
        words = (
            "a unit vector along axes that turn at $\\boldsymbol\\omega$ changes at the rate "
            f"$\\boldsymbol\\omega\\times\\hat{{\\mathbf e}}$. Hence {words}"
        )
    words = words[:1].upper() + words[1:]
    for letter, written, let in shown:
        yield SolutionLine(words, rf"\frac{{d{letter}}}{{dt}} = {written}", let=let)
        words = ""
    if shown and len(shown) < len(found):
        yield SolutionLine("The others have no short form.")


# -- elimination -----------------------------------------------------------------------------------


def _without_reactions(setting: Setting, bodies: list[_Body]) -> Iterator[SolutionLine]:
    words = (
        "The forces of the supports are not known, and they do no work in any motion that the "
        "supports allow. So take the scalar product of every law with the velocity or the angular "
        "velocity which the body has when one speed is 1 and all others are zero, and add: the "
        "forces of the supports drop out. This is d'Alembert's principle. "
    )
    for speed in setting.equations.speeds:
        terms = [term for body in bodies for term in _projected(body, speed)]
        text = f"{joined(terms or ['0'])} = 0"
        let = tuple(definition for body in bodies for definition in body.let)
        value = inline(speed)[:-1] + " = 1$"
        if len(text) > LONGEST:
            yield SolutionLine(f"{words}With {value} it gives an equation without a short form.")
        else:
            key = f"projected_{speed.published}"
            yield SolutionLine(f"{words}With {value} it gives", text, key, let=let)
        words = ""


def partial_products(setting: Setting, speed: Symbol) -> str:
    """The rates of momentum of all bodies times their partial velocities; empty for none."""
    terms = []
    for body in map(_Body, setting.each):
        one, variable = body.setting, Expr.generator(speed)
        along, about = one.velocity.diff(variable), one.angular_velocity.diff(variable)
        if not along.is_zero and not one.body.is_massless:
            rate = rf"{one.mass.latex()}\frac{{d{body.velocity}}}{{dt}}"
            terms.append(rf"{rate}\cdot {bracketed(body.written(along))}")
        if not about.is_zero and not one.spin.is_zero:
            rate = rf"\frac{{d{body.momentum}}}{{dt}}"
            terms.append(rf"{rate}\cdot {bracketed(body.written(about))}")
    return joined(terms) if terms else ""


def _projected(body: _Body, speed: Symbol) -> Iterator[str]:
    """The products of the laws of a body with its partial velocities."""
    setting, variable = body.setting, Expr.generator(speed)
    if setting.body.is_massless:
        return
    zero = setting.axes.zero
    along = setting.velocity.diff(variable)
    force = sum((action.force for action in body.applied), zero)
    if not along.is_zero:
        terms = [rf"{setting.mass.latex()}\frac{{d{body.velocity}}}{{dt}}"]
        terms += [setting.weight_latex] if setting.weight.dot(along) else []
        terms += [body.written(-force)] if force.dot(along) else []
        law = rf"\left({joined(terms)}\right)" if len(terms) > 1 else terms[0]
        yield rf"{law}\cdot {bracketed(body.written(along))}"
    about = setting.angular_velocity.diff(variable)
    moment = sum((action.couple + action.arm.cross(action.force) for action in body.applied), zero)
    if not about.is_zero and not setting.spin.is_zero:
        terms = [rf"\frac{{d{body.momentum}}}{{dt}}"]
        terms += [body.written(-moment)] if moment.dot(about) else []
        law = rf"\left({joined(terms)}\right)" if len(terms) > 1 else terms[0]
        yield rf"{law}\cdot {bracketed(body.written(about))}"
