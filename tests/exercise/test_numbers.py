"""Numbers drawn for exercises: reproducible, legal, to two significant figures."""

from dataclasses import replace
from hashlib import sha256
from itertools import permutations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.base import UnitError
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.exercise import Builder
from polhode.exercise._draws import Draws, rounded
from polhode.exercise._numbers import draw, draw_state
from polhode.exercise._quantities import Amount, number_latex, plain_amount


def test_a_draw_is_the_start_of_a_digest():
    """By hand, so that no machine and no version of Python draws anything else."""
    digest = sha256(b"exercise 3/m").digest()
    bits = int.from_bytes(digest, "big") >> (256 - 53)
    assert Draws("exercise 3").fraction("m") == bits / 2**53
    assert round(Draws("exercise 3").fraction("m"), 6) == 0.288832


def test_draws_are_independent_of_their_order():
    draws = Draws("x")
    first = [draws.fraction("a"), draws.fraction("b")]
    assert first == [draws.fraction("b"), draws.fraction("a")][::-1]
    assert sorted(draws.shuffled("s", "abcdef")) == list("abcdef")


@given(st.floats(1e-8, 1e8))
def test_two_figures_are_within_five_per_cent(value):
    assert abs(rounded(value) - value) <= 0.0501 * value
    assert len(f"{rounded(value):.10e}".split("e")[0].rstrip("0").replace(".", "")) <= 2


@pytest.fixture(scope="module")
def racquet():
    return Builder.of(CATALOGUE["tennis-racquet"]).subject


@pytest.fixture(scope="module")
def bar():
    """A bar with three letters for its moments, and nothing that says what is typical."""
    mass, length, g, *moments = ph.symbols("M b g A B C", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    body = ph.Body("bar", mass=mass, inertia=moments, axes=axes)
    system = ph.System(ph.Pivot(body, at=axes["3"] * length), ph.Gravity(g), name="swing")
    return Builder.of(system).subject


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_moments_obey_the_triangle_inequality(seed, racquet, bar):
    for subject, names in ((racquet, ("I_1", "I_2", "I_3")), (bar, ("A", "B", "C"))):
        values = {s.published: v for s, v in draw(subject, Draws(str(seed)), {}).values.items()}
        for i, j, k in permutations(values[name] for name in names):
            assert i <= (j + k) * (1 + 1e-12)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_the_order_of_typical_moments_is_kept(seed, racquet):
    values = {s.published: v for s, v in draw(racquet, Draws(str(seed)), {}).values.items()}
    assert values["I_1"] < values["I_2"] < values["I_3"]


def test_gravity_and_the_earth_are_not_drawn(bar):
    values = {s.published: v for s, v in draw(bar, Draws("1"), {}).values.items()}
    assert values["g"] == 9.81
    compass = Builder.of(CATALOGUE["gyrocompass"]).subject
    values = {s.published: v for s, v in draw(compass, Draws("1"), {}).values.items()}
    assert values["Omega"] == 7.2921159e-5
    assert values["I_3"] == pytest.approx(values["m"] * values["a"] ** 2)


def test_a_value_that_is_set_is_kept(bar):
    found = draw(bar, Draws("1"), {"M": "2 kg"})
    assert found.texts["M"] == "2.0 kg"


@pytest.mark.parametrize(
    ("text", "si"), [("7.5 g", 0.0075), ("33 rpm", 33 * 2 * 3.141592653589793 / 60), ("2", 2)]
)
def test_amounts_are_read_in_their_units(text, si):
    assert plain_amount(text).si == pytest.approx(si)


def test_formulas_are_no_amounts_and_units_are_checked():
    assert plain_amount("m*a**2/2") is None
    assert plain_amount("2/5") is None
    with pytest.raises(UnitError):
        _ = Amount(1.0, "furlong").si


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0123456, "0.0123"), (12.3456, "12.3"), (1234.56, "1235"), (-4.2e-5, r"-4.20\cdot 10^{-5}")],
)
def test_numbers_are_printed_to_three_figures(value, text):
    assert number_latex(value) == text


# -- what can be -----------------------------------------------------------------------------------


def subject_of(*parts, name):
    return Builder.of(CatalogueEntry.bare(name, name, ph.System(*parts, name=name))).subject


def drawn(subject, seed):
    values = draw(subject, Draws(str(seed)), {}).values.items()
    return {s.published: v for s, v in values}


SEEDS = range(12)


def test_a_pin_is_within_its_rod():
    m, l, h, g = ph.symbols("m l h g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="3")
    parts = (ph.Pivot(rod, at=axes["3"] * h), ph.Hinge(rod, axis="2"), ph.Gravity(g))
    subject = subject_of(*parts, name="rod")
    assert all(drawn(subject, seed)["h"] <= drawn(subject, seed)["l"] / 2 for seed in SEEDS)


def test_moments_about_a_fixed_point_leave_some_for_the_centre_of_mass():
    m, s, g, J, K = ph.symbols("m s g J K", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    top = ph.Body("top", mass=m, inertia=(J - m * s**2, J - m * s**2, K), axes=axes)
    subject = subject_of(ph.Pivot(top, at=axes["3"] * -s), ph.Gravity(g), name="top")
    for seed in SEEDS:
        v = drawn(subject, seed)
        across = v["J"] - v["m"] * v["s"] ** 2
        assert 0 < v["K"] <= 2 * across


def test_a_ball_is_smaller_than_its_bowl_and_has_its_centre_of_mass_inside():
    m, a, R, h, g, A, C = ph.symbols("m a R h g A C", positive=True)
    lab = ph.Frame("lab")
    turned = lab.rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    bob = ph.point_mass("ball", mass=m, axes=turned)
    bowl = subject_of(
        ph.Pivot(bob, at=turned["3"] * (R - a)), ph.Hinge(bob, axis="2"), ph.Gravity(g), name="bowl"
    )
    assert all(drawn(bowl, seed)["R"] > drawn(bowl, seed)["a"] for seed in SEEDS)
    tilted = lab.rotated(ph.coordinate("phi"), "z").rotated(
        ph.coordinate("theta"), "x", labels="1 2 3"
    )
    surface = ph.Round(R, "3", h)
    top = ph.Body(
        "top", mass=m, inertia=(A, A, C), axes=tilted, spin_about="3", surface=surface
    )  # fmt: skip
    tippe = subject_of(ph.Rolling(top, on=ph.Plane(lab)), ph.Gravity(g), name="tippe top")
    for seed in SEEDS:
        v = drawn(tippe, seed)
        assert v["h"] < v["R"]
        assert 2 * v["A"] + v["C"] <= 2 * v["m"] * v["R"] ** 2  # all mass within the sphere


def test_units_are_those_of_springs_and_dampers():
    m, k, c = ph.symbols("m k c", positive=True)
    lab = ph.Frame("lab")
    block = ph.point_mass("block", mass=m, axes=lab)
    subject = subject_of(
        ph.Pivot(block, only="y z", name="rail"),
        ph.Spring(block.point(), lab.zero, stiffness=k),
        ph.Damper(block.point(), lab.zero, damping=c),
        name="block",
    )
    amounts = draw(subject, Draws("1"), {}).amounts.items()
    assert {s.published: a.unit for s, a in amounts} == {"m": "kg", "k": "N/m", "c": "N s/m"}


def test_a_compass_turns_as_slowly_as_compasses_do():
    """Its period is 2π √(I₁/(I₃ Ω ω sin λ)) with ω = 3000 rpm: half a minute, so that θ̇ < 1/s."""
    subject = Builder.of(CATALOGUE["gyrocompass"]).subject
    (rate,) = (s for s in subject.equations.speeds if s.published == "theta_dot")
    for seed in SEEDS:
        draws = Draws(str(seed))
        found = draw_state(subject, [rate], draw(subject, draws, {}), draws)
        assert 0.02 < found[rate].si < 1


def test_a_hoop_does_not_turn_with_the_earth():
    m, R, g, Omega = ph.symbols("m R g Omega", positive=True)
    turning = ph.earth(Omega, colatitude=0)
    hoop = turning.rotated(-ph.coordinate("theta"), "y", name="hoop")
    bead = ph.point_mass("bead", mass=m, axes=hoop)
    wire = ph.Pivot(bead, at=hoop["z"] * R, name="wire", along=hoop)
    subject = subject_of(wire, ph.Hinge(bead, axis="y"), ph.Gravity(g), name="bead on a hoop")
    assert all(drawn(subject, seed)["Omega"] > 0.5 for seed in SEEDS)


def test_bare_numbers_of_a_file_get_their_units():
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    system = ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g), name="swing")
    entry = CatalogueEntry.bare("swing", "swing", system)
    entry = replace(entry, values={"m": "0.2", "l": "100 m"}, start={"theta_dot": "7 rad/s"})
    subject = Builder.of(entry).subject
    amounts = {s.published: a for s, a in draw(subject, Draws("1"), {}).amounts.items()}
    assert {name: a.unit for name, a in amounts.items()} == {"m": "kg", "l": "m", "g": "m/s^2"}
    assert 60 < amounts["l"].si < 150
    assert 0.1 < amounts["m"].si < 0.3
