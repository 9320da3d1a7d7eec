"""What words call small, large or constant, and to which order it is kept."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.judge.source import SourceRelation

DROPS = re.compile(
    r"\b(?:drop|neglect|ignor|omit|discard)\w*\s+(?:(?:the|all|small|any|contributions?|of)\s+)*"
    r"(?:□|terms?\b|products?\b|squares?\b|quadratic|higher|second)",
    re.I,
)
#: Limits that are named without saying in symbols what is large.
FAST = re.compile(
    r"\b(?:fast|rapid(?:ly)?|quickly)[- ](?:spin\w*|rotat\w*|turning|top|gyro\w*|disk|wheel)\b"
    r"|\b(?:fast|rapid) (?:symmetric |heavy )?top\b|\bspin\w* (?:fast|rapidly|quickly)\b",
    re.I,
)
_SMALL = re.compile(
    r"\b(?:small|to (?P<order>first|second|third|lowest|leading) order in)"
    r"(?:\s+(?:angles?|values? of|oscillations?(?: of)?|tilts?|deviations?|displacements?))?"
    r"\s*(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*(?:=[^$<>]{1,40})?(?:\$|\\\))",
    re.I,
)
_IS_SMALL = re.compile(
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*(?:\$|\\\))\s+"
    r"(?:(?:(?:is|are|be|being|remains?|stays?)\s+)?(?:very\s+)?small\b(?!er)"
    r"|(?:is|are) (?:(?:its|the|two|both|a)\s+)*small (?:angle|departure|deviation|tilt)s?\b)",
    re.I,
)
#: What is said of the further components of an angular velocity.
OTHERS_SMALL = re.compile(
    r"\bthe (?:others?|remaining)(?: (?:two|ones?|components?))*\b[^.;$]{0,30}\bsmall\b(?!er)", re.I
)
_IS_LARGE = re.compile(
    r"\blarge\s*(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*(?:\$|\\\))"
    r"|(?:\$|\\\()\s*(?P<after>[^$=<>]{1,40}?)\s*(?:\$|\\\))\s+(?:is|be|being)\s+(?:very\s+)?large\b(?!r)",
    re.I,
)
#: What words keep constant in a condition: "if $\\theta$ is constant", "at constant $r$".
KEPT = re.compile(
    r"\b(?:if|when|whenever|while|provided(?: that)?|as long as|for|at|with|suppos\w+|assum\w+)\b"
    r"[^.;:,$]{0,30}?(?:"
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*(?:\$|\\\))\s+(?:\w+\s+){1,2}(?:constant|fixed)\b"
    r"|\b(?:constant|fixed)\s*(?:\$|\\\()\s*(?P<after>[^$=<>]{1,40}?)\s*(?:\$|\\\)))",
    re.I,
)
DEPARTURE = re.compile(
    r"\bsmall (?:departure|deviation|displacement|disturbance|perturbation)s?\b", re.I
)
#: Motions close to one that is steady, without saying in symbols what is small.
LINEAR = re.compile(
    r"\blineari[sz]\w+|\blinear (?:order|terms|approximation)\b|\b(?:first|lowest|leading) order\b"
    r"|\bkleine[nr]? (?:Winkel|Auslenkung|Ausschl|Schwingung|Amplitude)\w*"
    r"|\bsmall[- ](?:angles?|oscillations?|amplitudes?|displacements?|swings?|tilts?)\b"
    r"|\b(?:near|close to) (?:the |its )?(?:bottom|lowest point|equilibrium)\b",
    re.I,
)
_MUCH_LESS = re.compile(
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*"
    r"(?:\\ll\s*1|\\(?:long)?(?:to|rightarrow)\s*0)\s*(?:\$|\\\))"
)
_TO_INFINITY = re.compile(
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,40}?)\s*\\(?:long)?(?:to|rightarrow)\s*\\infty\s*(?:\$|\\\))"
)
_ALL_MUCH_LESS = re.compile(
    r"(?:\$|\\\()\s*(?P<less>[^$=<>]{1,60}?)\s*,\s*[^$,=<>]{1,40}?\s*\\ll\s*(?P<more>[^$,=<>]{1,40}?)\s*(?:\$|\\\))"
)
_BEFORE_IT = re.compile(r"(?:\$|\\\()\s*([^$=<>]{1,40}?)\s*(?:\$|\\\))\s*(?:,\s*and|,|and)\s*\Z")
_BEHIND_IT = re.compile(r"\s*(?:,\s*and|,|and)\s*(?:\$|\\\()\s*([^$=<>]{1,40}?)\s*(?:\$|\\\))")
TO_ORDER = re.compile(r"\bto (?:the )?(?P<order>first|second|third|lowest|leading) order\b", re.I)
ORDERS = {"first": 1, "second": 2, "third": 3, "lowest": 1, "leading": 1}


def small_quantities(text: str, relation: SourceRelation) -> tuple[tuple[str, int | None], ...]:
    """What a text around a relation calls small, as LaTeX with the order that is kept."""
    found = list[tuple[str, int | None]]()
    for m in _SMALL.finditer(text):
        order = ORDERS.get((m["order"] or "").lower())
        found += [(latex, order) for latex in (m["latex"], *_listed(text, m.end(), _BEHIND_IT))]
    for m in _IS_SMALL.finditer(text):
        found += [(latex, None) for latex in (m["latex"], *_listed(text, m.start(), _BEFORE_IT))]
    found += [(m["latex"], None) for m in _MUCH_LESS.finditer(text)]
    for m in _ALL_MUCH_LESS.finditer(text):
        found += [(rf"\frac{{{less}}}{{{m['more']}}}", None) for less in m["less"].split(",")]
    large = ((m["latex"] or m["after"], None) for m in _IS_LARGE.finditer(text))
    infinite = ((m["latex"], 0) for m in _TO_INFINITY.finditer(text))
    found += [(rf"\frac{{1}}{{{latex}}}", order) for latex, order in (*large, *infinite)]
    return tuple(dict.fromkeys((relation.spelled_out(latex), order) for latex, order in found))


def _listed(text: str, place: int, beside: re.Pattern[str]) -> Iterator[str]:
    """Formulas that stand in a list with the one that begins or ends at a place."""
    is_behind = beside is _BEHIND_IT
    while found := beside.match(text, place) if is_behind else beside.search(text[:place]):
        yield found[1]
        place = found.end() if is_behind else found.start()
