"""Expansions against the linearised equations of the literature."""

import pytest

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


def test_fast_spin_is_an_expansion_in_one_over_the_spin():
    """Slow precession M g a/I₁ω₁ and fast I₁ω₁/(I₂ₚ cos θ), as in the problem set, (127)-(130)."""
    e = equations("gyroscope")
    M, g, a, first, second = ph.symbols("M g a I_1 I_2", positive=True)
    spin, theta = ph.speed("omega_1"), ph.coordinate("theta")
    slow, fast = (branch.value for branch in ph.steady(e)[0].branches)
    found = ph.expand(slow, 1 / spin, 1)
    assert found.polynomial == M * g * a / (first * spin)
    power, dropped = found.dropped
    about_pivot = second + M * a**2
    assert power == 3
    assert dropped == (M * g * a) ** 2 * about_pivot * ph.cos(theta) / (first * spin) ** 3
    assert ph.expand(fast, 1 / spin, -1).polynomial == first * spin / (about_pivot * ph.cos(theta))


def test_an_essential_singularity_is_refused():
    x = ph.symbol("x")
    with pytest.raises(ph.NumericError, match="finite value"):
        ph.expand(1 / ph.sin(x), x)
