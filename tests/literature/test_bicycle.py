"""The benchmark bicycle: J. P. Meijaard, J. M. Papadopoulos, A. Ruina and A. L. Schwab,
Linearized dynamics equations for the balance and steer of a bicycle: a benchmark and review,
Proc. R. Soc. A 463 (2007) 1955-1982; Table 2, and the speeds at which stability changes.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import polhode as ph
from derive.bicycles import BENCHMARK, bicycle

AT_REST = (3.13164324790656, 5.53094371765393, -3.13164324790656, -5.53094371765393)
#: By forward speed, m/s: real and imaginary part.
WEAVE = {
    1: (3.52696170990070, 0.80774027519930),
    2: (2.68234517512745, 1.68066296590675),
    3: (1.70675605663975, 2.31582447384325),
    4: (0.41325331521125, 3.07910818603206),
    5: (-0.77534188219585, 4.46486771378823),
    6: (-1.52644486584142, 5.87673060598709),
    7: (-2.13875644258362, 7.19525913329805),
    8: (-2.69348683581097, 8.46037971396931),
    9: (-3.21675402252485, 9.69377351531791),
    10: (-3.72016840437287, 10.90681139476287),
}
CAPSIZE_AND_CASTER = {
    1: (-3.13423125066578, -7.11008014637442),
    2: (-3.07158645641514, -8.67387984831735),
    3: (-2.63366137253667, -10.35101467245920),
    4: (-1.42944427361326, -12.15861426576447),
    5: (-0.32286642900409, -14.07838969279822),
    6: (-0.00406690076970, -16.08537123098026),
    7: (0.10268170574766, -18.15788466125262),
    8: (0.14327879765713, -20.27940894394569),
    9: (0.15790184030917, -22.43788559040858),
    10: (0.16105338653172, -24.62459635017404),
}
WEAVE_SPEED = 4.29238253634111
CAPSIZE_SPEED = 6.02426201538837


def running(speed: float) -> ph.Linearised:
    """Small departures from upright straight running."""
    upright = {"phi": 0, "delta": 0, "omega_y_R": speed / BENCHMARK["r_R"]}
    return ph.linearise(bicycle(), BENCHMARK, upright)


def eigenvalues(speed: float) -> np.ndarray:
    """Of upright straight running, without the zero of the forward speed itself."""
    found = running(speed)
    assert found.states == ("phi", "delta", "phi_dot", "delta_dot", "omega_y_R")
    assert not np.any(found.matrix[-1])
    assert not np.any(found.matrix[:, -1])
    return np.linalg.eigvals(found.matrix[:-1, :-1])


def test_at_rest_it_falls_over_in_two_ways():
    found = np.sort(eigenvalues(0.0))
    assert found == pytest.approx(sorted(AT_REST), rel=1e-12)


@pytest.mark.parametrize("speed", WEAVE)
def test_the_published_eigenvalues_follow(speed):
    found = eigenvalues(float(speed))
    oscillating = found[found.imag > 0]
    assert oscillating == pytest.approx([complex(*WEAVE[speed])], rel=1e-12)
    real = np.sort(found[found.imag == 0].real)
    assert real == pytest.approx(sorted(CAPSIZE_AND_CASTER[speed]), rel=1e-11)


def test_it_is_stable_by_itself_between_the_weave_and_the_capsize_speed():
    weave, capsize = eigenvalues(WEAVE_SPEED), eigenvalues(CAPSIZE_SPEED)
    assert weave[weave.imag > 0].real == pytest.approx(0, abs=1e-12)
    assert capsize[np.argmin(np.abs(capsize))] == pytest.approx(0, abs=1e-12)
    assert max(eigenvalues(WEAVE_SPEED - 0.01).real) > 1e-3
    assert max(eigenvalues((WEAVE_SPEED + CAPSIZE_SPEED) / 2).real) < -1e-3
    assert max(eigenvalues(CAPSIZE_SPEED + 0.01).real) > 1e-5


def test_only_the_zero_of_the_forward_speed_is_left_out():
    """Also where another eigenvalue is as small as it."""
    for speed in (0.0, 3.0, CAPSIZE_SPEED, 8.0):
        found = running(speed)
        assert found.neutral == 1
        assert len(found.eigenvalues) == len(found.exponents) + 1
        assert np.sort(found.exponents) == pytest.approx(np.sort(eigenvalues(speed)), abs=1e-11)


@pytest.mark.parametrize(
    ("between", "published"), [((4.0, 5.0), WEAVE_SPEED), ((5.0, 7.0), CAPSIZE_SPEED)]
)
def test_the_speeds_at_which_stability_changes_are_found_to_all_printed_digits(between, published):
    """That of capsizing too, at which an eigenvalue passes through zero itself."""

    def growth(speed: float) -> float:
        return float(max(running(speed).exponents.real))

    assert brentq(growth, *between, xtol=1e-14) == pytest.approx(published, rel=0, abs=3e-14)


# -- exactly, in symbols ---------------------------------------------------------------------------

UPRIGHT = {"phi": 0, "delta": 0, "theta": 0}


def number(expression: ph.Expr, values: dict[str, float]) -> float:
    """The value of an expression in which every symbol is given."""
    images = {symbol: values[symbol.published] for symbol in expression.symbols()}
    return float(expression.subs(images).ball(0).real.mid())


def test_the_linear_equations_in_all_parameters_have_the_published_eigenvalues():
    """B ẋ = A x with 25 symbols: kept in parts as a whole, the equations are short when upright."""
    (family,) = ph.steady(bicycle(), UPRIGHT)
    linear = ph.departures(family)
    state = ["phi", "delta", "phi_dot", "delta_dot"]
    names = {s.published: value for s, value in linear.names.items()}
    lean, steer = names["phi"].dt(), names["delta"].dt()
    assert names["phi_dot"] == lean
    rows = [row for row in linear.equations if row.diff(lean.dt()) or row.diff(steer.dt())]
    assert len(rows) == 2
    for speed in WEAVE:
        values = {**BENCHMARK, "omega_y_R": speed / BENCHMARK["r_R"]}
        mass = [[number(row.diff(x.dt()), values) for x in (lean, steer)] for row in rows]
        rest = [[number(row.diff(names[s]), values) for s in state] for row in rows]
        below = -np.linalg.solve(mass, rest)
        found = np.linalg.eigvals(np.vstack([np.eye(2, 4, 2), below]))
        published = [complex(*WEAVE[speed]), complex(*WEAVE[speed]).conjugate()]
        published += CAPSIZE_AND_CASTER[speed]
        assert np.sort_complex(found) == pytest.approx(np.sort_complex(published), rel=1e-11)


def test_the_exact_conditions_change_sign_at_the_weave_and_the_capsize_speed():
    (family,) = ph.steady(bicycle(), {**BENCHMARK, **UPRIGHT})
    found = ph.stability(family)

    def is_stable(speed: float) -> bool:
        values = {"omega_y_R": speed / BENCHMARK["r_R"]}
        return all(number(one.expression, values) > 0 for one in found.conditions)

    for threshold, changes in ((WEAVE_SPEED, 1), (CAPSIZE_SPEED, -1)):
        assert is_stable(threshold * (1 + changes * 1e-12))
        assert not is_stable(threshold * (1 - changes * 1e-12))


def test_conditions_that_would_fill_books_are_refused():
    (family,) = ph.steady(bicycle(), UPRIGHT)
    with pytest.raises(ph.NumericError, match="terms when written out"):
        str(ph.stability(family))
    with pytest.raises(ph.NumericError, match="in named parts; expected values"):
        ph.steady(bicycle())
