"""What the words around a relation say that it is: a definition, an assumption, a consequence."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from itertools import pairwise

from polhode.judge.source import SourceRelation
from polhode.judge.source._scan import GOES_ON
from polhode.judge.text._smallness import (
    DEPARTURE,
    DROPS,
    FAST,
    KEPT,
    LINEAR,
    ORDERS,
    OTHERS_SMALL,
    TO_ORDER,
    small_quantities,
)
from polhode.judge.text._start_words import (
    AT_REST,
    AT_START,
    AT_ZERO,
    COUNTS_TIME,
    FROM_UPRIGHT,
    LAUNCH,
    PLACED,
)
from polhode.judge.text._state_words import StateInWords, state_in_words


class Role(Enum):
    """What a relation is for in its text."""

    CLAIM = "claim"
    CONSEQUENCE = "consequence"
    DEFINITION = "definition"
    ASSUMPTION = "assumption"
    CONDITION = "condition"
    EXCEPTION = "exception"


_PLACE = (
    r"the (?:curve|surface|line|separatrix|case)"
    r"|(?:stops?|turns?|changes?|lies|zero|vanish\w*|largest|smallest|points?|places?) where"
)
#: Words right before a formula in a sentence that make it a case.
CASE = re.compile(rf"\b(?:if|when|whenever|for|at|{_PLACE})\s*\Z", re.I)
_ROLES = (
    (
        Role.CONSEQUENCE,
        r"hence|thus|so|therefore|then|follows|gives?|giving|yields?|yielding|implies|becomes?"
        r"|(?:we|to) (?:find|get|obtain|have|see)|substitut\w+|insert\w+|from (?:\(|eq|the)|using"
        r"|finally|means that|result\w*|leads?|equals?",
    ),
    (Role.DEFINITION, r"let|denot\w+|defin\w+|call|introduc\w+|where|with|in which|abbreviat\w+"),
    (
        Role.ASSUMPTION,
        r"assum\w+|suppos\w+|choose|we take|restrict\w*|consider|neglect\w*|initially"
        r"|in (?:a|the) (?:vertical |horizontal )?plane",
    ),
    (
        Role.CONDITION,
        rf"if|when|whenever|provided(?: that)?|in case|for|at|as long as|while|{_PLACE}(?=\s*\Z)",
    ),
    (
        Role.EXCEPTION,
        r"unless|(?:except|save)(?: perhaps)?(?: (?:if|when|where|for|at))?|excluding|apart from"
        r"|(?:other|elsewhere) than(?: (?:if|when|where|for|at))?|away from",
    ),
)
_INTRODUCES = re.compile(
    r"\b(?:let|denot\w+|defin\w+|call|introduc\w+|put|set|writ\w+|abbreviat\w+)\b", re.I
)
_EQUILIBRIUM = re.compile(
    r"\bequilibri|\b(?:fixed|stationary|rest) (?:points|positions)\b|\bother fixed point\b", re.I
)
#: What joins the formulas of a list.
_JOINED = r"\s*(?:[,;]|,?\s*\b(?:and|or)\b)\s*(?:\b(?:either|at|by|with|where)\b\s*)*"
_IN_LIST = (re.compile(rf"□{_JOINED}\Z", re.I), re.compile(rf"{_JOINED}□", re.I))
#: What is an alternative to the formulas before it in a sentence is not under their condition.
_OR = re.compile(r"(?:\bor|;)(?:\s+(?:with|at|for|when|if|where|by))?\s*\Z", re.I)
_STEADY = re.compile(
    r"\bstead(?:y|ily)\b|\buniform(?:ly)? (?:precess|roll|mo)|\bregular(?:ly)? precess"
    r"|\bcircular (?:orbit|motion|path|trajector)|\bconical (?:motion|pendulum)"
    r"|\bin a (?:horizontal )?circle\b|\boscillat\w+ about\b",
    re.I,
)
_BODY_FIXED = re.compile(
    r"\b(?:body|disk|disc|coin|rotor|top|gyroscope|wheel)[- ]fixed\b"
    r"|\bfixed (?:in|to) the (?!lab|ground|earth|space)\w+\b"
    r"|\b(?:turn|rotat|spin|mov)\w* with the (?:body|disk|disc|coin|rotor|top|gyroscope|wheel)\b"
    r"|\bbody (?:axes|frame|system)\b",
    re.I,
)
#: A letter that words introduce as a length or a number of the text's own.
_NAMED = re.compile(
    r"\b(?:radius|cent(?:re|er)|distance|length|height|arm|constant|factor|ratio|number)\s+"
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,20}?)\s*(?:\$|\\\))",
    re.I,
)
#: A letter for the effective potential, for which texts use those of the potential energy too.
_EFFECTIVE = re.compile(
    r"\beffective potential(?: energy)?(?:\s+(?:is|reads|becomes|then|now|here|by|as)\b)*[\s:,]*"
    r"(?:\$\$?|\\\(|\\\[|\\begin\s*\{\w+\*?\})\s*(?P<latex>[^$=<>&(]{1,20}?)\s*"
    r"(?:\(\s*\\?\w+\s*\)\s*)?(?:&?\s*=|\$|\\\))"
    r"|(?:\$|\\\()\s*(?P<after>[^$=<>]{1,20}?)\s*(?:\$|\\\)),?\s+(?:is|be|being|denot\w+|as)\s+"
    r"(?:the |an )?effective potential",
    re.I,
)
#: A vector that words introduce by the points between which it leads.
_LEADS = re.compile(
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*(?:\$|\\\)),?\s+(?:that |which |be |is |the |a )*"
    r"(?:(?:radius |position )?vector |leads?|leading|points?|pointing|runs?|running|goes|drawn)"
    r"[^.$]{0,20}?\bfrom\b",
    re.I,
)
_STABLE = re.compile(
    r"\bfor stability\b|\b(?:stab(?:le|ly|ility)|sleeps?"
    r"|(?:stays?|remains?) (?:small|bounded)|(?:do(?:es)?|will) not grow)\b"
    r".*?\b(?:if|when|whenever|for|provided|requires?|needs?|as long as"
    r"|condition|is|means|criterion|iff|demands?|calls for|necessitates|must|should"
    r"|ha(?:s|ve) to)\b(?!.*\b(?:if|when|for)\b.*[,:])",
    re.I,
)
_UNSTABLE = re.compile(r"\bunstabl|\binstab|\bnot stable|\bmarginal|\b(?:neither|never)\b", re.I)
#: The words that make a relation the condition of instability, up to the relation.
_UNSTABLE_IF = re.compile(
    r"\b(?:unstable|not stable)\b(?:(?!\bstab)[^,:;])*?"
    r"\b(?:if|when|whenever|for|provided(?: that)?|as long as|iff)\b[^,:;]*\Z",
    re.I,
)
#: Words that choose among the meanings of a letter, each with what the phrase of one has.
_MEANT = (
    (r"\babout (?:its|the|an?|that)?\s*(?:own )?(?:cm\b|com\b|cent(?:re|er)|G\b)", r" about cm\b"),
    (
        r"\babout (?:its|the|an?|that)?\s*(?:(?:fixed|upper|lower|suspension) )?"
        r"(?:pivot|hinge|end|point|support|suspension|axle|origin|O\b)",
        r" about (?!cm\b)",
    ),
    (r"\boscillat\w+|\bfrequenc(?:y|ies)\b|\bperiod\b", r"\bof (?:small )?oscillations"),
    (
        r"\b(?:along|down|up|parallel to|perpendicular to|normal to) (?:the|this) "
        r"(?:incline|slope|ramp|inclined plane)\b",
        r"^axis \w+ of slope",
    ),
)
_INTEGRATED = re.compile(r"\bintegrat(?:ed?|es|ing|ion)\b", re.I)
_ANSWER = re.compile(r"\b(?:final )?answers?\b|\bfinal result\b|\bresult(?: is|:)", re.I)
_BOXED = re.compile(r"\\(?:boxed|fbox)(?![A-Za-z])")
_FORMULA = re.compile(
    r"\$\$.*?\$\$|\$[^$]*\$|\\\[.*?\\\]|\\\(.*?\\\)"
    r"|\\begin\s*\{(\w+\*?)\}.*?\\end\s*\{\1\}",
    re.DOTALL,
)
_STOPPED = re.compile(r"\.\s*(?:\$\$|\\\]|\\end\s*\{\w+\*?\})\Z")
_OPENER = re.compile(r"\$\$?\s*\Z|\\[\[(]\s*\Z|\\begin\s*\{\w+\*?\}")
_DISPLAY = re.compile(r"\$\$|\\\[|\\begin\s*\{")
_RELATION = re.compile(r"[=<>≈≪≫]|\\(?:approx|simeq|ll|gg|lt|gt|leq?|geq?)(?![A-Za-z])")
_NEW_SENTENCE = re.compile(r"[\s\\\]$]*(?:\\end\s*\{\w+\*?\}\s*)?[A-Z]")
#: What begins a clause that goes on to say something else: "..., so at the bottom".
_NEXT_CLAUSE = re.compile(
    r"[,;]|\b(?:so|hence|thus|then|therefore|whence|giving|gives|yielding|yields|and|but)\b", re.I
)
_SENTENCE = re.compile(r"[.!?;](?=\s|\Z)")
_LABEL = re.compile(
    r"\A[\s*_\\{}a-z]*?((?:problem|exercise|question|part|aufgabe)\s+[0-9]*\.?[0-9]*\s*"
    r"(?:\([a-z]\))?|\([a-h]\))",
    re.I,
)
#: Bold words with a full stop or colon that open a paragraph about a motion of its own.
_HEAD = re.compile(
    r"\A\s*(?:\\(?:noindent|medskip|smallskip|bigskip|par)\b\s*)*"
    r"(?:\\(?:textbf|emph|textit|underline)\s*\{(?P<tex>[^{}$]{4,60}[.:])\}"
    r"|\*\*(?P<bold>[^*$]{4,60}[.:])\*\*|\*(?P<slanted>[^*$]{4,60}[.:])\*"
    r"|\\(?:textbf|emph|textit|underline)\s*\{(?P<before>[^{}$]{4,60})\}\s*[.:])"
)
_MOMENTUM = r"(?:angular momentum|\\(?:mathbf|vec|boldsymbol|bm)\s*\{?\s*L\b)"
_ALONG_MOMENTUM = re.compile(
    r"\bz\W{0,3}[ -]?ax[ie]s\b[^.;]{0,40}\b(?:along|parallel to|direction of)\b[^.;]{0,50}?"
    rf"{_MOMENTUM}"
    rf"|{_MOMENTUM}[^.;]{{0,40}}\b(?:along|parallel to|defines|in the direction of) the \W?z\b",
    re.I,
)
#: Heads that open no part of their own.
_PLAIN_HEAD = re.compile(
    r"\b(?:solution|answer|proof|note|remark|hint|comment|given|result|conclusion)s?\b", re.I
)


@dataclass(frozen=True)
class Cues:
    """What the words around a relation say.

    Attributes:
        role: what it is for.
        is_steady: whether they speak of steady motion.
        is_launch: whether they speak of the start of a motion.
        is_at_start: whether they speak of the very instant at which a motion starts.
        is_body_fixed: whether they speak of axes fixed in a body.
        drops_terms: whether they leave terms out that they name.
        is_fast: whether they speak of fast spin, without saying in symbols what is large.
        named: letters, as LaTeX, that the paragraph introduces in words alone.
        small: quantities called small before the next relation, as LaTeX, with the order that is
            kept, or None.
        small_here: the same, without what is said in the sentences behind it.
        is_from_upright: whether the paragraph says that a body falls from rest when upright.
        small_in_sentence: the same, of its own sentence alone.
        are_others_small: whether they call "the other two" components small.
        kept: quantities that a condition of the sentence keeps constant, as LaTeX.
        order: to which small quantities are kept, or None.
        departs: whether they speak of a small departure.
        integrates: whether the paragraph speaks of an integration.
        counts_time: whether they say from which instant time is counted.
        is_at_rest: whether they say that something is at rest, or starts so.
        is_of_stability: whether they make it the condition of stability: "is stable if".
        is_of_instability: whether they make it the condition of instability: "is unstable if".
        is_linear: whether they speak of small motions.
        is_one_of_several: whether it gives one of several equilibria.
        is_of_equilibrium: whether they speak of equilibrium.
        effective: letters, as LaTeX, that they call the effective potential.
        state: that they name, as "at the lowest point" does; None for none.
        placed: letters, as LaTeX, for the values of coordinates at the start.
        is_placed_at_rest: whether the body starts from rest there.
        meant: patterns of the phrases for what the words say that letters mean: "about the end".
        is_final: whether it is the boxed or named final answer.
        label: of the part that begins here, such as "Problem 2 (b)"; empty if none does.
        head: bold words that open its paragraph, such as "Rolling straight."; empty for none.
        sentence: what stands before it in its sentence, formulas included; nothing for what is
            an alternative to what stands there.
        introduces: whether they give a letter a meaning, as "let" does.
        words_before: what stands before it in its sentence, without formulas.
        two_sentences: the same with the sentence before it, whatever stands there.
    """

    role: Role
    is_steady: bool = False
    is_launch: bool = False
    is_body_fixed: bool = False
    drops_terms: bool = False
    small: tuple[tuple[str, int | None], ...] = ()
    is_final: bool = False
    label: str = ""
    sentence: str = ""
    introduces: bool = False
    words_before: str = ""
    two_sentences: str = ""
    small_here: tuple[tuple[str, int | None], ...] = ()
    order: int | None = None
    is_fast: bool = False
    named: tuple[str, ...] = ()
    departs: bool = False
    integrates: bool = False
    counts_time: bool = False
    is_at_rest: bool = False
    is_of_stability: bool = False
    is_of_instability: bool = False
    is_linear: bool = False
    is_one_of_several: bool = False
    state: StateInWords | None = None
    placed: tuple[str, ...] = ()
    meant: tuple[str, ...] = ()
    is_of_equilibrium: bool = False
    effective: tuple[str, ...] = ()
    is_at_start: bool = False
    is_placed_at_rest: bool = False
    small_in_sentence: tuple[tuple[str, int | None], ...] = ()
    is_from_upright: bool = False
    are_others_small: bool = False
    head: str = ""
    kept: tuple[str, ...] = ()


def cues(relation: SourceRelation, is_one_of_formula: bool = False) -> Cues:
    """What the words around a relation, and the headings above it, say.

    Args:
        relation: as read, with the words before its formula.
        is_one_of_formula: whether its formula has further relations.
    """
    sentence, printed = _sentence(relation.before), _SENTENCE.split(relation.before)[-1]
    # A display ends what is said of a formula before it, even without a full stop.
    after = _DISPLAY.split(_SENTENCE.split(relation.after, maxsplit=1)[0], maxsplit=1)[0]
    if relation.is_display and _NEW_SENTENCE.match(after):
        after = ""
    behind = _words(after)
    heading = " ".join(relation.headings[-1:])
    near = f"{sentence} {behind}"
    around = f"{_said_before(relation.before)} {near} {heading}"
    is_listed = is_one_of_formula or bool(_IN_LIST[0].search(sentence) or _IN_LIST[1].match(behind))
    label = _LABEL.match(_words(relation.before))
    head = _head(relation.before)
    placed = [*PLACED.finditer(f"{relation.before} {after}")]
    return Cues(
        role=Role.CONDITION if relation.is_condition else _role(sentence),
        is_steady=bool(_STEADY.search(around)),
        is_launch=bool(LAUNCH.search(near) or AT_ZERO.search(printed)),
        is_body_fixed=bool(_BODY_FIXED.search(f"{_words(relation.before)} {behind} {heading}")),
        drops_terms=bool(DROPS.search(near)),
        small=small_quantities(
            f"{relation.before} {max(after, _before_next(relation.after), key=len)}", relation
        ),
        is_final=bool(
            _BOXED.search(f"{relation.before[-12:]} {relation.latex}") or _ANSWER.search(sentence)
        ),
        label=" ".join(label[1].split()) if label else "",
        sentence="" if _OR.search(sentence) else printed,
        introduces=bool(_INTRODUCES.search(sentence)),
        words_before=sentence,
        two_sentences=". ".join(_SENTENCE.split(relation.before)[-2:]),
        small_here=small_quantities(f"{relation.before} {after}", relation),
        order=next((ORDERS[m["order"].lower()] for m in TO_ORDER.finditer(near)), None),
        is_fast=bool(FAST.search(near)),
        named=tuple(map(relation.spelled_out, _named(relation.before, after))),
        departs=bool(DEPARTURE.search(near)),
        integrates=bool(_INTEGRATED.search(_words(relation.before))),
        counts_time=bool(COUNTS_TIME.search(sentence)),
        is_at_rest=bool(AT_REST.search(near)),
        is_of_stability=_STABLE.search(sentence) is not None and not _UNSTABLE.search(near),
        is_of_instability=_UNSTABLE_IF.search(sentence) is not None,
        is_linear=bool(LINEAR.search(near)),
        is_one_of_several=re.search(r"\beither\b", sentence, re.I) is not None
        or (
            bool(_EQUILIBRIUM.search(near))
            and (is_listed or re.search(r"\bor\b", near) is not None)
        ),
        state=state_in_words(
            f"{sentence.replace(head, '') if head else sentence} "
            f"{_NEXT_CLAUSE.split(behind, maxsplit=1)[0]}"
        ),
        placed=tuple(relation.spelled_out(m["latex"]) for m in placed),
        meant=_meant(sentence) or _meant(behind) or _meant(f"{heading} {_words(relation.before)}"),
        is_of_equilibrium=bool(_EQUILIBRIUM.search(around)),
        effective=tuple(
            relation.spelled_out(m["latex"] or m["after"])
            for m in _EFFECTIVE.finditer(f"{relation.before} {relation.latex} {after}")
        ),
        is_at_start=bool(AT_START.search(near)),
        is_placed_at_rest=any(AT_REST.search(m[0]) for m in placed),
        small_in_sentence=small_quantities(f"{printed} {after}", relation),
        is_from_upright=bool(FROM_UPRIGHT.search(_words(relation.before))),
        are_others_small=bool(OTHERS_SMALL.search(near)),
        head=head,
        kept=tuple(
            relation.spelled_out(m["latex"] or m["after"])
            for m in KEPT.finditer(f"{printed} {after}")
        ),
    )


def _head(before: str) -> str:
    """The bold words that open a paragraph, and with them a part; empty for others."""
    found = _HEAD.match(before)
    words = next(filter(None, found.groups()), "") if found is not None else ""
    return "" if _PLAIN_HEAD.search(words) or _LABEL.match(before) else words.strip()


def takes_axis_along_momentum(text: str) -> bool:
    """Whether a text takes the z axis along the angular momentum, as for free bodies."""
    return _ALONG_MOMENTUM.search(text) is not None


def _before_next(text: str) -> str:
    """What stands before the next display or relation: "with small η" is said of the one behind."""
    return _RELATION.split(_DISPLAY.split(text, maxsplit=1)[0], maxsplit=1)[0]


def with_cues(relations: Iterable[SourceRelation]) -> Iterator[tuple[SourceRelation, Cues]]:
    """Relations with what is said of them; all of a formula have the words before the formula.

    In "For small angles \\[ a = b, \\quad c = d \\]" both are meant.
    """
    words, opener = "", ""
    for relation, behind in pairwise([*relations, None]):
        assert relation is not None
        before = relation.before
        is_later = False
        if opens := [*_OPENER.finditer(before)]:
            words, opener = before[: opens[-1].start()], before[opens[-1].start() :]
        elif opener:
            is_later = True
            words = f"{words} □ {before}"
            relation = replace(relation, before=f"{words} {opener}")
        goes_on = behind is not None and bool(opener) and not _OPENER.search(behind.before)
        yield relation, cues(relation, is_later or goes_on)


def _named(before: str, after: str) -> Iterator[str]:
    """Letters, as LaTeX, that the paragraph before, or the sentence, introduces in words alone."""
    yield from dict.fromkeys(m["latex"] for m in _NAMED.finditer(before))
    yield from dict.fromkeys(m["latex"] for m in _LEADS.finditer(f"{before} {after}"))


def _meant(words: str) -> tuple[str, ...]:
    """Patterns for what words say that letters mean, that of the last words last."""
    found = [(m.end(), phrase) for said, phrase in _MEANT for m in re.finditer(said, words, re.I)]
    return tuple(phrase for _, phrase in sorted(found))


def _words(text: str) -> str:
    """A text with a box for each formula, and without the sign that opens the last one.

    The full stop at the end of a display ends the sentence.
    """
    boxed = _FORMULA.sub(lambda found: " □. " if _STOPPED.search(found[0]) else " □ ", text)
    return _OPENER.sub(" ", boxed)


def _sentence(before: str) -> str:
    """The words of the sentence that a relation stands in, before it."""
    return _SENTENCE.split(_words(before))[-1]


def _said_before(before: str) -> str:
    """The sentence before, where the relation's own goes on from it: "Then the equations ..."."""
    sentences = _SENTENCE.split(_words(before))
    return sentences[-2] if len(sentences) > 1 and GOES_ON.match(sentences[-1]) else ""


def _role(sentence: str) -> Role:
    """By the last words before the relation that say what it is: "except where", not "where"."""
    found = [
        (match.end(), -match.start(), role)
        for role, words in _ROLES
        for match in re.finditer(rf"\b(?:{words})(?:\b|(?<=\())", sentence, re.I)
    ]
    for end, _, role in sorted(found, key=lambda one: one[:2], reverse=True):
        # In "for a disk, I = ..." the comma ends what the word governs.
        if "," not in sentence[end:] or role in (Role.CONSEQUENCE, Role.ASSUMPTION):
            return role
    return Role.CLAIM
