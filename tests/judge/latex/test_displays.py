"""Every display of the problem set, read as the transcript prints it."""

import pytest

from judge.latex.displays import DESTROYED, DISPLAYS, NUMBERED
from polhode.base import ParseError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import Cases, Name, Relation, walk

READABLE = [number for number in DISPLAYS if number not in DESTROYED]


def relations(number: str) -> tuple[Relation, ...]:
    return read_latex(DISPLAYS[number]).relations


def test_the_file_holds_every_numbered_equation() -> None:
    assert NUMBERED.keys() == {str(number) for number in range(1, 163)}


@pytest.mark.parametrize("number", READABLE)
def test_a_display_is_read_with_its_number(number: str) -> None:
    statement = read_latex(DISPLAYS[number])
    assert all(relation.is_claim for relation in statement.relations)
    assert statement.tags in ((number,), ())


@pytest.mark.parametrize("number", DESTROYED)
def test_a_destroyed_line_is_refused_at_its_place(number: str) -> None:
    with pytest.raises(ParseError, match=r"at character \d+"):
        read_latex(DISPLAYS[number])


def test_only_lines_whose_number_the_transcript_lost_have_none() -> None:
    untagged = {n for n in READABLE if n in NUMBERED and not read_latex(DISPLAYS[n]).tags}
    assert untagged == {"78", "96"}


@pytest.mark.parametrize("number", READABLE)
def test_what_is_read_can_be_written_and_read_again(number: str) -> None:
    for relation in relations(number):
        assert read_latex(write_latex(relation)).relations == (relation,)


@pytest.mark.parametrize(
    ("number", "sides"),
    [
        ("3", [3]),
        ("10", [2, 2, 2]),
        ("24", [6]),
        ("35", [6]),
        ("42", [9]),
        ("72", [5]),
        ("118", [6]),
    ],
)
def test_chains_continue_over_lines(number: str, sides: list[int]) -> None:
    assert [len(relation.sides) for relation in relations(number)] == sides


def test_a_sum_continues_over_lines() -> None:
    (relation,) = relations("144")
    assert len(relation.sides) == 2
    assert len(relation.sides[1].terms) == 3


def test_definitions_in_one_display_are_relations_of_their_own() -> None:
    statement = read_latex(DISPLAYS["8"])
    assert [write_latex(relation.sides[0]) for relation in statement.relations] == [
        r"\mathbf{v}",
        r"\mathbf{r}",
        r"\mathbf{R}",
    ]
    assert statement.notes == ("where", "and")
    assert statement.tags == ("8",)


@pytest.mark.parametrize(
    ("number", "condition"),
    [("52", r"\omega_{z,\mathrm{spin}} = 0"), ("126", r"\theta_{0} < \frac{\pi}{2}")],
)
def test_a_relation_in_brackets_is_a_condition(number: str, condition: str) -> None:
    statement = read_latex(DISPLAYS[number])
    assert [write_latex(found) for found in statement.conditions] == [condition]


def test_slow_or_fast_are_cases() -> None:
    (relation,) = relations("128")
    value = relation.sides[1]
    assert isinstance(value, Cases)
    assert [case.words for case in value.cases] == ["slow", "fast"]


def test_labels_in_brackets_distinguish_letters() -> None:
    assert relations("129")[0].sides[0] == Name("omega", "p,slow")
    assert relations("130")[0].sides[0] == Name("omega", "p,fast")


def test_boldness_that_the_transcript_lost_is_not_invented() -> None:
    names = {piece for piece in walk(relations("97")[0]) if isinstance(piece, Name)}
    assert Name("omega", "123") in names
    assert Name("1", decoration="hat") in names
