"""What a text states carries forward, and what is not judged says why."""

import subprocess
import sys
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET
from polhode.judge import named_system, proposed_systems, sentence

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS
NEEDS, NOT_JUDGED = ph.Mark.NEEDS, ph.Mark.NOT_JUDGED


@cache
def equations(name: str) -> ph.Equations:
    return ph.derive(PROBLEM_SET[name].build())


def marks(text: str, system: str = "rolling-disk", format: str = ".tex") -> list[ph.Mark]:
    return [blamed(line) for line in ph.review(text, equations(system), format=format).lines]


# -- what is stated --------------------------------------------------------------------------------


def test_a_defined_letter_is_known_in_later_lines() -> None:
    text = r"Let $k = \frac{I_3}{ma^2}$. Then \[ k = \frac12 . \] Hence \[ I_3 = k m a^2 . \]"
    assert marks(text) == [NOT_JUDGED, TRUE, TRUE]


def test_a_wrong_value_of_a_defined_letter_is_an_error_and_is_carried_on() -> None:
    text = r"Let $k = \frac{I_3}{ma^2}$. Then \[ k = \frac13 . \] Hence \[ I_3 = \frac13 m a^2 . \]"
    assert marks(text) == [NOT_JUDGED, ERROR, FOLLOWS]


def test_an_assumption_holds_for_its_part_and_not_for_the_next() -> None:
    line = r"\[ V = mga . \]"
    text = rf"\section{{On edge}} Assume $\theta = \pi/2$. {line} \section{{Tilted}} {line}"
    assert marks(text) == [NOT_JUDGED, TRUE, ERROR]


def test_a_condition_holds_for_its_sentence() -> None:
    text = r"When $\theta = \pi/2$ we have \[ V = mga \]" "\n\nIn general\n" r"\[ V = mga . \]"
    assert marks(text) == [NOT_JUDGED, TRUE, ERROR]


def test_a_line_under_a_condition_that_is_not_read_is_not_called_wrong() -> None:
    text = r"For $\theta = \text{a right angle}$ we have \[ V = mga . \]"
    assert marks(text)[-1] is NOT_JUDGED


def test_a_value_of_a_coordinate_is_a_choice_and_no_error() -> None:
    assert marks(r"The disk is at $\theta = \pi/3$.") == [NOT_JUDGED]


def test_a_value_of_a_free_parameter_is_a_choice_and_no_error() -> None:
    assert marks(r"Here $m = 2$ and hence \[ V = 2ga\sin\theta . \]") == [NOT_JUDGED, TRUE]
    assert marks(r"Take \[ I_1 = I_3 . \]", "gyrocompass") == [NOT_JUDGED]


def test_a_rate_that_a_wrong_line_sets_excuses_no_energy() -> None:
    assert marks(r"\[ \dot\theta^2 = -g/a \] \[ V = mga\cos\theta \]") == [ERROR, ERROR]


def test_speeds_that_a_text_never_mentions_may_be_taken_for_granted() -> None:
    line = r"\[ T = \frac{ma^2}{8}(\dot\theta^2 + 4\dot\theta^2\cos^2\theta"
    line += r" + \dot\phi^2\sin^2\theta + 2\omega_3^2) \]"
    (found,) = ph.review(line, equations("spinning-coin")).lines
    assert blamed(found) is NEEDS
    assert found.needs == "v_x = 0 and v_y = 0"
    assert marks(rf"The centre moves at $v_x = \dot x$. {line}", "spinning-coin")[-1] is ERROR


def test_a_deviation_is_defined_by_the_angle_that_it_changes() -> None:
    text = r"Write $\theta = \frac{\pi}{2} + \epsilon$. Then \[ V = mga\cos\epsilon . \]"
    assert marks(text) == [NOT_JUDGED, TRUE]


def test_steady_motion_is_named_by_the_words() -> None:
    line = r"\[ a\dot\phi^2\sin\theta\cos\theta = 6a\omega_3\dot\phi\sin\theta + 4g\cos\theta \]"
    (found,) = ph.review(rf"In steady motion {line}", equations("rolling-disk")).lines
    assert blamed(found) is TRUE
    assert found.context == "steady"
    assert marks(line) == [NEEDS]


def test_several_slips_are_each_a_first_error() -> None:
    text = r"\[ V = mga\cos\theta \] \[ I_3 = ma^2 \] \[ I_1 = \frac14 ma^2 \]"
    assert marks(text) == [ERROR, ERROR, TRUE]


def test_lines_that_cannot_be_read_say_why() -> None:
    (line,) = ph.review(r"\[ V = Q_{17} \]", equations("rolling-disk")).lines
    assert blamed(line) is NOT_JUDGED
    assert "Q_17" in line.reason


# -- formats ---------------------------------------------------------------------------------------


def test_macros_that_no_file_defines_are_named_and_do_not_stop_the_other_lines() -> None:
    text = r"$T = \half{m}v^2$ and $V = mga\cos\theta$"
    unread, line = ph.review(text, equations("rolling-disk")).lines
    assert (blamed(unread), blamed(line)) == (NOT_JUDGED, ERROR)
    assert unread.reason.startswith(r"\half{m}, which is defined nowhere")


def test_one_derivation_in_markdown_and_in_latex_has_the_same_marks() -> None:
    body = r"$V = mga\sin\theta$ and hence $$ V = mga\cos\theta $$"
    assert marks(body, format=".md") == marks(body) == [TRUE, ERROR]


def test_a_notebook_is_read_cell_by_cell() -> None:
    cell = '{"cell_type": "markdown", "source": ["Hence $$V = mga\\\\cos\\\\theta$$"]}'
    notebook = f'{{"cells": [{cell}], "nbformat": 4, "nbformat_minor": 5, "metadata": {{}}}}'
    assert marks(notebook, format=".ipynb") == [ERROR]


def test_included_files_are_reviewed_in_their_place(tmp_path: Path) -> None:
    (tmp_path / "part.tex").write_text(r"\[ V = mga\cos\theta \]")
    main = tmp_path / "main.tex"
    main.write_text("First.\n\\input{part}\n\\[ I_3 = \\frac12 ma^2 \\]\n")
    review = ph.review_files([main], equations("rolling-disk"))
    assert [Path(line.file).name for line in review.lines] == ["part.tex", "main.tex"]
    assert [blamed(line) for line in review.lines] == [ERROR, TRUE]


def test_wrong_lines_of_one_file_do_not_excuse_those_of_another(tmp_path: Path) -> None:
    files = [tmp_path / "one.tex", tmp_path / "two.tex"]
    for file in files:
        file.write_text(r"\[ V = mga\cos\theta \]")
    review = ph.review_files(files, equations("rolling-disk"))
    assert [blamed(line) for line in review.lines] == [ERROR, ERROR]


def test_anything_but_equations_is_refused() -> None:
    with pytest.raises(ph.DeclarationError, match="derive"):
        ph.review("$V = 1$", PROBLEM_SET["rolling-disk"].build())  # type: ignore[arg-type]


# -- the system of a text --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "comment",
    ["% polhode: rolling-disk", "<!-- polhode: rolling-disk -->", "// polhode: rolling-disk"],
)
def test_a_comment_names_the_system(comment: str) -> None:
    assert named_system([f"{comment}\nA disk."]) == "rolling-disk"


def test_a_system_is_proposed_by_the_words_of_a_text() -> None:
    text = "A marble rolls on a turntable that turns at a constant rate."
    assert "marble-on-turntable" in proposed_systems([text])
    assert proposed_systems(["Nothing of the kind."]) == ()


# -- the command -----------------------------------------------------------------------------------


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "polhode", "review", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_the_exit_code_says_whether_a_line_is_wrong(tmp_path: Path) -> None:
    file = tmp_path / "a.tex"
    file.write_text("% polhode: rolling-disk\n$V = mga\\sin\\theta$\n")
    done = run(str(file))
    assert done.returncode == 0
    assert "1 relation on rolling-disk: 1 true" in done.stdout
    file.write_text("% polhode: rolling-disk\nThe potential energy is $V = mga\\cos\\theta$.\n")
    done = run(str(file))
    assert done.returncode == 1
    assert "first error" in done.stdout


def test_a_text_without_a_system_is_bad_input_with_a_proposal(tmp_path: Path) -> None:
    file = tmp_path / "a.tex"
    file.write_text("A marble on a turntable: $V = mga$.")
    done = run(str(file))
    assert done.returncode == 2
    assert "--system marble-on-turntable" in done.stderr


def test_a_line_that_takes_too_long_does_not_stop_those_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def endless(*_: object) -> None:
        while True:
            pass

    text = r"\[ \dot\omega_3 = 0 \] \[ V = mga\sin\theta \]"
    (first, other) = ph.review(text, equations("rolling-disk"), seconds=0.0).lines
    assert (blamed(first), blamed(other)) == (ERROR, TRUE)
    module = import_module("polhode.judge.lines._judge_line")
    monkeypatch.setattr(import_module("polhode.judge._review"), "LONGEST", 0.5)
    monkeypatch.setattr(module, "unstated_condition", endless)
    (first, other) = ph.review(text, equations("rolling-disk"), seconds=0.0).lines
    assert blamed(first) is NOT_JUDGED
    assert "more than 0.5 s of computing" in first.reason
    assert blamed(other) is TRUE


def test_a_part_is_told_before_the_next_is_judged(monkeypatch) -> None:
    module, judged = import_module("polhode.judge._review"), []
    in_one_way = module.in_one_way

    def counted(lines, equations):
        judged.append(lines[0].latex)
        return in_one_way(lines, equations)

    monkeypatch.setattr(module, "in_one_way", counted)
    text = (
        r"\section{One} \[ V = mga\sin\theta \] \section{Two} \[ V = mga \] \section{Three} $V = 0$"
    )
    told = []
    ph.review(
        text, equations("rolling-disk"), seconds=0.0, tell=lambda line: told.append(len(judged))
    )
    assert told == [2, 3, 3]


def test_a_line_that_another_refers_to_is_named_among_several_on_its_line() -> None:
    text = r"The potential energy is $V = mga\cos\theta$, so $\mathcal L = T - mga\cos\theta$."
    review = ph.review(text, equations("rolling-disk"))
    said = [sentence(line, review) for line in review.lines]
    assert said[1] == r"This is wrong only because line 1 (V = mga\cos\theta) is"


def test_a_state_given_as_an_example_is_no_claim_and_numbers_are_judged_at_it() -> None:
    state = r"with $\theta = 0.927$, $\dot\phi = 4$, $\omega_3 = 3$, $a = 0.5$, $g = 10$"
    assert marks(rf"For instance, {state} and $\ddot\theta = -19.6$ it falls.")[-1] is TRUE
    assert marks(rf"For instance, {state} and $\ddot\theta = -18.6$ it falls.")[-1] is ERROR
    assert marks(r"For instance, with $\theta = 1$ and $\ddot\theta = -9.2$ it falls.") == (
        [NOT_JUDGED] * 2
    )
    parts = r"Take $a = 0.5$, $g=10$. At $\theta = 0.927$, $\dot\phi = 4$ and $\omega_3 = 3$"
    assert marks(rf"{parts} we find \[ \ddot\theta = -19.6 \]")[-1] is TRUE
    assert marks(r"Say $\dot\psi = 3$. The sides differ at $\dot\omega_3 = \pm 1$.") == (
        [NOT_JUDGED] * 2
    )


def test_numbers_have_units() -> None:
    given = r"Take $a = 3\,\mathrm{cm}$ and $g = 9.81\,\mathrm{m/s^2}$. "
    for value, mark in (
        (r"10.4\,\mathrm{rad/s}", TRUE),
        (r"10.6\,\mathrm{rad/s}", ERROR),
        (r"10.4\,\mathrm{rad}", ERROR),
        (r"10440\,\mathrm{mrad/s}", TRUE),
    ):
        assert marks(rf"{given}\[ \sqrt{{\frac{{g}}{{3a}}}} = {value} \]")[-1] is mark
    assert marks(r"Take $g = 9.81\,\mathrm{m/s}$.") == [ERROR]


def test_departures_are_not_judged_at_the_motion_that_they_depart_from() -> None:
    text = r"If the coin is upright, $\theta=\pi/2$ and $\omega_3=0$, then small tilts "
    text += r"$\epsilon = \theta - \pi/2$ obey \[ \ddot\epsilon \approx 0 \] and "
    text += r"\[ \ddot\epsilon + \dot\phi^2\epsilon \approx \frac{4g}{a}\epsilon . \]"
    assert marks(text, "spinning-coin")[-2:] == [ERROR, TRUE]


def test_what_words_say_of_rest_holds_for_their_sentence() -> None:
    on_edge = r"When the disk is on edge ($\theta = \pi/2$) and at rest, $\ddot\theta = "
    assert marks(f"{on_edge}0$.")[-1] is TRUE
    start = r"If it starts from rest at $\theta = 45^\circ$ then $\ddot\theta = -\frac{4g}{5a}"
    assert marks(rf"{start}\cos 45^\circ$ initially.")[-1] is TRUE
    assert marks(rf"{start}\sin 30^\circ$ initially.")[-1] is ERROR
    resting = r"Released from rest ($v_x = v_y = 0$) it stays."
    wrong = rf"{resting} \[ \dot{{\mathbf v}} = \Omega\,\hat{{\mathbf z}}\times\mathbf v \]"
    assert marks(wrong, "marble-on-turntable")[-1] is ERROR


def test_letters_for_a_time_a_speed_and_a_sense_of_rotation_are_the_texts_own() -> None:
    marble = r"With $I = \frac25 ma^2$ and $\Omega = 3.46$ a round takes "
    marble += r"\[ T = \frac{2\pi}{\frac27\Omega} = \frac{%s\pi}{\Omega} = 6.36\,\mathrm{s} \]"
    assert marks(marble % "7", "marble-on-turntable")[-1] is TRUE
    assert marks(marble % "5", "marble-on-turntable")[-1] is ERROR
    euler = r"$\omega_1 = \omega_0$. \[ \dot\omega_2 = \frac{I_3 - I_1}{I_2}\omega_0\omega_3 \]"
    assert marks(euler, "tennis-racquet") == [NOT_JUDGED, TRUE]
    order = r"Then $\omega_3 = \omega_3$. Since $I_1 < I_2 < I_3$ it is unstable."
    assert marks(order, "tennis-racquet")[-1] is NOT_JUDGED


def test_a_sheet_of_which_a_text_tells_one_motion_has_no_other() -> None:
    text = r"\[ v_x - r\omega_y = \dot X \] \[ \dot v_x = \frac{k}{1+k}\ddot X \]"
    text += r"\[ \dot v_x = \frac{1}{1+k}\ddot X \]"
    assert marks(text, "ball-on-paper") == [NEEDS, NEEDS, ERROR]


def test_appells_function_counts_up_to_terms_without_accelerations() -> None:
    slope = r"\[ \frac{\partial S}{\partial\ddot\theta} = -mga\cos\theta \]"
    by_definition = r"\[ S = \frac12 m\mathbf a_{\rm cm}^2 + \frac12\dot{\boldsymbol\omega}\cdot"
    by_definition += r"\mathsf I\dot{\boldsymbol\omega} + \dot{\boldsymbol\omega}\cdot"
    by_definition += r"(\boldsymbol\omega\times\mathbf L_{\rm cm}) \]"
    assert marks(slope + by_definition) == [TRUE, TRUE]
    # A sphere has no gyroscopic term, and its ω̇ follows from rolling by hand.
    sphere = r"\[ S = \frac{1}{2}\left(m + \frac{I}{a^2}\right)(\dot v_x^2 + \dot v_y^2) "
    sphere += r"+ \frac{1}{2}I\dot\omega_z^2 + \frac{I\Omega}{a^2}(v_y\dot v_x %s v_x\dot v_y) \]"
    assert marks(sphere % "-", "marble-on-turntable") == [TRUE]
    assert marks(sphere % "+", "marble-on-turntable") == [ERROR]
