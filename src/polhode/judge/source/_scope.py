r"""Whether a formula speaks of the mechanics of rigid bodies, decided by what is printed.

Two things are looked at, and never whether the formula can be read: the signs in it that belong to
another subject, such as a transfer function :math:`G(s)` or a bending stiffness :math:`EI`; and the
headings above it, of which the innermost that names a subject counts. What shows no sign of
another subject is taken for mechanics.
"""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Subject:
    """Something that texts about mechanics also write about.

    Args:
        name: what it is, in words.
        signs: what shows it in a formula.
        headings: what shows it in a heading.
    """

    name: str
    signs: re.Pattern[str]
    headings: re.Pattern[str]


def _subject(name: str, signs: str, headings: str) -> Subject:
    return Subject(
        name, re.compile(signs or r"(?!)", re.X), re.compile(headings or r"(?!)", re.X | re.I)
    )


_OPTIONAL_FONT = r"(?:\{?\s*\\(?:mathrm|text|rm|mathbf|bm|boldsymbol|textrm)\s*\{?)?\s*"
_SUBJECTS = (
    _subject(
        "software rather than a formula",
        r"""
        \\(?:texttt|mathtt|tt|codeName|verb|lstinline)(?![A-Za-z])
        | (?<![=<>\\])==(?!=) | [-+](?:\\[!;,:]|\s)*=(?!=) | (?<!\\)!=
        | (?<![A-Za-z\\])[A-Za-z]{4,}\[[0-9]\]
        | (?<![A-Za-z\\{_^])[a-z]{3,}[A-Z][a-z]{2,}
        | (?<![{0-9.])[0-9.]+e-?[0-9]
        | \\(?:mathrm|text|operatorname)\{(?:UF|atan2|floor|mod|return|True|False)\}\s*(?:_\w)?\s*\(
        """,
        r"software|implementation|source\s+code|python|user\s*function|numpy|listing|algorithm",
    ),
    _subject(
        "flexible bodies",
        rf"""
        (?<![A-Za-z\\])(?:EI|EA|GA|GJ|EJ)(?![A-Za-z])
        | \\(?:sigma|varepsilon|epsilon|gamma)_{_OPTIONAL_FONT}\{{?(?:xx|yy|zz|xy|yz|xz|zx)(?![a-z])
        | (?:ANCF|FFRF|CMS|RBE[23]|HCB)
        """,
        r"flexib|finite\s*element|super\s*element|bernoulli|timoshenko|cosserat|ANCF|FFRF|CMS"
        r"|beam\s+(?:theory|element)|(?:Node|Object|Marker)\w*(?:Beam|Cable|Plate|Slope)|eigenmode"
        r"|craig|bampton|RBE[23]|mode\s+synthesis|order\s+reduction|stress|(?<!con)strain|deformab",
    ),
    _subject(
        "control",
        rf"""
        [A-Za-z}}\])]\s*\(\s*s\s*\)
        | \(\s*s\s*[-+]\s*[0-9.]+\s*\)
        | (?<![A-Za-z\\])s\s*{_OPTIONAL_FONT}(?:I|E)\}}*(?:_[0-9])?\s*-\s*
        | (?<![A-Za-z\\])[Kk]\}}*_{_OPTIONAL_FONT}\{{?[pdiPDI]\}}*\s*
          (?:\(|e(?![A-Za-z])|\\dot\{{?e|\\int|\\(?:tilde|Delta|delta|bm|boldsymbol|mathbf)\b)
        | (?<![A-Za-z\\])u\s*(?:\(t\))?\s*=\s*-\s*K
        | _{_OPTIONAL_FONT}\{{?(?:cmd|ref,cmd|desired|des|setpoint|ctrl|control)\}}
        | \\operatorname\{{adj\}}
        """,
        r"control(?!\s+(?:volume|moment))|regulator|feedback|observer|kalman|filter|autopilot"
        r"|transfer\s+function|steering\s+law|attitude[-\s]management|stabili[sz]ation\s+loop",
    ),
    _subject(
        "statistics of measurements",
        rf"""
        \\pm\s*\\?(?:left)?\(?\s*\\sigma
        | \\pm\s*\\left\(\s*\\frac\{{\\sigma
        | \\sigma_{_OPTIONAL_FONT}[^=+]*\^\s*\{{?\s*2[^=]*=[^=]*\\sigma_[^=+]*\^\s*\{{?\s*2
        | \\frac\{{1\}}\{{N\s*-\s*[0-9]\}}
        | (?<![A-Za-z\\])s_\{{?[a-z]\w?\}}?\^2\s*[=(+]
        | \\sigma_y\^2
        """,
        r"statistic|uncertaint|regression|curve\s+fit|error\s+analysis|identification|R\^?2",
    ),
    _subject(
        "numerical integration or iteration",
        r"""
        _\{?[a-z]\s*[+-]\s*1\}?.*=.*\bh\b
        | (?<![A-Za-z\\])\w_\{?n\s*\+\s*1\}?\s*=
        | \\Delta\s*t_\{?n | O\(h\^ | \\mathrm\{(?:PNS|tol|TOL)\} | lastPNS
        """,
        r"integrator|time\s+(?:integration|stepping)|integration\s+point|newton\s+(?:iteration|method)"
        r"|solver|quadrature|post\s*newton|error\s+estimat",
    ),
    _subject(
        "fluids, heat, electricity or optics",
        r"""
        \\hbar | \\(?:epsilon|varepsilon|mu)_\{?0\}?\s*\\?(?:mathbf|vec|,)?\s*[EBH](?![A-Za-z])
        | k_\{?(?:\\mathrm)?\{?B\}*\s*T | \\nabla\s*\\times\s*\\(?:mathbf|vec)\{?[EBH]
        | \\lambda\s*=\s*\\frac\{?[hc]
        """,
        r"hydraul|pneumat|fluid|magnet|electr|optic|lens|refract|thermo|entropy|quantum|acoustic"
        r"|circuit|aerodynam",
    ),
    _subject(
        "differential forms",
        r"(?<![A-Za-z\\])d\s*[a-z](?:[_^]\{?\w\}?)*\s*\\wedge\s*d\s*[a-z]",
        r"",
    ),
    _subject(
        "a set, or a number of dimensions",
        r"""
        \A[^=]*\\(?:in|notin|subset|subseteq|ni)(?![A-Za-z])[^=]*\Z
        | (?<![A-Za-z\\])n_\{?\\?(?:mathrm|text|rm)?\{?(?:DOF|[A-Z]{2,}|[a-z]{1,3})[0-9]*\}?
          [^=]*=\s*[-+\\a-z0-9.\s{}_]*\Z
        """,
        r"",
    ),
)
_MECHANICS = re.compile(
    r"rigid|equations?\s+of\s+motion|motion\b|EOM|dynamic|kinematic|mechanic|lagrang|newton(?!\s+(?:i|m)"
    r")|euler|kane|momentum|momenta|inertia|energy|rotation|angular|torque|force|constraint|rolling"
    r"|joint|gyro|pendul|spin|precess|mass|top\b|wheel|body|bodies|friction|contact|spring",
    re.IGNORECASE,
)
_INDEX = r"[ijkn](?:_\w)?"
_RANGE = re.compile(
    rf"\s*{_INDEX}(?:\s*,\s*{_INDEX})*\s*(?:=|<|>|\\leq?|\\geq?|\\neq?)"
    rf"(?:\s|[-+<0-9,.;:]|{_INDEX}"
    r"|\\(?:[ld]?dots[cb]?|cdots|infty|quad|leq?|geq?|[,;:!]|text[a-z ]*))*\Z"
)
#: One value that counts nothing: the constant of a spring, k = 50 N/m.
_MEASURED = re.compile(rf"\s*{_INDEX}\s*=\s*(?:\d{{2,}}|\d*\.\d+)\s*\Z")
_NUMBERED = re.compile(
    r"\s*[a-z]\s*=\s*[01]\s*,(?:\s*2\s*,)?\s*\\[lc]?dots[cb]?\s*,\s*[a-zA-Z]\s*\Z"
)
_LETTER = re.compile(r"[^\W\d_]")
_BESIDE = re.compile(
    r"\\(?:label|tag|text|mbox|textrm|hspace|vspace)\s*\{[^{}]*\}|\\q?quad(?![A-Za-z])"
)
_WORD = re.compile(r"\\(?:text|mbox|textrm|mathrm)\s*\{([^{}]*)\}")
_PROSE_WORDS = 12  # words of which so many make a formula a sentence
_MACRO = re.compile(r"\\[A-Za-z]+")


def beyond(latex: str, headings: tuple[str, ...] = ()) -> str:
    """What else than mechanics of rigid bodies a formula speaks of; empty if it is mechanics.

    Args:
        latex: the formula, with the macros of its text expanded.
        headings: those above it, outermost first.
    """
    for subject in _SUBJECTS:
        if subject.signs.search(latex):
            return subject.name
    return _of_shape(latex) or _of_headings(headings)


def _of_shape(latex: str) -> str:
    bare = _BESIDE.sub(" ", latex)
    if _MEASURED.match(bare) is None and (
        _RANGE.match(re.sub(r"[{}]", "", bare)) or _NUMBERED.match(bare)
    ):
        return "the range of an index"
    if not _LETTER.search(bare):
        return "numbers without a quantity"
    words = sum(len(match[1].split()) for match in _WORD.finditer(latex))
    if words >= _PROSE_WORDS and words > len(_LETTER.findall(_MACRO.sub("", _WORD.sub("", latex)))):
        return "prose"
    return ""


def _of_headings(headings: tuple[str, ...]) -> str:
    """By the innermost heading that names a subject; one that names mechanics too is mechanics."""
    for heading in reversed(headings):
        if _MECHANICS.search(heading):
            return ""
        for subject in _SUBJECTS:
            if subject.headings.search(heading):
                return subject.name
    return ""
