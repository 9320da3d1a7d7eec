"""Where everything lies in the memory of the kernel."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from functools import cached_property
from math import ceil, exp, log

from polhode.simulate.kernel._guards import work_size
from polhode.simulate.kernel._recurrences import STEP
from polhode.simulate.kernel._tape import Step, Tape

# -- the head: fields that the module finds at fixed addresses ------------------------------------

#: Integers, of which most are addresses.
INTEGERS = (
    "states",  # how many there are
    "row",  # bytes of a row of coefficients
    "order",  # of the Taylor series
    "rows",  # the first row
    "constant",  # steps of the tape that are done once; the varying ones follow
    "varying",
    "end",  # of the tape
    "rates",  # addresses of the rows of the rates
    "weights",  # of the states in the size of the motion
    "carries",  # what the states lack to their sums without rounding
    "records",  # of the steps of a call
    "record",  # bytes of a record
    "guards",  # how many there are
    "guard_rows",  # addresses of their rows
    "falls",  # shares of the last step at which they fall
    "sizes",  # the largest values of the guards so far
    "powers",  # coefficients of a guard by powers of the share of the step
    "work",  # of the search for a fall
    "done",  # steps of the last call
)
#: Doubles.
DOUBLES = (
    "time",  # the instant that was reached, as the sum of two doubles, s
    "rest",
    "goal",  # where the motion is to end, s
    "longest",  # step, s
    "share",  # of the radius of convergence, that a step may take
    "unit",  # of the time in the series, s
    "length",  # of the last step that the series allowed, s
)
_DOUBLES_BEGIN = 128
TABLE = 256
"""Address of the table of the elementary functions."""
BEGIN = 1024
"""Address of what belongs to one system."""

INTEGER_PLACES = {name: 4 * i for i, name in enumerate(INTEGERS)}
DOUBLE_PLACES = {name: _DOUBLES_BEGIN + 8 * i for i, name in enumerate(DOUBLES)}

#: Doubles before the coefficients in the record of a step: its beginning, as the sum of two, and
#: its length, s.
RECORD_HEAD = 3


def order_of(tolerance: float) -> int:
    """The order that costs least per unit of time: 1 − ½ ln ε (Jorba and Zou)."""
    return max(2, ceil(1 - log(tolerance) / 2))


@dataclass(frozen=True)
class Layout:
    """The memory of one system.

    Attributes:
        tape: of its rates.
        order: of the Taylor series.
        steps: the most that one call takes.
        guards: how many outputs of the tape are guards, those after the rates; the others are
            quantities that are computed on demand.
    """

    tape: Tape
    order: int
    steps: int
    guards: int = 0

    @property
    def row(self) -> int:
        """Bytes of a row of coefficients."""
        return 8 * (self.order + 1)

    @property
    def record(self) -> int:
        """Bytes of the record of a step."""
        return 8 * RECORD_HEAD + self.tape.states * self.row

    @cached_property
    def places(self) -> dict[str, int]:
        """Addresses, in the order of the memory."""
        tape = self.tape
        sizes = {
            "constant": STEP * len(tape.constant),
            "varying": STEP * len(tape.varying),
            "end": 0,
            "rates": 4 * tape.states,
            "weights": 8 * tape.states,
            "carries": 8 * tape.states,
            "guard_rows": 4 * self.guards,
            "falls": 8 * self.guards,
            "sizes": 8 * self.guards,
            "powers": self.row,
            "work": work_size(self.order),
            "rows": self.row * tape.rows,
            "records": self.record * self.steps,
        }
        found, place = dict[str, int](), BEGIN
        for name, size in sizes.items():
            found[name] = place
            place += -(-size // 16) * 16
        # the steps that vary follow those that do not without a gap
        found["varying"] = found["constant"] + sizes["constant"]
        found["end"] = found["varying"] + sizes["varying"]
        return found | {"size": place}

    @property
    def size(self) -> int:
        """Bytes of the whole memory."""
        return self.places["size"]

    def address(self, row: int) -> int:
        """Of a row."""
        return self.places["rows"] + row * self.row

    @property
    def states(self) -> range:
        """Addresses of the states."""
        return range(self.address(0), self.address(self.tape.states), self.row)

    @property
    def parameters(self) -> range:
        """Addresses of the parameters."""
        first = self.tape.states + 1
        rows = range(first, first + self.tape.parameters)
        return range(self.address(rows.start), self.address(rows.stop), self.row)

    def image(self) -> dict[int, bytes]:
        """What the memory holds at first, by address; the rest is zero."""
        places, tape = self.places, self.tape
        integers = places | {
            "states": tape.states,
            "row": self.row,
            "order": self.order,
            "record": self.record,
            "done": 0,
            "guards": self.guards,
        }
        share = exp(-2 - 0.7 / (self.order - 1))
        outputs = [self.address(row) for row in tape.outputs]
        rates, others = outputs[: tape.states], outputs[tape.states :]
        image = {
            0: struct.pack(f"<{len(INTEGERS)}i", *(integers[name] for name in INTEGERS)),
            DOUBLE_PLACES["share"]: struct.pack("<d", share),
            places["constant"]: b"".join(map(self._packed, (*tape.constant, *tape.varying))),
            places["rates"]: struct.pack(f"<{tape.states}i", *rates),
            places["guard_rows"]: struct.pack(f"<{self.guards}i", *others[: self.guards]),
            places["weights"]: struct.pack(f"<{tape.states}d", *[1.0] * tape.states),
        }
        for row, value in tape.numbers.items():
            image[self.address(row)] = struct.pack("<d", value)
        return image

    def _packed(self, step: Step) -> bytes:
        rows = (step.target, step.first, step.second)
        return struct.pack("<4i", step.kind, *map(self.address, rows))
