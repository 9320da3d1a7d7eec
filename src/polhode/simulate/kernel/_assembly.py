"""WebAssembly modules in binary form, from functions that are put together value by value.

A `Value` is code that leaves one number on the stack. Values combine by Python's operators, and a
`Function` is the sequence of statements that store them; `Module` turns functions into the bytes
that every host reads. Only what the kernel needs is here: 32-bit addresses and counters, 64-bit
integers, doubles, one memory, structured control flow. Nothing in it depends on
the host: relaxed and fused operations are left out.

Source: WebAssembly Core Specification 2.0, W3C, chapter 5 (binary format).
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import IntEnum
from typing import TypeAlias

# -- numbers of the binary format -----------------------------------------------------------------


def unsigned(number: int) -> bytes:
    """A number in seven bits per byte, the least significant first (unsigned LEB128)."""
    found = bytearray()
    while number >= 0x80:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*found, number])


def signed(number: int) -> bytes:
    """The same for numbers of either sign, in two's complement (signed LEB128)."""
    found = bytearray()
    while not -0x40 <= number < 0x40:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*found, number & 0x7F])


def vector(items: Sequence[bytes]) -> bytes:
    """Items after their number."""
    return unsigned(len(items)) + b"".join(items)


def text(name: str) -> bytes:
    """A name after its length."""
    encoded = name.encode()
    return unsigned(len(encoded)) + encoded


# -- values ---------------------------------------------------------------------------------------


class Type(IntEnum):
    """The types of values."""

    I32 = 0x7F
    I64 = 0x7E
    F64 = 0x7C


I32, I64, F64 = Type.I32, Type.I64, Type.F64

# Integer comparisons are signed; shifts to the right and divisions are not, as nothing negative is
# shifted or divided here.
_OPERATIONS: Mapping[Type, Mapping[str, int]] = {
    I32: {"==": 0x46, "!=": 0x47, "<": 0x48, ">": 0x4A, "<=": 0x4C, ">=": 0x4E,
          "+": 0x6A, "-": 0x6B, "*": 0x6C, "/": 0x6E, "&": 0x71, "|": 0x72, "^": 0x73,
          "<<": 0x74, ">>": 0x76},
    I64: {"==": 0x51, "!=": 0x52, "<": 0x53, ">": 0x55, "<=": 0x57, ">=": 0x59,
          "+": 0x7C, "-": 0x7D, "*": 0x7E, "/": 0x80, "&": 0x83, "|": 0x84, "^": 0x85,
          "<<": 0x86, ">>": 0x88},
    F64: {"==": 0x61, "!=": 0x62, "<": 0x63, ">": 0x64, "<=": 0x65, ">=": 0x66,
          "+": 0xA0, "-": 0xA1, "*": 0xA2, "/": 0xA3, "min": 0xA4, "max": 0xA5,
          "copysign": 0xA6, "abs": 0x99, "neg": 0x9A, "nearest": 0x9E, "sqrt": 0x9F},
}  # fmt: skip
_COMPARISONS = ("==", "!=", "<", ">", "<=", ">=")
_LOAD = {I32: 0x28, I64: 0x29, F64: 0x2B}
_STORE = {I32: 0x36, I64: 0x37, F64: 0x39}

Operand: TypeAlias = "Value | float"


@dataclass(frozen=True, eq=False)
class Value:
    """Code that leaves one number on the stack."""

    type: Type
    code: bytes

    def __add__(self, other: Operand) -> Value:
        return _binary("+", self, other)

    def __radd__(self, other: float) -> Value:
        return _binary("+", constant(self.type, other), self)

    def __sub__(self, other: Operand) -> Value:
        return _binary("-", self, other)

    def __rsub__(self, other: float) -> Value:
        return _binary("-", constant(self.type, other), self)

    def __mul__(self, other: Operand) -> Value:
        return _binary("*", self, other)

    def __rmul__(self, other: float) -> Value:
        return _binary("*", constant(self.type, other), self)

    def __truediv__(self, other: Operand) -> Value:
        return _binary("/", self, other)

    def __rtruediv__(self, other: float) -> Value:
        return _binary("/", constant(self.type, other), self)

    def __floordiv__(self, other: Operand) -> Value:
        return _binary("/", self, other)

    def __and__(self, other: Operand) -> Value:
        return _binary("&", self, other)

    def __or__(self, other: Operand) -> Value:
        return _binary("|", self, other)

    def __xor__(self, other: Operand) -> Value:
        return _binary("^", self, other)

    def __lshift__(self, other: Operand) -> Value:
        return _binary("<<", self, other)

    def __rshift__(self, other: Operand) -> Value:
        return _binary(">>", self, other)

    def __lt__(self, other: Operand) -> Value:
        return _binary("<", self, other)

    def __le__(self, other: Operand) -> Value:
        return _binary("<=", self, other)

    def __gt__(self, other: Operand) -> Value:
        return _binary(">", self, other)

    def __ge__(self, other: Operand) -> Value:
        return _binary(">=", self, other)

    def __neg__(self) -> Value:
        return _unary("neg", self)

    def equals(self, other: Operand) -> Value:
        """Whether both are the same number."""
        return _binary("==", self, other)

    def differs(self, other: Operand) -> Value:
        """Whether they are not; a NaN differs from itself."""
        return _binary("!=", self, other)


@dataclass(frozen=True, eq=False)
class Variable(Value):
    """The value of a local variable of a function."""

    place: int


def _variable(type: Type, place: int) -> Variable:
    return Variable(type, b"\x20" + unsigned(place), place)


def constant(type: Type, number: float) -> Value:
    """A number."""
    if type is F64:
        return Value(F64, b"\x44" + struct.pack("<d", number))
    bits = 32 if type is I32 else 64
    within = (int(number) + 2 ** (bits - 1)) % 2**bits - 2 ** (bits - 1)
    return Value(type, (b"\x41" if type is I32 else b"\x42") + signed(within))


def absolute(value: Value) -> Value:
    """|x|."""
    return _unary("abs", value)


def square_root(value: Value) -> Value:
    """√x, correctly rounded."""
    return _unary("sqrt", value)


def nearest(value: Value) -> Value:
    """The nearest whole number, of two the even one."""
    return _unary("nearest", value)


def least(a: Value, b: Operand) -> Value:
    """The smaller of two doubles; NaN if either is."""
    return _binary("min", a, b)


def largest(a: Value, b: Operand) -> Value:
    """The larger of two doubles; NaN if either is."""
    return _binary("max", a, b)


def with_sign_of(size: Value, sign: Operand) -> Value:
    """A double with the sign of another."""
    return _binary("copysign", size, sign)


def selected(condition: Value, yes: Operand, no: Value) -> Value:
    """One of two values; both are computed."""
    return Value(no.type, _operand(no.type, yes).code + no.code + condition.code + b"\x1b")


def denied(condition: Value) -> Value:
    """Whether a condition does not hold."""
    return Value(I32, condition.code + b"\x45")


def bits_of(value: Value) -> Value:
    """The 64 bits of a double."""
    return Value(I64, value.code + b"\xbd")


def double_of_bits(value: Value) -> Value:
    """The double with these bits."""
    return Value(F64, value.code + b"\xbf")


def to_double(value: Value) -> Value:
    """An integer as the nearest double."""
    return Value(F64, value.code + (b"\xb7" if value.type is I32 else b"\xb9"))


def to_integer(value: Value) -> Value:
    """A double of up to 31 bits as an integer, towards zero."""
    return Value(I32, value.code + b"\xaa")


def narrowed(value: Value) -> Value:
    """The lower half of a 64-bit integer."""
    return Value(I32, value.code + b"\xa7")


def widened(value: Value) -> Value:
    """A 32-bit integer, not negative, in 64 bits."""
    return Value(I64, value.code + b"\xad")


def load(type: Type, address: Value, offset: int = 0) -> Value:
    """What lies at an address of the memory, so many bytes further."""
    # the alignment promised, as a power of two, is that of the type
    return Value(
        type, address.code + bytes([_LOAD[type], 2 if type is I32 else 3]) + unsigned(offset)
    )


def _operand(type: Type, value: Operand) -> Value:
    if not isinstance(value, Value):
        return constant(type, value)
    if value.type is not type:
        raise TypeError(f"{value.type.name} where {type.name} is needed")
    return value


def _binary(name: str, a: Value, b: Operand) -> Value:
    code = a.code + _operand(a.type, b).code
    result = I32 if name in _COMPARISONS else a.type
    return Value(result, code + bytes([_OPERATIONS[a.type][name]]))


def _unary(name: str, a: Value) -> Value:
    return Value(a.type, a.code + bytes([_OPERATIONS[a.type][name]]))


# -- functions ------------------------------------------------------------------------------------


class Function:
    """A function: its parameters and results, and statements that are added one by one."""

    def __init__(
        self, place: int, name: str, parameters: Sequence[Type], results: Sequence[Type]
    ) -> None:
        self.place = place
        self.name = name
        self.results = tuple(results)
        self.parameters = tuple(_variable(type, i) for i, type in enumerate(parameters))
        self._locals = list[Type]()
        self._code = bytearray()
        self._depth = 0

    # -- variables ------------------------------------------------------------------------------

    def variable(self, type: Type) -> Variable:
        """A new variable, zero at first."""
        self._locals.append(type)
        return _variable(type, len(self.parameters) + len(self._locals) - 1)

    def let(self, value: Value) -> Variable:
        """A new variable that holds a value."""
        found = self.variable(value.type)
        self.set(found, value)
        return found

    def set(self, variable: Variable, value: Operand) -> None:
        """Give a variable a value."""
        self._code += _operand(variable.type, value).code + b"\x21" + unsigned(variable.place)

    def add(self, variable: Variable, value: Operand) -> None:
        """Add a value to a variable."""
        self.set(variable, variable + value)

    def store(self, address: Value, value: Value, offset: int = 0) -> None:
        """Write a value into the memory."""
        access = bytes([_STORE[value.type], 2 if value.type is I32 else 3])
        self._code += address.code + value.code + access + unsigned(offset)

    # -- calls ----------------------------------------------------------------------------------

    def call(self, function: Function, *operands: Operand) -> tuple[Variable, ...]:
        """The results of a function, in new variables."""
        self._code += _call(function, operands)
        found = tuple(self.variable(type) for type in function.results)
        for variable in reversed(found):
            self._code += b"\x21" + unsigned(variable.place)
        return found

    def give(self, *values: Operand) -> None:
        """Return these values."""
        for type, value in zip(self.results, values, strict=True):
            self._code += _operand(type, value).code
        self._code += b"\x0f"

    # -- control flow ---------------------------------------------------------------------------

    @contextmanager
    def when(self, condition: Value) -> Iterator[None]:
        """Statements that are done if a condition holds; after `otherwise`, if it does not."""
        self._code += condition.code + b"\x04\x40"
        with self._nested(1):
            yield

    def otherwise(self) -> None:
        """What follows, within `when`, is done if its condition does not hold."""
        self._code += b"\x05"

    @contextmanager
    def repeat(self) -> Iterator[Loop]:
        """Statements that are repeated until the loop is left."""
        self._code += b"\x02\x40\x03\x40"
        with self._nested(2):
            loop = Loop(self._depth)
            yield loop
            self.again(loop)

    @contextmanager
    def repeat_while(self, condition: Value) -> Iterator[Loop]:
        """Statements that are repeated as long as a condition holds."""
        with self.repeat() as loop:
            self.leave(loop, denied(condition))
            yield loop

    @contextmanager
    def count(
        self, variable: Variable, begin: Operand, end: Operand, by: int = 1
    ) -> Iterator[Loop]:
        """Statements for every number from one up to, and without, another."""
        self.set(variable, begin)
        with self.repeat_while(variable < end) as loop:
            yield loop
            self.add(variable, by)

    def leave(self, loop: Loop, condition: Value | None = None) -> None:
        """Go on behind a loop, if a condition holds."""
        self._jump(self._depth - loop.depth + 1, condition)

    def again(self, loop: Loop) -> None:
        """Go back to the beginning of a loop."""
        self._jump(self._depth - loop.depth, None)

    def choose(self, which: Value, cases: Sequence[Callable[[], None]]) -> None:
        """The statements of one case, by its number from zero on."""
        # One block for each case within the other, and one around all: leaving block k leads to
        # case k, and from its end out of the outermost.
        self._code += b"\x02\x40" * (len(cases) + 1)
        places = [unsigned(k) for k in range(len(cases))]
        self._code += which.code + b"\x0e" + vector(places) + unsigned(len(cases))
        self._depth += len(cases) + 1
        for k, case in enumerate(cases):
            self._end(1)
            case()
            self._jump(len(cases) - 1 - k, None)
        self._end(1)

    def body(self) -> bytes:
        """The function in the code section."""
        places = [unsigned(1) + bytes([type]) for type in self._locals]
        # A function whose statements return has nothing to fall through to at its end.
        ending = b"\x00\x0b" if self.results else b"\x0b"
        code = vector(places) + bytes(self._code) + ending
        return unsigned(len(code)) + code

    @contextmanager
    def _nested(self, blocks: int) -> Iterator[None]:
        self._depth += blocks
        yield
        self._end(blocks)

    def _end(self, blocks: int) -> None:
        self._depth -= blocks
        self._code += b"\x0b" * blocks

    def _jump(self, blocks: int, condition: Value | None) -> None:
        self._code += condition.code + b"\x0d" if condition is not None else b"\x0c"
        self._code += unsigned(blocks)


@dataclass(frozen=True)
class Loop:
    """A loop of a function, by how many blocks surround its statements."""

    depth: int


def called(function: Function, *operands: Operand) -> Value:
    """The one result of a function."""
    (type,) = function.results
    return Value(type, _call(function, operands))


def _call(function: Function, operands: Sequence[Operand]) -> bytes:
    pairs = zip(function.parameters, operands, strict=True)
    code = b"".join(_operand(parameter.type, value).code for parameter, value in pairs)
    return code + b"\x10" + unsigned(function.place)


# -- modules --------------------------------------------------------------------------------------

PAGE = 2**16
"""The unit of memory, in bytes."""


class Module:
    """Functions with one memory, which is exported under the name "memory"."""

    def __init__(self) -> None:
        self._functions = list[Function]()
        self._exported = list[Function]()
        self._data = list[tuple[int, bytes]]()
        self._notes = list[tuple[str, bytes]]()

    def function(
        self, name: str, parameters: Sequence[Type], results: Sequence[Type], *, shown: bool = False
    ) -> Function:
        """A new function; its statements are added to it. If `shown`, hosts may call it."""
        found = Function(len(self._functions), name, parameters, results)
        self._functions.append(found)
        if shown:
            self._exported.append(found)
        return found

    def data(self, address: int, content: bytes) -> None:
        """Bytes that the memory has at an address from the beginning."""
        self._data.append((address, content))

    def note(self, name: str, content: bytes) -> None:
        """A custom section, which hosts pass over and tools may read."""
        self._notes.append((name, content))

    def binary(self, size: int) -> bytes:
        """The module with a memory of at least so many bytes."""
        signatures = [_signature(function) for function in self._functions]
        types = sorted(set(signatures))
        exports = [text("memory") + b"\x02\x00"]
        exports += [text(f.name) + b"\x00" + unsigned(f.place) for f in self._exported]
        data = [
            b"\x00\x41" + signed(address) + b"\x0b" + unsigned(len(content)) + content
            for address, content in self._data
        ]
        sections = [
            (1, vector(types)),
            (3, vector([unsigned(types.index(signature)) for signature in signatures])),
            (5, vector([b"\x00" + unsigned(-(-size // PAGE))])),
            (7, vector(exports)),
            (10, vector([function.body() for function in self._functions])),
            (11, vector(data)),
            *((0, text(name) + content) for name, content in self._notes),
        ]
        head = b"\0asm" + struct.pack("<I", 1)
        return head + b"".join(bytes([k]) + unsigned(len(c)) + c for k, c in sections)


def _signature(function: Function) -> bytes:
    parameters = [bytes([variable.type]) for variable in function.parameters]
    return b"\x60" + vector(parameters) + vector([bytes([type]) for type in function.results])
