"""The quantities of one system that the lines of its solution are made of."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property

from polhode.algebra import ONE, Expr, LetterParts, Symbol, SymbolKind, Vector, variables
from polhode.base import ConstraintError, DeclarationError
from polhode.derive import Equations
from polhode.model import Body, Contact, Element, Frame, Gravity, Pivot
from polhode.solution._letters import definition
from polhode.solution._lines import SolutionLine, is_sum, unit, vector_latex

#: Characters of a formula that fits on a page.
LONGEST = 420
#: Seconds of computing in which a formula has to be decided.
PATIENCE = 20.0
#: Characters of a vector that fits in one line.
WIDEST = 200
#: Letters that may stand for the vector of a force: L is the angular momentum.
_PLAIN = re.compile("[A-KM-Z]|Fprime")
#: How much longer a vector may be along the body's axes before others are taken.
_OTHER_AXES = 1.25


def fits(value: Expr, longest: int = LONGEST) -> bool:
    """Whether an expression can be printed; one of many terms is not written out to be measured."""
    return sum(1 for _ in value.terms()) <= longest // 6 and len(value.latex()) <= longest


@dataclass(frozen=True)
class Setting:
    """A system with one body, or the first body of several.

    Attributes:
        equations: derived from the declaration.
        chosen: the body in question; by default the first.
    """

    equations: Equations
    chosen: Body | None = None

    @property
    def body(self) -> Body:
        """The body."""
        return self.chosen or self.equations.system.bodies[0]

    @property
    def each(self) -> tuple[Setting, ...]:
        """The same system with each of its bodies in turn."""
        return tuple(replace(self, chosen=body) for body in self.equations.system.bodies)

    @property
    def is_single(self) -> bool:
        """Whether there is one body."""
        return len(self.equations.system.bodies) == 1

    @property
    def axes(self) -> Frame:
        """The axes along which the inertia is given."""
        return self.body.axes

    @cached_property
    def frames(self) -> tuple[Frame, ...]:
        """Frames whose labels are unambiguous: the body's axes, the laboratory, those between.

        The letters of several bodies belong to the first that has them.
        """
        root = self.axes.root
        known = {label: root[label] for label in root.labels}
        found = [root]
        bodies = self.equations.system.bodies
        others = [*bodies[0].axes.lineage, *(body.axes for body in bodies)]
        for frame in self.axes.lineage if self.is_single else dict.fromkeys(others):
            vectors = {label: frame[label] for label in frame.labels}
            clash = [k for k, v in vectors.items() if k in known and not (v - known[k]).is_zero]
            if frame != root and not clash:
                known |= vectors
                found.append(frame)
        return tuple(sorted(found, key=lambda f: f != self.axes))

    @cached_property
    def constant(self) -> dict[Symbol, Expr]:
        """Coordinates that the supports keep constant."""
        found = dependent_coordinates(self.equations)
        return {
            q: value
            for q, value in found.items()
            if not value.varies and all(s.kind is not SymbolKind.TIME for s in value.symbols())
        }

    @property
    def along(self) -> Frame:
        """The body's axes, or those of the laboratory where both have the same labels."""
        return self.axes if self.axes in self.frames else self.axes.root

    @property
    def changes(self) -> bool:
        """Whether the unit vectors along which vectors are resolved turn."""
        return self.along == self.axes and not self.turning.is_zero

    def shortest(self, vector: Vector) -> tuple[Frame, str]:
        """The frame along which a vector is short, and the vector there.

        The body's axes are preferred unless the vector is much longer along them. Coordinates that
        the supports keep constant have their values.
        """
        with suppress(ZeroDivisionError):  # a factor vanishes there that others have below a bar
            vector = vector.subs(self.constant)
        written = [(frame, vector_latex(vector, frame)) for frame in self.frames]
        return min(written, key=lambda p: len(p[1]) * (1 if p[0] == self.axes else _OTHER_AXES))

    # -- motion ---------------------------------------------------------------------------------

    @cached_property
    def velocity(self) -> Vector:
        """Of the centre of mass, m/s."""
        return self.equations.kinetics.velocities[self.body][0]

    @cached_property
    def angular_velocity(self) -> Vector:
        """Of the body, rad/s; with the rates of all angles where expressions are kept in parts."""
        if self.equations.in_parts:
            spins = {
                speed: angle.dt() + Expr.generator(speed) - value
                for angle, value in self.body.rates.items()
                for speed in value.symbols()
                if speed.kind is SymbolKind.SPEED
            }
            return self.body.angular_velocity.subs(spins)
        return self.equations.kinetics.velocities[self.body][1]

    @cached_property
    def turning(self) -> Vector:
        """Angular velocity of the axes, rad/s."""
        return self.equations.kinetics.resolve(self.axes.angular_velocity)

    @cached_property
    def spin(self) -> Vector:
        """Angular momentum about the centre of mass, kg m²/s; in the letters of ω."""
        if self.equations.in_parts:
            along = self.angular_velocity.express(self.axes).components
            return Vector(self.body.inertia.times(along), self.axes)
        return self.equations.kinetics.spin(self.body)

    def rate(self, vector: Vector) -> Vector:
        """Time derivative along the motion."""
        return self.equations.kinetics.derivative(vector)

    @cached_property
    def idle_speeds(self) -> frozenset[Symbol]:
        """Speeds that stay constant and on which nothing else depends."""
        rows = self.equations.motion
        found = set()
        for speed in self.equations.speeds:
            own = Expr.generator(speed.derivative())
            others = (s for row in rows if row != own for s in row.symbols())
            if own in rows and speed not in others:
                found.add(speed)
        return frozenset(found)

    # -- forces ---------------------------------------------------------------------------------

    @property
    def gravity(self) -> Gravity | None:
        """The load, if there is one."""
        loads = self.equations.system.loads
        return next((load for load in loads if isinstance(load, Gravity)), None)

    @cached_property
    def up(self) -> Vector | None:
        """Unit vector opposite to gravity."""
        if self.gravity is None:
            return None
        root = self.axes.root
        return self.gravity.up if self.gravity.up is not None else root[root.labels[2]]

    @cached_property
    def up_latex(self) -> str:
        """That vector as a sum of unit vectors of the laboratory; empty without gravity."""
        if self.up is None:
            return ""
        written = vector_latex(self.up, self.axes.root)
        return rf"\left({written}\right)" if is_sum(written) else written

    @cached_property
    def supports(self) -> tuple[Element, ...]:
        """Contacts and joints that exert a force."""
        return tuple(
            e for e in self.equations.system.elements if e.name in self.equations.reactions
        )

    @cached_property
    def forced(self) -> tuple[Element, ...]:
        """Contacts and joints that exert a force besides a couple."""
        reactions = self.equations.reactions
        return tuple(e for e in self.supports if not reactions[e.name].force.is_zero)

    @cached_property
    def twisting(self) -> tuple[Element, ...]:
        """Contacts and joints that exert a couple."""
        reactions = self.equations.reactions
        return tuple(e for e in self.supports if not reactions[e.name].couple.is_zero)

    def arm(self, element: Element) -> Vector:
        """From the centre of mass to where an element acts, m."""
        return self.equations.reactions[element.name].arm

    def force_name(self, element: Element) -> tuple[str, str]:
        """The letter of its force, as declared where no other force has it, and the subscript."""
        declared = [getattr(e, "force", "") for e in self.forced]
        own = getattr(element, "force", "")
        if declared.count(own) == 1 and _PLAIN.fullmatch(own):
            return own.replace("prime", "'"), ""
        if len(self.equations.reactions) == 1:
            return "F", ""
        return "F", _subscript(element.name, self.forced)

    def force_letter(self, element: Element) -> str:
        """LaTeX of the vector of its force."""
        letter, low = self.force_name(element)
        return rf"\mathbf {letter[0]}{letter[1:]}" + (f"_{low}" if low else "")

    def called(self, element: Element) -> str:
        """Where a force comes from, in brackets, unless the letter of the force says it."""
        if len(self.equations.reactions) == 1 or self.force_letter(element).endswith(
            rf"{{\rm {element.name}}}"
        ):
            return ""
        return f" ({self.source(element)})"

    def source(self, element: Element) -> str:
        """Where a force comes from, in words."""
        if len(self.forced) == 1:
            return "the support"
        if isinstance(element, Contact):
            alike = [e for e in self.forced if isinstance(e, Contact) and e.body == element.body]
            if len(alike) > 1:
                return f"the contact “{element.name}”"
            return f"the contact of the {element.body.name}"
        return f"“{element.name}”"

    @property
    def subscript(self) -> str:
        """LaTeX of the subscript of the body's quantities, with its underscore."""
        if self.is_single:
            return r"_{\rm cm}"
        return f"_{_subscript(self.body.name, self.equations.system.bodies)}"

    @property
    def omega_letter(self) -> str:
        """LaTeX of the angular velocity of the body."""
        return r"\boldsymbol\omega" + ("" if self.is_single else self.subscript)

    @property
    def momentum_letter(self) -> str:
        """LaTeX of the angular momentum about the body's centre of mass."""
        return rf"\mathbf L{self.subscript}"

    @property
    def let(self) -> tuple[str, ...]:
        """The definition of that letter for claims, where there are several bodies."""
        if self.spin.is_zero or self.is_single:
            return ()
        return (definition(self.momentum_letter, self.shortest(self.spin)[1]),)

    @property
    def bindings(self) -> dict[str, str]:
        """What letters with subscripts mean, where there are several forces or bodies."""
        found = {}
        loads = self.equations.system.loads
        forces = {self.force_letter(e): f"force of {e.name}" for e in self.forced}
        is_plain = len(self.equations.reactions) == 1 and set(forces) <= {r"\mathbf F"}
        if not is_plain or any(not isinstance(x, Gravity) for x in loads):
            found = forces
        for one in self.each if not self.is_single else ():
            found[rf"\mathbf v{one.subscript}"] = f"velocity of {one.body.name}"
            found[one.omega_letter] = f"angular velocity of {one.body.name}"
            if one.axes in self.frames and one.axes.parent is not None:
                found |= {unit(k): f"axis {k} of axes of {one.body.name}" for k in one.axes.labels}
        return found

    def is_fixed(self, element: Element) -> bool:
        """Whether an element holds a point of the body at rest."""
        return isinstance(element, Pivot) and element.is_at_rest

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """The contacts."""
        return self.equations.system.contacts

    @property
    def mass(self) -> Expr:
        """Of the body, kg."""
        return self.body.mass

    @property
    def weight_latex(self) -> str:
        """m g ẑ, the opposite of the weight; empty without gravity."""
        if self.gravity is None:
            return ""
        return rf"{(self.mass * self.gravity.g).latex()}\,{self.up_latex}"

    @property
    def weight(self) -> Vector:
        """The force of gravity, N."""
        if self.gravity is None or self.up is None:
            return self.axes.zero
        return self.up * (-self.mass * self.gravity.g)


def dependent_coordinates(equations: Equations) -> dict[Symbol, Expr]:
    """Coordinates that constraints give by others, or by constants of the equations of motion.

    A constant that these do not contain, such as the height of a rail, has no meaning to a claim.
    """
    images = dict[Symbol, Expr]()
    known = {*equations.coordinates, *variables([*equations.motion, equations.energy])}
    for closure in equations.closures:
        closed = closure.subs(images)
        for q in equations.coordinates:
            slope = closed.diff(q)
            if slope in (ONE, -ONE) and q.derivative() not in equations.speeds:
                value = Expr.generator(q) - closed / slope
                if not value.symbols() <= known:
                    continue
                images = {s: v.subs({q: value}) for s, v in images.items()} | {q: value}
                break
    return images


def _subscript(name: str, things: Sequence[Body] | Sequence[Element]) -> str:
    """A name of one word, a word that no other name has, or the number of the thing."""
    words = [re.split(r"[ _]", thing.name) for thing in things]
    own = re.split(r"[ _]", name)
    for word in (own[0], own[-1]):
        if word.isalpha() and sum(word in others for others in words) == 1:
            return rf"{{\rm {word}}}"
    return f"{{{[thing.name for thing in things].index(name) + 1}}}"


def bound(setting: Setting, line: SolutionLine) -> SolutionLine:
    """A line with the meanings of the letters in it that have subscripts."""
    text = " ".join((line.latex, *line.let))
    used = {letter: what for letter, what in setting.bindings.items() if letter in text}
    if used:
        equations = setting.equations
        names = [s.published for s in (*equations.speeds, *equations.coordinates)]
        names += equations.components
        letters = {
            Expr.generator(Symbol(name)).latex(): name for name in names if "_dot" not in name
        }
        used |= {k: f"declared {name}" for k, name in letters.items() if k in text and "_" in k}
    return replace(line, bindings={**used, **line.bindings}) if used else line


def setting_of(equations: Equations) -> Setting:
    """The setting of a system that can be worked on paper.

    Raises:
        ConstraintError: where a contact slides with friction, or nothing moves.
        DeclarationError: for a parameter d, which formulas would show as a differential.
    """
    places = equations.kinetics.places
    if any(element.friction(places) for element in equations.kinetics.elements):
        raise ConstraintError(
            f"a worked solution of {equations.system.name!r}, with sliding friction or a couple of "
            "rolling resistance",
            expected="contacts that roll or have no friction: the direction of friction "
            "changes with the motion, and nothing has a short form",
            advice="simulate it, or replace Coulomb by Rolling or Smooth, and leave out rolling "
            "resistance and drilling friction",
        )
    symbols = (*equations.parameters, *equations.coordinates, *equations.speeds)
    words = sorted({s.base().name for s in symbols if LetterParts.of(s.base().name).is_word})
    if words:
        raise DeclarationError(
            f"a worked solution of {equations.system.name!r}, with quantities called "
            f"{', '.join(words)}",
            expected="letters, such as m, x1 or theta_2: in a formula a word is read as words",
            advice="declare them under other names",
        )
    if not equations.speeds:
        raise ConstraintError(
            f"a worked solution of {equations.system.name!r}, which cannot move",
            expected="at least one independent speed",
        )
    return Setting(equations)
