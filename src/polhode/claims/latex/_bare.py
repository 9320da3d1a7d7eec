"""Names that stand in a formula without their backslash."""

from __future__ import annotations

import re

from polhode.claims.latex import _lexicon as lexicon

_MACRO = re.compile(r"\\(?:text|mathrm|operatorname|label|tag)\s*\{[^{}]*\}|\\[A-Za-z]+")
_NAMES = sorted(lexicon.GREEK | lexicon.FUNCTIONS.keys() - {"tg"}, key=len, reverse=True)
_BARE = re.compile(rf"(?<![A-Za-z])({'|'.join(_NAMES)})(?![A-Za-z])")


def bare_names(latex: str) -> tuple[str, ...]:
    """Greek letters and functions spelled out letter by letter, which is what LaTeX reads."""
    return tuple(dict.fromkeys(_BARE.findall(_MACRO.sub(" ", latex))))
