r"""The mutation test at the level of the text: true lines of every context get a slip.

What made the slip, and what decides whether the line is still true, share nothing with the judging
or with the search for corrections. To list what is missed, or put right otherwise:

    cd tests && python -m claims.text_mutation --context limit --most 5 --show missed unlike
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from random import Random
from zlib import crc32

import numpy as np

import polhode as ph
from judge.judged import Tell, before_correction, uncorrected
from judge.mutation import Original, document
from judge.oracle import JUDGED
from judge.test_false_passes import equations
from judge.text_claims import OwnClaim, Truth, own_claims
from judge.text_evaluator import Array, Formula, UnknownTextError
from judge.text_mutants import TextMutant, text_mutants
from judge.text_problem_set import spelled, truth_of
from polhode.base import PolhodeError, within
from polhode.judge import Answer, Verdict
from polhode.judge._check import judged_claim

CONTEXTS = ("identity", "motion", "steady", "threshold", "limit", "launch", "number")
_SECONDS = 20.0  # for one verdict with its correction
_POINTS = 24


@dataclass(frozen=True)
class Line:
    """A true line with what judges it and what decides whether a mutant is true.

    Attributes:
        name: where it stands.
        context: where it holds.
        latex: as printed.
        letters: further letters of the same text.
        judged: the verdict on a text.
        is_true: whether a text is true; None where that is not decided.
        is_original: whether a text says the same as the line.
    """

    name: str
    context: str
    latex: str
    judged: Callable[[str], Verdict]
    is_true: Callable[[str], bool | None]
    is_original: Callable[[str], bool]
    letters: tuple[str, ...] = ()

    def mutants(self, most: int, seed: int) -> list[TextMutant]:
        """Up to so many, of as many kinds as there are."""
        random = Random(f"{seed} {self.name}")
        kinds: dict[str, list[TextMutant]] = {}
        for mutant in text_mutants(self.latex, self.letters):
            kinds.setdefault(mutant.slip, []).append(mutant)
        groups = list(kinds.values())
        for group in groups:
            random.shuffle(group)
        random.shuffle(groups)
        rounds = max(map(len, groups), default=0)
        return [group[i] for i in range(rounds) for group in groups if i < len(group)][:most]


# -- lines of our own -----------------------------------------------------------------------------


def own_lines(corrected: bool = True) -> Iterator[Line]:
    """Lines of our own; without corrections, much faster, for the verdicts alone."""
    for claim in own_claims():
        yield Line(
            f"{claim.system}: {claim.latex}",
            claim.context,
            claim.latex,
            partial(_checked if corrected else _judged, claim),
            partial(_true_by_numbers, claim),
            partial(says_the_same, claim.latex),
        )


def _checked(claim: OwnClaim, latex: str) -> Verdict:
    options = {name: tuple(said) for name, said in claim.options.items()}
    model = equations(claim.system)
    try:
        return ph.check(latex, model, context=claim.context, seconds=_SECONDS, **options)
    except PolhodeError as error:
        return Verdict.unread(claim.context, error)


def _judged(claim: OwnClaim, latex: str) -> Verdict:
    options = {name: tuple(said) for name, said in claim.options.items()}
    try:
        return uncorrected(latex, equations(claim.system), context=claim.context, **options)
    except PolhodeError as error:
        return Verdict.unread(claim.context, error)


def _true_by_numbers(claim: OwnClaim, latex: str) -> bool | None:
    return claim.truth.is_true(Formula(latex))


class _AnyLetter(dict[str, Array]):
    """Positive numbers for any letter, the same for the same letter."""

    def __contains__(self, name: object) -> bool:
        return True

    def __missing__(self, name: str) -> Array:
        random = np.random.default_rng(crc32(name.encode()))
        return random.uniform(0.4, 1.3, _POINTS)


def says_the_same(one: str, other: str) -> bool:
    """Whether two texts are the same but for a number that multiplies a whole relation."""
    try:
        both = [Formula(text).sides(_AnyLetter()) for text in (one, other)]
    except UnknownTextError:
        return False
    return len(both[0]) == len(both[1]) and all(
        _proportional(a, b) for a, b in zip(*both, strict=True)
    )


def _proportional(one: tuple[Array, str, Array], other: tuple[Array, str, Array]) -> bool:
    first, second = (_oriented(sides) for sides in (one, other))
    if first[1] != second[1]:
        return False
    known = np.isfinite(first[0]) & np.isfinite(second[0]) & (np.abs(second[0]) > 1e-12)
    if not np.any(known):
        return False
    ratios = (first[0] * np.ones(_POINTS))[known] / (second[0] * np.ones(_POINTS))[known]
    constant = np.ptp(ratios) <= 1e-9 * np.max(np.abs(ratios))
    return bool(constant and (first[1] in "=≈" or ratios[0] > 0))


def _oriented(sides: tuple[Array, str, Array]) -> tuple[Array, str]:
    left, sign, right = sides
    difference = np.asarray(left - right) * np.ones(_POINTS)
    return (-difference, sign.replace("<", ">")) if "<" in sign else (difference, sign)


# -- the problem set ------------------------------------------------------------------------------


def problem_set_lines(
    contexts: Collection[str] = CONTEXTS, corrected: bool = True
) -> Iterator[Line]:
    """Claims whose truth the oracle of the problem set or the numbers of their letters can tell."""
    for claim in document().claims:
        if claim.context not in contexts:
            continue
        original = _PrintedClaim(Original.of(claim))
        truth = truth_of(claim.id, claim.formula, claim.when)
        if truth is not None:
            by_numbers = partial(_true_of_text, truth)
            if original.holds and by_numbers(claim.formula):
                yield original.line(by_numbers, corrected)
        elif claim.context in JUDGED and original.holds and original.is_true(claim.formula):
            yield original.line(original.is_true, corrected)


def _true_of_text(truth: Truth, latex: str) -> bool | None:
    return truth.is_true(Formula(spelled(latex)))


@dataclass(frozen=True)
class _PrintedClaim:
    """A claim of the document, its letters read as its part says."""

    original: Original

    def line(self, is_true: Callable[[str], bool | None], corrected: bool) -> Line:
        claim = self.original.claim
        return Line(
            claim.id,
            claim.context,
            claim.formula,
            self.judged if corrected else self.uncorrected,
            is_true,
            self.is_original,
            ("m", "M"),
        )

    @cached_property
    def holds(self) -> bool:
        known = self.original
        return bool(known.bound.members) and self._judged(known.claim.formula).holds

    @cached_property
    def oracle(self):
        return self.original.oracle()

    def judged(self, latex: str) -> Verdict:
        try:
            return within(_SECONDS, lambda _: self._judged(latex), advice="none is needed")
        except PolhodeError as error:
            return Verdict.unread(self.original.claim.context, error)

    def uncorrected(self, latex: str) -> Verdict:
        return before_correction(lambda stop: self._judged(latex, stop))

    def _judged(self, latex: str, tell: Tell = lambda verdict: None) -> Verdict:
        claim, notation = self.original.claim, self.original.notation
        return judged_claim(latex, notation.choosing, claim.context, claim.when, tell=tell)

    def is_true(self, latex: str) -> bool | None:
        from judge.mutation import _undetermined
        from polhode.judge.latex import read_latex

        powers = [re.findall(r"dt\s*\}?\^", each) for each in (latex, self.original.claim.formula)]
        if len(powers[0]) > len(powers[1]):
            return None  # the reading takes dt as 1, whatever its power
        try:
            bound = self.original.notation.read_claim(read_latex(latex), {})
            counted = [len(r.components()) for r in (bound, self.original.bound)]
        except (PolhodeError, ArithmeticError):
            return None
        true = self.oracle.is_true(bound) if counted[0] == counted[1] else None
        return None if true and _undetermined(bound) else true

    def is_original(self, latex: str) -> bool:
        from judge.mutation import _is_original

        return _is_original(self.original, latex)


# -- the count ------------------------------------------------------------------------------------


@dataclass
class Tally:
    """What became of the mutants of one context."""

    counts: Counter[str] = field(default_factory=Counter)
    lines: dict[str, list[str]] = field(default_factory=dict)

    def enter(self, what: str, line: str = "") -> None:
        self.counts[what] += 1
        if line:
            self.lines.setdefault(what, []).append(line)

    @property
    def false(self) -> int:
        return sum(self.counts[w] for w in ("fails", "ambiguous", "unread", "definition", "missed"))

    @property
    def caught(self) -> float:
        return 1 - (self.counts["missed"] + self.counts["definition"]) / max(self.false, 1)

    @property
    def repaired(self) -> float:
        return self.counts["repaired"] / max(self.counts["fails"], 1)

    def __str__(self) -> str:
        c = self.counts
        corrected = (
            f"put right {self.repaired:.2%} of those that fail"
            if c["corrected"]
            else "no corrections"
        )
        return (
            f"{c['originals']} lines, {self.false} false mutants: caught {self.caught:.2%} "
            f"({c['fails']} fail, {c['unread']} unread, {c['ambiguous']} ambiguous; {c['missed']} "
            f"pass, {c['definition']} defined); {corrected}; {c['true']} true still, of which "
            f"{c['refused']} refused; {c['undecided']} not decided, of which "
            f"{c['undecided, passed']} pass; {c['alarm']} originals refused"
        )


def tried(
    lines: Iterable[Line], most: int, seed: int, tell: Callable[[str], None] = lambda _: None
) -> dict[str, Tally]:
    """Judge up to so many mutants of every line."""
    tallies: dict[str, Tally] = {}
    for line in lines:
        tally = tallies.setdefault(line.context, Tally())
        tally.enter("originals")
        found = line.judged(line.latex)
        if (
            not (found.holds or found.answer is Answer.AMBIGUOUS)
            or line.is_true(line.latex) is False
        ):
            tally.enter("alarm", f"{line.name}: {found}")
            continue
        for mutant in line.mutants(most, seed):
            _try(line, mutant, tally)
        tell(f"{line.context:9s} {line.name[:60]}: {tally}")
    return tallies


def _try(line: Line, mutant: TextMutant, tally: Tally) -> None:
    where = f"{line.context} [{line.name}] {mutant.slip}: {mutant.latex}"
    verdict = line.judged(mutant.latex)
    answer = verdict.answer
    true = line.is_true(mutant.latex)
    if true is None and answer is not Answer.UNREAD:
        tally.enter("undecided", f"{where} -> {answer.value}")
        if verdict.holds:
            tally.enter("undecided, passed", where)
        return
    if true:
        tally.enter("true")
        if answer is Answer.FAILS:
            tally.enter("refused", f"{where} -> {verdict}")
        return
    if answer is not Answer.FAILS:
        what = "missed" if verdict.holds else answer.value
        tally.enter(what, f"{where} -> {verdict}")
        return
    tally.enter("fails")
    if verdict.correction is not None:
        tally.enter("corrected")
    corrections = [c.latex for c in (verdict.correction, *verdict.alternatives) if c is not None]
    if any(map(line.is_original, corrections)):
        tally.enter("repaired")
    else:
        tally.enter("unlike", f"{where} -> {corrections[0] if corrections else 'nothing'}")


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--context", nargs="+", choices=CONTEXTS, default=CONTEXTS)
    parser.add_argument("--most", type=int, default=4, help="mutants of one line")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--every", type=int, default=1, help="take every so-manieth line")
    parser.add_argument("--set", choices=["own", "problem-set", "both"], default="own")
    parser.add_argument(
        "--show",
        nargs="*",
        default=["missed", "alarm", "refused"],
        help="missed, definition, unread, ambiguous, unlike (not put right), refused, undecided",
    )
    parser.add_argument("--uncorrected", action="store_true", help="verdicts alone, of own lines")
    said = parser.parse_args(arguments)
    for context in said.context:
        lines = [
            *(own_lines(not said.uncorrected) if said.set != "problem-set" else ()),
            *(problem_set_lines([context], not said.uncorrected) if said.set != "own" else ()),
        ]
        chosen = [line for line in lines if line.context == context][:: said.every]
        for tally in tried(chosen, said.most, said.seed).values():
            print(f"{context:9s} {tally}", flush=True)
            for what in said.show:
                for line in tally.lines.get(what, []):
                    print(f"   {what}: {line}", flush=True)


if __name__ == "__main__":
    main()
