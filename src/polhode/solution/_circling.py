"""A circle at constant angular rate with a steady drift, and the charge that moves alike."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import Expr, Vector, pi, sqrt
from polhode.analyse import Circling
from polhode.model import Frame
from polhode.solution._letters import definition, free_letter, letter_latex
from polhode.solution._lines import SolutionLine, bracketed, is_sum, listed, unit, vector_latex
from polhode.solution._setting import Setting

_V = r"\mathbf v_{\rm cm}"
_W = r"\mathbf w"


def circling(setting: Setting, family: Circling) -> Iterator[SolutionLine]:
    """The circle: angular rate, radius, centre; the drift; crossed electric and magnetic fields."""
    plane = _plane(setting, family)
    if plane is None:
        return
    push = plane.frame[plane.first] * family.push[0] + plane.frame[plane.second] * family.push[1]
    rate = letter_latex(free_letter(setting.equations, "Lambda", "nu", "mu"))
    circle = _Circle(plane, rate, family.rate, push)
    yield from _law(circle)
    yield from _drift(circle)
    yield from _circle(setting, family, circle)
    yield from _charge(setting, family, circle)


@dataclass(frozen=True)
class _Plane:
    """The plane of a circle.

    Attributes:
        frame: at rest.
        first, second, normal: labels of its axes, right-handed.
    """

    frame: Frame
    first: str
    second: str
    normal: str


def _plane(setting: Setting, family: Circling) -> _Plane | None:
    along = [setting.velocity.diff(Expr.generator(speed)) for speed in family.velocity]
    for frame in filter(_rests, setting.frames):
        labels = [k for d in along for k in frame.labels if (d - frame[k]).is_zero]
        if len(labels) != 2:
            continue
        first, second = labels
        across = frame[first].cross(frame[second])
        for k in frame.labels:
            if (across - frame[k]).is_zero:
                return _Plane(frame, first, second, k)
    return None


def _rests(frame: Frame) -> bool:
    """Whether its axes do not move relative to those of the laboratory."""
    rows = frame.rotation_to(frame.root).rows
    return not any(s.kind.varies for row in rows for entry in row for s in entry.symbols())


def _inertia(setting: Setting, family: Circling) -> Expr:
    """The coefficient of the accelerations in the equations of motion, kg."""
    place = setting.equations.speeds.index(family.velocity[0])
    return setting.equations.mass.rows[place][place]


@dataclass(frozen=True)
class _Circle:
    """Letters and vectors of one circling motion.

    Attributes:
        plane: of the circle.
        rate: letter of Λ.
        value: Λ.
        push: c of dv/dt = Λ n × v + c, m/s².
    """

    plane: _Plane
    rate: str
    value: Expr
    push: Vector

    @property
    def normal(self) -> str:
        return unit(self.plane.normal)

    @property
    def drift(self) -> Vector:
        return self.plane.frame[self.plane.normal].cross(self.push) / self.value

    @property
    def drifts(self) -> bool:
        return not self.push.is_zero

    @property
    def relative(self) -> str:
        """LaTeX of the velocity less the drift."""
        return rf"\left({_V} - {_W}\right)" if self.drifts else _V

    @property
    def let(self) -> tuple[str, ...]:
        """Definitions of Λ and of the drift."""
        rate = definition(self.rate, self.value.latex())
        if not self.drifts:
            return (rate,)
        return rate, definition(_W, vector_latex(self.drift, self.plane.frame))


def _law(circle: _Circle) -> Iterator[SolutionLine]:
    frame = circle.plane.frame
    added = f" + {vector_latex(circle.push, frame)}" if circle.drifts else ""
    if added.startswith(" + -"):
        added = f" - {added[4:]}"
    yield SolutionLine(
        f"With the normal ${circle.normal}$ of the plane, both equations for the velocity are "
        "the components of one,",
        rf"\frac{{d{_V}}}{{dt}} = {circle.rate}\,{circle.normal}\times{_V}{added}, \qquad "
        f"{circle.rate} = {circle.value.latex()}",
        "circling",
        let=circle.let[:1],
        values=((circle.rate, circle.value),),
    )


def _drift(circle: _Circle) -> Iterator[SolutionLine]:
    if not circle.drifts:
        return
    written = vector_latex(circle.drift, circle.plane.frame)
    yield SolutionLine(
        "A constant velocity satisfies this equation, the drift, which is at right angles to the "
        "push:",
        f"{_W} = {written}",
        "drift",
        "identity",
        let=circle.let,
        values=tuple((c.latex(), c) for c in circle.drift.components if c),
        stated=(
            SolutionLine(
                "",
                rf"{circle.rate}\,{circle.normal}\times{_W} + "
                rf"{bracketed(vector_latex(circle.push, circle.plane.frame))} = 0",
                context="identity",
                let=circle.let,
            ),
        ),
    )
    yield SolutionLine(
        "The rest of the velocity turns uniformly,",
        rf"\frac{{d}}{{dt}}{circle.relative} = {circle.rate}\,{circle.normal}\times"
        f"{circle.relative}",
        "turning_velocity",
        let=circle.let,
    )


def _circle(setting: Setting, family: Circling, circle: _Circle) -> Iterator[SolutionLine]:
    plane, rate, n = circle.plane, circle.rate, circle.normal
    x, y = (Expr.generator(q).latex() for q in family.place)
    rho, centre = r"\boldsymbol\rho", r"\mathbf R"
    place = rf"{x}\,{unit(plane.first)} + {y}\,{unit(plane.second)}"
    radius = definition(rho, rf"\frac{{1}}{{{rate}}} {circle.relative}\times{n}")
    at_centre = definition(centre, rf"{place} - {rho}")
    let = (*circle.let, radius)
    what = "It" if circle.drifts else "The velocity"
    yield SolutionLine(
        f"{what} keeps its magnitude and turns at the constant rate ${rate}$, as on a circle. The "
        f"vector from the centre of this circle to the {setting.body.name} is",
        rf"{rho} = \frac{{1}}{{{rate}}} {circle.relative}\times{n}",
        "radius_vector",
        let=let,
        stated=(
            SolutionLine("", rf"\frac{{d{rho}}}{{dt}} = {rate}\,{n}\times{rho}", let=let),
            SolutionLine("", rf"{circle.relative} = {rate}\,{n}\times{rho}", let=let),
        ),
    )
    v, w = (Expr.generator(speed) for speed in family.velocity)
    drift = circle.drift.express(plane.frame).components
    labels = plane.frame.labels
    speeds = [
        (speed - drift[labels.index(label)]).latex()
        for speed, label in ((v, plane.first), (w, plane.second))
    ]
    size = rf"\sqrt{{{_squared(speeds[0])} + {_squared(speeds[1])}}}"
    squares = [
        (speed - drift[labels.index(label)]) ** 2
        for speed, label in ((v, plane.first), (w, plane.second))
    ]
    yield SolutionLine(
        "of length",
        rf"\left|{rho}\right| = \frac{{{size}}}{{\left|{rate}\right|}}",
        "radius",
        let=let,
        values=((rf"\left|{rho}\right|", sqrt(squares[0] + squares[1]) / circle.value),),
    )
    where = (
        rf"\left({x} - \frac{{{speeds[1]}}}{{{rate}}}\right)\,{unit(plane.first)} + "
        rf"\left({y} + \frac{{{speeds[0]}}}{{{rate}}}\right)\,{unit(plane.second)}"
    )
    let = (*let, at_centre)
    moves = f"moves with the drift ${_W}$" if circle.drifts else "stays at rest"
    yield SolutionLine(
        rf"The centre ${centre}$ of the circle {moves}:",
        rf"{centre} = {where}, \qquad \frac{{d{centre}}}{{dt}} = {_W if circle.drifts else 0}",
        "centre",
        let=let,
    )
    yield SolutionLine(
        "The place and the velocity at the start give it. One round takes the time "
        rf"$2\pi/\left|{rate}\right|$, whatever the radius; seen from the side to which ${n}$ "
        f"points it is anticlockwise if ${rate} > 0$.",
        values=((rf"\frac{{2\pi}}{{{rate}}}", 2 * pi / circle.value),),
    )
    if not circle.drifts:
        yield from _components(setting, family, circle)


def _squared(text: str) -> str:
    return rf"\left({text}\right)^2" if is_sum(text) else f"{text}^2"


def _components(setting: Setting, family: Circling, circle: _Circle) -> Iterator[SolutionLine]:
    v, w = (Expr.generator(speed).latex() for speed in family.velocity)
    size = rf"\sqrt{{{v}^2 + {w}^2}}"
    speed = letter_latex(free_letter(setting.equations, "u", "U"))
    phase = rf"\left({circle.rate} t\right)"
    yield SolutionLine(
        f"With ${speed} = {size}$, which is constant, and the time $t$ counted from an instant at "
        f"which the velocity is along ${unit(circle.plane.first)}$,",
        rf"{v} = {speed} \cos{phase}, \qquad {w} = {speed} \sin{phase}",
        "velocities",
        "launch",
        let=(*circle.let, definition(speed, size)),
        given=(f"{{{w}}} = 0",),
        positive=(f"{{{v}}}",),
    )


def _charge(setting: Setting, family: Circling, circle: _Circle) -> Iterator[SolutionLine]:
    inertia = _inertia(setting, family)
    field, force = (-circle.value * inertia).latex(), circle.push * inertia
    M, q, B = (letter_latex(free_letter(setting.equations, *names)) for names in ("MN", "qQ", "BH"))
    written, n = vector_latex(force, circle.plane.frame), circle.normal
    bold_e, bold_b = r"\mathbf E", rf"\mathbf {B}"
    fields, forces = "a magnetic field", rf"{q}\mathbf v\times{bold_b}"
    constants = [f"${M} = {inertia.latex()}$", f"${q} {B} = {field}$"]
    closing = "."
    if circle.drifts:
        fields = "crossed electric and magnetic fields"
        forces = rf"{q}{bold_e} + {forces}"
        constants.append(f"${q}{bold_e} = {written}$")
        closing = (
            rf", and the drift is ${bold_e}\times{bold_b}/{B}^2$, at right angles to both fields "
            f"and the same for every ${M}$."
        )
    yield SolutionLine(
        f"A particle of mass ${M}$ and charge ${q}$ in {fields} moves in the same way. Its "
        rf"equation ${M}\dot{{\mathbf v}} = {forces}$ is ours, with ${bold_b} = {B}\,{n}$, "
        f"if the constants correspond as {listed(constants)}. The rate ${circle.rate}$ is that at "
        f"which the charge goes round, $-{q} {B}/{M}${closing}",
        stated=_correspondence(circle, inertia, written, field),
    )


def _correspondence(
    circle: _Circle, inertia: Expr, force: str, field: str
) -> tuple[SolutionLine, ...]:
    """The equation of the charge with these constants, and its drift."""
    n, M = circle.normal, bracketed(inertia.latex())
    lorentz = rf"{_V}\times{bracketed(field)}\,{n}"
    right = f"{bracketed(force)} + {lorentz}" if circle.drifts else lorentz
    law = SolutionLine("", rf"{M}\frac{{d{_V}}}{{dt}} = {right}")
    if not circle.drifts:
        return (law,)
    crossed = rf"\frac{{1}}{{{bracketed(field)}}}{bracketed(force)}\times{n}"
    return law, SolutionLine("", f"{_W} = {crossed}", context="identity", let=circle.let)
