"""What a sheet states is what its answers are marked by: axes, letters, relations between them.

Right answers in honest forms are written out by hand here, and so are wrong ones; none of the first
may be marked wrong, and none of the second right.
"""

import re

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.exercise import Builder, PartMark
from polhode.exercise._answers import FormulaAnswer, marked_part

RIGHT, WRONG = PartMark.RIGHT, PartMark.WRONG


def cart_and_pole():
    """Axes 1, 2, 3 turn with the pole, while its velocity is shortest along x, y, z."""
    m, M, l, g = ph.symbols("m M l g", positive=True)
    lab = ph.Frame("lab")
    turned = lab.rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    cart = ph.point_mass("cart", mass=M, axes=lab)
    bob = ph.point_mass("bob", mass=m, axes=turned)
    return ph.System(
        ph.Pivot(cart, only="y z", name="rail"),
        ph.Pivot(bob, at=turned["3"] * -l, to=cart.point(), name="pole", force="P"),
        ph.Hinge(bob, axis="2"),
        ph.Gravity(g),
        name="cart and pole",
    )


@pytest.fixture(scope="module")
def builders():
    names = ("marble-on-turntable", "gyrocompass", "spinning-coin")
    found = {name: Builder.of(CATALOGUE[name]) for name in names}
    pole = cart_and_pole()
    found["pole"] = Builder.of(CatalogueEntry.bare("pole", "pole", pole))
    return found


def asked(builder, kind, letter):
    """The formula that some sheet asks for under a letter."""
    for seed in range(1, 12):
        for answer in builder.exercise(seed, kinds=[kind]).answers.values():
            if isinstance(answer, FormulaAnswer) and answer.asked == letter:
                return answer
    raise AssertionError(f"{letter} is never asked for")


def mark(builder, answer, text):
    return marked_part(answer, text, builder.subject.equations).mark


@pytest.mark.parametrize(
    ("text", "mark_due"),
    [
        # F = 2/7 m Ω v_x along y, with I = 2ma²/5, which the sheet gives
        (r"\frac{2}{7} m \Omega v_x", RIGHT),
        (r"\frac{m I \Omega v_x}{I + m a^2}", RIGHT),
        (r"\frac{\frac25 m a^2 \Omega v_x}{\frac75 a^2}", RIGHT),
        (r"F_y = \frac{2}{7} m \Omega v_x", RIGHT),
        (r"\mathbf F\cdot\hat{\mathbf y} - \frac{2}{7} m \Omega v_x = 0", RIGHT),
        (r"7 \mathbf F\cdot\hat{\mathbf y} = 2 m \Omega v_x", RIGHT),
        ("2*m*Omega*v_x/7", RIGHT),
        (r"\frac{2}{7} m \Omega \dot x", RIGHT),  # the sheet says that it is v_x
        (r"\frac{2}{5} m \Omega v_x", WRONG),
        (r"\frac{1}{3} m \Omega v_x", WRONG),
        (r"-\frac{2}{7} m \Omega v_x", WRONG),
        (r"m \dot v_y", WRONG),
        (r"\mathbf F\cdot\hat{\mathbf y}", WRONG),
    ],
)
def test_relations_of_the_sheet_may_be_used(builders, text, mark_due):
    answer = asked(builders["marble-on-turntable"], "reaction", r"\mathbf F\cdot\hat{\mathbf y}")
    assert mark(builders["marble-on-turntable"], answer, text) is mark_due


COMPASS = (
    r"\Omega\cos\lambda - \dot\theta",
    r"-\Omega\sin\theta\sin\lambda",
    r"\omega + \Omega\cos\theta\sin\lambda",
)  # along 1, 2, 3, which arise from x, y, z by a turn of -θ about x
AT_REST = (
    r"\Omega\cos\lambda - \dot\theta",
    r"\omega\sin\theta",
    r"\Omega\sin\lambda + \omega\cos\theta",
)


@pytest.mark.parametrize(
    ("text", "mark_due"),
    [
        ("({}, {}, {})".format(*COMPASS), RIGHT),
        (r"\begin{{pmatrix}} {} \\ {} \\ {} \end{{pmatrix}}".format(*COMPASS), RIGHT),
        (r"\omega_1 = {}, \omega_2 = {}, \omega_3 = {}".format(*COMPASS), RIGHT),
        ("\\omega_1 = {}\n\\omega_2 = {}\n\\omega_3 = {}".format(*COMPASS), RIGHT),
        (r"$\boldsymbol\omega = ({}, {}, {})$".format(*COMPASS), RIGHT),
        (r"({})\mathbf e_1 {}\,\mathbf e_2 + ({})\mathbf e_3".format(*COMPASS), RIGHT),
        (r"({})\hat x + {}\hat y + ({})\hat z".format(*AT_REST), RIGHT),
        (r"({})\hat\imath + {}\mathbf j + ({})\mathbf k".format(*AT_REST), None),
        (r"\omega_x = {}, \omega_y = {}, \omega_z = {}".format(*AT_REST), RIGHT),
        (r"\omega\hat{\mathbf 3} + (\Omega\cos\lambda - \frac{d\theta}{dt})\hat{\mathbf x}"
         r" + \Omega\sin\lambda\,\hat{\mathbf z}", RIGHT),
        ("({}, {}, {})".format(*AT_REST), WRONG),  # asked for along 1, 2, 3
        (r"\omega_1 = {}, \omega_2 = {}, \omega_3 = {}".format(*AT_REST), WRONG),
        (r"\omega_x = {}, \omega_y = {}, \omega_z = {}".format(*COMPASS), WRONG),
        (r"\omega_1 = {}, \omega_3 = {}".format(*COMPASS[::2]), WRONG),
    ],
)  # fmt: skip
def test_components_are_along_the_axes_that_are_asked_for(builders, text, mark_due):
    answer = asked(builders["gyrocompass"], "velocities", r"\boldsymbol\omega")
    assert answer.axes[0] == ("1", "2", "3")
    found = mark(builders["gyrocompass"], answer, text)
    assert found is mark_due if mark_due else found is not WRONG


@pytest.mark.parametrize(
    ("text", "mark_due"),
    [
        # the cart's velocity and that of the bob around it, along x, y, z
        (r"(v_x + l\dot\theta\cos\theta, 0, -l\dot\theta\sin\theta)", RIGHT),
        (r"v_x\hat{\mathbf x} + l\dot\theta\,\hat{\mathbf 1}", None),
        (r"(v_x\cos\theta + l\dot\theta, 0, v_x\sin\theta)", WRONG),  # along 1, 2, 3
        (r"(v_x\cos\theta + l\dot\theta)\hat{\mathbf 1} + v_x\sin\theta\,\hat{\mathbf 3}", None),
    ],
)
def test_components_along_the_laboratory(builders, text, mark_due):
    answer = asked(builders["pole"], "velocities", r"\mathbf v_{\rm bob}")
    assert answer.axes[0] == ("x", "y", "z")
    found = mark(builders["pole"], answer, text)
    assert found is mark_due if mark_due else found is not WRONG


@pytest.mark.parametrize(
    ("text", "mark_due"),
    [
        # the moments of the coin are I₁ = I₂ = ma²/4, I₃ = ma²/2 in the statement
        (r"I_1\dot\theta\,\hat{\mathbf 1} + I_2\dot\phi\sin\theta\,\hat{\mathbf 2}"
         r" + I_3\omega_3\hat{\mathbf 3}", RIGHT),
        (r"\frac{m a^2}{4}(\dot\theta, \dot\phi\sin\theta, 2\omega_3)", RIGHT),
        (r"I_1\dot\theta\,\hat{\mathbf 1} + I_1\dot\phi\sin\theta\,\hat{\mathbf 2}"
         r" + I_1\omega_3\hat{\mathbf 3}", WRONG),
    ],
)  # fmt: skip
def test_letters_of_moments_that_the_statement_defines(builders, text, mark_due):
    builder = builders["spinning-coin"]
    statement = " ".join(p.words for p in builder.exercise(1, kinds=["velocities"]).statement)
    assert "I_3" in statement
    answer = asked(builder, "velocities", r"\mathbf L_{\rm cm}")
    assert mark(builder, answer, text) is mark_due


@pytest.mark.parametrize("name", ["marble-on-turntable", "pole"])
def test_no_false_mark_on_what_the_sheet_itself_says(builders, name):
    """Every formula of a sheet in several forms; its double and its negative are wrong."""
    builder = builders[name]
    made = builder.exercise(1, kinds=tuple(builder.offered(1)))
    for answer in made.answers.values():
        if not isinstance(answer, FormulaAnswer):
            continue
        forms = [answer.latex, f"${answer.asked} = {answer.latex}$"]
        forms.append(re.sub(r"\\dot\{(\\theta|\\phi)\}", r"\\frac{d\1}{dt}", answer.latex))
        if not answer.axes:
            forms.append(f"{answer.asked} - \\left({answer.latex}\\right) = 0")
            forms.append(f"\\frac{{3\\left({answer.latex}\\right)}}{{3}}")
        for form in forms:
            assert mark(builder, answer, form) is RIGHT, (answer.asked, form)
        for form in (f"2\\left({answer.latex}\\right)", f"-\\left({answer.latex}\\right)"):
            assert mark(builder, answer, form) is not RIGHT, (answer.asked, form)


def test_a_letter_of_a_force_is_not_taken_for_another_quantity():
    """The force of the wall is S, so that a frequency gets another letter."""
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y", name="axes")
    ladder = ph.rod("ladder", mass=m, length=l, axes=axes, axis="z")
    system = ph.System(
        ph.Pivot(ladder, at=axes["z"] * (-l / 2), only="y z", name="floor", force="N"),
        ph.Pivot(ladder, at=axes["z"] * (l / 2), only="x", name="wall", force="S"),
        ph.Gravity(g),
        name="ladder",
    )
    made = ph.exercise(system, 1, kinds=["frequency"])
    answer = made.answers["1a"]
    assert answer.asked not in ("N", "S")
    builder = Builder.of(CatalogueEntry.bare("ladder", "ladder", system))
    # a rod on a smooth wall and floor turns like one on a pin at its end: 3g/2l
    assert mark(builder, answer, r"\sqrt{\frac{3 g}{2 l}}") is RIGHT
    assert mark(builder, answer, r"\sqrt{\frac{g}{l}}") is WRONG


def test_the_square_of_a_frequency_gives_it(builders):
    """The marble goes round at 2Ω/7."""
    builder = builders["marble-on-turntable"]
    answer = asked(builder, "frequency", "S")
    assert mark(builder, answer, r"S^2 = \frac{4\Omega^2}{49}") is RIGHT
    assert mark(builder, answer, r"S^2 = \frac{4\Omega^2}{25}") is not RIGHT
    assert mark(builder, answer, r"\frac27 \Omega") is RIGHT
