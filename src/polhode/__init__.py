"""polhode: rigid-body mechanics, worked as a good text works it.

Public names are fetched from their rooms when first asked for, so that importing polhode costs
next to nothing.
"""

import logging
import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from polhode.base import ConstraintError as ConstraintError
    from polhode.base import DeclarationError as DeclarationError
    from polhode.base import NumericError as NumericError
    from polhode.base import ParseError as ParseError
    from polhode.base import PolhodeError as PolhodeError
    from polhode.base import StoreError as StoreError
    from polhode.base import UnitError as UnitError

    __version__: str

_ROOMS = {
    "base": (
        "ConstraintError",
        "DeclarationError",
        "NumericError",
        "ParseError",
        "PolhodeError",
        "StoreError",
        "UnitError",
    ),
}
_HOME = {name: f"polhode.{room}" for room, names in _ROOMS.items() for name in names}

__all__ = [*_HOME, "__version__"]

logging.getLogger("polhode").addHandler(logging.NullHandler())


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        value: Any = version("polhode")
    elif name in _HOME:
        value = getattr(import_module(_HOME[name]), name)
    else:
        raise AttributeError(f"module 'polhode' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


class _House(ModuleType):
    """Keeps a room, once imported, from hiding the function of its name, as in ``ph.derive``."""

    def __setattr__(self, name: str, value: object) -> None:
        if not (name in _HOME and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _House
