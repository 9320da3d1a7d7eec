"""The sections of a page about one system."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator
from types import FunctionType

from polhode import catalogue
from polhode.algebra import Expr, Symbol, symbol, time
from polhode.tour._formulas import equation, listed, power_of_ten, raised, scientific, with_formulas
from polhode.tour._motions import DEFAULT_RUN
from polhode.tour._solved import folded, motion_shown, player, solved
from polhode.tour._work import Drawing, Worked
from polhode.view import Markup, inline, joined, table, tag

_IDEALS = {
    "Rolling": "rolls on it without slipping; friction is as large as that requires.",
    "Smooth": "touches it without friction; the force is along its normal.",
    "Coulomb": "slides on it with Coulomb’s friction.",
    "Pivot": "is held at one point, about which it turns freely.",
    "Hold": "is kept from moving, at one point, along the directions of the force.",
    "Hinge": "turns about one axis.",
    "Universal": "turns about two axes that cross at right angles.",
    "Guide": "has its axis kept in a plane, and is otherwise free to turn.",
    "Motor": "is turned at a constant rate.",
}
ZERO = Expr.constant(0)


def section(worked: Worked, folder: str, level: int) -> Markup:
    """All of one system, under a heading of its level (1 for that of the page).

    Its solution comes first, with the motions that show the answers; the declaration, all
    equations, the default run and the checks are folded below it.
    """
    entry = worked.entry
    command = "run" if worked.solution is None else "solve"
    return tag(
        "section",
        tag(f"h{level}", entry.title),
        tag("p", tag("code", f"polhode {command} {entry.name}", class_="command")),
        tag("p", with_formulas(entry.about)),
        *_main_part(worked, folder, level + 1),
        folded("Declaration, equations, the default run and its checks", *_folded(worked, folder)),
        id=anchor(worked),
    )


def _main_part(worked: Worked, folder: str, level: int) -> Iterator[Markup]:
    own = player(f"{anchor(worked)}-3d.html", worked.entry.title)
    if worked.solution is None:
        yield own
        return
    shown = {DEFAULT_RUN.get(worked.entry.name, ""): own}
    for motion in worked.motions:
        name = f"{anchor(worked)}-{motion.motion.name}"
        drawing = Drawing(name, "The quantities against time.", motion.svg)
        image = picture(worked, drawing, folder)
        found = motion_shown(motion, f"{name}-3d.html", image)
        asked = motion.motion.question
        shown[asked] = joined([shown.get(asked, Markup()), found])
    yield from solved(worked.solution, anchor(worked), level, shown)


def _folded(worked: Worked, folder: str) -> Iterator[Markup]:
    shown = (picture(worked, drawing, folder) for drawing in worked.drawings)
    parts: dict[str, Iterable[Markup]] = {
        "Declaration": [tag("pre", tag("code", source_of(worked.entry.build)), tabindex="0")],
        "Assumptions": _assumptions(worked),
        "Coordinates and speeds": _kinematics(worked),
        "Equations of motion": (equation(row, ZERO) for row in worked.equations.motion),
        "Reactions": _reactions(worked),
        "Energy": _energy(worked),
        "Conserved": _conserved(worked),
        "The default run": [_numbers(worked), tag("div", *shown, class_="figures")],
        "Checks": [_checks(worked)],
    }
    # Each part has a label; empty parts are omitted.
    for title, content in parts.items():
        if found := joined(content):
            yield joined([tag("p", title, class_="part"), found])


def anchor(worked: Worked) -> str:
    """The fragment of the page's address that leads to the system."""
    return stem(worked.entry.name)


def stem(name: str) -> str:
    """Name of the files of a system of the catalogue."""
    return name.replace("/", "-")


def problem_of(worked: Worked) -> str:
    """The problem that a system of the catalogue belongs to."""
    return worked.entry.name.partition("/")[0]


def picture(worked: Worked, drawing: Drawing, folder: str) -> Markup:
    """A figure with its caption, and its dark version for pages in dark mode."""
    # Width and height in the units of the drawing.
    box = drawing.svg.partition('viewBox="')[2].partition('"')[0].split()
    width, height = (f"{float(side):.0f}" for side in box[2:4])
    image = tag(
        "img",
        src=f"{folder}/{drawing.name}.svg",
        alt=f"{worked.entry.title}: {drawing.caption}",
        width=width,
        height=height,
        loading="lazy",
    )
    dark = tag(
        "source",
        media="(prefers-color-scheme: dark)",
        srcset=f"{folder}/{drawing.name}-dark.svg",
    )
    return tag("figure", tag("picture", dark, image), tag("figcaption", drawing.caption))


def _assumptions(worked: Worked) -> Iterator[Markup]:
    system, equations = worked.equations.system, worked.equations
    items: list[Markup] = [
        tag("li", tag("em", element.name), f": the {element.bodies[0].name} {ideal}")
        for element in system.elements
        for ideal in [_IDEALS[type(element).__name__]]
    ]
    items += [
        tag("li", inline(positive), " is taken to be positive.")
        for positive in equations.assumed_positive
    ]
    yield tag("ul", tag("li", "All bodies are rigid."), *items)


def _kinematics(worked: Worked) -> Iterator[Markup]:
    equations = worked.equations
    yield tag(
        "p",
        "Coordinates ",
        listed(equations.coordinates),
        "; independent speeds ",
        listed(equations.speeds),
        ".",
    )
    rates = {s: e for s, e in equations.kinematics.items() if s not in equations.speeds}
    rates |= equations.dependent
    yield from (equation(Expr.generator(s), e) for s, e in rates.items())


def _reactions(worked: Worked) -> Iterator[Markup]:
    equations = worked.equations
    components = equations.components
    for element, restraints in equations.kinetics.restraints.items():
        yield tag("p", f"On the {restraints[0].body.name}, by ", tag("em", element), ":")
        yield from _assigned({r.name: components[r.name] for r in restraints})
    if equations.undetermined:
        names = equations.undetermined
        yield tag(
            "p",
            "Newton’s laws do not determine ",
            listed(map(Symbol, names)),
            ". The choice with the smallest sum of squares, of forces and then of couples, is",
        )
        yield from _assigned({name: equations.least[name] for name in names})


def _assigned(values: dict[str, Expr]) -> Iterator[Markup]:
    """The value of each component; those left undetermined are omitted."""
    named = ((Expr.generator(Symbol(name)), value) for name, value in values.items())
    return (equation(name, value) for name, value in named if value != name)


def _energy(worked: Worked) -> Iterator[Markup]:
    equations = worked.equations
    yield equation(symbol("T"), equations.kinetic_energy)
    if equations.potential_energy:
        yield equation(symbol("V"), equations.potential_energy)
    if equations.power:
        yield tag("p", "Supports or motors do work at the rate")
        yield equation(symbol("P"), equations.power)
    else:
        yield tag("p", "Only forces with a potential do work.")


def _conserved(worked: Worked) -> Iterator[Markup]:
    speeds = {i.name: s for i in worked.conserved if (s := i.expression.symbol)}
    for invariant in worked.conserved:
        if invariant.name not in speeds:
            yield equation(symbol(invariant.name), invariant.expression)
    if speeds:
        are = "is" if len(speeds) == 1 else "are"
        yield tag("p", listed(speeds.values()), f" {are} constant.")


def _numbers(worked: Worked) -> Markup:
    entry, run = worked.entry, worked.run
    known = run.quantities
    rows: list[tuple[str, ...]] = []
    for parameter in entry.parameters:
        name, value = parameter.name, parameter.default
        if "*" in value and name in run.parameters:  # it follows from other parameters
            value = f"{run.parameters[name]:.3g} {parameter.unit}"
        letter = inline(known.get(name, symbol(name)))
        rows.append((letter, _raised(parameter.meaning), _raised(value)))
    rows += [
        (inline(known[name]), "at the start", _raised(value)) for name, value in entry.start.items()
    ]
    rows += [
        (inline(Expr.generator(s)), "prescribed", inline(motion))
        for s, motion in run.dynamics.prescribed.items()
    ]
    rows.append((inline(time), "duration", entry.duration))
    also = (tag("p", "All other quantities start at zero."),) if run.assumed else ()
    return joined([_wide(("symbol", "meaning", "value"), rows, "values"), *also])


def _raised(text: str) -> Markup:
    """Powers raised, as in m/s² and 10⁻⁵."""
    return raised(scientific(text.replace("^2", "²").replace("^3", "³")))


def _checks(worked: Worked) -> Markup:
    rows = (
        (
            check.name,
            check.how,
            _mark("holds" if check.passed else "fails", check.passed),
            raised(check.found),
        )
        for check in worked.checks
    )
    header = ("check", "what is compared", "verdict", "difference")
    return _wide(header, rows, "checks")


def _mark(words: str, passed: bool) -> Markup:
    return tag("span", words, class_="good" if passed else "bad")


def summary(all_worked: Iterable[Worked]) -> Markup:
    """A row for every system, with a link to its section."""
    rows = (
        (
            tag("a", worked.entry.title, href=f"{problem_of(worked)}.html#{anchor(worked)}"),
            str(worked.judged or ""),
            str(len(worked.equations.motion)),
            str(len(worked.equations.components)),
            _mark(f"{worked.passed} of {len(worked.checks)}", worked.passed == len(worked.checks)),
            raised(power_of_ten(worked.run.drift.energy)),
            raised(power_of_ten(worked.constraint_drift, "m")),
        )
        for worked in all_worked
    )
    header = (
        "system",
        "formulas judged",
        "equations",
        "reactions",
        "checks",
        "energy drift",
        "constraint drift",
    )
    return _wide(header, rows, "numbers")


def _wide(header: Iterable[str], rows: Iterable[Iterable[str]], kind: str) -> Markup:
    """A table that scrolls sideways if it is too wide for the page."""
    return tag("div", table(header, rows, class_=kind), class_="wide")


def source_of(build: Callable[[], object]) -> str:
    """Source of a function and of the catalogue's own functions it calls, callers last."""
    needed = list(dict.fromkeys(reversed(list(_reached(build)))))
    return "\n\n".join(inspect.getsource(function).rstrip() for function in needed)


def _reached(function: object) -> Iterator[FunctionType]:
    if isinstance(function, FunctionType) and function.__module__.startswith(catalogue.__name__):
        yield function
        for name in function.__code__.co_names:
            yield from _reached(function.__globals__.get(name))
