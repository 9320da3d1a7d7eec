"""Families of steady motions: what they require, the roots, and the limit of fast spin."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, pi, sqrt
from polhode.analyse import (
    SteadyMotion,
    Truth,
    departures,
    reduced,
    steady,
)
from polhode.base import PolhodeError
from polhode.judge import Answer, check
from polhode.solution._judge import if_true
from polhode.solution._letters import definition, free_letter, letter_latex
from polhode.solution._lines import SolutionLine, fraction, inline, listed, root_latex
from polhode.solution._setting import LONGEST, PATIENCE, Setting
from polhode.solution._tex_rows import WIDE, width


def steady_motions(setting: Setting) -> Iterator[SolutionLine]:
    """All families of steady motions, both roots, and the limit of fast spin."""
    try:
        families = steady(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    families = tuple(f for i, f in enumerate(families) if not _repeats(f, families[:i]))
    shown = [family for family in map(explicit, families) if len(family.latex()) <= LONGEST]
    if not shown or all(not family.conditions for family in shown):
        return
    system = reduced(setting.equations)
    idle = setting.idle_speeds
    still = [s for s in system.state if s not in idle]
    kept = [s for s in still if not (s.order and s.base() in system.essential)]
    state = "a steady motion" if any(s not in system.essential for s in kept) else "equilibrium"
    yield SolutionLine(f"In {state} {listed(map(inline, kept))} {_are(kept)} constant.")
    isolated = [family for family in shown if not family.relations]
    regular = [fixed_words(family) for family in isolated if _has_departures(family)]
    singular = [fixed_words(family) for family in isolated if not _has_departures(family)]
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


def explicit(family: SteadyMotion) -> SteadyMotion:
    """The same family with the coordinates as values that its relations give, if they give any."""
    fixed, left = dict(family.fixed), list[Expr]()
    for relation in (one.subs(fixed) for one in family.relations):
        for q in (q for q in family.reduced.essential if q not in fixed):
            slope = relation.diff(q)
            if slope and not any(s.kind.varies for s in slope.symbols()):
                value = Expr.generator(q) - relation / slope
                if not any(s.kind.varies for s in value.symbols()):
                    fixed[q] = value
                    break
        else:
            left.append(relation)
    return SteadyMotion(family.reduced, fixed, tuple(left))


def _repeats(family: SteadyMotion, others: Sequence[SteadyMotion]) -> bool:
    """Whether a particle is where it is on another family, its direction given by other angles."""
    equations = family.reduced.equations
    bodies = equations.system.bodies
    if any(any(row) for body in bodies for row in body.inertia.rows):
        return False
    places = [equations.kinetics.places[body].express(body.axes.root) for body in bodies]
    parts = [part for place in places for part in place.components]
    turned = {q: Expr.generator(q) + pi for q in family.free if not q.order}
    here = [part.subs(family.fixed).subs(turned) for part in parts]
    alike = [o for o in others if turned and o.fixed.keys() == family.fixed.keys()]
    return any(here == [part.subs(other.fixed) for part in parts] for other in alike)


def given_of(family: SteadyMotion) -> tuple[str, ...]:
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
    return holds(text, "steady", given_of(family), family)


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
    fixed = " or ".join(dict.fromkeys(filter(None, map(fixed_words, alike))))
    words = f"{f'With {fixed},' if fixed else start} the equations of motion require"
    text = f"{family.relations[0].latex()} = 0"
    given = given_of(family)
    others = tuple(
        SolutionLine("", text, context="steady", given=given_of(one)) for one in alike[1:]
    )
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


def fixed_words(family: SteadyMotion) -> str:
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
        yield from _direction(family)
        return
    quantity = family.branches[0].quantity
    (relation,) = family.relations
    symbol = quantity.symbol
    if symbol is None:
        return
    text, inside = _solved(relation, symbol)
    if len(text) > LONGEST:
        return
    let: tuple[str, ...] = ()
    if width(text) > WIDE and inside:
        name = letter_latex(free_letter(setting.equations, "D", "Delta", "q"))
        text = text.replace(rf"\sqrt{{{inside}}}", rf"\sqrt{{{name}}}")
        let = (definition(name, inside),)
    both = len(family.branches) > 1
    roots = f"a quadratic equation for {inline(quantity)}, whose roots are"
    if leading := _may_vanish(_parts(relation, symbol)[0], setting):
        roots += f", for ${leading} \\ne 0$,"
    yield SolutionLine(
        roots if both else "so that",
        f"{quantity.latex()} = {text}",
        f"roots_{number}",
        "steady",
        let=let,
        given=given_of(family),
        values=_root_values(relation, symbol),
    )
    if let:
        yield SolutionLine("with", f"{name} = {inside}", context="identity", let=let)
    yield from _existence(family, number)
    yield from if_true(_fast_spin(family, quantity), family.reduced.equations)


def _direction(family: SteadyMotion) -> Iterator[SolutionLine]:
    """The sine or cosine of an angle where the relation is linear in it."""
    (relation,) = family.relations
    functions = [g for g in relation.generators if any(s.kind.varies for s in g.symbols())]
    slopes = [relation.partial(function) for function in functions]
    if (
        len(functions) != 1
        or isinstance(functions[0], Symbol)
        or functions[0] in slopes[0].generators
    ):
        return
    turned = Expr.generator(functions[0])
    value = turned - relation / slopes[0]
    yield SolutionLine(
        "which is possible where the right side does not exceed 1 in",
        f"{turned.latex()} = {fraction(value)}",
        context="steady",
        given=given_of(family),
    )


def _may_vanish(leading: Expr, setting: Setting) -> str:
    """The factor of a leading coefficient that depends on the state and may be zero."""
    terms = tuple(leading.terms())
    shared = [g for g in terms[0][0] if all(g in powers for powers, _ in terms)] if terms else []
    changing = [Expr.generator(g) for g in shared if g.varies]
    rest = leading
    for factor in changing:
        rest = rest / factor
    of_both_signs = len({number > 0 for _, number in terms}) > 1
    if rest.varies or of_both_signs:
        text, opposite = leading.latex(), (-leading).latex()
        return opposite if text.startswith("-") else text
    signs = setting.equations.assumed_positive
    return " ".join(factor.latex() for factor in changing if factor not in signs)


def _existence(family: SteadyMotion, number: int) -> Iterator[SolutionLine]:
    """When the roots are real, where that can be judged."""
    conditions = [c for c in family.branches[0].exists if c.truth is Truth.OPEN]
    if len(conditions) != 1:
        return
    forms = [f.latex for f in threshold_forms(conditions[0].expression, family)]
    short = (f for f in forms if len(f) <= LONGEST and holds(f, "threshold", (), family))
    if text := next(short, ""):
        yield SolutionLine(
            "They are real and different if", text, f"existence_{number}", "threshold"
        )


def _parts(relation: Expr, symbol: Symbol) -> tuple[Expr, Expr, Expr]:
    """a, b and c of the relation a q² + 2 b q + c."""
    slope = relation.diff(symbol)
    at_zero = {symbol: ZERO}
    return slope.diff(symbol) / 2, slope.subs(at_zero) / 2, relation.subs(at_zero)


def _solved(relation: Expr, symbol: Symbol) -> tuple[str, str]:
    """The root or both roots of a relation, in the shortest of a few normalisations.

    With what stands under the square root, if there is one.
    """
    a, b, c = _parts(relation, symbol)
    if not a:
        return (-c / (2 * b)).latex(), ""
    functions = [g for g in a.generators if not isinstance(g, Symbol)]
    scales = [ONE, a, *(a / Expr.generator(g) for g in functions)]
    scales += [b / Expr.generator(g) for g in b.generators if g.symbols() and b]
    scales += [scale / 2 for scale in scales]
    signed = [scale * sign for scale in scales for sign in (ONE, -ONE)]
    forms = [(s, _both(a / s, b / s, c / s)) for s in signed]
    scale, text = min(forms, key=lambda form: len(form[1]))
    below, inside = a / scale, ((b * b - a * c) / scale**2).latex()
    top = text.removeprefix(r"\frac{").removesuffix(f"}}{{{below.latex()}}}")
    if top == text or r"\frac" not in top:
        return text, inside
    # no fraction within a fraction
    return rf"\frac{{1}}{{{below.latex()}}}\left({top}\right)", inside


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


def holds(text: str, context: str, given: tuple[str, ...], family: SteadyMotion) -> bool:
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
class ThresholdForm:
    """A condition as it may be printed.

    Attributes:
        latex: of it.
        speed: counted positive in it, if there is one.
        bound: of that speed.
    """

    latex: str
    speed: Expr | None = None
    bound: Expr | None = None


def threshold_forms(expression: Expr, family: SteadyMotion) -> Iterator[ThresholdForm]:
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
            if not bound.varies:
                for sign in "><":
                    text = f"{speed.latex()} {sign} {root_latex(bound)}"
                    yield ThresholdForm(text, speed, sqrt(bound))
    yield ThresholdForm(f"{expression.latex()} > 0")
