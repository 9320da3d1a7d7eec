"""`polhode invariants`: a document that SymPy reads, its text, and a refusal."""

import sympy

from cli.sympy_text import from_srepr


def test_integrals_are_constant_by_sympys_own_calculus(document):
    """dC/dt along Euler's equations, differentiated and substituted by SymPy."""
    found = document("invariants", "tennis-racquet")
    assert "degree 2 in the speeds" in found["ansatz"]
    energy = next(i for i in found["invariants"] if i["name"] == "E")
    moments = sympy.symbols("I_1 I_2 I_3")
    spins = sympy.symbols("omega_1 omega_2 omega_3")
    rate = sum(
        from_srepr(energy["sympy"]).diff(spins[i])
        * (moments[(i + 1) % 3] - moments[(i + 2) % 3])
        / moments[i]
        * spins[(i + 1) % 3]
        * spins[(i + 2) % 3]
        for i in range(3)
    )
    assert sympy.simplify(rate) == 0


def test_the_text_output(polhode):
    code, out, _ = polhode("invariants", "marble-on-turntable")
    assert code == 0
    assert "Nothing outside it is excluded" in out


def test_a_system_that_does_not_exist_is_refused(polhode):
    code, out, err = polhode("invariants", "nothing")
    assert (code, out) == (2, "")
    assert "is no system" in err
