"""Slips that are planted: of all kinds, false, and with one correction."""

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.exercise import Builder
from polhode.exercise._slips import slips
from polhode.judge import Answer


@pytest.mark.parametrize(
    ("kind", "text", "slipped"),
    [
        ("sign", "a + b = 0", "a - b = 0"),
        ("sign", r"x = \left(I_1 - I_3\right) y", r"x = \left(I_1 + I_3\right) y"),
        ("factor", "2 a = b", "a = b"),
        ("factor", "5 a = b", "4 a = b"),
        ("factor", "c + a = b", "c + 2 a = b"),
        ("function", r"a \sin\theta = b", r"a \cos\theta = b"),
        ("power", r"a \sin^2\theta = b", r"a \sin\theta = b"),
        ("index", "I_1 a = I_3 b", "I_3 a = I_3 b"),
        ("index", r"\omega_1 = 0", r"\omega_2 = 0"),
        ("term", "a - b + c = 0", "a + c = 0"),
    ],
)
def test_kinds_of_slips(kind, text, slipped):
    assert (kind, slipped) in {(s.kind, s.text) for s in slips(text, [r"\omega_2"])}


def swing():
    m, l, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "y", labels="1 2 3", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    return ph.System(ph.Pivot(bob, at=axes["3"] * -l), ph.Gravity(g), name="swing")


def test_planted_slips_are_of_many_kinds_and_quantities():
    builder = Builder.of(CatalogueEntry.bare("swing", "swing", swing()))
    kinds, sides = set(), set()
    for seed in range(1, 9):
        (question,) = builder.exercise(seed, kinds=["wrong"]).questions
        wrong = next(iter(question.answers[0].right))
        text = question.options["abcd".index(wrong)].strip("$")
        right = question.worked[0].latex
        assert ph.check(text, builder.subject.equations).answer is Answer.FAILS
        kinds |= {s.kind for s in slips(right) if s.text == text}
        sides.add(right.split(" = ")[0])
    assert len(kinds) >= 4
    assert len(sides) >= 3


def test_no_other_slip_back_makes_a_planted_equation_true():
    builder = Builder.of(CATALOGUE["gyroscope/vertical-plane"])
    (question,) = builder.exercise(2, kinds=["wrong"]).questions
    wrong = next(iter(question.answers[0].right))
    text = question.options["abcd".index(wrong)].strip("$")
    true = [
        s.text
        for s in slips(text)
        if ph.check(s.text, builder.subject.equations).answer is Answer.HOLDS
    ]
    assert set(true) <= {question.worked[0].latex}


def test_own_systems_are_asked_about_all_that_they_have():
    """Two bodies and a rope: velocities, a tension, a wrong equation, a conserved energy."""
    m1, m2, R, I, g = ph.symbols("m_1 m_2 R I g", positive=True)
    lab = ph.Frame("lab")
    wheel = lab.rotated(ph.coordinate("theta"), "y")
    pulley = ph.Body("pulley", mass=m1, inertia=(I, I, I), axes=wheel, tag="p")
    weight = ph.point_mass("weight", mass=m2, axes=lab, tag="w")
    system = ph.System(
        ph.Pivot(pulley, name="axle"),
        ph.Hinge(pulley, axis="y"),
        ph.Rope([weight.point(), pulley.point(lab["x"] * R)], directions=[lab["z"]], name="rope"),
        ph.Pivot(weight, to=lab["x"] * R, only="x y", name="guide"),
        ph.Gravity(g),
        name="wheel and weight",
    )
    builder = Builder.of(CatalogueEntry.bare("wheel", "wheel", system))
    assert set(builder.offered()) == {
        "freedom", "velocities", "motion", "conserved", "reaction", "wrong",
    }  # fmt: skip
    made = builder.exercise(1, kinds=["reaction"])
    formula, number = made.answers.values()
    v = {k: float(text.split()[0]) for k, text in made.texts.items()}
    # a falling weight on a wheel: S = m g I/(I + m R²)
    expected = v["m_2"] * v["g"] * v["I"] / (v["I"] + v["m_2"] * v["R"] ** 2)
    if "S" in formula.asked:
        assert number.values[0] == pytest.approx(expected, rel=1e-9)
