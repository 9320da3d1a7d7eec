"""What a notebook shows of systems, equations, steady motions and motions: HTML, no extension."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from functools import singledispatch
from html import escape

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.analyse import (
    Condition,
    Invariants,
    Stability,
    SteadyMotion,
    Truth,
    stability,
)
from polhode.base import NumericError
from polhode.derive import Equations, lettered
from polhode.model import Body, System
from polhode.simulate import Trajectory
from polhode.study import Ensemble
from polhode.view._markup import folded, framed, rows, table
from polhode.view._mathml import equation, positive, symbol
from polhode.view._page import page_of
from polhode.view._scene import Scene
from polhode.view._scene_build import scene

_ZERO = Expr.of(0)
_TALL = 640  # pixels of the picture of a motion with its plots
_FAILURES = 10  # that are told
_WIDE = "min(100%, 72rem)"


@singledispatch
def html_of(thing: object) -> str:
    """A declaration or result as HTML that stands by itself; other things as text."""
    return f"<pre>{escape(str(thing))}</pre>"


@html_of.register
def _(thing: System) -> str:
    bodies = table("bodies", ("", "mass", "inertia"), map(_body, thing.bodies))
    parts = [(escape(e.name), type(e).__name__) for e in thing.elements]
    parts += [(escape(load.name), type(load).__name__) for load in thing.loads]
    others = table("what acts on them", ("", ""), parts) if parts else ""
    return framed(f"<strong>{escape(thing.name)}</strong>{bodies}{others}")


@html_of.register
def _(thing: Equations) -> str:
    rates = {s: e for s, e in thing.kinematics.items() if s not in thing.speeds}
    told = {n: value for n, value in thing.components.items() if n not in thing.undetermined}
    values, legend = lettered(thing, (*thing.motion, *rates.values(), *told.values()))
    letters = iter(values)
    motion = [equation("", next(letters), _ZERO) for _ in thing.motion]
    kinematics = [equation("", Expr.generator(s), next(letters)) for s in rates]
    reactions = [equation("", Expr.generator(Symbol(name)), next(letters)) for name in told]
    shown = f"<strong>Equations of motion of {escape(thing.system.name)}</strong>{rows(motion)}"
    shown += folded("with", kinematics) + folded("reactions", reactions)
    if thing.undetermined:
        shown += f"<p>Not determined: {escape(', '.join(thing.undetermined))}</p>"
    shown += "".join(f"<p>{escape(line)}</p>" for line in legend)
    return framed(shown)


@html_of.register
def _(thing: SteadyMotion) -> str:
    name = escape(thing.reduced.equations.system.name)
    held = [equation("", condition, _ZERO) for condition in thing.conditions]
    shown = f"<strong>Steady motion of {name}</strong>{rows(held)}"
    if not held:
        shown += "<p>Every state.</p>"
    for branch in thing.branches:
        shown += rows([equation("", branch.quantity, branch.value)])
        shown += _where("exists where", branch.exists)
    try:
        return framed(shown + _told(stability(thing)))
    except NumericError:  # a family on which the coordinates are singular
        return framed(shown)


@html_of.register
def _(thing: Stability) -> str:
    return framed(_told(thing))


@html_of.register
def _(thing: Invariants) -> str:
    found = [
        f"<p>{escape(i.meaning)}</p>"
        f"{rows([equation('', Expr.generator(Symbol(i.name)), i.expression)])}"
        for i in thing
    ]
    beyond = f"<pre>{escape(str(thing.linear))}</pre>" if thing.linear else ""
    limits = f"<p>Searched: {escape(thing.ansatz)}. Nothing outside it is excluded.</p>"
    return framed("<strong>Invariants</strong>" + "".join(found) + beyond + limits)


@html_of.register
def _(thing: Ensemble) -> str:
    outputs = [(escape(name), _spread(thing, name)) for name in thing.values]
    title = f"{len(thing)} members, {thing.failed} failed"
    why = [f"<p>member {k}: {escape(v)}</p>" for k, v in list(thing.failures.items())[:_FAILURES]]
    folded = f"<details><summary>why</summary>{''.join(why)}</details>" if why else ""
    return framed(table(title, ("output", "of all members"), outputs) + folded)


@html_of.register
def _(thing: Trajectory) -> str:
    return _played(scene(thing))


@html_of.register
def _(thing: Scene) -> str:
    return _played(thing)


def _played(shown: Scene) -> str:
    """A page in a frame of its own, which can neither reach the notebook nor any network."""
    inner = page_of(shown).replace("&", "&amp;").replace("'", "&#39;")
    title = escape(f"{shown.title}, played", quote=True)
    return (
        f"<iframe title=\"{title}\" sandbox='allow-scripts' srcdoc='{inner}' "
        f"style='width:{_WIDE};height:{_TALL}px;border:0'></iframe>"
    )


def _body(body: Body) -> tuple[str, ...]:
    inertia = body.inertia.rows
    off = any(inertia[i][j] for i in range(3) for j in range(3) if i != j)
    entries = [e for row in inertia for e in row] if off else [inertia[i][i] for i in range(3)]
    return escape(body.name), symbol(body.mass), ", ".join(map(symbol, entries))


def _told(found: Stability) -> str:
    return _where("stable when", found.conditions) or f"<p>{escape(str(found))}</p>"


def _where(words: str, conditions: Iterable[Condition]) -> str:
    """Conditions of which something is left to ask."""
    formulas = [positive(c.expression) for c in conditions if c.truth is Truth.OPEN]
    return f"<p>{words}</p>{rows(formulas)}" if formulas else ""


def _spread(found: Ensemble, name: str) -> str:
    """How often each word comes; or the least and the largest number."""
    if name in found.labels:
        words = Counter(filter(None, found.named(name)))
        return escape(", ".join(f"{word}: {count}" for word, count in words.most_common()))
    values = found.values[name][found.done]
    if not values.size or not np.any(np.isfinite(values)):
        return "none"
    return f"from {np.nanmin(values):.6g} to {np.nanmax(values):.6g}"
