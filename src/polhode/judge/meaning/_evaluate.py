"""Evaluation of printed formulas: a node of the tree becomes a scalar, a vector or a tensor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce, singledispatchmethod
from math import prod

from polhode.algebra import (
    ONE,
    Expr,
    Matrix,
    SquareRoot,
    Symbol,
    SymbolKind,
    Vector,
    as_symbol,
    cos,
    cosh,
    exp,
    integrate,
    pi,
    sin,
    sinh,
    tan,
    zero_vector,
)
from polhode.algebra import tanh as tanh
from polhode.base import DeclarationError, NumericError, read_unit
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex import _tree as tree
from polhode.judge.latex._names import spelled
from polhode.judge.meaning import _meaning as meanings
from polhode.judge.meaning._derived_quantities import phase_space
from polhode.judge.meaning._differentials import VARIATIONS
from polhode.judge.meaning._initial_values import INITIAL, initial_value
from polhode.judge.meaning._meaning import BindingError, Meaning, as_scalar, as_vector
from polhode.judge.meaning._mechanics import on_constraints
from polhode.judge.meaning._poisson_bracket import (
    BRACKET,
    OF_COORDINATES_FIRST,
    SIGNS,
    poisson_bracket,
)
from polhode.judge.meaning._vocabulary import (
    LAGRANGIAN,
    POTENTIALS,
    Vocabulary,
    constant,
    is_of_place,
)
from polhode.model import Frame

TIME = tree.Name("t")
#: Functions of coordinates and momenta, whatever they are written with.
HAMILTONIANS = (tree.Name("H"), tree.Name("cal H"))
ROUTHIANS = (tree.Name("R"), tree.Name("cal R"))
#: Labels of (dL/dt)_s and (dL/dt)_r: rates seen from space, and from axes that turn with the body.
_SPACE = {"s", "S", "space", "fixed", "inertial", "in", "lab", "fix", "o", "I"}
_BODY = {
    "'",
    "*",
    "r",
    "b",
    "B",
    "rot",
    "body",
    "rel",
    "rotating",
    "r.f.",
    "rotating frame",
    "moving",
}
_ZERO_VECTOR = tree.Name("0", decoration="vector")
_EULER = tree.Name("e")
_LETTERS_OF_SIGNS = {"δ": "delta", "Δ": "Delta"}

_FUNCTIONS: dict[str, Callable[[Expr], Expr]] = {
    "sin": sin,
    "cos": cos,
    "tan": tan,
    "sec": lambda x: 1 / cos(x),
    "csc": lambda x: 1 / sin(x),
    "cot": lambda x: cos(x) / sin(x),
    "sinh": sinh,
    "cosh": cosh,
    "tanh": tanh,
    "sech": lambda x: 1 / cosh(x),
    "csch": lambda x: 1 / sinh(x),
    "coth": lambda x: cosh(x) / sinh(x),
    "exp": exp,
}

#: The inverse of each inverse function: artanh x = y says x = tanh y.
FORWARD: dict[str, Callable[[Expr], Expr]] = {
    "arcsin": sin,
    "arccos": cos,
    "arctan": tan,
    "arsinh": sinh,
    "arcosh": cosh,
    "artanh": tanh,
    "ln": exp,
    "log": exp,
}


#: How dE/dθ may be taken where E varies with more than θ: as ∂E/∂θ, or as the quotient of rates.
#: How the rate of a vector may be meant beside ω × that vector: in space, or as the body sees it.
RATES = IN_SPACE, FROM_BODY = "rate in space", "rate seen from the body"
SLOPES = ALONG_MOTION, FIXED_SPEEDS = "derivative along the motion", "derivative at fixed speeds"


@dataclass(frozen=True, eq=False)
class Evaluator:
    """Gives nodes their meaning.

    Args:
        vocabulary: of the text.
        upper: whether ± is read as plus (and ∓ as minus), or the reverse.
        per_time: whether a differential such as dω stands for the rate, dt being 1.
    """

    vocabulary: Vocabulary
    upper: bool = True
    per_time: bool = False

    def value(self, node: tree.Node) -> Meaning:
        """The meaning of a node.

        Raises `BindingError` for symbols without a meaning and for kinds that cannot be combined.
        """
        key = node, self.upper, self.per_time
        known = self.vocabulary.values
        if key not in known:
            known[key] = self._computed(node)
        return known[key]

    def _computed(self, node: tree.Node) -> Meaning:
        found = self.vocabulary.find(node)
        if found is not None:
            return found
        try:
            return self._value(node)
        except ZeroDivisionError:
            raise BindingError("a division by zero", advice="check the denominator") from None
        except NumericError as error:
            raise BindingError(
                error.given, expected=error.expected, advice=error.advice, option=error.option
            ) from error

    def scalar(self, node: tree.Node) -> Expr:
        """The meaning of a node that has to be a scalar."""
        return as_scalar(self.value(node), spelled(node))

    @singledispatchmethod
    def _value(self, node: tree.Node) -> Meaning:
        return self.vocabulary.meaning(node)

    @_value.register
    def _(self, node: tree.Name) -> Meaning:
        if node == _ZERO_VECTOR:
            return zero_vector(self.vocabulary.mechanics.body.axes.root)
        column = _column(node)
        if column is not None and self._is_row(node):
            return self.vocabulary.meaning(column)
        return self.vocabulary.meaning(node)

    @_value.register
    def _(self, node: tree.Number) -> Meaning:
        return Expr.of(Fraction(node.text))

    @_value.register
    def _(self, node: tree.UnitSymbol) -> Meaning:
        unit = read_unit(node.text)
        return Expr.of(unit.coefficient) * pi**unit.pi_power

    @_value.register
    def _(self, node: tree.Words) -> Meaning:
        raise BindingError(f"the words {node.text!r}", expected="a quantity")

    @_value.register
    def _(self, node: tree.Dots) -> Meaning:
        found = self.value(node.of)
        initial = self._initially(node.of, node.count)
        if initial is not None:
            return initial
        change: Callable[[Meaning], Meaning] = meanings.rate
        if self.vocabulary.way(moving(node), RATES) == FROM_BODY:
            change = self._seen_from("body")
        return reduce(lambda value, _: change(value), range(node.count), found)

    def _initially(self, node: tree.Node, dots: int) -> Expr | None:
        """The initial rate that dots over an initial value stand for."""
        sense = self.vocabulary.sense(node)
        phrase = sense.readings[0].phrase if sense and sense.readings else ""
        if not phrase.startswith(INITIAL):
            return None
        coordinates = self.vocabulary.mechanics.declared.coordinates
        name = phrase.removeprefix(INITIAL)
        symbol = next((q for q in coordinates if q.published == name), None)
        if symbol is None:
            return None
        rate = reduce(lambda found, _: found.derivative(), range(dots), symbol)
        return Expr.generator(initial_value(rate))

    @_value.register
    def _(self, node: tree.Derivative) -> Meaning:
        found = self.value(node.of)
        if node.by == TIME:
            change: Callable[[Meaning], Meaning] = meanings.rate
            if node.frame:
                change = self._seen_from(node.frame)
            elif node.partial:
                change = self._seen_from_axes
            return reduce(lambda value, _: change(value), range(node.order), found)
        # ∂L/∂q is of the Lagrangian, though a plain L may stand for an angular momentum here.
        if node.partial and node.of == LAGRANGIAN and self._is_lagrangian(found):
            found = self.value(replace(LAGRANGIAN, letter="cal L"))
        whole = as_scalar(found, "what is differentiated")
        if node.partial and node.of in ROUTHIANS and self._is_read_as(node.of, "routhian"):
            raise BindingError(
                "a derivative of the Routhian, at fixed momenta of cyclic coordinates",
                expected="the equation of motion that it gives",
                advice="write out the derivatives",
            )
        momentum = self._conjugate(node.by) if node.partial else None
        if momentum is not None or (node.partial and node.of in HAMILTONIANS):
            return self._in_phase_space(node, whole, momentum)
        variable = as_symbol(self.scalar(node.by))
        if node.partial:
            whole = self._as_function_of(variable, whole)
        elif self._way(node.by, whole, variable) == ALONG_MOTION:
            rate = Expr.generator(variable).dt()
            return reduce(lambda value, _: value.dt() / rate, range(node.order), whole)
        return reduce(lambda value, _: value.diff(variable), range(node.order), whole)

    def _is_read_as(self, letter: tree.Node, phrase: str) -> bool:
        sense = self.vocabulary.sense(letter)
        return sense is not None and any(r.phrase.startswith(phrase) for r in sense.readings)

    def _as_function_of(self, variable: Symbol, whole: Expr) -> Expr:
        """With one set of speeds: T(ω₁, ω₂, ω₃) for ∂T/∂ω₁, T(φ̇, θ̇, ψ̇) for ∂T/∂φ̇.

        Accelerations are those of the independent speeds, as in Appell's equations.
        """
        mechanics = self.vocabulary.mechanics
        rates = {q.derivative() for q in mechanics.declared.coordinates}
        if variable.order > (0 if variable.kind is SymbolKind.SPEED else 1):
            known = mechanics.equations.acceleration_symbols
            if variable not in known:
                raise BindingError(
                    f"a derivative by {variable.published}",
                    expected=f"one by {', '.join(s.published for s in known)}",
                )
            return on_constraints(whole, mechanics.equations)
        if variable.kind is SymbolKind.SPEED and variable not in rates:
            return as_scalar(mechanics.in_speeds(whole), "what is differentiated")
        return mechanics.in_rates(whole)

    def _is_lagrangian(self, found: Meaning) -> bool:
        """Whether L under ∂ is read by habit, and so as the Lagrangian.

        So is that of a system with a length L, of which nobody takes a derivative.
        """
        sense, is_stated = self.vocabulary.sense(LAGRANGIAN), LAGRANGIAN in self.vocabulary.stated
        by_habit = sense is not None and bool(sense.readings) and not is_stated
        is_constant = isinstance(found, Expr) and not found.varies and not is_stated
        return by_habit or is_constant or isinstance(found, Vector)

    def _way(self, by: tree.Node, whole: Expr, variable: Symbol) -> str:
        """How dE/dθ is taken: a matter of choice where E varies with θ and with more."""
        varying = {s for s in whole.symbols() if s.kind.varies}
        if not varying - {variable}:
            return FIXED_SPEEDS
        # At fixed speeds dθ̇/dθ would vanish whatever the motion is: θ̇ dθ̇/dθ is θ̈.
        if variable not in varying:
            return ALONG_MOTION
        return self.vocabulary.way(tree.Differential(by), SLOPES)

    def _conjugate(self, by: tree.Node) -> Symbol | None:
        """The coordinate to which a letter is the conjugate momentum."""
        sense = self.vocabulary.sense(by)
        phrase = sense.readings[0].phrase if sense and sense.readings else ""
        stem, _, name = phrase.rpartition(" ")
        if stem != "momentum conjugate to":
            return None
        coordinates = self.vocabulary.mechanics.declared.coordinates
        return next(q for q in coordinates if q.published == name)

    def _in_phase_space(
        self, node: tree.Derivative, whole: Expr, momentum_of: Symbol | None
    ) -> Meaning:
        """∂H/∂p or ∂H/∂q of a function of coordinates and momenta."""
        mechanics = self.vocabulary.mechanics
        try:
            space = phase_space(mechanics)
        except DeclarationError as error:
            raise BindingError(error.given, expected=error.expected) from None
        if momentum_of is None:
            variable = as_symbol(self.scalar(node.by))
        else:
            variable = space.rates[momentum_of.derivative()]
        of_momenta = space.by_momenta(mechanics.in_rates(whole))
        found = reduce(lambda value, _: value.diff(variable), range(node.order), of_momenta)
        return space.by_rates(found)

    def _seen_from_axes(self, value: Meaning) -> Meaning:
        """∂L/∂t of a vector is its rate relative to the axes of the body: dL/dt = ∂L/∂t + ω × L."""
        return _relative_rate(value, self.vocabulary.mechanics.body.axes)

    def _seen_from(self, label: str) -> Callable[[Meaning], Meaning]:
        """The rate of a vector as it is seen from a frame: (dL/dt)_rot, (dL/dt)_s."""
        if label in _SPACE:
            return meanings.rate
        frames = self.vocabulary.mechanics.frames
        by_labels = {"".join(frame.labels): frame for frame in frames.values()}
        frame = frames["body"] if label in _BODY else frames.get(label) or by_labels.get(label)
        if frame is None:
            raise BindingError(
                f"a rate seen from {label!r}",
                expected=f"space, body, or a frame: {', '.join(frames)}",
                advice="write rot or body for the axes that turn with the body",
            )
        seen = frame
        return lambda value: _relative_rate(value, seen)

    @_value.register
    def _(self, node: tree.Differential) -> Meaning:
        if self.per_time and node.sign in VARIATIONS:
            return meanings.rate(self.value(node.of))
        factor = self._factor_of(node)
        return self.vocabulary.meaning(node) if factor is None else self._product((factor, node.of))

    def _factor_of(self, node: tree.Node) -> tree.Name | None:
        """The letter that is a factor, such as a length d, where it looks like a differential.

        It is one where the formula has no differentials, and the system or the text has a d.
        """
        if not isinstance(node, tree.Differential) or self.per_time or self.vocabulary.has(node):
            return None
        letter = tree.Name(_LETTERS_OF_SIGNS.get(node.sign, node.sign))
        vocabulary = self.vocabulary
        return letter if letter in vocabulary.declared or letter in vocabulary.stated else None

    @_value.register
    def _(self, node: tree.Integral) -> Meaning:
        if node.lower is None or node.upper is None:
            raise BindingError("an integral without limits", expected="a definite integral")
        lower, upper = self.scalar(node.lower), self.scalar(node.upper)
        inside = self
        if not self.vocabulary.has(node.by):  # x² dm of a rod: a letter within the integral alone
            stated = self.vocabulary.stating({node.by: constant(node.by)})
            inside = replace(self, vocabulary=stated)
        variable = as_symbol(inside.scalar(node.by))
        integrand = inside.value(node.of)
        if isinstance(integrand, Vector):
            parts = (integrate(c, variable, lower, upper) for c in integrand.components)
            return Vector(tuple(parts), integrand.triad)
        return integrate(as_scalar(integrand, "an integrand"), variable, lower, upper)

    @_value.register
    def _(self, node: tree.Sum) -> Meaning:
        return reduce(meanings.plus, (self.value(term) for term in node.terms))

    @_value.register
    def _(self, node: tree.Negative) -> Meaning:
        return meanings.minus(self.value(node.of))

    @_value.register
    def _(self, node: tree.PlusMinus) -> Meaning:
        found = self.value(node.of)
        return found if (node.sign == "±") == self.upper else meanings.minus(found)

    @_value.register
    def _(self, node: tree.Product) -> Meaning:
        rows = [i for i, f in enumerate(node.factors) if self._is_row(f)]
        if rows and rows[0] + 1 < len(node.factors):  # a row vector: aᵀ I b is a · I b
            before, after = node.factors[: rows[0]], node.factors[rows[0] + 1 :]
            inside = meanings.dot(self.value(node.factors[rows[0]]), self._product(after))
            return meanings.times(self._product(before), inside) if before else inside
        return self._product(node.factors)

    def _is_row(self, node: tree.Node) -> bool:
        """Whether a factor is a vector as a row: ωᵀ, or Goldstein's ω̃."""
        if isinstance(node, tree.Transposed):
            return True
        column = _column(node)
        if column is None or self.vocabulary.has(node):
            return False
        return isinstance(self.vocabulary.find(column), Vector)

    def _product(self, factors: Sequence[tree.Node]) -> Meaning:
        found = reduce(meanings.times, map(self.value, factors))
        roots = [f for f in factors if isinstance(f, tree.Root)]
        if len({*roots}) < len(roots) or len(roots) < 2:
            return found
        # √a √b is √(ab), which may be plain: √(1 + cos θ) √(1 - cos θ) = |sin θ|.
        joint = self._root(prod((self.scalar(root.of) for root in roots), start=ONE))
        apart = prod(map(self.scalar, roots), start=ONE)
        is_shorter = len(_open_roots(joint)) < len(_open_roots(apart))
        return meanings.times(found, joint / apart) if is_shorter else found

    @_value.register
    def _(self, node: tree.Cross) -> Meaning:
        return meanings.cross(self._factor(node.left), self._factor(node.right))

    def _factor(self, node: tree.Node) -> Meaning:
        """One side of · or ×: what is bold there may not stand for a scalar of the same letter.

        With μ and B known as magnitudes only, **μ** · **B** is not their product.
        """
        found = self.value(node)
        is_bold = isinstance(node, tree.Name) and node.decoration == "vector"
        if is_bold and isinstance(found, Expr) and found:
            raise BindingError(
                f"{spelled(node)} in a product of vectors, though it is known as a scalar",
                expected="a vector",
                advice="define it",
                option="let",
                symbol=spelled(node),
            )
        return found

    @_value.register
    def _(self, node: tree.Dot) -> Meaning:
        return meanings.dot(self._factor(node.left), self._factor(node.right))

    @_value.register
    def _(self, node: tree.Quotient) -> Meaning:
        above, below = self.value(node.above), self.value(node.below)
        if isinstance(below, Vector) and _is_plain(node.below):
            below = self._root(below.dot(below))  # the u of **u**/u is the magnitude
        return meanings.over(above, below)

    @_value.register
    def _(self, node: tree.Power) -> Meaning:
        # e is Euler's number unless the text defines it; e² may be the square of a length.
        is_number = isinstance(node.exponent, tree.Number)
        if node.base == _EULER and not is_number and not self.vocabulary.has(_EULER):
            return exp(self.scalar(node.exponent))
        factor = self._factor_of(node.base)
        if factor is not None and isinstance(node.base, tree.Differential):  # d x² is d times x²
            return self._product((factor, replace(node, base=node.base.of)))
        return meanings.power(self.value(node.base), self.value(node.exponent), self._root)

    @_value.register
    def _(self, node: tree.Root) -> Meaning:
        if node.index is not None and self.scalar(node.index) != 2:
            raise BindingError("a root other than a square root", expected="a square root")
        return self._root(self.scalar(node.of))

    def _root(self, radicand: Expr) -> Expr:
        return meanings.positive_root(radicand, self.vocabulary.positive)

    @_value.register
    def _(self, node: tree.Call) -> Meaning:
        if node.function not in _FUNCTIONS:
            raise BindingError(
                f"the function {node.function}",
                expected=f"one of {', '.join(_FUNCTIONS)}",
                advice="an inverse function may stand alone on one side, apart from factors",
            )
        return _FUNCTIONS[node.function](self.scalar(node.argument))

    @_value.register
    def _(self, node: tree.At) -> Meaning:
        if node not in self.vocabulary.stated and (letter := _elliptic(node)):
            raise BindingError(
                f"{letter} of a sine or a root, which is an elliptic integral",
                expected="formulas without elliptic integrals",
                advice=f"write the integral, or put the bracket first if {letter} is a factor",
            )
        of = node.of
        if (
            isinstance(of, tree.Name)
            and of.letter in POTENTIALS
            and (of.primes or is_of_place(node))
        ):
            # U'(θ) is a derivative, though U' by itself may be an effective potential
            is_letter = of in self.vocabulary.stated or of in self.vocabulary.chosen
            found = None if is_letter else self._slope(of, node.argument)
            if found is not None:
                return found
        if is_of_place(node):
            return self.vocabulary.meaning(node)
        # Of a rate it is the rate, as θ̇(t) is θ̇.
        is_rate = isinstance(of, tree.Dots) and node.argument == TIME
        if is_rate and node not in self.vocabulary.stated:
            return self.value(of)
        # v(t) is a value at a time, but in m(l) the bracket is a factor, since m is constant.
        if self.vocabulary.has(node.of) and isinstance(node.of, tree.Name):
            whole = self.value(node.of)
            if not _is_function(whole):
                return meanings.times(whole, self.value(node.argument))
            if isinstance(whole, Expr):
                found = self._function(node.of, whole, node.argument)
                if found is not None:
                    return found
        return self.vocabulary.meaning(node)

    def _slope(self, of: tree.Name, argument: tree.Node) -> Expr | None:
        """V″(θ₀): the derivative by the only coordinate on which a potential depends."""
        bare = replace(of, primes=0)
        stated = (n for n in self.vocabulary.stated if isinstance(n, tree.At) and n.of == bare)
        if (function := next(stated, None)) is not None:
            whole = self.vocabulary.meaning(function)
        elif self.vocabulary.has(bare) and not is_of_place(tree.At(bare, argument)):
            whole = self.value(bare)
        else:
            return None
        if not isinstance(whole, Expr):
            return None
        varying = [s for s in whole.symbols() if s.kind.varies]
        if len(varying) != 1:
            return None
        slope = reduce(lambda found, _: found.diff(varying[0]), range(of.primes), whole)
        return self._function(bare, slope, argument)

    def _function(self, of: tree.Name, whole: Expr, argument: tree.Node) -> Expr | None:
        """U(θ) is U, and U(θ₀) or U(π/2) its value there; None for a value at a time."""
        entries = argument.entries if isinstance(argument, tree.ComponentList) else (argument,)
        if any(TIME in tree.walk(entry) for entry in entries):
            return None
        try:
            values = [self.scalar(entry) for entry in entries]
        except BindingError:
            return None
        if all(_is_function(value) for value in values):
            return whole
        varying = [s for s in whole.symbols() if s.kind.varies]
        is_of_place = (
            len(varying) == 1 and varying[0] in self.vocabulary.mechanics.declared.coordinates
        )
        if of.letter in POTENTIALS and len(values) == 1 and is_of_place:
            return whole.subs({varying[0]: values[0]})
        return None

    @_value.register
    def _(self, node: tree.Magnitude) -> Meaning:
        inside = self.value(node.of)
        if isinstance(inside, Vector):
            return self._root(inside.dot(inside))
        if isinstance(inside, Expr) and meanings.IMAGINARY in inside.symbols():
            real, imaginary = meanings.complex_parts(inside)
            return self._root(real * real + imaginary * imaginary)
        return meanings.positive_size(as_scalar(inside, "a magnitude"), self.vocabulary.positive)

    @_value.register
    def _(self, node: tree.Evaluated) -> Meaning:
        raise BindingError(
            f"a quantity taken at {node.subscript}",
            expected="a quantity at the state that the claim is about",
            advice=f"leave out the bar and restrict the claim to {node.subscript}",
            option="given",
        )

    @_value.register
    def _(self, node: tree.Component) -> Meaning:
        axis = self.value(tree.Name(node.subscript, decoration="hat"))
        return as_vector(self.value(node.of), spelled(node)).dot(as_vector(axis, node.subscript))

    @_value.register
    def _(self, node: tree.ComponentList) -> Meaning:
        if len(node.entries) != 3:
            raise BindingError(
                f"{len(node.entries)} entries in a bracket", expected="three components of a vector"
            )
        frame = self.vocabulary.mechanics.frame(self.vocabulary.columns)
        return Vector.along(frame, [self.scalar(entry) for entry in node.entries])

    @_value.register
    def _(self, node: tree.PoissonBracket) -> Meaning:
        mechanics = self.vocabulary.mechanics
        found = poisson_bracket(mechanics, self.scalar(node.left), self.scalar(node.right))
        return found if self.vocabulary.way(BRACKET, SIGNS) == OF_COORDINATES_FIRST else -found

    @_value.register
    def _(self, node: tree.PrintedMatrix) -> Meaning:
        rows = [[self.scalar(entry) for entry in row.entries] for row in node.rows]
        if len(rows) != 3 or any(len(row) != 3 for row in rows):
            raise BindingError(
                f"a matrix of {len(rows)} rows beside a vector", expected="three rows and columns"
            )
        frame = self.vocabulary.mechanics.frame(self.vocabulary.columns)
        return meanings.Tensor(Matrix.of(rows), frame)

    @_value.register
    def _(self, node: tree.Transposed) -> Meaning:
        found = self.value(node.of)
        return found.transposed() if isinstance(found, meanings.Tensor) else found

    @_value.register
    def _(self, node: tree.Order | tree.Omitted) -> Meaning:
        raise BindingError(
            "terms that are left out",
            expected="them in an approximation",
            advice="state what is small in the context limit",
            option="small",
        )


def _open_roots(expression: Expr) -> list[SquareRoot]:
    """The roots in an expression that are no magnitudes |f|."""
    return [g for g in expression.generators if isinstance(g, SquareRoot) and g.plain is None]


def _column(node: tree.Node) -> tree.Name | None:
    """The column vector of which a letter with a tilde may be the row."""
    if isinstance(node, tree.Name) and node.decoration == "tilde vector":
        return replace(node, decoration="vector")
    return None


def _relative_rate(value: Meaning, frame: Frame) -> Meaning:
    if isinstance(value, Vector):
        return value.express(frame).dt(frame)
    return meanings.rate(value)


def _elliptic(node: tree.At) -> str:
    """The letter of an elliptic integral, taken at a sine or a root; empty for any other letter."""
    argument = node.argument
    last = argument.entries[-1] if isinstance(argument, tree.ComponentList) else argument
    letter = node.of.letter if isinstance(node.of, tree.Name) else ""
    is_modulus = isinstance(last, tree.Call | tree.Root)
    return letter if is_modulus and letter in lexicon.ELLIPTIC else ""


def _is_function(meaning: Meaning) -> bool:
    """Whether it changes with time, so that a bracket behind it holds a time."""
    match meaning:
        case Expr():
            return meaning.varies
        case Vector():
            return True
    return False


def _is_plain(node: tree.Node) -> bool:
    return isinstance(node, tree.Name) and not node.decoration


def moving(node: tree.Dots) -> tree.Dots:
    """The rate of a vector as the key of its reading, whatever its number of dots."""
    return tree.Dots(node.of, 1)
