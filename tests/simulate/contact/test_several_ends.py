"""Slips that end within one step of the integrator: in straight lines a step is as long as it can.

Decelerations are μ g, so that each ends at v/(μ g), wherever the steps are.
"""

import pytest

import polhode as ph

m, g = ph.symbols("m g")
LAB = ph.Frame("lab")
COEFFICIENTS, SPEEDS = (0.1, 0.2, 0.15), (2.0, 1.0, 1.2)


def block(k: int, mu: float) -> ph.Coulomb:
    body = ph.point_mass(f"block {k}", mass=m, axes=LAB, tag=str(k))
    return ph.Coulomb(body, on=ph.Plane(LAB), mu=mu)


@pytest.mark.parametrize("precision", [None, 30])
def test_blocks_that_know_nothing_of_each_other_stop_in_their_order(precision: int | None) -> None:
    blocks = [block(k, mu) for k, mu in enumerate(COEFFICIENTS, 1)]
    start = {f"v_x_{k}": v for k, v in enumerate(SPEEDS, 1)}
    system = ph.System(*blocks, ph.Gravity(g))
    run = ph.simulate(system, {m: 1, g: 9.81}, start, 10, precision=precision)
    ends = sorted(v / (mu * 9.81) for v, mu in zip(SPEEDS, COEFFICIENTS, strict=True))
    found = [float(event.time) for event in run.events if event.kind == "sticks"]
    assert found == pytest.approx(ends, rel=1e-14)
    for k, (v, mu) in enumerate(zip(SPEEDS, COEFFICIENTS, strict=True), 1):
        assert float(run.final[f"x_{k}"]) == pytest.approx(v**2 / (2 * mu * 9.81), rel=1e-14)
