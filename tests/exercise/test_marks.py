"""The whole way: an exercise drawn, answers right, wrong, blank and in other forms, marked."""

import json

import pytest

from polhode.base import ParseError, StoreError
from polhode.catalogue import CATALOGUE
from polhode.exercise import (
    Builder,
    ExerciseSheet,
    PartMark,
    key_document,
    marked_submission,
    read_key,
    read_submission,
    sheet_blocks,
)
from polhode.exercise._answers import ChoiceAnswer, FormulaAnswer, NumberAnswer, marked_part
from polhode.exercise._documents import markdown_of
from polhode.exercise._key import KeyEntry
from polhode.judge.service import ServiceSettings, marked_answer
from polhode.judge.service._platforms import task_of


@pytest.fixture(scope="module")
def sheet(offered):
    return ExerciseSheet(7, 1, (offered,))


@pytest.fixture(scope="module")
def key(sheet, tmp_path_factory):
    path = tmp_path_factory.mktemp("key") / "sheet-key.json"
    path.write_text(json.dumps(key_document([sheet])), "utf-8")
    return read_key(path)


def handed_in(answers, tmp_path):
    path = tmp_path / "answers.md"
    text = "\n".join(f"{name}: {answer}" for name, answer in answers.items())
    path.write_text(f"student: 1\n\n{text}\n", "utf-8")
    return path


def right_text(answer):
    match answer:
        case FormulaAnswer():
            return answer.latex
        case NumberAnswer():
            return " and ".join(f"{v:.3g}" for v in answer.values)
    return ", ".join(answer.right)


def wrong_text(answer):
    match answer:
        case FormulaAnswer():
            return f"{answer.latex} + {answer.latex}"
        case NumberAnswer():
            return " and ".join(f"{1.1 * v + 0.5:.3g}" for v in answer.values)
    return next(k for k in answer.options if k not in answer.right)


@pytest.mark.parametrize(
    ("write", "mark"), [(right_text, PartMark.RIGHT), (wrong_text, PartMark.WRONG)]
)
def test_every_kind_of_answer_is_marked(sheet, key, disk_equations, tmp_path, write, mark):
    answers = {name: write(answer) for name, (_, answer) in sheet.answers.items()}
    submission = read_submission(handed_in(answers, tmp_path), key)
    marks = marked_submission(submission, key, lambda name: disk_equations)
    assert {name: part.mark for name, part in marks.items()} == dict.fromkeys(answers, mark)


def test_a_blank_sheet_is_not_judged(sheet, key, disk_equations, tmp_path):
    path = tmp_path / "blank.md"
    path.write_text(markdown_of(sheet_blocks(sheet), "", ["rolling-disk"], 7), "utf-8")
    marks = marked_submission(read_submission(path, key), key, lambda name: disk_equations)
    assert {part.mark for part in marks.values()} == {PartMark.NOT_JUDGED}
    assert {part.message for part in marks.values()} == {"left blank"}


def test_a_sheet_that_was_filled_in_is_read(sheet, key, disk_equations, tmp_path):
    """Answers stand in place of the blanks, behind their prompts and before their units."""
    text = markdown_of(sheet_blocks(sheet), "", ["rolling-disk"], 7)
    for answer in (answer for _, answer in sheet.answers.values()):
        text = text.replace("______", right_text(answer), 1)
    path = tmp_path / "filled.md"
    path.write_text(text, "utf-8")
    marks = marked_submission(read_submission(path, key), key, lambda name: disk_equations)
    assert {part.mark for part in marks.values()} == {PartMark.RIGHT}


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        (r"2\sqrt{g/(5a)}", PartMark.RIGHT),
        (r"\sqrt{\frac{4 g a}{5 a^2}}", PartMark.RIGHT),
        (r"S = 2\left(\frac{g}{5a}\right)^{1/2}", PartMark.RIGHT),
        (r"$S = 2\sqrt{\frac{g}{5 a}}$", PartMark.RIGHT),
        (r"\sqrt{\frac{g}{5a}}", PartMark.WRONG),
        (r"S", PartMark.WRONG),
        (r"\frac{", PartMark.NOT_JUDGED),
        ("   ", PartMark.NOT_JUDGED),
    ],
)
def test_forms_of_a_formula(disk_equations, text, mark):
    given = r"Let $S = 2 \sqrt{\frac{g}{5 a}}$."
    expected = FormulaAnswer("S", r"2 \sqrt{\frac{g}{5 a}}", ("a", "g"), given)
    assert marked_part(expected, text, disk_equations).mark is mark


def test_other_letters_and_accelerations_are_told(disk_equations):
    expected = FormulaAnswer(
        "X", r"4 g \cos\theta", ("a", "g", r"\theta", r"\phi", r"\omega_{3}"),
        r"Let $X = 4 g \cos\theta$.", (r"\ddot{\theta}",),
    )  # fmt: skip
    cheat = r"a \dot\phi^2\sin\theta\cos\theta - 6 a \omega_3\dot\phi\sin\theta - 5 a \ddot\theta"
    found = marked_part(expected, cheat, disk_equations)
    assert found.mark is PartMark.WRONG
    assert "without" in found.message
    other = marked_part(expected, r"\frac{4 m g \cos\theta}{m}", disk_equations)
    assert other.mark is PartMark.WRONG
    assert "letters" in other.message


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("3.2", PartMark.RIGHT),
        ("3.2 rad/s", PartMark.RIGHT),
        ("3,2", PartMark.RIGHT),
        (r"$3.2\,\mathrm{rad/s}$", PartMark.RIGHT),
        ("about? 3.2", PartMark.NOT_JUDGED),
        ("30.56 rpm", PartMark.RIGHT),
        (r"3.2\cdot 10^{0} rad/s", PartMark.RIGHT),
        ("= 3.21", PartMark.RIGHT),
        ("3.4", PartMark.WRONG),
        ("-3.2", PartMark.WRONG),
        ("3.2 m", PartMark.WRONG),
        ("3.2 furlong", PartMark.NOT_JUDGED),
        ("fast", PartMark.NOT_JUDGED),
        ("____", PartMark.NOT_JUDGED),
    ],
)
def test_forms_of_a_number(disk_equations, text, mark):
    expected = NumberAnswer("rate:", (3.2,), "rad/s")
    assert marked_part(expected, text, disk_equations).mark is mark


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("-3.58 and 551", PartMark.RIGHT),
        ("551 rad/s; -3.58 rad/s", PartMark.RIGHT),
        ("551, -3.58", PartMark.RIGHT),
        ("551", PartMark.WRONG),
        ("-3.58 and -3.58", PartMark.WRONG),
        ("3.58 and 551", PartMark.WRONG),
    ],
)
def test_both_roots_in_any_order(disk_equations, text, mark):
    expected = NumberAnswer("rates:", (-3.58, 551.0), "rad/s")
    assert marked_part(expected, text, disk_equations).mark is mark


@pytest.mark.parametrize(
    ("text", "mark"),
    [
        ("(a), (c)", PartMark.RIGHT),
        ("A and C", PartMark.RIGHT),
        ("a", PartMark.WRONG),
        ("a, b, c", PartMark.WRONG),
        ("none", PartMark.WRONG),
        ("the first one", PartMark.NOT_JUDGED),
    ],
)
def test_choices(disk_equations, text, mark):
    expected = ChoiceAnswer("constant:", frozenset("ac"), tuple("abcd"))
    assert marked_part(expected, text, disk_equations).mark is mark


@pytest.mark.parametrize(
    ("right", "text", "mark"),
    [
        (1.044, "1.0", PartMark.RIGHT),  # as it is rounded to two figures
        (1.044, "1", PartMark.WRONG),
        (1.06, "1.0", PartMark.WRONG),
        (0.01044, "0.010", PartMark.RIGHT),
        (0.01044, "1.0e-2", PartMark.RIGHT),
        (0.01044, r"1.0 \cdot 10^{-2}", PartMark.RIGHT),
        (1203.0, "1,200", PartMark.RIGHT),
        (1.2, "1,200", PartMark.RIGHT),  # a comma of either kind
        (12.0, "1,200", PartMark.WRONG),
        (1203.0, "1200 N", PartMark.RIGHT),
        (1203.0, "1.2 kN", PartMark.RIGHT),
        (1203.0, "1.3 kN", PartMark.WRONG),
    ],
)
def test_numbers_are_rounded_and_spelled_as_people_do(disk_equations, right, text, mark):
    expected = NumberAnswer("force:", (right,), "N")
    assert marked_part(expected, text, disk_equations).mark is mark


def test_small_numbers_with_powers_of_ten(disk_equations):
    expected = NumberAnswer("force:", (4.27e-4,), "N")
    for text in (r"4.27\cdot 10^{-4}", "4.27e-4 N", "4.27·10^-4 N", "0.427 mN"):
        assert marked_part(expected, text, disk_equations).mark is PartMark.RIGHT, text


def test_the_key_serves_learning_platforms(sheet, disk_equations):
    """A formula's entry holds what a request to the service of marks needs, besides the text."""
    entries = key_document([sheet])["sheets"][0]["answers"]
    formulas = [entry for entry in entries.values() if entry["kind"] == "formula"]
    assert formulas
    for entry in formulas:
        options = {k: entry[k] for k in ("asked", "given", "letters")}
        for text, correct in ((entry["latex"], True), (f"2\\left({entry['latex']}\\right)", False)):
            task = task_of({"text": text, **options}, ServiceSettings())
            assert marked_answer(task, disk_equations).is_correct is correct


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("answers.txt", "Student: 2\n1: 3\n"),
        ("team-02.txt", "1: 3\n"),
        ("sheet.md", "# Rolling disk (sheet -4.2)\n\n1: 3\n"),
        ("sheet.ipynb", json.dumps({"cells": [{"source": ["student: 2\n", "1: 3"]}]})),
    ],
)
def test_whose_answers_they_are(name, text, tmp_path):
    entry = KeyEntry("rolling-disk", NumberAnswer("degrees:", (3.0,), tolerance=0.0))
    path = tmp_path / name
    path.write_text(text, "utf-8")
    found = read_submission(path, {1: {"1": entry}, 2: {"1": entry}})
    assert (found.student, found.answers) == (2, {"1": "3"})


def test_a_file_that_belongs_to_nobody_is_refused(key, tmp_path):
    path = tmp_path / "late.txt"
    path.write_text("student: 9\n1: 3\n", "utf-8")
    with pytest.raises(ParseError, match="belong to no sheet"):
        read_submission(path, key)


@pytest.mark.parametrize("text", ["", "{}", '{"sheets": [{"student": 1, "answers": {"1": {}}}]}'])
def test_a_damaged_key_is_refused(text, tmp_path):
    path = tmp_path / "key.json"
    path.write_text(text, "utf-8")
    with pytest.raises(StoreError):
        read_key(path)


@pytest.mark.parametrize(
    "text",
    [
        r"\omega_1\sqrt{\frac{(I_1 - I_3)(I_1 - I_2)}{I_2 I_3}}",
        r"|\omega_1|\sqrt{\frac{(I_3 - I_1)(I_2 - I_1)}{I_2 I_3}}",
        r"\sqrt{\frac{(I_3 - I_1)(I_2 - I_1)\omega_1^2}{I_2 I_3}}",
    ],
)
def test_a_frequency_may_be_given_with_a_magnitude(racquet, text):
    """With ω₁ taken as positive both are right."""
    builder, expected = racquet
    assert marked_part(expected, text, builder.subject.equations).mark is PartMark.RIGHT


@pytest.fixture(scope="module")
def racquet():
    builder = Builder.of(CATALOGUE["tennis-racquet"])
    made = (builder.exercise(seed, kinds=["frequency"]) for seed in range(1, 9))
    about_1 = next(m for m in made if r"\omega_1$ as positive" in str(m.questions))
    return builder, about_1.answers["1a"]
