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


def test_conserved_momenta_have_their_names(polhode, document):
    _, out, _ = polhode("invariants", "spinning-coin")
    assert "(conserved momentum: L_cm_z)" in out
    found = document("invariants", "spinning-coin")["momenta"]
    m, a, spin = sympy.symbols("m a omega_3")
    assert from_srepr(found["P_psi"]["sympy"]) == m * a**2 * spin / 2  # (21) of the problem set
    assert document("invariants", "rolling-disk")["momenta"] == {}


def test_friction_of_any_strength_leaves_the_momentum_about_the_contact(document):
    found = document("invariants", "ball-on-paper", "--mu", "mu")["invariants"]
    m, r, k, v, omega = sympy.symbols("m r k v_x omega_y")
    about = {i["name"]: from_srepr(i["sympy"]) for i in found}
    # L + r z × P of (87), about the axis y
    assert sympy.expand(about["L_sheet_y"] - m * r * (v + k * r * omega)) == 0
