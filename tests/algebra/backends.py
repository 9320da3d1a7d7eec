"""One expression tree, evaluated in three backends: polhode's algebra, mpmath and SymPy.

A tree is a nested tuple. The backends share nothing but the tree, so that a result of polhode's
can be judged by a number, and by another computer algebra.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import sympy
from hypothesis import strategies as st

from polhode import algebra as ph
from polhode.algebra import Expr, Symbol

mpmath.mp.dps = 120  # high powers of sums lose half of them
CLOSE = mpmath.mpf(10) ** -30

x, y = ph.symbols("x y")
a, b = ph.symbols("a b", positive=True)
theta, phi = ph.coordinates("theta phi")
theta_dot, phi_dot = theta.dt(), phi.dt()
(omega_3,) = ph.speeds("omega_3")

#: Every symbol that trees use, by its published name.
NAMES = {
    str(ph.as_symbol(e).published): e
    for e in (x, y, a, b, theta, phi, theta_dot, phi_dot, omega_3, ph.time)
}

#: A point at which nothing special happens; a and b are positive.
POINT = {
    name: mpmath.mpf(value)
    for name, value in {
        "x": "0.7310585786300049",
        "y": "-1.324717957244746",
        "a": "1.2020569031595942",
        "b": "0.5772156649015329",
        "theta": "0.9159655941772190",
        "phi": "-2.502907875095893",
        "theta_dot": "0.6243299885435508",
        "phi_dot": "-0.2614972128476428",
        "omega_3": "1.705211140105367",
        "t": "0.4142135623730950",
    }.items()
} | {"pi": +mpmath.mp.pi}


@dataclass(frozen=True)
class Backend:
    """What numbers, names and functions are made of."""

    number: Callable[[Fraction], Any]
    name: Callable[[str], Any]
    function: Callable[[str], Callable[[Any], Any]]


KERNEL = Backend(
    Expr.of,
    lambda name: ph.pi if name == "pi" else NAMES[name],
    lambda name: {"abs": ph.absolute}.get(name) or getattr(ph, name),
)
SYMPY = Backend(
    lambda q: sympy.Rational(q.numerator, q.denominator),
    lambda name: sympy.pi if name == "pi" else sympy.Symbol(name),
    lambda name: getattr(sympy, "Abs" if name == "abs" else name),
)


def numbers_at(point: Mapping[str, Any]) -> Backend:
    """The backend of numbers of sixty digits, at a point."""
    return Backend(
        lambda q: mpmath.mpf(q.numerator) / q.denominator,
        point.__getitem__,
        lambda name: abs if name == "abs" else getattr(mpmath, name),
    )


NUMBERS = numbers_at(POINT)


def evaluated(tree: tuple, backend: Backend) -> Any:
    """What a tree makes in a backend."""
    match tree:
        case ("number", value):
            return backend.number(value)
        case ("name", name):
            return backend.name(name)
        case ("+", first, second):
            return evaluated(first, backend) + evaluated(second, backend)
        case ("-", first, second):
            return evaluated(first, backend) - evaluated(second, backend)
        case ("*", first, second):
            return evaluated(first, backend) * evaluated(second, backend)
        case ("/", first, second):
            return evaluated(first, backend) / evaluated(second, backend)
        case ("^", base, power):
            return evaluated(base, backend) ** power
        case (function, argument):
            return backend.function(function)(evaluated(argument, backend))
    raise ValueError(tree)


# --- trees ---

small = st.fractions(min_value=-3, max_value=3, max_denominator=4)
numbers = st.tuples(st.just("number"), small)
symbols = st.sampled_from([name for name in NAMES if name != "t"]).map(lambda n: ("name", n))


@st.composite
def angles(draw: st.DrawFn) -> tuple:
    """A multiple of an angle, perhaps with another one or a special angle added."""
    times = st.sampled_from([Fraction(n, d) for n, d in ((1, 1), (2, 1), (-3, 1), (1, 2), (-1, 2))])
    first = ("*", ("number", draw(times)), ("name", draw(st.sampled_from(["theta", "phi"]))))
    twelfths = st.integers(-24, 24).map(
        lambda n: ("*", ("number", Fraction(n, 12)), ("name", "pi"))
    )
    second = draw(st.one_of(st.none(), twelfths, st.just(("name", "phi")), st.just(("name", "x"))))
    return first if second is None else ("+", first, second)


circular = st.tuples(st.sampled_from(["sin", "cos"]), angles())
arguments = st.sampled_from(
    [
        ("name", "x"),
        ("*", ("number", Fraction(-1, 2)), ("name", "x")),
        ("-", ("name", "x"), ("*", ("number", Fraction(2)), ("name", "y"))),
    ]
)
growing = st.tuples(st.sampled_from(["sinh", "cosh", "exp"]), arguments)
leaves = st.one_of(numbers, symbols, symbols, circular)


def sums_and_products(inner: st.SearchStrategy) -> st.SearchStrategy:
    """Recipes one level higher, without division or roots."""
    return st.one_of(
        st.tuples(st.sampled_from("+-*"), inner, inner),
        st.tuples(st.just("^"), inner, st.integers(0, 3)),
    )


def of_positive(sign: str) -> Callable[[tuple], tuple]:
    """Makes a tree of one that is positive by construction."""
    return lambda tree: ("+", ("*", tree, tree), ("name", sign))


#: What it is divided by: short, since a denominator is multiplied by all its conjugates.
simple = st.one_of(
    numbers,
    symbols,
    st.sampled_from([(f, ("name", angle)) for f in ("sin", "cos") for angle in ("theta", "phi")]),
    st.just(("cosh", ("name", "x"))),
    symbols.map(lambda name: ("sqrt", of_positive("a")(name))),
)
divisors = st.one_of(simple, st.tuples(st.sampled_from("+-*"), simple, simple))


def smooth_ones(inner: st.SearchStrategy) -> st.SearchStrategy:
    """Recipes one level higher that can be differentiated everywhere."""
    return st.one_of(
        sums_and_products(inner),
        sums_and_products(inner),
        st.tuples(st.just("/"), inner, divisors),
        st.tuples(st.just("sqrt"), symbols.map(of_positive("b"))),
    )


def all_kinds(inner: st.SearchStrategy) -> st.SearchStrategy:
    """Recipes one level higher, of any kind."""
    return st.one_of(
        smooth_ones(inner),
        smooth_ones(inner),
        st.tuples(st.just("sqrt"), simple.map(of_positive("a"))),
        st.tuples(st.just("abs"), divisors),
    )


polynomials = st.recursive(leaves, sums_and_products, max_leaves=5)
smooth = st.recursive(st.one_of(leaves, growing), smooth_ones, max_leaves=4)
trees = st.recursive(st.one_of(leaves, growing), all_kinds, max_leaves=4)


def expression_of(tree: tuple) -> Expr | None:
    """What the kernel makes of it, or None where a denominator vanishes."""
    try:
        return evaluated(tree, KERNEL)
    except ZeroDivisionError:
        return None


# --- values ---


def value(expression: Expr, point: Mapping[str, Any] = POINT) -> Any:
    """The value of the normal form at a point, from its terms alone."""
    return _polynomial(expression.numerator, point) / _polynomial(expression.denominator, point)


def _polynomial(expression: Expr, point: Mapping[str, Any]) -> Any:
    total = mpmath.mpf(0)
    for powers, coefficient in expression.terms():
        term = mpmath.mpf(coefficient.numerator) / coefficient.denominator
        for generator, power in powers.items():
            term *= _generator(generator, point) ** power
        total += term
    return total


def _generator(generator: ph.Generator, point: Mapping[str, Any]) -> Any:
    if isinstance(generator, Symbol):
        return point[generator.published]
    (argument,) = generator.arguments
    name = generator.key.split("(")[0]
    return getattr(mpmath, name)(value(argument, point))


def are_close(first: Any, second: Any) -> bool:
    """Whether two numbers agree to thirty digits."""
    return abs(first - second) <= CLOSE * (1 + abs(first) + abs(second))
