"""Exercises that several tests look at, made once."""

import pytest

from polhode.catalogue import CATALOGUE
from polhode.derive import derive
from polhode.exercise import Builder


@pytest.fixture(scope="session")
def disk():
    """Makes exercises on the rolling disk."""
    return Builder.of(CATALOGUE["rolling-disk"])


@pytest.fixture(scope="session")
def disk_equations():
    return derive(CATALOGUE["rolling-disk"].build())


@pytest.fixture(scope="session")
def offered(disk):
    """Every kind of question on the disk, with the numbers of one student."""
    return disk.exercise(7, kinds=tuple(disk.offered()))
