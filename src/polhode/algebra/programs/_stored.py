"""Programs kept on disk between processes.

An entry is found by a digest of everything that a program is made from, and of the code that makes
it. It holds numbers only: what is read is checked, and becomes steps of known operations.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable, Iterable, Iterator
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
_CODES = dict(zip(Op, "cpa+-*/nsSCeHK", strict=True))  # a letter for each operation
_NONE = (Op.CONST, Op.PI, Op.ARG)
_TWO = (Op.ADD, Op.SUB, Op.MUL, Op.DIV)
_KINDS = {code: (op, 0 if op in _NONE else 2 if op in _TWO else 1) for op, code in _CODES.items()}


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
        "operations": "".join(_CODES[step.op] for step in steps),
        "operands": [operand for step in steps for operand in step.operands],
        "values": [(v.numerator, v.denominator) for s in steps if (v := s.value) is not None],
        "outputs": program.outputs,
    }
    return zlib.compress(json.dumps(document).encode(), 1)


def _read(content: bytes, arguments: tuple[Symbol, ...]) -> Program:
    """The program that was written; `ValueError` or the like for anything else."""
    document = json.loads(zlib.decompress(content))
    operands, values = document["operands"], iter(document["values"])
    if not all(type(i) is int and i >= 0 for i in operands):
        raise ValueError("operands")
    steps, pending = list[Instruction](), iter(operands)
    for code in document["operations"]:
        op, count = _KINDS[code]
        places = tuple(islice(pending, count))
        if len(places) != count or max(places, default=-1) >= len(steps):
            raise ValueError(f"step {len(steps)}")
        steps.append(Instruction(op, places, _value(op, values, arguments) if not count else None))
    outputs = tuple(document["outputs"])
    if not all(type(i) is int and 0 <= i < len(steps) for i in outputs):
        raise ValueError("outputs")
    return Program(arguments, tuple(steps), outputs)


def _value(op: Op, values: Iterator[Any], arguments: tuple[Symbol, ...]) -> Fraction | int | None:
    if op not in (Op.CONST, Op.ARG):
        return None
    above, below = next(values, (0, 0))
    if type(above) is not int or type(below) is not int or below < 1:
        raise ValueError("a number")
    if op is Op.ARG and not (below == 1 and 0 <= above < len(arguments)):
        raise ValueError("an argument")
    return above if below == 1 else Fraction(above, below)
