"""Systems too large for closed form: body by body, in named parts, and linearised with numbers."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from polhode.algebra import ZERO, Expr, Symbol, Vector
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.judge import Answer, Verdict
from polhode.model import BodyPoint, Element, Pivot, Rim, Rolling
from polhode.solution._bodies import applied_to, laws_of_bodies, lowest_point
from polhode.solution._example import Example
from polhode.solution._linearised import linearised
from polhode.solution._lines import SolutionLine, bracketed, inline, joined, listed
from polhode.solution._setting import LONGEST, Setting, bound

#: Bodies and independent speeds with which a text can still be followed.
_BODIES, _SPEEDS = 6, 4


def refuse_too_large(equations: Equations) -> None:
    """Raise `NumericError` for a system that is too large for a document even in named parts."""
    bodies, speeds = len(equations.system.bodies), len(equations.speeds)
    if equations.motion_in_parts and (bodies > _BODIES or speeds > _SPEEDS):
        raise NumericError(
            f"a worked solution of {equations.system.name!r}, with {bodies} bodies and {speeds} "
            "independent speeds, whose equations have to be kept in named parts",
            expected=f"at most {_BODIES} bodies and {_SPEEDS} independent speeds, where equations "
            "are too long to be written out",
            advice="work on a part of the system, or simulate",
        )


def in_named_parts(
    setting: Setting, example: Example | None
) -> dict[str, tuple[SolutionLine, ...]]:
    """The sections of a system whose equations are kept in named parts."""
    named = _NamedParts(setting.equations)
    return {
        "Velocities and angular momenta": tuple(_velocities(setting)),
        "Newton's law and the torque about the centre of mass": tuple(laws_of_bodies(setting)),
        "The equations of motion in named parts": tuple(named.lines()),
        "Small departures and stability": tuple(linearised(setting.equations, example)),
    }


# -- velocities ------------------------------------------------------------------------------------


def _velocities(setting: Setting) -> Iterator[SolutionLine]:
    """Each body's angular velocity, what places it, and its angular momentum, in all speeds."""
    equations = setting.equations
    yield SolutionLine(
        "Written out in the independent speeds the velocities would fill pages. We keep the rates "
        "of all angles as letters, and go from one body to the next through the points that they "
        "share."
    )
    for one in setting.each:
        lines = [*_angular_velocity(one), *_placed(one), *_momentum(one)]
        yield from (bound(setting, line) for line in lines)
    free, tied = equations.speeds, _tied(equations)
    given = f", and give {listed(map(inline, tied))} in terms of these" if tied else ""
    yield SolutionLine(
        f"The conditions of rolling and the joints leave {_count(free)} independent, for which we "
        f"take {listed(map(inline, free))}. They are linear in all speeds{given}."
    )


def _count(speeds: tuple[Symbol, ...]) -> str:
    return ("one speed", "two speeds", "three speeds", "four speeds")[len(speeds) - 1]


def _tied(equations: Equations) -> list[Symbol]:
    """The rates of angles and the other speeds that depend on the independent ones."""
    rates = [q.derivative() for q in equations.coordinates]
    symbols = {
        s
        for one in Setting(equations).each
        for c in one.angular_velocity.components
        for s in c.symbols()
    }
    found = [s for s in (*rates, *equations.dependent) if s in symbols]
    return [s for s in dict.fromkeys(found) if s not in equations.speeds]


def _angular_velocity(one: Setting) -> Iterator[SolutionLine]:
    written = one.shortest(one.angular_velocity)[1]
    letter = one.omega_letter
    words = f"The {one.body.name}: its angular velocity is"
    for other in one.each:
        if other.body == one.body:
            break
        more = one.shortest(one.angular_velocity - other.angular_velocity)[1]
        if len(more) + 20 < len(written):
            written = joined([other.omega_letter, more])
            words = (
                f"The {one.body.name} turns relative to the {other.body.name}: its angular "
                "velocity is"
            )
    yield SolutionLine(words, f"{letter} = {written}")


def _placed(one: Setting) -> Iterator[SolutionLine]:
    """The points that the body shares with others or with the ground."""
    for element in one.equations.system.elements:
        if element.bodies[0] == one.body:
            yield from _shared_point(one, element)


def _shared_point(one: Setting, element: Element) -> Iterator[SolutionLine]:
    own = rf"\mathbf v{one.subscript} + {one.omega_letter}\times"
    match element:
        case Rolling() if isinstance(element.body.surface, Rim):
            arm, let = lowest_point(one, element, one.arm(element))
            where = f", ${let[0].replace('{', '', 1).replace('} =', ' =', 1)}$," if let else ""
            yield SolutionLine(
                f"It rolls: the velocity of its point at “{element.name}”{where} vanishes,",
                f"{own} {arm} = 0",
                let=let,
            )
        case Pivot(to=BodyPoint(body=to, offset=place)) if set(element.only) == set(
            element.along.labels
        ):
            other = next(s for s in one.each if s.body == to)
            right = rf"\mathbf v{other.subscript}"
            if not place.is_zero:
                lever = bracketed(other.shortest(place)[1])
                right += rf" + {other.omega_letter}\times {lever}"
            left = rf"\mathbf v{one.subscript}"
            if not element.at.is_zero:
                left = f"{own} {bracketed(one.shortest(element.at)[1])}"
            yield SolutionLine(
                f"At “{element.name}” it shares a point with the {to.name}:", f"{left} = {right}"
            )


def _momentum(one: Setting) -> Iterator[SolutionLine]:
    (written,) = one.let or ("",)
    if not written:
        return
    shown = written.replace("{" + one.momentum_letter + "}", one.momentum_letter, 1)
    if len(shown) <= LONGEST:
        words = "Its angular momentum about the centre of mass is"
        yield SolutionLine(words, shown, context="identity", let=one.let)


# -- the equations ---------------------------------------------------------------------------------


class _NamedParts:
    """The coefficients of the equations of motion as sums over the bodies."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.each = [one for one in Setting(equations).each if not one.body.is_massless]

    def lines(self) -> Iterator[SolutionLine]:
        """What each part stands for, and the equations with them."""
        speeds = self.equations.speeds
        yield SolutionLine(
            "Since velocities are linear in the speeds, each body $b$ has partial velocities "
            r"$\mathbf v_{b,r}$ and $\boldsymbol\omega_{b,r}$: its velocity and its angular "
            "velocity when the independent speed $r$ is 1 and the others are zero. The forces of "
            "the supports do no work in any motion that they allow. So take the scalar product "
            "of every law with the partial velocities and add: the forces drop out. This is "
            "d'Alembert's principle. The factor of each acceleration, summed over the bodies, "
            r"which have the tensors of inertia $\mathbf I_b$, is kept under a name,",
            r"M_{rs} = \sum_b \left(m_b\,\mathbf v_{b,r}\cdot\mathbf v_{b,s} + "
            r"\boldsymbol\omega_{b,r}\cdot\mathbf I_b\,\boldsymbol\omega_{b,s}\right)",
            "inertias",
            verdict=self._verdict(self._inertia_defects()),
        )
        setting = Setting(self.equations)
        gravity = setting.gravity
        weight = "" if gravity is None else rf" + m_b {gravity.g.latex()}\,{setting.up_latex}"
        rate, turned = (
            r"m_b\left(\frac{d\mathbf v_b}{dt}\right)_0",
            r"\left(\frac{d\mathbf L_b}{dt}\right)_0",
        )
        loaded = any(True for one in self.each for _ in applied_to(one))
        force, moment = (r" - \mathbf F_b", r" - \boldsymbol\tau_b") if loaded else ("", "")
        rate = rf"\left({rate}{weight}{force}\right)" if weight or force else rate
        turned = rf"\left({turned}{moment}\right)" if moment else turned
        also = (
            r", and $\mathbf F_b$ and $\boldsymbol\tau_b$ for the force of the other loads on the "
            "body and their moment about its centre of mass"
            if loaded
            else ""
        )
        yield SolutionLine(
            "and so is the rest, with the index 0 for rates taken with all accelerations "
            f"{listed(inline(s.derivative()) for s in speeds)} zero{also}:",
            rf"h_r = \sum_b \left({rate}\cdot\mathbf v_{{b,r}} + "
            rf"{turned}\cdot\boldsymbol\omega_{{b,r}}\right)",
            "rest",
            verdict=self._verdict(self._rest_defects()),
        )
        yield SolutionLine("The equations of motion are then, one for each speed,")
        for i, speed in enumerate(speeds):
            terms = [
                f"{self._name(i, j)} {Expr.generator(other.derivative()).latex()}"
                for j, other in enumerate(speeds)
            ]
            yield SolutionLine(
                "",
                f"{joined(terms)} + h_{{{_index(speed)}}} = 0",
                f"named_{i + 1}",
                verdict=self._verdict(self._row_defects(i)),
            )
        yield SolutionLine(
            r"in which $M_{rs} = M_{sr}$. The parts depend on the coordinates, and the $h_r$ on "
            "the speeds too; derive computes them, and simulate integrates the equations."
        )

    def _name(self, i: int, j: int) -> str:
        first, second = sorted((i, j))
        speeds = self.equations.speeds
        return f"M_{{{_index(speeds[first])} {_index(speeds[second])}}}"

    def _verdict(self, defects: Iterator[Expr]) -> Verdict:
        """Whether every defect vanishes, by exact evaluation at random states."""
        wrong = next((defect for defect in defects if not defect.is_zero), None)
        if wrong is None:
            return Verdict(Answer.HOLDS, "motion")
        raise NumericError(
            f"named parts of {self.equations.system.name!r} that differ from their definition",
            expected="parts that agree with it",
            advice="report it with the declaration",
        )

    def _inertia_defects(self) -> Iterator[Expr]:
        for i, row in enumerate(self.equations.mass.rows):
            for j, entry in enumerate(row):
                yield entry - self._inertias[i][j]

    def _rest_defects(self) -> Iterator[Expr]:
        return (f + h for f, h in zip(self.equations.forcing, self._rests, strict=True))

    def _row_defects(self, i: int) -> Iterator[Expr]:
        """A row as it was derived, less the row in terms of the parts."""
        accelerations = map(Expr.generator, self.equations.acceleration_symbols)
        pairs = zip(self._inertias[i], accelerations, strict=True)
        written = sum((part * rate for part, rate in pairs), start=self._rests[i])
        row = self.equations.rows[i]
        yield (row - written) if (row - written).is_zero else row + written

    @cached_property
    def _partial(self) -> list[list[tuple[Vector, Vector, Vector]]]:
        """Of every body, for every speed: partial velocities, and the partial momentum."""
        kinetics, speeds = self.equations.kinetics, map(Expr.generator, self.equations.speeds)
        own = [(*kinetics.velocities[o.body], kinetics.spin(o.body)) for o in self.each]
        along = list(speeds)
        return [[(v.diff(u), w.diff(u), momentum.diff(u)) for u in along] for v, w, momentum in own]

    @cached_property
    def _inertias(self) -> list[list[Expr]]:
        count = range(len(self.equations.speeds))
        return [
            [
                sum(
                    (
                        one.mass * own[i][0].dot(own[j][0]) + own[i][1].dot(own[j][2])
                        for one, own in zip(self.each, self._partial, strict=True)
                    ),
                    start=ZERO,
                )
                for j in count
            ]
            for i in count
        ]

    @cached_property
    def _rests(self) -> list[Expr]:
        kinetics = self.equations.kinetics
        still = dict.fromkeys(self.equations.acceleration_symbols, ZERO)
        found = [ZERO] * len(self.equations.speeds)
        for one, own in zip(self.each, self._partial, strict=True):
            velocity, momentum = kinetics.velocities[one.body][0], kinetics.spin(one.body)
            gained, turned = (kinetics.derivative(v).subs(still) for v in (velocity, momentum))
            needed = gained * one.mass - one.weight
            for action in applied_to(one):
                needed = needed - action.force
                turned = turned - action.couple - action.arm.cross(action.force)
            for i, (along, about, _) in enumerate(own):
                found[i] = found[i] + needed.dot(along) + turned.dot(about)
        return found


def _index(speed: Symbol) -> str:
    """The letter of a speed as an index: that of the coordinate whose rate it is."""
    return Expr.generator(speed.base() if speed.order else speed).latex()
