"""What every room stands on: errors, units, the cache, progress and the schema."""

from polhode.base import _cache as cache
from polhode.base._bounds import bound_growth, bound_memory, bound_time, ended_with
from polhode.base._dimension import LENGTH, MASS, PURE, TIME, Dimension
from polhode.base._display import Shown, show_with
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
)
from polhode.base._extras import extra
from polhode.base._files import read_whole, write_whole
from polhode.base._lookup import look_up
from polhode.base._plain import Codec, ShapeRecord, digest
from polhode.base._processes import Start, Tell, preload, shared_flag
from polhode.base._progress import Progress, SilentProgress, StopRequested, terminal_progress
from polhode.base._quantity import Quantity, Value, read_quantity, to_si
from polhode.base._schema import SCHEMA, Provenance, installed_version, provenance
from polhode.base._unit_text import read_unit
from polhode.base._units import Unit
from polhode.base._workers import (
    COPY_MEMORY,
    Outcome,
    Worker,
    WorkerEndedError,
    answers,
    can_copy,
    within,
)

__all__ = [
    "COPY_MEMORY",
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
    "NumericError",
    "Outcome",
    "ParseError",
    "PolhodeError",
    "Progress",
    "Provenance",
    "Quantity",
    "ShapeRecord",
    "Shown",
    "SilentProgress",
    "Start",
    "StopRequested",
    "StoreError",
    "Tell",
    "Unit",
    "UnitError",
    "Value",
    "Worker",
    "WorkerEndedError",
    "answers",
    "bound_growth",
    "bound_memory",
    "bound_time",
    "cache",
    "can_copy",
    "digest",
    "ended_with",
    "exit_code",
    "extra",
    "installed_version",
    "look_up",
    "preload",
    "provenance",
    "read_quantity",
    "read_unit",
    "read_whole",
    "shared_flag",
    "show_with",
    "terminal_progress",
    "to_si",
    "within",
    "write_whole",
]
