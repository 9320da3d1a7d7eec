"""Programs kept on disk between processes.

An entry is found by a digest of everything that a program is made from, and of the code that makes
it. It holds numbers only: what is read is checked, and becomes steps of known operations.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from hashlib import blake2b
from itertools import islice
from pathlib import Path
from typing import Any

import flint

from polhode.algebra._expression import Expr, variables
from polhode.algebra._ring import Symbol
from polhode.algebra.programs._program import Instruction, Op, Program
from polhode.base import cache

_FOLDER = "programs"
_OPERATIONS = tuple(Op)
_CODES = "cpa+-*/nsSCeHK"  # one letter for each of the operations, in their order
_NONE = (Op.CONST, Op.PI, Op.ARG)
_TWO = (Op.ADD, Op.SUB, Op.MUL, Op.DIV)


def stored(
    meaning: Iterable[str], arguments: tuple[Symbol, ...], make: Callable[[], Program]
) -> Program:
    """The program that an earlier process made from the same; else that of `make`, which is kept.

    Args:
        meaning: texts that say all that the program depends on.
        arguments: of the program.
        make: makes it.
    """
    texts = (_maker(), *meaning, "of", *map(_identity, arguments))
    key = blake2b("\n".join(texts).encode(), digest_size=20).hexdigest()
    kept = cache.read(_FOLDER, key)
    if kept is not None:
        try:
            return _read(kept, arguments)
        except (ValueError, TypeError, LookupError, zlib.error):
            pass  # damaged: made again
    program = make()
    cache.write(_FOLDER, key, _written(program))
    return program


def texts_of(expressions: Iterable[Expr]) -> Iterator[str]:
    """Texts that determine expressions: their normal forms, and which symbols they are in."""
    given = tuple(expressions)
    for expression in given:
        yield expression.key
    yield from sorted(map(_identity, variables(given)))


def _identity(symbol: Symbol) -> str:
    return f"{symbol.name} {symbol.kind.value} {symbol.order} {symbol.positive}"


@lru_cache(maxsize=1)
def _maker() -> str:
    """A digest of polhode's code, as a version under development changes without a new number."""
    digest = blake2b(flint.__version__.encode(), digest_size=20)
    package = Path(__file__).parents[2]
    for path in sorted(package.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _written(program: Program) -> bytes:
    steps = program.instructions
    document = {
        "operations": "".join(_CODES[_OPERATIONS.index(step.op)] for step in steps),
        "operands": [operand for step in steps for operand in step.operands],
        "values": [_pair(step.value) for step in steps if step.value is not None],
        "outputs": program.outputs,
    }
    return zlib.compress(json.dumps(document).encode(), 1)


def _pair(value: Fraction | int) -> list[int]:
    return [value.numerator, value.denominator]


def _read(content: bytes, arguments: tuple[Symbol, ...]) -> Program:
    """The program that was written; `ValueError` or the like for anything else."""
    document = json.loads(zlib.decompress(content))
    operands, values = iter(document["operands"]), iter(document["values"])
    steps = list[Instruction]()
    for code in document["operations"]:
        op = _OPERATIONS[_CODES.index(code)]
        count = 0 if op in _NONE else 2 if op in _TWO else 1
        places = tuple(islice(operands, count))
        if len(places) != count or not all(_is_place(i, steps) for i in places):
            raise ValueError(f"step {len(steps)}")
        steps.append(Instruction(op, places, _value(op, values, arguments)))
    outputs = tuple(document["outputs"])
    if not all(_is_place(i, steps) for i in outputs):
        raise ValueError("outputs")
    return Program(arguments, tuple(steps), outputs)


def _is_place(number: Any, steps: Sequence[Instruction]) -> bool:
    return type(number) is int and 0 <= number < len(steps)


def _value(op: Op, values: Iterator[Any], arguments: tuple[Symbol, ...]) -> Fraction | int | None:
    if op not in (Op.CONST, Op.ARG):
        return None
    above, below = next(values, (0, 0))
    if type(above) is not int or type(below) is not int or below < 1:
        raise ValueError("a number")
    if op is Op.ARG and not (below == 1 and 0 <= above < len(arguments)):
        raise ValueError("an argument")
    return above if below == 1 else Fraction(above, below)
