"""Evaluation of printed formulas: a node of the tree becomes a scalar, a vector or a tensor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import reduce, singledispatchmethod

from polhode.algebra import (
    Expr,
    Vector,
    as_symbol,
    cos,
    cosh,
    exp,
    integrate,
    sin,
    sinh,
    tan,
)
from polhode.algebra import tanh as tanh
from polhode.base import NumericError
from polhode.claims.latex import _tree as tree
from polhode.claims.latex._names import spelled
from polhode.claims.meaning import _meaning as meanings
from polhode.claims.meaning._meaning import BindingError, Meaning, as_scalar, as_vector
from polhode.claims.meaning._vocabulary import LAGRANGIAN, Vocabulary

TIME = tree.Name("t")
_EULER = tree.Name("e")

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


class UnclearDerivativeError(BindingError):
    """A derivative d/dθ of a quantity that varies with more than θ."""

    def __init__(self, of: str, by: str) -> None:
        super().__init__(
            f"d({of})/d({by}) where {of} varies with more than {by}",
            expected="a derivative on which all readings agree",
            advice=f"write \\partial for the derivative at fixed speeds, or the rate of {of} over "
            f"the rate of {by} for the one along the motion",
        )


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
    def _(self, node: tree.Number) -> Meaning:
        return Expr.of(Fraction(node.text))

    @_value.register
    def _(self, node: tree.Words) -> Meaning:
        raise BindingError(f"the words {node.text!r}", expected="a quantity")

    @_value.register
    def _(self, node: tree.Dots) -> Meaning:
        found = self.value(node.of)
        for _ in range(node.count):
            found = meanings.rate(found)
        return found

    @_value.register
    def _(self, node: tree.Derivative) -> Meaning:
        found = self.value(node.of)
        if node.by == TIME:
            change = self._seen_from_axes if node.partial else meanings.rate
            return reduce(lambda value, _: change(value), range(node.order), found)
        variable = as_symbol(self.scalar(node.by))
        # ∂L/∂q is of the Lagrangian, though a plain L stands for the angular momentum here.
        if node.partial and node.of == LAGRANGIAN and isinstance(found, Vector):
            found = self.value(replace(LAGRANGIAN, letter="cal L"))
        whole = as_scalar(found, "what is differentiated")
        if node.partial:
            whole = self.vocabulary.mechanics.in_rates(whole)
        elif {s for s in whole.symbols() if s.kind.varies} - {variable}:
            # dE/dθ where E varies with more than θ is ∂E/∂θ in some texts, Ė/θ̇ in others.
            if not self.vocabulary.total_derivative:
                raise UnclearDerivativeError(spelled(node.of), spelled(node.by))
            if self.vocabulary.total_derivative == "along the motion":
                rate = Expr.generator(variable).dt()
                return reduce(lambda value, _: value.dt() / rate, range(node.order), whole)
        return reduce(lambda value, _: value.diff(variable), range(node.order), whole)

    def _seen_from_axes(self, value: Meaning) -> Meaning:
        """∂L/∂t of a vector is its rate relative to the axes of the body: dL/dt = ∂L/∂t + ω × L."""
        if isinstance(value, Vector):
            axes = self.vocabulary.mechanics.body.axes
            return value.express(axes).dt(axes)
        return meanings.rate(value)

    @_value.register
    def _(self, node: tree.Differential) -> Meaning:
        if self.per_time and node.sign == "d":
            return meanings.rate(self.value(node.of))
        return self.vocabulary.meaning(node)

    @_value.register
    def _(self, node: tree.Integral) -> Meaning:
        if node.lower is None or node.upper is None:
            raise BindingError("an integral without limits", expected="a definite integral")
        variable = as_symbol(self.scalar(node.by))
        lower, upper = self.scalar(node.lower), self.scalar(node.upper)
        integrand = self.value(node.of)
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
        return reduce(meanings.times, (self.value(factor) for factor in node.factors))

    @_value.register
    def _(self, node: tree.Cross) -> Meaning:
        return meanings.cross(self.value(node.left), self.value(node.right))

    @_value.register
    def _(self, node: tree.Dot) -> Meaning:
        return meanings.dot(self.value(node.left), self.value(node.right))

    @_value.register
    def _(self, node: tree.Quotient) -> Meaning:
        return meanings.over(self.value(node.above), self.value(node.below))

    @_value.register
    def _(self, node: tree.Power) -> Meaning:
        # e is Euler's number unless the text defines it; e² may be the square of a length.
        is_number = isinstance(node.exponent, tree.Number)
        if node.base == _EULER and not is_number and not self.vocabulary.has(_EULER):
            return exp(self.scalar(node.exponent))
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
        # v(t) is a value at a time, but in m(l) the bracket is a factor, since m is constant.
        if self.vocabulary.has(node.of) and isinstance(node.of, tree.Name):
            whole = self.value(node.of)
            if not _is_function(whole):
                return meanings.times(whole, self.value(node.argument))
        return self.vocabulary.meaning(node)

    @_value.register
    def _(self, node: tree.Magnitude) -> Meaning:
        inside = self.value(node.of)
        if isinstance(inside, Vector):
            return self._root(inside.dot(inside))
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


def _is_function(meaning: Meaning) -> bool:
    """Whether it changes with time, so that a bracket behind it holds a time."""
    match meaning:
        case Expr():
            return any(s.kind.varies for s in meaning.symbols())
        case Vector():
            return True
    return False
