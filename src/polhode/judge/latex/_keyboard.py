r"""Formulas as keyboards have them, ``3*g/(2*l)``, ``θ̈ = -g/l sin θ`` or ``x'' = -g``, as LaTeX.

Where multiplication is printed, a slash divides by the one factor behind it, as in programs; where
it is not, slashes are left for the reader of LaTeX, which knows that writers differ.
"""

from __future__ import annotations

import re
import unicodedata

from polhode.judge.latex._lexicon import FUNCTIONS, GREEK
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tokens import bare_names
from polhode.judge.latex._tree import Dots
from polhode.judge.latex._writer import write_latex

#: One and two dots above a letter, as signs of their own behind it.
_DOTS = "\u0307\u0308"
_GREEK_SIGNS = "\u0370-\u03ff"
_TOKEN = re.compile(
    r"\s*(?:(?P<number>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)"
    rf"|(?P<name>(?:[A-Za-z]+|[{_GREEK_SIGNS}])[\u0307\u0308]*(?:_[A-Za-z0-9]+)*_?'*)"
    r"|(?P<power>\*\*|\^)|(?P<open>[(\[])|(?P<close>[)\]])|(?P<other>[^\s]))"
)
_NAME = re.compile(
    r"(?P<base>[^\u0307\u0308_']+)(?P<above>[\u0307\u0308]*)(?P<label>[^']*)(?P<primes>'*)"
)
_AROUND = {"sqrt": (r"\sqrt{", "}"), "abs": ("|", "|"), "": (r"\left(", r"\right)")}
_BEGINS_FACTOR = ("number", "name", "open")
_ENDS_PRODUCT = frozenset("+-=<>,;≤≥≈")
#: What keyboards and copied text have in place of the signs of a program.
_SIGNS = str.maketrans({"−": "-", "·": "*", "⋅": "*", "∙": "*", "√": "sqrt", "′": "'", "″": "''"})
#: Raised and lowered figures and letters, and fractions of one sign, as Unicode takes them apart.
_SET_APART = {"<super>": "^", "<sub>": "_"}
_LETTER = rf"(?:[A-Za-z]+|[{_GREEK_SIGNS}])(?:_[A-Za-z0-9]+)?"
_RATE = re.compile(rf"\bd(?P<second>\^2|\*\*2)?\s*(?P<of>{_LETTER})\s*/\s*d\s*t\b(?:\^2|\*\*2)?")
_PRIMED = re.compile(rf"([a-z{_GREEK_SIGNS}])'(?!')(?<!'')")
_OPERATOR = re.compile(r"\bd\s*/\s*d\s*t\b")
#: Stands for d/dt, in the middle of a formula.
_BY_TIME = "\ue000"
#: Signs that no formula in LaTeX has without a backslash or a brace.
_TYPED = re.compile(
    rf"[*{_GREEK_SIGNS}\u0307\u0308]|[a-z]''|_d?dot|_[A-Za-z0-9]_|\bd\w*\s*/\s*dt\b"
    rf"|\b(?:{'|'.join(GREEK)}|[A-Za-z])(?:d?dot|prime)(?![a-z])"
)
_FUNCTION_OF = re.compile(
    rf"({'|'.join(sorted(FUNCTIONS, key=len, reverse=True))})({'|'.join(GREEK)})(?![a-z])"
)
_DOTTED = re.compile(r"(?P<base>[A-Za-z]+?)(?P<dots>d?dot)")


def as_latex(text: str) -> str:
    r"""A formula as LaTeX if it is typed as on a keyboard, such as ``theta'' = -(g/l)*sin(theta)``.

    Text that LaTeX reads as it stands, ``E = T + V``, is left alone.
    """
    if any(mark in text for mark in "\\{}"):
        return text
    plain = _in_signs_of_programs(text)
    is_typed = bare_names(text) or _FUNCTION_OF.search(text) or _TYPED.search(plain)
    return _KeyboardFormula(plain).latex() if is_typed or plain != text else text


def keyboard_latex(text: str) -> str:
    r"""A formula of a keyboard as LaTeX; one that has a backslash is LaTeX already.

    Names stand for themselves: ``theta_ddot``, ``thetaddot``, ``theta''`` and ``d^2 theta/dt^2``
    for θ̈, ``omega_3`` for ω₃, ``mgl`` for a product.
    """
    return text if "\\" in text else _KeyboardFormula(_in_signs_of_programs(text)).latex()


def _in_signs_of_programs(text: str) -> str:
    """With ^ for what is raised, _ for what is lowered, and dots behind their letters."""
    found, before = "", ""
    for sign in text:
        kind, _, codes = unicodedata.decomposition(sign).partition(" ")
        parts = "".join(chr(int(code, 16)) for code in codes.split())
        if kind == "<fraction>":
            found += f"({parts.replace(chr(0x2044), '/')})"
        elif kind in _SET_APART:
            # ω₂ᵣ has two labels, and vₓₗ too; ω₁₀ has one.
            goes_on = kind == before and (kind == "<super>" or (found[-1] + parts).isdigit())
            found += parts if goes_on else _SET_APART[kind] + parts
        else:
            found += sign
        before = kind
    text = unicodedata.normalize("NFD", found).translate(_SIGNS)
    text = _OPERATOR.sub(_BY_TIME, text)
    if "''" in text:  # then one prime is one dot; F' is another force, and no rate, elsewhere
        text = _PRIMED.sub("\\1\u0307", text)
    return _RATE.sub(lambda m: _dotted(m["of"], 2 if m["second"] else 1), text)


def _dotted(name: str, count: int) -> str:
    base, *labels = name.split("_")
    return "_".join([base + _DOTS[count - 1], *labels])


class _KeyboardFormula:
    """Goes through one formula."""

    def __init__(self, text: str) -> None:
        self._tokens = list(_TOKEN.finditer(text.strip()))
        self._place = 0
        self._divides_by_one = "*" in text.replace("**", "")

    def latex(self) -> str:
        """The whole formula, with brackets that close nothing where they stand."""
        found = self._sum()
        while self._place < len(self._tokens):
            found += self._take()[0]
            found += self._sum()
        return found

    def _kind(self) -> str:
        at_end = self._place >= len(self._tokens)
        return "" if at_end else self._tokens[self._place].lastgroup or ""

    def _take(self) -> re.Match[str]:
        self._place += 1
        return self._tokens[self._place - 1]

    def _sum(self) -> str:
        """What stands up to the bracket that closes, or to the end."""
        found: list[str] = []
        begins = 0  # where the product begins
        while self._kind() not in ("", "close"):
            said = self._tokens[self._place][0].strip()
            if said == "/" and self._divides_by_one and len(found) > begins:
                self._take()
                found[begins:] = [rf"\frac{{{''.join(found[begins:])}}}{{{self._factor()}}}"]
            elif self._kind() in _BEGINS_FACTOR:
                found.append(self._factor())
            else:
                self._take()
                found.append({"*": " ", _BY_TIME: r"\frac{d}{dt}"}.get(said, said))
                begins = len(found) if said in _ENDS_PRODUCT else begins
        return "".join(found)

    def _factor(self) -> str:
        """A number, a letter, a bracket or a function, with its power."""
        if self._kind() not in _BEGINS_FACTOR:
            return ""
        token = self._take()
        said = token[0].strip()
        space = token[0].removesuffix(said)
        if token.lastgroup == "open":
            return f"{space}{self._bracket('')}{self._power()}"
        if said in _AROUND and self._kind() == "open":
            self._take()
            return f"{space}{self._bracket(said)}{self._power()}"
        if said in FUNCTIONS:  # sin(x)^2 is the square of the sine
            opens = self._kind() == "open" and self._take()
            argument = self._bracket("") if opens else " "
            return rf"{space}\{FUNCTIONS[said]}{self._power()}{argument}"
        if token.lastgroup == "number":
            return f"{space}{said}{self._power()}"
        function = _FUNCTION_OF.match(said)  # sintheta
        before = rf"\{FUNCTIONS[function[1]]} " if function else ""
        name = said[len(function[1]) :] if function else said
        return f"{space}{before}{_named(name + self._figures(name))}{self._power()}"

    def _figures(self, name: str) -> str:
        """The label of a letter that stands right behind it: I2, theta0."""
        base = name.partition("_")[0]
        if self._kind() != "number" or "_" in name or not (base in GREEK or len(base) == 1):
            return ""
        follows = self._tokens[self._place][0]
        return f"_{self._take()[0]}" if follows.isdigit() else ""

    def _bracket(self, function: str) -> str:
        """What stands in a bracket that has been opened; one that is not closed stays so."""
        opening, closing = _AROUND[function]
        inner = self._sum()
        if self._kind() != "close":
            return f"{opening}{inner}"
        self._take()
        return f"{opening}{inner}{closing}"

    def _power(self) -> str:
        if self._kind() != "power":
            return ""
        self._take()
        minus = ""
        if self._kind() == "other" and self._tokens[self._place][0].strip() == "-":
            minus = self._take()[0]
        if self._kind() == "open":
            self._take()
            inner = self._sum()
            if self._kind() == "close":
                self._take()
                return f"^{{{minus}{inner}}}"
            return f"^{{{minus}({inner}}}"
        return f"^{{{minus}{self._factor()}}}"


def _named(name: str) -> str:
    """A name as LaTeX: a letter with its label and dots, or a product of letters as it stands."""
    found = _NAME.fullmatch(name)
    if found is None:
        return name
    base = found["base"]
    is_function = base.isascii() and base.isupper()  # V'' is a derivative by its argument
    count = 0 if is_function else len(found["primes"]) // 2 * 2
    primes = found["primes"][count:]
    count += sum(1 + _DOTS.index(mark) for mark in found["above"])
    if not base.isascii():
        called = unicodedata.name(base)  # GREEK SMALL LETTER THETA, or GREEK THETA SYMBOL
        letter = called.removesuffix(" SYMBOL").split()[-1].lower()
        base = letter.capitalize() if "CAPITAL" in called else letter
    dotted = _DOTTED.fullmatch(base)
    if dotted is not None and (dotted["base"] in GREEK or len(dotted["base"]) == 1):
        base, count = dotted["base"], count + len(dotted["dots"]) - 2
    stem = base.removesuffix("prime")
    is_letter = stem in GREEK or len(stem) == 1
    if not is_letter or not (stem != base or stem in GREEK or found["label"] or count):
        return name
    node = name_of(f"{base}{'prime' * len(primes)}{found['label']}")
    return f"{write_latex(Dots(node, count) if count else node)} "
