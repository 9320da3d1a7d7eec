"""LaTeX of a text as MathML, and what two formulas differ in marked."""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from polhode.algebra import mathml
from polhode.view._spacing import set_fractions_apart, set_functions_apart

LONGEST = 1500  # characters of LaTeX that is still typeset
_MARKS = re.compile(r"\$+|\\(?:tag|label)\*?\s*\{[^{}]*\}|\\n(?![A-Za-z])")
_NUMBER = re.compile(r"(?:\\q?quad)?\s*(?:\(\d+\)|\\text\s*\{\s*\(\d+\)\s*\})\s*$")
_NAMESPACE = "{http://www.w3.org/1998/Math/MathML}"
_LEAVES = ("mi", "mn", "mo", "mtext")


def typeset(latex: str) -> str:
    """MathML, without dollar signs and numbers; empty where it cannot be had."""
    root = _tree(latex)
    return "" if root is None else _written(root)


def typeset_change(before: str, after: str) -> tuple[str, str]:
    """Two formulas as MathML; what one has and the other has not is in the class `changed`."""
    first, second = _tree(before), _tree(after)
    if first is None or second is None:
        return typeset(before), typeset(after)
    old, new = _leaves(first), _leaves(second)
    matcher = SequenceMatcher(None, _texts(old), _texts(new), autojunk=False)
    for kind, i, j, k, n in matcher.get_opcodes():
        if kind != "equal":
            for leaf in (*old[i:j], *new[k:n]):
                leaf.set("class", "changed")
    return _written(first), _written(second)


def _tree(latex: str) -> Element | None:
    bare = _NUMBER.sub("", _MARKS.sub(" ", latex).strip()).strip()
    if not bare or len(bare) > LONGEST:
        return None
    try:
        root = ElementTree.fromstring(mathml(bare))
    except Exception:  # whatever the converter meets in LaTeX of any kind
        return None
    for element in root.iter():
        element.tag = element.tag.removeprefix(_NAMESPACE)
    set_functions_apart(root)
    set_fractions_apart(root)
    return root


def _leaves(root: Element) -> list[Element]:
    return [element for element in root.iter() if element.tag in _LEAVES]


def _texts(leaves: list[Element]) -> list[str]:
    return [leaf.text or "" for leaf in leaves]


def _written(root: Element) -> str:
    return ElementTree.tostring(root, encoding="unicode", short_empty_elements=False)
