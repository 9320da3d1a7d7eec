"""What words say of the start of a motion."""

from __future__ import annotations

import re

_FROM_REST = r"\bfrom\s+(?:\(?(?:almost|nearly)\)?\s+)?rest\b"
_AT_REST_AT = r"(?<!\bat )(?<!\bfrom )\brest at\b"  # "(rest at θ = 0)"
AT_REST = re.compile(
    rf"{_FROM_REST.replace('from', '(?:at|from)')}"
    rf"|{_AT_REST_AT}"
    r"|\b(?:held|kept)\b[^.;]{0,60}\b(?:and|then) (?:is )?(?:released|let go)\b",
    re.I,
)
AT_START = re.compile(
    r"\b(?:moment|instant) of (?:its |the )?(?:release|start)|\binitially\b|\bat first\b"
    r"|\bat the (?:start|beginning|outset)\b|\b(?:starts?|begins?) to \w+ with\b"
    r"|\b(?:just|immediately|right) after (?:it is |its )?"
    r"(?:the )?(?:release|start)",
    re.I,
)
LAUNCH = re.compile(
    rf"\breleased?\b|{_FROM_REST}|{_AT_REST_AT}|\binitially\b"
    r"|\blet (?:go|fall)\b|\bdropped\b|\bprojected\b"
    r"|\b(?:starts?|starting|begins?|beginning) (?:(?:to \w+|\w+ing|out|off) )?(?:at|with)\b"
    r"|\bset (?:going|spinning|moving|in motion)\b|\b(?:thrown|launched|struck|kicked)\b"
    r"|\binitial (?:conditions?|values?|state)\b",
    re.I,
)
#: The start by the time alone, as it is printed.
AT_ZERO = re.compile(r"\bat (?:time )?(?:\$|\\\()\s*t\s*=\s*0\b", re.I)
#: The value of a coordinate at the start, by a letter alone: "released from rest at θ₁".
PLACED = re.compile(
    r"\b(?:releas\w+|let go|start\w*)\b[^.$]{0,30}\b(?:at|from)(?: an?| the)?(?: \w+)?\s*"
    r"(?:\$|\\\()\s*(?P<latex>[^$=<>]{1,20}?)\s*(?:\$|\\\))",
    re.I,
)
#: A start in words alone: "it stands upright and falls from rest".
FROM_UPRIGHT = re.compile(
    r"\bupright\b[^.;]{0,80}\bfrom (?:almost |nearly )?rest\b"
    r"|\bfrom (?:almost |nearly )?rest\b[^.;]{0,40}\bupright\b",
    re.I,
)
COUNTS_TIME = re.compile(r"\bcounted from\b|\borigin of time\b", re.I)
