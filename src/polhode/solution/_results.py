"""What follows from the equations: their short form, reactions, steady motions, stability."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import suppress
from dataclasses import dataclass

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, Vector, pi, sqrt
from polhode.analyse import (
    Condition,
    Departures,
    SteadyMotion,
    Truth,
    departures,
    reduced,
    stability,
    steady,
)
from polhode.base import NumericError, PolhodeError
from polhode.claims import Answer, check
from polhode.model import Frame
from polhode.solution._judge import if_true
from polhode.solution._lines import SolutionLine, inline, letter_of, listed, unit, vector_latex
from polhode.solution._setting import LONGEST, PATIENCE, WIDEST, Setting, bound

#: How much shorter a force has to become by the equations of motion, or along other axes.
_SHORTER, _OTHER_AXES = 0.8, 1.25
#: Angles at which a motion may be simpler than elsewhere.
_SPECIAL = (pi / 2, ZERO, pi)
_EPSILON = Expr.generator(Symbol("epsilon", SymbolKind.COORDINATE))


def equations_of_motion(setting: Setting, shown: Collection[str]) -> Iterator[SolutionLine]:
    """The equations of motion without idle factors, except those that are shown already."""
    equations = setting.equations
    rows = [row for row in equations.motion if len(row.latex()) <= LONGEST]
    texts = [text for row in rows if (text := f"{row.latex()} = 0") not in shown]
    for i, text in enumerate(texts):
        words = "Without common factors the equations of motion are" if i == 0 else ""
        yield SolutionLine(words, text, f"motion_{i + 1}")
    if len(rows) < len(equations.motion):
        yield SolutionLine(
            f"{len(equations.motion) - len(rows)} of the equations of motion have no short form; "
            "derive prints them."
        )


def reactions(setting: Setting) -> Iterator[SolutionLine]:
    """The forces of the supports, along the axes in which they are short."""
    open_ = setting.equations.undetermined
    if open_:
        free = [n for n in open_ if setting.equations.components[n] == Expr.generator(Symbol(n))]
        yield SolutionLine(
            f"The supports are redundant: {listed(inline(Symbol(name)) for name in free)} may have "
            "any value, which Newton's laws leave open, and the other forces depend on "
            f"{'it' if len(free) == 1 else 'them'}."
        )
    for line in _forces(setting):
        yield bound(setting, line)


def _forces(setting: Setting) -> Iterator[SolutionLine]:
    for element in setting.forced:
        raw = setting.equations.reactions[element.name].force
        frame, force, written = _shortened(setting, raw)
        reduced = not (force - raw).is_zero
        letter = setting.force_letter(element)
        if len(written) > LONGEST:
            yield SolutionLine(
                f"The force of “{element.name}” has no short form along any of the axes."
            )
            continue
        parts = dict(zip(frame.labels, force.express(frame).components, strict=True))
        present = {label: value for label, value in parts.items() if value}
        which = "the support" if len(setting.forced) == 1 else f"“{element.name}”"
        if not present:
            words = f"The force of {which} vanishes, by the equations of motion:"
            yield SolutionLine(words, f"{letter} = 0", f"reaction_{element.name}")
            continue
        along = listed(f"${letter_of(label)}$" for label in present)
        by = ", by the equations of motion," if reduced else ""
        short = "" if len(setting.frames) == 1 else ", where its components are shortest"
        words = f"The force of {which} is{by or ','} along {along}{short},"
        if len(present) == 1:
            words = f"The force of {which} acts{by} along {along} alone:"
        if len(written) <= WIDEST:
            yield SolutionLine(words, f"{letter} = {written}", f"reaction_{element.name}")
            continue
        for label, value in present.items():
            along_it = rf"{letter}\cdot {unit(label)}"
            yield SolutionLine(
                words, f"{along_it} = {value.latex()}", f"reaction_{element.name}_{label}"
            )
            words = ""
    names = [
        restraint.name
        for element in setting.twisting
        for restraint in setting.equations.kinetics.restraints[element.name]
        if restraint.is_couple
    ]
    found = ((name, _couple(setting, name)) for name in names)
    couples = {name: value for name, value in found if value is not None}
    several = len(couples) > 1
    words = "The couples of the supports are" if several else "The couple of the support is"
    for name, couple in couples.items():
        letter = Expr.generator(Symbol(name)).latex()
        yield SolutionLine(words, f"{letter} = {couple.latex()}", f"couple_{name}")
        words = ""


def _shortened(setting: Setting, force: Vector) -> tuple[Frame, Vector, str]:
    """The frame along which a force is short, and the force there by the equations of motion."""
    plain, _ = setting.shortest(force)
    along = {frame: force.express(frame).components for frame in setting.frames}
    shorter = {
        frame: Vector(tuple(_on_motion(setting, value) for value in values), frame)
        for frame, values in along.items()
        if sum(len(value.latex()) for value in values) <= 4 * LONGEST
    }
    written = [(frame, force, vector_latex(force, frame)) for frame, force in shorter.items()]
    if not written:
        return plain, force, vector_latex(force, plain)
    return min(written, key=lambda one: len(one[2]) * (1 if one[0] == plain else _OTHER_AXES))


def _on_motion(setting: Setting, value: Expr) -> Expr:
    """A component with accelerations put in that the equations of motion give, where shorter."""
    equations = setting.equations
    with suppress(NumericError):  # too many coupled speeds
        rates = equations.accelerations.items()
        value = value.subs({rate: ZERO for rate, found in rates if not found})
    for row in equations.motion:
        for rate in equations.acceleration_symbols:
            slope, inertia = value.diff(rate), row.diff(rate)
            if slope and inertia:
                other = value - row * slope / inertia
                if len(other.latex()) < _SHORTER * len(value.latex()):
                    value = other
    return value


def _couple(setting: Setting, name: str) -> Expr | None:
    """The component of a couple, if there is one that can be written out."""
    value = _on_motion(setting, setting.equations.components.get(name, ZERO))
    return value if value and len(value.latex()) <= LONGEST else None


# -- steady motions --------------------------------------------------------------------------------


def steady_motions(setting: Setting) -> Iterator[SolutionLine]:
    """All families of steady motions, both roots, and the limit of fast spin."""
    try:
        families = steady(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    shown = [family for family in families if len(family.latex()) <= LONGEST]
    if not shown or all(not family.conditions for family in shown):
        return
    system = reduced(setting.equations)
    idle = setting.idle_speeds
    still = [s for s in system.state if s not in idle]
    kept = [s for s in still if not (s.order and s.base() in system.essential)]
    state = "a steady motion" if any(s not in system.essential for s in kept) else "equilibrium"
    yield SolutionLine(f"In {state} {listed(map(inline, kept))} {_are(kept)} constant.")
    isolated = [family for family in shown if not family.relations]
    regular = [_fixed_words(family) for family in isolated if _has_departures(family)]
    singular = [_fixed_words(family) for family in isolated if not _has_departures(family)]
    if regular:
        either = f"{'; with '.join(regular[:-1])}; or with " if len(regular) > 1 else ""
        resting = tuple(line for f in isolated if _has_departures(f) for line in _resting(f))
        yield SolutionLine(f"This is possible with {either}{regular[-1]}.", stated=resting)
    related = [f for f in shown if len(f.relations) == 1 and _is_true_of_all(f)]
    for i, alike in enumerate(_alike(related)):
        words = "Otherwise" if regular else "Then"
        yield from _families(setting, alike, i, words)
    if singular:
        yield SolutionLine(
            f"At {listed(singular)} the angles are singular; two tilts of the axis would "
            "describe the motion there."
        )
    if len(related) + len(isolated) < len(families):
        more = "further families, which" if related or isolated else "families that"
        yield SolutionLine(f"There are {more} have no short form; steady lists them.")


def _given(family: SteadyMotion) -> tuple[str, ...]:
    """What restricts a claim to a family, besides its relations."""
    essential = family.reduced.essential
    return tuple(
        f"{s.published} = {value}"
        for s, value in family.fixed.items()
        if not (s.order and s.base() in essential)
    )


def _is_true_of_all(family: SteadyMotion) -> bool:
    """Whether the relation of a family holds on every steady motion with its fixed values."""
    text = f"{family.relations[0].latex()} = 0"
    return _holds(text, "steady", _given(family), family)


def _are(things: list[Symbol]) -> str:
    return "is" if len(things) == 1 else "are"


def _resting(family: SteadyMotion) -> Iterator[SolutionLine]:
    """That all speeds stay constant on a family that is given by its fixed values."""
    system = family.reduced
    still = [f"{q.derivative().published} = 0" for q in system.essential]
    fixed = [f"{s.published} = {v!s}" for s, v in family.fixed.items() if not s.order]
    rates = [Expr.generator(s.derivative()).latex() for s in system.equations.speeds]
    moving = [f"{s.published} = {v!s}" for s, v in family.fixed.items() if s.order]
    given = tuple(dict.fromkeys((*fixed, *moving, *still)))
    claim = SolutionLine("", f"{' = '.join(rates)} = 0", given=given)
    yield from if_true([claim], system.equations)


def _alike(families: list[SteadyMotion]) -> list[list[SteadyMotion]]:
    """Families with the same relation, such as those at ψ = 0 and ψ = π, together."""
    groups = dict[Expr, list[SteadyMotion]]()
    for family in families:
        groups.setdefault(family.relations[0], []).append(family)
    return list(groups.values())


def _families(
    setting: Setting, alike: list[SteadyMotion], number: int, start: str
) -> Iterator[SolutionLine]:
    """A relation that families require; the start is the first word where they fix nothing."""
    family = alike[0]
    fixed = " or ".join(dict.fromkeys(filter(None, map(_fixed_words, alike))))
    words = f"{f'With {fixed},' if fixed else start} the equations of motion require"
    text = f"{family.relations[0].latex()} = 0"
    given = _given(family)
    others = tuple(SolutionLine("", text, context="steady", given=_given(one)) for one in alike[1:])
    yield SolutionLine(words, text, f"steady_{number}", "steady", given=given, stated=others)
    yield from _roots(setting, family, number)


def _has_departures(family: SteadyMotion) -> bool:
    """Whether small departures are described by the angles of the declaration."""
    try:
        departures(family)
    except PolhodeError:
        return False
    return True


def _angles_first(pair: tuple[Symbol, Expr]) -> tuple[bool, str]:
    return bool(pair[0].order) or pair[0].kind is not SymbolKind.COORDINATE, pair[0].published


def _fixed_words(family: SteadyMotion) -> str:
    own = family.reduced.essential
    return listed(
        [
            f"${Expr.generator(s).latex()} = {value.latex()}$"
            for s, value in sorted(family.fixed.items(), key=_angles_first)
            if not (s.order and s.base() in own)
        ]
        or [""]
    )


def _roots(setting: Setting, family: SteadyMotion, number: int) -> Iterator[SolutionLine]:
    if not family.branches:
        return
    quantity = family.branches[0].quantity
    (relation,) = family.relations
    symbol = quantity.symbol
    if symbol is None:
        return
    text = _solved(relation, symbol)
    if len(text) > LONGEST:
        return
    both = len(family.branches) > 1
    roots = f"a quadratic equation for {inline(quantity)}, whose roots are"
    if leading := _may_vanish(_parts(relation, symbol)[0], setting):
        roots += f", for ${leading} \\ne 0$,"
    yield SolutionLine(
        roots if both else "so that",
        f"{quantity.latex()} = {text}",
        f"roots_{number}",
        "steady",
        given=_given(family),
        values=_root_values(relation, symbol),
    )
    yield from _existence(family, number)
    yield from if_true(_fast_spin(family, quantity), family.reduced.equations)


def _may_vanish(leading: Expr, setting: Setting) -> str:
    """The factor of a leading coefficient that depends on the state and may be zero."""
    terms = tuple(leading.terms())
    shared = [g for g in terms[0][0] if all(g in powers for powers, _ in terms)] if terms else []
    changing = [Expr.generator(g) for g in shared if any(s.kind.varies for s in g.symbols())]
    rest = leading
    for factor in changing:
        rest = rest / factor
    of_both_signs = len({number > 0 for _, number in terms}) > 1
    if any(s.kind.varies for s in rest.symbols()) or of_both_signs:
        text, opposite = leading.latex(), (-leading).latex()
        return opposite if text.startswith("-") else text
    signs = setting.equations.assumed_positive
    return " ".join(factor.latex() for factor in changing if factor not in signs)


def _existence(family: SteadyMotion, number: int) -> Iterator[SolutionLine]:
    """When the roots are real, where that can be judged."""
    conditions = [c for c in family.branches[0].exists if c.truth is Truth.OPEN]
    if len(conditions) != 1:
        return
    forms = [f.latex for f in _threshold_forms(conditions[0].expression, family)]
    short = (f for f in forms if len(f) <= LONGEST and _holds(f, "threshold", (), family))
    if text := next(short, ""):
        yield SolutionLine(
            "They are real and different if", text, f"existence_{number}", "threshold"
        )


def _parts(relation: Expr, symbol: Symbol) -> tuple[Expr, Expr, Expr]:
    """a, b and c of the relation a q² + 2 b q + c."""
    slope = relation.diff(symbol)
    at_zero = {symbol: ZERO}
    return slope.diff(symbol) / 2, slope.subs(at_zero) / 2, relation.subs(at_zero)


def _solved(relation: Expr, symbol: Symbol) -> str:
    """The root or both roots of a relation, in the shortest of a few normalisations."""
    a, b, c = _parts(relation, symbol)
    if not a:
        return (-c / (2 * b)).latex()
    functions = [g for g in a.generators if not isinstance(g, Symbol)]
    scales = [ONE, a, *(a / Expr.generator(g) for g in functions)]
    scales += [b / Expr.generator(g) for g in b.generators if g.symbols() and b]
    scales += [scale / 2 for scale in scales]
    signed = [scale * sign for scale in scales for sign in (ONE, -ONE)]
    return min((_both(a / scale, b / scale, c / scale) for scale in signed), key=len)


def _root_values(relation: Expr, symbol: Symbol) -> tuple[tuple[str, Expr], ...]:
    """Both roots with a subscript, or the only one."""
    a, b, c = _parts(relation, symbol)
    name = Expr.generator(symbol).latex()
    if not a:
        return ((name, -c / (2 * b)),)
    root = sqrt(b * b - a * c)
    return ((f"{name}_1", (-b + root) / a), (f"{name}_2", (-b - root) / a))


def _both(a: Expr, b: Expr, c: Expr) -> str:
    """(-b ± √(b² - a c))/a."""
    above = (-b).latex() if b else ""
    top = rf"{above} \pm \sqrt{{{(b * b - a * c).latex()}}}".strip()
    return top if a == ONE else rf"\frac{{{top}}}{{{a.latex()}}}"


def _fast_spin(family: SteadyMotion, quantity: Expr) -> Iterator[SolutionLine]:
    """The slow root -c/2b and the fast one -2b/a for a spin that is large, to leading order."""
    symbol = quantity.symbol
    if symbol is None or len(family.branches) < 2:
        return
    a, b, c = _parts(family.relations[0], symbol)
    spins = [s for s in b.symbols() if s.kind is SymbolKind.SPEED]
    if len(spins) != 1 or not c or spins[0] in {*a.symbols(), *c.symbols()}:
        return
    (spin,) = spins
    words = f"For fast spin, large {inline(spin)}, they become a slow one and a fast one,"
    for key, value, order in (("slow", -c / (2 * b), 1), ("fast", -2 * b / a, 0)):
        yield SolutionLine(
            words,
            rf"{quantity.latex()} \approx {value.latex()}",
            key,
            "limit",
            small=(f"1/{spin.published}:{order}",),
        )
        words = ""


# -- stability at special angles -------------------------------------------------------------------


def special_motions(setting: Setting) -> Iterator[SolutionLine]:
    """Steady motions at an upright or level attitude, their linear equations and thresholds."""
    try:
        essential = reduced(setting.equations).essential
        general = steady(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    if len(essential) == 1:
        (angle,) = essential
        for value in _SPECIAL:
            try:
                families = steady(setting.equations, {angle: value})
            except (PolhodeError, ZeroDivisionError):
                continue
            for family in families:
                yield from _special(setting, family, angle, value)
        return
    for family in general:
        if not family.relations:
            yield from _special(setting, family, None, ZERO)


def _special(
    setting: Setting, family: SteadyMotion, angle: Symbol | None, value: Expr
) -> Iterator[SolutionLine]:
    if family.relations:
        return
    try:
        judged = stability(family)
        names = {angle: _EPSILON} if angle is not None else {}
        found = departures(family, names=names)
    except (PolhodeError, ZeroDivisionError):
        return
    where = _fixed_words(family)
    if not where:
        return
    idle = setting.idle_speeds
    arbitrary = [inline(s) for s in family.reduced.speeds if s not in {*family.fixed, *idle}]
    free = f" with any {listed(arbitrary)}" if arbitrary else ""
    moves = arbitrary or any(s.kind is SymbolKind.SPEED and v for s, v in family.fixed.items())
    state = "Steady motion" if moves else "Equilibrium"
    if angle is not None:
        small = "" if not value else f" - {value.latex()}"
        intro = (
            f"{state} is possible at {where}{free}. Let "
            f"$\\epsilon = {Expr.generator(angle).latex()}{small}$ be a small departure from it. "
            "To first order the equations of motion become"
        )
    else:
        intro = f"{state} is possible at {where}{free}. Close to it, to first order,"
    lines = list(_linear_lines(found, angle, value, intro))
    yield from lines
    if not lines:
        yield SolutionLine(f"{state} is possible at {where}{free}.")
    swing = tuple(_swing(judged.frequencies, lines)) if angle is not None else ()
    swing = tuple(if_true(swing, family.reduced.equations))
    yield from _threshold(family, judged.conditions, judged.truth, judged.frequencies, swing)


def _swing(frequencies: tuple[Expr, ...], lines: list[SolutionLine]) -> Iterator[SolutionLine]:
    """That ε oscillates at the only frequency, where nothing else varies with it."""
    first = next((line for line in lines if line.let), None)
    if len(frequencies) == 1 and first is not None:
        (rate,) = frequencies
        text = rf"\ddot{{\epsilon}} \approx {(-(rate**2) * _EPSILON).latex()}"
        yield SolutionLine("", text, context="limit", let=first.let, small=first.small)


def _linear_lines(
    found: Departures, angle: Symbol | None, value: Expr, intro: str
) -> Iterator[SolutionLine]:
    """The linear equations in ε and in the speeds that vanish on the family."""
    family = found.family
    images = dict[Symbol, Expr]()
    small = list[str]()
    for symbol, departure in found.names.items():
        if angle is not None and symbol.base() == angle:
            continue
        vanishing = symbol in family.fixed and not family.fixed[symbol]
        own = departure.symbol
        if own is None:
            return
        if vanishing:
            small.append(symbol.published)
            images[own] = Expr.generator(symbol)
        images[own.derivative()] = Expr.generator(symbol.derivative())
    rows = [row.subs(images) for row in found.equations]
    hidden = {s for row in rows for s in row.symbols() if s.name.startswith("delta_")}
    if hidden or not rows:
        return
    let: tuple[str, ...] = ()
    given_small = [f"{name}:1" for name in small if angle is None or name != f"{angle.name}_dot"]
    if angle is not None:
        let = (f"epsilon = {angle.published} - ({value})",)
        given_small.insert(0, "epsilon:1")
    if not given_small or any(len(row.latex()) > WIDEST for row in rows):
        return
    exact = family.reduced.equations.motion
    rows = [row for row in rows if not (row in exact and _is_linear(row))]
    for i, row in enumerate(rows):
        yield SolutionLine(
            intro if i == 0 else "",
            rf"{row.latex()} \approx 0",
            f"linear_{i + 1}",
            "limit",
            let=let,
            small=tuple(given_small),
        )
    if angle is not None:
        equations = family.reduced.equations
        yield from if_true(_oscillator(rows, let, tuple(given_small)), equations)
        together = _put_together(found, rows, images, let, tuple(given_small))
        yield from if_true(together, equations)


def _oscillator(
    rows: list[Expr], let: tuple[str, ...], small: tuple[str, ...]
) -> Iterator[SolutionLine]:
    """ε̈ in terms of ε alone, where nothing else varies with it."""
    bend = _EPSILON.dt().dt().symbol
    target = next((row for row in rows if bend in row.symbols()), None)
    if target is None or bend is None:
        return
    inertia = target.diff(bend)
    value = -(target - inertia * Expr.generator(bend)) / inertia
    slope = value.diff(_EPSILON.symbol) if _EPSILON.symbol is not None else ZERO
    if not slope or inertia == ONE or value != slope * _EPSILON:
        return
    if any(f"{s.published}:1" in small for s in slope.symbols()):
        return
    yield SolutionLine(
        "so that",
        rf"{Expr.generator(bend).latex()} \approx {value.latex()}",
        "oscillator",
        "limit",
        let=let,
        small=small,
    )


def _is_linear(row: Expr) -> bool:
    """Whether every term contains one varying quantity at most."""
    varying = (
        sum(p for g, p in powers.items() if any(s.kind.varies for s in g.symbols()))
        for powers, _ in row.terms()
    )
    return all(count <= 1 for count in varying)


def _put_together(
    found: Departures,
    rows: list[Expr],
    images: dict[Symbol, Expr],
    let: tuple[str, ...],
    small: tuple[str, ...],
) -> Iterator[SolutionLine]:
    """A row that is a derivative gives a speed in terms of ε, which is put into that of ε̈."""
    bend = _EPSILON.dt().dt()
    steering = [i.subs(images) for i in found.integrals if _EPSILON.symbol in i.symbols()]
    target = next((row for row in rows if bend.symbol in row.symbols()), None)
    if len(steering) != 1 or target is None or bend.symbol is None:
        return
    (constant,) = steering
    both = constant.symbols() & target.symbols()
    speeds = [s for s in both if s.order and f"{s.published}:1" in small]
    if len(speeds) != 1:
        return
    (speed,) = speeds
    slope = constant.diff(speed)
    value = -(constant - slope * Expr.generator(speed)) / slope
    row = target.subs({speed: value})
    rate = -(row - row.diff(bend.symbol) * bend) / row.diff(bend.symbol)
    shown = value / _EPSILON
    whole = constant / slope
    yield SolutionLine(
        "The first of these equations can be integrated:",
        rf"\frac{{d}}{{dt}}\left({whole.latex()}\right) \approx 0",
        "steering",
        "limit",
        let=let,
        small=small,
    )
    yield SolutionLine(
        "A constant of integration would only shift the origin of $\\epsilon$, to a neighbouring "
        "steady motion; we take it as zero. Then "
        f"${Expr.generator(speed).latex()} = {_times_epsilon(shown)}$, which put into the other "
        "equation gives",
        rf"{bend.latex()} \approx {_times_epsilon(rate / _EPSILON)}",
        "oscillator",
        "limit",
        let=let,
        small=small,
        given=(f"{speed.published} = {value!s}",),
    )


def _times_epsilon(coefficient: Expr) -> str:
    return (coefficient * _EPSILON).latex()


def _threshold(
    family: SteadyMotion,
    conditions: tuple[Condition, ...],
    truth: Truth,
    frequencies: tuple[Expr, ...],
    swing: tuple[SolutionLine, ...] = (),
) -> Iterator[SolutionLine]:
    if truth is Truth.NEVER:
        yield SolutionLine("Small departures grow: this motion is unstable.")
        return
    if truth is Truth.ALWAYS:
        rates = [f for f in frequencies if len(f.latex()) <= LONGEST]
        how = f", but oscillate at the angular frequency {inline(rates[0])}" if rates else ""
        words = f"Small departures do not grow{how if len(frequencies) == 1 else ''}."
        yield SolutionLine(words, stated=swing)
        return
    given = _given(family)
    for condition in conditions:  # one of several may imply the others
        for form in _threshold_forms(condition.expression, family):
            if len(form.latex) > LONGEST or not _holds(form.latex, "threshold", given, family):
                continue
            sign = "" if form.speed is None else f", with {inline(form.speed)} counted positive,"
            words = f"Small departures stay small if{sign}"
            values = () if form.bound is None else ((form.bound.latex(), form.bound),)
            yield SolutionLine(
                words, form.latex, "threshold", "threshold", given=given, values=values
            )
            return
    yield SolutionLine("The conditions of stability have no short form; steady prints them.")


def _holds(text: str, context: str, given: tuple[str, ...], family: SteadyMotion) -> bool:
    """Whether a claim about a family is judged to hold."""
    equations = family.reduced.equations
    positive = tuple(map(str, equations.assumed_positive))
    try:
        verdict = check(
            text,
            equations,
            context=context,
            given=given,
            positive=positive,
            seconds=PATIENCE,
        )
    except PolhodeError:
        return False
    return verdict.answer is Answer.HOLDS


@dataclass(frozen=True)
class _Form:
    """A condition as it may be printed.

    Attributes:
        latex: of it.
        speed: counted positive in it, if there is one.
        bound: of that speed.
    """

    latex: str
    speed: Expr | None = None
    bound: Expr | None = None


def _threshold_forms(expression: Expr, family: SteadyMotion) -> Iterator[_Form]:
    """A condition solved for a speed, above a bound or below, and as it stands.

    Which of them are true depends on signs that the parameters may leave open, so that each has to
    be judged.
    """
    for symbol in family.reduced.speeds:
        speed = Expr.generator(symbol)
        if symbol not in expression.symbols():
            continue
        square = expression.diff(symbol).diff(symbol) / 2
        rest = expression.subs({symbol: ZERO})
        if square and not (expression - square * speed**2 - rest) and not square.diff(symbol):
            bound = -rest / square
            if not any(s.kind.varies for s in bound.symbols()):
                for sign in "><":
                    root = sqrt(bound)
                    yield _Form(f"{speed.latex()} {sign} {root.latex()}", speed, root)
    yield _Form(f"{expression.latex()} > 0")
