"""Equations as source code in other languages: NumPy, C, JAX, Julia.

What is written are the steps of the compiled programs, so that the code needs no symbolic algebra
and no library beyond elementary functions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Final, Literal, overload

from polhode.algebra import Expr, Op, Program, Symbol
from polhode.base import DeclarationError, installed_version, look_up
from polhode.derive import Equations, equations_only
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._names import Name

KERNEL: Final = "wasm"
"""The language of modules that integrate the motion themselves."""

_NOTHING: Mapping[Name, Any] = MappingProxyType({})


@overload
def export(
    equations: Equations,
    to: Literal["wasm"],
    parameters: Mapping[Name, Any] = ...,
    start: Mapping[Name, Any] = ...,
    forcing: Mapping[Name, Any] = ...,
) -> bytes: ...


@overload
def export(equations: Equations, to: Literal["numpy", "c", "jax", "julia"]) -> str: ...


@overload
def export(
    equations: Equations,
    to: str,
    parameters: Mapping[Name, Any] = ...,
    start: Mapping[Name, Any] = ...,
    forcing: Mapping[Name, Any] = ...,
) -> str | bytes: ...


def export(
    equations: Equations,
    to: str,
    parameters: Mapping[Name, Any] = _NOTHING,
    start: Mapping[Name, Any] = _NOTHING,
    forcing: Mapping[Name, Any] = _NOTHING,
) -> str | bytes:
    """The equations of motion, the reactions and the energy as source code, or as a kernel.

    The code has three functions of the time t, the state x (coordinates, then independent speeds),
    the parameters p and the values f of prescribed functions, each followed by its first and
    second derivative: `rates` (dx/dt), `reactions` and `energy`, all in SI units. Its head lists
    what each entry is. In C they write into their last argument; in Julia `rates!` has the
    signature of DifferentialEquations.jl, with p holding the parameters, then f.

    "wasm" gives a WebAssembly module that integrates the motion by Taylor's method, the same bits
    wherever it runs. Its section "polhode" describes its memory as JSON: names, SI units, addresses
    and values of states, parameters and quantities, and the normal forces that end a motion when
    they vanish. Hosts set parameters and state, call `start`, then `advance(steps)` until the
    status says why the motion ends; each step is recorded as a polynomial of the share of it that
    has passed. `values` computes the quantities at the state that was reached.

    Args:
        equations: from `derive`.
        to: "numpy", "c", "jax", "julia" or "wasm".
        parameters: for "wasm", values that the module is to begin with; as for `simulate`.
        start: likewise, start values.
        forcing: for "wasm", an expression of time for every prescribed function.

    Raises:
        DeclarationError: for another language, equations of several contact modes, forces with
            kinks, and prescribed functions without an expression.
        ConstraintError, NumericError, UnitError: for values that `simulate` would refuse.
    """
    equations_only(equations, "an export")
    language = look_up(to, {**LANGUAGES, KERNEL: None}, "language")
    dynamics = Dynamics(equations, {})
    if dynamics.undecided:
        raise DeclarationError(
            f"{equations.system.name!r}, whose forces jump or have kinks",
            expected="forces that are smooth functions of the state",
            advice="simulate it with polhode, which treats each side separately",
        )
    if language is None:
        from polhode.simulate._export_kernel import exported_kernel

        return exported_kernel(equations, parameters, start, forcing).binary
    if parameters or start or forcing:
        raise DeclarationError(
            f"values for source code in {to}",
            expected=f"none, or the language {KERNEL}",
            advice="the code takes them as arguments",
        )
    given = tuple(
        symbol
        for function in equations.functions
        for symbol in (function, function.derivative(), function.derivative().derivative())
    )
    arguments = (*dynamics.states, *dynamics.parameters, CLOCK, *given)
    names = _argument_names(language, dynamics, given)
    wanted: dict[str, tuple[Expr, ...]] = {
        "rates": dynamics.rates,
        # those that Newton's laws leave open by the choice of smallest forces
        "reactions": tuple({**equations.components, **equations.least}.values()),
        "energy": (equations.energy,),
    }
    bodies = (
        language.function(name, dynamics.program(expressions, arguments), names)
        for name, expressions in wanted.items()
    )
    return "\n".join([*_head(language, equations, dynamics, given), *bodies])


@dataclass(frozen=True)
class Language:
    """How straight-line programs are written in one language.

    Attributes:
        suffix: of files.
        comment: what a comment begins with.
        opening: the lines before the first function.
        first: the index of the first entry of an array.
        pi: the number π.
        call: prefix of elementary functions.
        step: one assignment to a new name.
        frame: a whole function, from its name, its steps and its results.
    """

    suffix: str
    comment: str
    opening: tuple[str, ...]
    first: int
    pi: str
    call: str
    step: str
    frame: Callable[[str, list[str], list[str]], list[str]]

    def function(self, name: str, program: Program, names: tuple[str, ...]) -> str:
        """The source of a function that computes the outputs of a program."""
        values: list[str] = []
        lines: list[str] = []
        for i, (op, operands, value) in enumerate(program.instructions):
            parts = [values[k] for k in operands]
            if op is Op.CONST:
                values.append(_number(Fraction(value or 0)))
            elif op is Op.PI:
                values.append(self.pi)
            elif op is Op.ARG:
                values.append(names[int(value or 0)])
            else:
                values.append(f"v{i}")
                lines.append(self.step.format(name=f"v{i}", value=self._written(op, parts)))
        outputs = [values[i] for i in program.outputs]
        return "\n".join(self.frame(name, lines, outputs)) + "\n"

    def _written(self, op: Op, parts: list[str]) -> str:
        if op in _SIGNS:
            return f" {_SIGNS[op]} ".join(parts)
        return f"-{parts[0]}" if op is Op.NEG else f"{self.call}{op.value}({parts[0]})"


_SIGNS: Mapping[Op, str] = {Op.ADD: "+", Op.SUB: "-", Op.MUL: "*", Op.DIV: "/"}


def _number(value: Fraction) -> str:
    """A number in double precision, which all four languages read alike."""
    return repr(float(value))


def _argument_names(
    language: Language, dynamics: Dynamics, given: tuple[Symbol, ...]
) -> tuple[str, ...]:
    first = language.first
    parameters = len(dynamics.parameters)
    states = (f"x[{first + i}]" for i in range(len(dynamics.states)))
    constants = (f"p[{first + i}]" for i in range(parameters))
    if language.suffix == "jl":  # one vector holds both
        driven = (f"p[{first + parameters + i}]" for i in range(len(given)))
    else:
        driven = (f"f[{first + i}]" for i in range(len(given)))
    return (*states, *constants, "t", *driven)


def _head(
    language: Language, equations: Equations, dynamics: Dynamics, given: tuple[Symbol, ...]
) -> Iterator[str]:
    lists: dict[str, Iterable[str]] = {
        "x": (s.published for s in dynamics.states),
        "p": (s.published for s in dynamics.parameters),
        "f": (s.published for s in given),
        "reactions": equations.components,
    }
    mark = language.comment
    name = " ".join(equations.system.name.split())  # a line break would end the comment
    yield f"{mark} {name}, exported by polhode {installed_version('polhode')}; SI units."
    for name, entries in lists.items():
        listed = ", ".join(entries)
        if listed:
            yield f"{mark} {name}: {listed}"
    if equations.undetermined:
        open_ = ", ".join(equations.undetermined)
        yield f"{mark} not determined, given by the smallest forces: {open_}"
    yield from ("", *language.opening)


# -- the languages ---------------------------------------------------------------------------------


def _python(name: str, lines: list[str], outputs: list[str]) -> list[str]:
    listed = ", ".join(outputs)
    result = f"_over_batch(t, x, p, f, [{listed}])"
    if name == "energy":
        result += "[0]"
    body = [f"    {line}" for line in lines]
    return [f"def {name}(t, x, p, f=()):", *body, f"    return {result}", ""]


def _python_opening(module: str, library: str) -> tuple[str, ...]:
    """The import, and a function that gives every entry the shape of the batch.

    An entry that does not depend on the state would otherwise be a single number among arrays.
    """
    return (
        f"import {module} as {library}",
        "",
        "",
        "def _over_batch(t, x, p, f, values):",
        f"    shapes = [{library}.shape(value) for value in (t, *x, *p, *f)]",
        f"    shape = {library}.broadcast_shapes(*shapes)",
        f"    rows = [{library}.broadcast_to(value, shape) for value in values]",
        f"    return {library}.stack(rows) if rows else {library}.zeros((0, *shape))",
        "",
        "",
    )


def _c(name: str, lines: list[str], outputs: list[str]) -> list[str]:
    signature = (
        f"void {name}(double t, const double *x, const double *p, const double *f, double *out)"
    )
    unused = "    (void)t; (void)x; (void)p; (void)f; (void)out;"
    stored = [f"    out[{i}] = {value};" for i, value in enumerate(outputs)]
    return [signature, "{", unused, *(f"    {line}" for line in lines), *stored, "}"]


def _julia(name: str, lines: list[str], outputs: list[str]) -> list[str]:
    stored = [f"    out[{i}] = {value}" for i, value in enumerate(outputs, 1)]
    head = f"function {name}!(out, x, p, t)"
    return [head, *(f"    {line}" for line in lines), *stored, "    return out", "end"]


LANGUAGES: Mapping[str, Language] = {
    "numpy": Language(
        "py",
        "#",
        _python_opening("numpy", "np"),
        0,
        "np.pi",
        "np.",
        "{name} = {value}",
        _python,
    ),
    "c": Language(
        "c",
        "//",
        ("#include <math.h>", ""),
        0,
        "3.141592653589793",
        "",
        "const double {name} = {value};",
        _c,
    ),
    "jax": Language(
        "py",
        "#",
        _python_opening("jax.numpy", "jnp"),
        0,
        "jnp.pi",
        "jnp.",
        "{name} = {value}",
        _python,
    ),
    "julia": Language("jl", "#", (), 1, "pi", "", "{name} = {value}", _julia),
}
