"""`exact`: documents, agreement with the simulation, and exit codes."""

import pytest

from cli.shapes import MADE_WITH, misshapen

NUMBER_OR_NOTHING = (float, type(None))
EXACT = MADE_WITH | {
    "system": str,
    "closed_form": str,
    "kind": str,
    "latex": str,
    "duration": float,
    "parameters": {str: float},
    "start": {str: float},
    "assumed": {str: float},
    "quantities": {str: {"final": float, "difference": float}},
    "max_difference": float,
    "period": NUMBER_OR_NOTHING,
    "conditioning": {"data": NUMBER_OR_NOTHING, "steps": NUMBER_OR_NOTHING},
    "figures": {str: float},
    "drift": {"energy": float, "constraint": float, "invariants": {str: float}},
}

SYSTEMS = {
    "spinning-coin": ("spinning coin", "nutation"),
    "marble-on-turntable": ("circling", "circle"),
    "marble-on-turntable/tilted": ("circling", "circle with drift"),
    "gyrocompass": ("gyrocompass", "swing"),
    "gyrocompass/motor": ("gyrocompass", "swing"),
    "tennis-racquet": ("free body", "about axis 3"),
    "gyroscope": ("symmetric top", "cusps"),
    "gyroscope/vertical-plane": ("pendulum", "swing"),
}


@pytest.mark.parametrize(("name", "expected"), SYSTEMS.items())
def test_every_system_agrees_with_its_simulation(document, name, expected):
    found = document("exact", name, "--duration", "1s")
    assert list(misshapen(found, EXACT)) == []
    assert (found["closed_form"], found["kind"]) == expected
    rounding = 1e-14 * (1 + found["conditioning"]["data"] + found["conditioning"]["steps"])
    assert found["max_difference"] < 100 * rounding
    assert found["drift"]["energy"] < 1e-12


def test_a_start_is_taken_exactly(document):
    """√3 is no double: on the separatrix only if it is kept as a root."""
    moments = [word for i in (1, 2, 3) for word in ("--set", f"I_{i}={i}")]
    start = ["--start", "omega_1=sqrt(3)", "--start", "omega_2=1", "--start", "omega_3=1"]
    found = document("exact", "tennis-racquet", *moments, *start, "--duration", "1s")
    assert found["kind"] == "separatrix"
    assert found["period"] is None
    assert found["conditioning"] == {"data": None, "steps": None}
    assert found["max_difference"] < 1e-13


def test_the_text_output(polhode):
    code, out, err = polhode("exact", "gyrocompass", "--duration", "30s")
    assert (code, err) == (0, "")
    assert "closed form   gyrocompass, swing" in out
    assert "period        33.795125" in out
    assert "first_order_period" in out


REFUSED = {
    ("rolling-disk",): "rolling-disk has no closed form that is known here",
    ("gyroscope/held",): "gyroscope/held has no closed form that is known here",
    ("gyroscope", "--start", "theta=0", "--start", "omega_1=9"): "a sleeping top",
    ("gyroscope", "--start", "theta=1", "--start", "theta_dot=1"): "passes through the vertical",
    ("marble-on-turntable", "--set", "Omega=0"): "the marble does not circle",
    ("spinning-coin", "--start", "theta=1"): "a coin that falls flat on the table",
    ("spinning-coin", "--set", "b=1"): "'b' is no parameter of spinning-coin",
    ("gyroscope", "--start", "theta=3kg"): "theta",
    ("gyroscop",): "did you mean gyroscope",
}


@pytest.mark.parametrize(("words", "message"), REFUSED.items())
def test_refusals(polhode, words, message):
    code, out, err = polhode("exact", *words, "--duration", "1s", "--json")
    assert (code, out) == (2, "")
    assert message in err
    assert "Traceback" not in err
