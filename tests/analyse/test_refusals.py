"""Analysis needs equations: a declaration is refused with the advice to derive it first."""

from __future__ import annotations

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET

ASKED = [
    (ph.steady, "steady motions"),
    (ph.invariants, "invariants"),
    (ph.linear_integrals, "linear integrals"),
    (lambda system: ph.closed_form(system, {}, {}), "the closed form"),
    (lambda system: ph.contact_forces(system, "ground"), "contact forces"),
    (lambda system: ph.check("a = a", system), "a claim about the motion"),
]


@pytest.mark.parametrize(("ask", "what"), ASKED)
def test_a_declaration_is_to_be_derived_first(ask, what):
    system = PROBLEM_SET["rolling-disk"].build()
    with pytest.raises(ph.DeclarationError, match=f"{what} of a System; .* derive them first"):
        ask(system)
