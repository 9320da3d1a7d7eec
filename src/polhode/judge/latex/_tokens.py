"""LaTeX cut into tokens, in one pass from left to right.

Synonyms such as ``\\leq``, ``\\le`` and ``≤`` become the same token; spacing and type sizes are
dropped. Dollar signs separate formulas from the words around them. A macro or character that no
mechanics text would use is refused at its place.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, replace
from decimal import Decimal
from difflib import get_close_matches

from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._tree import Span
from polhode.judge.latex._units import unit_text

LONGEST = 20_000  # characters
SHOWN = 40  # of them on either side of a place

_LONGEST = 1000  # characters of a number
_WIDTH = r"-?[0-9.]+\s*(?:em|ex|cm|mm|pt|in|mu)"
_NUMBER = r"[0-9]+(?:\.[0-9]+)?|\.[0-9]+"
_PATTERN = re.compile(
    rf"""
      (?P<space>(?:\s|~|\\[,:;!>\s/-])+)
    | (?P<row>\\\\(?:\s*\[\s*-?[0-9.]+\s*[a-z]{{2}}\s*\])?|\$\$?|\\[][()])
    | (?P<number>{_NUMBER})
    | (?P<letter>[A-Za-z])
    | (?P<kern>\\(?:m?kern|[mh]skip)\s*{_WIDTH})
    | (?P<edge>\\(?:left|right)\s*(?:\.|\||\\[lr]?[vV]ert\b|\\\|))
    | (?P<macro>\\[A-Za-z]+)\*?
    | (?P<other>:=|=:|[<>]=|\.\.\.|\\[{{}}|]|.)
    """,
    re.VERBOSE | re.DOTALL,
)
_FONT = r"\\(?:text|textrm|textit|textbf|mbox|mathrm|rm|it)\s*"
_RAW = re.compile(rf"\s*\{{((?:[^{{}}\\]|\\(?!text|mbox|mathrm)|{_FONT}\{{[^{{}}]*\}})*)\}}")
_FONT_AROUND = re.compile(rf"{_FONT}\{{([^{{}}]*)\}}")
_PLAIN = re.compile(r"\s*(?:\{([\s~]*[A-Za-z][A-Za-z.~\s]*[0-9]?)\}|([A-Za-z]))")
_RUN = re.compile(r"\s*(?:\{([\s~]*[A-Za-z][A-Za-z.~\s]*)\}|([A-Za-z]+))")
_ENVIRONMENT = re.compile(r"\s*\{([A-Za-z]{1,20})\*?\}(?:\s*\[[tbc]\])?")
_OPENING = re.compile(r"\s*\{")
_BRACE = re.compile(r"\\.|[{}]", re.DOTALL)
_UNIT = re.compile(r"\s*\{((?:[^{}]|\{[^{}]{0,20}\}){1,100})\}")
_DECIMAL = (
    r"\{\s*([-+]?(?:[0-9]{1,40}(?:[.,][0-9]{0,40})?|\.[0-9]{1,40})(?:[eE][-+]?[0-9]{1,2})?)\s*\}"
)
_UNIT_TO_BRACE = re.compile(r"\s*([^{}]{1,60})(?=\})")
_FACTOR_BEHIND = re.compile(
    r"(?:\s|\\[,;:!]|~)*"
    r"(?:[A-Za-z(]|\\(?:d?dot|vec|mathbf|boldsymbol|bm|frac|sqrt|sin|cos|left|theta|phi|omega)\b)"
)
_UNIT_RAISED = re.compile(r"\s*\^\s*(?:\{\s*(-?[0-9])\s*\}|(-?[0-9]))")
_BARE_NUMBER = re.compile(rf"\s*(?:\[[^\]]*\]\s*)?{_DECIMAL}")
_OF_NUMBER = re.compile(r"\s*(?:\[[^\]]*\]\s*)?\{\s*[-+.]?[0-9][^{}]*\}\s*\{")
_MEASURED = re.compile(rf"{_BARE_NUMBER.pattern}{_UNIT.pattern}")
_EM = {"em": 1, "ex": 0.43, "cm": 2.8, "mm": 0.28, "pt": 0.1, "in": 7.2, "pc": 1.2, "mu": 1 / 18}
_WIDTH_GIVEN = re.compile(rf"(-?[0-9]*\.?[0-9]+)\s*({'|'.join(_EM)})(?![a-z])")
_DEGREES = ("\\degree", "\\circ", "\\deg", "deg", "°")
_COLUMNS = re.compile(r"\s*\{[lcrLCRp@|\s]{0,40}\}|\s*\{[0-9]{1,2}\}")
_COMMA = re.compile(r"\{,\}([0-9]+)")
_BEFORE_BRACKET = re.compile(r"[A-Za-z]\}?(?:\\left|\\[bB]igg?l?)?\(")
_BARE_WORD = re.compile(
    rf"(?:const(?:ant)?|{'|'.join(lexicon.ENERGIES)})(?![A-Za-z])|(?:{'|'.join(lexicon.NOUNS)})(?=_)"
)
_BARE_FUNCTION = re.compile(r"(?:arc)?(?:sin|cos|tan)(?![A-Za-z])")
_ENDS_IN_A = re.compile("(?<![A-Za-z])a(?:rc?)?\\Z")  # asin may be the arcsine
_ORDER = re.compile(r"\s*\[\s*([1-9])\s*\]")
_NO_OPERAND = re.compile(r"\s*\{\s*\}(?=\s*\{[^{}]*\}(?!\s*\{))")
_POWER = re.compile(r"\[([2-9])\]\s*(?=[({]|\\left)")  # of the package physics: \sin[2](x)
_EQUATION_NUMBER_BEHIND = re.compile(r"(?:[^\\$\n]|\\(?:rm|bf|it|hbox|mbox|text)\b)*")
_INDEX = re.compile(r"\s*\[\s*([0-9]{1,2}|[a-z])\s*\]")

# prose around formulas
_DOLLARS = re.compile(r"\$\$?")
_LINE_END = re.compile(r"\\n(?![a-z])")  # as a transcript spells it
_MATHEMATICS = re.compile(r"[\\^_=<>]")
_WITHOUT_BRACES = str.maketrans("{}", "  ")  # which only group words in prose
_TWO_LETTERS = re.compile(r"[A-Za-z]{2}")
_EQUATION_NUMBER = re.compile(r"\(([0-9]{1,4})\)[\s.,]*\Z")

# names without their backslash
_MACRO = re.compile(r"\\(?:text|mathrm|operatorname|label|tag)\s*\{[^{}]*\}|\\[A-Za-z]+")
_NAMES = sorted(lexicon.GREEK | lexicon.FUNCTIONS.keys() - {"tg"}, key=len, reverse=True)
_BARE = re.compile(rf"(?<![A-Za-z])({'|'.join(_NAMES)})(?![A-Za-z])")


@dataclass(frozen=True)
class Token:
    """A word of the formula.

    Args:
        kind: "number", "letter", "function", "sign" (of a relation), "mark", "words", "dots",
            "decoration", "alphabet", "fraction", "derivative", "root", "integral", "summation",
            "omitted", "brace" (under or over a quantity), "prescript", "rate" (a circle above),
            "unit", "operator" (which trees do not have), "label" (only in scripts), "begin", "end"
            (of an environment), "row", "gap", "arrow", "tag", "macro" (of `_rewriting`) or "close"
            (the end).
        text: what it is, by the name the tree uses.
        span: where it stands in the source.
    """

    kind: str
    text: str
    span: Span

    def is_mark(self, *marks: str) -> bool:
        """Whether it is one of some marks."""
        return self.kind == "mark" and self.text in marks


def tokens(source: str) -> list[Token]:
    """The tokens of a text, closed by one of kind "close".

    Raises:
        ParseError: for a text that is too long, and for characters and macros that are not known.
    """
    if len(source) > LONGEST:
        raise ParseError(
            f"LaTeX of {len(source)} characters", expected=f"at most {LONGEST} for one statement"
        )
    return _Scanner(source).all()


def refusal(source: str, span: Span, problem: str, expected: str = "") -> ParseError:
    """The error for a place in a text, with the place shown."""
    place = min(span[0], len(source))
    start = max(0, place - SHOWN)
    excerpt = source[start : place + SHOWN].replace("\n", " ").replace("\t", " ")
    excerpt = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in excerpt)
    shown = f"at character {place + 1}:\n    {excerpt}\n    {' ' * (place - start)}^"
    return ParseError(problem, expected=expected, advice=shown)


class _Scanner:
    """Goes through one source."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._place = 0
        self._found: list[Token] = []
        self._prose = _prose_of(source)

    def all(self) -> list[Token]:
        while self._place < len(self._source):
            if self._place in self._prose:
                self._found += self._words_outside()
                continue
            match = _PATTERN.match(self._source, self._place)
            assert match is not None  # the last alternative takes any character
            start, self._place = match.span()
            kind, text = match.lastgroup or "", match[match.lastgroup or 0]
            self._found += getattr(self, f"_{kind}")(text, start)
        end = len(self._source)
        return [*self._found, Token("close", "the end", (end, end))]

    def _words_outside(self) -> Iterator[Token]:
        """The words between formulas in dollar signs, and the equation number at their end."""
        start, self._place = self._place, self._prose[self._place]
        text = _LINE_END.sub(" ", self._source[start : self._place])
        prose = " ".join(text.translate(_WITHOUT_BRACES).split())
        number = _EQUATION_NUMBER.search(prose)
        words = (prose[: number.start()] if number else prose).strip(" .,;:")
        if words:
            yield _named(self._token("words", words, start))
        if number:
            yield self._token("tag", number[1], start)

    def _space(self, text: str, start: int) -> Iterator[Token]:
        strange = next(
            (c for c in text if unicodedata.category(c) == "Cc" and c not in "\t\n\r"), ""
        )
        if strange:
            raise self._strange(strange, start)
        yield from ()

    def _row(self, text: str, start: int) -> Iterator[Token]:
        yield self._token("row", text, start)

    def _number(self, text: str, start: int) -> Iterator[Token]:
        """A number; as in TeX, a macro or script takes its first digit alone: x^23 is x² 3."""
        if len(text) > _LONGEST:
            problem = f"a number of {len(text)} characters"
            raise self._refused(start, problem, f"one of at most {_LONGEST}")
        comma = _COMMA.match(self._source, self._place)
        if comma and (len(comma[1]) != 3 or text == "0") and "." not in text:
            text, self._place = f"{text}.{comma[1]}", comma.end()
        elif comma:
            problem = "a comma in a number, of a decimal or between thousands"
            raise self._refused(start, problem, "a decimal point, or none")
        digits = self._single_digits()
        if "." in text[:digits]:
            raise self._refused(start, f"{text} without braces", "a decimal number in braces")
        for offset, digit in enumerate(text[:digits]):
            yield Token("number", digit, (start + offset, start + offset + 1))
        if text[digits:]:
            yield Token("number", text[digits:], (start + digits, self._place))

    def _single_digits(self) -> int:
        """How many digits are single arguments of the token before: two for a fraction."""
        before = self._found[-1] if self._found else Token("row", "", (0, 0))
        if before.kind == "fraction":
            return 2
        return int(before.kind == "root" or before.is_mark("^", "_"))

    def _letter(self, text: str, start: int) -> Iterator[Token]:
        """A letter; "const", KE, mass_0 and sin are words though they are not set as such."""
        bare = _BARE_FUNCTION.match(self._source, start)
        if bare and not _ENDS_IN_A.search(self._source[max(0, start - 4) : start]):
            self._place = bare.end()
            yield self._token("function", lexicon.FUNCTIONS[bare[0]], start)
            return
        word = _BARE_WORD.match(self._source, start)
        if word and not self._source[start - 1 : start].isalpha():
            self._place = word.end()
            kind = "words" if word[0].startswith("const") else "letter"
            yield self._token(kind, word[0], start)
            return
        yield self._token("letter", text, start)

    def _edge(self, text: str, start: int) -> Iterator[Token]:
        kind = "null" if text.endswith(".") else "bar"
        yield self._token("mark", kind + ("(" if text.startswith(r"\left") else ")"), start)

    def _other(self, text: str, start: int) -> Iterator[Token]:
        if text in lexicon.POWER_CHARACTERS:
            yield self._token("mark", "^", start)
            yield self._token("number", lexicon.POWER_CHARACTERS[text], start)
        elif "\u2044" in (fraction := unicodedata.normalize("NFKC", text)):  # ½ and the like
            yield self._token("fraction", "frac", start)
            for number in fraction.split("\u2044"):
                yield self._token("mark", "{", start)
                yield self._token("number", number, start)
                yield self._token("mark", "}", start)
        else:
            if text == "°" and not (self._found and self._found[-1].is_mark("^", "{")):
                yield self._token("mark", "^", start)
            kind, name = _CHARACTERS.get(text, ("", ""))
            if name == "°" and not (self._found and self._found[-1].is_mark("^", "{")):
                yield self._token("mark", "^", start)
            if not kind:
                raise self._strange(text, start)
            yield self._token(kind, name, start)

    def _strange(self, character: str, start: int) -> ParseError:
        name = unicodedata.name(character, "without a name")
        problem = f"the character U+{ord(character):04X} ({name})"
        if character.isprintable():
            problem = f"{character!r}, {problem}"
        return self._refused(start, problem, "mathematics as LaTeX writes it")

    def _macro(self, text: str, start: int) -> Iterator[Token]:
        name = text[1:]
        if name in _MACROS:
            kind, value = _MACROS[name]
            if kind == "derivative":
                value += self._order_of_derivative(start)
            if kind != "silent":
                yield self._token(kind, value, start)
            power = _POWER.match(self._source, self._place) if kind == "function" else None
            if power:
                self._place = power.end()
                yield self._token("mark", "^", start)
                yield self._token("number", power[1], start)
        elif name in _SPECIAL:
            yield from getattr(self, f"_{_SPECIAL[name]}")(name, start)
        else:
            near = get_close_matches(name, [*_MACROS, *_SPECIAL], 1, 0.75) if len(name) < 30 else []
            hint = f"; \\{near[0]} is known" if near else ""
            raise self._refused(
                start, f"the macro {text[:SHOWN]}{hint}", "a macro of mechanics texts"
            )

    def _order_of_derivative(self, start: int) -> str:
        r"""The order in brackets; an empty group behind it, as in ``\dv{}{t}``, is passed over."""
        match = _ORDER.match(self._source, self._place)
        self._place = match.end() if match else self._place
        if self._source[self._place :].lstrip().startswith("["):
            raise self._refused(start, "the order of a derivative in brackets", "1 to 9, in digits")
        empty = _NO_OPERAND.match(self._source, self._place)
        self._place = empty.end() if empty else self._place
        return match[1] if match else ""

    def _measured(self, name: str, start: int) -> Iterator[Token]:
        r"""``\SI{9.81}{m/s^2}``; without a unit behind it, ``\qty`` is of the package physics."""
        match = _MEASURED.match(self._source, self._place)
        if match is None:
            if name == "SI" or _OF_NUMBER.match(self._source, self._place):
                raise self._refused(start, f"\\{name}", f"\\{name}{{number}}{{unit}}")
            yield self._token("macro", name, start)
            return
        self._place = match.end()
        yield from self._decimal(match[1], start)
        if match[2] in _DEGREES:
            yield self._token("mark", "^", start)
            yield self._token("mark", "°", start)
        else:
            yield self._unit_of(match[2], start)

    def _bare_number(self, name: str, start: int) -> Iterator[Token]:
        match = _BARE_NUMBER.match(self._source, self._place)
        if match is None:
            raise self._refused(start, f"\\{name}", f"\\{name}{{...}} with a decimal number in it")
        self._place = match.end()
        yield from self._decimal(match[1], start)
        if name == "ang":
            yield self._token("mark", "^", start)
            yield self._token("mark", "°", start)

    def _decimal(self, text: str, start: int) -> Iterator[Token]:
        """A number with its sign; a power of ten is written out."""
        number = format(Decimal(text.replace(",", ".")), "f")
        if number.startswith("-"):
            yield self._token("mark", "-", start)
        yield self._token("number", number.lstrip("-"), start)

    def _bare_unit(self, name: str, start: int) -> Iterator[Token]:
        match = _UNIT.match(self._source, self._place)
        if match is None:
            raise self._refused(start, f"\\{name}", f"\\{name}{{...}} with a unit in it")
        self._place = match.end()
        yield self._unit_of(match[1], start)

    def _unit_of(self, latex: str, start: int) -> Token:
        text = unit_text(latex)
        if not text:
            raise self._refused(start, f"the unit {latex[:SHOWN]}", "a unit such as kg m^2/s")
        return self._token("unit", text, start)

    def _unit_behind_number(self, start: int) -> Token | None:
        r"""The unit of ``9.81\,\mathrm{m/s^2}``: upright, and behind a number or another unit."""
        is_behind = self._is_behind_number()
        is_group = is_behind and _OPENING.match(self._source, self._place)
        match = (_UNIT if is_group else _UNIT_TO_BRACE).match(self._source, self._place)
        text = unit_text(match[1]) if match else ""
        if not match or not text:
            return None
        if len(text) == 1 and _FACTOR_BEHIND.match(self._source, match.end()):
            return None  # an upright letter among factors: 2 m v
        raised = _UNIT_RAISED.match(self._source, match.end()) if is_behind else None
        # Of \text{m s}^{-2}, the exponent belongs to the last unit.
        with_power = unit_text(f"{text}^{raised[1] or raised[2]}") if raised else ""
        self._place = raised.end() if raised and with_power else match.end()
        if is_behind and self._found[-1].is_mark("·"):  # N·m is one unit
            self._found.pop()
        return self._token("unit", with_power or text, start)

    def _is_behind_number(self) -> bool:
        return self._ends_with_number(self._found[-7:])

    def _ends_with_number(self, before: list[Token]) -> bool:
        is_joined = [token.kind for token in before[-2:-1]] == ["unit"] and before[-1].is_mark("·")
        if before and (is_joined or before[-1].is_mark("/")):
            before.pop()
        while before and (before[-1].is_mark("{") or before[-1].text == "pi"):
            opener = before.pop()
            if opener.is_mark("{") and before and before[-1].kind != "number":
                before = self._before_fraction(before)  # of units: 9.81 \frac{\text{m}}{\text{s}^2}
        if not before:
            return False
        if before[-1].kind == "number":
            stands_on = [token for token in before[-3:-1] if token.kind != "number"][-1:]
            is_argument = bool(stands_on) and (
                stands_on[0].is_mark("^", "_") or stands_on[0].kind in ("fraction", "root")
            )
            return not is_argument
        texts = [token.text for token in before]
        is_power_of_ten = texts[-1] == "}" and "10" in texts and texts[texts.index("10") + 1] == "^"
        return before[-1].kind == "unit" or is_power_of_ten or self._are_fraction(before)

    @staticmethod
    def _are_fraction(tokens: list[Token]) -> bool:
        r"""Whether tokens end with a fraction of numbers: ``\frac{0.5}{7}``."""
        kinds = [token.kind for token in tokens]
        inside = tokens[len(kinds) - kinds[::-1].index("fraction") :] if "fraction" in kinds else []
        are_numbers = all(t.kind == "number" or t.is_mark("{", "}") for t in inside)
        return are_numbers and bool(inside) and inside[-1].is_mark("}")

    def _before_fraction(self, before: list[Token]) -> list[Token]:
        """What stands before a fraction that has just opened, or has nothing but a unit above."""
        kinds = [token.kind for token in before]
        above = before[kinds.index("fraction") + 1 :] if "fraction" in kinds else before
        is_unit = all(token.kind == "unit" or token.is_mark("{", "}") for token in above)
        return before[: kinds.index("fraction")] if is_unit and "fraction" in kinds else []

    def _words(self, name: str, start: int) -> Iterator[Token]:
        unit = self._unit_behind_number(start)
        if unit:
            yield unit
            return
        yield self._function_or(_named(self._token("words", self._raw(name, start), start)), name)

    def _upright(self, name: str, start: int) -> Iterator[Token]:
        """Upright words or a unit; a font change around anything else is dropped."""
        if name not in lexicon.UPRIGHT_FROM_HERE or self._opens_behind_number():
            unit = self._unit_behind_number(start)
            if unit:
                yield unit
                return
        pattern = _RUN if name in lexicon.UPRIGHT_FROM_HERE else _PLAIN
        match = pattern.match(self._source, self._place)
        if match:
            self._place = match.end()
            token = _named(self._token("words", plain_words(match[1] or match[2]), start))
            yield self._function_or(token, name)
        elif name == "operatorname":
            raise self._refused(start, "\\operatorname", "the name of a function in it")

    def _function_or(self, token: Token, name: str) -> Token:
        """The token, as a function where the word is one or stands right before a bracket."""
        word = token.text
        if name == "operatorname" and word in lexicon.SHORT_FUNCTIONS:
            return replace(token, kind="function", text=lexicon.SHORT_FUNCTIONS[word])
        if token.kind != "words" or word == "diag" or word in lexicon.CONSTANTS:
            return token
        is_applied = (
            word.isalpha()
            and word not in lexicon.WORDS_OF_MACROS.values()
            and _BEFORE_BRACKET.match(self._source, self._place - 2)
        )
        is_name = word in lexicon.OPERATORS or name == "operatorname" or is_applied
        return replace(token, kind="operator") if is_name and not word.isupper() else token

    def _opens_behind_number(self) -> bool:
        """Whether a group that may hold a unit has just opened: ``5\\,{\\rm m/s}``."""
        is_open = bool(self._found) and self._found[-1].is_mark("{")
        return is_open and self._ends_with_number(self._found[-7:-1])

    def _skipped(self, name: str, start: int) -> Iterator[Token]:
        """Nothing for a macro that prints nothing, whatever it holds; a gap for wide space."""
        opening = _OPENING.match(self._source, self._place)
        depth = int(opening is not None)
        self._place = opening.end() if opening else self._place
        while depth:
            brace = _BRACE.search(self._source, self._place)
            if brace is None:
                raise self._refused(start, f"\\{name}", f"\\{name}{{...}}")
            depth += {"{": 1, "}": -1}.get(brace[0], 0)
            self._place = brace.end()
        if name == "hspace":
            yield from self._kern(self._source[start : self._place], start)

    def _kern(self, text: str, start: int) -> Iterator[Token]:
        """A gap for a space as wide as that between two formulas, of 1em or more."""
        width = _WIDTH_GIVEN.search(text)
        if width and float(width[1]) * _EM[width[2]] >= 1:
            yield self._token("gap", "gap", start)

    def _number_behind(self, name: str, start: int) -> Iterator[Token]:
        r"""The number of an equation, which ends a display: ``\eqno(1)``."""
        match = _EQUATION_NUMBER_BEHIND.match(self._source, self._place)
        number = re.sub(r"\\[a-z]+", "", match[0]) if match else ""
        self._place = match.end() if match else self._place
        yield self._token("tag", number.strip("{()} .,"), start)

    def _tag(self, name: str, start: int) -> Iterator[Token]:
        yield self._token("tag", self._raw(name, start).strip("() "), start)

    def _environment(self, name: str, start: int) -> Iterator[Token]:
        match = _ENVIRONMENT.match(self._source, self._place)
        if not match:
            raise self._refused(start, f"\\{name} without a name", f"\\{name}{{...}}")
        self._place = match.end()
        if name == "begin":
            columns = _COLUMNS.match(self._source, self._place)
            self._place = columns.end() if columns else self._place
        yield self._token(name, match[1], start)

    def _root(self, name: str, start: int) -> Iterator[Token]:
        index = _INDEX.match(self._source, self._place)
        self._place = index.end() if index else self._place
        yield self._token("root", index[1] if index else "", start)

    def _raw(self, name: str, start: int) -> str:
        match = _RAW.match(self._source, self._place)
        if not match:
            raise self._refused(start, f"\\{name}", f"\\{name}{{...}} with plain words in it")
        self._place = match.end()
        return plain_words(_FONT_AROUND.sub(r"\1", match[1]))

    def _token(self, kind: str, text: str, start: int) -> Token:
        return Token(kind, text, (start, self._place))

    def _refused(self, start: int, problem: str, expected: str) -> ParseError:
        return refusal(self._source, (start, start), problem, expected)


def plain_words(words: str) -> str:
    """Words with single spaces between them, without the signs that TeX prints as spaces."""
    return " ".join(words.replace("~", " ").replace("$", " ").split())


def is_words(text: str) -> bool:
    """Whether a text in words is not read as a letter or a function."""
    return _named(Token("words", text, (0, 0))).kind == "words"


def _named(token: Token) -> Token:
    """Words, or a letter or function in another font."""
    if token.text in lexicon.FUNCTIONS:
        return Token("function", lexicon.FUNCTIONS[token.text], token.span)
    is_letter = len(token.text) == 1 and token.text.isascii() and token.text.isalpha()
    if is_letter or token.text in lexicon.ENERGIES:
        return Token("letter", token.text, token.span)
    if token.text in lexicon.LETTER_CHARACTERS:
        return Token("letter", lexicon.LETTER_CHARACTERS[token.text], token.span)
    return token


_TABLES = {  # macros by kind of token
    "operator": {name: name for name in lexicon.OPERATORS},
    "letter": lexicon.LETTERS | lexicon.LETTER_SYNONYMS,
    "label": lexicon.LABELS,
    "words": lexicon.WORDS_OF_MACROS,
    "function": lexicon.FUNCTIONS,
    "sign": lexicon.SIGNS,
    "arrow": lexicon.ARROWS,
    "mark": lexicon.MARKS,
    "dots": {name: str(count) for name, count in lexicon.DOTS.items()},
    "decoration": lexicon.DECORATIONS,
    "alphabet": lexicon.ALPHABETS,
    "fraction": dict.fromkeys(lexicon.FRACTIONS, "frac"),
    "derivative": lexicon.DERIVATIVES,
    "integral": lexicon.INTEGRALS,
    "summation": lexicon.SUMS,
    "omitted": dict.fromkeys(lexicon.OMITTED, "omitted"),
    "brace": dict.fromkeys(lexicon.BRACES, "brace"),
    "macro": {name: name for name in lexicon.REWRITTEN},
    "gap": dict.fromkeys(lexicon.GAPS, "gap"),
    "row": dict.fromkeys(lexicon.ROWS, "row"),
    "silent": dict.fromkeys(lexicon.SILENT, ""),
}
_MACROS = {name: (kind, text) for kind, table in _TABLES.items() for name, text in table.items()}
_CHARACTERS = (
    {mark: ("mark", mark) for mark in (*"+-/^_'{}()[]|&,;.:*!?", "\\{", "\\}")}
    | {"\\|": ("mark", "|"), "...": ("omitted", "omitted"), "…": ("omitted", "omitted")}
    | {character: ("mark", mark) for character, mark in lexicon.CHARACTERS.items()}
    | {character: ("sign", sign) for character, sign in lexicon.SIGN_CHARACTERS.items()}
    | {character: ("letter", name) for character, name in lexicon.LETTER_CHARACTERS.items()}
    | {character: ("arrow", character) for character in lexicon.ARROW_CHARACTERS}
)
_SPECIAL = (
    dict.fromkeys(lexicon.WORDS, "words")
    | dict.fromkeys(lexicon.UPRIGHT | lexicon.UPRIGHT_FROM_HERE, "upright")
    | dict.fromkeys(lexicon.SILENT_WITH_ARGUMENT, "skipped")
    | {"SI": "measured", "qty": "measured", "quantity": "measured"}
    | {"num": "bare_number", "ang": "bare_number", "si": "bare_unit", "unit": "bare_unit"}
    | {"eqno": "number_behind", "leqno": "number_behind", "tag": "tag"}
    | {"sqrt": "root", "begin": "environment", "end": "environment"}
)


def _prose_of(source: str) -> dict[int, int]:
    """Where each stretch of words begins and ends.

    Text outside dollar signs is prose, unless it has mathematical signs, since transcripts lose
    dollar signs. In a source without dollar signs, all is mathematics.
    """
    # Start and end of every dollar sign: prose runs from each fourth edge to the one after it.
    edges = [0, *(place for match in _DOLLARS.finditer(source) for place in match.span())]
    outside = zip(edges[::4], [*edges[1::4], len(source)], strict=False)
    prose: dict[int, int] = {}
    for start, end in outside:
        bare = _LINE_END.sub(" ", source[start:end])
        if _TWO_LETTERS.search(bare) and not _MATHEMATICS.search(bare):
            prose[start] = end
    return prose if len(edges) > 1 else {}


def bare_names(latex: str) -> tuple[str, ...]:
    """Greek letters and functions without a backslash, which LaTeX reads letter by letter."""
    return tuple(dict.fromkeys(_BARE.findall(_MACRO.sub(" ", latex))))


def is_known(macro: str) -> bool:
    """Whether a macro, without its backslash, can be read."""
    return macro in _MACROS or macro in _SPECIAL or macro in ("left", "right")
