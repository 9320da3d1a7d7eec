"""Expansions against the linearised equations of the literature."""

import polhode as ph
from analyse.systems import equations, symbols
from polhode.algebra import pi
from polhode.analyse import expand


def test_coin_nearly_on_edge():
    """ε̈ = -(φ̇² - 4g/a) ε - 2 ω₃ φ̇ to first order in ε, for θ = π/2 + ε."""
    derived = equations("spinning-coin")
    s = symbols(derived)
    small = ph.symbol("delta")
    tilt = ph.coordinate("epsilon")
    row = next(r for r in derived.motion if s["theta"].dt().dt().symbol in r.symbols())
    found = expand(row, small, 1, about={s["theta"]: pi / 2 + small * tilt})
    rate, spin = s["phi"].dt(), s["omega_3"]
    classical = tilt.dt().dt() + (rate**2 - 4 * s["g"] / s["a"]) * tilt
    expected = s["a"] * (small * classical + 2 * spin * rate)
    assert found.polynomial == expected
    assert found.dropped is not None
    assert found.dropped[0] == 2


def test_gyrocompass_to_first_order_in_the_rate_of_the_earth():
    derived = equations("gyrocompass")
    s = symbols(derived)
    row = next(r for r in derived.motion if s["theta"].dt().dt().symbol in r.symbols())
    found = expand(row, s["Omega"], 1)
    swing = s["I_1"] * s["theta"].dt().dt()
    pull = s["I_3"] * s["omega"] * s["Omega"] * ph.sin(s["lambda_"]) * ph.sin(s["theta"])
    assert found.polynomial == swing + pull
    assert found.dropped is not None
    assert found.dropped[0] == 2


def test_what_is_exact_drops_nothing():
    x = ph.symbol("x")
    assert expand(1 + x + x**2, x, 2).dropped is None
