"""Every catalogue system derived once, ready for numbers."""

from functools import cache

from derive.states import Numeric
from polhode.catalogue import CATALOGUE
from polhode.derive import derive


@cache
def numeric(name: str) -> Numeric:
    """The system of this name, derived."""
    return Numeric(derive(CATALOGUE[name].build()))
