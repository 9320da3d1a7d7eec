"""Letters of a text bound to quantities of a model."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import chain

import pytest

import polhode as ph
from catalogue.systems import equations
from judge.transcript import document
from polhode.algebra import Expr, Vector, read_expression
from polhode.base import ParseError
from polhode.catalogue import PROBLEM_SET
from polhode.derive import Equations
from polhode.judge._notation import Notation, letter
from polhode.judge.document._document import Definition, Part
from polhode.judge.latex import read_latex, slash_readings
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import Name
from polhode.judge.meaning._bindings import Bound, bind
from polhode.judge.meaning._letters import phrases_by_letter
from polhode.judge.meaning._meaning import BindingError, Meaning
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.meaning._phrases import quantity


@cache
def notation(name: str) -> Notation:
    return Notation.of(equations(name))


def bound(name: str, latex: str) -> Bound:
    return notation(name).bound(read_latex(latex))


def value(name: str, latex: str) -> Meaning:
    return notation(name).value(letter(latex))


def expression(name: str, text: str) -> Expr:
    return read_expression(text, Mechanics(equations(name)).scalars)


def along(vector: Meaning, frame: str, name: str) -> list[str]:
    assert isinstance(vector, Vector)
    return [str(c) for c in vector.express(Mechanics(equations(name)).frame(frame)).components]


# -- the problem set --------------------------------------------------------------------------


@pytest.mark.parametrize("part", document().parts, ids=lambda part: part.id)
def test_every_claim_of_the_problem_set_binds(part: Part) -> None:
    shared = Notation.of_part(equations(part.system), part)
    for claim in document().claims:
        if claim.part == part.id:
            own = shared.of_claim(claim)
            found = own.bound(
                next(iter(slash_readings(claim.formula).values()))
            )  # the right dimensions
            asked = own.claimed(found)
            assert found.relations or found.is_definition
            assert all(asked.components(i) or found.defined for i in range(len(asked.branches)))


def test_read_as_is_used_only_for_what_cannot_be_bound_or_has_merged_fractions() -> None:
    merged = {"80", "81", "84", "85", "86", "w22", "w80", "w83"}
    for claim in document().claims:
        if claim.read_as and claim.id not in merged:
            part = document().part_of(claim)
            own = Notation.of_part(equations(part.system), part).of_claim(claim)
            with pytest.raises(ParseError):
                own.claimed(own.bound(read_latex(claim.latex))).components()


# -- letters ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("latex", "frame", "expected"),
    [
        (r"\boldsymbol{\omega}", "axes", ["theta_dot", "phi_dot*sin(theta)", "omega_3"]),
        (r"\omega_{(1,2,3)}", "axes", ["theta_dot", "phi_dot*sin(theta)", "phi_dot*cos(theta)"]),
        (r"\hat{\mathbf z}", "axes", ["0", "sin(theta)", "cos(theta)"]),
        (r"\frac{d\hat{\mathbf 2}}{dt}", "axes", ["-phi_dot*cos(theta)", "0", "theta_dot"]),
        (r"\mathbf F", "lab", ["F_x", "F_y", "F_z"]),
        (r"\mathbf g", "lab", ["0", "0", "-g"]),
        (
            r"\mathbf L",
            "axes",
            ["m*a**2*theta_dot/4", "m*a**2*phi_dot*sin(theta)/4", "m*a**2*omega_3/2"],
        ),
    ],
)
def test_vectors_of_a_rolling_disk(latex: str, frame: str, expected: list[str]) -> None:
    assert along(value("rolling-disk", latex), frame, "rolling-disk") == expected


@pytest.mark.parametrize(
    ("name", "latex", "expected"),
    [
        ("gyroscope", r"L_1", "I_1*omega_1"),
        ("gyroscope", r"\tau_z", "-a*F_phi*sin(theta)"),
        ("gyroscope", r"(\mathbf{L}_p)_2", "(I_2 + M*a**2)*theta_dot"),
        ("gyroscope", r"\mathbf{\tau}_p\cdot\hat{\boldsymbol{\phi}}", "M*g*a*sin(theta)"),
        ("gyroscope", r"V", "M*g*a*cos(theta)"),
        ("gyroscope/held", r"F'_\rho", "Fprime_rho"),
        ("spinning-coin", r"P_\psi", "m*a**2*(psi_dot + phi_dot*cos(theta))/2"),
        ("spinning-coin", r"\frac{\partial\mathcal{L}}{\partial\phi}", "0"),
        ("spinning-coin", r"\dot{\omega}_3", "omega_3_dot"),
        ("rolling-disk", r"I_3", "m*a**2/2"),
        ("marble-on-turntable", r"\omega_z", "omega_z"),
        ("tennis-racquet", r"|\mathbf{\omega}|^2", "omega_1**2 + omega_2**2 + omega_3**2"),
    ],
)
def test_scalars(name: str, latex: str, expected: str) -> None:
    assert value(name, latex) == expression(name, expected)


def test_a_letter_that_lost_its_boldness_is_still_a_vector() -> None:
    for latex in (r"\omega", r"\vec{\omega}", r"\mathbf{\omega}"):
        assert along(value("rolling-disk", latex), "axes", "rolling-disk")[2] == "omega_3"


def test_a_plain_letter_of_the_declaration_is_the_scalar() -> None:
    assert value("gyrocompass", r"\omega") == expression("gyrocompass", "omega")
    assert isinstance(value("gyrocompass", r"\boldsymbol{\omega}"), Vector)


def test_published_names_become_printed_letters() -> None:
    assert name_of("Fprime_rho") == Name("F", "rho", 1)
    assert name_of("lambda_") == Name("lambda")
    assert spelled(name_of("theta_ddot")) == "theta_ddot"
    assert spelled(letter(r"\hat{\mathbf 3}")) == "hat 3"


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_every_usual_letter_has_a_meaning(name: str) -> None:
    mechanics = Mechanics(equations(name))
    for phrase in chain.from_iterable(phrases_by_letter(mechanics).values()):
        quantity(mechanics, phrase)


@pytest.mark.parametrize(
    ("name", "phrase", "expected"),
    [
        ("gyroscope", "momentum conjugate to theta", "(I_2 + M*a**2)*theta_dot"),
        ("gyroscope/held", "least F_rho", "0"),
        ("gyroscope/held", "least Fprime_z", "M*g/2"),
        ("gyroscope", "moment of inertia 1", "I_1"),
        ("gyrocompass", "pi/2 - theta", "pi/2 - theta"),
    ],
)
def test_phrases_for_scalars(name: str, phrase: str, expected: str) -> None:
    assert quantity(Mechanics(equations(name)), phrase) == expression(name, expected)


@pytest.mark.parametrize(
    ("name", "phrase", "frame", "expected"),
    [
        ("rolling-disk", "arm of ground", "axes", ["0", "-a", "0"]),
        (
            "marble-on-turntable",
            "velocity of table",
            "lab",
            ["x_dot - a*omega_y", "y_dot + a*omega_x", "0"],
        ),
        ("gyroscope", "position of pivot", "lab", ["0", "0", "0"]),
        ("gyroscope", "angular velocity of cylindrical", "lab", ["0", "0", "phi_dot"]),
        ("gyroscope", "torque about pivot", "cylindrical", ["0", "M*g*a*sin(theta)", "0"]),
        (
            "gyrocompass",
            "angular momentum about cm relative to Earth",
            "axes",
            ["-I_1*theta_dot", "0", "I_3*omega"],
        ),
        (
            "marble-on-turntable/tilted",
            "uniform velocity",
            "slope",
            ["0", "0", "-m*g*a**2*sin(alpha)/(I*Omega)"],
        ),
        ("rolling-disk", "(x, y, 0) along lab", "lab", ["x", "y", "0"]),
        ("rolling-disk", "fixed vector of axes", "axes", ["c_1", "c_2", "c_3"]),
        ("tennis-racquet", "momentum", "lab", ["0", "0", "0"]),
    ],
)
def test_phrases_for_vectors(name: str, phrase: str, frame: str, expected: list[str]) -> None:
    assert along(quantity(Mechanics(equations(name)), phrase), frame, name) == expected


def test_the_radius_of_curvature_of_a_marble_on_its_circle() -> None:
    table = equations("marble-on-turntable")
    radius = quantity(Mechanics(table), "radius of curvature")
    assert isinstance(radius, Vector)
    velocity = Mechanics(table).velocity()
    factor = expression("marble-on-turntable", "(I + m*a**2)/(I*Omega)")
    axis = Mechanics(table).axis("z")
    left = radius - velocity.cross(axis) * factor
    assert not any(table.on_shell(table.on_shell(c.subs(rates(table)))) for c in left.components)


def rates(table: Equations) -> dict[Expr, Expr]:
    x, y = ph.coordinates("x y")
    return {q.dt().dt(): v.dt() for q, v in zip((x, y), ph.speeds("v_x v_y"), strict=True)}


def test_letters_of_several_bodies_are_those_of_the_whole() -> None:
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    lab = ph.Frame("lab")
    high, low = lab.rotated(alpha, "x"), lab.rotated(beta, "x")
    upper = ph.rod("upper", mass=m, length=l, axes=high, axis="z")
    lower = ph.rod("lower", mass=m, length=l, axes=low, axis="z", tag="low")
    shoulder = ph.Pivot(upper, at=high["z"] * (l / 2), name="shoulder")
    end = upper.point(high["z"] * (-l / 2))
    elbow = ph.Pivot(lower, at=low["z"] * (l / 2), to=end, name="elbow")
    pendulum = Notation.of(ph.derive(ph.System(shoulder, elbow, ph.Gravity(g), name="pendulum")))
    energy, momentum = pendulum.bound(
        read_latex(
            r"T = \frac{m l^2}{6}(4\dot\alpha^2 + \dot\beta^2"
            r" + 3\dot\alpha\dot\beta\cos(\alpha-\beta)), \quad \mathbf{P}\cdot\hat{\mathbf x} = 0"
        )
    ).relations
    assert energy.left == energy.right
    assert momentum.left == momentum.right


# -- statements -------------------------------------------------------------------------------


def test_a_chain_is_bound_member_by_member() -> None:
    found = bound("rolling-disk", r"F_z = mg = mg\cos\theta/\cos\theta \ge 0")
    assert [relation.sign for relation in found.relations] == ["=", "=", "≥"]
    assert found.relations[0].right == found.relations[1].left


def test_plus_or_minus_makes_two_branches() -> None:
    upper, lower = bound("rolling-disk", r"\dot\phi = 1 \pm 2 \mp 4").branches
    assert [branch[0].right for branch in (upper, lower)] == [Expr.of(-1), Expr.of(3)]


def test_a_new_letter_on_the_left_is_defined() -> None:
    found = bound("rolling-disk", r"\lambda = 2a")
    assert found.is_definition
    assert found.defined == {Name("lambda"): expression("rolling-disk", "2*a")}


def test_what_follows_a_definition_in_the_chain_is_a_claim() -> None:
    found = bound("rolling-disk", r"\lambda = 2a = a + a, \quad \lambda > a")
    assert not found.is_definition
    assert [relation.sign for relation in found.relations] == ["=", ">"]


def test_the_word_constant_means_that_the_rate_vanishes() -> None:
    (relation,) = bound("gyroscope", r"\omega_1 = \text{constant.}").relations
    assert (str(relation.left), relation.right) == ("omega_1_dot", 0)


def test_an_inverse_function_is_inverted() -> None:
    (relation,) = bound("gyroscope", r"\frac{1}{2}\tanh^{-1}\theta = t").relations
    assert relation.left == expression("gyroscope", "theta")
    assert relation.right == ph.tanh(2 * ph.time)


def test_differentials_over_dt_are_rates() -> None:
    (relation,) = bound("tennis-racquet", r"\frac{d\omega_2}{I_1} = I_2\,dt").relations
    assert relation.left == expression("tennis-racquet", "omega_2_dot/I_1")
    assert relation.right == expression("tennis-racquet", "I_2")


def test_values_named_in_words_are_distinguished() -> None:
    part = document().part("gyro-steady")
    own = Notation.of_part(equations(part.system), part)
    both = own.bound(read_latex(r"\omega_p \approx 1 \text{ (slow) or } 2 \text{ (fast)}"))
    slow, fast = both.relations
    assert slow.left == own.scalar(r"\omega_p(\text{slow})")
    assert fast.left == own.scalar(r"\omega_p(\text{fast})")
    assert slow.left != fast.left


def test_slow_and_fast_precession_are_the_roots_of_steady_motion() -> None:
    own = Notation.of_part(equations("gyroscope"), document().part("gyro-steady"))
    spin, mass = expression("gyroscope", "I_1*omega_1"), expression("gyroscope", "M*g*a")
    along_cos = expression("gyroscope", "(I_2 + M*a**2)*cos(theta)")
    for pace in ("slow", "fast"):
        rate = own.scalar(rf"\omega_p(\text{{{pace}}})")
        assert along_cos * rate**2 - spin * rate + mass == 0


def test_a_decimal_number_has_half_a_unit_of_its_last_digit() -> None:
    found = bound("rolling-disk", r"a \approx 0.75\,g")
    assert found.digits == {0: expression("rolling-disk", "g") * Fraction(1, 200)}


def test_components_in_a_bracket_are_along_the_stated_frame() -> None:
    own = notation("spinning-coin")
    for frame in ("axes", "body"):
        vector = own.binding({"components": frame}).value(letter(r"(0, 1, 0)"))
        assert along(vector, frame, "spinning-coin") == ["0", "1", "0"]


def test_roots_of_squares_use_the_signs_that_the_text_gives() -> None:
    own = notation("marble-on-turntable")
    assert str(own.scalar(r"\sqrt{\Omega^2}")) == "abs(Omega)"
    assert str(own.taking_positive([r"\Omega"]).scalar(r"\sqrt{\Omega^2}")) == "Omega"
    assert str(own.taking_positive([r"-\Omega"]).scalar(r"|\Omega|")) == "-Omega"


def test_restrictions_are_values_and_vanishing_expressions() -> None:
    own = notation("tennis-racquet").under(
        [r"\omega_1 = 0", r"2 I_2 T = \mathbf{L}\cdot\mathbf{L}"]
    )
    asked = own.claimed(own.bound(read_latex(r"\omega_2 = 0")))
    assert {s.published: value for s, value in asked.given.items()} == {"omega_1": 0}
    assert len(asked.relations) == 1


def test_definitions_may_use_earlier_ones() -> None:
    own = notation("gyroscope").defining(
        [Definition(r"I_{2p} = I_2 + Ma^2"), Definition(r"\kappa = I_{2p}/I_1")]
    )
    assert own.scalar(r"\kappa") == expression("gyroscope", "(I_2 + M*a**2)/I_1")


def test_a_correction_may_use_further_letters() -> None:
    asked = notation("gyroscope").read_claim(read_latex("c_9 = I_1"), {"c_9": Expr.of(3)})
    assert asked.members[0].left == Expr.of(3)


def test_all_letters_of_a_text_have_a_meaning() -> None:
    own = notation("gyroscope")
    assert {spelled(node) for node in own.names} >= {"theta", "phi_ddot", "omega_1", "I_2", "F_z"}
    for node in own.names:
        own.value(node)


# -- refusals ---------------------------------------------------------------------------------


def test_an_unknown_symbol_is_named_with_what_resembles_it() -> None:
    with pytest.raises(BindingError, match="omega_4, which has no meaning") as caught:
        bound("rolling-disk", r"\omega_3 = \omega_4")
    assert caught.value.symbol == "omega_4"
    assert "omega_3" in caught.value.near


@pytest.mark.parametrize(
    ("latex", "said"),
    [
        (r"\mathbf F + m = 0", "a vector + a scalar"),
        (r"\hat{\mathbf z}\times a = 0", "a vector × a scalar"),
        (r"\mathbf F\,\hat{\mathbf z} = 0", "a vector beside a vector"),
        (r"m/\mathbf F = 0", "a scalar over a vector"),
        (r"m = a/(g - g)", "a division by zero"),
        (r"m = a^{b}", "has no meaning"),
        (r"m = a^{g}", "exponent"),
        (r"m = a^{1000}", "exponent"),
        (r"m = \ln a + 1", "the function ln"),
        (r"m = (a, a)", "2 entries"),
        (r"m = \sqrt[3]{a}", "square root"),
        (r"\mathbf I = 0", "tensor"),
    ],
)
def test_kinds_that_do_not_go_together_are_refused(latex: str, said: str) -> None:
    with pytest.raises(BindingError) as caught:
        bound("rolling-disk", latex)
    assert said in str(caught.value)


@pytest.mark.parametrize("latex", [r"m = 3", r"\theta = 1", r"F_z = mg"])
def test_a_letter_of_the_declaration_is_not_redefined(latex: str) -> None:
    with pytest.raises(ParseError, match="has already"):
        notation("rolling-disk").defining([Definition(latex)])


@pytest.mark.parametrize(
    "phrase", ["axis 7", "force of table", "frame", "kinetik energy", "(a, a) along lab"]
)
def test_a_phrase_that_names_nothing_is_refused(phrase: str) -> None:
    with pytest.raises(BindingError):
        quantity(Mechanics(equations("rolling-disk")), phrase)


@pytest.mark.parametrize("latex", ["a b = c", "a > 1, b = 2", ""])
def test_a_letter_is_one_quantity(latex: str) -> None:
    with pytest.raises(ParseError):
        letter(latex)


def test_a_condition_other_than_an_equality_is_refused() -> None:
    own = notation("rolling-disk").under([r"\omega_3 > 0"])
    with pytest.raises(BindingError, match="the condition with >"):
        own.claimed(own.bound(read_latex(r"F_z = mg")))


def test_binding_twice_says_the_same() -> None:
    statement = read_latex(r"\mathbf F - mg\hat{\mathbf z} = m\frac{d\mathbf v_{\rm cm}}{dt}")
    first, second = (bind(statement, notation("rolling-disk").vocabulary) for _ in range(2))
    assert first == second


def test_a_component_of_a_vector_of_the_text_overrides_that_of_the_model() -> None:
    own = notation("gyrocompass")
    assert str(own.scalar(r"\tau_2")) == "tau_2"
    redefined = own.binding({r"\boldsymbol{\tau}": "Coriolis torque in Earth"})
    assert redefined.scalar(r"\tau_2") != own.scalar(r"\tau_2")


def test_a_length_named_like_its_vector_leaves_the_vector_alone() -> None:
    own = notation("marble-on-turntable").defining([Definition(r"v = |\mathbf{v}|")])
    assert isinstance(own.value(letter(r"\mathbf{v}")), Vector)
    assert isinstance(own.value(letter("v")), Expr)
