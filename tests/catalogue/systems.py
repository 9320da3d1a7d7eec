"""Every catalogue system derived once for all tests of a process."""

from functools import cache

from derive.states import Numeric
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations, derive


@cache
def equations(name: str) -> Equations:
    """The equations of the system of this name."""
    return derive(CATALOGUE[name].build())


@cache
def numeric(name: str) -> Numeric:
    """The same, ready for numbers."""
    return Numeric(equations(name))
