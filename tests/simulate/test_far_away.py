"""Motion far from the origin: distances between bodies keep their digits."""

import numpy as np
import pytest

import polhode as ph
from literature.published_forms import FORMS, k, l, m
from polhode.algebra import symbols

(M,) = symbols("M", positive=True)
pair = FORMS["two masses on a spring"].build()
VALUES = {M: 1, m: 1, k: 5, l: 0.8}


def _apart(run):
    return run.final["x_2"] - run.final["x_1"], run.final["y_2"] - run.final["y_1"]


def _start(away):
    return {"x_1": away, "x_2": away + 1.0, "v_y_1": -0.6, "v_y_2": 0.6}


@pytest.fixture(scope="module")
def exact():
    """At the origin, to forty digits; the relative motion is the same everywhere."""
    run = ph.simulate(pair, VALUES | {l: "0.8"}, _start(0) | {"x_2": 1}, 20, precision=40)
    return tuple(map(float, _apart(run)))


@pytest.mark.parametrize("integrator", ["heyoka", "kernel"])
@pytest.mark.parametrize("away", [1.0, 1e3, 1e5, 1e7])
@pytest.mark.filterwarnings("ignore::polhode.DriftWarning")
def test_it_does_not_depend_on_the_place(away, integrator, exact, monkeypatch):
    """Within what the roundings of the place cost; by hand SciPy is off by 140 of them."""
    monkeypatch.setenv("POLHODE_INTEGRATOR", integrator)
    found = _apart(ph.simulate(pair, VALUES, _start(away), 20.0))
    assert found == pytest.approx(exact, abs=100 * np.spacing(away) + 1e-13)


@pytest.mark.parametrize("away", [0.0, 1e5])
def test_ensembles_keep_the_digits_too(away, exact):
    outputs = ["x_1", "x_2"]
    found = ph.ensemble(pair, VALUES | {k: [5.0, 4.0, 5.0]}, _start(away), 20.0, outputs=outputs)
    apart = found["x_2"] - found["x_1"]
    assert apart[0] == apart[2] == pytest.approx(exact[0], abs=100 * np.spacing(away) + 1e-13)


def test_satellites_metres_apart_keep_their_distance():
    """Two of the same mass, tied by a spring, on one orbit of the Earth; against many digits."""
    earth = 3.986e14
    (strength,) = symbols("kappa", positive=True)
    lab = pair.bodies[0].axes
    between = ph.symbol("s", positive=True)
    bodies = pair.bodies
    pulls = [
        ph.CentralForce(b.point(), lab.zero, energy=-strength / between, distance=between, name=n)
        for b, n in zip(bodies, ("first", "second"), strict=True)
    ]
    plane = [ph.Pivot(b, only="z", name=f"plane {b.tag}", force=f"P{b.tag}") for b in bodies]
    spring = ph.Spring(bodies[0].point(), bodies[1].point(), stiffness=k, length=l)
    system = ph.System(*plane, spring, *pulls)
    values = VALUES | {strength: earth, k: 0.001, l: 4}
    start = {"x_1": 6.8e6, "x_2": 6.8e6 + 4, "v_y_1": 7656.0, "v_y_2": 7656.0}
    found = _apart(ph.simulate(system, values, start, 600.0))
    fine = _apart(ph.simulate(system, values, start, 600.0, precision=30))
    assert found == pytest.approx(tuple(map(float, fine)), abs=1e-6)
