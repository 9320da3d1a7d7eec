"""Factors: letters with their scripts and arguments, fractions, functions and brackets."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import accumulate
from math import factorial

from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._brackets import Paired, closes, opens
from polhode.judge.latex._derivatives import Operator, derivative
from polhode.judge.latex._integrals import LONGEST_CHAIN, IntegralReader
from polhode.judge.latex._letters import seen_from
from polhode.judge.latex._names import (
    BEGIN_DIFFERENTIATED,
    LETTERS,
    ORDERS,
    ROMAN,
    follows_d,
    is_label_text,
    is_word,
    spelled,
)
from polhode.judge.latex._tokens import Token
from polhode.judge.latex._tree import (
    At,
    Call,
    ComponentList,
    Derivative,
    Differential,
    Dots,
    Evaluated,
    Magnitude,
    Name,
    Negative,
    Node,
    Number,
    Omitted,
    Order,
    PoissonBracket,
    Power,
    PrintedMatrix,
    Product,
    Quotient,
    Relation,
    Resolved,
    Root,
    UnitSymbol,
    factors_of,
    product,
)

_OPENERS = ("(", "[", "\\{", "bar(", "null(")
_ANGLES = LETTERS | {"fraction"}  # what an angle behind a number may begin with
_FACTORS = LETTERS | {"number", "function", "fraction", "derivative", "root", "integral"}
_FACTORS |= {"summation", "omitted", "brace", "prescript", "rate", "unit", "begin"}


class FactorReader(IntegralReader):
    """Reads what stands beside others in a product."""

    def __init__(self, source: str, paired: Paired) -> None:
        super().__init__(source, paired)
        self._notes: list[str] = []
        self._braced: list[Relation] = []  # what stands under braces: \\underbrace{x}_{= 0}

    @abstractmethod
    def _at_aside(self) -> bool:
        """Whether the bracket that opens here is no factor, but an aside to the relation."""

    def _starts_factor(self) -> bool:
        token = self._token
        if token.kind in _FACTORS or token.is_mark("{") or self._at_diagonal():
            return True
        if token.is_mark("|"):
            return not self._bars and not self._next.is_mark("_")
        if not token.is_mark(*_OPENERS):
            return False
        return self._around != "" or not self._at_aside()

    def _factor(self) -> Node:
        """An atom with its scripts, its argument and its bar."""
        if self._at_differential():
            return self._differential()
        is_bracket = self._at("{", "|", *_OPENERS)
        is_group = self._at("{")
        atom = self._atom()
        if isinstance(atom, Operator):
            return self._with_operand(self._in_triad(atom) if is_bracket else atom)
        if is_bracket and not (is_group and isinstance(atom, Name | Dots)):
            return self._evaluated(self._indexed(atom, self._scripts(atom)))
        scripts = self._scripts(None if isinstance(atom, Number) else atom)
        scripted = self._raised(self._labelled(atom, scripts), scripts)
        applied = self._applied(scripted)
        if isinstance(applied, At):
            applied = self._indexed(applied, self._scripts(applied))
        return self._evaluated(applied)

    def _at_differential(self) -> bool:
        if self._token.kind != "letter" or self._token.text not in lexicon.DIFFERENTIALS:
            return False
        kind, text = self._next.kind, self._next.text
        is_of_word = kind == "letter" and is_word(Name(text)) and text not in lexicon.ENERGIES
        return kind in BEGIN_DIFFERENTIATED and not is_of_word

    def _differential(self) -> Node:
        """d, Δ, δ or ∂ with the letter behind it."""
        start = self._start
        sign = lexicon.DIFFERENTIALS[self._take().text]
        with self._deeper():
            letter = self._letter() if self._token.kind in LETTERS else self._prescripted()
        if not isinstance(letter.of if isinstance(letter, Dots) else letter, Name):
            raise self._refused(letter.span, f"a {sign} before more than a letter", "one letter")
        scripts = self._scripts(letter)
        of = self._labelled(letter, scripts)
        if scripts.exponent is None:
            of = self._applied(of)
        differential = Differential(of, sign, span=self._since(start))
        if isinstance(of, At):
            return self._indexed(differential, self._scripts(of))
        return self._raised(differential, scripts)

    def _in_triad(self, operator: Operator) -> Operator:
        """An operator in brackets, with the label of the triad in which it acts: (d/dt)_rot."""
        return replace(operator, frame=self._label()) if self._took("_") else operator

    def _with_operand(self, operator: Operator) -> Node:
        """A d/dt with its operand: a bracket, otherwise all factors behind it."""
        start = operator.span[0]
        if not self._starts_factor():
            raise self._without_operand(operator)
        with self._deeper():
            of = self._factor() if self._at(*_OPENERS) else self._product()
        return operator.applied(of, self._since(start))

    def _without_operand(self, operator: Operator) -> ParseError:
        problem = "a derivative with nothing to act on"
        return self._refused(operator.span, problem, "the quantity that is differentiated")

    def _applied(self, node: Node) -> Node:
        """A letter with its argument, if a bracket with a letter or a zero follows: v(t), θ(0)."""
        if isinstance(node, Derivative) and self._at("("):
            node = self._rate_at_time(node)
        base = node.of if isinstance(node, Dots) else node
        if node in ORDERS and self._at("("):
            return Order(self._operand_in_bracket(), span=self._since(node.span[0]))
        if not isinstance(base, Name) or base.decoration == "hat" or not self._at("("):
            return node
        inside = self._tokens[self._place + 1 : self._partner[self._place]]
        if [token.kind for token in inside] == ["words"]:
            return self._with_label(node, base)
        behind = self._tokens[self._partner[self._place] + 1]
        can_be = base.letter in lexicon.ELLIPTIC and not base.subscript
        is_elliptic = can_be and _is_modulus(inside)
        if behind.is_mark("_") or not (is_elliptic or self._holds_arguments(self._place)):
            return node
        return At(node, self._arguments(), span=self._since(node.span[0]))

    def _rate_at_time(self, rate: Derivative) -> Node:
        """A rate before ``(t)`` or ``(0)`` as one with dots; other brackets are factors of it."""
        inside = self._tokens[self._place + 1 : self._partner[self._place]]
        is_time = len(inside) == 1 and inside[0].text in ("t", "0")
        is_plain = isinstance(rate.of, Name) and not (rate.partial or rate.frame)
        if not is_time or not is_plain or rate.by != Name("t"):
            return rate
        return Dots(rate.of, rate.order, span=rate.span)

    def _holds_arguments(self, opening: int) -> bool:
        """Whether a bracket holds what functions are taken at: letters, a zero, or ``t = 0``."""
        place, end = opening + 1, self._partner[opening]
        if self._tokens[place].text == "t" and self._tokens[place + 1].text == "=":
            place += 2
        while True:
            token = self._tokens[place]
            is_several = end > place + 1 or self._tokens[place - 1].is_mark(",", ";")
            if token.text == "0" or (token.kind == "omitted" and is_several):
                place += 1
            else:
                place = self._past_argument(place)
            if place == end or not self._tokens[place].is_mark(",", ";"):
                return place == end
            place += 1

    def _past_argument(self, place: int) -> int:
        """Go past a letter with its dots, labels and arguments, if one follows."""
        while self._tokens[place].kind in ("decoration", "dots") or self._tokens[place].text == "{":
            place += 1
        token = self._tokens[place]
        if token.kind != "letter" or token.text in lexicon.DIFFERENTIALS:
            return place
        place += 1
        while self._tokens[place].is_mark("}", "'", "_", "^", "("):
            token, behind = self._tokens[place : place + 2]
            label = self._tokens[place + 2] if behind.is_mark("{") else behind
            if token.is_mark("^") and not label.is_mark("*", "+", "-"):
                return place
            has_no_label = token.is_mark("_") and closes(behind)
            if has_no_label or (token.is_mark("(") and not self._holds_arguments(place)):
                return place
            place += token.is_mark("_", "^")
            place = self._partner.get(place, place) + 1
        return place

    def _arguments(self) -> Node:
        """What a function is taken at, in its bracket; of ``t = 0`` the value."""
        start = self._start
        with self._within():
            if self._next.kind == "sign":
                self._take()
                self._take()
            entries = [self._sum()]
            while self._at(",", ";"):
                self._take()
                entries.append(self._sum())
        span = self._since(start)
        return entries[0] if len(entries) == 1 else ComponentList(tuple(entries), span=span)

    def _with_label(self, node: Node, base: Name) -> Node:
        r"""With the label in brackets behind it: ``\omega_p(\text{slow})``."""
        with self._within():
            label = self._label()
        subscript = f"{base.subscript},{label}" if base.subscript else label
        span = self._since(node.span[0])
        name = replace(base, subscript=subscript, span=span)
        return replace(node, of=name, span=span) if isinstance(node, Dots) else name

    def _evaluated(self, node: Node) -> Node:
        """A quantity with the bar and label behind it, if there are any: dL/dt|_P."""
        if self._at("|") and self._next.is_mark("_") and not self._bars:
            self._take()
            self._take()
            return self._taken_at(node, node.span[0])
        return node

    def _taken_at(self, node: Node, start: int) -> Node:
        """With the label behind the bar, which may be a triad: dL/dt|_body."""
        label = self._label()
        if self._at("^"):
            raise self._refused(self._token.span, "limits behind a bar", "the difference")
        return seen_from(node, label) or Evaluated(node, label, span=self._since(start))

    # -- atoms ----------------------------------------------------------------------------------

    def _atom(self) -> Node:
        """A factor without what follows it."""
        token = self._token
        if token.kind in LETTERS:
            return self._letter()
        reader = _ATOMS.get(token.text if token.kind == "mark" else token.kind)
        if reader:
            return reader(self)
        raise self._unexpected("a quantity")

    def _argument(self) -> Node:
        """The argument of a macro, a ``^`` or a ``_``: a group or a single token."""
        if self._at("{"):
            return self._group()
        (start, end), word = self._token.span, self._token.text
        if len(word) > 1 and self._source[start:end] == word and self._token.kind in LETTERS:
            # Of mass_0 without braces, LaTeX takes the m alone.
            raise self._refused((start, end), f"{word} without braces", "braces around it")
        atom = self._atom()
        if isinstance(atom, Operator):
            raise self._without_operand(atom)
        return atom

    def _number(self) -> Node:
        """A number, or the factorial of a small one."""
        token = self._take()
        if not self._at("!"):
            return Number(token.text, span=token.span)
        if not token.text.isdecimal() or len(token.text) > 1:
            raise self._refused(token.span, "a factorial", "one of a single digit")
        self._take()
        return Number(str(factorial(int(token.text))), span=self._since(token.span[0]))

    def _word(self) -> Node:
        """A word that stands for a quantity: "constant", or capitals such as KE."""
        if self._at_diagonal():
            return self._diagonal()
        if not self._at_word():
            raise self._unexpected("a quantity")
        token = self._take()
        letter = "constant" if token.text.rstrip(".,") in lexicon.CONSTANTS else token.text
        return Name(letter, span=token.span)

    def _at_word(self) -> bool:
        is_constant = self._token.text.rstrip(".,") in lexicon.CONSTANTS
        is_named = self._token.kind == "words" and is_constant
        return is_named or self._at_capitals() or self._at_diagonal()

    def _at_diagonal(self) -> bool:
        is_named = self._token.kind == "words" and self._token.text == "diag"
        return is_named and self._next.is_mark("(", "[", "\\{")

    def _diagonal(self) -> Node:
        """A matrix given by its diagonal: diag(I_1, I_2, I_3)."""
        start = self._take().span[0]
        entries = self._bracket()
        if not isinstance(entries, ComponentList):
            raise self._refused(entries.span, "a diagonal of one entry", "two or more entries")
        if len(entries.entries) > LONGEST_CHAIN:
            problem = f"a diagonal of {len(entries.entries)} entries"
            raise self._refused(entries.span, problem, f"at most {LONGEST_CHAIN}")
        size = range(len(entries.entries))
        rows = (tuple(entries.entries[i] if i == j else Number("0") for j in size) for i in size)
        span = self._since(start)
        return PrintedMatrix(tuple(ComponentList(row) for row in rows), span=span)

    def _unit(self) -> Node:
        token = self._take()
        return UnitSymbol(token.text, span=token.span)

    def _operator(self) -> Node:
        known = ", ".join(sorted(set(lexicon.FUNCTIONS.values())))
        raise self._refused(self._token.span, f"the function {self._token.text}", f"one of {known}")

    def _dots(self) -> Node:
        return Omitted(span=self._take().span)

    def _relative_rate(self) -> Node:
        """A circle above a vector: its rate relative to the triad that turns."""
        start = self._take().span[0]
        with self._deeper():
            of = self._argument()
        return Derivative(of, Name("t"), frame="circ", span=self._since(start))

    def _prescripted(self) -> Node:
        r"""A quantity with the frame in front of it: ``{}^N\boldsymbol\omega``, ``{}^Nd``."""
        token = self._take()
        if not is_label_text(token.text):
            raise self._refused(token.span, "a formula in a label", "letters, digits and commas")
        with self._deeper():
            if self._token.kind == "letter" and self._token.text in ("d", "partial"):
                node: Node = Name(self._take().text)
            else:
                node = self._atom()
        span = self._since(token.span[0])
        if isinstance(node, Operator):
            raise self._refused(span, "a frame in front of d/dt", "the frame in front of the d")
        match node:
            case Name(prescript=""):
                return replace(node, prescript=token.text, span=span)
            case Dots(Name(prescript="") as name) | Derivative(
                Name(prescript="") as name, frame="circ"
            ):
                return replace(node, of=replace(name, prescript=token.text), span=span)
        return Resolved(node, token.text, span=span)

    def _under_brace(self) -> Node:
        """A quantity with a brace, whose label is a note, or a relation where a sign begins it."""
        start = self._take().span[0]
        with self._deeper():
            if self._at_word():
                raise self._unexpected("a formula under or over the brace")
            of = self._argument()
            if self._at("_", "^"):
                self._take()
                self._read_remark(of)
        return replace(of, span=self._since(start))

    def _read_remark(self, of: Node) -> None:
        inside = self._inside()
        if inside[0].kind == "sign" and self._at("{"):
            with self._within():
                sign = self._take().text
                self._braced.append(Relation((of, self._sum()), (sign,), span=of.span))
            return
        is_words = len(inside) == 1 and inside[0].kind == "words"
        printed = self._source[inside[0].span[0] : inside[-1].span[1]]
        self._notes.append(inside[0].text if is_words else printed)
        self._pass(inside)

    def _at_capitals(self) -> bool:
        token = self._token
        is_name = token.text.isupper() or self._next.is_mark("_")
        return token.kind == "words" and token.text.isalpha() and is_name

    def _group(self) -> Node:
        r"""What braces hold, with at most one ``\over`` in it."""
        start = self._start
        with self._within():
            above = self._sum()
            below = self._sum() if self._took("over") else None
        return above if below is None else self._over(above, below, start)

    def _fraction(self) -> Node:
        start = self._start
        self._take()
        with self._deeper():
            above = self._argument()
            below = self._argument()
        return self._over(above, below, start)

    def _over(self, above: Node, below: Node, start: int) -> Node:
        """A derivative where the fraction prints one, else a quotient."""
        span = self._since(start)
        found = derivative(above, below, span)
        last = factors_of(found)[-1] if isinstance(found, Product) else None
        if isinstance(last, Operator):
            raise self._without_operand(last)
        return found or Quotient(above, below, span=span)

    def _derivative(self) -> Node:
        r"""What the package physics writes as ``\dv{x}{t}``, or ``\dv{t}`` before a bracket."""
        token = self._take()
        is_partial = token.text.startswith("partial")
        order = int(token.text[-1]) if token.text[-1].isdigit() else 1
        with self._deeper():
            arguments = [self._argument()]
            while self._at("{") and len(arguments) < 2 + (is_partial and order == 1):
                arguments.append(self._argument())
        of = arguments.pop(0) if len(arguments) > 1 else None
        for variable in arguments:
            if not follows_d(variable.of if isinstance(variable, At) else variable):
                problem = "a derivative by more than a letter"
                raise self._refused(variable.span, problem, "one letter")
        by = tuple((variable, order) for variable in arguments)
        operator = Operator(by, is_partial, span=self._since(token.span[0]))
        return operator if of is None else operator.applied(of, operator.span)

    def _root(self) -> Node:
        token = self._take()
        kind = Number if token.text.isdigit() else Name
        index = kind(token.text, span=token.span) if token.text else None
        with self._deeper():
            of = self._argument()
        return Root(of, index, span=self._since(token.span[0]))

    def _bracket(self) -> Node:
        """One quantity, the components of a vector, cases, or a magnitude."""
        start = self._start
        opener = self._token
        with self._within() as closer:
            if opener.is_mark("\\{") and closer.is_mark("null)") and self._token.kind == "begin":
                return self._cases()
            entries = [self._fraction() if self._at_lone_fraction(closer) else self._sum()]
            has_comma = self._at(",")
            while self._at(",", ";"):
                self._take()
                entries.append(self._sum())
        span = self._since(start)
        if len(entries) == 2 and has_comma and opener.is_mark("\\{", "["):
            left, right = entries
            return PoissonBracket(left, right, opener.is_mark("["), span=span)
        if len(entries) > 1 and not any(isinstance(entry, Operator) for entry in entries):
            return ComponentList(tuple(entries), span=span)
        if opener.is_mark("bar("):
            return Magnitude(entries[0], span=span)
        factors = factors_of(entries[0])
        if opener.is_mark("[") and len(factors) == 2 and all(map(_is_vector, factors)):
            problem = "two vectors in square brackets, for their cross product or for a product"
            raise self._refused(span, problem, r"\times between them, or round brackets")
        if isinstance(entries[0], Operator):
            return self._in_triad(entries[0]) if closer.is_mark("bar)") else entries[0]
        if closer.is_mark("bar)") and self._took("_"):
            return self._taken_at(entries[0], start)
        return entries[0]

    def _operand_in_bracket(self) -> Node:
        """What a function acts on, which cannot be a d/dt."""
        found = self._bracket()
        if isinstance(found, Operator):
            raise self._without_operand(found)
        return found

    def _at_lone_fraction(self, closer: Token) -> bool:
        """Whether a fraction fills the bracket, which may then be a d/dt."""
        if self._token.kind != "fraction":
            return False
        place = self._place + 1
        for _ in range(2):
            place = self._partner.get(place, place) + 1
        return self._tokens[min(place, len(self._tokens) - 1)] is closer

    def _magnitude(self) -> Node:
        start = self._take().span[0]
        self._bars += 1
        with self._deeper():
            of = self._sum()
        if not self._took("|"):
            raise self._unexpected("|")
        self._bars -= 1
        return Magnitude(of, span=self._since(start))

    # -- functions, as texts print them: sin 2θ cos φ, cos Ωt, tanh⁻¹ x --------------------------

    def _call(self) -> Node:
        """A function with its argument: a bracket, or the angle that stands behind it."""
        start = self._start
        function = self._take().text
        exponent = self._exponent()
        if exponent == Negative(Number("1")) and function in lexicon.INVERSES:
            function, exponent = lexicon.INVERSES[function], None
        with self._deeper():
            is_bracketed = self._at("(", "[", "\\{")
            argument = self._operand_in_bracket() if is_bracketed else self._angle()
        call = Call(function, argument, span=self._since(start))
        exponent = exponent or self._exponent()
        return call if exponent is None else Power(call, exponent, span=self._since(start))

    def _exponent(self) -> Node | None:
        if not self._took("^"):
            return None
        with self._deeper():
            return self._argument()

    def _angle(self) -> Node:
        """The argument of a function without brackets: numbers and counts, then one more factor.

        So sin 2θ cos φ is a product. A time t behind a rate belongs to the angle: cos Ωt.
        """
        start = self._start
        if self._took("-"):
            with self._deeper():
                of = self._angle()
            return Negative(of, span=self._since(start))
        factors = [self._factor()]
        while _is_count(factors[-1]) and (self._token.kind in _ANGLES or self._at("(", "[")):
            factors.append(self._factor())
        if _is_rate(factors[-1]) and self._token.kind == "letter" and self._token.text == "t":
            factors.append(self._factor())
        last = factors[-1]
        is_latin = isinstance(last, Name) and last.letter in ROMAN - {"t"}
        if is_latin and self._token.text in lexicon.GREEK:
            problem = f"{spelled(last)}, which may be part of the angle or all of it"
            raise self._refused(last.span, problem, "the angle in brackets")
        return product(factors, self._since(start))


_ATOMS: dict[str, Callable[[FactorReader], Node]] = {
    "number": FactorReader._number,
    "words": FactorReader._word,
    "function": FactorReader._call,
    "fraction": FactorReader._fraction,
    "derivative": FactorReader._derivative,
    "root": FactorReader._root,
    "integral": FactorReader._integral,
    "summation": FactorReader._summation,
    "omitted": FactorReader._dots,
    "brace": FactorReader._under_brace,
    "prescript": FactorReader._prescripted,
    "rate": FactorReader._relative_rate,
    "unit": FactorReader._unit,
    "operator": FactorReader._operator,
    "begin": FactorReader._environment,
    "{": FactorReader._group,
    "|": FactorReader._magnitude,
    **dict.fromkeys(_OPENERS, FactorReader._bracket),
}


def _is_count(node: Node) -> bool:
    """Whether a factor is a multiple that stands before an angle: 2θ, nθ, πt/T."""
    return isinstance(node, Number) or (isinstance(node, Name) and node.letter in lexicon.COUNTS)


def _is_rate(node: Node) -> bool:
    """Whether a time t behind this factor makes an angle with it."""
    if isinstance(node, Name):
        return node.letter in lexicon.RATES or (len(node.letter) == 1 and node.letter != "t")
    return isinstance(node, Dots)


def _is_modulus(inside: Sequence[Token]) -> bool:
    """Whether a bracket ends with a lone sine or root, as in K(sin(θ₀/2)) or F(φ, sin α)."""
    last = inside[
        max((i for i, t in enumerate(inside) if t.is_mark(",", ";", "|")), default=-1) + 1 :
    ]
    depths = accumulate((opens(token) - closes(token) for token in last), initial=0)
    is_sum = any(t.is_mark("+", "-") and not d for t, d in zip(last, depths, strict=False))
    return bool(last) and last[0].kind in ("function", "root") and not is_sum


def _is_vector(node: Node) -> bool:
    return isinstance(node, Name) and (node.is_marked_vector or node.letter.startswith("frak"))
