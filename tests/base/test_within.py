"""A task with a time limit, in a copy of the process."""

import os
import signal

import pytest

from polhode.base import NumericError, within


def test_a_copy_that_is_killed_is_replaced_once(tmp_path):
    mark = tmp_path / "was here"

    def task(tell):
        if not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return 7

    assert within(60.0, task, advice="") == 7


def test_one_that_is_killed_again_is_an_error():
    def task(tell):
        os.kill(os.getpid(), signal.SIGKILL)

    with pytest.raises(NumericError, match="the computing process ended unexpectedly"):
        within(60.0, task, advice="take less")
