"""What a notebook shows of the parts of results: vectors, conditions, modes, matrices, errors."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

from polhode.algebra import Expr, Matrix, Symbol, Vector
from polhode.analyse import (
    Branch,
    ClosedForm,
    Condition,
    ContactForces,
    Fictitious,
    Invariant,
    LinearIntegrals,
    SteadyValues,
    Truth,
)
from polhode.derive import Automaton, Reaction
from polhode.model import Frame
from polhode.simulate import Drift
from polhode.study import Fit, Linearised, Sensitivities
from polhode.view._markup import folded, formula, framed, rows, table
from polhode.view._mathml import alone, equation, positive, symbol
from polhode.view._notebook import html_of as html_of
from polhode.view._typeset import typeset

_DIGITS = ".6g"


@html_of.register
def _(thing: Expr) -> str:
    return framed(rows([alone(thing)]))


@html_of.register
def _(thing: Matrix) -> str:
    return framed(_set(thing.latex(), str(thing)))


@html_of.register
def _(thing: ClosedForm) -> str:
    return framed(f"<p>{escape(str(thing))}</p>{_set(thing.latex(), thing.latex())}")


@html_of.register
def _(thing: Vector) -> str:
    return framed(_vector("", thing))


@html_of.register
def _(thing: Reaction) -> str:
    title = f"<strong>What {escape(thing.name)} does to {escape(thing.body.name)}</strong>"
    shown = _vector("force, N", thing.force)
    if not thing.couple.is_zero:
        shown += _vector("couple, N m", thing.couple)
    if thing.undetermined:
        shown += f"<p>Not determined: {escape(', '.join(thing.undetermined))}</p>"
    return framed(title + shown)


@html_of.register
def _(thing: ContactForces) -> str:
    named = {"normal": thing.normal, "tangential": thing.tangential}
    return framed(_equations(named))


@html_of.register
def _(thing: Fictitious) -> str:
    named = {
        "centrifugal": thing.centrifugal,
        "Coriolis": thing.coriolis,
        "Euler": thing.euler,
        "of the origin": thing.coordinate,
    }
    told = [_vector(name, vector) for name, vector in named.items() if not vector.is_zero]
    return framed("".join(told) or "<p>None: the frame is at rest.</p>")


@html_of.register
def _(thing: Automaton) -> str:
    """The modes that are known already; nothing is derived to be shown."""
    contacts = [(escape(c.name), type(c).__name__, escape(c.body.name)) for c in thing.contacts]
    shown = f"<strong>Contact modes of {escape(thing.system.name)}</strong>"
    if contacts:
        shown += table("contacts", ("", "", "of"), contacts)
    shown += f"<p>modes: {escape('; '.join(thing.names))}</p>"
    for mode in thing.known:
        guards = [positive(guard.positive) for guard in mode.guards]
        shown += folded(f"{escape(mode.name)} lasts while", guards)
    return framed(shown)


@html_of.register
def _(thing: Drift) -> str:
    told = [("energy − work done", _number(thing.energy), "against the energy scale")]
    if thing.constraint:  # zero where nothing closes
        told.append(("closed loops", _number(thing.constraint), "m, largest gap"))
    told += [
        (escape(name), _number(value), "against its largest term")
        for name, value in thing.invariants.items()
    ]
    return framed(table("largest drift along the motion", ("", "", ""), told))


@html_of.register
def _(thing: Condition) -> str:
    if thing.truth is not Truth.OPEN:
        return framed(f"<p>{escape(thing.truth.value)}</p>")
    return framed(rows([positive(thing.expression)]))


@html_of.register
def _(thing: Branch) -> str:
    asked = [positive(c.expression) for c in thing.exists if c.truth is Truth.OPEN]
    exists = f"<p>exists where</p>{rows(asked)}" if asked else ""
    return framed(rows([equation("", thing.quantity, thing.value)]) + exists)


@html_of.register
def _(thing: Invariant) -> str:
    row = equation("", Expr.generator(Symbol(thing.name)), thing.expression)
    return framed(f"<p>{escape(thing.meaning)}</p>{rows([row])}")


@html_of.register
def _(thing: LinearIntegrals) -> str:
    angle = symbol(Expr.generator(thing.angle))
    told = [
        (symbol(Expr.generator(speed)), formula(alone(slope)))
        for speed, slope in zip(thing.speeds, thing.slopes, strict=True)
    ]
    return framed(table(f"derivatives by {angle} along every motion", ("of", ""), told))


@html_of.register
def _(thing: SteadyValues) -> str:
    found = ", ".join(map(_number, thing.values)) or "none that is real"
    name = symbol(Expr.generator(thing.quantity))
    return framed(f"<p>{name} = {found}</p><p>of at most {thing.degree}</p>")


@html_of.register
def _(thing: Linearised) -> str:
    matrix = [
        (escape(name), *map(_number, row))
        for name, row in zip(thing.states, thing.matrix, strict=True)
    ]
    header = ("rate of", *map(escape, thing.states))
    rates = ", ".join(f"{rate.real:.4g} {rate.imag:+.4g}i" for rate in thing.eigenvalues)
    shown = table("small departures, SI units", header, matrix)
    return framed(f"{shown}<p>they go as exp(λt), λ = {rates} per second</p>")


@html_of.register
def _(thing: Fit) -> str:
    told = [
        (escape(name), _number(value), f"± {thing.uncertainties[name]:.2g}")
        for name, value in thing.values.items()
    ]
    title = f"best fit, SI units, after {thing.evaluations} motions"
    return framed(table(title, ("", "", ""), told) + f"<p>scatter {thing.scatter:.4g}</p>")


@html_of.register
def _(thing: Sensitivities) -> str:
    told = [
        (escape(quantity), escape(name), _number(float(values[-1])))
        for quantity, by in thing.derivatives.items()
        for name, values in by.items()
    ]
    title = f"derivatives at {float(thing.times[-1]):g} s, SI units"
    return framed(table(title, ("of", "by", ""), told))


def _set(latex: str, otherwise: str) -> str:
    """A formula on a line of its own, or text where it is too long to be set."""
    return f"<div class='row'>{typeset(latex) or escape(otherwise)}</div>"


def _vector(title: str, vector: Vector) -> str:
    frame = vector.triad
    labels = frame.labels if isinstance(frame, Frame) else ("1", "2", "3")
    along = f" along {escape(frame.name)}" if isinstance(frame, Frame) else ""
    told = [
        (escape(label), formula(alone(component)))
        for label, component in zip(labels, vector.components, strict=True)
    ]
    return table(f"{title}{along}", ("", ""), told)


def _equations(named: Mapping[str, Expr]) -> str:
    return table("", ("", ""), [(name, formula(alone(value))) for name, value in named.items()])


def _number(value: float) -> str:
    return format(float(value), _DIGITS)
