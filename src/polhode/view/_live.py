"""What a live page computes motions with: kernels, sliders, and what is drawn by number.

The page has two kernels for every contact mode (`PageKernels`). What is drawn refers to the outputs
of the second, which have the same numbers in all modes; `web/src/live` makes of them what
`_scene_bodies`, `_scene_supports` and `_scene_text` make of a motion that has been followed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind, as_symbol, read_value, variables
from polhode.base import PURE, TIME, read_quantity
from polhode.derive import Equations, is_angle
from polhode.model import Body, Contact, Coulomb, CurvedSupport, Sheet, System
from polhode.simulate import (
    WORK,
    PageKernels,
    PageMode,
    Trajectory,
    auxiliary_places,
    coefficients,
    kernel_code,
    onset_collocation,
    page_kernels,
    page_loops,
)
from polhode.view._controls import (
    Control,
    control,
    is_plain,
    may_be_negative,
    plain_unit,
    unit_in,
    widened,
)
from polhode.view._drawn import (
    VectorInMode,
    arms_in,
    arrows_in,
    base_of,
    contact_point,
    contacts_in,
    directions_of,
    end_of_link,
    joints_in,
    labels_of,
    links_in,
    place_of,
    sided_in,
    turning_of,
)
from polhode.view._drawn_angles import angles_in
from polhode.view._drawn_portraits import portraits_in
from polhode.view._quantities import Array, equations_of, quantity
from polhode.view._scene import Scene
from polhode.view._scene_build import frames_of, up_of
from polhode.view._scene_supports import patch_of
from polhode.view._scene_text import ENERGIES, energies_of
from polhode.view._shapes import source_of

#: The texts that numbers were given as, by name: units of sliders, formulas of other parameters.
Written = Mapping[str, str]
#: Motions by their titles: values of parameters, coordinates and speeds at the start, and of the
#: duration, by name, SI. The others keep the values that the page opens with.
Presets = Mapping[str, Mapping[str, float]]
#: Expressions in the equations of a contact mode; None for those that are not defined there.
Meaning = Callable[[Equations], Sequence[Expr | None]]


@dataclass
class _Outputs:
    """What the second kernel of every mode computes, by number.

    Attributes:
        modes: the contact modes.
        known: parameters that have values.
        expressions: of every mode, in the order of their numbers.
    """

    modes: tuple[PageMode, ...]
    known: frozenset[Symbol]
    expressions: list[list[Expr | None]] = field(init=False)

    def __post_init__(self) -> None:
        self.expressions = [[] for _ in self.modes]

    @property
    def system(self) -> System:
        """The system, as it is in the first mode."""
        return self.modes[0].equations.system

    def meanings(self, meaning: Meaning) -> list[int]:
        """The numbers of expressions that have a meaning in each mode."""
        begin = len(self.expressions[0])
        for mode, expressions in zip(self.modes, self.expressions, strict=True):
            expressions += meaning(mode.equations)
        return list(range(begin, len(self.expressions[0])))

    def numbers(self, expressions: Iterable[Expr]) -> list[int]:
        """The numbers of expressions that are the same in every mode."""
        same = tuple(expressions)
        return self.meanings(lambda equations: same)

    def vector(self, in_mode: VectorInMode | None) -> list[int] | None:
        """Components along the root frame; None for a vector that is not defined anywhere."""
        if in_mode is None:
            return None

        def components(equations: Equations) -> Sequence[Expr | None]:
            vector = in_mode(equations)
            if vector is None:
                return (None,) * 3
            return tuple(vector.express(equations.system.root).components)

        return self.meanings(components)

    def columns(
        self, in_mode: Callable[[Equations], Sequence[Expr] | None], count: int
    ) -> list[int]:
        """The numbers of so many expressions that are defined in some modes."""
        return self.meanings(lambda equations: in_mode(equations) or (None,) * count)

    def constants(self, expressions: Sequence[Expr]) -> list[int]:
        """The numbers of expressions of parameters; none if a parameter has no value."""
        used = {s for e in expressions for s in e.symbols() if s.kind is SymbolKind.PARAMETER}
        return self.numbers(expressions) if used <= self.known else []


def live_document(
    run: Trajectory,
    shown: Scene,
    written: Written,
    duration: float | None = None,
    presets: Presets = MappingProxyType({}),
) -> dict[str, Any]:
    """What a live page needs besides the scene of the motion it opens with, as plain data.

    Args:
        run: the motion that the page opens with.
        shown: its scene.
        written: how its parameters and start values were written.
        duration: of the motions that the page computes, s; by default that of `run`.
        presets: further motions by their titles.

    Raises:
        DeclarationError: for a motion that a page cannot compute by itself, with the reason.
    """
    formulas = _formulas(run, written)
    loops = page_loops(run, written)
    kernels = page_kernels(run, formulas, loops)
    pi = Symbol("pi", SymbolKind.PARAMETER)
    outputs = _Outputs(kernels.modes, frozenset((*kernels.parameters, *formulas, pi)))
    contact = kernels.contact
    laws = {} if contact is None else coefficients(contact)
    start = list(_start(run, kernels, shown, written))
    sliders = list(_parameters(run, kernels, shown, written))
    own = kernels.modes[0].equations
    states = [*own.coordinates, *own.speeds]
    document = {
        "system": run.equations.system.name,
        "duration": duration or run.duration,
        "frames": frames_of(run),
        "parameters": [vars(slider) for slider in sliders],
        "positive": [s.published for s in kernels.chosen if s.positive],
        "formulas": [
            {"symbol": _letter(s), "formula": f.mathml(), "name": s.published}
            for s, f in formulas.items()
        ],
        "start": [vars(slider) for slider in start],
        "presets": [
            {
                "title": title,
                "parameters": _texts(sliders, values),
                "start": _texts(start, values),
                "duration": f"{values['duration']:.12g} s" if "duration" in values else "",
            }
            for title, values in presets.items()
        ],
        "states": outputs.numbers(Expr.generator(symbol) for symbol in states),
        "work": outputs.numbers([Expr.generator(WORK)])[0],
        "timed": any(_is_timed(mode.equations) for mode in kernels.modes),
        "schedule": {
            "times": kernels.schedule.times,
            "values": kernels.schedule.values,
            "jerks": kernels.schedule.jerks,
        },
        "contact": None if contact is None else contact.name,
        "law": {name: outputs.numbers([value])[0] for name, value in laws.items()},
        "friction": _friction(laws, kernels),
        "loops": {
            "gaps": outputs.columns(partial(_gaps, len(loops.gaps)), len(loops.gaps)),
            "solved": [own.coordinates.index(q) for q in loops.solved],
            "slopes": outputs.numbers(loops.slopes),
        },
        "radau": onset_collocation() if isinstance(contact, Coulomb) else None,
        "drawn": _drawn(run, shown, outputs, kernels),
    }
    shown_outputs = len(outputs.expressions[0])
    modes = [
        _mode(kernels, mode, expressions)
        for mode, expressions in zip(kernels.modes, outputs.expressions, strict=True)
    ]
    return document | {"code": kernel_code(), "outputs": shown_outputs, "modes": modes}


def _friction(laws: Mapping[str, Expr], kernels: PageKernels) -> str:
    """The parameter that bounds static friction; empty where none does by itself."""
    limit = laws.get("mu_static", laws.get("mu"))
    symbol = None if limit is None else limit.symbol
    return symbol.published if symbol in kernels.chosen else ""


def _gaps(count: int, equations: Equations) -> tuple[Expr, ...] | None:
    """The closures of a mode that has as many loops as the first."""
    return equations.closures if len(equations.closures) == count else None


def _is_timed(equations: Equations) -> bool:
    """Whether a motion that starts later is another one."""
    kinds = {s.kind for s in variables([*equations.mass.entries, *equations.forcing])}
    return not kinds.isdisjoint((SymbolKind.FUNCTION, SymbolKind.TIME))


def _mode(kernels: PageKernels, mode: PageMode, shown: list[Expr | None]) -> dict[str, Any]:
    """The kernels of a mode; what joins it to others follows what is shown."""
    joined, wanted = dict[str, list[int]](), list(shown)
    for name, expressions in mode.joined.items():
        joined[name] = list(range(len(wanted), len(wanted) + len(expressions)))
        wanted += expressions
    equations = mode.equations
    return {
        "name": mode.name,
        "phase": mode.phase,
        "beyond": mode.is_beyond,
        "coordinates": [s.published for s in equations.coordinates],
        "speeds": [s.published for s in equations.speeds],
        "work": mode.work,
        **auxiliary_places(mode),
        "integrator": kernels.integrator(mode),
        "viewer": kernels.viewer(mode, wanted),
        "fewest": kernels.fewest(mode),
        "watched": [{"kind": w.kind, "ends": w.ends} for w in mode.watched],
        "joined": joined,
    }


# -- sliders ---------------------------------------------------------------------------------------


def _formulas(run: Trajectory, written: Written) -> dict[Symbol, Expr]:
    """Parameters that were written as formulas of others."""
    own = {s.published: s for s in run.dynamics.parameters}
    names = {name: own.get(name, Symbol(name, SymbolKind.PARAMETER)) for name in written}
    found = {}
    for name, text in written.items():
        if name not in run.parameters or is_plain(text):
            continue
        value = read_value(name, text, names)
        if value.symbols and isinstance(value.number, Expr):
            found[names[name]] = value.number
    return found


def _parameters(
    run: Trajectory, kernels: PageKernels, shown: Scene, written: Written
) -> Iterator[Control]:
    """Sliders of the parameters that have values of their own, in the order of the kernels."""
    equations = equations_of(run)
    meanings = {number.name: number.meaning for number in shown.parameters}
    for symbol in kernels.chosen:
        name = symbol.published
        dimension = equations.dimensions.get(symbol, PURE)
        unit = "deg" if is_angle(equations, symbol) else plain_unit(dimension)
        text = written.get(name, "")
        value = run.parameters[name] if name in run.parameters else read_quantity(text).value
        is_positive = symbol.positive or not may_be_negative(dimension)
        yield _slider(symbol, text, unit, meanings.get(name, ""), value, positive=is_positive)


def _start(
    run: Trajectory, kernels: PageKernels, shown: Scene, written: Written
) -> Iterator[Control]:
    """Sliders of the coordinates and speeds at the start, in the order of the kernels."""
    equations = kernels.modes[0].equations
    own = (*equations.coordinates, *equations.speeds)
    state = dict(run.segments[0].state(0.0))
    others = [s.published for s in own if s.published not in state]
    state |= {name: float(value) for name, value in run.table(others, 0.0).items()}
    # dense output is a series, whose rounding leaves about 1e-16 where a start is zero
    state |= {number.name: 0.0 for number in shown.start if not number.value}
    found: list[Control] = []
    for symbol in own:
        name = symbol.published
        dimension = equations.dimensions.get(symbol.base(), PURE) / TIME**symbol.order
        unit = "deg" if dimension == PURE else plain_unit(dimension)
        value = float(state[name])
        made = _slider(symbol, written.get(name, ""), unit, "", value, positive=False)
        made = widened(made, dimension, found)
        is_cyclic = symbol.kind is SymbolKind.COORDINATE and not symbol.order and not value
        found.append(replace(made, extra=is_cyclic))
    yield from found


def _slider(
    symbol: Symbol, text: str, unit: str, meaning: str, value: float, *, positive: bool
) -> Control:
    """A slider in the unit in which the value was written, or else in another."""
    if is_plain(text):
        unit = unit_in(text) or unit
    size = read_quantity(f"1 {unit}").value if unit else 1.0
    text = f"{value / size:.12g} {unit}".strip()
    letter = Symbol(symbol.name.rstrip("_"), symbol.kind, symbol.order)
    made = control(letter, text, unit, meaning, value, positive=positive)
    # the value itself, so that an untouched page computes the motion that it opens with
    return replace(made, name=symbol.published, value=value / made.size)


def _texts(sliders: Sequence[Control], values: Mapping[str, float]) -> dict[str, str]:
    """Values of sliders, in their units."""
    named = (slider for slider in sliders if slider.name in values)
    return {s.name: f"{values[s.name] / s.size:.15g} {s.unit}".strip() for s in named}


def _letter(symbol: Symbol) -> str:
    return Expr.generator(Symbol(symbol.published.rstrip("_"))).mathml()


# -- what is drawn ---------------------------------------------------------------------------------


def _drawn(
    run: Trajectory, shown: Scene, outputs: _Outputs, kernels: PageKernels
) -> dict[str, Any]:
    """Everything that is drawn, with the numbers of the outputs in place of values."""
    system = outputs.system
    bodies = list(system.bodies)
    sided = sided_in(run.system if isinstance(run.system, System) else system)
    equations = [mode.equations for mode in kernels.modes]

    def energies(equations: Equations) -> tuple[Expr, Expr]:
        """Energy, and what it is at zero speeds."""
        still = dict.fromkeys(equations.speeds, 0)
        return equations.energy, equations.energy.subs(still)

    return {
        "up": outputs.numbers(up_of(system)),
        "bodies": [_body(body, body in sided, system, outputs) for body in bodies],
        "joints": [
            {
                "kind": joint.kind,
                "name": joint.name,
                "body": bodies.index(joint.body),
                "place": outputs.numbers(joint.place),
                "axis": None if joint.axis is None else outputs.numbers(joint.axis),
            }
            for joint in joints_in(system)
        ],
        "links": [
            {
                "kind": link.kind,
                "name": name,
                "start": outputs.vector(end_of_link(link.start)),
                "end": outputs.vector(end_of_link(link.end)),
            }
            for name, link in links_in(system)
        ],
        "contacts": [_contact(run, contact, shown, outputs) for contact in contacts_in(system)],
        "arrows": [
            {
                "kind": arrow.kind,
                "name": arrow.name,
                "symbol": arrow.symbol,
                "body": bodies.index(arrow.body),
                "unit": arrow.unit,
                "foot": outputs.vector(arrow.foot),
                "along": outputs.vector(arrow.along),
                "normal": outputs.vector(arrow.normal),
                "friction": None if arrow.friction is None else outputs.numbers([arrow.friction]),
            }
            for arrow in arrows_in(system, equations)
        ],
        "angles": [
            {
                "name": angles.name,
                "body": angles.body,
                "vertex": outputs.vector(angles.vertex),
                "rotations": [
                    {
                        "symbol": rotation.symbol,
                        "angle": outputs.numbers([rotation.angle])[0],
                        "axis": outputs.numbers(rotation.axis),
                        "begin": outputs.numbers(rotation.begin),
                        "offset": outputs.numbers([rotation.offset])[0],
                        "coordinate": rotation.coordinate,
                        "sign": rotation.sign,
                    }
                    for rotation in angles.rotations
                ],
            }
            for angles in angles_in(system)
        ],
        "panels": _panels(run, shown, outputs),
        "portraits": _portraits(run, shown, outputs),
        "energy": outputs.meanings(energies),
    }


def _body(body: Body, is_sided: bool, system: System, outputs: _Outputs) -> dict[str, Any]:
    source, fixed = source_of(body.surface, body), body.fixed_axes
    root = system.root
    turn = turning = spin = axis = None
    if fixed is None:
        turning = outputs.vector(turning_of(body))
    else:
        rows = body.axes.rotation_to(root).rows
        turn = outputs.numbers(entry for row in rows for entry in row)
        if fixed != body.axes:
            spin, axis = outputs.numbers([fixed.angle])[0], outputs.numbers(fixed.axis)
    return {
        "name": body.name,
        "rule": "inertia" if is_sided else source.rule,
        "numbers": [] if is_sided else outputs.constants(source.numbers),
        "position": source.position,
        "place": outputs.vector(place_of(body)),
        "turn": turn,
        "turning": turning,
        "spin": spin,
        "axis": axis,
        "velocity": outputs.vector(lambda equations: equations.kinetics.velocities[body][0]),
        "rotation": outputs.vector(lambda equations: equations.kinetics.velocities[body][1]),
        "arms": [outputs.numbers(arm) for arm in arms_in(system, body)],
        "labels": labels_of(body),
    }


def _contact(run: Trajectory, contact: Contact, shown: Scene, outputs: _Outputs) -> dict[str, Any]:
    """A contact with its support, which is drawn with the first contact on it."""
    support = contact.on
    recorded = next((s for s in shown.supports if s.name == contact.name), None)
    edge = support.edge if isinstance(support, Sheet) else None
    grid = None
    if recorded is not None and recorded.kind == "curved":
        grid = _grid(run, contact, shown, outputs, recorded.points)
    surfaces = list(dict.fromkeys(c.on.under("") for c in contacts_in(outputs.system)))
    return {
        "name": contact.name,
        "support": surfaces.index(support.under("")),
        "kind": None if recorded is None else recorded.kind,
        "place": outputs.vector(base_of(contact)),
        "turn": outputs.numbers(directions_of(contact)),
        "turning": outputs.numbers([support.turning])[0],
        "point": outputs.vector(contact_point(contact)),
        "touched": outputs.vector(contact_point(contact, contact.on)),
        "edge": None if edge is None else outputs.numbers([edge])[0],
        "grid": grid,
    }


def _grid(
    run: Trajectory,
    contact: Contact,
    shown: Scene,
    outputs: _Outputs,
    points: Array,
) -> dict[str, Any]:
    """A curved support as values of u and v, or the sides of a body as they were drawn."""
    support = contact.on
    if not isinstance(support, CurvedSupport) or not points.size:
        return {"shape": list(points.shape[:2]), "points": points.ravel().tolist()}
    reach = max(body.reach for body in shown.bodies)
    u, v = patch_of(run, support, reach)
    place = support.foot.express(support.frame).components
    up = support.up.express(support.frame).components
    return {
        "shape": list(u.shape),
        "uv": [outputs.modes[0].dynamics.states.index(as_symbol(q)) for q in support.uv],
        "values": [u.ravel().tolist(), v.ravel().tolist()],
        "foot": outputs.numbers(place),
        "normal": outputs.numbers(up),
    }


def _panels(run: Trajectory, shown: Scene, outputs: _Outputs) -> list[dict[str, Any]]:
    """The plots of the motion that the page opens with."""
    found = []
    for panel in shown.panels:
        series = [
            {"name": one.name, "symbol": one.symbol, "value": _plotted(run, one.name, outputs)}
            for one in panel.series
        ]
        unit = quantity(run, panel.series[0].name).unit
        found.append({"unit": unit, "series": series, "kind": panel.kind})
    return found


def _portraits(run: Trajectory, shown: Scene, outputs: _Outputs) -> list[dict[str, Any]]:
    """Those of the motion that the page opens with, but for its potential."""
    present = {(one.kind, one.names, one.title) for one in shown.portraits}
    return [
        {
            "kind": one.kind,
            "title": one.title,
            "names": one.names,
            "symbols": one.symbols,
            "units": one.units,
            "values": [] if one.kind == "axis" else outputs.columns(one.values, len(one.names)),
            "body": one.body,
            "axis": one.axis,
        }
        for one in portraits_in(equations_of(run))
        if (one.kind, one.names, one.title) in present
    ]


def _plotted(run: Trajectory, name: str, outputs: _Outputs) -> int:
    """The number of a quantity."""

    def meaning(equations: Equations) -> list[Expr | None]:
        if name in ENERGIES:
            kinetic, potential = energies_of(equations)
            return [{"E": equations.energy, "T": kinetic, "V": potential}[ENERGIES[name]]]
        if name in reactions:
            return [equations.components.get(name, Expr.of(0))]
        return [run.quantities[name]]

    reactions = {name for mode in outputs.modes for name in mode.equations.components}
    return outputs.meanings(meaning)[0]
