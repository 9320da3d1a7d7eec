"""No true statement is accused, however it is said; the campaign takes all six ways of each."""

import pytest

from judge.paraphrased import ACCUSING, statements


@pytest.mark.parametrize("number", range(len(statements())))
def test_a_true_statement_is_not_accused(number: int) -> None:
    statement = statements()[number]
    lines = statement.reviewed(number % len(statement.ways))
    assert [line.latex for line in lines if line.mark in ACCUSING] == []
