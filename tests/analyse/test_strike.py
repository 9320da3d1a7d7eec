"""Blows: centre of percussion, a struck ball, and bodies that hang together."""

import numpy as np
import pytest

import polhode as ph

m, l, x, P, g, a, h = ph.symbols("m l x P g a h", positive=True)
LAB = ph.Frame("lab")
theta, phi = ph.coordinates("theta phi")


def hinged_rod() -> tuple[ph.Equations, ph.Body, ph.Frame]:
    axes = LAB.rotated(theta, "z")
    rod = ph.rod("rod", mass=m, length=l, axes=axes)
    hinge = ph.Hinge(rod, axis="z")
    return ph.derive(ph.System(ph.Pivot(rod, at=axes["x"] * (-l / 2)), hinge)), rod, axes


def test_a_rod_struck_at_two_thirds_does_not_push_its_pivot() -> None:
    """Impulse of the pivot P (3x/2l - 1) across the rod, and ω = 3 P x/(m l²)."""
    equations, rod, axes = hinged_rod()
    blow = ph.strike(equations, rod.point(axes["x"] * (x - l / 2)), axes["y"] * P)
    assert blow.changes[theta.dt().symbol] == 3 * P * x / (m * l**2)
    pushed = P * (3 * x / (2 * l) - 1)
    assert blow.reactions["F_x"] == -pushed * ph.sin(theta)
    assert blow.reactions["F_y"] == pushed * ph.cos(theta)
    assert all(not value.subs({x: 2 * l / 3}) for value in blow.reactions.values())


@pytest.mark.parametrize("contact", [ph.Smooth, ph.Rolling])
def test_a_ball_struck_seven_fifths_of_its_radius_above_the_table_rolls(contact: type) -> None:
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    equations = ph.derive(ph.System(contact(ball, on=ph.Plane(LAB)), ph.Gravity(g)))
    blow = ph.strike(equations, ball.point(LAB["z"] * h), LAB["x"] * P)
    right = {h: 2 * a / 5}
    changes = {symbol.published: value.subs(right) for symbol, value in blow.changes.items()}
    assert changes["v_x"] == P / m == changes["omega_y"] * a
    if contact is ph.Rolling:
        assert blow.reactions["F_x"] == P * (5 * h - 2 * a) / (7 * a)


def double_pendulum() -> tuple[ph.Equations, ph.Body, ph.Frame]:
    upper, lower = LAB.rotated(theta, "z"), LAB.rotated(phi, "z")
    one = ph.rod("one", mass=m, length=l, axes=upper)
    two = ph.rod("two", mass=2 * m, length=l, axes=lower, tag="2")
    half = upper["x"] * (l / 2)
    joint = ph.Pivot(two, at=lower["x"] * (-l / 2), to=one.point(half), name="joint", force="G")
    hinges = ph.Hinge(one, axis="z"), ph.Hinge(two, axis="z", name="hinge 2", torque="sigma")
    system = ph.System(ph.Pivot(one, at=-half), *hinges, joint, ph.Gravity(g, up=LAB["x"]))
    return ph.derive(system), two, lower


def test_the_work_is_what_the_energy_rises_by() -> None:
    equations, body, axes = double_pendulum()
    blow = ph.strike(equations, body.point(axes["x"] * (l / 3)), axes["y"] * P)
    energy = equations.kinetic_energy
    after = {u: type(energy).generator(u) + blow.changes[u] for u in equations.speeds}
    assert not energy.subs(after) - energy - blow.work


def test_it_is_the_limit_of_a_short_force() -> None:
    """Speeds after 1e-6 s of a force with the same impulse, and the mean of its reaction."""
    equations, body, axes = double_pendulum()
    blow = ph.strike(equations, body.point(axes["x"] * (l / 3)), axes["y"] * P)
    numbers = {"m": 0.3, "l": 0.7, "g": 9.81, "P": 0.2}
    start = {"theta": 0.4, "phi": 1.1}
    short = 1e-6
    push = ph.Force(body.point(axes["x"] * (l / 3)), axes["y"] * (P / ph.symbol("T")), name="push")
    pushed = ph.System(*equations.system.elements, *equations.system.loads, push)
    run = ph.simulate(pushed, numbers | {"T": short}, start, short)
    names = ("theta_dot", "phi_dot")
    known = {ph.symbol(n): v for n, v in numbers.items()}
    known |= {ph.coordinate(n): v for n, v in start.items()}

    def number(value: ph.Expr) -> float:
        given = {s: known[k] for k in known for s in [k.symbol]}
        program = ph.compile_program([value], tuple(given)).function()
        return float(program(*given.values())[0])

    changes = {s.published: value for s, value in blow.changes.items()}
    for name in names:
        assert run.final[name] == pytest.approx(number(changes[name]), rel=1e-4)
    for name in ("F_x", "F_y", "G_x_2", "G_y_2"):
        mean = float(np.mean(run.evaluate(name, np.linspace(0, short, 3)))) * short
        assert mean == pytest.approx(number(blow.reactions[name]), rel=1e-4, abs=2e-5)


def test_what_a_blow_cannot_say() -> None:
    equations, rod, axes = hinged_rod()
    stranger = ph.rod("other", mass=m, length=l, axes=axes)
    with pytest.raises(ph.DeclarationError, match="not in"):
        ph.strike(equations, stranger.point(axes.zero), axes["y"] * P)
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    rubs = ph.derive(ph.System(ph.Coulomb(ball, on=ph.Plane(LAB), mu=h), ph.Gravity(g)))
    with pytest.raises(ph.DeclarationError, match="impulse of friction"):
        ph.strike(rubs, ball.point(LAB.zero), LAB["x"] * P)
    text = str(ph.strike(equations, rod.point(axes.zero), axes["y"] * P))
    assert "Δθ̇ = 3 P/(2 m l)" in text
