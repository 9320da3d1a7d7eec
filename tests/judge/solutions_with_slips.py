"""Solutions by Lagrange's method that `polhode solve` writes, with one slip carried on to the end.

SymPy works momenta and Lagrange's equations out anew from the energies as they stand on the page,
which also tells what depends on the slip. The text ends with the last line that can be carried on
in this way: polhode puts what comes after it in another form. Solutions by other methods are in
vectors, and nothing is planted in them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import islice
from random import Random

import sympy as sp

import polhode as ph
from judge.derivations import Derivation, Family, Slip, about, slips
from judge.own_solutions import equations, written
from polhode.judge import Notation

SYSTEMS = ("spinning-coin", "gyrocompass", "tennis-racquet", "gyroscope", "gyroscope/upright")
_DISPLAY = re.compile(r"(?<=\$\$\n)(.*?)( \\tag\{[0-9]+\})(?=\n\$\$)")
_LAGRANGIAN = r"\\frac\{\\partial\\mathcal L\}\{\\partial (\S+)\}"
_MOMENTUM = re.compile(rf"[Pp]_\S+ = {_LAGRANGIAN} = ")
_LAW = re.compile(rf"\\frac\{{d\}}\{{dt\}}{_LAGRANGIAN} = ")


@cache
def _read(system: str, latex: str) -> sp.Expr:
    return ph.to_sympy(Notation.of(equations(system)).scalar(latex))


def _printed(value: sp.Expr) -> str:
    names = {}
    for symbol in value.free_symbols:
        base, _, rate = symbol.name.rpartition("_")
        if rate in ("dot", "ddot"):
            names[symbol] = rf"\{rate}{{{sp.latex(sp.Symbol(base))}}}"
        elif not rate:  # lambda_, since lambda is a word of Python
            names[symbol] = sp.latex(sp.Symbol(base))
    return sp.latex(value, symbol_names=names)


@dataclass
class WorkedOut:
    """The energies of a solution as they stand on the page, and what SymPy makes of them."""

    system: str
    energies: dict[str, sp.Expr] = field(default_factory=dict)
    law: str = ""

    def sides(self, latex: str, *, is_result: bool) -> tuple[str, sp.Expr, sp.Expr] | None:
        """The head of a display and both its sides; None for one that is left as it is."""
        if found := _MOMENTUM.match(latex):
            return found[0], sp.Integer(0), self._momentum(found[1])
        if latex.startswith(("T = ", "V = ")):
            return latex[:4], sp.Integer(0), _read(self.system, latex[4:])
        if found := _LAW.match(latex):
            self.law = found[1]
            return None
        if not (is_result and self.law):
            return None
        law, self.law = self.law, ""
        names = [q.published for q in equations(self.system).coordinates]
        momentum = self._momentum(law)
        chains = [sp.symbols(f"{name} {name}_dot {name}_ddot") for name in names]
        change = sum(momentum.diff(q) * v + momentum.diff(v) * a for q, v, a in chains)
        place = _read(self.system, law).name.removesuffix("_dot")
        return "", sp.expand(change), self._lagrangian.diff(sp.Symbol(place))

    @property
    def _lagrangian(self) -> sp.Expr:
        return self.energies["T"] - self.energies.get("V", sp.Integer(0))

    def _momentum(self, rate: str) -> sp.Expr:
        return self._lagrangian.diff(_read(self.system, rate))


def _displays(system: str, slip: Slip | None, at: int) -> list[tuple[int, str, sp.Expr]]:
    """The displays that are worked out, by number, with what they state to vanish.

    In the one with the slip, and in those that depend on it, the right side is as it then is.
    """
    text, found = written(system, ".md", "lagrange"), list[tuple[int, str, sp.Expr]]()
    work = WorkedOut(system)
    for number, display in enumerate(_DISPLAY.finditer(text)):
        is_result = text[: display.start() - 4].endswith("that is,\n")
        sides = work.sides(display[1], is_result=is_result)
        if sides is None:
            continue
        head, left, right = sides[0], sides[1], sp.expand(sides[2])
        if number == at and slip is not None:
            right = slip(right)
        if head in ("T = ", "V = "):
            work.energies[head[0]] = right
        found.append((number, (head or f"{_printed(left)} = ") + _printed(right), left - right))
    return found


def solution(seed: int, *, with_slip: bool) -> Derivation:
    """A solution drawn at random, its energies and what follows from them worked out anew."""
    random = Random(seed)
    system = random.choice(SYSTEMS)
    kind = Family(system, lambda chain, share: None, about(system))
    right = _displays(system, None, -1)
    if not with_slip:
        return Derivation(kind, sp.Integer(1), _text(system, right), None, (), ".md")
    at = random.choice([number for number, _, _ in right])
    for slip in slips(random):
        spoilt = _displays(system, slip, at)
        changed = tuple(
            number
            for (number, _, one), (_, _, other) in zip(spoilt, right, strict=True)
            if sp.simplify(one - other) != 0
        )
        if changed[:1] == (at,):
            return Derivation(kind, sp.Integer(1), _text(system, spoilt), at, changed, ".md")
    return solution(seed + 1_000_000, with_slip=True)


def _text(system: str, shown: Sequence[tuple[int, str, sp.Expr]]) -> str:
    """The solution up to the last display that is worked out, with these displays in it."""
    text = written(system, ".md", "lagrange")
    latex = {number: latex for number, latex, _ in shown}
    pieces, end = list[str](), 0
    for number, display in enumerate(islice(_DISPLAY.finditer(text), max(latex) + 1)):
        pieces += [text[end : display.start()], latex.get(number, display[1]), display[2]]
        end = display.end()
    return "".join(pieces) + "\n$$\n"
