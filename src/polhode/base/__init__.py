"""What every package builds on: errors, units, files, the cache, progress, worker processes."""

from polhode.base import _cache as cache
from polhode.base._bounds import bound_growth, bound_memory, bound_time, ended_with
from polhode.base._display import Shown, show_with
from polhode.base._documents import (
    SCHEMA,
    Codec,
    Provenance,
    ShapeRecord,
    digest,
    installed_version,
    provenance,
)
from polhode.base._errors import (
    ConstraintError,
    DeclarationError,
    DriftWarning,
    Exit,
    NumericError,
    ParseError,
    PolhodeError,
    StoreError,
    UnitError,
    exit_code,
    extra,
    look_up,
)
from polhode.base._files import read_whole, write_whole
from polhode.base._forked_worker import ForkedWorker, Tell, can_part, within
from polhode.base._progress import Progress, SilentProgress, StopRequested, terminal_progress
from polhode.base._quantity import (
    Quantity,
    Value,
    check_dimension,
    quantity_of,
    read_quantity,
    to_si,
)
from polhode.base._units import LENGTH, MASS, PURE, TIME, Dimension, Unit, read_unit

__all__ = [
    "LENGTH",
    "MASS",
    "PURE",
    "SCHEMA",
    "TIME",
    "Codec",
    "ConstraintError",
    "DeclarationError",
    "Dimension",
    "DriftWarning",
    "Exit",
    "ForkedWorker",
    "NumericError",
    "ParseError",
    "PolhodeError",
    "Progress",
    "Provenance",
    "Quantity",
    "ShapeRecord",
    "Shown",
    "SilentProgress",
    "StopRequested",
    "StoreError",
    "Tell",
    "Unit",
    "UnitError",
    "Value",
    "bound_growth",
    "bound_memory",
    "bound_time",
    "cache",
    "can_part",
    "check_dimension",
    "digest",
    "ended_with",
    "exit_code",
    "extra",
    "installed_version",
    "look_up",
    "provenance",
    "quantity_of",
    "read_quantity",
    "read_unit",
    "read_whole",
    "show_with",
    "terminal_progress",
    "to_si",
    "within",
    "write_whole",
]
