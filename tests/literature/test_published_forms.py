"""Derived equations are those of books, and as short."""

import random

import pytest
import sympy as sp

import polhode as ph
from literature.published_forms import FORMS
from polhode.algebra import to_sympy

#: Times the operations of the published form, lengths and what they stand for counted once.
MOST = 1.2


def written(text, lengths=()):
    """A row of a published form; letters of lengths stand for themselves or for their roots."""
    names = {str(s): s for s in sp.sympify(text, locals=LETTERS).free_symbols}
    return sp.sympify(text, locals=LETTERS | names).subs(dict(lengths))


#: Names that SymPy has functions for.
LETTERS = {name: sp.Symbol(name) for name in ("beta", "zeta", "gamma", "lambda_", "I", "Q", "S")}


def in_letters(expression):
    """A derived row with the letters of lengths, as it is printed."""
    return written(str(expression).replace("abs(v_c)", "v_c").replace("abs(v)", "v"))


@pytest.mark.parametrize("name", FORMS)
def test_published_equations_hold_along_the_motion(name):
    """At a random state, with the accelerations of the model in their normal form."""
    form = FORMS[name]
    equations = ph.derive(form.build())
    if equations.motion_in_parts:  # which SymPy cannot be given
        equations = equations.in_lengths
    drawn = random.Random(name)
    symbols = {
        *(*equations.coordinates, *equations.speeds, *equations.parameters),
        *(*equations.kinematics, *equations.dependent),
    }
    values = {s: sp.Rational(drawn.randint(5, 40), 16) for s in sorted(symbols, key=str)}
    state = {sp.Symbol(s.published): v for s, v in values.items()}
    for symbol, value in {**equations.kinematics, **equations.dependent}.items():
        if symbol not in equations.speeds:
            state[sp.Symbol(symbol.published)] = to_sympy(value).subs(state)
    mass = sp.Matrix([[to_sympy(e).subs(state) for e in row] for row in equations.mass.rows])
    forcing = sp.Matrix([to_sympy(f).subs(state) for f in equations.forcing])
    found = mass.evalf(40).LUsolve(forcing.evalf(40))
    accelerations = [sp.Symbol(s.published) for s in equations.acceleration_symbols]
    state |= dict(zip(accelerations, found, strict=True))
    lengths = {letter: written(root) for letter, root in form.lengths.items()}
    for row in form.rows:
        expression = written(row, lengths)
        terms = sp.Add.make_args(sp.expand(expression))
        size = sum(abs(term.subs(state).evalf(40)) for term in terms)
        assert abs(expression.subs(state).evalf(40)) <= 1e-30 * max(size, 1), row


@pytest.mark.parametrize("name", FORMS)
def test_derived_equations_are_as_short(name):
    form = FORMS[name]
    equations = ph.derive(form.build()).in_lengths
    meanings = [part.meaning for part in equations.lengths.values()]
    own = [*map(in_letters, equations.motion), *(written(str(m)) for m in meanings)]
    theirs = [*map(written, form.rows), *map(written, form.lengths.values())]
    assert sum(map(sp.count_ops, own)) <= MOST * sum(map(sp.count_ops, theirs))
