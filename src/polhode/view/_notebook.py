"""Declarations, derived results and motions as HTML for a notebook, without an extension."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from contextlib import suppress
from functools import singledispatch

import numpy as np

from polhode.algebra import Expr, Matrix, Symbol, Vector, under_defined_letters
from polhode.analyse import (
    Branch,
    ClosedForm,
    Condition,
    ContactForces,
    Fictitious,
    Invariant,
    Invariants,
    LinearIntegrals,
    Stability,
    SteadyMotion,
    SteadyValues,
    Truth,
    stability,
)
from polhode.base import NumericError
from polhode.derive import Automaton, Equations, Reaction, symbols_of
from polhode.model import Declared, Frame, System, brief
from polhode.simulate import Drift, Trajectory
from polhode.study import Ensemble, Fit, Linearised, Sensitivities
from polhode.view._html import Markup, joined, table, tag
from polhode.view._mathml import Formula, alone, equation, inline, math_fonts, positive, typeset
from polhode.view._page import page_of
from polhode.view._scene import Scene
from polhode.view._scene_build import scene
from polhode.view._scene_text import meanings_of

_STYLE = (
    ".polhode{max-width:60em;overflow-x:auto}"
    ".polhode math{font-size:1.1em;font-family:var(--polhode-math)}"
    ".polhode .row{margin:.45em 0 .45em 1.2em;line-height:1.9}"
    ".polhode table{border-collapse:collapse;margin:.3em 0}"
    ".polhode table td,.polhode table th{text-align:left;vertical-align:baseline;"
    "padding:.15em .8em .15em 0}"
    ".polhode summary{cursor:pointer;font-weight:600}"
    ".polhode table caption{text-align:left;white-space:nowrap;font-weight:600;"
    "padding:.2em 0}"
)
_ZERO = Expr.of(0)
_TALL = 640  # pixels of the picture of a motion with its plots
_WIDE = "min(100%, 72rem)"
_FAILURES = 10  # that are listed


@singledispatch
def html_of(thing: object) -> str:
    """A declaration or result as self-contained HTML; other objects as text."""
    return tag("pre", str(thing))


# --- pieces ---


def _framed(*inner: str) -> Markup:
    """A block together with the style that all blocks share."""
    style = tag("style", Markup(math_fonts() + _STYLE))
    return tag("div", style, *inner, class_="polhode")


def _formula(formula: Formula) -> Markup:
    """A formula in its pieces, or as text if it is too long to be typeset."""
    return joined(map(Markup, formula.pieces), " ") or joined([formula.spoken])


def _rows(formulas: Iterable[Formula]) -> Markup:
    """Formulas, each on a line of its own."""
    return joined(tag("div", _formula(f), class_="row") for f in formulas)


def _folded(title: str, content: Markup) -> Markup:
    """Content folded away under a title; nothing if there is no content."""
    if not content:
        return content
    return tag("details", tag("summary", title), content)


def _where(words: str, conditions: Iterable[Condition]) -> Markup:
    """The conditions that are open, with some words before them; nothing if there are none."""
    formulas = [positive(c.expression) for c in conditions if c.truth is Truth.OPEN]
    return joined([tag("p", words), _rows(formulas)]) if formulas else Markup()


def _undetermined(names: Iterable[str]) -> Markup:
    listed = ", ".join(names)
    return tag("p", f"Not determined: {listed}") if listed else Markup()


def _vector(caption: str, vector: Vector) -> Markup:
    frame = vector.triad
    labels = frame.labels if isinstance(frame, Frame) else ("1", "2", "3")
    along = f" along {frame.name}" if isinstance(frame, Frame) else ""
    values = map(_formula, map(alone, vector.components))
    return table(("", ""), zip(labels, values, strict=True), caption=f"{caption}{along}")


def _on_a_line(latex: str, otherwise: str) -> Markup:
    """A formula on a separate line, or text if it cannot be typeset."""
    return tag("div", typeset(latex) or otherwise, class_="row")


def _number(value: float) -> str:
    return format(float(value), ".6g")


# --- declarations ---


@html_of.register
def _(thing: System) -> str:
    bodies = []
    for body in thing.bodies:
        inertia = body.inertia.rows
        off = any(inertia[i][j] for i in range(3) for j in range(3) if i != j)
        entries = [e for row in inertia for e in row] if off else [inertia[i][i] for i in range(3)]
        bodies.append((body.name, inline(body.mass), joined(map(inline, entries), ", ")))
    shown = table(("", "mass", "inertia"), bodies, caption="bodies")
    parts = [(element.name, type(element).__name__) for element in thing.elements]
    parts += [(load.name, type(load).__name__) for load in thing.loads]
    others = table(("", ""), parts, caption="contacts, joints and loads") if parts else ""
    return _framed(tag("strong", thing.name), shown, others)


@html_of.register
def _(thing: Declared) -> str:
    name = str(getattr(thing, "name", ""))
    caption = f"{type(thing).__name__} {name}".strip()
    parts = [(field, _part(value)) for field, value in thing.parts]
    return _framed(table(("", ""), parts, caption=caption))


@html_of.register
def _(thing: Frame) -> str:
    """The successive rotations that lead from the laboratory to the frame."""
    steps = []
    for frame in reversed(thing.lineage[:-1]):
        # the axis of rotation: its label if it is one of the parent's directions
        labels = frame.parent.labels if frame.parent else frame.labels
        along = [label for label, part in zip(labels, frame.axis, strict=True) if part == 1]
        steps.append((str(frame), _part(frame.angle), along[0] if along else _listed(frame.axis)))
    title = tag("strong", f"Frame {thing}")
    if not steps:
        return _framed(title)
    turns = table(("", "turned by, rad", "about"), steps)
    return _framed(title, tag("p", f"out of {thing.root}"), turns)


@singledispatch
def _part(value: object) -> str:
    """A part of a declaration within a table."""
    return brief(value)


@_part.register
def _(value: Expr) -> str:
    return _formula(alone(value))


@_part.register
def _(value: tuple) -> str:  # type: ignore[type-arg]
    return joined(map(_part, value), ", ")


@_part.register
def _(value: Vector) -> str:
    return joined([_listed(value.components), f" along {value.triad}"])


@_part.register
def _(value: Matrix) -> str:
    return joined(map(_listed, value.rows), "; ")


def _listed(entries: Iterable[Expr]) -> Markup:
    return joined(["(", joined(map(inline, entries), ", "), ")"])


# --- expressions ---


@html_of.register
def _(thing: Expr) -> str:
    return _framed(_rows([alone(thing)]))


@html_of.register
def _(thing: Matrix) -> str:
    return _framed(_on_a_line(thing.latex(), str(thing)))


@html_of.register
def _(thing: Vector) -> str:
    return _framed(_vector("", thing))


# --- equations of motion and forces ---


@html_of.register
def _(thing: Equations) -> str:
    if thing.in_lengths is not thing:
        return html_of(thing.in_lengths)
    rates = {s: e for s, e in thing.kinematics.items() if s not in thing.speeds}
    determined = {n: value for n, value in thing.components.items() if n not in thing.undetermined}
    expressions = (*thing.motion, *rates.values(), *determined.values())
    values, letters = under_defined_letters(expressions, symbols_of(thing))
    rows = iter(values)
    motion = [equation("", next(rows), _ZERO) for _ in thing.motion]
    kinematics = [equation("", Expr.generator(s), next(rows)) for s in rates]
    reactions = [equation("", Expr.generator(Symbol(n)), next(rows)) for n in determined]
    return _framed(
        tag("strong", f"Equations of motion of {thing.system.name}"),
        _rows(motion),
        _folded("with", _rows(kinematics)),
        _folded("reactions", _rows(reactions)),
        _undetermined(thing.undetermined),
        _folded("where", _rows(meanings_of(letters))),
    )


@html_of.register
def _(thing: Reaction) -> str:
    couple = "" if thing.couple.is_zero else _vector("couple, N m", thing.couple)
    return _framed(
        tag("strong", f"Reaction of {thing.name} on {thing.body.name}"),
        _vector("force, N", thing.force),
        couple,
        _undetermined(thing.undetermined),
    )


@html_of.register
def _(thing: ContactForces) -> str:
    named: Mapping[str, Expr] = {"normal": thing.normal, "tangential": thing.tangential}
    return _framed(table(("", ""), [(name, _formula(alone(e))) for name, e in named.items()]))


@html_of.register
def _(thing: Fictitious) -> str:
    named = {
        "centrifugal": thing.centrifugal,
        "Coriolis": thing.coriolis,
        "Euler": thing.euler,
        "of the origin": thing.coordinate,
    }
    shown = [_vector(name, vector) for name, vector in named.items() if not vector.is_zero]
    return _framed(*(shown or [tag("p", "None: the frame is at rest.")]))


@html_of.register
def _(thing: Automaton) -> str:
    """The modes derived so far; showing an automaton derives no others."""
    contacts = [
        (c.name, type(c).__name__, c.body.name, "; ".join(phase.value for phase in option))
        for c, option in zip(thing.contacts, thing.options, strict=True)
    ]
    return _framed(
        tag("strong", f"Contact modes of {thing.system.name}"),
        table(("", "", "of", "may be"), contacts, caption="contacts") if contacts else "",
        *(
            _folded(f"{mode.name} lasts while", _rows(positive(g.positive) for g in mode.guards))
            for mode in thing.known
        ),
    )


# --- steady motions, integrals and closed forms ---


@html_of.register
def _(thing: SteadyMotion) -> str:
    shown = [tag("strong", f"Steady motion of {thing.reduced.equations.system.name}")]
    conditions = _rows(equation("", condition, _ZERO) for condition in thing.conditions)
    shown.append(conditions or tag("p", "Every state."))
    for branch in thing.branches:
        shown.append(_rows([equation("", branch.quantity, branch.value)]))
        shown.append(_where("exists where", branch.exists))
    with suppress(NumericError):  # raised for a family on which the coordinates are singular
        shown.append(_stability(stability(thing)))
    return _framed(*shown)


@html_of.register
def _(thing: Stability) -> str:
    return _framed(_stability(thing))


def _stability(found: Stability) -> Markup:
    return _where("stable when", found.conditions) or tag("p", str(found))


@html_of.register
def _(thing: Branch) -> str:
    value = _rows([equation("", thing.quantity, thing.value)])
    return _framed(value, _where("exists where", thing.exists))


@html_of.register
def _(thing: Condition) -> str:
    if thing.truth is not Truth.OPEN:
        return _framed(tag("p", thing.truth.value))
    return _framed(_rows([positive(thing.expression)]))


@html_of.register
def _(thing: SteadyValues) -> str:
    found = ", ".join(map(_number, thing.values)) or "none that is real"
    name = inline(Expr.generator(thing.quantity))
    return _framed(tag("p", name, f" = {found}"), tag("p", f"of at most {thing.degree}"))


@html_of.register
def _(thing: Invariants) -> str:
    beyond = tag("pre", str(thing.linear)) if thing.linear else ""
    limits = tag("p", f"Searched: {thing.ansatz}. Nothing outside it is excluded.")
    return _framed(tag("strong", "Invariants"), *map(_invariant, thing), beyond, limits)


@html_of.register
def _(thing: Invariant) -> str:
    return _framed(_invariant(thing))


def _invariant(found: Invariant) -> Markup:
    value = equation("", Expr.generator(Symbol(found.name)), found.expression)
    return joined([tag("p", found.meaning), _rows([value])])


@html_of.register
def _(thing: LinearIntegrals) -> str:
    slopes = [
        (inline(Expr.generator(speed)), _formula(alone(slope)))
        for speed, slope in zip(thing.speeds, thing.slopes, strict=True)
    ]
    angle = inline(Expr.generator(thing.angle))
    caption = joined(["derivatives by ", angle, " along every motion"])
    return _framed(table(("of", ""), slopes, caption=caption))


@html_of.register
def _(thing: ClosedForm) -> str:
    return _framed(tag("p", str(thing)), _on_a_line(thing.latex(), thing.latex()))


# --- motions and studies of many ---


@html_of.register
def _(thing: Trajectory) -> str:
    return _played(scene(thing))


@html_of.register
def _(thing: Scene) -> str:
    return _played(thing)


def _played(shown: Scene) -> str:
    """A page in an isolated frame, with access neither to the notebook nor to the network."""
    return tag(
        "iframe",
        title=f"{shown.title}, played",
        sandbox="allow-scripts",
        srcdoc=page_of(shown),
        style=f"width:{_WIDE};height:{_TALL}px;border:0",
    )


@html_of.register
def _(thing: Drift) -> str:
    drifts = [("energy − work done", _number(thing.energy), "against the energy scale")]
    if thing.constraint:  # zero where nothing closes
        drifts.append(("closed loops", _number(thing.constraint), "m, largest gap"))
    drifts += [
        (name, _number(value), "against its largest term")
        for name, value in thing.invariants.items()
    ]
    return _framed(table(("", "", ""), drifts, caption="largest drift along the motion"))


@html_of.register
def _(thing: Ensemble) -> str:
    outputs = [(name, _spread(thing, name)) for name in thing.values]
    caption = f"{len(thing)} members, {thing.failed} failed"
    failures = list(thing.failures.items())[:_FAILURES]
    why = joined(tag("p", f"member {k}: {reason}") for k, reason in failures)
    shown = table(("output", "of all members"), outputs, caption=caption)
    return _framed(shown, _folded("why", why))


def _spread(ensemble: Ensemble, name: str) -> str:
    """The count of each outcome, or the least and the largest number."""
    if name in ensemble.labels:
        words = Counter(filter(None, ensemble.named(name)))
        return ", ".join(f"{word}: {count}" for word, count in words.most_common())
    values = ensemble.values[name][ensemble.done]
    if not values.size or not np.any(np.isfinite(values)):
        return "none"
    return f"from {np.nanmin(values):.6g} to {np.nanmax(values):.6g}"


@html_of.register
def _(thing: Linearised) -> str:
    matrix = [
        (name, *map(_number, row)) for name, row in zip(thing.states, thing.matrix, strict=True)
    ]
    shown = table(("rate of", *thing.states), matrix, caption="small departures, SI units")
    rates = ", ".join(f"{rate.real:.4g} {rate.imag:+.4g}i" for rate in thing.eigenvalues)
    return _framed(shown, tag("p", f"departures vary as exp(λt), λ = {rates} per second"))


@html_of.register
def _(thing: Fit) -> str:
    values = [
        (name, _number(value), f"± {thing.uncertainties[name]:.2g}")
        for name, value in thing.values.items()
    ]
    caption = f"best fit, SI units, after {thing.evaluations} motions"
    shown = table(("", "", ""), values, caption=caption)
    return _framed(shown, tag("p", f"scatter {thing.scatter:.4g}"))


@html_of.register
def _(thing: Sensitivities) -> str:
    values = [
        (quantity, name, _number(float(values[-1])))
        for quantity, by in thing.derivatives.items()
        for name, values in by.items()
    ]
    caption = f"derivatives at {float(thing.times[-1]):g} s, SI units"
    return _framed(table(("of", "by", ""), values, caption=caption))
