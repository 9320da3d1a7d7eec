import pickle

import pytest

from polhode import base

FAMILY = [
    base.DeclarationError,
    base.ConstraintError,
    base.UnitError,
    base.ParseError,
    base.NumericError,
    base.StoreError,
]


def test_a_message_says_what_came_what_was_expected_and_what_to_do():
    error = base.DeclarationError("mass = -1 kg", expected="a positive mass", advice="check it")
    assert str(error) == "mass = -1 kg; expected a positive mass; check it"


def test_parts_left_empty_leave_no_trace():
    assert str(base.ParseError("x +", advice="close it")) == "x +; close it"
    assert str(base.ParseError("x +")) == "x +"


@pytest.mark.parametrize("kind", FAMILY)
def test_one_family(kind):
    assert issubclass(kind, base.PolhodeError)
    assert base.exit_code(kind("anything")) == 2


def test_exit_codes_of_the_contract():
    assert [base.Exit.DONE, base.Exit.FAILED, base.Exit.REFUSED] == [0, 1, 2]
    assert base.exit_code(KeyboardInterrupt()) == 130
    assert base.exit_code(ZeroDivisionError()) == 2


def test_an_error_comes_home_from_a_worker_whole():
    error = base.UnitError("3 kg", expected="a length", advice="measure again")
    home = pickle.loads(pickle.dumps(error))
    assert type(home) is base.UnitError
    assert (home.given, home.expected, home.advice) == ("3 kg", "a length", "measure again")
    assert str(home) == str(error)
