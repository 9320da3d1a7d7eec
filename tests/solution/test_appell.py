"""The energy of acceleration, against one that is summed by hand over the masses."""

import pytest
import sympy as sp

import polhode as ph
from polhode.algebra import to_sympy
from polhode.catalogue import PROBLEM_SET
from polhode.solution._appell import _energy_of_acceleration
from polhode.solution._setting import setting_of
from solution import own_systems


def symbols(names):
    return sp.symbols(names)


def energy(system):
    return to_sympy(_energy_of_acceleration(setting_of(ph.derive(system))))


def without_constants(expression, accelerations):
    return sp.expand(expression - expression.subs(dict.fromkeys(accelerations, 0)))


def test_the_sleigh():
    """S = m (v̇ - a ω²)²/2 + m (a ω̇ + v ω)²/2 + I ω̇²/2."""
    m, a, I, v, w, dv, dw = symbols("m a I v omega v_dot omega_dot")
    by_hand = m * ((dv - a * w**2) ** 2 + (a * dw + v * w) ** 2) / 2 + I * dw**2 / 2
    assert (
        sp.expand(energy(own_systems.chaplygin_sleigh()) - without_constants(by_hand, (dv, dw)))
        == 0
    )


def test_the_rolling_disk_as_four_masses_at_its_rim():
    """Masses m/2, of which two lie at ± a√(1/2) along each axis of the disk, have its inertia.

    Their accelerations are taken by SymPy from their places, with the spin at its zero.
    """
    t = sp.Symbol("t")
    m, a = symbols("m a")
    theta, phi, psi = (sp.Function(n)(t) for n in ("theta", "phi", "psi"))
    R = sp.Matrix(
        [[sp.cos(phi), -sp.sin(phi), 0], [sp.sin(phi), sp.cos(phi), 0], [0, 0, 1]]
    ) * sp.Matrix(
        [[1, 0, 0], [0, sp.cos(theta), -sp.sin(theta)], [0, sp.sin(theta), sp.cos(theta)]]
    )
    spin = sp.Matrix([[sp.cos(psi), -sp.sin(psi), 0], [sp.sin(psi), sp.cos(psi), 0], [0, 0, 1]])
    omega_3 = psi.diff(t) + phi.diff(t) * sp.cos(theta)
    velocity = R * sp.Matrix([-a * omega_3, 0, a * theta.diff(t)])
    acceleration = velocity.diff(t)
    arms = [sp.Matrix(p) * a / sp.sqrt(2) for p in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
    total = sum(
        m
        / 8
        * (acceleration + (R * spin * arm).diff(t, 2)).dot(
            acceleration + (R * spin * arm).diff(t, 2)
        )
        for arm in arms
    )
    numbers = {"theta": 1.1, "phi": 0.4, "theta_dot": 0.7, "phi_dot": -1.3, "omega_3": 2.2}
    bends = {"theta_ddot": 0.9, "phi_ddot": 1.7, "omega_3_dot": -0.6, "m": 1.4, "a": 0.8}

    def by_hand(values):
        c, s = sp.cos(values["theta"]), sp.sin(values["theta"])
        psi_dot = values["omega_3"] - values["phi_dot"] * c
        psi_ddot = (
            values["omega_3_dot"]
            - values["phi_ddot"] * c
            + values["phi_dot"] * values["theta_dot"] * s
        )
        rates = {
            psi.diff(t, 2): psi_ddot,
            phi.diff(t, 2): values["phi_ddot"],
            theta.diff(t, 2): values["theta_ddot"],
        }
        speeds = {
            psi.diff(t): psi_dot,
            phi.diff(t): values["phi_dot"],
            theta.diff(t): values["theta_dot"],
        }
        places = {
            psi: 0.3,
            phi: values["phi"],
            theta: values["theta"],
            m: values["m"],
            a: values["a"],
        }
        return float(total.subs(rates).subs(speeds).subs(places))

    resting = {**numbers, **bends, "theta_ddot": 0.0, "phi_ddot": 0.0, "omega_3_dot": 0.0}
    found = energy(PROBLEM_SET["rolling-disk"].build())
    value = float(found.subs({sp.Symbol(k): x for k, x in {**numbers, **bends}.items()}))
    assert value == pytest.approx(by_hand({**numbers, **bends}) - by_hand(resting))


@pytest.mark.parametrize("name", ["rolling-disk", "gyroscope"])
def test_appells_equations_are_those_of_motion(name):
    found = ph.solution(PROBLEM_SET[name].build(), "appell")
    shown = [step.latex for step in found.sections["Gibbs's and Appell's equations"] if step.latex]
    assert shown[0].startswith("S = ")
    assert len(shown) == 1 + len(ph.derive(PROBLEM_SET[name].build()).speeds)
    assert all(step.verdict.holds for step in found.steps if step.latex in shown)


def test_a_spring_is_not_covered():
    with pytest.raises(ph.ConstraintError, match="no load but gravity"):
        ph.solution(own_systems.two_on_a_spring(), "appell")
