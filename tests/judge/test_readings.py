"""What the letters of a claim are taken to mean, and the verdict where several are usual."""

from __future__ import annotations

from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from catalogue.systems import equations
from judge.judged import uncorrected
from polhode.base import ParseError
from polhode.catalogue import PROBLEM_SET
from polhode.derive import Equations
from polhode.judge import Answer
from polhode.judge.meaning import _letters as letters
from polhode.judge.meaning import _vocabulary as vocabulary


@cache
def heavy_top(sequence: str = "zxz", *, about_pivot: bool = True) -> Equations:
    """The top of docs/checking.md, its angles about the axes that the sequence names."""
    mu, l, g, I_1, I_3 = ph.symbols("mu l g I_1 I_3", positive=True)
    axes = ph.Frame("lab")
    for angle, axis in zip(ph.coordinates("phi theta psi"), sequence, strict=True):
        axes = axes.rotated(angle, axis)
    axes = axes.rotated(0, "z", labels="1 2 3")
    body = ph.Body("top", mass=mu, inertia=(I_1, I_1, I_3), axes=axes)
    held = ph.Pivot(body, at=axes["3"] * -l) if about_pivot else ph.Pivot(body)
    return ph.derive(ph.System(held, ph.Gravity(g), name="top"))


def swinging_rod() -> Equations:
    """A pendulum whose string force is declared along the string."""
    m, l, g = ph.symbols("m l g", positive=True)
    turned = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    bob = ph.point_mass("bob", mass=m, axes=turned)
    string = ph.Pivot(bob, at=turned["z"] * l, name="string", along=turned)
    return ph.derive(ph.System(string, ph.Gravity(g), name="pendulum"))


# --- unit vectors ---


@pytest.mark.parametrize(
    "latex",
    [
        r"\omega_z = \omega_3",
        r"L_z = I_3\omega_3",
        r"\hat{\mathbf z} = \hat{\mathbf 3}",
        r"\hat{\mathbf z}\cdot\hat{\mathbf 3} = 1",
        r"(\boldsymbol\omega)_z = \omega_3",
        r"\hat{\mathbf x}\cdot\hat{\mathbf 3} = 0",
    ],
)
def test_directions_are_not_those_of_an_intermediate_frame(latex: str) -> None:
    """The frames that the Euler angles pass through keep the labels x y z."""
    assert uncorrected(latex, equations("tennis-racquet")).answer is Answer.FAILS


def test_an_axis_of_a_slope_is_one_although_no_body_has_it() -> None:
    """A ball with axes of the laboratory on a slope: v has no component along the normal."""
    m, g, alpha = ph.symbols("m g alpha", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=ph.symbol("R", positive=True), axes=lab)
    rolling = ph.Rolling(ball, on=ph.Plane(lab, tilt=-alpha), name="ground")
    model = ph.derive(ph.System(rolling, ph.Gravity(g), name="ball"))
    verdict = uncorrected("v_z = 0", model)
    assert verdict.answer is Answer.AMBIGUOUS
    assert "holds if z is axis z of slope" in verdict.reason
    # The declaration has F_z along that normal; the vertical component is another reading.
    assert uncorrected(r"F_z = mg\cos\alpha", model).answer is Answer.HOLDS
    vertical = uncorrected(r"F_z = mg(\cos^2\alpha + \frac27\sin^2\alpha)", model)
    assert vertical.answer is Answer.AMBIGUOUS
    chosen = "F_z = force of ground along axis z of lab"
    assert uncorrected(r"F_z = mg\cos\alpha", model, read=[chosen]).answer is Answer.FAILS


def test_slopes_of_one_name_are_told_apart_by_their_contacts() -> None:
    lab, g, alpha, beta = ph.Frame("lab"), *ph.symbols("g alpha beta", positive=True)
    m, R = ph.symbols("m R", positive=True)
    one, two = (ph.sphere(f"ball {i}", mass=m, radius=R, axes=lab, tag=i) for i in "12")
    left = ph.Rolling(one, on=ph.Plane(lab, tilt=-alpha), name="left")
    right = ph.Rolling(two, on=ph.Plane(lab, tilt=-beta), name="right")
    model = ph.derive(ph.System(left, right, ph.Gravity(g), name="two balls"))
    latex = r"\mathbf g\cdot\hat{\mathbf z} = -g\cos\beta"
    verdict = uncorrected(latex, model)
    assert "holds if z is axis z of right" in verdict.reason
    assert uncorrected(latex, model, read=["z = axis z of right"]).answer is Answer.HOLDS


@pytest.mark.parametrize(
    "latex",
    [
        r"\omega_z = \dot\phi + \dot\psi\cos\theta",  # Goldstein, exercise 4.15
        r"\omega_x = \dot\theta\cos\phi + \dot\psi\sin\theta\sin\phi",
        r"\omega_y = \dot\theta\sin\phi - \dot\psi\sin\theta\cos\phi",
        r"\mathbf g = -g\hat{\mathbf z}",
        r"L_{p,z} = (I_1+\mu l^2)\dot\phi\sin^2\theta + I_3(\dot\psi+\dot\phi\cos\theta)\cos\theta",
        r"\hat{\mathbf z} = \sin\theta(\sin\psi\,\hat{\mathbf 1} + \cos\psi\,\hat{\mathbf 2})"
        r" + \cos\theta\,\hat{\mathbf 3}",
    ],
)
def test_components_along_the_vertical_as_in_textbooks(latex: str) -> None:
    assert ph.check(latex, heavy_top(), context="identity").answer is Answer.HOLDS


def test_the_angular_momentum_of_a_free_body_is_conserved_along_every_direction_at_rest() -> None:
    for axis in "xyz":
        verdict = ph.check(rf"L_{axis} = \text{{const}}", equations("tennis-racquet"))
        assert verdict.answer is Answer.HOLDS


@given(st.permutations("xyz"), st.sampled_from("xyz"))
def test_a_direction_at_rest_whatever_angles_the_body_has(sequence: list[str], axis: str) -> None:
    """ẑ·ẑ' of the fixed axes has no angle in it, so its rate vanishes identically."""
    body = heavy_top("".join(sequence))
    latex = rf"\frac{{d\hat{{\mathbf {axis}}}}}{{dt}} = 0"
    assert ph.check(latex, body, context="identity", seconds=None).answer is Answer.HOLDS


# --- about which point ---


def test_a_moment_may_be_about_the_centre_of_mass_or_the_fixed_point() -> None:
    verdict = ph.check(r"\dot L_z = 0", equations("gyroscope"))
    assert verdict.answer is Answer.AMBIGUOUS
    assert "fails if L is angular momentum about cm" in verdict.reason
    assert "holds if L is angular momentum about pivot" in verdict.reason
    assert "'L = angular momentum about pivot'" in verdict.reason
    assert verdict.option == "read"


@pytest.mark.parametrize(
    ("read", "expected"),
    [("L = about pivot", Answer.HOLDS), (r"\mathbf L = about cm", Answer.FAILS)],
)
def test_a_reading_can_be_chosen(read: str, expected: Answer) -> None:
    verdict = uncorrected(r"\dot L_z = 0", equations("gyroscope"), read=[read])
    assert verdict.answer is expected
    assert {r.letter for r in verdict.readings} == {r"\mathbf{L}", r"\hat{\mathbf{z}}"}


@pytest.mark.parametrize(
    ("read", "complaint"),
    [
        ("L = about the moon", "angular momentum about pivot"),
        ("q = about pivot", "a letter of several meanings"),
        ("L", "one = between"),
    ],
)
def test_an_unknown_reading_is_refused(read: str, complaint: str) -> None:
    with pytest.raises(ParseError, match=complaint):
        ph.check(r"\dot L_z = 0", equations("gyroscope"), read=[read])


def test_where_all_readings_agree_the_verdict_stands() -> None:
    assert ph.check(r"L_1 = I_1\omega_1", equations("gyroscope")).answer is Answer.HOLDS
    assert uncorrected(r"L_1 = 2I_1\omega_1", equations("gyroscope")).answer is Answer.FAILS


def test_moments_of_one_statement_are_about_one_point() -> None:
    latex = r"\frac{d\mathbf L}{dt} = \boldsymbol\tau"
    assert ph.check(latex, equations("gyroscope")).answer is Answer.HOLDS


def test_a_pivot_at_the_centre_of_mass_is_unambiguous() -> None:
    body = heavy_top(about_pivot=False)
    assert ph.check(r"\dot{\mathbf L} = 0", body).answer is Answer.HOLDS


def test_what_goes_with_a_claim_is_read_the_same_way() -> None:
    verdict = ph.check(r"\dot b = 0", equations("gyroscope"), let=["b = L_z/I_1"])
    assert verdict.answer is Answer.AMBIGUOUS
    chosen = ph.check(
        r"\dot b = 0", equations("gyroscope"), let=["b = L_z/I_1"], read=["L = about pivot"]
    )
    assert chosen.answer is Answer.HOLDS


# --- of which body, along which axis ---


def test_a_letter_of_several_bodies_is_that_of_any() -> None:
    lab = ph.Frame("lab")
    m, l, g = ph.symbols("m l g", positive=True)
    one, two = (lab.rotated(-angle, "y") for angle in ph.coordinates("alpha beta"))
    upper = ph.point_mass("upper", mass=m, axes=one, tag="1")
    lower = ph.point_mass("lower", mass=m, axes=two, tag="2")
    pendulum = ph.derive(
        ph.System(
            ph.Pivot(upper, at=one["z"] * l, name="shoulder"),
            ph.Pivot(lower, at=two["z"] * l, to=upper.point(), name="elbow"),
            ph.Gravity(g),
            name="double pendulum",
        )
    )
    verdict = ph.check(r"\mathbf v\cdot\mathbf v = l^2\dot\alpha^2", pendulum, context="identity")
    assert verdict.answer is Answer.AMBIGUOUS
    assert "velocity of upper" in verdict.reason
    centre = r"\mathbf r_{\rm cm}\cdot\hat{\mathbf z} = -\frac{l}{2}(2\cos\alpha + \cos\beta)"
    assert ph.check(centre, pendulum, context="identity").answer is Answer.HOLDS


def test_a_component_declared_along_a_rod_is_not_the_vertical_one() -> None:
    verdict = ph.check(r"F_z = mg\cos\theta + ml\dot\theta^2", swinging_rod())
    assert verdict.answer is Answer.AMBIGUOUS
    assert "declared F_z" in verdict.reason
    assert "force of string along axis z of lab" in verdict.reason
    chosen = ph.check(
        r"F_z = mg\cos\theta + ml\dot\theta^2", swinging_rod(), read=["F_z = declared F_z"]
    )
    assert chosen.answer is Answer.HOLDS


def test_too_many_readings_ask_for_a_choice() -> None:
    lab = ph.Frame("lab")
    bodies = [
        ph.point_mass(f"bead{i}", mass=ph.symbol("m"), axes=lab, tag=str(i)) for i in range(1, 6)
    ]
    beads = ph.derive(ph.System(*bodies, ph.Gravity(ph.symbol("g")), name="beads"))
    verdict = ph.check(r"\mathbf r\times\mathbf v = 0", beads)
    assert verdict.answer is Answer.UNREAD
    assert "25 ways" in verdict.reason


# --- what was read is shown, and read again ---


def test_every_verdict_shows_its_readings() -> None:
    for latex in (r"\mathbf L_p = \mathbf L_p", r"T = V", r"\ddot q = 1"):
        verdict = ph.check(latex, equations("gyroscope"))
        letters_read = {r.letter for r in verdict.readings}
        assert (verdict.answer is Answer.UNREAD) != bool(letters_read)


def misread(monkeypatch: pytest.MonkeyPatch, letter: str, phrase: str) -> None:
    """Let the first reader take a letter for another quantity."""
    known = letters.phrases_by_letter

    def mistaken(mechanics):
        found = known(mechanics)
        (node,) = (n for n in found if n.letter == letter and n.decoration == "hat")
        return found | {node: (phrase,)}

    monkeypatch.setattr(vocabulary, "phrases_by_letter", mistaken)


@pytest.mark.parametrize("latex", [r"\hat{\mathbf z} = \hat{\mathbf 3}", r"L_z = I_3\omega_3"])
def test_the_second_reader_finds_what_the_first_misread(
    monkeypatch: pytest.MonkeyPatch, latex: str
) -> None:
    racquet = ph.derive(PROBLEM_SET["tennis-racquet"].build())  # nothing of it is known yet
    misread(monkeypatch, "z", "axis z of lab''")
    verdict = ph.check(latex, racquet, seconds=None)
    assert verdict.answer is Answer.UNREAD
    assert "a second reading" in verdict.reason


def test_where_nothing_moves_along_the_angular_momentum_nothing_holds_for_it() -> None:
    """On one branch of the separatrix of a free body, by two relations that meet L_x = L_y = 0."""
    branch = r"\omega_3 = \sqrt{\frac{I_1 (I_2 - I_1)}{I_3 (I_3 - I_2)}}\omega_1"
    given = {"given": [r"L^2 = 2I_2T", branch]}
    verdict = uncorrected(r"\omega_2 = 7\frac{L}{I_2}", equations("tennis-racquet"), **given)
    assert verdict.answer is Answer.FAILS
