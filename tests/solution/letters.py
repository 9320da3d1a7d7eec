"""Letters in the formulas of a solution that nothing defines up to the end of their section."""

import re
from itertools import chain

from polhode.solution._letters import letters_in

_INLINE = re.compile(r"\$([^$]+)\$")
#: A letter that is a component of a vector: what stands before a unit vector.
_COMPONENT = re.compile(r"(?<![}\w)] )(?:= |[+-] |\\left\(|^)?([^ =+-]+)\\,\\hat")
#: The time and the base of exponentials need no introduction.
_ALWAYS = frozenset({"t", "e"})


def _defined_by(step):
    """Letters in words, alone on the left of an equation, or as a component of a vector."""
    yield from map(letters_in, _INLINE.findall(step.words))
    for part in re.split(r"\\q?quad", step.latex):
        left, equals, right = part.strip(" ,").partition(" = ")
        if equals and len(letters_in(left)) == 1:
            yield letters_in(left)
        if equals and left.startswith((r"\mathbf", r"\boldsymbol")):
            alone = map(letters_in, _COMPONENT.findall(right))
            yield from (letters for letters in alone if len(letters) == 1)
    if "letters for the components of the couples" in step.words:
        yield frozenset(x for x in letters_in(step.latex) if x.startswith(r"\tau"))


def undefined_letters(solution):
    """Letters with the formula in which each occurs first."""
    known, found = set(_ALWAYS), {}
    for steps in solution.sections.values():
        known |= set(chain.from_iterable(letters for s in steps for letters in _defined_by(s)))
        for step in steps:
            for letter in letters_in(step.latex) - known:
                found.setdefault(letter, step.latex)
    return found
